//! Snapshots as plain files, and what is left out of them.

use std::panic::catch_unwind;

/// Compares each text with the snapshot of its name in the folder of its kind; fails after the last one, so that all
/// differences are shown.
pub fn check_each(kind: &str, texts: impl IntoIterator<Item = (String, String)>) {
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_snapshot_path(format!("snapshots/{kind}"));
    settings.set_omit_expression(true);
    let differing: Vec<String> = settings.bind(|| {
        let differs = |(name, text): &(String, String)| {
            catch_unwind(|| insta::assert_snapshot!(name.as_str(), text)).is_err()
        };
        texts.into_iter().filter(differs).map(|(name, _)| name).collect()
    });
    assert!(differing.is_empty(), "snapshots of {kind} differ: {}", differing.join(", "));
}

/// The text without what may differ from run to run: the version, times, sizes, hashes and random names of files.
pub fn redact(text: &str) -> String {
    let text = text
        .replace(rockfrag::table::store::provenance::CODE, "[version]")
        .replace(env!("CARGO_PKG_VERSION"), "[version]");
    text.lines().map(|line| without_random_names(&without_hashes(&without_times(line))) + "\n").collect()
}

fn without_times(line: &str) -> String {
    let words: Vec<&str> = line.split(' ').collect();
    let is = |index: usize, word: &str| words.get(index).is_some_and(|other| other.starts_with(word));
    let shown = |index: usize| {
        let is_time = index > 0 && is(index - 1, "in") && is(index + 1, "s");
        let is_number = words[index].parse::<f64>().is_ok();
        if is_number && (is_time || is(index + 1, "MB")) { "[number]" } else { words[index] }
    };
    (0..words.len()).map(shown).collect::<Vec<_>>().join(" ")
}

fn without_hashes(line: &str) -> String {
    let is_hash = |run: &str| run.len() == 64 && run.bytes().all(|byte| byte.is_ascii_hexdigit());
    let runs = line.split_inclusive(|letter: char| !letter.is_ascii_alphanumeric());
    let shown = runs.map(|run| {
        let word = run.trim_end_matches(|letter: char| !letter.is_ascii_alphanumeric());
        if is_hash(word) { run.replace(word, "[hash]") } else { run.to_string() }
    });
    shown.collect()
}

/// A file that is being written has random letters before its ending.
fn without_random_names(line: &str) -> String {
    let Some((before, after)) = line.split_once(".partial") else { return line.to_string() };
    let (name, _) = before.rsplit_once('.').unwrap_or((before, ""));
    format!("{name}.[random].partial{after}")
}
