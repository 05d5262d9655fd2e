//! evaluate: probabilities at an intensity or at each of a table, and annual rates over the hazard of a site.
//!
//! ```text
//! object       what is predicted for each object of a call, the worst first
//! point        probabilities at a PGA, a PGV or both
//! rates        annual rates at a site
//! fragility    the intensities that half of the motions need, without a motion or over the hazard of a site
//! target       the width of a base that meets a target
//! pages        what pages and figures show of the answers
//! table        probabilities at each intensity of a table
//! words        an object, its model and its warnings in words
//! explain      the model and the measures behind an answer
//! ```

mod explain;
mod fragility;
mod object;
pub mod pages;
mod point;
mod rates;
mod table;
mod target;
mod words;

use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use clap::{ArgGroup, Args};
use serde::Serialize;

use super::shared::model_args::{ModelArgs, Models};
use super::shared::objects::{PlaceArgs, StructureArgs, named};
use super::shared::responses;
use crate::fragility::Peak;
use crate::hazard::{Hazard, Motion, PeakHazard, PgvPgaRatio, Site, SitesInGeneral};
use crate::inputs::{Rename, Renames, hazard};
use crate::keyword::Keyword;
use crate::object::{Object, Restitution, Subject};
use crate::pipeline::context::Context;
use crate::pipeline::options::{listed, number};
use crate::pipeline::paths::{AnswersOutput, Input, Read, RowsInput, SheetInput, split_lists};
use crate::pipeline::{InRun, Stage, UsageError};
use crate::plausibility::{MAGNITUDES, PGV_PGA_OF_SITE_S, STRONGEST_PGA_G, STRONGEST_PGV_M_S, judge_peaks};
use crate::records::implausibility::rarity;
use crate::report::rated::Evaluation;
use crate::report::{DPI, Page, made_in_words, png, svg, workbook};
use crate::table::frame::{self, Format};
use crate::table::rows;
use crate::units::G_M_S2;
use crate::warning::{UNNAMED, Warning, Warnings};

use self::fragility::FragilityRow;
pub use self::object::{Answer, DoubtsRow, ObjectRow, Predicted};
pub use self::point::TreeRow;
pub use self::rates::{RatesRow, expected_number};
pub use self::words::{model_of_all, size, too_far};

/// Predict the probability of rocking and overturning: under one motion, under each motion of a table, or
/// per year at a site
#[derive(Debug, Args, Serialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag evaluate --width 0.5 --height 2.0\n\
    rockfrag evaluate --width 0.5 --height 2.0 --pga 0.5 --pgv 0.6\n\
    rockfrag evaluate --width 0.5 --height 2.0 --depth 0.4 --hazard pga.csv,sa.csv\n\
    rockfrag evaluate --structures objects.csv --hazard pga.csv --out objects.parquet\n\
    rockfrag evaluate --width 0.5 --height 2.0 --period 0.6 --level 0.5 --hazard pga.csv")]
