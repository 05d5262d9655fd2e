//! Incremental dynamic analysis: one structure under one motion at rising intensity (Vamvatsikos & Cornell 2002, Incremental
//! dynamic analysis, Earthquake Engineering & Structural Dynamics 31, 491-514).
//!
//! Rocking is not monotone in the intensity: a structure that overturns under a motion may survive a stronger one of the same
//! shape, so that there is no one capacity, but a least overturning intensity and safe windows above it.

use super::response::{Outcome, Response};
use crate::keyword::keywords;

/// The demand |theta|max / alpha from which a structure that survives may have a neighbour that does not.
const NEAR_OVERTURNING: f64 = 0.2;

/// The intensities at which a structure is looked at: levels in equal ratios, and more between them where the outcome changes
/// or may change twice.
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
    /// The intensity.
    pub intensity: f64,
    /// What came of it.
    pub response: Response,
}

/// One of several structures under motions, at an intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Its number.
    pub case: usize,
    /// The intensity.
    pub intensity: f64,
}

impl Scan {
    /// From one intensity to another in `steps` equal ratios, which are halved up to `halvings` times where the outcome may
    /// change twice within them. Where it changes, its place is found to the relative `tolerance`.
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

    /// The least intensity.
    pub fn foot(&self) -> f64 {
        self.levels.first().copied().unwrap_or(f64::NAN)
    }

    /// The largest intensity.
    pub fn top(&self) -> f64 {
        self.levels.last().copied().unwrap_or(f64::NAN)
    }

    /// The ratio of two levels.
    pub fn ratio(&self) -> f64 {
        self.ratio
    }

    /// The ratio of two intensities between which nothing more is searched: safe windows, or overturning ranges, that are
    /// narrower may be missed.
    pub fn finest_ratio(&self) -> f64 {
        self.finest_ratio
    }

    /// The levels at which all structures are looked at, rising.
    pub fn levels(&self) -> &[f64] {
        &self.levels
    }

    /// All cases looked at as often as the scan asks for, in rounds: `respond` gives the responses to all looks of a round, in
    /// order. Of each case the responses come at rising intensity.
    ///
    /// # Errors
    /// Those of `respond`.
    pub fn run<E>(
        &self,
        cases: usize,
        respond: impl Fn(&[Look]) -> Result<Vec<Response>, E>,
    ) -> Result<Vec<Vec<ScanResponse>>, E> {
        let mut found: Vec<Vec<ScanResponse>> = vec![Vec::new(); cases];
        let levels = |case| self.levels.iter().map(move |&intensity| Look { case, intensity });
        let mut looks: Vec<Look> = (0..cases).flat_map(levels).collect();
        while !looks.is_empty() {
            for (&Look { case, intensity }, response) in looks.iter().zip(respond(&looks)?) {
                found[case].push(ScanResponse { intensity, response });
            }
            looks.clear();
            for (case, found) in found.iter_mut().enumerate() {
                found.sort_by(|a, b| a.intensity.total_cmp(&b.intensity));
                let missing = found.windows(2).filter_map(|pair| self.between(&pair[0], &pair[1]));
                looks.extend(missing.map(|intensity| Look { case, intensity }));
            }
        }
        Ok(found)
    }

    /// The intensity between two neighbours at which the scan must look too, if any.
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

/// Whether the outcome may change twice between two responses of the same outcome: between overturnings in another mode, after
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
    /// From an intensity within the scan on.
    Overturns,
    /// Nowhere.
    Safe,
    /// Already at the foot of the scan.
    Below,
}

keywords!(CapacityStatus { Overturns = "overturns", Safe = "safe", Below = "below" });

/// What a scan says of the capacity of a structure against overturning. Each change of outcome lies between two neighbouring
/// looks.
#[derive(Debug, Clone, PartialEq)]
pub struct Capacity {
    /// Whether and where it overturns.
    pub status: CapacityStatus,
    /// The largest intensity below all that overturn it.
    pub safe_below: Option<f64>,
    /// The least intensity that overturns it.
    pub overturning: Option<f64>,
    /// The intensities above that it survives.
    pub windows: Vec<SafeWindow>,
}

/// A range of intensities that a structure survives, above one that overturns it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SafeWindow {
    /// The least of them.
    pub low: f64,
    /// The largest of them; none where the scan ends within the window.
    pub high: Option<f64>,
}

impl Capacity {
    /// Of responses at rising intensity.
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
