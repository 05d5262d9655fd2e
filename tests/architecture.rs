//! The shape of the source tree: imports run downwards from the command line to the arithmetic, and no two files import each
//! other. What is read are the `use` statements and the paths of `src/`, names that a folder passes on (`pub use`) followed to
//! the file that defines them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The rooms of the house, from the bottom to the top: a file imports from its own room and from those before it.
const LAYERS: [&[&str]; 12] = [
    &["units", "keyword", "wide", "allocator"],
    &["random", "normal"],
    &["statistics"],
    &["resampling"],
    &["rocking", "hazard"],
    &["motion"],
    &["records"],
    &["fragility"],
    &["studies"],
    &["export", "report"],
    &["table"],
    &["pipeline"],
];
/// Those above all others, in order.
const RIM: [&str; 4] = ["stages", "cli", "lib", "main"];

/// The most files and folders in one folder.
const MOST_ENTRIES: usize = 22;

#[test]
fn imports_run_downwards() {
    let upward: Vec<String> = imports()
        .into_iter()
        .filter(|(from, to)| layer(from) < layer(to))
        .map(|(from, to)| format!("{} imports {}", from.display(), to.display()))
        .collect();
    assert!(upward.is_empty(), "{}", upward.join("\n"));
}

#[test]
fn no_two_files_import_each_other_on_any_way() {
    let mut below: BTreeMap<PathBuf, BTreeSet<PathBuf>> = BTreeMap::new();
    for (from, to) in imports() {
        below.entry(from).or_default().insert(to);
    }
    let mut circles = BTreeSet::new();
    for start in below.keys() {
        let reached = reachable(&below, start);
        if reached.contains(start) {
            let back = |file: &&PathBuf| reachable(&below, file).contains(start);
            circles.insert(reached.iter().filter(back).cloned().collect::<Vec<_>>());
        }
    }
    assert!(circles.is_empty(), "files that import each other: {circles:#?}");
}

#[test]
fn no_folder_is_crowded() {
    let mut entries: BTreeMap<PathBuf, BTreeSet<PathBuf>> = BTreeMap::new();
    for file in files() {
        for path in file.ancestors().filter(|path| path.parent().is_some()) {
            entries.entry(path.parent().unwrap().to_path_buf()).or_default().insert(path.to_path_buf());
        }
    }
    let crowded: Vec<String> = entries
        .iter()
        .filter(|(_, inside)| inside.len() > MOST_ENTRIES)
        .map(|(folder, inside)| format!("src/{}: {} entries", folder.display(), inside.len()))
        .collect();
    assert!(crowded.is_empty(), "{}", crowded.join("\n"));
}

/// The pages that tell where in the tree things are.
const PAGES: [&str; 2] = ["docs/architecture.md", "docs/paper.md"];

#[test]
fn what_the_pages_name_is_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for page in PAGES {
        let text = std::fs::read_to_string(root.join(page)).unwrap();
        let is_path = |name: &&str| name.contains('/') && !name.contains(' ') && !name.starts_with("out/");
        let named = text.split('`').skip(1).step_by(2).filter(is_path);
        let missing: Vec<&str> = named
            .filter(|name| {
                ![root.to_path_buf(), root.join("src")].iter().any(|base| base.join(name).exists())
            })
            .collect();
        assert!(missing.is_empty(), "{page} names what is not there: {missing:?}");
    }
    let architecture = std::fs::read_to_string(root.join(PAGES[0])).unwrap();
    for room in LAYERS.iter().flat_map(|rooms| rooms.iter()).filter(|room| **room != "allocator") {
        assert!(architecture.contains(room), "{} does not name src/{room}", PAGES[0]);
    }
}

