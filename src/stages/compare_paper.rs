//! compare-paper: each published number beside ours.

use std::path::PathBuf;

use clap::{Args, ValueHint};
use serde::{Deserialize, Serialize};

use crate::fragility::{Kind, Model, Scenarios};
use crate::paper;
use crate::pipeline::context::Context;
use crate::pipeline::stage::Stage;
use crate::studies::paper::{Comparison, compare};
use crate::table::frame::{self, Format};
use crate::table::rows;

/// Compare fits of the paper's set-up with the numbers that the paper publishes
#[derive(Debug, Args)]
pub struct ComparePaper {
    /// Fits of fit-pex
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, default_value = "pex.parquet")]
    pex: PathBuf,
    /// Fits of fit-pro
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, default_value = "pro.parquet")]
    pro: PathBuf,
    /// Comparison to write
    #[arg(long, value_name = "FILE", value_hint = ValueHint::AnyPath, default_value = "paper.parquet")]
    out: PathBuf,
    /// Print every number, not only the planes of Table II and the worked example
    #[arg(long)]
    all: bool,
}

impl Stage for ComparePaper {
    fn outputs(&self) -> Vec<PathBuf> {
        vec![self.out.clone()]
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let compared = compare(&rows::read(&self.pex)?, &rows::read(&self.pro)?);
        let summary = match self.all {
            true => frame::show(&frame::of_batch(&rows::batch(&compared)?)?, Format::Text)?,
            false => summary(&compared)?,
        };
        context.write::<Comparison>(&self.out, &compared, &summary)?;
        Ok(summary)
    }
}

/// One of the eight planes of Table II: z of each of its numbers over our seeds, and the probability that all
/// four are one more draw of ours.
#[derive(Serialize, Deserialize)]
struct PlaneLine {
    plane: String,
    z_ln_a: Option<String>,
    z_b1: Option<String>,
    z_b2: Option<String>,
    z_r2: Option<String>,
    p: Option<String>,
}

/// Within so many standard deviations of ours a published number agrees.
const AGREES: f64 = 2.0;

/// The eight planes, the worked example, how many numbers agree, and what the surface predicts in their
/// place.
fn summary(compared: &[Comparison]) -> anyhow::Result<String> {
    let planes = compared.iter().filter_map(|row| Some((row, row.quantity.strip_suffix("_plane")?)));
    let line = |(of, side): (&Comparison, &str)| {
        let z = |name: &str| {
            let quantity = format!("{side}_{name}");
            let is_it = |row: &&Comparison| {
                (&row.quantity, &row.suite, &row.structure) == (&quantity, &of.suite, &of.structure)
            };
            let z = compared.iter().find(is_it)?.z?;
            Some(format!("{z:+.1}"))
        };
        PlaneLine {
            plane: format!("{}, {}, {side}", of.suite, of.structure),
            z_ln_a: z("ln_a"),
            z_b1: z("b1"),
            z_b2: z("b2"),
            z_r2: z("r2"),
            p: of.t2_p.map(|p| if p < 0.001 { format!("{p:.0e}") } else { format!("{p:.2}") }),
        }
    };
    let planes: Vec<PlaneLine> = planes.map(line).collect();
    let known: Vec<&Comparison> =
        compared.iter().filter(|row| row.sd.is_some() && row.published.is_some()).collect();
    let agree = known.iter().filter(|row| row.z.is_none_or(|z| z.abs() < AGREES)).count();
    let example = |row: &&Comparison| row.quantity == "example_p_ro";
    let example: Vec<String> = compared
        .iter()
        .filter(example)
        .map(|row| {
            let number = |value: Option<f64>| value.map_or("none".to_string(), |value| format!("{value:.2}"));
            format!("{} {} ({} here)", row.structure, number(row.published), number(row.ours))
        })
        .collect();
    let surface = paper::structures().into_iter().filter_map(|structure| {
        let model = Model::shipped(Kind::Csgm, &structure, paper::LIMIT_STATE);
        let given =
            model.probabilities(&structure, &paper::example(&structure), None, Scenarios::One).given_rocking?;
        let p = given.p_ro;
        Some(format!("{} {:.2} ({:.2} to {:.2})", structure.name, p.value, p.low, p.high))
    });
    Ok(format!(
        "{agree} of {} published numbers are within two standard deviations of ours over seeds\n{}\
         worked example, P_ro published: {}\nworked example, by the universal surface: {}\n",
        known.len(),
        frame::text(&frame::of_batch(&rows::batch(&planes)?)?),
        example.join(", "),
        surface.collect::<Vec<_>>().join(", ")
    ))
}
