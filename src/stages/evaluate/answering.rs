//! What answers: fits of one structure, or the surface of all.

use super::answer::{FITS_OF, UNIVERSAL};
use crate::fragility::universal::{self, Scenarios, other_structure};
use crate::fragility::{
    FragilityModel, JointPeaks, LimitState, OutOfRange, Probabilities, ResampledModel, Slice, UniversalModel,
};
use crate::keyword::{self, Keyword};
use crate::motion::{IntensityMeasures, Suite};
use crate::pipeline::console::Console;
use crate::rocking::Structure;
use crate::stages::shared::chosen_fits::ChosenFits;

/// What answers.
pub enum Answering {
    Fits(Box<ChosenFits>),
    Universal(UniversalModel),
}

/// What answers, without its words.
#[derive(Clone, Copy)]
pub enum Model<'a> {
    Fits(&'a FragilityModel),
    Universal(&'a UniversalModel),
}

impl Model<'_> {
    /// The probabilities of a structure at an intensity.
    pub fn probabilities(self, structure: &Structure, measures: &IntensityMeasures) -> Probabilities {
        match self {
            Model::Fits(model) => model.probabilities(measures),
            Model::Universal(model) => model.probabilities(structure, measures),
        }
    }

    /// The measures outside of the data.
    pub fn out_of_range(self, measures: &IntensityMeasures) -> Vec<OutOfRange> {
        match self {
            Model::Fits(model) => model.out_of_range(measures).collect(),
            Model::Universal(model) => model.out_of_range(measures).collect(),
        }
    }

    /// The intensities along a slice at which probabilities jump.
    pub fn jumps(self, slice: &Slice) -> Vec<f64> {
        match self {
            Model::Fits(model) => slice.jumps(model),
            Model::Universal(_) => vec![slice.intensity_at_im4(1.0)],
        }
    }
}

