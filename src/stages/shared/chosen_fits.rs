//! The fits as chosen: in words, and where they do not hold.

use std::collections::BTreeSet;

use super::answers::Answers;
use super::surface::Surface;
use super::transfers;
use crate::fragility::overturning::LEAST_EVENTS;
use crate::fragility::overturning::group::rejects;
use crate::fragility::sample::MANY;
use crate::fragility::universal::Scenarios;
use crate::fragility::{
    DemandModel, Fragility, FragilityModel, Gap, JointPeaks, LimitState, Measure, OutOfRange, Probabilities,
    ReplicateLimits, ResampledModel, Slice, USEFUL_R2, UniversalModel,
};
use crate::keyword::Keyword;
use crate::motion::{IntensityMeasures, Suite};
use crate::pipeline::console::Console;
use crate::rocking::Block;
use crate::rocking::Structure;
use crate::statistics::Estimator;

/// The fits as chosen.
#[derive(Debug, Clone, PartialEq)]
pub struct ChosenFits {
    /// Suite of motions, if it has a name.
    pub suite: Option<String>,
    /// Structure that was simulated.
    pub structure: String,
    /// The fits joined.
    pub model: FragilityModel,
    /// The same fits to resampled cases, where limits come from them.
    pub resampled: Option<ResampledModel>,
    /// R2 of the regression of the demand.
    pub demand_r2: Option<f64>,
    /// How P_ro was fitted.
    pub estimator: Estimator,
    /// Overturnings that P_ro comes from, and the cases among which they are.
    pub events: [usize; 2],
    /// Whether P_ro comes from so few events that some limits are too narrow.
    pub few_events: bool,
    /// Whether it comes from so few magnitudes and distances, or earthquakes, that little is known of how these differ.
    pub few_clusters: bool,
    /// Akaike's criterion of the curve of P_ro for each case: the least is of the best model.
    pub aic_per_case: f64,
    /// What speaks against the curve of P_ro, if anything does.
    pub misfit: Option<Misfit>,
    /// The size and slenderness that were simulated, if all cases share them.
    pub block: Option<Block>,
    /// How PGA and PGV go together in the motions that were simulated.
    pub peaks: Option<JointPeaks>,
}

/// What the tests of the straight line say against it.
#[derive(Debug, Clone, PartialEq)]
pub struct Misfit {
    /// How far it is from the curve that bends, if there is one.
    pub gap: Option<Gap>,
    /// The tests that were made, with their probabilities.
    pub tests: Vec<(&'static str, f64)>,
    /// Mean log scores of cells that were left out, of the line and of the curve that bends.
    pub log_scores: Option<[f64; 2]>,
    /// Which of the two answers.
    pub answer: Line,
}

/// Whether an index is straight or bends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Line {
    Straight,
    Bent,
}

impl Misfit {
    /// By how much the line is off, which tests reject it, and what answers in its place.
    pub fn words(&self) -> String {
        let reject = self.tests.iter().filter(|(_, p)| rejects(*p));
        let tests = reject.map(|(test, p)| format!("{test} p {p:.0e}")).collect::<Vec<_>>().join(", ");
        let off = self.gap.map_or(String::new(), |Gap { straight, bent }| {
            format!(
                "; in 1 case of 20 it is off by {:.2} or more, as {straight:.2} where a curve with a bend has {bent:.2}",
                (straight - bent).abs()
            )
        });
        let scores = self.log_scores.map_or(String::new(), |[straight, bent]| {
            format!(" (log score on held-out cells {bent:.4} against {straight:.4}, nearer to 0 is better)")
        });
        match self.answer {
            Line::Bent => format!(
                "the paper's curve of P_ro fits these data badly ({tests}{off}), so a curve with a bend answers{scores}; --model paper takes the paper's"
            ),
            Line::Straight => format!(
                "the paper's curve of P_ro, which answers, fits these data badly ({tests}{off}); low and high do not hold this error"
            ),
        }
    }
}

/// A difference in eta that the response hardly feels.
const SAME_ETA: f64 = 0.005;

/// Whether two coefficients of restitution are as far apart as the response feels.
pub fn is_other_eta(one: f64, other: f64) -> bool {
    (one - other).abs() > SAME_ETA
}

impl ChosenFits {
    /// Whether this coefficient of restitution is another one than that of the fits.
    pub fn is_other_eta(&self, eta: f64) -> bool {
        is_other_eta(eta, self.model.eta)
    }

    /// The overturnings, or the motions without them, whichever are fewer.
    fn fewer(&self) -> usize {
        let [events, n] = self.events;
        events.min(n - events)
    }

