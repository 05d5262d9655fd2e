//! Which intensity measures a stage takes of each motion.

use crate::motion::MeasurePlan;
use crate::pipeline::options::{Steps, check};
use crate::table::schema::spectral_acceleration_name;

/// From the options `--housner` and `--sa`.
///
/// # Errors
/// If a period is out of range, or two of them have one name.
pub fn measure_plan(housner: bool, sa: Option<&Steps>) -> anyhow::Result<MeasurePlan> {
    let Some(sa) = sa else { return Ok(MeasurePlan { housner, sa_periods_s: Vec::new() }) };
    let possible = sa.values.iter().all(|period| (0.01..=20.0).contains(period));
    check(possible, "sa", sa, "periods from 0.01 to 20 s")?;
    let names: Vec<String> = sa.values.iter().copied().map(spectral_acceleration_name).collect();
    check(
        names.windows(2).all(|pair| pair[0] != pair[1]),
        "sa",
        sa,
        "periods that differ by 0.0001 s or more",
    )?;
    Ok(MeasurePlan { housner, sa_periods_s: sa.values.clone() })
}
