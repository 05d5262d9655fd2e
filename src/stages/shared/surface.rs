//! The universal surface as an answer: for which motions and limit state, with its words.

use super::answers::Answers;
use crate::fragility::universal::{self, Scenarios, other_structure};
use crate::fragility::{Fragility, JointPeaks, LimitState, Slice, UniversalModel};
use crate::keyword::{self, Keyword};
use crate::motion::{IntensityMeasures, Suite};
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::check;
use crate::rocking::Structure;

/// The limit state of the paper: what P_ex of the surface is about unless another demand is asked for.
pub const PAPER_LIMIT: f64 = 0.1;
/// How it did on motions that it was not made of (`docs/universal.md`).
const OF_OTHER_MOTIONS: &str = "on average over 320 blocks, recorded motions overturned 7 to 18 % more often than it says, and synthetic ones on rock \
     overturned blocks that seldom fall a fifth less often, some of them half as often";
/// What to say where PGV is 0.
pub const NEEDS_VELOCITY: &str = "the surface needs a velocity: give --pgv above 0";
/// How an answer of the surface begins.
pub const UNIVERSAL: &str = "universal fragility surface";

/// The surface for one kind of motion and one limit state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface(pub UniversalModel);

impl Surface {
    /// For what is asked.
    ///
    /// # Errors
    /// If the limit state or the suite is none of the surface.
    pub fn new(suite: Option<&str>, limit: Option<f64>, scenarios: Scenarios) -> anyhow::Result<Surface> {
        let limit = limit.unwrap_or(PAPER_LIMIT);
        let [least, largest] = universal::limits();
        check(
            limit >= least && limit <= largest,
            "limit-state",
            limit,
            &format!("a demand |theta|max / alpha from {least} to {largest}"),
        )?;
        let motions = match suite {
            None => Suite::Csgm,
            Some(word) => known_suite(word).ok_or_else(|| {
                UsageError::because(format!(
                    "suite '{word}' is none of the universal surface; expected pulse, csgm or hfc"
                ))
            })?,
        };
        Ok(Surface(UniversalModel { limit, motions, scenarios }))
    }

    /// Beside fits of a suite: of combined motions if it has no such, and of the nearest limit state that it knows.
    pub fn beside(suite: Option<&str>, limit: f64, scenarios: Scenarios) -> Surface {
        let [least, largest] = universal::limits();
        let motions = suite.and_then(known_suite).unwrap_or(Suite::Csgm);
        Surface(UniversalModel { limit: limit.clamp(least, largest), motions, scenarios })
    }
}

/// That no limit state is asked of fits.
///
/// # Errors
/// If one is.
pub fn expect_no_limit(limit: Option<f64>) -> anyhow::Result<()> {
    match limit {
        None => Ok(()),
        Some(_) => Err(UsageError::because(
            "limit-state is of the universal surface; that of fits is chosen by fit-pex --limit-state",
        )),
    }
}

fn known_suite(word: &str) -> Option<Suite> {
    keyword::parse(word).ok().filter(|suite| Suite::SYNTHETIC.contains(suite))
}

fn warn_of_outside(name: &str, value: f64, [least, largest]: [f64; 2], console: &Console) {
    console
        .warn(&format!("{name} is {value:.4}, outside of {least} to {largest} of the surface: extrapolated"));
}

impl Answers for Surface {
    fn model(&self) -> &dyn Fragility {
        &self.0
    }

    fn limit(&self) -> f64 {
        self.0.limit
    }

    fn words(&self) -> String {
        let motions = match self.0.motions {
            Suite::Pulse => "pulse, pulses alone",
            Suite::Hfc => "hfc, high frequencies alone",
            _ => "csgm, pulses with high frequencies",
        };
        format!("{UNIVERSAL}, of motions {motions}")
    }

    fn words_of_limits(&self) -> String {
        let of = match self.0.scenarios {
            Scenarios::One => "for one structure at one magnitude and distance that the surface has not seen",
            Scenarios::Many => {
                "for one structure that the surface has not seen, over many magnitudes and distances"
            }
        };
        format!("{of}; {OF_OTHER_MOTIONS}")
    }

    fn meaning(&self, state: LimitState) -> String {
        match state {
            LimitState::Rocking => "rocking".to_string(),
            LimitState::Failure => {
                format!("|theta|max / alpha above {}, or overturning, by the universal surface", self.0.limit)
            }
            LimitState::Overturning => "overturning, by the universal surface".to_string(),
        }
    }

    fn words_of_missing(&self, _: &IntensityMeasures) -> String {
        NEEDS_VELOCITY.to_string()
    }

    fn peaks(&self) -> Option<JointPeaks> {
        self.0.peaks()
    }

    fn words_of_motions(&self) -> &'static str {
        "of the surface"
    }

    fn is_other_structure(&self, structure: &Structure) -> bool {
        other_structure(structure).next().is_some()
    }

    fn words_of_others(&self) -> String {
        "a structure outside of those of the surface: extrapolated".to_string()
    }

    fn warn_of_structure(&self, structure: &Structure, console: &Console) {
        for other in other_structure(structure) {
            warn_of_outside(other.parameter, other.value, other.range, console);
        }
    }

    fn warn_of_range(&self, measures: &IntensityMeasures, subject: &str, console: &Console) {
        for out in self.0.out_of_range(measures) {
            let name = format!("{subject}{}", out.measure.as_str());
            warn_of_outside(&name, out.value, out.range, console);
        }
    }

    fn warn_of_slice(&self, slice: &Slice, to: f64, subject: &str, console: &Console) {
        self.warn_of_range(&slice.measures(to), subject, console);
    }
}
