//! Imports run downwards between the rooms of the house: the science knows no files, and no two rooms, and no
//! two files, import each other.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The rooms from the top down; those of one line stand beside each other.
const LAYERS: [&[&str]; 8] = [
    &["main", "cli"],
    &["stages"],
    &["pipeline"],
    &["table", "export", "report"],
    &["studies", "records"],
    &["inputs"],
    &["fragility", "hazard", "object", "paper"],
    &[
        "motion",
        "rocking",
        "random",
        "statistics",
        "spelling",
        "number",
        "plausibility",
        "source",
        "units",
        "warning",
    ],
];

fn layer(room: &str) -> usize {
    let layer = LAYERS.iter().position(|rooms| rooms.contains(&room));
    layer.unwrap_or_else(|| panic!("src/{room} is in no layer of this test"))
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

/// The path within src and the text of each source.
fn sources() -> Vec<(PathBuf, String)> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let sources =
        files(&src).into_iter().filter(|file| file.extension().is_some_and(|ending| ending == "rs"));
    let source = |file: PathBuf| {
        (file.strip_prefix(&src).unwrap().to_path_buf(), std::fs::read_to_string(&file).unwrap())
    };
    sources.map(source).collect()
}

fn room(module: &str) -> &str {
    module.split("::").next().unwrap()
}

