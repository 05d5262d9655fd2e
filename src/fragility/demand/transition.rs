//! Where the two planes of Eq. 18 meet.

use super::inference::DemandRefits;
use super::inference::{DemandReplicate, solutions};
use crate::fragility::sample::Sample;
use crate::resampling::bootstrap::{Resamples, TOGETHER};
use crate::resampling::normal_equations::NormalEquations;
use crate::statistics::design::{Moments, Rows};
use crate::statistics::estimate::Limits;

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
    let critical = -2.0 * libm::log(1.0 - confidence.sqrt());
    let likely = |point: &&ScanPoint| {
        let cases = (point.n_low + point.n_high) as f64;
        cases * (point.pooled_rss - least) / least <= critical
    };
    let mut places = scan.iter().filter(likely).map(|point| point.im4);
    let low = places.next()?;
    Some(Limits { low, high: places.next_back().unwrap_or(low) })
}

/// The places of the scan.
fn places() -> impl Iterator<Item = f64> {
    let (first, last, step) = SCAN;
    (0..=((last - first) / step).round() as usize).map(move |index| first + step * index as f64)
}

/// Tries every IM4 of the scan as the place where two planes, ln EDP on ln IM4 and ln IM3, meet. None without enough cases on
/// both sides of any.
pub fn find_transition(sample: &Sample) -> Option<Transition> {
    let design = sample.design();
    let means = Moments::of(&design).means;
    let of_block = |rows: &Rows| {
        let numbers: Vec<usize> = (0..rows.count()).collect();
        let search = TransitionSearch::of(means.clone(), &[rows.x[1], rows.x[2], rows.y], &numbers);
        search.parts(&Resamples::alike(&vec![1.0; rows.count()]))
    };
    let parts = design.fold(0, of_block, |parts, more| {
        parts.iter_mut().zip(&more).for_each(|(part, more)| part.add(more));
    });
    least(&sides(means.len(), &parts))
}

/// The cases in the order of their IM4, ready for searches in resamples.
pub struct TransitionSearch {
    refits: DemandRefits,
    /// The number of cases below each place that is tried.
    below: Vec<usize>,
}

/// The two planes of one resample.
#[derive(Debug, Clone, PartialEq)]
pub struct Break {
    /// The IM4 of the least pooled residual.
    pub im4: f64,
    /// The plane below; none if its cases do not determine it.
    pub low: Option<DemandReplicate>,
    /// The plane above.
    pub high: Option<DemandReplicate>,
}

/// The equations of both planes at one place of the scan.
struct Sides {
    im4: f64,
    low: NormalEquations,
    high: NormalEquations,
    /// Infinite where there are too few cases.
    pooled_rss: [f64; TOGETHER],
}

/// The place of the least pooled residual in the first resample.
fn least(sides: &[Sides]) -> Option<Transition> {
    let point = |sides: &Sides| ScanPoint {
        im4: sides.im4,
        pooled_rss: sides.pooled_rss[0],
        n_low: sides.low.products[0][0] as usize,
        n_high: sides.high.products[0][0] as usize,
    };
    let scan: Vec<ScanPoint> = sides.iter().map(point).filter(|p| p.pooled_rss.is_finite()).collect();
    let best = scan.iter().min_by(|a, b| a.pooled_rss.total_cmp(&b.pooled_rss))?.im4;
    Some(Transition { im4: best, scan })
}

/// Both planes at each place, from the equations of the cases between places.
fn sides(k: usize, parts: &[NormalEquations]) -> Vec<Sides> {
    // Both from their own end, so that nothing is subtracted.
    let lows = running_sums(k, parts.iter());
    let highs: Vec<NormalEquations> = running_sums(k, parts[1..].iter().rev()).collect();
    let sides = places().zip(lows.zip(highs.into_iter().rev()));
    sides.map(|(im4, (low, high))| Sides::new(k, im4, low, high)).collect()
}

impl TransitionSearch {
    /// In a sample of IM4 and IM3.
    pub fn new(sample: &Sample) -> TransitionSearch {
        TransitionSearch::about(Moments::of(&sample.design()).means, sample)
    }

