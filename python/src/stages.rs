//! The stages, as the command line runs them: tables and paths in, a table (or the path that was written) out.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use rockfrag::keyword::{self, Keyword};
use rockfrag::pipeline::console::Console;
use rockfrag::pipeline::options::{Parsed, Word};
use rockfrag::pipeline::stage::Stage;
use rockfrag::pipeline::{UsageError, cache};
use rockfrag::stages::evaluate::EvaluateTable;
use rockfrag::stages::fit_pex::FitPex;
use rockfrag::stages::fit_pro::FitPro;
use rockfrag::stages::fits::FitsOptions;
use rockfrag::stages::import_motions::ImportMotions;
use rockfrag::stages::partitions::{each_file, file_of};
use rockfrag::stages::sample_scenarios::SampleScenarios;
use rockfrag::stages::simulate::{Simulate, SimulateOptions};
use rockfrag::stages::structure_options::StructureOptions;
use rockfrag::stages::structures::StructureSpec;
use rockfrag::stages::synthesize_motions::{SynthesizeMotions, SynthesizeMotionsOptions};
use rockfrag::table::partition::Partition;
use rockfrag::table::provenance::Provenance;
use rockfrag::table::source::{Shelf, Source, Target};
use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::error::to_python;
use crate::run::{Manner, run};
use crate::table::{PyTable, source};

/// The place on a shelf of what a stage is for.
const MAIN: &str = "";
/// The places of what a stage may leave besides.
const PARTS: [&str; 3] = ["scan", "bootstrap", "trace"];

/// sample-scenarios.
#[pyfunction]
pub fn sample_scenarios(
    py: Python,
    options: &str,
    out: Option<PathBuf>,
    manner: Manner,
) -> PyResult<Py<PyAny>> {
    one(py, out, &manner, |target| SampleScenarios::new(&read(options)?, target))
}

/// synthesize-motions.
#[pyfunction]
pub fn synthesize_motions(
    py: Python,
    scenarios: &Bound<PyAny>,
    options: &str,
    out: Option<PathBuf>,
    manner: Manner,
) -> PyResult<Py<PyAny>> {
    let scenarios = source("scenarios", scenarios)?;
    let partition = partition_of::<SynthesizeMotionsOptions>(options, |options| options.partition);
    let out = out.map(|out| file_of(Some(&out), Path::new(""), "motions", partition));
    one(py, out, &manner, |target| SynthesizeMotions::new(&read(options)?, scenarios, target))
}

/// import-motions.
#[pyfunction]
pub fn import_motions(
    py: Python,
    options: &str,
    out: Option<PathBuf>,
    manner: Manner,
) -> PyResult<Py<PyAny>> {
    one(py, out, &manner, |target| ImportMotions::new(&read(options)?, target))
}

/// simulate.
#[pyfunction]
pub fn simulate(
    py: Python,
    motions: &Bound<PyAny>,
    options: &str,
    out: Option<PathBuf>,
    manner: Manner,
) -> PyResult<Py<PyAny>> {
    let motions = source("motions", motions)?;
    if let (Source::Path(folder), Some(out)) = (&motions, &out) {
        let each = |console: &Console| {
            let stages = each_file(&read_simulate(options)?, folder, Some(out))?;
            let Some(stages) = stages else { return Ok(false) };
            stages.iter().try_for_each(|stage| cache::run_alone(stage, manner.force, console)).map(|()| true)
        };
        if folder.is_dir() && run(py, &manner, each)? {
            return Ok(out.into_pyobject(py)?.unbind());
        }
    }
    let partition = partition_of::<SimulateOptions>(options, |options| options.partition);
    let out = out.map(|out| file_of(Some(&out), Path::new(""), "responses", partition));
    one(py, out, &manner, |target| Simulate::new(&read_simulate(options)?, motions, target))
}

/// fit-pex.
#[pyfunction]
pub fn fit_pex(
    py: Python,
    responses: &Bound<PyAny>,
    options: &str,
    out: Option<PathBuf>,
    manner: Manner,
) -> PyResult<Py<PyAny>> {
    let responses = source("responses", responses)?;
    one(py, out, &manner, |target| FitPex::new(&read(options)?, responses, target))
}

