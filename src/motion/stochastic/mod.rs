//! The high-frequency component: Boore's stochastic method with the two-corner source of Atkinson & Silva (2000)
//! (section 2.1.2).

mod site;
mod spectrum;
mod window;

pub use site::{Site, SiteTableError};
pub use spectrum::{CONSTANT, LowCut, Source, StochasticModel, quality_exponent};
pub use window::{PEAK_SHARE, Window};
