//! Annual rates of a structure at a site: the hazard as it is given, what is not known of it, and what the
//! ends of its curve leave open.

use super::budget::Budget;
use super::count::{CountedMotion, CountedRate, counted_rate};
use super::curve::HazardCurve;
use super::pgv_pga::{PgvPgaRatio, VelocitySource, magnitude};
use super::rates::{AnnualRate, PairOfPeaks, Rate, median_intensity, rates_over_curve, rates_over_pairs};
use crate::fragility::{Case, Cases, Direction, GivenPeak, Kind, LimitStates, Peak};
use crate::motion::Peaks;
use crate::object::{Part, Subject, Unknown};
use crate::plausibility::{STRONGEST_PGA_G, STRONGEST_PGV_M_S};
use crate::rocking::Outcome;
use crate::units::G_M_S2;
use crate::warning::Warning;

/// The hazard of a site.
#[derive(Debug, Clone, PartialEq)]
pub enum Hazard {
    /// Annual rates at which one peak is exceeded.
    Curve(PeakHazard),
    /// Annual rates at which pairs of peaks occur: bins in any order; those without motions may be left out.
    Joint(Vec<PairOfPeaks>),
}

/// Annual rates at which a peak is exceeded.
#[derive(Debug, Clone, PartialEq)]
pub struct PeakHazard {
    /// The peak.
    pub peak: Peak,
    /// Annual rates of exceedance, over m/s2 or m/s.
    pub curve: HazardCurve,
    /// The 16 and 84 % fractiles, if they are given.
    pub fractiles: Option<[HazardCurve; 2]>,
    /// PGV / PGA, by the curve of the other peak or as the user gives it.
    pub velocity: Option<PgvPgaRatio>,
}

impl Hazard {
    /// Makes the hazard of a curve of one peak; PGV / PGA is that of sites in general.
    pub fn over(peak: Peak, curve: HazardCurve) -> Hazard {
        Hazard::Curve(PeakHazard { peak, curve, fractiles: None, velocity: None })
    }
}

/// Fraction of a rate that stronger motions than the last may add before it is no value.
const NEGLIGIBLE: f64 = 0.1;
/// Rates a year of less count as this, once in 1e12 years, where errors are measured.
const LEAST: f64 = 1e-12;
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

/// The hazard of a site, and how rates over it are computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// The hazard.
    pub hazard: Hazard,
    /// Mean magnitude of the disaggregation: of SA(1.0 s) where that curve is given, else of PGA; not used
    /// with PGV alone. Where it is not known, the median is 6.35 and its standard deviation 0.6.
    pub mw: Option<f64>,
    /// Vs30, m/s.
    pub vs30_m_s: Option<f64>,
    /// Whether to extrapolate a curve that ends too early.
    pub extrapolate: bool,
    /// Responses in which to count overturning beside the rate; may be empty.
    pub responses: Vec<Cases>,
}

/// Annual rates of an object; none where the model has no probability.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct SiteRates {
    pub rocking: Option<AnnualRate>,
    pub failure: Option<AnnualRate>,
    pub overturning: Option<AnnualRate>,
    /// Standard deviations of ln of the rate of overturning, by what is not known.
    pub errors: Budget,
    /// Source of PGV / PGA; none where the hazard has both peaks of each motion.
    pub velocity: Option<VelocitySource>,
    /// The share of the rate of overturning beyond the last point of a curve that is extrapolated.
    pub beyond: Option<f64>,
    /// The rate of overturning, counted among the responses.
    pub counted: Option<CountedRate>,
    /// PGA and PGV (m/s2 and m/s) of a motion above which half of the rate of overturning lies; of a joint
    /// hazard those of the strongest.
    pub motion: Peaks,
    pub warnings: Vec<Warning>,
}

/// Rates with all at its median, and with each unknown at its quantiles.
struct Varied {
    rates: LimitStates<Rate>,
    ends: Vec<Unknown<LimitStates<Rate>>>,
}

impl Site {
    /// Makes a site of which only the hazard is known.
    pub fn new(hazard: Hazard) -> Site {
        Site { hazard, mw: None, vs30_m_s: None, extrapolate: false, responses: Vec::new() }
    }

