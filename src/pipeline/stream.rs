//! Concurrent reading, work and writing in order, in memory bounded by short queues.

use std::sync::mpsc::sync_channel;
use std::thread::{self, Builder};

use rayon::prelude::*;

/// Capacity of a queue between two steps.
const QUEUE: usize = 2;

/// Passes the items of each batch of `source` through `work`, on all threads, and what comes of them in order
/// to `sink`. Source and sink each have their own thread. The first error ends all and is returned.
pub fn pipelined<A: Send, B: Send>(
    source: impl Iterator<Item = anyhow::Result<Vec<A>>> + Send,
    work: impl Fn(A) -> anyhow::Result<B> + Sync,
    mut sink: impl FnMut(B) -> anyhow::Result<()> + Send,
) -> anyhow::Result<()> {
    thread::scope(|scope| {
        let (to_work, from_source) = sync_channel(QUEUE);
        let (to_sink, from_work) = sync_channel::<Vec<B>>(QUEUE);
        Builder::new().spawn_scoped(scope, move || {
            for batch in source {
                let last = batch.is_err();
                // The queue is closed if a later step failed; that step returns the error.
                if to_work.send(batch).is_err() || last {
                    break;
                }
            }
        })?;
        let writer = Builder::new()
            .spawn_scoped(scope, move || from_work.into_iter().flatten().try_for_each(&mut sink))?;
        let mut worked = Ok(true);
        for batch in from_source {
            let done = batch.and_then(|batch| batch.into_par_iter().map(&work).collect());
            worked = done.map(|done| to_sink.send(done).is_ok());
            // The queue is closed if the sink failed; the sink returns the error.
            if !matches!(worked, Ok(true)) {
                break;
            }
        }
        drop(to_sink);
        let written =
            writer.join().unwrap_or_else(|_| Err(anyhow::anyhow!("the writer stopped unexpectedly")));
        worked?;
        written
    })
}

/// Returns the items of `source` in batches of `size`, up to the first error.
pub fn batches<A, E: Into<anyhow::Error>>(
    source: impl Iterator<Item = Result<A, E>>,
    size: usize,
) -> impl Iterator<Item = anyhow::Result<Vec<A>>> {
    let mut source = source.fuse();
    std::iter::from_fn(move || {
        let batch: Result<Vec<A>, E> = source.by_ref().take(size).collect();
        match batch {
            Ok(batch) if batch.is_empty() => None,
            batch => Some(batch.map_err(Into::into)),
        }
    })
}
