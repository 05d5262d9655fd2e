//! The cases of a regression or a curve: logarithms of their measures, and what was observed.

use std::ops::Range;
use std::sync::Arc;

use super::case::{Case, Measure};
use super::cases::{Cases, Placed};
use crate::statistics::FitStatus;
use crate::statistics::binary::as_numbers;
use crate::statistics::columns::Columns;
use crate::statistics::design::Design;
use crate::statistics::regression::{LinearFit, RegressionError, regress};
use crate::statistics::spread::is_among;

/// The cases of a regression or a curve that have all its measures.
#[derive(Debug)]
pub struct Sample {
    /// The logarithm of each measure, what was observed, which of all cases it is, its cluster and its cell.
    pub columns: Columns,
    /// How many measures.
    pub measures: usize,
}

/// Which of the labels is that of the cluster; the first is the row.
pub const CLUSTER: usize = 1;
/// Fewer clusters say too little of how they differ: limits that allow for it come out too narrow (Cameron & Miller 2015, section VI).
pub const MANY: usize = 20;
/// Of more cases than these, some will do to see how clusters differ: what is known of that hangs on how many clusters there are.
const ENOUGH: usize = 1 << 14;
/// By how much a number at most changes when its logarithm is taken and undone.
const ROUNDING: f64 = 1e-14;

impl Sample {
    /// Of an event; `event` says whether it happened, or that a case does not count.
    pub fn of_events<C: Cases + ?Sized>(
        cases: &C,
        measures: &[Measure],
        event: impl Fn(&Case) -> Option<bool> + Sync,
    ) -> Sample {
        Sample::of(cases, measures, |case, _| event(case).map(|happened| f64::from(u8::from(happened))))
    }

    /// Of ln EDP in safe rocking, where the first measure lies in `range`.
    pub fn of_demands<C: Cases + ?Sized>(cases: &C, measures: &[Measure], range: Range<f64>) -> Sample {
        Sample::of(cases, measures, |case, first| {
            (case.has_demand() && range.contains(&first)).then(|| libm::log(case.edp))
        })
    }

    fn of<C: Cases + ?Sized>(
        cases: &C,
        measures: &[Measure],
        observed: impl Fn(&Case, f64) -> Option<f64> + Sync,
    ) -> Sample {
        let width = measures.len() + 4;
        let of_some = |some: &[Placed]| {
            let mut columns = vec![Vec::with_capacity(some.len()); width];
            let mut values = vec![0.0; width];
            for Placed { row, case, cell, cluster } in some {
                let has_all = measures.iter().zip(&mut values).all(|(measure, value)| {
                    *value = measure.of(case).unwrap_or(f64::NAN);
                    !value.is_nan()
                });
                if let Some(y) = has_all.then(|| observed(case, values[0])).flatten() {
                    values[..measures.len()].iter_mut().for_each(|value| *value = libm::log(*value));
                    values[measures.len()..].copy_from_slice(&[
                        y,
                        *row as f64,
                        *cluster as f64,
                        *cell as f64,
                    ]);
                    columns.iter_mut().zip(&values).for_each(|(column, value)| column.push(*value));
                }
            }
            columns
        };
        let mut columns = Columns::new(width, &Arc::default());
        cases.each(of_some, |some: Vec<Vec<f64>>| columns.append(&some));
        Sample { columns, measures: measures.len() }
    }

    /// Of these predictors, whatever they are, each as long as what was observed.
    pub fn of_columns(predictors: Vec<Vec<f64>>, observed: Vec<f64>) -> Sample {
        let measures = predictors.len();
        let rows: Vec<f64> = (0..observed.len()).map(|row| row as f64).collect();
        let mut columns = Columns::new(measures + 4, &Arc::default());
        let cells = vec![0.0; rows.len()];
        let labels = [rows.clone(), rows, cells];
        columns.append(&predictors.into_iter().chain([observed]).chain(labels).collect::<Vec<_>>());
        Sample { columns, measures }
    }

