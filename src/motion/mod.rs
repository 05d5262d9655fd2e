//! Near-fault ground motions: a coherent velocity pulse plus stochastic high frequencies (section 2.1).
//!
//! ```text
//! scenario       magnitude, distance and the random parameters of the pulse (section 2.1.1); suites of motions
//! design         how a cell of the magnitude-distance grid is sampled
//! pulse          Mavroeidis & Papageorgiou's pulse (Eq. 1)
//! stochastic     Boore's stochastic method with the source of Atkinson & Silva (section 2.1.2)
//! site           amplification from the source to the surface
//! combine        high frequencies and pulse into one motion (section 2.1.3)
//! synthesis      all of it for one scenario, on one time axis
//! intensity      measures of any motion
//! dimensionless  the six measures of Eq. 13, and how all others become dimensionless
//! fourier        transforms of real series, planned once for each length
//! ```

mod combine;
mod design;
mod dimensionless;
pub mod fourier;
pub mod intensity;
pub mod pulse;
pub mod scenario;
pub mod site;
pub mod stochastic;
mod synthesis;

pub use combine::{Difference, Epoch};
pub use design::{Design, Grid};
pub use dimensionless::{IntensityMeasures, Quantity};
pub use intensity::{IntensityScratch, MeasurePlan, Measured, Measures, measures};
pub use pulse::Pulse;
pub use scenario::{Scenario, Suite};
pub use site::Site;
pub use stochastic::{LowCut, StochasticModel};
pub use synthesis::{MotionModel, Synthesizer, Synthetic};

/// The most samples of a motion: what is made of them (spectra, velocities) takes many times their room.
pub const LONGEST_MOTION: usize = 1 << 24;
