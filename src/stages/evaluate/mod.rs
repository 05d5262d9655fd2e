//! evaluate: probabilities at an intensity or at each of a table, and annual rates over the hazard of a site.

mod answer;
mod object;
mod site;
mod table;

use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use clap::{Args, ValueHint};
use rayon::prelude::*;

use super::shared::fits::FitsArgs;
use super::shared::hazard::{self, Renamed};
use super::shared::responses;
use super::shared::structures::{Object, StructureArgs, warnings_of};
use crate::fragility::{Model, Peak, Ratio, Scenarios};
use crate::keyword;
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::stage::Stage;
use crate::rocking::Structure;
use crate::table::frame::{self, Format};
use crate::table::rows;
use crate::table::writer::write_file;
use crate::units::G_M_S2;
use crate::warning::Warning;

use self::object::{Answer, texts};
pub use self::object::{ObjectRow, Predicted, TreeRow, words_of};
pub use self::site::RatesRow;
use self::site::Site;

/// Predict how probable rocking and overturning are: under a motion, under each of a table, or a year at
/// a site
#[derive(Debug, Args)]
#[command(after_help = "rockfrag evaluate --width 0.5 --height 2.0 --pga 0.5 --pgv 0.6\n\
    rockfrag evaluate --structures objects.csv --hazard hazard.csv")]
pub struct Evaluate {
    /// Peak ground acceleration, g
    #[arg(long, value_name = "G", conflicts_with_all = ["in", "hazard"],
          value_parser = number(0.0..=4.5, "g, up to 4.5, the strongest ever recorded: is it in m/s2?"))]
    pga: Option<f64>,
    /// Peak ground velocity, m/s
    #[arg(long, value_name = "M/S", conflicts_with_all = ["in", "hazard"],
          value_parser = number(0.0..=5.0, "m/s, up to 5, more than was ever recorded: is it in cm/s?"))]
    pgv: Option<f64>,
    /// Table of PGA and PGV (pga_m_s2 or pga_g, pgv_m_s), Parquet or CSV, with p_rad_s, alpha_rad and
    /// eta where they vary
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = ValueHint::FilePath, conflicts_with = "hazard")]
    input: Option<PathBuf>,
    /// Hazard curve, CSV: PGA or PGV with annual rates, probabilities or return periods; or both with
    /// rates of occurrence
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    hazard: Option<PathBuf>,
    /// Headings of --hazard or --in that stand for columns
    #[arg(long, value_name = "COLUMN=HEADING,...", value_delimiter = ',')]
    columns: Vec<Renamed>,
    /// Time of exposure, years
    #[arg(long, value_name = "YEARS", default_value = "50", value_parser = number(1e-3..=1e6, "years above 0"))]
    years: f64,
    /// PGV/PGA of all motions, s [default: as in motions of that strength]
    #[arg(long, value_name = "S", requires = "hazard",
          value_parser = number(0.005..=1.0, "PGV/PGA in s, from 0.005 to 1, of PGA in m/s2 and PGV in m/s"))]
    ratio: Option<f64>,
    /// Responses to count overturning in, beside the rate
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    responses: Option<PathBuf>,
    /// Continue the hazard curve with its last slope
    #[arg(long, requires = "hazard")]
    extrapolate: bool,
    /// Also print model, measures and other predictions
    #[arg(long)]
    explain: bool,
    /// Also print a sentence for a report
    #[arg(long)]
    sentence: bool,
    /// text, csv or json
    #[arg(long, default_value = "text")]
    format: Format,
    /// File to write: .parquet, .csv or .json [default: none; with --in, evaluated.parquet beside it]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::AnyPath)]
    out: Option<PathBuf>,
    #[command(flatten)]
    fits: FitsArgs,
    #[command(flatten)]
    structures: StructureArgs,
}