    /// That P_ro says little, if it comes from few overturnings, or motions without: least where ordinary estimates refuse them.
    pub fn doubt_of_events(&self) -> Option<String> {
        let ([events, n], few) = (self.events, self.fewer());
        let (what, limit) = match events == few {
            true => ("overturning(s)", "an upper"),
            false => ("motion(s) without overturning", "a lower"),
        };
        let what = what.replace("(s)", if few == 1 { "" } else { "s" });
        let says = match few < LEAST_EVENTS {
            true => format!("this says little more than {limit} limit"),
            false if self.few_events => "too few to tell how steep the curve is".to_string(),
            false => return None,
        };
        Some(format!("from {few} {what} of {n} motions: {says}"))
    }
}

/// The option without which a measure is missing among those of a motion that rocks the structure.
fn given_as(measure: Measure, measures: &IntensityMeasures) -> &'static str {
    match measure {
        Measure::Im1 => "--tp",
        Measure::Im2 => "--tm",
        Measure::Im6 if measures.im2.is_none() => "--tm",
        _ => "--pgv above 0",
    }
}

impl Answers for ChosenFits {
    fn model(&self) -> &dyn Fragility {
        &self.model
    }

    fn probabilities(&self, _: &Structure, measures: &IntensityMeasures) -> Probabilities {
        let probabilities = self.model.probabilities(measures);
        let Some(resampled) = &self.resampled else { return probabilities };
        let given_rocking = probabilities.given_rocking.map(|given| resampled.with_limits(&given, measures));
        Probabilities { given_rocking, ..probabilities }
    }

    fn resampled(&self) -> Option<&ResampledModel> {
        self.resampled.as_ref()
    }

    fn eta(&self) -> Option<f64> {
        Some(self.model.eta)
    }

    fn fitted(&self) -> Option<(Option<&str>, &str)> {
        Some((self.suite.as_deref(), &self.structure))
    }

    fn doubt_of_rates(&self) -> Option<String> {
        // Where fits are refused from fewer, those that are there come from samples that happen to hold many.
        let chosen = (LEAST_EVENTS..2 * LEAST_EVENTS).contains(&self.fewer());
        let chosen = if chosen {
            format!(
                "; fits from fewer than {LEAST_EVENTS} are refused, so that rates of those that answer are too high on average"
            )
        } else {
            String::new()
        };
        self.few_events.then(|| {
            format!(
                "annual rates from so few events: low and high assume the form of the curve where strong motions are few, and are too narrow{chosen}"
            )
        })
    }

    fn limit(&self) -> f64 {
        self.model.limit
    }

    fn hybrid_measure(&self, measures: &IntensityMeasures) -> Option<f64> {
        let overturning = &self.model.overturning;
        overturning.im_y.and_then(|_| overturning.hybrid_measure(measures))
    }

    fn words(&self) -> String {
        let model = &self.model;
        let of = |measures: &mut dyn Iterator<Item = Measure>| {
            measures.map(Keyword::as_str).collect::<Vec<_>>().join(" and ")
        };
        let demand = of(&mut model.demand.at_strong_motion().ln_median.measures());
        let planes = match model.demand {
            DemandModel::Everywhere(_) => String::new(),
            DemandModel::Biplanar { transition, .. } => {
                format!(" in two planes that meet at im4 {}", (transition * 1e4).round() / 1e4)
            }
        };
        let overturning = of(&mut model.overturning.measures());
        let bent = if model.overturning.bend.is_some() { ", bent" } else { "" };
        let suite = self.suite.as_deref().map_or(String::new(), |suite| format!(", {suite}"));
        let firth = match self.estimator {
            Estimator::Ml => "",
            Estimator::Firth => " by Firth's estimator",
        };
        format!(
            "fits of {}{suite}: P_ex of {demand}{planes}, P_ro of {overturning}{bent}{firth}",
            self.structure
        )
    }

    fn words_of_limits(&self) -> String {
        let by = match &self.resampled {
            None if self.model.overturning.spread > 0.0 => {
                let of = if self.suite.as_deref() == Some(Suite::Record.as_str()) {
                    "earthquake"
                } else {
                    "magnitude and distance"
                };
                format!("by the delta method, for one {of} that the fits have not seen")
            }
            None => "by the delta method".to_string(),
            Some(ResampledModel { replicates, limits: ReplicateLimits::Percentile }) => {
                format!("percentiles of {} resamples, of the fits alone", replicates.len())
            }
            Some(ResampledModel { replicates, limits: ReplicateLimits::BiasCorrected }) => {
                format!("bias-corrected percentiles of {} resamples, of the fits alone", replicates.len())
            }
        };
        match &self.misfit {
            Some(Misfit { answer: Line::Straight, .. }) => {
                format!("{by}, of the fitted line alone, which its tests reject")
            }
            _ => by,
        }
    }

