//! Free-standing structures in earthquakes: the probability that one rocks, rocks too far, or overturns, and
//! the annual rate of each at a site.
//!
//! A cabinet, a statue or a frame on rocking columns stays on its base until the ground acceleration exceeds
//! g tan *α*. Then it rocks, and comes to rest or overturns. Its response depends on three parameters:
//! the frequency parameter *p* (rad/s; smaller for larger blocks), the slenderness angle *α* (rad; width over
//! height is tan *α*), and the coefficient of restitution *η* (the ratio of the velocities after and before
//! an impact). PGA decides whether it rocks; PGA, PGV and magnitude predict whether it overturns.
//!
//! The method is that of Dimitrakopoulos & Paraskeva (2015), *Dimensionless fragility curves for rocking
//! response to near-fault excitations* (Earthquake Engineering & Structural Dynamics), extended to recorded
//! motions, other structures and hazard curves.
//!
//! # From an object to its annual rate
//!
//! This needs no simulation: [`uncalibrated`](object::RockingObject::uncalibrated) takes the fragility
//! surface, a regression on the simulated responses of many structures, as it is.
//!
//! ```
//! use rockfrag_core::fragility::MotionKind;
//! use rockfrag_core::hazard::{Hazard, HazardCurve, Site, probability_in_years};
//! use rockfrag_core::object::{Object, RockingObject};
//!
//! // 0.5 m wide and 1.9 m high. Failure: |theta|max above 0.10 alpha, or overturning.
//! let cabinet = Object::block("cabinet", 0.5, 1.9);
//! let object = RockingObject::uncalibrated(&cabinet, MotionKind::Recorded, 0.10)?;
//! // PGA and spectral acceleration at 1 s (m/s2), and how often a year each is exceeded.
//! let pga = HazardCurve::new(vec![(0.5, 2e-2), (5.0, 5e-4), (20.0, 8e-6), (45.0, 4e-7)])?;
//! let sa_1s = HazardCurve::new(vec![(0.5, 2e-2), (4.0, 5e-4), (15.0, 8e-6), (32.0, 4e-7)])?;
//! let rates = Site::new(Hazard::with_spectrum(pga, &sa_1s)?).rates(&object);
//! let rate = rates.states.overturning.estimate().ok_or("the curve ends early")?;
//! let p = rate.map(|rate| 100.0 * probability_in_years(rate, 50.0));
//! println!("{:.1} % in 50 years ({:.1} to {:.1} %)", p.value, p.low, p.high);
//! # assert!(0.0 < rate.low && rate.low < rate.value && rate.value < rate.high && rate.high < 0.1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The limits cover uncertainty in the model, PGV, restitution, object, floor and magnitude (here inferred
//! from PGV / PGA). An [`Object`](object::Object) can have more detail: depth, floor, measured values. A
//! [`GroundMotion`](hazard::GroundMotion) in place of a site gives probabilities.
//!
//! [`rocking::simulate`] gives the response to a record, [`rocking::trace`] the rotation over time.
//! `examples/curve.rs` goes from earthquake scenarios to a fragility curve.
//!
//! # What is where
//!
//! | module | holds | in the paper |
//! |---|---|---|
//! | [`motion`] | scenarios, motions, measures | sections 2.1 and 2.2.3, Eqs. 1 to 3, 9, 10 and 13 |
//! | [`rocking`] | structures, records, the rocking response | section 2.2, Eqs. 4 to 7 |
//! | [`fragility`] | P_ex and P_ro, their fits, the surface | sections 2.3 and 3, Eqs. 12, 14 to 24 |
//! | [`object`] | objects: size, mass, place, and their uncertainty | |
//! | [`hazard`] | hazard curves, annual rates, probabilities under one motion | |
//! | [`records`] | recorded motions: processing, rotation, pulses | |
//! | [`studies`] | validation, comparison with the paper | tables, worked example |
//! | [`statistics`] | regressions and distributions | Eqs. 16, 17, 19 to 22 |
//! | [`paper`] | what the paper publishes | sections 2 and 3 |
//!
//! These share [`number`], [`plausibility`], [`random`], [`spelling`], [`units`] and [`warning`].
//!
//! # Conventions
//!
//! Names end in their unit (`pga_m_s2`, `p_rad_s`), except fields of objects and coefficients of formulas,
//! which are in SI units. Demands are |*θ*|max / *α*; IM1 to IM6 are those of Eq. 13. Limits are 95 % limits
//! unless a confidence is given. The same seed gives the same numbers for any number of threads, but for the
//! last digits on other processors.
//!
//! Nothing here opens a file, asks the time or prints; `data` is compiled in. The crate `rockfrag` reads the
//! files of agencies and runs these steps over Parquet files: `rockfrag --help`.

pub mod fragility;
pub mod hazard;
pub mod motion;
pub mod number;
pub mod object;
pub mod paper;
pub mod plausibility;
pub mod random;
pub mod records;
pub mod rocking;
pub mod spelling;
pub mod statistics;
pub mod studies;
pub mod units;
pub mod warning;