/// fit-pro.
#[pyfunction]
pub fn fit_pro(
    py: Python,
    responses: &Bound<PyAny>,
    options: &str,
    out: Option<PathBuf>,
    manner: Manner,
) -> PyResult<Py<PyAny>> {
    let responses = source("responses", responses)?;
    one(py, out, &manner, |target| FitPro::new(&read(options)?, responses, target))
}

/// evaluate, at each intensity of a table.
#[pyfunction]
pub fn evaluate(
    py: Python,
    intensities: &Bound<PyAny>,
    pex: &Bound<PyAny>,
    pro: &Bound<PyAny>,
    options: &str,
    out: Option<PathBuf>,
    manner: Manner,
) -> PyResult<Py<PyAny>> {
    let (intensities, pex, pro) =
        (source("intensities", intensities)?, source("pex", pex)?, source("pro", pro)?);
    one(py, out, &manner, |target| {
        let Evaluation { suite, structure, model, measure, limits, p, alpha, eta } = read(options)?;
        let fits = FitsOptions {
            pex,
            pro,
            suite,
            structure,
            model: word(&model)?,
            measure: measure.as_deref().map(word).transpose()?,
        };
        let structure = StructureOptions { p, alpha, eta, ..StructureOptions::default() };
        EvaluateTable::new(&fits, word(&limits)?.0, &structure, intensities, target)
    })
}

/// The options of evaluate.
#[derive(Deserialize)]
struct Evaluation {
    suite: Option<String>,
    structure: Option<String>,
    model: String,
    measure: Option<String>,
    limits: String,
    p: Option<f64>,
    alpha: Option<f64>,
    eta: Option<f64>,
}

/// Makes a stage and runs it: into a file, unless that is up to date, or into memory.
fn one<S: Stage>(
    py: Python,
    out: Option<PathBuf>,
    manner: &Manner,
    stage: impl FnOnce(Target) -> anyhow::Result<S> + Send,
) -> PyResult<Py<PyAny>> {
    if let Some(out) = out {
        run(py, manner, |console| cache::run_alone(&stage((&out).into())?, manner.force, console))?;
        return Ok(out.into_pyobject(py)?.unbind());
    }
    let shelf = Shelf::default();
    run(py, manner, |console| {
        let stage = stage(shelf.place(MAIN))?;
        // What stays in memory has no file to say how it was made.
        let provenance = Provenance::new(stage.subcommand(), stage.parameters(), BTreeMap::new());
        stage.execute(&provenance, console)
    })?;
    let table = PyTable::take(py, &shelf, MAIN, &PARTS)?;
    Ok(table.into_pyobject(py)?.unbind())
}

/// What the file of a partition is called.
#[pyfunction]
pub fn partition_file(py: Python, partition: &str) -> PyResult<String> {
    let partition: Result<Partition, String> = partition.parse();
    let partition = partition.map_err(|wrong| to_python(py, &UsageError::because(wrong)))?;
    Ok(partition.file_name())
}

/// Options of simulate; what is wrong with a structure is said of that one.
fn read_simulate(options: &str) -> anyhow::Result<SimulateOptions> {
    let options: serde_json::Value = read(options)?;
    let said = |error: serde_json::Error| UsageError::because(error.to_string());
    if let Some(structures) = options.get("structures").filter(|structures| structures.is_array()) {
        Vec::<StructureSpec>::deserialize(structures).map_err(said)?;
    }
    serde_json::from_value(options).map_err(said)
}

/// Options as Python wrote them.
fn read<T: DeserializeOwned>(options: &str) -> anyhow::Result<T> {
    serde_json::from_str(options).map_err(|error| UsageError::because(error.to_string()))
}

fn word<T: Keyword>(word: &str) -> anyhow::Result<Word<T>> {
    keyword::parse(word).map(Word).map_err(|unknown| UsageError::because(unknown.to_string()))
}

/// The partition that options ask for; whoever reads them again says what is wrong with them.
fn partition_of<T: DeserializeOwned>(
    options: &str,
    partition: impl Fn(&T) -> Option<Parsed<Partition>>,
) -> Option<Partition> {
    serde_json::from_str(options)
        .ok()
        .and_then(|options| partition(&options))
        .map(|Parsed(partition)| partition)
}
