//! Motions conditional on PGA or PGV: the other peak, the magnitude, and the uncertainty of both.

use std::ops::RangeInclusive;

use super::pgv_pga::{PgvPgaRatio, VelocitySource};
use crate::fragility::{
    AssumedMagnitude, GivenPeak, MagnitudeSource, Model, Peak, RockingDirection, at_higher_magnitude,
};
use crate::motion::Peaks;
use crate::object::{LowHigh, RockingObject, UncertaintySource};
use crate::statistics::normal::Z_95;
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
    /// Median of the mean magnitude by which PGV / PGA is estimated, and its standard deviation.
    mean: f64,
    sd: f64,
    /// The magnitude of the motions less that mean; none where it is inferred from PGV / PGA.
    above: Option<f64>,
    source: MagnitudeSource,
}

impl ConditionalMotions {
    /// Motions of earthquakes of a magnitude or, without one, of those that matter at generic sites.
    pub fn new(peak: Peak, pgv_pga: PgvPgaRatio, mw: Option<f64>) -> ConditionalMotions {
        // PGV / PGA by two curves, or of the model's motions, determines the magnitude.
        let is_usual = matches!(pgv_pga.source, VelocitySource::Sites | VelocitySource::Given);
        let (mean, sd, above, source) = match mw {
            Some(mw) => (mw, 0.0, Some(0.0), MagnitudeSource::Given),
            None if is_usual => (USUAL_MAGNITUDE, SD_OF_USUAL, Some(0.0), MagnitudeSource::Usual),
            None => (USUAL_MAGNITUDE, SD_OF_USUAL, None, MagnitudeSource::Inferred),
        };
        ConditionalMotions { peak, pgv_pga, mean, sd, above, source }
    }

    /// Motions as recorded, of a magnitude or, without one, of all magnitudes that overturn. `ratio_s` is the
    /// PGV / PGA of all.
    pub fn as_recorded(
        model: &Model,
        peak: Peak,
        ratio_s: Option<f64>,
        vs30_m_s: Option<f64>,
        mw: Option<f64>,
    ) -> ConditionalMotions {
        let scatter = if mw.is_some() { 0.0 } else { SCATTER_OF_RECORDED };
        let of_records = || PgvPgaRatio::as_recorded(model, peak, vs30_m_s, scatter);
        let motions = ConditionalMotions::new(peak, ratio_s.map_or_else(of_records, PgvPgaRatio::given), mw);
        ConditionalMotions { mean: mw.unwrap_or(RECORDED_MAGNITUDE), ..motions }
    }

    /// `mean` is the mean magnitude of the disaggregation: of SA(1.0 s) where PGV / PGA is by this curve,
    /// else of PGA; of PGV there is none.
    pub fn at_site(peak: Peak, pgv_pga: PgvPgaRatio, mean: Option<f64>) -> ConditionalMotions {
        let mean = mean.filter(|_| peak == Peak::Pga);
        let motions = ConditionalMotions::new(peak, pgv_pga, mean);
        let (above, sd) = match pgv_pga.source {
            _ if mean.is_none() => return motions,
            VelocitySource::Spectrum => (0.0, SD_OF_MEAN),
            VelocitySource::Sites => (0.0, SD_ABOVE_MEAN_OF_PGA),
            _ => (ABOVE_MEAN_OF_PGA, SD_ABOVE_MEAN_OF_PGA),
        };
        ConditionalMotions { sd, above: Some(above), ..motions }
    }

    /// `ln_factor` is added to ln(PGV / PGA).
    pub fn given<'a>(&self, directions: &'a [RockingDirection], ln_factor: f64) -> GivenPeak<'a> {
        self.with_mean(directions, self.mean, ln_factor)
    }

    fn with_mean<'a>(&self, directions: &'a [RockingDirection], mean: f64, ln_factor: f64) -> GivenPeak<'a> {
        let mw = self.above.map(|above| mean + above);
        GivenPeak::new(directions, self.peak, self.pgv_pga.at(mean, ln_factor), mw)
    }

    /// That of the motions, of which `motion` is the median; none where nothing depends on it.
    pub fn magnitude(&self, model: &Model, motion: Peaks) -> Option<AssumedMagnitude> {
        let inferred = model.inferred_magnitude(motion)?;
        Some(match self.above {
            Some(above) => AssumedMagnitude { mw: self.mean + above, sd: self.sd, source: self.source },
            None => AssumedMagnitude { sd: SD_OF_INFERRED, ..inferred },
        })
    }

    /// Results with each source of uncertainty, of the motions and of the object, at its quantiles.
    pub fn at_quantiles<T>(
        &self,
        object: &RockingObject,
        result: impl Fn(&GivenPeak) -> T,
    ) -> Vec<LowHigh<T>> {
        let directions = &object.directions[..];
        let mut at_quantiles = Vec::new();
        if self.sd > 0.0 && matches!(directions[0].model, Model::Surface { .. }) {
            let at_mean = |mean: f64| match self.above {
                Some(_) => result(&self.with_mean(directions, mean, 0.0)),
                // What PGV / PGA leaves open, in the part of PGV / PGA that depends on the magnitude, too.
                None => {
                    let off = SD_OF_INFERRED / self.sd * (mean - self.mean);
                    result(&self.with_mean(&at_higher_magnitude(directions, off), mean, 0.0))
                }
            };
            at_quantiles
                .push(quantiles(UncertaintySource::Magnitude, self.mean, self.sd).map(|mean| at_mean(*mean)));
        }
        at_quantiles
            .push(self.pgv_pga.at_quantiles().map(|ln_factor| result(&self.given(directions, *ln_factor))));
        at_quantiles.extend(object.at_quantiles(|directions| result(&self.given(directions, 0.0))));
        at_quantiles
    }
}

/// Warnings about a magnitude and a Vs30 (m/s), where they are used.
pub fn unusual_motions(mw: Option<f64>, vs30_m_s: Option<f64>) -> impl Iterator<Item = Warning> {
    let magnitude = mw.is_some_and(|mw| mw > LARGEST_FITTED).then_some(Warning::UnusualMagnitude);
    let is_unusual = vs30_m_s.is_some_and(|vs30| !USUAL_VS30_M_S.contains(&vs30));
    magnitude.into_iter().chain(is_unusual.then_some(Warning::UnusualGround))
}

/// Results of motions whose magnitude is inferred from both peaks, at its quantiles.
pub(super) fn at_inferred_magnitudes<T>(
    directions: &[RockingDirection],
    sd: f64,
    result: impl Fn(&[RockingDirection]) -> T,
) -> LowHigh<T> {
    quantiles(UncertaintySource::Magnitude, 0.0, sd).map(|off| result(&at_higher_magnitude(directions, *off)))
}

fn quantiles(source: UncertaintySource, mean: f64, sd: f64) -> LowHigh<f64> {
    LowHigh { source, low: mean - Z_95 * sd, high: mean + Z_95 * sd }
}