/// Which rooms each room imports.
fn imports() -> BTreeMap<String, BTreeSet<String>> {
    let mut imports: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (module, used) in imports_of_files().into_iter().filter(|(module, _)| !module.is_empty()) {
        let others = used.iter().map(|used| room(used)).filter(|used| *used != room(&module));
        imports.entry(room(&module).to_string()).or_default().extend(others.map(str::to_string));
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

/// Fails if one imports itself by way of others.
fn expect_no_circle(imports: &BTreeMap<String, BTreeSet<String>>) {
    for one in imports.keys() {
        let (mut seen, mut next) = (BTreeSet::new(), vec![one.clone()]);
        while let Some(other) = next.pop() {
            for used in imports.get(&other).into_iter().flatten() {
                assert_ne!(used, one, "{one} imports itself by way of {other}");
                if seen.insert(used.clone()) {
                    next.push(used.clone());
                }
            }
        }
    }
}

#[test]
fn no_rooms_import_each_other_on_any_way() {
    expect_no_circle(&imports());
}

/// Splits `a::{b, c::{d, e}}` into `a::b`, `a::c::d` and `a::c::e`.
fn paths(of: &str) -> Vec<String> {
    let Some((head, rest)) = of.split_once('{') else { return vec![of.to_string()] };
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for sign in rest[..rest.rfind('}').unwrap()].chars() {
        depth += i32::from(sign == '{') - i32::from(sign == '}');
        match sign {
            ',' if depth == 0 => parts.push(String::new()),
            _ => parts.last_mut().unwrap().push(sign),
        }
    }
    let parts = parts.iter().filter(|part| !part.is_empty());
    parts.flat_map(|part| paths(part)).map(|path| format!("{head}{path}")).collect()
}

/// The path from the root of a path within a module; none of another crate's.
fn absolute(module: &str, path: &str) -> Option<String> {
    let mut base: Vec<&str> = module.split("::").filter(|part| !part.is_empty()).collect();
    let mut path: Vec<&str> = path.split("::").collect();
    match path[0] {
        "crate" => base.clear(),
        "self" => {}
        "super" => {
            while path[0] == "super" {
                base.pop();
                path.remove(0);
            }
            path.insert(0, "super");
        }
        _ => return None,
    }
    path.remove(0);
    Some(base.into_iter().chain(path).filter(|part| *part != "self").collect::<Vec<_>>().join("::"))
}

/// Which files each file imports, by their modules. What a `mod.rs` hands on of its room with `pub use` is
/// of the file that has it, and is no import of `mod.rs`.
fn imports_of_files() -> BTreeMap<String, BTreeSet<String>> {
    let (mut used, mut handed_on): (BTreeMap<String, Vec<String>>, BTreeMap<String, String>) =
        Default::default();
    for (inside, text) in sources() {
        let inside = inside.with_extension("");
        let names: Vec<_> = inside.iter().map(|part| part.to_string_lossy()).collect();
        let names = names.strip_suffix(&["mod".into()]).unwrap_or(&names);
        let module = if names == ["lib"] { String::new() } else { names.join("::") };
        let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        let paths_of_module = used.entry(module.clone()).or_default();
        for statement in lines.collect::<Vec<_>>().join(" ").split(';') {
            let statement = statement.trim_start();
            let is_public = statement.starts_with("pub use ");
            let path = statement.trim_start_matches("pub ").strip_prefix("use ");
            let path = path.filter(|path| !path.contains(['"', '-']));
            let uses = path.map_or_else(
                || {
                    let words =
                        statement.split(|sign: char| !(sign.is_alphanumeric() || "_:".contains(sign)));
                    words.filter(|word| word.contains("::")).map(str::to_string).collect()
                },
                |path| paths(&path.replace(' ', "")),
            );
            for path in uses {
                let local =
                    || is_public.then(|| format!("{module}::{path}").trim_start_matches(':').to_string());
                let Some(full) = absolute(&module, &path).or_else(local) else { continue };
                if !is_public || room(&full) != room(&module) {
                    paths_of_module.push(full.clone());
                }
                if is_public {
                    let name = full.rsplit("::").next().unwrap();
                    handed_on.insert(format!("{module}::{name}"), full);
                }
            }
        }
    }
    let home = |path: &String| -> Option<String> {
        let mut path = handed_on.get(path).unwrap_or(path).clone();
        while !used.contains_key(&path) {
            path.truncate(path.rfind("::")?);
        }
        Some(path)
    };
    let imported = |(module, paths): (&String, &Vec<String>)| {
        let homes = paths.iter().filter_map(home).filter(|home| home != module);
        (module.clone(), homes.collect())
    };
    used.iter().map(imported).collect()
}

#[test]
fn no_files_import_each_other_on_any_way() {
    let imports = imports_of_files();
    assert!(imports.values().map(BTreeSet::len).sum::<usize>() > 400, "the sources are read");
    expect_no_circle(&imports);
}

/// The fields of all structs that are rows of tables.
fn columns_of_rows() -> BTreeSet<String> {
    let fields = |text: String| -> Vec<String> {
        let rows =
            text.split("#[derive(").skip(1).filter(|row| row.lines().next().unwrap().contains("Serialize"));
        let bodies = rows.filter_map(|row| row.split_once(" {\n")?.1.split("\n}").next());
        let lines =
            bodies.flat_map(|body| body.lines().map(str::trim).filter(|line| !line.starts_with("//")));
        let columns = |(name, kind): (&str, &str)| {
            let ends = match kind {
                "Limited," => " _low _high",
                "Bounds," => "_low _high",
                "Lognormal," => {
                    "_16 _16_low _16_high _theta _theta_low _theta_high _84 _84_low _84_high _beta _error"
                }
                _ => "",
            };
            ends.split(' ').map(|end| format!("{name}{end}")).collect::<Vec<_>>()
        };
        let renamed =
            lines.clone().filter_map(|line| line.strip_prefix("#[serde(rename = \"")?.split('"').next());
        let fields = lines.filter_map(|line| line.trim_start_matches("pub ").split_once(": "));
        fields.flat_map(columns).chain(renamed.map(str::to_string)).collect()
    };
    sources().into_iter().flat_map(|(_, text)| fields(text)).collect()
}

#[test]
fn every_column_of_the_dictionary_is_written() {
    let written = columns_of_rows();
    let made_of_samples = ["acceleration_m_s2", "sa_*_m_s2"];
    for name in rockfrag::table::dictionary::names() {
        assert!(written.contains(name) || made_of_samples.contains(&name), "no table has a column {name}");
    }
}
