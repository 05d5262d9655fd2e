//! validate: predictions beside what happened in responses that no fit has seen.

use std::path::PathBuf;

use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::fragility::{Case, Cases, Event, Model, MotionKind, Tau};
use rockfrag_core::studies::{Forecasts, ReliabilityBin, Validation};
use rockfrag_core::warning::{Warning, Warnings};
use serde::{Deserialize, Serialize};

use super::shared::fits::text;
use super::shared::model_args::ModelArgs;
use super::shared::motion_columns::MotionColumns;
use super::shared::responses;
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::options::Rule;
use crate::pipeline::paths::{Read, part};
use crate::table::keys::key_of;
use crate::table::provenance::Provenance;

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
    fn rules() -> Vec<Rule> {
        ModelArgs::RULES.to_vec()
    }

    fn inputs(&self) -> Vec<Read> {
        vec![Read::new("in", [&self.input]), self.fits.input()]
    }

    fn check(&self) -> anyhow::Result<()> {
        self.fits.check()
    }

    fn outputs(&self) -> Vec<PathBuf> {
        vec![part(&self.out, "reliability"), self.out.to_path_buf()]
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
            let warnings = warnings.into_iter().map(|warning| (warning, cases.structure.name.clone()));
            context.warn(warnings.collect());
            for event in EVENTS {
                let (score, reliability, outside) = validate(cases, &model, event, self.fits.limit_state);
                scores.extend(score);
                bins.extend(reliability);
                context.warn(outside);
            }
            bar.advance(1)?;
        }
        if scores.is_empty() {
            anyhow::bail!("{}: no structure rocks; expected responses with rocking", self.input.display());
        }
        let summary = text(&scores, COLUMNS, &self.out)?
            + if self.are_own()? { "These are the responses that were fitted.\n" } else { "" };
        context.write::<ReliabilityBin>(&part(&self.out, "reliability"), &bins, &summary)?;
        context.write::<Validation>(&self.out, &scores, &summary)?;
        Ok(summary)
    }
}

impl Validate {
    /// Whether the fits were made from these responses.
    fn are_own(&self) -> anyhow::Result<bool> {
        let Some(folder) = &self.fits.fits else { return Ok(false) };
        let made = Provenance::read(&folder.join("pro.calibration.parquet"))?;
        Ok(made.and_then(|made| made.input("in")) == Some(key_of(&self.input)?))
    }
}

/// Scores and reliability of one event; nothing of one without a case.
fn validate(
    cases: &Cases,
    model: &Model,
    event: Event,
    limit_state: f64,
) -> (Option<Validation>, Vec<ReliabilityBin>, Warnings) {
    let (mut probabilities, mut happened, mut clusters) = (Vec::new(), Vec::new(), Vec::new());
    let mut outside = false;
    for Case { outcome, measures, mw, cluster, .. } in &cases.all {
        let Some(has_happened) = event.happened(*outcome, limit_state) else { continue };
        let predicted = model.probabilities(&cases.structure, measures, *mw, Tau::Averaged).given_rocking;
        let p = predicted.and_then(|given| match event {
            Event::Overturning => Some(given.p_ro),
            Event::Exceeding => given.p_ex,
            Event::Rocking | Event::Failure => given.p_failure,
        });
        let Some(p) = p else { continue };
        outside |= model.warnings(&cases.structure, measures).contains(&Warning::Extrapolated);
        probabilities.push(p.value);
        happened.push(has_happened);
        clusters.push(*cluster);
    }
    let forecasts = Forecasts {
        suite: cases.suite.as_deref(),
        structure: &cases.structure.name,
        event,
        model: match model {
            Model::Surface { overturning, .. } if overturning.n == 0 => "surface",
            Model::Surface { .. } => "calibrated",
            Model::Paper { .. } => "paper",
        },
        probabilities: &probabilities,
        happened: &happened,
        clusters: &clusters,
    };
    let warning =
        (outside && event == Event::Failure).then(|| (Warning::Extrapolated, cases.structure.name.clone()));
    (forecasts.validate(), forecasts.reliability(), warning.into_iter().collect())
}
