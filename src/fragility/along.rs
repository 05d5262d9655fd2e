//! Probabilities along one peak: at each intensity averaged over PGV / PGA of the motions that have it.

use std::f64::consts::TAU;

use super::calibration::Scenarios;
use super::model::Model;
use super::peaks::Peak;
use super::tree::Probability;
use crate::motion::IntensityMeasures;
use crate::rocking::Structure;

/// PGV / PGA of motions of one intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ratio {
    /// Lognormal, as in the motions that the model stands for.
    Distributed,
    /// So many standard deviations of its logarithm above the median.
    Deviations(f64),
    /// The same for all motions, s.
    Seconds(f64),
}

/// The motions of one peak, as they meet a structure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Along<'a> {
    pub model: &'a Model,
    pub structure: &'a Structure,
    pub peak: Peak,
    pub ratio: Ratio,
}

/// Probabilities of LS1, LS2 and LS3 under motions of a PGA and PGV (m/s2 and m/s); NaN where the model has none.
pub fn limit_states_at(
    model: &Model,
    structure: &Structure,
    [pga_m_s2, pgv_m_s]: [f64; 2],
    scenarios: Scenarios,
) -> [Probability; 3] {
    let measures = IntensityMeasures::new(structure, pga_m_s2, pgv_m_s, None, None);
    let probabilities = model.probabilities(structure, &measures, scenarios);
    let (rocking, unknown) = (Probability::exact(1.0 - probabilities.p_nr), Probability::exact(f64::NAN));
    probabilities.limit_states().unwrap_or([rocking, unknown, unknown])
}

/// Step and last node of the trapezoidal rule in standard deviations: exact to 1e-7 for smooth functions under a
/// normal density.
const STEP: f64 = 0.625;
const LAST_NODE: i32 = 8;

impl<'a> Along<'a> {
    /// The same motions with another ratio.
    pub fn with(self, ratio: Ratio) -> Along<'a> {
        Along { ratio, ..self }
    }

    /// PGA and PGV (m/s2 and m/s) of motions of an intensity (that of the peak), with weights whose sum is 1.
    pub fn motions(&self, intensity: f64) -> Vec<([f64; 2], f64)> {
        self.nodes().into_iter().map(|(node, weight)| (self.peaks(intensity, node), weight)).collect()
    }

    /// PGA and PGV of the motions of median PGV / PGA.
    pub fn median_motion(&self, intensity: f64) -> [f64; 2] {
        self.peaks(intensity, self.nodes()[self.nodes().len() / 2].0)
    }

    /// Probabilities of LS1, LS2 and LS3 at an intensity, with limits; NaN where the model has none.
    pub fn limit_states(&self, intensity: f64, scenarios: Scenarios) -> [Probability; 3] {
        let mut mean = [Probability::exact(0.0); 3];
        for (peaks, weight) in self.motions(intensity) {
            let states = limit_states_at(self.model, self.structure, peaks, scenarios);
            for (sum, state) in mean.iter_mut().zip(states) {
                sum.value += weight * state.value;
                sum.low += weight * state.low;
                sum.high += weight * state.high;
            }
        }
        mean
    }

    /// Intensities at which a probability jumps: that of uplift first, then those of the planes' transition.
    pub fn jumps(&self) -> Vec<f64> {
        let transitions = match self.model {
            Model::Paper { demand, .. } => demand.iter().filter_map(|fit| fit.range_low).collect(),
            Model::Calibrated { .. } => Vec::new(),
        };
        let uplift = self.structure.uplift_acceleration_m_s2();
        let levels = std::iter::once(1.0).chain(transitions.into_iter().filter(|&im4: &f64| im4 > 1.0));
        let mut jumps: Vec<f64> = match self.peak {
            Peak::Pga => levels.map(|im4| im4 * uplift).collect(),
            Peak::Pgv => levels.flat_map(|im4| self.pgv_at(im4 * uplift)).collect(),
        };
        jumps.sort_by(f64::total_cmp);
        jumps.dedup();
        jumps
    }

    /// PGV at which the motions of each node have a PGA, m/s2: by bisection, since the median ratio bends.
    fn pgv_at(&self, pga_m_s2: f64) -> Vec<f64> {
        let bisect = |(node, _)| {
            let (mut low, mut high) = (1e-6_f64, 1e3_f64);
            while high > low * (1.0 + 1e-12) {
                let middle = (low * high).sqrt();
                if self.peaks(middle, node)[0] < pga_m_s2 { low = middle } else { high = middle }
            }
            high
        };
        self.nodes().into_iter().map(bisect).collect()
    }

    /// Standard deviations from the median, with their weights.
    fn nodes(&self) -> Vec<(f64, f64)> {
        let Ratio::Distributed = self.ratio else { return vec![(0.0, 1.0)] };
        let density = |z: f64| STEP * libm::exp(-0.5 * z * z) / TAU.sqrt();
        let nodes = (-LAST_NODE..=LAST_NODE).map(|k| STEP * f64::from(k));
        nodes.map(|z| (z, density(z))).collect()
    }

    fn peaks(&self, intensity: f64, node: f64) -> [f64; 2] {
        let of_model = |deviations| self.model.peaks().pgv_over_pga(self.peak, intensity, deviations);
        let ratio = match self.ratio {
            Ratio::Distributed => of_model(node),
            Ratio::Deviations(deviations) => of_model(deviations),
            Ratio::Seconds(ratio) => ratio,
        };
        match self.peak {
            Peak::Pga => [intensity, intensity * ratio],
            Peak::Pgv => [intensity / ratio, intensity],
        }
    }
}
