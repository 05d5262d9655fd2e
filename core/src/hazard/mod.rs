//! Seismic hazard at a site, and the annual rates by it and a fragility.
//!
//! ```text
//! curve     annual rate of exceedance of one intensity; the convolution integral
//! pgv_pga   PGV / PGA of the motions of a site: by the curves of both, or by ground-motion models
//! rates     annual rates of the limit states of a structure, over a curve or over pairs of PGA and PGV
//! budget    the sources of uncertainty, and the limits by them
//! motion    the limit states under one motion, with limits
//! motions   the motions of which one peak is given, and their uncertainty
//! ratio     the rate after a change over that before
//! share     the shares of a rate by intensity
//! site      the rates of a structure at a site, with limits and warnings
//! target    the base with which a rate is a target
//! fragility the probabilities of an object over one peak, with limits
//! ```

mod budget;
mod curve;
mod fragility;
mod motion;
mod motions;
mod pgv_pga;
mod rates;
mod ratio;
mod share;
mod site;
mod target;

pub use budget::Budget;
pub use curve::{HazardCurve, HazardError};
pub use fragility::{Fragility, FragilityPoint, Lognormal, SitesInGeneral, intensity_in_words};
pub use motion::{GroundMotion, MotionProbabilities};
pub use pgv_pga::{MatchError, PgvPgaRatio, VelocitySource, velocity_of_spectrum};
pub use rates::{PairOfPeaks, Rate, exceedance, rates_over_curve};
pub use ratio::{RateByParts, ratio_of_rates};
pub use share::RateByIntensity;
pub use site::{Hazard, PeakHazard, Site, SiteRates, strongest};
pub use target::{Bases, SLENDERNESSES, SearchEnd};

/// The probability of one or more events of a Poisson process in `years`: 1 - exp(-rate years).
pub fn probability_in_years(annual_rate: f64, years: f64) -> f64 {
    -(-annual_rate * years).exp_m1()
}
