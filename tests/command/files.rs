//! Files: what is damaged, foreign or in the way is named, and nothing of the user's is lost.

use std::fs::{self, DirEntry};
use std::os::unix::fs::{PermissionsExt, chown, symlink};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use arrow_array::RecordBatch;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::metadata::{KeyValue, ParquetMetaDataWriter};
use parquet::file::properties::WriterProperties;

use crate::common::{SMALL, bytes, fail, folder, folder_with, made, ran, rockfrag, succeed, texts, write};
use crate::common::{write_motions, write_with};

const STRUCTURE: &str = "--p 2.5 --alpha 0.2 --eta 0.92";
const BLOCK: &str = "--width 0.5 --height 2";
const HAZARD: &str = "pga_g,annual_rate\n0.1,0.01\n0.3,0.001\n1.0,0.00005\n";

/// The first rows of a file, and its metadata.
fn first_batch(path: &Path) -> (RecordBatch, Option<Vec<KeyValue>>) {
    let reader = ParquetRecordBatchReaderBuilder::try_new(fs::File::open(path).unwrap()).unwrap();
    let pairs = reader.metadata().file_metadata().key_value_metadata().cloned();
    (reader.build().unwrap().next().unwrap().unwrap(), pairs)
}

#[test]
fn a_fit_without_a_status_is_refused() {
    let folder = folder_with(SMALL);
    succeed(folder.path(), "run");
    let path = folder.path().join("out/pro.parquet");
    let (batch, _) = first_batch(&path);
    let nothing = texts(&vec![""; batch.num_rows()]);
    let schema = batch.schema();
    let columns = schema.fields().iter().zip(batch.columns()).map(|(field, column)| {
        (field.name().as_str(), if field.name() == "status" { nothing.clone() } else { column.clone() })
    });
    write(&path, columns.collect());
    let call = "evaluate --fits out --model paper --suite csgm --name frame --pga 0.4 --pgv 0.5";
    fail(folder.path(), call, 1, &["pro.parquet", "status"]);
}

#[test]
fn damaged_files_are_errors_that_name_them() {
    let folder = folder_with(SMALL);
    succeed(folder.path(), "run");
    let motions = bytes(&folder.path().join("out/motions.parquet"));
    let size = motions.len();
    let damaged =
        [vec![], motions[..size / 2].to_vec(), motions[..size - 3].to_vec(), b"pga,pgv\n1,2\n".to_vec()];
    let flips = (1..60).map(|k| {
        let at = size - 7 * k * k % size - 1;
        [&motions[..at], &[motions[at] ^ 0x55], &motions[at + 1..]].concat()
    });
    for (number, content) in damaged.into_iter().chain(flips).enumerate() {
        fs::write(folder.path().join("m.parquet"), content).unwrap();
        let call = format!("simulate --in m.parquet --out r.parquet --quiet {STRUCTURE}");
        let output = rockfrag(folder.path(), &call).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        // A flipped bit of a column that is not read is no error.
        assert!(number >= 4 || !output.status.success(), "{number}");
        assert!(output.status.success() || stderr.contains("m.parquet"), "{number}: {stderr}");
        assert!(!stderr.contains("panicked") && output.status.code().is_some(), "{number}: {stderr}");
        let _ = fs::remove_file(folder.path().join("r.parquet"));
    }
}

