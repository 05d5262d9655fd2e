//! compare-paper: each published number beside ours over seeds, and beside that of this run.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::fragility::{CurveFit, DemandFit};
use rockfrag_core::paper::{self, OTHER_ALPHA};
use rockfrag_core::rocking::Structure;
use rockfrag_core::studies::comparison::{Comparison, compare, verdict};
use serde::{Deserialize, Serialize};

use super::default_options;
use crate::number::{aligned, fixed, significant};
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::paths::{Files, Read};
use crate::table::frame;
use crate::table::provenance::{Provenance, text_of};
use crate::table::rows;

/// Compare what the paper publishes with twenty seeds of its set-up, and with the fits of this run
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag compare-paper\n\
    rockfrag compare-paper --pex fits/pex.parquet --pro fits/pro.parquet --out paper.parquet")]
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
}

impl Stage for ComparePaper {
    fn files(&self) -> Files {
        Files::tables([Read::new("pex", [&self.pex]), Read::new("pro", [&self.pro])], [&self.out])
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let (demand, curves): (Vec<DemandFit>, Vec<CurveFit>) =
            (rows::read(&self.pex)?, rows::read(&self.pro)?);
        let mut compared = compare(&demand, &curves);
        let fits = [&self.pex, &self.pro].map(|path| Provenance::read(path).ok().flatten());
        let mut differences = other_structures(&demand);
        if let [Some(pex), Some(pro)] = &fits
            && pex.input("in") != pro.input("in")
        {
            differences.push("pex and pro are fits to different responses".to_string());
        }
        differences.extend(other_options(fits.into_iter().flatten()));
        // Our seeds are spread as those of the paper's scenarios are.
        if differences.iter().any(|difference| difference.starts_with(STAGES[0])) {
            compared.iter_mut().for_each(|row| row.ours_z = None);
        }
        let summary = format!("{}\n{}", verdict(&compared), of_this_run(&compared, &differences)?);
        context.write::<Comparison>(&self.out, &compared, &summary)?;
        Ok(summary)
    }
}

/// A number of the run this many standard deviations from the mean of the seeds is not one more of them.
const FAR: f64 = 3.0;

/// Whether this run is in the paper's set-up, how many of its numbers are not those of one more seed, and the
/// numbers.
fn of_this_run(compared: &[Comparison], differences: &[String]) -> anyhow::Result<String> {
    let set_up = match differences {
        [] => "This run is in the paper's set-up.".to_string(),
        [one] => format!("This run is not in the paper's set-up: {one}."),
        _ => format!("This run is not in the paper's set-up:\n  {}.", differences.join("\n  ")),
    };
    if compared.iter().all(|row| row.ours.is_none()) {
        return Ok(format!("{set_up}\nIt has no fits that can be compared with the paper's."));
    }
    let z: Vec<f64> = compared.iter().filter_map(|row| row.ours_z).collect();
    let far = z.iter().filter(|z| z.abs() >= FAR).count();
    let count = match z.len() {
        0 => String::new(),
        numbers => format!("\n{FAR} or more standard deviations from the seeds: {far} of {numbers} numbers."),
    };
    let heads = ["suite", "structure", "plane", "ln a", "b1", "b2", "R2", "T2", "p"].map(str::to_string);
    let planes: Vec<_> = [heads].into_iter().chain(table_two(compared)).map(Vec::from).collect();
    let numbers = rows::batch(compared.iter().filter(|row| row.plane.is_none()))?;
    let columns = "quantity suite structure published mean z p ours ours_z".split(' ');
    Ok(format!(
        "{set_up}{count}\n\nplanes of Table II: published / mean of seeds / this run (its z from {FAR} on)\n\
         {}\nother numbers\n{}",
        aligned(&planes, |column| column > 2),
        frame::text(&frame::from_batch(&numbers)?.select(columns)?),
    ))
}

