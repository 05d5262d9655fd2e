use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::Args;
use serde::{Deserialize, Serialize};

use super::inputs::Reading;
use crate::keyword::{self, Keyword};
use crate::pipeline::UsageError;
use crate::pipeline::declare::StageOptions;
use crate::pipeline::options::{Parsed, Steps, Word, check, defaults};
use crate::records::processing::{Implausible, Processing, PulseSearch};
use crate::records::rotation::Direction;
use crate::records::signal::{Baseline, HighPass, Scaling};
use crate::records::{AccelerationUnit, ColumnChoice, Format, Given};
use crate::stages::shared::measures::measure_plan;
use crate::units::G_M_S2;

/// Which records, and how they are read.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct ImportMotionsOptions {
    /// Files and folders of records, with all that is in the folders
    #[arg(value_name = "FILE|DIR")]
    pub files: Vec<PathBuf>,
    /// Format of text files: auto (by content), at2, cosmos, csmip, esm, knet, smc, or columns (plain numbers)
    #[arg(long, default_value = "auto")]
    pub format: Parsed<FormatChoice>,
    /// Time between samples, s, for files that do not state it, or only to few decimals; one that states another is refused
    #[arg(long, value_name = "S")]
    pub dt: Option<f64>,
    /// Unit of the acceleration, for files that do not state it: g, mg, m/s2, cm/s2 (gal), mm/s2, %g, ft/s2 or in/s2. A file that
    /// states another is refused
    #[arg(long)]
    pub unit: Option<Parsed<AccelerationUnit>>,
    /// Column of the acceleration in plain files: its number, its name, or all where one series wraps over lines [default: the one
    /// with that heading, or the only one besides times]
    #[arg(long, value_name = "N|NAME|all")]
    pub column: Option<Parsed<ColumnChoice>>,
    /// How far the peak of the samples may be from the peak in the header, as a share of it, besides rounding
    #[arg(long, default_value = "0.05", value_name = "SHARE")]
    pub pga_tolerance: f64,
    /// What to remove from the acceleration: none, mean, or linear (the line of least squares)
    #[arg(long, default_value = "none")]
    pub baseline: Word<Baseline>,
    /// Corner of a zero-phase Butterworth high-pass of order 4, Hz [default: none]
    #[arg(long, value_name = "HZ")]
    pub high_pass: Option<f64>,
    /// Resample to this time step, s, band-limited [default: as in the file]
    #[arg(long, value_name = "S")]
    pub resample: Option<f64>,
    /// Rotate each pair of horizontal components of one earthquake and station into one motion, towards an azimuth (degrees) or the
    /// strongest-pulse, and add RotD50 and RotD100 of PGA and PGV. Motions without a partner are left out
    #[arg(long, value_name = "AZIMUTH|strongest-pulse")]
    pub rotate: Option<Parsed<Direction>>,
    /// Scale by these factors, separated by commas or first:last:step; each makes a motion of each record
    #[arg(long, value_name = "F,...", conflicts_with_all = ["scale_pga", "scale_pgv"])]
    pub scale: Option<Steps>,
    /// Scale each motion to this PGA, g
    #[arg(long, value_name = "G", conflicts_with = "scale_pgv")]
    pub scale_pga: Option<f64>,
    /// Scale each motion to this PGV, m/s
    #[arg(long, value_name = "M/S")]
    pub scale_pgv: Option<f64>,
    /// Whether to look for velocity pulses: find (indicator of Baker 2007, then a fit of Eq. 1 for tp_s), or skip
    #[arg(long, default_value = "find")]
    pub pulses: Word<PulseSearch>,
    /// Also write each motion with a pulse without that pulse, as suite residual
    #[arg(long)]
    pub residual: bool,
    /// Add spectral accelerations (5 % damping) at these periods, s: first:last:step, or numbers separated by commas; the column
    /// sa_0p20_m_s2 is for 0.2 s
    #[arg(long, value_name = "S,...")]
    pub sa: Option<Steps>,
    /// Also compute the Housner intensity, which takes 15 times as long or more
    #[arg(long)]
    pub housner: bool,
    /// Import motions that no earthquake is likely to have made (by length, PGA, PGV, time step, spikes or drift), and warn of them
    #[arg(long)]
    pub accept_implausible: bool,
    /// Import the rest where files cannot be read, and warn of those
    #[arg(long)]
    pub keep_going: bool,
}

