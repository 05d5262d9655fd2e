//! The rocking solver against closed forms, quadruple precision, the printed equations, and extreme input.

mod body;
mod company;
mod incremental;
mod noise;
mod numbers;
mod reference;
mod rocking;
mod truth;

/// All motions of a file.
fn motions(path: &std::path::Path) -> Vec<rockfrag::table::motions::Motion> {
    let motions = rockfrag::table::motions::Motions::open(path, None).unwrap();
    let read = |part| motions.read(part, 64).unwrap().flat_map(|batch| batch.unwrap().1).collect::<Vec<_>>();
    motions.parts().flat_map(|part| read(part.unwrap())).collect()
}
