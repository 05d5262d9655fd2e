//! Whether a model fits: tests whose small probabilities speak against it, and scores of probabilities.

use crate::statistics::binary::{BinaryFit, as_numbers};
use crate::statistics::columns::Columns;
use crate::statistics::design::{Design, Further, Rows, columns_of, widen};
use crate::statistics::distribution::{chi_squared_upper_tail, f_upper_tail};
use crate::statistics::regression::{LinearFit, regress};
use crate::statistics::sorted::Sorter;

/// Groups of a Hosmer-Lemeshow test.
const GROUPS: usize = 10;

/// The outcome of a test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Test {
    pub statistic: f64,
    /// Probability of one as large, if the model holds.
    pub p: f64,
}

/// The rows in so many groups of rising values and of equal size, but for the first ones, which take what does not divide.
pub fn rising_groups(values: &[f64], groups: usize) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let (size, larger) = (values.len() / groups, values.len() % groups);
    let (first, rest) = order.split_at(larger * (size + 1));
    first.chunks(size + 1).chain(rest.chunks(size.max(1))).map(<[usize]>::to_vec).collect()
}

/// A tenth of the cases, in the order of their probability.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Tenth {
    n: f64,
    expected: f64,
    observed: f64,
}

/// The tenths of so many cases with these probabilities, in rising order; the first ones take what does not divide. None with fewer
/// than two cases in each.
fn tenths(n: usize, rising: impl Iterator<Item = (f64, bool)>) -> Option<[Tenth; GROUPS]> {
    let (size, larger) = (n / GROUPS, n % GROUPS);
    let mut tenths = [Tenth::default(); GROUPS];
    for (rank, (probability, event)) in rising.enumerate() {
        let in_larger = larger * (size + 1);
        let place = match rank.checked_sub(in_larger) {
            None => rank / (size + 1),
            Some(further) => larger + further / size.max(1),
        };
        let Tenth { n, expected, observed } = &mut tenths[place];
        (*n, *expected, *observed) =
            (*n + 1.0, *expected + probability, *observed + f64::from(u8::from(event)));
    }
    (n >= 2 * GROUPS).then_some(tenths)
}

fn hosmer_lemeshow_of(tenths: &[Tenth]) -> Option<Test> {
    let of = |Tenth { n, expected, observed }: &Tenth| {
        (observed - expected).powi(2) / (expected * (1.0 - expected / n))
    };
    let statistic: f64 = tenths.iter().map(of).sum();
    let test = Test { statistic, p: chi_squared_upper_tail(statistic, GROUPS - 2) };
    statistic.is_finite().then_some(test)
}

fn rising(probabilities: &[f64], events: &[bool]) -> impl Iterator<Item = (f64, bool)> + use<> {
    let mut sorter = Sorter::default();
    probabilities.iter().zip(as_numbers(events)).for_each(|(p, event)| sorter.push((*p, event)));
    sorter.sorted().map(|(p, event)| (p, event != 0.0))
}

/// How the fitted curve of a design does on the cases that it was fitted to.
#[derive(Debug, Clone, PartialEq)]
pub struct Goodness {
    /// Area under the receiver operating characteristic.
    pub auc: f64,
    /// Brier score.
    pub brier: f64,
    /// Where there are cases enough.
    pub hosmer_lemeshow: Option<Test>,
    /// Least and largest index of the cases.
    pub index_range: [f64; 2],
}

impl Goodness {
    /// Of a fit to this design.
    pub fn of(design: &Design, fit: &BinaryFit) -> Goodness {
        let (mut sorter, mut squares) = (Sorter::default(), 0.0);
        let of_block = |rows: &Rows| {
            let indices = fit.indices(rows);
            let probabilities: Vec<f64> = indices.iter().map(|index| fit.link.probability(*index)).collect();
            let squares = probabilities.iter().zip(rows.y).map(|(p, y)| (p - y).powi(2)).sum::<f64>();
            // Its sign says whether the event happened.
            let signed = probabilities.iter().zip(rows.y).map(|(p, y)| p.copysign(y - 0.5));
            (squares, indices.into_iter().zip(signed).collect::<Vec<_>>())
        };
        design.each(0, of_block, |(more, pairs)| {
            squares += more;
            pairs.into_iter().for_each(|pair| sorter.push(pair));
        });
        let (mut area, mut index_range) = (Area::default(), [f64::INFINITY, f64::NEG_INFINITY]);
        let rising = sorter.sorted().map(|(index, signed)| {
            let event = signed.is_sign_positive();
            area.add(index, event);
            widen(&mut index_range, [index; 2]);
            (signed.abs(), event)
        });
        let tenths = tenths(design.cases(), rising);
        Goodness {
            auc: area.under(),
            brier: squares / design.cases() as f64,
            hosmer_lemeshow: tenths.and_then(|tenths| hosmer_lemeshow_of(&tenths)),
            index_range,
        }
    }
}

/// Hosmer and Lemeshow's test of fitted probabilities: in ten groups of rising probability, as many events as expected?
/// (Hosmer & Lemeshow 1980, Communications in Statistics A9, 1043-1069). None with fewer than two cases a group, or if a
/// group is certain of its outcome.
pub fn hosmer_lemeshow(probabilities: &[f64], events: &[bool]) -> Option<Test> {
    hosmer_lemeshow_of(&tenths(events.len(), rising(probabilities, events))?)
}

/// The likelihood-ratio test of a binary regression against a larger one that contains it.
pub fn likelihood_ratio(restricted: &BinaryFit, full: &BinaryFit) -> Test {
    let statistic = (2.0 * (full.log_likelihood - restricted.log_likelihood)).max(0.0);
    let degrees = full.coefficients.len() - restricted.coefficients.len();
    Test { statistic, p: chi_squared_upper_tail(statistic, degrees) }
}

