//! Probabilities given one peak, PGA or PGV: averaged over PGV / PGA of the motions that have it.

use std::f64::consts::TAU;

use super::calibration::{Level, Scenarios};
use super::model::{Direction, Model};
use super::peaks::{Peak, RatioGiven};
use super::ready::ReadyObject;
use super::tree::LimitStates;
use crate::statistics::Estimate;
use crate::statistics::numerics::{first, quadrature};

/// Standard deviations from the median within which all ratios lie that count.
const FARTHEST: f64 = 6.0;
/// Step of the trapezoidal rule, in standard deviations: exact to 1e-6 for smooth functions under a normal
/// density.
const STEP: f64 = 0.6;
/// The same on floors, where nothing is sharp.
const STEP_ON_FLOORS: f64 = 0.8;
/// Widest panel of the quadrature, in standard deviations.
const PANEL: f64 = 1.6;
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
    /// Of motions of one PGA.
    nodes: Vec<Node>,
    /// Least PGA that uplifts it, m/s2.
    uplift_m_s2: f64,
}

/// Motions that stand for others: standard deviations of ln(PGV / PGA) from its median, and weight.
struct Node {
    deviations: f64,
    weight: f64,
}

impl<'a> GivenPeak<'a> {
    /// Makes an object, in the directions in which it falls, ready for motions of which this peak is given and
    /// PGV / PGA has this distribution. `mw` is their magnitude; `None`: inferred from PGV / PGA.
    pub fn new(
        directions: &'a [Direction],
        peak: Peak,
        ratio: RatioGiven,
        mw: Option<f64>,
    ) -> GivenPeak<'a> {
        let is_on_floor = directions.iter().all(|direction| direction.model.floor().is_some());
        let step = if is_on_floor { STEP_ON_FLOORS } else { STEP };
        let last = (FARTHEST / step).ceil() as i32;
        let node = |k: i32| {
            let deviations = step * f64::from(k);
            Node { deviations, weight: step * density(deviations) }
        };
        let nodes = match ratio.is_exact() {
            true => vec![Node { deviations: 0.0, weight: 1.0 }],
            false => (-last..=last).map(node).collect(),
        };
        let uplifts = directions.iter().map(|Direction { structure, model }| model.uplift_m_s2(structure)[0]);
        let uplift_m_s2 = uplifts.fold(f64::INFINITY, f64::min);
        let ready = ReadyObject::new(directions, mw);
        GivenPeak { directions, ready, peak, ratio, mw, nodes, uplift_m_s2 }
    }

    /// PGA and PGV (m/s2 and m/s) of the motions of an intensity whose PGV / PGA is this many standard
    /// deviations above its median.
    pub fn peaks(&self, intensity: f64, deviations: f64) -> [f64; 2] {
        let ratio = self.ratio.ratio(intensity, deviations);
        match self.peak {
            Peak::Pga => [intensity, intensity * ratio],
            Peak::Pgv => [intensity / ratio, intensity],
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
                for node in &self.nodes {
                    add(node, object.limit_states(self.ratio.ln_ratio(ln_pga, node.deviations), level));
                }
            }
            Peak::Pgv => {
                for node in self.nodes_of_pgv(intensity) {
                    let [pga, pgv] = self.peaks(intensity, node.deviations);
                    add(&node, self.ready.at(pga).limit_states((pgv / pga).ln(), level));
                }
            }
        }
        mean
    }

    /// Least intensity that uplifts the object, and that which does so with the median PGV / PGA.
    pub fn uplift(&self) -> [f64; 2] {
        let of_all = self.directions.iter().map(|Direction { structure, model }| model.uplift_m_s2(structure));
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

    /// Widest panel of ln of the peak over which probabilities are smooth: the paper's lower plane under
    /// pulses has a dispersion of 0.03.
    pub(crate) fn widest_panel(&self) -> f64 {
        let is_of_paper = |direction: &Direction| matches!(direction.model, Model::Paper { .. });
        if self.directions.iter().any(is_of_paper) { 0.02 } else { 0.2 }
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
        first(low, high, |ln_pgv| self.peaks(ln_pgv.exp(), node)[0] >= pga_m_s2).exp()
    }

    /// Motions that stand for those of a PGV; weights sum to 1, but for motions of too little PGA.
    fn nodes_of_pgv(&self, pgv_m_s: f64) -> Vec<Node> {
        if self.ratio.is_exact() {
            return vec![Node { deviations: 0.0, weight: 1.0 }];
        }
        let edges = self.edges(pgv_m_s);
        let nodes = edges.windows(2).flat_map(|edge| quadrature(edge[0], edge[1], PANEL));
        nodes.map(|(deviations, width)| Node { deviations, weight: width * density(deviations) }).collect()
    }

    /// Standard deviations between which the motions of a PGV have probabilities without a jump.
    fn edges(&self, pgv_m_s: f64) -> Vec<f64> {
        let ln_ratio = |z| (self.peaks(pgv_m_s, z)[1] / self.peaks(pgv_m_s, z)[0]).ln();
        let (median, sd) = (ln_ratio(0.0), ln_ratio(1.0) - ln_ratio(0.0));
        let deviations = |pga: f64| (((pgv_m_s / pga).ln() - median) / sd).clamp(-FARTHEST, FARTHEST);
        let jumps = self.jumps_of_pga().into_iter().map(deviations);
        // Those with less PGA than uplifts the structure, behind the last, do not count.
        let mut edges: Vec<f64> = std::iter::once(-FARTHEST).chain(jumps).collect();
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        edges
    }
}

/// The density of the standard normal distribution.
fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / TAU.sqrt()
}
