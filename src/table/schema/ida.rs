//! Incremental dynamic analysis: the same motions at rising intensity.

use super::column::{Column, Kind, columns};
use super::motion::{MOTION_ID, SCALE, SUITE};
use super::pex::{BETA, N, STATUS};
use super::pro::{BETA_HIGH, BETA_LOW, THETA, THETA_HIGH, THETA_LOW};
use super::response::{ALPHA_RAD, ETA, P_RAD_S, RESPONSES, STRUCTURE};
use super::table::Table;
use super::validation::{SHARE, SHARE_HIGH, SHARE_LOW};

columns! {
    MEASURE = "measure", Text, "1", "what intensity is: scale (of the motion as it is), pga (in g), pgv (in m/s), im4, im5 or im6";
    INTENSITY = "intensity", Float64, "1", "the measure of the scaled motion";
    UNSCALED = "unscaled", Float64, "1", "the measure of the motion as it is";
    CAPACITY = "capacity", Text, "1", "overturns (within the scan), safe (throughout), or below (overturns already at its foot)";
    SAFE_BELOW = "safe_below", Float64, "1", "largest intensity below all that overturn the structure; null: none in the scan";
    OVERTURNING_INTENSITY = "overturning_intensity", Float64, "1", "least intensity that overturns the structure; null: none in the scan";
    SAFE_WINDOWS = "safe_windows", Int64, "1", "ranges of larger intensities that it survives";
    SAFE_UP_TO = "safe_up_to", Float64, "1", "largest intensity that it survives; null: none in the scan";
    WINDOW = "window", Int64, "1", "number of the window, rising with the intensity";
    WINDOW_LOW = "window_low", Float64, "1", "least intensity of the window";
    WINDOW_HIGH = "window_high", Float64, "1", "largest intensity of the window; null: the scan ends within it";
    OVERTURNED = "overturned", Int64, "1", "motions that overturn the structure at this intensity";
    OVERTURNED_UP_TO = "overturned_up_to", Int64, "1", "motions that do so at this intensity or a lower one";
    LOGNORMAL = "lognormal", Float64, "1", "probability of the same by the lognormal distribution of the overturning intensities; null: none";
    N_SAFE = "n_safe", Int64, "1", "motions that overturn the structure nowhere in the scan";
    N_BELOW = "n_below", Int64, "1", "motions that overturn it already at its foot";
    N_WITH_WINDOWS = "n_with_windows", Int64, "1", "motions with a safe window";
}

/// Whether and from which intensity on each structure overturns under each motion.
pub const IDA: Table = Table {
    name: "capacities",
    stage: "ida",
    columns: &[
        MOTION_ID,
        SUITE.or_null(),
        STRUCTURE,
        P_RAD_S,
        ALPHA_RAD,
        ETA,
        MEASURE,
        UNSCALED,
        CAPACITY,
        SAFE_BELOW.or_null(),
        OVERTURNING_INTENSITY.or_null(),
        SAFE_WINDOWS,
        SAFE_UP_TO.or_null(),
    ],
};

/// Intensities that a structure survives, above one that overturns it.
pub const IDA_WINDOWS: Table = Table {
    name: "windows",
    stage: IDA.stage,
    columns: &[MOTION_ID, SUITE.or_null(), STRUCTURE, MEASURE, WINDOW, WINDOW_LOW, WINDOW_HIGH.or_null()],
};

const STRIPE_COLUMNS: [Column; RESPONSES.columns.len() + 3] = {
    let mut columns = [MEASURE; RESPONSES.columns.len() + 3];
    let mut k = 0;
    while k < RESPONSES.columns.len() {
        columns[k] = RESPONSES.columns[k];
        k += 1;
    }
    columns[k + 1] = INTENSITY;
    columns[k + 2] = SCALE;
    columns
};

/// Responses at each level of the scan: those of simulate to scaled motions, and the scale.
pub const IDA_STRIPES: Table = Table { name: "stripes", stage: IDA.stage, columns: &STRIPE_COLUMNS };

/// How many motions overturn a structure at each level.
pub const IDA_SHARES: Table = Table {
    name: "shares",
    stage: IDA.stage,
    columns: &[
        SUITE.or_null(),
        STRUCTURE,
        MEASURE,
        INTENSITY,
        N,
        OVERTURNED,
        SHARE,
        SHARE_LOW,
        SHARE_HIGH,
        OVERTURNED_UP_TO,
        LOGNORMAL.or_null(),
    ],
};

/// The lognormal distribution of the overturning intensities.
pub const IDA_FRAGILITY: Table = Table {
    name: "fragility",
    stage: IDA.stage,
    columns: &[
        SUITE.or_null(),
        STRUCTURE,
        MEASURE,
        N,
        N_SAFE,
        N_BELOW,
        N_WITH_WINDOWS,
        THETA.or_null(),
        THETA_LOW.or_null(),
        THETA_HIGH.or_null(),
        BETA.or_null(),
        BETA_LOW.or_null(),
        BETA_HIGH.or_null(),
        STATUS,
    ],
};
