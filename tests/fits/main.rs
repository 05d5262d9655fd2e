//! The fits, their limits and what is made of them, against statsmodels, scipy and closed forms.

mod bent;
mod counted_rates;
mod coverage;
mod evaluate;
#[cfg(feature = "pipeline")]
mod export;
mod hazard;
mod limits;
mod many;
mod normal;
mod paper;
mod paper_model;
mod regressions_and_curves;
mod search;
mod universal;
mod universality;
mod validation;
