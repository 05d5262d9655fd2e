//! The stages: one file or folder a subcommand, which reads tables, calls the science and writes tables.

pub mod compare_paper;
pub mod evaluate;
pub mod export;
pub mod fit_pex;
pub mod fit_pro;
pub mod floor_motions;
pub mod ida;
pub mod import_motions;
pub mod init;
pub mod inspect;
pub mod report;
pub mod sample_scenarios;
pub mod shared;
pub mod simulate;
pub mod synthesize_motions;
pub mod validate;

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::{Args, Command};
use rockfrag_core::object::Field;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::pipeline::call::Call;
use crate::pipeline::context::Common;
use crate::pipeline::options::{Given, Rule, defaults, is_path, merge, name_of};
use crate::pipeline::paths::{Files, is_word};
use crate::pipeline::{Stage, UsageError};

/// What options of any stage exclude and need.
pub const RULES: [Rule; 16] = [
    Rule::Either(&Field::SIZES, &["structure", "structures"]),
    Rule::Either(&["structure"], &["structures"]),
    Rule::Either(&["width", "height", "depth", "centre-height", "centre-offset", "inertia"], &["p", "alpha"]),
    Rule::Either(&["beam-mass-ratio"], &["depth", "centre-height", "centre-offset", "inertia", "p", "alpha"]),
    Rule::Either(&["eta"], &["base"]),
    Rule::Needs(&["ground-floor", "storeys", "building"], &["structures"]),
    Rule::Needs(&["name", "model=paper"], &["fits"]),
    Rule::Either(&["partition"], &["trace"]),
    Rule::Either(&["pga", "pgv"], &OF_HAZARD),
    Rule::Either(&["in"], &OF_HAZARD),
    Rule::Either(&["in"], &["pga", "pgv", "vs30"]),
    Rule::Either(&["over"], &["in", "pga", "pgv", "target", "variants"]),
    Rule::Either(&["vs30"], &["ratio", "fits", "suite"]),
    Rule::Needs(&["effective-years", "years", "target", "variants"], &["hazard"]),
    Rule::Needs(&["columns", "ignore"], &["structures", "hazard", "in"]),
    Rule::Needs(&["period-sd"], &["period", "structure", "structures"]),
];
const OF_HAZARD: [&str; 4] = ["hazard", "effective-years", "ratio", "target"];

/// A stage: its command, and how serde makes it of what is given.
pub struct StageKind {
    pub command: Command,
    make: fn(Given) -> serde_json::Result<Made>,
}

type Made = (Box<dyn Stage>, BTreeMap<String, Value>);

/// All stages, in the order of a run.
pub fn all() -> Vec<StageKind> {
    vec![
        kind::<sample_scenarios::SampleScenarios>("sample-scenarios"),
        kind::<synthesize_motions::SynthesizeMotions>("synthesize-motions"),
        kind::<import_motions::ImportMotions>("import-motions"),
        kind::<floor_motions::FloorMotions>("floor-motions"),
        kind::<simulate::Simulate>("simulate"),
        kind::<ida::Ida>("ida"),
        kind::<fit_pex::FitPex>("fit-pex"),
        kind::<fit_pro::FitPro>("fit-pro"),
        kind::<compare_paper::ComparePaper>("compare-paper"),
        kind::<evaluate::Evaluate>("evaluate"),
        kind::<export::Export>("export"),
        kind::<validate::Validate>("validate"),
        kind::<report::Report>("report"),
    ]
}

fn kind<S: Stage + Args + Serialize + DeserializeOwned + 'static>(name: &'static str) -> StageKind {
    let command = S::augment_args(Command::new(name));
    let about = command.get_about().cloned().unwrap_or_default();
    let command = Common::augment_args(shared::objects::with_fields(command)).about(about);
    StageKind {
        command: command.args_override_self(true).mut_args(|arg| arg.allow_negative_numbers(true)),
        make: |given| {
            let stage: S = serde_json::from_value(Value::Object(given))?;
            let options = serde_json::from_value(serde_json::to_value(&stage)?)?;
            Ok((Box::new(stage), options))
        },
    }
}

impl StageKind {
    pub fn name(&self) -> &str {
        self.command.get_name()
    }

    /// Merges defaults, the section of a file and the options of the user, and makes the call. Default files
    /// are in `folder`.
    pub fn call(&self, section: &Given, user: &Given, folder: &Path) -> anyhow::Result<Call> {
        let given = merge(section, user, &RULES);
        if let Some(problem) = RULES.iter().find_map(|rule| rule.broken(&given, &self.command)) {
            return Err(UsageError::because(problem));
        }
        let mut required = self.command.get_arguments().filter(|arg| arg.is_required_set()).map(name_of);
        if let Some(option) = required.find(|option| !given.contains_key(*option)) {
            return Err(UsageError::because(format!("--{option} is missing")));
        }
        let mut all = defaults(&self.command, folder);
        all.extend(given);
        let common = serde_json::from_value(Value::Object(all.clone()))?;
        let (stage, options) = (self.make)(all).map_err(|error| UsageError::because(error.to_string()))?;
        let is_file = |option: &str, value: &Value| {
            let is_word = value.as_str().is_some_and(|text| is_word(option, text));
            !is_word && self.command.get_arguments().any(|arg| name_of(arg) == option && is_path(arg))
        };
        let options = options.into_iter().filter_map(|(option, value)| Some((option, stated(value)?)));
        let options = options.filter(|(option, value)| !is_file(option, value)).collect();
        let Files { written, endings, .. } = stage.files();
        let is_known = |ending: &OsStr| endings.iter().any(|known| ending == *known);
        // Tables go to no pipe.
        let is_other =
            |out: &&PathBuf| out.starts_with("-") || !out.extension().map_or(endings.len() == 1, is_known);
        if let Some(out) = written.last().filter(is_other) {
            let (out, endings) = (out.display(), endings.join(", ."));
            let problem = format!("--out is {out}; expected a name that ends in .{endings}");
            return Err(UsageError::because(problem));
        }
        stage.check()?;
        Ok(Call { name: self.name().to_string(), stage, common, options })
    }
}

/// The options of a stage that is given none.
pub fn default_options(stage: &str) -> BTreeMap<String, Value> {
    let kind = all().into_iter().find(|kind| kind.name() == stage);
    let call = kind.and_then(|kind| kind.call(&Given::new(), &Given::new(), Path::new("")).ok());
    call.map_or(BTreeMap::new(), |call| call.options)
}

fn stated(value: Value) -> Option<Value> {
    match value {
        Value::Null => None,
        Value::Array(items) => {
            let items: Vec<Value> = items.into_iter().filter_map(stated).collect();
            (!items.is_empty()).then_some(Value::Array(items))
        }
        Value::Object(fields) => {
            Some(fields.into_iter().filter_map(|(name, value)| Some((name, stated(value)?))).collect())
        }
        other => Some(other),
    }
}
