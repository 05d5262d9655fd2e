//! The rocking solver against closed forms, quadruple precision, the printed equations, and extreme input.

mod body;
mod company;
mod incremental;
mod noise;
mod numbers;
mod reference;
mod rocking;
mod truth;

use rockfrag::table::motions::{Motion, open, parts, read_part};

/// All motions of a file.
fn motions(path: &std::path::Path) -> Vec<Motion> {
    let table = open(path, None).unwrap();
    let read = parts(&table).flat_map(|part| read_part(&table, part.unwrap(), 64).unwrap());
    read.flat_map(|batch| batch.unwrap().1).collect()
}
