//! fit-pro: fragility curves of overturning, or of rocking, by maximum likelihood.

use std::collections::BTreeSet;

use clap::Args;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::shared::groups;
use super::shared::uncertainty::uncertainty;
use super::simulate::Simulate;
use crate::fragility::overturning::{BentFit, Curve, CurveOptions, Gap, LEAST_EVENTS, Pair};
use crate::fragility::{CaseTable, CurveModel, Event};
use crate::keyword::{self, Keyword};
use crate::motion::Suite;
use crate::pipeline::console::{Console, OfGroup};
use crate::pipeline::declare::{Declare, Files, Input, Output, StageOptions};
use crate::pipeline::options::{Parsed, Several, Word, check, defaults};
use crate::pipeline::stage::Stage;
use crate::statistics::{Estimator, FitStatus, Link};
use crate::table::pro::{GroupCurve, PRO, PRO_BOOTSTRAP, ProReplicateRow, ProRow};
use crate::table::row::WriteRow;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::store::writer::TableWriter;

/// Which curves.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct FitProOptions {
    /// Event of the probability: overturning (given rocking) or rocking (of all motions)
    #[arg(long, default_value = "overturning")]
    pub event: Word<Event>,
    /// Pairs of measures for hybrid curves, besides the curves of the six single measures
    #[arg(long, default_value = "im4:im3_inv", value_name = "IM:IM,...")]
    pub pairs: Several<Parsed<Pair>>,
    /// Shape of the curve: probit (lognormal), logit or cloglog
    #[arg(long, default_value = "probit")]
    pub link: Word<Link>,
    /// What to maximise: ml (the likelihood) or firth (the penalised likelihood, for few events or separation)
    #[arg(long, default_value = "ml")]
    pub estimator: Word<Estimator>,
    /// Number of bootstrap resamples, drawn within each cell of magnitude and distance
    #[arg(long, default_value = "0", value_name = "N")]
    pub bootstrap: usize,
    /// Confidence level of all limits
    #[arg(long, default_value = "0.95", value_name = "P")]
    pub confidence: f64,
    /// Seed of the resamples [default: 42]
    #[arg(long)]
    pub seed: Option<u64>,
}

impl Default for FitProOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for FitProOptions {
    fn seed(&mut self) -> Option<&mut Option<u64>> {
        Some(&mut self.seed)
    }
}

/// The stage, ready to run.
pub struct FitPro {
    options: FitProOptions,
    curves: CurveOptions,
    input: Source,
    out: Target,
}

impl FitPro {
    /// Of the responses in `input`, into `out`.
    ///
    /// # Errors
    /// If an option is out of range.
    pub fn new(
        options: &FitProOptions,
        input: impl Into<Source>,
        out: impl Into<Target>,
    ) -> anyhow::Result<FitPro> {
        let possible = matches!(options.event.0, Event::Overturning | Event::Rocking);
        check(possible, "event", options.event, "overturning or rocking")?;
        let uncertainty = uncertainty(options.bootstrap, options.confidence, options.seed)?;
        let model = CurveModel {
            link: options.link.0,
            estimator: options.estimator.0,
            confidence: uncertainty.confidence,
        };
        let pairs = options.pairs.0.iter().map(|pair| pair.0).collect();
        let curves = CurveOptions { event: options.event.0, pairs, model, uncertainty };
        let options = FitProOptions { seed: Some(uncertainty.seed), ..options.clone() };
        Ok(FitPro { options, curves, input: input.into(), out: out.into() })
    }

    fn bootstrap_target(&self) -> Option<Target> {
        (self.options.bootstrap > 0).then(|| self.out.part("bootstrap"))
    }
}

impl Declare for FitPro {
    type Options = FitProOptions;
    const NAME: &'static str = PRO.stage;
    const ABOUT: &'static str = "Fit the probability of overturning: P_ro";
    const EXAMPLES: &'static str = "rockfrag fit-pro\n\
        rockfrag fit-pro --estimator firth --out firth.parquet";
    const INPUTS: &'static [Input] =
        &[Input::file("responses", "in", Simulate::OUTPUT.file, "Responses to read")];
    const OUTPUT: Output =
        Output::file("pro.parquet", "Fits to write [default: pro.parquet beside the input]")
            .with_parts(&["bootstrap"]);