#[test]
fn what_is_in_the_way_is_kept_unless_it_is_given_up() {
    let folder = folder_with(SMALL);
    succeed(folder.path(), "run");
    let simulate =
        |out: &str, more: &str| format!("simulate --in out/motions.parquet --out {out} {STRUCTURE} {more}");
    fail(folder.path(), &simulate("out/motions.parquet", "--force"), 2, &["out/motions.parquet"]);
    fs::create_dir(folder.path().join("folder")).unwrap();
    fail(folder.path(), &simulate("folder", ""), 2, &["folder"]);
    let other = folder.path().join("other.parquet");
    write_motions(&other, 0.01, &[&[0.0, 1.0]]);
    fs::write(folder.path().join("notes.parquet"), "my notes").unwrap();
    for name in ["other.parquet", "notes.parquet"] {
        let before = bytes(&folder.path().join(name));
        fail(folder.path(), &simulate(name, ""), 1, &[name, "--force"]);
        assert_eq!(bytes(&folder.path().join(name)), before);
        succeed(folder.path(), &simulate(name, "--force"));
    }
    let responses = folder.path().join("out/responses.parquet");
    for mode in [0o600, 0o400] {
        fs::set_permissions(&responses, fs::Permissions::from_mode(mode)).unwrap();
        match mode {
            0o600 => drop(succeed(folder.path(), &simulate("out/responses.parquet", ""))),
            _ => fail(
                folder.path(),
                &simulate("out/responses.parquet", "--trace 0"),
                2,
                &["read-only", "--force"],
            ),
        }
        assert_eq!(fs::metadata(&responses).unwrap().permissions().mode() & 0o777, mode, "stays private");
    }
}

#[test]
fn a_file_that_another_program_rewrote_is_not_taken_for_ours() {
    let folder = folder_with(SMALL);
    succeed(folder.path(), "run");
    let path = folder.path().join("out/motions.parquet");
    let (batch, pairs) = first_batch(&path);
    let properties = WriterProperties::builder().set_key_value_metadata(pairs).build();
    write_with(&path, &batch.slice(0, 5), properties);
    let (plan, _) = succeed(folder.path(), "run --dry-run");
    assert!(plan.contains("synthesize-motions: cannot run") && plan.contains("--force"), "{plan}");
    fail(folder.path(), "run", 1, &["motions.parquet", "--force"]);
    let before = made(&folder.path().join("out/responses.parquet"));
    let simulate = "simulate --config pipeline.yaml --in out/motions.parquet --out out/responses.parquet";
    succeed(folder.path(), simulate);
    let after = made(&folder.path().join("out/responses.parquet"));
    assert!(before.key() != after.key() && before.arguments == after.arguments);
}

#[test]
fn a_view_is_written_again_if_it_names_rockfrag_or_a_run_names_it() {
    let folder = folder(&[
        ("mine.csv", "object,p_nr,note\ncabinet,1,checked with rockfrag\n"),
        ("notes.html", "<html><title>rockfrag</title></html>"),
        ("drawing.svg", "<svg><desc>of rockfrag</desc></svg>"),
        ("photo.png", "rockfrag"),
        ("list.xlsx", ""),
        ("pipeline.yaml", "out: .\nevaluate: { width: 0.5, height: 2, pga: 0.4, pgv: 0.5, out: run.csv }\n"),
    ]);
    let at = |name: &str| folder.path().join(name);
    let evaluate = |out: &str| format!("evaluate {BLOCK} --pga 0.4 --pgv 0.5 --out {out}");
    for name in ["mine.csv", "notes.html", "drawing.svg", "photo.png", "list.xlsx"] {
        let before = bytes(&at(name));
        fail(folder.path(), &evaluate(name), 1, &[name, "--force"]);
        assert_eq!(bytes(&at(name)), before, "{name}");
        succeed(folder.path(), &format!("{} --force", evaluate(name)));
    }
    for (name, is_known) in [
        ("a.html", true),
        ("a.svg", true),
        ("a.png", true),
        ("a.csv", false),
        ("a.json", false),
        ("a.xlsx", false),
    ] {
        succeed(folder.path(), &evaluate(name));
        let first = bytes(&at(name));
        match is_known {
            true => drop(succeed(folder.path(), &evaluate(name))),
            false => fail(folder.path(), &evaluate(name), 1, &[name, "--force"]),
        }
        let (_, stderr) = succeed(folder.path(), &format!("{} --force", evaluate(name)));
        assert!(bytes(&at(name)) == first && !stderr.contains("up to date"), "{name}");
    }
    fs::create_dir(at("folder.csv")).unwrap();
    fail(folder.path(), &format!("{} --force", evaluate("folder.csv")), 2, &["folder.csv"]);
    let listed = "evaluate --structures a.xlsx#rockfrag --pga 0.4 --pgv 0.5 --out a.xlsx --force";
    fail(folder.path(), listed, 2, &["a.xlsx", "is read"]);
    for (to, out) in [("openquake", "e.xml"), ("pelicun", "e.csv")] {
        let export = format!("export --to {to} {BLOCK} --out {out}");
        succeed(folder.path(), &export);
        fail(folder.path(), &export, 1, &["--force"]);
    }
    for _ in 0..2 {
        assert_eq!(ran(&succeed(folder.path(), "run").1), ["evaluate"]);
    }
    for (out, code) in [("notes.html", 0), ("pipeline.html", 1), ("list.csv", 2)] {
        fs::write(at("pipeline.html"), "another's").unwrap();
        fs::write(at("list.csv"), "name,width,height\na,0.5,2\n").unwrap();
        let yaml = format!(
            "out: .\nsimulate: {{ structures: list.csv }}\n\
             evaluate: {{ width: 0.5, height: 2, pga: 0.4, pgv: 0.5, out: {out} }}\n"
        );
        let yaml = if code == 2 { yaml } else { yaml.replace("simulate: { structures: list.csv }\n", "") };
        fs::write(at("pipeline.yaml"), yaml).unwrap();
        let output = rockfrag(folder.path(), "run").output().unwrap();
        assert_eq!(output.status.code(), Some(code), "{out}: {output:?}");
    }
}

