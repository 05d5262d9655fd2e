//! The stages, as the command line runs them: tables and paths in, a table (or the path that was written) out.

use std::collections::BTreeMap;
use std::path::PathBuf;

use pyo3::prelude::*;
use rockfrag::pipeline::UsageError;
use rockfrag::pipeline::cache::{self, May};
use rockfrag::stages::registry;
use rockfrag::table::store::partition::Partition;
use rockfrag::table::store::provenance::Provenance;
use rockfrag::table::store::source::{MemoryTables, Source, Target};
use serde_json::{Value, json};

use crate::error::to_python;
use crate::run::{Settings, run};
use crate::table::{PyTable, source};

/// The place among the tables in memory, of what a stage is for.
const MAIN: &str = "";

/// All stages as JSON: names, inputs, options with types and defaults, outputs.
#[pyfunction]
pub fn stages() -> String {
    registry::descriptions().to_string()
}

/// Runs a stage: into a file, unless that is up to date, or into memory.
#[pyfunction]
pub fn call(
    py: Python,
    stage: &str,
    inputs: BTreeMap<String, Bound<PyAny>>,
    options: &str,
    out: Option<PathBuf>,
    settings: Settings,
) -> PyResult<Py<PyAny>> {
    let given = inputs.iter().map(|(role, given)| Ok((role.clone(), source(role, given)?)));
    let inputs = given.collect::<PyResult<BTreeMap<String, Source>>>()?;
    if let Some(out) = out {
        let path = run(py, &settings, |console| {
            let stages = registry::create(stage, options, &inputs, Some((&out).into()))?;
            let may = May { force: settings.force, overwrite: settings.overwrite };
            stages.iter().try_for_each(|stage| cache::run_alone(stage.as_ref(), may, console))?;
            let written = if stages.len() == 1 { stages[0].outputs().pop() } else { None };
            Ok(written.unwrap_or(out))
        })?;
        return Ok(path.into_pyobject(py)?.unbind());
    }
    let tables = MemoryTables::default();
    let (parts, made) = run(py, &settings, |console| {
        let stages = registry::create(stage, options, &inputs, Some(tables.place(MAIN)))?;
        let (mut parts, mut made) = (Vec::new(), Value::Null);
        for stage in stages {
            // What stays in memory has no file to say how it was made.
            let provenance = Provenance::new(stage.name(), stage.parameters(), BTreeMap::new());
            cache::warn_of_partitions(stage.as_ref(), console);
            stage.execute(&provenance, console)?;
            let Provenance { stage: name, version, parameters, .. } = provenance;
            let warnings = console.warnings.all();
            made =
                json!({ "stage": name, "version": version, "parameters": parameters, "warnings": warnings });
            parts.extend(stage.targets().into_iter().filter_map(|target| match target {
                Target::Memory(_, part) if part != MAIN => Some(part),
                _ => None,
            }));
        }
        Ok((parts, made))
    })?;
    Ok(PyTable::take(py, &tables, MAIN, &parts, &made.to_string())?.into_pyobject(py)?.unbind())
}

/// What the file of a partition is called.
#[pyfunction]
pub fn partition_file(py: Python, partition: &str) -> PyResult<String> {
    let partition: Result<Partition, String> = partition.parse();
    let partition = partition.map_err(|wrong| to_python(py, &UsageError::because(wrong)))?;
    Ok(partition.file_name())
}
