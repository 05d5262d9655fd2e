//! Work in the background of a Python call: the GIL is released, and the caller hears of progress and can
//! interrupt.

use std::sync::OnceLock;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{RecvTimeoutError::Timeout, sync_channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use rockfrag::pipeline::context::{Common, Observed, threads_of};
use rockfrag::source::forget_pipes;

use crate::error::to_python;

/// The time between two checks of signals and progress.
const CHECK_EVERY: Duration = Duration::from_millis(50);
/// Checks for which an interrupted stage may end; then it is left alone, and gives no file its name.
const LAST_CHECKS: usize = 10;

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
pub fn run<T: Send + 'static>(
    py: Python,
    threads: Option<usize>,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(Common) -> anyhow::Result<T> + Send + 'static,
) -> PyResult<T> {
    forget_pipes();
    expect_own_threads().map_err(|error| to_python(&error))?;
    let common = Common { quiet: true, ..Common::default() };
    let observed = &common.observed.clone();
    let (finished, wait) = sync_channel(1);
    // Nobody waits for an interrupted one.
    thread::spawn(move || drop(finished.send(on_threads(threads, || work(common)))));
    let result = py.detach(move || {
        let (mut interrupted, mut last) = (None, 0..LAST_CHECKS);
        loop {
            match wait.recv_timeout(CHECK_EVERY) {
                Err(Timeout) if interrupted.is_none() => {
                    interrupted = Python::attach(|py| check(py, progress, observed)).err();
                    interrupted.iter().for_each(|_| observed.stop());
                }
                Err(Timeout) if last.next().is_some() => {}
                done => return interrupted.map_or(Ok(done), Err),
            }
        }
    })?;
    let result = result.unwrap_or_else(|_| Err(anyhow::anyhow!("the stage stopped unexpectedly")));
    let result = result.map_err(|error| to_python(&error))?;
    check(py, progress, observed)?;
    Ok(result)
}

fn on_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> anyhow::Result<T> + Send,
) -> anyhow::Result<T> {
    let pool = threads_of(threads)?;
    if threads.is_some() { pool.build()?.install(work) } else { work() }
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
