//! Annual rates of a structure at a site: the hazard as it is given, and what the ends of its curve leave
//! open.

use super::count::{CountedMotion, CountedRate, counted_rate};
use super::curve::HazardCurve;
use super::joint::JointHazard;
use super::rates::{Rate, Rates, median_intensity, rates_over_curve, rates_over_pairs};
use crate::fragility::{Cases, Event, GivenPeak, Kind, Model, Peak, Ratio};
use crate::number::Limited;
use crate::plausibility::{STRONGEST_PGA_G, STRONGEST_PGV_M_S};
use crate::rocking::Structure;
use crate::units::G_M_S2;
use crate::warning::Warning;

/// The hazard of a site.
#[derive(Debug, Clone, PartialEq)]
pub enum Hazard {
    /// Annual rates at which a peak is exceeded; m/s2 or m/s.
    Curve(Peak, HazardCurve),
    /// Annual rates at which pairs of peaks occur.
    Joint(JointHazard),
}

/// Fraction of a rate that stronger motions than the last may add before it is no value.
const NEGLIGIBLE: f64 = 0.1;
/// Rate a year at which no site has 1 g or 1 m/s, and by which power of the peak it falls: a hundred times
/// less than 0.1 g once a year.
const IMPLAUSIBLE: (f64, f64) = (0.02, 1.7);
/// The seed of the resamples of a count.
const SEED: u64 = 1;

/// PGA (m/s2) or PGV (m/s) beyond which nothing was ever recorded: a curve that reaches it cannot end too
/// early.
pub fn strongest(peak: Peak) -> f64 {
    match peak {
        Peak::Pga => STRONGEST_PGA_G * G_M_S2,
        Peak::Pgv => STRONGEST_PGV_M_S,
    }
}

impl Hazard {
    /// Whether strong motions are more frequent than anywhere on earth.
    pub fn is_implausible(&self) -> bool {
        let exceeds = |one: f64, points: &[(f64, f64)]| {
            points.iter().any(|&(peak, rate)| rate >= IMPLAUSIBLE.0 * (peak / one).powf(-IMPLAUSIBLE.1))
        };
        match self {
            Hazard::Curve(Peak::Pga, curve) => exceeds(G_M_S2, curve.points()),
            Hazard::Curve(Peak::Pgv, curve) => exceeds(1.0, curve.points()),
            Hazard::Joint(joint) => {
                exceeds(G_M_S2, &joint.exceedance(|bin| bin.pga_m_s2))
                    || exceeds(1.0, &joint.exceedance(|bin| bin.pgv_m_s))
            }
        }
    }
}

/// The hazard of a site, and how rates over it are computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    pub hazard: Hazard,
    pub ratio: Ratio,
    /// Whether a curve that ends too early is continued.
    pub extrapolate: bool,
    /// Demand |theta|max / alpha that is the limit state.
    pub limit_state: f64,
    /// Responses to count in, of each suite and structure.
    pub responses: Vec<Cases>,
}

/// Annual rates of a structure. Where the hazard ends too early for a value there are bounds alone.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteRates {
    pub rocking: Option<f64>,
    pub failure: Limited,
    pub overturning: Limited,
    /// Of overturning, with PGV / PGA a standard deviation below its median, and above.
    pub by_velocity: Option<[f64; 2]>,
    /// The rate of overturning, counted among the responses.
    pub counted: Option<CountedRate>,
    /// PGA and PGV (m/s2 and m/s) of a motion that half of the rate of overturning is above; of a joint hazard
    /// those of the strongest.
    pub motion: [f64; 2],
    pub warnings: Vec<Warning>,
}

impl Site {
    /// The rates of a structure.
    pub fn rates(&self, structure: &Structure, model: &Model) -> SiteRates {
        match &self.hazard {
            Hazard::Curve(peak, curve) => self.rates_of_curve(
                &GivenPeak { model, structure, peak: *peak, ratio: self.ratio, mw: None },
                curve,
            ),
            Hazard::Joint(joint) => {
                let strongest = joint.bins.iter().max_by(|a, b| a.pga_m_s2.total_cmp(&b.pga_m_s2));
                let motion = strongest.map_or([0.0; 2], |bin| [bin.pga_m_s2, bin.pgv_m_s]);
                SiteRates::new(rates_over_pairs(model, structure, None, joint), false, motion)
            }
        }
    }

    fn rates_of_curve(&self, given_peak: &GivenPeak, curve: &HazardCurve) -> SiteRates {
        let [(first, _), (last, _)] = curve.ends();
        let mut warnings = Vec::new();
        let mut rates = rates_over_curve(given_peak, curve);
        let is_short = last < strongest(given_peak.peak) && rates[2].beyond > NEGLIGIBLE * rates[2].value;
        let extrapolated = (is_short && self.extrapolate).then(|| curve.extrapolated());
        if let Some(curve) = &extrapolated {
            rates = rates_over_curve(given_peak, curve);
            warnings.push(Warning::HazardExtrapolated);
        } else if is_short {
            warnings.push(Warning::HazardEndsEarly);
        }
        let is_short = is_short && extrapolated.is_none();
        let curve = extrapolated.as_ref().unwrap_or(curve);
        if first > given_peak.uplift()[1] {
            warnings.push(Warning::HazardStartsLate);
        }
        let motion = given_peak.median_motion(median_intensity(given_peak, curve));
        let mut rates = SiteRates { warnings, ..SiteRates::new(rates, is_short, motion) };
        if self.ratio == Ratio::Distributed && rates.overturning[0].is_some() {
            let with = |deviations| {
                rates_over_curve(&given_peak.with(Ratio::Deviations(deviations)), curve)[2].value
            };
            rates.by_velocity = Some([-1.0, 1.0].map(with));
        }
        SiteRates { counted: self.count(given_peak, curve), ..rates }
    }

    /// The rate of overturning, counted among the responses of this structure to this kind of motion.
    fn count(&self, given_peak: &GivenPeak, curve: &HazardCurve) -> Option<CountedRate> {
        let kind_of =
            |suite: &Option<String>| Kind::of(suite.as_deref().and_then(|suite| suite.parse().ok()));
        let kind = match given_peak.model {
            Model::Calibrated { overturning, .. } => overturning.kind,
            Model::Paper { overturning, .. } => kind_of(&overturning.suite),
        };
        let is_same =
            |cases: &&Cases| kind_of(&cases.suite) == kind && given_peak.structure.is_like(&cases.structure);
        let cases = self.responses.iter().find(is_same)?;
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

impl SiteRates {
    /// Of the rates of the limit states; `is_short` where the hazard ends too early for values.
    fn new([rocking, failure, overturning]: Rates, is_short: bool, motion: [f64; 2]) -> SiteRates {
        let known = |rate: f64| Some(rate).filter(|rate| !rate.is_nan());
        let limited = |rate: Rate| match is_short {
            true => [None, known(rate.low), known(rate.high.max(rate.value + rate.beyond))],
            false => [known(rate.value), known(rate.low), known(rate.high)],
        };
        let is_rocking_known = !is_short || rocking.beyond <= NEGLIGIBLE * rocking.value;
        SiteRates {
            rocking: known(rocking.value).filter(|_| is_rocking_known),
            failure: limited(failure),
            overturning: limited(overturning),
            by_velocity: None,
            counted: None,
            motion,
            warnings: Vec::new(),
        }
    }
}
