//! evaluate: probabilities at an intensity or at each of a table, and annual rates over the hazard of a site.
//!
//! ```text
//! object       what is predicted for each object of a call, the worst first
//! point        probabilities at a PGA, a PGV or both
//! rates        annual rates at a site
//! fragility    the intensities that half of the motions need, without a motion or over the hazard of a site
//! pages        what pages show of the answers
//! table        probabilities at each intensity of a table
//! words        an object, its model and its warnings in words
//! ```

mod fragility;
mod object;
pub mod pages;
mod point;
mod rates;
mod table;
mod words;

use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{GenericSites, GroundMotion, Hazard, PeakHazard, PgvPgaRatio, Site};
use rockfrag_core::motion::Peaks;
use rockfrag_core::object::{Object, Place, Restitution};
use rockfrag_core::plausibility::{MAGNITUDES, PGV_PGA_OF_SITE_S, STRONGEST_PGA_G, STRONGEST_PGV_M_S};
use rockfrag_core::records::implausibility::rarity;
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::Warning;
use serde::{Deserialize, Serialize};

use self::object::{Predicted, Prediction};
use self::point::TreeRow;
use super::shared::model_args::{ModelArgs, Models};
use super::shared::objects::{StructureArgs, named};
use crate::chart::{DPI, png, svg};
use crate::document::answers::Evaluation;
use crate::document::{Page, fragility as fragilities, workbook};
use crate::inputs::{Rename, Renames, hazard};
use crate::pipeline::context::Context;
use crate::pipeline::options::{Rule, number};
use crate::pipeline::paths::Read;
use crate::pipeline::{Stage, UsageError};
use crate::table::answers::{Answer, FragilityRow, RatesRow};
use crate::table::frame::{self, Format};
use crate::table::rows;

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
    #[arg(long, value_name = "G",
          value_parser = number(0.0..=STRONGEST_PGA_G, "g, up to 4.5, the strongest ever recorded: is it in m/s2?"))]
    pga: Option<f64>,
    /// Peak ground velocity, m/s
    #[arg(long, value_name = "M/S",
          value_parser = number(0.0..=STRONGEST_PGV_M_S, "m/s, up to 5, more than was ever recorded: is it in cm/s?"))]
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
    /// Years represented by the ground-motion fields of --hazard
    #[arg(long, value_name = "YEARS", value_parser = number(1.0..=1e9, "years of 1 and more"))]
    effective_years: Option<f64>,
    /// Moment magnitude of motions without one; at a site the mean of the disaggregation at 2475 years, of
    /// SA(1.0 s) with that curve, else of PGA (not used with PGV alone)
    #[arg(long, value_name = "MW", value_parser = number(MAGNITUDES, "a moment magnitude"))]
    magnitude: Option<f64>,
    /// Vs30 of the site, m/s: narrows the estimate of the peak that is not given
    #[arg(long, value_name = "M/S", value_parser = number(100.0..=2500.0, "Vs30 in m/s, from 100 to 2500"))]
    vs30: Option<f64>,
    /// Column names for headings of --hazard, --structures or --in
    #[arg(long, value_name = "COLUMN=HEADING,...", value_delimiter = ',')]
    columns: Vec<Rename>,
    /// Exposure time, years
    #[arg(long, value_name = "YEARS", default_value = "50", value_parser = number(1e-3..=1e6, "years above 0"))]
    years: f64,
    /// PGV/PGA of all motions, s [default: from the curves, or that of typical sites]
    #[arg(long, value_name = "S",
          value_parser = number(PGV_PGA_OF_SITE_S, "PGV/PGA in s, from 0.01 to 0.5, of PGA in m/s2 and PGV in m/s"))]
    ratio: Option<f64>,
    /// Probability of overturning in --years, such as 1%: find the width of the base that meets it
    #[arg(long, value_name = "P", value_parser = parse_target)]
    target: Option<f64>,
    /// Fragility over pga or pgv: without a motion or hazard [default: pga]; beside a hazard curve, at its
    /// site
    #[arg(long, value_name = "PEAK")]
    over: Option<Peak>,
    /// Continue the hazard curve with its last slope
    #[arg(long)]
    extrapolate: bool,
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
    model: ModelArgs,
    #[command(flatten)]
    #[serde(flatten)]
    structures: StructureArgs,
    #[arg(skip)]
    #[serde(flatten)]
    place: Place,
}

