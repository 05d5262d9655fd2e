//! Motions of which one peak is given: the other peak, the magnitude, and the uncertainty of both.

use super::pgv_pga::{PgvPgaRatio, VelocitySource};
use crate::fragility::{GivenPeak, Peak, RockingDirection, Z_95};
use crate::object::{RockingObject, UncertainParameter, UncertaintySource};

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
    pub velocity: PgvPgaRatio,
    /// Median of the mean magnitude by which PGV / PGA is estimated, and its uncertainty.
    mean: f64,
    unknown: UncertainParameter<f64>,
    /// The magnitude of the motions less that mean; none where it is inferred from PGV / PGA.
    above: Option<f64>,
}

impl ConditionalMotions {
    /// Motions of earthquakes of a magnitude or, without one, of those that matter at generic sites.
    pub fn new(peak: Peak, velocity: PgvPgaRatio, mw: Option<f64>) -> ConditionalMotions {
        let (mean, sd) = mw.map_or((USUAL_MAGNITUDE, SD_OF_USUAL), |mw| (mw, 0.0));
        let unknown = UncertainParameter {
            source: UncertaintySource::Magnitude,
            low: mean - Z_95 * sd,
            high: mean + Z_95 * sd,
        };
        // PGV / PGA by two curves, or of the model's motions, determines the magnitude.
        let is_told = !matches!(velocity.source, VelocitySource::Sites | VelocitySource::Given);
        ConditionalMotions { peak, velocity, mean, unknown, above: (mw.is_some() || !is_told).then_some(0.0) }
    }

    /// `mean` is the mean magnitude of the disaggregation: of SA(1.0 s) where PGV / PGA is by this curve,
    /// else of PGA; of PGV there is none.
    pub fn at_site(peak: Peak, velocity: PgvPgaRatio, mean: Option<f64>) -> ConditionalMotions {
        let mean = mean.filter(|_| peak == Peak::Pga);
        let motions = ConditionalMotions::new(peak, velocity, mean);
        let Some(mean) = mean else { return motions };
        let (above, sd) = match velocity.source {
            VelocitySource::Spectrum => (0.0, SD_OF_MEAN),
            VelocitySource::Sites => (0.0, SD_ABOVE_MEAN_OF_PGA),
            _ => (ABOVE_MEAN_OF_PGA, SD_ABOVE_MEAN_OF_PGA),
        };
        let unknown = UncertainParameter { low: mean - Z_95 * sd, high: mean + Z_95 * sd, ..motions.unknown };
        ConditionalMotions { unknown, above: Some(above), ..motions }
    }

    /// `ln` is added to ln(PGV / PGA).
    pub fn given<'a>(&self, directions: &'a [RockingDirection], ln: f64) -> GivenPeak<'a> {
        self.with_mean(directions, self.mean, ln)
    }

    fn with_mean<'a>(&self, directions: &'a [RockingDirection], mean: f64, ln: f64) -> GivenPeak<'a> {
        let mw = self.above.map(|above| mean + above);
        GivenPeak::new(directions, self.peak, self.velocity.at(mean, ln), mw)
    }

    /// Results with each unknown of the motions and of the object at its quantiles.
    pub fn ends<T>(
        &self,
        object: &RockingObject,
        result: impl Fn(&GivenPeak) -> T,
    ) -> Vec<UncertainParameter<T>> {
        let directions = &object.directions[..];
        let mut ends = Vec::new();
        if directions[0].model.depends_on_magnitude() && self.above.is_some() {
            ends.push(self.unknown.map(|mean| result(&self.with_mean(directions, *mean, 0.0))));
        }
        ends.push(self.velocity.unknown().map(|ln| result(&self.given(directions, *ln))));
        ends.extend(object.ends(|directions| result(&self.given(directions, 0.0))));
        ends
    }
}
