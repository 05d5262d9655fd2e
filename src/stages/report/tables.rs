use std::path::{Path, PathBuf};

use arrow_array::cast::AsArray;
use arrow_array::{Array, RecordBatch};
use arrow_schema::DataType;

use crate::fragility::demand::Form;
use crate::keyword::Keyword;
use crate::report::data::{Column, Table};
use crate::table::TableError;
use crate::table::schema;
use crate::table::store::reader::read_any;
use crate::table::store::text;

/// The most rows of a table in the page.
const MOST_ROWS: usize = 300;

/// A table of the page: out of the file of which role, which rows and columns of it.
struct Shown {
    role: &'static str,
    title: &'static str,
    /// Words that must stand in the column of the model; all rows where there are none.
    models: &'static [Form],
    /// All columns where there are none.
    columns: &'static [schema::Column],
}

const SHOWN: [Shown; 7] = [
    Shown {
        role: "pex",
        title: "Regressions of the demand on one measure (Table I)",
        models: &[Form::Univariate],
        columns: &[
            schema::suite,
            schema::structure,
            schema::im_x,
            schema::ln_a,
            schema::b1,
            schema::r2,
            schema::beta,
            schema::zeta,
            schema::se_b1,
            schema::n,
            schema::status,
        ],
    },
    Shown {
        role: "pex",
        title: "Regressions of the demand on two measures (Table II)",
        models: &[Form::Plane, Form::Biplanar, Form::Smooth],
        columns: &[
            schema::suite,
            schema::structure,
            schema::model,
            schema::range_low,
            schema::range_high,
            schema::ln_a,
            schema::b1,
            schema::b2,
            schema::r2,
            schema::r2_pooled,
            schema::beta,
            schema::n,
            schema::status,
        ],
    },
    Shown {
        role: "pro",
        title: "Curves of overturning",
        models: &[],
        columns: &[
            schema::suite,
            schema::structure,
            schema::fitted_event,
            schema::im_x,
            schema::im_y,
            schema::lambda,
            schema::theta,
            schema::theta_low,
            schema::theta_high,
            schema::beta,
            schema::aic,
            schema::auc,
            schema::brier,
            schema::n,
            schema::n_events,
            schema::status,
        ],
    },
    Shown { role: "paper", title: "Published numbers beside ours", models: &[], columns: &[] },
    Shown { role: "ranking", title: "Ranking of the measures", models: &[], columns: &[] },
    Shown {
        role: "universality",
        title: "Universality: fits of one structure for another",
        models: &[],
        columns: &[],
    },
    Shown { role: "validation", title: "Counts seen, and expected by the fits", models: &[], columns: &[] },
];

/// The tables of those files that are there.
pub fn read(files: &[(&'static str, PathBuf)]) -> Result<Vec<Table>, TableError> {
    let of = |shown: &Shown| {
        let (_, path) = files.iter().find(|(role, _)| *role == shown.role)?;
        Some(table(shown, path))
    };
    SHOWN.iter().filter_map(of).collect()
}

fn table(shown: &Shown, path: &Path) -> Result<Table, TableError> {
    let batches = read_any(path)?;
    let mut table =
        Table { title: shown.title.to_string(), columns: Vec::new(), rows: Vec::new(), left_out: 0 };
    for batch in &batches {
        let of_schema = batch.schema();
        let indices: Vec<usize> = match shown.columns.is_empty() {
            true => (0..batch.num_columns()).collect(),
            false => shown.columns.iter().filter_map(|column| of_schema.index_of(column.name).ok()).collect(),
        };
        if table.columns.is_empty() {
            table.columns = indices.iter().map(|&index| column(of_schema.field(index))).collect();
        }
        let cells: Vec<Vec<String>> =
            indices.iter().map(|&index| text::cells(batch.column(index)).collect()).collect();
        for row in (0..batch.num_rows()).filter(|&row| is_of(batch, row, shown.models)) {
            if table.rows.len() < MOST_ROWS {
                table.rows.push(cells.iter().map(|column| column[row].clone()).collect());
            } else {
                table.left_out += 1;
            }
        }
    }
    Ok(table)
}

fn column(field: &arrow_schema::Field) -> Column {
    let description = field.metadata().get("description").cloned().unwrap_or_default();
    Column { name: field.name().clone(), description, numeric: field.data_type() != &DataType::Utf8 }
}

fn is_of(batch: &RecordBatch, row: usize, models: &[Form]) -> bool {
    let model = batch.column_by_name(schema::model.name).and_then(|column| column.as_string_opt::<i32>());
    let is = |model: &arrow_array::StringArray| {
        !model.is_null(row) && models.iter().any(|wanted| wanted.as_str() == model.value(row))
    };
    models.is_empty() || model.is_some_and(is)
}
