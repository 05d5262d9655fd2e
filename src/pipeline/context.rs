//! Output, progress and warnings of the running stage.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use arrow_array::RecordBatch;
use arrow_schema::SchemaRef;
use clap::{Args, ValueHint};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::ThreadPoolBuilder;
use rockfrag_core::warning::Warnings;
use serde::Deserialize;

use super::call::Plan;
use super::options::{UsageError, number};
use crate::inputs::Reading;
use crate::table::TableError;
use crate::table::keys::key_of_file;
use crate::table::provenance::{InputFile, Provenance};
use crate::table::rows::{self, Row};
use crate::table::writer::{PendingFile, TableWriter, persist};

/// More threads than any machine runs at once take minutes to start.
const MOST_THREADS: usize = 1024;

/// Begins a pool of as many threads as are asked for, by a number or by the environment, else of all.
pub fn threads_of(asked: Option<usize>) -> anyhow::Result<ThreadPoolBuilder> {
    let by_environment = std::env::var("RAYON_NUM_THREADS").ok().and_then(|threads| threads.parse().ok());
    match asked.or(by_environment).unwrap_or_default() {
        threads @ ..=MOST_THREADS => Ok(ThreadPoolBuilder::new().num_threads(threads)),
        threads => Err(UsageError::because(format!(
            "threads is {threads} (--threads or RAYON_NUM_THREADS); expected 1 to {MOST_THREADS}"
        ))),
    }
}

pub const COMMON: &str = "Common options";

// Options of all stages. A doc comment would replace the description of every stage.
#[derive(Debug, Clone, Default, Args, Deserialize)]
#[command(next_help_heading = COMMON)]
pub struct Common {
    /// Pipeline file whose section gives further options
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    #[serde(skip)]
    pub config: Option<PathBuf>,
    /// Run even if up to date; replace what is there
    #[arg(long)]
    pub force: bool,
    /// Threads [default: all]
    #[arg(long, value_name = "N", value_parser = number(1..=MOST_THREADS, "1 to 1024 threads"))]
    pub threads: Option<usize>,
    /// Print no progress
    #[arg(long)]
    pub quiet: bool,
    /// Whether a pipeline file is run, which writes the views again that it names.
    #[arg(skip)]
    #[serde(skip)]
    pub is_run: bool,
    #[arg(skip)]
    #[serde(skip)]
    pub observed: Arc<Observed>,
}

/// What another program sees of the progress of a stage, and how it stops the stage.
#[derive(Debug, Default)]
pub struct Observed {
    pub done: AtomicUsize,
    pub total: AtomicUsize,
    stop: AtomicBool,
    /// The temporary names of the tables that it writes.
    begun: Mutex<Vec<PathBuf>>,
}

impl Observed {
    /// Stops the stage: what it writes goes, and gets no name, whenever it hears of it.
    pub fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
        for path in &*locked(&self.begun) {
            let _ = std::fs::remove_file(path);
        }
    }

    pub fn expect_running(&self) -> anyhow::Result<()> {
        anyhow::ensure!(!self.stop.load(Ordering::Relaxed), "interrupted");
        Ok(())
    }
}

fn locked<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

#[derive(Default)]
pub struct Context {
    pub common: Common,
    pub plan: Plan,
    /// What is planned, with warnings, and how files of people were read, by now.
    made: Mutex<Provenance>,
    /// Files that have no name until the stage ends: one that fails leaves nothing.
    written: Mutex<Vec<PendingFile>>,
    /// Files that go when these get their names.
    former: Mutex<Vec<PathBuf>>,
}

impl Context {
    pub fn new(common: &Common, plan: Plan) -> Context {
        Context { common: common.clone(), made: Mutex::new(plan.made.clone()), plan, ..Context::default() }
    }

    pub fn warn(&self, warnings: Warnings) {
        locked(&self.made).warnings.extend(warnings);
    }

    /// Keeps how files of people were read, and doubts about what they say.
    pub fn tell(&self, warnings: Warnings, readings: Vec<Reading>) {
        self.warn(warnings);
        locked(&self.made).readings.extend(readings);
    }

