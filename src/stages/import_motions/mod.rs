//! import-motions: recorded ground motions from the files of strong-motion networks and people, as motions
//! that simulate reads.

mod importer;
mod summary;

use std::path::PathBuf;

use arrow_array::RecordBatch;
use clap::Args;
use clap::ValueHint::{AnyPath, FilePath};
use rockfrag_core::motion::MeasurePlan;
use rockfrag_core::records::processing::{ImportedMotion, Processing, PulseSearch};
use rockfrag_core::records::rotation::Orientation;
use rockfrag_core::records::signal::Baseline;
use rockfrag_core::units::Unit;
use rockfrag_core::warning::{Warning, Warnings};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use self::importer::Importer;
use self::summary::Summary;
use crate::inputs::About;
use crate::inputs::records::{ReadOptions, RecordFormat};
use crate::pipeline::context::Context;
use crate::pipeline::options::{Steps, number, periods, steps};
use crate::pipeline::paths::{Files, Read};
use crate::pipeline::stream::{batches, pipelined};
use crate::pipeline::{Stage, UsageError};
use crate::table::keys::resolved;
use crate::table::{motions, rows};

/// Files, or pairs of components, that are processed at once.
const AT_ONCE: usize = 32;

/// Import recorded ground motions from the files of strong-motion networks, or CSV
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag import-motions records --about records.csv --out motions.parquet\n\
    rockfrag import-motions a.csv b.csv --unit g --dt 0.01 --column 2\n\
    rockfrag import-motions records --keep-going --scale 0.5,1,2 --rotate strongest-pulse")]
pub struct ImportMotions {
    /// Files and folders of records
    #[arg(value_name = "FILE|DIR", value_hint = AnyPath, required = true)]
    files: Vec<PathBuf>,
    /// Motions to write
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "motions.parquet")]
    out: PathBuf,
    /// Format: at2, cosmos, esm, knet or csv [default: by content]
    #[arg(long)]
    format: Option<RecordFormat>,
    /// Time step, s, where files do not state it
    #[arg(long, value_name = "S", value_parser = number(1e-6..=10.0, "a time step above 0 s and up to 10 s"))]
    dt: Option<f64>,
    /// Unit of acceleration, where files do not state it: g, m/s2, cm/s2 (gal), mm/s2, mg, %g, ft/s2
    /// or in/s2
    #[arg(long, value_parser = Unit::parse_acceleration)]
    #[serde(default, deserialize_with = "unit")]
    unit: Option<Unit>,
    /// Column of acceleration in CSV: number, heading, or all where one series wraps over lines
    #[arg(long, value_name = "N|NAME|all")]
    column: Option<String>,
    /// Remove from acceleration: none, mean or linear
    #[arg(long, default_value = "none")]
    baseline: Baseline,
    /// Corner of a zero-phase high-pass filter of order 4, Hz
    #[arg(long, value_name = "HZ",
          value_parser = number(1e-6..=1.0, "above 0 and up to 1 Hz: motions above 1 Hz rock structures"))]
    high_pass: Option<f64>,
    /// Resample to this time step, s
    #[arg(long, value_name = "S", value_parser = number(1e-4..=0.1, "a time step from 0.0001 to 0.1 s"))]
    resample: Option<f64>,
    /// Rotate pairs of horizontal components to an azimuth (degrees) or the strongest-pulse; add
    /// RotD50 and RotD100
    #[arg(long, value_name = "AZIMUTH|strongest-pulse")]
    rotate: Option<Orientation>,
    /// Scale by these factors; each gives a separate motion
    #[arg(long, value_name = "F,...",
          value_parser = steps(f64::MIN_POSITIVE..=f64::MAX, "expected factors above 0"))]
    scale: Option<Steps>,
    /// Velocity pulses: find (Baker 2007, then a fit of Eq. 1, the velocity) or skip
    #[arg(long, default_value = "find")]
    pulses: PulseSearch,
    /// Add spectral accelerations (5 % damping) at these periods, s, as sa_0p20_m_s2
    #[arg(long, value_name = "S,...", value_parser = periods)]
    sa: Option<Steps>,
    /// Also compute the Housner intensity (15 times as slow)
    #[arg(long)]
    housner: bool,
    /// Table with the magnitude, distance (km) or earthquake of each file (columns file, magnitude,
    /// distance, earthquake), or PEER's search results or flatfile
    #[arg(long, value_name = "FILE", value_hint = FilePath)]
    about: Option<PathBuf>,
    /// Import physically implausible motions
    #[arg(long)]
    accept_implausible: bool,
    /// Skip files that cannot be read
    #[arg(long)]
    keep_going: bool,
}

