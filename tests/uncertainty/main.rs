//! The uncertainty of the fits against statsmodels, pyFragility, firthmodels and scipy (scripts/reference/uncertainty.py), and the
//! ranking of what they are fitted to (scripts/reference/ranking.py).

mod bootstrap;
mod data;
mod firth;
mod goodness;
mod link_series;
mod links;
mod ranking;
mod robust;
