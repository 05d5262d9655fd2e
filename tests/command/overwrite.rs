//! Nothing of the user's is written over.

use std::os::unix::fs::symlink;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{Array, Float64Array};

use crate::common::{fail, small_pipeline, succeed, write};
use crate::evaluate::fitted;

const PAPER: &str = "--structures paper";

fn bytes(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap()
}

/// The small pipeline after its run.
fn run_before() -> tempfile::TempDir {
    let (folder, _) = small_pipeline();
    succeed(folder.path(), "run");
    folder
}

#[test]
fn no_stage_writes_over_its_input_by_any_name() {
    let folder = run_before();
    let at = |name: &str| folder.path().join(name);
    std::fs::rename(at("out/motions.parquet"), at("motions.parquet")).unwrap();
    let before = bytes(&at("motions.parquet"));
    symlink("motions.parquet", at("link.parquet")).unwrap();
    symlink(folder.path(), at("here")).unwrap();
    std::fs::hard_link(at("motions.parquet"), at("hard.parquet")).unwrap();
    let simulate = |input: &str, out: &str| {
        for overwrite in ["", " --overwrite --force"] {
            let call = format!("simulate --in {input} --out {out} {PAPER}{overwrite}");
            fail(folder.path(), &call, 2, &["simulate reads it (the motions)", "--out FILE"]);
        }
        assert!(bytes(&at("motions.parquet")) == before, "{input} {out}");
    };
    simulate("motions.parquet", "motions.parquet");
    simulate("motions.parquet", "./out/../motions.parquet");
    simulate("motions.parquet", "link.parquet");
    simulate("link.parquet", "motions.parquet");
    simulate("motions.parquet", "hard.parquet");
    simulate("motions.parquet", "here/motions.parquet");
    // A file beside the output is one, too.
    std::fs::copy(at("out/responses.parquet"), at("pex.scan.parquet")).unwrap();
    let call = "fit-pex --in pex.scan.parquet --out pex.parquet --overwrite";
    fail(folder.path(), call, 2, &["pex.scan.parquet: fit-pex reads it (the responses)"]);
    // Nor does a table come to stand in a folder of tables that is read.
    std::fs::create_dir(at("parts")).unwrap();
    std::fs::rename(at("motions.parquet"), at("parts/part-00000.parquet")).unwrap();
    let call = format!("simulate --in parts --out parts/part-00000.parquet {PAPER}");
    fail(folder.path(), &call, 2, &["reads it"]);
    fail(folder.path(), &format!("simulate --in parts --out parts/ {PAPER}"), 2, &["reads it"]);
    fail(folder.path(), &format!("simulate --in parts --out parts/new.parquet {PAPER}"), 2, &["reads it"]);
    assert!(bytes(&at("parts/part-00000.parquet")) == before);
}

#[test]
fn what_something_else_made_is_kept_unless_it_is_given_up() {
    let folder = run_before();
    let at = |name: &str| folder.path().join(name);
    let column: Arc<dyn Array> = Arc::new(Float64Array::from(vec![1.0]));
    write(&at("others.parquet"), vec![("x", column)]);
    std::fs::write(at("thesis.odt"), "a thesis\n").unwrap();
    for (name, says) in [
        ("thesis.odt", "a file that rockfrag did not make"),
        ("others.parquet", "a file that rockfrag did not make"),
        ("out/pex.parquet", "made by fit-pex"),
    ] {
        let before = bytes(&at(name));
        let call = format!("simulate --in out/motions.parquet --out {name} {PAPER}");
        fail(folder.path(), &call, 2, &[name, says, "--overwrite"]);
        assert!(bytes(&at(name)) == before, "{name}");
    }
    let told = succeed(
        folder.path(),
        &format!("simulate --in out/motions.parquet --out thesis.odt {PAPER} --overwrite"),
    );
    assert!(told.contains("responses"), "{told}");
    // What the same stage made is made again as ever, and an empty file holds nothing to lose.
    std::fs::write(at("empty.parquet"), "").unwrap();
    for out in ["out/responses.parquet", "empty.parquet"] {
        succeed(
            folder.path(),
            &format!("simulate --in out/motions.parquet --out {out} --width 0.6 --height 2.4"),
        );
    }
    // A file beside the output.
    std::fs::copy(at("out/pro.parquet"), at("p.scan.parquet")).unwrap();
    fail(
        folder.path(),
        "fit-pex --in out/responses.parquet --out p.parquet",
        2,
        &["p.scan.parquet: made by fit-pro"],
    );
    assert!(!at("p.parquet").exists());
    fail(
        folder.path(),
        "fit-pex --in out/responses.parquet --out out",
        2,
        &["out: there is something that is not a file"],
    );
    // A run says so before it does anything, and does the rest as ever.
    std::fs::remove_file(at("out/scenarios.parquet")).unwrap();
    std::fs::copy(at("out/pex.parquet"), at("out/scenarios.parquet")).unwrap();
    fail(folder.path(), "run", 2, &["scenarios.parquet: made by fit-pex", "--overwrite"]);
    succeed(folder.path(), "run --overwrite");
    assert_eq!(succeed(folder.path(), "run").matches("up to date").count(), 6);
}

