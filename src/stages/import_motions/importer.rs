//! The files of a call: which are read, in which pairs, and what is done to each.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use anyhow::bail;
use rayon::prelude::*;
use rockfrag_core::motion::LONGEST_MOTION;
use rockfrag_core::records::Origin;
use rockfrag_core::records::processing::{ImportedMotion, NamedRecord, Processing};
use rockfrag_core::records::rotation::pairs;
use rockfrag_core::rocking::Record;
use rockfrag_core::warning::Warning;

use super::summary::{NotImported, Summary};
use crate::inputs::records::{self, ReadOptions, read_records};
use crate::inputs::words::is_vertical;
use crate::inputs::{About, Member, unpack};
use crate::number::counted;
use crate::pipeline::context::Context;
use crate::source;
use crate::table::keys::names_below;

pub struct Importer {
    pub files: Vec<File>,
    pub reading: ReadOptions,
    pub processing: Processing,
    pub about: About,
}

/// A file, or one in an archive.
#[derive(Clone)]
pub struct File {
    pub path: PathBuf,
    /// Its path below the folder that has all.
    below: String,
    /// The name of its record.
    name: String,
}

/// What one thread imports: a file, or two components by their file and number.
pub enum Work {
    File(File),
    Pair([(File, usize); 2]),
}

/// Names files without their ending where no other has the same (K-NET tells components by the ending), else
/// by their path.
pub fn named(paths: Vec<PathBuf>) -> Vec<File> {
    let mut counts: HashMap<String, usize> = HashMap::new();
    paths.iter().for_each(|path| *counts.entry(text(path.file_stem())).or_default() += 1);
    let below = names_below(&paths);
    let files = paths.into_iter().zip(below).map(|(path, below)| {
        let stem = text(path.file_stem());
        File { name: if counts[&stem] == 1 { stem } else { below.clone() }, below, path }
    });
    files.collect()
}

impl Importer {
    /// All work in order; the summary gets what is not imported already.
    pub fn work(&self, context: &Context, summary: &mut Summary) -> anyhow::Result<Vec<Work>> {
        if self.processing.direction.is_none() {
            return Ok(self.files.iter().cloned().map(Work::File).collect());
        }
        // Samples are read again once a pair is found: that takes less memory than keeping all of them.
        let origin = |NamedRecord { motion, .. }: NamedRecord| (motion.origin, motion.dt_s);
        let read = |file| self.read(file).into_iter().map(|record| record.map(origin)).collect::<Vec<_>>();
        let mut components = Vec::new();
        for (file, read) in self.files.iter().zip(self.files.par_iter().map(read).collect::<Vec<_>>()) {
            for (index, component) in read.into_iter().enumerate() {
                match component {
                    Ok((origin, dt_s)) => components.push((origin, dt_s, (file.clone(), index))),
                    Err(why) => summary.leave_out(why),
                }
            }
        }
        let horizontal = counted(components.len(), "horizontal component");
        let origins: Vec<_> = components.iter().map(|(origin, dt_s, _)| (origin, *dt_s)).collect();
        let pairs = pairs(&origins);
        if pairs.is_empty() && summary.refused.is_empty() {
            bail!(
                "no pair among {horizontal}; expected two of one event, station and time step at right \
                 angles. Without --rotate each is imported by itself"
            );
        }
        let alone = (0..components.len()).filter(|at| !pairs.iter().any(|pair| pair.contains(at)));
        let alone = alone.map(|at| (Warning::NoPartner, text(components[at].2.0.path.file_name())));
        context.warn(alone.collect());
        Ok(pairs.into_iter().map(|pair| Work::Pair(pair.map(|at| components[at].2.clone()))).collect())
    }

