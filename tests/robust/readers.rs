//! Everything that reads a Parquet file, whatever is in it.

use std::path::Path;

use rockfrag::pipeline::terminal::Terminal;
use rockfrag::rocking::Record;
use rockfrag::stages::inspect::inspect;
use rockfrag::stages::rank_ims::verdict as ranking_verdict;
use rockfrag::stages::shared::groups;
use rockfrag::table::intensities::IntensityBatches;
use rockfrag::table::motion_measures::MotionMeasures;
use rockfrag::table::motion_table::MotionTable;
use rockfrag::table::motions::{Motion, MotionBatches};
use rockfrag::table::pex::PexRow;
use rockfrag::table::pro::ProRow;
use rockfrag::table::row::ReadRow;
use rockfrag::table::schema::headings::Headings;
use rockfrag::table::store::{contents, reader};
use rockfrag::table::universality::{PooledRow, UniversalityRow};
use rockfrag::table::{TableError, ida, paper, scenarios, validation};

/// Reads a file as each stage would, and gives what each made of it.
pub fn read_as_everything(path: &Path) -> Vec<(&'static str, Result<(), String>)> {
    vec![
        ("recorded", words(contents::recorded(path))),
        ("content", words(contents::content_of(path))),
        ("inspect", words(inspect(path, None).map(|shown| shown.text(&Terminal::PLAIN)))),
        ("inspect --head", words(inspect(path, Some(3)).map(|shown| shown.text(&Terminal::PLAIN)))),
        ("scenarios", words(scenarios::read(path))),
        ("motions", words(motions(path))),
        ("motions in parts", words(motions_in_parts(path))),
        ("measures of motions", words(MotionMeasures::read(path, &[]))),
        ("responses", words(groups::read(path))),
        ("regressions", words(regressions(path))),
        ("curves", words(curves(path))),
        ("intensities", words(intensities(path))),
        ("comparison", words(paper::show(path))),
        ("validation", words(validation::show(path))),
        ("capacities", words(ida::show(path))),
        ("ranking", words(ranking_verdict::show(path))),
        ("universality", words(UniversalityRow::read(path))),
        ("pooled curves", words(PooledRow::read(path))),
        ("any table", words(reader::read_any(path, |_| true))),
    ]
}

fn words<T, E: Into<anyhow::Error>>(result: Result<T, E>) -> Result<(), String> {
    result.map(drop).map_err(|error| format!("{:#}", error.into()))
}

fn check(motions: &[Motion]) {
    for motion in motions {
        // What cannot be simulated is refused there.
        let _ = Record::new(&motion.acceleration_m_s2.to_vec(), motion.dt_s);
    }
}

fn motions(path: &Path) -> Result<(), TableError> {
    MotionBatches::open(path, 64)?.try_for_each(|motions| motions.map(|motions| check(&motions)))
}

fn motions_in_parts(path: &Path) -> Result<(), TableError> {
    let file = MotionTable::open(path, None)?;
    file.parts().try_for_each(|part| {
        file.chunks(&part?, 64)?.try_for_each(|motions| motions.map(|motions| check(&motions)))
    })
}

fn regressions(path: &Path) -> anyhow::Result<()> {
    let ok = PexRow::read(path)?;
    ok.iter().filter(|row| row.is_ok()).try_for_each(|row| Ok(row.demand().map(drop)?))
}

fn curves(path: &Path) -> anyhow::Result<()> {
    let ok = ProRow::read(path)?;
    ok.iter().filter(|row| row.is_ok()).try_for_each(|row| Ok(row.probit().map(drop)?))
}

fn intensities(path: &Path) -> Result<(), TableError> {
    IntensityBatches::open(path, &Headings::default(), None, Some(0.92), 4096)?
        .try_for_each(|batch| batch.map(drop))
}