/// Calls the command and stops it when its temporary file is there, does something, and lets it go on.
fn meanwhile(folder: &Path, call: &str, act: impl FnOnce()) -> Output {
    let mut call = rockfrag(folder, call);
    let mut running = call.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let id = running.id().to_string();
    let signal = |name: &str| assert!(Command::new("kill").args([name, &id]).status().unwrap().success());
    let is_partial = |entry: DirEntry| entry.file_name().to_string_lossy().ends_with(".partial");
    while !fs::read_dir(folder).unwrap().flatten().any(is_partial) {
        assert!(running.try_wait().unwrap().is_none(), "it has ended");
    }
    signal("-STOP");
    act();
    signal("-CONT");
    running.wait_with_output().unwrap()
}

#[test]
fn what_comes_while_a_stage_runs_is_kept() {
    let folder = folder(&[("victim.txt", "victim"), ("list.csv", "name,width,height\na,0.5,2\n")]);
    let at = |name: &str| folder.path().join(name);
    succeed(folder.path(), "sample-scenarios --samples 4 --out s.parquet");
    succeed(folder.path(), "synthesize-motions --in s.parquet --suite csgm --out m.parquet");
    let simulate = "simulate --in m.parquet --structures list.csv --out";
    let put = || fs::write(at("file.parquet"), "work of a user").unwrap();
    let output = meanwhile(folder.path(), &format!("{simulate} file.parquet"), put);
    assert_eq!(bytes(&at("file.parquet")), b"work of a user", "{output:?}");
    let link = || symlink("victim.txt", at("link.parquet")).unwrap();
    let output = meanwhile(folder.path(), &format!("{simulate} link.parquet"), link);
    assert!(bytes(&at("victim.txt")) == b"victim" && at("link.parquet").is_symlink(), "{output:?}");
    // A run that fails removes nothing.
    succeed(folder.path(), &format!("{simulate} r.parquet --trace 1"));
    let change = || fs::write(at("list.csv"), "name,width,height\nb,0.5,1.8\n").unwrap();
    let output = meanwhile(folder.path(), &format!("{simulate} r.parquet"), change);
    assert!(at("r.trace.parquet").exists() && output.status.code() == Some(1), "{output:?}");
}

