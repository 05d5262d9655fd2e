//! Motions as simulate and ida take them: as records, with their measures, under distinct names.

use std::collections::HashSet;
use std::path::Path;

use crate::keyword;
use crate::motion::{IntensityMeasures, MeasureScratch, Suite, SyntheticSuite, measures};
use crate::records::implausibility::implausibility;
use crate::rocking::{Outcome, Record, Response, Structure};
use crate::table::TableError;
use crate::table::motions::Motion;
use crate::table::responses::ResponseRow;
use crate::warning::{Warning, Warnings};

/// Measures of a motion: those of the file, or of the record where the file has none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    pub pga_m_s2: f64,
    pub pgv_m_s: f64,
    pub tm_s: Option<f64>,
    pub tp_s: Option<f64>,
}

impl Measures {
    pub fn new(motion: &Motion, record: &Record, scratch: &mut MeasureScratch) -> Measures {
        let (samples, dt_s) = (record.acceleration_m_s2(), record.dt_s());
        let pgv = || measures::peak(&measures::velocity(samples, dt_s));
        Measures {
            pga_m_s2: motion.pga_m_s2.unwrap_or(record.peak_m_s2()),
            pgv_m_s: motion.pgv_m_s.unwrap_or_else(pgv),
            tm_s: motion.tm_s.or_else(|| measures::mean_period(samples, dt_s, scratch)),
            tp_s: motion.tp_s,
        }
    }

    pub fn scaled(self, factor: f64) -> Measures {
        Measures { pga_m_s2: factor * self.pga_m_s2, pgv_m_s: factor * self.pgv_m_s, ..self }
    }

    /// The measures of Eq. 13.
    pub fn of_structure(&self, structure: &Structure) -> IntensityMeasures {
        IntensityMeasures::new(structure, self.pga_m_s2, self.pgv_m_s, self.tp_s, self.tm_s)
    }

    /// The row of the response of a structure to the motion.
    pub fn response_row(&self, motion: &Motion, structure: &Structure, response: Response) -> ResponseRow {
        ResponseRow {
            motion_id: motion.motion_id.clone(),
            suite: motion.suite.clone(),
            structure: structure.name.clone(),
            p_rad_s: structure.p_rad_s,
            alpha_rad: structure.alpha_rad,
            eta: structure.eta,
            outcome: response.outcome,
            edp: (response.outcome != Outcome::Overturning).then_some(response.edp),
            impacts: i32::try_from(response.impacts).ok(),
            mw: motion.mw,
            re_km: motion.re_km,
            earthquake: motion.earthquake.clone(),
            pga_m_s2: self.pga_m_s2,
            pgv_m_s: self.pgv_m_s,
            tp_s: self.tp_s,
            tm_s: self.tm_s,
        }
    }
}

/// By which share the peaks that a file gives may miss those of the samples.
const PEAK_TOLERANCE: f64 = 0.1;

/// Warnings about a recorded motion of the ground.
pub fn warnings(motion: &Motion, record: &Record) -> Warnings {
    let is_not_recorded =
        |word: &str| word.ends_with(Suite::OF_FLOOR) || keyword::parse::<SyntheticSuite>(word).is_ok();
    if motion.suite.as_deref().is_some_and(is_not_recorded) {
        return Warnings::default();
    }
    let (samples, dt_s) = (record.acceleration_m_s2(), record.dt_s());
    let pgv_m_s = measures::peak(&measures::velocity(samples, dt_s));
    let differs = |given: Option<f64>, peak: f64| {
        given.is_some_and(|given| (given - peak).abs() > PEAK_TOLERANCE * peak)
    };
    let is_other = differs(motion.pga_m_s2, record.peak_m_s2()) || differs(motion.pgv_m_s, pgv_m_s);
    let implausible = implausibility(samples, dt_s)
        .map(|warning| (Warning::ImplausibleRecord, format!("{}: {}", motion.motion_id, warning)));
    let other_peak = is_other.then(|| (Warning::OtherPeak, motion.motion_id.clone()));
    implausible.into_iter().chain(other_peak).collect()
}

/// Adds the names of motions of the file at `path` to those so far, which must differ.
pub fn expect_distinct(
    known: &mut HashSet<String>,
    path: &Path,
    names: impl IntoIterator<Item = String>,
) -> Result<(), TableError> {
    match names.into_iter().find_map(|name| known.replace(name)) {
        None => Ok(()),
        Some(name) => {
            let problem = format!("two motions are called '{name}'; expected distinct motion_id");
            Err(TableError::table(path, problem))
        }
    }
}
