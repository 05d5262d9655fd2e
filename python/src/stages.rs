//! Any stage by the parser of the command line: options as JSON in, the paths of what was written out.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args as _, Command, FromArgMatches};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use rockfrag::cli::calls;
use rockfrag::inputs::Reading;
use rockfrag::pipeline::call::{Call, Planned};
use rockfrag::pipeline::context::Common;
use rockfrag::pipeline::options::Given;
use rockfrag::stages::inspect::Inspect;
use serde_json::{Value, json};

use crate::error::{in_python, to_python};
use crate::objects::fields;
use crate::run::run;

/// A stage that is done: its name, the files that it wrote, what it prints, its warnings.
type Made = (String, Vec<PathBuf>, String, Vec<String>);

/// All stages, and the fields of an object, as JSON in the words of Python.
#[pyfunction]
pub fn describe() -> String {
    let mut stages = rockfrag::cli::describe();
    for stage in stages.as_array_mut().into_iter().flatten() {
        translate(&mut stage["help"]);
        for option in stage["options"].as_array_mut().into_iter().flatten() {
            translate(&mut option["help"]);
            option["name"] = option["name"].as_str().unwrap_or_default().replace('-', "_").into();
        }
    }
    json!({ "stages": stages, "fields": fields() }).to_string()
}

fn translate(help: &mut Value) {
    *help = in_python(help.as_str().unwrap_or_default()).into();
}

/// Runs a stage, unless its files are up to date. Options are a JSON object by the flags of the command.
#[pyfunction]
pub fn call(
    py: Python,
    stage: &str,
    options: &str,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Made> {
    let kind = rockfrag::stages::all().into_iter().find(|kind| kind.name() == stage);
    let kind = kind.ok_or_else(|| PyTypeError::new_err(format!("no stage {stage}")))?;
    let options: Given =
        serde_json::from_str(options).map_err(|error| PyTypeError::new_err(error.to_string()))?;
    run(py, threads, progress.as_ref(), move |mut common| {
        let call = calls::of_stage(&kind, options)?;
        common.force = call.common.force;
        make(&call, &common, &mut Planned::new())
    })
}

/// Runs a call unless its files are up to date. `made` gathers the keys of the files of a run.
fn make(call: &Call, common: &Common, made: &mut Planned) -> anyhow::Result<Made> {
    let made = call.run(common, made)?.made;
    let warnings = made.readings.iter().filter_map(Reading::gaps).chain(made.warnings.lines());
    Ok((call.name.clone(), call.stage.files().written, made.summary, warnings.collect()))
}

/// Runs all stages of a pipeline file that are not up to date.
#[pyfunction]
pub fn run_pipeline(
    py: Python,
    pipeline: PathBuf,
    out: Option<PathBuf>,
    seed: Option<u64>,
    force: bool,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Vec<Made>> {
    run(py, threads, progress.as_ref(), move |mut common| {
        let calls = calls::of_run(&pipeline, out, seed)?;
        (common.force, common.is_run) = (force, true);
        let mut made = Planned::new();
        calls.iter().map(|call| make(call, &common, &mut made)).collect()
    })
}

/// What `rockfrag inspect` prints of a file as JSON.
#[pyfunction]
pub fn inspect(path: PathBuf) -> PyResult<String> {
    let words = ["inspect".into(), "--format=json".into(), path.into_os_string()];
    let inspect = Inspect::augment_args(Command::new("inspect")).try_get_matches_from::<_, OsString>(words);
    let inspect =
        inspect.and_then(|matches| Inspect::from_arg_matches(&matches)).map_err(anyhow::Error::from);
    inspect.and_then(|inspect| inspect.run()).map_err(|error| to_python(&error))
}

/// Runs the command line in this process, and gives the code to exit with.
#[pyfunction]
pub fn command(py: Python, arguments: Vec<OsString>) -> u8 {
    py.detach(|| rockfrag::cli::main(arguments))
}
