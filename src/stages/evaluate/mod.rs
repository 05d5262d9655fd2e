//! evaluate: answers for objects under a motion, at the site of a hazard or over a peak, and probabilities at
//! each intensity of a table.

mod table;

use std::path::{Path, PathBuf};

use anyhow::{bail, ensure};
use arrow_array::RecordBatch;
use clap::Args;
use clap::ValueHint::FilePath;
use polars_core::prelude::DataFrame;
use rayon::prelude::*;
use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{GenericSites, GroundMotion, Hazard, Site};
use rockfrag_core::motion::Peaks;
use rockfrag_core::object::{Object, Place, Restitution};
use rockfrag_core::plausibility::{
    GIVEN_MAGNITUDE, GIVEN_PGA_G, GIVEN_PGV_M_S, GIVEN_RATIO_S, GIVEN_VS30_M_S, GIVEN_YEARS,
};
use rockfrag_core::records::implausibility::rarity;
use rockfrag_core::rocking::Structure;
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::Warning;
use serde::{Deserialize, Serialize};

use super::shared::model_args::{ModelArgs, Models};
use super::shared::objects::{StructureArgs, named};
use crate::answer::{self, Answer, AnswerTable, Detail, Question, assess, variants_beside};
use crate::chart::{DPI, png, svg};
use crate::document::{Document, PageArgs, sheet, workbook};
use crate::inputs::{Reader, hazard};
use crate::pipeline::context::Context;
use crate::pipeline::options::{given, number};
use crate::pipeline::paths::{Files, Read};
use crate::pipeline::{Stage, UsageError};
use crate::table::frame::{self, Format};

/// Predict the probability of rocking and overturning: under one motion, under each motion of a table, or
/// per year at a site
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag evaluate --width 0.5 --height 2.0\n\
    rockfrag evaluate --width 0.5 --height 2.0 --pga 0.5 --pgv 0.6\n\
    rockfrag evaluate --width 0.5 --height 2.0 --depth 0.4 --hazard pga.csv,sa.csv\n\
    rockfrag evaluate --structures objects.csv --hazard pga.csv --out objects.parquet\n\
    rockfrag evaluate --width 0.5 --height 2.0 --period 0.6 --level 0.5 --hazard pga.csv")]
pub struct Evaluate {
    /// Peak ground acceleration, g
    #[arg(long, value_name = "G", value_parser = given(GIVEN_PGA_G))]
    pga: Option<f64>,
    /// Peak ground velocity, m/s
    #[arg(long, value_name = "M/S", value_parser = given(GIVEN_PGV_M_S))]
    pgv: Option<f64>,
    /// Table of PGA and PGV (pga_m_s2 or pga_g, pgv_m_s), Parquet or CSV, with p_rad_s, alpha_rad and
    /// eta where they vary
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = FilePath)]
    #[serde(rename = "in")]
    input: Option<PathBuf>,
    /// Hazard curves, CSV: PGA, best with PGV or SA(1.0 s), by annual rates, probabilities or return periods;
    /// or PGA and PGV together, by rates of occurrence or as OpenQuake's ground-motion fields
    #[arg(long, value_name = "FILE,...", value_hint = FilePath)]
    hazard: Vec<PathBuf>,
    /// Moment magnitude of motions without one [default: inferred from PGV/PGA, else that of motions that
    /// overturn]; at a site the mean of the disaggregation at 2475 years, of SA(1.0 s) with that curve, else of
    /// PGA (not used with PGV alone)
    #[arg(long, value_name = "MW", value_parser = given(GIVEN_MAGNITUDE))]
    magnitude: Option<f64>,
    /// Vs30 of the site, m/s: narrows the estimate of the peak that is not given
    #[arg(long, value_name = "M/S", value_parser = given(GIVEN_VS30_M_S))]
    vs30: Option<f64>,
    /// Years represented by ground-motion fields
    #[arg(long, value_name = "YEARS", value_parser = number(1.0..=1e9, "years of 1 and more"))]
    effective_years: Option<f64>,
    /// Exposure time, years
    #[arg(long, value_name = "YEARS", default_value = "50", value_parser = given(GIVEN_YEARS))]
    years: f64,
    /// PGV/PGA of all motions, s [default: from the curves, or that of typical sites]
    #[arg(long, value_name = "S", value_parser = given(GIVEN_RATIO_S))]
    ratio: Option<f64>,
    /// Probability of overturning in --years, such as 1%: find the width of the base that meets it
    #[arg(long, value_name = "P", value_parser = parse_target)]
    target: Option<f64>,
    /// Fragility over pga or pgv alone: without a motion or hazard [default: over both]; beside a hazard
    /// curve, at its site
    #[arg(long, value_name = "PEAK")]
    over: Option<Peak>,
    /// What would change the object, or the worst ten: printed, and beside a Parquet file NAME.variants.parquet
    #[arg(long)]
    variants: bool,
    /// text, csv or json
    #[arg(long, default_value = "text")]
    #[serde(skip_serializing)]
    format: Format,
    /// File to write: .parquet, .csv, .json, .xlsx, a page (.html) or its main figure (.svg, .png) [default:
    /// none; with --in, evaluated.parquet beside it]
    #[arg(long, value_name = "FILE", value_hint = FilePath)]
    out: Option<PathBuf>,
    #[command(flatten)]
    #[serde(flatten)]
    signed: PageArgs,
    #[command(flatten)]
    #[serde(flatten)]
    model: ModelArgs,
    #[command(flatten)]
    #[serde(flatten)]
    structures: StructureArgs,
    #[arg(skip)]
    #[serde(flatten)]
    place: Place,
}

