//! ida: every structure under every motion at rising intensity.
//!
//! ```text
//! options  which structures, which intensities
//! measure  what is scaled
//! scaled   the looks at some motions
//! tally    what they come to for each suite and structure
//! ```

mod measure;
mod options;
mod scaled;
mod tally;

use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use rayon::prelude::*;
use serde_json::{Value, json};

pub use self::options::IdaOptions;
use self::tally::Tally;
use super::motions::SeenIds;
use super::structures::parameters;
use crate::keyword::Keyword;
use crate::motion::IntensityScratch;
use crate::pipeline::console::Console;
use crate::pipeline::stage::Stage;
use crate::pipeline::stream::{Pool, batches, pipelined};
use crate::rocking::{Path as SolverPath, Scan, Structure};
use crate::table::ida::{self, IDA, IDA_FRAGILITY, IDA_SHARES, IDA_STRIPES, IDA_WINDOWS};
use crate::table::motion_table::{MotionTable, Part};
use crate::table::motions::{self, Motion, MotionId};
use crate::table::provenance::Provenance;
use crate::table::source::{Source, Target, with_part};
use crate::table::writer::TableWriter;

/// Motions that a thread takes at once: enough to keep the lanes of its registers busy while outcomes are bisected.
const CHUNK: usize = 8;

/// The stage, ready to run.
pub struct Ida {
    options: IdaOptions,
    structures: Vec<Structure>,
    path: SolverPath,
    scan: Scan,
    input: PathBuf,
    out: PathBuf,
}

/// What came of some motions.
struct Analysed {
    motion_ids: Vec<MotionId>,
    stripes: RecordBatch,
    capacities: RecordBatch,
    windows: RecordBatch,
    tally: Tally,
}

impl Ida {
    /// With the motions in `input`, into the file `out` and others beside it.
    ///
    /// # Errors
    /// If an option is out of range, or the structures cannot be read or are impossible.
    pub fn new(options: &IdaOptions, input: PathBuf, out: PathBuf) -> anyhow::Result<Ida> {
        let scan = options.scan()?;
        let (structures, path) = options.structures()?;
        Ok(Ida { options: options.clone(), structures, path, scan, input, out })
    }

    /// The file of fragility beside the file of capacities `out`.
    pub fn fragility_path(out: &Path) -> PathBuf {
        with_part(out, IDA_FRAGILITY.name)
    }

    fn measure(&self) -> &'static str {
        self.options.measure.0.as_str()
    }

    fn analyse(
        &self,
        path: &Path,
        motions: &[Motion],
        by_name: bool,
        scratch: &mut IntensityScratch,
    ) -> anyhow::Result<Analysed> {
        let (stripes, capacities) = self.looks(path, motions, scratch)?;
        Ok(Analysed {
            motion_ids: motions.iter().map(|motion| motion.motion_id.clone()).collect(),
            tally: Tally::of(&self.scan, &stripes, &capacities),
            stripes: ida::stripes(&stripes, by_name)?,
            windows: ida::windows(&capacities, by_name)?,
            capacities: ida::capacities(&capacities, self.scan.top(), by_name)?,
        })
    }
}

impl Stage for Ida {
    fn subcommand(&self) -> &'static str {
        IDA.stage
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("motions", (&self.input).into())]
    }

    fn targets(&self) -> Vec<Target> {
        let beside = [IDA_STRIPES, IDA_WINDOWS, IDA_SHARES, IDA_FRAGILITY];
        let beside = beside.iter().map(|table| with_part(&self.out, table.name).into());
        beside.chain([(&self.out).into()]).collect()
    }

    fn parameters(&self) -> Value {
        let IdaOptions { from, to, steps, halvings, tolerance, .. } = self.options;
        json!({
            "measure": self.measure(), "from": from, "to": to, "steps": steps, "halvings": halvings,
            "tolerance": tolerance, "structures": parameters(&self.structures), "path": self.path.arithmetic()
        })
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let file = MotionTable::open(&self.input, None)?;
        let (total, by_name) = (file.rows(), file.ids_are_names());
        let paths = self.outputs();
        let [stripes_path, windows_path, shares_path, fragility_path, out] = &paths[..] else {
            unreachable!("five files")
        };
        let mut stripes = motions::writer(stripes_path, &IDA_STRIPES, by_name, provenance)?;
        let mut windows = motions::writer(windows_path, &IDA_WINDOWS, by_name, provenance)?;
        let mut capacities = motions::writer(out, &IDA, by_name, provenance)?;
        let (mut seen, mut tally) = (SeenIds::default(), Tally::default());
        let pool = Pool::new(IntensityScratch::default);
        let bar = console.bar(self.subcommand(), total);
        pipelined(
            batches(file.parts(), rayon::current_num_threads()),
            |parts| {
                let analyse = |part: &Part| -> anyhow::Result<Vec<Analysed>> {
                    let path = file.path_of(part);
                    let analyse = |motions: Vec<Motion>| {
                        let analysed =
                            pool.lend(|scratch| self.analyse(&path, &motions, by_name, scratch))?;
                        bar.inc(motions.len() as u64)?;
                        Ok(analysed)
                    };
                    let motions = file.chunks(part, CHUNK)?.collect::<Result<Vec<_>, _>>()?;
                    motions.into_par_iter().map(analyse).collect()
                };
                let analysed: Vec<Vec<Analysed>> =
                    parts.par_iter().map(analyse).collect::<anyhow::Result<_>>()?;
                Ok(analysed.into_iter().flatten())
            },
            |analysed| {
                for analysed in analysed {
                    seen.note(&self.input, &analysed.motion_ids)?;
                    stripes.append(&analysed.stripes)?;
                    windows.append(&analysed.windows)?;
                    capacities.append(&analysed.capacities)?;
                    tally.append(analysed.tally);
                }
                Ok(())
            },
        )?;
        let rows = tally.rows(&self.scan);
        let mut shares = TableWriter::create(shares_path, &IDA_SHARES, provenance.clone())?;
        shares.append(&ida::shares(&rows)?)?;
        let mut fragility = TableWriter::create(fragility_path, &IDA_FRAGILITY, provenance.clone())?;
        fragility.append(&ida::fragility(&rows)?)?;
        [stripes, windows, shares, fragility, capacities].into_iter().try_for_each(TableWriter::finish)?;
        bar.finish();
        Ok(format!(
            "{total} motions and {} structure(s) at {} levels in ratios of {:.4}, of {:.4} near overturning",
            self.structures.len(),
            self.scan.levels().len(),
            self.scan.ratio(),
            self.scan.finest_ratio()
        ))
    }
}
