//! All stages, in the order of a run. From this list follow the subcommands, pipeline.yaml and Python's functions.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{ArgMatches, Command};
use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::compare_paper::ComparePaper;
use super::evaluate::Evaluate;
use super::export::Export;
use super::fit_pex::FitPex;
use super::fit_pro::FitPro;
use super::ida::Ida;
use super::import_motions::ImportMotions;
use super::rank_ims::RankIms;
use super::report::Report;
use super::sample_scenarios::SampleScenarios;
use super::simulate::Simulate;
use super::synthesize_motions::SynthesizeMotions;
use super::universality::Universality;
use super::validate::Validate;
use crate::pipeline::UsageError;
use crate::pipeline::declare::{AnySection, Declare, Files, OUT, Section, command, description};
use crate::pipeline::options::explain;
use crate::pipeline::stage::{Stage, beside, folder_of};
use crate::table::store::source::{Source, Target};
use crate::table::store::text_file;

macro_rules! stages {
    ($($key:ident: $stage:ty,)*) => {
        /// A pipeline file. A stage that is left out is not run.
        #[derive(Debug, Clone, Default, Deserialize)]
        #[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
        pub struct Config {
            /// Seed of the stages that draw random numbers, unless they have their own.
            pub seed: Option<u64>,
            /// Folder of all files, relative to this one.
            pub out: Option<PathBuf>,
            $(pub $key: Option<Section<$stage>>,)*
        }

        impl Config {
            fn sections(&self) -> impl Iterator<Item = &dyn AnySection> {
                [$(self.$key.as_ref().map(|section| section as &dyn AnySection)),*].into_iter().flatten()
            }

            fn sections_mut(&mut self) -> impl Iterator<Item = &mut dyn AnySection> {
                [$(self.$key.as_mut().map(|section| section as &mut dyn AnySection)),*].into_iter().flatten()
            }

            /// The stages of a subcommand that is called with `flags`, which win over the file; none if it is no stage.
            ///
            /// # Errors
            /// Those of the stage.
            pub fn called(&self, subcommand: &str, flags: &ArgMatches) -> anyhow::Result<Option<Vec<Box<dyn Stage>>>> {
                $(if subcommand == <$stage>::NAME {
                    let section = Section::<$stage>::called(flags, self.$key.as_ref())?;
                    let out = flags.get_one::<PathBuf>(OUT).map(Into::into);
                    return section.stages(&section.files(None, out), self.seed).map(Some);
                })*
                Ok(None)
            }
        }

        /// The stages of a subcommand with `options` as JSON and tables by their roles, for a program that calls it.
        ///
        /// # Errors
        /// Those of the stage, or if there is none of this name.
        pub fn create(
            subcommand: &str,
            options: &str,
            inputs: &BTreeMap<String, Source>,
            out: Option<Target>,
        ) -> anyhow::Result<Vec<Box<dyn Stage>>> {
            $(if subcommand == <$stage>::NAME {
                let section: Section<$stage> =
                    serde_json::from_str(options).map_err(|error| refused::<$stage>(options, &error))?;
                let given = <$stage>::INPUTS.iter();
                let inputs = given.filter_map(|input| Some((input.role, inputs.get(input.role)?.clone()))).collect();
                return section.stages(&Files { inputs, out, ..Files::default() }, None);
            })*
            Err(UsageError::because(format!("no stage '{subcommand}'")))
        }

        /// All stages, as programs that call them need to know them.
        pub fn descriptions() -> Value {
            json!([$(description::<$stage>()),*])
        }

        /// The subcommands of all stages.
        pub fn commands() -> Vec<Command> {
            vec![$(command::<$stage>().clone()),*]
        }

        /// Whether this command is a stage that shows a table.
        pub fn shows_table(command: &str) -> bool {
            [$((<$stage>::NAME, <$stage>::SHOWS_TABLE)),*].contains(&(command, true))
        }

        /// Whether this command is a stage without a progress bar.
        pub fn lacks_progress(command: &str) -> bool {
            [$((<$stage>::NAME, <$stage>::HAS_PROGRESS)),*].contains(&(command, false))
        }
    };
}

