//! Output, progress and warnings of a running stage.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use arrow_schema::SchemaRef;
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::keyword::keywords;
use crate::table::TableError;
use crate::table::keys::key_of;
use crate::table::provenance::Provenance;
use crate::table::rows::{self, Row};
use crate::table::writer::TableWriter;
use crate::warning::Warnings;

/// Help heading of the common options.
pub const COMMON: &str = "Common options";

// Options of all stages. A doc comment would replace the description of every stage.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = COMMON)]
pub struct Common {
    /// Pipeline file whose section gives further options
    #[arg(long, value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Run even if up to date; replace files of other programs
    #[arg(long)]
    pub force: bool,
    /// Threads [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=4096))]
    pub threads: Option<u64>,
    /// Print only the result
    #[arg(long)]
    pub quiet: bool,
    /// Progress bars: auto or never
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub progress: Bars,
}

keywords! {
    /// When to draw progress bars: if stderr is a terminal, or never.
    #[derive(Default)]
    pub enum Bars {
        #[default]
        Auto = "auto",
        Never = "never",
    }
}

/// What another program sees of the progress of a stage, and how it stops the stage.
#[derive(Default)]
pub struct Observed {
    pub done: AtomicU64,
    pub total: AtomicU64,
    pub stop: AtomicBool,
}

/// The context of a running stage.
#[derive(Clone, Default)]
pub struct Context {
    /// Run even if up to date; replace files of other programs.
    pub force: bool,
    /// Print only the result.
    pub quiet: bool,
    /// Draw progress bars if stderr is a terminal.
    pub progress: bool,
    pub observed: Arc<Observed>,
    /// Provenance of the files of the stage.
    pub made: Provenance,
    /// Input files and their keys.
    inputs: Vec<(PathBuf, String)>,
    warnings: Arc<Mutex<Warnings>>,
}

impl Context {
    /// Makes the context of a command line.
    pub fn new(common: &Common) -> Context {
        let progress = common.progress == Bars::Auto && !common.quiet;
        Context { force: common.force, quiet: common.quiet, progress, ..Context::default() }
    }

    /// Returns the context of a call that reads these files and makes files of this provenance.
    pub fn of_call<'a>(&self, inputs: impl Iterator<Item = &'a PathBuf>, made: Provenance) -> Context {
        let keys = made.inputs.values().flat_map(|keys| keys.split(' '));
        let files = inputs.cloned().zip(keys.map(str::to_string));
        let inputs = files.filter(|(path, _)| path.exists()).collect();
        Context { made, inputs, warnings: Arc::default(), ..self.clone() }
    }

    /// Adds warnings.
    pub fn warn(&self, warnings: Warnings) {
        if let Ok(mut all) = self.warnings.lock() {
            all.extend(warnings);
        }
    }

    /// Returns all warnings so far.
    pub fn warnings(&self) -> Warnings {
        self.warnings.lock().map(|all| all.clone()).unwrap_or_default()
    }

    /// Begins a table.
    pub fn create(&self, path: &Path, schema: &SchemaRef) -> Result<TableWriter, TableError> {
        TableWriter::create(path, schema)
    }

    /// Ends a table with provenance, printed summary and warnings. A changed input is an error.
    pub fn finish(&self, writer: TableWriter, summary: &str) -> Result<(), TableError> {
        writer.finish(&self.provenance(summary)?)
    }

    /// Returns the provenance of a finished file.
    ///
    /// # Errors
    /// If an input has changed since it was read.
    pub fn provenance(&self, summary: &str) -> Result<Provenance, TableError> {
        for (path, key) in &self.inputs {
            if key_of(path)? != *key {
                return Err(TableError::table(path, "changed by another run; run again"));
            }
        }
        Ok(Provenance { summary: summary.to_string(), warnings: self.warnings(), ..self.made.clone() })
    }

    /// Writes a table of rows.
    pub fn write<R: Row>(&self, path: &Path, rows: &[R], summary: &str) -> anyhow::Result<()> {
        let mut writer = self.create(path, &rows::schema::<R>())?;
        writer.append(&rows::batch(rows)?)?;
        Ok(self.finish(writer, summary)?)
    }

    /// Begins progress over `total` steps.
    pub fn bar(&self, total: u64) -> Progress {
        self.observed.total.fetch_add(total, Ordering::Relaxed);
        let is_seen = self.progress && std::io::stderr().is_terminal();
        let target = if is_seen { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(total), target).with_message(self.made.stage.clone());
        let style = ProgressStyle::with_template("{msg:20} {bar:40} {human_pos}/{human_len}  {eta} left");
        let bar = style.map_or(bar.clone(), |style| bar.with_style(style));
        Progress { bar, observed: self.observed.clone() }
    }
}

/// Progress of a stage; dropping it clears the bar.
pub struct Progress {
    bar: ProgressBar,
    observed: Arc<Observed>,
}

impl Progress {
    /// Ends a number of steps; an error if another program stops the stage.
    pub fn advance(&self, steps: u64) -> anyhow::Result<()> {
        self.bar.inc(steps);
        self.observed.done.fetch_add(steps, Ordering::Relaxed);
        anyhow::ensure!(!self.observed.stop.load(Ordering::Relaxed), "interrupted");
        Ok(())
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
