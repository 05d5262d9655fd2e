//! Cases by the million: in memory as far as they are few.

use std::sync::Arc;

use super::case::Case;
use crate::motion::IntensityMeasures;
use crate::resampling::Sizes;
use crate::rocking::Outcome;
use crate::statistics::columns::{BLOCK, Columns, Scratch};
use crate::statistics::spread::Spread;

/// A case among others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Its number.
    pub row: usize,
    pub case: Case,
    /// The cell of magnitude and distance, within which the bootstrap resamples.
    pub cell: usize,
    /// Its cluster: cases of one cluster may depend on each other.
    pub cluster: usize,
}

/// Cases in some order, however they are held.
pub trait Cases: Sync {
    /// Calls `take` with what `work` makes of some neighbouring cases, in order.
    fn each<S: Send>(&self, work: impl Fn(&[Placed]) -> S + Sync, take: impl FnMut(S));
}

/// All are in one cell, and each is a cluster of its own.
impl<T: AsRef<[Case]> + Sync + ?Sized> Cases for T {
    fn each<S: Send>(&self, work: impl Fn(&[Placed]) -> S + Sync, mut take: impl FnMut(S)) {
        for (block, cases) in self.as_ref().chunks(BLOCK).enumerate() {
            let placed = |(row, &case): (usize, &Case)| {
                let row = block * BLOCK + row;
                Placed { row, case, cell: 0, cluster: row }
            };
            take(work(&cases.iter().enumerate().map(placed).collect::<Vec<_>>()));
        }
    }
}

/// The cases of one structure under one suite of motions, as columns.
#[derive(Debug)]
pub struct CaseTable {
    columns: Columns,
    /// The numbers of clusters by what the column has, if these are others.
    clusters: Vec<usize>,
}

/// Demand and outcome, six measures, cell and cluster.
const WIDTH: usize = 10;

impl CaseTable {
    /// Of no cases yet.
    pub fn new(scratch: &Arc<Scratch>) -> CaseTable {
        CaseTable { columns: Columns::new(WIDTH, scratch), clusters: Vec::new() }
    }

    /// Of these, with the number of the cell of magnitude and distance of each, within which the bootstrap resamples, and that of its
    /// cluster.
    pub fn of(cases: &[Case], cells: &[usize], clusters: &[usize]) -> CaseTable {
        let mut table = CaseTable::new(&Arc::default());
        for ((case, &cell), &cluster) in cases.iter().zip(cells).zip(clusters) {
            table.push(case, cell, cluster);
        }
        table
    }

    /// Adds a case.
    pub fn push(&mut self, case: &Case, cell: usize, cluster: usize) {
        let Case { outcome, edp, measures: IntensityMeasures { im1, im2, im3, im4, im5, im6 } } = *case;
        let outcome = match outcome {
            Outcome::NoRocking => 0.0,
            Outcome::SafeRocking => 1.0,
            Outcome::Overturning => 2.0,
        };
        let or_nan = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let [im1, im2, im3, im6] = [im1, im2, im3, im6].map(or_nan);
        self.columns.push(&[edp, outcome, im1, im2, im3, im4, im5, im6, cell as f64, cluster as f64]);
    }

    /// Gives clusters other numbers: of those that were pushed as 0, 1, 2 ...; larger ones stay.
    pub fn renumber(&mut self, clusters: Vec<usize>) {
        self.clusters = clusters;
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.columns.rows()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether one block has them all.
    pub fn is_small(&self) -> bool {
        self.columns.is_small()
    }

    /// How many blocks hold them.
    pub fn blocks(&self) -> usize {
        self.columns.blocks()
    }

    /// Those of a block.
    pub fn block(&self, block: usize) -> Vec<Case> {
        let some = |first: usize, columns: &[&[f64]]| self.placed(first, columns);
        self.columns.with_block(block, WIDTH, some).into_iter().map(|placed| placed.case).collect()
    }

    /// The cells of those of a block.
    pub fn cells_of(&self, block: usize) -> Vec<usize> {
        self.columns.with_block(block, WIDTH - 1, |_, columns| {
            columns[WIDTH - 2].iter().map(|cell| *cell as usize).collect()
        })
    }

    /// Whether its cases are in the same cells as those of another table.
    pub fn has_cells_of(&self, other: &CaseTable) -> bool {
        let same = |block: usize| self.cells_of(block) == other.cells_of(block);
        self.len() == other.len() && (0..self.blocks()).all(same)
    }

    /// How many cases each cell has.
    pub fn cell_sizes(&self) -> Sizes {
        let mut sizes = Sizes::new();
        for block in 0..self.blocks() {
            for cell in self.cells_of(block) {
                *sizes.entry(cell).or_default() += 1;
            }
        }
        sizes
    }

    /// All of them, or of more than `most` some that are spread over all: of tables of one length the same rows.
    pub fn spread(&self, most: usize) -> Vec<Placed> {
        let mut spread = Spread::new(most);
        self.each(
            |some| some.to_vec(),
            |some: Vec<Placed>| some.into_iter().for_each(|case| spread.push(case)),
        );
        spread.into_kept()
    }

    fn placed(&self, first: usize, columns: &[&[f64]]) -> Vec<Placed> {
        let case = |at: usize| {
            let value = |place: usize| columns[place][at];
            let known = |place: usize| Some(value(place)).filter(|value| !value.is_nan());
            let outcome = match value(1) {
                0.0 => Outcome::NoRocking,
                1.0 => Outcome::SafeRocking,
                _ => Outcome::Overturning,
            };
            let measures = IntensityMeasures {
                im1: known(2),
                im2: known(3),
                im3: known(4),
                im4: value(5),
                im5: value(6),
                im6: known(7),
            };
            let case = Case { outcome, edp: value(0), measures };
            Placed { row: first + at, case, cell: value(8) as usize, cluster: self.cluster(value(9)) }
        };
        (0..columns[0].len()).map(case).collect()
    }

    fn cluster(&self, pushed: f64) -> usize {
        self.clusters.get(pushed as usize).copied().unwrap_or(pushed as usize)
    }
}

impl Cases for CaseTable {
    fn each<S: Send>(&self, work: impl Fn(&[Placed]) -> S + Sync, take: impl FnMut(S)) {
        let of_block = |first: usize, columns: &[&[f64]]| work(&self.placed(first, columns));
        self.columns.each(WIDTH, of_block, take);
    }
}
