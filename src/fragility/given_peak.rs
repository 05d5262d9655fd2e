//! Probabilities given one peak, PGA or PGV: averaged over PGV / PGA of the motions that have it.

use std::f64::consts::TAU;

use super::calibration::{Level, Scenarios};
use super::model::{Direction, Model};
use super::peaks::{Peak, RatioGiven};
use super::ready::ReadyObject;
use super::tree::LimitStates;
use crate::motion::Peaks;
use crate::statistics::Estimate;
use crate::statistics::numerics::{first, quadrature};

/// Standard deviations from the median within which all ratios lie that count.
const FARTHEST: f64 = 6.0;
/// Step of the trapezoidal rule on floors, in standard deviations: nothing is sharp there.
const STEP_ON_FLOORS: f64 = 0.8;
/// Widest panel of the quadrature, in standard deviations, over the motions of a PGA and over those of a PGV,
/// which reach down to uplift.
const PANEL_OF_PGA: f64 = 3.0;
const PANEL_OF_PGV: f64 = 0.7;
/// Times the PGA of uplift, up to which probabilities rise steeply.
const STEEP: f64 = 1.15;
/// PGV between which the uplift of any structure is sought, m/s.
const SOUGHT_M_S: [f64; 2] = [1e-6, 1e3];

/// An object under motions of which one peak is given.
pub struct GivenPeak<'a> {
    /// The directions in which the object falls.
    pub directions: &'a [Direction],
    ready: ReadyObject<'a>,
    /// The peak that is given.
    pub peak: Peak,
    ratio: RatioGiven,
    /// Magnitude of the motions; `None`: inferred from PGV / PGA.
    pub mw: Option<f64>,
    /// ln(PGV / PGA), s, at which the model bends.
    bends: Vec<f64>,
    /// Least PGA that uplifts it, m/s2.
    uplift_m_s2: f64,
}

/// Motions that stand for others: standard deviations of ln(PGV / PGA) from its median, and weight.
struct Node {
    deviations: f64,
    weight: f64,
}

