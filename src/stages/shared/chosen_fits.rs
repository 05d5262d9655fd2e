//! The fits as chosen: in words, and where they do not hold.

use super::transfers;
use crate::fragility::{
    DemandModel, FragilityModel, JointPeaks, LimitState, Measure, OutOfRange, Probabilities, ReplicateLimits,
    ResampledModel, Slice,
};
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::pipeline::console::Console;
use crate::rocking::Block;
use crate::rocking::Structure;
use crate::statistics::Gap;

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
    /// Whether P_ro comes from so few events that some limits are too narrow.
    pub few_events: bool,
    /// Akaike's criterion of the curve of P_ro for each case: the least is of the best model.
    pub aic_per_case: f64,
    /// What speaks against the curve of P_ro, if anything does.
    pub misfit: Option<Misfit>,
    /// The size and slenderness that were simulated, if all cases share them.
    pub block: Option<Block>,
    /// How PGA and PGV go together in the motions that were simulated.
    pub peaks: Option<JointPeaks>,
}

/// What the tests of a curve say against it.
#[derive(Debug, Clone, PartialEq)]
pub struct Misfit {
    /// What it predicts and what was observed, where they differ most.
    pub gap: Gap,
    /// The tests that were made, with their probabilities.
    pub tests: Vec<(&'static str, f64)>,
}

impl Misfit {
    /// By how much the curve is off, and which tests reject it.
    pub fn words(&self) -> String {
        let Misfit { gap: Gap { predicted, observed }, tests } = self;
        let tests = tests.iter().map(|(test, p)| format!("{test} p {p:.0e}")).collect::<Vec<_>>().join(", ");
        format!(
            "P_ro fits its own cases badly: where it predicts {predicted:.3}, {observed:.3} overturned ({tests}); low and high do not hold this error"
        )
    }
}

/// A difference in eta that the response hardly feels.
const SAME_ETA: f64 = 0.005;

impl ChosenFits {
    /// The probabilities at an intensity, with limits by the replicates if there are any.
    pub fn probabilities(&self, measures: &IntensityMeasures) -> Probabilities {
        let probabilities = self.model.probabilities(measures);
        let Some(resampled) = &self.resampled else { return probabilities };
        let given_rocking = probabilities.given_rocking.map(|given| resampled.with_limits(&given, measures));
        Probabilities { given_rocking, ..probabilities }
    }

    /// How the limits come about, and what they do not hold, in words.
    pub fn words_of_limits(&self) -> String {
        let by = self.way_of_limits();
        if self.misfit.is_some() {
            format!("{by}, of the fitted model alone, which its tests reject")
        } else {
            by
        }
    }

    fn way_of_limits(&self) -> String {
        match &self.resampled {
            None => "by the delta method".to_string(),
            Some(ResampledModel { replicates, limits: ReplicateLimits::Percentile }) => {
                format!("percentiles of {} resamples", replicates.len())
            }
            Some(ResampledModel { replicates, limits: ReplicateLimits::BiasCorrected }) => {
                format!("bias-corrected percentiles of {} resamples", replicates.len())
            }
        }
    }

    /// That the limits come from resamples of too few events.
    pub fn warn_of_few_events(&self, console: &Console) {
        if self.resampled.is_some() && self.few_events {
            console.warn("P_ro comes from fewer than 10 events, or non-events, for each coefficient: where it is small, limits by resamples are too narrow, those of --limits delta are not");
        }
    }

    /// Warns that the tests of the curve reject it, and by how much it is off.
    pub fn warn_of_misfit(&self, console: &Console) {
        if let Some(misfit) = &self.misfit {
            console.warn(&misfit.words());
        }
    }

    /// In words: of what, over which measures.
    pub fn words(&self) -> String {
        let model = &self.model;
        let of = |measures: &mut dyn Iterator<Item = Measure>| {
            measures.map(Keyword::as_str).collect::<Vec<_>>().join(" and ")
        };
        let demand = of(&mut model.demand.at_strong_motion().ln_median.measures());
        let planes = match model.demand {
            DemandModel::Everywhere(_) => String::new(),
            DemandModel::Biplanar { transition, .. } => {
                format!(" in two planes that meet at im4 {transition}")
            }
        };
        let overturning = of(&mut model.overturning.measures());
        let suite = self.suite.as_deref().map_or(String::new(), |suite| format!(", {suite}"));
        format!("{}{suite}: P_ex of {demand}{planes}, P_ro of {overturning}", self.structure)
    }

    /// What a limit state is, in words.
    pub fn meaning(&self, state: LimitState) -> String {
        match state {
            LimitState::Rocking => "rocking".to_string(),
            LimitState::Failure => format!("|theta|max / alpha above {}, or overturning", self.model.limit),
            LimitState::Overturning => "overturning".to_string(),
        }
    }

    /// Warns if the structure is not the one that was simulated: by what is known of such transfers, or of its eta.
    pub fn warn_of_structure(&self, structure: &Structure, console: &Console) {
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

    /// That these measures, of what `subject` says, lie outside of the data.
    pub fn warn_of_range(&self, measures: &IntensityMeasures, subject: &str, console: &Console) {
        let mut outside: Vec<OutOfRange> = self.model.out_of_range(measures).collect();
        outside.dedup_by_key(|out| out.measure);
        for OutOfRange { measure, value, range: [least, largest] } in outside {
            console.warn(&format!(
                "{subject}{} is {value:.4}, outside of {least:.4} to {largest:.4} in the data: extrapolated",
                measure.as_str()
            ));
        }
    }

    /// That the p PGV / PGA of a slice lies outside of the data, or that it goes up `to` an intensity above them.
    pub fn warn_of_slice(&self, slice: &Slice, to: f64, subject: &str, console: &Console) {
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

    /// Whether a structure has another slenderness or size than the one that was simulated.
    pub fn is_other_block(&self, structure: &Structure) -> bool {
        self.block.is_some_and(|block| transfers::is_other_block(block, structure))
    }

    /// Whether this coefficient of restitution is another one than that of the fits.
    pub fn is_other_eta(&self, eta: f64) -> bool {
        (eta - self.model.eta).abs() > SAME_ETA
    }
}
