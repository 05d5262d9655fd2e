//! Work that many processes share: partitions, and folders of them where a file may stand.

use std::path::{Path, PathBuf};

use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use rockfrag::table::store::fingerprint::Fingerprint;

use crate::common::{content, fail, rockfrag, small_pipeline, succeed};

/// The content fingerprint of the rows of a folder's files, in the order of names.
fn together(folder: &Path) -> String {
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let open = |file| ParquetRecordBatchReaderBuilder::try_new(std::fs::File::open(file).unwrap()).unwrap();
    let mut fingerprint = Fingerprint::new(open(&files[0]).schema().clone());
    for batch in files.iter().flat_map(|file| open(file).build().unwrap()) {
        fingerprint.update(&batch.unwrap());
    }
    fingerprint.finish()
}

/// The small pipeline, with its motions also in `n` partitions.
fn partitioned(n: usize) -> tempfile::TempDir {
    let (folder, _) = small_pipeline();
    succeed(folder.path(), "run");
    for i in 0..n {
        let call = "synthesize-motions --config pipeline.yaml --in out/scenarios.parquet --out parts";
        succeed(folder.path(), &format!("{call} --partition {i}/{n}"));
    }
    folder
}

#[test]
fn partitions_together_are_the_whole() {
    let folder = partitioned(3);
    let at = |name: &str| folder.path().join(name);
    assert!(at("parts/part-00002.parquet").is_file());
    assert_eq!(together(&at("parts")), content(&at("out/motions.parquet")));
    // Each on its own, out of order.
    for i in [2, 0, 1] {
        let call = "simulate --config pipeline.yaml --in parts --out responses";
        succeed(folder.path(), &format!("{call} --partition {i}/3"));
    }
    assert_eq!(together(&at("responses")), content(&at("out/responses.parquet")));
    // Motions in one file, cut where no row group ends.
    for i in 0..7 {
        let call = "simulate --config pipeline.yaml --in out/motions.parquet --out cut";
        succeed(folder.path(), &format!("{call} --partition {i}/7"));
    }
    assert_eq!(together(&at("cut")), content(&at("out/responses.parquet")));
}

#[test]
fn a_folder_stands_where_a_file_may() {
    let folder = partitioned(3);
    let at = |name: &str| folder.path().join(name);
    succeed(folder.path(), "simulate --config pipeline.yaml --in parts --out one.parquet");
    assert_eq!(content(&at("one.parquet")), content(&at("out/responses.parquet")));
    let told = succeed(folder.path(), "simulate --config pipeline.yaml --in parts --out responses/");
    assert_eq!(told.matches("responses of 2").count(), 3, "{told}");
    assert_eq!(together(&at("responses")), content(&at("out/responses.parquet")));
    let again = succeed(folder.path(), "simulate --config pipeline.yaml --in parts --out responses/");
    assert_eq!(again.matches("up to date").count(), 3, "{again}");
    for (fit, name) in [("fit-pex", "pex"), ("fit-pro", "pro")] {
        succeed(folder.path(), &format!("{fit} --config pipeline.yaml --in responses --out {name}.parquet"));
        assert_eq!(content(&at(&format!("{name}.parquet"))), content(&at(&format!("out/{name}.parquet"))));
    }
    let text = rockfrag(folder.path()).args(["inspect", "responses"]).output().unwrap();
    let text = String::from_utf8(text.stdout).unwrap();
    assert!(text.contains("160 rows in 3 row groups") && text.contains("made by simulate"), "{text}");
}

#[test]
fn a_partition_that_is_done_is_skipped() {
    let folder = partitioned(2);
    let call = "synthesize-motions --config pipeline.yaml --in out/scenarios.parquet --out parts --partition";
    let told = succeed(folder.path(), &format!("{call} 1/2"));
    assert!(told.contains("up to date"), "{told}");
    // Another cut is other work, even where the name is the same.
    let told = succeed(folder.path(), &format!("{call} 1/3 --overwrite"));
    assert!(told.contains("26 motions") || told.contains("28 motions"), "{told}");
    fail(
        folder.path(),
        "simulate --in parts --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["part-00001.parquet", "3 partitions", "of 2"],
    );
}

#[test]
fn an_incomplete_folder_is_no_table() {
    let folder = partitioned(3);
    let at = |name: &str| folder.path().join(name);
    std::fs::remove_file(at("parts/part-00001.parquet")).unwrap();
    let missing = ["parts", "part-00001.parquet is missing", "--partition 1/3"];
    fail(folder.path(), "simulate --in parts --out r.parquet --p 2.5 --alpha 0.2 --eta 0.92", 1, &missing);
    // A partition needs no other one.
    succeed(folder.path(), "simulate --in parts --partition 2/3 --out r --p 2.5 --alpha 0.2 --eta 0.92");
    fail(
        folder.path(),
        "simulate --in parts --partition 1/3 --out r --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["part-00001.parquet", "no such file"],
    );
    fail(
        folder.path(),
        "simulate --in parts --partition 2/4 --out r --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["3 partitions", "2/4"],
    );
    std::fs::create_dir(at("empty")).unwrap();
    fail(
        folder.path(),
        "simulate --in empty --out r.parquet --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["empty", "part-00000.parquet"],
    );
}