    fn create(options: &FitProOptions, files: &Files) -> anyhow::Result<FitPro> {
        FitPro::new(options, files.input("responses")?, files.out(Self::OUTPUT.file)?)
    }
}

impl Stage for FitPro {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("responses", self.input.clone())]
    }

    fn targets(&self) -> Vec<Target> {
        self.bootstrap_target().into_iter().chain([self.out.clone()]).collect()
    }

    fn parameters(&self) -> Value {
        json!(self.options)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let groups = groups::read(&self.input)?;
        let bar = console.bar(self.name(), groups.len() as u64 * self.curves.uncertainty.steps());
        let to_fit: Vec<&CaseTable> = groups.iter().map(|group| &group.cases).collect();
        let fitted = self.curves.fit(&to_fit, &|steps| bar.inc(steps))?;
        bar.finish();
        let mut rows = Vec::new();
        for (group, curves) in groups.iter().zip(fitted) {
            let (block, peaks) = (group.block(), group.peaks());
            let (suite, structure, eta) = (&group.suite, &group.structure, group.eta);
            let row = |curve| GroupCurve {
                suite: suite.clone(),
                structure: structure.clone(),
                eta,
                block,
                peaks,
                curve,
            };
            rows.extend(curves.into_iter().map(row));
        }
        let missing = rows.iter().filter(|row| !row.curve.status().is_usable());
        console.warn_each_group(missing.map(|row| (reason(row), measures(&row.curve))));
        console.warn_each_group(rows.iter().filter_map(doubt));
        let few = rows.iter().filter(|row| row.curve.has_few_events());
        console.warn_each_group(few.map(|row| (few_events(row), measures(&row.curve))));
        if !rows.iter().any(|row| row.curve.status().is_usable()) {
            console.warn(&nothing_fits(&rows));
        }
        if let Some(target) = self.bootstrap_target() {
            let mut writer = TableWriter::create(target, &PRO_BOOTSTRAP, provenance.clone())?;
            for row in &rows {
                writer.append(&ProReplicateRow::batch(&row.replicates().collect::<Vec<_>>())?)?;
            }
            writer.finish()?;
        }
        ProRow::write(&rows.iter().map(ProRow::from).collect::<Vec<_>>(), self.out.clone(), provenance)?;
        let count = |status: FitStatus| rows.iter().filter(|row| row.curve.status() == status).count();
        let doubtful = [FitStatus::Misfit, FitStatus::FarMedian]
            .map(|status| (count(status), status.as_str()))
            .into_iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, status)| format!(", {count} {status}"));
        Ok(format!("{} of {} curves ok{}", count(FitStatus::Ok), rows.len(), doubtful.collect::<String>()))
    }
}

/// The measures of a curve, for a message.
fn measures(curve: &Curve) -> String {
    let second = curve.im_y.map_or(String::new(), |measure| format!(":{}", measure.as_str()));
    format!("{}{second}", curve.im_x.as_str())
}

/// What speaks against a curve that there is, for a message.
fn doubt(row: &GroupCurve) -> Option<(OfGroup, String)> {
    let curve = &row.curve;
    let (event, of) = (curve.event.as_str(), measures(curve));
    let fit = curve.fit.as_ref().ok()?;
    match curve.status() {
        FitStatus::Misfit => {
            let bent = match (&curve.bent, curve.bent_answer()) {
                (None, _) => "",
                (_, Some(_)) => "; evaluate uses the bent ones",
                (_, None) => "; the bent ones do no better on cells left out",
            };
            Some((
                of_group(
                    row,
                    format!("straight curves of {event} for {{}}, fit badly (tests reject them){bent}"),
                ),
                match &curve.bent {
                    Some(BentFit { gap: Gap { straight, bent }, .. }) => {
                        format!("{of} ({straight:.2} straight, {bent:.2} bent)")
                    }
                    None => of,
                },
            ))
        }
        FitStatus::FarMedian => Some((
            of_group(
                row,
                format!(
                    "medians of {event} for {{}}, lie far outside of the data, so that these measures say little"
                ),
            ),
            match fit.factor_of_median() {
                far if far < LARGEST_FACTOR => format!("{of} (by a factor of {})", factor(far)),
                _ => format!("{of} (no median can be estimated)"),
            },
        )),
        _ => None,
    }
}

