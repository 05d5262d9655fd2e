//! Work in the background of a Python call: the GIL is released, and the caller hears of progress and can
//! interrupt.

use std::sync::OnceLock;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use rockfrag::pipeline::context::{Context, Observed, threads_of};
use rockfrag::source::forget_pipes;

use crate::error::to_python;

/// The time between two checks of signals and progress.
const CHECK_EVERY: Duration = Duration::from_millis(50);

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
    forget_pipes();
    expect_own_threads().map_err(|error| to_python(&error))?;
    let mut context = Context::default();
    context.common.quiet = true;
    let observed = &context.observed.clone();
    let (finished, wait) = sync_channel(1);
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
                    interrupted = Python::attach(|py| check(py, progress, observed)).err();
                    observed.stop.store(interrupted.is_some(), Ordering::Relaxed);
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
    check(py, progress, observed)?;
    Ok(result)
}

fn on_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> anyhow::Result<T> + Send,
) -> anyhow::Result<T> {
    match threads_of(threads)? {
        Some(threads) => threads.build()?.install(work),
        None => work(),
    }
}

/// Lets Python interrupt, and calls `progress` with the number of steps done and of all.
fn check(py: Python, progress: Option<&Py<PyAny>>, observed: &Observed) -> PyResult<()> {
    py.check_signals()?;
    if let Some(progress) = progress {
        let [done, total] = [&observed.done, &observed.total].map(|steps| steps.load(Ordering::Relaxed));
        progress.call1(py, (done, total))?;
    }
    Ok(())
}
