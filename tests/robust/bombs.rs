//! Files of a few hundred bytes that announce what no memory holds (scripts/attack/bombs.py made them).

use std::path::PathBuf;
use std::process::{Command, Output};

use rockfrag::rocking::Structure;
use rockfrag::table::intensities::IntensityBatches;
use rockfrag::table::motion_measures::MotionMeasures;
use rockfrag::table::motion_table::MotionTable;
use rockfrag::table::schema::headings::Headings;

use crate::readers::read_as_everything;

/// Memory that the command may take, kB: far below what the files announce.
const MEMORY_KB: u64 = 2_000_000;

/// Files that are odd, but hold what they say; what stands in them is for the stages to judge.
const SOUND: [&str; 5] = ["sound", "quiet", "values-in-chunk", "step-tiny", "step-huge"];

fn bombs() -> Vec<(String, PathBuf)> {
    let folder = std::fs::read_dir("tests/reference/bombs").unwrap();
    let mut bombs: Vec<PathBuf> = folder.map(|entry| entry.unwrap().path()).collect();
    bombs.sort();
    bombs.into_iter().map(|path| (path.file_stem().unwrap().to_string_lossy().into_owned(), path)).collect()
}

#[test]
fn bombs_are_told_from_sound_files() {
    assert!(bombs().len() >= 20);
    for (name, path) in bombs() {
        let read = read_as_everything(&path);
        let is_read = |reader: &str| read.iter().any(|(what, result)| *what == reader && result.is_ok());
        let sound = SOUND.contains(&name.as_str());
        assert_eq!(is_read("motions"), sound, "{name}: {read:?}");
        assert_eq!(is_read("motions in parts"), sound, "{name}: {read:?}");
        assert!(!is_read("scenarios"), "{name}: {read:?}");
    }
}

#[test]
fn measures_of_motions_that_would_fill_the_memory_are_refused() {
    let path = PathBuf::from("tests/reference/bombs/rows-of-motions.parquet");
    let words = MotionMeasures::read(&path, &[]).unwrap_err().to_string();
    assert!(words.contains("134217728 rows in a file of"), "{words}");
}

#[test]
fn little_that_makes_much_of_another_file_is_refused() {
    let open = |name: &str| PathBuf::from(format!("tests/reference/bombs/{name}.parquet"));
    let motions = MotionTable::open(open("rows-of-motions"), None).err().unwrap().to_string();
    assert!(motions.contains("134217728 rows in a file of 154 bytes"), "{motions}");
    let structure = Structure::new("frame", 1.0, 0.15, 0.92).unwrap();
    let peaks =
        IntensityBatches::open(open("rows-of-peaks"), &Headings::default(), Some(structure), Some(0.92), 64)
            .err()
            .unwrap()
            .to_string();
    assert!(peaks.contains("134217728 rows in a file of 255 bytes"), "{peaks}");
}

#[test]
fn bombs_are_refused_in_little_memory_and_few_words() {
    let folder = tempfile::tempdir().unwrap();
    for (name, path) in bombs() {
        for stage in ["synthesize-motions", "simulate", "fit-pro", "import-motions"] {
            let path = path.canonicalize().unwrap();
            let argument = match stage {
                // One of the sound files holds zeros.
                "import-motions" => "--accept-implausible ",
                "simulate" => "--structures paper --in ",
                _ => "--in ",
            };
            let Output { status, stderr, .. } = Command::new("sh")
                .arg("-c")
                .arg(format!(
                    "ulimit -v {MEMORY_KB}; exec {} --threads 2 {stage} {argument}{} --out {stage}.parquet",
                    assert_cmd::cargo::cargo_bin("rockfrag").display(),
                    path.display()
                ))
                .current_dir(folder.path())
                .output()
                .unwrap();
            let words = String::from_utf8(stderr).unwrap();
            let fine = ["sound", "quiet", "values-in-chunk"].contains(&name.as_str())
                && ["simulate", "import-motions"].contains(&stage);
            assert_eq!(status.code(), Some(i32::from(!fine)), "{name} {stage}: {words}");
            assert!(!words.contains("panicked"), "{name} {stage}: {words}");
            assert_eq!(folder.path().join(format!("{stage}.parquet")).exists(), fine, "{name} {stage}");
            let _ = std::fs::remove_file(folder.path().join(format!("{stage}.parquet")));
        }
    }
}