#[test]
fn a_trace_goes_with_its_responses_and_that_of_another_call_stays() {
    let folder = folder(&[]);
    let at = |name: &str| folder.path().join(name);
    write_motions(&at("m.parquet"), 0.01, &[&[0.0, 1.0, 0.0]]);
    let simulate = format!("simulate --in m.parquet {STRUCTURE} --out");
    succeed(folder.path(), &format!("{simulate} run.trace.parquet"));
    let before = bytes(&at("run.trace.parquet"));
    for out in ["run.parquet", "run.parquet --force"] {
        succeed(folder.path(), &format!("{simulate} {out}"));
        assert!(at("run.trace.parquet").exists() && bytes(&at("run.trace.parquet")) == before);
    }
    succeed(folder.path(), &format!("{simulate} traced.parquet --trace 0"));
    assert!(at("traced.trace.parquet").exists());
    succeed(folder.path(), &format!("{simulate} traced.parquet"));
    assert!(!at("traced.trace.parquet").exists());
}

#[test]
fn a_result_takes_no_more_than_the_permissions_of_its_owner() {
    let folder = folder(&[]);
    let path = folder.path().join("s.parquet");
    let sample = "sample-scenarios --mw 7 --re 5 --samples 2 --out s.parquet --force";
    let mode = || fs::metadata(&path).unwrap().permissions().mode() & 0o7777;
    succeed(folder.path(), sample);
    let usual = mode();
    for (mode_before, owner, expected) in [(0o4640, None, 0o640), (0o6777, Some(1000), usual)] {
        // Only root gives a file away.
        if chown(&path, owner, None).is_ok() {
            fs::set_permissions(&path, fs::Permissions::from_mode(mode_before)).unwrap();
            succeed(folder.path(), sample);
            assert_eq!(mode(), expected, "{owner:?}");
        }
    }
}

#[test]
fn files_of_a_stage_get_their_names_all_or_none() {
    let folder = folder(&[]);
    let at = |name: &str| folder.path().join(name);
    let push: Vec<f64> = (0..200).map(|k| 5.0 * (0.05 * f64::from(k)).sin()).collect();
    write_motions(&at("m.parquet"), 0.01, &[&push]);
    // With this name `stripes`, the first part, has 255 letters, and `fragility`, the next one, too many.
    let name = "n".repeat(239);
    let ida = format!("ida --in m.parquet {STRUCTURE} --out {name}.parquet");
    fail(folder.path(), &ida, 1, &["cannot write", "fragility"]);
    let there = || fs::read_dir(folder.path()).unwrap().map(|file| file.unwrap().file_name());
    assert_eq!(there().collect::<Vec<_>>(), ["m.parquet"], "no file is new");
    let stripes = at(&format!("{name}.stripes.parquet"));
    succeed(folder.path(), "sample-scenarios --mw 7 --re 5 --samples 2 --out s.parquet");
    fs::rename(at("s.parquet"), &stripes).unwrap();
    let before = bytes(&stripes);
    fail(folder.path(), &ida, 1, &["cannot write", "fragility"]);
    assert!(bytes(&stripes) == before && there().count() == 2, "{:?}", there().collect::<Vec<_>>());
}

/// What names rockfrag in a page and a figure.
const GENERATOR: &str = "<meta name=\"generator\" content=\"rockfrag 0\">";

#[test]
fn a_page_that_names_files_does_nothing_to_them() {
    let folder = folder_with(SMALL);
    succeed(folder.path(), "run");
    let at = |name: &str| folder.path().join(name);
    let names = ["victim.txt".to_string(), "out/report/victim.csv".to_string()];
    fs::create_dir(at("out/report")).unwrap();
    names.iter().for_each(|name| fs::write(at(name), "notes").unwrap());
    // A page as 0.2 wrote it, with the names and hashes of files that it should have written.
    let hash = blake3::hash(b"notes").to_hex();
    let further = format!(
        "{{&quot;../victim.txt&quot;:&quot;{hash}&quot;,&quot;report/victim.csv&quot;:&quot;{hash}&quot;}}"
    );
    let page =
        format!("{GENERATOR}\n<meta name=\"rockfrag\" content=\"{{&quot;further&quot;:{further}}}\">\n");
    let seal = blake3::hash(page.as_bytes()).to_hex();
    fs::write(at("out/report.html"), format!("{page}<!-- hash {seal} -->\n")).unwrap();
    succeed(folder.path(), "report --in out");
    assert!(names.iter().all(|name| at(name).exists()));
}

