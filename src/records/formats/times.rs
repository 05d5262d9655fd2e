//! Times of samples: the step between them, as far as their decimals bear it.

use super::error::RecordFileError;

/// The share by which a step of time may differ from the usual one: the times of many files are rounded.
const UNEVEN: f64 = 0.05;
/// The most decimals of times that are told from those of binary numbers.
const MOST_DECIMALS: i32 = 9;

/// The times of samples, on successive lines.
pub struct Times {
    /// In the unit of the file.
    values: Vec<f64>,
    in_s: f64,
    first_line: usize,
    /// Decimals of all times.
    decimals: Option<i32>,
}

impl Times {
    /// Of times in a unit of `in_s` seconds.
    pub fn new(values: Vec<f64>, in_s: f64, first_line: usize) -> Times {
        let has = |decimals: &i32| {
            values
                .iter()
                .map(|time| time * libm::exp10(f64::from(*decimals)))
                .all(|scaled| (scaled - scaled.round()).abs() <= 1e-6 + 4.0 * f64::EPSILON * scaled.abs())
        };
        let decimals = (0..=MOST_DECIMALS).find(has);
        Times { values, in_s, first_line, decimals }
    }

    /// Computes the time step, s, of times that must be even.
    ///
    /// # Errors
    /// If they are not.
    pub fn step_s(&self) -> Result<f64, RecordFileError> {
        let steps: Vec<f64> = self.values.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mut ordered = steps.clone();
        ordered.sort_by(f64::total_cmp);
        let short = RecordFileError::TooShort { found: self.values.len() };
        let usual = *ordered.get(ordered.len() / 2).ok_or(short)?;
        let is_even = |step: f64| (step - usual).abs() <= UNEVEN * usual.abs();
        let Some(at) = steps.iter().position(|step| !is_even(*step)) else {
            return Ok(self.mean_step() * self.in_s);
        };
        let (line, step_s, dt_s) = (self.line(at + 1), self.shown_s(steps[at]), self.shown_s(usual));
        // A gap is one long step among even ones.
        let is_gap = usual > 0.0 && steps[at] > usual && steps.get(at + 1).is_none_or(|next| is_even(*next));
        Err(if is_gap {
            RecordFileError::Gap { line, gap_s: step_s, dt_s }
        } else {
            RecordFileError::UnevenTime { line, step_s, dt_s }
        })
    }

    /// Checks that these are times in steps of `given_s`, but for their rounding.
    ///
    /// # Errors
    /// If samples are missing among them, or the step is another one.
    pub fn expect_steps(&self, given_s: f64) -> Result<(), RecordFileError> {
        let dt = given_s / self.in_s;
        let resolution = self.decimals.map_or(0.0, |decimals| libm::exp10(-f64::from(decimals)));
        let in_resolutions = dt / resolution;
        let is_exact = (in_resolutions - in_resolutions.round()).abs() < 1e-6 * in_resolutions;
        let allowed = if is_exact { 0.0 } else { resolution } + 2.0 * UNEVEN * dt;
        let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
        let first = self.values.first().copied().unwrap_or_default();
        for (k, &time) in self.values.iter().enumerate() {
            let expected = first + k as f64 * dt;
            (least, largest) = (least.min(time - expected), largest.max(time - expected));
            if largest - least <= allowed {
                continue;
            }
            let (line, step) = (self.line(k), time - self.values[k - 1]);
            return Err(if step - dt > allowed {
                RecordFileError::Gap { line, gap_s: self.shown_s(step), dt_s: given_s }
            } else {
                let (time_s, expected_s) = (self.shown_s(time), self.shown_s(expected));
                RecordFileError::OffStep { line, time_s, expected_s, given_s }
            });
        }
        Ok(())
    }

    /// The mean step, to the decimals that its rounding bears.
    fn mean_step(&self) -> f64 {
        let (first, last) = (self.values[0], self.values[self.values.len() - 1]);
        let steps = (self.values.len() - 1) as f64;
        rounded((last - first) / steps, self.decimals.map(|known| known + libm::log10(steps).ceil() as i32))
    }

    /// A time or a step in s, to one decimal more than the file has.
    fn shown_s(&self, time: f64) -> f64 {
        // The product with the unit is rounded once more.
        rounded(rounded(time, self.decimals.map(|known| known + 1)) * self.in_s, Some(2 * MOST_DECIMALS - 6))
    }

    fn line(&self, sample: usize) -> usize {
        self.first_line + sample
    }
}

/// Rounds to so many decimals.
fn rounded(value: f64, decimals: Option<i32>) -> f64 {
    let places = decimals.and_then(|decimals| usize::try_from(decimals).ok());
    places.map_or(value, |places| format!("{value:.places$}").parse().unwrap_or(value))
}
