//! init: a folder to start from. It replaces nothing.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use chrono::Local;
use clap::ValueEnum;

use crate::number;
use crate::pipeline::UsageError;
use crate::table::writer::{Existing, PendingFile, persist};

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
    let today = Local::now().date_naive().to_string();
    let written =
        files.iter().map(|(path, text)| PendingFile::new(path, text.replace("TODAY", &today).as_bytes()));
    persist(written.collect::<Result<_, _>>()?, Existing::Kept)?;
    let wrote = |(path, _): &(PathBuf, _)| format!("wrote {}\n", number::path(path));
    let mut text: String = files.iter().map(wrote).collect();
    let there =
        if folder == Path::new("") { String::new() } else { format!("cd {} && ", number::path(folder)) };
    let before = if start == Start::Records { "put your records into the folder records, then " } else { "" };
    writeln!(text, "next: {before}{there}rockfrag run")?;
    Ok(text)
}