    /// In some of the cases that have these means.
    pub fn about(means: Vec<f64>, sample: &Sample) -> TransitionSearch {
        let columns: Vec<Vec<f64>> = sample.predictors().into_iter().chain([sample.observed()]).collect();
        TransitionSearch::of(means, &columns.iter().map(Vec::as_slice).collect::<Vec<_>>(), &sample.rows())
    }

    fn of(means: Vec<f64>, columns: &[&[f64]], rows: &[usize]) -> TransitionSearch {
        let ln_im4 = columns[0];
        let mut order: Vec<usize> = (0..ln_im4.len()).collect();
        order.sort_by(|&a, &b| ln_im4[a].total_cmp(&ln_im4[b]));
        let below = |im4: f64| order.partition_point(|&case| ln_im4[case] < libm::log(im4));
        let below = places().map(below).collect();
        TransitionSearch { refits: DemandRefits::in_order(means, columns, rows, &order), below }
    }

    /// As [`find_transition`], where each of all cases counts so often.
    pub fn find(&self, counts: &[f64]) -> Option<Transition> {
        least(&self.sides(&Resamples::alike(counts)))
    }

    /// Where the planes meet in each resample, and which they are.
    pub fn breaks(&self, resamples: &Resamples) -> [Option<Break>; TOGETHER] {
        breaks(self.refits.means(), &self.parts(resamples))
    }

    fn sides(&self, resamples: &Resamples) -> Vec<Sides> {
        sides(self.refits.means().len(), &self.parts(resamples))
    }

    /// The equations of the cases up to the first place, between places, and from the last one on.
    pub fn parts(&self, resamples: &Resamples) -> Vec<NormalEquations> {
        let below = self.below.iter().copied();
        let ends: Vec<usize> = std::iter::once(0).chain(below).chain([self.refits.cases()]).collect();
        ends.windows(2).map(|ends| self.refits.equations(ends[0]..ends[1], resamples)).collect()
    }
}

/// The parts of no cases, for planes of so many coefficients.
pub fn no_parts(coefficients: usize) -> Vec<NormalEquations> {
    vec![NormalEquations::empty(coefficients); places().count() + 1]
}

/// Where the planes meet in each resample, and which they are, from the parts of all cases.
pub fn breaks(means: &[f64], parts: &[NormalEquations]) -> [Option<Break>; TOGETHER] {
    let sides = sides(means.len(), parts);
    let best: [Option<&Sides>; TOGETHER] = std::array::from_fn(|resample| {
        let possible = sides.iter().filter(|sides| sides.pooled_rss[resample].is_finite());
        possible.min_by(|a, b| a.pooled_rss[resample].total_cmp(&b.pooled_rss[resample]))
    });
    let mut low = NormalEquations::empty(means.len());
    let mut high = low.clone();
    for (resample, sides) in best.iter().enumerate().filter_map(|(k, sides)| Some((k, (*sides)?))) {
        low.copy(&sides.low, resample);
        high.copy(&sides.high, resample);
    }
    let (mut low, mut high) = (solutions(means, &low), solutions(means, &high));
    std::array::from_fn(|resample| {
        let im4 = best[resample]?.im4;
        Some(Break { im4, low: low[resample].take(), high: high[resample].take() })
    })
}

impl Sides {
    fn new(coefficients: usize, im4: f64, low: NormalEquations, high: NormalEquations) -> Sides {
        let (rss_low, rss_high) = (low.rss(coefficients), high.rss(coefficients));
        let pooled_rss = std::array::from_fn(|resample| {
            let enough = low.products[0][resample].min(high.products[0][resample]) >= LEAST_CASES;
            let rss = rss_low[resample] + rss_high[resample];
            if enough && rss.is_finite() { rss } else { f64::INFINITY }
        });
        Sides { im4, low, high, pooled_rss }
    }
}

/// The equations of the cases up to each part.
fn running_sums<'a>(
    coefficients: usize,
    parts: impl Iterator<Item = &'a NormalEquations>,
) -> impl Iterator<Item = NormalEquations> {
    parts.scan(NormalEquations::empty(coefficients), |sum, part| {
        sum.add(part);
        Some(sum.clone())
    })
}
