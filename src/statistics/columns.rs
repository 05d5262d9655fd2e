//! Columns of numbers of any length: what is more than memory should hold lies in a file without a name, in the folder for
//! temporary files. They are read in blocks of rows, which threads share; results are joined in the order of the rows, so that they
//! have the same bits on any number of threads, wherever the numbers lie.

use std::fs::File;
use std::io;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

/// Rows of a block.
pub const BLOCK: usize = 8192;
/// Blocks that are worked on before their results are joined.
const AT_ONCE: usize = 16;
/// Blocks that tell well enough where to search in all.
const FEW: usize = 8;
/// Numbers that all columns together hold in memory: 16 MiB. Further blocks go to files.
const MOST_HELD: usize = 2 << 20;

static HELD: AtomicUsize = AtomicUsize::new(0);

/// Columns of the same length.
#[derive(Debug)]
pub struct Columns {
    width: usize,
    /// Rows of a block.
    block: usize,
    rows: usize,
    full: Vec<Place>,
    /// The last rows, column by column.
    open: Vec<Vec<f64>>,
    scratch: Arc<Scratch>,
}

/// Where a block lies, column after column.
#[derive(Debug)]
enum Place {
    Memory(Vec<f64>),
    File(u64),
}

impl Columns {
    /// Of no rows yet; columns that share a scratch share its file.
    pub fn new(width: usize, scratch: &Arc<Scratch>) -> Columns {
        Columns::in_blocks(BLOCK, width, scratch)
    }

    /// The same in blocks of so many rows.
    pub fn in_blocks(block: usize, width: usize, scratch: &Arc<Scratch>) -> Columns {
        let open = vec![Vec::new(); width];
        Columns { width, block, rows: 0, full: Vec::new(), open, scratch: scratch.clone() }
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Whether one block has them all.
    pub fn is_small(&self) -> bool {
        self.rows <= self.block
    }

    /// Adds a row.
    pub fn push(&mut self, row: &[f64]) {
        self.open.iter_mut().zip(row).for_each(|(column, value)| column.push(*value));
        self.rows += 1;
        if self.open[0].len() == self.block {
            self.close();
        }
    }

    /// Adds rows, given column by column.
    pub fn append(&mut self, columns: &[Vec<f64>]) {
        let (mut from, rows) = (0, columns[0].len());
        while from < rows {
            let to = rows.min(from + self.block - self.open[0].len());
            self.open.iter_mut().zip(columns).for_each(|(open, column)| open.extend(&column[from..to]));
            self.rows += to - from;
            from = to;
            if self.open[0].len() == self.block {
                self.close();
            }
        }
    }

    fn close(&mut self) {
        let block = self.open.concat();
        self.open.iter_mut().for_each(Vec::clear);
        let is_more = HELD.load(Ordering::Relaxed) + block.len() > MOST_HELD;
        // A disk that is full leaves memory.
        let place = match is_more.then(|| self.scratch.write(&block)).flatten() {
            Some(at) => Place::File(at),
            None => {
                HELD.fetch_add(block.len(), Ordering::Relaxed);
                Place::Memory(block)
            }
        };
        self.full.push(place);
    }

    /// How many blocks there are.
    pub fn blocks(&self) -> usize {
        self.full.len() + usize::from(self.open.first().is_some_and(|column| !column.is_empty()))
    }

    /// Calls `work` with the number of the first row of a block, and the first `wanted` of its columns.
    pub fn with_block<T>(&self, block: usize, wanted: usize, work: impl FnOnce(usize, &[&[f64]]) -> T) -> T {
        let mut read = Vec::new();
        let columns: Vec<&[f64]> = match self.full.get(block) {
            None => self.open[..wanted].iter().map(Vec::as_slice).collect(),
            Some(Place::Memory(values)) => values.chunks(self.block).take(wanted).collect(),
            Some(Place::File(at)) => {
                read.resize(wanted * self.block, 0.0);
                self.scratch.read(*at, &mut read);
                read.chunks(self.block).collect()
            }
        };
        work(block * self.block, &columns)
    }

    /// Calls `take` with what `work` makes of each block, in order. It is given the number of the first row and the first `wanted`
    /// columns; where there are no rows, once, with empty ones.
    pub fn each<S: Send>(
        &self,
        wanted: usize,
        work: impl Fn(usize, &[&[f64]]) -> S + Sync,
        mut take: impl FnMut(S),
    ) {
        let of_block = |block: usize| self.with_block(block, wanted, &work);
        take(of_block(0));
        for first in (1..self.blocks()).step_by(AT_ONCE) {
            let last = self.blocks().min(first + AT_ONCE);
            let parts: Vec<S> = (first..last).into_par_iter().map(of_block).collect();
            parts.into_iter().for_each(&mut take);
        }
    }

    /// What `work` makes of all blocks, joined in order by `add`.
    pub fn fold<S: Send>(
        &self,
        wanted: usize,
        work: impl Fn(usize, &[&[f64]]) -> S + Sync,
        mut add: impl FnMut(&mut S, S),
    ) -> S {
        let mut sum = None;
        self.each(wanted, &work, |part| match &mut sum {
            Some(sum) => add(sum, part),
            None => sum = Some(part),
        });
        sum.unwrap_or_else(|| self.with_block(0, wanted, work))
    }

    /// Whether there are many blocks.
    pub fn is_many(&self) -> bool {
        self.blocks() > FEW
    }

    /// Blocks from all over, where there are many.
    pub fn spread(&self) -> Option<Columns> {
        let blocks = self.blocks();
        self.is_many().then(|| {
            let mut few = Columns::new(self.width, &self.scratch);
            for block in (0..FEW).map(|k| k * blocks / FEW) {
                let columns: Vec<Vec<f64>> = self.with_block(block, self.width, |_, columns| {
                    columns.iter().map(|column| column.to_vec()).collect()
                });
                few.append(&columns);
            }
            few
        })
    }

    /// A column as a whole, in memory.
    pub fn column(&self, place: usize) -> Vec<f64> {
        self.fold(place + 1, |_, columns| columns[place].to_vec(), |all, part| all.extend(part))
    }
}

impl Drop for Columns {
    fn drop(&mut self) {
        let held = self.full.iter().map(|place| match place {
            Place::Memory(values) => values.len(),
            Place::File(_) => 0,
        });
        HELD.fetch_sub(held.sum(), Ordering::Relaxed);
    }
}

/// A file without a name, made when it is first needed; it goes with its last user.
#[derive(Debug, Default)]
pub struct Scratch {
    file: OnceLock<Option<File>>,
    end: AtomicU64,
}

impl Scratch {
    /// Where the numbers are now; none if there is no room.
    fn write(&self, values: &[f64]) -> Option<u64> {
        let file = self.file.get_or_init(nameless).as_ref()?;
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let at = self.end.fetch_add(bytes.len() as u64, Ordering::Relaxed);
        write_at(file, &bytes, at).ok()?;
        Some(at)
    }

