//! What pages show of an evaluation: objects with their rates at a site, in a reader's words.

use super::figure::{Estimate, Ink};
use super::portrait::Portrait;
use super::text::literal;
use crate::number::{self, Limited, PERCENT};
use crate::object::Part;

/// An evaluation of objects over the hazard of a site.
#[derive(Debug, Clone, Default)]
pub struct Evaluation {
    /// Name of its file, where there are several.
    pub file: String,
    /// Exposure time, years; none under one motion.
    pub years: Option<f64>,
    /// The exposure time or the motion, in words: `in 50 years`.
    pub when: String,
    /// Probability of overturning that is aimed at.
    pub target: Option<f64>,
    /// The hazard, in words.
    pub hazard: String,
    /// Key of the hazard: the same for the same files.
    pub hazard_key: String,
    /// The fraction of the slenderness that is too far.
    pub limit_state: f64,
    pub rows: Vec<Rated>,
    /// Of a single object what its page shows besides.
    pub portrait: Portrait,
}

/// An object, and how often it reaches each limit state.
#[derive(Debug, Clone, Default)]
pub struct Rated {
    /// None where it was given without one.
    pub name: Option<String>,
    /// Block, body or frame.
    pub kind: String,
    pub size: String,
    /// The floor that it stands on, in words; none on the ground.
    pub floor: Option<String>,
    /// Number of such objects.
    pub count: Option<f64>,
    /// Without this much friction it slides.
    pub friction: Option<f64>,
    /// Annual rate of overturning.
    pub rate: Limited,
    pub once_in_years: Option<f64>,
    /// Probabilities in the exposure time.
    pub rocking: Option<f64>,
    pub failure: Limited,
    pub overturning: Limited,
    /// Standard deviations of ln of the rate, by what is not known.
    pub sds: Vec<(Part, f64)>,
    /// What speaks against the answer, or why there is none.
    pub doubts: Option<String>,
    pub model: String,
}

/// Probabilities of overturning, in the exposure time, that part the bands of a figure: those of the
/// earthquakes that codes design for and consider, with 10 and 2 % in 50 years.
pub const BANDS: [f64; 2] = [0.02, 0.1];

/// The bands in words.
pub const BAND_NAMES: [&str; 3] = ["below 2 %", "2 to 10 %", "above 10 %"];

impl Rated {
    pub fn is_answered(&self) -> bool {
        self.rate.value.or(self.rate.high).is_some()
    }

    /// Marked text.
    pub fn title(&self) -> String {
        self.name.as_deref().map_or_else(|| format!("{} of {}", self.kind, self.size), literal)
    }

    /// The probability of overturning by which objects are sorted: where there is no value its upper end.
    pub fn severity(&self) -> f64 {
        self.overturning.value.or(self.overturning.high).unwrap_or(f64::NEG_INFINITY)
    }

    pub fn band(&self) -> usize {
        BANDS.iter().filter(|end| self.severity() > **end).count()
    }

    pub fn ink(&self) -> Ink {
        Ink::Band(self.band())
    }

    /// The sentence that answers how likely it overturns.
    pub fn sentence(&self, when: &str) -> String {
        let p = self.overturning;
        match (p.value, p.high, self.once_in_years) {
            (Some(0.0), ..) => "does not overturn: nothing of the hazard uplifts it".to_string(),
            (Some(_), _, Some(period)) => format!(
                "overturns with a probability of {} {when} {}: once in {} years",
                PERCENT.value(p),
                PERCENT.limits(p, "95 % limits "),
                number::period(period)
            ),
            (Some(_), ..) => format!(
                "overturns with a probability of {} {when} {}",
                PERCENT.value(p),
                PERCENT.limits(p, "95 % limits ")
            ),
            (_, Some(_), _) => format!(
                "overturns with a probability of {} {when}: the hazard ends too early for one number",
                PERCENT.value(p)
            ),
            _ => "has no rate of overturning".to_string(),
        }
    }
}

/// A probability with its limits in a row of a figure, in percent.
pub fn percent_in_row(p: Limited, y: f64) -> Estimate {
    let [x, low, high] = [p.value, p.low, p.high].map(|p| p.map_or(f64::NAN, |p| 100.0 * p));
    Estimate { x, y, low, high, n: f64::NAN }
}
