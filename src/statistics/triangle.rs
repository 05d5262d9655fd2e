//! Symmetric matrices as the rows of their lower triangle, one after the other.

/// Where row `i` and column `j` stand, in either order.
#[inline(always)]
pub fn place(i: usize, j: usize) -> usize {
    let (row, column) = (i.max(j), i.min(j));
    row * (row + 1) / 2 + column
}

/// How many numbers a matrix with so many rows has.
pub fn count(rows: usize) -> usize {
    place(rows, 0)
}
