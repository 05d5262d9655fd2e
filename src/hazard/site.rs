//! Annual rates of a structure at a site: the hazard as it is given, what is not known of it, and what the ends of
//! its curve leave open.

use super::budget::{Budget, Budgets, Part, Unknown};
use super::count::{CountedMotion, CountedRate, counted_rate};
use super::curve::HazardCurve;
use super::pgv_pga::{PgvPgaRatio, VelocitySource, magnitude};
use super::rates::{PairOfPeaks, Rate, Rates, median_intensity, rates_over_curve, rates_over_pairs};
use crate::fragility::{Cases, GivenPeak, Kind, Model, Peak};
use crate::plausibility::{STRONGEST_PGA_G, STRONGEST_PGV_M_S};
use crate::rocking::{Outcome, Structure};
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
    /// Mean magnitude of the disaggregation; where it is not known, the median is 6.35 and its standard
    /// deviation 0.6.
    pub mw: Option<f64>,
    /// Vs30, m/s.
    pub vs30_m_s: Option<f64>,
    /// Whether to extrapolate a curve that ends too early.
    pub extrapolate: bool,
    /// Responses in which to count overturning beside the rate; may be empty.
    pub responses: Vec<Cases>,
}

/// Annual rates of a structure: of failure (LS2) and of overturning (LS3) a value and its lower and upper 95 %
/// limit. Where the hazard ends too early for a value, it is none, and the limits are bounds.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct SiteRates {
    pub rocking: Option<f64>,
    pub failure: [Option<f64>; 3],
    pub overturning: [Option<f64>; 3],
    /// Standard deviations of ln rate.
    pub budgets: Budgets,
    /// Source of PGV / PGA; none where the hazard has both peaks of each motion.
    pub velocity: Option<VelocitySource>,
    /// The share of the rate of overturning beyond the last point of a curve that is extrapolated.
    pub beyond: Option<f64>,
    /// The rate of overturning, counted among the responses.
    pub counted: Option<CountedRate>,
    /// PGA and PGV (m/s2 and m/s) of a motion above which half of the rate of overturning lies; of a joint hazard
    /// those of the strongest.
    pub motion: [f64; 2],
    pub warnings: Vec<Warning>,
}

impl Site {
    /// The rates of an object in its directions, of which there is one or more. `unknowns` are its uncertain
    /// inputs: the same directions with one of them at its quantiles.
    pub fn rates(
        &self,
        directions: &[(Structure, Model)],
        unknowns: &[Unknown<Vec<(Structure, Model)>>],
    ) -> SiteRates {
        match &self.hazard {
            Hazard::Curve(hazard) => self.rates_over_curve(hazard, directions, unknowns),
            Hazard::Joint(bins) => {
                let rates = |directions: &[(Structure, Model)]| rates_over_pairs(directions, self.mw, bins);
                let value = rates(directions);
                let mut budgets = Budgets::about(ln_rates(&value));
                for unknown in parameters(directions).iter().chain(unknowns) {
                    budgets.vary(unknown, |directions| ln_rates(&rates(directions)));
                }
                let strongest = bins.iter().max_by(|a, b| a.pga_m_s2.total_cmp(&b.pga_m_s2));
                let motion = strongest.map_or([0.0; 2], |bin| [bin.pga_m_s2, bin.pgv_m_s]);
                SiteRates::new(value, budgets, motion, false)
            }
        }
    }

    fn rates_over_curve(
        &self,
        hazard: &PeakHazard,
        directions: &[(Structure, Model)],
        unknowns: &[Unknown<Vec<(Structure, Model)>>],
    ) -> SiteRates {
        let (peak, model) = (hazard.peak, &directions[0].1);
        let velocity = hazard.velocity.unwrap_or_else(|| PgvPgaRatio::of_model(model, peak, self.vs30_m_s));
        let (mw, of_magnitude) = magnitude(self.mw);
        let given = |mw: f64, ln: f64| {
            let of_motions = velocity.magnitude(self.mw, mw);
            GivenPeak { directions, peak, ratio: velocity.at(mw, ln), mw: of_motions }
        };
        let middle = given(mw, 0.0);
        let as_given = rates_over_curve(&middle, &hazard.curve);
        let [(first, _), (last, _)] = hazard.curve.ends();
        let ends_early = last < strongest(peak) && as_given[2].beyond > NEGLIGIBLE * as_given[2].value;
        let is_extrapolated = ends_early && self.extrapolate;
        let extended =
            |curve: &HazardCurve| if is_extrapolated { curve.extrapolated() } else { curve.clone() };
        let curve = extended(&hazard.curve);
        let rates = if is_extrapolated { rates_over_curve(&middle, &curve) } else { as_given };

        let mut budgets = Budgets::about(ln_rates(&rates));
        let of = |given: &GivenPeak, curve: &HazardCurve| ln_rates(&rates_over_curve(given, curve));
        if model.depends_on_magnitude() && middle.mw.is_some() {
            budgets.vary(&of_magnitude, |mw| of(&given(*mw, 0.0), &curve));
        }
        budgets.vary(&velocity.unknown(), |ln| of(&given(mw, *ln), &curve));
        for unknown in parameters(directions).iter().chain(unknowns) {
            budgets.vary(unknown, |directions| of(&GivenPeak { directions, ..middle }, &curve));
        }
        if let Some(fractiles) = &hazard.fractiles {
            let fractiles = Unknown { part: Part::Hazard, quantiles: fractiles.each_ref().map(extended) };
            budgets.vary(&fractiles, |curve| of(&middle, curve));
        }

        let motion = middle.peaks(median_intensity(&middle, &curve), 0.0);
        let warnings = [
            is_extrapolated.then_some(Warning::HazardExtrapolated),
            (ends_early && !is_extrapolated).then_some(Warning::HazardEndsEarly),
            (first > middle.uplift()[1]).then_some(Warning::HazardStartsLate),
        ];
        SiteRates {
            velocity: Some(velocity.source),
            beyond: is_extrapolated.then(|| 1.0 - (as_given[2].value - as_given[2].of_last) / rates[2].value),
            counted: self.count(&middle, &curve),
            warnings: warnings.into_iter().flatten().collect(),
            ..SiteRates::new(rates, budgets, motion, ends_early && !is_extrapolated)
        }
    }