    pub fn made(&self, summary: &str) -> Provenance {
        Provenance { summary: summary.to_string(), ..locked(&self.made).clone() }
    }

    pub fn create(&self, path: &Path, schema: &SchemaRef) -> anyhow::Result<TableWriter> {
        let writer = TableWriter::create(path, schema)?;
        locked(&self.common.observed.begun).push(writer.partial().to_path_buf());
        self.common.observed.expect_running()?;
        Ok(writer)
    }

    pub fn finish(&self, writer: TableWriter, summary: &str) -> Result<(), TableError> {
        let output = self.plan.outputs.iter().position(|output| output == writer.path()).unwrap_or_default();
        let made = Provenance { output, ..self.made(summary) }.with_before();
        locked(&self.written).push(writer.finish(&made)?);
        Ok(())
    }

    /// Removes, once `out` is replaced, what the same call as its present content wrote beside it.
    pub fn remove_former(&self, out: &Path, beside: PathBuf) {
        let made = Provenance::read(out).ok().flatten();
        if made.is_some_and(|made| made.is_beside(&beside)) {
            locked(&self.former).push(beside);
        }
    }

    /// Gives all files that were written their names, unless another program stops the stage, has changed an
    /// input or put something in their way.
    pub fn persist(&self) -> anyhow::Result<()> {
        let written = std::mem::take(&mut *locked(&self.written));
        let paths: Vec<PathBuf> = written.iter().map(|file| file.path.clone()).collect();
        self.plan.expect_replaceable(&paths, &self.common)?;
        self.common.observed.expect_running()?;
        self.expect_unchanged()?;
        persist(written)?;
        for former in &*locked(&self.former) {
            let _ = std::fs::remove_file(former);
        }
        Ok(())
    }

    /// Checks that no input was changed since the plan was made.
    pub fn expect_unchanged(&self) -> Result<(), TableError> {
        for InputFile { path, key, .. } in self.plan.made.inputs.values().flatten() {
            if key_of_file(path)? != *key {
                return Err(TableError::table(path, "changed by another run; run again"));
            }
        }
        Ok(())
    }

    pub fn write_file(&self, path: &Path, content: &[u8]) -> anyhow::Result<()> {
        self.common.observed.expect_running()?;
        locked(&self.written).push(PendingFile::new(path, content)?);
        Ok(())
    }

    pub fn write<R: Row>(&self, path: &Path, rows: &[R], summary: &str) -> anyhow::Result<()> {
        self.write_batches(path, &[rows::batch(rows)?], summary)
    }

    /// Writes batches of one schema, at least one.
    pub fn write_batches(&self, path: &Path, all: &[RecordBatch], summary: &str) -> anyhow::Result<()> {
        let mut writer = self.create(path, &all[0].schema())?;
        all.iter().try_for_each(|rows| writer.append(rows))?;
        Ok(self.finish(writer, summary)?)
    }

    pub fn bar(&self, total: usize) -> Progress {
        self.common.observed.total.fetch_add(total, Ordering::Relaxed);
        // Without a terminal, indicatif draws nothing.
        let bar = if self.common.quiet { ProgressBar::hidden() } else { ProgressBar::new(total as u64) };
        let style = ProgressStyle::with_template("{msg:20} {bar:40} {human_pos}/{human_len}  {eta} left");
        let bar = bar.with_style(style.expect("a template")).with_message(self.plan.made.stage.clone());
        Progress { bar, observed: self.common.observed.clone() }
    }
}

/// Progress of a stage; dropping it clears the bar.
pub struct Progress {
    bar: ProgressBar,
    observed: Arc<Observed>,
}

impl Progress {
    /// Ends a number of steps; an error if another program stops the stage.
    pub fn advance(&self, steps: usize) -> anyhow::Result<()> {
        self.bar.inc(steps as u64);
        self.observed.done.fetch_add(steps, Ordering::Relaxed);
        self.observed.expect_running()
    }
}
