//! Incremental dynamic analysis: one structure under one motion at rising intensity (Vamvatsikos & Cornell
//! 2002, Incremental dynamic analysis, Earthquake Engineering & Structural Dynamics 31, 491-514).
//!
//! Rocking is not monotone in the intensity: a structure that overturns under a motion may survive a stronger
//! one of the same shape, and a finer scan finds more changes of outcome, since the boundaries are fractal.
//! There is no single capacity. At its resolution, a scan finds the least overturning intensity, and the
//! windows above it in which no simulated intensity overturns.

use serde::{Deserialize, Serialize};

use super::response::{Outcome, Response};
use crate::spelling::unknown_word;
use crate::statistics::numerics::equal_ratios;

/// Halvings of a step between levels where the structure rocks: the resolution.
const HALVINGS: i32 = 4;
/// Further halvings where the demand may reach the tipping point.
const CLOSER_HALVINGS: i32 = 4;
/// A safe window has at least this many steps, of equal or smaller ratios.
const WINDOW_PARTS: f64 = 16.0;
/// Relative error of the intensities at which the outcome changes.
const TOLERANCE: f64 = 1e-3;
/// Demand |theta|max / alpha at the tipping point on still ground.
const TIPPING: f64 = 1.0;
/// Between impacts the demand is a continuous function of the intensity. Within a step it may grow by this
/// many times its change over the step or a neighbouring step; a larger factor misses fewer grazing peaks.
const GROWTH: f64 = 8.0;
/// Keeps rounding from causing one more halving.
const ROUNDING: f64 = 1.0 + 1e-12;

/// The intensities of an incremental dynamic analysis: levels in equal ratios, halved where the structure
/// rocks, and halved further where the outcome changes or a peak may graze the tipping point.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    /// Intensities at which every case is simulated, ascending.
    pub levels: Vec<f64>,
    pub ratio: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScanResponse {
    pub intensity: f64,
    pub response: Response,
}

/// A case (a structure under a motion) and an intensity to simulate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScanPoint {
    pub case: usize,
    pub intensity: f64,
}

impl Scan {
    /// Divides the range from `from` to `to` in `steps` equal ratios.
    pub fn new(from: f64, to: f64, steps: usize) -> Scan {
        let below = equal_ratios(from, to, steps).take(steps);
        Scan { levels: below.chain([to]).collect(), ratio: (to / from).powf(1.0 / steps as f64) }
    }

    /// Returns the resolution: the ratio of neighbouring intensities simulated wherever a case rocks.
    /// Narrower overturning ranges may be missed; narrower safe windows do not count.
    pub fn finest_ratio(&self) -> f64 {
        self.ratio_after(HALVINGS)
    }

    fn ratio_after(&self, halvings: i32) -> f64 {
        self.ratio.powf(0.5_f64.powi(halvings))
    }

    /// Simulates all cases at as many intensities as needed, in rounds. `respond` simulates the points of a
    /// round, in order. Returns the responses of each case at ascending intensity, or the error of `respond`.
    pub fn run<E>(
        &self,
        cases: usize,
        respond: impl Fn(&[ScanPoint]) -> Result<Vec<Response>, E>,
    ) -> Result<Vec<Vec<ScanResponse>>, E> {
        let mut found: Vec<Vec<ScanResponse>> = vec![Vec::new(); cases];
        let mut points: Vec<ScanPoint> = (0..cases)
            .flat_map(|case| self.levels.iter().map(move |&intensity| ScanPoint { case, intensity }))
            .collect();
        while !points.is_empty() {
            for (&ScanPoint { case, intensity }, response) in points.iter().zip(respond(&points)?) {
                found[case].push(ScanResponse { intensity, response });
            }
            points.clear();
            for (case, found) in found.iter_mut().enumerate() {
                found.sort_by(|a, b| a.intensity.total_cmp(&b.intensity));
                points.extend(self.missing(found).map(|intensity| ScanPoint { case, intensity }));
            }
        }
        Ok(found)
    }