    /// The rate of overturning, counted among the responses of this structure to this kind of motion.
    fn count(&self, given: &GivenPeak, curve: &HazardCurve) -> Option<CountedRate> {
        let kind_of = |suite: &Option<String>| Kind::of_word(suite.as_deref());
        let [(structure, model)] = given.directions else { return None };
        let kind = match model {
            Model::Calibrated { overturning, .. } => overturning.kind,
            Model::Paper { overturning, .. } => kind_of(&overturning.suite),
        };
        let is_same = |cases: &&Cases| kind_of(&cases.suite) == kind && structure.is_like(&cases.structure);
        let cases = self.responses.iter().find(is_same)?;
        let motion = |case: usize| CountedMotion {
            intensity: if given.peak == Peak::Pga { cases.pga_m_s2[case] } else { cases.pgv_m_s[case] },
            event: cases.outcome[case] == Outcome::Overturning,
            cluster: cases.cluster[case],
        };
        let motions: Vec<CountedMotion> = (0..cases.len()).map(motion).collect();
        // Weaker motions uplift nothing.
        let least = match given.peak {
            Peak::Pga => structure.uplift_acceleration_m_s2(),
            Peak::Pgv => given.uplift()[0],
        };
        counted_rate(curve, least, motions, SEED)
    }
}

impl SiteRates {
    /// Of the rates of the limit states; `ends_early` where the hazard does so for values.
    fn new(rates: Rates, budgets: Budgets, motion: [f64; 2], ends_early: bool) -> SiteRates {
        let [rocking, failure, overturning] = rates;
        let known = |rate: f64| Some(rate).filter(|rate| !rate.is_nan());
        let limited = |rate: Rate, budget: &Budget| match ends_early {
            // No stronger motion has the effect, or each has.
            true => [None, known(rate.value - rate.of_last), known(rate.value + rate.beyond)],
            false => {
                let limits = budget.limits_of_rate(rate.value, rocking.value);
                [known(rate.value), known(limits.low), known(limits.high)]
            }
        };
        let is_rocking_known = !ends_early || rocking.beyond <= NEGLIGIBLE * rocking.value;
        SiteRates {
            rocking: known(rocking.value).filter(|_| is_rocking_known),
            failure: limited(failure, &budgets.failure),
            overturning: limited(overturning, &budgets.overturning),
            budgets,
            velocity: None,
            beyond: None,
            counted: None,
            motion,
            warnings: Vec::new(),
        }
    }
}

/// ln of the rates of failure and of overturning.
fn ln_rates(rates: &Rates) -> [f64; 2] {
    [rates[1], rates[2]].map(|rate| rate.value.max(LEAST).ln())
}

/// What is not known of the models: the same error moves both directions.
fn parameters(directions: &[(Structure, Model)]) -> Vec<Unknown<Vec<(Structure, Model)>>> {
    let ends: Vec<Vec<[Model; 2]>> = directions.iter().map(|(_, model)| model.ends()).collect();
    let at = |error: usize, end: usize| {
        let models = directions.iter().zip(&ends);
        models.map(|((structure, _), ends)| (structure.clone(), ends[error][end].clone())).collect()
    };
    let fewest = ends.iter().map(Vec::len).min().unwrap_or(0);
    (0..fewest)
        .map(|error| Unknown { part: Part::Fit, quantiles: [0, 1].map(|end| at(error, end)) })
        .collect()
}
