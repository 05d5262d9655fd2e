use crate::keyword::{Keyword, keywords};

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
}

keywords!(Suite { Pulse = "pulse", Csgm = "csgm", Hfc = "hfc", Record = "record" });

impl Suite {
    /// The motion of a scenario in this suite: unique across suites, and the same whichever suites are made.
    pub fn motion_id(self, scenario_id: i64) -> i64 {
        scenario_id * Suite::ALL.len() as i64 + self as i64
    }
}
