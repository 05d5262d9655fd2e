//! export: the fragility of structures for OpenQuake or pelicun.

use std::path::PathBuf;

use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::fragility::{LimitStates, Peak};
use rockfrag_core::hazard::{GenericSites, strongest, unusual_motions};
use rockfrag_core::object::{Object, Place, RockingObject};
use rockfrag_core::plausibility::GIVEN_MAGNITUDE;
use rockfrag_core::spelling::unknown_word;
use rockfrag_core::statistics::numerics::{bisect_first_true, equal_ratios};
use rockfrag_core::warning::Warning;
use serde::{Deserialize, Serialize};

use super::shared::model_args::ModelArgs;
use super::shared::objects::{StructureArgs, named};
use crate::answer::ObjectColumns;
use crate::export::{FragilityModel, Function, GAP, discrete, distinct_ids, metadata, parameters};
use crate::inputs::Reader;
use crate::number;
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::options::given;
use crate::pipeline::paths::Files;

/// Write fragility over PGA or PGV, averaged over PGV/PGA, for OpenQuake or pelicun
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag export --width 0.5 --height 1.9 --to openquake --out cabinet.xml\n\
    rockfrag export --structures objects.csv --to pelicun --over pga --fits fits --suite csgm\n\
    rockfrag export --width 0.5 --height 1.9 --period 0.6 --level 1 --to openquake --over pgv")]
pub struct Export {
    /// openquake (NRML) or pelicun (CSV, and JSON beside it)
    #[arg(long, value_name = "PROGRAM")]
    to: Program,
    /// Fragility over pga or pgv alone [default: over both]
    #[arg(long, value_name = "PEAK")]
    over: Option<Peak>,
    /// Moment magnitude of the motions [default: that of motions that overturn]
    #[arg(long, value_name = "MW", value_parser = given(GIVEN_MAGNITUDE))]
    magnitude: Option<f64>,
    /// File to write, without an ending with .xml or, for pelicun, .csv
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "fragility")]
    out: PathBuf,
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

#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase", parse_err_ty = String, parse_err_fn = unknown_word::<Program>)]
enum Program {
    OpenQuake,
    Pelicun,
}

/// Steps of equal ratio between the levels of a table, and how near to 1 its probabilities end.
const STEPS: usize = 99;
const NEAR: f64 = 1e-5;

impl Stage for Export {
    fn files(&self) -> Files {
        let is_pelicun = self.to == Program::Pelicun;
        let endings = if is_pelicun { &["csv"] } else { &["xml"] };
        let mut out = self.out.to_path_buf();
        if out.extension().is_none() {
            out.set_extension(endings[0]);
        }
        let json = is_pelicun.then(|| out.with_extension("json"));
        let read = vec![self.model.input(), self.structures.input()];
        Files { read, written: json.into_iter().chain([out]).collect(), endings }
    }

    fn check(&self) -> anyhow::Result<()> {
        self.objects(&mut self.structures.list.reader()).map(|_| ())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let models = self.model.read()?;
        let mut reader = self.structures.list.reader();
        let objects = self.objects(&mut reader)?;
        context.tell(reader.warnings, reader.readings);
        let ids = distinct_ids(objects.iter().map(|object| object.name.as_str()));
        let bar = context.bar(objects.len());
        let mut functions = Vec::new();
        for (object, id) in objects.iter().zip(&ids) {
            bar.advance(1)?;
            let (rocking, warnings) = models.rocking_object(object)?;
            let warnings = warnings.into_iter().chain(rocking.structure_warnings());
            let warnings = warnings.chain(unusual_motions(self.magnitude, None));
            context.warn(warnings.map(|warning| (warning, object.name.clone())).collect());
            for peak in self.peaks() {
                functions.push(self.function(id, peak, object, &rocking)?);
            }
        }
        let too_far =
            format!("rocks beyond {} of its slenderness angle, or overturns", self.model.limit_state);
        let model = FragilityModel {
            id: if let [id] = &ids[..] { id.clone() } else { "rockfrag_structures".to_string() },
            limit_states: vec!["rocks".to_string(), too_far, "overturns".to_string()],
            functions,
        };
        let files = &context.plan.outputs;
        let contents = match self.to {
            Program::OpenQuake => vec![discrete(&model)],
            Program::Pelicun => {
                vec![serde_json::to_string_pretty(&metadata(&model))? + "\n", parameters(&model)?]
            }
        };
        for (file, content) in files.iter().zip(contents) {
            context.write_file(file, content.as_bytes())?;
        }
        let peaks: Vec<String> = self.peaks().iter().map(Peak::to_string).collect();
        let (structures, peaks) = (number::counted(objects.len(), "structure"), peaks.join(" and "));
        Ok(format!("{}: {structures} over {peaks}\n", number::path(&files[files.len() - 1])))
    }
}