/// What the fits have in place of the paper's structures.
fn other_structures(demand: &[DemandFit]) -> Vec<String> {
    let difference = |structure: Structure| {
        let (name, papers) = (&structure.name, structure.parameters());
        if demand.iter().any(|fit| fit.structure.parameters() == papers) {
            return None;
        }
        let Some(named) = demand.iter().find(|fit| fit.structure.name == *name) else {
            return Some(format!("no fits of its {name}"));
        };
        let printed =
            |value: f64| if OTHER_ALPHA.contains(&value) { " (also printed in the paper)" } else { "" };
        let others = named.structure.parameters().into_iter().zip(papers).zip(["p", "alpha", "eta"]);
        let others = others
            .filter(|((value, papers), _)| value != papers)
            .map(|((value, papers), of)| format!("{of} {value}{}, not {papers}", printed(value)));
        Some(format!("{name}: {}", others.collect::<Vec<_>>().join("; ")))
    };
    paper::structures().into_iter().filter_map(difference).collect()
}

/// The stages of the paper, whose defaults are its set-up.
const STAGES: [&str; 5] = ["sample-scenarios", "synthesize-motions", "simulate", "fit-pex", "fit-pro"];
/// Options that do not change what is compared.
const NEUTRAL: &str = "all confidence housner in motions pairs partition sa seed structure structures trace";
/// Options that may have more than the paper's.
const LISTS: [&str; 2] = ["limit-state", "suite"];

/// What options of the fits, and of the stages before, are not the paper's.
fn other_options(fits: impl Iterator<Item = Provenance>) -> Vec<String> {
    let stated: Vec<(String, BTreeMap<String, String>)> = fits.flat_map(|made| made.all_stated()).collect();
    let mut differences = Vec::new();
    for stage in STAGES {
        let mut its = stated.iter().filter(|(name, _)| name == stage).map(|(_, stated)| stated).peekable();
        if its.peek().is_none() {
            differences.push(format!("no {stage}"));
        }
        let paper = default_options(stage);
        for stated in its {
            let flags: BTreeSet<&String> = stated.keys().chain(paper.keys()).collect();
            for flag in flags.into_iter().filter(|flag| NEUTRAL.split(' ').all(|neutral| neutral != *flag)) {
                let [now, then] = [stated.get(flag).cloned(), paper.get(flag).map(text_of)]
                    .map(|text| text.unwrap_or("none".into()))
                    .map(|text| text.replace(".0,", ",").trim_end_matches(".0").to_string());
                let has =
                    |one: &str| LISTS.contains(&flag.as_str()) && now.split(',').any(|other| other == one);
                let difference = format!("{stage} --{flag} {now}, not {then}");
                if now != then && !then.split(',').all(has) && !differences.contains(&difference) {
                    differences.push(difference);
                }
            }
        }
    }
    differences
}

/// The eight planes of Table II: suite, structure, side of the transition, ln a, b1, b2 and R2, each as
/// published, as the mean of the seeds, and of this run; T2 and p of the published plane.
pub fn table_two(compared: &[Comparison]) -> Vec<[String; 9]> {
    let group = |row: &Comparison| (row.suite.clone(), row.structure.clone(), row.plane.clone());
    let planes = compared.chunk_by(|a, b| group(a) == group(b)).filter_map(|rows| {
        let [ln_a, b1, b2, r2] = rows.iter().map(in_words).collect::<Vec<_>>().try_into().ok()?;
        let (suite, structure, plane) = group(&rows[0]);
        let [t2, p] = [rows[0].test.t2, rows[0].test.p].map(|number| significant(number, 2));
        Some([suite, structure, plane?, ln_a, b1, b2, r2, t2, p])
    });
    planes.collect()
}

fn in_words(row: &Comparison) -> String {
    let [published, mean] = [row.published, row.mean].map(|value| fixed(value, 2));
    let ours = row.ours.map_or("-".to_string(), |value| fixed(value, 2));
    let far = row.ours_z.filter(|z| z.abs() >= FAR).map_or(String::new(), |z| format!(" ({z:+.1})"));
    format!("{published} / {mean} / {ours}{far}")
}
