//! What gives the probabilities of a structure: fits of one, or the surface of all.

use super::model::{FragilityModel, Probabilities};
use super::predictor::OutOfRange;
use super::probability::Probability;
use super::slice::{Lognormal, Slice};
use super::universal::UniversalModel;
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::rocking::Structure;

/// Probabilities of a structure at an intensity, and where they hold.
pub trait Fragility: Sync {
    /// The probabilities of a structure at an intensity.
    fn of_structure(&self, structure: &Structure, measures: &IntensityMeasures) -> Probabilities;

    /// The measures outside of the data.
    fn outside(&self, measures: &IntensityMeasures) -> Vec<OutOfRange>;

    /// How far the measures are from the middle of the data, the rim being 1, in that coordinate in which they are farthest; with
    /// its name. On logarithmic scales, but for eta.
    fn distance(&self, structure: &Structure, measures: &IntensityMeasures) -> Option<(f64, &'static str)>;

    /// The probability of reaching each limit state at an intensity along a slice; none where a measure is missing.
    fn limit_states(&self, slice: &Slice, intensity: f64) -> Option<[Probability; 3]> {
        self.of_structure(&slice.structure, &slice.measures(intensity)).limit_states()
    }

    /// Overturning along a slice, where it is lognormal in the intensity.
    fn lognormal(&self, _: &Slice) -> Option<Lognormal> {
        None
    }

    /// The intensities along a slice at which probabilities jump; the first is uplift.
    fn jumps(&self, slice: &Slice) -> Vec<f64>;

    /// The largest intensity along a slice for which there are data.
    fn largest_in_data(&self, slice: &Slice) -> f64;
}

impl Fragility for FragilityModel {
    fn of_structure(&self, _: &Structure, measures: &IntensityMeasures) -> Probabilities {
        self.probabilities(measures)
    }

    fn outside(&self, measures: &IntensityMeasures) -> Vec<OutOfRange> {
        self.out_of_range(measures).collect()
    }

    fn distance(&self, _: &Structure, measures: &IntensityMeasures) -> Option<(f64, &'static str)> {
        let fits = [&self.demand.law(measures).ln_median, &self.overturning];
        let known = fits.into_iter().flat_map(|fit| fit.measures().zip(fit.ranges));
        farthest(
            known.filter_map(|(measure, range)| Some((measure.as_str(), measure.among(measures)?, range))),
        )
    }

    fn lognormal(&self, slice: &Slice) -> Option<Lognormal> {
        slice.overturning(&self.overturning)
    }

    fn jumps(&self, slice: &Slice) -> Vec<f64> {
        slice.jumps(self)
    }

    fn largest_in_data(&self, slice: &Slice) -> f64 {
        slice.largest_in_data(self)
    }
}

impl Fragility for UniversalModel {
    fn of_structure(&self, structure: &Structure, measures: &IntensityMeasures) -> Probabilities {
        self.probabilities(structure, measures)
    }

    fn outside(&self, measures: &IntensityMeasures) -> Vec<OutOfRange> {
        self.out_of_range(measures).collect()
    }

    fn distance(&self, structure: &Structure, measures: &IntensityMeasures) -> Option<(f64, &'static str)> {
        farthest(self.coordinates(structure, measures).into_iter())
    }

    fn jumps(&self, slice: &Slice) -> Vec<f64> {
        vec![slice.intensity_at_im4(1.0)]
    }

    fn largest_in_data(&self, slice: &Slice) -> f64 {
        let at_one = slice.measures(1.0);
        let known = self.coordinates(&slice.structure, &at_one).into_iter();
        let growing = known.filter(|(name, ..)| ["im4", "im5"].contains(name));
        growing.map(|(_, value, range)| range[1] / value).fold(f64::INFINITY, f64::min)
    }
}

fn farthest(coordinates: impl Iterator<Item = (&'static str, f64, [f64; 2])>) -> Option<(f64, &'static str)> {
    let distance = |(name, value, [least, largest]): (&'static str, f64, [f64; 2])| {
        let [value, least, largest] = match name {
            "eta" => [value, least, largest],
            _ => [value, least, largest].map(libm::log),
        };
        let (middle, half) = (0.5 * (least + largest), 0.5 * (largest - least));
        ((value - middle).abs() / half, name)
    };
    coordinates.map(distance).filter(|(far, _)| far.is_finite()).max_by(|a, b| a.0.total_cmp(&b.0))
}
