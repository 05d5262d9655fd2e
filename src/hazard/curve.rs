//! Hazard curve of one intensity, and its convolution with a fragility.

use crate::statistics::numerics::quadrature;

/// Annual rate that the largest intensity of a hazard curve hardly has; a column of intensities, taken for
/// rates, has.
const FREQUENT: f64 = 0.02;

/// Annual rates at which intensities are exceeded; between its points ln rate is linear in ln IM.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardCurve {
    /// Intensity and annual rate of exceedance.
    points: Vec<(f64, f64)>,
}

/// Why points make no hazard curve. `point` counts from 0, in messages from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the message says it")]
pub enum HazardError {
    #[error("{0} point(s); expected 2 or more")]
    TooFewPoints(usize),
    #[error("point {}: intensity {im}, rate {rate}; expected both above 0", .point + 1)]
    NotPositive { point: usize, im: f64, rate: f64 },
    #[error("point {}, by intensity: expected a larger intensity than before, and no larger rate", .point + 1)]
    Unordered { point: usize },
    #[error(
        "rows go from rare to frequent, and the largest intensity is exceeded {rate} times a year, more often than strong motions come; check that the two columns are not exchanged"
    )]
    Exchanged { rate: f64 },
}

impl HazardCurve {
    /// Checks intensities (m/s2 or m/s) and their annual rates of exceedance, from frequent to rare or the other
    /// way.
    ///
    /// # Errors
    /// If there are fewer than two points, or one is not positive or not in order: as intensities rise, rates
    /// do not.
    pub fn new(mut points: Vec<(f64, f64)>) -> Result<HazardCurve, HazardError> {
        if points.len() < 2 {
            return Err(HazardError::TooFewPoints(points.len()));
        }
        let positive = |value: f64| value > 0.0 && value.is_finite();
        if let Some(point) = points.iter().position(|&(im, rate)| !positive(im) || !positive(rate)) {
            let (im, rate) = points[point];
            return Err(HazardError::NotPositive { point, im, rate });
        }
        if points.windows(2).all(|pair| pair[0].0 > pair[1].0 && pair[0].1 <= pair[1].1) {
            let (_, rate) = points[0];
            if rate > FREQUENT {
                return Err(HazardError::Exchanged { rate });
            }
            points.reverse();
        }
        match points.windows(2).position(|pair| pair[0].0 >= pair[1].0 || pair[0].1 < pair[1].1) {
            Some(before) => Err(HazardError::Unordered { point: before + 1 }),
            None => Ok(HazardCurve { points }),
        }
    }

    /// Returns all intensities, each with its rate.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// Returns the first intensity and the last, each with its rate.
    pub fn ends(&self) -> [(f64, f64); 2] {
        [self.points[0], self.points[self.points.len() - 1]]
    }

    /// The curve continued to ten times its last intensity with the slope of its last two points.
    pub fn extrapolated(&self) -> HazardCurve {
        const FURTHER: f64 = 10.0;
        let mut points = self.points.clone();
        let [(low, rate), (high, rate_at_high)] = [points[points.len() - 2], points[points.len() - 1]];
        let slope = (rate / rate_at_high).ln() / (high / low).ln();
        points.push((FURTHER * high, (rate_at_high * FURTHER.powf(-slope)).max(f64::MIN_POSITIVE)));
        HazardCurve { points }
    }

    /// The same rates at other intensities, which rise with the intensity and fall with the rate.
    pub fn map(&self, other: impl Fn(f64, f64) -> f64) -> HazardCurve {
        HazardCurve { points: self.points.iter().map(|&(im, rate)| (other(im, rate), rate)).collect() }
    }

    /// The intensity that is exceeded at an annual rate; beyond the ends of the curve that of the end.
    pub fn intensity(&self, rate: f64) -> f64 {
        let below = self.points.partition_point(|&(_, point)| point >= rate);
        if below == 0 || below == self.points.len() {
            return self.points[below.saturating_sub(1)].0;
        }
        let [(low, at_low), (high, at_high)] = [self.points[below - 1], self.points[below]];
        low * (high / low).powf((at_low / rate).ln() / (at_low / at_high).ln())
    }

    /// The annual rate at which an intensity is exceeded; beyond the ends of the curve that of the end.
    pub fn exceedance(&self, im: f64) -> f64 {
        let above = self.points.partition_point(|&(point, _)| point <= im);
        if above == 0 || above == self.points.len() {
            return self.points[above.saturating_sub(1)].1;
        }
        let [(low, rate), (high, rate_at_high)] = [self.points[above - 1], self.points[above]];
        rate * ((rate_at_high / rate).ln() * (im / low).ln() / (high / low).ln()).exp()
    }

    /// Integrates the mean annual rates of events that have these probabilities at an intensity: P(im)
    /// |dH(im)|.
    ///
    /// Gauss-Legendre on panels of ln IM that are at most `widest`, none across a point of the curve or one of
    /// `breaks`, where a probability jumps. Motions above the last intensity count with the probability at it; those below the
    /// first are not counted.
    pub fn mean_annual_rates<const N: usize>(
        &self,
        breaks: &[f64],
        widest: f64,
        probabilities: impl Fn(f64) -> [f64; N],
    ) -> [f64; N] {
        let [_, (last, rate_beyond)] = self.ends();
        let mut rates = probabilities(last).map(|p| p * rate_beyond);
        for segment in self.points.windows(2) {
            let [(low, rate), (high, rate_at_high)] = [segment[0], segment[1]];
            let slope = (rate / rate_at_high).ln() / (high / low).ln();
            let mut edges = vec![low.ln(), high.ln()];
            edges.extend(breaks.iter().filter(|&&im| low < im && im < high).map(|im| im.ln()));
            edges.sort_by(f64::total_cmp);
            for (ln_im, width) in edges.windows(2).flat_map(|edge| quadrature(edge[0], edge[1], widest)) {
                let density = slope * rate * (-slope * (ln_im - low.ln())).exp() * width;
                for (sum, p) in rates.iter_mut().zip(probabilities(ln_im.exp())) {
                    *sum += p * density;
                }
            }
        }
        rates
    }
}
