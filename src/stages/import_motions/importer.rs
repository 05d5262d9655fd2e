//! The files of a call: which are read, in which pairs, and what is done to each.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::bail;
use rayon::prelude::*;

use super::about::About;
use crate::inputs::{Member, unpack};
use crate::motion::LONGEST_MOTION;
use crate::number::counted;
use crate::pipeline::context::Context;
use crate::records::implausibility::Implausibility;
use crate::records::processing::{ImportedMotion, NamedRecord, Processing, ProcessingError, SourceFile};
use crate::records::rotation::{Component, pairs};
use crate::records::{ReadOptions, RecordFileError, RecordedMotion, read_records};
use crate::rocking::Record;
use crate::source;
use crate::table::keys::names_below;
use crate::warning::Warning;

pub struct Importer {
    pub files: Vec<PathBuf>,
    /// How many files share a stem or a name.
    names: HashMap<String, usize>,
    /// The path of each file below the folder that has all.
    paths: HashMap<PathBuf, String>,
    reading: ReadOptions,
    processing: Processing,
    pub about: About,
    /// Whether vertical components are imported too.
    vertical: bool,
    left_out: LeftOut,
}

/// How many components were left out, and why.
#[derive(Default)]
pub struct LeftOut {
    pub vertical: AtomicUsize,
    pub in_borehole: AtomicUsize,
}

impl LeftOut {
    /// The counts in words; none where all are imported.
    pub fn words(&self) -> Option<String> {
        let counts = [(&self.vertical, "vertical component"), (&self.in_borehole, "borehole component")];
        let counts = counts.map(|(count, name)| (count.load(Ordering::Relaxed), name));
        let words = counts.iter().filter(|(count, _)| *count > 0).map(|(count, name)| counted(*count, name));
        let words: Vec<String> = words.collect();
        (!words.is_empty()).then(|| words.join(" and "))
    }
}

/// What one thread imports: a file, or two components by their file and number.
pub enum Work {
    File(PathBuf),
    Pair([(PathBuf, usize); 2]),
}

impl Importer {
    pub fn new(
        files: Vec<PathBuf>,
        reading: ReadOptions,
        processing: Processing,
        about: About,
        vertical: bool,
    ) -> anyhow::Result<Importer> {
        let paths = files.iter().cloned().zip(names_below(&files)).collect();
        let mut names = HashMap::new();
        for file in &files {
            let both: HashSet<String> = [file.file_stem(), file.file_name()].map(text).into();
            both.into_iter().for_each(|name| *names.entry(name).or_insert(0) += 1);
        }
        let left_out = LeftOut::default();
        Ok(Importer { files, names, paths, reading, processing, about, vertical, left_out })
    }

    /// All work in order, and what cannot be read already.
    pub fn work(&self, context: &Context) -> anyhow::Result<(Vec<Work>, Vec<String>)> {
        if self.processing.direction.is_none() {
            return Ok((self.files.iter().cloned().map(Work::File).collect(), Vec::new()));
        }
        let (mut components, mut refused) = (Vec::new(), Vec::new());
        for (file, read) in self.files.par_iter().map(|file| (file, self.read(file))).collect::<Vec<_>>() {
            let (records, others): (Vec<_>, Vec<_>) = read.into_iter().partition(Result::is_ok);
            refused.extend(others.into_iter().filter_map(Result::err));
            for (index, record) in records.into_iter().flatten().enumerate() {
                if self.leaves_out(&record.motion) {
                    continue;
                }
                // Samples are read again once a pair is found: that takes less memory than keeping all of
                // them.
                components.push((Component::new(&record.motion), (file.clone(), index)));
            }
        }
        let horizontal = counted(components.len(), "horizontal component");
        let (pairs, left_out) = pairs(components);
        if pairs.is_empty() && refused.is_empty() {
            bail!(
                "no pair among {horizontal}; expected two of one event, station and time step at right angles. \
                 Without --rotate each is imported by itself"
            );
        }
        let warning = |(file, _): (PathBuf, usize)| (Warning::NoPartner, text(file.file_name()));
        context.warn(left_out.into_iter().map(warning).collect());
        Ok((pairs.into_iter().map(Work::Pair).collect(), refused))
    }

    /// How many components were left out, in words.
    pub fn left_out(&self) -> Option<String> {
        self.left_out.words()
    }

    /// Counts a component that is not to be imported. A column that was chosen is.
    fn leaves_out(&self, motion: &RecordedMotion) -> bool {
        let is_vertical = motion.is_vertical() && !self.vertical && self.reading.column.is_none();
        let counter = match (motion.is_in_borehole, is_vertical) {
            (true, _) => &self.left_out.in_borehole,
            (_, true) => &self.left_out.vertical,
            _ => return false,
        };
        counter.fetch_add(1, Ordering::Relaxed);
        true
    }

    pub fn import(&self, work: &Work) -> Vec<Result<Vec<ImportedMotion>, String>> {
        match work {
            Work::File(file) => {
                let mut records = self.read(file);
                records.retain(|read| read.as_ref().map_or(true, |record| !self.leaves_out(&record.motion)));
                let import = |read: Result<NamedRecord, String>| {
                    self.processing.import(read?).map_err(|error| unprocessed(file, &error))
                };
                records.into_iter().map(import).collect()
            }
            Work::Pair(pair) => {
                let component = |(file, index): &(PathBuf, usize)| {
                    let record = self.read(file).into_iter().flatten().nth(*index);
                    record.ok_or_else(|| refusal(file, &"changed while it was read; run again"))
                };
                let both = || Ok([component(&pair[0])?, component(&pair[1])?]);
                let import =
                    |both| self.processing.import_pair(both).map_err(|error| unprocessed(&pair[0].0, &error));
                vec![both().and_then(import)]
            }
        }
    }

