//! Hazard curve of one intensity, and its convolution with a fragility.

/// Nodes and weights on (0, 1) of the Gauss-Legendre rule of order 8, exact for polynomials of degree 15.
const GAUSS_LEGENDRE: [(f64, f64); 8] = [
    (0.019_855_071_751_231_884, 0.050_614_268_145_188_13),
    (0.101_666_761_293_186_63, 0.111_190_517_226_687_24),
    (0.237_233_795_041_835_5, 0.156_853_322_938_943_64),
    (0.408_282_678_752_175_1, 0.181_341_891_689_181),
    (0.591_717_321_247_825, 0.181_341_891_689_181),
    (0.762_766_204_958_164_5, 0.156_853_322_938_943_64),
    (0.898_333_238_706_813_4, 0.111_190_517_226_687_24),
    (0.980_144_928_248_768_1, 0.050_614_268_145_188_13),
];

/// A rate a year that the largest intensity of a hazard curve hardly has: a column with intensities in it
/// has.
const FREQUENT: f64 = 0.02;

/// Annual rates at which intensities are exceeded; between its points ln rate is linear in ln IM.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardCurve {
    /// Intensity and annual rate of exceedance.
    points: Vec<(f64, f64)>,
}

/// Why points make no hazard curve. `point` counts from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HazardError {
    #[error("{0} point(s); expected 2 or more")]
    TooFewPoints(usize),
    #[error("point {point}: intensity {im}, rate {rate}; expected both above 0")]
    NotPositive { point: usize, im: f64, rate: f64 },
    #[error("point {point}: expected a larger intensity than before, and no larger rate")]
    Unordered { point: usize },
    #[error(
        "rows go from rare to frequent, and the largest intensity is exceeded {rate} times a year, more often than strong motions come; check that the two columns are not exchanged"
    )]
    Exchanged { rate: f64 },
}

impl HazardCurve {
    /// Checks intensities and their annual rates of exceedance, from frequent to rare or the other way.
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
        match points.windows(2).position(|pair| pair[0].0 >= pair[1].0 || pair[0].1 < pair[1].1) {
            Some(_) if points.windows(2).all(|pair| pair[0].0 > pair[1].0 && pair[0].1 <= pair[1].1) => {
                let (_, rate) = points[0];
                if rate > FREQUENT {
                    return Err(HazardError::Exchanged { rate });
                }
                points.reverse();
                Ok(HazardCurve { points })
            }
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

    /// The same rates at intensities times `factor`.
    pub fn scaled(&self, factor: f64) -> HazardCurve {
        HazardCurve { points: self.points.iter().map(|&(im, rate)| (im * factor, rate)).collect() }
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
        rate * libm::exp(libm::log(rate_at_high / rate) * libm::log(im / low) / libm::log(high / low))
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
            let slope = libm::log(rate / rate_at_high) / libm::log(high / low);
            let mut edges = vec![libm::log(low), libm::log(high)];
            edges.extend(breaks.iter().filter(|&&im| low < im && im < high).map(|im| libm::log(*im)));
            edges.sort_by(f64::total_cmp);
            for (ln_im, width) in edges.windows(2).flat_map(|edge| nodes(edge[0], edge[1], widest)) {
                let density = slope * rate * libm::exp(-slope * (ln_im - libm::log(low))) * width;
                for (sum, p) in rates.iter_mut().zip(probabilities(libm::exp(ln_im))) {
                    *sum += p * density;
                }
            }
        }
        rates
    }
}

/// Returns nodes and weights of the quadrature between two values of ln IM.
fn nodes(from: f64, to: f64, widest: f64) -> impl Iterator<Item = (f64, f64)> {
    let panels = ((to - from) / widest).ceil().max(1.0);
    let width = (to - from) / panels;
    (0..panels as usize).flat_map(move |panel| {
        let start = from + width * panel as f64;
        GAUSS_LEGENDRE.map(|(node, weight)| (start + node * width, weight * width))
    })
}
