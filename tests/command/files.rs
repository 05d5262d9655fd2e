//! Files: what is damaged, foreign or in the way is named, and nothing of the user's is lost.

use std::fs::{self, DirEntry};
use std::os::unix::fs::{PermissionsExt, chown, symlink};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use arrow_array::RecordBatch;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;

use crate::common::{BLOCK, STRUCTURE, bytes, fail, folder, made, ran, rockfrag, small_run, succeed};
use crate::common::{write_motions, write_with};

fn first_batch(path: &Path) -> (RecordBatch, Option<Vec<KeyValue>>) {
    let reader = ParquetRecordBatchReaderBuilder::try_new(fs::File::open(path).unwrap()).unwrap();
    let pairs = reader.metadata().file_metadata().key_value_metadata().cloned();
    (reader.build().unwrap().next().unwrap().unwrap(), pairs)
}

#[test]
fn what_is_in_the_way_is_kept_unless_it_is_given_up() {
    let folder = small_run();
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
    let mode = || fs::metadata(&responses).unwrap().permissions().mode() & 0o777;
    fs::set_permissions(&responses, fs::Permissions::from_mode(0o600)).unwrap();
    succeed(folder.path(), &simulate("out/responses.parquet", ""));
    assert_eq!(mode(), 0o600, "stays private");
    fs::set_permissions(&responses, fs::Permissions::from_mode(0o400)).unwrap();
    let traced = simulate("out/responses.parquet", "--trace 0");
    fail(folder.path(), &traced, 2, &["read-only", "--force"]);
    assert_eq!(mode(), 0o400);
}

#[test]
fn a_file_that_another_program_rewrote_is_not_taken_for_ours() {
    let folder = small_run();
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
        ("mine.csv", "object,p_rocking,note\ncabinet,1,checked with rockfrag\n"),
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
    for name in ["a.html", "a.svg", "a.png", "a.csv", "a.json", "a.xlsx"] {
        let is_known = ["a.html", "a.svg", "a.png"].contains(&name);
        succeed(folder.path(), &evaluate(name));
        let first = bytes(&at(name));
        let other = evaluate(name).replace("--pga 0.4", "--pga 0.6");
        match is_known {
            true => drop(succeed(folder.path(), &other)),
            false => fail(folder.path(), &other, 1, &[name, "--force"]),
        }
        assert_eq!(bytes(&at(name)) != first, is_known, "{name}");
        let (_, stderr) = succeed(folder.path(), &format!("{} --force", evaluate(name)));
        assert!(bytes(&at(name)) == first && !stderr.contains("up to date"), "{name}");
    }
    fs::create_dir(at("folder.csv")).unwrap();
    fail(folder.path(), &format!("{} --force", evaluate("folder.csv")), 2, &["folder.csv"]);
    let listed = "evaluate --structures a.xlsx#rockfrag --pga 0.4 --pgv 0.5 --out a.xlsx --force";
    fail(folder.path(), listed, 2, &["a.xlsx", "is read"]);
    for _ in 0..2 {
        assert_eq!(ran(&succeed(folder.path(), "run").1), ["evaluate"]);
    }
    fs::write(at("pipeline.html"), "another's").unwrap();
    fs::write(at("list.csv"), "name,width,height\na,0.5,2\n").unwrap();
    let yaml = "evaluate: { width: 0.5, height: 2, pga: 0.4, pgv: 0.5, out: a.html }\n";
    let read = "out: .\nsimulate: { structures: list.csv }\n";
    for (before, out, code) in [("", "notes.html", 0), ("", "pipeline.html", 1), (read, "list.csv", 2)] {
        fs::write(at("pipeline.yaml"), before.to_string() + &yaml.replace("a.html", out)).unwrap();
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

#[test]
fn a_pipe_is_read_once_and_never_replaced() {
    let folder = folder(&[
        ("h.csv", include_str!("../../data/hazard.csv")),
        ("list.csv", "name,width,height\nshelf,0.5,2\n"),
    ]);
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
        // The last line names the file.
        let [printed, direct] =
            [&printed, &direct].map(|text| text.lines().rev().skip(1).collect::<Vec<_>>());
        assert_eq!((code, printed), (Some(0), direct), "{call}");
    }
    let own = "rockfrag export --structures <(sed s/width/w1/ list.csv) --columns width=w1 --to pelicun";
    let evaluate = "rockfrag evaluate --pga 0.3 --pgv 0.3 --out e.parquet";
    let two = "--structure 'name=a b,p=1,alpha=.2,eta=.9' --structure name=c,width=1,height=3";
    let pasted = format!("rockfrag inspect e.parquet | grep -e --structure | xargs {evaluate}");
    let little = "ulimit -v 4000000; rockfrag";
    for (call, code, named) in [
        ("rockfrag evaluate --width 0.5 --height 2 --hazard /dev/zero", 1, "/dev/zero"),
        (&format!("{little} run /dev/zero"), 2, "device"),
        (&format!("{little} evaluate --width 0.5 --height 2 --config /dev/zero"), 2, "device"),
        ("rockfrag evaluate --structures - --hazard h.csv < list.csv", 0, ""),
        // What cannot be read is not called damaged: an error of input or output.
        ("ln -s /proc/self/mem mem.parquet; rockfrag inspect mem.parquet", 1, "os error 5"),
        ("rockfrag sample-scenarios --out >(cat)", 2, "device"),
        ("rockfrag sample-scenarios --out -", 2, ".parquet"),
        ("mkdir -p hive/scenario=1; rockfrag simulate --in hive", 1, "scenario=1"),
        (own, 0, ""),
        (&format!("{evaluate} {two}; {pasted}"), 0, "up to date"),
    ] {
        let (found, _, stderr) = shell(call);
        assert!(found == Some(code) && stderr.contains(named), "{call}: {stderr}");
    }
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
    symlink("next.parquet", path("chain.parquet")).unwrap();
    symlink("there/last.parquet", path("next.parquet")).unwrap();
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
    let sample = "sample-scenarios --samples 2 --out s.parquet";
    let call = format!("60 {} {sample}", env!("CARGO_BIN_EXE_rockfrag"));
    let mut call = Command::new("timeout").args(call.split(' ')).current_dir(folder.path()).spawn().unwrap();
    assert_eq!(call.wait().unwrap().code(), Some(0));
    let there = fs::read_dir(folder.path()).unwrap();
    let names = there.map(|file| file.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.filter(|name| name != "s.parquet").collect();
    names.sort_unstable();
    let kept = ["abcdef.partial", "abcdefghijklmnop.partial", "backup.partial"];
    assert_eq!(names, kept.map(|name| format!(".s.parquet.{name}")));
}

#[test]
fn a_file_that_may_not_grow_gets_no_name() {
    let run = small_run();
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
}
