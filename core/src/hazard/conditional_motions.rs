//! Motions conditional on PGA or PGV: the other peak, the magnitude, and the uncertainty of both.

use std::ops::RangeInclusive;

use super::fragility_curve::GenericSites;
use super::pgv_pga::{PgvPgaRatio, VelocitySource};
use crate::fragility::{
    AssumedMagnitude, GivenPeak, MagnitudeSource, Model, ModelPoint, Peak, RockingDirection,
};
use crate::motion::Peaks;
use crate::object::{LowHigh, RockingObject, UncertaintySource};
use crate::warning::Warning;

/// The mean magnitude by which PGV / PGA of generic sites is that of the motions that overturn, and its
/// standard deviation between sites (scripts/reference/site_rates.py).
const USUAL_MAGNITUDE: f64 = 6.35;
const SD_OF_USUAL: f64 = 0.6;
/// The mean magnitude of the motions that overturn, and its standard deviation within a site.
const RECORDED_MAGNITUDE: f64 = 6.65;
const SCATTER_OF_RECORDED: f64 = 0.3;
/// Standard deviation of that mean, between sites, about what PGV / PGA tells: 0.43, and the error of m.
pub(super) const SD_OF_INFERRED: f64 = 0.5;
/// Standard deviation of their magnitude about a mean of the disaggregation of SA(1.0 s).
const SD_OF_MEAN: f64 = 0.2;
/// Mean magnitude of the motions that overturn less that of the disaggregation of PGA at 2475 years, and its
/// standard deviation between sites (scripts/reference/site_rates.py). The mean of SA(1.0 s) needs no
/// correction, nor does a site of PGA alone, where PGV / PGA by the mean errs to the other side.
const ABOVE_MEAN_OF_PGA: f64 = 0.25;
const SD_ABOVE_MEAN_OF_PGA: f64 = 0.3;

/// The largest magnitude of the records that the surface was fitted to.
const LARGEST_FITTED: f64 = 7.9;
/// Vs30 of the ground-motion models by which PGV / PGA depends on it, m/s.
const USUAL_VS30_M_S: RangeInclusive<f64> = 200.0..=1500.0;

#[derive(Debug, Clone, Copy)]
pub(super) struct ConditionalMotions {
    pub peak: Peak,
    pub pgv_pga: PgvPgaRatio,
    /// The mean magnitude by which PGV / PGA is estimated.
    mean: AssumedMagnitude,
    /// The magnitude of the motions less that mean; none where it is inferred from PGV / PGA.
    above: Option<f64>,
}

impl ConditionalMotions {
    /// Motions of earthquakes of a magnitude or, without one, of those that matter at generic sites.
    pub fn new(peak: Peak, pgv_pga: PgvPgaRatio, mw: Option<f64>) -> ConditionalMotions {
        // PGV / PGA by two curves, or of the model's motions, determines the magnitude.
        let is_usual = matches!(pgv_pga.source, VelocitySource::Sites | VelocitySource::Ratio);
        let source = if is_usual { MagnitudeSource::Usual } else { MagnitudeSource::Inferred };
        let usual = AssumedMagnitude { mw: USUAL_MAGNITUDE, sd: SD_OF_USUAL, source };
        let mean = mw.map_or(usual, AssumedMagnitude::given);
        let above = (is_usual || mw.is_some()).then_some(0.0);
        ConditionalMotions { peak, pgv_pga, mean, above }
    }

    /// Motions as recorded, of a magnitude or, without one, of all magnitudes that overturn.
    pub fn as_recorded(model: &Model, sites: GenericSites) -> ConditionalMotions {
        let GenericSites { over: peak, mw, vs30_m_s, ratio_s } = sites;
        let scatter = if mw.is_some() { 0.0 } else { SCATTER_OF_RECORDED };
        let of_records = || PgvPgaRatio::as_recorded(model, peak, vs30_m_s, scatter);
        let mut motions =
            ConditionalMotions::new(peak, ratio_s.map_or_else(of_records, PgvPgaRatio::given), mw);
        motions.mean.mw = mw.unwrap_or(RECORDED_MAGNITUDE);
        motions
    }

