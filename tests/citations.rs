//! Equations, figures, tables and sections of the paper are cited by the numbers that they have there.

use std::path::{Path, PathBuf};

/// The equations in order. Where a title stands after a colon, the citation must have that word near it.
const EQUATIONS: [&str; 25] = [
    "velocity of the pulse",
    "median Vp",
    "median Tp",
    "equation of: motion",
    ": uplift",
    ": impact",
    "demand |theta|max / alpha",
    "response as a function of its: variables",
    "groups that are: dimensionless",
    "orientationless groups that are: dimensionless",
    "fragility as a probability that is: conditional",
    "event tree",
    "measures IM1 to IM6",
    "P_ex, lognormal",
    "median demand, a power of one measure",
    "its logarithm",
    "plane in the logarithms of two measures",
    "the same as a power law",
    "likelihood of overturning",
    "P_ro of one measure",
    "log-likelihood",
    "its maximum",
    "hybrid measure",
    "P_ro of the hybrid measure",
    "when Eq. 18 is Eq. 23",
];
const TABLES: [&str; 2] = ["limit states LS1 to LS3, each a: state", "the eight planes"];
const FIGURES: usize = 12;
const SECTIONS: &str = " 1 2 2.1 2.1.1 2.1.2 2.1.3 2.2 2.2.1 2.2.2 2.2.3 2.3 2.3.1 2.3.2 2.3.3 3 4 ";

/// Whether the paper has that number, and what it is about is near.
fn holds(kind: &str, number: &str, near: &str) -> bool {
    let title = match (kind, number) {
        ("section" | "sections", _) => return SECTIONS.contains(&format!(" {number} ")),
        ("Figure" | "Figures", _) => return number.parse().is_ok_and(|n| (1..=FIGURES).contains(&n)),
        ("Table", "I" | "II") => Some(TABLES[number.len() - 1]),
        ("Table", _) => None,
        _ => number.parse().ok().and_then(|n: usize| EQUATIONS.get(n.wrapping_sub(1)).copied()),
    };
    title.is_some_and(|title| title.split_once(": ").is_none_or(|(_, word)| near.contains(word)))
}

fn files(path: PathBuf) -> Vec<PathBuf> {
    match path.read_dir() {
        Ok(entries) => entries.flat_map(|entry| files(entry.unwrap().path())).collect(),
        Err(_) => vec![path],
    }
}

/// The citations in a line, kind and number, of a range its ends; none after a year, where they are of
/// another work.
fn citations(line: &str) -> Vec<(&str, &str)> {
    const KINDS: [&str; 7] = ["Eq.", "Eqs.", "Figure", "Figures", "Table", "section", "sections"];
    let words: Vec<&str> =
        line.split([' ', '(', '[', '"', ',', ')', '`']).filter(|word| !word.is_empty()).collect();
    let is_year = |word: &&str| word.parse().is_ok_and(|year| (1900..2100).contains(&year));
    let of_paper = words.iter().position(is_year).unwrap_or(words.len());
    let number = |k: usize| {
        let number = words.get(k)?.trim_end_matches(['.', ':', ';', '*']);
        let is_number =
            number.starts_with(|c: char| c.is_ascii_digit()) || ["I", "II", "to", "and"].contains(&number);
        is_number.then_some(number)
    };
    let mut found = Vec::new();
    for (k, kind) in words[..of_paper].iter().enumerate().filter(|(_, word)| KINDS.contains(word)) {
        found.extend(number(k + 1).map(|number| (*kind, number)));
        let goes_on = matches!(number(k + 2), Some("to" | "and"));
        found.extend(number(k + 3).filter(|_| goes_on).map(|number| (*kind, number)));
    }
    found
}

#[test]
fn citations_are_the_papers() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut wrong = Vec::new();
    for path in ["src", "docs", "README.md"].into_iter().flat_map(|path| files(root.join(path))) {
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let lines: Vec<&str> = text.lines().collect();
        for (row, line) in lines.iter().enumerate() {
            let near = lines[row.saturating_sub(2)..lines.len().min(row + 3)].join(" ").to_lowercase();
            let bad = citations(line).into_iter().filter(|(kind, number)| !holds(kind, number, &near));
            wrong
                .extend(bad.map(|(kind, number)| format!("{}:{}: {kind} {number}", path.display(), row + 1)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
