//! Annual rates over the hazard of a site.

use serde::{Deserialize, Serialize};

use super::object::Predicted;
use crate::fragility::{Cases, Event, GivenPeak, Kind, Model, Peak, Ratio};
use crate::hazard::{CountedMotion, CountedRate, HazardCurve, Rate};
use crate::hazard::{
    counted_rate, median_intensity, probability_in_years, rates_over_curve, rates_over_pairs,
};
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::rocking::Structure;
use crate::stages::shared::hazard::Hazard;
use crate::units::G_M_S2;
use crate::warning::Warning;

/// The hazard, and how rates over it are computed.
pub struct Site {
    pub hazard: Hazard,
    pub years: f64,
    pub ratio: Ratio,
    pub extrapolate: bool,
    /// Demand |theta|max / alpha beyond which it rocks too far.
    pub limit_state: f64,
    /// Responses to count in, of each suite and structure.
    pub responses: Option<Vec<Cases>>,
}

/// Annual rates of an object, and probabilities in the time of exposure. Where the hazard ends too early for
/// a value there are bounds alone, in the columns of limits.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RatesRow {
    pub rocking_per_year: Option<f64>,
    pub failure_per_year: Option<f64>,
    pub failure_per_year_low: Option<f64>,
    pub failure_per_year_high: Option<f64>,
    pub overturning_per_year: Option<f64>,
    pub overturning_per_year_low: Option<f64>,
    pub overturning_per_year_high: Option<f64>,
    pub return_period_years: Option<f64>,
    pub years: Option<f64>,
    pub p_rocking: Option<f64>,
    pub p_failure: Option<f64>,
    pub p_failure_low: Option<f64>,
    pub p_failure_high: Option<f64>,
    pub p_overturning: Option<f64>,
    pub p_overturning_low: Option<f64>,
    pub p_overturning_high: Option<f64>,
    /// With PGV / PGA a standard deviation below its median, and above.
    pub overturning_per_year_less_velocity: Option<f64>,
    pub overturning_per_year_more_velocity: Option<f64>,
    pub counted_motions: Option<i64>,
    pub counted_per_year: Option<f64>,
    pub counted_per_year_low: Option<f64>,
    pub counted_per_year_high: Option<f64>,
    pub warnings: Option<String>,
}

/// PGA of a curve (m/s2) and PGV (m/s) beyond which nothing was ever recorded: it cannot end too early.
const STRONGEST: [f64; 2] = [4.5 * G_M_S2, 5.0];
/// Share of a rate that stronger motions than the last may add before it is no value.
const NEGLIGIBLE: f64 = 0.1;
/// Rate a year at which no site has 1 g or 1 m/s, and by which power of the peak it falls: a hundred times
/// less than 0.1 g once a year.
const IMPLAUSIBLE: (f64, f64) = (0.02, 1.7);
/// The seed of the resamples of a count.
const SEED: u64 = 1;

impl Site {
    /// Refuses options that a joint hazard has no use for.
    pub fn check(&self, ratio: Option<f64>) -> anyhow::Result<()> {
        match (&self.hazard, ratio, self.extrapolate) {
            (Hazard::Joint(_), Some(_), _) => {
                Err(UsageError::because("ratio: the hazard has PGA and PGV of each motion"))
            }
            (Hazard::Joint(_), _, true) => {
                Err(UsageError::because("extrapolate: expected a hazard curve of one peak"))
            }
            _ => Ok(()),
        }
    }

    /// Whether strong motions are more frequent than anywhere on earth.
    pub fn is_implausible(&self) -> bool {
        let exceeds = |one: f64, points: &[(f64, f64)]| {
            points.iter().any(|&(peak, rate)| rate >= IMPLAUSIBLE.0 * (peak / one).powf(-IMPLAUSIBLE.1))
        };
        match &self.hazard {
            Hazard::Curve(Peak::Pga, curve) => exceeds(G_M_S2, curve.points()),
            Hazard::Curve(Peak::Pgv, curve) => exceeds(1.0, curve.points()),
            Hazard::Joint(joint) => {
                exceeds(G_M_S2, &joint.exceedance(|bin| bin.pga_m_s2))
                    || exceeds(1.0, &joint.exceedance(|bin| bin.pgv_m_s))
            }
        }
    }

    /// The rates of a structure, and the measures of a motion that half of its rate of overturning is above.
    pub fn rates(
        &self,
        structure: &Structure,
        model: &Model,
        warnings: &mut Vec<Warning>,
    ) -> (RatesRow, IntensityMeasures) {
        let (row, peaks) = match &self.hazard {
            Hazard::Curve(peak, curve) => {
                let given_peak = GivenPeak { model, structure, peak: *peak, ratio: self.ratio };
                self.over_curve(&given_peak, curve, warnings)
            }
            Hazard::Joint(joint) => {
                let strongest = joint.bins.iter().max_by(|a, b| a.pga_m_s2.total_cmp(&b.pga_m_s2));
                let peaks = strongest.map_or([0.0; 2], |bin| [bin.pga_m_s2, bin.pgv_m_s]);
                (RatesRow::new(rates_over_pairs(model, structure, joint), self.years, false), peaks)
            }
        };
        (row, IntensityMeasures::new(structure, peaks[0], peaks[1], None, None))
    }

