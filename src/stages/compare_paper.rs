//! compare-paper: each number that the paper publishes beside ours.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::fit_pex::FitPex;
use super::fit_pro::FitPro;
use super::shared::groups::{self, Group};
use super::simulate::Simulate;
use crate::fragility::{Case, Plane, p_overturning, rms_difference};
use crate::motion::IntensityMeasures;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output, StageOptions};
use crate::pipeline::options::defaults;
use crate::pipeline::stage::Stage;
use crate::pipeline::terminal::Terminal;
use crate::statistics::Test;
use crate::studies::paper::{EXAMPLE_LAMBDA, example, half_erf, hybrid, joint_test, rms_between};
use crate::table::paper::{self, PAPER, PaperRow, Published, SpreadRow};
use crate::table::row::WriteRow;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::{pex::PexFrame, pro::ProFrame};

/// Against which spread over seeds our numbers are held.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct ComparePaperOptions {
    /// CSV file of the numbers over seeds, as seed-spread writes it [default: the one shipped, of the paper's set-up]
    #[arg(long)]
    pub spread: Option<PathBuf>,
}

impl Default for ComparePaperOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for ComparePaperOptions {
    fn resolve_paths(&mut self, folder: &Path) {
        if let Some(spread) = &mut self.spread {
            *spread = folder.join(&*spread);
        }
    }
}

/// The stage, ready to run.
pub struct ComparePaper {
    published: Vec<Published>,
    spread: Vec<SpreadRow>,
    pex: Source,
    pro: Source,
    responses: Source,
    out: Target,
}

impl ComparePaper {
    /// Of the fits in `pex` and `pro` and their `responses`, into the file `out`.
    ///
    /// # Errors
    /// If the spread cannot be read.
    pub fn new(
        options: &ComparePaperOptions,
        [pex, pro, responses]: [Source; 3],
        out: impl Into<Target>,
    ) -> anyhow::Result<ComparePaper> {
        let out = out.into();
        let spread = paper::spread(options.spread.as_deref())?;
        Ok(ComparePaper { published: paper::published()?, spread, pex, pro, responses, out })
    }
}

/// The fits and cases from which our numbers come.
struct Ours {
    groups: Vec<Group>,
    pex: PexFrame,
    pro: ProFrame,
    published: Vec<Published>,
}

/// One side of the transition, IM4 = 1.30 in the paper.
#[derive(Clone, Copy)]
enum Side {
    Low,
    High,
}

impl Side {
    fn range(self) -> std::ops::Range<f64> {
        match self {
            Side::Low => 1.0..paper::TRANSITION,
            Side::High => paper::TRANSITION..f64::INFINITY,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Side::Low => "low",
            Side::High => "high",
        }
    }

    /// The side that a quantity is of, and what of it.
    fn of(quantity: &str) -> Option<(Side, &str)> {
        let of = |side: Side| Some((side, quantity.strip_prefix(side.word())?.strip_prefix('_')?));
        of(Side::Low).or_else(|| of(Side::High))
    }
}

/// The suite and structure whose curve the worked example takes, for both of its structures.
const EXAMPLE: (&str, &str) = ("csgm", "electrical-equipment");

impl Ours {
    /// Our value of a published quantity; none where our files do not have it.
    fn value(&self, wanted: &Published) -> Option<f64> {
        let (suite, structure) = (wanted.suite.as_str(), wanted.structure.as_str());
        let quantity = wanted.quantity.as_str();
        if let Some((side, rest)) = Side::of(quantity) {
            return match rest {
                "rms_ln_edp" => self.rms(suite, structure, side),
                "rms_over_beta" => {
                    let beta = self.plane_number(suite, structure, side, "beta")?;
                    Some(self.rms(suite, structure, side)? / beta)
                }
                "plane" => None,
                column => self.plane_number(suite, structure, side, column),
            };
        }
        let curve = |column| self.pro.number(EXAMPLE.0, EXAMPLE.1, "im4", Some("im3_inv"), column);
        let example_hybrid = || hybrid(&self.example(suite, structure)?, curve("lambda")?);
        match quantity {
            "transition" => self.plane_number(suite, structure, Side::High, "transition_found"),
            "r2_pooled" => self.plane_number(suite, structure, Side::High, "r2_pooled"),
            "hybrid_lambda" => self.pro.number(suite, structure, "im4", Some("im3_inv"), "lambda"),
            "im5_theta" => self.pro.number(suite, structure, "im5", None, "theta"),
            "im5_beta" => self.pro.number(suite, structure, "im5", None, "beta"),
            "example_hybrid" => example_hybrid(),
            "example_p_ro" => {
                Some(p_overturning(example_hybrid()?, curve("mu")?, curve("beta")?, self.pro.link()?))
            }
            "example_half_erf" => Some(half_erf(hybrid(&self.example(suite, structure)?, EXAMPLE_LAMBDA)?)),
            _ => None,
        }
    }

