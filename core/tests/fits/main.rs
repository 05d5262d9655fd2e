//! The fits, their limits and what is made of them, against statsmodels, pyFragility, scipy and closed forms.

mod at_site;
mod cases;
mod common;
mod coverage;
mod demand;
mod hazard;
mod model;
mod outcomes;
mod overturning;
mod regression;
#[path = "../shared/mod.rs"]
mod shared;
mod tree;
mod validation;
