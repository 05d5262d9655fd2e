//! Any stage by the parser of the command line: options as JSON in, the paths of what was written out.

use std::collections::{BTreeMap, HashMap};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{Arg, ArgAction, Args as _, Command, FromArgMatches};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use rockfrag::cli::config::arguments;
use rockfrag::cli::{calls_of, configured, stage_commands};
use rockfrag::pipeline::cache::{self, Done};
use rockfrag::pipeline::call::Call;
use rockfrag::pipeline::context::{COMMON, Context};
use rockfrag::pipeline::files::role;
use rockfrag::stages::inspect::Inspect;
use serde_json::{Value, json};

use crate::error::{in_python, to_python};
use crate::run::run;

/// A stage that is done: its name, the files that it wrote, what it prints, its warnings.
type Made = (String, Vec<PathBuf>, String, Vec<String>);

/// All stages as JSON: names, meanings, options with their meanings and defaults.
#[pyfunction]
pub fn describe() -> String {
    json!(stage_commands().iter().map(describe_stage).collect::<Vec<_>>()).to_string()
}

fn describe_stage(command: &Command) -> Value {
    let words = |text: Option<&clap::builder::StyledStr>| text.map(|text| in_python(&text.to_string()));
    let option = |arg: &Arg| {
        let id = arg.get_id().as_str();
        let default = arg.get_default_values().iter().map(|value| value.to_string_lossy());
        json!({
            "name": arg.get_long().unwrap_or(id).replace('-', "_"),
            "help": words(arg.get_help()),
            "default": default.collect::<Vec<_>>().join(","),
            "flag": matches!(arg.get_action(), ArgAction::SetTrue),
            "file": role(arg).is_read(),
            "positional": arg.is_positional(),
            "common": arg.get_help_heading() == Some(COMMON),
        })
    };
    let options =
        command.get_arguments().filter(|arg| !["help", "progress", "quiet"].contains(&arg.get_id().as_str()));
    let options: Vec<Value> = options.map(option).collect();
    json!({ "name": command.get_name(), "help": words(command.get_about()), "options": options })
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
    let commands = stage_commands();
    let command = commands.iter().find(|command| command.get_name() == stage);
    let command = command.ok_or_else(|| PyTypeError::new_err(format!("no stage {stage}")))?;
    let options: BTreeMap<String, Value> =
        serde_json::from_str(options).map_err(|error| PyTypeError::new_err(error.to_string()))?;
    let words = arguments(command, options, Path::new(""))
        .map_err(|error| PyTypeError::new_err(in_python(&error.to_string())))?;
    run(py, threads, progress.as_ref(), move |mut context| {
        let call = configured(command, &words)?;
        context.force = call.common.force;
        make(&call, &context, &mut HashMap::new())
    })
}

/// Runs a call unless its files are up to date. `made` gathers the keys of the files of a run.
fn make(call: &Call, context: &Context, made: &mut HashMap<PathBuf, String>) -> anyhow::Result<Made> {
    let Done { summary, warnings, key, .. } = cache::run(call, context, made)?;
    let outputs = call.stage.outputs();
    made.extend(outputs.iter().map(|path| (path.clone(), key.clone())));
    Ok((call.name.clone(), outputs, summary, warnings.lines()))
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
    run(py, threads, progress.as_ref(), |mut context| {
        let calls = calls_of(&pipeline, out, seed)?;
        context.force = force;
        let mut made = HashMap::new();
        calls.iter().map(|call| make(call, &context, &mut made)).collect()
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
