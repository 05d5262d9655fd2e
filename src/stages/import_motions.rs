//! import-motions: recorded ground motions from the files of strong-motion networks and people, as motions
//! that simulate reads.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use clap::{Args, ValueHint};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::motion::pulse::largest_velocity;
use crate::motion::{LONGEST_MOTION, MeasurePlan, Measures, Suite};
use crate::pipeline::UsageError;
use crate::pipeline::context::Context;
use crate::pipeline::options::{Steps, listed, number};
use crate::pipeline::stage::Stage;
use crate::pipeline::stream::pipelined;
use crate::records::pairs::{Pairs, pairs};
use crate::records::processing::{
    Implausible, ImportedMotion, NamedRecord, Processing, PulseSearch, SourceFile,
};
use crate::records::pulses::Verdict;
use crate::records::rotation::{Direction, RotD};
use crate::records::signal::{Baseline, HighPass, Scaling};
use crate::records::{Format, ReadOptions, RecordedMotion, read_records};
use crate::rocking::Record;
use crate::table::{keys, motions, rows};
use crate::units::{G_M_S2, Quantity, Unit};
use crate::warning::Warning;

/// Files, or pairs of components, that are processed at once.
const AT_ONCE: usize = 32;
/// Files that a message names.
const NAMED: usize = 10;

/// Import recorded ground motions from the files of strong-motion networks, or CSV
#[derive(Debug, Args)]
pub struct ImportMotions {
    /// Files and folders of records
    #[arg(value_name = "FILE|DIR", value_hint = ValueHint::FilePath)]
    files: Vec<PathBuf>,
    /// Motions to write
    #[arg(long, value_name = "FILE", value_hint = ValueHint::AnyPath, default_value = "motions.parquet")]
    out: PathBuf,
    /// Format: at2, cosmos, esm, knet or csv [default: by content]
    #[arg(long)]
    format: Option<Format>,
    /// Time step, s, where files do not state it
    #[arg(long, value_name = "S", value_parser = number(1e-6..=10.0, "a time step above 0 s and up to 10 s"))]
    dt: Option<f64>,
    /// Unit of acceleration, where files do not state it: g, m/s2, cm/s2 (gal), mm/s2, mg, %g, ft/s2
    /// or in/s2
    #[arg(long, value_parser = acceleration_unit)]
    unit: Option<Unit>,
    /// Column of acceleration in CSV: number, heading, or all where one series wraps over lines
    #[arg(long, value_name = "N|NAME|all")]
    column: Option<String>,
    /// Tolerated difference from the peak in the header, as a share
    #[arg(long, default_value = "0.05", value_name = "SHARE", value_parser = number(0.0..=1e9, "a share of 0 or more"))]
    pga_tolerance: f64,
    /// Remove from acceleration: none, mean or linear
    #[arg(long, default_value = "none")]
    baseline: Baseline,
    /// Corner of a zero-phase high-pass filter of order 4, Hz
    #[arg(long, value_name = "HZ", value_parser = number(1e-6..=1e3, "a frequency above 0 Hz"))]
    high_pass: Option<f64>,
    /// Resample to this time step, s
    #[arg(long, value_name = "S", value_parser = number(1e-4..=0.1, "a time step from 0.0001 to 0.1 s"))]
    resample: Option<f64>,
    /// Rotate pairs of horizontal components to an azimuth (degrees) or the strongest-pulse; add
    /// RotD50 and RotD100
    #[arg(long, value_name = "AZIMUTH|strongest-pulse")]
    rotate: Option<Direction>,
    /// Scale by these factors, each to a motion of its own
    #[arg(long, value_name = "F,...", conflicts_with_all = ["scale_pga", "scale_pgv"])]
    scale: Option<Steps>,
    /// Scale each motion to this PGA, g
    #[arg(long, value_name = "G", conflicts_with = "scale_pgv", value_parser = number(1e-9..=100.0, "a PGA above 0 g"))]
    scale_pga: Option<f64>,
    /// Scale each motion to this PGV, m/s
    #[arg(long, value_name = "M/S", value_parser = number(1e-9..=100.0, "a PGV above 0 m/s"))]
    scale_pgv: Option<f64>,
    /// Velocity pulses: find (Baker 2007, then a fit of Eq. 1, the velocity) or skip
    #[arg(long, default_value = "find")]
    pulses: PulseSearch,
    /// Also write motions without their pulse, as suite residual
    #[arg(long)]
    residual: bool,
    /// Add spectral accelerations (5 % damping) at these periods, s, as sa_0p20_m_s2
    #[arg(long, value_name = "S,...")]
    sa: Option<Steps>,
    /// Also compute the Housner intensity (15 times as slow)
    #[arg(long)]
    housner: bool,
    /// Import motions that no earthquake is likely to have made
    #[arg(long)]
    accept_implausible: bool,
    /// Import the others where a file cannot be read
    #[arg(long)]
    keep_going: bool,
}

