//! compare-paper: each number that the paper publishes beside ours.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use polars::prelude::DataFrame;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::fit_pex::FitPex;
use super::fit_pro::FitPro;
use super::shared::groups::{self, Group};
use super::simulate::Simulate;
use crate::fragility::{Measure, Plane, p_overturning, plane_sample, rms_difference};
use crate::motion::IntensityMeasures;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output, StageOptions};
use crate::pipeline::options::defaults;
use crate::pipeline::stage::Stage;
use crate::pipeline::terminal::Terminal;
use crate::statistics::Test;
use crate::studies::paper::{EXAMPLE_LAMBDA, example, half_erf, hybrid, joint_test, rms_between};
use crate::table::fits;
use crate::table::paper::{self, PAPER, PaperRow, Published, SpreadRow};
use crate::table::pex::PexRow;
use crate::table::pro::ProRow;
use crate::table::row::{ReadRow, WriteRow};
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};

/// The spread over seeds that our numbers are compared with.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct ComparePaperOptions {
    /// CSV file of our numbers over seeds, from seed-spread [default: the built-in one, for the paper's set-up]
    #[arg(long, value_name = "FILE")]
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
    /// Whether that is the shipped one.
    is_shipped: bool,
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
        let is_shipped = options.spread.is_none();
        Ok(ComparePaper { published: paper::published()?, spread, is_shipped, pex, pro, responses, out })
    }
}

/// The fits and cases from which our numbers come.
struct Ours {
    groups: Vec<Group>,
    pex: Vec<PexRow>,
    pro: Vec<ProRow>,
    published: Vec<Published>,
}

/// Motions of each suite in the paper: 100 in each of 35 cells.
const MOTIONS_OF_PAPER: usize = 3500;

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

impl Ours {
    /// Our value of a published quantity; none where our files do not have it.
    ///
    /// # Errors
    /// If the quantity is unknown.
    fn value(&self, wanted: &Published) -> anyhow::Result<Option<f64>> {
        let quantity = wanted.quantity.as_str();
        if let Some((side, rest)) = Side::of(quantity) {
            let plane = self.plane(wanted, side);
            return Ok(match rest {
                "rms_ln_edp" => self.rms(wanted, side),
                "rms_over_beta" => self
                    .rms(wanted, side)
                    .zip(plane.and_then(|plane| plane.beta))
                    .map(|(rms, beta)| rms / beta),
                "ln_a" => plane.and_then(|plane| plane.ln_a),
                "b1" => plane.and_then(|plane| plane.b1),
                "b2" => plane.and_then(|plane| plane.b2),
                "r2" => plane.and_then(|plane| plane.r2),
                // A row of its joint test.
                "plane" => None,
                _ => anyhow::bail!("data/paper.csv: {quantity}: unknown quantity"),
            });
        }
        let of_two = || self.curve(wanted, Measure::Im4, Some(Measure::Im3Inverse));
        let im5 = || self.curve(wanted, Measure::Im5, None);
        let high = || self.plane(wanted, Side::High);
        let example = self.example(wanted);
        Ok(match quantity {
            "transition" => high().and_then(|plane| plane.transition_found),
            "r2_pooled" => high().and_then(|plane| plane.r2_pooled),
            "hybrid_lambda" => of_two().and_then(|curve| curve.lambda),
            "im5_theta" => im5().and_then(|curve| curve.theta),
            "im5_beta" => im5().and_then(|curve| curve.beta),
            "example_hybrid" => example.map(|(im, _)| im),
            "example_p_ro" => {
                example.and_then(|(im, curve)| Some(p_overturning(im, curve.mu?, curve.beta?, curve.link)))
            }
            "example_half_erf" => self
                .example_measures(wanted)
                .and_then(|measures| Some(half_erf(hybrid(&measures, EXAMPLE_LAMBDA)?))),
            _ => anyhow::bail!("data/paper.csv: {quantity}: unknown quantity"),
        })
    }

