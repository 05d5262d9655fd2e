//! The stages: one file or folder a subcommand, which reads tables, calls the science and writes tables.

pub mod init;
pub mod inspect;
pub mod run;
pub mod shared;

use std::collections::BTreeMap;
use std::path::Path;

use clap::{Command, Subcommand};
use serde::Serialize;
use serde::de::Error;
use serde_json::Value;

use crate::pipeline::Stage;
use crate::pipeline::given::defaults;
use crate::pipeline::options::{Given, Rule};

/// Declares the stages, in the order of a run: the file and the struct of each.
macro_rules! stages {
    ($($module:ident :: $stage:ident),* $(,)?) => {
        $(pub mod $module;)*

        /// All stages.
        #[derive(Debug, Subcommand, Serialize)]
        #[serde(untagged)]
        #[expect(clippy::large_enum_variant, reason = "clap makes one for each call")]
        pub enum Stages {
            $($stage($module::$stage)),*
        }

        impl Stages {
            /// Makes a stage of what is given to it, defaults included.
            pub fn of(name: &str, given: Given) -> serde_json::Result<Stages> {
                let given = Value::Object(given);
                match name.replace('-', "_").as_str() {
                    $(stringify!($module) => serde_json::from_value(given).map(Stages::$stage),)*
                    _ => Err(serde_json::Error::custom(format_args!("no stage {name}"))),
                }
            }

            /// What options of a stage exclude, and need.
            pub fn rules(name: &str) -> Vec<Rule> {
                match name.replace('-', "_").as_str() {
                    $(stringify!($module) => $module::$stage::rules(),)*
                    _ => Vec::new(),
                }
            }

            pub fn boxed(self) -> Box<dyn Stage> {
                match self {
                    $(Stages::$stage(stage) => Box::new(stage)),*
                }
            }
        }
    };
}

stages! {
    sample_scenarios::SampleScenarios,
    synthesize_motions::SynthesizeMotions,
    import_motions::ImportMotions,
    floor_motions::FloorMotions,
    simulate::Simulate,
    ida::Ida,
    fit_pex::FitPex,
    fit_pro::FitPro,
    compare_paper::ComparePaper,
    evaluate::Evaluate,
    export::Export,
    validate::Validate,
    report::Report,
}

impl Stages {
    /// The options of a stage that is given none.
    pub fn defaults(stage: &str) -> BTreeMap<String, Value> {
        let commands = Stages::commands();
        let command = commands.iter().find(|command| command.get_name() == stage);
        let made = command.map(|command| Stages::of(stage, defaults(command, Path::new(""))));
        made.and_then(Result::ok).map_or(BTreeMap::new(), |stage| stage.options())
    }

    /// The commands of all stages, in the order of a run.
    pub fn commands() -> Vec<Command> {
        let stages = Stages::augment_subcommands(Command::new("stages"));
        stages.get_subcommands().cloned().map(shared::objects::with_fields).collect()
    }

    /// The options of the stage by flag, without files and what is not given.
    pub fn options(&self) -> BTreeMap<String, Value> {
        let all = serde_json::to_value(self).unwrap_or_default();
        let options = all.as_object().into_iter().flatten().map(|(flag, value)| (flag.clone(), given(value)));
        options.filter(|(_, value)| !value.is_null()).collect()
    }
}

/// A value without what is null in it; null if nothing is left.
fn given(value: &Value) -> Value {
    match value {
        Value::Array(items) => {
            let items: Vec<Value> = items.iter().map(given).filter(|item| !item.is_null()).collect();
            if items.is_empty() { Value::Null } else { Value::Array(items) }
        }
        Value::Object(fields) => {
            let given = fields.iter().map(|(name, value)| (name.clone(), given(value)));
            Value::Object(given.filter(|(_, value)| !value.is_null()).collect())
        }
        value => value.clone(),
    }
}