    /// `mean` is the mean magnitude of the disaggregation: of SA(1.0 s) where PGV / PGA is by this curve,
    /// else of PGA; of PGV there is none.
    pub fn at_site(peak: Peak, pgv_pga: PgvPgaRatio, mean: Option<f64>) -> ConditionalMotions {
        let mean = mean.filter(|_| peak == Peak::Pga);
        let mut motions = ConditionalMotions::new(peak, pgv_pga, mean);
        let (above, sd) = match pgv_pga.source {
            _ if mean.is_none() => return motions,
            VelocitySource::Sa => (0.0, SD_OF_MEAN),
            VelocitySource::Sites => (0.0, SD_ABOVE_MEAN_OF_PGA),
            _ => (ABOVE_MEAN_OF_PGA, SD_ABOVE_MEAN_OF_PGA),
        };
        (motions.above, motions.mean.sd) = (Some(above), sd);
        motions
    }

    /// `ln_factor` is added to ln(PGV / PGA).
    pub fn given<'a>(&self, directions: &'a [RockingDirection], ln_factor: f64) -> GivenPeak<'a> {
        self.with_mean(directions, self.mean.mw, ln_factor)
    }

    fn with_mean<'a>(&self, directions: &'a [RockingDirection], mean: f64, ln_factor: f64) -> GivenPeak<'a> {
        let mw = self.above.map(|above| mean + above);
        GivenPeak::new(directions, self.peak, self.pgv_pga.at(mean, ln_factor), mw)
    }

    /// That of the motions, of which `motion` is the median; none where nothing depends on it.
    pub fn magnitude(&self, model: &Model, motion: Peaks) -> Option<AssumedMagnitude> {
        let inferred = model.inferred_magnitude(motion)?;
        Some(match self.above {
            Some(above) => AssumedMagnitude { mw: self.mean.mw + above, ..self.mean },
            None => AssumedMagnitude { sd: SD_OF_INFERRED, ..inferred },
        })
    }

    /// Results with each source of uncertainty, of the motions and of the object, at its quantiles.
    pub fn at_quantiles<T>(
        &self,
        object: &RockingObject,
        result: impl Fn(&GivenPeak, ModelPoint) -> T,
    ) -> Vec<LowHigh<T>> {
        let directions = &object.directions[..];
        let mut at_quantiles = Vec::new();
        let AssumedMagnitude { mw, sd, .. } = self.mean;
        if sd > 0.0 && matches!(*directions[0].model, Model::Surface { .. }) {
            // What PGV / PGA leaves open moves the part of PGV / PGA that depends on the magnitude, too.
            let share = if self.above.is_none() { SD_OF_INFERRED / sd } else { 0.0 };
            at_quantiles.push(LowHigh::normal(UncertaintySource::Magnitude, sd).map(|off| {
                result(&self.with_mean(directions, mw + off, 0.0), ModelPoint::Magnitude(share * off))
            }));
        }
        let estimate = |directions: &[RockingDirection], ln_factor| {
            result(&self.given(directions, ln_factor), ModelPoint::Estimate)
        };
        at_quantiles.push(self.pgv_pga.at_quantiles().map(|ln_factor| estimate(directions, *ln_factor)));
        at_quantiles.extend(object.at_quantiles(|directions| estimate(directions, 0.0)));
        at_quantiles
    }
}

/// Warnings about a magnitude and a Vs30 (m/s), where they are used.
pub fn unusual_motions(mw: Option<f64>, vs30_m_s: Option<f64>) -> impl Iterator<Item = Warning> {
    let magnitude = mw.is_some_and(|mw| mw > LARGEST_FITTED).then_some(Warning::UnusualMagnitude);
    let is_unusual = vs30_m_s.is_some_and(|vs30| !USUAL_VS30_M_S.contains(&vs30));
    magnitude.into_iter().chain(is_unusual.then_some(Warning::UnusualGround))
}
