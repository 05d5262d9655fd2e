//! The universal surface for many structures and motions at once, as NumPy arrays.

use std::collections::{BTreeMap, HashMap};

use numpy::{IntoPyArray, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use rockfrag::fragility::universal::Scenarios;
use rockfrag::fragility::{Peak, PeaksDoubt, Probability, doubt_of_peaks};
use rockfrag::motion::IntensityMeasures;
use rockfrag::pipeline::UsageError;
use rockfrag::pipeline::options::check_bound;
use rockfrag::stages::shared::answers::Answers;
use rockfrag::stages::shared::structures::{Restitution, StructureSpec};
use rockfrag::stages::shared::surface::{NEEDS_VELOCITY, Surface};
use rockfrag::units::G_M_S2;

use crate::error::{in_python, to_python};

const NAMES: [&str; 15] = [
    "p_nr",
    "p_ex",
    "p_ex_low",
    "p_ex_high",
    "p_ro",
    "p_ro_low",
    "p_ro_high",
    "p_o",
    "p_o_low",
    "p_o_high",
    "p_f",
    "p_f_low",
    "p_f_high",
    "distance",
    "eta",
];

/// What is said of one question.
struct Row {
    numbers: [f64; NAMES.len()],
    is_outside: bool,
    doubt: Option<PeaksDoubt>,
    doubtful_size: bool,
    /// Whether it rocks and has no probability.
    lacks_measure: bool,
}

/// The probabilities by name, and how many questions have which doubt. `structure` has p and alpha, or width and height, and eta if
/// it is given; all arrays are as long, those of `shape` in the order of C.
#[pyfunction]
pub fn probability<'py>(
    py: Python<'py>,
    structure: HashMap<String, PyReadonlyArray1<f64>>,
    pga_g: PyReadonlyArray1<f64>,
    pgv_m_s: PyReadonlyArray1<f64>,
    shape: Vec<usize>,
    suite: Option<&str>,
    limit_state: Option<f64>,
) -> PyResult<(Bound<'py, PyDict>, Vec<String>)> {
    let columns = structure.iter().map(|(name, values)| Ok((name.as_str(), values.as_slice()?)));
    let columns = columns.collect::<PyResult<BTreeMap<&str, &[f64]>>>()?;
    let (pga_g, pgv_m_s) = (pga_g.as_slice()?, pgv_m_s.as_slice()?);
    let surface = Surface::new(suite, limit_state, Scenarios::One).map_err(|error| to_python(py, &error))?;
    let answer = |k: usize| {
        let row = spec(&columns, k).and_then(|spec| row(&surface, &spec, pga_g[k], pgv_m_s[k]));
        row.map_err(|error| place(&shape, k).into_iter().fold(error, anyhow::Error::context))
    };
    // The first that is wrong is told, whichever thread is done first.
    let rows: Vec<_> = py.detach(|| (0..pga_g.len()).into_par_iter().map(answer).collect());
    let rows: anyhow::Result<Vec<Row>> = rows.into_iter().collect();
    let rows = rows.map_err(|error| to_python(py, &error))?;
    let result = PyDict::new(py);
    for (at, name) in NAMES.iter().enumerate() {
        let column: Vec<f64> = rows.iter().map(|row| row.numbers[at]).collect();
        result.set_item(name, column.into_pyarray(py))?;
    }
    let warning = |is: &dyn Fn(&Row) -> bool, words: &str| {
        let first = rows.iter().position(is)?;
        let count = rows.iter().filter(|row| is(row)).count();
        let of = |place| format!("{count} of {}, the first {place}: ", rows.len());
        Some(place(&shape, first).map_or(String::new(), of) + words)
    };
    let missing = in_python(NEEDS_VELOCITY);
    let doubts = PeaksDoubt::ALL.map(|doubt| warning(&|row| row.doubt == Some(doubt), doubt.words()));
    let others = [
        warning(&|row| row.lacks_measure, &missing),
        warning(
            &|row| row.is_outside,
            "a structure or a measure outside of those of the surface: extrapolated",
        ),
        warning(&|row| row.doubtful_size, "a p of a solid block of 90 m and more: are dimensions in cm?"),
    ];
    Ok((result, doubts.into_iter().chain(others).flatten().collect()))
}

/// Where a question stands in arrays of this shape; a number stands nowhere.
fn place(shape: &[usize], k: usize) -> Option<String> {
    let mut left = k;
    let index = shape.iter().rev().map(|&length| {
        let at = left % length;
        left /= length;
        at.to_string()
    });
    let mut index: Vec<String> = index.collect();
    index.reverse();
    match &index[..] {
        [] => None,
        [at] => Some(format!("element {at}")),
        several => Some(format!("element ({})", several.join(", "))),
    }
}

fn spec(columns: &BTreeMap<&str, &[f64]>, row: usize) -> anyhow::Result<StructureSpec> {
    let mut spec = StructureSpec::default();
    for (name, values) in columns {
        let value = Some(values[row]);
        match *name {
            "p" => spec.p = value,
            "alpha" => spec.alpha = value,
            "width" => spec.width = value,
            "height" => spec.height = value,
            "eta" => spec.eta = value.map(Restitution::Given),
            other => return Err(UsageError(format!("{other}: not a parameter of a structure")).into()),
        }
    }
    Ok(spec)
}

fn row(surface: &Surface, spec: &StructureSpec, pga_g: f64, pgv_m_s: f64) -> anyhow::Result<Row> {
    check_bound(&Peak::Pga.bound(), pga_g)?;
    check_bound(&Peak::Pgv.bound(), pgv_m_s)?;
    let structure = spec.structure()?;
    let measures = IntensityMeasures::new(&structure, pga_g * G_M_S2, pgv_m_s, None, None);
    let said = surface.model().of_structure(&structure, &measures);
    let none = Probability::exact(f64::NAN);
    let given = said.given_rocking;
    let [p_ex, p_ro] =
        [given.map(|given| given.p_ex), given.map(|given| given.p_ro)].map(|p| p.unwrap_or(none));
    let [_, p_f, p_o] = said.limit_states().unwrap_or([none; 3]);
    let distance = surface.model().distance(&structure, &measures).map_or(f64::NAN, |(distance, _)| distance);
    let three = |Probability { value, low, high }: Probability| [value, low, high];
    let ([ex, ex_low, ex_high], [ro, ro_low, ro_high]) = (three(p_ex), three(p_ro));
    let ([o, o_low, o_high], [f, f_low, f_high]) = (three(p_o), three(p_f));
    Ok(Row {
        numbers: [
            said.p_nr,
            ex,
            ex_low,
            ex_high,
            ro,
            ro_low,
            ro_high,
            o,
            o_low,
            o_high,
            f,
            f_low,
            f_high,
            distance,
            structure.eta,
        ],
        is_outside: !surface.model().outside(&measures).is_empty() || surface.is_other_structure(&structure),
        doubt: doubt_of_peaks(pga_g * G_M_S2, pgv_m_s),
        doubtful_size: structure.doubt().is_some(),
        lacks_measure: said.limit_states().is_none(),
    })
}
