use std::path::{Path, PathBuf};

use polars::prelude::{AnyValue, DataFrame};

use crate::fragility::demand::Form;
use crate::keyword::Keyword;
use crate::report::data::{Column, Table, scaled_words};
use crate::report::number;
use crate::table::schema;
use crate::table::store::frame::{frame_of, stacked};
use crate::table::store::reader::read_any;
use crate::table::store::text;

/// The most rows of a table in the page.
const MOST_ROWS: usize = 300;
/// Significant digits of numbers.
const DIGITS: i32 = 3;
/// The least probability that is written in full.
const LEAST_P: f64 = 1e-3;

/// A table of the page: out of the file of which role, which rows and columns of it.
struct Shown {
    role: &'static str,
    /// Name of its file.
    name: &'static str,
    title: &'static str,
    rows: Rows,
    columns: &'static [Head],
}

/// Which rows.
enum Rows {
    All,
    /// Of these models.
    Models(&'static [Form]),
    /// That have a value here.
    With(schema::Column),
}

/// A column under a head that reads well.
struct Head {
    words: &'static str,
    of: Cell,
}

/// What stands in a column.
enum Cell {
    Value(schema::Column),
    /// A value, with its limits in brackets.
    Limits([schema::Column; 3]),
    /// The probability of a test.
    Chance(schema::Column),
    /// A measure that is scaled, with its unit.
    Scaled(schema::Column),
}

const fn value(words: &'static str, column: schema::Column) -> Head {
    Head { words, of: Cell::Value(column) }
}

const fn limits(words: &'static str, columns: [schema::Column; 3]) -> Head {
    Head { words, of: Cell::Limits(columns) }
}

const fn chance(words: &'static str, column: schema::Column) -> Head {
    Head { words, of: Cell::Chance(column) }
}

const fn scaled(words: &'static str, column: schema::Column) -> Head {
    Head { words, of: Cell::Scaled(column) }
}

const SUITE: Head = value("motions", schema::suite);
const STRUCTURE: Head = value("structure", schema::structure);
const STATUS: Head = value("status", schema::status);
const CASES: Head = value("cases", schema::n);

const SHOWN: [Shown; 8] = [
    Shown {
        role: "pro",
        name: "curves",
        title: "Curves of overturning",
        rows: Rows::All,
        columns: &[
            SUITE,
            STRUCTURE,
            value("event", schema::fitted_event),
            value("over", schema::im_x),
            value("and", schema::im_y),
            value("λ", schema::lambda),
            limits("median θ", [schema::theta, schema::theta_low, schema::theta_high]),
            value("β", schema::beta),
            value("AUC", schema::auc),
            CASES,
            value("events", schema::n_events),
            value("off at one case of 20: line", schema::gap_straight),
            value("bent curve", schema::gap_bent),
            STATUS,
        ],
    },
    Shown {
        role: "pex",
        name: "planes",
        title: "Regressions of the demand on two measures (Table II of the paper)",
        rows: Rows::Models(&[Form::Plane, Form::Biplanar, Form::Smooth]),
        columns: &[
            SUITE,
            STRUCTURE,
            value("model", schema::model),
            value("from IM4", schema::range_low),
            value("to", schema::range_high),
            value("ln a", schema::ln_a),
            value("slope on IM4", schema::b1),
            value("on IM3", schema::b2),
            value("R²", schema::r2),
            value("R² of both", schema::r2_pooled),
            value("β", schema::beta),
            CASES,
            STATUS,
        ],
    },
    Shown {
        role: "pex",
        name: "regressions",
        title: "Regressions of the demand on one measure (Table I of the paper)",
        rows: Rows::Models(&[Form::Univariate]),
        columns: &[
            SUITE,
            STRUCTURE,
            value("on", schema::im_x),
            value("ln a", schema::ln_a),
            limits("slope b", [schema::b1, schema::b1_low, schema::b1_high]),
            value("R²", schema::r2),
            value("β", schema::beta),
            value("ζ", schema::zeta),
            CASES,
            STATUS,
        ],
    },
    Shown {
        role: "ida fragility",
        name: "ida",
        title: "Incremental dynamic analysis: lowest overturning intensities",
        rows: Rows::All,
        columns: &[
            SUITE,
            STRUCTURE,
            scaled("scaled", schema::measure),
            value("number", schema::n),
            value("never overturn", schema::n_safe),
            value("with safe windows", schema::n_with_windows),
            limits("median θ", [schema::theta, schema::theta_low, schema::theta_high]),
            limits("β", [schema::beta, schema::beta_low, schema::beta_high]),
            STATUS,
        ],
    },
    Shown {
        role: "validation",
        name: "validation",
        title: "Counts seen, and expected by the fits",
        rows: Rows::All,
        columns: &[
            SUITE,
            STRUCTURE,
            value("fits of", schema::fits_suite),
            value("event", schema::predicted),
            value("cases", schema::n_predicted),
            value("seen", schema::seen),
            limits("expected", [schema::expected, schema::expected_low, schema::expected_high]),
            value("by chance from", schema::chance_low),
            value("to", schema::chance_high),
            chance("p of chance", schema::chance_p),
            value("log score", schema::log_score),
            value("extrapolated", schema::extrapolated),
        ],
    },
    Shown {
        role: "ranking",
        name: "ranking",
        title: "Measures that stand out",
        rows: Rows::With(schema::choice),
        columns: &[
            SUITE,
            STRUCTURE,
            value("of", schema::target),
            value("measures", schema::measures),
            value("form", schema::form),
            value("why", schema::choice),
            value("rank", schema::rank),
            value("log score", schema::rank_log_score),
            value("gain over the paper's", schema::over_paper),
            value("its standard error", schema::se_over_paper),
        ],
    },
    Shown {
        role: "universality",
        name: "universality",
        title: "Fits of one structure for another",
        rows: Rows::All,
        columns: &[
            SUITE,
            STRUCTURE,
            value("event", schema::predicted),
            value("cases", schema::n_predicted),
            value("seen", schema::seen),
            value("expected", schema::expected),
            value("worst too high", schema::worst_over),
            value("too low", schema::worst_under),
            value("share lost", schema::share_lost),
            value("verdict", schema::verdict),
        ],
    },
    Shown {
        role: "paper",
        name: "paper",
        title: "Numbers of Dimitrakopoulos & Paraskeva (2015) beside ours",
        rows: Rows::All,
        columns: &[
            value("quantity", schema::quantity),
            SUITE,
            STRUCTURE,
            value("published", schema::published),
            value("ours", schema::ours),
            value("mean over seeds", schema::spread_mean),
            value("deviation", schema::spread_sd),
            value("z", schema::z),
            chance("p of T²", schema::t2_p),
            value("place", schema::place),
        ],
    },
];

/// The tables of those files that are there.
pub fn read(files: &[(&'static str, PathBuf)]) -> anyhow::Result<Vec<Table>> {
    let of = |shown: &Shown| {
        let (_, path) = files.iter().find(|(role, _)| *role == shown.role)?;
        Some(table(shown, path))
    };
    SHOWN.iter().filter_map(of).collect()
}

impl Head {
    fn columns(&self) -> &[schema::Column] {
        match &self.of {
            Cell::Value(column) | Cell::Chance(column) | Cell::Scaled(column) => std::slice::from_ref(column),
            Cell::Limits(columns) => columns,
        }
    }

    fn cell(&self, frame: &DataFrame, row: usize) -> String {
        let at = |column: &schema::Column| frame.column(column.name).ok()?.get(row).ok();
        let float = |column: &schema::Column| match at(column) {
            Some(AnyValue::Float64(number)) => number,
            _ => f64::NAN,
        };
        match &self.of {
            Cell::Limits(columns) if float(&columns[0]).is_finite() => {
                number::with_limits([0, 1, 2].map(|part| float(&columns[part])), DIGITS)
            }
            Cell::Chance(column) if float(column) < LEAST_P => format!("< {LEAST_P}"),
            Cell::Scaled(column) => {
                scaled_words(at(column).as_ref().and_then(AnyValue::get_str).unwrap_or_default())
            }
            _ => words(at(&self.columns()[0])),
        }
    }
}

/// A value as it is read by people, however its file keeps texts.
fn words(value: Option<AnyValue>) -> String {
    match value.as_ref().and_then(AnyValue::get_str) {
        Some("im3_inv") => return "1/IM3".to_string(),
        Some(measure) if measure.len() == 3 && measure.starts_with("im") => return measure.to_uppercase(),
        Some(text) => return text.replace('_', " "),
        None => {}
    }
    match value {
        Some(AnyValue::Float64(value)) => number::readable(value, DIGITS),
        Some(AnyValue::Int64(count)) => count.to_string(),
        Some(AnyValue::Int32(count)) => count.to_string(),
        _ => "\u{2013}".to_string(),
    }
}

fn table(shown: &Shown, path: &Path) -> anyhow::Result<Table> {
    let batches = read_any(path, |_| true)?;
    let mut frame = stacked(batches.iter().map(frame_of).collect::<Result<Vec<_>, _>>()?)?;
    if frame.height() > 0 {
        frame = match &shown.rows {
            Rows::All => frame,
            Rows::Models(models) => {
                let is_shown = |model: Option<&str>| {
                    model.is_some_and(|model| models.iter().any(|wanted| wanted.as_str() == model))
                };
                let kept = frame.column(schema::model.name)?.str()?.iter().map(is_shown).collect();
                frame.filter(&kept)?
            }
            Rows::With(column) => {
                let kept = frame.column(column.name)?.is_not_null();
                frame.filter(&kept)?
            }
        };
    }
    let columns = shown.columns.iter().flat_map(Head::columns).map(|column| column.name);
    let there: Vec<&str> = columns.filter(|name| frame.column(name).is_ok()).collect();
    let first = frame.select(there)?.head(Some(MOST_ROWS));
    let heads: Vec<&Head> =
        shown.columns.iter().filter(|head| first.column(head.columns()[0].name).is_ok()).collect();
    let column = |head: &&Head| {
        let first = head.columns()[0];
        Column {
            name: head.words.to_string(),
            description: format!("{}: {}", first.name, first.description),
            numeric: first.kind != schema::Kind::Text,
        }
    };
    Ok(Table {
        name: shown.name.to_string(),
        title: shown.title.to_string(),
        columns: heads.iter().map(column).collect(),
        rows: (0..first.height())
            .map(|row| heads.iter().map(|head| head.cell(&first, row)).collect())
            .collect(),
        left_out: frame.height() - first.height(),
        csv: text::csv(&first)?,
    })
}
