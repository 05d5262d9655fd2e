//! rank-ims: which intensity measures predict best, alone, in pairs and in triples.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::Args;
use polars::prelude::SortMultipleOptions;
use serde::Serialize;

use super::shared::responses::{self, Candidate, Candidates};
use crate::motion::Dimension;
use crate::number::listed;
use crate::paper;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::paths::{Input, Output, Read};
use crate::pipeline::{Stage, UsageError};
use crate::rocking::Structure;
use crate::studies::{RankedSet, RankingRules, Target, rank_measures};
use crate::table::file::Table;
use crate::table::frame;
use crate::table::rows;

/// Measures of a motions file besides the peaks and periods of Eq. 13.
const FURTHER: [&str; 6] = ["pgd_m", "arias_m_s", "cav_m_s", "d5_75_s", "d5_95_s", "housner_m"];
/// The units at the end of the names of columns, the longer ones first.
const UNITS: [(&str, Dimension); 4] = [
    ("_m_s2", Dimension::Acceleration),
    ("_m_s", Dimension::Velocity),
    ("_m", Dimension::Length),
    ("_s", Dimension::Duration),
];
/// Sets that are printed of each target.
const SHOWN: i64 = 5;

/// Rank intensity measures, singly and in sets, by how well they predict held-out cells or earthquakes
#[derive(Debug, Args, Serialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag rank-ims --in responses.parquet --terms 1 --out ranking.parquet\n\
    rockfrag rank-ims --motions motions.parquet --candidate energy_m")]
pub struct RankIms {
    /// Responses to read
    #[arg(long = "in", id = "in", value_name = "FILE", default_value = "responses.parquet")]
    input: Input,
    /// Ranking to write
    #[arg(long, value_name = "FILE", default_value = "ranking.parquet")]
    out: Output,
    /// Motions of these responses, whose measures are made dimensionless with p and g tan alpha
    #[arg(long, value_name = "FILE")]
    motions: Option<Input>,
    /// Further columns of --motions, with their unit at the end of the name (_m_s2, _m_s, _m, _s)
    #[arg(long, value_name = "COLUMN", value_delimiter = ',', requires = "motions")]
    candidate: Vec<String>,
    /// Largest set of measures
    #[arg(long, value_name = "N", default_value = "2", value_parser = number(1..=3_usize, "1, 2 or 3"))]
    terms: usize,
    /// Number of folds
    #[arg(long, value_name = "N", default_value = "10", value_parser = number(2..=1000_usize, "2 to 1000"))]
    folds: usize,
    /// IM4 at which the two planes of demands meet
    #[arg(long, value_name = "IM4", default_value_t = paper::TRANSITION,
          value_parser = number(1.0..=10.0, "an IM4 from 1 to 10"))]
    transition: f64,
}

impl Stage for RankIms {
    fn inputs(&self) -> Vec<Read> {
        vec![Read::new("in", [&*self.input]), Read::new("motions", self.motions.iter().map(|path| &**path))]
    }

    fn outputs(&self) -> Vec<PathBuf> {
        vec![self.out.to_path_buf()]
    }

    fn check(&self) -> anyhow::Result<()> {
        match self.candidate.iter().find(|name| quantity(name).is_none()) {
            Some(name) => {
                let problem = "expected a unit at its end: _m_s2, _m_s, _m or _s";
                Err(UsageError::because(format!("candidate {name}: {problem}")))
            }
            None => Ok(()),
        }
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let further = match &self.motions {
            Some(path) => Further::read(path, &self.candidate)?,
            None => Further::default(),
        };
        let candidates: Candidates = &|motions, structure| further.candidates(motions, structure);
        let groups = responses::read_with(&self.input, self.motions.is_some().then_some(candidates))?;
        let rules = RankingRules { terms: self.terms, folds: self.folds, transition: self.transition };
        let bar = context.bar(2 * groups.len());
        let (mut sets, mut incomplete) = (Vec::new(), BTreeMap::new());
        for cases in &groups {
            for target in [Target::Demand, Target::Overturning] {
                let ranking = rank_measures(cases, target, &rules);
                sets.extend(ranking.sets);
                for (name, missing) in ranking.incomplete {
                    *incomplete.entry(name).or_default() += missing;
                }
                bar.advance(1)?;
            }
        }
        let summary = best(&sets)? + &not_ranked(&incomplete);
        context.write(&self.out, &sets, &summary)?;
        Ok(summary)
    }
}