#[test]
fn a_partition_that_cannot_be_is_named() {
    let folder = partitioned(1);
    for wrong in ["3/3", "-1/3", "1", "a/b", "0/0"] {
        let call = format!("synthesize-motions --in out/scenarios.parquet --partition={wrong}");
        fail(folder.path(), &call, 2, &["from 0 to n - 1"]);
    }
    let call = "simulate --in out/motions.parquet --trace 1 --partition 0/2 --p 2.5 --alpha 0.2 --eta 0.92";
    fail(folder.path(), call, 2, &["--partition", "--trace"]);
    let call =
        "simulate --in parts/part-00000.parquet --out r --partition 0/2 --p 2.5 --alpha 0.2 --eta 0.92";
    fail(folder.path(), call, 2, &["partition 0/1", "--partition 0/2"]);
}

#[test]
fn a_partition_may_have_no_rows() {
    let folder = partitioned(1);
    succeed(folder.path(), "sample-scenarios --samples 1 --mw 6 --re 5,10 --out two.parquet");
    succeed(folder.path(), "synthesize-motions --in two.parquet --out few --partition 0/3");
    succeed(folder.path(), "synthesize-motions --in two.parquet --out few --partition 1/3");
    succeed(folder.path(), "synthesize-motions --in two.parquet --out few --partition 2/3");
    let told = succeed(folder.path(), "simulate --in few --out r.parquet --p 2.5 --alpha 0.2 --eta 0.92");
    assert!(told.contains("4 responses"), "{told}");
    let told =
        succeed(folder.path(), "simulate --in few --out r --partition 0/3 --p 2.5 --alpha 0.2 --eta 0.92");
    assert!(told.contains("0 responses"), "{told}");
}

/// A folder with three partitions of motions and of their responses.
fn with_responses() -> tempfile::TempDir {
    let folder = partitioned(3);
    for i in 0..3 {
        succeed(folder.path(), &format!("{SIMULATE} --partition {i}/3"));
    }
    folder
}

const SYNTHESIZE: &str = "synthesize-motions --config pipeline.yaml --in out/scenarios.parquet --out parts";
const SIMULATE: &str = "simulate --config pipeline.yaml --in parts --out responses";

#[test]
fn partitions_made_in_different_ways_are_no_table() {
    let folder = with_responses();
    // Of motions: one option each.
    for option in ["kappa 0.05", "seed 8", "dt 0.02", "suite csgm"] {
        succeed(folder.path(), &format!("{SYNTHESIZE} --partition 1/3 --{option}"));
        let name = option.split(' ').next().unwrap();
        let told = ["part-00001.parquet has", name, "but part-00000.parquet has", "--partition 1/3"];
        fail(folder.path(), "simulate --in parts --structures paper --out one.parquet", 1, &told);
        fail(folder.path(), "inspect parts", 1, &told);
    }
    // Their responses: of other motions than the others.
    succeed(folder.path(), &format!("{SIMULATE} --partition 1/3"));
    let told = ["part-00001.parquet is made of other motions than part-00000.parquet"];
    fail(folder.path(), "fit-pro --in responses --out pro.parquet", 1, &told);
    succeed(folder.path(), &format!("{SYNTHESIZE} --partition 1/3"));
    succeed(folder.path(), &format!("{SIMULATE} --partition 1/3"));
    succeed(folder.path(), "fit-pro --in responses --out pro.parquet");
    // Other structures for one of them.
    let other = "simulate --in parts --out responses --partition 1/3 --p 2 --alpha 0.2 --eta 0.9";
    succeed(folder.path(), other);
    fail(
        folder.path(),
        "fit-pro --in responses --out pro.parquet",
        1,
        &["part-00001.parquet has structures"],
    );
    // Other scenarios for one of them.
    succeed(
        folder.path(),
        "sample-scenarios --samples 10 --mw 6.5,7.5 --re 5,10 --seed 9 --out other.parquet",
    );
    let other = SYNTHESIZE.replace("out/scenarios", "other");
    succeed(folder.path(), &format!("{other} --partition 2/3"));
    fail(folder.path(), "inspect parts", 1, &["part-00002.parquet is made of other scenarios"]);
}

