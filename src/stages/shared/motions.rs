//! Motions as simulate and ida take them: as records, with their peaks, under distinct names; and what is doubtful about those
//! that other programs made.

use std::collections::HashSet;
use std::path::Path;
use std::sync::Arc;

use super::reasons::{Case, listed};
use crate::keyword;
use crate::motion::{IntensityMeasures, IntensityScratch, Suite, intensity};
use crate::pipeline::console::Console;
use crate::records::plausibility;
use crate::rocking::{Outcome, Record, RecordError, Response, Structure};
use crate::table::TableError;
use crate::table::motions::{Motion, MotionId};
use crate::table::responses::ResponseRow;
use crate::table::schema;
use crate::table::store::source::Source;
use crate::units::G_M_S2;

/// The record of a motion of the file at `path`, whose samples are these (m/s2).
///
/// # Errors
/// If they are none of a record.
pub fn record<'a>(path: &Path, motion: &Motion, samples: &'a [f64]) -> Result<Record<'a>, TableError> {
    Record::new(samples, motion.dt_s).map_err(|problem| TableError::Value {
        path: path.to_path_buf(),
        row: motion.row,
        column: match problem {
            RecordError::TimeStep(_) => schema::dt_s.name.to_string(),
            _ => schema::acceleration_m_s2.name.to_string(),
        },
        problem: problem.to_string(),
    })
}

/// Measures of the file, or of the record where the file has none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peaks {
    /// Peak ground acceleration, m/s2.
    pub pga_m_s2: f64,
    /// Peak ground velocity, m/s.
    pub pgv_m_s: f64,
    /// Mean period, s.
    pub tm_s: Option<f64>,
}

impl Peaks {
    /// Of a motion.
    pub fn of(motion: &Motion, record: &Record, scratch: &mut IntensityScratch) -> Peaks {
        let (samples, dt_s) = (record.acceleration_m_s2(), record.dt_s());
        let pgv = || intensity::peak(&intensity::velocity(samples, dt_s));
        Peaks {
            pga_m_s2: motion.pga_m_s2.unwrap_or(record.peak_m_s2()),
            pgv_m_s: motion.pgv_m_s.unwrap_or_else(pgv),
            tm_s: motion.tm_s.or_else(|| intensity::mean_period(samples, dt_s, scratch)),
        }
    }

    /// The row of what came of a structure under the motion that has these peaks.
    pub fn response_row<'a>(
        &self,
        motion: &'a Motion,
        structure: &'a Structure,
        response: Response,
    ) -> ResponseRow<'a> {
        let Peaks { pga_m_s2, pgv_m_s, tm_s } = *self;
        let measures = IntensityMeasures::new(structure, pga_m_s2, pgv_m_s, motion.tp_s, tm_s);
        ResponseRow {
            motion_id: &motion.motion_id,
            suite: motion.suite.as_deref(),
            structure: &structure.name,
            p_rad_s: structure.p_rad_s,
            alpha_rad: structure.alpha_rad,
            eta: structure.eta,
            outcome: response.outcome,
            // How far it leans when it is down is no demand: an average over it would mean nothing.
            edp: (response.outcome != Outcome::Overturning).then_some(response.edp),
            impacts: i32::try_from(response.impacts).unwrap_or(i32::MAX),
            mw: motion.mw,
            re_km: motion.re_km,
            earthquake: motion.earthquake.as_ref().map(|label| label.0.as_str()),
            pga_m_s2,
            pgv_m_s,
            tp_s: motion.tp_s,
            tm_s,
            im1: measures.im1,
            im2: measures.im2,
            im3: measures.im3,
            im4: measures.im4,
            im5: measures.im5,
            im6: measures.im6,
        }
    }

    /// Of the motion scaled by a factor.
    pub fn scaled(&self, factor: f64) -> Peaks {
        Peaks { pga_m_s2: factor * self.pga_m_s2, pgv_m_s: factor * self.pgv_m_s, ..*self }
    }
}

/// Accelerations up to this number may have been meant in g.
const LARGEST_PGA_IN_G: f64 = 3.0;

/// Asks whether a column is in g, where nothing rocks and its largest acceleration is so small.
pub fn in_g(what: &str, column: &str, largest_m_s2: f64) -> Option<String> {
    (largest_m_s2 <= LARGEST_PGA_IN_G).then(|| {
        format!(
            "no {what} rocks: PGA is at most {largest_m_s2} m/s2; is it in g? multiply the column {column} by {G_M_S2}"
        )
    })
}

/// By which share the peak that a file of others gives may miss that of the samples.
const PEAK_TOLERANCE: f64 = 0.1;

/// Whether the motions of other programs can be those of earthquakes.
pub struct Judge {
    of_others: HashSet<Arc<Path>>,
}

impl Judge {
    /// Of the motions in these files, but for those that say that they are synthetic.
    pub fn new(of_others: HashSet<Arc<Path>>) -> Judge {
        Judge { of_others }
    }

    /// What is doubtful about a motion of the file at `path`, whose samples are these (m/s2).
    pub fn doubt(&self, path: &Path, motion: &Motion, samples: &[f64]) -> Option<Case> {
        let suite = motion.suite.as_deref().and_then(|word| keyword::parse::<Suite>(word).ok());
        let is_synthetic = suite.is_some_and(|suite| Suite::SYNTHETIC.contains(&suite));
        if is_synthetic || !self.of_others.contains(path) {
            return None;
        }
        let name = motion.motion_id.to_string();
        let peak = intensity::peak(samples);
        let other = motion.pga_m_s2.filter(|pga| (pga - peak).abs() > PEAK_TOLERANCE * peak);
        if let Some(pga) = other {
            let found = Some(format!("{pga:.3} m/s2 for {peak:.3} m/s2"));
            let reason =
                "column 'pga_m_s2' is not the peak of the samples; PGA of another unit or component?";
            return Some(Case { name, found, reason: reason.to_string() });
        }
        plausibility::doubt(samples, motion.dt_s).map(|doubt| Case::of_doubt(name, &doubt))
    }
}

/// The most columns that are named one by one.
const MOST_NAMED: usize = 12;

/// What may take them, of simulate.
pub const FOR_RANKING: &str = "rank-ims takes them with --candidate";

/// Says which columns of a motions file are not taken, and what may take them.
pub fn note_passed_over(source: &Source, columns: &[String], way: &str, console: &Console) {
    if columns.is_empty() {
        return;
    }
    let named = listed(&columns[..columns.len().min(MOST_NAMED)], columns.len());
    console.note(&format!("{}: passed over: {named}; {way}", source.name().display()));
}

/// The names of all motions so far, which must differ; numbers take little room, as there may be millions.
#[derive(Default)]
pub struct DistinctIds {
    numbers: HashSet<i64>,
    names: HashSet<String>,
}

impl DistinctIds {
    /// Adds those of the file at `path`.
    ///
    /// # Errors
    /// If one is there already.
    pub fn add(&mut self, path: &Path, ids: &[MotionId]) -> anyhow::Result<()> {
        match ids.iter().find(|id| !self.insert(id)) {
            Some(id) => anyhow::bail!(
                "{}: two motions are called '{id}'; expected distinct motion_id",
                path.display()
            ),
            None => Ok(()),
        }
    }

    fn insert(&mut self, id: &MotionId) -> bool {
        match id {
            MotionId::Number(number) => self.numbers.insert(*number),
            MotionId::Name(name) => self.names.insert(name.clone()),
        }
    }
}