    /// Reads the records of a file, or of those in an archive; in words what is wrong with some.
    fn read(&self, file: &Path) -> Vec<Result<NamedRecord, String>> {
        let members = source::read(file).map_err(|error| refusal(file, &error));
        let members = members.and_then(|bytes| unpack(bytes).map_err(|error| refusal(file, &error)));
        let members = match members {
            Ok(members) => members,
            Err(refusal) => return vec![Err(refusal)],
        };
        let names = member_names(&members);
        let read = |(member, name): (Member, Option<String>)| {
            let within = file.join(member.name.as_deref().unwrap_or_default());
            let path = if member.name.is_some() { &within } else { file };
            let name = name.map_or_else(|| self.name(file), |name| format!("{}/{name}", self.name(file)));
            let below = Path::new(&self.paths[file]).join(member.name.as_deref().unwrap_or_default());
            let below =
                if member.name.is_some() { below } else { Path::new(&self.paths[file]).to_path_buf() };
            match self.read_one(path, &below, &name, &member.bytes) {
                Ok(records) => records.into_iter().map(Ok).collect(),
                Err(refusal) => vec![Err(refusal)],
            }
        };
        members.into_iter().zip(names).flat_map(read).collect()
    }

    /// Reads the records in the bytes of a file; `below` is its path below the folder that has all.
    fn read_one(
        &self,
        file: &Path,
        below: &Path,
        name: &str,
        bytes: &[u8],
    ) -> Result<Vec<NamedRecord>, String> {
        let (path, blake3) = (below.display().to_string(), blake3::hash(bytes).to_hex().to_string());
        let source = SourceFile { path, blake3 };
        let motions = read_records(bytes, &self.reading).map_err(|error| unread(file, &error))?;
        let several = motions.len() > 1;
        let named = |(index, mut motion): (usize, RecordedMotion)| {
            self.about.add(file, &mut motion);
            if several && motion.event.is_none() && motion.station.is_none() {
                // The columns of a table are of one instrument.
                motion.station = Some(name.to_string());
            }
            let samples = motion.acceleration_m_s2.len();
            if samples > LONGEST_MOTION {
                return Err(refusal(file, &format!("{samples} samples; expected {LONGEST_MOTION} at most")));
            }
            Record::new(&motion.acceleration_m_s2, motion.dt_s).map_err(|problem| refusal(file, &problem))?;
            let motion_id = if several { format!("{name}:{}", index + 1) } else { name.to_string() };
            Ok(NamedRecord { motion_id, source: source.clone(), motion })
        };
        motions.into_iter().enumerate().map(named).collect()
    }

    /// The name of a file without its ending where no other file has the same, else with it (K-NET tells
    /// components by the ending), else its path.
    fn name(&self, file: &Path) -> String {
        let names = [file.file_stem(), file.file_name()].map(text);
        let unique = names.into_iter().find(|name| self.names.get(name) == Some(&1));
        unique.unwrap_or_else(|| self.paths[file].clone())
    }
}

/// Names of the files in an archive, without their endings if they still differ; none of a file that is none.
fn member_names(members: &[Member]) -> Vec<Option<String>> {
    let names = |of: fn(&Path) -> Option<&std::ffi::OsStr>| {
        let name = move |member: &Member| Some(text(of(Path::new(member.name.as_ref()?))));
        members.iter().map(name).collect::<Vec<_>>()
    };
    let stems = names(Path::file_stem);
    let differ = stems.iter().collect::<HashSet<_>>().len() == stems.len();
    if differ { stems } else { names(Path::file_name) }
}

fn text(name: Option<&std::ffi::OsStr>) -> String {
    name.unwrap_or_default().to_string_lossy().into_owned()
}

fn refusal(file: &Path, reason: &impl ToString) -> String {
    format!("{}: {}", file.display(), reason.to_string())
}

/// What is wrong with a file, and the option that helps.
fn unread(file: &Path, error: &RecordFileError) -> String {
    let option = match error {
        RecordFileError::NoUnit { .. } => ", or --unit, such as --unit g",
        RecordFileError::NoTimeStep { .. } => ", or --dt, such as --dt 0.005",
        RecordFileError::UnevenTime { .. } => " Rounded times? Give --dt",
        RecordFileError::Column { .. } => ": choose with --column, or --column all if lines wrap",
        _ => "",
    };
    format!("{}{option}", refusal(file, error))
}

/// Why a record cannot be imported, and the option that helps.
fn unprocessed(file: &Path, error: &ProcessingError) -> String {
    let option = match error {
        ProcessingError::Implausible(Implausibility::Drift { .. }) => {
            " (--baseline linear corrects it, --accept-implausible imports it anyway)"
        }
        ProcessingError::Implausible(_) | ProcessingError::Scaled { .. } => {
            " (--accept-implausible imports it anyway)"
        }
        ProcessingError::Resampled { .. } => ": choose another for --resample",
        ProcessingError::Zero | ProcessingError::Corner { .. } => "",
    };
    format!("{}{option}", refusal(file, error))
}
