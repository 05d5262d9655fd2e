//! fit-pex: regressions of the demand in safe rocking.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use rayon::prelude::*;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Value, json};

use super::groups::{self, Group};
use crate::fragility::{FitStatus, LinearFit, Measure, fit_biplanar, fit_plane, fit_univariate};
use crate::keyword::Keyword;
use crate::pipeline::console::Console;
use crate::pipeline::options::{check, defaults, from_scalar};
use crate::pipeline::stage::{Stage, with_part};
use crate::table::pex::{self, Model, PexRow, ScanRow};
use crate::table::provenance::Provenance;
use crate::table::schema::{PEX, PEX_SCAN};
use crate::table::writer::TableWriter;

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
    input: PathBuf,
    out: PathBuf,
}

impl FitPex {
    /// Of the responses in `input`, into the file `out`.
    ///
    /// # Errors
    /// If an option is out of range.
    pub fn new(options: &FitPexOptions, input: PathBuf, out: PathBuf) -> anyhow::Result<FitPex> {
        let limit = options.limit_state;
        check(limit > 0.0 && limit.is_finite(), "limit-state", limit, "a demand |theta|max / alpha above 0")?;
        Ok(FitPex { options: options.clone(), input, out })
    }

    fn fits_of(&self, group: &Group) -> (Vec<PexRow>, Vec<ScanRow>) {
        let row = |model, im_y, range: std::ops::Range<f64>, fit: Result<LinearFit, FitStatus>| PexRow {
            suite: group.suite.clone(),
            structure: group.structure.clone(),
            eta: group.eta,
            model,
            im_x: Measure::Im4,
            im_y,
            range_low: Some(range.start),
            range_high: Some(range.end).filter(|end| end.is_finite()),
            limit_state: self.options.limit_state,
            r2_pooled: None,
            r2_overall: None,
            transition_found: None,
            fit,
        };
        let univariate = |&measure: &Measure| PexRow {
            im_x: measure,
            range_low: None,
            ..row(Model::Univariate, None, 0.0..f64::INFINITY, fit_univariate(&group.cases, measure))
        };
        let mut rows: Vec<PexRow> = Measure::SCALAR.iter().map(univariate).collect();
        let everywhere = 1.0..f64::INFINITY;
        let plane = fit_plane(&group.cases, everywhere.clone());
        rows.push(row(Model::Plane, Some(Measure::Im3), everywhere.clone(), plane));

        let fixed = match self.options.transition {
            TransitionAt::Found => None,
            TransitionAt::Fixed(im4) => Some(im4),
        };
        let biplanar = match fit_biplanar(&group.cases, fixed) {
            Ok(biplanar) => biplanar,
            Err(status) => {
                rows.push(row(Model::Biplanar, Some(Measure::Im3), everywhere, Err(status)));
                return (rows, Vec::new());
            }
        };
        let (at, found) = (biplanar.transition, biplanar.found);
        let (r2_pooled, r2_overall) = (biplanar.r2_pooled, biplanar.r2_overall);
        let pooled = |row| PexRow { r2_pooled, r2_overall, transition_found: found, ..row };
        rows.push(pooled(row(Model::Biplanar, Some(Measure::Im3), 1.0..at, biplanar.low)));
        rows.push(pooled(row(Model::Biplanar, Some(Measure::Im3), at..f64::INFINITY, biplanar.high)));
        let scan = biplanar.scan.into_iter().map(|point| ScanRow {
            suite: group.suite.clone(),
            structure: group.structure.clone(),
            point,
        });
        (rows, scan.collect())
    }

    fn scan_path(&self) -> PathBuf {
        with_part(&self.out, "scan")
    }
}

impl Stage for FitPex {
    fn subcommand(&self) -> &'static str {
        PEX.stage
    }

    fn inputs(&self) -> Vec<(&'static str, PathBuf)> {
        vec![("responses", self.input.clone())]
    }

    fn outputs(&self) -> Vec<PathBuf> {
        vec![self.scan_path(), self.out.clone()]
    }

    fn parameters(&self) -> Value {
        json!(self.options)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let groups = groups::read(&self.input)?;
        let (rows, scans): (Vec<_>, Vec<_>) = groups.par_iter().map(|group| self.fits_of(group)).unzip();
        let (rows, scans) = (rows.concat(), scans.concat());
        let missing = rows.iter().filter(|row| row.fit.is_err());
        console.warn_each(missing.map(|row| (row.reason(), row.measures())));
        let mut scan_writer = TableWriter::create(&self.scan_path(), &PEX_SCAN, provenance.clone())?;
        scan_writer.append(&pex::scan_batch(&scans)?)?;
        scan_writer.finish()?;
        let mut writer = TableWriter::create(&self.out, &PEX, provenance.clone())?;
        writer.append(&pex::batch(&rows)?)?;
        writer.finish()?;
        let fitted = rows.iter().filter(|row| row.fit.is_ok()).count();
        let status = FitStatus::Ok.as_str();
        Ok(format!("{fitted} of {} fits {status}", rows.len()))
    }
}
