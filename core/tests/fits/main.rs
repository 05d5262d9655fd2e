//! The fits, their limits and what is made of them, against statsmodels, pyFragility, scipy and closed forms.

mod at_site;
mod capacity;
mod cases;
mod common;
mod coverage;
mod demand;
mod hazard;
mod model;
mod normal;
mod on_floor;
mod outcomes;
mod overturning;
mod paper;
mod regression;
mod score;
#[path = "../shared/mod.rs"]
mod shared;
mod tree;
mod validation;