    fn meaning(&self, state: LimitState) -> String {
        match state {
            LimitState::Rocking => "rocking".to_string(),
            LimitState::Failure => format!("|theta|max / alpha above {}, or overturning", self.model.limit),
            LimitState::Overturning => "overturning".to_string(),
        }
    }

    fn words_of_missing(&self, measures: &IntensityMeasures) -> String {
        let demand = &self.model.demand.at_strong_motion().ln_median;
        let needed = demand.measures().chain(self.model.overturning.measures());
        let missing = needed.filter(|measure| measure.among(measures).is_none());
        let (missing, given): (BTreeSet<&str>, BTreeSet<&str>) =
            missing.map(|measure| (measure.as_str(), given_as(measure, measures))).unzip();
        let all = |of: BTreeSet<&str>| of.into_iter().collect::<Vec<_>>().join(" and ");
        format!("the fits need {}: give {}", all(missing), all(given))
    }

    fn surface(&self, scenarios: Scenarios) -> Option<UniversalModel> {
        Some(Surface::beside(self.suite.as_deref(), self.model.limit, scenarios).0)
    }

    fn peaks(&self) -> Option<JointPeaks> {
        self.peaks
    }

    fn words_of_motions(&self) -> &'static str {
        "of the fits"
    }

    fn warn(&self, console: &Console) {
        if let Some(resampled) = &self.resampled {
            if let Some(missing) = resampled.too_many_missing() {
                console.warn(&format!(
                    "{missing} of {} resamples have no fit, so that they give no limits; take --limits delta",
                    resampled.replicates.len()
                ));
            }
            if self.few_events {
                console.warn("P_ro comes from fewer than 10 events, or non-events, for each coefficient: where it is small, limits by resamples are too narrow, those of --limits delta are not");
            }
        }
        if let Some(doubt) = self.doubt_of_events() {
            console.warn(&format!(
                "P_ro comes {doubt}; its limits may miss the truth: simulate more motions, or stronger ones, or ask --model universal"
            ));
        }
        if self.few_clusters {
            let but = match self.model.overturning.spread > 0.0 {
                true => "how much these differ is poorly known, and low and high may be too narrow",
                false => {
                    "too few to tell how much these differ, so that low and high leave it out and are too narrow"
                }
            };
            console.warn(&format!(
                "P_ro comes from fewer than {MANY} magnitudes and distances, or earthquakes: {but}"
            ));
        }
        if let Some(r2) = self.demand_r2.filter(|r2| *r2 < USEFUL_R2) {
            console.warn(&format!(
                "P_ex comes from a regression that explains next to nothing (R2 {r2:.2}): try another measure (--model univariate --measure IM), or --model universal"
            ));
        }
        if let Some(misfit) = &self.misfit {
            console.warn(&misfit.words());
        }
    }

    fn is_other_block(&self, structure: &Structure) -> bool {
        self.block.is_some_and(|block| transfers::is_other_block(block, structure))
    }

    fn is_other_structure(&self, structure: &Structure) -> bool {
        self.is_other_eta(structure.eta)
    }

    fn words_of_others(&self) -> String {
        format!("another eta than the fits ({}): they depend on it", self.model.eta)
    }

    fn warn_of_structure(&self, structure: &Structure, console: &Console) {
        let fitted = self.block.map(|block| (block, self.model.eta));
        let transfer = fitted.and_then(|fitted| transfers::words(self.suite.as_deref(), fitted, structure));
        if let Some(words) = transfer {
            return console.warn(&words);
        }
        if self.is_other_eta(structure.eta) {
            console.warn(&format!(
                "eta is {:.4}, but the fits are of eta {:.4}, on which the curves depend: simulate and fit with this eta",
                structure.eta, self.model.eta
            ));
        }
    }

    fn warn_of_range(&self, measures: &IntensityMeasures, subject: &str, console: &Console) {
        let mut outside: Vec<OutOfRange> = self.model.out_of_range(measures).collect();
        outside.dedup_by_key(|out| out.measure);
        for OutOfRange { measure, value, range: [least, largest] } in outside {
            console.warn(&format!(
                "{subject}{} is {value:.4}, outside of {least:.4} to {largest:.4} in the data: extrapolated",
                measure.as_str()
            ));
        }
    }

    fn warn_of_slice(&self, slice: &Slice, to: f64, subject: &str, console: &Console) {
        let strong = slice.intensity_at_im4(self.model.transition_im4().unwrap_or(1.0));
        self.warn_of_range(&slice.measures(strong), subject, console);
        let (largest, (unit, size)) = (slice.largest_in_data(&self.model), slice.peak.usual_unit());
        if to > largest * (1.0 + 1e-9) {
            console.warn(&format!(
                "{subject}up to {:.4} {unit}, but the data only to {:.4} {unit}: extrapolated",
                to / size,
                largest / size
            ));
        }
    }
}