#[test]
fn texts_and_pages_are_known_by_what_they_say() {
    let (folder, chosen) = fitted();
    let at = |name: &str| folder.path().join(name);
    let point = format!("evaluate {chosen} --p 2.5 --alpha 0.2 --pga 0.5 --pgv 0.6");
    let export = format!("export {chosen} --p 2.5 --alpha 0.2 --ratio 0.3 --tolerance 1e-2");
    let calls = [
        format!("{point} --out a.txt"),
        format!("{point} --out a.csv"),
        format!("{point} --out a.json"),
        format!("{export} --to openquake --out f.xml"),
        format!("{export} --to pelicun --out f.csv"),
    ];
    for call in calls {
        for _ in 0..2 {
            succeed(folder.path(), &format!("{call} --force"));
        }
        let name = call.rsplit(' ').next().unwrap();
        std::fs::write(at(name), "ID,Incomplete,Demand-Type\nB.10.31,0,PGA\n").unwrap();
        fail(folder.path(), &call, 2, &[name, "a file that rockfrag did not make", "--overwrite"]);
        assert!(bytes(&at(name)).starts_with(b"ID,Incomplete"), "{name}");
        succeed(folder.path(), &format!("{call} --overwrite"));
    }
    std::fs::write(at("page.html"), "<html>mine</html>").unwrap();
    let run = crate::evaluate::run_folder().display();
    let call = format!("report --in {run} --out page.html --dpi 36 --groups 1 --motions 0");
    fail(folder.path(), &call, 2, &["page.html", "a file that rockfrag did not make"]);
    succeed(folder.path(), &format!("{call} --overwrite"));
    succeed(folder.path(), &format!("{call} --force"));
    std::fs::write(at("spread.csv"), "seed,mine\n1,2\n").unwrap();
    std::fs::write(at("pipeline.yaml"), crate::common::SMALL_PIPELINE).unwrap();
    fail(folder.path(), "seed-spread --seeds 1 --out spread.csv", 2, &["spread.csv", "did not make"]);
}

#[test]
fn a_folder_keeps_to_one_number_of_partitions() {
    let folder = run_before();
    let at = |name: &str| folder.path().join(name);
    let call = "synthesize-motions --config pipeline.yaml --in out/scenarios.parquet --out parts";
    for index in 0..3 {
        succeed(folder.path(), &format!("{call} --partition {index}/3"));
    }
    let before = bytes(&at("parts/part-00001.parquet"));
    for cut in ["1/5", "4/5"] {
        let refused = ["partition", "/3 is there", "this is partition", cut, "--overwrite"];
        fail(folder.path(), &format!("{call} --partition {cut}"), 2, &refused);
    }
    fail(folder.path(), &format!("{call}/part-00001.parquet"), 2, &["partition 1/3 is there", "the whole"]);
    assert!(bytes(&at("parts/part-00001.parquet")) == before && !at("parts/part-00004.parquet").exists());
    succeed(folder.path(), &format!("{call} --partition 1/3 --force"));
    succeed(folder.path(), &format!("{call} --partition 1/5 --overwrite"));
}