    fn over_curve(
        &self,
        given_peak: &GivenPeak,
        curve: &HazardCurve,
        warnings: &mut Vec<Warning>,
    ) -> (RatesRow, [f64; 2]) {
        let [(first, _), (last, _)] = curve.ends();
        let mut rates = rates_over_curve(given_peak, curve);
        let is_short = last < STRONGEST[usize::from(given_peak.peak == Peak::Pgv)]
            && rates[2].beyond > NEGLIGIBLE * rates[2].value;
        let extrapolated = (is_short && self.extrapolate).then(|| curve.extrapolated());
        if let Some(curve) = &extrapolated {
            rates = rates_over_curve(given_peak, curve);
            warnings.push(Warning::HazardExtrapolated);
        } else if is_short {
            warnings.push(Warning::HazardEndsEarly);
        }
        let curve = extrapolated.as_ref().unwrap_or(curve);
        if first > given_peak.uplift()[1] {
            warnings.push(Warning::HazardStartsLate);
        }
        let mut row = RatesRow::new(rates, self.years, is_short && extrapolated.is_none());
        if self.ratio == Ratio::Distributed && row.overturning_per_year.is_some() {
            let overturning = |z| rates_over_curve(&given_peak.with(Ratio::Deviations(z)), curve)[2].value;
            row.overturning_per_year_less_velocity = Some(overturning(-1.0));
            row.overturning_per_year_more_velocity = Some(overturning(1.0));
        }
        if let Some(count) = self.count(given_peak, curve) {
            row.counted_motions = Some(count.motions as i64);
            row.counted_per_year = Some(count.value);
            row.counted_per_year_low = Some(count.limits.low);
            row.counted_per_year_high = Some(count.limits.high);
        }
        (row, given_peak.median_motion(median_intensity(given_peak, curve)))
    }

    /// The rate of overturning, counted among the responses of this structure to this kind of motion.
    fn count(&self, given_peak: &GivenPeak, curve: &HazardCurve) -> Option<CountedRate> {
        let kind_of =
            |suite: &Option<String>| Kind::of(suite.as_deref().and_then(|suite| suite.parse().ok()));
        let kind = match given_peak.model {
            Model::Calibrated { overturning, .. } => overturning.kind,
            Model::Paper { overturning, .. } => kind_of(&overturning.suite),
        };
        let parameters = |structure: &Structure| [structure.p_rad_s, structure.alpha_rad, structure.eta];
        let is_same = |cases: &&Cases| {
            let pairs = parameters(&cases.structure).into_iter().zip(parameters(given_peak.structure));
            kind_of(&cases.suite) == kind && pairs.into_iter().all(|(a, b)| (a / b - 1.0).abs() < 0.01)
        };
        let cases = self.responses.iter().flatten().find(is_same)?;
        let motion = |case: usize| CountedMotion {
            intensity: if given_peak.peak == Peak::Pga { cases.pga_m_s2[case] } else { cases.pgv_m_s[case] },
            event: cases.happened(case, Event::Overturning, self.limit_state) == Some(true),
            cluster: cases.cluster[case],
        };
        let motions: Vec<CountedMotion> = (0..cases.len()).map(motion).collect();
        // Weaker motions uplift nothing.
        let least = match given_peak.peak {
            Peak::Pga => given_peak.structure.uplift_acceleration_m_s2(),
            Peak::Pgv => given_peak.uplift()[0],
        };
        counted_rate(curve, least, motions, SEED)
    }
}

impl RatesRow {
    /// Of rates of rocking, failure and overturning; `is_short` where the hazard ends too early for values.
    fn new([rocking, failure, overturning]: [Rate; 3], years: f64, is_short: bool) -> RatesRow {
        let known = |rate: f64| Some(rate).filter(|rate| !rate.is_nan());
        let is_rocking_known = !is_short || rocking.beyond <= NEGLIGIBLE * rocking.value;
        let rocking = known(rocking.value).filter(|_| is_rocking_known);
        let values = |rate: Rate| match is_short {
            true => [None, known(rate.low), known(rate.high.max(rate.value + rate.beyond))],
            false => [known(rate.value), known(rate.low), known(rate.high)],
        };
        let ([failure, failure_low, failure_high], [value, low, high]) =
            (values(failure), values(overturning));
        let p = |rate: Option<f64>| rate.map(|rate| probability_in_years(rate, years));
        RatesRow {
            rocking_per_year: rocking,
            failure_per_year: failure,
            failure_per_year_low: failure_low,
            failure_per_year_high: failure_high,
            overturning_per_year: value,
            overturning_per_year_low: low,
            overturning_per_year_high: high,
            return_period_years: value.map(|rate| 1.0 / rate).filter(|years| years.is_finite()),
            years: Some(years),
            p_rocking: p(rocking),
            p_failure: p(failure),
            p_failure_low: p(failure_low),
            p_failure_high: p(failure_high),
            p_overturning: p(value),
            p_overturning_low: p(low),
            p_overturning_high: p(high),
            ..RatesRow::default()
        }
    }

    /// Rate of overturning with limits; limits alone are bounds.
    pub fn overturning(&self) -> [Option<f64>; 3] {
        [self.overturning_per_year, self.overturning_per_year_low, self.overturning_per_year_high]
    }

    /// The same of failure.
    pub fn failure(&self) -> [Option<f64>; 3] {
        [self.failure_per_year, self.failure_per_year_low, self.failure_per_year_high]
    }
}

impl Predicted for RatesRow {
    fn with_warnings(self, warnings: Option<String>) -> RatesRow {
        RatesRow { warnings, ..self }
    }

    fn severity(&self) -> f64 {
        self.overturning_per_year.or(self.overturning_per_year_high).unwrap_or(f64::NEG_INFINITY)
    }
}
