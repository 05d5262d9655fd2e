//! The commands that are no stage: a whole run, a look into a file, the spread over seeds; and the command itself.

use std::ffi::OsString;
use std::path::PathBuf;

use pyo3::prelude::*;
use rockfrag::pipeline::UsageError;
use rockfrag::pipeline::cache::May;
use rockfrag::pipeline::terminal::Terminal;
use rockfrag::stages::registry::Config;
use rockfrag::stages::seed_spread::SeedSpreadOptions;
use rockfrag::stages::{inspect, run as pipeline, seed_spread as spread};
use rockfrag::table::store::contents;
use serde_json::json;

use crate::error::to_python;
use crate::run::{Settings, run};

/// The name of a stage, and the files that it writes.
type StageFiles = (String, Vec<PathBuf>);

/// Does what the words of a command line say, in this process, and gives the code to exit with.
#[pyfunction]
pub fn command(py: Python, arguments: Vec<OsString>) -> u8 {
    py.detach(|| rockfrag::cli::main(arguments))
}

/// Runs a pipeline file, or tells what would run: the files by stages, or that text.
#[pyfunction]
pub fn run_pipeline(
    py: Python,
    pipeline: PathBuf,
    out: Option<PathBuf>,
    seed: Option<u64>,
    dry_run: bool,
    settings: Settings,
) -> PyResult<(Vec<StageFiles>, String)> {
    run(py, &settings, |console| {
        let config = Config::read(&pipeline)?;
        let config = if let Some(seed) = seed { config.with_seed(seed) } else { config };
        let stages = config.stages(&out.or(config.out.clone()).unwrap_or_default())?;
        if stages.is_empty() {
            let message = format!("{}: no stage; expected at least one", pipeline.display());
            return Err(UsageError::because(message));
        }
        let may = May { force: settings.force, overwrite: settings.overwrite };
        let text = if dry_run { pipeline::dry_run(&stages, may)? } else { String::new() };
        if !dry_run {
            pipeline::run(&stages, may, console)?;
        }
        Ok((stages.iter().map(|stage| (stage.name().to_string(), stage.outputs())).collect(), text))
    })
}

/// What a file holds and where it came from: as JSON, and as the command prints it.
#[pyfunction]
pub fn inspect_file(py: Python, file: PathBuf) -> PyResult<(String, String)> {
    let look = || -> anyhow::Result<_> {
        let text = inspect::inspect(&file, None)?.text(&Terminal::PLAIN);
        let footer = contents::footer(&file)?;
        let made = contents::recorded(&file)?.map(|recorded| {
            let made = recorded.provenance;
            json!({
                "stage": made.stage, "version": made.version, "parameters": made.parameters,
                "inputs": made.inputs, "warnings": made.warnings.all(), "content": recorded.content
            })
        });
        let column = |field: &std::sync::Arc<arrow_schema::Field>| {
            let range = footer.ranges.get(field.name()).cloned().unwrap_or_default();
            json!({
                "name": field.name(), "type": field.data_type().to_string(),
                "unit": field.metadata().get("unit"), "description": field.metadata().get("description"),
                "nulls": range.nulls, "least": range.least, "largest": range.largest
            })
        };
        let columns = footer.schema.fields().iter().map(column).collect::<Vec<_>>();
        let told = json!({ "rows": footer.rows, "bytes": footer.bytes, "made": made, "columns": columns });
        Ok((told.to_string(), text))
    };
    py.detach(look).map_err(|error| to_python(py, &error))
}

/// Repeats a pipeline over seeds.
#[pyfunction]
pub fn seed_spread(
    py: Python,
    pipeline: PathBuf,
    seeds: u64,
    out: PathBuf,
    settings: Settings,
) -> PyResult<PathBuf> {
    let options = SeedSpreadOptions { seeds, out: out.clone() };
    let may = May { force: settings.force, overwrite: settings.overwrite };
    run(py, &settings, |console| spread::seed_spread(&pipeline, &options, may, console))?;
    Ok(out)
}