    /// Computes the annual rates of an object, with limits.
    pub fn rates(&self, subject: &Subject) -> SiteRates {
        match &self.hazard {
            Hazard::Curve(hazard) => self.rates_over_curve(hazard, subject),
            Hazard::Joint(bins) => {
                let rates = |directions: &[Direction]| rates_over_pairs(directions, self.mw, bins);
                let varied =
                    Varied { rates: rates(&subject.directions), ends: ends_of_subject(subject, rates) };
                let strongest = bins.iter().max_by(|a, b| a.peaks.pga_m_s2.total_cmp(&b.peaks.pga_m_s2));
                let motion = strongest.map_or(Peaks { pga_m_s2: 0.0, pgv_m_s: 0.0 }, |bin| bin.peaks);
                varied.with_limits(motion, false)
            }
        }
    }

    /// Computes the annual rate of overturning alone; none where the hazard ends too early for it.
    pub fn overturning(&self, subject: &Subject) -> Option<f64> {
        let rate = match &self.hazard {
            Hazard::Joint(bins) => rates_over_pairs(&subject.directions, self.mw, bins).overturning.value,
            Hazard::Curve(hazard) => {
                let given = self.motions(hazard, subject).given(&subject.directions, 0.0, None);
                let rate = rates_over_curve(&given, &hazard.curve).overturning;
                match (ends_early(hazard, &rate), self.extrapolate) {
                    (false, _) => rate.value,
                    (true, false) => return None,
                    (true, true) => rates_over_curve(&given, &hazard.curve.extrapolated()).overturning.value,
                }
            }
        };
        Some(rate).filter(|rate| !rate.is_nan())
    }

    /// The motions of a curve of one peak, with all that is not given of them at its median.
    pub(super) fn motions(&self, hazard: &PeakHazard, subject: &Subject) -> Motions {
        let of_model = || PgvPgaRatio::of_model(&subject.directions[0].model, hazard.peak, self.vs30_m_s);
        let velocity = hazard.velocity.unwrap_or_else(of_model);
        let given = self.mw.filter(|_| hazard.peak == Peak::Pga);
        let [above, sd] = velocity.above_mean();
        let (median, unknown) = magnitude(given, Some(sd));
        let above = given.map_or(0.0, |_| above);
        Motions { peak: hazard.peak, velocity, given, above, median, unknown }
    }

    fn rates_over_curve(&self, hazard: &PeakHazard, subject: &Subject) -> SiteRates {
        let (directions, motions) = (&subject.directions[..], self.motions(hazard, subject));
        let middle = motions.given(directions, 0.0, None);
        let as_given = rates_over_curve(&middle, &hazard.curve);
        let ends_early = ends_early(hazard, &as_given.overturning);
        let is_extrapolated = ends_early && self.extrapolate;
        let [curve, low, high] = match &hazard.fractiles {
            Some([low, high]) => [&hazard.curve, low, high],
            None => [&hazard.curve; 3],
        }
        .map(|curve| if is_extrapolated { curve.extrapolated() } else { curve.clone() });
        let rates = if is_extrapolated { rates_over_curve(&middle, &curve) } else { as_given };

        let mut ends = Vec::new();
        if directions[0].model.depends_on_magnitude() && middle.mw.is_some() {
            let at = |mw: &f64| rates_over_curve(&motions.given(directions, 0.0, Some(*mw)), &curve);
            ends.push(motions.unknown.map(at));
        }
        let velocity = motions.velocity.unknown();
        ends.push(velocity.map(|ln| rates_over_curve(&motions.given(directions, *ln, None), &curve)));
        ends.extend(ends_of_subject(subject, |directions| {
            rates_over_curve(&motions.given(directions, 0.0, None), &curve)
        }));
        if hazard.fractiles.is_some() {
            let fractiles = Unknown { part: Part::Hazard, low, high };
            ends.push(fractiles.map(|curve| rates_over_curve(&middle, curve)));
        }

        let motion = middle.peaks(median_intensity(&middle, &curve), 0.0);
        let [(first, _), _] = hazard.curve.ends();
        let warnings = [
            is_extrapolated.then_some(Warning::HazardExtrapolated),
            (ends_early && !is_extrapolated).then_some(Warning::HazardEndsEarly),
            (first > middle.uplift()[1]).then_some(Warning::HazardStartsLate),
        ];
        let share_beyond = 1.0 - as_given.overturning.least() / rates.overturning.value;
        SiteRates {
            velocity: Some(motions.velocity.source),
            beyond: is_extrapolated.then_some(share_beyond),
            counted: self.count(&middle, &curve),
            warnings: warnings.into_iter().flatten().collect(),
            ..Varied { rates, ends }.with_limits(motion, ends_early && !is_extrapolated)
        }
    }