    fn read(&self, at: u64, values: &mut [f64]) {
        let mut bytes = vec![0; size_of_val(values)];
        let file = self.file.get().and_then(Option::as_ref);
        let read = file.map_or(Err(io::ErrorKind::NotFound.into()), |file| read_at(file, &mut bytes, at));
        if let Err(error) = read {
            panic!("{}: cannot read back what was put there: {error}", std::env::temp_dir().display());
        }
        let (bytes, _) = bytes.as_chunks();
        values.iter_mut().zip(bytes).for_each(|(value, bytes)| *value = f64::from_le_bytes(*bytes));
    }
}

/// Without files, all is held in memory.
fn nameless() -> Option<File> {
    #[cfg(feature = "pipeline")]
    return tempfile::tempfile().ok();
    #[cfg(not(feature = "pipeline"))]
    None
}

#[cfg(unix)]
fn read_at(file: &File, bytes: &mut [u8], at: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, bytes, at)
}

#[cfg(unix)]
fn write_at(file: &File, bytes: &[u8], at: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::write_all_at(file, bytes, at)
}

#[cfg(windows)]
fn read_at(file: &File, bytes: &mut [u8], at: u64) -> io::Result<()> {
    let mut done = 0;
    while done < bytes.len() {
        match std::os::windows::fs::FileExt::seek_read(file, &mut bytes[done..], at + done as u64)? {
            0 => return Err(io::ErrorKind::UnexpectedEof.into()),
            read => done += read,
        }
    }
    Ok(())
}

#[cfg(windows)]
fn write_at(file: &File, bytes: &[u8], at: u64) -> io::Result<()> {
    let mut done = 0;
    while done < bytes.len() {
        done += std::os::windows::fs::FileExt::seek_write(file, &bytes[done..], at + done as u64)?;
    }
    Ok(())
}
