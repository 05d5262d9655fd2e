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
pub mod run;
pub mod sample_scenarios;
pub mod shared;
pub mod simulate;
pub mod synthesize_motions;
pub mod validate;

use std::collections::BTreeMap;
use std::path::Path;

use clap::{Args, Command};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::pipeline::Stage;
use crate::pipeline::context::Common;
use crate::pipeline::given::{defaults, is_path, name_of};
use crate::pipeline::options::{Given, Rule};
use crate::pipeline::paths::is_word;

/// A stage: its command, what its options exclude and need, and how serde makes it of what is given.
pub struct StageKind {
    pub command: Command,
    pub rules: Vec<Rule>,
    make: fn(&Command, Given) -> serde_json::Result<Made>,
}

/// A stage with its options by flag, without files and what is not given.
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
        rules: S::rules(),
        make: |command, given| {
            let stage: S = serde_json::from_value(Value::Object(given))?;
            let options = options(command, serde_json::to_value(&stage)?);
            Ok((Box::new(stage), options))
        },
    }
}

impl StageKind {
    pub fn name(&self) -> &str {
        self.command.get_name()
    }

    /// Makes a stage of what is given to it, defaults included.
    pub fn make(&self, given: Given) -> serde_json::Result<Made> {
        (self.make)(&self.command, given)
    }
}

/// The options of a stage that is given none.
pub fn default_options(stage: &str) -> BTreeMap<String, Value> {
    let kind = all().into_iter().find(|kind| kind.name() == stage);
    let made = kind.and_then(|kind| kind.make(defaults(&kind.command, Path::new(""))).ok());
    made.map_or(BTreeMap::new(), |(_, options)| options)
}

fn options(command: &Command, mut all: Value) -> BTreeMap<String, Value> {
    strip(&mut all);
    let is_file = |option: &str, value: &Value| {
        let is_word = value.as_str().is_some_and(|text| is_word(option, text));
        !is_word && command.get_arguments().any(|arg| name_of(arg) == option && is_path(arg))
    };
    let options = all.as_object().cloned().unwrap_or_default().into_iter();
    options.filter(|(option, value)| !is_file(option, value)).collect()
}

/// Removes what is null or empty.
fn strip(value: &mut Value) {
    let is_given = |value: &Value| !value.is_null() && *value != Value::Array(Vec::new());
    match value {
        Value::Array(items) => {
            items.iter_mut().for_each(strip);
            items.retain(is_given);
        }
        Value::Object(fields) => {
            fields.values_mut().for_each(strip);
            fields.retain(|_, value| is_given(value));
        }
        _ => {}
    }
}