    /// The same of what happened or did not.
    pub fn of_happened(predictors: Vec<Vec<f64>>, happened: &[bool]) -> Sample {
        Sample::of_columns(predictors, as_numbers(happened))
    }

    /// The same cases with predictors more, which follow from the logarithms of the measures.
    pub fn with(&self, further: impl Fn(&[&[f64]]) -> Vec<Vec<f64>> + Sync) -> Sample {
        let of_block = |_: usize, columns: &[&[f64]]| -> Vec<Vec<f64>> {
            let (measures, rest) = columns.split_at(self.measures);
            let copied =
                |columns: &[&[f64]]| columns.iter().map(|column| column.to_vec()).collect::<Vec<_>>();
            copied(measures).into_iter().chain(further(measures)).chain(copied(rest)).collect()
        };
        let more = further(&vec![&[][..]; self.measures]).len();
        let mut columns = Columns::new(self.measures + more + 4, &Arc::default());
        self.columns.each(self.measures + 4, of_block, |some| columns.append(&some));
        Sample { columns, measures: self.measures + more }
    }

    /// Cases from all over the sample, as many as are enough to see how clusters differ; none where all of them are no more.
    pub fn thinned(&self) -> Option<Sample> {
        let share = ENOUGH as f64 / self.cases() as f64;
        if share >= 1.0 {
            return None;
        }
        let of_block = |first: usize, columns: &[&[f64]]| -> Vec<Vec<f64>> {
            let is_kept = |case: &usize| is_among(first + case, share);
            let kept: Vec<usize> = (0..columns[0].len()).filter(is_kept).collect();
            columns.iter().map(|column| kept.iter().map(|&case| column[case]).collect()).collect()
        };
        let width = self.measures + 4;
        let mut columns = Columns::new(width, &Arc::default());
        self.columns.each(width, of_block, |some| columns.append(&some));
        Some(Sample { columns, measures: self.measures })
    }

    /// Whether the cases are of many clusters.
    pub fn has_many_clusters(&self) -> bool {
        self.design().distinct(CLUSTER).len() >= MANY
    }

    /// How many cases there are.
    pub fn cases(&self) -> usize {
        self.columns.rows()
    }

    /// In how many the event happened.
    pub fn events(&self) -> usize {
        self.design().fold(0, |rows| rows.y.iter().sum::<f64>(), |sum, part| *sum += part) as usize
    }

    /// The design of a regression on the measures.
    pub fn design(&self) -> Design<'_> {
        Design::new(&self.columns, self.measures)
    }

    /// The logarithms of each measure.
    pub fn predictors(&self) -> Vec<Vec<f64>> {
        (0..self.measures).map(|measure| self.columns.column(measure)).collect()
    }

    /// What was observed in each case.
    pub fn observed(&self) -> Vec<f64> {
        self.columns.column(self.measures)
    }

    /// Which of all cases they are.
    pub fn rows(&self) -> Vec<usize> {
        self.columns.column(self.measures + 1).into_iter().map(|row| row as usize).collect()
    }

    /// Least and largest value of each measure, a rounding error further out: they return from their logarithms, and no case of
    /// the sample may lie outside.
    pub fn ranges(&self) -> Vec<[f64; 2]> {
        let of = |measure| {
            let [least, largest] = self.design().range(measure).map(libm::exp);
            [least * (1.0 - ROUNDING), largest * (1.0 + ROUNDING)]
        };
        (0..self.measures).map(of).collect()
    }

    /// Least squares of what was observed on the logarithms of the measures.
    ///
    /// # Errors
    /// With the status that says why there is no fit.
    pub fn fit(&self) -> Result<LinearFit, FitStatus> {
        regress(&self.design()).map_err(|error| match error {
            RegressionError::TooFewCases { .. } => FitStatus::TooFewCases,
            RegressionError::Constant => FitStatus::Constant,
            RegressionError::Collinear => FitStatus::Collinear,
        })
    }
}
