use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use polars::prelude::DataType;

use crate::fragility::demand::Form;
use crate::keyword::Keyword;
use crate::report::data::{Column, Table};
use crate::table::schema;
use crate::table::store::frame::{frame_of, names, stacked};
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
pub fn read(files: &[(&'static str, PathBuf)]) -> anyhow::Result<Vec<Table>> {
    let of = |shown: &Shown| {
        let (_, path) = files.iter().find(|(role, _)| *role == shown.role)?;
        Some(table(shown, path))
    };
    SHOWN.iter().filter_map(of).collect()
}

fn table(shown: &Shown, path: &Path) -> anyhow::Result<Table> {
    let batches = read_any(path)?;
    let mut frame = stacked(batches.iter().map(frame_of).collect::<Result<Vec<_>, _>>()?)?;
    if !shown.models.is_empty() && frame.height() > 0 {
        let models = frame.column(schema::model.name)?.str()?;
        let is_shown = |model: Option<&str>| {
            model.is_some_and(|model| shown.models.iter().any(|wanted| wanted.as_str() == model))
        };
        frame = frame.filter(&models.iter().map(is_shown).collect())?;
    }
    if !shown.columns.is_empty() {
        let there = |name: &&str| frame.column(name).is_ok();
        frame = frame.select(names(shown.columns).filter(there).collect::<Vec<_>>())?;
    }
    let first = frame.head(Some(MOST_ROWS));
    let cells: Vec<Vec<String>> =
        first.columns().iter().map(|column| text::cells(column).collect()).collect();
    let fields = batches.first().map(RecordBatch::schema);
    let column = |column: &polars::prelude::Column| {
        let field = fields.as_ref().and_then(|schema| schema.field_with_name(column.name()).ok());
        let description =
            field.and_then(|field| field.metadata().get("description").cloned()).unwrap_or_default();
        Column { name: column.name().to_string(), description, numeric: column.dtype() != &DataType::String }
    };
    Ok(Table {
        title: shown.title.to_string(),
        columns: first.columns().iter().map(column).collect(),
        rows: (0..first.height())
            .map(|row| cells.iter().map(|column| column[row].clone()).collect())
            .collect(),
        left_out: frame.height() - first.height(),
    })
}