/// Ramsey's test of a linear regression: do squares and cubes of the fitted values add to it? (Ramsey 1969, J. Royal
/// Statistical Society B31, 350-371). None where they do not vary on their own.
pub fn reset(predictors: &[&[f64]], y: &[f64], fit: &LinearFit) -> Option<Test> {
    let columns = columns_of(predictors, y.to_vec());
    reset_of(&columns, predictors.len(), fit)
}

/// The same of a regression on the first columns.
pub fn reset_of(columns: &Columns, predictors: usize, fit: &LinearFit) -> Option<Test> {
    let b = fit.values();
    let fitted = |x: &[&[f64]]| -> Vec<f64> {
        let slopes = |row: usize| x.iter().zip(b.iter().skip(1)).map(|(x, b)| b * x[row]).sum::<f64>();
        (0..x[0].len()).map(|row| b[0] + slopes(row)).collect()
    };
    added_powers(columns, predictors, None, &fitted, fit.rss)
}

/// The F test of what squares and cubes of `fitted` add to a regression on the first columns, and on `further` ones, that leaves
/// `rss`.
pub fn added_powers(
    columns: &Columns,
    predictors: usize,
    further: Option<(usize, Further)>,
    fitted: &(dyn Fn(&[&[f64]]) -> Vec<f64> + Sync),
    rss: f64,
) -> Option<Test> {
    let design = Design::new(columns, predictors);
    let n = design.cases() as f64;
    // Standardised, which changes nothing but the conditioning.
    let sum = |of: &(dyn Fn(f64) -> f64 + Sync)| {
        let of_block = |rows: &Rows| fitted(&rows.x[1..]).into_iter().map(of).sum::<f64>();
        design.fold(0, of_block, |sum, part| *sum += part)
    };
    let mean = sum(&|fitted| fitted) / n;
    let sd = (sum(&|fitted| (fitted - mean).powi(2)) / n).sqrt();
    let more = |x: &[&[f64]]| -> Vec<Vec<f64>> {
        let fitted = fitted(x);
        let power = |k: i32| fitted.iter().map(|f| ((f - mean) / sd).powi(k)).collect::<Vec<f64>>();
        let further = further.map_or(Vec::new(), |(_, further)| further(x));
        further.into_iter().chain([power(2), power(3)]).collect()
    };
    let full = regress(&design.with(further.map_or(0, |(count, _)| count) + 2, &more)).ok()?;
    let degrees = (full.n - full.coefficients.len()) as f64;
    let statistic = (rss - full.rss) / 2.0 / (full.rss / degrees);
    statistic.is_finite().then(|| Test { statistic, p: f_upper_tail(statistic, 2.0, degrees) })
}

/// The area under the receiver operating characteristic, of cases that come in the order of their score.
#[derive(Default)]
struct Area {
    wins: f64,
    others_below: f64,
    events: f64,
    /// Of the score that came last: events and others.
    tied: [f64; 2],
    score: f64,
}

impl Area {
    fn add(&mut self, score: f64, event: bool) {
        if score != self.score {
            self.close();
            self.score = score;
        }
        self.tied[usize::from(!event)] += 1.0;
    }

    fn close(&mut self) {
        let [happened, did_not] = std::mem::take(&mut self.tied);
        self.wins += happened * (self.others_below + 0.5 * did_not);
        self.others_below += did_not;
        self.events += happened;
    }

    fn under(mut self) -> f64 {
        self.close();
        self.wins / (self.events * self.others_below)
    }
}

/// Area under the receiver operating characteristic: the probability that an event has a higher score than a non-event,
/// ties counted half. NaN without both.
pub fn auc(scores: &[f64], events: &[bool]) -> f64 {
    let mut area = Area::default();
    rising(scores, events).for_each(|(score, event)| area.add(score, event));
    area.under()
}

/// The same of a design: of its first predictor as the score, where an event was observed where there is no 0.
pub fn auc_of(design: &Design) -> f64 {
    let (mut sorter, mut area) = (Sorter::default(), Area::default());
    let pairs = |rows: &Rows| rows.x[1].iter().copied().zip(rows.y.iter().copied()).collect::<Vec<_>>();
    design.each(0, pairs, |pairs| pairs.into_iter().for_each(|pair| sorter.push(pair)));
    sorter.sorted().for_each(|(score, y)| area.add(score, y != 0.0));
    area.under()
}

/// Brier score: the mean squared difference of probability and outcome.
pub fn brier_score(probabilities: &[f64], events: &[bool]) -> f64 {
    let square = |(p, &event): (&f64, &bool)| (p - f64::from(u8::from(event))).powi(2);
    probabilities.iter().zip(events).map(square).sum::<f64>() / events.len() as f64
}

/// Logarithmic score: the mean logarithm of the probability of what happened, 0 at best.
pub fn log_score(probabilities: &[f64], events: &[bool]) -> f64 {
    let of = |(p, &event): (&f64, &bool)| if event { libm::log(*p) } else { libm::log1p(-p) };
    probabilities.iter().zip(events).map(of).sum::<f64>() / events.len() as f64
}

/// The logarithmic score that right probabilities have in the mean.
pub fn expected_log_score(probabilities: &[f64]) -> f64 {
    let times_ln = |weight: f64, ln: f64| if weight > 0.0 { weight * ln } else { 0.0 };
    let of = |&p: &f64| times_ln(p, libm::log(p)) + times_ln(1.0 - p, libm::log1p(-p));
    probabilities.iter().map(of).sum::<f64>() / probabilities.len() as f64
}
