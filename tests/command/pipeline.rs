//! A run: what depends on a change is run again, and nothing else; threads and partitions do not matter.

use crate::common::{
    FILES, SMALL, bytes, fail, folder_with, motions_of, numbers, ran, rows, small_run, succeed, texts, write,
};

#[test]
fn what_depends_on_a_change_is_run_again_and_nothing_else() {
    let folder = folder_with(SMALL);
    assert_eq!(ran(&succeed(folder.path(), "run").1).len(), FILES.len());
    assert!(ran(&succeed(folder.path(), "run").1).is_empty(), "all is up to date");
    let change = |from: &str, to: &str| {
        std::fs::write(folder.path().join("pipeline.yaml"), SMALL.replace(from, to)).unwrap()
    };
    change("fit-pex: {}", "fit-pex: { limit-state: 0.2 }");
    let (plan, _) = succeed(folder.path(), "run --dry-run");
    assert!(plan.contains("fit-pex: run") && plan.contains("--limit-state"), "{plan}");
    assert!(plan.contains("fit-pro: up to date") && plan.contains("simulate: up to date"), "{plan}");
    assert_eq!(ran(&succeed(folder.path(), "run").1), ["fit-pex", "compare-paper"]);
    change("dt: 0.01", "dt: 0.02");
    let (plan, _) = succeed(folder.path(), "run --dry-run");
    assert!(plan.contains("--dt changed from 0.01 to 0.02"), "{plan}");
    let later = ["synthesize-motions", "simulate", "fit-pex", "fit-pro", "compare-paper"];
    assert_eq!(ran(&succeed(folder.path(), "run").1), later);
    assert_eq!(ran(&succeed(folder.path(), "run --force").1).len(), FILES.len());
}

#[test]
fn files_are_the_same_on_any_number_of_threads_and_others_with_another_seed() {
    let folder = folder_with(SMALL);
    for (seed, threads) in [(7, 1), (7, 2), (7, 3), (8, 2)] {
        succeed(folder.path(), &format!("run --seed {seed} --threads {threads} --out {seed}-{threads}"));
    }
    for name in FILES {
        let file = |out: &str| bytes(&folder.path().join(format!("{out}/{name}.parquet")));
        assert!(file("7-1") == file("7-2") && file("7-1") == file("7-3"), "{name}");
        assert!(file("7-1") != file("8-2"), "{name}");
    }
}

#[test]
fn partitions_make_the_rows_of_the_whole() {
    let folder = small_run();
    let simulate = "simulate --config pipeline.yaml --in out/motions.parquet --out parts --partition";
    for part in 0..3 {
        succeed(folder.path(), &format!("{simulate} {part}/3"));
    }
    assert_eq!(rows(folder.path(), "parts"), rows(folder.path(), "out/responses.parquet"));
    succeed(folder.path(), "fit-pro --in parts --out parts.pro.parquet");
    assert_eq!(rows(folder.path(), "parts.pro.parquet"), rows(folder.path(), "out/pro.parquet"));
    std::fs::remove_file(folder.path().join("parts/part-00001.parquet")).unwrap();
    fail(folder.path(), "fit-pro --in parts --out again.parquet", 1, &["parts", "1/3"]);
    fail(folder.path(), &format!("{simulate} 3/3"), 2, &["3/3"]);
}

#[test]
fn a_partition_of_an_object_with_a_depth_needs_no_other() {
    let folder = folder_with(SMALL);
    succeed(folder.path(), "sample-scenarios --mw 6.5 --re 5 --samples 4");
    for stage in ["synthesize-motions", "simulate --in motions --width 0.5 --depth 0.4 --height 1.9"] {
        succeed(folder.path(), &format!("{stage} --partition 0/2"));
    }
    let one = folder.path().join("motions/part-00000.parquet");
    std::fs::remove_file(&one).unwrap();
    // Pairs of components may stand in different partitions.
    let mut columns = motions_of(texts(&["a"]), 0.01, &[&[0.1; 50]]);
    columns.push(("azimuth_deg", numbers(&[90.0])));
    write(&one, columns);
    let simulate = "simulate --in motions --width 0.5 --depth 0.4 --height 1.9 --partition 0/2";
    fail(folder.path(), simulate, 1, &["part-00000.parquet", "one file"]);
}

#[test]
fn a_path_back_from_a_link_is_where_the_link_leads() {
    let pipeline = SMALL
        .replace("{ suite", "{ out: link/../m.parquet, suite")
        .replace("simulate:\n", "simulate:\n  in: link/../m.parquet\n");
    let folder = folder_with(&pipeline);
    std::fs::create_dir_all(folder.path().join("far/away")).unwrap();
    std::os::unix::fs::symlink("far/away", folder.path().join("link")).unwrap();
    assert_eq!(ran(&succeed(folder.path(), "run").1).len(), FILES.len());
    assert!(folder.path().join("far/m.parquet").exists());
    assert!(ran(&succeed(folder.path(), "run").1).is_empty());
}
