//! The universal surface: P_ro and P_ex of any structure. data/universal.csv holds it; scripts/universal makes it.

use crate::keyword::keywords;
use crate::motion::{IntensityMeasures, Suite};
use crate::rocking::Structure;

/// Kinds of motion that the surface knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Recorded motions.
    Recorded,
    /// Combined synthetic motions on rock: pulse and high frequencies.
    Csgm,
    /// Coherent pulses alone.
    Pulse,
    /// High frequencies alone.
    Hfc,
}

keywords!(Kind { Recorded = "recorded", Csgm = "csgm", Pulse = "pulse", Hfc = "hfc" });

impl Kind {
    /// The kind of a suite of motions; those without a suite are taken for recorded ones.
    pub fn of(suite: Option<Suite>) -> Kind {
        match suite {
            Some(Suite::Pulse) => Kind::Pulse,
            Some(Suite::Csgm) => Kind::Csgm,
            Some(Suite::Hfc) => Kind::Hfc,
            Some(Suite::Record | Suite::Residual) | None => Kind::Recorded,
        }
    }
}

/// The logit of P_ro by the surface; none where a measure is missing.
pub fn logit_overturning(_kind: Kind, _structure: &Structure, _measures: &IntensityMeasures) -> Option<f64> {
    todo!()
}

/// The logit of P_ex by the surface at a limit state |theta|max / alpha; none where a measure is missing.
pub fn logit_exceeding(
    _kind: Kind,
    _structure: &Structure,
    _measures: &IntensityMeasures,
    _limit_state: f64,
) -> Option<f64> {
    todo!()
}
