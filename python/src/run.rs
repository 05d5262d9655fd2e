//! A stage in the background of a Python call: the GIL is released, and whoever called hears of progress and can interrupt.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, OnceLock};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use rockfrag::pipeline::console::{Console, Listener};

use crate::error::{in_python, to_python};

/// The time between two checks of signals and progress.
const CHECK_EVERY: Duration = Duration::from_millis(50);

/// The settings of a call.
#[derive(FromPyObject)]
pub struct Settings {
    /// Threads; all cores if none.
    #[pyo3(item)]
    threads: Option<usize>,
    /// Called with the number of steps done and of all.
    #[pyo3(item)]
    progress: Option<Py<PyAny>>,
    /// Whether even what is up to date is run.
    #[pyo3(item)]
    pub force: bool,
    /// Whether files that something else has made are written over.
    #[pyo3(item)]
    pub overwrite: bool,
}

/// What the stage says, for the thread that waits for it.
#[derive(Default)]
struct Heard {
    done: AtomicU64,
    total: AtomicU64,
    stop: AtomicBool,
    lines: Mutex<Vec<Line>>,
}

enum Line {
    Note(String),
    Warning(String),
}

impl Heard {
    fn push(&self, line: Line) {
        if let Ok(mut lines) = self.lines.lock() {
            lines.push(line);
        }
    }
}

impl Listener for Heard {
    fn note(&self, line: &str) {
        self.push(Line::Note(line.to_string()));
    }

    fn warn(&self, warning: &str) {
        self.push(Line::Warning(warning.to_string()));
    }

    fn begin(&self, steps: u64) {
        self.total.fetch_add(steps, Ordering::Relaxed);
    }

    fn advance(&self, steps: u64) -> anyhow::Result<()> {
        self.done.fetch_add(steps, Ordering::Relaxed);
        anyhow::ensure!(!self.stop.load(Ordering::Relaxed), "interrupted");
        Ok(())
    }
}

/// The process that has used rockfrag first. A child made by fork has none of its threads, and would wait for them without end.
static OWNER: OnceLock<u32> = OnceLock::new();

fn expect_own_threads() -> anyhow::Result<()> {
    anyhow::ensure!(
        *OWNER.get_or_init(std::process::id) == std::process::id(),
        "this process was forked from one that had used rockfrag, and lacks its threads; expected multiprocessing with the start method \
         'spawn' or 'forkserver': multiprocessing.get_context('spawn')"
    );
    Ok(())
}

/// Runs `work` on a thread of its own, with as many threads as `settings` says, until it is done or Python interrupts it.
pub fn run<T: Send>(
    py: Python,
    settings: &Settings,
    work: impl FnOnce(&Console) -> anyhow::Result<T> + Send,
) -> PyResult<T> {
    expect_own_threads().map_err(|error| to_python(py, &error))?;
    let heard = Arc::new(Heard::default());
    let console = Console { listener: Some(heard.clone()), ..Console::default() };
    let (finished, wait) = sync_channel(1);
    let (watched, console) = (&heard, &console);
    let (result, interrupted) = py.detach(move || {
        thread::scope(|scope| {
            let worker = scope.spawn(move || {
                let result = on_threads(settings.threads, || work(console));
                // Whoever waits is there until this is said.
                let _ = finished.send(());
                result
            });
            let mut interrupted = None;
            let mut told = 0;
            while wait.recv_timeout(CHECK_EVERY) == Err(RecvTimeoutError::Timeout) {
                if interrupted.is_some() {
                    continue;
                }
                if let Err(error) = Python::attach(|py| check(py, settings, watched, &mut told)) {
                    watched.stop.store(true, Ordering::Relaxed);
                    interrupted = Some(error);
                }
            }
            (worker.join(), interrupted)
        })
    });
    if let Some(error) = interrupted {
        return Err(error);
    }
    let result = result.unwrap_or_else(|_| Err(anyhow::anyhow!("the stage stopped unexpectedly")));
    tell(py, &heard)?;
    let result = result.map_err(|error| to_python(py, &error))?;
    check(py, settings, &heard, &mut 0)?;
    Ok(result)
}

fn on_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> anyhow::Result<T> + Send,
) -> anyhow::Result<T> {
    match threads {
        Some(threads) => rayon::ThreadPoolBuilder::new().num_threads(threads).build()?.install(work),
        None => work(),
    }
}

/// Lets Python interrupt, and tells it what is done if that is more than was `told`.
fn check(py: Python, settings: &Settings, heard: &Heard, told: &mut u64) -> PyResult<()> {
    py.check_signals()?;
    let done = heard.done.load(Ordering::Relaxed);
    if let Some(progress) = settings.progress.as_ref().filter(|_| done > *told) {
        *told = done;
        progress.call1(py, (done, heard.total.load(Ordering::Relaxed)))?;
    }
    Ok(())
}

/// Warnings as Python's, what was done as a line of its log.
fn tell(py: Python, heard: &Heard) -> PyResult<()> {
    let lines = heard.lines.lock().map(|mut lines| std::mem::take(&mut *lines)).unwrap_or_default();
    for line in lines {
        match line {
            Line::Warning(warning) => {
                let class = py.import("rockfrag.errors")?.getattr("RockfragWarning")?;
                // The line of whoever called the package's function.
                py.import("warnings")?.call_method1("warn", (in_python(&warning), class, 2))?;
            }
            Line::Note(note) => {
                let log = py.import("logging")?.call_method1("getLogger", ("rockfrag",))?;
                log.call_method1("info", (note,))?;
            }
        }
    }
    Ok(())
}
