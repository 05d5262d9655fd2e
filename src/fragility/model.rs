//! The fragility of a structure: P_nr, P_ex and P_ro joined in the tree of Eq. 12.

use super::case::Measure;
use super::predictor::{OutOfRange, Predicted, Predictor};
use super::probability::{Probability, ProbitIndex};
use super::probability::{p_exceeding, p_failure_given_rocking, p_no_rocking};
use crate::keyword::keywords;
use crate::motion::IntensityMeasures;
use crate::normal;

/// The demand in safe rocking: ln EDP on the measures, and its dispersion (Eqs. 15 and 17).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DemandLaw {
    /// ln of the median demand.
    pub ln_median: Predictor,
    /// Dispersion: the residual standard deviation.
    pub beta: f64,
    /// Degrees of freedom of that standard deviation.
    pub degrees: f64,
}

impl DemandLaw {
    /// The index of P_ex (Eq. 14); none where a measure is missing.
    pub fn exceeding(&self, measures: &IntensityMeasures, limit: f64) -> Option<ProbitIndex> {
        let Predicted { value, variance } = self.ln_median.at(measures)?;
        Some(ProbitIndex::of_exceeding(value, variance, limit, self.beta, self.degrees))
    }
}

/// How the demand depends on the intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "few are held at once")]
pub enum DemandModel {
    /// One law everywhere (Eqs. 15 and 16).
    Everywhere(DemandLaw),
    /// One below an IM4 and one from there on (Eqs. 17 and 18).
    Biplanar {
        /// The IM4 at which they meet.
        transition: f64,
        /// Below it.
        low: DemandLaw,
        /// From it on.
        high: DemandLaw,
    },
}

impl DemandModel {
    /// The law that holds far above uplift.
    pub fn at_strong_motion(&self) -> &DemandLaw {
        match self {
            DemandModel::Everywhere(law) | DemandModel::Biplanar { high: law, .. } => law,
        }
    }

    /// The law that holds at this intensity.
    pub fn law(&self, measures: &IntensityMeasures) -> &DemandLaw {
        match self {
            DemandModel::Everywhere(law) => law,
            DemandModel::Biplanar { transition, low, .. } if measures.im4 < *transition => low,
            DemandModel::Biplanar { high, .. } => high,
        }
    }
}

/// Whether a measure outside of the range lies where there are no data. IM4 has no lower end: whatever rocks is at or above
/// uplift, and so are the data.
pub(crate) fn has_no_data(out: &OutOfRange) -> bool {
    out.measure != Measure::Im4 || out.value > out.range[1]
}

/// All that is fitted to one structure and suite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FragilityModel {
    /// P_ex.
    pub demand: DemandModel,
    /// The demand |theta|max / alpha that P_ex is about.
    pub limit: f64,
    /// P_ro: the probit index (ln IM - mu) / beta (Eq. 20; of a hybrid Eq. 24).
    pub overturning: Predictor,
    /// Coefficient of restitution of the structure that was simulated: the curves do not know any other.
    pub eta: f64,
}

/// Probabilities at one intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probabilities {
    /// No rocking.
    pub p_nr: f64,
    /// Given rocking; none where IM4 rules rocking out, or a measure is missing.
    pub given_rocking: Option<GivenRocking>,
}

/// Probabilities given that the structure rocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GivenRocking {
    /// Demand above the limit, in safe rocking.
    pub p_ex: Probability,
    /// Overturning.
    pub p_ro: Probability,
    /// Failure, the one or the other (Eq. 12).
    pub p_failure: Probability,
}

/// How far a structure goes, each state within the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitState {
    /// Rocking.
    Rocking,
    /// Demand above the limit, or overturning.
    Failure,
    /// Overturning.
    Overturning,
}

keywords!(LimitState { Rocking = "LS1", Failure = "LS2", Overturning = "LS3" });

impl Probabilities {
    /// That each limit state is reached, in the order of [`LimitState::ALL`], over the whole tree: exactly 0 without
    /// rocking. None where a measure is missing.
    pub fn limit_states(&self) -> Option<[Probability; 3]> {
        let rocking = Probability::exact(1.0 - self.p_nr);
        if self.p_nr == 1.0 {
            return Some([rocking; 3]);
        }
        self.given_rocking.map(|given| [rocking, given.p_failure, given.p_ro])
    }
}

impl FragilityModel {
    /// The probabilities at an intensity.
    pub fn probabilities(&self, measures: &IntensityMeasures) -> Probabilities {
        let p_nr = p_no_rocking(measures.im4);
        Probabilities { p_nr, given_rocking: if p_nr == 0.0 { self.given_rocking(measures) } else { None } }
    }

    /// P_ex, P_ro and the probability of failure (Eq. 12) given rocking, without limits; none where a measure is missing.
    pub(crate) fn given(&self, measures: &IntensityMeasures) -> Option<[f64; 3]> {
        let law = self.demand.law(measures);
        let p_ex = p_exceeding(law.ln_median.at(measures)?.value, self.limit, law.beta);
        let p_ro = normal::cdf(self.overturning.at(measures)?.value);
        Some([p_ex, p_ro, p_failure_given_rocking(p_ro, p_ex)])
    }

    fn given_rocking(&self, measures: &IntensityMeasures) -> Option<GivenRocking> {
        let exceeding = self.demand.law(measures).exceeding(measures, self.limit)?;
        let index = self.overturning.at(measures)?;
        let overturning = ProbitIndex { value: index.value, standard_error: index.variance.sqrt() };
        let (p_ex, p_ro) = (exceeding.probability(), overturning.probability());
        Some(GivenRocking { p_ex, p_ro, p_failure: Probability::of_failure(p_ro, p_ex) })
    }

    /// The measures that lie outside of the range of the data, of P_ex and of P_ro; none without rocking, which needs no
    /// data.
    pub fn out_of_range(&self, measures: &IntensityMeasures) -> impl Iterator<Item = OutOfRange> {
        self.demand_out_of_range(measures).chain(self.overturning_out_of_range(measures))
    }

    /// Those of P_ex.
    pub(crate) fn demand_out_of_range(
        &self,
        measures: &IntensityMeasures,
    ) -> impl Iterator<Item = OutOfRange> {
        out_of_range(&self.demand.law(measures).ln_median, measures)
    }

    /// Those of P_ro.
    pub(crate) fn overturning_out_of_range(
        &self,
        measures: &IntensityMeasures,
    ) -> impl Iterator<Item = OutOfRange> {
        out_of_range(&self.overturning, measures)
    }

    /// The same for many magnitudes and distances, among which their differences average out.
    pub fn over_many_cells(mut self) -> FragilityModel {
        self.overturning.spread = 0.0;
        match &mut self.demand {
            DemandModel::Everywhere(law) => law.ln_median.spread = 0.0,
            DemandModel::Biplanar { low, high, .. } => {
                (low.ln_median.spread, high.ln_median.spread) = (0.0, 0.0);
            }
        }
        self
    }

    /// Where P_ex jumps from one law to the other.
    pub fn transition_im4(&self) -> Option<f64> {
        match self.demand {
            DemandModel::Everywhere(_) => None,
            DemandModel::Biplanar { transition, .. } => Some(transition),
        }
    }
}

fn out_of_range(fit: &Predictor, measures: &IntensityMeasures) -> impl Iterator<Item = OutOfRange> {
    let rocks = p_no_rocking(measures.im4) == 0.0;
    let out = fit.out_of_range(measures);
    out.filter(move |out| rocks && has_no_data(out))
}
