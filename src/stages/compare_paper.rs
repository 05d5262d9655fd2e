//! compare-paper: each published number beside that of this run.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::fragility::DemandFit;
use rockfrag_core::paper;
use rockfrag_core::rocking::Structure;
use rockfrag_core::studies::comparison::{Comparison, compare};
use serde::{Deserialize, Serialize};

use super::default_options;
use super::shared::fits::text;
use crate::number::{counted, fixed};
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::paths::Read;
use crate::table::frame;
use crate::table::provenance::{Provenance, text_of};
use crate::table::rows;

/// Compare fits of the paper's set-up with the published numbers
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag compare-paper\n\
    rockfrag compare-paper --pex fits/pex.parquet --pro fits/pro.parquet --all --out paper.parquet")]
pub struct ComparePaper {
    /// Fits of fit-pex
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "pex.parquet")]
    pex: PathBuf,
    /// Fits of fit-pro
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "pro.parquet")]
    pro: PathBuf,
    /// Comparison to write
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "paper.parquet")]
    out: PathBuf,
    /// Print every number, not only those that differ from those of this run
    #[arg(long)]
    #[serde(skip_serializing)]
    all: bool,
}

impl Stage for ComparePaper {
    fn inputs(&self) -> Vec<Read> {
        let beside = Read::new("beside", UPSTREAM_FILES.map(|name| self.pex.with_file_name(name)));
        let beside = Read { optional: true, ..beside };
        vec![Read::new("pex", [&self.pex]), Read::new("pro", [&self.pro]), beside]
    }

    fn outputs(&self) -> Vec<PathBuf> {
        vec![self.out.to_path_buf()]
    }

    fn printed(&self, verdict: &str) -> anyhow::Result<Option<String>> {
        self.text(verdict, &rows::read(&self.out)?).map(Some)
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let demand: Vec<DemandFit> = rows::read(&self.pex)?;
        let compared = compare(&demand, &rows::read(&self.pro)?);
        let differences = [other_structures(&demand), other_options(&self.pex)].concat();
        let verdict = verdict(&compared, &differences);
        context.write::<Comparison>(&self.out, &compared, &verdict)?;
        self.text(&verdict, &compared)
    }
}

impl ComparePaper {
    fn text(&self, verdict: &str, compared: &[Comparison]) -> anyhow::Result<String> {
        let differs = |row: &&Comparison| row.z.is_some_and(|z| z.abs() >= AGREES);
        let rows = match self.all {
            true => frame::text(&frame::from_batch(&rows::batch(compared)?)?),
            false => text(compared.iter().filter(differs), COLUMNS, &self.out)?,
        };
        Ok(verdict.to_string() + &rows)
    }
}

const COLUMNS: &str = "quantity place suite structure published ours z";
/// Within this many standard deviations over seeds a published number agrees with that of the run.
const AGREES: f64 = 2.0;

/// How many published numbers agree with those of this run, and what is not the paper's set-up.
fn verdict(compared: &[Comparison], differences: &[String]) -> String {
    let z: Vec<f64> = compared.iter().filter_map(|row| row.z).collect();
    let agree = z.iter().filter(|z| z.abs() < AGREES).count();
    let others = compared.iter().filter(|row| row.published.is_some()).count() - z.len();
    let count = format!(
        "{agree} of {} are within two standard deviations (over 20 seeds) of those of this run, {} are not; \
         {others} more cannot be compared.\n",
        counted(z.len(), "published number"),
        z.len() - agree
    );
    match differences {
        [] => count,
        _ => format!("not the paper's set-up ({}): {count}", differences.join("; ")),
    }
}

/// Which of the paper's structures have no fits.
fn other_structures(demand: &[DemandFit]) -> Vec<String> {
    let is_fitted = |Structure { name, p_rad_s, alpha_rad, eta, .. }: &Structure| {
        let mut its = demand.iter().filter(|fit| fit.structure == *name);
        its.any(|fit| (fit.p_rad_s, fit.alpha_rad, fit.eta) == (*p_rad_s, *alpha_rad, *eta))
    };
    let others = paper::structures().into_iter().filter(|structure| !is_fitted(structure));
    others.map(|structure| format!("no fits of its {}", structure.name)).collect()
}

/// Options that do not change what is compared.
const NEUTRAL: [&str; 7] = ["seed", "partition", "housner", "sa", "structure", "structures", "trace"];

/// The tables of the stages before the fits, the last first.
const UPSTREAM_FILES: [&str; 3] = ["responses.parquet", "motions.parquet", "scenarios.parquet"];

/// What options of the stages before the fits are not the paper's, which are the defaults; as far as the
/// files of these stages are beside the fits.
fn other_options(fits: &Path) -> Vec<String> {
    let read = |path: &Path| Provenance::read(path).ok().flatten();
    let (mut differences, mut child) = (Vec::new(), read(fits).unwrap_or_default());
    for file in UPSTREAM_FILES {
        let made = read(&fits.with_file_name(file)).filter(|made| child.input("in") == Some(made.key()));
        let Some(made) = made else { break };
        let paper = default_options(&made.stage);
        let flags: BTreeSet<&String> = made.arguments.keys().chain(paper.keys()).collect();
        for flag in flags.into_iter().filter(|flag| !NEUTRAL.contains(&flag.as_str())) {
            let now = made.arguments.get(flag).map(text_of).or(made.names(flag));
            let [now, then] = [now, paper.get(flag).map(text_of)].map(|text| text.unwrap_or("none".into()));
            if now != then {
                differences.push(format!("{} --{flag} {now}, not {then}", made.stage));
            }
        }
        child = made;
    }
    differences
}

/// The eight planes of Table II: suite, structure, side of the transition, ln a, b1, b2 and R2.
pub fn table_two(compared: &[Comparison]) -> impl Iterator<Item = [String; 7]> {
    let planes = compared.iter().filter(|number| number.quantity.ends_with("_plane"));
    planes.map(|Comparison { quantity, suite, structure, .. }| {
        let [ln_a, b1, b2, r2] = ["ln_a", "b1", "b2", "r2"].map(|name| {
            let its = (&quantity.replace("plane", name), suite, structure);
            let number = compared.iter().find(|row| (&row.quantity, &row.suite, &row.structure) == its);
            number.map_or(String::new(), both)
        });
        let side = if quantity == "low_plane" { "below" } else { "above" };
        [suite.clone(), structure.clone(), side.to_string(), ln_a, b1, b2, r2]
    })
}

/// A number as published, of this run, and how far they are apart.
fn both(row: &Comparison) -> String {
    let [published, ours] =
        [row.published, row.ours].map(|value| value.map_or("-".to_string(), |value| fixed(value, 2)));
    let z = row.z.map_or(String::new(), |z| format!(" ({z:+.1})"));
    format!("{published} / {ours}{z}")
}
