//! Objects and sites of the library: probabilities, rates and fragilities without a file. Numbers are the
//! bytes of f64, NaN where there is none.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::CString;
use std::path::PathBuf;
use std::sync::Arc;

use arrow_array::RecordBatch;
use pyo3::exceptions::{PyTypeError, PyUserWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyDict};
use rayon::prelude::*;
use rockfrag::answer::{CurveRow, FragilityColumns, RateColumns};
use rockfrag::inputs::{Reader, Rename, hazard as files};
use rockfrag::pipeline::UsageError;
use rockfrag::pipeline::context::Common;
use rockfrag::stages::shared::model_args::{ModelArgs, ModelName};
use rockfrag::table::rows;
use rockfrag_core::fragility::{LimitStates, MotionKind, Peak, RockingDirection};
use rockfrag_core::hazard::{self, GenericSites, GroundMotion, Hazard, unusual_motions};
use rockfrag_core::motion::{IntensityMeasures, Peaks};
use rockfrag_core::object::{Field, Object, Place, RockingObject};
use rockfrag_core::plausibility::{
    Expected, GIVEN_LIMIT_STATE, GIVEN_MAGNITUDE, GIVEN_PGA_G, GIVEN_PGV_M_S, GIVEN_RATIO_S, GIVEN_VS30_M_S,
    GIVEN_YEARS,
};
use rockfrag_core::records::implausibility::rarity;
use rockfrag_core::rocking::Structure;
use rockfrag_core::statistics::Interval;
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::{UNNAMED, Warning};
use strum::VariantArray;

use crate::arrays::{bytes, numbers};
use crate::error::{in_python, to_python};
use crate::run::run;
use crate::table::columns;

/// Motions up to which the calling thread is the fastest.
const FEW: usize = 64;

type Columns<'py> = (Bound<'py, PyDict>, Vec<String>);

/// The name and the help of each field of an object.
pub fn fields() -> Vec<(String, String)> {
    let name = |field: &Field| field.to_string().replace('-', "_");
    Field::VARIANTS.iter().map(|field| (name(field), in_python(field.entry().help))).collect()
}

/// A message with the names that fields have in Python.
fn with_fields(message: &str) -> String {
    let fields = Field::VARIANTS.iter().map(Field::to_string).filter(|field| field.contains('-'));
    fields.fold(in_python(message), |message, field| message.replace(&field, &field.replace('-', "_")))
}

/// An object with the model of each of its directions.
#[pyclass(frozen, name = "Object")]
pub struct PyObject {
    place: Place,
    rocking: Arc<RockingObject>,
    warnings: Vec<Warning>,
}

#[pymethods]
impl PyObject {
    #[new]
    fn new(
        fields: Vec<(String, String)>,
        limit_state: f64,
        suite: Option<&str>,
        fits: Option<PathBuf>,
    ) -> PyResult<PyObject> {
        let mut object = Object { name: UNNAMED.to_string(), ..Object::default() };
        for (name, text) in &fields {
            let word = name.replace('_', "-");
            if !["name", "count"].contains(&&*word) {
                word.parse::<Field>().map_err(|error| PyTypeError::new_err(error.replace('-', "_")))?;
            }
            object.set(&word, text).map_err(|error| PyValueError::new_err(with_fields(&error)))?;
        }
        let suite = suite.map(str::parse::<MotionKind>).transpose();
        let suite = suite.map_err(|error| PyValueError::new_err(format!("suite: {error}")))?;
        expect("limit_state", GIVEN_LIMIT_STATE, &[limit_state])?;
        let object = object.on_pedestal();
        let model = ModelArgs { fits, name: None, suite, model: ModelName::Calibrated, limit_state };
        let found = model.read().and_then(|models| models.rocking_object(&object));
        let (rocking, warnings) = found.map_err(|error| match error.is::<UsageError>() {
            true => PyValueError::new_err(with_fields(&error.to_string())),
            false => to_python(&error),
        })?;
        Ok(PyObject { place: object.place, rocking: Arc::new(rocking), warnings })
    }