/// What the file has of a motion, besides its measures.
#[derive(Serialize, Deserialize)]
struct SourceRow {
    motion_id: String,
    suite: Suite,
    name: Option<String>,
    earthquake: Option<String>,
    station: Option<String>,
    component: Option<String>,
    azimuth_deg: Option<f64>,
    source_file: String,
    source_blake3: String,
    scale: f64,
    dt_s: f64,
}

/// What is known of the pair and the pulse of a motion.
#[derive(Serialize, Deserialize)]
struct PulseRow {
    housner_m: Option<f64>,
    rotd50_pga_m_s2: Option<f64>,
    rotd100_pga_m_s2: Option<f64>,
    rotd50_pgv_m_s: Option<f64>,
    rotd100_pgv_m_s: Option<f64>,
    pulse_indicator: Option<f64>,
    pulse_verdict: Option<Verdict>,
    pulse_wavelet_s: Option<f64>,
    pulse_amplitude_m_s: Option<f64>,
    vp_m_s: Option<f64>,
    tp_s: Option<f64>,
    gamma: Option<f64>,
    nu_rad: Option<f64>,
    t0_s: Option<f64>,
    pulse_r2: Option<f64>,
}

impl Stage for ImportMotions {
    fn outputs(&self) -> Vec<PathBuf> {
        vec![self.out.clone()]
    }

    fn check(&self) -> anyhow::Result<()> {
        if self.files.is_empty() {
            return Err(UsageError::because("no files; expected files or folders of records"));
        }
        if self.residual && self.pulses == PulseSearch::Skip {
            return Err(UsageError::because("residual motions need their pulses; leave out pulses: skip"));
        }
        Ok(())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let importer = Importer::new(self)?;
        let periods = importer.processing.plan.sa_periods_s.clone();
        let mut writer = context.create(&self.out, &batch(&[], &periods)?.schema())?;
        let (work, mut refused) = importer.work(context)?;
        let (mut ids, mut summary) = (HashSet::new(), Summary::default());
        let bar = context.bar(work.len() as u64);
        pipelined(
            work.chunks(AT_ONCE).map(Ok),
            |work| {
                bar.advance(work.len() as u64)?;
                Ok(work.par_iter().flat_map_iter(|work| importer.import(work)).collect::<Vec<_>>())
            },
            |results| {
                for result in results {
                    let imported = match result {
                        Ok(imported) => imported,
                        Err(refusal) => {
                            refused.push(refusal);
                            continue;
                        }
                    };
                    if let Some(twice) = imported.iter().find(|motion| !ids.insert(motion.motion_id.clone()))
                    {
                        anyhow::bail!(
                            "{}: two motions are called '{}'; rename the file",
                            twice.source.path,
                            twice.motion_id
                        );
                    }
                    context.warn(imported.iter().filter_map(warning).collect());
                    summary.add(&imported);
                    writer.append(&batch(&imported, &periods)?)?;
                }
                Ok(())
            },
        )?;
        if ids.is_empty() || !refused.is_empty() && !self.keep_going {
            let others = if ids.is_empty() { "" } else { "\n--keep-going imports the others" };
            anyhow::bail!(
                "{} of {} files cannot be imported:\n{}{others}",
                refused.len(),
                importer.files.len(),
                refused.join("\n")
            );
        }
        context.warn(refused.into_iter().map(|refusal| (Warning::UnreadableFile, refusal)).collect());
        let summary = summary.text();
        context.finish(writer, &summary)?;
        Ok(summary)
    }
}

