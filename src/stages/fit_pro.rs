//! fit-pro: fragility curves of overturning, or of rocking, by maximum likelihood.

use std::fmt;
use std::str::FromStr;

use clap::Args;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::groups::{self, Group};
use super::pro_group::ProModel;
use super::uncertainty::Uncertainty;
use crate::fragility::{Case, CurveModel, Measure};
use crate::keyword::{self, Keyword, keywords};
use crate::pipeline::console::Console;
use crate::pipeline::options::{Several, Word, defaults};
use crate::pipeline::stage::Stage;
use crate::rocking::Outcome;
use crate::statistics::{Estimator, FitStatus, Link};
use crate::table::pro::{self, ProRow};
use crate::table::provenance::Provenance;
use crate::table::replicates;
use crate::table::schema::{PRO, PRO_BOOTSTRAP};
use crate::table::source::{Source, Target};
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
    /// How the index becomes a probability: probit (lognormal curve), logit or cloglog
    #[arg(long, default_value = "probit")]
    pub link: Word<Link>,
    /// What is maximised: ml (the likelihood), or firth (penalised, for few events or separation)
    #[arg(long, default_value = "ml")]
    pub estimator: Word<Estimator>,
    /// Resamples for bootstrap limits, drawn within each cell of magnitude and distance
    #[arg(long, default_value = "0", value_name = "N")]
    pub bootstrap: usize,
    /// Probability with which limits of confidence hold the truth
    #[arg(long, default_value = "0.95")]
    pub confidence: f64,
    /// Seed of the resamples [default: 42]
    #[arg(long)]
    pub seed: Option<u64>,
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
    pub fn happened(self, case: &Case) -> Option<bool> {
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
    model: ProModel,
    input: Source,
    out: Target,
}

impl FitPro {
    /// Of the responses in `input`, into `out`.
    ///
    /// # Errors
    /// If an option is out of range.
    pub fn new(
        options: &FitProOptions,
        input: impl Into<Source>,
        out: impl Into<Target>,
    ) -> anyhow::Result<FitPro> {
        let uncertainty = Uncertainty::new(options.bootstrap, options.confidence, options.seed)?;
        let curve = CurveModel {
            link: options.link.0,
            estimator: options.estimator.0,
            confidence: uncertainty.confidence,
        };
        let model = ProModel { event: options.event.0, pairs: options.pairs.0.clone(), curve, uncertainty };
        let options = FitProOptions { seed: Some(uncertainty.seed), ..options.clone() };
        Ok(FitPro { options, model, input: input.into(), out: out.into() })
    }

    fn bootstrap_target(&self) -> Option<Target> {
        (self.options.bootstrap > 0).then(|| self.out.part("bootstrap"))
    }
}

impl Stage for FitPro {
    fn subcommand(&self) -> &'static str {
        PRO.stage
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("responses", self.input.clone())]
    }

    fn targets(&self) -> Vec<Target> {
        self.bootstrap_target().into_iter().chain([self.out.clone()]).collect()
    }

    fn parameters(&self) -> Value {
        json!(self.options)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let groups = groups::read(&self.input)?;
        let bar = console.bar(self.subcommand(), groups.len() as u64 * self.model.uncertainty.steps());
        let fit = |groups: &&[Group]| self.model.fit(groups, &bar);
        let rows: Vec<Vec<ProRow>> =
            groups::alike(&groups).par_iter().map(fit).collect::<anyhow::Result<_>>()?;
        bar.finish();
        let rows = rows.concat();
        let missing = rows.iter().filter(|row| row.status() != FitStatus::Ok);
        console.warn_each(missing.map(|row| (row.reason(), row.measures())));
        let few = rows.iter().filter(|row| row.has_few_events());
        console.warn_each(few.map(|row| (row.few_events(), row.measures())));
        if let Some(target) = self.bootstrap_target() {
            let mut writer = TableWriter::create(target, &PRO_BOOTSTRAP, provenance.clone())?;
            rows.iter().try_for_each(|row| anyhow::Ok(writer.append(&replicates::pro_batch(row)?)?))?;
            writer.finish()?;
        }
        let mut writer = TableWriter::create(self.out.clone(), &PRO, provenance.clone())?;
        writer.append(&pro::batch(&rows)?)?;
        writer.finish()?;
        Ok(format!(
            "{} of {} curves ok",
            rows.iter().filter(|row| row.status() == FitStatus::Ok).count(),
            rows.len()
        ))
    }
}
