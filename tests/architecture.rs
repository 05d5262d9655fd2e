//! Imports run downwards between the rooms of the house: the science knows no files, and no two rooms import
//! each other.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The rooms from the top down; those of one line stand beside each other.
const LAYERS: [&[&str]; 7] = [
    &["main", "cli"],
    &["stages"],
    &["pipeline"],
    &["table", "export", "report"],
    &["studies", "records"],
    &["fragility", "hazard", "paper", "sheet"],
    &["motion", "rocking", "random", "statistics", "keyword", "number", "plausibility", "units", "warning"],
];

fn layer(room: &str) -> usize {
    let layer = LAYERS.iter().position(|rooms| rooms.contains(&room));
    layer.unwrap_or_else(|| panic!("src/{room} is in no layer of this test"))
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

/// Which rooms each room imports.
fn imports() -> BTreeMap<String, BTreeSet<String>> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut imports: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for file in files(&src).into_iter().filter(|file| file.extension().is_some_and(|ending| ending == "rs")) {
        let inside = file.strip_prefix(&src).unwrap();
        let room =
            Path::new(inside.iter().next().unwrap()).file_stem().unwrap().to_string_lossy().into_owned();
        if room == "lib" {
            continue;
        }
        let text = std::fs::read_to_string(&file).unwrap();
        let code =
            text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
        let used = code
            .split("crate::")
            .skip(1)
            .map(|path| path.split(|sign: char| !sign.is_alphanumeric() && sign != '_').next().unwrap());
        imports
            .entry(room.clone())
            .or_default()
            .extend(used.filter(|used| *used != room && !used.is_empty()).map(str::to_string));
    }
    imports
}

#[test]
fn imports_run_downwards() {
    for (room, used) in imports() {
        for other in used {
            assert!(layer(&other) >= layer(&room), "src/{room} imports src/{other}, which stands above it");
        }
    }
}

#[test]
fn no_rooms_import_each_other_on_any_way() {
    let imports = imports();
    for room in imports.keys() {
        let (mut seen, mut next) = (BTreeSet::new(), vec![room.clone()]);
        while let Some(other) = next.pop() {
            for used in imports.get(&other).into_iter().flatten() {
                assert_ne!(used, room, "src/{room} imports itself by way of src/{other}");
                if seen.insert(used.clone()) {
                    next.push(used.clone());
                }
            }
        }
    }
}

/// The fields of all structs that are rows of tables.
fn columns_of_rows() -> BTreeSet<String> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let is_code = |file: &PathBuf| file.extension().is_some_and(|ending| ending == "rs");
    let texts = files(&src).into_iter().filter(is_code).map(|file| std::fs::read_to_string(file).unwrap());
    let fields = |text: String| -> Vec<String> {
        let rows =
            text.split("#[derive(").skip(1).filter(|row| row.lines().next().unwrap().contains("Serialize"));
        let bodies = rows.filter_map(|row| row.split_once(" {\n")?.1.split("\n}").next());
        let lines =
            bodies.flat_map(|body| body.lines().map(str::trim).filter(|line| !line.starts_with("//")));
        let names = lines.filter_map(|line| Some(line.trim_start_matches("pub ").split_once(": ")?.0));
        names.map(str::to_string).collect()
    };
    texts.flat_map(fields).collect()
}

#[test]
fn every_column_of_the_dictionary_is_written() {
    let written = columns_of_rows();
    let made_of_samples = ["acceleration_m_s2", "sa_*_m_s2"];
    for name in rockfrag::table::dictionary::names() {
        assert!(written.contains(name) || made_of_samples.contains(&name), "no table has a column {name}");
    }
}