/// The files of a call, and what is done to them.
struct Importer {
    files: Vec<PathBuf>,
    /// How many files share a stem or a name.
    names: HashMap<String, usize>,
    reading: ReadOptions,
    processing: Processing,
}

/// What one thread imports: a file, or two components by their file and number.
enum Work {
    File(PathBuf),
    Pair([(PathBuf, usize); 2]),
}

impl Importer {
    fn new(options: &ImportMotions) -> anyhow::Result<Importer> {
        let mut files = keys::files_below(&options.files)?;
        // What an earlier run wrote into a folder of records is no record.
        let out = std::path::absolute(&options.out)?;
        files.retain(|file| std::path::absolute(file).is_ok_and(|file| file != out));
        let mut names = HashMap::new();
        for file in &files {
            let both: HashSet<String> = [file.file_stem(), file.file_name()].map(text).into();
            both.into_iter().for_each(|name| *names.entry(name).or_insert(0) += 1);
        }
        let scaling = match (&options.scale, options.scale_pga, options.scale_pgv) {
            (Some(factors), ..) if factors.0.iter().any(|factor| *factor <= 0.0) => {
                return Err(UsageError::because("scale: expected factors above 0"));
            }
            (Some(factors), ..) => Scaling::Factors(factors.0.clone()),
            (_, Some(pga_g), _) => Scaling::Pga(pga_g * G_M_S2),
            (_, _, Some(pgv_m_s)) => Scaling::Pgv(pgv_m_s),
            _ => Scaling::Factors(vec![1.0]),
        };
        let sa_periods_s = options.sa.as_ref().map_or(Vec::new(), |steps| steps.0.clone());
        Ok(Importer {
            files,
            names,
            reading: ReadOptions {
                format: options.format,
                dt_s: options.dt,
                unit: options.unit,
                column: options.column.clone(),
                pga_tolerance: options.pga_tolerance,
            },
            processing: Processing {
                baseline: options.baseline,
                high_pass: options.high_pass.map(|corner_hz| HighPass { corner_hz }),
                resample_s: options.resample,
                direction: options.rotate,
                scaling,
                pulses: options.pulses,
                residual: options.residual,
                implausible: if options.accept_implausible {
                    Implausible::Accept
                } else {
                    Implausible::Refuse
                },
                plan: MeasurePlan { housner: options.housner, sa_periods_s },
            },
        })
    }

    /// All work in order, and what cannot be read already.
    fn work(&self, context: &Context) -> anyhow::Result<(Vec<Work>, Vec<String>)> {
        if self.processing.direction.is_none() {
            return Ok((self.files.iter().cloned().map(Work::File).collect(), Vec::new()));
        }
        let (mut components, mut refused) = (Vec::new(), Vec::new());
        for (file, read) in self.files.par_iter().map(|file| (file, self.read(file))).collect::<Vec<_>>() {
            match read {
                // Samples are read again once a pair is found: that takes less memory than keeping all of
                // them.
                Ok(records) => components.extend(records.into_iter().enumerate().map(|(index, record)| {
                    let motion = RecordedMotion { acceleration_m_s2: Vec::new(), ..record.motion };
                    (motion, (file.clone(), index))
                })),
                Err(refusal) => refused.push(refusal),
            }
        }
        let Pairs { pairs, left_out } = pairs(components);
        let warning = |(file, _): (PathBuf, usize)| (Warning::NoPartner, text(file.file_name()));
        context.warn(left_out.into_iter().map(warning).collect());
        Ok((pairs.into_iter().map(Work::Pair).collect(), refused))
    }

