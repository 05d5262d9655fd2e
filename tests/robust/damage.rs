//! Files of each stage with bytes changed, cut out, put in or cut off.

use std::path::{Path, PathBuf};

use proptest::prelude::*;
use rockfrag::table::store::guarded::quiet_damage;

use crate::readers::read_as_everything;

fn files() -> Vec<PathBuf> {
    let files = ["files", "bombs"].into_iter().flat_map(|folder| {
        std::fs::read_dir(Path::new("tests/reference").join(folder))
            .unwrap()
            .map(|entry| entry.unwrap().path())
    });
    let mut files: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|end| end == "parquet")).collect();
    files.sort();
    files
}

/// A change to bytes; places are shares of the length, of the file or of its end, where it describes itself.
#[derive(Debug, Clone)]
enum Change {
    Set(u8),
    Flip(u8),
    Insert(Vec<u8>),
    CutOut(usize),
    CutOff,
}

fn changes() -> impl Strategy<Value = Vec<(bool, f64, Change)>> {
    let varints = vec![vec![0xff; 9], vec![0xff, 0xff, 0xff, 0xff, 0x0f], vec![0x80; 20], vec![0]];
    let change = prop_oneof![
        4 => any::<u8>().prop_map(Change::Set),
        4 => (0..8u8).prop_map(Change::Flip),
        2 => prop::sample::select(varints).prop_map(Change::Insert),
        1 => (1..40usize).prop_map(Change::CutOut),
        1 => Just(Change::CutOff),
    ];
    prop::collection::vec((any::<bool>(), 0.0..1.0f64, change), 1..5)
}

fn damaged(mut bytes: Vec<u8>, changes: &[(bool, f64, Change)]) -> Vec<u8> {
    for (at_end, share, change) in changes {
        let from = if *at_end { bytes.len().saturating_sub(2000) } else { 0 };
        let at = from + ((bytes.len() - from) as f64 * share) as usize;
        if at >= bytes.len() {
            continue;
        }
        match change {
            Change::Set(byte) => bytes[at] = *byte,
            Change::Flip(bit) => bytes[at] ^= 1 << bit,
            Change::Insert(more) => drop(bytes.splice(at..at, more.iter().copied())),
            Change::CutOut(length) => drop(bytes.drain(at..(at + length).min(bytes.len()))),
            // The end stays, so that the description is read.
            Change::CutOff => {
                let end = bytes.split_off(bytes.len() - bytes.len().min(8));
                bytes.truncate(at);
                bytes.extend(end);
            }
        }
    }
    bytes
}

proptest! {
    #[test]
    fn damage_is_an_error_or_does_not_matter(which in any::<prop::sample::Index>(), changes in changes()) {
        quiet_damage();
        let files = files();
        let path = &files[which.index(files.len())];
        let folder = tempfile::tempdir().unwrap();
        let copy = folder.path().join("damaged.parquet");
        std::fs::write(&copy, damaged(std::fs::read(path).unwrap(), &changes)).unwrap();
        for (_, result) in read_as_everything(&copy) {
            if let Err(words) = result {
                prop_assert!(words.contains("damaged.parquet"), "{words}");
            }
        }
    }
}
