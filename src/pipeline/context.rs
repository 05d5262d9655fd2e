//! What a call would make, and output, progress and warnings of the running stage.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use arrow_schema::SchemaRef;
use clap::{Args, ValueHint};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rayon::ThreadPoolBuilder;
use rockfrag_core::warning::Warnings;
use serde::Deserialize;

use super::options::{UsageError, number};
use crate::table::TableError;
use crate::table::keys::{modified_at, read_file, resolved};
use crate::table::provenance::{InputFile, Provenance};
use crate::table::rows::{self, Row};
use crate::table::writer::{PendingFile, TableWriter, persist};

/// More threads than any machine runs at once take minutes to start.
const MOST_THREADS: usize = 1024;

/// Returns as many threads as are asked for, by a number or by the environment; none if neither asks.
pub fn threads_of(asked: Option<usize>) -> anyhow::Result<Option<ThreadPoolBuilder>> {
    let by_environment = std::env::var("RAYON_NUM_THREADS").ok().and_then(|threads| threads.parse().ok());
    match asked.or(by_environment.filter(|threads| *threads > 0)) {
        Some(threads) if !(1..=MOST_THREADS).contains(&threads) => Err(UsageError::because(format!(
            "threads is {threads} (--threads or RAYON_NUM_THREADS); expected 1 to {MOST_THREADS}"
        ))),
        asked => Ok(asked.map(|threads| ThreadPoolBuilder::new().num_threads(threads))),
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
    /// Progress bars: auto or never
    #[arg(long, value_name = "WHEN", default_value = "auto", value_parser = bars)]
    pub progress: String,
}

/// Reads when to draw progress bars: if stderr is a terminal, or never.
fn bars(text: &str) -> Result<String, String> {
    match text {
        "auto" | NEVER => Ok(text.to_string()),
        _ => Err(format!("expected auto or {NEVER}")),
    }
}

const NEVER: &str = "never";

/// What a call would make.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    pub made: Provenance,
    pub outputs: Vec<PathBuf>,
}

impl Plan {
    /// Returns the provenance of one of the outputs.
    pub fn output(&self, output: usize) -> Provenance {
        Provenance { output, ..self.made.clone() }
    }

    /// Returns the keys of the outputs.
    pub fn keys(&self) -> impl Iterator<Item = (PathBuf, String)> + '_ {
        let outputs = self.outputs.iter().enumerate();
        outputs.map(|(place, path)| (resolved(path), self.output(place).key_of_content()))
    }
}

/// What another program sees of the progress of a stage, and how it stops the stage.
#[derive(Default)]
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

    fn expect_running(&self) -> anyhow::Result<()> {
        anyhow::ensure!(!self.stop.load(Ordering::Relaxed), "interrupted");
        Ok(())
    }
}

fn locked<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Who calls a stage: a run writes the files without a mark that its pipeline file names again.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Caller {
    #[default]
    Command,
    Run,
}

#[derive(Default)]
pub struct Context {
    pub common: Common,
    pub caller: Caller,
    pub observed: Arc<Observed>,
    pub plan: Plan,
    warnings: Mutex<Warnings>,
    /// Files that have no name until the stage ends: one that fails leaves nothing.
    written: Mutex<Vec<PendingFile>>,
    /// Files that go when these get their names.
    former: Mutex<Vec<PathBuf>>,
}

impl Context {
    pub fn new(common: Common, caller: Caller) -> Context {
        Context { common, caller, ..Context::default() }
    }

    /// Returns the context of a planned call.
    pub fn begin(&self, plan: Plan) -> Context {
        let (common, observed) = (self.common.clone(), self.observed.clone());
        Context { common, caller: self.caller, observed, plan, ..Context::default() }
    }

    pub fn warn(&self, warnings: Warnings) {
        locked(&self.warnings).extend(warnings);
    }

    pub fn warnings(&self) -> Warnings {
        locked(&self.warnings).clone()
    }

    pub fn create(&self, path: &Path, schema: &SchemaRef) -> anyhow::Result<TableWriter> {
        let writer = TableWriter::create(path, schema)?;
        locked(&self.observed.begun).push(writer.partial().to_path_buf());
        self.observed.expect_running()?;
        Ok(writer)
    }

    /// Ends a table with its provenance.
    pub fn finish(&self, writer: TableWriter, summary: &str) -> Result<(), TableError> {
        let output = self.plan.outputs.iter().position(|output| output == writer.path()).unwrap_or_default();
        let (summary, warnings) = (summary.to_string(), self.warnings());
        let made = Provenance { summary, warnings, ..self.plan.output(output) };
        let written = writer.finish(&made)?;
        locked(&self.written).push(written);
        Ok(())
    }

    /// Removes, once `out` is replaced, what the same call as its present content wrote beside it.
    pub fn remove_former(&self, out: &Path, beside: PathBuf) {
        let [made, other] = [out, &beside].map(|path| Provenance::read(path).ok().flatten());
        if let (Some(made), Some(other)) = (made, other)
            && made.output != other.output
            && made.key() == (Provenance { output: made.output, ..other }).key()
        {
            locked(&self.former).push(beside);
        }
    }

    /// Returns the paths of all files that were written.
    pub fn written(&self) -> Vec<PathBuf> {
        locked(&self.written).iter().map(|written| written.path.clone()).collect()
    }

    /// Gives all files that were written their names, unless another program stops the stage or has changed
    /// an input.
    pub fn persist(&self) -> anyhow::Result<()> {
        self.observed.expect_running()?;
        self.expect_unchanged()?;
        persist(std::mem::take(&mut *locked(&self.written)))?;
        for former in &*locked(&self.former) {
            let _ = std::fs::remove_file(former);
        }
        Ok(())
    }

    /// Checks that no input was changed since the plan was made.
    pub fn expect_unchanged(&self) -> Result<(), TableError> {
        for InputFile { path, key, modified, .. } in self.plan.made.inputs.values().flatten() {
            if modified_at(path) != *modified && read_file(path, String::new())?.key != *key {
                return Err(TableError::table(path, "changed by another run; run again"));
            }
        }
        Ok(())
    }

    /// Writes a file that is no table.
    pub fn write_file(&self, path: &Path, content: &[u8]) -> anyhow::Result<()> {
        self.observed.expect_running()?;
        let written = PendingFile::new(path, content)?;
        locked(&self.written).push(written);
        Ok(())
    }

    pub fn write<R: Row>(&self, path: &Path, rows: &[R], summary: &str) -> anyhow::Result<()> {
        let mut writer = self.create(path, &rows::schema::<R>())?;
        writer.append(&rows::batch(rows)?)?;
        Ok(self.finish(writer, summary)?)
    }

    /// Begins progress over `total` steps.
    pub fn bar(&self, total: usize) -> Progress {
        self.observed.total.fetch_add(total, Ordering::Relaxed);
        let is_wanted = self.common.progress != NEVER && !self.common.quiet;
        // Without a terminal, indicatif draws nothing.
        let target = if is_wanted { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let style = ProgressStyle::with_template("{msg:20} {bar:40} {human_pos}/{human_len}  {eta} left");
        let bar = ProgressBar::with_draw_target(Some(total as u64), target)
            .with_style(style.expect("a template of indicatif"))
            .with_message(self.plan.made.stage.clone());
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
    pub fn advance(&self, steps: usize) -> anyhow::Result<()> {
        self.bar.inc(steps as u64);
        self.observed.done.fetch_add(steps, Ordering::Relaxed);
        self.observed.expect_running()
    }
}
