//! What answers: fits of one structure, or the surface of all, with the words of each.

use super::structures::StructureSpec;
use crate::fragility::universal::Scenarios;
use crate::fragility::{
    Fragility, JointPeaks, LimitState, Probabilities, ResampledModel, Slice, UniversalModel,
};
use crate::motion::IntensityMeasures;
use crate::pipeline::console::Console;
use crate::rocking::Structure;

/// What answers.
pub trait Answers: Send + Sync {
    /// The same without its words.
    fn model(&self) -> &dyn Fragility;

    /// The probabilities of a structure at an intensity, with their limits.
    fn probabilities(&self, structure: &Structure, measures: &IntensityMeasures) -> Probabilities {
        self.model().of_structure(structure, measures)
    }

    /// The fits to resampled cases, where limits come from them.
    fn resampled(&self) -> Option<&ResampledModel> {
        None
    }

    /// The coefficient of restitution where none is given.
    fn eta(&self) -> Option<f64> {
        None
    }

    /// The structure that is asked for.
    ///
    /// # Errors
    /// If it is none, or has no eta and none is known.
    fn structure(&self, asked: &StructureSpec) -> anyhow::Result<Structure> {
        match self.eta() {
            Some(eta) => asked.structure_with_eta(eta),
            None => asked.structure(),
        }
    }

    /// The suite and the structure whose responses were fitted; none where the surface answers.
    fn fitted(&self) -> Option<(Option<&str>, &str)> {
        None
    }

    /// What speaks against annual rates, where few events decide them: their limits hold less than they seem to.
    fn doubt_of_rates(&self) -> Option<String> {
        None
    }

    /// The demand that P_ex is about.
    fn limit(&self) -> f64;

    /// The one measure that P_ro is a function of, if there is one.
    fn hybrid_measure(&self, _: &IntensityMeasures) -> Option<f64> {
        None
    }

    /// In words.
    fn words(&self) -> String;

    /// How the limits come about, in words.
    fn words_of_limits(&self) -> String;

    /// What a limit state is, in words.
    fn meaning(&self, state: LimitState) -> String;

    /// Which measures are missing, and what to give for them.
    fn words_of_missing(&self, measures: &IntensityMeasures) -> String;

    /// The surface, to be asked besides; none where it answers itself.
    fn surface(&self, _: Scenarios) -> Option<UniversalModel> {
        None
    }

    /// How PGA and PGV go together in the motions behind it, if it is known.
    fn peaks(&self) -> Option<JointPeaks>;

    /// Of which motions that is, in words.
    fn words_of_motions(&self) -> &'static str;

    /// Warns of what speaks against it, whatever the question.
    fn warn(&self, _: &Console) {}

    /// Whether it is of another slenderness or size.
    fn is_other_block(&self, _: &Structure) -> bool {
        false
    }

    /// Whether the structure is none of those behind it: its eta, or whatever it has.
    fn is_other_structure(&self, structure: &Structure) -> bool;

    /// Of rows of which that is so, in words.
    fn words_of_others(&self) -> String;

    /// Warns that a structure is none of those behind it, and why.
    fn warn_of_structure(&self, structure: &Structure, console: &Console);

    /// Warns that these measures, of what `subject` says, lie outside of the data.
    fn warn_of_range(&self, measures: &IntensityMeasures, subject: &str, console: &Console);

    /// Warns that a slice lies outside of the data, or goes up `to` an intensity outside of them.
    fn warn_of_slice(&self, slice: &Slice, to: f64, subject: &str, console: &Console);
}
