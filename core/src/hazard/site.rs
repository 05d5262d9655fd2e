//! Annual rates of an object at a site, with the uncertainty of the hazard and of the rate beyond its curve.

use super::budget::Budget;
use super::conditional_motions::{ConditionalMotions, SD_OF_INFERRED, unusual_motions};
use super::curve::HazardCurve;
use super::ground::unusual_ground;
use super::pgv_pga::{MatchError, PgvPgaRatio, VelocitySource, velocity_of_spectrum};
use super::rates::{OverCurve, PairOfPeaks, rates_over_curve, rates_over_pairs};
use crate::fragility::{AssumedMagnitude, LimitState, LimitStates, ModelPoint, Peak, RockingDirection};
use crate::motion::Peaks;
use crate::object::{LowHigh, RockingObject, UncertaintySource};
use crate::plausibility::{STRONGEST_PGA_G, STRONGEST_PGV_M_S};
use crate::statistics::Interval;
use crate::statistics::normal::Z_95;
use crate::units::G_M_S2;
use crate::warning::Warning;

/// How often motions come to a site, 1/year.
#[derive(Debug, Clone, PartialEq)]
pub enum Hazard {
    /// Annual rates of exceedance of one peak.
    Curve(PeakHazard),
    /// Annual rates of occurrence of pairs of peaks: bins in any order; empty ones may be left out.
    Joint(Vec<PairOfPeaks>),
}

/// The hazard curve of PGA or PGV, and what the hazard study says besides.
#[derive(Debug, Clone, PartialEq)]
pub struct PeakHazard {
    pub peak: Peak,
    /// Over m/s2 or m/s.
    pub curve: HazardCurve,
    /// What is known against its curves: a median in place of a mean, unusual ground.
    pub warnings: Vec<Warning>,
    /// The 16 and 84 % fractiles.
    pub fractiles: Option<[HazardCurve; 2]>,
    /// PGV / PGA, by the curve of the other peak or as the user gives it; none for that of generic sites.
    pub pgv_pga: Option<PgvPgaRatio>,
}

impl Hazard {
    /// By curves of PGA and of the spectral acceleration at 1 s (m/s2), from which PGV is inferred.
    ///
    /// # Errors
    /// If they cannot be of one site.
    pub fn with_spectrum(curve: HazardCurve, sa_1s: &HazardCurve) -> Result<Hazard, MatchError> {
        let pgv = velocity_of_spectrum(&curve, sa_1s);
        let pgv_pga = Some(PgvPgaRatio::by_curves(&curve, &pgv, VelocitySource::Sa)?);
        let warnings = unusual_ground(&curve, sa_1s).into_iter().collect();
        Ok(Hazard::Curve(PeakHazard { peak: Peak::Pga, curve, warnings, fractiles: None, pgv_pga }))
    }

    /// PGV / PGA is that of generic sites.
    pub fn over(peak: Peak, curve: HazardCurve) -> Hazard {
        Hazard::Curve(PeakHazard { peak, curve, warnings: vec![], fractiles: None, pgv_pga: None })
    }
}

/// The least annual rate whose logarithm is taken: once in 1e12 years.
pub(super) const LEAST: f64 = 1e-12;

/// The upper limit of a rate over the lower, by motions beyond the hazard curve, above which it ends too early.
const EARLY: f64 = 1.2;

/// PGA (m/s2) or PGV (m/s) beyond which nothing was ever recorded: a curve that reaches it cannot end too
/// early.
pub fn strongest(peak: Peak) -> f64 {
    match peak {
        Peak::Pga => STRONGEST_PGA_G * G_M_S2,
        Peak::Pgv => STRONGEST_PGV_M_S,
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    pub hazard: Hazard,
    /// Mean magnitude of the disaggregation: of SA(1.0 s) where that curve is given, else of PGA; not used
    /// with PGV alone. Without it, see [`SiteRates::magnitude`].
    pub mw: Option<f64>,
    pub vs30_m_s: Option<f64>,
}

/// Annual rates of an object, with 95 % limits; empty where the model has no probability. A curve is continued
/// beyond its last point by its last slope; the limits range from no motion there having the effect to each
/// having it.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteRates {
    pub states: LimitStates<Interval<Option<f64>>>,
    /// Standard deviations of ln of the rate of overturning, by source.
    pub budget: Budget,
    /// Source of PGV / PGA; none where the hazard has both peaks of each motion.
    pub pgv_pga_source: Option<VelocitySource>,
    /// Share of the rate of overturning beyond the last point of a curve.
    pub beyond: Option<f64>,
    /// A motion above which half of the rate of overturning lies; of a joint hazard the strongest.
    pub motion: Peaks,
    /// None where nothing depends on it, or each motion has its own.
    pub magnitude: Option<AssumedMagnitude>,
    pub warnings: Vec<Warning>,
}

