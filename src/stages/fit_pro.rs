//! fit-pro: the probability of overturning, by the paper's lognormal curves (Eqs. 19 to 24).

use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::shared::responses;
use crate::fragility::{CurveOptions, Event, Pair, fit_curves};
use crate::pipeline::UsageError;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::stage::{Stage, part};

/// Fit the probability of overturning: P_ro
#[derive(Debug, Args)]
pub struct FitPro {
    /// Responses to read
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = ValueHint::FilePath, default_value = "responses.parquet")]
    input: PathBuf,
    /// Fits to write; NAME.parameters.parquet and NAME.calibration.parquet are written beside it
    #[arg(long, value_name = "FILE", value_hint = ValueHint::AnyPath, default_value = "pro.parquet")]
    out: PathBuf,
    /// Event of the probability: overturning (given rocking) or rocking (of all motions)
    #[arg(long, default_value = "overturning")]
    event: Event,
    /// Pairs of measures for hybrid curves, besides curves of IM4 and IM5
    #[arg(long, value_name = "IM:IM,...", value_delimiter = ',', default_value = "im4:im3_inv")]
    pairs: Vec<Pair>,
    /// Confidence level of the limits
    #[arg(long, value_name = "P", default_value = "0.95", value_parser = number(0.5..=0.9999, "a level from 0.5 to 0.9999"))]
    confidence: f64,
    /// Fit all six measures of Eq. 13, not only IM4 and IM5
    #[arg(long)]
    all: bool,
}

impl Stage for FitPro {
    fn outputs(&self) -> Vec<PathBuf> {
        vec![part(&self.out, "parameters"), self.out.clone()]
    }

    fn check(&self) -> anyhow::Result<()> {
        match self.event {
            Event::Overturning | Event::Rocking => Ok(()),
            other => Err(UsageError::because(format!("event is {other}; expected overturning or rocking"))),
        }
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let groups = responses::read(&self.input)?;
        let options = CurveOptions { event: self.event, pairs: self.pairs.clone(), all: self.all };
        let bar = context.bar(groups.len() as u64);
        let mut fits = Vec::new();
        for cases in &groups {
            fits.extend(fit_curves(cases, &options));
            bar.advance(1)?;
        }
        let parameters: Vec<_> = fits.iter().flat_map(|fit| fit.parameters(self.confidence)).collect();
        let summary = format!("{} fits\n", fits.len());
        context.write(&part(&self.out, "parameters"), &parameters, &summary)?;
        context.write(&self.out, &fits, &summary)?;
        Ok(summary)
    }
}
