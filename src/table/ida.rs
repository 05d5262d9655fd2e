//! The files of an incremental dynamic analysis: capacities, safe windows, stripes, shares and fragility.

use std::path::Path;

use arrow_array::RecordBatch;
use arrow_schema::ArrowError;

use super::motions::MotionId;
use super::responses::{RESPONSES, ResponseRow};
use super::row::{WriteRow, schema_of, table};
use super::schema::{Column, Table, joined};
use super::store::frame::read_frame;
use super::store::text;
use crate::fragility::CapacityFit;
use crate::rocking::{Capacity, CapacityStatus, Structure};
use crate::statistics::FitStatus;
use crate::studies::wilson_limits;

table! {
    /// Whether and from which intensity on each structure overturns under each motion.
    pub struct IdaRow<'a> as IDA = "capacities" by "ida" {
        motion_id: &'a MotionId,
        suite: Option<&'a str>,
        structure: &'a str,
        p_rad_s: f64,
        alpha_rad: f64,
        eta: f64,
        measure: &'a str,
        unscaled: f64,
        capacity: CapacityStatus,
        safe_below: Option<f64>,
        overturning_intensity: Option<f64>,
        safe_windows: usize,
        safe_up_to: Option<f64>,
    }
}

table! {
    /// Ranges above an overturning intensity in which a structure survives every simulated one.
    pub struct WindowRow<'a> as IDA_WINDOWS = "windows" by "ida" {
        motion_id: &'a MotionId,
        suite: Option<&'a str>,
        structure: &'a str,
        measure: &'a str,
        window: usize,
        window_low: f64,
        window_high: Option<f64>,
    }
}

table! {
    /// A level of the scan, beside the response there.
    pub struct LevelRow<'a> as IDA_LEVELS = "levels" by "ida" {
        measure: &'a str,
        intensity: f64,
        scale: f64,
        overturning_above: Option<f64>,
    }
}

const STRIPE_COLUMNS: [Column; RESPONSES.columns.len() + IDA_LEVELS.columns.len()] =
    joined(RESPONSES.columns, IDA_LEVELS.columns);

/// Responses at each level of the scan: those of simulate to scaled motions, and the scale.
pub const IDA_STRIPES: Table = Table { name: "stripes", stage: IDA.stage, columns: &STRIPE_COLUMNS };

table! {
    /// How many motions overturn a structure at each level.
    pub struct ShareRow<'a> as IDA_SHARES = "shares" by "ida" {
        suite: Option<&'a str>,
        structure: &'a str,
        measure: &'a str,
        intensity: f64,
        n: usize,
        overturned: usize,
        share: f64,
        share_low: f64,
        share_high: f64,
        overturned_up_to: usize,
        lognormal: Option<f64>,
    }
}

table! {
    /// The lognormal distribution of the overturning intensities.
    pub struct LognormalRow<'a> as IDA_FRAGILITY = "fragility" by "ida" {
        suite: Option<&'a str>,
        structure: &'a str,
        measure: &'a str,
        n: usize,
        n_safe: usize,
        n_below: usize,
        n_with_windows: usize,
        theta: Option<f64> = capacity_theta,
        theta_low: Option<f64> = capacity_theta_low,
        theta_high: Option<f64> = capacity_theta_high,
        beta: Option<f64> = capacity_beta,
        beta_low: Option<f64> = capacity_beta_low,
        beta_high: Option<f64> = capacity_beta_high,
        status: FitStatus,
    }
}

table! {
    /// Shares as they are read.
    pub struct Share of IDA_SHARES {
        suite: Option<String>,
        structure: String,
        measure: String,
        intensity: f64,
        n: usize,
        share: f64,
        share_low: f64,
        share_high: f64,
        lognormal: Option<f64>,
    }
}

table! {
    /// Lognormal distributions as they are read.
    pub struct Lognormal of IDA_FRAGILITY {
        suite: Option<String>,
        structure: String,
        measure: String,
        theta: Option<f64> = capacity_theta,
        theta_low: Option<f64> = capacity_theta_low,
        theta_high: Option<f64> = capacity_theta_high,
        beta: Option<f64> = capacity_beta,
        beta_low: Option<f64> = capacity_beta_low,
        beta_high: Option<f64> = capacity_beta_high,
        n_safe: usize,
        n_below: usize,
    }
}

/// What a scan says of a structure under a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct CapacityRow<'a> {
    pub motion_id: &'a MotionId,
    /// Its kind, if known.
    pub suite: Option<&'a str>,
    pub structure: &'a Structure,
    /// What is scaled.
    pub measure: &'static str,
    /// Its value of the motion as it is.
    pub unscaled: f64,
    /// Where the structure overturns.
    pub capacity: Capacity,
}

/// A response at a level of the scan.
#[derive(Debug, Clone, PartialEq)]
pub struct StripeRow<'a> {
    pub response: ResponseRow<'a>,
    /// What is scaled.
    pub measure: &'static str,
    /// Its value of the scaled motion.
    pub intensity: f64,
    /// The factor by which the motion is scaled.
    pub scale: f64,
    /// Share of the intensities from this level to the next that overturn the structure; none at the last.
    pub overturning_above: Option<f64>,
}

/// The capacities of a structure against the motions of a suite.
#[derive(Debug, Clone, PartialEq)]
pub struct FragilityRow {
    /// The suite, if known.
    pub suite: Option<String>,
    pub structure: String,
    /// What is scaled.
    pub measure: &'static str,
    /// Motions.
    pub n: usize,
    /// Those that overturn it nowhere.
    pub n_safe: usize,
    /// Those that overturn it already at the foot of the scan.
    pub n_below: usize,
    /// Those with a safe window.
    pub n_with_windows: usize,
    /// Levels of the scan, rising.
    pub levels: Vec<LevelCount>,
    /// The distribution, or why there is none.
    pub fit: Result<CapacityFit, FitStatus>,
}