/// Why options cannot be read: which of them, and what is wrong with it.
fn refused<S: Declare>(options: &str, error: &serde_json::Error) -> anyhow::Error {
    let words = |error: &serde_json::Error| {
        let said = error.to_string();
        said.rsplit_once(" at line ").map_or(said.clone(), |(said, _)| said.to_string())
    };
    let options: Map<String, Value> = serde_json::from_str(options).unwrap_or_default();
    // Each by itself; what is left are options that do not go together.
    let alone = options.into_iter().find_map(|(name, value)| {
        let option = Value::Object(Map::from_iter([(name.clone(), value.clone())]));
        let said = words(&serde_json::from_value::<Section<S>>(option).err()?);
        let of_type = said.strip_prefix("invalid ").and_then(|said| said.split_once(", expected "));
        let expected = of_type.map(|(_, expected)| expected).or(said.strip_prefix("expected "));
        Some(match expected {
            Some(expected) => format!("--{name} is {value}; expected {expected}"),
            None => format!("--{name}: {said}"),
        })
    });
    UsageError::because(alone.unwrap_or_else(|| words(error)))
}

stages! {
    sample_scenarios: SampleScenarios,
    synthesize_motions: SynthesizeMotions,
    import_motions: ImportMotions,
    simulate: Simulate,
    ida: Ida,
    fit_pex: FitPex,
    fit_pro: FitPro,
    universality: Universality,
    rank_ims: RankIms,
    compare_paper: ComparePaper,
    validate: Validate,
    evaluate: Evaluate,
    export: Export,
    report: Report,
}

/// The largest file: many thousand structures.
const MOST_MIB: u64 = 1;

/// The set-up of the paper.
pub const PAPER: &str = include_str!("../../pipeline.yaml");

impl Config {
    /// Reads the file.
    ///
    /// # Errors
    /// If it is missing, is no YAML (with line and column), or has an unknown key (naming the nearest known one) or a
    /// value of another type.
    pub fn read(path: &Path) -> anyhow::Result<Config> {
        let failed = |why: String| UsageError::because(format!("{}: {why}", path.display()));
        let text = text_file::text(path, MOST_MIB, "a pipeline file")
            .with_context(|| UsageError(path.display().to_string()))?;
        let mut config: Config =
            serde_saphyr::from_str(&text).map_err(|error| failed(explain(&error, &text)))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        config.sections_mut().for_each(|section| section.resolve_paths(folder));
        config.out = Some(beside(path, "").join(config.out.unwrap_or("out".into())));
        Ok(config)
    }

    /// Whether these stages are some of the paper's set-up, as `pipeline.yaml` has it.
    ///
    /// # Errors
    /// If an input cannot be read.
    pub fn is_of_paper(stages: &[Box<dyn Stage>]) -> anyhow::Result<bool> {
        let Some(path) = stages.first().and_then(|stage| stage.outputs().pop()) else { return Ok(false) };
        let paper: Config = serde_saphyr::from_str(PAPER).context("pipeline.yaml")?;
        let paper = paper.stages(folder_of(&path))?;
        let is_same = |one: &dyn Stage, other: &dyn Stage| {
            let names = |stage: &dyn Stage| {
                stage.inputs().iter().map(|(_, source)| source.name().to_path_buf()).collect::<Vec<_>>()
            };
            one.name() == other.name() && one.parameters() == other.parameters() && names(one) == names(other)
        };
        let is_of_paper = |stage: &dyn Stage| paper.iter().any(|other| is_same(stage, other.as_ref()));
        Ok(stages.iter().all(|stage| is_of_paper(stage.as_ref())))
    }

    /// The same run with another seed in all stages.
    pub fn with_seed(mut self, seed: u64) -> Config {
        self.seed = Some(seed);
        self.sections_mut().for_each(AnySection::clear_seed);
        self
    }

    /// The stages that the file asks for, in order, with all files in `folder`.
    ///
    /// # Errors
    /// If an option is out of range, or two stages make the same file.
    pub fn stages(&self, folder: &Path) -> anyhow::Result<Vec<Box<dyn Stage>>> {
        let mut stages: Vec<Box<dyn Stage>> = Vec::new();
        for section in self.sections() {
            for stage in section.stages_in(folder, self.seed)? {
                let outputs = stage.outputs();
                if let Some(other) = stages.iter().find(|other| other.outputs().last() == outputs.last()) {
                    let made = outputs.last().and_then(|path| path.file_stem()).unwrap_or_default();
                    return Err(UsageError::because(format!(
                        "both {} and {} make the {}; leave one of them out",
                        other.name(),
                        stage.name(),
                        made.display()
                    )));
                }
                stages.push(stage);
            }
        }
        Ok(stages)
    }
}