    /// p (rad/s), alpha (rad) and eta of its weaker direction.
    #[getter]
    fn parameters(&self) -> (f64, f64, f64) {
        let Structure { p_rad_s, alpha_rad, eta, .. } = self.rocking.directions[0].structure;
        (p_rad_s, alpha_rad, eta)
    }

    /// Probabilities under `number` motions, a row of numbers a limit: rocking; failure, its limits;
    /// overturning, its limits.
    fn probability<'py>(
        &self,
        py: Python<'py>,
        number: usize,
        pga_g: Option<Numbers>,
        pgv_m_s: Option<Numbers>,
        magnitude: Option<Numbers>,
        vs30: Option<f64>,
    ) -> PyResult<(Bound<'py, PyBytes>, Vec<String>)> {
        expect_site(None, vs30, None)?;
        let (motions, is_at_rim) = motions(number, [pga_g, pgv_m_s, magnitude], vs30)?;
        let (rocking, mut warnings) = (self.rocking.clone(), BTreeSet::from_iter(self.warnings.clone()));
        warnings.extend(rocking.structure_warnings());
        warnings.extend(is_at_rim.then_some(Warning::AtRim));
        let states = if number <= FEW {
            py.detach(|| motions.iter().map(|motion| under(&rocking, motion)).collect())
        } else {
            run(py, None, None, move |common| {
                let all = motions.par_chunks(FEW).map(|some| {
                    common.observed.expect_running()?;
                    Ok(some.iter().map(|motion| under(&rocking, motion)).collect())
                });
                Ok(all.collect::<anyhow::Result<Vec<Vec<_>>>>()?.concat())
            })?
        };
        let mut rows: [Vec<f64>; 7] = Default::default();
        for (LimitStates { rocking, failure, overturning }, told) in states {
            let limits = |of: Interval<Option<f64>>| [of.value, of.low, of.high];
            let all = [rocking.value].into_iter().chain(limits(failure)).chain(limits(overturning));
            rows.iter_mut().zip(all).for_each(|(row, p)| row.push(p.unwrap_or(f64::NAN)));
            warnings.extend(told);
        }
        Ok((bytes(py, rows.into_iter().flatten()), texts(&warnings)))
    }

    /// Annual rates and probabilities in so many years at a site: the columns of evaluate.
    fn rate<'py>(&self, py: Python<'py>, site: &Site, years: f64) -> PyResult<Columns<'py>> {
        expect("years", GIVEN_YEARS, &[years])?;
        let (rocking, site) = (self.rocking.clone(), site.0.clone());
        self.answer(py, move |_| {
            let rates = site.rates(&rocking);
            let (of_rates, in_years) = RateColumns::new(&rates, years);
            let warnings = rates.warnings.iter().copied().chain(rocking.warnings(rates.motion));
            Ok((vec![rows::batch(&[of_rates])?, rows::batch(&[in_years])?], warnings.collect()))
        })
    }

    /// The fragility over a peak at typical sites: the points, and what it comes to.
    fn fragility<'py>(
        &self,
        py: Python<'py>,
        over: &str,
        magnitude: Option<f64>,
        vs30: Option<f64>,
        ratio: Option<f64>,
    ) -> PyResult<Columns<'py>> {
        let over: Peak = over.parse().map_err(|error| PyValueError::new_err(format!("over: {error}")))?;
        expect_site(magnitude, vs30, ratio)?;
        let (rocking, sites) =
            (self.rocking.clone(), GenericSites { over, mw: magnitude, vs30_m_s: vs30, ratio_s: ratio });
        self.answer(py, move |_| {
            let fragility = sites.fragility(&rocking);
            let points = fragility.points.iter().map(|point| CurveRow::new(Some(over), point));
            let tables = vec![
                rows::batch(&points.collect::<Vec<_>>())?,
                rows::batch(&[FragilityColumns::new(&fragility)])?,
            ];
            let unusual = unusual_motions(magnitude, vs30);
            Ok((tables, unusual.chain(rocking.warnings(fragility.motion)).collect()))
        })
    }
}

