//! Hazard curve of one intensity, and its convolution with a fragility.

use crate::statistics::numerics::{interpolation, quadrature};

/// Annual rate that the largest intensity of a hazard curve hardly has; a column of intensities, taken for
/// rates, has.
const FREQUENT: f64 = 0.02;

/// Annual rates at which intensities are exceeded; between its points ln rate is linear in ln IM.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardCurve {
    /// Intensity and annual rate of exceedance.
    points: Vec<(f64, f64)>,
    /// All of it, in parts of one segment or of many close points.
    parts: Vec<Part>,
}

/// The points from one to another.
#[derive(Debug, Clone, PartialEq)]
struct Part {
    from: usize,
    to: usize,
    /// Of close points, what stands for them.
    nodes: Vec<Node>,
}

/// An intensity that stands for others, and how often a year one of them comes.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    ln_im: f64,
    annual_rate: f64,
}

/// More points than this within this factor of intensity are taken together: a probability is a polynomial
/// there, which as many nodes know.
const MANY: usize = 8;
const CLOSE: f64 = 1.1;

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
    /// Checks intensities (m/s2 or m/s) and their annual rates of exceedance, from frequent to rare or the
    /// other way.
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
            None => Ok(HazardCurve::in_parts(points)),
        }
    }

    fn in_parts(points: Vec<(f64, f64)>) -> HazardCurve {
        let (mut parts, mut from) = (Vec::new(), 0);
        while from + 1 < points.len() {
            let close = points.partition_point(|point| point.0 <= CLOSE * points[from].0) - 1;
            let to = if close > from + MANY { close } else { from + 1 };
            let nodes = if to > from + 1 { nodes_of_close(&points[from..=to]) } else { Vec::new() };
            parts.push(Part { from, to, nodes });
            from = to;
        }
        HazardCurve { points, parts }
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
        HazardCurve::in_parts(points)
    }

    /// The same rates at other intensities, which rise with the intensity and fall with the rate.
    pub fn map(&self, other: impl Fn(f64, f64) -> f64) -> HazardCurve {
        HazardCurve::in_parts(self.points.iter().map(|&(im, rate)| (other(im, rate), rate)).collect())
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
    /// Gauss-Legendre on panels of ln IM that are at most `widest`, none across a point of the curve or one
    /// of `breaks`, where a probability jumps. Motions above the last intensity count with the probability
    /// at it; those below the first are not counted.
    pub fn mean_annual_rates<const N: usize>(
        &self,
        breaks: &[f64],
        widest: f64,
        probabilities: impl Fn(f64) -> [f64; N],
    ) -> [f64; N] {
        let [_, (last, rate_beyond)] = self.ends();
        let mut rates = probabilities(last).map(|p| p * rate_beyond);
        let mut add = |node: &Node| {
            for (sum, p) in rates.iter_mut().zip(probabilities(node.ln_im.exp())) {
                *sum += p * node.annual_rate;
            }
        };
        for part in &self.parts {
            let [(low, _), (high, _)] = [self.points[part.from], self.points[part.to]];
            let inside: Vec<f64> = breaks.iter().copied().filter(|&im| low < im && im < high).collect();
            if inside.is_empty() && !part.nodes.is_empty() {
                part.nodes.iter().for_each(&mut add);
                continue;
            }
            for piece in self.pieces(part, &inside) {
                match piece.len() > MANY + 1 {
                    true => nodes_of_close(&piece).iter().for_each(&mut add),
                    false => piece
                        .windows(2)
                        .flat_map(|segment| nodes_of(segment, widest))
                        .for_each(|node| add(&node)),
                }
            }
        }
        rates
    }

    /// The points of a part, in pieces from break to break.
    fn pieces(&self, part: &Part, breaks: &[f64]) -> Vec<Vec<(f64, f64)>> {
        let mut points = self.points[part.from..=part.to].to_vec();
        points.extend(breaks.iter().map(|&im| (im, self.exceedance(im))));
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.dedup_by_key(|point| point.0);
        let mut pieces = vec![vec![points[0]]];
        for &point in &points[1..] {
            pieces.last_mut().expect("there is a first").push(point);
            if breaks.contains(&point.0) {
                pieces.push(vec![point]);
            }
        }
        pieces
    }
}

/// Gauss-Legendre on panels of a segment that are at most `widest`.
fn nodes_of(segment: &[(f64, f64)], widest: f64) -> impl Iterator<Item = Node> {
    let [(low, rate), (high, rate_at_high)] = [segment[0], segment[1]];
    let slope = (rate / rate_at_high).ln() / (high / low).ln();
    quadrature(low.ln(), high.ln(), widest).map(move |(ln_im, width)| {
        let annual_rate = slope * rate * (-slope * (ln_im - low.ln())).exp() * width;
        Node { ln_im, annual_rate }
    })
}

/// The nodes of one panel over many points, each with its share of all rates between them.
fn nodes_of_close(points: &[(f64, f64)]) -> Vec<Node> {
    /// Nodes of the Gauss-Legendre rule of order 2 on (0, 1).
    const WITHIN: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
    let [from, to] = [points[0].0.ln(), points[points.len() - 1].0.ln()];
    let panel = quadrature(from, to, f64::INFINITY);
    let mut nodes: Vec<Node> = panel.map(|(ln_im, _)| Node { ln_im, annual_rate: 0.0 }).collect();
    for segment in points.windows(2) {
        let [(low, rate), (high, rate_at_high)] = [segment[0], segment[1]];
        let (ratio, ln_low, width) = ((rate_at_high / rate).ln(), low.ln(), (high / low).ln());
        for part in WITHIN {
            let density = -ratio * rate * (ratio * part).exp() / WITHIN.len() as f64;
            let shares = interpolation((ln_low + part * width - from) / (to - from));
            for (node, share) in nodes.iter_mut().zip(shares) {
                node.annual_rate += density * share;
            }
        }
    }
    nodes
}