/// Rates with all that is uncertain at its median, and with each source at its quantiles.
struct RateSensitivity {
    rates: LimitStates<Option<Interval>>,
    at_quantiles: Vec<LowHigh<LimitStates<Option<Interval>>>>,
}

impl Site {
    pub fn new(hazard: Hazard) -> Site {
        Site { hazard, mw: None, vs30_m_s: None }
    }

    /// With what is known besides its hazard; PGV / PGA in s.
    ///
    /// # Errors
    /// If the hazard itself gives PGV / PGA.
    pub fn about(
        mut hazard: Hazard,
        mw: Option<f64>,
        vs30_m_s: Option<f64>,
        ratio_s: Option<f64>,
    ) -> Result<Site, &'static str> {
        match &mut hazard {
            Hazard::Curve(PeakHazard { pgv_pga: known @ None, .. }) => {
                *known = ratio_s.map(PgvPgaRatio::given)
            }
            _ if ratio_s.or(vs30_m_s).is_some() => {
                return Err("ratio, vs30: the hazard itself gives PGV/PGA");
            }
            _ => {}
        }
        Ok(Site { hazard, mw, vs30_m_s })
    }

    /// Mean annual rates, 1/year, with 95 % limits; see [`SiteRates`] for what is none.
    pub fn rates(&self, object: &RockingObject) -> SiteRates {
        match &self.hazard {
            Hazard::Curve(hazard) => self.rates_over_curve(hazard, object),
            Hazard::Joint(bins) => {
                let points = ModelPoint::at_errors(&object.directions);
                let all = rates_over_pairs(&object.directions, self.mw, bins, &points);
                let rates = |directions: &[RockingDirection], point| {
                    rates_over_pairs(directions, self.mw, bins, &[point])[0]
                };
                let mut at_quantiles =
                    object.at_quantiles(|directions| rates(directions, ModelPoint::Estimate));
                let strongest = bins.iter().max_by(|a, b| a.peaks.pga_m_s2.total_cmp(&b.peaks.pga_m_s2));
                let motion = strongest.map_or(Peaks::default(), |bin| bin.peaks);
                let mut magnitude = self.mw.map(AssumedMagnitude::given);
                if bins.iter().any(|bin| bin.mw.or(self.mw).is_none()) {
                    at_quantiles.push(
                        LowHigh::normal(UncertaintySource::Magnitude, SD_OF_INFERRED)
                            .map(|off| rates(&object.directions, ModelPoint::Magnitude(*off))),
                    );
                    magnitude = object.directions[0].model.inferred_magnitude(motion);
                }
                let warnings = unusual_motions(self.mw, None).collect();
                let rates = RateSensitivity::new(all, at_quantiles).with_limits(motion);
                SiteRates { magnitude, warnings, ..rates }
            }
        }
    }

    /// The value of [`Site::rates`] alone.
    pub fn overturning(&self, object: &RockingObject) -> Option<f64> {
        let rates = match &self.hazard {
            Hazard::Joint(bins) => {
                rates_over_pairs(&object.directions, self.mw, bins, &[ModelPoint::Estimate])[0]
            }
            Hazard::Curve(hazard) => {
                let given = self.motions(hazard, object).given(&object.directions, 0.0);
                rates_over_curve(&given, &hazard.curve)
            }
        };
        Some(rates.overturning?.value)
    }

    /// What is not given of the motions is at its median.
    pub(super) fn motions(&self, hazard: &PeakHazard, object: &RockingObject) -> ConditionalMotions {
        let by_model = || PgvPgaRatio::by_model(&object.directions[0].model, hazard.peak, self.vs30_m_s);
        let pgv_pga = hazard.pgv_pga.unwrap_or_else(by_model);
        ConditionalMotions::at_site(hazard.peak, pgv_pga, self.mw)
    }

    fn rates_over_curve(&self, hazard: &PeakHazard, object: &RockingObject) -> SiteRates {
        let motions = self.motions(hazard, object);
        let middle = motions.given(&object.directions, 0.0);
        let points = ModelPoint::at_errors(&object.directions);
        let over = OverCurve::new(&middle, &hazard.curve, &points);
        let mut at_quantiles = motions
            .at_quantiles(object, |given, point| OverCurve::new(given, &hazard.curve, &[point]).rates(0));
        if let Some([low, high]) = &hazard.fractiles {
            let fractiles = LowHigh { source: UncertaintySource::Hazard, low, high };
            at_quantiles.push(fractiles.map(|curve| rates_over_curve(&middle, curve)));
        }
        let by_point: Vec<_> = (0..points.len()).map(|point| over.rates(point)).collect();
        let rate = by_point[0].overturning.unwrap_or_default();
        let motion = middle.peaks(over.median_intensity(), 0.0);
        let [(first, _), _] = hazard.curve.ends();
        let vs30_m_s = self.vs30_m_s.filter(|_| hazard.pgv_pga.is_none());
        let warnings = [
            (rate.high > EARLY * rate.low).then_some(Warning::HazardEndsEarly),
            (first > middle.uplift().usual).then_some(Warning::HazardStartsLate),
        ];
        SiteRates {
            pgv_pga_source: Some(motions.pgv_pga.source),
            beyond: (rate.value > 0.0).then(|| 1.0 - rate.low / rate.value),
            magnitude: motions.magnitude(&object.directions[0].model, motion),
            warnings: warnings
                .into_iter()
                .flatten()
                .chain(hazard.warnings.iter().copied())
                .chain(unusual_motions(self.mw, vs30_m_s))
                .collect(),
            ..RateSensitivity::new(by_point, at_quantiles).with_limits(motion)
        }
    }
}