#[test]
fn a_pipe_is_read_once_and_never_replaced() {
    let folder = folder(&[("h.csv", HAZARD), ("list.csv", "name,width,height\nshelf,0.5,2\n")]);
    let shell = |call: &str| {
        let line = call.replace("rockfrag", env!("CARGO_BIN_EXE_rockfrag"));
        let mut call = Command::new("timeout");
        let output = call.args(["60", "bash", "-c", &line]).current_dir(folder.path()).output().unwrap();
        let [stdout, stderr] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
        (output.status.code(), stdout, stderr)
    };
    let (code, direct, _) = shell(&format!("rockfrag evaluate {BLOCK} --hazard h.csv"));
    assert_eq!(code, Some(0));
    for call in [
        format!("rockfrag evaluate {BLOCK} --hazard <(cat h.csv)"),
        format!("rockfrag evaluate {BLOCK} --hazard - < h.csv"),
        format!("cat h.csv | rockfrag evaluate {BLOCK} --hazard /dev/stdin"),
        format!("mkfifo f; cat h.csv > f & rockfrag evaluate {BLOCK} --hazard f"),
    ] {
        let (code, printed, _) = shell(&call);
        assert_eq!((code, &printed), (Some(0), &direct), "{call}");
    }
    let (code, _, stderr) = shell(&format!("rockfrag evaluate {BLOCK} --hazard /dev/zero"));
    assert!(code == Some(1) && stderr.contains("/dev/zero"), "{stderr}");
    for call in ["run /dev/zero", "evaluate --width 0.5 --height 2 --config /dev/zero"] {
        let (code, _, stderr) = shell(&format!("ulimit -v 4000000; rockfrag {call}"));
        assert!(code == Some(2) && stderr.contains("device"), "{call}: {stderr}");
    }
    let (code, _, stderr) = shell("rockfrag evaluate --structures - --hazard h.csv < list.csv");
    assert_eq!(code, Some(0), "{stderr}");
    let evaluate = format!("rockfrag evaluate {BLOCK} --pga 0.3 --pgv 0.3 --force --out p.parquet");
    let (code, _, stderr) = shell(&format!("mkfifo p.parquet; {evaluate}"));
    assert!(code == Some(2) && stderr.contains("p.parquet"), "{stderr}");
}

#[test]
fn a_link_keeps_pointing_and_a_long_name_is_a_name() {
    let folder = folder(&[]);
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("there")).unwrap();
    let sample = |out: &str| format!("sample-scenarios --mw 7 --re 5 --samples 2 --out {out}");
    for _ in 0..2 {
        let _ = fs::remove_file(path("link.parquet"));
        symlink("there/s.parquet", path("link.parquet")).unwrap();
        succeed(folder.path(), &format!("{} --force", sample("link.parquet")));
        assert!(path("link.parquet").is_symlink() && path("there/s.parquet").is_file());
    }
    symlink("nowhere/s.parquet", path("lost.parquet")).unwrap();
    fail(folder.path(), &sample("lost.parquet"), 1, &["lost.parquet", "nowhere"]);
    assert!(!path("nowhere").exists());
    for (link, target) in [("chain.parquet", "next.parquet"), ("next.parquet", "there/last.parquet")] {
        symlink(target, path(link)).unwrap();
    }
    succeed(folder.path(), &sample("chain.parquet"));
    assert!(["chain.parquet", "next.parquet"].iter().all(|link| path(link).is_symlink()));
    assert!(path("there/last.parquet").is_file());
    let name = format!("{}.parquet", "n".repeat(247));
    succeed(folder.path(), &sample(&name));
    assert!(succeed(folder.path(), &sample(&name)).1.contains("up to date"));
}

