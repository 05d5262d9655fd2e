//! The pro file: one row a fragility curve.

use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;
use polars::prelude::{ChunkCompareEq, DataFrame};

use super::TableError;
use super::frame::read_frame;
use super::schema::{self, Column, PRO};
use crate::fragility::overturning::{Curve, ParameterInference};
use crate::fragility::{CurveParameter, OverturningFit};
use crate::keyword::{self, Keyword};
use crate::statistics::{Estimate, Link, Test};

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct ProRow {
    /// Suite of the responses, if known.
    pub suite: Option<String>,
    /// Name of the structure.
    pub structure: String,
    /// Its coefficient of restitution.
    pub eta: f64,
    /// What was fitted.
    pub curve: Curve,
}

/// The rows of the pro file; a limit beyond all numbers is null.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[ProRow]) -> Result<RecordBatch, ArrowError> {
    let number = |value: &dyn Fn(&OverturningFit) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(
            rows.iter().map(|row| row.curve.fit.as_ref().ok().and_then(value).filter(|v| v.is_finite())),
        ))
    };
    let text = |value: fn(&ProRow) -> Option<&str>| -> ArrayRef {
        Arc::new(rows.iter().map(value).collect::<StringArray>())
    };
    let count = |value: fn(&ProRow) -> usize| -> ArrayRef {
        Arc::new(Int64Array::from_iter_values(rows.iter().map(|row| value(row) as i64)))
    };
    let estimates: [fn(&OverturningFit) -> Option<Estimate>; 4] =
        [|fit| fit.lambda, |fit| Some(fit.mu), |fit| Some(fit.beta), |fit| Some(fit.theta)];
    let part = |estimate: fn(&OverturningFit) -> Option<Estimate>, part: fn(Estimate) -> f64| {
        number(&|fit| estimate(fit).map(part))
    };
    let mut columns: Vec<ArrayRef> = vec![
        text(|row| row.suite.as_deref()),
        text(|row| Some(&row.structure)),
        text(|row| Some(row.curve.event.as_str())),
        text(|row| Some(row.curve.im_x.as_str())),
        text(|row| row.curve.im_y.map(Keyword::as_str)),
    ];
    columns.extend(estimates.map(|estimate| part(estimate, |e| e.value)));
    columns.extend([
        number(&|fit| Some(fit.regression.log_likelihood)),
        number(&|fit| Some(fit.aic)),
        number(&|fit| Some(fit.bic)),
        number(&|fit| Some(fit.auc)),
        number(&|fit| Some(fit.brier)),
        count(|row| row.curve.n),
        count(|row| row.curve.events),
    ]);
    columns.extend(estimates.map(|estimate| part(estimate, |e| e.standard_error)));
    for estimate in estimates {
        columns.extend([part(estimate, |e| e.low), part(estimate, |e| e.high)]);
    }
    columns.push(text(|row| Some(row.curve.model.link.as_str())));
    columns.push(text(|row| Some(row.curve.model.estimator.as_str())));
    columns.extend((0..3).map(|k| number(&|fit| fit.regression.coefficients.get(k).copied())));
    let covariance = |place: (usize, usize)| number(&|fit| fit.regression.covariance.get(place).copied());
    columns.extend((0..3).map(|k| number(&|fit| Some(fit.regression.covariance.get((k, k))?.sqrt()))));
    columns.extend([(0, 1), (0, 2), (1, 2)].map(covariance));
    let inferred =
        |parameter: CurveParameter, value: &dyn Fn(&ParameterInference) -> Option<f64>| -> ArrayRef {
            let value =
                |row: &ProRow| row.curve.inference_of(parameter).and_then(value).filter(|v| v.is_finite());
            Arc::new(Float64Array::from_iter(rows.iter().map(value)))
        };
    columns.extend(CurveParameter::ALL.map(|parameter| inferred(parameter, &|i| Some(i.clustered_error))));
    for parameter in CurveParameter::ALL {
        columns.push(inferred(parameter, &|i| Some(i.profile.low)));
        columns.push(inferred(parameter, &|i| Some(i.profile.high)));
    }
    columns.push(Arc::new(Float64Array::from_iter_values(rows.iter().map(|row| row.curve.model.confidence))));
    columns.push(count(|row| row.curve.replicates.iter().flatten().count()));
    for parameter in CurveParameter::ALL {
        columns.extend((0..4).map(|k| inferred(parameter, &|i| i.bootstrap?.in_order()[k])));
    }
    let test = |test: fn(&ProRow) -> Option<Test>, part: fn(Test) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(|row| test(row).map(part))))
    };
    let hosmer_lemeshow = |row: &ProRow| row.curve.fit.as_ref().ok()?.hosmer_lemeshow;
    columns.extend([
        test(hosmer_lemeshow, |test| test.statistic),
        test(hosmer_lemeshow, |test| test.p),
        test(|row| row.curve.spline, |test| test.p),
        test(|row| row.curve.interaction, |test| test.p),
    ]);
    let of_row = |value: &dyn Fn(&ProRow) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(|row| value(row).filter(|v| v.is_finite()))))
    };
    let end = |(measure, end): (usize, usize)| of_row(&|row| Some(row.curve.data_ranges.get(measure)?[end]));
    columns.extend([(0, 0), (0, 1), (1, 0), (1, 1)].map(end));
    columns.push(of_row(&|row| Some(row.eta)));
    columns.push(text(|row| Some(row.curve.status().as_str())));
    RecordBatch::try_new(PRO.schema(), columns)
}

/// The curves of a pro file.
pub struct ProFrame(DataFrame);

impl ProFrame {
    /// Reads the file.
    ///
    /// # Errors
    /// If it is none of curves.
    pub fn read(path: &Path) -> Result<ProFrame, TableError> {
        read_frame(path, &PRO).map(ProFrame)
    }

    /// A number of the curve of one measure, or of a hybrid of two.
    pub fn number(
        &self,
        suite: &str,
        structure: &str,
        im_x: &str,
        im_y: Option<&str>,
        column: &str,
    ) -> Option<f64> {
        let equal =
            |column: Column, word: &str| Some(self.0.column(column.name).ok()?.str().ok()?.equal(word));
        let second = match im_y {
            Some(im_y) => equal(schema::IM_Y, im_y)?,
            None => self.0.column(schema::IM_Y.name).ok()?.is_null(),
        };
        let rows = equal(schema::SUITE, suite)?
            & equal(schema::STRUCTURE, structure)?
            & equal(schema::IM_X, im_x)?
            & second;
        self.0.filter(&rows).ok()?.column(column).ok()?.f64().ok()?.iter().next().flatten()
    }

    /// The link of all curves.
    pub fn link(&self) -> Option<Link> {
        keyword::parse(self.0.column(schema::LINK.name).ok()?.str().ok()?.get(0)?).ok()
    }
}