    fn group(&self, suite: &str, structure: &str) -> Option<&Group> {
        self.groups.iter().find(|g| g.suite.as_deref() == Some(suite) && g.structure == structure)
    }

    fn cases(&self, suite: &str, structure: &str) -> Option<&[Case]> {
        Some(&self.group(suite, structure)?.cases)
    }

    /// The measures of the worked example for a structure.
    fn example(&self, suite: &str, structure: &str) -> Option<IntensityMeasures> {
        let group = self.group(suite, structure).filter(|group| !group.cases.is_empty())?;
        Some(example(&group.structure_of(0)))
    }

    fn plane_number(&self, suite: &str, structure: &str, side: Side, column: &str) -> Option<f64> {
        self.pex.plane_number(suite, structure, matches!(side, Side::Low), column)
    }

    /// How far the published plane lies from ours over our own cases, in ln EDP.
    fn rms(&self, suite: &str, structure: &str, side: Side) -> Option<f64> {
        let published = |coefficient: &str| {
            let quantity = format!("{}_{coefficient}", side.word());
            self.published.iter().find(|p| p.is(&quantity, suite, structure)).and_then(|p| p.published)
        };
        let ours = |coefficient| self.plane_number(suite, structure, side, coefficient);
        let theirs = Plane { ln_a: published("ln_a")?, b1: published("b1")?, b2: published("b2")? };
        let ours = Plane { ln_a: ours("ln_a")?, b1: ours("b1")?, b2: ours("b2")? };
        rms_difference(&theirs, &ours, self.cases(suite, structure)?, side.range())
    }

    /// What a root mean square of a side is between planes of our seeds.
    fn seed_rms(&self, wanted: &Published, spread: &Spread) -> Option<f64> {
        let (side, rest) = Side::of(&wanted.quantity)?;
        let (suite, structure) = (wanted.suite.as_str(), wanted.structure.as_str());
        let plane = |set: Vec<f64>| Plane { ln_a: set[0], b1: set[1], b2: set[2] };
        let planes: Vec<Plane> = sets(spread, side, wanted)?.into_iter().map(plane).collect();
        let rms = || rms_between(&planes, self.cases(suite, structure)?, side.range());
        match rest {
            "rms_ln_edp" => rms(),
            "rms_over_beta" => Some(rms()? / self.plane_number(suite, structure, side, "beta")?),
            _ => None,
        }
    }

    /// Whether the published plane could be one more of our seeds.
    fn joint(&self, wanted: &Published, spread: &Spread) -> Option<Test> {
        let (side, _) = Side::of(&wanted.quantity).filter(|(_, rest)| *rest == "plane")?;
        let published = NUMBERS_OF_PLANE.map(|number| {
            let quantity = format!("{}_{number}", side.word());
            let of_plane =
                self.published.iter().find(|p| p.is(&quantity, &wanted.suite, &wanted.structure))?;
            Some((of_plane.published?, of_plane.rounding()?))
        });
        let published: Option<Vec<(f64, f64)>> = published.into_iter().collect();
        let (printed, rounding): (Vec<f64>, Vec<f64>) = published?.into_iter().unzip();
        joint_test(&sets(spread, side, wanted)?, &printed, &rounding)
    }
}

/// What Table II prints of a plane.
const NUMBERS_OF_PLANE: [&str; 4] = ["ln_a", "b1", "b2", "r2"];

