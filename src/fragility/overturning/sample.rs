use crate::fragility::case::{Case, Measure};
use crate::statistics::design::DesignMatrix;

/// The cases of a curve: logarithms of their measures, and whether the event happened.
#[derive(Debug, Clone, PartialEq)]
pub struct EventSample {
    ln_im: Vec<Vec<f64>>,
    /// In each case.
    pub happened: Vec<bool>,
    /// Which of all cases they are.
    pub rows: Vec<usize>,
}

impl EventSample {
    /// Of the cases that have all the measures; `event` says whether it happened, or that the case does not count.
    pub fn new(cases: &[Case], measures: &[Measure], event: impl Fn(&Case) -> Option<bool>) -> EventSample {
        let ln_im = vec![Vec::new(); measures.len()];
        let mut sample = EventSample { ln_im, happened: Vec::new(), rows: Vec::new() };
        for (row, case) in cases.iter().enumerate() {
            let values = measures.iter().map(|measure| measure.of(case)).collect::<Option<Vec<f64>>>();
            if let (Some(values), Some(happened)) = (values, event(case)) {
                sample.happened.push(happened);
                sample.rows.push(row);
                for (column, value) in sample.ln_im.iter_mut().zip(values) {
                    column.push(value.ln());
                }
            }
        }
        sample
    }

    /// Of these predictors, whatever they are, each as long as `happened`.
    pub fn of_columns(columns: Vec<Vec<f64>>, happened: Vec<bool>) -> EventSample {
        EventSample { ln_im: columns, rows: (0..happened.len()).collect(), happened }
    }

    /// In how many cases the event happened.
    pub fn events(&self) -> usize {
        self.happened.iter().filter(|&&happened| happened).count()
    }

    /// The logarithms of each measure.
    pub fn predictors(&self) -> Vec<&[f64]> {
        self.ln_im.iter().map(Vec::as_slice).collect()
    }

    /// The design matrix of a regression on them.
    pub fn design(&self) -> DesignMatrix {
        DesignMatrix::new(&self.predictors(), self.happened.len())
    }
}
