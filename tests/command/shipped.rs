//! The shipped data are what the program makes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rockfrag::keyword::Keyword;
use rockfrag::table::row::ReadRow;
use rockfrag::table::universality::UniversalityRow;

use crate::common::{rockfrag, succeed};

/// The arithmetic of another processor or library of mathematics may differ in the last bits, which chaotic motions feel.
const TOLERANCE: f64 = 1e-6;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join(name)
}

/// The rows of a CSV file whose first line says what made it, by the columns that name a row: the others.
fn rows(path: &Path, key: &[&str]) -> BTreeMap<Vec<String>, BTreeMap<String, String>> {
    let text = std::fs::read_to_string(path).unwrap();
    assert!(text.starts_with("# rockfrag "), "{} does not say what made it", path.display());
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let rows = reader.deserialize().map(|row| {
        let mut row: BTreeMap<String, String> = row.unwrap();
        (key.iter().map(|column| row.remove(*column).unwrap()).collect(), row)
    });
    rows.collect()
}

#[test]
fn the_first_seed_of_the_spread_is_what_the_program_makes() {
    let folder = tempfile::tempdir().unwrap();
    let call = format!("seed-spread {} --seeds 1 --out made.csv", data("seed_spread.yaml").display());
    succeed(folder.path(), &call);
    let key = ["seed", "suite", "structure", "quantity"];
    let [made, shipped] =
        [folder.path().join("made.csv"), data("seed_spread.csv")].map(|path| rows(&path, &key));
    let seeds: std::collections::BTreeSet<&String> = shipped.keys().map(|key| &key[0]).collect();
    assert_eq!(seeds.len(), 20);
    let of_first = shipped.iter().filter(|(key, _)| key[0] == "1").collect::<Vec<_>>();
    assert_eq!(made.len(), of_first.len());
    for (key, row) in of_first {
        // The root mean squares lean on numbers of the paper alone, and on no other seed.
        let [ours, theirs] = [&made[key], row].map(|row| row["value"].parse::<f64>().unwrap());
        assert!((ours - theirs).abs() <= TOLERANCE * theirs.abs().max(1.0), "{key:?}: {ours} for {theirs}");
    }
}

/// A column of the file, and its value in a row.
type Shipped = (&'static str, fn(&UniversalityRow) -> Option<f64>);

/// The columns of the shipped universality that depend on the structure of the row and the reference alone.
const OF_STRUCTURE: [Shipped; 8] = [
    ("n", |row| Some(row.n as f64)),
    ("seen", |row| Some(row.seen as f64)),
    ("expected", |row| Some(row.expected)),
    ("calibration_slope", |row| row.calibration_slope),
    ("log_score_own", |row| row.log_score_own),
    ("log_score_transferred", |row| row.log_score_transferred),
    ("share_lost", |row| row.share_lost),
    ("worst_over", |row| row.worst_over),
];
/// Those that depend on all structures.
const OF_ALL: [Shipped; 4] = [
    ("log_score_line", |row| row.log_score_line),
    ("log_score_curved", |row| row.log_score_curved),
    ("log_score_restitution", |row| row.log_score_restitution),
    ("log_score_structure", |row| row.log_score_structure),
];

/// Makes the universality of the shipped set-up with these structures of its grid, and compares it.
fn compare_universality(structures: &dyn Fn(&str) -> bool, columns: &[Shipped]) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(data("universality.yaml"), folder.path().join("universality.yaml")).unwrap();
    let grid = std::fs::read_to_string(data("universality_grid.csv")).unwrap();
    let lines = grid
        .lines()
        .enumerate()
        .filter(|(line, text)| *line == 0 || structures(text.split(',').next().unwrap()));
    let chosen: String = lines.flat_map(|(_, text)| [text, "\n"]).collect();
    std::fs::write(folder.path().join("universality_grid.csv"), chosen).unwrap();
    let output = rockfrag(folder.path()).args(["run", "universality.yaml", "--out", "out"]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let made = UniversalityRow::read(folder.path().join("out/universality.parquet").as_path()).unwrap();
    let shipped = rows(&data("universality.csv"), &["suite", "event", "structure"]);
    for row in &made {
        let key = vec![row.suite.clone().unwrap(), row.event.as_str().to_string(), row.structure.clone()];
        for (column, of) in columns {
            let theirs = shipped[&key][*column].parse::<f64>().ok();
            let same = match (of(row), theirs) {
                // Four decimals are shipped.
                (Some(ours), Some(theirs)) => (ours - theirs).abs() <= 0.50001e-4 + TOLERANCE * theirs.abs(),
                (ours, theirs) => ours.is_none() && theirs.is_none(),
            };
            assert!(same, "{key:?}, {column}: {:?} for {theirs:?}", of(row));
        }
    }
    let of_chosen = shipped.keys().filter(|key| structures(&key[2])).count();
    assert_eq!(made.len(), of_chosen);
}

#[test]
fn the_universality_of_some_structures_is_what_the_program_makes() {
    let chosen = ["electrical-equipment", "frame", "p4-a0.35-eta0.98", "p2-a0.10-eta0.80"];
    compare_universality(&|name| chosen.contains(&name), &OF_STRUCTURE);
}

#[test]
#[ignore = "takes minutes: 434000 responses"]
fn the_universality_of_all_structures_is_what_the_program_makes() {
    let all: Vec<_> = OF_STRUCTURE.iter().chain(&OF_ALL).copied().collect();
    compare_universality(&|_| true, &all);
}