/// Endings of files of rows and, from the fifth on, of pages and figures.
const ENDINGS: [&str; 7] = ["parquet", "csv", "json", "xlsx", "html", "svg", "png"];

impl Stage for Evaluate {
    fn files(&self) -> Files {
        let (table, hazard) = (Read::new("in", &self.input), Read::new("hazard", &self.hazard));
        let read = vec![table, hazard, self.model.input(), self.structures.input()];
        let beside = || Some(self.input.as_ref()?.with_file_name("evaluated.parquet"));
        let out = self.out.clone().or_else(beside);
        let is_table = |out: &&PathBuf| self.variants && ending(out) == "parquet";
        let variants = out.as_ref().filter(is_table).map(|out| variants_beside(out));
        // A page or figure is of objects.
        let endings = if self.input.is_some() { &ENDINGS[..4] } else { &ENDINGS };
        Files { read, written: variants.into_iter().chain(out).collect(), endings }
    }

    fn check(&self) -> anyhow::Result<()> {
        if self.pga.or(self.pgv).is_some() { self.motion().map(drop) } else { Ok(()) }
    }

    fn format(&self) -> Format {
        self.format
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let (models, mut reader) = (self.model.read()?, self.structures.list.reader());
        if let Some(path) = &self.input {
            let (rows, text) = table::evaluate(self, path, &mut reader, &models, context)?;
            reader.expect_used()?;
            context.tell(reader.warnings, reader.readings);
            self.write(&rows, None, &text, context, &Document::default())?;
            return self.in_format(&rows, text);
        }
        let question = self.question(&mut reader, &models)?;
        let objects = self.objects(&mut reader, &models)?;
        context.tell(reader.warnings, reader.readings);
        let models_of = |object: &Object| models.rocking_object(object);
        let rows = assess(&objects, &question, &models_of, &context.bar(objects.len()))?;
        // The text states these, or a warning of the file that is read.
        let told = [Warning::HazardEndsEarly, Warning::MedianHazard];
        let warned = answer::over_all(&rows).flat_map(|answer| {
            let warnings = answer.uncertainty.warnings().into_iter();
            warnings.map(|warning| (warning, answer.object.structure.clone()))
        });
        context.warn(warned.filter(|(warning, _)| !told.contains(warning)).collect());
        let all = answer::table(&rows, &question)?;
        let mut table = AnswerTable { rows, made: vec![context.made("")], ..AnswerTable::default() };
        if let Question::Hazard { site, years, .. } = &question {
            let is_page = self.out.as_ref().is_some_and(|out| ENDINGS[4..].contains(&&*ending(out)));
            let most = if self.variants || is_page { WORST } else { 0 };
            let mut worst: Vec<(&Answer, &Object)> = table.rows.iter().zip(&objects).collect();
            worst.sort_by(|(a, _), (b, _)| b.severity().total_cmp(&a.severity()));
            worst.truncate(most);
            let details = worst.par_iter().map(|(_, object)| Detail::new(object, site, *years, &models_of));
            table.details = details.filter(|detail| !detail.variants.is_empty()).collect();
            table.hazard = Some(site.hazard.clone());
        }
        let document = Document::of_answers(&table).signed(&self.signed);
        let text = document.text(self.out.as_deref());
        if let [beside, _] = &context.plan.outputs[..] {
            let variants: Vec<Answer> = table.details.iter().flat_map(|of| of.variants.clone()).collect();
            context.write_batches(beside, &[answer::variant_table(&variants, &question)?], &text)?;
        }
        let (rows, sheet) = match question {
            Question::Curve { .. } => (answer::points(&table.rows)?, None),
            _ => (all.clone(), Some(sheet(&table.rows)?)),
        };
        self.write(&[rows], sheet.as_ref(), &text, context, &document)?;
        match sheet {
            Some(sheet) if self.format == Format::Csv => frame::show(&sheet, Format::Csv),
            _ => self.in_format(&[all], text),
        }
    }
}

/// The most objects of which more is told.
const WORST: usize = 10;

