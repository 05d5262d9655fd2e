//! The rows of files of fits, as evaluate and export take them, and other readers.

use std::collections::HashMap;
use std::path::PathBuf;

use super::TableError;
use super::pex::PEX;
use super::pro::PRO;
use super::schema::{self, Column, Kind, Table};
use super::store::columns::Columns;
use super::store::reader::Batches;
use super::store::source::Source;
use crate::fragility::{DemandLaw, Measure, Predictor};
use crate::keyword::{self, Keyword};
use crate::statistics::{FitStatus, Link};

/// A row of a file of fits.
#[derive(Debug, Clone, PartialEq)]
pub struct FitRow {
    path: PathBuf,
    row: u64,
    text: HashMap<&'static str, String>,
    numbers: HashMap<&'static str, f64>,
}

/// The regressions of a pex file.
///
/// # Errors
/// If it is none.
pub fn regressions(source: impl Into<Source>) -> Result<Vec<FitRow>, TableError> {
    rows(source, &PEX)
}

/// The curves of a pro file.
///
/// # Errors
/// If it is none.
pub fn curves(source: impl Into<Source>) -> Result<Vec<FitRow>, TableError> {
    rows(source, &PRO)
}

/// The rows of a file of fits.
///
/// # Errors
/// If it is not the output of the stage of this table.
pub fn rows(source: impl Into<Source>, table: &Table) -> Result<Vec<FitRow>, TableError> {
    let mut rows: Vec<FitRow> = Vec::new();
    for batch in Batches::open_whole(source, table, &[table.stage])? {
        let batch = batch?;
        let columns = batch.columns();
        let row = |row| FitRow {
            path: batch.path.to_path_buf(),
            row: batch.first_row + row as u64,
            text: HashMap::new(),
            numbers: HashMap::new(),
        };
        let mut fits: Vec<FitRow> = (0..columns.rows()).map(row).collect();
        for column in table.columns {
            if column.kind == Kind::Text {
                for (fit, text) in fits.iter_mut().zip(columns.optional_text(column)?) {
                    fit.text.extend(text.map(|text| (column.name, text)));
                }
            } else {
                for (fit, number) in fits.iter_mut().zip(numbers(&columns, column)?) {
                    fit.numbers.extend(number.map(|number| (column.name, number)));
                }
            }
        }
        rows.extend(fits);
    }
    Ok(rows)
}

fn numbers(columns: &Columns, column: &Column) -> Result<Vec<Option<f64>>, TableError> {
    match column.kind {
        Kind::Float64 => columns.optional_numbers(column),
        _ => Ok(columns.integers(column)?.into_iter().map(|count| Some(count as f64)).collect()),
    }
}

impl FitRow {
    /// The text of a column, if it has one.
    pub fn text(&self, column: &Column) -> Option<&str> {
        self.text.get(column.name).map(String::as_str)
    }

    /// The number of a column, if it has one.
    pub fn optional_number(&self, column: &Column) -> Option<f64> {
        self.numbers.get(column.name).copied()
    }

    /// The number of a column.
    ///
    /// # Errors
    /// If there is none.
    pub fn number(&self, column: &Column) -> Result<f64, TableError> {
        let missing = || self.error(column, "null; expected a number: fit again with --force".to_string());
        self.optional_number(column).ok_or_else(missing)
    }

    /// The measure of a column, if it has one.
    ///
    /// # Errors
    /// If it is none of the known ones.
    pub fn measure(&self, column: &Column) -> Result<Option<Measure>, TableError> {
        let parse = |word| keyword::parse(word).map_err(|unknown| self.error(column, unknown.to_string()));
        self.text(column).map(parse).transpose()
    }

    /// Why there is no fit in this row, or "ok".
    pub fn status(&self) -> &str {
        self.text(&schema::status).unwrap_or_default()
    }

    /// Whether there is a fit in this row.
    pub fn is_ok(&self) -> bool {
        self.status() == FitStatus::Ok.as_str()
    }

    /// The demand in a row of a pex file.
    ///
    /// # Errors
    /// If the row lacks a number.
    pub fn demand(&self) -> Result<DemandLaw, TableError> {
        let im_y = self.measure(&schema::im_y)?;
        let second = |column| if im_y.is_some() { self.number(column) } else { Ok(0.0) };
        let (a, b1, b2) =
            (self.number(&schema::se_ln_a)?, self.number(&schema::se_b1)?, second(&schema::se_b2)?);
        let [ab1, ab2, b1b2] =
            [self.number(&schema::cov_ln_a_b1)?, second(&schema::cov_ln_a_b2)?, second(&schema::cov_b1_b2)?];
        let ln_median = self.predictor(
            [self.number(&schema::ln_a)?, self.number(&schema::b1)?, second(&schema::b2)?],
            [[a * a, ab1, ab2], [ab1, b1 * b1, b1b2], [ab2, b1b2, b2 * b2]],
        )?;
        let coefficients = 1.0 + ln_median.measures().count() as f64;
        let degrees = self.number(&schema::n)? - coefficients;
        Ok(DemandLaw { ln_median, beta: self.number(&schema::beta)?, degrees })
    }

    /// The probit index in a row of a pro file: b0 + b1 ln IMx + b2 ln IMy.
    ///
    /// # Errors
    /// If the row lacks a number, or the curve has another link.
    pub fn probit(&self) -> Result<Predictor, TableError> {
        let link = self.text(&schema::link).unwrap_or_default();
        if link != Link::Probit.as_str() {
            return Err(self.error(&schema::link, format!("{link}; expected probit: fit with --link probit")));
        }
        let second = |column| if self.text(&schema::im_y).is_some() { self.number(column) } else { Ok(0.0) };
        let [se_0, se_1, se_2] =
            [self.number(&schema::se_b0)?, self.number(&schema::se_b1)?, second(&schema::se_b2)?];
        let [b01, b02, b12] =
            [self.number(&schema::cov_b0_b1)?, second(&schema::cov_b0_b2)?, second(&schema::cov_b1_b2)?];
        self.predictor(
            [self.number(&schema::b0)?, self.number(&schema::index_b1)?, second(&schema::index_b2)?],
            [[se_0 * se_0, b01, b02], [b01, se_1 * se_1, b12], [b02, b12, se_2 * se_2]],
        )
    }

    fn predictor(&self, coefficients: [f64; 3], covariance: [[f64; 3]; 3]) -> Result<Predictor, TableError> {
        let missing = || self.error(&schema::im_x, "null; expected a measure".to_string());
        let im_x = self.measure(&schema::im_x)?.ok_or_else(missing)?;
        let im_y = self.measure(&schema::im_y)?;
        let range_x = [self.number(&schema::im_x_low)?, self.number(&schema::im_x_high)?];
        let range_y = match im_y {
            Some(_) => [self.number(&schema::im_y_low)?, self.number(&schema::im_y_high)?],
            None => [0.0; 2],
        };
        Ok(Predictor { im_x, im_y, coefficients, covariance, ranges: [range_x, range_y] })
    }

    fn error(&self, column: &Column, problem: String) -> TableError {
        TableError::Value { path: self.path.clone(), row: self.row, column: column.name.to_string(), problem }
    }
}