#[test]
fn partitions_of_a_file_and_of_a_folder_do_not_mix() {
    let folder = with_responses();
    // The cut of a file is another one than that of the folder.
    let of_file = SIMULATE.replace("--in parts", "--in out/motions.parquet");
    succeed(folder.path(), &format!("{of_file} --partition 2/3"));
    let told = ["part-00002.parquet is made of other motions", "--partition 2/3"];
    fail(folder.path(), "fit-pro --in responses --out pro.parquet", 1, &told);
}

#[test]
fn motions_may_go_once_their_responses_are_there() {
    let folder = with_responses();
    std::fs::remove_dir_all(folder.path().join("parts")).unwrap();
    succeed(folder.path(), "fit-pro --in responses --out pro.parquet");
}

#[test]
fn one_partition_alone_is_fitted_with_a_warning() {
    let folder = with_responses();
    let told = succeed(folder.path(), "fit-pro --in responses/part-00002.parquet --out pro.parquet");
    assert!(
        told.contains("part-00002.parquet is partition 2/3") && told.contains("give the folder"),
        "{told}"
    );
    let told = succeed(folder.path(), "fit-pro --in responses --out all.parquet");
    assert!(!told.contains("give the folder"), "{told}");
}

#[test]
fn a_copy_of_a_partition_is_named() {
    let folder = with_responses();
    let at = |name: &str| folder.path().join("responses").join(name);
    std::fs::copy(at("part-00001.parquet"), at("part-00001-copy.parquet")).unwrap();
    let told =
        ["part-00001-copy.parquet is partition 1/3, as is part-00001.parquet", "remove part-00001-copy"];
    fail(folder.path(), "fit-pro --in responses --out pro.parquet", 1, &told);
}

#[test]
fn a_partition_that_was_cut_off_is_made_again_with_overwrite() {
    let folder = with_responses();
    let part = folder.path().join("responses/part-00001.parquet");
    let bytes = std::fs::read(&part).unwrap();
    std::fs::write(&part, &bytes[..bytes.len() / 2]).unwrap();
    fail(
        folder.path(),
        "fit-pro --in responses --out pro.parquet",
        1,
        &["part-00001.parquet", "--overwrite"],
    );
    let again = format!("{SIMULATE} --partition 1/3");
    fail(folder.path(), &again, 2, &["part-00001.parquet: not readable", "--overwrite"]);
    succeed(folder.path(), &format!("{again} --overwrite"));
    assert_eq!(std::fs::read(&part).unwrap(), bytes);
}

#[test]
fn a_partition_goes_into_a_folder_and_into_no_run() {
    let (folder, file) = small_pipeline();
    succeed(folder.path(), "sample-scenarios --config pipeline.yaml --out s.parquet");
    let call = "synthesize-motions --config pipeline.yaml --in s.parquet --partition 1/4";
    fail(folder.path(), &format!("{call} --out m.parquet"), 2, &["out is m.parquet", "folder, such as m"]);
    // Its own name is one that it may have.
    succeed(folder.path(), &format!("{call} --out m/part-00001.parquet"));
    let pipeline = std::fs::read_to_string(&file).unwrap().replace("dt: 0.01", "dt: 0.01, partition: 1/4");
    std::fs::write(&file, pipeline).unwrap();
    fail(folder.path(), "run", 2, &["synthesize-motions has a partition", "--partition i/n"]);
}

#[test]
fn a_partition_under_the_name_of_another_is_refused() {
    let folder = with_responses();
    let at = |name: &str| folder.path().join(name);
    let swap = |folder: &str| {
        let file = |part: &str| at(&format!("{folder}/{part}.parquet"));
        std::fs::rename(file("part-00001"), at("away")).unwrap();
        std::fs::rename(file("part-00002"), file("part-00001")).unwrap();
        std::fs::rename(at("away"), file("part-00002")).unwrap();
    };
    swap("responses");
    let expected = "part-00001.parquet holds partition 2/3; expected that in part-00002.parquet: rename it";
    fail(folder.path(), "fit-pro --in responses --out pro.parquet", 1, &[expected]);
    swap("parts");
    let call = "simulate --config pipeline.yaml --in parts --out again --partition 1/3";
    fail(folder.path(), call, 1, &[expected]);
    assert!(!at("again/part-00001.parquet").exists());
}

#[test]
fn a_partition_with_other_options_than_its_neighbours_is_warned_of() {
    let folder = partitioned(3);
    let call =
        "synthesize-motions --config pipeline.yaml --in out/scenarios.parquet --out parts --partition 1/3";
    let told = succeed(folder.path(), &format!("{call} --seed 8"));
    assert!(told.contains("seed 8, but part-00000.parquet has"), "{told}");
    // Every line says of which partition it is.
    assert!(told.contains("synthesize-motions 1/3 "), "{told}");
}