    fn group(&self, of: &Published) -> Option<&Group> {
        self.groups.iter().find(|group| of.is_of(&group.suite, &group.structure))
    }

    /// The measures of the worked example for a structure of it.
    fn example_measures(&self, of: &Published) -> Option<IntensityMeasures> {
        let group = self.group(of).filter(|group| !group.cases.is_empty())?;
        Some(example(&group.structure()))
    }

    /// The hybrid measure of the worked example for a structure of it, by our exponent, and the curve over it: the example takes that
    /// of the electrical equipment for both structures.
    fn example(&self, of: &Published) -> Option<(f64, &ProRow)> {
        let equipment = Published { structure: "electrical-equipment".to_string(), ..of.clone() };
        let curve = self.curve(&equipment, Measure::Im4, Some(Measure::Im3Inverse))?;
        Some((hybrid(&self.example_measures(of)?, curve.lambda?)?, curve))
    }

    fn plane(&self, of: &Published, side: Side) -> Option<&PexRow> {
        let [low, high] = fits::planes(self.pex.iter().filter(|row| of.is_of(&row.suite, &row.structure)))?;
        Some(match side {
            Side::Low => low,
            Side::High => high,
        })
    }

    fn curve(&self, of: &Published, x: Measure, y: Option<Measure>) -> Option<&ProRow> {
        let mut curves = self.pro.iter().filter(|row| of.is_of(&row.suite, &row.structure));
        curves.find(|row| row.is_of_overturning() && row.im_x == x && row.im_y == y)
    }

    /// How far the published plane lies from ours over our own cases, in ln EDP.
    fn rms(&self, of: &Published, side: Side) -> Option<f64> {
        let published = |coefficient: &str| {
            let quantity = format!("{}_{coefficient}", side.word());
            self.published
                .iter()
                .find(|p| p.is(&quantity, &of.suite, &of.structure))
                .and_then(|p| p.published)
        };
        let row = self.plane(of, side)?;
        let theirs = Plane { ln_a: published("ln_a")?, b1: published("b1")?, b2: published("b2")? };
        let ours = Plane { ln_a: row.ln_a?, b1: row.b1?, b2: row.b2? };
        rms_difference(&theirs, &ours, &plane_sample(&self.group(of)?.cases, side.range()))
    }

    /// What a root mean square of a side is between planes of two seeds.
    fn seed_rms(&self, of: &Published, spread: &Spread) -> Option<f64> {
        let (side, rest) = Side::of(&of.quantity).filter(|(_, rest)| rest.starts_with("rms"))?;
        let plane = |set: &Vec<f64>| Plane { ln_a: set[0], b1: set[1], b2: set[2] };
        let planes: Vec<Plane> = sets(spread, of, side)?.iter().map(plane).collect();
        let rms = rms_between(&planes, &plane_sample(&self.group(of)?.cases, side.range()))?;
        Some(rms / if rest == "rms_over_beta" { self.plane(of, side)?.beta? } else { 1.0 })
    }

    /// Whether the published plane could be that of one more seed.
    fn joint(&self, of: &Published, spread: &Spread) -> Option<Test> {
        let (side, _) = Side::of(&of.quantity).filter(|(_, rest)| *rest == "plane")?;
        let printed = NUMBERS_OF_PLANE.iter().map(|number| {
            let quantity = format!("{}_{number}", side.word());
            let number = self.published.iter().find(|p| p.is(&quantity, &of.suite, &of.structure))?;
            Some((number.published?, number.rounding()?))
        });
        let (printed, rounding): (Vec<f64>, Vec<f64>) =
            printed.collect::<Option<Vec<_>>>()?.into_iter().unzip();
        joint_test(&sets(spread, of, side)?, &printed, &rounding)
    }
}

/// What Table II prints of a plane.
const NUMBERS_OF_PLANE: [&str; 4] = ["ln_a", "b1", "b2", "r2"];

