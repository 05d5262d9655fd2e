//! Counter-based random streams: the numbers of a row do not depend on which other rows are made.

mod normals;
mod words;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

pub use normals::Normals;

/// What random numbers are for. Streams of different purposes are independent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// The order of the strata of a Latin hypercube; the row is the cell times the dimensions plus the dimension.
    Strata,
    /// The place of a sample within its stratum, or in the unit cube; the row is the scenario.
    Sample,
    /// The digital shift of a Sobol sequence; the row is the cell.
    SobolShift,
    /// The noise of the stochastic motion; the row is the scenario.
    Noise,
    /// The rows of a resample; the row is the replicate.
    Bootstrap,
}

impl Purpose {
    fn label(self) -> &'static str {
        match self {
            Purpose::Strata => "strata",
            Purpose::Sample => "sample",
            Purpose::SobolShift => "sobol-shift",
            Purpose::Noise => "noise",
            Purpose::Bootstrap => "bootstrap",
        }
    }
}

/// The stream of random numbers of a seed, a purpose and a row.
pub fn stream(seed: u64, purpose: Purpose, row: u64) -> ChaCha8Rng {
    let mut generator = ChaCha8Rng::from_seed(key(seed, purpose));
    generator.set_stream(row);
    generator
}

/// The key of all streams of a seed and a purpose.
fn key(seed: u64, purpose: Purpose) -> [u8; 32] {
    *blake3::hash(format!("rockfrag {} {seed}", purpose.label()).as_bytes()).as_bytes()
}
