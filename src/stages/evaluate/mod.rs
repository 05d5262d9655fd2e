//! evaluate: probabilities at an intensity or at each of a table, and annual rates over the hazard of a site.
//!
//! ```text
//! object       what is predicted for each object of a call, the worst first
//! point        probabilities at one PGA and PGV
//! rates        annual rates at a site
//! table        probabilities at each intensity of a table; intensities reads it
//! words        an object, its model and its warnings in words
//! explain      the model and the measures behind an answer
//! output       what is printed and written
//! ```

mod explain;
mod intensities;
mod object;
mod output;
mod point;
mod rates;
mod table;
mod words;

use std::path::{Path, PathBuf};

use clap::{Args, ValueHint};

use super::shared::hazard::{self, Renamed};
use super::shared::model_args::{ModelArgs, Models};
use super::shared::responses;
use super::shared::structures::{Object, StructureArgs};
use crate::fragility::{Model, Ratio};
use crate::hazard::{Hazard, Site};
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::stage::Stage;
use crate::plausibility::{STRONGEST_PGA_G, STRONGEST_PGV_M_S};
use crate::rocking::Structure;
use crate::units::G_M_S2;
use crate::warning::Warning;

use self::object::{Answer, Prediction};
pub use self::object::{ObjectRow, Predicted};
use self::output::Output;
pub use self::point::TreeRow;
pub use self::rates::RatesRow;
pub use self::words::size;

/// Predict how probable rocking and overturning are: under a motion, under each of a table, or a year at
/// a site
#[derive(Debug, Args)]
#[command(after_help = "rockfrag evaluate --width 0.5 --height 2.0 --pga 0.5 --pgv 0.6\n\
    rockfrag evaluate --structures objects.csv --hazard hazard.csv")]
pub struct Evaluate {
    /// Peak ground acceleration, g
    #[arg(long, value_name = "G", conflicts_with_all = ["in", "hazard"],
          value_parser = number(0.0..=STRONGEST_PGA_G, "g, up to 4.5, the strongest ever recorded: is it in m/s2?"))]
    pga: Option<f64>,
    /// Peak ground velocity, m/s
    #[arg(long, value_name = "M/S", conflicts_with_all = ["in", "hazard"],
          value_parser = number(0.0..=STRONGEST_PGV_M_S, "m/s, up to 5, more than was ever recorded: is it in cm/s?"))]
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
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    model: ModelArgs,
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
        self.output.path(self.input.as_deref()).into_iter().collect()
    }

    fn check(&self) -> anyhow::Result<()> {
        self.output.check()?;
        self.question().map(|_| ())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let models = self.model.read()?;
        match self.question()? {
            Question::Point(pga_g, pgv_m_s) => self.at_point([pga_g * G_M_S2, pgv_m_s], &models, context),
            Question::Hazard(path) => self.over_hazard(path, &models, context),
            Question::Table(path) => {
                let (rows, text) = table::evaluate(path, &self.columns, &self.structures, &models, context)?;
                self.output.write(&rows, text, Some(path), context)
            }
        }
    }
}

impl Evaluate {
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

    fn at_point(&self, peaks: [f64; 2], models: &Models, context: &Context) -> anyhow::Result<String> {
        let predict = |structure: &Structure, model: &Model| {
            let measures = IntensityMeasures::new(structure, peaks[0], peaks[1], None, None);
            let row = TreeRow::new(structure, model, &measures, peaks);
            Prediction { row, motion: peaks, warnings: Vec::new() }
        };
        let all = object::answers(self.objects(models)?, models, self.explain, predict)?;
        self.finish(&all, point::text(&all, self.sentence), context)
    }

    fn over_hazard(&self, path: &Path, models: &Models, context: &Context) -> anyhow::Result<String> {
        let site = self.site(path)?;
        let implausible = site.hazard.is_implausible().then_some(Warning::ImplausibleHazard);
        let predict = |structure: &Structure, model: &Model| {
            let rates = site.rates(structure, model);
            let row = RatesRow::new(&rates, self.years);
            Prediction {
                row,
                motion: rates.motion,
                warnings: rates.warnings.into_iter().chain(implausible).collect(),
            }
        };
        let all = object::answers(self.objects(models)?, models, self.explain, predict)?;
        self.finish(&all, rates::text(&all, &site, self.sentence), context)
    }

    /// Reads the hazard and what rates over it need.
    fn site(&self, path: &Path) -> anyhow::Result<Site> {
        let hazard = hazard::read(path, &self.columns)?;
        if let Hazard::Joint(_) = hazard {
            if self.ratio.is_some() {
                return Err(UsageError::because("ratio: the hazard has PGA and PGV of each motion"));
            }
            if self.extrapolate {
                return Err(UsageError::because("extrapolate: expected a hazard curve of one peak"));
            }
        }
        Ok(Site {
            hazard,
            ratio: self.ratio.map_or(Ratio::Distributed, Ratio::Seconds),
            extrapolate: self.extrapolate,
            limit_state: self.model.limit_state,
            responses: self.responses.as_deref().map_or(Ok(Vec::new()), responses::read)?,
        })
    }

    /// Returns the given structures, or all fitted ones.
    fn objects(&self, models: &Models) -> anyhow::Result<Vec<Object>> {
        if !self.structures.is_given() && self.model.fits.is_some() {
            return Ok(models.structures()?.into_iter().map(Object::from).collect());
        }
        let objects = self.structures.objects()?;
        match objects.iter().find_map(|object| object.structure.as_ref().err()) {
            Some(reason) if objects.iter().all(|object| object.structure.is_err()) => {
                match self.structures.structures {
                    Some(_) => anyhow::bail!("{reason}; no other row can be right either"),
                    None => Err(UsageError::because(reason)),
                }
            }
            _ => Ok(objects.to_vec()),
        }
    }

    /// Writes and prints the answers for all objects, and warns of them.
    fn finish<R: Predicted>(
        &self,
        all: &[Answer<R>],
        text: String,
        context: &Context,
    ) -> anyhow::Result<String> {
        context.warn(object::warnings_of_all(all));
        self.output.write(&[object::batch(all)?], text, None, context)
    }
}