/// Options of a hazard.
const SITE: [&str; 5] = ["hazard", "effective-years", "ratio", "target", "extrapolate"];
const RULES: [Rule; 8] = [
    Rule::Either(&["pga", "pgv"], &SITE),
    Rule::Either(&["in"], &SITE),
    Rule::Either(&["in"], &["pga", "pgv", "vs30"]),
    Rule::Either(&["over"], &["in", "pga", "pgv", "target", "extrapolate"]),
    Rule::Either(&["vs30"], &["ratio", "fits", "suite"]),
    Rule::Needs(&["effective-years", "years", "target", "extrapolate"], &["hazard"]),
    Rule::Needs(&["columns"], &["hazard", "structures", "in"]),
    Rule::Needs(&["period-sd"], &["period", "structure", "structures"]),
];

/// Endings of files of rows and, from the fifth on, of pages and figures.
const ENDINGS: [&str; 7] = ["parquet", "csv", "json", "xlsx", "html", "svg", "png"];

impl Stage for Evaluate {
    fn rules() -> Vec<Rule> {
        [&StructureArgs::RULES[..], &ModelArgs::RULES, &RULES].concat()
    }

    fn inputs(&self) -> Vec<Read> {
        vec![
            Read::new("in", self.input.iter()),
            Read::new("hazard", self.hazard.iter()),
            self.model.input(),
            self.structures.input(),
        ]
    }

    fn outputs(&self) -> Vec<PathBuf> {
        let beside = || Some(self.input.as_ref()?.with_file_name("evaluated.parquet"));
        self.out.as_deref().map(Path::to_path_buf).or_else(beside).into_iter().collect()
    }

    fn endings(&self) -> &[&'static str] {
        // A page or figure is of objects.
        if self.input.is_some() { &ENDINGS[..4] } else { &ENDINGS }
    }

    fn check(&self) -> anyhow::Result<()> {
        if self.pga.or(self.pgv).is_some() {
            self.motion()?;
        }
        self.model.check()
    }

    fn printed(&self, summary: &str) -> anyhow::Result<Option<String>> {
        Ok((self.format == Format::Text).then(|| summary.to_string()))
    }

    fn format(&self) -> Format {
        self.format
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let models = self.model.read()?;
        if let Some(path) = &self.input {
            let mut renames = Renames::new(&self.columns);
            let (rows, text) = table::evaluate(self, path, &mut renames, &models, context)?;
            renames.expect_used()?;
            self.write(&rows, &text, context, || Ok(Page::default()))?;
            self.in_format(&rows, text)
        } else if self.pga.or(self.pgv).is_some() {
            self.under_motion(&self.motion()?, &models, context)
        } else if self.hazard.is_empty() || self.over.is_some() {
            self.over_peak(&models, context)
        } else {
            self.over_hazard(&models, context)
        }
    }
}

impl Evaluate {
    /// The motion that is given.
    fn motion(&self) -> anyhow::Result<GroundMotion> {
        let (pga_m_s2, pgv_m_s) = (self.pga.map(|pga_g| pga_g * G_M_S2), self.pgv);
        match (pga_m_s2, pgv_m_s) {
            (Some(_), Some(_)) if self.vs30.is_some() => {
                return Err(UsageError::because("vs30 only estimates a missing peak; both are given"));
            }
            (Some(pga_m_s2), Some(pgv_m_s)) => {
                Peaks { pga_m_s2, pgv_m_s }.validate().map_err(UsageError::because)?;
            }
            _ => {}
        }
        Ok(GroundMotion { pga_m_s2, pgv_m_s, mw: self.magnitude, vs30_m_s: self.vs30 })
    }

    fn under_motion(
        &self,
        motion: &GroundMotion,
        models: &Models,
        context: &Context,
    ) -> anyhow::Result<String> {
        let rarity = rarity(motion.pga_m_s2, motion.pgv_m_s).map(|rare| rare.to_string());
        context.warn(rarity.map(|rare| (Warning::ImplausibleRecord, rare)).into_iter().collect());
        let objects = self.objects(Renames::new(&self.columns), models, context)?;
        let all = object::answers(&objects, models, context, |_, rocking_object| {
            let (row, budget) = TreeRow::new(motion, rocking_object);
            let motion = motion.peaks(&rocking_object.directions[0].model);
            Prediction { row, budget, motion, warnings: Vec::new() }
        })?;
        let text = point::text(&all, self.out.as_deref());
        self.finish(&all, text, context, || Ok(pages::page(&pages::under_motion(&all))))
    }