/// A median that is farther out is none.
const LARGEST_FACTOR: f64 = 1e6;

fn factor(factor: f64) -> String {
    if factor < 1000.0 { format!("{factor:.0}") } else { format!("{factor:.0e}") }
}

/// What to do where no curve can be fitted.
fn nothing_fits(rows: &[GroupCurve]) -> String {
    let event = rows.first().map_or("events", |row| row.curve.event.as_str());
    let counts: BTreeSet<String> =
        rows.iter().map(|row| format!("{} of {}", row.curve.events, row.curve.n)).collect();
    let counts = counts.into_iter().collect::<Vec<_>>().join(", ");
    let is_synthetic = |row: &GroupCurve| {
        let suite = row.suite.as_deref().and_then(|suite| keyword::parse(suite).ok());
        suite.is_some_and(|suite| Suite::SYNTHETIC.contains(&suite))
    };
    let more = match rows.iter().all(is_synthetic) {
        true => "more motions (more samples of sample-scenarios, in pipeline.yaml or by --samples)",
        false => "more motions, or stronger ones (import-motions --scale),",
    };
    format!(
        "none of {} curves can be fitted: {event} in {counts} cases; expected {LEAST_EVENTS} or more with it, \
         and {LEAST_EVENTS} or more without\n\
         {more} answer the same question with more events; rockfrag evaluate --model universal answers by a surface for all structures, with none\n\
         --estimator firth answers it from one event on, and in spite of separation; from so few it says little more than an upper limit\n\
         ida scales each motion until it overturns a structure; fit-pro reads its stripes (ida.stripes.parquet), which tell what \
         these motions would do if they were stronger",
        rows.len()
    )
}

/// Which limits to take where events are few, for a message.
fn few_events(row: &GroupCurve) -> OfGroup {
    let GroupCurve { curve, .. } = row;
    let few = curve.events.min(curve.n - curve.events);
    let of_probabilities = match few < LEAST_EVENTS {
        true => "a probability is little more than a bound, and its own limits may miss the truth",
        false => {
            "evaluate --limits delta gives sound limits of one probability among these motions, but not of annual rates"
        }
    };
    let words = format!(
        "few {} for {{}}: standard errors of parameters are too small, their profile limits (columns *_profile_*) are not; \
         {of_probabilities}",
        if 2 * curve.events > curve.n { "cases without the event" } else { "events" }
    );
    let reason = of_group(row, words);
    OfGroup { group: format!("{} ({few} of {} cases)", reason.group, curve.n), ..reason }
}

fn of_group(GroupCurve { suite, structure, .. }: &GroupCurve, words: String) -> OfGroup {
    let suite = suite.as_deref().unwrap_or("the motions");
    OfGroup { words, group: format!("{suite}, {structure}"), counts: String::new() }
}

/// What is wrong with a curve, for a message.
fn reason(row: &GroupCurve) -> OfGroup {
    let curve = &row.curve;
    let Curve { events, n, .. } = curve;
    let event = curve.event.as_str();
    match curve.status() {
        FitStatus::Falling => {
            of_group(row, format!("the probability of {event} for {{}}, falls with the measure"))
        }
        status => OfGroup {
            counts: format!(" ({events} of {n} cases)"),
            ..of_group(row, format!("no curve of {event} for {{}}: {}", status.as_str()))
        },
    }
}
