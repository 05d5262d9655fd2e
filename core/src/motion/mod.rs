//! Near-fault ground motions: a coherent velocity pulse plus stochastic high frequencies (section 2.1).

pub mod amplification;
mod combine;
mod design;
pub mod floor;
pub(crate) mod fourier;
mod intensity_measures;
pub mod measures;
mod peaks;
pub mod pulse;
pub mod scenario;
pub mod stochastic;
mod synthesis;

pub use amplification::SiteAmplification;
pub use combine::{Difference, Epoch};
pub use design::{Design, ScenarioGrid};
pub use floor::{Amplification, Floor};
pub use intensity_measures::{Dimension, IntensityMeasures};
pub use measures::{MeasurePlan, MotionMeasures};
pub use peaks::{Peaks, validate_medians};
pub use pulse::Pulse;
pub use scenario::{Scenario, Suite};
pub use stochastic::StochasticModel;
pub use synthesis::{MotionModel, Synthesizer, SyntheticMotion};

/// Largest number of samples of a motion; its spectra and velocities take many times the memory.
pub const LONGEST_MOTION: usize = 1 << 24;
