use super::site::{Hazard, Site, strongest};
use crate::fragility::{ModelPoint, ReadyObject};
use crate::object::RockingObject;
use crate::statistics::numerics::equal_ratios;

/// Widest panel within a bin, in ln of the intensity.
const PANEL: f64 = 0.1;

#[derive(Debug, Clone, PartialEq)]
pub struct RateByIntensity {
    /// Edges of the bins, m/s2 or m/s.
    pub edges: Vec<f64>,
    pub rates: Vec<f64>,
    /// Annual rate of overturning by motions beyond the curve, which is continued.
    pub beyond: f64,
}

impl Site {
    /// Splits the annual rate of overturning by the intensity of the hazard, of pairs by PGA, into bins of
    /// equal ratio; 0 where the model has no probability.
    pub fn rate_by_intensity(&self, object: &RockingObject, bins: usize) -> RateByIntensity {
        match &self.hazard {
            Hazard::Curve(hazard) => {
                let given = self.motions(hazard, object).given(&object.directions, 0.0);
                let [(first, _), (last, _)] = hazard.curve.ends();
                let mut split = RateByIntensity::new(first, last, bins);
                let curve = hazard.curve.continued(strongest(hazard.peak));
                for node in curve.nodes(&[&split.edges[..], &given.breaks()].concat(), PANEL) {
                    let p = given.limit_states(node.intensity).overturning.unwrap_or(0.0);
                    match node.intensity < last {
                        true => split.add(node.intensity, p * node.annual_rate),
                        false => split.beyond += p * node.annual_rate,
                    }
                }
                split
            }
            Hazard::Joint(pairs) => {
                let peaks = pairs.iter().map(|pair| pair.peaks.pga_m_s2);
                let (low, high) =
                    peaks.fold((f64::INFINITY, 0.0_f64), |(a, b), pga| (a.min(pga), b.max(pga)));
                let mut split = RateByIntensity::new(low, high * 1.001, bins);
                for pair in pairs {
                    let ready = ReadyObject::new(&object.directions, pair.mw.or(self.mw));
                    let p = ready.limit_states(pair.peaks, &[ModelPoint::Estimate])[0].overturning;
                    split.add(pair.peaks.pga_m_s2, p.unwrap_or(0.0) * pair.annual_rate);
                }
                split
            }
        }
    }
}

impl RateByIntensity {
    fn new(low: f64, high: f64, bins: usize) -> RateByIntensity {
        let edges = equal_ratios(low, high, bins).collect();
        RateByIntensity { edges, rates: vec![0.0; bins], beyond: 0.0 }
    }

    fn add(&mut self, intensity: f64, rate: f64) {
        let above = self.edges.partition_point(|edge| *edge <= intensity).clamp(1, self.rates.len());
        self.rates[above - 1] += rate;
    }
}
