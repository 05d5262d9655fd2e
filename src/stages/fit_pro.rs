//! fit-pro: the probability of overturning, by the paper's lognormal curves (Eqs. 19 to 24).

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::shared::fit_tables::{calibrations_text, suite_name, text, verdict, warnings};
use super::shared::{observed, responses};
use crate::fragility::{Calibration, CurveFit, Event, Measure, Pair, Parameter, fit_curves};
use crate::number::THREE_DIGITS;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::paths::{Output, Read, RowsInput, part};
use crate::pipeline::{Stage, UsageError};

/// Fit the probability of overturning: P_ro
#[derive(Debug, Args, Serialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag fit-pro\n\
    rockfrag fit-pro --in responses.parquet --pairs im4:im5 --all --out fits/pro.parquet")]
pub struct FitPro {
    /// Responses to read; or a list of what stood and what fell, CSV or Parquet: sizes, PGA, PGV, fell
    #[arg(long = "in", id = "in", value_name = "FILE", default_value = "responses.parquet")]
    input: RowsInput,
    /// Fits to write, with NAME.parameters.parquet and NAME.calibration.parquet beside
    #[arg(long, value_name = "FILE", default_value = "pro.parquet")]
    out: Output,
    /// Event of the probability: overturning (given rocking) or rocking (of all motions)
    #[arg(long, default_value = "overturning")]
    event: Event,
    /// Pairs of measures for hybrid curves, besides curves of IM4 and IM5
    #[arg(long, value_name = "IM:IM,...", value_delimiter = ',', default_value = "im4:im3_inv")]
    pairs: Vec<Pair>,
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
        vec![Read::new("in", [&*self.input])]
    }

    fn outputs(&self) -> Vec<PathBuf> {
        vec![part(&self.out, "calibration"), part(&self.out, "parameters"), self.out.to_path_buf()]
    }

    fn check(&self) -> anyhow::Result<()> {
        match self.event {
            Event::Overturning | Event::Rocking => Ok(()),
            other => Err(UsageError::because(format!("event is {other}; expected overturning or rocking"))),
        }
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let calibration = part(&self.out, "calibration");
        let (mut fits, mut calibrations, mut texts) = (Vec::new(), Vec::new(), Vec::new());
        if observed::is_list(&self.input)? {
            // What stood and what fell gives no curve.
            let (outcomes, unused) = observed::read(&self.input)?;
            context.warn(unused);
            calibrations.extend(Calibration::fit_outcomes(&outcomes));
            texts.push(calibrations_text(&calibrations, ["rocked", "fell"], &calibration));
        } else {
            let groups = responses::read(&self.input)?;
            let bar = context.bar(groups.len());
            for cases in &groups {
                fits.extend(fit_curves(cases, self.event, &self.pairs, self.all));
                // The surface gives the probability of overturning, not that of rocking.
                if self.event == Event::Overturning {
                    calibrations.push(Calibration::fit(cases, None));
                }
                bar.advance(1)?;
            }
            if !calibrations.is_empty() {
                texts.push(calibrations_text(&calibrations, ["rock", "overturn"], &calibration));
            }
            texts.push(curves_text(&fits, self.confidence, &self.out));
        }
        let parameters: Vec<_> = fits.iter().flat_map(|fit| fit.parameters(self.confidence)).collect();
        let summary = texts.join("\n");
        context.warn(warnings(&calibrations));
        context.write(&calibration, &calibrations, &summary)?;
        context.write(&part(&self.out, "parameters"), &parameters, &summary)?;
        context.write(&self.out, &fits, &summary)?;
        Ok(summary)
    }
}

fn curves_text(fits: &[CurveFit], confidence: f64, out: &Path) -> String {
    let curves = fits.iter().filter(|fit| (fit.im_x, fit.im_y) == (Measure::Im5, None));
    let lines = curves.map(|fit| {
        let parameters = fit.parameters(confidence);
        let [median, dispersion] = [Parameter::Theta, Parameter::Beta].map(|wanted| {
            let row = parameters.iter().find(|row| row.parameter == wanted);
            row.map_or("-".to_string(), |row| THREE_DIGITS.both(row.estimate().into(), ""))
        });
        vec![suite_name(&fit.suite), fit.structure.clone(), median, dispersion, verdict(fit.status)]
    });
    let headings = ["suite", "structure", "median", "dispersion", "verdict"];
    let lines = text(&headings, lines, 0..0, out);
    format!("lognormal curve (paper) of IM5, with {} % limits\n{lines}", 100.0 * confidence)
}
