//! Counter-based random streams: the numbers of a row are independent of the other rows.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Purpose of random numbers. Streams of different purposes are independent.
#[derive(Clone, Copy, strum::Display)]
#[strum(serialize_all = "snake_case")]
pub enum Purpose {
    /// Order of the strata of a Latin hypercube; the row is the cell times the dimensions plus the
    /// dimension.
    Strata,
    /// Place of a sample in its stratum, or in the unit cube; the row is the scenario.
    Sample,
    /// Noise of the stochastic motion; the row is the scenario, whatever file it is in.
    Noise,
}

/// ChaCha with 8 rounds, its key from seed and purpose, its stream number the row.
pub fn stream(seed: u64, purpose: Purpose, row: u64) -> ChaCha8Rng {
    let key = blake3::hash(format!("rockfrag {purpose} {seed}").as_bytes());
    let mut generator = ChaCha8Rng::from_seed(*key.as_bytes());
    generator.set_stream(row);
    generator
}