impl PyObject {
    /// Runs `work`, and gives the columns of all its tables with the warnings.
    fn answer<'py>(
        &self,
        py: Python<'py>,
        work: impl FnOnce(Common) -> anyhow::Result<(Vec<RecordBatch>, Vec<Warning>)> + Send + 'static,
    ) -> PyResult<Columns<'py>> {
        let (tables, warnings) = run(py, None, None, work)?;
        let found = PyDict::new(py);
        for table in tables {
            columns(&found, &table, &|_| true)?;
        }
        Ok((found, texts(warnings.iter().chain(&self.warnings))))
    }

    /// The structure of its weaker direction, on the ground and free to rock to both sides.
    pub fn structure(&self) -> anyhow::Result<Structure> {
        let place = &self.place;
        let problem = match () {
            () if matches!(place.floor(), Ok(Some(_))) => {
                "level, period: expected the motion of the floor itself"
            }
            () if place.wall.is_some() => "wall: the solvers rock it to both sides",
            () => return Ok(self.rocking.directions[0].structure.clone()),
        };
        Err(UsageError::because(problem))
    }
}

fn texts<'a>(warnings: impl IntoIterator<Item = &'a Warning>) -> Vec<String> {
    let all: BTreeSet<&Warning> = warnings.into_iter().collect();
    all.into_iter().map(|warning| warning.text().to_string()).collect()
}

/// The probabilities under a motion, and warnings about them. One direction has no other to be compared with.
fn under(
    object: &RockingObject,
    motion: &GroundMotion,
) -> (LimitStates<Interval<Option<f64>>>, Vec<Warning>) {
    let peaks = motion.peaks(&object.directions[0].model);
    let mut told = match &object.directions[..] {
        [RockingDirection { structure, model, .. }] if peaks.pga_m_s2 > 0.0 => {
            model.warnings(structure, &IntensityMeasures::new(structure, peaks, None, None))
        }
        _ => object.warnings(peaks),
    };
    told.extend(rarity(motion.pga_m_s2, motion.pgv_m_s).map(|_| Warning::ImplausibleRecord));
    told.extend(unusual_motions(motion.mw, motion.vs30_m_s));
    (motion.probabilities(object).states, told)
}

/// A number, or the bytes of several.
#[derive(FromPyObject)]
enum Numbers {
    One(f64),
    Many(PyBackedBytes),
}

/// PGA, PGV and magnitude of each motion; of several, those that no motion has are held at the rim of records.
fn motions(
    number: usize,
    given: [Option<Numbers>; 3],
    vs30_m_s: Option<f64>,
) -> PyResult<(Vec<GroundMotion>, bool)> {
    let [pga, pgv, mw] = given.map(|of| {
        of.map(|of| match of {
            Numbers::One(number) => vec![number],
            Numbers::Many(bytes) => numbers(&bytes),
        })
    });
    expect("pga", GIVEN_PGA_G, pga.iter().flatten())?;
    expect("pgv", GIVEN_PGV_M_S, pgv.iter().flatten())?;
    expect("magnitude", GIVEN_MAGNITUDE, mw.iter().flatten())?;
    if pga.is_some() && pgv.is_some() && vs30_m_s.is_some() {
        return Err(PyValueError::new_err("vs30 only estimates a missing peak; both are given"));
    }
    let at = |of: &Option<Vec<f64>>, k: usize| of.as_ref().map(|of| of[k]);
    let mut all: Vec<GroundMotion> = (0..number)
        .map(|k| GroundMotion {
            pga_m_s2: at(&pga, k).map(|g| g * G_M_S2),
            pgv_m_s: at(&pgv, k),
            mw: at(&mw, k),
            vs30_m_s,
        })
        .collect();
    let mut is_at_rim = false;
    for motion in &mut all {
        let GroundMotion { pga_m_s2: Some(pga_m_s2), pgv_m_s: Some(pgv_m_s), .. } = *motion else { break };
        let given = Peaks { pga_m_s2, pgv_m_s };
        if number == 1 {
            given.validate().map_err(PyValueError::new_err)?;
        }
        let peaks = given.clamp_to_recorded();
        is_at_rim |= peaks != given;
        (motion.pga_m_s2, motion.pgv_m_s) = (Some(peaks.pga_m_s2), Some(peaks.pgv_m_s));
    }
    Ok((all, is_at_rim))
}

