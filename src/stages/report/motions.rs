use std::path::Path;

use rayon::prelude::*;

use crate::keyword::Keyword;
use crate::motion::Suite;
use crate::report::data::{Group, Motion, Parts, Trace, most_telling};
use crate::report::number;
use crate::rocking::{Record, Structure, trace};
use crate::table::TableError;
use crate::table::motion_table::MotionTable;
use crate::table::motions;

/// The structures of the groups, each once.
pub fn structures(groups: &[Group]) -> Vec<Structure> {
    let mut structures: Vec<Structure> = Vec::new();
    for group in groups {
        if !structures.contains(&group.structure) {
            structures.push(group.structure.clone());
        }
    }
    structures
}

/// So many motions from all over the file, and one in its parts.
pub fn read(
    path: &Path,
    structures: &[Structure],
    count: usize,
) -> anyhow::Result<(Vec<Motion>, Option<Parts>)> {
    let file = MotionTable::open(path, None)?;
    let rows = file.rows();
    let count = rows.min(count as u64);
    let wanted: Vec<u64> = (0..count).map(|k| ((2 * k + 1) * rows) / (2 * count)).collect();
    let runs = file.runs_of(&wanted);
    let picked = runs.par_iter().map(|(run, rows)| file.pick(*run, |motion| rows.contains(&motion.row)));
    let picked = picked.collect::<Result<Vec<Vec<motions::Motion>>, TableError>>()?;
    let shown: Vec<Motion> =
        picked.into_par_iter().flatten().map(|motion| shown(&motion, structures)).collect();
    let parts = parts(&file, rows / 2)?.or_else(|| most_telling(&shown).map(|index| whole(&shown[index])));
    Ok((shown, parts))
}

/// A motion of which no parts are known.
fn whole(motion: &Motion) -> Parts {
    let demand = motion.traces.first().zip(motion.demand()).map(|(trace, demand)| {
        format!(
            ", in which {} rocks to {} of α: of the motions shown, the nearest to overturning that does not",
            trace.structure,
            number::short(demand)
        )
    });
    Parts {
        words: format!("motion {}{}{}", motion.name, motion.words, demand.unwrap_or_default()),
        dt_s: motion.dt_s,
        pulse_m_s2: None,
        whole_m_s2: motion.acceleration_m_s2.clone(),
    }
}

fn shown(motion: &motions::Motion, structures: &[Structure]) -> Motion {
    let acceleration = motion.acceleration_m_s2.to_vec();
    let traced = |structure: &Structure| {
        let record = Record::new(&acceleration, motion.dt_s).ok()?;
        let (response, points) = trace(structure, &record);
        Some(Trace {
            structure: structure.name.clone(),
            alpha_rad: structure.alpha_rad,
            outcome: response.outcome,
            points,
        })
    };
    Motion {
        name: name(motion),
        words: words(motion),
        dt_s: motion.dt_s,
        traces: structures.iter().filter_map(traced).collect(),
        acceleration_m_s2: acceleration,
    }
}

/// The first motion from this row on that has its pulse in the same row group.
fn parts(file: &MotionTable, row: u64) -> Result<Option<Parts>, TableError> {
    let Some((run, rows)) = file.runs_of(&[row]).pop() else { return Ok(None) };
    let (motions, row) = (file.pick(run, |_| true)?, rows[0]);
    let is = |motion: &motions::Motion, suite: Suite| motion.suite.as_deref() == Some(suite.as_str());
    let earthquake = |motion: &motions::Motion| [motion.mw, motion.re_km, motion.tp_s];
    let pulse_of = |whole: &motions::Motion| {
        let mut pulses = motions.iter().filter(|motion| is(motion, Suite::Pulse));
        pulses.find(|pulse| earthquake(pulse) == earthquake(whole))
    };
    let mut combined = motions.iter().filter(|motion| motion.row >= row && is(motion, Suite::Csgm));
    let pair = combined.find_map(|whole| Some((whole, pulse_of(whole)?)));
    Ok(pair.map(|(whole, pulse)| Parts {
        words: format!("motion {}{}", name(whole), words(whole)),
        dt_s: whole.dt_s,
        pulse_m_s2: Some(pulse.acceleration_m_s2.to_vec()),
        whole_m_s2: whole.acceleration_m_s2.to_vec(),
    }))
}

fn name(motion: &motions::Motion) -> String {
    match &motion.suite {
        Some(suite) => format!("{} ({suite})", motion.motion_id),
        None => motion.motion_id.to_string(),
    }
}

/// What is known of a motion, each part after a comma.
fn words(motion: &motions::Motion) -> String {
    let known = [
        motion.mw.map(|mw| format!("Mw {mw}")),
        motion.re_km.map(|re_km| format!("{re_km} km")),
        motion.tp_s.map(|tp_s| format!("Tp {tp_s:.2} s")),
        motion.pga_m_s2.map(|pga| format!("PGA {pga:.2} m/s²")),
        motion.pgv_m_s.map(|pgv| format!("PGV {pgv:.2} m/s")),
    ];
    known.into_iter().flatten().map(|part| format!(", {part}")).collect()
}
