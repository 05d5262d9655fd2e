//! The pex file: one row a regression of the demand in safe rocking.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;

use polars::prelude::{ChunkCompareEq, DataFrame};

use super::TableError;
use super::frame::read_frame;
use super::schema::{self, Column, PEX};
use crate::fragility::{DemandReplicate, Measure};
use crate::keyword::{Keyword, keywords};
use crate::statistics::{BootstrapLimits, Estimate, FitStatus, Limits, LinearFit, Test};

/// The form of a regression.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Model {
    /// On one measure.
    Univariate,
    /// On two, everywhere.
    Plane,
    /// On two, on one side of the transition.
    Biplanar,
    /// On two, on one side of a smooth transition; fitted together.
    Smooth,
}

keywords!(Model { Univariate = "univariate", Plane = "plane", Biplanar = "biplanar", Smooth = "smooth" });

/// One regression.
#[derive(Debug, Clone, PartialEq)]
pub struct PexRow {
    /// Of which suite.
    pub suite: Option<String>,
    /// Of which structure.
    pub structure: String,
    /// Its coefficient of restitution.
    pub eta: f64,
    /// Its form.
    pub model: Model,
    /// First measure.
    pub im_x: Measure,
    /// Second measure.
    pub im_y: Option<Measure>,
    /// Where it holds.
    pub range_low: Option<f64>,
    /// Up to where.
    pub range_high: Option<f64>,
    /// The demand that P_ex is about.
    pub limit_state: f64,
    /// Least and largest value of each measure in the cases.
    pub ranges: Vec<[f64; 2]>,
    /// Of both planes, each about the mean on its own side.
    pub r2_pooled: Option<f64>,
    /// Of both planes, about the mean of all cases.
    pub r2_overall: Option<f64>,
    /// IM4 of the least pooled residual, or where the planes of a smooth transition count the same.
    pub transition_found: Option<f64>,
    /// Its limits: by the residual (Hansen) of a break, by linearisation of a smooth transition.
    pub transition_limits: Option<Limits>,
    /// Its percentile limits.
    pub transition_percentile: Option<Limits>,
    /// Width of a smooth transition, in ln IM4.
    pub transition_width: Option<Estimate>,
    /// Ramsey's test.
    pub reset: Option<Test>,
    /// The fit, or why there is none.
    pub fit: Result<LinearFit, FitStatus>,
    /// Probability with which limits hold the truth.
    pub confidence: f64,
    /// Standard errors of the coefficients where cases of one cell or earthquake may depend on each other.
    pub clustered_errors: Vec<f64>,
    /// Bootstrap limits of the coefficients and of the dispersion; empty without replicates.
    pub limits: Vec<Option<BootstrapLimits>>,
    /// Of the bootstrap.
    pub replicates: Vec<Option<PexReplicate>>,
}

/// A regression of a resample.
#[derive(Debug, Clone, PartialEq)]
pub struct PexReplicate {
    /// Where it holds.
    pub range: Range<f64>,
    /// Its numbers.
    pub fit: DemandReplicate,
}

impl PexRow {
    /// The form and the measure of the fit, for a message.
    pub fn measures(&self) -> String {
        format!("{} {}", self.model.as_str(), self.im_x.as_str())
    }

    /// Whether there is a fit, and if not, why.
    pub fn status(&self) -> FitStatus {
        match &self.fit {
            Ok(fit) => fit.status(),
            Err(status) => *status,
        }
    }

    /// What is wrong with the fit, for a message.
    pub fn reason(&self) -> String {
        let suite = self.suite.as_deref().unwrap_or("the motions");
        match self.status() {
            FitStatus::Falling => {
                format!("the demand for {suite}, {}, falls with the measure", self.structure)
            }
            status => format!("no fit of the demand for {suite}, {}: {}", self.structure, status.as_str()),
        }
    }

    /// Where the fit holds.
    pub fn range(&self) -> Range<f64> {
        self.range_low.unwrap_or(0.0)..self.range_high.unwrap_or(f64::INFINITY)
    }

    /// Where it holds if two planes meet at this IM4; none of two planes that meet nowhere.
    pub fn range_at(&self, transition: Option<f64>) -> Option<Range<f64>> {
        match (self.model, self.range_high) {
            (Model::Univariate | Model::Plane | Model::Smooth, _) => Some(self.range()),
            (Model::Biplanar, Some(_)) => Some(self.range().start..transition?),
            (Model::Biplanar, None) => Some(transition?..f64::INFINITY),
        }
    }

    fn coefficient(&self, index: usize) -> Option<Estimate> {
        self.fit.as_ref().ok().and_then(|fit| fit.coefficients.get(index).copied())
    }

    fn covariance(&self, place: (usize, usize)) -> Option<f64> {
        self.fit.as_ref().ok().and_then(|fit| fit.covariance.get(place).copied())
    }

