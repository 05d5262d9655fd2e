use crate::keyword::keywords;
use crate::motion::IntensityMeasures;
use crate::rocking::Outcome;

/// A response as the fits see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    /// Which branch of the tree it took.
    pub outcome: Outcome,
    /// |theta|max / alpha; infinite where it overturns.
    pub edp: f64,
    /// The measures of Eq. 13.
    pub measures: IntensityMeasures,
}

impl Case {
    /// Whether P_ex is about it: it rocked and came back, with a demand that has a logarithm.
    pub fn has_demand(&self) -> bool {
        self.outcome == Outcome::SafeRocking && self.edp > 0.0
    }
}

/// The event whose probability a curve gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// Rocking: 1 - P_nr.
    Rocking,
    /// Overturning given rocking: P_ro.
    Overturning,
    /// A demand above the limit given safe rocking: P_ex.
    Exceeding,
    /// Failure given rocking, overturning or a demand above the limit: P_f|r (Eq. 12).
    Failure,
}

keywords!(Event {
    Overturning = "overturning",
    Rocking = "rocking",
    Exceeding = "exceeding",
    Failure = "failure",
});

impl Event {
    /// The branches of the tree of Figure 6 that have a curve of their own.
    pub const BRANCHES: [Event; 2] = [Event::Overturning, Event::Exceeding];

    /// Whether it happened in a case, `limit` being the demand that P_ex is about; none if the case does not count.
    pub fn happened(self, case: &Case, limit: f64) -> Option<bool> {
        let overturned = case.outcome == Outcome::Overturning;
        match (self, case.outcome) {
            (Event::Rocking, outcome) => Some(outcome != Outcome::NoRocking),
            (_, Outcome::NoRocking) | (Event::Exceeding, Outcome::Overturning) => None,
            (Event::Overturning, _) => Some(overturned),
            (Event::Exceeding | Event::Failure, _) => Some(overturned || case.edp > limit),
        }
    }
}

/// A dimensionless intensity measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Measure {
    /// wp / p.
    Im1,
    /// wm / p.
    Im2,
    /// PGA / (p PGV).
    Im3,
    /// PGA / (g tan alpha).
    Im4,
    /// p PGV / (g tan alpha).
    Im5,
    /// wm PGV / (g tan alpha).
    Im6,
    /// p PGV / PGA: the frequency ratio of Figure 12.
    Im3Inverse,
}

keywords!(Measure {
    Im1 = "im1",
    Im2 = "im2",
    Im3 = "im3",
    Im4 = "im4",
    Im5 = "im5",
    Im6 = "im6",
    Im3Inverse = "im3_inv",
});

impl Measure {
    /// The six of Eq. 13.
    pub const SCALAR: [Measure; 6] =
        [Measure::Im1, Measure::Im2, Measure::Im3, Measure::Im4, Measure::Im5, Measure::Im6];

    /// Its value in a case; none where it is missing or not positive, so that it has no logarithm.
    pub fn of(self, case: &Case) -> Option<f64> {
        self.among(&case.measures)
    }

    /// Its value among those of a motion; none as in a case.
    pub fn among(self, measures: &IntensityMeasures) -> Option<f64> {
        let value = match self {
            Measure::Im1 => measures.im1,
            Measure::Im2 => measures.im2,
            Measure::Im3 => measures.im3,
            Measure::Im4 => Some(measures.im4),
            Measure::Im5 => Some(measures.im5),
            Measure::Im6 => measures.im6,
            Measure::Im3Inverse => measures.im3.map(|im3| 1.0 / im3),
        };
        value.filter(|value| value.is_finite() && *value > 0.0)
    }
}
