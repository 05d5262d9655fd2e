use std::convert::Infallible;

use rand_chacha::rand_core::{TryRng, utils};
use rand_distr::{Distribution, StandardNormal};

use super::words::Words;
use super::{Purpose, key};

/// Layers of the ziggurat.
const LAYERS: usize = 256;

/// The standard normal numbers of `StandardNormal` from the streams of a seed and a purpose, many at once. Nearly all of
/// them come from one number inside a layer of the ziggurat; `StandardNormal` itself makes the others.
pub struct Normals {
    words: Words,
    layers: Box<[Layer; LAYERS]>,
}

/// A layer of the ziggurat.
#[derive(Clone, Copy)]
struct Layer {
    /// How far it reaches.
    edge: f64,
    /// How far the next one does: all within is below the density.
    inner: f64,
}

impl Normals {
    /// Of a seed and a purpose.
    pub fn new(seed: u64, purpose: Purpose) -> Normals {
        let inner = |layer| if layer + 1 < LAYERS { edge(layer + 1) } else { 0.0 };
        let layer = |layer| Layer { edge: edge(layer), inner: inner(layer) };
        Normals { words: Words::new(key(seed, purpose)), layers: Box::new(std::array::from_fn(layer)) }
    }

    /// The first numbers of a row.
    pub fn fill(&mut self, row: u64, normals: &mut [f64]) {
        self.words.set_stream(row);
        let mut rest = normals;
        loop {
            let inside = self.fill_inside(rest);
            let Some((normal, others)) = rest[inside..].split_first_mut() else { return };
            *normal = StandardNormal.sample(&mut self.words);
            rest = others;
        }
    }

    /// As many as lie inside of their layers, until one does not or no number is left: how many.
    fn fill_inside(&mut self, normals: &mut [f64]) -> usize {
        let mut inside = 0;
        for (normal, &number) in normals.iter_mut().zip(self.words.left()) {
            let Layer { edge, inner } = self.layers[number as usize % LAYERS];
            let x = symmetric(number) * edge;
            if x.abs() >= inner {
                break;
            }
            *normal = x;
            inside += 1;
        }
        self.words.skip(inside);
        inside
    }
}

/// The upper 52 bits as a number in [-1, 1).
#[inline(always)]
fn symmetric(number: u64) -> f64 {
    f64::from_bits(number >> 12 | 2_f64.to_bits()) - 3.0
}

/// How far a layer reaches: twice what a half of it gives.
fn edge(layer: usize) -> f64 {
    let half: f64 = StandardNormal.sample(&mut Always(3 << 62 | layer as u64));
    2.0 * half
}

/// Always the same number.
struct Always(u64);

impl TryRng for Always {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok(self.0 as u32)
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        Ok(self.0)
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        utils::fill_bytes_via_next_word(bytes, || self.try_next_u64())
    }
}