/// The numbers of a plane, seed by seed; none where a seed lacks one.
fn sets(spread: &Spread, of: &Published, side: Side) -> Option<Vec<Vec<f64>>> {
    let over_seeds = |number: &&str| {
        let quantity = format!("{}_{number}", side.word());
        let key = (quantity.as_str(), of.suite.as_str(), of.structure.as_str());
        spread.iter().find(|(other, _)| **other == key).map(|(_, values)| values)
    };
    let numbers: Vec<&Vec<f64>> = NUMBERS_OF_PLANE.iter().map(over_seeds).collect::<Option<_>>()?;
    let seeds = numbers[0].len();
    let complete = numbers.iter().all(|values| values.len() == seeds);
    complete.then(|| (0..seeds).map(|seed| numbers.iter().map(|values| values[seed]).collect()).collect())
}

/// Values over seeds of each quantity, suite and structure.
type Spread<'a> = BTreeMap<(&'a str, &'a str, &'a str), Vec<f64>>;

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
    const ABOUT: &'static str = "Compare our numbers with those that the paper publishes";
    const EXAMPLES: &'static str = "rockfrag compare-paper\n\
        rockfrag compare-paper --format json";
    const INPUTS: &'static [Input] = &[
        Input::file("pex", "pex", FitPex::OUTPUT.file, "Demand fits, from fit-pex"),
        Input::file("pro", "pro", FitPro::OUTPUT.file, "Overturning curves, from fit-pro"),
        Input::file(
            "responses",
            "responses",
            Simulate::OUTPUT.file,
            "Responses that both were fitted to, from simulate",
        ),
    ];
    const OUTPUT: Output = Output::file(
        "paper.parquet",
        "Comparison file to write [default: paper.parquet beside the regressions]",
    );
    const SHOWS_TABLE: bool = true;
    const HAS_PROGRESS: bool = false;

    fn create(options: &ComparePaperOptions, files: &Files) -> anyhow::Result<ComparePaper> {
        let inputs = [files.input("pex")?, files.input("pro")?, files.input("responses")?];
        ComparePaper::new(options, inputs, files.out(Self::OUTPUT.file)?)
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

    fn rows(&self) -> anyhow::Result<Option<DataFrame>> {
        self.out.path().map(paper::shown).transpose()
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let ours = Ours {
            groups: groups::read(&self.responses)?,
            pex: PexRow::read(self.pex.clone())?,
            pro: ProRow::read(self.pro.clone())?,
            published: self.published.clone(),
        };
        let spread = by_quantity(&self.spread);
        let row = |published: &Published| {
            let key = (published.quantity.as_str(), published.suite.as_str(), published.structure.as_str());
            let values = spread.get(&key).map_or(&[][..], Vec::as_slice);
            let joint = ours.joint(published, &spread);
            Ok(PaperRow {
                seed_rms: ours.seed_rms(published, &spread),
                t2: joint.map(|test| test.statistic),
                t2_p: joint.map(|test| test.p),
                ..PaperRow::new(published, ours.value(published)?, values)
            })
        };
        let rows: Vec<PaperRow> = self.published.iter().map(row).collect::<anyhow::Result<_>>()?;
        PaperRow::write(&rows, self.out.clone(), provenance)?;
        let of_paper =
            |group: &&Group| self.published.iter().any(|p| p.is_of(&group.suite, &group.structure));
        let other = ours.groups.iter().filter(of_paper).find(|group| group.cases.len() != MOTIONS_OF_PAPER);
        if let Some(group) = other.filter(|_| self.is_shipped) {
            console.note(&format!(
                "mean, sd and z are of seeds of the paper's {MOTIONS_OF_PAPER} motions, these responses are to {}; seed-spread makes a --spread of others",
                group.cases.len()
            ));
        }
        let published = rows.iter().filter(|row| row.published.is_some());
        let missing = published.clone().filter(|row| row.ours.is_none()).count();
        Ok(match missing {
            0 => format!("{} published numbers", published.count()),
            missing => format!("{} published numbers, {missing} without ours", published.count()),
        })
    }
}
