//! Work on all threads while the former batch is written and the next one is read, in bounded memory.

use rayon::prelude::*;

/// Passes the items of each batch of `source` through `work`, on all threads, and what comes of them in order
/// to `sink`, while the next batch is read. The first error ends all and is returned.
pub fn pipelined<A: Send, B: Send>(
    mut source: impl Iterator<Item = anyhow::Result<Vec<A>>> + Send,
    work: impl Fn(A) -> anyhow::Result<B> + Sync,
    mut sink: impl FnMut(B) -> anyhow::Result<()> + Send,
) -> anyhow::Result<()> {
    let (mut batch, mut done) = (source.next().transpose()?, Vec::new());
    while let Some(items) = batch {
        let (next, worked) = rayon::join(
            || done.into_iter().try_for_each(&mut sink).and_then(|()| source.next().transpose()),
            || items.into_par_iter().map(&work).collect::<anyhow::Result<Vec<B>>>(),
        );
        (batch, done) = (next?, worked?);
    }
    done.into_iter().try_for_each(sink)
}

pub fn batches<A>(
    source: impl Iterator<Item = A>,
    size: usize,
) -> impl Iterator<Item = anyhow::Result<Vec<A>>> {
    let mut source = source.fuse();
    std::iter::from_fn(move || {
        let batch: Vec<A> = source.by_ref().take(size).collect();
        (!batch.is_empty()).then_some(Ok(batch))
    })
}
