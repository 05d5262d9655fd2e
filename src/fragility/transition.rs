//! Where the two planes of Eq. 18 meet.

use nalgebra::{Matrix3, Vector3};

use super::limits::Limits;

/// The IM4 at which the planes may meet: first, last and step of the scan.
const SCAN: (f64, f64, f64) = (1.05, 2.0, 0.01);
/// A plane needs this many cases on its side.
const LEAST_CASES: f64 = 20.0;

/// The pooled residual for one place of the transition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScanPoint {
    /// The IM4 that parts the planes.
    pub im4: f64,
    /// Residual sum of squares of both planes.
    pub pooled_rss: f64,
    /// Cases below.
    pub n_low: usize,
    /// Cases above.
    pub n_high: usize,
}

/// The transition and how it was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Transition {
    /// The IM4 of the least pooled residual.
    pub im4: f64,
    /// All places that were tried.
    pub scan: Vec<ScanPoint>,
}

/// The first and last place of a scan whose residual is no more than chance above the least: limits that hold the place of
/// a break with this confidence, its jump being large against the scatter (Hansen 2000, Sample splitting and threshold
/// estimation, Econometrica 68, 575-603; for the same scatter on both sides). None without a scan.
pub fn transition_limits(scan: &[ScanPoint], confidence: f64) -> Option<Limits> {
    let least = scan.iter().map(|point| point.pooled_rss).min_by(f64::total_cmp)?;
    let critical = -2.0 * (1.0 - confidence.sqrt()).ln();
    let likely = |point: &&ScanPoint| {
        let cases = (point.n_low + point.n_high) as f64;
        cases * (point.pooled_rss - least) / least <= critical
    };
    let mut places = scan.iter().filter(likely).map(|point| point.im4);
    let low = places.next()?;
    Some(Limits { low, high: places.next_back().unwrap_or(low) })
}

/// Sums from which the residual of a plane follows. Predictors and response are centred beforehand, so that the sums do not cancel.
#[derive(Clone)]
struct Sums {
    n: f64,
    xx: Matrix3<f64>,
    xy: Vector3<f64>,
    yy: f64,
}

impl Sums {
    fn new() -> Sums {
        Sums { n: 0.0, xx: Matrix3::zeros(), xy: Vector3::zeros(), yy: 0.0 }
    }

    fn add(&mut self, case: &CentredCase, weight: f64) {
        let weighted = case.row * weight;
        self.n += weight;
        self.xx += weighted * case.row.transpose();
        self.xy += weighted * case.y;
        self.yy += weight * case.y * case.y;
    }

    fn minus(&self, other: &Sums) -> Sums {
        Sums { n: self.n - other.n, xx: self.xx - other.xx, xy: self.xy - other.xy, yy: self.yy - other.yy }
    }

    fn rss(&self) -> Option<f64> {
        let coefficients = self.xx.cholesky()?.solve(&self.xy);
        Some(self.yy - coefficients.dot(&self.xy))
    }
}

/// A case about the means of all.
struct CentredCase {
    /// Which it is.
    index: usize,
    ln_im4: f64,
    row: Vector3<f64>,
    y: f64,
}

/// The cases in the order of their IM4, ready for searches with different weights.
pub struct TransitionSearch {
    cases: Vec<CentredCase>,
}

impl TransitionSearch {
    /// Of the logarithms of both measures and of the demand.
    pub fn new(ln_im4: &[f64], ln_im3: &[f64], ln_edp: &[f64]) -> TransitionSearch {
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let (mean4, mean3, mean_y) = (mean(ln_im4), mean(ln_im3), mean(ln_edp));
        let case = |k: usize| CentredCase {
            index: k,
            ln_im4: ln_im4[k],
            row: Vector3::new(1.0, ln_im4[k] - mean4, ln_im3[k] - mean3),
            y: ln_edp[k] - mean_y,
        };
        let mut cases: Vec<CentredCase> = (0..ln_edp.len()).map(case).collect();
        cases.sort_by(|a, b| a.ln_im4.total_cmp(&b.ln_im4));
        TransitionSearch { cases }
    }

    /// Tries every IM4 of the scan as the place where two planes, ln EDP on ln IM4 and ln IM3, meet, where a case counts
    /// as often as `weight` says. None without enough cases on both sides of any.
    pub fn find(&self, weight: impl Fn(usize) -> f64) -> Option<Transition> {
        let mut all = Sums::new();
        self.cases.iter().for_each(|case| all.add(case, weight(case.index)));
        let (mut low, mut cases, mut scan) = (Sums::new(), self.cases.iter().peekable(), Vec::new());
        let (first, last, step) = SCAN;
        for index in 0..=((last - first) / step).round() as usize {
            let im4 = first + step * index as f64;
            while let Some(case) = cases.next_if(|case| case.ln_im4 < im4.ln()) {
                low.add(case, weight(case.index));
            }
            let high = all.minus(&low);
            if low.n >= LEAST_CASES
                && high.n >= LEAST_CASES
                && let (Some(rss_low), Some(rss_high)) = (low.rss(), high.rss())
            {
                let (n_low, n_high) = (low.n as usize, high.n as usize);
                scan.push(ScanPoint { im4, pooled_rss: rss_low + rss_high, n_low, n_high });
            }
        }
        let best = scan.iter().min_by(|a, b| a.pooled_rss.total_cmp(&b.pooled_rss))?.im4;
        Some(Transition { im4: best, scan })
    }
}

/// Tries every IM4 of the scan as the place where two planes, ln EDP on ln IM4 and ln IM3, meet. None without enough
/// cases on both sides of any.
pub fn find_transition(ln_im4: &[f64], ln_im3: &[f64], ln_edp: &[f64]) -> Option<Transition> {
    TransitionSearch::new(ln_im4, ln_im3, ln_edp).find(|_| 1.0)
}
