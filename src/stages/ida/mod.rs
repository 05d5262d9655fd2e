//! ida: every structure under every motion at rising intensity.
//!
//! ```text
//! options  which structures, which intensities
//! measure  what is scaled
//! scaled   all structures under some motions
//! counts   what they come to for each suite and structure
//! ```

mod counts;
mod measure;
mod options;
mod scaled;

use std::path::Path;

use arrow_array::RecordBatch;
use polars::prelude::DataFrame;
use rayon::prelude::*;
use serde_json::{Value, json};

use self::counts::Counts;
pub use self::options::IdaOptions;
use super::shared::motions::{DistinctIds, Judge};
use super::shared::reasons::{Case, Reasons};
use super::shared::structures::{parameters, warn_of_size};
use super::simulate::simd;
use super::synthesize_motions::SynthesizeMotions;
use crate::keyword::Keyword;
use crate::motion::IntensityScratch;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output};
use crate::pipeline::stage::Stage;
use crate::pipeline::stream::{Pool, batches, pipelined};
use crate::pipeline::terminal::Terminal;
use crate::rocking::{Scan, Simd, Structure};
use crate::table::ida::{self, FragilityRow, IDA, IDA_FRAGILITY, IDA_SHARES, IDA_STRIPES, IDA_WINDOWS};
use crate::table::motion_table::{MotionTable, Part};
use crate::table::motions::{self, Motion, MotionId};
use crate::table::schema::Table;
use crate::table::store::frame::read_frame;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::store::writer::TableWriter;

/// Motions that a thread takes at once: enough to keep the lanes of its registers busy while outcomes are bisected.
const CHUNK: usize = 8;

/// The stage, ready to run.
pub struct Ida {
    options: IdaOptions,
    structures: Vec<Structure>,
    simd: Simd,
    scan: Scan,
    input: Source,
    out: Target,
}

/// What came of some motions.
struct Analysed {
    motion_ids: Vec<MotionId>,
    stripes: RecordBatch,
    capacities: RecordBatch,
    windows: RecordBatch,
    counts: Counts,
    doubts: Vec<Case>,
}

impl Ida {
    /// With the motions in `input`, into the file `out` and others beside it.
    ///
    /// # Errors
    /// If an option is out of range, or the structures cannot be read or are impossible.
    pub fn new(
        options: &IdaOptions,
        input: impl Into<Source>,
        out: impl Into<Target>,
    ) -> anyhow::Result<Ida> {
        let (input, out) = (input.into(), out.into());
        let scan = options.scan()?;
        let (structures, simd) = (options.structure.resolve()?, simd(options.simd)?);
        Ok(Ida { options: options.clone(), structures, simd, scan, input, out })
    }

    fn measure(&self) -> &'static str {
        self.options.measure.0.as_str()
    }

    fn analyse(
        &self,
        path: &Path,
        motions: &[Motion],
        by_name: bool,
        judge: &Judge,
        scratch: &mut IntensityScratch,
    ) -> anyhow::Result<Analysed> {
        let (stripes, capacities) = self.stripes_and_capacities(path, motions, scratch)?;
        let doubt = |motion: &Motion| judge.doubt(path, motion, &motion.acceleration_m_s2.to_vec());
        Ok(Analysed {
            doubts: motions.iter().filter_map(doubt).collect(),
            motion_ids: motions.iter().map(|motion| motion.motion_id.clone()).collect(),
            counts: Counts::of(&self.scan, &stripes, &capacities),
            stripes: ida::stripes(&stripes, by_name)?,
            windows: ida::windows(&capacities, by_name)?,
            capacities: ida::capacities(&capacities, by_name)?,
        })
    }
}

impl Declare for Ida {
    type Options = IdaOptions;
    const NAME: &'static str = IDA.stage;
    const ABOUT: &'static str = "Run incremental dynamic analysis: find the lowest intensity at which each motion overturns each structure, \
         and the share of larger ones at which it does";
    const EXAMPLES: &'static str =
        "rockfrag ida --in recorded.parquet --width 0.5 --height 2.0 --measure im5";
    const INPUTS: &'static [Input] =
        &[Input::file("motions", "in", SynthesizeMotions::OUTPUT.file, "Motions to read, as in simulate")];
    const OUTPUT: Output = Output::file(
        "ida.parquet",
        "File of overturning intensities to write; NAME.stripes, NAME.windows, NAME.shares and NAME.fragility are written beside it [default: ida.parquet beside the input]",
    )
    .with_parts(&[IDA_STRIPES.name, IDA_WINDOWS.name, IDA_SHARES.name, IDA_FRAGILITY.name]);
    const SHOWS_TABLE: bool = true;

    fn create(options: &IdaOptions, files: &Files) -> anyhow::Result<Ida> {
        Ida::new(options, files.input("motions")?, files.out(Self::OUTPUT.file)?)
    }
}

