//! A table of intensities, ours (motions, responses) or anyone's: pga_m_s2 and pgv_m_s, and what else is there.

use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::Float32Type;
use arrow_array::{ArrayRef, Float64Array, Int64Array, StringArray, new_null_array};
use arrow_schema::{DataType, Field};

use super::TableError;
use super::evaluated::EVALUATED;
use super::schema::headings::Headings;
use super::schema::{self, Column};
use super::store::columns::{Columns, numbers, spelt_out, whole_numbers, words_of};
use super::store::reader::{Batch, Batches, OpenTable, expect_columns};
use super::store::source::Source;
use crate::motion::IntensityMeasures;
use crate::rocking::{Bound, Structure};

/// The stages whose output can stand as a table of intensities.
const STAGES: [&str; 4] = ["synthesize-motions", "import-motions", "simulate", "evaluate"];

/// Rows that a table may have, however small it is: a grid of intensities, in which each occurs thousands of times, takes less
/// than a byte a row.
const FEW_ROWS: u64 = 1 << 24;

const PEAKS: &[Column] = &[schema::pga_m_s2, schema::pgv_m_s];
const PERIODS: &[Column] = &[schema::tp_s.or_null(), schema::tm_s.or_null()];
const STRUCTURE: &[Column] = &[schema::p_rad_s, schema::alpha_rad, schema::eta.or_null()];
const READ: [&[Column]; 3] = [PEAKS, STRUCTURE, PERIODS];

/// A structure and the motion that it meets.
#[derive(Debug, Clone, PartialEq)]
pub struct Intensity {
    /// The structure; nameless where it comes from the row.
    pub structure: Structure,
    /// Peak ground acceleration, m/s2.
    pub pga_m_s2: f64,
    /// Peak ground velocity, m/s.
    pub pgv_m_s: f64,
    /// Eq. 13.
    pub measures: IntensityMeasures,
}

/// Some rows of a table of intensities.
pub struct Intensities {
    pub rows: Vec<Intensity>,
    /// The columns that are kept, in the order of [`IntensityBatches::kept`].
    pub kept: Vec<ArrayRef>,
}

/// The rows of a table of intensities, some at a time.
pub struct IntensityBatches {
    batches: Batches,
    headings: Headings,
    kept: Vec<Field>,
    not_kept: Vec<String>,
    structure: Option<Structure>,
    eta: Option<f64>,
}

impl IntensityBatches {
    /// Opens the table, `batch_size` rows at a time. `structure` holds for all rows; without one each row must have its
    /// own p and alpha, and `eta` holds where it has no eta; without one it must have one. Columns may have other `headings`.
    ///
    /// # Errors
    /// If the file is missing, unreadable, empty, of another stage, or lacks a column.
    pub fn open(
        source: impl Into<Source>,
        headings: &Headings,
        structure: Option<Structure>,
        eta: Option<f64>,
        batch_size: usize,
    ) -> Result<IntensityBatches, TableError> {
        let columns = if structure.is_none() { READ.concat() } else { [PEAKS, PERIODS].concat() };
        let source = source.into();
        // Of all columns, so that a message can name them.
        let whole = OpenTable::open_at(&source, &STAGES, |_| true)?.schemas()?;
        let renamed = whole.iter().map(|(path, schema)| headings.schema(path, schema));
        let renamed = renamed.collect::<Result<Vec<_>, TableError>>()?;
        let fields = whole[0].1.fields().iter().zip(renamed[0].fields());
        let own_names = fields.filter(|(field, renamed)| field.name() == renamed.name());
        let own: Vec<_> = own_names.map(|(field, _)| field.as_ref()).collect();
        let kept: Vec<Field> = own.iter().filter_map(|field| kept(field)).collect();
        let lost = own.iter().filter(|field| is_lost(field, &columns));
        let not_kept =
            lost.map(|field| format!("{} ({})", field.name(), words_of(field.data_type()))).collect();
        let is_kept = |name: &str| kept.iter().any(|field| field.name() == name);
        let table =
            OpenTable::open_at(source, &STAGES, |name| is_kept(name) || headings.may_be(name, &columns))?;
        table.expect_rows(FEW_ROWS)?;
        for (path, schema) in table.schemas()? {
            expect_columns(&path, &headings.schema(&path, &schema)?, &columns)?;
        }
        let (batches, headings) = (table.batches(batch_size)?, headings.clone());
        Ok(IntensityBatches { batches, headings, kept, not_kept, structure, eta })
    }

    /// The columns of the table that go along with an answer: numbers and text that are none of its own.
    pub fn kept(&self) -> &[Field] {
        &self.kept
    }

    /// Those of other types, in words: they are lost.
    pub fn not_kept(&self) -> &[String] {
        &self.not_kept
    }

    /// How many rows the table has.
    pub fn rows(&self) -> u64 {
        self.batches.rows()
    }

