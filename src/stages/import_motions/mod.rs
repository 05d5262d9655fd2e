//! import-motions: recorded ground motions from files of many formats, as motions that simulate reads.
//!
//! ```text
//! options  which files, and how they are read
//! inputs   files to records, and what is wrong with those that cannot be read
//! ```

mod inputs;
mod options;

use std::collections::{BTreeMap, HashSet};
use std::path::PathBuf;

use anyhow::bail;
use rayon::prelude::*;
use serde_json::{Value, json};

use self::inputs::{Found, Names, Refusal, groups, motions};
pub use self::options::ImportMotionsOptions;
use self::options::Reading;
use crate::keyword::Keyword;
use crate::motion::{IntensityScratch, MeasurePlan, Suite};
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::files::{content_of_all, expand};
use crate::pipeline::stage::Stage;
use crate::pipeline::stream::{Pool, pipelined};
use crate::table::TableError;
use crate::table::provenance::Provenance;
use crate::table::records::{self, RecordRow};
use crate::table::schema::RECORDS;
use crate::table::writer::TableWriter;

/// The stage, ready to run.
pub struct ImportMotions {
    files: Vec<PathBuf>,
    reading: Reading,
    plan: MeasurePlan,
    keep_going: bool,
    out: PathBuf,
}

impl ImportMotions {
    /// Into the file `out`.
    ///
    /// # Errors
    /// If an option is out of range, or no file is named.
    pub fn new(options: &ImportMotionsOptions, out: PathBuf) -> anyhow::Result<ImportMotions> {
        let files = expand(&options.files);
        if files.is_empty() {
            return Err(UsageError::because("no files; expected files or folders of records"));
        }
        let (reading, plan) = (options.reading()?, MeasurePlan::default());
        Ok(ImportMotions { files, reading, plan, keep_going: options.keep_going, out })
    }

    fn row(&self, found: Found, scratch: &mut IntensityScratch) -> RecordRow {
        let Found { motion_id, source, motion } = found;
        let acceleration_m_s2: Vec<f32> = motion.acceleration_m_s2.iter().map(|&a| a as f32).collect();
        // Measured as it will be read.
        let written: Vec<f64> = acceleration_m_s2.iter().map(|&a| f64::from(a)).collect();
        RecordRow {
            motion_id,
            suite: Suite::Record,
            event: motion.event,
            station: motion.station,
            component: motion.component,
            azimuth_deg: motion.azimuth_deg,
            source,
            scale: 1.0,
            dt_s: motion.dt_s,
            measured: self.plan.measure(&written, motion.dt_s, scratch),
            acceleration_m_s2,
        }
    }

    /// What is said of the files that are refused.
    fn summary(&self, refused: &[Refusal]) -> String {
        let lines: Vec<String> =
            refused.iter().map(|refusal| format!("\n  {}: {}", refusal.file, refusal.reason)).collect();
        format!("{} of {} files refused:{}", refused.len(), self.files.len(), lines.concat())
    }
}

impl Stage for ImportMotions {
    fn subcommand(&self) -> &'static str {
        RECORDS.stage
    }

    fn inputs(&self) -> Vec<(&'static str, PathBuf)> {
        self.files.iter().map(|file| ("files", file.clone())).collect()
    }

    fn outputs(&self) -> Vec<PathBuf> {
        vec![self.out.clone()]
    }

    fn parameters(&self) -> Value {
        let Reading { format, given, pga_tolerance } = &self.reading;
        json!({
            "format": format.map_or("auto", Keyword::as_str), "dt": given.dt_s,
            "unit": given.unit.map(|unit| unit.to_string()),
            "column": given.column.as_ref().map(ToString::to_string),
            "pga-tolerance": pga_tolerance, "keep-going": self.keep_going,
        })
    }

    fn provenance(&self) -> Result<Provenance, TableError> {
        let inputs = BTreeMap::from([("files".to_string(), content_of_all(&self.files))]);
        Ok(Provenance::new(self.subcommand(), self.parameters(), inputs))
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let mut writer = TableWriter::create(&self.out, &RECORDS, provenance.clone())?;
        let names = Names::of(&self.files);
        let pool = Pool::new(IntensityScratch::default);
        let bar = console.bar(self.subcommand(), self.files.len() as u64);
        let mut refused: Vec<Refusal> = Vec::new();
        let mut seen = HashSet::new();
        pipelined(
            groups(&self.files).map(Ok),
            |inputs| {
                bar.inc(inputs.len() as u64);
                let rows = |input| {
                    let found = motions(input, &names, &self.reading)?;
                    Ok(found.into_iter().map(|found| pool.lend(|s| self.row(found, s))).collect::<Vec<_>>())
                };
                Ok(inputs.into_par_iter().map(rows).collect::<Vec<Result<Vec<RecordRow>, Refusal>>>())
            },
            |results| {
                let mut rows = Vec::new();
                for result in results {
                    match result {
                        Ok(imported) => rows.extend(imported),
                        Err(refusal) => refused.push(refusal),
                    }
                }
                if let Some(row) = rows.iter().find(|row| !seen.insert(row.motion_id.clone())) {
                    bail!("{}: two motions are called '{}'; rename the file", row.source.file, row.motion_id);
                }
                if rows.is_empty() { Ok(()) } else { Ok(writer.write_row_group(&records::batch(&rows)?)?) }
            },
        )?;
        bar.finish_and_clear();
        if seen.is_empty() {
            bail!("no motion is imported; {}", self.summary(&refused));
        }
        if refused.is_empty() || self.keep_going {
            writer.finish()?;
            if !refused.is_empty() {
                console.note(&format!("warning: {}", self.summary(&refused)));
            }
            return Ok(format!("{} motions of {} files", seen.len(), self.files.len()));
        }
        writer.made_otherwise(incomplete(provenance, &refused));
        writer.finish()?;
        bail!(
            "{}\n{} motions of the others are imported; with --keep-going this is no failure",
            self.summary(&refused),
            seen.len()
        )
    }
}

/// The provenance of a file that lacks what was refused: it is made again as long as that is so.
fn incomplete(provenance: &Provenance, refused: &[Refusal]) -> Provenance {
    let mut provenance = provenance.clone();
    if let Value::Object(parameters) = &mut provenance.parameters {
        let files: Vec<&str> = refused.iter().map(|refusal| refusal.file.as_str()).collect();
        parameters.insert("refused".to_string(), json!(files));
    }
    provenance
}
