//! Recorded motions through the command: what is imported, what is refused, what runs again.

use std::path::Path;

use crate::common::{fail, rockfrag, succeed};
use rockfrag::table::motions::{Motion, MotionBatches};

/// A CSV of times and accelerations in g: a sine of `cycles` cycles.
fn write_csv(folder: &Path, name: &str, cycles: f64) {
    let row = |k: usize| {
        let t = k as f64 * 0.01;
        format!("{t:.2},{:.6}\n", 0.5 * (2.0 * std::f64::consts::PI * cycles * t / 2.0).sin())
    };
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, (0..=200).map(row).collect::<String>()).unwrap();
}

fn imported(path: &Path) -> Vec<Motion> {
    MotionBatches::open(path, 64).unwrap().flat_map(Result::unwrap).collect()
}

fn ids(path: &Path) -> Vec<String> {
    imported(path).iter().map(|motion| motion.motion_id.to_string()).collect()
}

#[test]
fn folders_are_walked_and_simulate_reads_what_comes() {
    let folder = tempfile::tempdir().unwrap();
    write_csv(folder.path(), "records/b.csv", 2.0);
    write_csv(folder.path(), "records/a/x.csv", 1.0);
    write_csv(folder.path(), "records/a/.hidden.csv", 1.0);
    write_csv(folder.path(), "x.csv", 3.0);
    let told = succeed(folder.path(), "import-motions records x.csv x.csv --unit g");
    assert!(told.contains("3 motions of 3 files"), "{told}");
    // Two files are called x: their paths tell them apart.
    assert_eq!(ids(&folder.path().join("motions.parquet")), ["records/a/x.csv", "b", "x.csv"]);
    let told = succeed(folder.path(), "simulate --in motions.parquet --trace b");
    assert!(told.contains("3 responses"), "{told}");
    // What was imported can be imported again.
    succeed(folder.path(), "import-motions motions.parquet --out again.parquet");
    let (first, second) = ("motions.parquet", "again.parquet");
    let samples = |name: &str| imported(&folder.path().join(name)).remove(1).acceleration_m_s2;
    assert_eq!(samples(first), samples(second));
    assert_eq!(ids(&folder.path().join(second))[1], "motions:b");
}

#[test]
fn a_bad_file_is_named_and_the_rest_imported() {
    let folder = tempfile::tempdir().unwrap();
    for k in 0..150 {
        write_csv(folder.path(), &format!("records/{k:03}.csv"), 1.0);
    }
    std::fs::write(folder.path().join("records/077.csv"), "0.00,0.1\n0.01,oops\n").unwrap();
    std::fs::write(folder.path().join("records/099.csv"), b"PAR1 and no more").unwrap();
    let call = "import-motions records none.csv --unit g";
    let expected = [
        "3 of 151 files refused",
        "records/077.csv: line 2: 'oops' is no number",
        "records/099.csv: not a readable Parquet file",
        "none.csv: No such file",
        "148 motions of the others are imported",
        "--keep-going",
    ];
    fail(folder.path(), call, 1, &expected[1..]);
    assert_eq!(ids(&folder.path().join("motions.parquet")).len(), 148);
    // It fails again as long as the files are bad, unless that is no failure.
    fail(folder.path(), call, 1, &expected);
    let told = succeed(folder.path(), &format!("{call} --keep-going"));
    assert!(told.contains("warning: 3 of 151 files refused") && told.contains("oops"), "{told}");
    assert!(succeed(folder.path(), &format!("{call} --keep-going")).contains("up to date"));
    fail(folder.path(), "import-motions none.csv", 1, &["no motion is imported", "none.csv"]);
    fail(folder.path(), "import-motions", 2, &["no files"]);
    fail(folder.path(), "import-motions records --format at3", 2, &["did you mean 'at2'"]);
    fail(folder.path(), "import-motions records --unit furlong", 2, &["expected g, mg, m/s2"]);
}

#[test]
fn a_pipeline_may_start_from_records() {
    let folder = tempfile::tempdir().unwrap();
    for k in 1..9 {
        write_csv(folder.path(), &format!("here/records/{k}.csv"), f64::from(k));
    }
    let pipeline = "import-motions: { files: [records], unit: g, column: 2 }\nsimulate: {}\n";
    std::fs::write(folder.path().join("here/pipeline.yaml"), pipeline).unwrap();
    let told = succeed(folder.path(), "run here/pipeline.yaml");
    assert!(told.contains("8 motions of 8 files") && told.contains("8 responses"), "{told}");
    let again = succeed(folder.path(), "run here/pipeline.yaml");
    assert_eq!(again.matches("up to date").count(), 2, "{again}");
    write_csv(folder.path(), "here/records/4.csv", 4.5);
    let plan = rockfrag(folder.path()).args(["run", "here/pipeline.yaml", "--dry-run"]).output().unwrap();
    let plan = String::from_utf8(plan.stdout).unwrap();
    assert!(plan.contains("would run: the files changed"), "{plan}");
    let both = pipeline.to_string() + "synthesize-motions: {}\n";
    std::fs::write(folder.path().join("here/pipeline.yaml"), both).unwrap();
    fail(folder.path(), "run here/pipeline.yaml", 2, &["leave one of them out"]);
}

#[test]
fn motions_do_not_depend_on_threads() {
    let folder = tempfile::tempdir().unwrap();
    for k in 0..70 {
        write_csv(folder.path(), &format!("records/{k:03}.csv"), f64::from(k) * 0.3);
    }
    succeed(folder.path(), "import-motions records --unit g --out one.parquet --threads 1");
    succeed(folder.path(), "import-motions records --unit g --out two.parquet --threads 2");
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("one.parquet") == bytes("two.parquet"));
}
