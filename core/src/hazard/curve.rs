//! Hazard curve of one intensity, and its convolution with a fragility.

use crate::statistics::numerics::{QuadraturePanel, panels};

/// No largest intensity of a curve is exceeded this often a year: one that seems to be is itself a rate.
const FREQUENT: f64 = 0.02;

/// Annual rates of exceedance of an intensity; between points ln rate is linear in ln IM.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardCurve {
    points: Vec<(f64, f64)>,
}

/// A node of a quadrature, with the annual rate of the motions that it stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    pub intensity: f64,
    pub annual_rate: f64,
}

/// `point` counts from 0, in messages from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HazardError {
    #[error("{0} point(s); expected 2 or more")]
    TooFewPoints(usize),
    #[error("point {}: intensity {im}, rate {rate}; expected both above 0", .point + 1)]
    NotPositive { point: usize, im: f64, rate: f64 },
    #[error(
        "point {}, by intensity: expected a larger intensity than before, and no larger rate",
        .point + 1
    )]
    Unordered { point: usize },
    #[error(
        "rows go from rare to frequent, and the largest intensity is exceeded {rate} times a year, more \
         often than strong motions come; check that the two columns are not exchanged"
    )]
    Exchanged { rate: f64 },
}

impl HazardCurve {
    /// Intensities (m/s2 or m/s) and their annual rates of exceedance, in rising or falling order.
    ///
    /// # Errors
    /// If there are fewer than two points, or one is not positive, or a rate rises with intensity.
    pub fn new(mut points: Vec<(f64, f64)>) -> Result<HazardCurve, HazardError> {
        if points.len() < 2 {
            return Err(HazardError::TooFewPoints(points.len()));
        }
        let is_positive = |&(im, rate): &(f64, f64)| [im, rate].iter().all(|x| *x > 0.0 && x.is_finite());
        if let Some(point) = points.iter().position(|point| !is_positive(point)) {
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

    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// The first and the last intensity, each with its rate.
    pub fn ends(&self) -> [(f64, f64); 2] {
        [self.points[0], self.points[self.points.len() - 1]]
    }

    /// Continued to an intensity, if it ends before, with the slope of the last two points.
    pub fn continued(&self, to: f64) -> HazardCurve {
        let mut points = self.points.clone();
        let [(low, rate), (high, rate_at_high)] = [points[points.len() - 2], points[points.len() - 1]];
        if high < to {
            let slope = (rate / rate_at_high).ln() / (high / low).ln();
            points.push((to, (rate_at_high * (to / high).powf(-slope)).max(f64::MIN_POSITIVE)));
        }
        HazardCurve { points }
    }

    /// The rates at other intensities, which must rise with the intensity and fall with the rate.
    pub fn map(&self, other: impl Fn(f64, f64) -> f64) -> HazardCurve {
        HazardCurve { points: self.points.iter().map(|&(im, rate)| (other(im, rate), rate)).collect() }
    }

    /// Beyond the ends of the curve, the intensity of the end.
    pub fn intensity(&self, rate: f64) -> f64 {
        let below = self.points.partition_point(|&(_, point)| point >= rate);
        if below == 0 || below == self.points.len() {
            return self.points[below.saturating_sub(1)].0;
        }
        let [(low, at_low), (high, at_high)] = [self.points[below - 1], self.points[below]];
        low * (high / low).powf((at_low / rate).ln() / (at_low / at_high).ln())
    }

    /// Beyond the ends of the curve, the rate of the end.
    pub fn exceedance(&self, im: f64) -> f64 {
        let above = self.points.partition_point(|&(point, _)| point <= im);
        if above == 0 || above == self.points.len() {
            return self.points[above.saturating_sub(1)].1;
        }
        let [(low, rate), (high, rate_at_high)] = [self.points[above - 1], self.points[above]];
        rate * ((rate_at_high / rate).ln() * (im / low).ln() / (high / low).ln()).exp()
    }

    /// Mean annual rate of an event with a probability p at an intensity: the integral of p(im) |dH(im)|.
    /// Motions above the last intensity count with the probability at it, those below the first do not count.
    pub fn mean_annual_rate(&self, breaks: &[f64], widest: f64, p: impl Fn(f64) -> f64) -> f64 {
        self.nodes(breaks, widest).iter().map(|node| p(node.intensity) * node.annual_rate).sum()
    }

    /// Nodes of the quadrature, rising; the last stands for all motions beyond the curve. A probability is
    /// taken as the polynomial through its values at the nodes of each panel of ln IM, at most `widest` and
    /// none across one of `breaks`, where it jumps or bends: the points of the curve need no panels of their
    /// own.
    pub(super) fn nodes(&self, breaks: &[f64], widest: f64) -> Vec<Node> {
        let [(first, _), (last, rate_beyond)] = self.ends();
        let mut edges = vec![first.ln(), last.ln()];
        edges.extend(breaks.iter().filter(|im| first < **im && **im < last).map(|im| im.ln()));
        edges.sort_by(f64::total_cmp);
        // Both directions of a square base jump at one intensity: a panel without width has no polynomial.
        edges.dedup_by(|a, b| *a - *b < 1e-12);
        let panels = edges.windows(2).flat_map(|edge| panels(edge[0], edge[1], widest));
        let nodes = panels.flat_map(|panel| panel.nodes_of(self.masses(panel)));
        let nodes = nodes.map(|(ln_im, annual_rate)| Node { intensity: ln_im.exp(), annual_rate });
        nodes.chain([Node { intensity: last, annual_rate: rate_beyond }]).collect()
    }

    /// ln IM within a panel, with its annual rate.
    fn masses(&self, panel: QuadraturePanel) -> impl Iterator<Item = (f64, f64)> {
        let before = self.points.partition_point(|point| point.0.ln() <= panel.from).max(1) - 1;
        let segments = self.points[before..].windows(2);
        segments.take_while(move |segment| segment[0].0.ln() < panel.to).flat_map(move |segment| {
            let [(low, rate), (high, rate_at_high)] = [segment[0], segment[1]];
            let (ln_low, ln_high) = (low.ln(), high.ln());
            let slope = (rate / rate_at_high).ln() / (ln_high - ln_low);
            let within = QuadraturePanel { from: ln_low.max(panel.from), to: ln_high.min(panel.to) };
            let density = move |ln_im: f64| slope * rate * (-slope * (ln_im - ln_low)).exp();
            within.nodes().map(move |(ln_im, width)| (ln_im, width * density(ln_im)))
        })
    }
}