fn unit<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Unit>, D::Error> {
    Unit::parse_acceleration(&String::deserialize(deserializer)?).map(Some).map_err(D::Error::custom)
}

impl Stage for ImportMotions {
    fn files(&self) -> Files {
        let records = Read { whole_folders: true, ..Read::new("files", &self.files) };
        Files::tables([records, Read::new("about", &self.about)], [&self.out])
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let sa_periods_s = self.sa.as_ref().map_or(Vec::new(), |steps| steps.0.clone());
        let processing = Processing {
            baseline: self.baseline,
            high_pass_hz: self.high_pass,
            resample_s: self.resample,
            direction: self.rotate,
            factors: self.scale.as_ref().map_or(vec![1.0], |steps| steps.0.clone()),
            pulses: self.pulses,
            accept_implausible: self.accept_implausible,
            plan: MeasurePlan { housner: self.housner, sa_periods_s },
        };
        let reading =
            ReadOptions { format: self.format, dt_s: self.dt, unit: self.unit, column: self.column.clone() };
        let files = context.plan.made.inputs.get("files").into_iter().flatten();
        let files = importer::named(files.map(|file| file.path.clone()).collect());
        let mut importer = Importer { files, reading, processing, about: About::default() };
        if let Some(path) = &self.about {
            let Importer { files, about, .. } = &mut importer;
            *about = About::read(path).map_err(|error| UsageError::because(error.to_string()))?;
            context.tell(Warnings::default(), vec![about.reading.clone()]);
            files.retain(|file| resolved(&file.path) != resolved(path));
            let problem = format!("{}: no row is about any of the files", path.display());
            let is_about_any = files.iter().any(|file| about.get(&file.path).is_some());
            anyhow::ensure!(is_about_any, UsageError::because(problem));
        }
        let mut writer = context.create(&self.out, &batch(&[], &importer.processing.plan)?.schema())?;
        let mut summary = Summary::default();
        let work = importer.work(context, &mut summary)?;
        let bar = context.bar(work.len());
        pipelined(
            batches(work.into_iter(), AT_ONCE),
            |work| {
                bar.advance(1)?;
                Ok(importer.import(&work))
            },
            |results| {
                for result in results {
                    match result {
                        Err(why) => summary.leave_out(why),
                        Ok(imported) => {
                            context.warn(imported.iter().flat_map(warnings).collect());
                            writer.append(&batch(&imported, &importer.processing.plan)?)?;
                            summary.add(imported);
                        }
                    }
                }
                Ok(())
            },
        )?;
        summary.expect_motions(self.keep_going)?;
        context.warn(summary.refused.iter().map(|why| (Warning::UnreadableFile, why.clone())).collect());
        let text = summary.text();
        context.finish(writer, &text)?;
        Ok(text)
    }
}

fn warnings(motion: &ImportedMotion) -> impl Iterator<Item = (Warning, String)> {
    motion.doubts.iter().map(|(warning, why)| (*warning, format!("{}: {why}", motion.motion_id)))
}

fn batch(some: &[ImportedMotion], plan: &MeasurePlan) -> anyhow::Result<RecordBatch> {
    let sampled = some.iter().map(|motion| (&motion.measures, motion.acceleration_m_s2.as_slice()));
    motions::batch(&[rows::batch(some)?], &plan.sa_periods_s, sampled)
}
