//! The rocking response of one structure to one motion.

use numpy::{IntoPyArray, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rockfrag::keyword::Keyword;
use rockfrag::pipeline::UsageError;
use rockfrag::pipeline::options::check;
use rockfrag::rocking::{Outcome, Record, RecordError, TracePoint, simulate, trace, with_tail};
use rockfrag::stages::shared::structures::StructureSpec;

use crate::error::to_python;

fn spec(structure: &str) -> anyhow::Result<StructureSpec> {
    serde_json::from_str(structure).map_err(|error| UsageError::because(error.to_string()))
}

/// Name, p, alpha and eta of a structure that is given as JSON.
#[pyfunction]
pub fn structure(py: Python, structure: &str) -> PyResult<(String, f64, f64, f64)> {
    let structure = spec(structure).and_then(|spec| spec.structure());
    let structure = structure.map_err(|error| to_python(py, &error))?;
    Ok((structure.name, structure.p_rad_s, structure.alpha_rad, structure.eta))
}

/// Rotation and velocity at every sample and event, by name of the column; and what came of it.
#[pyfunction]
pub fn response<'py>(
    py: Python<'py>,
    acceleration_m_s2: PyReadonlyArray1<f64>,
    dt_s: f64,
    structure: &str,
    tail_s: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let samples = acceleration_m_s2.as_slice()?;
    let solve = || -> anyhow::Result<_> {
        let structure = spec(structure)?.structure()?;
        check((0.0..=1000.0).contains(&tail_s), "tail_s", tail_s, "0 to 1000 s")?;
        let usage = |error: RecordError| UsageError(error.to_string());
        let record = Record::new(samples, dt_s).map_err(usage)?;
        let response = simulate(&structure, &record);
        let ended = with_tail(&record, tail_s);
        let (_, points) = trace(&structure, &Record::new(&ended, dt_s).map_err(usage)?);
        Ok((response, points, structure))
    };
    let (response, points, structure) = py.detach(solve).map_err(|error| to_python(py, &error))?;
    let column =
        |value: fn(&TracePoint) -> f64| points.iter().map(value).collect::<Vec<f64>>().into_pyarray(py);
    let result = PyDict::new(py);
    result.set_item("time_s", column(|point| point.time_s))?;
    result.set_item("theta_rad", column(|point| point.theta_rad))?;
    result.set_item("theta_dot_rad_s", column(|point| point.theta_dot_rad_s))?;
    let events = points.iter().filter_map(|point| Some((point.time_s, point.solver_event?.as_str())));
    result.set_item("events", events.collect::<Vec<_>>())?;
    result.set_item("outcome", response.outcome.as_str())?;
    let demand = (response.outcome != Outcome::Overturning).then_some(response.edp);
    result.set_item("edp", demand)?;
    result.set_item("impacts", response.impacts)?;
    result.set_item("p_rad_s", structure.p_rad_s)?;
    result.set_item("alpha_rad", structure.alpha_rad)?;
    result.set_item("eta", structure.eta)?;
    Ok(result)
}
