//! Motions as simulate and ida take them: as records, with their measures, under distinct names.

use std::collections::HashSet;

use rayon::prelude::*;
use rockfrag_core::motion::{IntensityMeasures, Peaks, Suite, measures};
use rockfrag_core::records::implausibility::implausibility;
use rockfrag_core::rocking::{Record, Response, Structure};
use rockfrag_core::warning::{Warning, Warnings};

use crate::pipeline::context::Progress;
use crate::pipeline::stream::{batches, pipelined};
use crate::table::TableError;
use crate::table::motions::{MotionRow, Part, Sampled};
use crate::table::responses::ResponseRow;

/// Parts of the file that are read at once, for each thread.
const PARTS_A_THREAD: usize = 4;

/// Passes the motions of a table, in its parts, through `work` on all threads, and what comes of them in order
/// to `sink`. They must have distinct names.
pub fn process_in_order<'a, T: Send>(
    bar: &Progress,
    parts: impl Iterator<Item = Part<'a>> + Send,
    work: impl Fn(Sampled) -> anyhow::Result<T> + Sync,
    mut sink: impl FnMut(T) -> anyhow::Result<()> + Send,
) -> anyhow::Result<()> {
    let mut known = HashSet::new();
    pipelined(
        batches(parts, PARTS_A_THREAD * rayon::current_num_threads()),
        |part| {
            let done = part()?.into_par_iter().map(|some| {
                let ids: Vec<String> = some.motions.iter().map(|motion| motion.motion_id.clone()).collect();
                let path = some.columns.path.clone();
                bar.advance(ids.len())?;
                Ok((path, ids, work(some)?))
            });
            done.collect::<anyhow::Result<Vec<_>>>()
        },
        |part| {
            for (path, ids, done) in part {
                if let Some(id) = ids.into_iter().find_map(|id| known.replace(id)) {
                    let problem = format!("two motions are called '{id}'; expected distinct motion_id");
                    return Err(TableError::table(&path, problem).into());
                }
                sink(done)?;
            }
            Ok(())
        },
    )
}

/// Measures of a motion: those of the file, or of the record where the file has none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    pub peaks: Peaks,
    pub tm_s: Option<f64>,
    pub tp_s: Option<f64>,
}

impl Measures {
    pub fn new(motion: &MotionRow, record: &Record) -> Measures {
        let (samples, dt_s) = (record.acceleration_m_s2(), record.dt_s());
        let peaks = Peaks {
            pga_m_s2: motion.pga_m_s2.unwrap_or(record.peak_m_s2()),
            pgv_m_s: motion.pgv_m_s.unwrap_or_else(|| measures::peak(&measures::velocity(samples, dt_s))),
        };
        let tm_s = motion.tm_s.or_else(|| measures::mean_period(samples, dt_s));
        Measures { peaks, tm_s, tp_s: motion.tp_s }
    }

    pub fn scaled(self, factor: f64) -> Measures {
        let Peaks { pga_m_s2, pgv_m_s } = self.peaks;
        Measures { peaks: Peaks { pga_m_s2: factor * pga_m_s2, pgv_m_s: factor * pgv_m_s }, ..self }
    }

    /// The measures of Eq. 13.
    pub fn dimensionless(&self, structure: &Structure) -> IntensityMeasures {
        IntensityMeasures::new(structure, self.peaks, self.tp_s, self.tm_s)
    }

    pub fn response_row(&self, motion: &MotionRow, structure: &Structure, response: Response) -> ResponseRow {
        ResponseRow {
            motion_id: motion.motion_id.clone(),
            suite: motion.suite.clone(),
            structure: structure.clone(),
            outcome: response.outcome.into(),
            edp: response.outcome.demand(),
            impacts: i32::try_from(response.impacts).ok(),
            scenario_id: motion.scenario_id,
            mw: motion.mw,
            re_km: motion.re_km,
            earthquake: motion.earthquake.clone(),
            pga_m_s2: self.peaks.pga_m_s2,
            pgv_m_s: self.peaks.pgv_m_s,
            tp_s: self.tp_s,
            tm_s: self.tm_s,
            measures: self.dimensionless(structure),
        }
    }
}

/// By which share the peaks that a file gives may miss those of the samples.
const PEAK_TOLERANCE: f64 = 0.1;

/// Warnings about a recorded motion of the ground.
pub fn warnings(motion: &MotionRow, record: &Record) -> Warnings {
    let suite = motion.suite.as_deref();
    let known = suite.and_then(|suite| suite.parse::<Suite>().ok());
    if known.is_some_and(|suite| suite != Suite::Record) || Suite::is_floor(suite) {
        return Warnings::default();
    }
    let (samples, dt_s) = (record.acceleration_m_s2(), record.dt_s());
    let implausible = implausibility(samples, dt_s)
        .map(|why| (Warning::ImplausibleRecord, format!("{}: {why}", motion.motion_id)));
    let pgv_m_s = measures::peak(&measures::velocity(samples, dt_s));
    let peaks = [(motion.pga_m_s2, record.peak_m_s2()), (motion.pgv_m_s, pgv_m_s)];
    let is_other = |(given, peak): (Option<f64>, f64)| {
        given.is_some_and(|given| (given - peak).abs() > PEAK_TOLERANCE * peak)
    };
    let other = peaks.into_iter().any(is_other).then(|| (Warning::OtherPeak, motion.motion_id.clone()));
    implausible.into_iter().chain(other).collect()
}
