//! Probabilities given one peak, PGA or PGV: averaged over PGV / PGA of the motions that have it.

use super::joint_peaks::{Peak, RatioGiven};
use super::model::{Model, RockingDirection};
use super::model_point::{ModelPoint, Tau};
use super::on_floor::UpliftIntensities;
use super::ready::ReadyObject;
use super::surface;
use super::tree::LimitStates;
use crate::motion::Peaks;
use crate::statistics::numerics::{QuadraturePanel, bisect_first_true, panels};
use crate::statistics::{Interval, Range, normal};

/// Ratios further from the median than this many standard deviations do not count.
const FARTHEST: f64 = 6.0;
/// Nor do those this far below the median at one PGA: probabilities fall with PGV / PGA, and the rest adds
/// less than a millionth.
const FARTHEST_BELOW: f64 = 5.0;
/// Step of the trapezoidal rule on floors and over lists, in standard deviations: probabilities have no jumps
/// there.
const SMOOTH_STEP: f64 = 0.8;
/// Widest panel of the quadrature, in standard deviations, over the motions of a PGA and over those of a PGV,
/// which reach down to uplift.
const PANEL_OF_PGA: f64 = 3.0;
const PANEL_OF_PGV: f64 = 1.0;
/// Probabilities rise steeply from the PGA of uplift to this multiple of it.
const STEEP: f64 = 1.15;
/// PGV between which the uplift of any structure is sought, m/s.
const SOUGHT_M_S: Range = Range { low: 1e-6, high: 1e3 };

/// An object under motions conditional on one peak.
pub struct GivenPeak<'a> {
    pub directions: &'a [RockingDirection],
    ready: ReadyObject<'a>,
    pub peak: Peak,
    ratio: RatioGiven,
    bends: Vec<Bend>,
}

/// Where the prediction for a direction bends.
struct Bend {
    /// ln(PGV / PGA), s.
    ln_pgv_pga: f64,
    /// ln of the PGA (m/s2) beyond which PGV alone counts.
    ln_held_pga: f64,
}

