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
use super::shared::structures::{Object, StructureArgs, doubts_of};
use crate::doubt::{Doubt, Doubts};
use crate::fragility::{Peak, Ratio, Scenarios};
use crate::keyword;
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::stage::Stage;
use crate::table::frame::{self, Format};
use crate::table::rows;
use crate::table::writer::write_file;
use crate::units::G_M_S2;

pub use self::object::{ObjectRow, TreeRow, words_of};
pub use self::site::RatesRow;

/// Predict how probable rocking and overturning are: at a PGA and PGV, at each of a table, or a year at a site
///
/// Without --fits, the universal surface for recorded motions predicts them.
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
    /// Table of intensities, Parquet or CSV: PGA (pga_m_s2, or in g) and PGV (pgv_m_s), and p_rad_s, alpha_rad and eta
    /// where they vary; other columns are copied
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = ValueHint::FilePath, conflicts_with = "hazard")]
    input: Option<PathBuf>,
    /// Hazard of the site, CSV: PGA or PGV with annual rates, probabilities or return periods, or both with rates of
    /// occurrence
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    hazard: Option<PathBuf>,
    /// Which headings of --hazard or --in stand for which columns
    #[arg(long, value_name = "COLUMN=HEADING,...", value_delimiter = ',')]
    columns: Vec<Renamed>,
    /// Time of exposure, years
    #[arg(long, value_name = "YEARS", default_value = "50", value_parser = number(1e-3..=1e6, "years above 0"))]
    years: f64,
    /// PGV/PGA of all motions, s [default: as motions of the same strength have it]
    #[arg(long, value_name = "S", requires = "hazard",
          value_parser = number(0.005..=1.0, "PGV/PGA in s, from 0.005 to 1, of PGA in m/s2 and PGV in m/s"))]
    ratio: Option<f64>,
    /// Responses whose overturning is counted beside the rate, weighted to the hazard
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, requires = "hazard")]
    responses: Option<PathBuf>,
    /// Continue a hazard curve beyond its end with its last slope
    #[arg(long, requires = "hazard")]
    extrapolate: bool,
    /// Also print the model, the measures of the motion and what other models predict
    #[arg(long)]
    explain: bool,
    /// Also print a sentence for a report
    #[arg(long)]
    sentence: bool,
    /// text, csv or json
    #[arg(long, default_value = "text")]
    format: Format,
    /// File to write, .parquet, .csv or .json [default: none; with --in, evaluated.parquet beside it]
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

    /// The structures that are asked for, or all that are fitted.
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
        let models = self.fits.models()?;
        let of_object = |object: Object| -> anyhow::Result<(ObjectRow, TreeRow, String)> {
            let structure = match &object.structure {
                Ok(structure) => structure,
                Err(reason) => {
                    let row = TreeRow { doubts: Some(reason.clone()), ..TreeRow::default() };
                    return Ok((ObjectRow::refused(&object), row, String::new()));
                }
            };
            let (model, mut doubts) = models.model(structure)?;
            let measures = IntensityMeasures::new(structure, pga_g * G_M_S2, pgv_m_s, None, None);
            doubts.extend(doubts_of(structure));
            doubts.extend(model.doubts(structure, &measures));
            let probabilities = model.probabilities(structure, &measures, Scenarios::One);
            let row = TreeRow::new([pga_g * G_M_S2, pgv_m_s], &probabilities, &doubts);
            context.doubt(doubts.into_iter().map(|doubt| (doubt, object.name.clone())).collect());
            let object = ObjectRow::new(&object, structure, &model, self.fits.limit_state);
            let more = if self.explain { answer::explained(&model, structure, &measures) } else { String::new() };
            Ok((object, row, more))
        };
        let objects = self.objects()?;
        let mut all = objects.into_par_iter().map(of_object).collect::<anyhow::Result<Vec<_>>>()?;
        all.sort_by(|a, b| b.1.severity().total_cmp(&a.1.severity()));
        context.doubt(refused(all.iter().map(|(object, row, _)| (object, &row.doubts))));
        let text = || answer::of_points(&all, self.sentence);
        let (objects, trees): (Vec<&ObjectRow>, Vec<&TreeRow>) =
            all.iter().map(|(object, tree, _)| (object, tree)).unzip();
        let columns = [rows::batch_of::<ObjectRow, _>(&objects)?, rows::batch_of::<TreeRow, _>(&trees)?];
        self.finish(&rows::side_by_side(&columns)?, text, context)
    }

    fn over_hazard(&self, path: &Path, context: &Context) -> anyhow::Result<String> {
        let site = site::Site {
            hazard: hazard::read(path, &self.columns)?,
            years: self.years,
            ratio: self.ratio.map_or(Ratio::Distributed, Ratio::Seconds),
            extrapolate: self.extrapolate,
            limit_state: self.fits.limit_state,
            responses: self.responses.as_deref().map(super::shared::responses::read).transpose()?,
        };
        site.check(self.ratio)?;
        if site.is_implausible() {
            context.doubt([(Doubt::ImplausibleHazard, path.display().to_string())].into_iter().collect());
        }
        let models = self.fits.models()?;
        let of_object = |object: Object| -> anyhow::Result<(ObjectRow, RatesRow, String)> {
            let structure = match &object.structure {
                Ok(structure) => structure,
                Err(reason) => {
                    let row = RatesRow { doubts: Some(reason.clone()), ..RatesRow::default() };
                    return Ok((ObjectRow::refused(&object), row, String::new()));
                }
            };
            let (model, mut doubts) = models.model(structure)?;
            doubts.extend(doubts_of(structure));
            let (row, measures) = site.rates(structure, &model, &mut doubts);
            context.doubt(doubts.into_iter().map(|doubt| (doubt, object.name.clone())).collect());
            let object = ObjectRow::new(&object, structure, &model, self.fits.limit_state);
            let more = if self.explain { answer::explained(&model, structure, &measures) } else { String::new() };
            Ok((object, row, more))
        };
        let objects = self.objects()?;
        let mut all = objects.into_par_iter().map(of_object).collect::<anyhow::Result<Vec<_>>>()?;
        all.sort_by(|a, b| b.1.severity().total_cmp(&a.1.severity()));
        context.doubt(refused(all.iter().map(|(object, row, _)| (object, &row.doubts))));
        let text = || answer::of_rates(&all, &site, self.sentence);
        let (objects, rates): (Vec<&ObjectRow>, Vec<&RatesRow>) =
            all.iter().map(|(object, rates, _)| (object, rates)).unzip();
        let columns = [rows::batch_of::<ObjectRow, _>(&objects)?, rows::batch_of::<RatesRow, _>(&rates)?];
        self.finish(&rows::side_by_side(&columns)?, text, context)
    }

    /// Writes the rows, if they go to a file, and returns what to print.
    fn finish(
        &self,
        rows: &RecordBatch,
        text: impl Fn() -> String,
        context: &Context,
    ) -> anyhow::Result<String> {
        let frame = frame::of_batch(rows)?;
        let printed = match self.format {
            Format::Text => text(),
            format => frame::show(&frame, format)?,
        };
        match self.out().map(|out| (file_format(&out), out)) {
            None => {}
            Some((format, out)) => match format? {
                None => {
                    let mut writer = context.create(&out, &rows.schema())?;
                    writer.append(rows)?;
                    context.finish(writer, &printed)?;
                }
                Some(format) => write_file(&out, frame::show(&frame, format)?.as_bytes())?,
            },
        }
        Ok(printed)
    }
}

/// The rows that cannot be right.
fn refused<'a>(rows: impl Iterator<Item = (&'a ObjectRow, &'a Option<String>)>) -> Doubts {
    let refused = rows.filter(|(object, _)| object.p_rad_s.is_none());
    refused.map(|(object, _)| (Doubt::ImplausibleRow, object.structure.clone())).collect()
}

/// How a file is written, by how its name ends; none as Parquet.
fn file_format(out: &Path) -> anyhow::Result<Option<Format>> {
    match out.extension().and_then(|ending| ending.to_str()) {
        Some("parquet") => Ok(None),
        Some(ending @ ("csv" | "json")) => Ok(Some(keyword::parse(ending)?)),
        _ => {
            let out = out.display();
            Err(UsageError::because(format!("out is {out}; expected a name that ends in .parquet, .csv or .json")))
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