/// Refuses what is out of range.
fn expect<'a>(
    name: &str,
    (range, expected): Expected,
    values: impl IntoIterator<Item = &'a f64>,
) -> PyResult<()> {
    match values.into_iter().find(|value| !range.contains(value)) {
        Some(value) => Err(PyValueError::new_err(format!("{name} is {value}; expected {expected}"))),
        None => Ok(()),
    }
}

/// Checks magnitude, Vs30 and PGV / PGA of the motions of a site.
fn expect_site(magnitude: Option<f64>, vs30: Option<f64>, ratio: Option<f64>) -> PyResult<()> {
    expect("magnitude", GIVEN_MAGNITUDE, &magnitude)?;
    expect("vs30", GIVEN_VS30_M_S, &vs30)?;
    expect("ratio", GIVEN_RATIO_S, &ratio)
}

/// A site by its hazard curves, each of two rows: intensities, and the annual rates at which they are exceeded.
///
/// `pga` and `sa_1s` are in g, `pgv` in m/s: PGA alone, with one of the others (which tell PGV / PGA), or PGV
/// alone. `magnitude` is the mean of the disaggregation, `vs30` in m/s, `ratio` PGV / PGA in s.
#[pyclass(frozen, module = "rockfrag")]
pub struct Site(hazard::Site);

#[pymethods]
impl Site {
    #[new]
    #[pyo3(signature = (*, pga=None, pgv=None, sa_1s=None, magnitude=None, vs30=None, ratio=None))]
    fn new(
        pga: Option<[Vec<f64>; 2]>,
        pgv: Option<[Vec<f64>; 2]>,
        sa_1s: Option<[Vec<f64>; 2]>,
        magnitude: Option<f64>,
        vs30: Option<f64>,
        ratio: Option<f64>,
    ) -> PyResult<Site> {
        let mut curves = Vec::new();
        for (name, curve) in [("pga", pga), ("pgv", pgv), ("sa_1s", sa_1s)] {
            let Some([values, rates]) = curve else { continue };
            if values.len() != rates.len() {
                let problem = format!("{name}: {} intensities and {} rates", values.len(), rates.len());
                return Err(PyValueError::new_err(problem));
            }
            curves.push((name, values.into_iter().zip(rates).collect()));
        }
        let hazard = files::of_points(curves).map_err(|error| PyValueError::new_err(error.to_string()))?;
        Site::about(hazard, magnitude, vs30, ratio)
    }

    /// A site by the files that `evaluate(hazard=...)` takes; `columns` says what headings mean.
    #[staticmethod]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    #[pyo3(signature = (*files, columns=BTreeMap::new(), ignore=vec![], effective_years=None, magnitude=None,
                        vs30=None, ratio=None))]
    fn read(
        py: Python,
        files: Vec<PathBuf>,
        columns: BTreeMap<String, String>,
        ignore: Vec<String>,
        effective_years: Option<f64>,
        magnitude: Option<f64>,
        vs30: Option<f64>,
        ratio: Option<f64>,
    ) -> PyResult<Site> {
        let renames = columns.iter().map(|(column, heading)| format!("{column}={heading}").parse());
        let renames = renames.collect::<Result<Vec<Rename>, _>>().map_err(PyValueError::new_err)?;
        let mut reader = Reader::new(&renames, &ignore);
        let read = py.detach(|| {
            let hazard = files::read(&files, &mut reader, effective_years)?;
            reader.expect_used().map(|()| hazard)
        });
        let site = Site::about(read.map_err(|error| to_python(&error.into()))?, magnitude, vs30, ratio)?;
        for line in reader.warnings.lines() {
            PyErr::warn(py, &py.get_type::<PyUserWarning>(), &CString::new(line)?, 1)?;
        }
        Ok(site)
    }
}

impl Site {
    fn about(
        hazard: Hazard,
        magnitude: Option<f64>,
        vs30: Option<f64>,
        ratio: Option<f64>,
    ) -> PyResult<Site> {
        expect_site(magnitude, vs30, ratio)?;
        hazard::Site::about(hazard, magnitude, vs30, ratio).map(Site).map_err(PyValueError::new_err)
    }
}
