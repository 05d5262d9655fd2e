//! Where the two planes of Eq. 18 meet.

use nalgebra::{Matrix3, Vector3};

/// The IM4 at which the planes may meet: first, last and step of the scan.
const SCAN: (f64, f64, f64) = (1.05, 2.0, 0.01);
/// A plane needs this many cases on its side.
const LEAST_CASES: usize = 20;

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

/// Sums from which the residual of a plane follows. Predictors and response are centred beforehand, so that the sums do not cancel.
#[derive(Clone)]
struct Sums {
    n: usize,
    xx: Matrix3<f64>,
    xy: Vector3<f64>,
    yy: f64,
}

impl Sums {
    fn new() -> Sums {
        Sums { n: 0, xx: Matrix3::zeros(), xy: Vector3::zeros(), yy: 0.0 }
    }

    fn add(&mut self, row: &Vector3<f64>, y: f64) {
        self.n += 1;
        self.xx += row * row.transpose();
        self.xy += row * y;
        self.yy += y * y;
    }

    fn minus(&self, other: &Sums) -> Sums {
        Sums { n: self.n - other.n, xx: self.xx - other.xx, xy: self.xy - other.xy, yy: self.yy - other.yy }
    }

    fn rss(&self) -> Option<f64> {
        let coefficients = self.xx.cholesky()?.solve(&self.xy);
        Some(self.yy - coefficients.dot(&self.xy))
    }
}

/// Tries every IM4 of the scan as the place where two planes, ln EDP on ln IM4 and ln IM3, meet. None without enough
/// cases on both sides of any.
pub fn find_transition(ln_im4: &[f64], ln_im3: &[f64], ln_edp: &[f64]) -> Option<Transition> {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (mean4, mean3, mean_y) = (mean(ln_im4), mean(ln_im3), mean(ln_edp));
    let mut order: Vec<usize> = (0..ln_edp.len()).collect();
    order.sort_by(|&a, &b| ln_im4[a].total_cmp(&ln_im4[b]));
    let row = |k: usize| Vector3::new(1.0, ln_im4[k] - mean4, ln_im3[k] - mean3);

    let mut all = Sums::new();
    order.iter().for_each(|&k| all.add(&row(k), ln_edp[k] - mean_y));
    let (mut low, mut next, mut scan) = (Sums::new(), 0, Vec::new());
    let (first, last, step) = SCAN;
    for index in 0..=((last - first) / step).round() as usize {
        let im4 = first + step * index as f64;
        while next < order.len() && ln_im4[order[next]] < im4.ln() {
            low.add(&row(order[next]), ln_edp[order[next]] - mean_y);
            next += 1;
        }
        let high = all.minus(&low);
        if low.n >= LEAST_CASES
            && high.n >= LEAST_CASES
            && let (Some(rss_low), Some(rss_high)) = (low.rss(), high.rss())
        {
            scan.push(ScanPoint { im4, pooled_rss: rss_low + rss_high, n_low: low.n, n_high: high.n });
        }
    }
    let best = scan.iter().min_by(|a, b| a.pooled_rss.total_cmp(&b.pooled_rss))?.im4;
    Some(Transition { im4: best, scan })
}
