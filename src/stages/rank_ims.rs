//! rank-ims: which intensity measures predict best, alone, in pairs and in triples.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use clap::{Args, ValueHint};
use polars::prelude::SortMultipleOptions;

use super::shared::responses;
use crate::motion::Dimension;
use crate::paper;
use crate::pipeline::UsageError;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::stage::Stage;
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
const SHOWN: usize = 5;

/// Rank intensity measures, alone, in pairs and triples, by how well they predict cells or earthquakes
/// left out
#[derive(Debug, Args)]
pub struct RankIms {
    /// Responses to read
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = ValueHint::FilePath, default_value = "responses.parquet")]
    input: PathBuf,
    /// Ranking to write
    #[arg(long, value_name = "FILE", value_hint = ValueHint::AnyPath, default_value = "ranking.parquet")]
    out: PathBuf,
    /// Motions of these responses, whose measures are made dimensionless with p and g tan alpha
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    motions: Option<PathBuf>,
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
    #[arg(long, value_name = "IM4", default_value_t = paper::TRANSITION, value_parser = number(1.0..=10.0, "an IM4 from 1 to 10"))]
    transition: f64,
}

impl Stage for RankIms {
    fn outputs(&self) -> Vec<PathBuf> {
        vec![self.out.clone()]
    }

    fn check(&self) -> anyhow::Result<()> {
        match self.candidate.iter().find(|name| quantity(name).is_none()) {
            Some(name) => Err(UsageError::because(format!(
                "candidate {name}: expected a unit at its end: _m_s2, _m_s, _m or _s"
            ))),
            None => Ok(()),
        }
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let further = match &self.motions {
            Some(path) => Further::read(path, &self.candidate)?,
            None => Further::default(),
        };
        let groups = responses::read_with(&self.input, &further.names(), |motion, structure| {
            further.of(motion, structure)
        })?;
        let rules = RankingRules { terms: self.terms, folds: self.folds, transition: self.transition };
        let bar = context.bar(2 * groups.len() as u64);
        let mut sets: Vec<RankedSet> = Vec::new();
        for cases in &groups {
            for target in [Target::Demand, Target::Overturning] {
                sets.extend(rank_measures(cases, target, &rules).sets);
                bar.advance(1)?;
            }
        }
        let summary = best(&sets)?;
        context.write(&self.out, &sets, &summary)?;
        Ok(summary)
    }
}

/// The first sets of each suite, structure and target.
fn best(sets: &[RankedSet]) -> anyhow::Result<String> {
    let frame = frame::of_batch(&rows::batch(sets)?)?;
    let is_shown = frame
        .column("rank")?
        .i64()?
        .iter()
        .map(|rank| rank.is_some_and(|rank| rank <= SHOWN as i64))
        .collect();
    let columns = [
        "suite",
        "structure",
        "target",
        "rank",
        "measures",
        "form",
        "log_score",
        "loss",
        "loss_error",
        "aic",
        "status",
    ];
    let order = SortMultipleOptions::default().with_maintain_order(true);
    let shown =
        frame.filter(&is_shown)?.select(columns)?.sort(["suite", "structure", "target", "rank"], order)?;
    Ok(frame::text(&shown))
}

/// Further measures of motions.
#[derive(Default)]
struct Further {
    columns: Vec<(String, Dimension)>,
    values: HashMap<String, Vec<f64>>,
    path: PathBuf,
}

impl Further {
    fn read(path: &Path, candidates: &[String]) -> anyhow::Result<Further> {
        let table = Table::open(path)?;
        let names: Vec<&str> = table.schema().fields().iter().map(|field| field.name().as_str()).collect();
        if let Some(missing) = candidates.iter().find(|name| !names.contains(&name.as_str())) {
            let file = path.display();
            return Err(UsageError::because(format!(
                "{file}: no column '{missing}'; expected one of {}",
                names.join(", ")
            )));
        }
        let is_wanted = |name: &&&str| {
            FURTHER.contains(*name)
                || name.starts_with("sa_")
                || candidates.iter().any(|other| other == **name)
        };
        let columns: Vec<(String, Dimension)> = names
            .iter()
            .filter(is_wanted)
            .filter_map(|name| Some((name.to_string(), quantity(name)?)))
            .collect();
        let mut values = HashMap::new();
        for batch in
            table.batches(&|name| name == "motion_id" || columns.iter().any(|(column, _)| column == name))
        {
            let batch = batch?;
            let all = batch.columns();
            let of_columns =
                columns.iter().map(|(name, _)| all.numbers(name)).collect::<Result<Vec<_>, _>>()?;
            for (row, id) in all.required_texts("motion_id")?.into_iter().enumerate() {
                values.insert(id, of_columns.iter().map(|column| column[row]).collect());
            }
        }
        // A measure that no motion has does not compete.
        let has_any = |place: &usize| values.values().any(|values: &Vec<f64>| !values[*place].is_nan());
        let kept: Vec<usize> = (0..columns.len()).filter(has_any).collect();
        values.values_mut().for_each(|values| *values = kept.iter().map(|&place| values[place]).collect());
        let columns = kept.iter().map(|&place| columns[place].clone()).collect();
        Ok(Further { columns, values, path: path.to_path_buf() })
    }

    /// The names of the measures, without units.
    fn names(&self) -> Vec<String> {
        let plain = |name: &String| {
            UNITS.iter().find_map(|(unit, _)| name.strip_suffix(unit)).unwrap_or(name).to_string()
        };
        self.columns.iter().map(|(name, _)| plain(name)).collect()
    }

    /// The measures of a motion, made dimensionless for a structure.
    fn of(&self, motion: &str, structure: &Structure) -> anyhow::Result<Vec<f64>> {
        if self.columns.is_empty() {
            return Ok(Vec::new());
        }
        let values = self.values.get(motion).ok_or_else(|| {
            anyhow::anyhow!(
                "{}: no motion '{motion}'; expected the motions of the responses",
                self.path.display()
            )
        })?;
        let pairs = values.iter().zip(&self.columns);
        Ok(pairs.map(|(value, (_, quantity))| quantity.dimensionless(*value, structure)).collect())
    }
}

/// What a column measures, by the unit at its end.
fn quantity(name: &str) -> Option<Dimension> {
    if name == "arias_m_s" {
        return Some(Dimension::AriasIntensity);
    }
    UNITS.iter().find(|(unit, _)| name.ends_with(unit)).map(|(_, quantity)| *quantity)
}