    /// The rate of overturning, counted among the responses of this structure to this kind of motion.
    fn count(&self, given: &GivenPeak, curve: &HazardCurve) -> Option<CountedRate> {
        let kind_of = |suite: &Option<String>| Kind::of_word(suite.as_deref());
        let [Direction { structure, model }] = given.directions else { return None };
        let kind = model.kind();
        let is_same = |cases: &&Cases| kind_of(&cases.suite) == kind && structure.is_like(&cases.structure);
        let cases = self.responses.iter().find(is_same)?;
        let motion = |case: &Case| CountedMotion {
            intensity: if given.peak == Peak::Pga { case.peaks.pga_m_s2 } else { case.peaks.pgv_m_s },
            event: case.outcome == Outcome::Overturned,
            cluster: case.cluster,
        };
        let motions: Vec<CountedMotion> = cases.all.iter().map(motion).collect();
        // Weaker motions uplift nothing.
        let least = match given.peak {
            Peak::Pga => structure.uplift_acceleration_m_s2(),
            Peak::Pgv => given.uplift()[0],
        };
        counted_rate(curve, least, motions, SEED)
    }
}

/// Whether a curve ends too early for a rate.
pub(super) fn ends_early(hazard: &PeakHazard, rate: &Rate) -> bool {
    let [_, (last, _)] = hazard.curve.ends();
    last < strongest(hazard.peak) && rate.beyond > NEGLIGIBLE * rate.value
}

/// The motions of a curve of one peak.
pub(super) struct Motions {
    pub peak: Peak,
    pub velocity: PgvPgaRatio,
    /// The mean magnitude, if it is given, and how far that of the motions is above; the median of the mean,
    /// and what is not known of it.
    pub given: Option<f64>,
    pub above: f64,
    pub median: f64,
    pub unknown: Unknown<f64>,
}

impl Motions {
    /// The motions with this error of ln(PGV / PGA), of this magnitude or the median one.
    pub fn given<'a>(&self, directions: &'a [Direction], ln: f64, mw: Option<f64>) -> GivenPeak<'a> {
        let mw = mw.unwrap_or(self.median);
        let known = self.velocity.magnitude(self.given, mw).map(|mw| mw + self.above);
        GivenPeak::new(directions, self.peak, self.velocity.at(mw, ln), known)
    }
}

impl Varied {
    /// Gives the rates their limits; `ends_early` where the hazard does so for values.
    fn with_limits(&self, motion: Peaks, ends_early: bool) -> SiteRates {
        let LimitStates { rocking, failure, overturning } = &self.rates;
        let is_rocking_early = ends_early && rocking.beyond > NEGLIGIBLE * rocking.value;
        SiteRates {
            rocking: self.limited(rocking, |rates| &rates.rocking, is_rocking_early),
            failure: self.limited(failure, |rates| &rates.failure, ends_early),
            overturning: self.limited(overturning, |rates| &rates.overturning, ends_early),
            errors: self.budget(|rates| rates.overturning.value),
            velocity: None,
            beyond: None,
            counted: None,
            motion,
            warnings: Vec::new(),
        }
    }

    /// Gives one rate its limits. Where the hazard ends too early, either no stronger motion than its last
    /// has the effect, or each: the rate lies within the lower limit of the one and the upper limit of the
    /// other.
    fn limited(
        &self,
        rate: &Rate,
        of: fn(&LimitStates<Rate>) -> &Rate,
        ends_early: bool,
    ) -> Option<AnnualRate> {
        if rate.value.is_nan() {
            return None;
        }
        let most = self.rates.rocking.value + if ends_early { self.rates.rocking.beyond } else { 0.0 };
        Some(match ends_early {
            false => AnnualRate::Estimate(self.budget(|rates| of(rates).value).limit_rate(rate.value, most)),
            true => AnnualRate::Range {
                low: self.budget(|rates| of(rates).least()).limit_rate(rate.least(), most).low,
                high: self.budget(|rates| of(rates).most()).limit_rate(rate.most(), most).high,
            },
        })
    }

    /// The standard deviations of ln of a rate.
    fn budget(&self, rate: impl Fn(&LimitStates<Rate>) -> f64) -> Budget {
        Budget::new(&self.rates, &self.ends, |rates| rate(rates).max(LEAST).ln())
    }
}

/// Computes rates with each unknown of an object, and each error of its models, at its quantiles.
fn ends_of_subject(
    subject: &Subject,
    rates: impl Fn(&[Direction]) -> LimitStates<Rate>,
) -> Vec<Unknown<LimitStates<Rate>>> {
    let model_errors = subject.model_errors();
    let all = model_errors.iter().chain(&subject.unknowns);
    all.map(|unknown| unknown.map(|change| rates(&subject.changed(change)))).collect()
}
