//! Snapshots as plain files, and what is left out of them.

use std::panic::catch_unwind;

/// Compares each text with the snapshot of its name; fails after the last one, so that all differences are shown.
pub fn check_each(texts: impl IntoIterator<Item = (String, String)>) {
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_snapshot_path("snapshots");
    settings.set_omit_expression(true);
    let differing: Vec<String> = settings.bind(|| {
        let differs = |(name, text): &(String, String)| {
            catch_unwind(|| insta::assert_snapshot!(name.as_str(), text)).is_err()
        };
        texts.into_iter().filter(differs).map(|(name, _)| name).collect()
    });
    assert!(differing.is_empty(), "snapshots differ: {}", differing.join(", "));
}

/// The text without what may differ from run to run: the version, times, sizes and hashes of files.
pub fn redact(text: &str) -> String {
    let text = text.replace(env!("CARGO_PKG_VERSION"), "[version]");
    text.lines().map(|line| redact_line(line) + "\n").collect()
}

fn redact_line(line: &str) -> String {
    let mut words: Vec<String> = line.split(' ').map(str::to_string).collect();
    for index in 0..words.len() {
        let next = words.get(index + 1).cloned().unwrap_or_default();
        let is_number = words[index].parse::<f64>().is_ok();
        let is_time = next == "s" && index > 0 && words[index - 1] == "in" && is_number;
        let word = &mut words[index];
        if is_time || (next.starts_with("MB") && is_number) {
            *word = "[number]".to_string();
        } else if word.len() == 64 && word.chars().all(|letter| letter.is_ascii_hexdigit()) {
            *word = "[hash]".to_string();
        }
    }
    words.join(" ")
}