impl Default for ImportMotionsOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for ImportMotionsOptions {
    fn resolve_paths(&mut self, folder: &Path) {
        for file in &mut self.files {
            *file = folder.join(&*file);
        }
    }
}

impl ImportMotionsOptions {
    /// What is done to records.
    ///
    /// # Errors
    /// If an option is out of range, or two ask for different scales.
    pub(super) fn processing(&self) -> anyhow::Result<Processing> {
        for (option, value, expected) in [
            ("high-pass", self.high_pass, "a frequency above 0 Hz"),
            ("scale-pga", self.scale_pga, "an acceleration above 0 g"),
            ("scale-pgv", self.scale_pgv, "a velocity above 0 m/s"),
        ] {
            if let Some(value) = value {
                check(value > 0.0 && value.is_finite(), option, value, expected)?;
            }
        }
        if let Some(dt) = self.resample {
            check((1e-4..=0.1).contains(&dt), "resample", dt, "a time step from 0.0001 to 0.1 s")?;
        }
        if self.residual && self.pulses.0 == PulseSearch::Skip {
            return Err(UsageError::because("residual motions need their pulses; leave out pulses: skip"));
        }
        Ok(Processing {
            baseline: self.baseline.0,
            high_pass: self.high_pass.map(|corner_hz| HighPass { corner_hz }),
            resample_s: self.resample,
            direction: self.rotate.as_ref().map(|direction| direction.0),
            scaling: self.scaling()?,
            pulses: self.pulses.0,
            residual: self.residual,
            implausible: if self.accept_implausible { Implausible::Accept } else { Implausible::Refuse },
            plan: measure_plan(self.housner, self.sa.as_ref())?,
        })
    }

    fn scaling(&self) -> anyhow::Result<Scaling> {
        match (&self.scale, self.scale_pga, self.scale_pgv) {
            (None, None, None) => Ok(Scaling::Factors(vec![1.0])),
            (None, Some(pga_g), None) => Ok(Scaling::Pga(pga_g * G_M_S2)),
            (None, None, Some(pgv_m_s)) => Ok(Scaling::Pgv(pgv_m_s)),
            (Some(factors), None, None) => {
                let positive = factors.values.iter().all(|factor| *factor > 0.0);
                check(positive, "scale", factors, "factors above 0")?;
                Ok(Scaling::Factors(factors.values.clone()))
            }
            _ => Err(UsageError::because(
                "scale, scale-pga and scale-pgv exclude each other; keep one of them",
            )),
        }
    }

    /// How files are read.
    ///
    /// # Errors
    /// If an option is out of range.
    pub(super) fn reading(&self) -> anyhow::Result<Reading> {
        if let Some(dt) = self.dt {
            check(dt > 0.0 && dt <= 10.0, "dt", dt, "a time step above 0 s and up to 10 s")?;
        }
        check(self.pga_tolerance >= 0.0, "pga-tolerance", self.pga_tolerance, "0 or more")?;
        Ok(Reading {
            format: self.format.0.0,
            given: Given {
                dt_s: self.dt,
                unit: self.unit.as_ref().map(|unit| unit.0),
                column: self.column.as_ref().map(|column| column.0.clone()),
            },
            pga_tolerance: self.pga_tolerance,
        })
    }
}

/// A format, or `auto`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FormatChoice(Option<Format>);

impl FromStr for FormatChoice {
    type Err = keyword::UnknownKeyword;

    fn from_str(word: &str) -> Result<FormatChoice, keyword::UnknownKeyword> {
        if word == "auto" {
            Ok(FormatChoice(None))
        } else {
            keyword::parse(word).map(|f| FormatChoice(Some(f)))
        }
    }
}

impl fmt::Display for FormatChoice {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.0.map_or("auto", Keyword::as_str))
    }
}