/// The names of figures and of quantities of the comparison that docs/paper.md promises, as the source has them.
#[test]
fn what_the_page_on_the_paper_promises_is_made() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = std::fs::read_to_string(root.join("docs/paper.md")).unwrap();
    let figures: String = files()
        .iter()
        .filter(|file| file.starts_with("report/figures"))
        .map(|file| std::fs::read_to_string(root.join("src").join(file)).unwrap())
        .collect();
    let of_figures = page.split("## Figures").nth(1).unwrap().split("## Tables").next().unwrap();
    let names = of_figures.split('`').skip(1).step_by(2);
    let missing: Vec<&str> =
        names.filter(|name| !figures.contains(&format!("\"{}", name.trim_end_matches('*')))).collect();
    assert!(missing.is_empty(), "docs/paper.md names figures that nothing draws: {missing:?}");
    let published = std::fs::read_to_string(root.join("data/paper.csv")).unwrap();
    for quantity in published.lines().skip(1).map(|line| line.split(',').next().unwrap()) {
        let kind = quantity.starts_with("low_") || quantity.starts_with("high_");
        assert!(kind || page.contains(&format!("`{quantity}`")), "docs/paper.md does not tell of {quantity}");
    }
}

/// The place of a file's room in the order of layers.
fn layer(file: &Path) -> usize {
    let room = room(file);
    let domain = LAYERS.iter().position(|rooms| rooms.contains(&room.as_str()));
    let rim = || RIM.iter().position(|name| *name == room).map(|place| LAYERS.len() + place);
    domain.or_else(rim).unwrap_or_else(|| panic!("src/{}: a room without a place in LAYERS", file.display()))
}

fn room(file: &Path) -> String {
    let first = file.iter().next().unwrap().to_string_lossy().into_owned();
    first.trim_end_matches(".rs").to_string()
}

fn reachable(below: &BTreeMap<PathBuf, BTreeSet<PathBuf>>, start: &Path) -> BTreeSet<PathBuf> {
    let mut reached = BTreeSet::new();
    let mut waiting = vec![start.to_path_buf()];
    while let Some(file) = waiting.pop() {
        for next in below.get(&file).into_iter().flatten() {
            if reached.insert(next.clone()) {
                waiting.push(next.clone());
            }
        }
    }
    reached
}

/// All source files, relative to `src`.
fn files() -> Vec<PathBuf> {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(&path, found);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                found.push(path);
            }
        }
    }
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    walk(&src, &mut found);
    found.iter().map(|file| file.strip_prefix(&src).unwrap().to_path_buf()).collect()
}

/// The path of the module that a file holds: `motion/pulse.rs` is `["motion", "pulse"]`.
fn module_of(file: &Path) -> Vec<String> {
    let mut module: Vec<String> =
        file.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if ["mod", "lib", "main"].contains(&module.last().unwrap().as_str()) {
        module.pop();
    }
    module
}

/// Every import of one file by another.
fn imports() -> BTreeSet<(PathBuf, PathBuf)> {
    let files = files();
    let modules: BTreeMap<Vec<String>, PathBuf> = files
        .iter()
        .filter(|file| !file.ends_with("main.rs"))
        .map(|file| (module_of(file), file.clone()))
        .collect();
    let mut used: BTreeMap<PathBuf, Vec<Used>> = BTreeMap::new();
    for file in &files {
        let text =
            std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(file)).unwrap();
        used.insert(file.clone(), paths(&text, &module_of(file), &modules));
    }
    let house = House { modules, used: &used };
    let mut imports = BTreeSet::new();
    for (file, paths) in &used {
        for path in paths.iter().filter(|path| !path.passed_on) {
            if let Some(target) = house.file_of(&path.path, 0).filter(|target| target != file) {
                imports.insert((file.clone(), target));
            }
        }
    }
    imports
}

/// A path that a file names, from the root of the crate.
struct Used {
    path: Vec<String>,
    /// Whether it is a `pub use` of a folder, which hands on what its files define.
    passed_on: bool,
}

struct House<'a> {
    modules: BTreeMap<Vec<String>, PathBuf>,
    used: &'a BTreeMap<PathBuf, Vec<Used>>,
}

impl House<'_> {
    /// The file that defines what a path names.
    fn file_of(&self, path: &[String], depth: usize) -> Option<PathBuf> {
        let deepest = (0..=path.len()).rev().find(|&length| self.modules.contains_key(&path[..length]))?;
        let file = &self.modules[&path[..deepest]];
        let Some(name) = path.get(deepest).filter(|_| depth < 8) else { return Some(file.clone()) };
        let hands_on =
            |used: &&Used| used.passed_on && used.path.last().is_some_and(|last| last == name || last == "*");
        let mut onward =
            self.used[file].iter().filter(hands_on).filter_map(|used| match used.path.last().unwrap() {
                last if last == name => self.file_of(&used.path, depth + 1),
                _ => {
                    let mut inner = used.path[..used.path.len() - 1].to_vec();
                    inner.push(name.clone());
                    self.file_of(&inner, depth + 1).filter(|target| self.defines(target, name))
                }
            });
        Some(onward.next().unwrap_or_else(|| file.clone()))
    }

    fn defines(&self, file: &Path, name: &str) -> bool {
        let text =
            std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(file)).unwrap();
        let kinds = ["struct", "enum", "fn", "const", "trait", "type", "static", "macro_rules!"];
        kinds.iter().any(|kind| text.contains(&format!("{kind} {name}")))
    }
}