impl RateSensitivity {
    /// `by_point` are the rates at [`ModelPoint::at_errors`], `at_quantiles` those of other sources.
    fn new(
        by_point: Vec<LimitStates<Option<Interval>>>,
        mut at_quantiles: Vec<LowHigh<LimitStates<Option<Interval>>>>,
    ) -> RateSensitivity {
        at_quantiles.extend(LowHigh::from_fit_errors(&by_point));
        RateSensitivity { rates: by_point[0], at_quantiles }
    }

    fn with_limits(&self, motion: Peaks) -> SiteRates {
        SiteRates {
            states: LimitStates {
                rocking: self.limited(LimitState::Rocking),
                failure: self.limited(LimitState::Failure),
                overturning: self.limited(LimitState::Overturning),
            },
            budget: self.budget(LimitState::Overturning),
            pgv_pga_source: None,
            beyond: None,
            motion,
            magnitude: None,
            warnings: Vec::new(),
        }
    }

    fn limited(&self, state: LimitState) -> Interval<Option<f64>> {
        let Some((rate, rocking)) = self.rates.get(state).zip(self.rates.rocking) else {
            return Interval::default();
        };
        let limits = self.budget(state).limit_rate(rate.value, rocking.high);
        // Rates below the least have no logarithm.
        Interval { low: limits.low.min(rate.low), high: limits.high.max(rate.high), ..limits }.into()
    }

    /// Standard deviations of ln of a rate. Its limits by motions beyond the curve, which are for certain,
    /// count as 95 % limits.
    fn budget(&self, state: LimitState) -> Budget {
        let ln = |rates: &LimitStates<Option<Interval>>| {
            rates.get(state).map(|rate| rate.map(|rate| rate.max(LEAST).ln()))
        };
        let mut budget = Budget::new(&self.rates, &self.at_quantiles, |rates| Some(ln(rates)?.value));
        if let Some(Interval { value, low, high }) = ln(&self.rates) {
            let ends = LowHigh { source: UncertaintySource::Hazard, low, high };
            budget.add(ends.map(|end| (end - value) / Z_95));
        }
        budget
    }
}
