//! Where a rate comes from: its shares by intensity.

use super::curve::HazardCurve;
use super::rates::rates_over_curve;
use super::site::{Hazard, Site, ends_early};
use crate::fragility::{Level, ReadyObject};
use crate::object::Subject;
use crate::statistics::numerics::quadrature;

/// Widest panel of the quadrature within a bin, in ln of the intensity.
const PANEL: f64 = 0.1;

/// Parts of the annual rate of overturning.
#[derive(Debug, Clone, PartialEq)]
pub struct RateByIntensity {
    /// Edges of the bins, m/s2 or m/s.
    pub edges: Vec<f64>,
    /// The annual rate within each bin.
    pub rates: Vec<f64>,
    /// That of motions above the last edge.
    pub beyond: f64,
}

impl Site {
    /// Parts the annual rate of overturning by the intensity of the hazard, of pairs of peaks by PGA, into
    /// bins of equal ratio.
    pub fn rate_by_intensity(&self, subject: &Subject, bins: usize) -> RateByIntensity {
        let edges = |low: f64, high: f64| -> Vec<f64> {
            (0..=bins).map(|k| low * (high / low).powf(k as f64 / bins as f64)).collect()
        };
        match &self.hazard {
            Hazard::Curve(hazard) => {
                let given = self.motions(hazard, subject).given(&subject.directions, 0.0, None);
                let rate = rates_over_curve(&given, &hazard.curve).overturning;
                let curve = match self.extrapolate && ends_early(hazard, &rate) {
                    true => hazard.curve.extrapolated(),
                    false => hazard.curve.clone(),
                };
                let [(first, _), (last, rate_beyond)] = curve.ends();
                let edges = edges(first, last);
                let probability = |intensity: f64| given.limit_states(intensity).overturning;
                let rates = rates_in_bins(&curve, &edges, &given.jumps(), probability);
                RateByIntensity { edges, rates, beyond: probability(last) * rate_beyond }
            }
            Hazard::Joint(pairs) => {
                let peaks = pairs.iter().map(|pair| pair.peaks.pga_m_s2);
                let (low, high) =
                    peaks.fold((f64::INFINITY, 0.0_f64), |(a, b), pga| (a.min(pga), b.max(pga)));
                let (edges, mut rates) = (edges(low, high * 1.001), vec![0.0; bins]);
                for pair in pairs {
                    let ready = ReadyObject::new(&subject.directions, pair.mw.or(self.mw));
                    let p = ready.limit_states(pair.peaks, Level::Estimate).overturning;
                    let bin = edges.partition_point(|edge| *edge <= pair.peaks.pga_m_s2).clamp(1, bins) - 1;
                    rates[bin] += p * pair.annual_rate;
                }
                RateByIntensity { edges, rates, beyond: 0.0 }
            }
        }
    }
}

/// The annual rate of an event within each bin of intensity, whose edges rise: the integral of P(im)
/// |dH(im)|, in panels none of which crosses a point of the curve or a jump of the probability.
fn rates_in_bins(
    curve: &HazardCurve,
    edges: &[f64],
    jumps: &[f64],
    probability: impl Fn(f64) -> f64,
) -> Vec<f64> {
    let breaks: Vec<f64> = curve.points().iter().map(|point| point.0).chain(jumps.iter().copied()).collect();
    let between = |low: f64, high: f64| -> f64 {
        let mut edges = vec![low, high];
        edges.extend(breaks.iter().filter(|im| low < **im && **im < high));
        edges.sort_by(f64::total_cmp);
        edges.windows(2).map(|edge| in_segment(curve, edge[0], edge[1], &probability)).sum()
    };
    edges.windows(2).map(|edge| between(edge[0], edge[1])).collect()
}

/// Within a segment of the curve, where ln rate is linear in ln of the intensity.
fn in_segment(curve: &HazardCurve, low: f64, high: f64, probability: impl Fn(f64) -> f64) -> f64 {
    if low >= high {
        return 0.0;
    }
    let [rate, rate_at_high] = [low, high].map(|im| curve.exceedance(im));
    let slope = (rate / rate_at_high).ln() / (high / low).ln();
    let part = |(ln_im, width): (f64, f64)| {
        probability(ln_im.exp()) * slope * rate * (-slope * (ln_im - low.ln())).exp() * width
    };
    quadrature(low.ln(), high.ln(), PANEL).map(part).sum()
}