impl Evaluate {
    fn motion(&self) -> anyhow::Result<GroundMotion> {
        let (pga_m_s2, pgv_m_s) = (self.pga.map(|pga_g| pga_g * G_M_S2), self.pgv);
        if let (Some(pga_m_s2), Some(pgv_m_s)) = (pga_m_s2, pgv_m_s) {
            let problem = "vs30 only estimates a missing peak; both are given";
            ensure!(self.vs30.is_none(), UsageError::because(problem));
            Peaks { pga_m_s2, pgv_m_s }.validate().map_err(UsageError::because)?;
        }
        Ok(GroundMotion { pga_m_s2, pgv_m_s, mw: self.magnitude, vs30_m_s: self.vs30 })
    }

    fn question(&self, reader: &mut Reader, models: &Models) -> anyhow::Result<Question> {
        if self.pga.or(self.pgv).is_some() {
            let motion = self.motion()?;
            if let Some(rare) = rarity(motion.pga_m_s2, motion.pgv_m_s) {
                reader.warnings.add(Warning::ImplausibleRecord, rare.to_string());
            }
            return Ok(Question::Motion(motion));
        }
        models.expect_ground()?;
        let site = (!self.hazard.is_empty()).then(|| self.site(reader)).transpose()?;
        let over = self.over.unwrap_or(Peak::Pgv);
        let general = GenericSites { over, mw: self.magnitude, vs30_m_s: self.vs30, ratio_s: self.ratio };
        match site {
            Some(site) if self.over.is_none() => {
                Ok(Question::Hazard { site, years: self.years, target: self.target })
            }
            Some(site) if !matches!(&site.hazard, Hazard::Curve(hazard) if hazard.peak == over) => {
                let problem = format!("over {over}: expected a hazard curve of {over}, of no other peak");
                Err(UsageError::because(problem))
            }
            site => Ok(Question::Curve { general, site, beside: self.over.is_none().then_some(Peak::Pga) }),
        }
    }

    /// Reads the hazard and what rates over it need.
    fn site(&self, reader: &mut Reader) -> anyhow::Result<Site> {
        let hazard = hazard::read(&self.hazard, reader, self.effective_years)?;
        Site::about(hazard, self.magnitude, self.vs30, self.ratio).map_err(UsageError::because)
    }

    /// Returns the given structures, or all fitted ones.
    fn objects(&self, reader: &mut Reader, models: &Models) -> anyhow::Result<Vec<Object>> {
        if !self.structures.is_given() && self.model.fits.is_some() {
            reader.expect_used()?;
            let object = |of: &Structure| Object::with_parameters(of, Restitution::Fitted(of.eta));
            return Ok(models.structures()?.iter().map(|of| object(of).at(&self.place)).collect());
        }
        let objects = self.structures.objects(&self.place, reader)?;
        reader.expect_used()?;
        let first = objects.first().filter(|_| objects.iter().all(Object::is_implausible));
        match (first.and_then(|first| Some(named(first, &first.sides().err()?))), &self.structures.structures)
        {
            (Some(why), Some(path)) => bail!("{}: {why}; every other row has a fault too", path.display()),
            (Some(why), None) => Err(why),
            _ => Ok(objects),
        }
    }

    /// Returns a text, or rows of one schema in the form that is asked for.
    fn in_format(&self, rows: &[RecordBatch], text: String) -> anyhow::Result<String> {
        if self.format == Format::Text { Ok(text) } else { frame::show(&framed(rows)?, self.format) }
    }

    /// Writes rows, the sheet, a page or its main figure, by how the name of the file ends.
    fn write(
        &self,
        rows: &[RecordBatch],
        sheet: Option<&DataFrame>,
        text: &str,
        context: &Context,
        document: &Document,
    ) -> anyhow::Result<()> {
        let Some(out) = context.plan.outputs.last() else { return Ok(()) };
        let sheet = || sheet.map_or_else(|| framed(rows), |sheet| Ok(sheet.clone()));
        let content = match &*ending(out) {
            "parquet" => return context.write_batches(out, rows, text),
            "csv" => frame::show(&sheet()?, Format::Csv)?.into_bytes(),
            "json" => frame::show(&framed(rows)?, Format::Json)?.into_bytes(),
            "xlsx" => workbook(&sheet()?)?,
            "html" => document.html()?.into_bytes(),
            "svg" => svg(&document.main_figure()?).into_bytes(),
            _ => png(&svg(&document.main_figure()?), DPI)?,
        };
        context.write_file(out, &content)
    }
}

fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().into_owned()
}

/// Parses a probability of overturning in the time of exposure, such as 1%.
fn parse_target(text: &str) -> Result<f64, String> {
    match text.strip_suffix('%').map(|percent| percent.trim_end().parse::<f64>()) {
        Some(Ok(percent)) if percent > 0.0 && percent < 100.0 => Ok(0.01 * percent),
        _ => Err("expected a probability in --years with its percent sign, such as 1%".to_string()),
    }
}

fn framed(rows: &[RecordBatch]) -> anyhow::Result<DataFrame> {
    let mut whole = DataFrame::default();
    for rows in rows {
        whole.vstack_mut_owned(frame::from_batch(rows)?)?;
    }
    Ok(whole)
}