/// How many motions overturn a structure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelCount {
    /// At this intensity.
    pub intensity: f64,
    pub overturned: usize,
    /// At this intensity or a lower one.
    pub overturned_up_to: usize,
}

/// The rows of the file of capacities.
///
/// # Errors
/// If a motion without a number stands among those that have one.
pub fn capacities(rows: &[CapacityRow], by_name: bool) -> Result<RecordBatch, ArrowError> {
    let rows = rows.iter().map(|row| IdaRow {
        motion_id: row.motion_id,
        suite: row.suite,
        structure: &row.structure.name,
        p_rad_s: row.structure.p_rad_s,
        alpha_rad: row.structure.alpha_rad,
        eta: row.structure.eta,
        measure: row.measure,
        unscaled: row.unscaled,
        capacity: row.capacity.status,
        safe_below: row.capacity.safe_below,
        overturning_intensity: row.capacity.overturning,
        safe_windows: row.capacity.windows.len(),
        safe_up_to: row.capacity.safe_up_to,
    });
    IdaRow::batch_in(&rows.collect::<Vec<_>>(), &schema_of(&IDA, by_name))
}

/// The windows of these rows.
///
/// # Errors
/// As [`capacities`].
pub fn windows(rows: &[CapacityRow], by_name: bool) -> Result<RecordBatch, ArrowError> {
    let rows = rows.iter().flat_map(|row| {
        (1..).zip(&row.capacity.windows).map(|(number, window)| WindowRow {
            motion_id: row.motion_id,
            suite: row.suite,
            structure: &row.structure.name,
            measure: row.measure,
            window: number,
            window_low: window.low,
            window_high: window.high,
        })
    });
    WindowRow::batch_in(&rows.collect::<Vec<_>>(), &schema_of(&IDA_WINDOWS, by_name))
}

/// The rows of the file of stripes.
///
/// # Errors
/// As [`capacities`].
pub fn stripes(rows: &[StripeRow], by_name: bool) -> Result<RecordBatch, ArrowError> {
    let mut columns = ResponseRow::arrays(rows.iter().map(|row| &row.response), by_name);
    let level = |row: &StripeRow| LevelRow {
        measure: row.measure,
        intensity: row.intensity,
        scale: row.scale,
        overturning_above: row.overturning_above,
    };
    columns.extend(LevelRow::arrays(rows.iter().map(level).collect::<Vec<_>>().iter(), by_name));
    RecordBatch::try_new(schema_of(&IDA_STRIPES, by_name), columns)
}

/// The rows of the file of shares: each level of each row.
///
/// # Errors
/// If memory runs out.
pub fn shares(rows: &[FragilityRow]) -> Result<RecordBatch, ArrowError> {
    let of_row = |row| {
        let FragilityRow { suite, structure, measure, n, levels, fit, .. }: &FragilityRow = row;
        levels.iter().map(move |level| {
            let limits = wilson_limits(level.overturned, *n);
            ShareRow {
                suite: suite.as_deref(),
                structure,
                measure,
                intensity: level.intensity,
                n: *n,
                overturned: level.overturned,
                share: level.overturned as f64 / *n as f64,
                share_low: limits.low,
                share_high: limits.high,
                overturned_up_to: level.overturned_up_to,
                lognormal: fit.as_ref().ok().map(|fit| fit.lognormal.p_up_to(level.intensity)),
            }
        })
    };
    ShareRow::batch(&rows.iter().flat_map(of_row).collect::<Vec<_>>())
}

/// The rows of the fragility file.
///
/// # Errors
/// If memory runs out.
pub fn fragility(rows: &[FragilityRow]) -> Result<RecordBatch, ArrowError> {
    let of_row = |row| {
        let FragilityRow { suite, structure, measure, n, n_safe, n_below, n_with_windows, fit, .. }: &FragilityRow =
            row;
        let of_fit = |value: fn(&CapacityFit) -> f64| fit.as_ref().ok().map(value);
        LognormalRow {
            suite: suite.as_deref(),
            structure,
            measure,
            n: *n,
            n_safe: *n_safe,
            n_below: *n_below,
            n_with_windows: *n_with_windows,
            theta: of_fit(|fit| fit.lognormal.theta),
            theta_low: of_fit(|fit| fit.theta_limits.low),
            theta_high: of_fit(|fit| fit.theta_limits.high),
            beta: of_fit(|fit| fit.lognormal.beta),
            beta_low: of_fit(|fit| fit.beta_limits.low),
            beta_high: of_fit(|fit| fit.beta_limits.high),
            status: fit.as_ref().map_or_else(|&status| status, |_| FitStatus::Ok),
        }
    };
    LognormalRow::batch(&rows.iter().map(of_row).collect::<Vec<_>>())
}

/// A fragility file as a table to read, and what its limits are.
///
/// # Errors
/// If it is none.
pub fn show(path: &Path) -> anyhow::Result<String> {
    let frame = read_frame(path, &IDA_FRAGILITY)?;
    let counts = |column| anyhow::Ok(frame.column(column)?.i64()?.iter().flatten().sum::<i64>());
    let censored = match counts("n_safe")? + counts("n_below")? {
        0 => "",
        _ => {
            "; with n_safe or n_below above 0 they come from the likelihood, and are too narrow for few motions"
        }
    };
    Ok(format!(
        "{}theta and beta are median and dispersion of the lowest intensity that overturns; low and high are their 95 % confidence limits{censored}\n",
        text::aligned(&frame)
    ))
}