/// The first sets of each suite, structure and target; those that make one model in a row.
fn best(sets: &[RankedSet]) -> anyhow::Result<String> {
    let mut shown: Vec<RankedSet> = Vec::new();
    for set in sets.iter().filter(|set| set.rank <= SHOWN) {
        match shown.last_mut().filter(|last| place(last) == place(set)) {
            Some(last) => last.measures += &format!(" = {}", set.measures),
            None => shown.push(set.clone()),
        }
    }
    let frame = frame::from_batch(&rows::batch(&shown)?)?;
    const COLUMNS: &str = "suite structure target rank measures form log_score loss loss_error aic status";
    let order = SortMultipleOptions::default().with_maintain_order(true);
    Ok(frame::text(&frame.select(COLUMNS.split(' '))?.sort(["suite", "structure", "target", "rank"], order)?))
}

fn place(set: &RankedSet) -> (&Option<String>, &str, Target, i64) {
    (&set.suite, &set.structure, set.target, set.rank)
}

/// A line on the measures that some cases lack.
fn not_ranked(incomplete: &BTreeMap<String, usize>) -> String {
    let measures: Vec<String> =
        incomplete.iter().map(|(name, missing)| format!("{name} (missing in {missing} cases)")).collect();
    if measures.is_empty() { String::new() } else { format!("not ranked: {}\n", measures.join(", ")) }
}

/// Further measures of motions.
#[derive(Default)]
struct Further {
    path: PathBuf,
    /// The columns, and what each measures.
    columns: Vec<(String, Dimension)>,
    /// The values of each motion, by its name.
    motions: HashMap<String, Vec<Option<f64>>>,
}

impl Further {
    fn read(path: &Path, candidates: &[String]) -> anyhow::Result<Further> {
        let table = Table::open(path)?;
        let names: Vec<&String> = table.schema().fields().iter().map(|field| field.name()).collect();
        if let Some(missing) = candidates.iter().find(|name| !names.contains(name)) {
            let (file, names) = (path.display(), listed(&names, usize::MAX));
            let problem = format!("{file}: no column '{missing}'; expected one of {names}");
            return Err(UsageError::because(problem));
        }
        let columns = names.into_iter().filter_map(|name| {
            let is_known = FURTHER.contains(&name.as_str()) || name.starts_with("sa_");
            let quantity = quantity(name).filter(|_| is_known || candidates.contains(name));
            Some((name.clone(), quantity?))
        });
        let columns: Vec<(String, Dimension)> = columns.collect();
        let mut motions = HashMap::new();
        for batch in table.batches(|name| name == "motion_id" || columns.iter().any(|(own, _)| own == name)) {
            let batch = batch?;
            let values = columns.iter().map(|(column, _)| batch.numbers(column));
            let values = values.collect::<Result<Vec<_>, _>>()?;
            for (row, id) in batch.required_texts("motion_id")?.into_iter().enumerate() {
                motions.insert(id.into_owned(), values.iter().map(|values| values[row]).collect());
            }
        }
        Ok(Further { path: path.to_path_buf(), columns, motions })
    }

    /// The measures of motions, made dimensionless for a structure, by their names without units.
    fn candidates(&self, motions: &[&str], structure: &Structure) -> anyhow::Result<Vec<Candidate>> {
        let motions = motions.iter().map(|motion| {
            self.motions.get(*motion).with_context(|| {
                let file = self.path.display();
                format!("{file}: no motion '{motion}'; expected the motions of the responses")
            })
        });
        let motions = motions.collect::<anyhow::Result<Vec<_>>>()?;
        let mut candidates = Vec::new();
        for (place, (column, quantity)) in self.columns.iter().enumerate() {
            // A measure that no motion has does not compete.
            if self.motions.values().any(|values| values[place].is_some()) {
                let name = UNITS.iter().find_map(|(unit, _)| column.strip_suffix(unit)).unwrap_or(column);
                let values =
                    motions.iter().map(|values| Some(quantity.dimensionless(values[place]?, structure)));
                candidates.push((name.to_string(), values.collect()));
            }
        }
        Ok(candidates)
    }
}

/// What a column measures, by the unit at its end.
fn quantity(name: &str) -> Option<Dimension> {
    if name == "arias_m_s" {
        return Some(Dimension::AriasIntensity);
    }
    UNITS.iter().find(|(unit, _)| name.ends_with(unit)).map(|(_, quantity)| *quantity)
}