    /// Returns the intensities of a case still to simulate: the middles of steps that are too wide.
    fn missing<'a>(&'a self, found: &'a [ScanResponse]) -> impl Iterator<Item = f64> + 'a {
        let first = found.iter().position(ScanResponse::overturns).unwrap_or(found.len());
        let runs = found.chunk_by(|a, b| a.overturns() == b.overturns());
        let window_parts = runs.flat_map(move |run| {
            let part = self.is_window(run).then(|| width(run).powf(1.0 / WINDOW_PARTS));
            std::iter::repeat_n(part, run.len())
        });
        found.windows(2).zip(window_parts).enumerate().filter_map(move |(step, (pair, window_part))| {
            let [below, above] = [&pair[0], &pair[1]];
            // Refined to the tolerance where the outcome changes; closer than the resolution where a peak may
            // graze the tipping point; else to the resolution, in a window to a part of it.
            let widest = if below.overturns() != above.overturns() {
                1.0 + TOLERANCE
            } else if above.response.outcome == Outcome::NoRocking {
                return None;
            } else if (step < first || window_part.is_some()) && may_tip(found, step) {
                self.ratio_after(HALVINGS + CLOSER_HALVINGS)
            } else {
                self.finest_ratio().min(window_part.filter(|_| step > first).unwrap_or(f64::INFINITY))
            };
            let is_wide = above.intensity / below.intensity > widest * ROUNDING;
            is_wide.then(|| (below.intensity * above.intensity).sqrt())
        })
    }

    /// Returns whether a run of responses is safe and at least as wide as the resolution.
    fn is_window(&self, run: &[ScanResponse]) -> bool {
        !run[0].overturns() && width(run) * ROUNDING >= self.finest_ratio()
    }
}

fn width(run: &[ScanResponse]) -> f64 {
    run[run.len() - 1].intensity / run[0].intensity
}

/// Whether the demand may reach the tipping point in a step, by its rate of change there and beside it.
fn may_tip(found: &[ScanResponse], step: usize) -> bool {
    let beside = &found[step.saturating_sub(1)..found.len().min(step + 3)];
    let rates = beside.windows(2).filter_map(|pair| {
        let change = pair[1].response.outcome.demand()? - pair[0].response.outcome.demand()?;
        Some(change.abs() / width(pair).ln())
    });
    let ends = &found[step..=step + 1];
    let growth = GROWTH * rates.fold(0.0, f64::max) * width(ends).ln();
    ends.iter().filter_map(|end| end.response.outcome.demand()).any(|demand| demand + growth > TIPPING)
}

impl ScanResponse {
    pub fn overturns(&self) -> bool {
        self.response.outcome == Outcome::Overturned
    }
}

/// Whether and where a structure overturns in a scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<CapacityStatus>)]
pub enum CapacityStatus {
    /// Overturns from an intensity within the scan.
    Overturns,
    /// Safe at all simulated intensities.
    Safe,
    /// Overturns at the lowest intensity of the scan.
    Below,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Capacity {
    #[serde(rename = "capacity")]
    pub status: CapacityStatus,
    /// Largest safe intensity below the first overturning one.
    pub safe_below: Option<f64>,
    #[serde(rename = "overturning_intensity")]
    pub overturning: Option<f64>,
    pub safe_up_to: Option<f64>,
}

impl Capacity {
    /// Of responses at ascending intensity.
    pub fn of(responses: &[ScanResponse]) -> Capacity {
        let first = responses.iter().position(ScanResponse::overturns);
        let safe_below = responses[..first.unwrap_or(responses.len())].last().map(|last| last.intensity);
        let overturning = first.map(|first| responses[first].intensity);
        let status = match (safe_below, overturning) {
            (_, None) => CapacityStatus::Safe,
            (None, Some(_)) => CapacityStatus::Below,
            (Some(_), Some(_)) => CapacityStatus::Overturns,
        };
        let safe_up_to = responses.iter().rfind(|at| !at.overturns()).map(|at| at.intensity);
        Capacity { status, safe_below, overturning, safe_up_to }
    }
}
