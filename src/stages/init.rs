//! init: a folder to start from. It replaces nothing.

use std::fmt::Write as _;
use std::fs::File;
use std::io::Write as _;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use anyhow::Context;
use clap::ValueEnum;

use crate::pipeline::UsageError;

/// What a folder starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Start {
    /// The paper's set-up
    Paper,
    /// A folder of your records
    Records,
    /// The hazard curve of a site
    Site,
}

const STRUCTURES: (&str, &str) = ("structures.csv", include_str!("../../data/start/structures.csv"));

impl Start {
    /// The files by name, and their text.
    fn files(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Start::Paper => &[("pipeline.yaml", include_str!("../../pipeline.yaml"))],
            Start::Records => &[("pipeline.yaml", include_str!("../../data/start/records.yaml")), STRUCTURES],
            Start::Site => &[
                ("pipeline.yaml", include_str!("../../data/start/site.yaml")),
                STRUCTURES,
                ("hazard.csv", include_str!("../../data/hazard.csv")),
                ("hazard_sa.csv", include_str!("../../data/hazard_sa.csv")),
            ],
        }
    }
}

/// The date, as 2026-11-23 (Hinnant, chrono-compatible low-level date algorithms: years begin in March).
fn today() -> String {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    let days = since.as_secs() / 86_400 + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month = (5 * day_of_year + 2) / 153;
    let (day, month) =
        (day_of_year - (153 * month + 2) / 5 + 1, if month < 10 { month + 3 } else { month - 9 });
    format!("{}-{month:02}-{day:02}", era * 400 + year_of_era + u64::from(month <= 2))
}

/// Writes the files of a start into a folder, unless one of them is there already. Returns which.
pub fn init(start: Start, folder: &Path) -> anyhow::Result<String> {
    let folder = folder.strip_prefix(".").unwrap_or(folder);
    let files: Vec<_> = start.files().iter().map(|(name, text)| (folder.join(name), text)).collect();
    if let Some((path, _)) = files.iter().find(|(path, _)| path.symlink_metadata().is_ok()) {
        let path = path.display();
        return Err(UsageError::because(format!(
            "{path}: is there already; choose another folder with --out"
        )));
    }
    let mut text = String::new();
    for (path, content) in &files {
        let place = || path.display().to_string();
        std::fs::create_dir_all(path.parent().unwrap_or(Path::new(""))).with_context(place)?;
        // A file that came meanwhile is left as it is.
        let content = content.replace("TODAY", &today());
        File::create_new(path).and_then(|mut file| file.write_all(content.as_bytes())).with_context(place)?;
        writeln!(text, "wrote {}", path.display())?;
    }
    let there = if folder == Path::new("") { String::new() } else { format!("cd {} && ", folder.display()) };
    let before = if start == Start::Records { "put your records into the folder records, then " } else { "" };
    writeln!(text, "next: {before}{there}rockfrag run")?;
    Ok(text)
}
