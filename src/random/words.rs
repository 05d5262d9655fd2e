use std::convert::Infallible;

use pulp::NullaryFnOnce;
use rand_chacha::rand_core::{TryRng, utils};

use crate::wide::widest;

/// Blocks that are made at once.
const BLOCKS: usize = 64;
/// Words of a block; two make a number.
const WORDS: usize = 16;
/// Numbers of all these blocks.
const BATCH: usize = BLOCKS * WORDS / 2;
const ROUNDS: usize = 8;
/// "expand 32-byte k", with which every block begins.
const CONSTANTS: [u32; 4] = [0x6170_7865, 0x3320_646e, 0x7962_2d32, 0x6b20_6574];
/// The low word of a block's number.
const BLOCK_NUMBER: usize = 12;

/// A word of each block.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Row([u32; BLOCKS]);

/// The numbers of `ChaCha8Rng`, from so many blocks at once that they fill wide registers: in half the time.
pub struct Words {
    key: [u32; 8],
    stream: u64,
    /// The first block of the next batch.
    block: u64,
    batch: Box<[u64; BATCH]>,
    /// The next number of the batch.
    next: usize,
}

impl Words {
    /// The first stream of a key.
    pub fn new(key: [u8; 32]) -> Words {
        let key = std::array::from_fn(|k| u32::from_le_bytes(std::array::from_fn(|byte| key[4 * k + byte])));
        Words { key, stream: 0, block: 0, batch: Box::new([0; BATCH]), next: BATCH }
    }

    /// Goes to the beginning of a stream.
    pub fn set_stream(&mut self, stream: u64) {
        (self.stream, self.block, self.next) = (stream, 0, BATCH);
    }

    /// What is left of the numbers made so far.
    pub fn left(&self) -> &[u64] {
        &self.batch[self.next..]
    }

    /// Passes over some of them.
    pub fn skip(&mut self, numbers: usize) {
        self.next += numbers;
    }

    fn draw(&mut self) -> u64 {
        if self.next == BATCH {
            let [c0, c1, c2, c3] = CONSTANTS;
            let [k0, k1, k2, k3, k4, k5, k6, k7] = self.key;
            let [block, stream] = [self.block, self.stream].map(|x| (x as u32, (x >> 32) as u32));
            let state =
                [c0, c1, c2, c3, k0, k1, k2, k3, k4, k5, k6, k7, block.0, block.1, stream.0, stream.1];
            widest(Batch { state, numbers: &mut self.batch });
            self.block += BLOCKS as u64;
            self.next = 0;
        }
        self.next += 1;
        self.batch[self.next - 1]
    }
}

impl TryRng for Words {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok(self.draw() as u32)
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        Ok(self.draw())
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        utils::fill_bytes_via_next_word(bytes, || self.try_next_u64())
    }
}

/// The blocks that follow from the state of the first one.
struct Batch<'a> {
    state: [u32; WORDS],
    numbers: &'a mut [u64; BATCH],
}

impl NullaryFnOnce for Batch<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Batch { state, numbers } = self;
        let mut rows = [Row([0; BLOCKS]); WORDS];
        for (row, word) in rows.iter_mut().zip(state) {
            row.0 = [word; BLOCKS];
        }
        number_blocks(&mut rows[BLOCK_NUMBER]);
        let [x0, x1, x2, x3, x4, x5, x6, x7, x8, x9, x10, x11, x12, x13, x14, x15] = &mut rows;
        for _ in 0..ROUNDS / 2 {
            // Columns, then diagonals.
            quarter_round(x0, x4, x8, x12);
            quarter_round(x1, x5, x9, x13);
            quarter_round(x2, x6, x10, x14);
            quarter_round(x3, x7, x11, x15);
            quarter_round(x0, x5, x10, x15);
            quarter_round(x1, x6, x11, x12);
            quarter_round(x2, x7, x8, x13);
            quarter_round(x3, x4, x9, x14);
        }
        for (row, word) in rows.iter_mut().zip(state) {
            for x in &mut row.0 {
                *x = x.wrapping_add(word);
            }
        }
        number_blocks(&mut rows[BLOCK_NUMBER]);
        for pair in 0..WORDS / 2 {
            for block in 0..BLOCKS {
                let (low, high) = (rows[2 * pair].0[block], rows[2 * pair + 1].0[block]);
                numbers[block * WORDS / 2 + pair] = u64::from(low) | u64::from(high) << 32;
            }
        }
    }
}

/// A batch begins at a multiple of its length: only the low word of a block's number changes within it.
#[inline(always)]
fn number_blocks(low: &mut Row) {
    for (block, low) in low.0.iter_mut().enumerate() {
        *low = low.wrapping_add(block as u32);
    }
}

#[inline(always)]
fn quarter_round(a: &mut Row, b: &mut Row, c: &mut Row, d: &mut Row) {
    for (((a, b), c), d) in a.0.iter_mut().zip(&mut b.0).zip(&mut c.0).zip(&mut d.0) {
        for (first, second) in [(16, 12), (8, 7)] {
            *a = a.wrapping_add(*b);
            *d = (*d ^ *a).rotate_left(first);
            *c = c.wrapping_add(*d);
            *b = (*b ^ *c).rotate_left(second);
        }
    }
}