    fn limits_of(&self, parameter: Parameter) -> Option<BootstrapLimits> {
        let coefficients = self.fit.as_ref().ok()?.coefficients.len();
        match parameter {
            Parameter::Coefficient(index) if index >= coefficients => None,
            Parameter::Coefficient(index) => *self.limits.get(index)?,
            Parameter::Beta => *self.limits.get(coefficients)?,
        }
    }
}

/// What has bootstrap limits.
#[derive(Clone, Copy)]
enum Parameter {
    Coefficient(usize),
    Beta,
}

/// The rows of the pex file; what is no finite number is null.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[PexRow]) -> Result<RecordBatch, ArrowError> {
    let number = |value: &dyn Fn(&PexRow) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(|row| value(row).filter(|v| v.is_finite()))))
    };
    let fitted = |value: fn(&LinearFit) -> f64| number(&|row| row.fit.as_ref().ok().map(value));
    let estimate = |index: usize, part: fn(Estimate) -> f64| number(&|row| row.coefficient(index).map(part));
    let text = |value: fn(&PexRow) -> Option<&str>| -> ArrayRef {
        Arc::new(rows.iter().map(value).collect::<StringArray>())
    };
    let zeta = |row: &PexRow| Some(row.fit.as_ref().ok()?.residual_sd / row.coefficient(1)?.value);
    let mut columns: Vec<ArrayRef> = vec![
        text(|row| row.suite.as_deref()),
        text(|row| Some(&row.structure)),
        text(|row| Some(row.model.as_str())),
        text(|row| Some(row.im_x.as_str())),
        text(|row| row.im_y.map(Keyword::as_str)),
        number(&|row| row.range_low),
        number(&|row| row.range_high),
        number(&|row| Some(row.limit_state)),
    ];
    columns.extend((0..3).map(|index| estimate(index, |e| e.value)));
    columns.extend([
        fitted(|fit| fit.r2),
        number(&|row| row.r2_pooled),
        number(&|row| row.r2_overall),
        number(&|row| row.transition_found),
        fitted(|fit| fit.residual_sd),
        number(&zeta),
        Arc::new(Int64Array::from_iter_values(
            rows.iter().map(|row| row.fit.as_ref().map_or(0, |fit| fit.n as i64)),
        )),
    ]);
    columns.extend((0..3).map(|index| estimate(index, |e| e.standard_error)));
    columns.extend((0..3).flat_map(|index| [estimate(index, |e| e.low), estimate(index, |e| e.high)]));
    columns.extend([(0, 1), (0, 2), (1, 2)].map(|place| number(&|row| row.covariance(place))));
    columns.extend((0..3).map(|k| number(&|row| row.clustered_errors.get(k).copied())));
    columns.push(number(&|row| Some(row.confidence)));
    columns.push(Arc::new(Int64Array::from_iter_values(
        rows.iter().map(|row| row.replicates.iter().flatten().count() as i64),
    )));
    let coefficients = (0..3).map(Parameter::Coefficient);
    for parameter in coefficients.chain([Parameter::Beta]) {
        let limit = |k: usize| number(&|row| row.limits_of(parameter)?.in_order()[k]);
        columns.extend((0..4).map(limit));
    }
    columns.extend([
        number(&|row| Some(row.transition_limits?.low)),
        number(&|row| Some(row.transition_limits?.high)),
        number(&|row| Some(row.transition_percentile?.low)),
        number(&|row| Some(row.transition_percentile?.high)),
        number(&|row| Some(row.transition_width?.value)),
        number(&|row| Some(row.transition_width?.standard_error)),
        number(&|row| Some(row.reset?.statistic)),
        number(&|row| Some(row.reset?.p)),
    ]);
    let end = |(measure, end): (usize, usize)| number(&|row| Some(row.ranges.get(measure)?[end]));
    columns.extend([(0, 0), (0, 1), (1, 0), (1, 1)].map(end));
    columns.push(number(&|row| Some(row.eta)));
    columns.push(text(|row| Some(row.status().as_str())));
    RecordBatch::try_new(PEX.schema(), columns)
}

/// The regressions of a pex file.
pub struct PexFrame(DataFrame);

impl PexFrame {
    /// Reads the file.
    ///
    /// # Errors
    /// If it is none of regressions.
    pub fn read(path: &Path) -> Result<PexFrame, TableError> {
        read_frame(path, &PEX).map(PexFrame)
    }

    /// A number of one of the two planes, below the transition or above it.
    pub fn plane_number(&self, suite: &str, structure: &str, low: bool, column: &str) -> Option<f64> {
        let equal =
            |column: Column, word: &str| Some(self.0.column(column.name).ok()?.str().ok()?.equal(word));
        let open_above = self.0.column(schema::RANGE_HIGH.name).ok()?.is_null();
        let side = if low { !&open_above } else { open_above };
        let rows = equal(schema::SUITE, suite)?
            & equal(schema::STRUCTURE, structure)?
            & equal(schema::MODEL, Model::Biplanar.as_str())?
            & side;
        self.0.filter(&rows).ok()?.column(column).ok()?.f64().ok()?.iter().next().flatten()
    }
}
