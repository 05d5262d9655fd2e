//! init: a folder to start from. It replaces nothing.

use std::fmt::Write as _;
use std::path::Path;

use chrono::Local;
use clap::ValueEnum;

use crate::number;
use crate::pipeline::UsageError;
use crate::table::writer::{PendingFile, persist};

/// What a folder starts from.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Start {
    /// The paper's set-up
    Paper,
    /// A folder of your records
    Records,
    /// The hazard curve of a site
    Site,
    /// A list of objects
    List,
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
            Start::List => &[("objects.csv", include_str!("../../data/start/objects.csv"))],
        }
    }

    /// What comes next, in the folder.
    fn next(self) -> [&'static str; 2] {
        match self {
            Start::Records => ["put your records into the folder records, then ", "rockfrag run"],
            Start::List => ["", "rockfrag evaluate --structures objects.csv"],
            Start::Paper | Start::Site => ["", "rockfrag run"],
        }
    }
}

/// Writes the files of a start into a folder, unless one of them is there already. Returns which.
pub fn init(start: Start, folder: &Path) -> anyhow::Result<String> {
    let folder = folder.strip_prefix(".").unwrap_or(folder);
    let today = Local::now().date_naive().to_string();
    let (mut files, mut text) = (Vec::new(), String::new());
    for (name, content) in start.files() {
        let path = folder.join(name);
        let problem = format!("{}: is there already; choose another folder with --out", path.display());
        anyhow::ensure!(path.symlink_metadata().is_err(), UsageError::because(problem));
        files.push(PendingFile::new(&path, content.replace("TODAY", &today).as_bytes())?);
        writeln!(text, "wrote {}", number::path(&path))?;
    }
    persist(files)?;
    let [before, next] = start.next();
    let there = if folder == Path::new("") { "" } else { &format!("cd {} && ", number::path(folder)) };
    writeln!(text, "next: {before}{there}{next}")?;
    Ok(text)
}
