//! The uncertainty of the fits against statsmodels, pyFragility, firthmodels and scipy (scripts/reference/uncertainty.py).

mod bootstrap;
mod data;
mod firth;
mod goodness;
mod links;
mod ranking;
mod robust;
