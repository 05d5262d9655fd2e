//! Files: what is damaged, foreign or in the way is named, and nothing of the user's is lost.

use std::fs;
use std::io::{Cursor, Read, Write};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use std::process::Command;

use arrow_array::RecordBatch;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::metadata::{KeyValue, ParquetMetaDataWriter};
use parquet::file::properties::WriterProperties;

use crate::common::{SMALL, bytes, fail, folder, folder_with, made, rockfrag, succeed, texts, write};
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
    assert!(plan.contains("synthesize-motions: run"), "{plan}");
    fail(folder.path(), "run", 1, &["motions.parquet", "--force"]);
    let before = made(&folder.path().join("out/responses.parquet"));
    let simulate = "simulate --config pipeline.yaml --in out/motions.parquet --out out/responses.parquet";
    succeed(folder.path(), simulate);
    let after = made(&folder.path().join("out/responses.parquet"));
    assert!(before.key() != after.key() && before.arguments == after.arguments);
}

/// A workbook as a spreadsheet saves it: all parts stay, but for the time.
fn saved_again(book: Vec<u8>) -> Vec<u8> {
    let mut parts = zip::ZipArchive::new(Cursor::new(book)).unwrap();
    let mut saved = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for at in 0..parts.len() {
        let mut part = parts.by_index(at).unwrap();
        let mut text = String::new();
        part.read_to_string(&mut text).unwrap();
        saved.start_file(part.name(), zip::write::SimpleFileOptions::default()).unwrap();
        let text = text
            .replace("2000-01-01T00:00:00Z</dcterms:modified>", "2026-01-01T00:00:00Z</dcterms:modified>");
        saved.write_all(text.as_bytes()).unwrap();
    }
    saved.finish().unwrap().into_inner()
}

#[test]
fn foreign_texts_are_not_replaced_and_own_ones_are() {
    let folder = folder(&[
        ("mine.csv", "object,p_nr,note\ncabinet,1,checked with rockfrag\n"),
        ("notes.json", "{\"note\": \"made with rockfrag\", \"p_overturning\": 1}"),
    ]);
    let evaluate = |out: &str| format!("evaluate {BLOCK} --pga 0.4 --pgv 0.5 --out {out}");
    for name in ["mine.csv", "notes.json"] {
        let before = bytes(&folder.path().join(name));
        fail(folder.path(), &evaluate(name), 1, &[name, "--force"]);
        assert_eq!(bytes(&folder.path().join(name)), before);
    }
    for name in ["own.csv", "own.json"] {
        succeed(folder.path(), &evaluate(name));
        succeed(folder.path(), &evaluate(name).replace("0.4", "0.3"));
    }
    for name in ["cut.html", "cut.svg", "cut.png", "cut.xlsx"] {
        succeed(folder.path(), &evaluate(name));
        let whole = bytes(&folder.path().join(name));
        fs::write(folder.path().join(name), &whole[..whole.len() - 100]).unwrap();
        fail(folder.path(), &evaluate(name), 1, &[name, "--force"]);
        let mut edited = whole.clone();
        match name {
            "cut.xlsx" => edited = saved_again(whole),
            _ => edited[whole.len() / 2] ^= 1,
        }
        fs::write(folder.path().join(name), edited).unwrap();
        fail(folder.path(), &evaluate(name), 1, &[name, "--force"]);
    }
    let call = "evaluate --structures cut.xlsx#rockfrag --pga 0.4 --pgv 0.5 --out cut.xlsx --force";
    fail(folder.path(), call, 2, &["cut.xlsx", "is read"]);
    let export = format!("export --to pelicun {BLOCK} --out mine.csv");
    fail(folder.path(), &export, 1, &["mine.csv", "--force"]);
    fs::write(folder.path().join("f.xml"), "<?xml version=\"1.0\"?>\n<a>rockfrag</a>\n").unwrap();
    fail(folder.path(), &format!("export --to openquake {BLOCK} --out f.xml"), 1, &["f.xml", "--force"]);
    for height in ["2", "1.8"] {
        succeed(folder.path(), &format!("export --to openquake --width 0.5 --height {height} --out own.xml"));
    }
    for peak in ["pga", "pgv"] {
        succeed(folder.path(), &format!("export --to pelicun {BLOCK} --over {peak} --out other.csv"));
    }
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
    let name = format!("{}.parquet", "n".repeat(247));
    succeed(folder.path(), &sample(&name));
    assert!(succeed(folder.path(), &sample(&name)).1.contains("up to date"));
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
fn a_file_that_may_not_grow_is_an_error_and_leaves_nothing() {
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
        assert_eq!(output.status.code(), Some(1), "{call}: {output:?}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "{call}");
    }
    succeed(folder.path(), "init");
}