impl<'a> GivenPeak<'a> {
    /// Makes an object, in the directions in which it falls, ready for motions of which this peak is given
    /// and PGV / PGA has this distribution. `mw` is their magnitude; `None`: inferred from PGV / PGA.
    pub fn new(directions: &'a [Direction], peak: Peak, ratio: RatioGiven, mw: Option<f64>) -> GivenPeak<'a> {
        let bends = directions.iter().flat_map(|direction| direction.model.bends(mw)).collect();
        let uplifts = directions.iter().map(|Direction { structure, model }| model.uplift_m_s2(structure)[0]);
        let uplift_m_s2 = uplifts.fold(f64::INFINITY, f64::min);
        let ready = ReadyObject::new(directions, mw);
        GivenPeak { directions, ready, peak, ratio, mw, bends, uplift_m_s2 }
    }

    /// Peaks of the motions of an intensity whose PGV / PGA is this many standard deviations above its
    /// median.
    pub fn peaks(&self, intensity: f64, deviations: f64) -> Peaks {
        let ratio = self.ratio.ratio(intensity, deviations);
        match self.peak {
            Peak::Pga => Peaks { pga_m_s2: intensity, pgv_m_s: intensity * ratio },
            Peak::Pgv => Peaks { pga_m_s2: intensity / ratio, pgv_m_s: intensity },
        }
    }

    /// Probabilities of the limit states at an intensity; NaN where the model has none.
    pub fn limit_states(&self, intensity: f64) -> LimitStates<f64> {
        self.at_level(intensity, Level::Estimate)
    }

    /// The same with limits.
    pub fn estimates(&self, intensity: f64, scenarios: Scenarios) -> LimitStates<Estimate> {
        Level::limit_states(scenarios, |level| self.at_level(intensity, level))
    }

    fn at_level(&self, intensity: f64, level: Level) -> LimitStates<f64> {
        let mut mean = LimitStates::all(0.0);
        let mut add = |node: &Node, at: LimitStates<f64>| mean = mean.zip(at, |sum, p| sum + node.weight * p);
        match self.peak {
            Peak::Pga if intensity < self.uplift_m_s2 => {}
            Peak::Pga => {
                let (object, ln_pga) = (self.ready.at(intensity), intensity.ln());
                for node in self.nodes(intensity) {
                    add(&node, object.limit_states(self.ratio.ln_ratio(ln_pga, node.deviations), level));
                }
            }
            Peak::Pgv => {
                for node in self.nodes(intensity) {
                    let Peaks { pga_m_s2, pgv_m_s } = self.peaks(intensity, node.deviations);
                    add(&node, self.ready.at(pga_m_s2).limit_states((pgv_m_s / pga_m_s2).ln(), level));
                }
            }
        }
        mean
    }

    /// Least intensity that uplifts the object, and that which does so with the median PGV / PGA.
    pub fn uplift(&self) -> [f64; 2] {
        let of_all =
            self.directions.iter().map(|Direction { structure, model }| model.uplift_m_s2(structure));
        let [least, usual] = of_all.fold([f64::INFINITY; 2], |a, b| [a[0].min(b[0]), a[1].min(b[1])]);
        [self.intensity_of(least, -FARTHEST), self.intensity_of(usual, 0.0)]
    }

    /// Intensities at which a probability jumps: that of uplift, and that of the planes' transition. Over a
    /// distribution of PGA none does.
    pub fn jumps(&self) -> Vec<f64> {
        match (self.peak, self.ratio.is_exact()) {
            (Peak::Pgv, false) => Vec::new(),
            _ => self.jumps_of_pga().into_iter().map(|pga| self.intensity_of(pga, 0.0)).collect(),
        }
    }

    /// Intensities between which probabilities are smooth: at jumps, above uplift on the ground, and where
    /// PGV / PGA bends.
    pub(crate) fn breaks(&self) -> Vec<f64> {
        let mut all = self.jumps();
        if self.peak == Peak::Pga {
            all.extend(self.jumps().into_iter().map(|jump| STEEP * jump));
        }
        if self.ratio.bend != 0.0 {
            all.push(self.ratio.knot.exp());
        }
        all
    }

    /// Widest panel of ln of the peak over which probabilities are smooth: the paper's lower plane under
    /// pulses has a dispersion of 0.03.
    pub(crate) fn widest_panel(&self) -> f64 {
        let is_of_paper = |direction: &Direction| matches!(direction.model, Model::Paper { .. });
        if self.directions.iter().any(is_of_paper) { 0.02 } else { 0.4 }
    }

    /// PGA at which a probability jumps, m/s2, rising.
    fn jumps_of_pga(&self) -> Vec<f64> {
        let jumps = |Direction { structure, model }: &Direction| {
            let demand = if let Model::Paper { demand, .. } = model { &demand[..] } else { &[] };
            let transitions = demand.iter().filter_map(|fit| fit.range_low).filter(|&im4| im4 > 1.0);
            let [uplift, _] = model.uplift_m_s2(structure);
            std::iter::once(1.0).chain(transitions).map(|im4| im4 * uplift).collect::<Vec<f64>>()
        };
        let mut all: Vec<f64> = self.directions.iter().flat_map(jumps).collect();
        all.sort_by(f64::total_cmp);
        all
    }

    /// The intensity at which motions this many standard deviations from the median have a PGA (m/s2): by
    /// bisection, since the median bends.
    fn intensity_of(&self, pga_m_s2: f64, node: f64) -> f64 {
        if self.peak == Peak::Pga {
            return pga_m_s2;
        }
        let [low, high] = SOUGHT_M_S.map(f64::ln);
        first(low, high, |ln_pgv| self.peaks(ln_pgv.exp(), node).pga_m_s2 >= pga_m_s2).exp()
    }

    /// Motions that stand for those of an intensity; weights sum to 1, but for motions of too little PGA.
    fn nodes(&self, intensity: f64) -> Vec<Node> {
        let is_on_floor = self.directions.iter().all(|direction| direction.model.floor().is_some());
        if self.ratio.is_exact() {
            return vec![Node { deviations: 0.0, weight: 1.0 }];
        }
        let all: Vec<(f64, f64)> = match self.peak {
            Peak::Pga if is_on_floor => {
                let last = (FARTHEST / STEP_ON_FLOORS).ceil() as i32;
                (-last..=last).map(|k| (STEP_ON_FLOORS * f64::from(k), STEP_ON_FLOORS)).collect()
            }
            peak => {
                let widest = if peak == Peak::Pga { PANEL_OF_PGA } else { PANEL_OF_PGV };
                let edges = self.edges(intensity);
                edges.windows(2).flat_map(|edge| quadrature(edge[0], edge[1], widest)).collect()
            }
        };
        let node = |(deviations, width)| Node { deviations, weight: width * density(deviations) };
        all.into_iter().map(node).collect()
    }

    /// Standard deviations between which the motions of an intensity have smooth probabilities.
    fn edges(&self, intensity: f64) -> Vec<f64> {
        let ln_intensity = intensity.ln();
        let median = self.ratio.ln_ratio(ln_intensity, 0.0);
        let deviations = |ln_seconds: f64| {
            let above = ln_seconds - median;
            above / (self.ratio.ln_ratio(ln_intensity, above.signum()) - median).abs()
        };
        let mut edges = vec![-FARTHEST, 0.0];
        edges.extend(self.bends.iter().map(|bend| deviations(*bend)));
        let mut last = FARTHEST;
        if self.peak == Peak::Pgv {
            // Those with less PGA than uplifts the structure, behind the last jump, do not count.
            let at = |pga: f64| deviations((intensity / pga).ln());
            let jumps = self.jumps_of_pga();
            last = jumps.iter().map(|pga| at(*pga)).fold(-FARTHEST, f64::max).min(FARTHEST);
            edges.extend(jumps.iter().flat_map(|pga| [at(*pga), at(STEEP * pga)]));
        }
        edges.push(last);
        edges.retain(|edge| (-FARTHEST..=last).contains(edge));
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        edges
    }
}

/// The density of the standard normal distribution.
fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / TAU.sqrt()
}
