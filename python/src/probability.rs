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
use rockfrag::stages::shared::surface::Surface;
use rockfrag::units::G_M_S2;

use crate::error::to_python;

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
}

/// The probabilities by name, and how many questions have which doubt. `structure` has p and alpha, or width and height, and eta if
/// it is given; all arrays are as long.
#[pyfunction]
pub fn probability<'py>(
    py: Python<'py>,
    structure: HashMap<String, PyReadonlyArray1<f64>>,
    pga_g: PyReadonlyArray1<f64>,
    pgv_m_s: PyReadonlyArray1<f64>,
    suite: Option<&str>,
    limit_state: Option<f64>,
) -> PyResult<(Bound<'py, PyDict>, Vec<String>)> {
    let columns = structure.iter().map(|(name, values)| Ok((name.as_str(), values.as_slice()?)));
    let columns = columns.collect::<PyResult<BTreeMap<&str, &[f64]>>>()?;
    let (pga_g, pgv_m_s) = (pga_g.as_slice()?, pgv_m_s.as_slice()?);
    let solve = || -> anyhow::Result<Vec<Row>> {
        let surface = Surface::new(suite, limit_state, Scenarios::One)?;
        (0..pga_g.len())
            .into_par_iter()
            .map(|k| row(&surface, &spec(&columns, k)?, pga_g[k], pgv_m_s[k]))
            .collect()
    };
    let rows = py.detach(solve).map_err(|error| to_python(py, &error))?;
    let result = PyDict::new(py);
    for (at, name) in NAMES.iter().enumerate() {
        let column: Vec<f64> = rows.iter().map(|row| row.numbers[at]).collect();
        result.set_item(name, column.into_pyarray(py))?;
    }
    let count = |is: &dyn Fn(&Row) -> bool| rows.iter().filter(|row| is(row)).count();
    let doubts = PeaksDoubt::ALL.map(|doubt| (count(&|row| row.doubt == Some(doubt)), doubt.words()));
    let others = [
        (
            count(&|row| row.is_outside),
            "a structure or a measure outside of those of the surface: extrapolated",
        ),
        (count(&|row| row.doubtful_size), "a p of a solid block of 90 m and more: are dimensions in cm?"),
    ];
    let warnings = doubts.into_iter().chain(others).filter(|(rows, _)| *rows > 0);
    let warnings: Vec<String> =
        warnings.map(|(rows, words)| format!("{rows} of {}: {words}", pga_g.len())).collect();
    Ok((result, warnings))
}

fn spec(columns: &BTreeMap<&str, &[f64]>, row: usize) -> anyhow::Result<StructureSpec> {
    let mut spec = StructureSpec { name: Some(format!("row {row}")), ..StructureSpec::default() };
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
    })
}