    fn import(&self, work: &Work) -> Vec<Result<Vec<ImportedMotion>, String>> {
        match work {
            Work::File(file) => match self.read(file) {
                Ok(records) => {
                    let import =
                        |record| self.processing.import(record).map_err(|error| refusal(file, &error));
                    records.into_iter().map(import).collect()
                }
                Err(refusal) => vec![Err(refusal)],
            },
            Work::Pair(pair) => {
                let component = |(file, index): &(PathBuf, usize)| {
                    let record = self.read(file)?.into_iter().nth(*index);
                    record.ok_or_else(|| refusal(file, &"changed while it was read; run again"))
                };
                let both = || Ok([component(&pair[0])?, component(&pair[1])?]);
                let import =
                    |both| self.processing.import_pair(both).map_err(|error| refusal(&pair[0].0, &error));
                vec![both().and_then(import)]
            }
        }
    }

    /// Reads the records of a file, in words what is wrong with it.
    fn read(&self, file: &Path) -> Result<Vec<NamedRecord>, String> {
        let bytes = std::fs::read(file).map_err(|error| refusal(file, &error))?;
        let source = SourceFile {
            path: file.display().to_string(),
            blake3: blake3::hash(&bytes).to_hex().to_string(),
        };
        let motions = read_records(&bytes, &self.reading).map_err(|error| refusal(file, &error))?;
        let several = motions.len() > 1;
        let named = |(index, motion): (usize, RecordedMotion)| {
            let samples = motion.acceleration_m_s2.len();
            if samples > LONGEST_MOTION {
                return Err(refusal(file, &format!("{samples} samples; expected {LONGEST_MOTION} at most")));
            }
            Record::new(&motion.acceleration_m_s2, motion.dt_s).map_err(|problem| refusal(file, &problem))?;
            let name = self.name(file);
            let motion_id = if several { format!("{name}:{}", index + 1) } else { name };
            Ok(NamedRecord { motion_id, source: source.clone(), motion })
        };
        motions.into_iter().enumerate().map(named).collect()
    }

    /// The name of a file without its ending where no other file has the same, else with it (K-NET tells
    /// components by the ending), else its path.
    fn name(&self, file: &Path) -> String {
        let names = [file.file_stem(), file.file_name()].map(text);
        let unique = names.into_iter().find(|name| self.names.get(name) == Some(&1));
        unique.unwrap_or_else(|| file.display().to_string())
    }
}

fn text(name: Option<&std::ffi::OsStr>) -> String {
    name.unwrap_or_default().to_string_lossy().into_owned()
}

fn refusal(file: &Path, reason: &impl ToString) -> String {
    format!("{}: {}", file.display(), reason.to_string())
}

/// The unit of acceleration of this name.
fn acceleration_unit(text: &str) -> Result<Unit, String> {
    let unit = Unit::parse(text).filter(|unit| unit.quantity == Quantity::Acceleration);
    unit.ok_or_else(|| "expected g, m/s2, cm/s2, gal, mm/s2, mg, %g, ft/s2 or in/s2".to_string())
}

fn warning(motion: &ImportedMotion) -> Option<(Warning, String)> {
    Some((Warning::ImplausibleRecord, format!("{}: {}", motion.motion_id, motion.warning?)))
}

fn batch(some: &[ImportedMotion], periods_s: &[f64]) -> anyhow::Result<RecordBatch> {
    let sources: Vec<SourceRow> = some.iter().map(SourceRow::from).collect();
    let measures: Vec<Measures> = some.iter().map(|motion| motion.measured.measures).collect();
    let pulses: Vec<PulseRow> = some.iter().map(PulseRow::from).collect();
    let sa: Vec<&[f64]> = some.iter().map(|motion| motion.measured.sa_m_s2.as_slice()).collect();
    let known = [rows::batch(&sources)?, rows::batch(&measures)?, rows::batch(&pulses)?];
    motions::batch(&known, periods_s, &sa, some.iter().map(|motion| motion.acceleration_m_s2.as_slice()))
}

