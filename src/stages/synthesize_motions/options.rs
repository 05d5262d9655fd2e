//! The options of synthesize-motions.

use std::path::Path;

use anyhow::Context;
use clap::Args;
use serde::{Deserialize, Serialize};

use crate::motion::Site;
use crate::motion::stochastic::LowCut;
use crate::motion::{Difference, Epoch, MotionModel, StochasticModel, Suite};
use crate::pipeline::UsageError;
use crate::pipeline::declare::StageOptions;
use crate::pipeline::options::{DEFAULT_SEED, Parsed, Several, Steps, Word, check, defaults, number};
use crate::table::store::partition::Partition;
use crate::table::store::text_file::{self, CsvText};

/// The largest table of site amplification.
const MOST_SITE_MIB: u64 = 1;

/// Site amplifications that are no file.
const SITES: [&str; 3] = ["rock", "soil", "none"];

/// How motions are made.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct SynthesizeMotionsOptions {
    /// Seed of the noise [default: 42]
    #[arg(long)]
    pub seed: Option<u64>,
    /// Suites, separated by commas: pulse (the pulse alone), csgm (pulse and high frequencies), hfc (high frequencies alone)
    #[arg(long, default_value = "pulse,csgm")]
    pub suite: Several<Word<Suite>>,
    /// Time between samples, s
    #[arg(long, default_value = "0.005", value_name = "S")]
    pub dt: f64,
    /// How to subtract the pulse from the spectrum of the high frequencies where the pulse is stronger: absolute, signed, clamp or none
    /// (plain sum)
    #[arg(long, default_value = "absolute")]
    pub difference: Word<Difference>,
    /// When the pulse peaks: envelope-peak (at the peak of the envelope), pga or pgv (at the peak acceleration or velocity of the
    /// high frequencies)
    #[arg(long, default_value = "envelope-peak")]
    pub epoch: Word<Epoch>,
    /// Site amplification: rock, soil, none, or a CSV file with a column of frequencies (Hz) and one of factors
    #[arg(long, default_value = "rock")]
    pub site: String,
    /// Near-surface attenuation kappa, s
    #[arg(long, default_value = "0.03", value_name = "S")]
    pub kappa: f64,
    /// Corner of the filter 1/sqrt(1 + (f/fmax)^8), Hz [default: none]
    #[arg(long, value_name = "HZ")]
    pub fmax: Option<f64>,
    /// Corner of the high-pass filter 1/(1 + (fc/f)^(2n)), Hz [default: none]
    #[arg(long, value_name = "HZ")]
    pub low_cut: Option<f64>,
    /// Order n of the high-pass filter
    #[arg(long, default_value = "4", value_name = "N")]
    pub low_cut_order: u32,
    /// Also compute the Housner intensity, which takes 15 times as long or more
    #[arg(long)]
    pub housner: bool,
    /// Add spectral accelerations (5 % damping) at these periods, s: first:last:step, or numbers separated by commas; the column
    /// sa_0p20_m_s2 is for 0.2 s
    #[arg(long, value_name = "S,...")]
    pub sa: Option<Steps>,
    /// Scenarios in a row group, which are held in memory together; the rows do not depend on it
    #[arg(long, default_value = "128", value_name = "N")]
    pub row_group: usize,
    /// Make only partition i of n, with i from 0 to n - 1: an equal share of the scenarios (later ones take longer). The output is
    /// then a folder, and the partition its file part-0000i.parquet
    #[arg(long, value_name = "I/N")]
    pub partition: Option<Parsed<Partition>>,
}

impl Default for SynthesizeMotionsOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for SynthesizeMotionsOptions {
    fn seed(&mut self) -> Option<&mut Option<u64>> {
        Some(&mut self.seed)
    }

    fn resolve_paths(&mut self, folder: &Path) {
        if !SITES.contains(&self.site.as_str()) {
            self.site = folder.join(&self.site).display().to_string();
        }
    }
}

impl SynthesizeMotionsOptions {
    pub(super) fn model(&self) -> anyhow::Result<MotionModel> {
        check((1e-4..=0.1).contains(&self.dt), "dt", self.dt, "a time step from 0.0001 to 0.1 s")?;
        check((0.0..=1.0).contains(&self.kappa), "kappa", self.kappa, "0 to 1 s")?;
        for (option, corner) in [("fmax", self.fmax), ("low-cut", self.low_cut)] {
            if let Some(corner) = corner {
                check(corner > 0.0 && corner.is_finite(), option, corner, "a frequency above 0 Hz")?;
            }
        }
        check((1..=20).contains(&self.low_cut_order), "low-cut-order", self.low_cut_order, "1 to 20")?;
        check((1..=4096).contains(&self.row_group), "row-group", self.row_group, "1 to 4096 scenarios")?;
        let low_cut = self.low_cut.map(|corner_hz| LowCut { corner_hz, order: self.low_cut_order });
        Ok(MotionModel {
            dt_s: self.dt,
            difference: self.difference.0,
            epoch: self.epoch.0,
            stochastic: StochasticModel {
                site: self.site()?,
                kappa_s: self.kappa,
                fmax_hz: self.fmax,
                low_cut,
            },
            seed: self.seed.unwrap_or(DEFAULT_SEED),
        })
    }

    fn site(&self) -> anyhow::Result<Site> {
        match self.site.as_str() {
            "rock" => Ok(Site::Rock),
            "soil" => Ok(Site::Soil),
            "none" => Ok(Site::None),
            file => {
                let expected = || {
                    UsageError(format!(
                        "site is '{file}'; expected rock, soil, none, or a CSV file with a header line"
                    ))
                };
                let text = text_file::text(Path::new(file), MOST_SITE_MIB, "amplification by frequency")
                    .with_context(expected)?;
                let rows = amplification(&text).map_err(anyhow::Error::msg).with_context(expected)?;
                Site::table(rows).with_context(expected)
            }
        }
    }

    pub(super) fn suites(&self) -> anyhow::Result<Vec<Suite>> {
        let suites: Vec<Suite> = self.suite.0.iter().map(|word| word.0).collect();
        let made = |suite: &Suite| Suite::SYNTHETIC.contains(suite);
        let distinct = (1..suites.len()).all(|k| !suites[..k].contains(&suites[k]));
        let words: Vec<String> = self.suite.0.iter().map(ToString::to_string).collect();
        let fine = !suites.is_empty() && suites.iter().all(made) && distinct;
        check(fine, "suite", words.join(","), "some of pulse, csgm and hfc, each once")?;
        Ok(suites)
    }
}

/// Frequencies (Hz) and factors: the first two columns of a CSV file.
fn amplification(text: &str) -> Result<Vec<(f64, f64)>, String> {
    let table = CsvText::new(text, |_| false).map_err(|error| error.to_string())?;
    let headings = table.headings.clone();
    let pair = |row: Result<(u64, csv::StringRecord), String>| {
        let (line, row) = row?;
        let cell = |column: usize| {
            let (text, heading) = (row.get(column).unwrap_or_default(), headings.get(column));
            let heading = heading.map_or("", String::as_str);
            number(text).map_err(|expected| format!("line {line}, column '{heading}': '{text}'; {expected}"))
        };
        Ok((cell(0)?, cell(1)?))
    };
    table.rows().map(pair).collect()
}