/// What is evaluated.
enum Question<'a> {
    /// PGA (g) and PGV (m/s).
    Point(f64, f64),
    Table(&'a Path),
    Hazard(&'a Path),
}

impl Stage for Evaluate {
    fn outputs(&self) -> Vec<PathBuf> {
        self.out().into_iter().collect()
    }

    fn check(&self) -> anyhow::Result<()> {
        if let Some(out) = self.out() {
            file_format(&out)?;
        }
        self.question().map(|_| ())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        match self.question()? {
            Question::Table(path) => table::run(self, path, context),
            Question::Point(pga_g, pgv_m_s) => self.at_point(pga_g, pgv_m_s, context),
            Question::Hazard(path) => self.over_hazard(path, context),
        }
    }
}

impl Evaluate {
    fn out(&self) -> Option<PathBuf> {
        let beside = || self.input.as_ref().map(|input| input.with_file_name("evaluated.parquet"));
        self.out.clone().or_else(beside)
    }

    fn question(&self) -> anyhow::Result<Question<'_>> {
        match (self.pga, self.pgv, &self.input, &self.hazard) {
            (Some(pga), Some(pgv), ..) => Ok(Question::Point(pga, pgv)),
            (_, _, Some(path), _) => Ok(Question::Table(path)),
            (_, _, _, Some(path)) => Ok(Question::Hazard(path)),
            _ => Err(UsageError::because(
                "expected --pga (g) and --pgv (m/s), a table of intensities (--in) or the hazard of a site (--hazard)",
            )),
        }
    }

    /// Returns the given structures, or all fitted ones.
    fn objects(&self) -> anyhow::Result<Vec<Object>> {
        if !self.structures.is_given() && self.fits.fits.is_some() {
            return Ok(self.fits.models()?.structures().into_iter().map(Object::from).collect());
        }
        let objects = self.structures.objects()?;
        match objects.iter().find_map(|object| object.structure.as_ref().err()) {
            Some(reason) if objects.iter().all(|object| object.structure.is_err()) => {
                match self.structures.structures {
                    Some(_) => anyhow::bail!("{reason}; no other row can be right either"),
                    None => Err(UsageError::because(reason)),
                }
            }
            _ => Ok(objects),
        }
    }

    fn at_point(&self, pga_g: f64, pgv_m_s: f64, context: &Context) -> anyhow::Result<String> {
        let peaks = [pga_g * G_M_S2, pgv_m_s];
        let predict = |structure: &Structure, model: &Model, _: &mut Vec<Warning>| {
            let measures = IntensityMeasures::new(structure, peaks[0], peaks[1], None, None);
            (TreeRow::new(peaks, &model.probabilities(structure, &measures, Scenarios::One)), measures)
        };
        self.answer(predict, |all| answer::of_points(all, self.sentence), context)
    }

    fn over_hazard(&self, path: &Path, context: &Context) -> anyhow::Result<String> {
        let site = Site {
            hazard: hazard::read(path, &self.columns)?,
            years: self.years,
            ratio: self.ratio.map_or(Ratio::Distributed, Ratio::Seconds),
            extrapolate: self.extrapolate,
            limit_state: self.fits.limit_state,
            responses: self.responses.as_deref().map(responses::read).transpose()?,
        };
        site.check(self.ratio)?;
        let implausible = site.is_implausible().then_some(Warning::ImplausibleHazard);
        let predict = |structure: &Structure, model: &Model, warnings: &mut Vec<Warning>| {
            warnings.extend(implausible);
            site.rates(structure, model, warnings)
        };
        self.answer(predict, |all| answer::of_rates(all, &site, self.sentence), context)
    }

    /// Predicts for all objects, the worst first. `predict` gives a row, and the measures of the motion that
    /// matters.
    fn answer<R: Predicted>(
        &self,
        predict: impl Fn(&Structure, &Model, &mut Vec<Warning>) -> (R, IntensityMeasures) + Sync,
        text: impl Fn(&[Answer<R>]) -> String,
        context: &Context,
    ) -> anyhow::Result<String> {
        let models = self.fits.models()?;
        let of_object = |object: Object| -> anyhow::Result<Answer<R>> {
            let structure = match &object.structure {
                Ok(structure) => structure,
                Err(reason) => {
                    let refused = Answer {
                        object: ObjectRow::refused(&object),
                        row: R::default().with_warnings(Some(reason.clone())),
                        warnings: vec![Warning::ImplausibleRow],
                        explained: String::new(),
                    };
                    return Ok(refused);
                }
            };
            let (model, mut warnings) = models.model(structure)?;
            let (row, measures) = predict(structure, &model, &mut warnings);
            warnings.extend(warnings_of(structure));
            warnings.extend(model.warnings(structure, &measures));
            warnings.sort();
            warnings.dedup();
            let explained = || answer::explained(&model, structure, &measures);
            Ok(Answer {
                object: ObjectRow::new(&object, structure, &model, self.fits.limit_state),
                row: row.with_warnings(texts(&warnings)),
                warnings,
                explained: if self.explain { explained() } else { String::new() },
            })
        };
        let all = self.objects()?.into_par_iter().map(of_object).collect::<anyhow::Result<Vec<_>>>();
        let mut all = all?;
        let warnings = |answer: &Answer<R>| {
            let name = answer.object.structure.clone();
            answer.warnings.clone().into_iter().map(move |warning| (warning, name.clone()))
        };
        context.warn(all.iter().flat_map(warnings).collect());
        all.sort_by(|a, b| b.row.severity().total_cmp(&a.row.severity()));
        let objects: Vec<&ObjectRow> = all.iter().map(|answer| &answer.object).collect();
        let predicted: Vec<&R> = all.iter().map(|answer| &answer.row).collect();
        let columns = [rows::batch_of::<ObjectRow, _>(&objects)?, rows::batch_of::<R, _>(&predicted)?];
        let rows = rows::side_by_side(&columns)?;
        self.write(&[rows], || text(&all), context)
    }

    /// Writes rows of one schema, if they go to a file, and returns what to print.
    fn write(
        &self,
        rows: &[RecordBatch],
        text: impl Fn() -> String,
        context: &Context,
    ) -> anyhow::Result<String> {
        let show = |format: Format| -> anyhow::Result<String> {
            let mut whole = frame::of_batch(&rows[0])?;
            for more in &rows[1..] {
                whole.vstack_mut(&frame::of_batch(more)?)?;
            }
            frame::show(&whole, format)
        };
        let printed = if self.format == Format::Text { text() } else { show(self.format)? };
        let Some(out) = self.out() else { return Ok(printed) };
        match file_format(&out)? {
            Some(format) => write_file(&out, show(format)?.as_bytes())?,
            None => {
                let mut writer = context.create(&out, &rows[0].schema())?;
                rows.iter().try_for_each(|rows| writer.append(rows))?;
                context.finish(writer, &printed)?;
            }
        }
        Ok(printed)
    }
}

/// How a file is written, by how its name ends; none as Parquet.
fn file_format(out: &Path) -> anyhow::Result<Option<Format>> {
    match out.extension().and_then(|ending| ending.to_str()) {
        Some("parquet") => Ok(None),
        Some(ending @ ("csv" | "json")) => Ok(Some(keyword::parse(ending)?)),
        _ => {
            let out = out.display();
            Err(UsageError::because(format!(
                "out is {out}; expected a name that ends in .parquet, .csv or .json"
            )))
        }
    }
}

/// The usual unit of a peak, and its size in m/s2 or m/s.
fn unit(peak: Peak) -> (&'static str, f64) {
    match peak {
        Peak::Pga => ("g", G_M_S2),
        Peak::Pgv => ("m/s", 1.0),
    }
}