    pub fn import(&self, work: &Work) -> Vec<Result<Vec<ImportedMotion>, NotImported>> {
        match work {
            Work::File(file) => {
                let records = self.read(file);
                let several = records.len() > 1;
                let import = |record: NamedRecord| {
                    let column = record.motion.origin.component.clone().filter(|_| several);
                    let column = column.map_or(String::new(), |column| format!("column '{column}': "));
                    let imported = self.processing.import(record);
                    imported.map_err(|error| refusal(&file.path, &format!("{column}{error}")))
                };
                records.into_iter().map(|record| record.and_then(import)).collect()
            }
            Work::Pair(pair) => {
                let read = |(file, index): &(File, usize)| self.read(file).into_iter().nth(*index)?.ok();
                // That a file has changed meanwhile is told in the end.
                let [Some(first), Some(second)] = pair.each_ref().map(read) else { return Vec::new() };
                let imported = self.processing.import_pair([first, second]);
                vec![imported.map_err(|error| refusal(&pair[0].0.path, &error))]
            }
        }
    }

    /// Reads the records of a file, or of those in an archive.
    fn read(&self, file: &File) -> Vec<Result<NamedRecord, NotImported>> {
        let bytes = source::read(&file.path).map_err(anyhow::Error::from);
        match bytes.and_then(|bytes| Ok(unpack(bytes)?)) {
            Err(reason) => vec![Err(refusal(&file.path, &reason))],
            Ok(members) => {
                let files = file.unpacked(&members).into_iter().zip(&members);
                files.flat_map(|(file, member)| self.read_one(&file, &member.bytes)).collect()
            }
        }
    }

    fn read_one(&self, file: &File, bytes: &[u8]) -> Vec<Result<NamedRecord, NotImported>> {
        let File { path, name, below } = file;
        let source_blake3 = blake3::hash(bytes).to_hex().to_string();
        let motions = match read_records(bytes, &self.reading) {
            Ok(motions) => motions,
            Err(error) => return vec![Err(refusal(path, &error))],
        };
        let several = motions.len() > 1;
        let records = (1..).zip(motions).map(|(number, mut motion)| {
            let origin = &mut motion.origin;
            if let Some(Origin { mw, re_km, earthquake, .. }) = self.about.get(path).cloned() {
                origin.mw = mw.or(origin.mw);
                origin.re_km = re_km.or(origin.re_km);
                origin.earthquake = earthquake.or(origin.earthquake.take());
            }
            if several && origin.earthquake.is_none() && origin.station.is_none() {
                // The columns of a table are of one instrument.
                origin.station = Some(name.clone());
            }
            // A file without a direction may have it at the end of its name: ABC-UP.AT2.
            let last = name.rsplit(['-', '_', '.', ' ']).next().unwrap_or_default();
            if !several && origin.azimuth_deg.is_none() && last != name && is_vertical(last) {
                origin.component = Some(last.to_string());
            }
            if motion.is_in_borehole {
                return Err(NotImported::LeftOut("borehole component"));
            }
            // A column that was chosen is imported.
            if records::is_vertical(origin) && self.reading.column.is_none() {
                return Err(NotImported::LeftOut("vertical component"));
            }
            let samples = motion.acceleration_m_s2.len();
            if samples > LONGEST_MOTION {
                return Err(refusal(path, &format!("{samples} samples; expected {LONGEST_MOTION} at most")));
            }
            Record::new(&motion.acceleration_m_s2, motion.dt_s).map_err(|problem| refusal(path, &problem))?;
            let motion_id = if several { format!("{name}:{number}") } else { name.clone() };
            let (source_file, source_blake3) = (below.clone(), source_blake3.clone());
            Ok(NamedRecord { motion_id, source_file, source_blake3, motion, doubts: Vec::new() })
        });
        records.collect()
    }
}

impl File {
    /// The files in an archive, named among each other; the file itself if it is none.
    fn unpacked(&self, members: &[Member]) -> Vec<File> {
        let inner = members.iter().filter_map(|member| member.name.as_deref()).map(PathBuf::from);
        let inner = named(inner.collect()).into_iter().map(|File { path, name, .. }| File {
            below: Path::new(&self.below).join(&path).display().to_string(),
            path: self.path.join(path),
            name: format!("{}/{name}", self.name),
        });
        let inner: Vec<File> = inner.collect();
        if inner.is_empty() { vec![self.clone()] } else { inner }
    }
}

fn text(name: Option<&OsStr>) -> String {
    name.unwrap_or_default().to_string_lossy().into_owned()
}

fn refusal(file: &Path, reason: &impl ToString) -> NotImported {
    NotImported::Refused(format!("{}: {}", file.display(), reason.to_string()))
}
