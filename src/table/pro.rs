//! The pro file: one row a fragility curve.

use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;
use nalgebra::DVector;

use polars::prelude::{ChunkCompareEq, DataFrame};

use super::TableError;
use super::frame::read_frame;
use super::schema::{self, Column, PRO};
use crate::fragility::{CurveModel, CurveParameter, Measure, OverturningFit, has_few_events};
use crate::keyword::{self, Keyword};
use crate::statistics::{BootstrapLimits, Estimate, FitStatus, Limits, Link, Test};

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct ProRow {
    /// Of which suite.
    pub suite: Option<String>,
    /// Of which structure.
    pub structure: String,
    /// Its coefficient of restitution.
    pub eta: f64,
    /// What it is the probability of.
    pub event: &'static str,
    /// First measure.
    pub im_x: Measure,
    /// Second measure, of a hybrid.
    pub im_y: Option<Measure>,
    /// Cases used.
    pub n: usize,
    /// Those in which the event happened.
    pub events: usize,
    /// Least and largest value of each measure in the cases.
    pub ranges: Vec<[f64; 2]>,
    /// How the curve was fitted.
    pub model: CurveModel,
    /// The curve, or why there is none.
    pub fit: Result<OverturningFit, FitStatus>,
    /// The likelihood-ratio test against a curve that bends as a spline.
    pub spline: Option<Test>,
    /// The same against one with an interaction.
    pub interaction: Option<Test>,
    /// How sure its parameters are.
    pub inference: Vec<ParameterInference>,
    /// The coefficients in each resample, where it has a curve.
    pub replicates: Vec<Option<DVector<f64>>>,
}

impl ProRow {
    /// The measures of the curve, for a message.
    pub fn measures(&self) -> String {
        let second = self.im_y.map_or(String::new(), |measure| format!(":{}", measure.as_str()));
        format!("{}{second}", self.im_x.as_str())
    }

    /// Whether there is a curve, and if not, why.
    pub fn status(&self) -> FitStatus {
        match &self.fit {
            Ok(fit) => fit.status(),
            Err(status) => *status,
        }
    }

    fn inference_of(&self, parameter: CurveParameter) -> Option<&ParameterInference> {
        self.inference.iter().find(|inference| inference.parameter == parameter)
    }

    /// Whether there is a curve, from so few events that some of its limits are too narrow.
    pub fn has_few_events(&self) -> bool {
        let measures = 1 + usize::from(self.im_y.is_some());
        self.fit.is_ok() && has_few_events(self.events, self.n, measures)
    }

    /// Which limits to take where events are few, for a message.
    pub fn few_events(&self) -> String {
        let suite = self.suite.as_deref().unwrap_or("the motions");
        format!(
            "few events for {suite}, {} ({} of {} cases), so that limits by standard errors are too narrow; take the profile limits",
            self.structure, self.events, self.n
        )
    }

    /// What is wrong with the curve, for a message.
    pub fn reason(&self) -> String {
        let suite = self.suite.as_deref().unwrap_or("the motions");
        match self.status() {
            FitStatus::Falling => {
                format!(
                    "the probability of {} for {suite}, {}, falls with the measure",
                    self.event, self.structure
                )
            }
            status => format!(
                "no curve of {} for {suite}, {}: {} ({} of {} cases)",
                self.event,
                self.structure,
                status.as_str(),
                self.events,
                self.n
            ),
        }
    }
}

/// How sure a parameter of a curve is, besides the errors and limits of the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterInference {
    /// Which.
    pub parameter: CurveParameter,
    /// Standard error where cases of one cell or earthquake may depend on each other.
    pub clustered_error: f64,
    /// By the profile likelihood.
    pub profile: Limits,
    /// From the replicates, if they give any.
    pub bootstrap: Option<BootstrapLimits>,
}

/// The rows of the pro file; a limit beyond all numbers is null.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[ProRow]) -> Result<RecordBatch, ArrowError> {
    let number = |value: &dyn Fn(&OverturningFit) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(
            rows.iter().map(|row| row.fit.as_ref().ok().and_then(value).filter(|v| v.is_finite())),
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
        text(|row| Some(row.event)),
        text(|row| Some(row.im_x.as_str())),
        text(|row| row.im_y.map(Keyword::as_str)),
    ];
    columns.extend(estimates.map(|estimate| part(estimate, |e| e.value)));
    columns.extend([
        number(&|fit| Some(fit.regression.log_likelihood)),
        number(&|fit| Some(fit.aic)),
        number(&|fit| Some(fit.bic)),
        number(&|fit| Some(fit.auc)),
        number(&|fit| Some(fit.brier)),
        count(|row| row.n),
        count(|row| row.events),
    ]);
    columns.extend(estimates.map(|estimate| part(estimate, |e| e.standard_error)));
    for estimate in estimates {
        columns.extend([part(estimate, |e| e.low), part(estimate, |e| e.high)]);
    }
    columns.push(text(|row| Some(row.model.link.as_str())));
    columns.push(text(|row| Some(row.model.estimator.as_str())));
    columns.extend((0..3).map(|k| number(&|fit| fit.regression.coefficients.get(k).copied())));
    let covariance = |place: (usize, usize)| number(&|fit| fit.regression.covariance.get(place).copied());
    columns.extend((0..3).map(|k| number(&|fit| Some(fit.regression.covariance.get((k, k))?.sqrt()))));
    columns.extend([(0, 1), (0, 2), (1, 2)].map(covariance));
    let inferred =
        |parameter: CurveParameter, value: &dyn Fn(&ParameterInference) -> Option<f64>| -> ArrayRef {
            let value = |row: &ProRow| row.inference_of(parameter).and_then(value).filter(|v| v.is_finite());
            Arc::new(Float64Array::from_iter(rows.iter().map(value)))
        };
    columns.extend(CurveParameter::ALL.map(|parameter| inferred(parameter, &|i| Some(i.clustered_error))));
    for parameter in CurveParameter::ALL {
        columns.push(inferred(parameter, &|i| Some(i.profile.low)));
        columns.push(inferred(parameter, &|i| Some(i.profile.high)));
    }
    columns.push(Arc::new(Float64Array::from_iter_values(rows.iter().map(|row| row.model.confidence))));
    columns.push(count(|row| row.replicates.iter().flatten().count()));
    for parameter in CurveParameter::ALL {
        columns.extend((0..4).map(|k| inferred(parameter, &|i| i.bootstrap?.in_order()[k])));
    }
    let test = |test: fn(&ProRow) -> Option<Test>, part: fn(Test) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(|row| test(row).map(part))))
    };
    let hosmer_lemeshow = |row: &ProRow| row.fit.as_ref().ok()?.hosmer_lemeshow;
    columns.extend([
        test(hosmer_lemeshow, |test| test.statistic),
        test(hosmer_lemeshow, |test| test.p),
        test(|row| row.spline, |test| test.p),
        test(|row| row.interaction, |test| test.p),
    ]);
    let of_row = |value: &dyn Fn(&ProRow) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(|row| value(row).filter(|v| v.is_finite()))))
    };
    let end = |(measure, end): (usize, usize)| of_row(&|row| Some(row.ranges.get(measure)?[end]));
    columns.extend([(0, 0), (0, 1), (1, 0), (1, 1)].map(end));
    columns.push(of_row(&|row| Some(row.eta)));
    columns.push(text(|row| Some(row.status().as_str())));
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
