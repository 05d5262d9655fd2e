//! fit-pex: regressions of the demand in safe rocking.

use std::str::FromStr;

use clap::Args;
use rayon::prelude::*;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Value, json};

use super::groups::{self, Group};
use super::pex_group::{PexModel, Regressions};
use super::uncertainty::Uncertainty;
use crate::keyword::Keyword;
use crate::pipeline::console::Console;
use crate::pipeline::options::{check, defaults, from_scalar};
use crate::pipeline::stage::Stage;
use crate::statistics::FitStatus;
use crate::table::provenance::Provenance;
use crate::table::schema::{PEX, PEX_BOOTSTRAP, PEX_SCAN};
use crate::table::source::{Source, Target};
use crate::table::writer::TableWriter;
use crate::table::{pex, pex_scan, replicates};

/// How the demand is fitted.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct FitPexOptions {
    /// Demand |theta|max / alpha whose exceedance P_ex is about
    #[arg(long, default_value = "0.10")]
    pub limit_state: f64,
    /// IM4 at which the two planes meet: found (least pooled residual), or a number
    #[arg(long, default_value = "found")]
    pub transition: TransitionAt,
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

impl Default for FitPexOptions {
    fn default() -> Self {
        defaults()
    }
}

/// Where the two planes meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TransitionAt {
    /// Where their pooled residual is least.
    Found,
    /// At this IM4.
    Fixed(f64),
}

impl TransitionAt {
    /// The IM4 that is fixed, if one is.
    pub fn im4(self) -> Option<f64> {
        match self {
            TransitionAt::Found => None,
            TransitionAt::Fixed(im4) => Some(im4),
        }
    }
}

impl FromStr for TransitionAt {
    type Err = String;

    fn from_str(text: &str) -> Result<TransitionAt, String> {
        match (text, text.parse()) {
            ("found", _) => Ok(TransitionAt::Found),
            (_, Ok(im4)) if im4 > 1.0 && im4 < 100.0 => Ok(TransitionAt::Fixed(im4)),
            _ => Err(format!("'{text}': expected 'found' or an IM4 above 1")),
        }
    }
}

impl Serialize for TransitionAt {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            TransitionAt::Found => serializer.serialize_str("found"),
            TransitionAt::Fixed(im4) => serializer.serialize_f64(*im4),
        }
    }
}

impl<'de> Deserialize<'de> for TransitionAt {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<TransitionAt, D::Error> {
        from_scalar(deserializer)
    }
}

/// The stage, ready to run.
pub struct FitPex {
    options: FitPexOptions,
    model: PexModel,
    input: Source,
    out: Target,
}

impl FitPex {
    /// Of the responses in `input`, into `out`.
    ///
    /// # Errors
    /// If an option is out of range.
    pub fn new(
        options: &FitPexOptions,
        input: impl Into<Source>,
        out: impl Into<Target>,
    ) -> anyhow::Result<FitPex> {
        let limit = options.limit_state;
        check(limit > 0.0 && limit.is_finite(), "limit-state", limit, "a demand |theta|max / alpha above 0")?;
        let transition = options.transition.im4();
        let uncertainty = Uncertainty::new(options.bootstrap, options.confidence, options.seed)?;
        let options = FitPexOptions { seed: Some(uncertainty.seed), ..options.clone() };
        let model = PexModel { limit_state: limit, transition, uncertainty };
        Ok(FitPex { options, model, input: input.into(), out: out.into() })
    }

    fn scan_target(&self) -> Target {
        self.out.part("scan")
    }

    fn bootstrap_target(&self) -> Option<Target> {
        (self.options.bootstrap > 0).then(|| self.out.part("bootstrap"))
    }
}

impl Stage for FitPex {
    fn subcommand(&self) -> &'static str {
        PEX.stage
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("responses", self.input.clone())]
    }

    fn targets(&self) -> Vec<Target> {
        [self.scan_target()].into_iter().chain(self.bootstrap_target()).chain([self.out.clone()]).collect()
    }

    fn parameters(&self) -> Value {
        json!(self.options)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let groups = groups::read(&self.input)?;
        let bar = console.bar(self.subcommand(), groups.len() as u64 * self.model.uncertainty.steps());
        let fit = |groups: &&[Group]| self.model.fit(groups, &bar);
        let fitted = groups::alike(&groups).par_iter().map(fit).collect::<anyhow::Result<Vec<_>>>()?;
        bar.finish();
        let fitted = fitted.into_iter().flatten().map(|Regressions { rows, scan }| (rows, scan));
        let (rows, scans): (Vec<_>, Vec<_>) = fitted.unzip();
        let (rows, scans) = (rows.concat(), scans.concat());
        let missing = rows.iter().filter(|row| row.status() != FitStatus::Ok);
        console.warn_each(missing.map(|row| (row.reason(), row.measures())));
        let mut scan_writer = TableWriter::create(self.scan_target(), &PEX_SCAN, provenance.clone())?;
        scan_writer.append(&pex_scan::batch(&scans)?)?;
        scan_writer.finish()?;
        if let Some(target) = self.bootstrap_target() {
            let mut writer = TableWriter::create(target, &PEX_BOOTSTRAP, provenance.clone())?;
            rows.iter().try_for_each(|row| anyhow::Ok(writer.append(&replicates::pex_batch(row)?)?))?;
            writer.finish()?;
        }
        let mut writer = TableWriter::create(self.out.clone(), &PEX, provenance.clone())?;
        writer.append(&pex::batch(&rows)?)?;
        writer.finish()?;
        let fitted = rows.iter().filter(|row| row.status() == FitStatus::Ok).count();
        let status = FitStatus::Ok.as_str();
        Ok(format!("{fitted} of {} fits {status}", rows.len()))
    }
}
