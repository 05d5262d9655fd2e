//! fit-pro: the probability of overturning, by the paper's lognormal curves (Eqs. 19 to 24).

use std::path::PathBuf;

use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::fragility::{Calibration, CurveFit, Event, Predictors, fit_curves};
use serde::{Deserialize, Serialize};

use super::shared::fits::{CurveLine, best_first, text, warnings};
use super::shared::motion_columns::MotionColumns;
use super::shared::{observed, responses};
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::paths::{Files, Read, part};

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
    /// Measures, and pairs of them for hybrid curves, besides IM4 and IM5; or columns of --motions
    #[arg(
        long,
        value_name = "IM[:IM],...",
        value_delimiter = ',',
        default_value = "im4:im3_inv,im5:im3_inv"
    )]
    pairs: Vec<Predictors>,
    /// Motions of these responses; p and g tan alpha make columns in m/s2, m/s, m and s dimensionless
    #[arg(long, value_name = "FILE", value_hint = FilePath)]
    motions: Option<PathBuf>,
    /// Confidence level of the limits
    #[arg(long, value_name = "P", default_value = "0.95",
          value_parser = number(0.5..=0.9999, "a level from 0.5 to 0.9999"))]
    confidence: f64,
    /// Fit all six measures and both hybrids of the paper, not only IM4 and IM5
    #[arg(long)]
    all: bool,
}

impl Stage for FitPro {
    fn files(&self) -> Files {
        let read = [Read::new("in", [&self.input]), Read::new("motions", &self.motions)];
        let beside = ["calibration", "parameters"].map(|name| part(&self.out, name));
        Files::tables(read, beside.iter().chain([&self.out]))
    }

    fn check(&self) -> anyhow::Result<()> {
        MotionColumns::check(&self.pairs, self.motions.as_deref())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let (mut fits, mut calibrations) = (Vec::new(), Vec::new());
        if let Some(outcomes) = observed::read(&self.input, context)? {
            // What stood and what fell gives no curve.
            calibrations.extend(Calibration::fit_outcomes(&outcomes));
        } else {
            let columns = MotionColumns::read(&self.pairs, self.motions.as_deref())?;
            let groups = responses::read(&self.input, &columns)?;
            let bar = context.bar(groups.len());
            for cases in &groups {
                fits.extend(fit_curves(cases, Event::Overturning, &self.pairs, self.all));
                calibrations.push(Calibration::fit(cases, None));
                bar.advance(1)?;
            }
        }
        let parameters: Vec<_> = fits.iter().flat_map(|fit| fit.parameters(self.confidence)).collect();
        let [calibration_out, parameters_out] =
            ["calibration", "parameters"].map(|name| part(&self.out, name));
        let mut summary = "cases, events, and events that the surface as shipped expects\n".to_string();
        summary += &text(&calibrations, "suite structure n n_events expected", &calibration_out)?;
        if !fits.is_empty() {
            let best_first = best_first(&fits, CurveFit::group, |fit| fit.held_out_log_score);
            let lines: Vec<_> = best_first.iter().map(|fit| CurveLine::new(fit, self.confidence)).collect();
            let percent = 100.0 * self.confidence;
            summary += &format!(
                "\nlognormal curves (paper), the best on held-out cases first, with {percent} % limits\n"
            );
            summary += &text(&lines, CURVE_COLUMNS, &self.out)?;
        }
        context.warn(warnings(&calibrations));
        context.write(&calibration_out, &calibrations, &summary)?;
        context.write(&parameters_out, &parameters, &summary)?;
        context.write(&self.out, &fits, &summary)?;
        Ok(summary)
    }
}

const CURVE_COLUMNS: &str = "suite structure im_x im_y theta theta_low theta_high beta beta_low beta_high \
                             lambda largest_difference status";