impl From<&ImportedMotion> for SourceRow {
    fn from(motion: &ImportedMotion) -> SourceRow {
        SourceRow {
            motion_id: motion.motion_id.clone(),
            suite: motion.suite,
            name: motion.name(),
            earthquake: motion.record.event.clone(),
            station: motion.record.station.clone(),
            component: motion.record.component.clone(),
            azimuth_deg: motion.record.azimuth_deg,
            source_file: motion.source.path.clone(),
            source_blake3: motion.source.blake3.clone(),
            scale: motion.scale,
            dt_s: motion.record.dt_s,
        }
    }
}

impl From<&ImportedMotion> for PulseRow {
    fn from(ImportedMotion { measured, rotd, indicator, pulse: fitted, .. }: &ImportedMotion) -> PulseRow {
        let pulse = fitted.as_ref().map(|fitted| fitted.pulse);
        let peak = |peak: fn(&RotD) -> f64| rotd.as_ref().map(peak);
        PulseRow {
            housner_m: measured.housner_m,
            rotd50_pga_m_s2: peak(|rotd| rotd.pga50_m_s2),
            rotd100_pga_m_s2: peak(|rotd| rotd.pga100_m_s2),
            rotd50_pgv_m_s: peak(|rotd| rotd.pgv50_m_s),
            rotd100_pgv_m_s: peak(|rotd| rotd.pgv100_m_s),
            pulse_indicator: indicator.as_ref().map(|found| found.indicator),
            pulse_verdict: indicator.as_ref().map(|found| found.verdict),
            pulse_wavelet_s: indicator.as_ref().map(|found| found.period_s),
            pulse_amplitude_m_s: pulse.map(|pulse| pulse.amplitude_m_s),
            vp_m_s: pulse.map(|pulse| pulse.amplitude_m_s * largest_velocity(pulse.gamma, pulse.nu_rad)),
            tp_s: pulse.map(|pulse| pulse.tp_s),
            gamma: pulse.map(|pulse| pulse.gamma),
            nu_rad: pulse.map(|pulse| pulse.nu_rad),
            t0_s: fitted.as_ref().map(|fitted| fitted.t0_s),
            pulse_r2: fitted.as_ref().map(|fitted| fitted.r2),
        }
    }
}

/// What was read, so that a wrong unit is seen.
#[derive(Default)]
struct Summary {
    motions: usize,
    pulses: usize,
    /// How many motions came of each format and unit.
    kinds: BTreeMap<String, usize>,
    /// PGA (g) and PGV (m/s) of each.
    peaks: Vec<[f64; 2]>,
}

impl Summary {
    fn add(&mut self, imported: &[ImportedMotion]) {
        for motion in imported {
            self.motions += 1;
            self.pulses += usize::from(motion.pulse.is_some());
            *self
                .kinds
                .entry(format!("{} in {}", motion.record.format, motion.record.unit.name))
                .or_default() += 1;
            let Measures { pga_m_s2, pgv_m_s, .. } = motion.measured.measures;
            self.peaks.push([pga_m_s2 / G_M_S2, pgv_m_s]);
        }
    }

    fn text(&self) -> String {
        let kinds: Vec<String> = self.kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        let range = |peak: usize| {
            let values = self.peaks.iter().map(|peaks| peaks[peak]);
            (values.clone().fold(f64::INFINITY, f64::min), values.fold(0.0, f64::max))
        };
        let ((low_g, high_g), (low, high)) = (range(0), range(1));
        format!(
            "{} motions ({}), {} with a pulse\nPGA {low_g:.3} to {high_g:.3} g, PGV {low:.3} to {high:.3} m/s\n",
            self.motions,
            listed(&kinds, NAMED),
            self.pulses
        )
    }
}