impl Answering {
    pub fn model(&self) -> Model<'_> {
        match self {
            Answering::Fits(fits) => Model::Fits(&fits.model),
            Answering::Universal(model) => Model::Universal(model),
        }
    }

    /// The fits to resampled cases, where limits come from them.
    pub fn resampled(&self) -> Option<&ResampledModel> {
        match self {
            Answering::Fits(fits) => fits.resampled.as_ref(),
            Answering::Universal(_) => None,
        }
    }

    /// The coefficient of restitution where none is given.
    pub fn eta(&self) -> Option<f64> {
        match self {
            Answering::Fits(fits) => Some(fits.model.eta),
            Answering::Universal(_) => None,
        }
    }

    /// The demand that P_ex is about.
    pub fn limit(&self) -> f64 {
        match self {
            Answering::Fits(fits) => fits.model.limit,
            Answering::Universal(model) => model.limit,
        }
    }

    /// The probabilities of a structure at an intensity, with their limits.
    pub fn probabilities(&self, structure: &Structure, measures: &IntensityMeasures) -> Probabilities {
        match self {
            Answering::Fits(fits) => fits.probabilities(measures),
            Answering::Universal(model) => model.probabilities(structure, measures),
        }
    }

    /// The one measure that P_ro is a function of, if there is one.
    pub fn hybrid_measure(&self, measures: &IntensityMeasures) -> Option<f64> {
        match self {
            Answering::Fits(fits) => {
                let overturning = &fits.model.overturning;
                overturning.im_y.and_then(|_| overturning.hybrid_measure(measures))
            }
            Answering::Universal(_) => None,
        }
    }

    /// In words.
    pub fn words(&self) -> String {
        match self {
            Answering::Fits(fits) => format!("{FITS_OF}{}", fits.words()),
            Answering::Universal(model) => {
                let motions = match model.motions {
                    Suite::Pulse => "pulse, pulses alone",
                    Suite::Hfc => "hfc, high frequencies alone",
                    _ => "csgm, pulses with high frequencies",
                };
                format!("{UNIVERSAL}, of motions {motions}")
            }
        }
    }

    /// How the limits come about, in words.
    pub fn words_of_limits(&self) -> String {
        match self {
            Answering::Fits(fits) => fits.words_of_limits(),
            Answering::Universal(UniversalModel { scenarios: Scenarios::One, .. }) => {
                "for one structure at one magnitude and distance that the surface has not seen".to_string()
            }
            Answering::Universal(UniversalModel { scenarios: Scenarios::Many, .. }) => {
                "for one structure that the surface has not seen, over many magnitudes and distances"
                    .to_string()
            }
        }
    }

    /// What a limit state is, in words.
    pub fn meaning(&self, state: LimitState) -> String {
        match (self, state) {
            (Answering::Fits(fits), _) => fits.meaning(state),
            (_, LimitState::Rocking) => "rocking".to_string(),
            (Answering::Universal(model), LimitState::Failure) => {
                format!("|theta|max / alpha above {}, or overturning, by the universal surface", model.limit)
            }
            (_, LimitState::Overturning) => "overturning, by the universal surface".to_string(),
        }
    }

    /// Warns of what speaks against fits: few events, tests that reject the curve.
    pub fn warn_of_fits(&self, console: &Console) {
        if let Answering::Fits(fits) = self {
            fits.warn_of_few_events(console);
            fits.warn_of_misfit(console);
        }
    }

    /// The universal surface, to be asked besides where the tests of the fits reject them.
    pub fn beside_misfit(&self, scenarios: Scenarios) -> Option<UniversalModel> {
        let Answering::Fits(fits) = self else { return None };
        fits.misfit.as_ref()?;
        let [least, largest] = universal::limits();
        let motions = fits.suite.as_deref().and_then(|word| keyword::parse(word).ok()).unwrap_or(Suite::Csgm);
        Some(UniversalModel { limit: fits.model.limit.clamp(least, largest), motions, scenarios })
    }

    /// How PGA and PGV go together in the motions behind it, if it is known.
    pub fn peaks(&self) -> Option<JointPeaks> {
        match self {
            Answering::Fits(fits) => fits.peaks,
            Answering::Universal(_) => None,
        }
    }

    /// Whether fits are of another slenderness or size.
    pub fn is_other_block(&self, structure: &Structure) -> bool {
        match self {
            Answering::Fits(fits) => fits.is_other_block(structure),
            Answering::Universal(_) => false,
        }
    }

    /// Whether the structure is not of the kind that was simulated.
    pub fn is_other_structure(&self, structure: &Structure) -> bool {
        match self {
            Answering::Fits(fits) => fits.is_other_eta(structure.eta),
            Answering::Universal(_) => other_structure(structure).next().is_some(),
        }
    }

    /// That it is not, and why.
    pub fn warn_of_structure(&self, structure: &Structure, console: &Console) {
        match self {
            Answering::Fits(fits) => fits.warn_of_structure(structure, console),
            Answering::Universal(_) => other_structure(structure).for_each(|other| {
                let (parameter, [least, largest]) = (other.parameter, other.range);
                console.warn(&format!(
                    "{parameter} is {:.4}, outside of {least} to {largest} of the surface: extrapolated",
                    other.value
                ));
            }),
        }
    }

    /// That these measures, of what `subject` says, lie outside of the data.
    pub fn warn_of_range(&self, measures: &IntensityMeasures, subject: &str, console: &Console) {
        match self {
            Answering::Fits(fits) => fits.warn_of_range(measures, subject, console),
            Answering::Universal(model) => model.out_of_range(measures).for_each(|out| {
                let (measure, [least, largest]) = (out.measure.as_str(), out.range);
                console.warn(&format!(
                    "{subject}{measure} is {:.4}, outside of {least} to {largest} of the surface: extrapolated",
                    out.value
                ));
            }),
        }
    }

    /// That a slice lies outside of the data, or goes up `to` an intensity outside of them.
    pub fn warn_of_slice(&self, slice: &Slice, to: f64, subject: &str, console: &Console) {
        match self {
            Answering::Fits(fits) => fits.warn_of_slice(slice, to, subject, console),
            Answering::Universal(_) => self.warn_of_range(&slice.measures(to), subject, console),
        }
    }
}
