//! export: the fragility of structures for OpenQuake or pelicun.

use std::path::{Path, PathBuf};

use clap::{Args, ValueHint};

use super::shared::model_args::{ModelArgs, words_of};
use super::shared::objects::StructureArgs;
use crate::export::{FragilityModel, Function, PELICUN_TOLERANCE};
use crate::export::{discrete, levels, metadata, own_id, parameters, whole_curve_end};
use crate::fragility::{GivenPeak, Peak, Scenarios};
use crate::hazard::{PgvPgaRatio, magnitude, strongest};
use crate::keyword::keywords;
use crate::pipeline::context::Context;
use crate::pipeline::{Stage, UsageError};
use crate::rocking::Structure;
use crate::table::writer::write_file;

/// Write fragility over PGA or PGV, averaged over PGV/PGA, for OpenQuake or pelicun
#[derive(Debug, Args)]
pub struct Export {
    /// openquake (NRML) or pelicun (CSV, and JSON beside it)
    #[arg(long, value_name = "PROGRAM")]
    to: Program,
    /// Intensity: pga or pgv
    #[arg(long, value_name = "PEAK", default_value = "pga")]
    im: Peak,
    /// File to write: .xml, for pelicun .csv [default: fragility.xml or fragility.csv]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::AnyPath)]
    out: Option<PathBuf>,
    #[command(flatten)]
    model: ModelArgs,
    #[command(flatten)]
    structures: StructureArgs,
}

keywords! {
    /// A program that reads fragility.
    enum Program {
        OpenQuake = "openquake",
        Pelicun = "pelicun",
    }
}

/// Largest error of straight lines between the levels for OpenQuake.
const TOLERANCE: f64 = 4e-6;

impl Stage for Export {
    fn outputs(&self) -> Vec<PathBuf> {
        let out = self.out.clone().unwrap_or_else(|| Path::new("fragility").with_extension(self.ending()));
        let json = (self.to == Program::Pelicun).then(|| out.with_extension("json"));
        json.into_iter().chain([out]).collect()
    }

    fn check(&self) -> anyhow::Result<()> {
        let ending = self.ending();
        if let Some(out) = self.out.as_ref().filter(|out| out.extension() != Some(ending.as_ref())) {
            let out = out.display();
            return Err(UsageError::because(format!("out is {out}; expected a name that ends in .{ending}")));
        }
        self.structures.resolve().map(|_| ())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let (structures, warnings) = self.structures.resolve()?;
        context.warn(warnings);
        let models = self.model.read()?;
        let (mut functions, mut description) = (Vec::new(), String::new());
        let bar = context.bar(structures.len());
        for structure in &structures {
            bar.advance(1)?;
            let (model, warnings) = models.model(structure)?;
            context.warn(warnings.into_iter().map(|warning| (warning, structure.name.clone())).collect());
            let (velocity, median) = (PgvPgaRatio::of_model(&model, self.im, None), magnitude(None).0);
            let (ratio, mw) = (velocity.at(median, 0.0), velocity.magnitude(None, median));
            let directions = [(structure.clone(), model.clone())];
            let given_peak = GivenPeak { directions: &directions, peak: self.im, ratio, mw };
            functions.push(self.function(structure, &given_peak));
            description = words_of(&model);
        }
        let too_far = format!("rocks beyond {} of its slenderness, or overturns", self.model.limit_state);
        let model = FragilityModel {
            id: own_id(&structures[0].name),
            description,
            limit_states: vec!["rocks".to_string(), too_far, "overturns".to_string()],
        };
        let files = self.outputs();
        match self.to {
            Program::OpenQuake => write_file(&files[0], discrete(&model, &functions).as_bytes())?,
            Program::Pelicun => {
                let json = serde_json::to_string_pretty(&metadata(&model, &functions))? + "\n";
                write_file(&files[0], json.as_bytes())?;
                write_file(&files[1], parameters(&functions)?.as_bytes())?;
            }
        }
        let (file, number, im) = (files[files.len() - 1].display(), functions.len(), self.im);
        let most = functions.iter().map(|function| function.levels.len()).max().unwrap_or(0);
        Ok(format!("{file}: {number} structure(s) over {im}, up to {most} levels each\n"))
    }
}

impl Export {
    fn ending(&self) -> &'static str {
        match self.to {
            Program::OpenQuake => "xml",
            Program::Pelicun => "csv",
        }
    }

    /// The probabilities of a structure as a table, from uplift to where all are 1 or nothing was ever
    /// recorded.
    fn function(&self, structure: &Structure, given_peak: &GivenPeak) -> Function {
        let reaching = |intensity: f64| {
            given_peak.limit_states(intensity, Scenarios::One).map(|state| state.value.clamp(0.0, 1.0))
        };
        let tolerance = if self.to == Program::OpenQuake { TOLERANCE } else { PELICUN_TOLERANCE };
        let [uplift, _] = given_peak.uplift();
        let most = strongest(self.im).max(2.0 * uplift);
        let end = whole_curve_end(uplift, tolerance, reaching).min(most);
        let jumps = given_peak.jumps().into_iter().filter(|&jump| uplift < jump && jump < end);
        let edges: Vec<f64> = std::iter::once(uplift).chain(jumps).chain([end]).collect();
        let levels = levels(&edges, tolerance, reaching);
        // Strong synthetic PGA have little PGV, by which a probability may fall: it is held where it has
        // been.
        let mut most = [0.0_f64; 3];
        let held = |&level: &f64| {
            most.iter_mut().zip(reaching(level)).for_each(|(most, p)| *most = most.max(p));
            most
        };
        Function {
            id: format!("{}_{}", own_id(&structure.name), self.im),
            peak: self.im,
            probabilities: levels.iter().map(held).collect(),
            range_of_data: [uplift, end],
            levels,
        }
    }
}