    fn intensities(&self, batch: &Batch) -> Result<Vec<Intensity>, TableError> {
        let columns = batch.columns();
        let not_negative = |value: f64| (value < 0.0).then(|| "0 or more".to_string());
        let pga = within(&columns, &schema::pga_m_s2, not_negative)?;
        let pgv = within(&columns, &schema::pgv_m_s, not_negative)?;
        let (tp, tm) = (columns.optional_numbers(&schema::tp_s)?, columns.optional_numbers(&schema::tm_s)?);
        let structures = self.structures(&columns)?;
        let intensity = |(row, structure): (usize, Structure)| Intensity {
            measures: IntensityMeasures::new(&structure, pga[row], pgv[row], tp[row], tm[row]),
            structure,
            pga_m_s2: pga[row],
            pgv_m_s: pgv[row],
        };
        Ok(structures.into_iter().enumerate().map(intensity).collect())
    }

    fn structures(&self, columns: &Columns) -> Result<Vec<Structure>, TableError> {
        if let Some(structure) = &self.structure {
            return Ok(vec![structure.clone(); columns.rows()]);
        }
        let refusal = |parameter| move |value| Bound::of(parameter)?.refusal(value);
        let p = within(columns, &schema::p_rad_s, refusal("p"))?;
        let alpha = within(columns, &schema::alpha_rad, refusal("alpha"))?;
        let eta = columns.optional_numbers(&schema::eta)?;
        let wrong = |eta: &Option<f64>| refusal("eta")((*eta)?);
        if let Some((row, expected)) = eta.iter().enumerate().find_map(|(row, eta)| Some((row, wrong(eta)?)))
        {
            let found = eta[row].unwrap_or_default();
            return Err(columns.value_error(row, &schema::eta, &format!("{found}; expected {expected}")));
        }
        let structure = |(row, ((p_rad_s, alpha_rad), eta)): (usize, ((f64, f64), Option<f64>))| {
            let unknown =
                || columns.value_error(row, &schema::eta, "null; expected a coefficient of restitution");
            let eta = eta.or(self.eta).ok_or_else(unknown)?;
            Ok(Structure { name: String::new(), p_rad_s, alpha_rad, eta })
        };
        p.into_iter().zip(alpha).zip(eta).enumerate().map(structure).collect()
    }
}

impl Iterator for IntensityBatches {
    type Item = Result<Intensities, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        let batch = self.batches.next()?;
        Some(batch.and_then(|batch| {
            let rows = self.headings.batch(&batch.path, batch.rows)?;
            let kept = |field: &Field| {
                let there = rows.column_by_name(field.name()).map(plain);
                let of_its_type = there.filter(|array| array.data_type() == field.data_type());
                of_its_type.unwrap_or_else(|| new_null_array(field.data_type(), rows.num_rows()))
            };
            let kept = self.kept.iter().map(kept).collect();
            Ok(Intensities { rows: self.intensities(&Batch { rows, ..batch })?, kept })
        }))
    }
}

/// A column that goes along with an answer, as it stands there; none that the answer has itself, and no lists.
fn kept(field: &Field) -> Option<Field> {
    let kind = match field.data_type() {
        DataType::Dictionary(_, of) => return kept(&field.clone().with_data_type(of.as_ref().clone())),
        DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View => DataType::Utf8,
        DataType::Float64 | DataType::Float32 => DataType::Float64,
        DataType::Int32 => DataType::Int32,
        DataType::UInt64 => return None,
        DataType::Decimal128(..) => DataType::Float64,
        kind if kind.is_integer() => DataType::Int64,
        _ => return None,
    };
    (!is_of_answer(field)).then(|| field.clone().with_data_type(kind).with_nullable(true))
}

/// Whether a column is neither read nor kept nor of the answer, and is no list, as accelerations are.
fn is_lost(field: &Field, read: &[Column]) -> bool {
    let is_list =
        matches!(field.data_type(), DataType::List(_) | DataType::LargeList(_) | DataType::FixedSizeList(..));
    let is_read = read.iter().any(|column| column.name == field.name());
    kept(field).is_none() && !is_list && !is_read && !is_of_answer(field)
}

fn is_of_answer(field: &Field) -> bool {
    EVALUATED.columns.iter().any(|column| column.name == field.name())
}

/// An array in one of the types in which columns are kept, if it can be.
fn plain(array: &ArrayRef) -> ArrayRef {
    match array.data_type() {
        DataType::Dictionary(..) => plain(&spelt_out(array)),
        DataType::Int32 => array.clone(),
        DataType::LargeUtf8 => Arc::new(array.as_string::<i64>().iter().collect::<StringArray>()),
        DataType::Utf8View => Arc::new(array.as_string_view().iter().collect::<StringArray>()),
        DataType::Float32 => {
            let numbers = array.as_primitive::<Float32Type>().iter();
            Arc::new(numbers.map(|number| number.map(f64::from)).collect::<Float64Array>())
        }
        DataType::Decimal128(..) => {
            numbers(array).map_or(array.clone(), |numbers| Arc::new(Float64Array::from(numbers)))
        }
        _ => whole_numbers(array).map_or(array.clone(), |numbers| Arc::new(Int64Array::from(numbers))),
    }
}

/// The numbers of a column, none of which is refused.
fn within(
    columns: &Columns,
    column: &Column,
    refusal: impl Fn(f64) -> Option<String>,
) -> Result<Vec<f64>, TableError> {
    let values = columns.numbers(column)?;
    match values.iter().enumerate().find_map(|(row, &value)| Some((row, refusal(value)?))) {
        Some((row, expected)) => {
            Err(columns.value_error(row, column, &format!("{}; expected {expected}", values[row])))
        }
        None => Ok(values),
    }
}