    /// The fragility over one peak, of motions in general or at the site of a hazard curve.
    fn over_peak(&self, models: &Models, context: &Context) -> anyhow::Result<String> {
        models.expect_ground()?;
        let over = self.over.unwrap_or(Peak::Pga);
        let mut renames = Renames::new(&self.columns);
        let site = if self.hazard.is_empty() { None } else { Some(self.site(&mut renames, context)?) };
        match site.as_ref().map(|site| &site.hazard) {
            None => {}
            Some(Hazard::Curve(curve)) if curve.peak == over => {}
            Some(_) => {
                let problem = format!("over {over}: expected a hazard curve of {over}, of no other peak");
                return Err(UsageError::because(problem));
            }
        }
        let objects = self.objects(renames, models, context)?;
        let general = GenericSites { over, mw: self.magnitude, vs30_m_s: self.vs30, ratio_s: self.ratio };
        let all = object::answers(&objects, models, context, |_, rocking_object| {
            let at_site = site.as_ref().and_then(|site| site.fragility(rocking_object));
            let fragility = at_site.unwrap_or_else(|| general.fragility(rocking_object));
            let (budget, motion) = (fragility.budget, fragility.motion);
            Prediction { row: FragilityRow::new(fragility), budget, motion, warnings: Vec::new() }
        })?;
        let text = fragility::text(&all, self.out.as_deref());
        let answers = [answer_rows(&all, context)?];
        let page = || {
            let outline = pages::portrait(&objects, models, None, self.years)?.outline;
            let hazard = site.as_ref().and_then(|_| context.plan.made.names("hazard"));
            Ok(fragilities::page(&all, outline, hazard.as_deref()))
        };
        self.write(&[rows::batch(&fragility::curves(&all))?], &text, context, page)?;
        self.in_format(&answers, text)
    }

    fn over_hazard(&self, models: &Models, context: &Context) -> anyhow::Result<String> {
        models.expect_ground()?;
        let mut renames = Renames::new(&self.columns);
        let site = self.site(&mut renames, context)?;
        let objects = self.objects(renames, models, context)?;
        let all = object::answers(&objects, models, context, |object, rocking_object| {
            let rates = site.rates(rocking_object);
            let target = self.target.map(|p| -(-p).ln_1p() / self.years);
            let with_models = |object: &Object| Some(models.rocking_object(object).ok()?.0);
            let bases =
                target.map(|target| site.bases(object, &with_models, rates.states.overturning, target));
            let row = RatesRow::new(&rates, self.years, bases.unwrap_or_default());
            Prediction { row, budget: rates.budget, motion: rates.motion, warnings: rates.warnings }
        })?;
        let page = || {
            let portrait = pages::portrait(&objects, models, Some(&site), self.years)?;
            Ok(pages::page(&Evaluation { portrait, ..pages::over_hazard(all.clone(), &context.plan.made) }))
        };
        let text = rates::text(&all, &site, self.target, self.out.as_deref());
        self.finish(&all, text, context, page)
    }

    /// Reads the hazard and what rates over it need.
    fn site(&self, renames: &mut Renames, context: &Context) -> anyhow::Result<Site> {
        let (mut hazard, unused) = hazard::read(&self.hazard, renames, self.effective_years)?;
        context.warn(unused);
        match &mut hazard {
            Hazard::Curve(PeakHazard { pgv_pga: pgv_pga @ None, .. }) => {
                *pgv_pga = self.ratio.map(PgvPgaRatio::given);
            }
            _ if self.ratio.or(self.vs30).is_some() => {
                return Err(UsageError::because("ratio, vs30: the hazard itself gives PGV/PGA"));
            }
            Hazard::Joint(_) if self.extrapolate => {
                return Err(UsageError::because("extrapolate: expected a hazard curve of one peak"));
            }
            _ => {}
        }
        Ok(Site { hazard, mw: self.magnitude, vs30_m_s: self.vs30, extrapolate: self.extrapolate })
    }

