//! import-motions: recorded ground motions from files of many formats, as motions that simulate reads.
//!
//! ```text
//! options  which files, how they are read, what is done to them
//! inputs   files to records, and what is wrong with those that cannot be read
//! work     files or pairs in groups that are processed at once
//! told     what is said of all that
//! ```

mod inputs;
mod options;
mod told;
mod work;

use std::collections::{BTreeMap, HashSet};
use std::io;
use std::path::Path;

use anyhow::bail;
use rayon::prelude::*;
use serde_json::{Value, json};

use self::inputs::{Names, Reading};
pub use self::options::ImportMotionsOptions;
use self::told::{Told, summary};
use self::work::{Importer, Plan};
use crate::keyword::Keyword;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Output};
use crate::pipeline::files::{content_of_all, expand};
use crate::pipeline::options::Word;
use crate::pipeline::stage::Stage;
use crate::pipeline::stream::{Pool, pipelined};
use crate::records::processing::{Implausible, Processing, Refusal, Scratch};
use crate::records::signal::Scaling;
use crate::table::records::{self, RECORDS};
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::store::writer::TableWriter;

/// Motions in a row group.
const ROW_GROUP: usize = 64;

/// The stage, ready to run.
pub struct ImportMotions {
    importer: Importer,
    keep_going: bool,
    out: Target,
}

impl ImportMotions {
    /// Creates the stage: reads the files of `options`, writes motions to `out`.
    ///
    /// # Errors
    /// If an option is out of range, or no file is named.
    pub fn new(options: &ImportMotionsOptions, out: impl Into<Target>) -> anyhow::Result<ImportMotions> {
        let out = out.into();
        let mut files = expand(&options.files);
        // What an earlier run wrote into a folder of records is no record.
        let absolute = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        files.retain(|file| out.path().is_none_or(|out| absolute(file) != absolute(out)));
        if files.is_empty() {
            return Err(UsageError::because("no files; expected files or folders of records"));
        }
        Ok(ImportMotions {
            importer: Importer {
                names: Names::of(&files),
                files,
                reading: options.reading()?,
                processing: options.processing()?,
            },
            keep_going: options.keep_going,
            out,
        })
    }
}

impl ImportMotions {
    /// The error of refused files: of a file that is not there, if one is not.
    fn failed(&self, why: String) -> anyhow::Error {
        match self.importer.files.iter().all(|file| file.exists()) {
            true => anyhow::Error::msg(why),
            false => io::Error::new(io::ErrorKind::NotFound, why).into(),
        }
    }

    /// Checks that the files still hold what they held before they were read.
    fn expect_unchanged(&self, planned: &Provenance) -> anyhow::Result<()> {
        let now = self.provenance()?.inputs;
        if planned.inputs.iter().any(|(role, content)| now.get(role) != Some(content)) {
            bail!("the files changed while they were read; run again");
        }
        Ok(())
    }
}

impl Declare for ImportMotions {
    type Options = ImportMotionsOptions;
    const NAME: &'static str = RECORDS.stage;
    const ABOUT: &'static str =
        "Import recorded ground motions from the files of strong-motion networks, CSV or Parquet";
    const EXAMPLES: &'static str = "rockfrag import-motions records --out recorded.parquet\n\
        rockfrag import-motions records --out scaled.parquet --baseline linear --scale 0.5,1,2";
    const OUTPUT: Output =
        Output::file("motions.parquet", "Motions file to write [default: motions.parquet]");

    fn create(options: &ImportMotionsOptions, files: &Files) -> anyhow::Result<ImportMotions> {
        ImportMotions::new(options, files.out(Self::OUTPUT.file)?)
    }
}

