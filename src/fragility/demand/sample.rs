use crate::fragility::case::{Case, Measure};
use crate::statistics::FitStatus;
use crate::statistics::design::DesignMatrix;
use crate::statistics::regression::{LinearFit, RegressionError, least_squares};

/// The demands of the safe-rocking cases and the logarithms of their measures, where all are there.
#[derive(Debug, Clone, PartialEq)]
pub struct DemandSample {
    /// Response of the regression.
    pub ln_edp: Vec<f64>,
    /// The logarithms of each measure.
    pub ln_im: Vec<Vec<f64>>,
    /// Which of all cases they are.
    pub rows: Vec<usize>,
}

impl DemandSample {
    /// Of the cases whose first measure lies in `range`.
    pub fn new(cases: &[Case], measures: &[Measure], range: std::ops::Range<f64>) -> DemandSample {
        let ln_im = vec![Vec::new(); measures.len()];
        let mut sample = DemandSample { ln_edp: Vec::new(), ln_im, rows: Vec::new() };
        for (row, case) in cases.iter().enumerate().filter(|(_, case)| case.has_demand()) {
            let values = measures.iter().map(|measure| measure.of(case)).collect::<Option<Vec<f64>>>();
            if let Some(values) = values
                && values.first().is_some_and(|first| range.contains(first))
            {
                sample.ln_edp.push(case.edp.ln());
                sample.rows.push(row);
                for (column, value) in sample.ln_im.iter_mut().zip(values) {
                    column.push(value.ln());
                }
            }
        }
        sample
    }

    /// Least squares of ln EDP on the logarithms of the measures.
    ///
    /// # Errors
    /// With the status that says why there is no fit.
    pub fn fit(&self) -> Result<LinearFit, FitStatus> {
        least_squares(&self.predictors(), &self.ln_edp).map_err(|error| match error {
            RegressionError::TooFewCases { .. } => FitStatus::TooFewCases,
            RegressionError::Constant => FitStatus::Constant,
            RegressionError::Collinear => FitStatus::Collinear,
        })
    }

    /// The logarithms of each measure.
    pub fn predictors(&self) -> Vec<&[f64]> {
        self.ln_im.iter().map(Vec::as_slice).collect()
    }

    /// The design matrix of a regression on them.
    pub fn design(&self) -> DesignMatrix {
        DesignMatrix::new(&self.predictors(), self.ln_edp.len())
    }
}
