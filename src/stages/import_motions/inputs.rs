//! What is read of the files that a user names: text files whole, Parquet files some motions at a time.

use std::collections::{HashMap, HashSet};
use std::ffi::OsStr;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::motion::LONGEST_MOTION;
use crate::pipeline::files;
use crate::records::processing::{NamedRecord, Refusal, SourceFile, TABLE};
use crate::records::{AccelerationUnit, Format, Given, RecordedMotion, SaidUnit, read};
use crate::rocking::Record;
use crate::table::motions::{Motion, MotionBatches};
use crate::table::store::text_file;

/// The largest text file that is read: ten million samples and more.
const MOST_MIB: u64 = 512;
/// How Parquet files begin.
const PARQUET: &[u8] = b"PAR1";

/// How files are read.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The format of text files; none: the one that the content shows.
    pub format: Option<Format>,
    pub given: Given,
    /// By which share samples may miss the peak that their header gives.
    pub pga_tolerance: f64,
}

/// What one thread reads.
pub enum Input {
    Text(PathBuf),
    /// A motion of a Parquet file.
    Motion(SourceFile, Box<Motion>),
    /// What cannot be read.
    Refused(Refusal),
}

/// Splits the files, in order, into groups that are read at once: so many text files, or motions of a Parquet file.
pub fn groups(files: &[PathBuf], at_once: usize) -> impl Iterator<Item = Vec<Input>> {
    let mut files = files.iter().peekable();
    let mut batches: Option<Batches> = None;
    std::iter::from_fn(move || {
        if let Some(group) = batches.as_mut().and_then(Iterator::next) {
            return Some(group);
        }
        batches = None;
        let mut group = Vec::new();
        while group.len() < at_once {
            let Some(file) = files.peek() else { break };
            if !is_parquet(file) {
                group.push(Input::Text(file.to_path_buf()));
            } else if group.is_empty() {
                let mut of_file = parquet(file, at_once);
                group.extend(of_file.next().into_iter().flatten());
                batches = Some(of_file);
                files.next();
                break;
            } else {
                break;
            }
            files.next();
        }
        (!group.is_empty()).then_some(group)
    })
}

fn is_parquet(file: &Path) -> bool {
    let mut magic = [0; PARQUET.len()];
    File::open(file).is_ok_and(|mut file| file.read_exact(&mut magic).is_ok() && magic == PARQUET)
}

/// The motions of a Parquet file, some at a time.
type Batches = Box<dyn Iterator<Item = Vec<Input>> + Send>;

fn parquet(file: &Path, at_once: usize) -> Batches {
    let opened = MotionBatches::open(file, at_once).map_err(|error| Refusal::of(file, &error));
    let hash = files::hash(file).map_err(|error| Refusal::of(file, &error));
    match opened.and_then(|batches| Ok((batches, hash?))) {
        Ok((batches, blake3)) => {
            let path = file.to_path_buf();
            let source = SourceFile { path: path.display().to_string(), blake3 };
            let input = move |motion| Input::Motion(source.clone(), Box::new(motion));
            Box::new(batches.map(move |batch| match batch {
                Ok(motions) => motions.into_iter().map(&input).collect(),
                Err(error) => vec![Input::Refused(Refusal::of(&path, &error))],
            }))
        }
        Err(refusal) => Box::new(std::iter::once(vec![Input::Refused(refusal)])),
    }
}

/// The names of files in motion_id: by the name without its ending where no other file has the same, else by the name
/// (K-NET tells components by the ending), else by the path.
pub struct Names(HashMap<String, usize>);

impl Names {
    pub fn of(files: &[PathBuf]) -> Names {
        let mut counts = HashMap::new();
        for file in files {
            // A name without an ending is its own stem, and counts once.
            let names = HashSet::from([text(file.file_stem()), text(file.file_name())]);
            names.into_iter().for_each(|name| *counts.entry(name).or_insert(0) += 1);
        }
        Names(counts)
    }

    fn name(&self, path: &str) -> String {
        let file = Path::new(path);
        let unique = |name: &String| self.0.get(name) == Some(&1);
        let names = [text(file.file_stem()), text(file.file_name())];
        names.into_iter().find(unique).unwrap_or_else(|| path.to_string())
    }
}

fn text(name: Option<&OsStr>) -> String {
    name.unwrap_or_default().to_string_lossy().into_owned()
}

/// Reads the motions of an input; what cannot be read is refused.
pub fn motions(input: Input, names: &Names, reading: &Reading) -> Vec<Result<NamedRecord, Refusal>> {
    match input {
        Input::Refused(refusal) => vec![Err(refusal)],
        Input::Text(file) => match text_file(&file, names, reading) {
            Ok(found) => found.into_iter().map(Ok).collect(),
            Err(reason) => vec![Err(Refusal::of(&file, &reason))],
        },
        Input::Motion(source, motion) => {
            let name = names.name(&source.path);
            vec![of_parquet(*motion, &name, source)]
        }
    }
}

fn text_file(file: &Path, names: &Names, reading: &Reading) -> Result<Vec<NamedRecord>, String> {
    let expected = "the file of a record, or motions in a Parquet file";
    let bytes = text_file::bytes(file, MOST_MIB, expected).map_err(|error| error.to_string())?;
    let blake3 = blake3::hash(&bytes).to_hex().to_string();
    let source = SourceFile { path: file.display().to_string(), blake3 };
    let name = names.name(&source.path);
    let motions = read(&bytes, reading.format, &reading.given).map_err(|error| error.to_string())?;
    let several = motions.len() > 1;
    let check = |(index, motion): (usize, RecordedMotion)| {
        if let Some(pga) = motion.header_pga {
            pga.check(&motion.acceleration_m_s2, reading.pga_tolerance).map_err(|error| error.to_string())?;
        }
        let samples = motion.acceleration_m_s2.len();
        if samples > LONGEST_MOTION {
            return Err(format!("{samples} samples; expected {LONGEST_MOTION} at most: cut out the shaking"));
        }
        Record::new(&motion.acceleration_m_s2, motion.dt_s).map_err(|problem| problem.to_string())?;
        let motion_id = if several { format!("{name}:{}", index + 1) } else { name.clone() };
        Ok(NamedRecord { motion_id, source: source.clone(), motion })
    };
    motions.into_iter().enumerate().map(check).collect()
}

fn of_parquet(motion: Motion, name: &str, source: SourceFile) -> Result<NamedRecord, Refusal> {
    let acceleration_m_s2 = motion.acceleration_m_s2.to_vec();
    if let Err(problem) = Record::new(&acceleration_m_s2, motion.dt_s) {
        let reason = format!("row {}: {problem}", motion.row);
        return Err(Refusal::because(source.path, reason));
    }
    Ok(NamedRecord {
        motion_id: format!("{name}:{}", motion.motion_id),
        source,
        motion: RecordedMotion {
            dt_s: motion.dt_s,
            acceleration_m_s2,
            component: Some(motion.motion_id.to_string()),
            format: TABLE,
            unit: Some(SaidUnit::by_file(AccelerationUnit::MetrePerSecond2)),
            ..RecordedMotion::default()
        },
    })
}