    /// Returns the given structures, or all fitted ones.
    fn objects(
        &self,
        mut renames: Renames,
        models: &Models,
        context: &Context,
    ) -> anyhow::Result<Vec<Object>> {
        let place = self.place;
        if !self.structures.is_given() && self.model.fits.is_some() {
            renames.expect_used()?;
            let fitted = models.structures()?.into_iter();
            return Ok(fitted
                .map(|structure| {
                    Object::with_parameters(&structure, Restitution::Fitted(structure.eta)).at(&place)
                })
                .collect());
        }
        let (objects, unused) = self.structures.objects(&place, &mut renames)?;
        renames.expect_used()?;
        context.warn(unused);
        if let Some(reason) = objects.first().and_then(|first| first.sides().err()) {
            let reason = named(&objects[0], &reason);
            match &self.structures.structures {
                _ if !objects.iter().all(Object::is_implausible) => {}
                Some(path) => {
                    anyhow::bail!("{}: {reason}; every other row has a fault too", path.display())
                }
                None => return Err(reason),
            }
        }
        Ok(objects)
    }

    /// Writes and prints the answers for all objects.
    fn finish<R: Predicted>(
        &self,
        all: &[Answer<R>],
        text: String,
        context: &Context,
        page: impl Fn() -> anyhow::Result<Page>,
    ) -> anyhow::Result<String> {
        let rows = [answer_rows(all, context)?];
        self.write(&rows, &text, context, page)?;
        self.in_format(&rows, text)
    }

    /// Returns a text, or rows of one schema in the form that is asked for.
    fn in_format(&self, rows: &[RecordBatch], text: String) -> anyhow::Result<String> {
        if self.format == Format::Text { Ok(text) } else { shown(rows, self.format) }
    }

    /// Writes rows of one schema, or a page or the main figure of them, by how the name of the file ends.
    fn write(
        &self,
        rows: &[RecordBatch],
        text: &str,
        context: &Context,
        page: impl Fn() -> anyhow::Result<Page>,
    ) -> anyhow::Result<()> {
        for out in self.outputs() {
            let ending = out.extension().unwrap_or_default().to_string_lossy();
            if ending == "parquet" {
                let mut writer = context.create(&out, &rows[0].schema())?;
                rows.iter().try_for_each(|rows| writer.append(rows))?;
                context.finish(writer, text)?;
                continue;
            }
            let drawn = || Ok::<_, anyhow::Error>(svg(&page()?.main_figure()));
            let content = match &*ending {
                "csv" => shown(rows, Format::Csv)?.into_bytes(),
                "json" => shown(rows, Format::Json)?.into_bytes(),
                "xlsx" => workbook(rows)?,
                "html" => page()?.html().into_bytes(),
                "svg" => drawn()?.into_bytes(),
                _ => png(&drawn()?, DPI)?,
            };
            context.write_file(&out, &content)?;
        }
        Ok(())
    }
}

/// Parses a probability of overturning in the time of exposure, such as 1%.
fn parse_target(text: &str) -> Result<f64, String> {
    match text.strip_suffix('%').map(|percent| percent.trim_end().parse::<f64>()) {
        Some(Ok(percent)) if percent > 0.0 && percent < 100.0 => Ok(0.01 * percent),
        _ => Err("expected a probability in --years with its percent sign, such as 1%".to_string()),
    }
}

/// Gathers the rows of answers, and warns of what their text does not state.
fn answer_rows<R: Predicted>(all: &[Answer<R>], context: &Context) -> anyhow::Result<RecordBatch> {
    for answer in all {
        // The text states them, or a warning of the file that is read.
        let told = [Warning::HazardEndsEarly, Warning::HazardExtrapolated, Warning::MedianHazard];
        let others = answer.warnings.iter().filter(|warning| !told.contains(warning));
        context.warn(others.map(|warning| (*warning, answer.object.structure.clone())).collect());
    }
    rows::side_by_side(&[
        rows::batch(all.iter().map(|answer| &answer.object))?,
        rows::batch(all.iter().map(|answer| &answer.row))?,
        rows::batch(all.iter().map(|answer| &answer.doubts))?,
    ])
}

/// Shows rows of one schema.
fn shown(rows: &[RecordBatch], format: Format) -> anyhow::Result<String> {
    let mut whole = frame::from_batch(&rows[0])?;
    for more in &rows[1..] {
        whole.vstack_mut(&frame::from_batch(more)?)?;
    }
    frame::show(&whole, format)
}
