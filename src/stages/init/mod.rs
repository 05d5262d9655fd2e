//! init: a folder to start from. It replaces nothing.

use std::fmt::Write as _;
use std::fs::File;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::ValueEnum;

use super::registry::PAPER;
use crate::motion::{Design, Grid, MotionModel, Suite, Synthesizer};
use crate::pipeline::UsageError;
use crate::pipeline::stage::folder_of;
use crate::units::G_M_S2;

/// What a folder starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Start {
    /// The set-up of the paper.
    Paper,
    /// A folder of records.
    Records,
    /// The hazard curve of a site.
    Site,
}

const STRUCTURES: &str = include_str!("structures.csv");

impl Start {
    /// The files by name, and their text.
    fn files(self) -> Vec<(PathBuf, String)> {
        let texts: &[(&str, &str)] = match self {
            Start::Paper => &[
                ("pipeline.yaml", PAPER),
                ("structures.csv", include_str!("../../../data/structures.csv")),
                ("README.md", include_str!("paper.md")),
            ],
            Start::Records => &[
                ("pipeline.yaml", include_str!("records.yaml")),
                ("structures.csv", STRUCTURES),
                ("README.md", include_str!("records.md")),
            ],
            Start::Site => &[
                ("pipeline.yaml", include_str!("site.yaml")),
                ("structures.csv", STRUCTURES),
                ("hazard.csv", include_str!("../../../data/hazard.csv")),
                ("README.md", include_str!("site.md")),
            ],
        };
        let texts = texts.iter().map(|(name, text)| (PathBuf::from(name), text.to_string()));
        texts.chain((self == Start::Records).then(records).into_iter().flatten()).collect()
    }
}

/// Writes the files of a start into a folder, and says which.
///
/// # Errors
/// If one of them is there already, in which case nothing is written; or if the folder cannot be written.
pub fn init(start: Start, folder: &Path) -> anyhow::Result<String> {
    // As a name without the folder that it is in anyway.
    let folder = folder.strip_prefix(".").unwrap_or(folder);
    let files: Vec<(PathBuf, String)> =
        start.files().into_iter().map(|(name, text)| (folder.join(name), text)).collect();
    if let Some((path, _)) = files.iter().find(|(path, _)| path.symlink_metadata().is_ok()) {
        return Err(UsageError::because(format!(
            "{}: already there, and init replaces nothing; choose another folder with --out",
            path.display()
        )));
    }
    for (path, text) in &files {
        write(path, text).with_context(|| path.display().to_string())?;
    }
    let (samples, others): (Vec<_>, Vec<_>) =
        files.iter().partition(|(path, _)| path.extension().is_some_and(|ending| ending == "AT2"));
    let mut said = String::new();
    for (path, _) in others {
        writeln!(said, "wrote {}", path.display())?;
    }
    if !samples.is_empty() {
        writeln!(said, "wrote {} made-up records to {}", samples.len(), folder.join(RECORDS).display())?;
    }
    let there = if folder == Path::new("") { String::new() } else { format!("cd {} && ", folder.display()) };
    writeln!(said, "next: {there}rockfrag run")?;
    Ok(said)
}

fn write(path: &Path, text: &str) -> std::io::Result<()> {
    std::fs::create_dir_all(folder_of(path))?;
    // A file that came meanwhile is left as it is.
    File::create_new(path)?.write_all(text.as_bytes())
}

/// The folder of sample records.
const RECORDS: &str = "records";
/// Samples of an earthquake below this share of the peak, before the first and after the last above it, are left out.
const QUIET: f64 = 0.002;
const SAMPLES_IN_LINE: usize = 5;

/// Made-up near-fault records in the AT2 format of PEER: pulses with high frequencies, of scenarios of the paper's kind.
fn records() -> Vec<(PathBuf, String)> {
    let grid =
        Grid { mw: vec![6.5, 7.0, 7.5], re_km: vec![5.0, 10.0], samples: 4, design: Design::Lhs, seed: 1 };
    let model = MotionModel { dt_s: 0.01, seed: 1, ..MotionModel::default() };
    let mut synthesizer = Synthesizer::new(model, &[Suite::Csgm]);
    let scenarios = (0..grid.cells()).flat_map(|cell| grid.scenarios_of_cell(cell));
    let file = |scenario| {
        let synthetic = synthesizer.synthesize(&scenario);
        let samples = loud(synthetic.samples(Suite::Csgm));
        let number = scenario.scenario_id + 1;
        let mut text = format!(
            "MADE-UP RECORD, OF NO EARTHQUAKE\nSample {number}, 1/1/2000, Mw {} at {} km, 0\nACCELERATION TIME SERIES IN UNITS OF G\n\
             NPTS= {}, DT= {:.4} SEC\n",
            scenario.mw,
            scenario.re_km,
            samples.len(),
            synthetic.dt_s
        );
        for line in samples.chunks(SAMPLES_IN_LINE) {
            text.extend(line.iter().map(|sample| format!("{:13.4E}", sample / G_M_S2)));
            text.push('\n');
        }
        (Path::new(RECORDS).join(format!("sample-{number:02}.AT2")), text)
    };
    scenarios.map(file).collect()
}

/// The part of a motion between its quiet ends.
fn loud(samples: &[f64]) -> &[f64] {
    let peak = samples.iter().fold(0.0_f64, |peak, sample| peak.max(sample.abs()));
    let is_loud = |sample: &f64| sample.abs() > QUIET * peak;
    let first = samples.iter().position(is_loud).unwrap_or(0);
    let last = samples.iter().rposition(is_loud).unwrap_or(0);
    &samples[first..=last]
}
