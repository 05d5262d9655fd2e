use crate::keyword::keywords;

/// A kind of ground motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Suite {
    /// The coherent pulse alone.
    Pulse,
    /// The combined synthetic ground motion: pulse and high frequencies.
    Csgm,
    /// The stochastic high-frequency component alone.
    Hfc,
    /// A recorded motion.
    Record,
    /// What is left of a recorded motion without its pulse.
    Residual,
}

/// Numbers that each scenario keeps for its motions.
const MOTIONS_OF_SCENARIO: i64 = 4;

keywords!(Suite { Pulse = "pulse", Csgm = "csgm", Hfc = "hfc", Record = "record", Residual = "residual" });

impl Suite {
    /// The synthetic motion of a scenario in this suite: unique across suites, and the same whichever suites are made.
    pub fn motion_id(self, scenario_id: i64) -> i64 {
        scenario_id * MOTIONS_OF_SCENARIO + self as i64
    }
}