impl<'a> GivenPeak<'a> {
    /// `ratio` is the distribution of PGV / PGA; an unknown magnitude is inferred from PGV / PGA.
    pub fn new(
        directions: &'a [RockingDirection],
        peak: Peak,
        ratio: RatioGiven,
        mw: Option<f64>,
    ) -> GivenPeak<'a> {
        let mut bends = Vec::new();
        for RockingDirection { structure, model, .. } in directions {
            let ln_held_pga = surface::held_pga_m_s2(structure).ln();
            bends.extend(model.bends(mw).into_iter().map(|ln_pgv_pga| Bend { ln_pgv_pga, ln_held_pga }));
        }
        GivenPeak { directions, ready: ReadyObject::new(directions, mw), peak, ratio, bends }
    }

    /// The peaks of motions whose PGV / PGA is this many standard deviations above its median.
    pub fn peaks(&self, intensity: f64, deviations: f64) -> Peaks {
        let ratio = self.ratio.ratio(intensity, deviations);
        match self.peak {
            Peak::Pga => Peaks { pga_m_s2: intensity, pgv_m_s: intensity * ratio },
            Peak::Pgv => Peaks { pga_m_s2: intensity / ratio, pgv_m_s: intensity },
        }
    }

    pub fn limit_states(&self, intensity: f64) -> LimitStates<Option<f64>> {
        self.at_points(intensity, &[ModelPoint::Estimate])[0]
    }

    pub fn estimates(&self, intensity: f64, tau: Tau) -> LimitStates<Option<Interval>> {
        LimitStates::from_points(&self.at_points(intensity, &ModelPoint::at_limits(tau)))
    }

    pub(crate) fn at_points(&self, intensity: f64, points: &[ModelPoint]) -> Vec<LimitStates<Option<f64>>> {
        let mut means = vec![LimitStates::all(Some(0.0)); points.len()];
        if self.peak == Peak::Pga && intensity < self.least_uplift_m_s2() {
            return means;
        }
        let mut states = means.clone();
        let at_pga = (self.peak == Peak::Pga).then(|| self.ready.at(intensity));
        self.for_each_node(intensity, |ln_pgv_pga, weight| {
            match &at_pga {
                Some(at_pga) => at_pga.limit_states(ln_pgv_pga, points, &mut states),
                None => {
                    let at_pga = self.ready.at(intensity * (-ln_pgv_pga).exp());
                    at_pga.limit_states(ln_pgv_pga, points, &mut states);
                }
            }
            for (mean, state) in means.iter_mut().zip(&states) {
                *mean = mean.zip(*state, |sum, p| Some(sum? + weight * p?));
            }
        });
        means
    }

    fn least_uplift_m_s2(&self) -> f64 {
        let uplifts = self.directions.iter().map(|direction| direction.uplift_m_s2().least);
        uplifts.fold(f64::INFINITY, f64::min)
    }

    pub fn uplift(&self) -> UpliftIntensities {
        let usual = self.directions.iter().map(|direction| direction.uplift_m_s2().usual);
        UpliftIntensities {
            least: self.intensity_of(self.least_uplift_m_s2(), -FARTHEST),
            usual: self.intensity_of(usual.fold(f64::INFINITY, f64::min), 0.0),
        }
    }

    /// Intensities at which a probability jumps: uplift, and the transition of the planes. At one PGV,
    /// averaging over PGA leaves no jump.
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
        all.truncate(if self.is_list() { 1 } else { all.len() });
        if self.peak == Peak::Pga {
            all.extend(all.clone().into_iter().map(|jump| STEEP * jump));
        }
        if self.ratio.bend != 0.0 {
            all.push(self.ratio.knot.exp());
        }
        all
    }

    /// Widest panel of ln of the peak over which probabilities are smooth: the paper's lower plane under
    /// pulses has a dispersion of 0.03.
    pub(crate) fn widest_panel(&self) -> f64 {
        let mut models = self.directions.iter().map(|direction| &direction.model);
        if models.any(|model| matches!(**model, Model::Paper { .. })) { 0.02 } else { 0.6 }
    }

    /// In m/s2, rising.
    fn jumps_of_pga(&self) -> Vec<f64> {
        let mut all = Vec::new();
        for direction in self.directions {
            let uplift = direction.uplift_m_s2().least;
            all.push(uplift);
            if let Model::Paper { demand, .. } = &*direction.model {
                let transitions = demand.iter().filter_map(|fit| fit.range_low).filter(|&im4| im4 > 1.0);
                all.extend(transitions.map(|im4| im4 * uplift));
            }
        }
        all.sort_by(f64::total_cmp);
        all
    }

    /// The intensity at which motions this many standard deviations from the median have this PGA (m/s2): by
    /// bisection, since the median bends.
    fn intensity_of(&self, pga_m_s2: f64, deviations: f64) -> f64 {
        if self.peak == Peak::Pga {
            return pga_m_s2;
        }
        let sought = SOUGHT_M_S.ln();
        bisect_first_true(sought.low, sought.high, |ln_pgv| {
            self.peaks(ln_pgv.exp(), deviations).pga_m_s2 >= pga_m_s2
        })
        .exp()
    }

    /// Visits the nodes of the quadrature over the motions of an intensity: ln(PGV / PGA), s, and weight. The
    /// weights sum to 1, less those of motions of too little PGA.
    fn for_each_node(&self, intensity: f64, mut visit: impl FnMut(f64, f64)) {
        let ln_intensity = intensity.ln();
        let mut visit = |(deviations, width): (f64, f64)| {
            visit(self.ratio.ln_ratio(ln_intensity, deviations), width * normal::density(deviations));
        };
        if self.ratio.is_exact() {
            visit((0.0, 1.0 / normal::density(0.0)));
        } else if self.is_list() || self.peak == Peak::Pga && self.is_on_floor() {
            let first = if self.peak == Peak::Pga { -FARTHEST_BELOW } else { -FARTHEST };
            let [first, last] = [first, FARTHEST].map(|end| (end / SMOOTH_STEP).round() as i32);
            (first..=last).for_each(|k| visit((SMOOTH_STEP * f64::from(k), SMOOTH_STEP)));
        } else {
            let widest = if self.peak == Peak::Pga { PANEL_OF_PGA } else { PANEL_OF_PGV };
            for edge in self.edges(ln_intensity).windows(2) {
                panels(edge[0], edge[1], widest).flat_map(QuadraturePanel::nodes).for_each(&mut visit);
            }
        }
    }

    fn is_list(&self) -> bool {
        self.directions.iter().any(|direction| direction.count.is_some())
    }

    fn is_on_floor(&self) -> bool {
        self.directions.iter().all(|direction| direction.model.floor().is_some())
    }

    /// Edges, in standard deviations, between which probabilities are smooth in PGV / PGA.
    fn edges(&self, ln_intensity: f64) -> Vec<f64> {
        let median = self.ratio.ln_ratio(ln_intensity, 0.0);
        let deviations = |ln_pgv_pga: f64| {
            let above = ln_pgv_pga - median;
            above / (self.ratio.ln_ratio(ln_intensity, above.signum()) - median).abs()
        };
        let first = if self.peak == Peak::Pga { -FARTHEST_BELOW } else { -FARTHEST };
        let mut edges = vec![first];
        if self.ratio.sd_below != self.ratio.sd_above {
            edges.push(0.0);
        }
        for Bend { ln_pgv_pga, ln_held_pga } in &self.bends {
            let excess = (ln_intensity - ln_held_pga).max(0.0);
            edges.push(deviations(if self.peak == Peak::Pga { ln_pgv_pga - excess } else { *ln_pgv_pga }));
        }
        let mut last = FARTHEST;
        if self.peak == Peak::Pgv {
            // Motions beyond the last jump do not uplift the structure, and so do not count.
            let jumps = self.jumps_of_pga();
            edges.extend(self.bends.iter().map(|bend| deviations(ln_intensity - bend.ln_held_pga)));
            let steep = jumps.iter().flat_map(|pga| [*pga, STEEP * pga]);
            edges.extend(steep.map(|pga| deviations(ln_intensity - pga.ln())));
            last = deviations(ln_intensity - jumps[0].ln()).min(FARTHEST);
        }
        edges.push(last);
        edges.retain(|edge| (first..=last).contains(edge));
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        edges
    }
}
