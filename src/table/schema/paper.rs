//! Published numbers beside ours.

use super::column::{Column, Kind, columns};
use super::motion::SUITE;
use super::response::STRUCTURE;
use super::table::Table;

columns! {
    QUANTITY = "quantity", Text, "1", "what was published";
    PLACE = "place", Text, "1", "where the paper prints it";
    PUBLISHED = "published", Float64, "1", "the published number";
    OURS = "ours", Float64, "1", "the same number from these files";
    SPREAD_MEAN = "spread_mean", Float64, "1", "mean of ours over seeds";
    SPREAD_SD = "spread_sd", Float64, "1", "standard deviation of ours over seeds";
    SEEDS = "seeds", Int32, "1", "number of seeds of the spread";
    Z = "z", Float64, "1", "(published - mean) / standard deviation";
}

/// Each published number beside ours.
pub const PAPER: Table = Table {
    name: "paper comparison",
    stage: "compare-paper",
    columns: &[
        QUANTITY,
        PLACE,
        SUITE.or_null(),
        STRUCTURE.or_null(),
        PUBLISHED.or_null(),
        OURS.or_null(),
        SPREAD_MEAN.or_null(),
        SPREAD_SD.or_null(),
        SEEDS,
        Z.or_null(),
    ],
};
