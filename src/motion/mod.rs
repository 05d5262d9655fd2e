//! Near-fault ground motions: a coherent velocity pulse plus stochastic high frequencies (section 2.1).
//!
//! ```text
//! scenario    magnitude, distance and the random parameters of the pulse (section 2.1.1)
//! design      how a cell of the magnitude-distance grid is sampled
//! pulse       Mavroeidis & Papageorgiou's pulse (Eq. 1)
//! stochastic  Boore's stochastic method with the source of Atkinson & Silva (section 2.1.2)
//! circle      sines and cosines of equally spaced angles
//! fourier     transforms of real series, planned once for each length
//! combine     high frequencies and pulse into one motion (section 2.1.3)
//! synthesis   all of it for one scenario, on one time axis
//! intensity   measures of any motion
//! records     recorded motions from the files of the strong-motion networks
//! processing  what is done to recorded motions before they are used
//! wavelet, pulse_indicator, pulse_fit  whether a record holds a pulse, and which
//! dimensionless  the six measures of Eq. 13
//! quantity       how all other measures become dimensionless
//! ```

mod circle;
mod combine;
mod design;
mod dimensionless;
mod fourier;
pub mod intensity;
pub mod processing;
pub mod pulse;
pub mod pulse_fit;
pub mod pulse_indicator;
mod quantity;
pub mod records;
pub mod scenario;
mod sobol;
pub mod stochastic;
mod suite;
mod synthesis;
pub mod wavelet;

pub use combine::{Difference, Epoch};
pub use design::{Design, Grid};
pub use dimensionless::IntensityMeasures;
pub use intensity::{IntensityScratch, MeasurePlan, Measured, Measures, measures};
pub use pulse::Pulse;
pub use quantity::Quantity;
pub use scenario::Scenario;
pub use sobol::SobolSequence;
pub use stochastic::StochasticModel;
pub use suite::Suite;
pub use synthesis::{MotionModel, Synthesizer, Synthetic};
