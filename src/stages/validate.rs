//! validate: predictions beside what happened in responses that no fit has seen.

use std::path::PathBuf;

use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::fragility::{Case, Cases, Event, Model, MotionKind, Tau};
use rockfrag_core::rocking::Outcome;
use rockfrag_core::studies::{Forecasts, ReliabilityBin, Validation};
use rockfrag_core::warning::Warning;
use serde::{Deserialize, Serialize};

use super::shared::fits::text;
use super::shared::model_args::ModelArgs;
use super::shared::motion_columns::MotionColumns;
use super::shared::responses;
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::paths::{Files, Read, part};

/// Test predictions on responses not used in the fit: counts, scores and reliability
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag validate --in responses.parquet --fits fits --name frame \
    --suite csgm --out validation.parquet")]
pub struct Validate {
    /// Responses to test on
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = FilePath, default_value = "responses.parquet")]
    #[serde(rename = "in")]
    input: PathBuf,
    /// Scores to write, with NAME.reliability.parquet beside
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "validation.parquet")]
    out: PathBuf,
    #[command(flatten)]
    #[serde(flatten)]
    fits: ModelArgs,
}

const COLUMNS: &str = "suite structure event model n observed expected expected_error log_score brier";
const EVENTS: [Event; 3] = [Event::Overturning, Event::Exceeding, Event::Failure];

impl Stage for Validate {
    fn files(&self) -> Files {
        let read = [Read::new("in", [&self.input]), self.fits.input()];
        Files::tables(read, [&part(&self.out, "reliability"), &self.out])
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let groups = responses::read(&self.input, &MotionColumns::default())?;
        let mut models = self.fits.read()?;
        let bar = context.bar(groups.len());
        let (mut scores, mut bins) = (Vec::new(), Vec::new());
        for cases in &groups {
            // Without --suite the fits to the same kind of motion predict.
            let kind = MotionKind::from_suite(cases.suite.as_deref());
            models.args.suite = self.fits.suite.or(Some(kind));
            let (model, warnings) = models.model(&cases.structure)?;
            let is_outside = |case: &Case| {
                let warnings = model.warnings(&cases.structure, &case.measures);
                case.outcome != Outcome::NoRocking && warnings.contains(&Warning::Extrapolated)
            };
            let outside = cases.all.iter().any(is_outside).then_some(Warning::Extrapolated);
            let warnings = warnings.into_iter().chain(outside);
            context.warn(warnings.map(|warning| (warning, cases.structure.name.clone())).collect());
            let predicted: Vec<_> = cases.all.iter().map(|case| predict(&model, cases, case)).collect();
            for (place, event) in EVENTS.into_iter().enumerate() {
                let known = cases.all.iter().zip(&predicted).filter_map(|(case, p)| {
                    let happened = event.happened(case.outcome, self.fits.limit_state)?;
                    Some(((p[place]?, happened), case.cluster))
                });
                let (known, clusters): (Vec<_>, Vec<u32>) = known.unzip();
                let (probabilities, happened): (Vec<f64>, Vec<bool>) = known.into_iter().unzip();
                let forecasts = Forecasts {
                    suite: cases.suite.as_deref(),
                    structure: &cases.structure.name,
                    event,
                    model: word(&model),
                    probabilities: &probabilities,
                    happened: &happened,
                    clusters: &clusters,
                };
                scores.extend(forecasts.validate());
                bins.extend(forecasts.reliability());
            }
            bar.advance(1)?;
        }
        if scores.is_empty() {
            anyhow::bail!("{}: no structure rocks; expected responses with rocking", self.input.display());
        }
        let summary = text(&scores, COLUMNS, &self.out)?;
        context.write::<ReliabilityBin>(&part(&self.out, "reliability"), &bins, &summary)?;
        context.write::<Validation>(&self.out, &scores, &summary)?;
        Ok(summary)
    }
}

fn predict(model: &Model, Cases { structure, .. }: &Cases, case: &Case) -> [Option<f64>; 3] {
    let given = model.probabilities(structure, &case.measures, case.mw, Tau::Averaged).given_rocking;
    let of_events = given.map(|given| [Some(given.p_ro), given.p_ex, given.p_failure]);
    of_events.unwrap_or_default().map(|p| p.map(|p| p.value))
}

fn word(model: &Model) -> &'static str {
    match model {
        Model::Surface { overturning, .. } if overturning.n == 0 => "surface",
        Model::Surface { .. } => "calibrated",
        Model::Paper { .. } => "paper",
    }
}
