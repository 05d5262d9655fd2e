//! fit-pro: the probability of overturning, by the paper's lognormal curves (Eqs. 19 to 24).

use std::path::PathBuf;

use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::fragility::{Calibration, CurveFit, Event, Measure, Parameter, Predictors, fit_curves};
use serde::{Deserialize, Serialize};

use super::shared::fit_tables::{by_score, calibrations_text, score, suite_name, text, verdict, warnings};
use super::shared::motion_columns::MotionColumns;
use super::shared::{observed, responses};
use crate::number::THREE_DIGITS;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::paths::{Read, part};
use crate::pipeline::{Stage, UsageError};

/// Fit the probability of overturning: P_ro
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag fit-pro\n\
    rockfrag fit-pro --in responses.parquet --pairs im4:im5 --all --out fits/pro.parquet\n\
    rockfrag fit-pro --motions motions.parquet --pairs im4:im3_inv,housner_m,im4:arias_m_s")]
pub struct FitPro {
    /// Responses to read; or a list of what stood and what fell, CSV or Parquet: sizes, PGA, PGV, fell
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = FilePath, default_value = "responses.parquet")]
    #[serde(rename = "in")]
    input: PathBuf,
    /// Fits to write, with NAME.parameters.parquet and NAME.calibration.parquet beside
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "pro.parquet")]
    out: PathBuf,
    /// Event of the probability: overturning (given rocking) or rocking (of all motions)
    #[arg(long, default_value = "overturning")]
    event: Event,
    /// Measures, and pairs of them for hybrid curves, besides IM4 and IM5; or columns of --motions
    #[arg(long, value_name = "IM[:IM],...", value_delimiter = ',', default_value = "im4:im3_inv")]
    pairs: Vec<Predictors>,
    /// Motions of these responses; p and g tan alpha make columns in m/s2, m/s, m and s dimensionless
    #[arg(long, value_name = "FILE", value_hint = FilePath)]
    motions: Option<PathBuf>,
    /// Confidence level of the limits
    #[arg(long, value_name = "P", default_value = "0.95",
          value_parser = number(0.5..=0.9999, "a level from 0.5 to 0.9999"))]
    confidence: f64,
    /// Fit all six measures, not only IM4 and IM5
    #[arg(long)]
    all: bool,
}

impl Stage for FitPro {
    fn inputs(&self) -> Vec<Read> {
        vec![Read::new("in", [&self.input]), Read::new("motions", self.motions.iter())]
    }

    fn outputs(&self) -> Vec<PathBuf> {
        vec![part(&self.out, "calibration"), part(&self.out, "parameters"), self.out.to_path_buf()]
    }

    fn check(&self) -> anyhow::Result<()> {
        match self.event {
            Event::Overturning | Event::Rocking => MotionColumns::check(&self.pairs, self.motions.as_deref()),
            other => Err(UsageError::because(format!("event is {other}; expected overturning or rocking"))),
        }
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let calibration = part(&self.out, "calibration");
        let (mut fits, mut calibrations) = (Vec::new(), Vec::new());
        let summary = if observed::is_list(&self.input)? {
            // What stood and what fell gives no curve.
            let (outcomes, unused) = observed::read(&self.input)?;
            context.warn(unused);
            calibrations.extend(Calibration::fit_outcomes(&outcomes));
            calibrations_text(&calibrations, ["rocked", "fell"], &calibration)
        } else {
            let is_overturning = self.event == Event::Overturning;
            let columns = MotionColumns::read(&self.pairs, self.motions.as_deref())?;
            let groups = responses::read_with(&self.input, &columns)?;
            let bar = context.bar(groups.len());
            for cases in &groups {
                fits.extend(fit_curves(cases, self.event, &self.pairs, self.all));
                // The surface gives the probability of overturning, not that of rocking.
                calibrations.extend(is_overturning.then(|| Calibration::fit(cases, None)));
                bar.advance(1)?;
            }
            let calibrated = || calibrations_text(&calibrations, ["rock", "overturn"], &calibration) + "\n";
            is_overturning.then(calibrated).unwrap_or_default() + &self.curves_text(&fits)
        };
        let parameters: Vec<_> = fits.iter().flat_map(|fit| fit.parameters(self.confidence)).collect();
        context.warn(warnings(&calibrations));
        context.write(&calibration, &calibrations, &summary)?;
        context.write(&part(&self.out, "parameters"), &parameters, &summary)?;
        context.write(&self.out, &fits, &summary)?;
        Ok(summary)
    }
}

impl FitPro {
    /// The curves of IM5 and of the pairs, those of a structure by their score, the best first.
    fn curves_text(&self, fits: &[CurveFit]) -> String {
        let is_asked = |fit: &&CurveFit| {
            let predictors = fit.predictors();
            predictors == Predictors::one(Measure::Im5) || self.pairs.contains(&predictors)
        };
        let mut curves: Vec<&CurveFit> = fits.iter().filter(is_asked).collect();
        for its in curves.chunk_by_mut(|a, b| a.group() == b.group()) {
            its.sort_by(|a, b| by_score(a.held_out_log_score, b.held_out_log_score));
        }
        let lines = curves.into_iter().map(|fit| {
            let parameters = fit.parameters(self.confidence);
            let [median, dispersion] = [Parameter::Theta, Parameter::Beta].map(|wanted| {
                let row = parameters.iter().find(|row| row.parameter == wanted);
                row.map_or("-".to_string(), |row| THREE_DIGITS.both(row.estimate().into(), ""))
            });
            let names = [suite_name(&fit.suite), fit.structure.clone(), fit.predictors().to_string()];
            let numbers = [median, dispersion, score(fit.held_out_log_score), verdict(fit.status)];
            names.into_iter().chain(numbers).collect()
        });
        let headings = ["suite", "structure", "measure", "median", "dispersion", "log score", "verdict"];
        let lines = text(&headings, lines.collect(), 5..6, &self.out);
        format!(
            "lognormal curves (paper), with {} % limits; log score of held-out cells or earthquakes\n{lines}",
            100.0 * self.confidence
        )
    }
}
