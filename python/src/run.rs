//! Work in the background of a Python call: the GIL is released, and the caller hears of progress and can
//! interrupt.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, OnceLock};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use rockfrag::pipeline::context::{Context, Listener};

use crate::error::to_python;

/// The time between two checks of signals and progress.
const CHECK_EVERY: Duration = Duration::from_millis(50);

/// How far the work is.
#[derive(Default)]
struct Heard {
    done: AtomicU64,
    total: AtomicU64,
    stop: AtomicBool,
}

impl Listener for Heard {
    fn begin(&self, steps: u64) {
        self.total.fetch_add(steps, Ordering::Relaxed);
    }

    fn advance(&self, steps: u64) -> anyhow::Result<()> {
        self.done.fetch_add(steps, Ordering::Relaxed);
        anyhow::ensure!(!self.stop.load(Ordering::Relaxed), "interrupted");
        Ok(())
    }
}

/// The first process that uses rockfrag. A child made by fork lacks its threads and would wait for them.
static OWNER: OnceLock<u32> = OnceLock::new();

fn expect_own_threads() -> anyhow::Result<()> {
    anyhow::ensure!(
        *OWNER.get_or_init(std::process::id) == std::process::id(),
        "forked from a process that had used rockfrag; expected multiprocessing.get_context('spawn')"
    );
    Ok(())
}

/// Runs `work` on a thread of its own, with `threads` threads (all processors if none), until it is done or
/// interrupted.
pub fn run<T: Send>(
    py: Python,
    threads: Option<usize>,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(Context) -> anyhow::Result<T> + Send,
) -> PyResult<T> {
    expect_own_threads().map_err(|error| to_python(&error))?;
    let heard = Arc::new(Heard::default());
    let mut context = Context::default();
    context.quiet = true;
    context.listener = Some(heard.clone());
    let (finished, wait) = sync_channel(1);
    let heard = &heard;
    let (result, interrupted) = py.detach(move || {
        thread::scope(|scope| {
            let worker = scope.spawn(move || {
                let result = on_threads(threads, || work(context));
                // Whoever waits is there until this is sent.
                let _ = finished.send(());
                result
            });
            let mut interrupted = None;
            while wait.recv_timeout(CHECK_EVERY) == Err(RecvTimeoutError::Timeout) {
                if interrupted.is_none() {
                    interrupted = Python::attach(|py| check(py, progress, heard)).err();
                    heard.stop.store(interrupted.is_some(), Ordering::Relaxed);
                }
            }
            (worker.join(), interrupted)
        })
    });
    if let Some(error) = interrupted {
        return Err(error);
    }
    let result = result.unwrap_or_else(|_| Err(anyhow::anyhow!("the stage stopped unexpectedly")));
    let result = result.map_err(|error| to_python(&error))?;
    check(py, progress, heard)?;
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

/// Lets Python interrupt, and calls `progress` with the number of steps done and of all.
fn check(py: Python, progress: Option<&Py<PyAny>>, heard: &Heard) -> PyResult<()> {
    py.check_signals()?;
    if let Some(progress) = progress {
        progress.call1(py, (heard.done.load(Ordering::Relaxed), heard.total.load(Ordering::Relaxed)))?;
    }
    Ok(())
}
