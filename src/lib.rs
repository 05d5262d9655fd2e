//! Free-standing structures in earthquakes: the probability that one rocks, rocks too far, or overturns, and
//! how often this happens at a site.
//!
//! A cabinet, a statue or a frame on rocking columns stays on its base until the ground acceleration exceeds
//! g tan *α*. Then it rocks, and either comes to rest or overturns. Its response depends on three parameters:
//! the frequency parameter *p* (rad/s; smaller for larger blocks), the slenderness *α* (rad; width over height
//! is tan *α*), and the coefficient of restitution *η* (the ratio of the velocities after and before an
//! impact). PGA decides whether it rocks; PGA and PGV together, whether it overturns.
//!
//! The method is that of Dimitrakopoulos & Paraskeva (2015), *Dimensionless fragility curves for rocking
//! response to near-fault excitations* (Earthquake Engineering & Structural Dynamics), extended to recorded
//! motions, other structures and hazard curves.
//!
//! # The probability that a block overturns
//!
//! Without simulation, by the universal surface: a regression on the responses of many structures.
//!
//! ```
//! use rockfrag::fragility::{Kind, Model, Scenarios};
//! use rockfrag::motion::IntensityMeasures;
//! use rockfrag::rocking::Structure;
//!
//! // 0.5 m wide and 2 m high; eta after Housner. Failure: |theta|max above 0.10 alpha, or overturning.
//! let block = Structure::rectangular_block("block", 0.5, 2.0, None)?;
//! let model = Model::shipped(Kind::Recorded, &block, 0.10);
//!
//! // A motion of PGA 0.5 g = 4.9 m/s2 and PGV 0.6 m/s; pulse period and mean period are not needed.
//! let motion = IntensityMeasures::new(&block, 4.9, 0.6, None, None);
//! let given_rocking = model.probabilities(&block, &motion, None, Scenarios::One).given_rocking;
//! let p = given_rocking.expect("PGA is above g tan alpha").p_ro;
//! assert!(0.0 < p.low && p.low < p.value && p.value < p.high && p.high < 1.0);
//! # assert!((0.01..0.6).contains(&p.value), "{p:?}");
//! # Ok::<(), rockfrag::rocking::StructureError>(())
//! ```
//!
//! [`hazard::Site::rates`] integrates it over the hazard of a site, with limits: see `examples/block.rs`.
//!
//! # The response to a record
//!
//! ```
//! use rockfrag::rocking::{Outcome, Record, Structure, simulate};
//!
//! let cabinet = Structure::rectangular_block("cabinet", 0.8, 2.2, None)?;
//! // A sine of 2 Hz and 6 m/s2, every 5 ms; records::read_records reads the files of agencies.
//! let sine = |k: i32| 6.0 * (std::f64::consts::TAU * 2.0 * 0.005 * f64::from(k)).sin();
//! let acceleration: Vec<f64> = (0..400).map(sine).collect();
//! let response = simulate(&cabinet, &Record::new(&acceleration, 0.005)?);
//! assert_eq!(response.outcome, Outcome::SafeRocking);
//! // The largest rotation over the slenderness, |theta|max / alpha.
//! assert!(0.0 < response.edp && response.edp < 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`rocking::trace`] gives the rotation over time. The folder `examples` has three programs: the probability
//! and rate of a block, the response to your own record, and the way from earthquake scenarios to a fragility
//! curve.
//!
//! # What is where
//!
//! | module | holds | in the paper |
//! |---|---|---|
//! | [`motion`] | scenarios, synthetic motions, intensity measures | sections 2.1 and 2.2.3, Eqs. 1 to 3, 9, 10 and 13 |
//! | [`rocking`] | structures, records, the rocking response | section 2.2, Eqs. 4 to 7 |
//! | [`fragility`] | P_ex and P_ro, their fits, the surface | sections 2.3 and 3, Eqs. 12, 14 to 24 |
//! | [`hazard`] | hazard curves, annual rates | not in the paper |
//! | [`records`] | recorded motions: formats, processing, pulses | not in the paper |
//! | [`studies`] | ranking of measures, validation, comparison with the paper | tables, worked example |
//! | [`statistics`] | regressions and distributions | Eqs. 16, 17, 19 to 22 |
//! | [`paper`] | what the paper publishes | sections 2 and 3 |
//!
//! # Conventions
//!
//! Names end in their unit: `pga_m_s2`, `p_rad_s`. Demands are |*θ*|max / *α*, and IM1 to IM6 are those of
//! Eq. 13. A fit takes columns of length n and has k coefficients, the intercept first; a covariance is k × k,
//! row by row. Limits are 95 % confidence limits unless a confidence is given. The same seed gives the same
//! numbers for any number of threads.
//!
//! The modules above read no files. Fits, counts and rankings share their work among the threads of rayon.
//! Before 1.0, any version may change them.
//!
//! The command `rockfrag` runs these steps over Parquet files: `rockfrag --help`.

#![warn(missing_docs)]

#[doc(hidden)]
pub mod cli;
#[doc(hidden)]
pub mod export;
pub mod fragility;
pub mod hazard;
#[doc(hidden)]
pub mod inputs;
#[doc(hidden)]
pub mod keyword;
pub mod motion;
#[doc(hidden)]
pub mod number;
pub mod paper;
#[doc(hidden)]
pub mod pipeline;
#[doc(hidden)]
pub mod plausibility;
#[doc(hidden)]
pub mod random;
pub mod records;
#[doc(hidden)]
pub mod report;
pub mod rocking;
#[doc(hidden)]
pub mod stages;
pub mod statistics;
pub mod studies;
#[doc(hidden)]
pub mod table;
pub mod units;
pub mod warning;