impl Stage for Ida {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("motions", self.input.clone())]
    }

    fn targets(&self) -> Vec<Target> {
        Self::OUTPUT.parts.iter().map(|part| self.out.part(part)).chain([self.out.clone()]).collect()
    }

    fn parameters(&self) -> Value {
        let IdaOptions { from, to, steps, halvings, tolerance, .. } = self.options;
        json!({
            "measure": self.measure(), "from": from, "to": to, "steps": steps, "halvings": halvings,
            "tolerance": tolerance, "structures": parameters(&self.structures)
        })
    }

    fn show(&self, _terminal: &Terminal) -> anyhow::Result<String> {
        match self.out.part(IDA_FRAGILITY.name) {
            Target::Path(path) => ida::show(&path),
            Target::Memory(..) => Ok(String::new()),
        }
    }

    fn rows(&self) -> anyhow::Result<Option<DataFrame>> {
        let fragility = self.out.part(IDA_FRAGILITY.name);
        Ok(fragility.path().map(|path| read_frame(path, &IDA_FRAGILITY)).transpose()?)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        warn_of_size(&self.structures, console);
        let file = MotionTable::open(&self.input, None)?;
        let (total, by_name) = (file.rows(), file.ids_are_names());
        let part = |table: &Table| self.out.part(table.name);
        let mut stripes = motions::writer(part(&IDA_STRIPES), &IDA_STRIPES, by_name, provenance)?;
        let mut windows = motions::writer(part(&IDA_WINDOWS), &IDA_WINDOWS, by_name, provenance)?;
        let mut capacities = motions::writer(self.out.clone(), &IDA, by_name, provenance)?;
        let (mut ids, mut counts) = (DistinctIds::default(), Counts::default());
        let (judge, mut doubts) = (Judge::new(file.of_others()), Reasons::default());
        let pool = Pool::new(IntensityScratch::default);
        let bar = console.bar(self.name(), total);
        pipelined(
            batches(file.parts(), rayon::current_num_threads()),
            |parts| {
                let analyse_part = |part: &Part| -> anyhow::Result<Vec<Analysed>> {
                    let path = file.path_of(part);
                    let analyse_chunk = |motions: Vec<Motion>| {
                        let analysed =
                            pool.lend(|scratch| self.analyse(&path, &motions, by_name, &judge, scratch))?;
                        bar.inc(motions.len() as u64)?;
                        Ok(analysed)
                    };
                    let motions = file.chunks(part, CHUNK)?.collect::<Result<Vec<_>, _>>()?;
                    motions.into_par_iter().map(analyse_chunk).collect()
                };
                let analysed: Vec<Vec<Analysed>> =
                    parts.par_iter().map(analyse_part).collect::<anyhow::Result<_>>()?;
                Ok(analysed.into_iter().flatten())
            },
            |analysed| {
                for analysed in analysed {
                    ids.add(self.input.name(), &analysed.motion_ids)?;
                    stripes.append(&analysed.stripes)?;
                    windows.append(&analysed.windows)?;
                    capacities.append(&analysed.capacities)?;
                    counts.append(analysed.counts);
                    analysed.doubts.into_iter().for_each(|case| doubts.add(case));
                }
                Ok(())
            },
        )?;
        let rows = counts.rows(&self.scan);
        let mut shares = TableWriter::create(part(&IDA_SHARES), &IDA_SHARES, provenance.clone())?;
        shares.append(&ida::shares(&rows)?)?;
        let mut fragility = TableWriter::create(part(&IDA_FRAGILITY), &IDA_FRAGILITY, provenance.clone())?;
        fragility.append(&ida::fragility(&rows)?)?;
        [stripes, windows, shares, fragility, capacities].into_iter().try_for_each(TableWriter::finish)?;
        bar.finish();
        doubts.lines("motions").for_each(|line| console.warn(&line));
        console.warn_of_many(rows.iter().filter_map(no_median));
        Ok(format!(
            "{total} motions and {} structure(s) at {} levels in ratios of {:.4}, of {:.4} where they rock",
            self.structures.len(),
            self.scan.levels().len(),
            self.scan.ratio(),
            self.scan.finest_ratio()
        ))
    }
}

/// What to do where too few motions overturn a structure for a median, for a message.
fn no_median(row: &FragilityRow) -> Option<(String, String)> {
    let FragilityRow { suite, structure, n, n_safe, fit, .. } = row;
    let is_strong = fit.is_err() && 2 * n_safe >= *n;
    let suite = suite.as_deref().unwrap_or("the motions");
    is_strong.then(|| {
        let why =
            "too few motions overturn a structure for a median: take a larger --to, or another --measure";
        (why.to_string(), format!("{structure}, {suite} ({n_safe} of {n} do not)"))
    })
}