impl Export {
    /// The objects that have an answer, one or more.
    fn objects(&self, reader: &mut Reader) -> anyhow::Result<Vec<Object>> {
        let all = self.structures.objects(&self.place, reader)?;
        reader.expect_used()?;
        let (objects, others): (Vec<_>, Vec<_>) = all.into_iter().partition(|of| of.sides().is_ok());
        if let ([], [other, ..]) = (&objects[..], &others[..]) {
            other.sides().map_err(|reason| named(other, &reason))?;
        }
        others.into_iter().for_each(|other| reader.warnings.add(Warning::NoAnswer, other.name));
        Ok(objects)
    }

    fn peaks(&self) -> Vec<Peak> {
        self.over.map_or(vec![Peak::Pgv, Peak::Pga], |over| vec![over])
    }

    /// Tabulates the probabilities of an object, in either of its directions, from uplift to where all are 1
    /// or nothing was ever recorded, and on either side of a jump.
    fn function(
        &self,
        id: &str,
        peak: Peak,
        object: &Object,
        rocking: &RockingObject,
    ) -> anyhow::Result<Function> {
        let general = GenericSites { over: peak, mw: self.magnitude, vs30_m_s: None, ratio_s: None };
        let given_peak = general.given_peak(&rocking.directions);
        let is_whole = |intensity: f64| {
            given_peak.limit_states(intensity).into_array().iter().all(|p| p.is_some_and(|p| p >= 1.0 - NEAR))
        };
        let uplift = given_peak.uplift().least;
        let end = bisect_first_true(uplift, strongest(peak).max(2.0 * uplift), is_whole);
        let jumps = given_peak.jumps().into_iter().filter(|&jump| uplift < jump && jump < end);
        let mut levels: Vec<f64> = jumps.flat_map(|jump| [jump * (1.0 - GAP), jump]).collect();
        levels.extend(equal_ratios(uplift, end, STEPS));
        levels.sort_unstable_by(f64::total_cmp);
        // Strong synthetic PGA have little PGV, by which a probability may fall: it is held where it has
        // been.
        let mut most = LimitStates::all(0.0_f64);
        let mut probabilities = Vec::new();
        for &level in &levels {
            let states = given_peak.limit_states(level);
            let problem = "its fits give no probability for some motions: fit more responses";
            anyhow::ensure!(!states.into_array().contains(&None), named(object, &problem));
            most = most.zip(states, |most, p| p.map_or(most, |p| most.max(p.clamp(0.0, 1.0))));
            probabilities.push(most);
        }
        let magnitude = self.magnitude.map_or(String::new(), |mw| format!(", magnitude {mw}"));
        let weaker = &rocking.directions[0];
        let directions = if rocking.directions.len() > 1 { " in both directions" } else { "" };
        Ok(Function {
            id: format!("{id}_{peak}"),
            peak,
            description: format!(
                "{}{directions}, {}{magnitude}, by {}",
                object.name,
                ObjectColumns::new(object, Some(weaker)).place_in_building(),
                weaker.model.description()
            ),
            probabilities,
            levels,
        })
    }
}