#[command(group(ArgGroup::new("site").multiple(true)))]
pub struct Evaluate {
    /// Peak ground acceleration, g
    #[arg(long, value_name = "G", conflicts_with_all = ["in", "site"], allow_negative_numbers = true,
          value_parser = number(0.0..=STRONGEST_PGA_G, "g, up to 4.5, the strongest ever recorded: is it in m/s2?"))]
    pga: Option<f64>,
    /// Peak ground velocity, m/s
    #[arg(long, value_name = "M/S", conflicts_with_all = ["in", "site"], allow_negative_numbers = true,
          value_parser = number(0.0..=STRONGEST_PGV_M_S, "m/s, up to 5, more than was ever recorded: is it in cm/s?"))]
    pgv: Option<f64>,
    /// Table of PGA and PGV (pga_m_s2 or pga_g, pgv_m_s), Parquet or CSV, with p_rad_s, alpha_rad and
    /// eta where they vary
    #[arg(long = "in", id = "in", value_name = "FILE", conflicts_with = "site")]
    input: Option<RowsInput>,
    /// Hazard curves, CSV: PGA, best with PGV or SA(1.0 s), by annual rates, probabilities or return periods;
    /// or PGA and PGV together, by rates of occurrence or as OpenQuake's ground-motion fields
    #[arg(long, value_name = "FILE,...", group = "site")]
    hazard: Vec<SheetInput>,
    /// Years represented by the ground-motion fields of --hazard
    #[arg(long, value_name = "YEARS", requires = "hazard", group = "site", value_parser = number(1.0..=1e9, "years of 1 and more"))]
    effective_years: Option<f64>,
    /// Moment magnitude of motions without one; at a site the mean of the disaggregation at 2475 years, of
    /// SA(1.0 s) with that curve, else of PGA (not used with PGV alone)
    #[arg(long, value_name = "MW", value_parser = number(MAGNITUDES, "a moment magnitude"))]
    magnitude: Option<f64>,
    /// Vs30 of the site, m/s: narrows the estimate of the peak that is not given
    #[arg(long, value_name = "M/S", conflicts_with_all = ["in", "ratio", "fits", "suite"],
          value_parser = number(100.0..=2500.0, "Vs30 in m/s, from 100 to 2500"))]
    vs30: Option<f64>,
    /// Column names for headings of --hazard, --structures or --in
    #[arg(long, value_name = "COLUMN=HEADING,...", value_delimiter = ',')]
    columns: Vec<Rename>,
    /// Exposure time, years
    #[arg(long, value_name = "YEARS", default_value = "50", requires = "hazard",
          value_parser = number(1e-3..=1e6, "years above 0"))]
    years: f64,
    /// PGV/PGA of all motions, s [default: from the curves, or that of typical sites]
    #[arg(long, value_name = "S", group = "site",
          value_parser = number(PGV_PGA_OF_SITE_S, "PGV/PGA in s, from 0.01 to 0.5, of PGA in m/s2 and PGV in m/s"))]
    ratio: Option<f64>,
    /// Probability of overturning in --years, such as 1%: find the width of the base that meets it
    #[arg(long, value_name = "P", requires = "hazard", group = "site", value_parser = target::parse)]
    target: Option<f64>,
    /// Fragility over pga or pgv: without a motion or hazard [default: pga]; beside a hazard curve, at its
    /// site
    #[arg(long, value_name = "PEAK", conflicts_with_all = ["in", "pga", "pgv", "target", "responses", "extrapolate"])]
    over: Option<Peak>,
    /// Responses to count overturning in, beside the rate
    #[arg(long, value_name = "FILE", requires = "hazard", group = "site")]
    responses: Option<Input>,
    /// Continue the hazard curve with its last slope
    #[arg(long, requires = "hazard", group = "site")]
    extrapolate: bool,
    /// Also print model, measures and other predictions
    #[arg(long)]
    explain: bool,
    /// text, csv or json
    #[arg(long, default_value = "text")]
    format: Format,
    /// File to write: .parquet, .csv, .json, .xlsx, a page (.html) or its main figure (.svg, .png) [default:
    /// none; with --in, evaluated.parquet beside it]
    #[arg(long, value_name = "FILE")]
    out: Option<AnswersOutput>,
    #[command(flatten)]
    #[serde(flatten)]
    model: ModelArgs,
    #[command(flatten)]
    #[serde(flatten)]
    structures: StructureArgs,
    #[command(flatten)]
    #[serde(flatten)]
    place: PlaceArgs,
}

impl Stage for Evaluate {
    fn is_answer(&self) -> bool {
        true
    }

    fn in_run(run: &InRun) -> Vec<(&'static str, &'static str)> {
        let counts = run.has("simulate") && run.section.contains_key("hazard");
        let responses = counts.then_some(("responses", "responses.parquet"));
        let own = responses.into_iter().chain([("out", "evaluated.parquet")]);
        own.chain(ModelArgs::in_run(run)).collect()
    }

    fn inputs(&self) -> Vec<Read> {
        vec![
            Read::new("in", self.input.iter().map(|path| &**path)),
            Read::new("hazard", split_lists(&self.hazard)),
            Read::new("responses", self.responses.iter().map(|path| &**path)),
            self.model.input(),
            self.structures.input(),
        ]
    }

    fn outputs(&self) -> Vec<PathBuf> {
        let beside = || Some(self.input.as_ref()?.with_file_name("evaluated.parquet"));
        self.out.as_deref().map(Path::to_path_buf).or_else(beside).into_iter().collect()
    }

