//! Near-fault ground motions: a coherent velocity pulse plus stochastic high frequencies (section 2.1).
//!
//! ```text
//! scenario            magnitude, distance, parameters of the pulse (section 2.1.1, Eqs. 2 and 3); suites
//! design              samples of the random parameters in a cell of the magnitude-distance grid
//! pulse               Mavroeidis & Papageorgiou's pulse (Eq. 1)
//! stochastic          high frequencies: Boore's method, source of Atkinson & Silva (section 2.1.2)
//! amplification       amplification from the source to the surface
//! combine             high frequencies and pulse into one motion (section 2.1.3)
//! synthesis           all of these for one scenario, on one time axis
//! floor               motions of floors of buildings, and their peaks
//! peaks               PGA and PGV, and whether they can be those of a motion
//! measures            measures of a motion with units: peaks, mean period, Arias intensity, duration
//! intensity_measures  IM1 to IM6 (Eq. 13) of a motion and a structure, and other measures without units
//! fourier             transforms of real series
//! ```

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
