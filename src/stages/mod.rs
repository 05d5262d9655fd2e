//! The stages: one file or folder a subcommand, which reads tables, calls the science and writes tables.

pub mod init;
pub mod inspect;
pub mod run;
pub mod shared;

use std::collections::BTreeMap;

use clap::{Command, FromArgMatches, Subcommand};
use serde::Serialize;
use serde_json::Value;

use crate::pipeline::Stage;

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
            /// The stage that clap has parsed.
            pub fn parsed(self) -> Box<dyn Stage> {
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
        let parser = Stages::augment_subcommands(Command::new("rockfrag"));
        let parsed = parser.try_get_matches_from(["rockfrag", stage]);
        let stage = parsed.and_then(|matches| Stages::from_arg_matches(&matches));
        stage.map_or(BTreeMap::new(), |stage| stage.options())
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
