//! How the curve of one structure fares on another: is it universal?

use super::transfer::{Curve, CurveSubject};
use super::validation::Forecast;
use super::validation::{Validation, calibration_slope};
use crate::fragility::case::Case;
use crate::keyword::keywords;
use crate::normal;
use crate::resampling::folds::{Folds, Gain, MOST_FOLDS, gain};
use crate::statistics::FitStatus;
use crate::statistics::goodness::expected_log_score;

/// The curve of one structure tested on the cases of another.
#[derive(Debug, Clone, PartialEq)]
pub struct Transfer {
    /// Counts and calibration of the transferred curve.
    pub validation: Validation,
    /// Slope of the recalibration in log odds: below 1 where the curve is too sure of itself.
    pub slope: Option<f64>,
    /// Log score that the share of events alone has.
    pub share_log_score: f64,
    /// The transferred curve beside the structure's own; the status of the latter where it does not exist.
    pub own: Result<BesideOwn, FitStatus>,
}

/// A transferred curve beside the structure's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BesideOwn {
    /// Mean log score of the own curve, in cells that it was not fitted to.
    pub log_score: f64,
    /// That of the transferred curve, likewise.
    pub transferred: f64,
    /// The first less the second.
    pub loss: Gain,
    /// Mean absolute difference of the two probabilities over the cases.
    pub mean_error: f64,
    /// The most by which the transferred curve says more than the own one, over the cases.
    pub worst_over: f64,
    /// The most by which it says less.
    pub worst_under: f64,
}

/// Whether a transferred curve does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It loses less than a tenth of what the own curve tells beyond the share of events.
    Holds,
    /// It loses less than half of that.
    Bends,
    /// It loses more.
    Fails,
    /// The structure has no curve of its own that tells more than the share of events.
    TooFewEvents,
}

keywords!(Verdict { Holds = "holds", Bends = "bends", Fails = "fails", TooFewEvents = "too_few_events" });

/// Shares of what the own curve tells that may be lost.
const LITTLE: f64 = 0.1;
const MUCH: f64 = 0.5;

impl Transfer {
    /// Of the curve of the `reference` to `cases`, the responses to the same motions in the same order, of which `cells`
    /// says the cell. None if no case counts.
    ///
    /// # Errors
    /// With the status of the reference if it has no curve.
    pub fn new(
        subject: &CurveSubject,
        reference: &[Case],
        cases: &[Case],
        cells: &[usize],
    ) -> Result<Option<Transfer>, FitStatus> {
        let transferred = subject.fit(reference)?;
        let counts = |(case, &cell): (&Case, &usize)| {
            let happened = subject.happened(case)?;
            Some(Counted { happened, index: transferred.index(&case.measures)?.value, cell })
        };
        let counted: Vec<Option<Counted>> = cases.iter().zip(cells).map(counts).collect();
        let forecast = |(case, counted): (&Case, &Option<Counted>)| {
            let happened = counted.as_ref()?.happened;
            let probability = transferred.index(&case.measures)?.probability();
            let is_extrapolated = transferred.is_extrapolated(&case.measures);
            Some(Forecast { probability, happened, is_extrapolated })
        };
        let forecasts: Vec<Forecast> = cases.iter().zip(&counted).filter_map(forecast).collect();
        let Some(validation) = Validation::of(&forecasts) else { return Ok(None) };
        let (indices, happened): (Vec<f64>, Vec<bool>) =
            counted.iter().flatten().map(|counted| (counted.index, counted.happened)).unzip();
        let own =
            subject.fit(cases).and_then(|own| beside_own(subject, &own, [reference, cases], &counted, cells));
        Ok(Some(Transfer {
            slope: calibration_slope(&indices, &happened),
            share_log_score: expected_log_score(&[validation.share]),
            validation,
            own,
        }))
    }

    /// The share of what the own curve tells beyond the share of events that the transferred one does not; above 1 where it
    /// says less than that share alone. None where the own one tells nothing.
    pub fn share_lost(&self) -> Option<f64> {
        let own = self.own.as_ref().ok()?;
        let told = own.log_score - self.share_log_score;
        (told > 0.0).then(|| own.loss.value / told)
    }

    /// In a word.
    pub fn verdict(&self) -> Verdict {
        match self.share_lost() {
            None => Verdict::TooFewEvents,
            Some(lost) if lost < LITTLE => Verdict::Holds,
            Some(lost) if lost < MUCH => Verdict::Bends,
            Some(_) => Verdict::Fails,
        }
    }
}

/// A case that counts.
struct Counted {
    happened: bool,
    /// That of the transferred curve.
    index: f64,
    cell: usize,
}

impl Counted {
    /// The logarithm of the probability of what happened.
    fn log_score(&self, index: f64) -> f64 {
        normal::ln_cdf(if self.happened { index } else { -index })
    }
}

/// Log scores of both curves without the fold of each case, and the difference of both with all.
fn beside_own(
    subject: &CurveSubject,
    own: &Curve,
    [reference, cases]: [&[Case]; 2],
    counted: &[Option<Counted>],
    cells: &[usize],
) -> Result<BesideOwn, FitStatus> {
    let index =
        |curve: &Curve, case: &Case| curve.index(&case.measures).map_or(f64::NAN, |index| index.value);
    let folds = Folds::new(cells, MOST_FOLDS).ok_or(FitStatus::TooFewEvents)?;
    let of_both = folds.leave_out(|_, weights| {
        let kept = |cases: &[Case]| -> Vec<Case> {
            cases.iter().zip(weights).filter(|(_, weight)| **weight > 0.0).map(|(case, _)| *case).collect()
        };
        let (own, transferred) = (subject.fit(&kept(cases)).ok()?, subject.fit(&kept(reference)).ok()?);
        Some(move |case: usize| (index(&own, &cases[case]), index(&transferred, &cases[case])))
    });
    let (of_own, of_transferred): (Vec<f64>, Vec<f64>) =
        of_both.ok_or(FitStatus::TooFewEvents)?.into_iter().unzip();
    let scores = |indices: &[f64]| -> Vec<f64> {
        let pairs = counted.iter().zip(indices);
        pairs.filter_map(|(counted, index)| Some(counted.as_ref()?.log_score(*index))).collect()
    };
    let (own_scores, transferred_scores) = (scores(&of_own), scores(&of_transferred));
    let counted_cells: Vec<usize> = counted.iter().flatten().map(|counted| counted.cell).collect();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let difference = |(case, counted): (&Case, &Option<Counted>)| {
        Some(normal::cdf(counted.as_ref()?.index) - normal::cdf(index(own, case)))
    };
    let differences: Vec<f64> = cases.iter().zip(counted).filter_map(difference).collect();
    Ok(BesideOwn {
        log_score: mean(&own_scores),
        transferred: mean(&transferred_scores),
        loss: gain(&own_scores, &transferred_scores, &counted_cells),
        mean_error: differences.iter().map(|d| d.abs()).sum::<f64>() / differences.len() as f64,
        worst_over: most(differences.iter().copied()),
        worst_under: most(differences.iter().map(|d| -d)),
    })
}

/// The largest that is above 0; 0 without one. Which of 0 and -0 `f64::max` takes depends on the compiler.
fn most(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, value| if value > most { value } else { most })
}
