//! fit-pex: the probability of a demand above the limit state in safe rocking, by the paper's lines and
//! planes (Eqs. 14 to 18).

use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::Args;
use serde::Serialize;

use super::shared::fit_tables::{calibrations_text, suite_name, text, verdict, warnings};
use super::shared::responses;
use crate::fragility::{Calibration, DemandFit, DemandModel, fit_demand, sd_of_one_plane};
use crate::number::significant;
use crate::paper;
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::paths::{Input, Output, Read, part};
use crate::statistics::FitStatus;

/// Fit the probability of exceeding a demand in safe rocking: P_ex
#[derive(Debug, Args, Serialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag fit-pex\n\
    rockfrag fit-pex --in responses.parquet --limit-state 0.1,0.5 --all --out fits/pex.parquet")]
pub struct FitPex {
    /// Responses to read
    #[arg(long = "in", id = "in", value_name = "FILE", default_value = "responses.parquet")]
    input: Input,
    /// Fits to write, with NAME.parameters.parquet and NAME.calibration.parquet beside
    #[arg(long, value_name = "FILE", default_value = "pex.parquet")]
    out: Output,
    /// Limit states: demands |theta|max / alpha
    #[arg(long, value_name = "DEMAND,...", value_delimiter = ',', default_value = "0.1",
          value_parser = number(1e-6..=1.0, "a demand |theta|max / alpha above 0 and up to 1, such as 0.1"))]
    limit_state: Vec<f64>,
    /// IM4 at which the planes meet: a number, or found (least residual)
    #[arg(long, value_name = "IM4", default_value = "1.3")]
    transition: Transition,
    /// Lower bound on demands, as a solver of finite tolerance imposes
    #[arg(long, value_name = "DEMAND", default_value = "0",
          value_parser = number(0.0..=1.0, "a demand from 0 to 1"))]
    demand_floor: f64,
    /// Confidence level of the limits
    #[arg(long, value_name = "P", default_value = "0.95",
          value_parser = number(0.5..=0.9999, "a level from 0.5 to 0.9999"))]
    confidence: f64,
    /// Also fit each of the six measures alone, and one plane over all cases
    #[arg(long)]
    all: bool,
}

/// Where two planes meet.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Transition {
    Found,
    #[serde(untagged)]
    At(f64),
}

impl FromStr for Transition {
    type Err = String;

    fn from_str(text: &str) -> Result<Transition, String> {
        match text.parse() {
            Ok(im4) if im4 > 1.0 => Ok(Transition::At(im4)),
            _ if text == "found" => Ok(Transition::Found),
            _ => Err(format!("expected an IM4 above 1, such as {}, or found", paper::TRANSITION)),
        }
    }
}

impl Stage for FitPex {
    fn inputs(&self) -> Vec<Read> {
        vec![Read::new("in", [&*self.input])]
    }

    fn outputs(&self) -> Vec<PathBuf> {
        vec![part(&self.out, "calibration"), part(&self.out, "parameters"), self.out.to_path_buf()]
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let mut groups = responses::read(&self.input)?;
        let bar = context.bar(groups.len());
        let transition = if let Transition::At(im4) = self.transition { Some(im4) } else { None };
        let (mut fits, mut calibrations, mut sds) = (Vec::new(), Vec::new(), Vec::new());
        for cases in &mut groups {
            cases.raise_demands(self.demand_floor);
            fits.extend(fit_demand(cases, transition, self.confidence, self.all));
            let limits = self.limit_state.iter();
            calibrations.extend(limits.map(|limit_state| Calibration::fit(cases, Some(*limit_state))));
            sds.push(sd_of_one_plane(cases));
            bar.advance(1)?;
        }
        let parameters: Vec<_> = fits.iter().flat_map(|fit| fit.parameters(self.confidence)).collect();
        let summary = format!(
            "{}\n{}",
            calibrations_text(&calibrations, ["rock safely", "exceed"], &part(&self.out, "calibration")),
            planes_text(&fits, &sds, &self.out)
        );
        context.warn(warnings(&calibrations));
        context.write(&part(&self.out, "calibration"), &calibrations, &summary)?;
        context.write(&part(&self.out, "parameters"), &parameters, &summary)?;
        context.write(&self.out, &fits, &summary)?;
        Ok(summary)
    }
}

/// The paper's planes, with the residual standard deviation of both and of one plane in their place (`sds`).
fn planes_text(fits: &[DemandFit], sds: &[Option<f64>], out: &Path) -> String {
    let planes: Vec<&DemandFit> = fits.iter().filter(|fit| fit.model == DemandModel::Biplanar).collect();
    let lines = planes.chunks_exact(2).zip(sds).map(|(pair, one)| {
        let (below, above) = (pair[0], pair[1]);
        let numbers = [below.range_high, below.r2, above.r2, below.sd_with(above), *one];
        let numbers = numbers.map(|number| number.map_or("-".to_string(), |number| significant(number, 4)));
        let verdict = verdict(if below.status == FitStatus::Ok { above.status } else { below.status });
        let names = [suite_name(&below.suite), below.structure.clone()];
        names.into_iter().chain(numbers).chain([verdict]).collect()
    });
    let headings =
        ["suite", "structure", "transition", "R2 below", "R2 above", "sd", "sd of one plane", "verdict"];
    format!(
        "planes (paper), below and above the transition; sd of ln demand, also of one plane in ln(ln IM4) \
         and ln IM3\n{}",
        text(&headings, lines, 2..7, out)
    )
}
