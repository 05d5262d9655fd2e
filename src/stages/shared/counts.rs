//! Annual rates counted among responses, and the responses that fits were made from.

use std::path::PathBuf;

use super::groups::Group;
use crate::fragility::{Event, Peak, Placed};
use crate::hazard::{Count, CountedMotion, HazardCurve, counted_rates};
use crate::pipeline::declare::Declare;
use crate::pipeline::options::DEFAULT_SEED;
use crate::pipeline::stage::folder_of;
use crate::stages::simulate::Simulate;
use crate::studies::MOST_CASES;
use crate::table::responses::RESPONSES;
use crate::table::store::contents::recorded;
use crate::table::store::folder::parquet_files;
use crate::table::store::source::Source;

/// The events whose rates are counted.
pub const COUNTED: [Event; 2] = [Event::Failure, Event::Overturning];
/// The role of responses among the inputs of fits.
pub const RESPONSES_ROLE: &str = "responses";
/// Files beside fits that are looked at, at most.
const MOST_FILES: usize = 200;

/// The responses that fits were made from, if a file beside them holds these.
pub fn responses_beside(fits: &Source) -> Option<PathBuf> {
    let Source::Path(fits) = fits else { return None };
    let made_of = recorded(fits).ok()??.provenance.inputs.remove(RESPONSES_ROLE)?;
    let files = parquet_files(folder_of(fits)).ok()?;
    let usual = fits.with_file_name(Simulate::OUTPUT.file);
    let holds = |file: &PathBuf| {
        let recorded = recorded(file).ok().flatten();
        recorded.is_some_and(|it| it.content == made_of && it.provenance.stage == RESPONSES.stage)
    };
    std::iter::once(usual).chain(files.into_iter().take(MOST_FILES)).find(holds)
}

/// Whether each of [`COUNTED`] happened in a case.
pub fn happened(case: &Placed, limit: f64) -> [f64; 2] {
    COUNTED.map(|event| f64::from(u8::from(event.happened(&case.case, limit) == Some(true))))
}

/// Counts the annual rates of what `events` tells of each response of a group, whose motions are weighted so that the peak has the
/// hazard's rates. None without responses, or where `events` tells nothing of one.
pub fn count<const N: usize>(
    group: &Group,
    peak: Peak,
    curve: &HazardCurve,
    events: impl Fn(&Placed) -> Option<[f64; N]>,
) -> Option<Count<N>> {
    let structure = group.structure_of();
    let of_case = |placed: &Placed| {
        let structure = structure(placed.row);
        let uplift_m_s2 = structure.uplift_acceleration_m_s2();
        let measures = &placed.case.measures;
        let intensity = match peak {
            Peak::Pga => measures.im4 * uplift_m_s2,
            Peak::Pgv => measures.im5 * uplift_m_s2 / structure.p_rad_s,
        };
        Some(CountedMotion { intensity, events: events(placed)?, cluster: placed.cluster })
    };
    let cases = group.cases.spread(MOST_CASES);
    let motions = cases.iter().map(of_case).collect::<Option<Vec<_>>>()?;
    // Below uplift nothing happens, and the bins need not hold such motions.
    let uplift =
        group.block().filter(|_| peak == Peak::Pga).map(|_| group.structure().uplift_acceleration_m_s2());
    let least = || motions.iter().map(|motion| motion.intensity).fold(f64::INFINITY, f64::min);
    let least = uplift.unwrap_or_else(least);
    counted_rates(curve, least, motions, DEFAULT_SEED)
}
