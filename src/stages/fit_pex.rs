//! fit-pex: the probability of a demand above the limit state in safe rocking, by the paper's lines and
//! planes (Eqs. 14 to 18).

use std::path::PathBuf;

use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::fragility::{Calibration, DemandFit, Predictors, fit_demand};
use rockfrag_core::plausibility::GIVEN_LIMIT_STATE;
use serde::{Deserialize, Serialize};

use super::shared::fits::{best_first, text, warnings};
use super::shared::motion_columns::MotionColumns;
use super::shared::responses;
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::options::{given, number};
use crate::pipeline::paths::{Files, Read, part};

/// Fit the probability of exceeding a demand in safe rocking: P_ex
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag fit-pex\n\
    rockfrag fit-pex --in responses.parquet --limit-state 0.1,0.5 --all --out fits/pex.parquet\n\
    rockfrag fit-pex --motions motions.parquet --pairs im5:im3,housner_m")]
pub struct FitPex {
    /// Responses to read
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = FilePath, default_value = "responses.parquet")]
    #[serde(rename = "in")]
    input: PathBuf,
    /// Fits to write, with NAME.parameters.parquet and NAME.calibration.parquet beside
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "pex.parquet")]
    out: PathBuf,
    /// Limit states: demands |theta|max / alpha
    #[arg(long, value_name = "DEMAND,...", value_delimiter = ',', default_value = "0.1",
          value_parser = given(GIVEN_LIMIT_STATE))]
    limit_state: Vec<f64>,
    /// IM4 at which the planes meet; the column transition_found has that of the least residual
    #[arg(long, value_name = "IM4", default_value = "1.3",
          value_parser = number(1.0_f64.next_up()..=100.0, "an IM4 above 1, such as 1.3"))]
    transition: f64,
    /// Lower bound on rotations in safe rocking, rad, as a solver of finite tolerance imposes
    #[arg(long, value_name = "RAD", default_value = "1e-6",
          value_parser = number(0.0..=0.1, "a rotation from 0 to 0.1 rad"))]
    rotation_floor: f64,
    /// Confidence level of the limits
    #[arg(long, value_name = "P", default_value = "0.95",
          value_parser = number(0.5..=0.9999, "a level from 0.5 to 0.9999"))]
    confidence: f64,
    /// Also fit each of the six measures alone, and one plane over all cases
    #[arg(long)]
    all: bool,
    /// Further measures to fit over all cases, and pairs of them for planes; or columns of --motions
    #[arg(long, value_name = "IM[:IM],...", value_delimiter = ',')]
    pairs: Vec<Predictors>,
    /// Motions of these responses; p and g tan alpha make columns in m/s2, m/s, m and s dimensionless
    #[arg(long, value_name = "FILE", value_hint = FilePath)]
    motions: Option<PathBuf>,
}

impl Stage for FitPex {
    fn files(&self) -> Files {
        let read = [Read::new("in", [&self.input]), Read::new("motions", &self.motions)];
        let beside = ["calibration", "parameters"].map(|name| part(&self.out, name));
        Files::tables(read, beside.iter().chain([&self.out]))
    }

    fn check(&self) -> anyhow::Result<()> {
        MotionColumns::check(&self.pairs, self.motions.as_deref())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let columns = MotionColumns::read(&self.pairs, self.motions.as_deref())?;
        let mut groups = responses::read(&self.input, &columns)?;
        let bar = context.bar(groups.len());
        let (mut fits, mut calibrations) = (Vec::new(), Vec::new());
        for cases in &mut groups {
            cases.raise_rotations(self.rotation_floor);
            fits.extend(fit_demand(cases, Some(self.transition), &self.limit_state, &self.pairs, self.all));
            let limits = self.limit_state.iter();
            calibrations.extend(limits.map(|limit_state| Calibration::fit(cases, Some(*limit_state))));
            bar.advance(1)?;
        }
        let parameters: Vec<_> = fits.iter().flat_map(|fit| fit.parameters(self.confidence)).collect();
        let calibration = part(&self.out, "calibration");
        let best_first = best_first(&fits, DemandFit::group, |fit| fit.held_out_log_score);
        let summary = format!(
            "cases, events, and events that the surface as shipped expects\n{}\n\
             planes (paper) below and above the transition, and laws; beta is the sd of ln demand\n{}",
            text(&calibrations, "suite structure limit_state n n_events expected", &calibration)?,
            text(best_first, COLUMNS, &self.out)?
        );
        context.warn(warnings(&calibrations));
        context.write(&calibration, &calibrations, &summary)?;
        context.write(&part(&self.out, "parameters"), &parameters, &summary)?;
        context.write(&self.out, &fits, &summary)?;
        Ok(summary)
    }
}

const COLUMNS: &str = "suite structure model im_x im_y range_low n r2 beta held_out_log_score \
                       largest_difference status";
