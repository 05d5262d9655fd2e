//! Motions through objects. Arrays are the bytes of f64.

use std::sync::atomic::Ordering;

use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyDict};
use rayon::prelude::*;
use rockfrag::pipeline::UsageError;
use rockfrag::pipeline::context::Common;
use rockfrag::table::responses::OutcomeWord;
use rockfrag_core::object::structure_warnings;
use rockfrag_core::records::implausibility::implausibility;
use rockfrag_core::rocking::{
    Ground, Outcome, Problem, Record, Response, Structure, TracePoint, simulate, simulate_all, trace,
};
use rockfrag_core::units::G_M_S2;

use crate::error::to_python;
use crate::objects::PyObject;
use crate::run::run;

/// The largest acceleration, g, and the longest time step, s, of a motion that is not in a wrong unit.
const MOST_G: f64 = 20.0;
const LONGEST_STEP_S: f64 = 0.1;
/// Motions that a thread takes at once, as of simulate.
const CHUNK: usize = 32;

/// Numbers from their bytes.
pub fn numbers(bytes: &[u8]) -> Vec<f64> {
    bytes.as_chunks::<8>().0.iter().map(|number| f64::from_ne_bytes(*number)).collect()
}

/// The bytes of numbers.
pub fn bytes<'py>(py: Python<'py>, numbers: impl Iterator<Item = f64>) -> Bound<'py, PyBytes> {
    PyBytes::new(py, &numbers.flat_map(f64::to_ne_bytes).collect::<Vec<u8>>())
}

/// A record that the solvers take: in m/s2, with a step of a record.
fn record(acceleration: &[f64], dt_s: f64) -> Result<Record<'_>, String> {
    let pga_g = acceleration.iter().fold(0.0_f64, |most, a| most.max(a.abs())) / G_M_S2;
    match () {
        () if pga_g > MOST_G && pga_g.is_finite() => {
            Err(format!("acceleration reaches {pga_g:.1} g; expected m/s2, up to {MOST_G} g"))
        }
        () if dt_s > LONGEST_STEP_S => {
            Err(format!("dt is {dt_s} s; expected at most {LONGEST_STEP_S} s: is it in ms?"))
        }
        () => Record::new(acceleration, dt_s).map_err(|error| error.to_string()),
    }
}

/// Simulates an object under samples (m/s2) every `dt_s` s with `tail_s` s of quiet after them. Returns the
/// rotation at every sample and event, and the outcome.
#[pyfunction]
pub fn simulate_motion<'py>(
    py: Python<'py>,
    object: &PyObject,
    acceleration: &[u8],
    dt_s: f64,
    tail_s: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let acceleration = numbers(acceleration);
    let solve = || -> anyhow::Result<_> {
        let structure = object.structure()?;
        if !(0.0..=1000.0).contains(&tail_s) {
            return Err(UsageError::because(format!("tail is {tail_s}; expected 0 to 1000 s")));
        }
        let record = record(&acceleration, dt_s).map_err(UsageError::because)?;
        let points = trace(&structure, &record, tail_s).1;
        let ground = record.ground_at(points.iter().map(|point| point.time_s));
        Ok((simulate(&structure, &record), points, ground, structure))
    };
    let (response, points, ground, structure) = py.detach(solve).map_err(|error| to_python(&error))?;
    let result = PyDict::new(py);
    let column = |value: fn(&TracePoint) -> f64| bytes(py, points.iter().map(value));
    result.set_item("time", column(|point| point.time_s))?;
    result.set_item("theta", column(|point| point.theta_rad))?;
    result.set_item("theta_dot", column(|point| point.theta_dot_rad_s))?;
    let of_ground = |value: fn(&Ground) -> f64| bytes(py, ground.iter().map(value));
    result.set_item("ground_acceleration", of_ground(|ground| ground.acceleration_m_s2))?;
    result.set_item("ground_velocity", of_ground(|ground| ground.velocity_m_s))?;
    let events = points.iter().filter_map(|point| Some((point.time_s, point.solver_event?.to_string())));
    result.set_item("events", events.collect::<Vec<_>>())?;
    result.set_item("outcome", OutcomeWord::from(response.outcome).to_string())?;
    result.set_item("edp", response.outcome.demand())?;
    result.set_item("impacts", response.impacts)?;
    result.set_item("p", structure.p_rad_s)?;
    result.set_item("alpha", structure.alpha_rad)?;
    result.set_item("eta", structure.eta)?;
    let implausible = implausibility(&acceleration, dt_s).map(|of| of.to_string());
    let warnings = structure_warnings(&structure).into_iter().map(|warning| warning.text().to_string());
    result.set_item("warnings", implausible.into_iter().chain(warnings).collect::<Vec<_>>())?;
    Ok(result)
}

/// Simulates all objects under all records (m/s2), each with its `dt_s` or the only one: for each record and
/// object in turn |theta|max / alpha, NaN where it overturns, and 1 where it does; and a warning of the first
/// record that cannot be one.
#[pyfunction]
pub fn simulate_motions<'py>(
    py: Python<'py>,
    records: Vec<PyBackedBytes>,
    dt_s: Vec<f64>,
    objects: Vec<PyRef<PyObject>>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyBytes>, Option<String>)> {
    let structures =
        objects.iter().map(|object| object.structure()).collect::<anyhow::Result<Vec<Structure>>>();
    let structures = structures.map_err(|error| to_python(&error))?;
    let work = move |common: Common| {
        common.observed.total.store(records.len(), Ordering::Relaxed);
        let all = records.par_chunks(CHUNK).enumerate().map(|(chunk, some)| {
            common.observed.expect_running()?;
            let samples: Vec<Vec<f64>> = some.iter().map(|bytes| numbers(bytes)).collect();
            let told = |at: usize, problem: String| format!("accelerations[{at}]: {problem}");
            let dt_s = |at: usize| dt_s[if dt_s.len() == 1 { 0 } else { at }];
            let numbered = || samples.iter().zip(CHUNK * chunk..);
            let checked = numbered().map(|(samples, at)| {
                record(samples, dt_s(at)).map_err(|problem| UsageError::because(told(at, problem)))
            });
            let checked = checked.collect::<anyhow::Result<Vec<Record>>>()?;
            let implausible = numbered().filter_map(|(samples, at)| {
                implausibility(samples, dt_s(at)).map(|problem| told(at, problem.to_string()))
            });
            let implausible: Vec<String> = implausible.collect();
            let pairs = checked
                .iter()
                .flat_map(|&record| structures.iter().map(move |structure| Problem { structure, record }));
            let responses = simulate_all(&pairs.collect::<Vec<_>>());
            common.observed.done.fetch_add(some.len(), Ordering::Relaxed);
            Ok((responses, implausible))
        });
        let (responses, implausible): (Vec<_>, Vec<_>) =
            all.collect::<anyhow::Result<Vec<_>>>()?.into_iter().unzip();
        Ok((responses.concat(), implausible.concat()))
    };
    let (responses, implausible): (Vec<Response>, Vec<String>) = run(py, threads, progress.as_ref(), work)?;
    let edp = responses.iter().map(|response| response.outcome.demand().unwrap_or(f64::NAN));
    let overturned = responses.iter().map(|response| u8::from(response.outcome == Outcome::Overturned));
    let warning = match &implausible[..] {
        [] => None,
        [one] => Some(one.clone()),
        [first, others @ ..] => Some(format!("{first} (and {} more)", others.len())),
    };
    Ok((bytes(py, edp), PyBytes::new(py, &overturned.collect::<Vec<u8>>()), warning))
}
