//! Seismic hazard at a site, and the annual rates at which objects rock, fail and overturn there.

mod budget;
mod conditional_motions;
mod curve;
mod fragility_curve;
mod ground;
mod ground_motion;
mod list;
mod pgv_pga;
mod rates;
mod share;
mod site;
mod target;

pub use budget::Budget;
pub use conditional_motions::unusual_motions;
pub use curve::{HazardCurve, HazardError};
pub use fragility_curve::{Fragility, FragilityPoint, GenericSites, Lognormal};
pub use ground_motion::{GroundMotion, MotionProbabilities};
pub use list::{ListProbabilities, ListedObject};
pub use pgv_pga::{MatchError, PgvPgaRatio, VelocitySource, velocity_of_spectrum};
pub use rates::{PairOfPeaks, exceedance, rates_over_curve};
pub use share::RateByIntensity;
pub use site::{Hazard, PeakHazard, Site, SiteRates, strongest};
pub use target::{Bases, SLENDERNESSES, SearchEnd, Side};

/// The probability of one or more events of a Poisson process in `years`: 1 - exp(-rate years).
pub fn probability_in_years(annual_rate: f64, years: f64) -> f64 {
    -(-annual_rate * years).exp_m1()
}