impl Stage for ImportMotions {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        self.importer.files.iter().map(|file| ("files", file.into())).collect()
    }

    fn targets(&self) -> Vec<Target> {
        vec![self.out.clone()]
    }

    fn parameters(&self) -> Value {
        let Reading { format, given, pga_tolerance } = &self.importer.reading;
        let Processing {
            baseline,
            high_pass,
            resample_s,
            direction,
            scaling,
            pulses,
            residual,
            implausible,
            plan,
        } = &self.importer.processing;
        let scaling = match scaling {
            Scaling::Factors(factors) => json!({ "factors": factors }),
            Scaling::Pga(target) => json!({ "pga_m_s2": target }),
            Scaling::Pgv(target) => json!({ "pgv_m_s": target }),
        };
        json!({
            "format": format.map_or("auto", Keyword::as_str), "dt": given.dt_s,
            "unit": given.unit.map(|unit| unit.to_string()),
            "column": given.column.as_ref().map(ToString::to_string),
            "pga-tolerance": pga_tolerance, "baseline": Word(*baseline),
            "high-pass": high_pass.map(|filter| filter.corner_hz), "resample": resample_s,
            "rotate": direction.map(|direction| direction.to_string()), "scale": scaling,
            "pulses": Word(*pulses), "residual": residual, "housner": plan.housner, "sa": plan.sa_periods_s,
            "accept-implausible": *implausible == Implausible::Accept, "keep-going": self.keep_going,
        })
    }

    fn provenance(&self) -> anyhow::Result<Provenance> {
        let inputs = BTreeMap::from([("files".to_string(), content_of_all(&self.importer.files))]);
        Ok(Provenance::new(self.name(), self.parameters(), inputs))
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let schema = RECORDS.schema_with_spectrum(&self.importer.processing.plan.sa_periods_s);
        let mut writer =
            TableWriter::with_schema(self.out.clone(), &RECORDS, schema.clone(), provenance.clone())?;
        let pool = Pool::new(Scratch::default);
        let Plan { work, mut refused } = self.importer.plan(console);
        let bar = console.bar(self.name(), self.importer.files.len() as u64);
        let (mut seen, mut told) = (HashSet::new(), Told::default());
        pipelined(
            work.map(Ok),
            |work| {
                bar.inc(work.len() as u64)?;
                Ok(work
                    .into_par_iter()
                    .flat_map_iter(|work| self.importer.import(work, &pool))
                    .collect::<Vec<_>>())
            },
            |results| {
                let mut rows = Vec::new();
                for result in results {
                    match result {
                        Ok(imported) => {
                            told.add(&imported);
                            rows.extend(imported);
                        }
                        Err(refusal) => refused.push(refusal),
                    }
                }
                if let Some(row) = rows.iter().find(|row| !seen.insert(row.motion_id.clone())) {
                    bail!("{}: two motions are called '{}'; rename the file", row.source.path, row.motion_id);
                }
                rows.chunks(ROW_GROUP)
                    .try_for_each(|rows| Ok(writer.write_row_group(&records::batch(rows, &schema)?)?))
            },
        )?;
        bar.finish();
        if seen.is_empty() && refused.is_empty() {
            bail!("no motion is imported of {} files", self.importer.files.len());
        }
        if seen.is_empty() {
            let refused = summary(&refused, self.importer.files.len());
            return Err(self.failed(format!("no motion is imported; {refused}")));
        }
        self.expect_unchanged(provenance)?;
        told.lines().iter().for_each(|line| console.note(line));
        told.doubts.lines("motions").chain(told.same_files()).for_each(|doubt| console.warn(&doubt));
        if refused.is_empty() || self.keep_going {
            writer.finish()?;
            if !refused.is_empty() {
                console.warn(&summary(&refused, self.importer.files.len()));
            }
            return Ok(format!("{} motions of {} files", seen.len(), self.importer.files.len()));
        }
        writer.made_otherwise(incomplete(provenance, &refused));
        writer.finish()?;
        let others = match self.out.path() {
            Some(_) => "are imported; with --keep-going the command succeeds anyway",
            None => "come with --keep-going",
        };
        let refused = summary(&refused, self.importer.files.len());
        Err(self.failed(format!("{refused}\n{} motions of the others {others}", seen.len())))
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