#[test]
fn only_what_a_killed_run_left_is_removed() {
    let folder =
        folder(&[(".s.parquet.backup.partial", "mine"), (".s.parquet.0123456789abcdef.partial", "")]);
    for letters in ["abcdef", "abcdefghijklmnop"] {
        let fifo = folder.path().join(format!(".s.parquet.{letters}.partial"));
        assert!(Command::new("mkfifo").arg(fifo).status().unwrap().success());
    }
    let mut call = Command::new("timeout");
    call.args([
        "60",
        env!("CARGO_BIN_EXE_rockfrag"),
        "sample-scenarios",
        "--samples",
        "2",
        "--out",
        "s.parquet",
    ]);
    assert_eq!(call.current_dir(folder.path()).status().unwrap().code(), Some(0));
    let names =
        fs::read_dir(folder.path()).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort_unstable();
    let kept = ["abcdef.partial", "abcdefghijklmnop.partial", "backup.partial"];
    assert_eq!(
        names,
        [kept.map(|name| format!(".s.parquet.{name}")).to_vec(), vec!["s.parquet".into()]].concat()
    );
}

#[test]
fn a_table_whose_footer_points_before_its_start_is_damaged() {
    let folder = folder(&[]);
    succeed(folder.path(), "sample-scenarios --samples 2 --out s.parquet");
    let path = folder.path().join("s.parquet");
    let reader = ParquetRecordBatchReaderBuilder::try_new(fs::File::open(&path).unwrap()).unwrap();
    let footer = reader.metadata().as_ref().clone();
    let groups = footer.row_groups().iter().map(|group| {
        let columns = group.columns().iter().map(|column| {
            let builder = column.clone().into_builder().set_dictionary_page_offset(None);
            builder.set_data_page_offset(-5).build().unwrap()
        });
        group.clone().into_builder().set_column_metadata(columns.collect()).build().unwrap()
    });
    let groups = groups.collect();
    let mut damaged = bytes(&path);
    let footer = footer.into_builder().set_row_groups(groups).build();
    ParquetMetaDataWriter::new(&mut damaged, &footer).finish().unwrap();
    fs::write(&path, damaged).unwrap();
    fail(folder.path(), "synthesize-motions --in s.parquet --out m.parquet", 1, &["s.parquet", "damaged"]);
}

#[test]
fn a_file_that_may_not_grow_gets_no_name() {
    let run = folder_with(SMALL);
    succeed(run.path(), "run");
    let responses = run.path().join("out/responses.parquet");
    let fit = format!("fit-pex --in {} --out pex.parquet", responses.display());
    // Enough for all files of the fit but the last.
    let last = (bytes(&run.path().join("out/pex.parquet")).len() / 1024) as u32;
    let folder = folder(&[]);
    for (most_kb, call) in [
        (0, "init"),
        (0, "sample-scenarios --samples 2"),
        (0, "export --to openquake --width 0.5 --height 2"),
        (last, &fit),
    ] {
        let line = format!("ulimit -f {most_kb}; {} {call}", env!("CARGO_BIN_EXE_rockfrag"));
        let output = Command::new("bash").args(["-c", &line]).current_dir(folder.path()).output().unwrap();
        assert!(!output.status.success(), "{call}: {output:?}");
        let names = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name());
        assert!(names.map(|name| name.into_string().unwrap()).all(|name| name.starts_with('.')), "{call}");
    }
    succeed(folder.path(), "init");
}

#[test]
fn what_cannot_be_read_is_not_called_damaged() {
    let folder = folder(&[]);
    symlink("/proc/self/mem", folder.path().join("mem.parquet")).unwrap();
    // Input/output error
    fail(folder.path(), "inspect mem.parquet", 1, &["mem.parquet", "os error 5"]);
}
