use crate::keyword::keywords;

/// How a structure came through a ground motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It never left its base.
    NoRocking,
    /// It rocked and came back.
    SafeRocking,
    /// Its rotation reached pi/2, or will after the record by its energy.
    Overturning,
}

keywords!(Outcome {
    NoRocking = "no_rocking",
    SafeRocking = "safe_rocking",
    Overturning = "overturning",
});

/// The response of one structure to one ground motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Which branch of the tree of Figure 6 it took.
    pub outcome: Outcome,
    /// Engineering demand parameter |theta|max / alpha (Eq. 7); where it overturns, pi / (2 alpha).
    pub edp: f64,
    /// Impacts within the duration of the record.
    pub impacts: u32,
}