/// Values over seeds of each quantity, suite and structure.
type Spread<'a> = BTreeMap<(&'a str, &'a str, &'a str), Vec<f64>>;

/// The numbers of a plane, seed by seed; none where a seed lacks one.
fn sets(spread: &Spread, side: Side, of: &Published) -> Option<Vec<Vec<f64>>> {
    let over_seeds = |number: &str| {
        let quantity = format!("{}_{number}", side.word());
        let key = (quantity.as_str(), of.suite.as_str(), of.structure.as_str());
        spread.iter().find(|(other, _)| **other == key).map(|(_, values)| values)
    };
    let numbers = NUMBERS_OF_PLANE.iter().map(|number| over_seeds(number)).collect::<Option<Vec<_>>>()?;
    let seeds = numbers[0].len();
    let complete = numbers.iter().all(|values| values.len() == seeds);
    complete.then(|| (0..seeds).map(|seed| numbers.iter().map(|values| values[seed]).collect()).collect())
}

fn by_quantity(spread: &[SpreadRow]) -> Spread<'_> {
    let mut values = Spread::new();
    for row in spread {
        let key = (row.quantity.as_str(), row.suite.as_str(), row.structure.as_str());
        values.entry(key).or_default().push(row.value);
    }
    values
}

impl Declare for ComparePaper {
    type Options = ComparePaperOptions;
    const NAME: &'static str = PAPER.stage;
    const ABOUT: &'static str = "Hold our numbers against the published ones";
    const INPUTS: &'static [Input] = &[
        Input::file("pex", "pex", FitPex::OUTPUT.file, "Regressions of fit-pex"),
        Input::file("pro", "pro", FitPro::OUTPUT.file, "Curves of fit-pro"),
        Input::file("responses", "responses", Simulate::OUTPUT.file, "Responses that both were fitted to"),
    ];
    const OUTPUT: Output = Output::file(
        "paper.parquet",
        "Comparison file to write [default: paper.parquet beside the regressions]",
    );

    fn create(options: &ComparePaperOptions, files: &Files) -> anyhow::Result<ComparePaper> {
        let inputs = [files.input("pex")?, files.input("pro")?, files.input("responses")?];
        ComparePaper::new(options, inputs, files.out(Self::OUTPUT.file))
    }
}

impl Stage for ComparePaper {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("pex", self.pex.clone()), ("pro", self.pro.clone()), ("responses", self.responses.clone())]
    }

    fn targets(&self) -> Vec<Target> {
        vec![self.out.clone()]
    }

    fn parameters(&self) -> Value {
        let hash = |rows: Value| blake3::hash(rows.to_string().as_bytes()).to_hex().to_string();
        json!({ "published": hash(json!(self.published)), "spread": hash(json!(self.spread)) })
    }

    fn show(&self, terminal: &Terminal) -> anyhow::Result<String> {
        self.out.path().map_or(Ok(String::new()), |out| Ok(terminal.table(&paper::show(out)?)))
    }

    fn execute(&self, provenance: &Provenance, _console: &Console) -> anyhow::Result<String> {
        let ours = Ours {
            groups: groups::read(&self.responses)?,
            pex: PexFrame::read(&self.pex)?,
            pro: ProFrame::read(&self.pro)?,
            published: self.published.clone(),
        };
        let spread = by_quantity(&self.spread);
        let row = |published: &Published| {
            let key = (published.quantity.as_str(), published.suite.as_str(), published.structure.as_str());
            let values = spread.get(&key).map_or(&[][..], Vec::as_slice);
            let joint = ours.joint(published, &spread);
            PaperRow {
                seed_rms: ours.seed_rms(published, &spread),
                t2: joint.map(|test| test.statistic),
                t2_p: joint.map(|test| test.p),
                ..PaperRow::new(published, ours.value(published), values)
            }
        };
        let rows: Vec<PaperRow> = self.published.iter().map(row).collect();
        PaperRow::write(&rows, self.out.clone(), provenance)?;
        Ok(format!("{} published numbers", rows.iter().filter(|row| row.published.is_some()).count()))
    }
}
