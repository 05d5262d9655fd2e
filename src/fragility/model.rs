//! What answers: the calibrated surface, or the curve and planes of the paper.

use super::calibration::{Calibration, Scenarios};
use super::demand::DemandFit;
use super::overturning::OverturningFit;
use super::peaks::JointPeaks;
use super::surface::Kind;
use super::tree::Probabilities;
use crate::doubt::Doubt;
use crate::motion::IntensityMeasures;
use crate::rocking::Structure;

/// What answers for one structure and limit state.
#[derive(Debug, Clone, PartialEq)]
pub enum Model {
    /// The universal surface, calibrated.
    Calibrated { overturning: Calibration, exceeding: Calibration, peaks: JointPeaks },
    /// The paper's planes (or the one line that holds everywhere) and its lognormal curve.
    Paper { demand: Vec<DemandFit>, overturning: OverturningFit, limit_state: f64, peaks: JointPeaks },
}

impl Model {
    /// That of a structure without fits: the surface for this kind of motion.
    pub fn shipped(_kind: Kind, _structure: &Structure, _limit_state: f64) -> Model {
        todo!()
    }

    /// The probabilities of the tree at an intensity (Eq. 12).
    pub fn probabilities(
        &self,
        _structure: &Structure,
        _measures: &IntensityMeasures,
        _scenarios: Scenarios,
    ) -> Probabilities {
        todo!()
    }

    /// How PGA and PGV go together in the motions that it stands for.
    pub fn peaks(&self) -> &JointPeaks {
        match self {
            Model::Calibrated { peaks, .. } | Model::Paper { peaks, .. } => peaks,
        }
    }

    /// What speaks against its answer at an intensity.
    pub fn doubts(&self, _structure: &Structure, _measures: &IntensityMeasures) -> Vec<Doubt> {
        todo!()
    }
}