/// The paths into this crate that a file names.
fn paths(text: &str, module: &[String], modules: &BTreeMap<Vec<String>, PathBuf>) -> Vec<Used> {
    let code: String = text.lines().map(|line| line.split("//").next().unwrap().to_string() + "\n").collect();
    let is_folder = modules.get(module).is_some_and(|file| file.ends_with("mod.rs"));
    let mut found = Vec::new();
    let mut rest = code.as_str();
    // `use` statements, with their braces opened.
    let mut body = String::new();
    while let Some(at) = find_use(rest) {
        let (before, after) = rest.split_at(at);
        body.push_str(before);
        let end = after.find(';').unwrap_or(after.len());
        let passed_on = before.trim_end().ends_with("pub") || before.trim_end().ends_with(')');
        for path in opened(after["use ".len()..end].trim()) {
            if let Some(path) = absolute(&path, module, modules) {
                found.push(Used { path, passed_on: passed_on && is_folder });
            }
        }
        rest = &after[end..];
    }
    body.push_str(rest);
    // Paths within expressions and types.
    for prefix in ["crate::", "super::", "self::"] {
        for (at, _) in body.match_indices(prefix) {
            let path: String =
                body[at..].chars().take_while(|c| c.is_alphanumeric() || *c == '_' || *c == ':').collect();
            let starts =
                !body[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':' || c == '$');
            if let Some(path) = absolute(path.trim_end_matches(':'), module, modules).filter(|_| starts) {
                found.push(Used { path, passed_on: false });
            }
        }
    }
    found
}

fn find_use(text: &str) -> Option<usize> {
    text.match_indices("use ").map(|(at, _)| at).find(|&at| {
        let before = &text[..at];
        before.is_empty() || before.ends_with(['\n', ' ', ')'])
    })
}

/// `a::{b, c::{d, e}}` as `a::b`, `a::c::d`, `a::c::e`.
fn opened(tree: &str) -> Vec<String> {
    let Some(open) = tree.find('{') else {
        return vec![tree.split(" as ").next().unwrap().trim().to_string()];
    };
    let inner = &tree[open + 1..tree.rfind('}').unwrap_or(tree.len())];
    let (mut parts, mut depth, mut part) = (Vec::new(), 0, String::new());
    for letter in inner.chars() {
        match letter {
            ',' if depth == 0 => parts.push(std::mem::take(&mut part)),
            letter => {
                depth += i32::from(letter == '{') - i32::from(letter == '}');
                part.push(letter);
            }
        }
    }
    parts.push(part);
    let parts = parts.iter().map(|part| part.trim()).filter(|part| !part.is_empty());
    parts.flat_map(opened).map(|part| format!("{}{part}", tree[..open].trim())).collect()
}

/// A path from the root of the crate; none of what other crates define.
fn absolute(path: &str, module: &[String], modules: &BTreeMap<Vec<String>, PathBuf>) -> Option<Vec<String>> {
    let mut parts: Vec<String> = path.split("::").map(|part| part.trim().to_string()).collect();
    let mut base = module.to_vec();
    match parts[0].as_str() {
        "crate" | "rockfrag" => base.clear(),
        "self" => {}
        "super" => {
            while parts.get(1).is_some_and(|part| part == "super") {
                base.pop();
                parts.remove(1);
            }
            base.pop();
        }
        first => {
            // A child module named without a prefix.
            base.push(first.to_string());
            return modules.contains_key(&base).then(|| {
                base.extend(parts.drain(1..));
                base
            });
        }
    }
    base.extend(parts.drain(1..).filter(|part| part != "self"));
    Some(base)
}
