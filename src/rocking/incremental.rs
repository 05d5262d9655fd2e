//! Incremental dynamic analysis: one structure under one motion at rising intensity (Vamvatsikos & Cornell 2002, Incremental
//! dynamic analysis, Earthquake Engineering & Structural Dynamics 31, 491-514).
//!
//! Rocking is not monotone in the intensity: a structure that overturns under a motion may survive a stronger one of the same
//! shape, so that there is no one capacity, but a least overturning intensity and safe windows above it.

use super::response::{Outcome, Response};
use crate::keyword::keywords;

/// The demand |theta|max / alpha from which a structure that survives may have a neighbour that does not.
const NEAR_OVERTURNING: f64 = 0.2;

/// The intensities of an incremental dynamic analysis: levels in equal ratios, and more between them where the outcome changes or
/// may change twice.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    levels: Vec<f64>,
    ratio: f64,
    finest_ratio: f64,
    tolerance: f64,
}

/// A response at an intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScanResponse {
    pub intensity: f64,
    pub response: Response,
}

/// A case (a structure under a motion) and the intensity at which to simulate it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScanPoint {
    /// Index of the case.
    pub case: usize,
    pub intensity: f64,
}

impl Scan {
    /// Divides the intensities between two in `steps` equal ratios, which are halved up to `halvings` times where the outcome may
    /// change twice within them. Where it changes, the intensity is found to the relative `tolerance`.
    pub fn new(from: f64, to: f64, steps: usize, halvings: u32, tolerance: f64) -> Scan {
        let parts = |parts: f64| libm::pow(to / from, 1.0 / parts);
        let level = |k: usize| from * libm::pow(to / from, k as f64 / steps as f64);
        Scan {
            levels: (0..steps).map(level).chain([to]).collect(),
            ratio: parts(steps as f64),
            finest_ratio: parts(steps as f64 * libm::exp2(f64::from(halvings))),
            tolerance,
        }
    }

    pub fn lowest(&self) -> f64 {
        self.levels.first().copied().unwrap_or(f64::NAN)
    }

    pub fn highest(&self) -> f64 {
        self.levels.last().copied().unwrap_or(f64::NAN)
    }

    /// Ratio of neighbouring levels.
    pub fn ratio(&self) -> f64 {
        self.ratio
    }

    /// Ratio of two intensities between which nothing more is searched: narrower safe windows, or overturning ranges, may be
    /// missed.
    pub fn finest_ratio(&self) -> f64 {
        self.finest_ratio
    }

    /// Intensities at which every case is simulated, rising.
    pub fn levels(&self) -> &[f64] {
        &self.levels
    }

    /// Simulates all cases at as many intensities as the scan needs, in rounds: `respond` gives the responses to all points of a
    /// round, in order. Returns the responses of each case at rising intensity.
    ///
    /// # Errors
    /// Those of `respond`.
    pub fn run<E>(
        &self,
        cases: usize,
        respond: impl Fn(&[ScanPoint]) -> Result<Vec<Response>, E>,
    ) -> Result<Vec<Vec<ScanResponse>>, E> {
        let mut found: Vec<Vec<ScanResponse>> = vec![Vec::new(); cases];
        let levels = |case| self.levels.iter().map(move |&intensity| ScanPoint { case, intensity });
        let mut points: Vec<ScanPoint> = (0..cases).flat_map(levels).collect();
        while !points.is_empty() {
            for (&ScanPoint { case, intensity }, response) in points.iter().zip(respond(&points)?) {
                found[case].push(ScanResponse { intensity, response });
            }
            points.clear();
            for (case, found) in found.iter_mut().enumerate() {
                found.sort_by(|a, b| a.intensity.total_cmp(&b.intensity));
                let missing = found.windows(2).filter_map(|pair| self.between(&pair[0], &pair[1]));
                points.extend(missing.map(|intensity| ScanPoint { case, intensity }));
            }
        }
        Ok(found)
    }

    /// Returns the intensity between two neighbours that must be simulated too, if any.
    fn between(&self, below: &ScanResponse, above: &ScanResponse) -> Option<f64> {
        let widest = if below.overturns() != above.overturns() {
            1.0 + self.tolerance
        } else if may_hide_a_change(&below.response, &above.response) {
            // Rounding must not ask for one halving more.
            self.finest_ratio * (1.0 + 1e-12)
        } else {
            return None;
        };
        (above.intensity / below.intensity > widest).then(|| (below.intensity * above.intensity).sqrt())
    }
}

/// Tells whether the outcome may change twice between two responses of the same outcome: between overturnings in another mode, after
/// more or fewer impacts (Zhang & Makris 2001, Rocking response of free-standing blocks under cycloidal pulses, Journal of
/// Engineering Mechanics 127, 473-483), and near overturning.
fn may_hide_a_change(below: &Response, above: &Response) -> bool {
    match above.outcome {
        Outcome::Overturning => below.impacts != above.impacts,
        _ => below.edp.max(above.edp) > NEAR_OVERTURNING,
    }
}

impl ScanResponse {
    fn overturns(&self) -> bool {
        self.response.outcome == Outcome::Overturning
    }
}

/// Whether and where a structure overturns in a scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CapacityStatus {
    /// It overturns from an intensity within the scan on.
    Overturns,
    /// It overturns nowhere in the scan.
    Safe,
    /// It overturns already at the lowest intensity of the scan.
    Below,
}

keywords!(CapacityStatus { Overturns = "overturns", Safe = "safe", Below = "below" });

/// The capacity of a structure against overturning, as a scan finds it. Each change of outcome lies between two neighbouring
/// intensities.
#[derive(Debug, Clone, PartialEq)]
pub struct Capacity {
    pub status: CapacityStatus,
    /// Largest simulated intensity below all that overturn it.
    pub safe_below: Option<f64>,
    /// Least simulated intensity that overturns it.
    pub overturning: Option<f64>,
    /// Ranges of intensity above that it survives.
    pub windows: Vec<SafeWindow>,
}

/// A range of intensities that a structure survives, above one that overturns it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SafeWindow {
    /// Least intensity of the window.
    pub low: f64,
    /// Largest intensity of the window; none where the scan ends within it.
    pub high: Option<f64>,
}

impl Capacity {
    /// Finds the capacity in responses at rising intensity.
    pub fn of(responses: &[ScanResponse]) -> Capacity {
        let mut runs = responses.chunk_by(|a, b| a.overturns() == b.overturns()).peekable();
        let safe = runs.next_if(|run| !run[0].overturns());
        let safe_below = safe.and_then(|run| run.last()).map(|last| last.intensity);
        let overturning = runs.next().map(|run| run[0].intensity);
        let mut windows = Vec::new();
        while let Some(run) = runs.next() {
            let [first, last] = [&run[0], &run[run.len() - 1]];
            if !first.overturns() {
                let high = runs.peek().map(|_| last.intensity);
                windows.push(SafeWindow { low: first.intensity, high });
            }
        }
        let status = match (safe_below, overturning) {
            (_, None) => CapacityStatus::Safe,
            (None, Some(_)) => CapacityStatus::Below,
            (Some(_), Some(_)) => CapacityStatus::Overturns,
        };
        Capacity { status, safe_below, overturning, windows }
    }
}