    fn check(&self) -> anyhow::Result<()> {
        self.out.as_deref().map(file_format).transpose()?;
        if self.pga.or(self.pgv).is_some() {
            self.motion()?;
        }
        Ok(())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let models = self.model.read()?;
        if let Some(path) = &self.input {
            let mut renames = Renames::new(&self.columns);
            let call = table::Call {
                structures: &self.structures,
                place: &self.place.place(),
                models: &models,
                magnitude: self.magnitude,
            };
            let (rows, text) = table::evaluate(path, &mut renames, &call, context)?;
            renames.expect_used()?;
            let printed = self.printed(&rows, text)?;
            self.write(&rows, printed, context, || {
                let problem =
                    "out: a page or figure is of objects at a site or under a motion, not of a table";
                Err(UsageError::because(problem))
            })
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
    fn motion(&self) -> anyhow::Result<Motion> {
        let (pga_m_s2, pgv_m_s) = (self.pga.map(|pga_g| pga_g * G_M_S2), self.pgv);
        match (pga_m_s2, pgv_m_s) {
            (Some(_), Some(_)) if self.vs30.is_some() => {
                return Err(UsageError::because("vs30 only estimates a missing peak; both are given"));
            }
            (Some(pga), Some(pgv)) => judge_peaks(pga, pgv).map_err(UsageError::because)?,
            _ => {}
        }
        Ok(Motion { pga_m_s2, pgv_m_s, mw: self.magnitude, vs30_m_s: self.vs30 })
    }

    fn under_motion(&self, motion: &Motion, models: &Models, context: &Context) -> anyhow::Result<String> {
        let rarity = rarity(motion.pga_m_s2, motion.pgv_m_s).map(|rare| rare.to_string());
        context.warn(rarity.map(|rare| (Warning::ImplausibleRecord, rare)).into_iter().collect());
        let predict = |_: &Object, subject: &Subject| {
            let (row, budget) = TreeRow::new(motion, subject);
            (row, budget, motion.peaks(&subject.directions[0].model), Vec::new())
        };
        let mut renames = Renames::new(&self.columns);
        let objects = self.objects(&mut renames, models, context)?;
        renames.expect_used()?;
        let bar = context.bar(objects.len());
        let all = object::answers(objects, models, self.explain, &bar, predict)?;
        let text = point::text(&all, self.out.as_deref());
        self.finish(&all, text, context, || Ok(pages::under_motion(&all)))
    }

    /// The fragility over one peak, of motions in general or at the site of a hazard curve.
    fn over_peak(&self, models: &Models, context: &Context) -> anyhow::Result<String> {
        models.expect_ground()?;
        let over = self.over.unwrap_or(Peak::Pga);
        let mut renames = Renames::new(&self.columns);
        let site = if self.hazard.is_empty() { None } else { Some(self.site(&mut renames, context)?) };
        let is_over = |site: &Site| matches!(&site.hazard, Hazard::Curve(curve) if curve.peak == over);
        if site.as_ref().is_some_and(|site| !is_over(site)) {
            let over = over.as_str();
            return Err(UsageError::because(format!(
                "over {over}: expected a hazard curve of {over}, of no other peak"
            )));
        }
        let objects = self.objects(&mut renames, models, context)?;
        renames.expect_used()?;
        if self.out.as_deref().map(file_format).transpose()? == Some(FileFormat::Page) {
            return Err(UsageError::because("out: a page is of a site or a motion; expected .svg or .png"));
        }
        let general = SitesInGeneral { over, mw: self.magnitude, vs30_m_s: self.vs30, ratio_s: self.ratio };
        let predict = |_: &Object, subject: &Subject| {
            let at_site = site.as_ref().and_then(|site| site.fragility(subject));
            let fragility = at_site.unwrap_or_else(|| general.fragility(subject));
            let (errors, motion) = (fragility.errors, fragility.motion);
            (FragilityRow::new(fragility), errors, motion, Vec::new())
        };
        let (first, bar) = (objects[0].clone(), context.bar(objects.len()));
        let all = object::answers(objects, models, self.explain, &bar, predict)?;
        let text = fragility::text(&all, self.out.as_deref());
        let printed = self.printed(&[answer_rows(&all, context)?], text)?;
        let picture = || pages::of_fragility(&all, &first, models);
        self.write(&[rows::batch(&fragility::curves(&all))?], printed, context, picture)
    }

    fn over_hazard(&self, models: &Models, context: &Context) -> anyhow::Result<String> {
        models.expect_ground()?;
        let mut renames = Renames::new(&self.columns);
        let site = self.site(&mut renames, context)?;
        let objects = self.objects(&mut renames, models, context)?;
        renames.expect_used()?;
        let predict = |object: &Object, subject: &Subject| {
            let rates = site.rates(subject);
            let target = self.target.map(|p| -(-p).ln_1p() / self.years).zip(rates.overturning);
            let bases = target.map(|(target, rate)| target::bases(object, models, &site, rate, target));
            let row = RatesRow::new(&rates, self.years, bases.unwrap_or_default());
            (row, rates.errors, rates.motion, rates.warnings)
        };
        let alone = if let [one] = &objects[..] { Some(one.clone()) } else { None };
        let bar = context.bar(objects.len());
        let all = object::answers(objects, models, self.explain, &bar, predict)?;
        if let Some(path) = &self.responses {
            context.warn(expect_counted(&all, &site, path)?);
        }
        let picture = || {
            let mut evaluation = pages::over_hazard(&all, context.made());
            evaluation.target = self.target;
            if let Some(object) = alone.as_ref().filter(|object| object.sides().is_ok()) {
                evaluation.portrait = pages::portrait(object, models, &site, self.years)?;
            }
            Ok(evaluation)
        };
        let text = rates::text(&all, &site, self.target, self.out.as_deref());
        self.finish(&all, text, context, picture)
    }

    /// Reads the hazard and what rates over it need.
    fn site(&self, renames: &mut Renames, context: &Context) -> anyhow::Result<Site> {
        let (mut hazard, unused) = hazard::read(&split_lists(&self.hazard), renames, self.effective_years)?;
        context.warn(unused);
        match &mut hazard {
            Hazard::Curve(PeakHazard { velocity: velocity @ None, .. }) => {
                *velocity = self.ratio.map(PgvPgaRatio::given);
            }
            _ if self.ratio.or(self.vs30).is_some() => {
                return Err(UsageError::because("ratio, vs30: the hazard itself gives PGV/PGA"));
            }
            Hazard::Joint(_) if self.extrapolate || self.responses.is_some() => {
                let option = if self.extrapolate { "extrapolate" } else { "responses" };
                return Err(UsageError::because(format!("{option}: expected a hazard curve of one peak")));
            }
            _ => {}
        }
        Ok(Site {
            hazard,
            mw: self.magnitude,
            vs30_m_s: self.vs30,
            extrapolate: self.extrapolate,
            responses: self.responses.as_deref().map_or(Ok(Vec::new()), responses::read_of_ground)?,
        })
    }

    /// Returns the given structures, or all fitted ones.
    fn objects(
        &self,
        renames: &mut Renames,
        models: &Models,
        context: &Context,
    ) -> anyhow::Result<Vec<Object>> {
        if !self.structures.is_given() && self.model.fits.is_some() {
            let place = self.place.place();
            let fitted = |structure| Object::with_parameters(structure, Restitution::Fitted).at(&place);
            return Ok(models.structures()?.into_iter().map(fitted).collect());
        }
        let (objects, unused) = self.structures.objects(&self.place.place(), renames)?;
        context.warn(unused);
        match (objects.first().map(|first| (first, first.sides())), &self.structures.structures) {
            (Some((first, Err(reason))), path) if objects.iter().all(Object::is_implausible) => {
                let reason = named(first, &reason);
                match path {
                    Some(path) => {
                        anyhow::bail!("{}: {reason}; every other row has a fault too", path.display())
                    }
                    None => Err(reason),
                }
            }
            _ => Ok(objects),
        }
    }

    /// Writes and prints the answers for all objects.
    fn finish<R: Predicted>(
        &self,
        all: &[Answer<R>],
        text: String,
        context: &Context,
        picture: impl Fn() -> anyhow::Result<Evaluation>,
    ) -> anyhow::Result<String> {
        let rows = [answer_rows(all, context)?];
        let printed = self.printed(&rows, text)?;
        self.write(&rows, printed, context, picture)
    }

    /// Returns a text, or rows of one schema in the form that is asked for.
    fn printed(&self, rows: &[RecordBatch], text: String) -> anyhow::Result<String> {
        if self.format == Format::Text { Ok(text) } else { shown(rows, self.format) }
    }

    /// Writes rows of one schema, or a picture of them, if they go to a file, and returns what to print.
    fn write(
        &self,
        rows: &[RecordBatch],
        printed: String,
        context: &Context,
        picture: impl Fn() -> anyhow::Result<Evaluation>,
    ) -> anyhow::Result<String> {
        for out in self.outputs() {
            let key = || anyhow::Ok(context.provenance(&out, &printed)?.json());
            match file_format(&out)? {
                FileFormat::Text(format) => context.write_file(&out, shown(rows, format)?.as_bytes())?,
                FileFormat::Workbook => context.write_file(&out, &workbook(rows, &key()?)?)?,
                FileFormat::Page => {
                    let page = Page { key: key()?, made: made_in_words(), ..pages::page(&picture()?) };
                    context.write_file(&out, page.html().as_bytes())?;
                }
                FileFormat::Svg => {
                    context.write_file(&out, svg(&pages::figure(&picture()?), &key()?).as_bytes())?;
                }
                FileFormat::Png => {
                    let drawing = svg(&pages::figure(&picture()?), "");
                    context.write_file(&out, &png(&drawing, DPI, &key()?)?)?;
                }
                FileFormat::Parquet => {
                    let mut writer = context.create(&out, &rows[0].schema())?;
                    rows.iter().try_for_each(|rows| writer.append(rows))?;
                    context.finish(writer, &printed)?;
                }
            }
        }
        Ok(printed)
    }
}

/// Gathers the rows of answers, and warns of what their text does not state.
fn answer_rows<R: Predicted>(all: &[Answer<R>], context: &Context) -> anyhow::Result<RecordBatch> {
    let is_stated = |of: &Warning| matches!(of, Warning::HazardEndsEarly | Warning::HazardExtrapolated);
    for answer in all {
        let others = answer.warnings.iter().filter(|warning| !is_stated(warning));
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

/// Checks that responses were of an object; a warning where all have a depth, for they are to one component.
fn expect_counted(all: &[Answer<RatesRow>], site: &Site, responses: &Path) -> anyhow::Result<Warnings> {
    if all.iter().any(|answer| answer.row.counted_motions.is_some()) {
        return Ok(Warnings::default());
    }
    if all.iter().all(|answer| answer.object.p_rad_s.is_none() || answer.object.depth_m.is_some()) {
        return Ok([(Warning::NotCounted, UNNAMED.to_string())].into_iter().collect());
    }
    let mut names: Vec<&str> = site.responses.iter().map(|cases| &*cases.structure.name).collect();
    names.sort_unstable();
    names.dedup();
    anyhow::bail!(
        "{}: responses of {}; expected those of this structure to motions of its kind, some of which uplift it",
        responses.display(),
        listed(&names, 8)
    )
}

/// How answers are written to a file.
#[derive(Debug, Clone, Copy, PartialEq)]
enum FileFormat {
    Parquet,
    Text(Format),
    Page,
    Svg,
    Png,
    Workbook,
}

/// How a file is written, by how its name ends.
fn file_format(out: &Path) -> anyhow::Result<FileFormat> {
    Ok(match out.extension().and_then(|ending| ending.to_str()) {
        Some("parquet") => FileFormat::Parquet,
        Some("csv") => FileFormat::Text(Format::Csv),
        Some("json") => FileFormat::Text(Format::Json),
        Some("html") => FileFormat::Page,
        Some("svg") => FileFormat::Svg,
        Some("png") => FileFormat::Png,
        Some("xlsx") => FileFormat::Workbook,
        _ => {
            let out = out.display();
            let expected = "expected a name that ends in .parquet, .csv, .json, .xlsx, .html, .svg or .png";
            return Err(UsageError::because(format!("out is {out}; {expected}")));
        }
    })
}
