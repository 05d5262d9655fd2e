//! Motions conditional on PGA or PGV: the other peak, the magnitude, and the uncertainty of both.

use super::pgv_pga::{PgvPgaRatio, VelocitySource};
use crate::fragility::{GivenPeak, Peak, RockingDirection};
use crate::object::{LowHigh, RockingObject, UncertaintySource};
use crate::statistics::normal::Z_95;

/// Mean and standard deviation of the magnitude of the motions that overturn, at generic sites.
const USUAL_MAGNITUDE: f64 = 6.35;
const SD_OF_USUAL: f64 = 0.6;
/// Standard deviation of their magnitude about a mean of the disaggregation of SA(1.0 s).
const SD_OF_MEAN: f64 = 0.2;
/// Mean magnitude of the motions that overturn less that of the disaggregation of PGA at 2475 years, and its
/// standard deviation between sites (scripts/reference/site_rates.py). The mean of SA(1.0 s) needs no
/// correction, nor does a site of PGA alone, where PGV / PGA by the mean errs to the other side.
const ABOVE_MEAN_OF_PGA: f64 = 0.25;
const SD_ABOVE_MEAN_OF_PGA: f64 = 0.3;

#[derive(Debug, Clone, Copy)]
pub(super) struct ConditionalMotions {
    pub peak: Peak,
    pub pgv_pga: PgvPgaRatio,
    /// Median of the mean magnitude by which PGV / PGA is estimated, and its uncertainty.
    mean: f64,
    mean_at_quantiles: LowHigh<f64>,
    /// The magnitude of the motions less that mean; none where it is inferred from PGV / PGA.
    above: Option<f64>,
}

impl ConditionalMotions {
    /// Motions of earthquakes of a magnitude or, without one, of those that matter at generic sites.
    pub fn new(peak: Peak, pgv_pga: PgvPgaRatio, mw: Option<f64>) -> ConditionalMotions {
        let (mean, sd) = mw.map_or((USUAL_MAGNITUDE, SD_OF_USUAL), |mw| (mw, 0.0));
        let mean_at_quantiles =
            LowHigh { source: UncertaintySource::Magnitude, low: mean - Z_95 * sd, high: mean + Z_95 * sd };
        // PGV / PGA by two curves, or of the model's motions, determines the magnitude.
        let is_inferred = !matches!(pgv_pga.source, VelocitySource::Sites | VelocitySource::Given);
        ConditionalMotions {
            peak,
            pgv_pga,
            mean,
            mean_at_quantiles,
            above: (mw.is_some() || !is_inferred).then_some(0.0),
        }
    }

    /// `mean` is the mean magnitude of the disaggregation: of SA(1.0 s) where PGV / PGA is by this curve,
    /// else of PGA; of PGV there is none.
    pub fn at_site(peak: Peak, pgv_pga: PgvPgaRatio, mean: Option<f64>) -> ConditionalMotions {
        let mean = mean.filter(|_| peak == Peak::Pga);
        let motions = ConditionalMotions::new(peak, pgv_pga, mean);
        let Some(mean) = mean else { return motions };
        let (above, sd) = match pgv_pga.source {
            VelocitySource::Spectrum => (0.0, SD_OF_MEAN),
            VelocitySource::Sites => (0.0, SD_ABOVE_MEAN_OF_PGA),
            _ => (ABOVE_MEAN_OF_PGA, SD_ABOVE_MEAN_OF_PGA),
        };
        let mean_at_quantiles =
            LowHigh { low: mean - Z_95 * sd, high: mean + Z_95 * sd, ..motions.mean_at_quantiles };
        ConditionalMotions { mean_at_quantiles, above: Some(above), ..motions }
    }

    /// `ln_factor` is added to ln(PGV / PGA).
    pub fn given<'a>(&self, directions: &'a [RockingDirection], ln_factor: f64) -> GivenPeak<'a> {
        self.with_mean(directions, self.mean, ln_factor)
    }

    fn with_mean<'a>(&self, directions: &'a [RockingDirection], mean: f64, ln_factor: f64) -> GivenPeak<'a> {
        let mw = self.above.map(|above| mean + above);
        GivenPeak::new(directions, self.peak, self.pgv_pga.at(mean, ln_factor), mw)
    }

    /// Results with each source of uncertainty, of the motions and of the object, at its quantiles.
    pub fn at_quantiles<T>(
        &self,
        object: &RockingObject,
        result: impl Fn(&GivenPeak) -> T,
    ) -> Vec<LowHigh<T>> {
        let directions = &object.directions[..];
        let mut at_quantiles = Vec::new();
        if directions[0].model.depends_on_magnitude() && self.above.is_some() {
            at_quantiles
                .push(self.mean_at_quantiles.map(|mean| result(&self.with_mean(directions, *mean, 0.0))));
        }
        at_quantiles
            .push(self.pgv_pga.at_quantiles().map(|ln_factor| result(&self.given(directions, *ln_factor))));
        at_quantiles.extend(object.at_quantiles(|directions| result(&self.given(directions, 0.0))));
        at_quantiles
    }
}
