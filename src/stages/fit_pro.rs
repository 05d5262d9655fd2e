//! fit-pro: fragility curves of overturning, or of rocking, by maximum likelihood.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::groups::{self, Group};
use crate::fragility::{Case, EventSample, Measure, fit_overturning};
use crate::keyword::{self, Keyword, keywords};
use crate::pipeline::console::Console;
use crate::pipeline::options::{Several, Word, defaults};
use crate::pipeline::stage::Stage;
use crate::rocking::Outcome;
use crate::table::pro::{self, ProRow};
use crate::table::provenance::Provenance;
use crate::table::schema::PRO;
use crate::table::writer::TableWriter;

/// Which curves.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct FitProOptions {
    /// What the probability is of: overturning (given rocking), or rocking (of all motions)
    #[arg(long, default_value = "overturning")]
    pub event: Word<FittedEvent>,
    /// Pairs of measures that make hybrid ones, besides the six scalar measures
    #[arg(long, default_value = "im4:im3_inv")]
    pub pairs: Several<Pair>,
}

impl Default for FitProOptions {
    fn default() -> Self {
        defaults()
    }
}

/// What a fragility curve is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FittedEvent {
    /// Overturning given rocking: P_ro.
    Overturning,
    /// Rocking: 1 - P_nr.
    Rocking,
}

keywords!(FittedEvent { Overturning = "overturning", Rocking = "rocking" });

impl FittedEvent {
    /// Whether it happened in a case; none if the case does not count.
    fn happened(self, case: &Case) -> Option<bool> {
        match (self, case.outcome) {
            (FittedEvent::Overturning, Outcome::NoRocking) => None,
            (FittedEvent::Overturning, outcome) => Some(outcome == Outcome::Overturning),
            (FittedEvent::Rocking, outcome) => Some(outcome != Outcome::NoRocking),
        }
    }
}

/// Two measures that make a hybrid one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pair(pub Measure, pub Measure);

impl FromStr for Pair {
    type Err = String;

    fn from_str(text: &str) -> Result<Pair, String> {
        let (x, y) =
            text.split_once(':').ok_or_else(|| format!("'{text}': expected two measures as im4:im3_inv"))?;
        let measure = |name: &str| keyword::parse(name.trim()).map_err(|unknown| unknown.to_string());
        let pair = Pair(measure(x)?, measure(y)?);
        if pair.0 == pair.1 { Err(format!("'{text}': expected two different measures")) } else { Ok(pair) }
    }
}

impl fmt::Display for Pair {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}", self.0.as_str(), self.1.as_str())
    }
}

impl Serialize for Pair {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Pair {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Pair, D::Error> {
        crate::pipeline::options::from_scalar(deserializer)
    }
}

/// The stage, ready to run.
pub struct FitPro {
    options: FitProOptions,
    input: PathBuf,
    out: PathBuf,
}

impl FitPro {
    /// Of the responses in `input`, into the file `out`.
    pub fn new(options: &FitProOptions, input: PathBuf, out: PathBuf) -> FitPro {
        FitPro { options: options.clone(), input, out }
    }

    fn fits_of(&self, group: &Group) -> Vec<ProRow> {
        let event = self.options.event.0;
        let fit = |im_x: Measure, im_y: Option<Measure>| {
            let measures: Vec<Measure> = std::iter::once(im_x).chain(im_y).collect();
            let sample = EventSample::new(&group.cases, &measures, |case| event.happened(case));
            ProRow {
                suite: group.suite.clone(),
                structure: group.structure.clone(),
                eta: group.eta,
                event: event.as_str(),
                im_x,
                im_y,
                n: sample.happened.len(),
                events: sample.events(),
                fit: fit_overturning(&sample),
            }
        };
        let scalar = Measure::SCALAR.into_iter().map(|measure| fit(measure, None));
        scalar.chain(self.options.pairs.0.iter().map(|&Pair(x, y)| fit(x, Some(y)))).collect()
    }
}

impl Stage for FitPro {
    fn subcommand(&self) -> &'static str {
        PRO.stage
    }

    fn inputs(&self) -> Vec<(&'static str, PathBuf)> {
        vec![("responses", self.input.clone())]
    }

    fn outputs(&self) -> Vec<PathBuf> {
        vec![self.out.clone()]
    }

    fn parameters(&self) -> Value {
        json!(self.options)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let groups = groups::read(&self.input)?;
        let rows: Vec<Vec<ProRow>> = groups.par_iter().map(|group| self.fits_of(group)).collect();
        let rows = rows.concat();
        let missing = rows.iter().filter(|row| row.fit.is_err());
        console.warn_each(missing.map(|row| (row.reason(), row.measures())));
        let mut writer = TableWriter::create(&self.out, &PRO, provenance.clone())?;
        writer.append(&pro::batch(&rows)?)?;
        writer.finish()?;
        Ok(format!("{} of {} curves ok", rows.iter().filter(|row| row.fit.is_ok()).count(), rows.len()))
    }
}
