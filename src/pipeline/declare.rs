//! What a stage declares of itself, once: from it follow its command, its section of pipeline.yaml, its place in a run, and
//! its function in Python.

use std::any::TypeId;
use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches, value_parser};
use serde::de::value::MapAccessDeserializer;
use serde::de::{DeserializeOwned, DeserializeSeed, Error as _, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::{Map, Value, json};

use super::UsageError;
use super::options::Steps;
use super::stage::{Stage, beside};
use crate::table::store::partition;
use crate::table::store::source::{Source, Target};

/// Options of a stage: one struct serves the command line, pipeline.yaml and Python.
pub trait StageOptions: Args + Serialize + DeserializeOwned + Default + Clone + fmt::Debug {
    /// The seed, where the stage draws random numbers.
    fn seed(&mut self) -> Option<&mut Option<u64>> {
        None
    }

    /// Makes paths relative to `folder`, that of the pipeline file.
    fn resolve_paths(&mut self, _folder: &Path) {}
}

/// A stage with its name, options and files.
pub trait Declare: Stage + Sized + 'static {
    /// The options.
    type Options: StageOptions;
    /// The subcommand, and the key in pipeline.yaml.
    const NAME: &'static str;
    /// What it does, in one phrase; further paragraphs are for `--help`.
    const ABOUT: &'static str;
    /// Commands to try, one a line.
    const EXAMPLES: &'static str;
    /// Other words for options that several stages share, by their names, where they mean something else here.
    const HELPS: &'static [(&'static str, &'static str)] = &[];
    /// What it reads of what other stages make.
    const INPUTS: &'static [Input] = &[];
    /// The file it writes.
    const OUTPUT: Output;
    /// Whether it shows a table, which can be printed for programs ([`Stage::rows`]).
    const SHOWS_TABLE: bool = false;
    /// Whether it has a progress bar.
    const HAS_PROGRESS: bool = true;

    /// Creates the stage.
    ///
    /// # Errors
    /// If an option is out of range, or a file that options name cannot be used.
    fn create(options: &Self::Options, files: &Files) -> anyhow::Result<Self>;

    /// Creates the stage, or one for each part where the work is parted.
    ///
    /// # Errors
    /// As [`Declare::create`].
    fn create_all(options: &Self::Options, files: &Files) -> anyhow::Result<Vec<Box<dyn Stage>>> {
        Ok(vec![Box::new(Self::create(options, files)?)])
    }
}

/// A table that a stage reads, by the role it plays.
#[derive(Debug, Clone, Copy)]
pub struct Input {
    /// What it is called in provenance and messages, and as an argument in Python.
    pub role: &'static str,
    /// The flag that names it, and the key in pipeline.yaml.
    pub flag: &'static str,
    about: &'static str,
    unnamed: Unnamed,
    heading: Option<&'static str>,
    excludes: &'static [&'static str],
}

/// What is read where nobody names an input.
#[derive(Debug, Clone, Copy)]
enum Unnamed {
    /// This file; in a run, in the folder of its files.
    File(&'static str),
    /// This folder; in a run, that of its files.
    Folder(&'static str),
    /// In a run this file in the folder of its files, else nothing.
    FileOfRun(&'static str),
    /// This file, outside of a run only if it is there.
    FileIfThere(&'static str),
    Nothing,
}

/// Tables that may be a folder of partitions, and what the help of their flags says of it.
const PARTED: [&str; 2] = ["motions.parquet", "responses.parquet"];
const OF_PARTITIONS: &str = "; a file, or a folder of partitions";

impl Input {
    /// Declares an input that is `file` unless a flag names another.
    pub const fn file(
        role: &'static str,
        flag: &'static str,
        file: &'static str,
        about: &'static str,
    ) -> Input {
        Input { role, flag, about, unnamed: Unnamed::File(file), heading: None, excludes: &[] }
    }

    /// Declares a folder of files.
    pub const fn folder(self, folder: &'static str) -> Input {
        Input { unnamed: Unnamed::Folder(folder), ..self }
    }

    /// Makes the file one that is read only in a run, or where a flag names it.
    pub const fn if_in_run(self) -> Input {
        match self.unnamed {
            Unnamed::File(file) => Input { unnamed: Unnamed::FileOfRun(file), ..self },
            _ => self,
        }
    }

    /// Makes the file one that the stage can do without, outside of a run.
    pub const fn if_there(self) -> Input {
        match self.unnamed {
            Unnamed::File(file) => Input { unnamed: Unnamed::FileIfThere(file), ..self },
            _ => self,
        }
    }

    /// Makes the input one that is read only where it is named.
    pub const fn if_named(self) -> Input {
        Input { unnamed: Unnamed::Nothing, ..self }
    }

    /// Puts the flag under a heading of the help.
    pub const fn under(self, heading: &'static str) -> Input {
        Input { heading: Some(heading), ..self }
    }

    /// Refuses the flag together with these options.
    pub const fn without(self, excludes: &'static [&'static str]) -> Input {
        Input { excludes, ..self }
    }

    /// Whether the stage cannot do without it.
    pub fn is_required(&self) -> bool {
        matches!(self.unnamed, Unnamed::File(_) | Unnamed::Folder(_))
    }

    fn path(&self, run: Option<&Path>) -> Option<PathBuf> {
        match (self.unnamed, run) {
            (Unnamed::File(file) | Unnamed::FileOfRun(file) | Unnamed::FileIfThere(file), Some(folder)) => {
                Some(folder.join(file))
            }
            (Unnamed::FileIfThere(file), None) => Some(PathBuf::from(file)).filter(|path| path.exists()),
            (Unnamed::Folder(_), Some(folder)) => Some(folder.to_path_buf()),
            (Unnamed::File(name) | Unnamed::Folder(name), None) => Some(name.into()),
            (Unnamed::FileOfRun(_), None) | (Unnamed::Nothing, _) => None,
        }
    }

    fn help(&self) -> String {
        let parts = match self.unnamed {
            Unnamed::File(file) if PARTED.contains(&file) => OF_PARTITIONS,
            _ => "",
        };
        format!("{}{parts}", self.about)
    }

    fn arg(&self) -> Arg {
        let (kind, default) = match self.unnamed {
            Unnamed::File(file) | Unnamed::FileIfThere(file) => ("FILE", Some(file)),
            Unnamed::Folder(folder) => ("DIR", Some(folder)),
            Unnamed::FileOfRun(_) | Unnamed::Nothing => ("FILE", None),
        };
        let arg = Arg::new(self.flag).long(self.flag).value_name(kind).help(self.help());
        let arg = arg.value_parser(value_parser!(PathBuf)).default_value(default).display_order(0);
        arg.help_heading(self.heading).conflicts_with_all(self.excludes)
    }
}

/// The file that a stage writes.
#[derive(Debug, Clone, Copy)]
pub struct Output {
    /// What it is called unless a flag says otherwise.
    pub file: &'static str,
    about: &'static str,
    heading: Option<&'static str>,
    /// Further files beside it: `pex.scan.parquet` of `pex.parquet`.
    pub parts: &'static [&'static str],
}

impl Output {
    /// Declares an output.
    pub const fn file(file: &'static str, about: &'static str) -> Output {
        Output { file, about, heading: None, parts: &[] }
    }

    /// Puts the flag under a heading of the help.
    pub const fn under(self, heading: &'static str) -> Output {
        Output { heading: Some(heading), ..self }
    }

    /// Adds further files.
    pub const fn with_parts(self, parts: &'static [&'static str]) -> Output {
        Output { parts, ..self }
    }

    fn arg(&self) -> Arg {
        let arg = Arg::new(OUT).long(OUT).value_name("FILE").help(self.about);
        arg.value_parser(value_parser!(PathBuf)).help_heading(self.heading)
    }
}

/// The flag of outputs.
pub const OUT: &str = "out";

/// The files of a stage that is called.
#[derive(Debug, Clone, Default)]
pub struct Files {
    /// What it reads, by roles.
    pub inputs: Vec<(&'static str, Source)>,
    /// What it writes, if that is said.
    pub out: Option<Target>,
    /// The folder of all files, in a run.
    pub run: Option<PathBuf>,
    /// Inputs that nobody named, and that are read since they are there.
    pub found: Vec<&'static str>,
}

impl Files {
    /// The input in a role that need not be played.
    pub fn optional(&self, role: &str) -> Option<Source> {
        self.inputs.iter().find(|(other, _)| *other == role).map(|(_, source)| source.clone())
    }

    /// The input in a role.
    ///
    /// # Errors
    /// If there is none.
    pub fn input(&self, role: &str) -> anyhow::Result<Source> {
        self.optional(role).ok_or_else(|| UsageError::because(format!("no {role}; expected a table of them")))
    }

    /// The output as it is asked for, or `file` in the folder of a run.
    pub fn asked(&self, file: &str) -> Option<Target> {
        let in_run = || self.run.as_ref().map(|folder| folder.join(file).into());
        self.out.clone().or_else(in_run)
    }

    /// The table as it is asked for, or `file` beside the first input.
    ///
    /// # Errors
    /// If it is asked for under the name of another kind of file.
    pub fn out(&self, file: &str) -> anyhow::Result<Target> {
        let beside_input = || match self.inputs.first() {
            Some((_, source)) => beside(source.name(), file).into(),
            None => file.into(),
        };
        let out = self.asked(file).unwrap_or_else(beside_input);
        expect_parquet(&out)?;
        Ok(out)
    }
}

/// Endings of files that hold a table in another format.
const OTHER_FORMATS: [&str; 9] = ["csv", "tsv", "txt", "json", "xlsx", "xls", "html", "feather", "arrow"];

/// That a table is not written under the name of another kind of file.
///
/// # Errors
/// If it is.
pub fn expect_parquet(out: &Target) -> anyhow::Result<()> {
    let Some(path) = out.path() else { return Ok(()) };
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if !OTHER_FORMATS.contains(&&*ending) || path.is_dir() {
        return Ok(());
    }
    Err(UsageError::because(format!(
        "out is {}; this table is written as Parquet: expected a name that ends in .parquet (polars, pandas and DuckDB turn it into {ending})",
        path.display()
    )))
}

/// A stage in pipeline.yaml, or as it is called: its options, and the inputs that are named.
pub struct Section<S: Declare> {
    pub options: S::Options,
    /// Paths by flags.
    inputs: BTreeMap<&'static str, PathBuf>,
}

impl<S: Declare> Section<S> {
    /// The section as resolved: a flag wins over `file`, the file over the default. A flag also takes away what the file has of
    /// options that exclude each other.
    ///
    /// # Errors
    /// If flag and file do not fit together into the options.
    pub fn called(flags: &ArgMatches, file: Option<&Section<S>>) -> anyhow::Result<Section<S>> {
        let command = command::<S>();
        let typed = object(&S::Options::from_arg_matches(flags)?)?;
        let defaults = object(&S::Options::default())?;
        let mut options = file.map_or(Ok(defaults.clone()), |section| object(&section.options))?;
        let mut inputs = file.map(|section| section.inputs.clone()).unwrap_or_default();
        let given = |arg: &&Arg| flags.value_source(arg.get_id().as_str()) == Some(ValueSource::CommandLine);
        let given: Vec<&'static Arg> = command.get_arguments().filter(given).collect();
        for other in given.iter().flat_map(|arg| excluded(command, arg)) {
            let name = name_of(other);
            inputs.remove(name);
            options.extend(defaults.get(name).map(|default| (name.to_string(), default.clone())));
        }
        for name in given.into_iter().map(name_of) {
            if S::INPUTS.iter().any(|input| input.flag == name) {
                inputs.extend(flags.get_one::<PathBuf>(name).map(|path| (name, path.clone())));
            } else if let Some(value) = typed.get(name) {
                if value.is_null() {
                    return Err(UsageError::because(format!("{name} is not a finite number")));
                }
                options.insert(name.to_string(), value.clone());
            }
        }
        let options = serde_json::from_value(Value::Object(options));
        Ok(Section { options: options.map_err(|error| UsageError::because(error.to_string()))?, inputs })
    }

    /// The files of the stage: in the folder of a `run`, or where the flags say.
    pub fn files(&self, run: Option<&Path>, out: Option<Target>) -> Files {
        let path = |input: &Input| self.inputs.get(input.flag).cloned().or_else(|| input.path(run));
        let inputs = S::INPUTS.iter().filter_map(|input| Some((input.role, path(input)?.into())));
        let is_found = |input: &&Input| {
            matches!(input.unnamed, Unnamed::FileIfThere(_)) && !self.inputs.contains_key(input.flag)
        };
        let found = S::INPUTS.iter().filter(is_found).filter(|_| run.is_none()).map(|input| input.role);
        Files { inputs: inputs.collect(), out, run: run.map(Path::to_path_buf), found: found.collect() }
    }
}

impl<S: Declare> Clone for Section<S> {
    fn clone(&self) -> Self {
        Section { options: self.options.clone(), inputs: self.inputs.clone() }
    }
}

impl<S: Declare> Default for Section<S> {
    fn default() -> Self {
        Section { options: S::Options::default(), inputs: BTreeMap::new() }
    }
}

impl<S: Declare> fmt::Debug for Section<S> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct(S::NAME).field("options", &self.options).field("inputs", &self.inputs).finish()
    }
}

/// What a pipeline file does with any section.
pub trait AnySection {
    /// Makes paths relative to `folder`, that of the pipeline file.
    fn resolve_paths(&mut self, folder: &Path);

    /// Forgets the seed of its own.
    fn clear_seed(&mut self);

    /// Creates the stages of the section, with a seed for where it has none of its own.
    ///
    /// # Errors
    /// Those of the stage.
    fn stages(&self, files: &Files, seed: Option<u64>) -> anyhow::Result<Vec<Box<dyn Stage>>>;

    /// Creates the stages of the section in the folder of a run.
    ///
    /// # Errors
    /// Those of the stage.
    fn stages_in(&self, run: &Path, seed: Option<u64>) -> anyhow::Result<Vec<Box<dyn Stage>>>;
}

impl<S: Declare> AnySection for Section<S> {
    fn resolve_paths(&mut self, folder: &Path) {
        self.options.resolve_paths(folder);
        self.inputs.values_mut().for_each(|path| *path = folder.join(&*path));
    }

    fn clear_seed(&mut self) {
        if let Some(seed) = self.options.seed() {
            *seed = None;
        }
    }

    fn stages(&self, files: &Files, seed: Option<u64>) -> anyhow::Result<Vec<Box<dyn Stage>>> {
        let mut options = self.options.clone();
        if let Some(own) = options.seed() {
            *own = own.or(seed);
        }
        S::create_all(&options, files)
    }

    fn stages_in(&self, run: &Path, seed: Option<u64>) -> anyhow::Result<Vec<Box<dyn Stage>>> {
        if object(&self.options)?.get(partition::PARAMETER).is_some_and(|partition| !partition.is_null()) {
            let name = S::NAME;
            return Err(UsageError::because(format!(
                "{name} has a partition, and a run makes whole files; take it out of the pipeline file, and name it where a stage is \
                 called: rockfrag --config FILE {name} --partition i/n"
            )));
        }
        self.stages(&self.files(Some(run), None), seed)
    }
}

fn object(options: &impl Serialize) -> anyhow::Result<Map<String, Value>> {
    match serde_json::to_value(options) {
        Ok(Value::Object(object)) => Ok(object),
        _ => Err(UsageError::because("options that are no list of names and values")),
    }
}

/// The command of a stage: its inputs, its output, its options.
pub fn command<S: Declare>() -> &'static Command {
    static COMMANDS: Mutex<BTreeMap<&str, &Command>> = Mutex::new(BTreeMap::new());
    let mut commands = COMMANDS.lock().unwrap_or_else(PoisonError::into_inner);
    commands.entry(S::NAME).or_insert_with(|| Box::leak(Box::new(new_command::<S>())))
}

fn new_command<S: Declare>() -> Command {
    let (own, headed): (Vec<Arg>, Vec<Arg>) = S::INPUTS
        .iter()
        .map(Input::arg)
        .chain([S::OUTPUT.arg()])
        .partition(|arg| arg.get_help_heading().is_none());
    let command = S::Options::augment_args(Command::new(S::NAME).args(own));
    // What a negative number means is said by the check of the option, not by a word on unknown flags.
    // The words that an option knows stand in its help, each with what it means.
    let command = command.mut_args(|arg| arg.allow_negative_numbers(true).hide_possible_values(true));
    let command = command.next_help_heading(None::<&str>).args(headed);
    let command = S::HELPS
        .iter()
        .fold(command, |command, &(option, help)| command.mut_arg(option, |arg| arg.help(help)));
    let examples: String = S::EXAMPLES.lines().map(|line| format!("\n  {line}")).collect();
    let command = command.after_help(format!("Examples:{examples}"));
    let about = S::ABOUT.split("\n\n").next();
    let long = S::ABOUT.contains("\n\n").then_some(S::ABOUT);
    command.about(about).long_about(long)
}

/// A stage as a program that calls it needs to know it: what goes in, the options with types and defaults, what comes out.
pub fn description<S: Declare>() -> Value {
    let input =
        |input: &Input| json!({ "role": input.role, "required": input.is_required(), "help": input.help() });
    let declared =
        |arg: &&Arg| *arg.get_id() != OUT && S::INPUTS.iter().all(|input| input.flag != *arg.get_id());
    let option = |arg: &Arg| {
        let default: Vec<_> = arg.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
        json!({
            "name": name_of(arg), "type": type_of(arg), "positional": arg.is_positional(), "words": words_of(arg),
            "default": default.first(), "help": arg.get_help().map(ToString::to_string)
        })
    };
    json!({
        "name": S::NAME, "about": S::ABOUT, "inputs": S::INPUTS.iter().map(input).collect::<Vec<_>>(),
        "options": command::<S>().get_arguments().filter(declared).map(option).collect::<Vec<_>>(),
        "output": { "file": S::OUTPUT.file, "parts": S::OUTPUT.parts, "help": S::OUTPUT.about }
    })
}

/// The type of an option, in a word.
fn type_of(arg: &Arg) -> &'static str {
    let parsed = arg.get_value_parser().type_id();
    let is_any = |types: &[TypeId]| types.iter().any(|known| parsed == *known);
    match arg.get_action() {
        ArgAction::SetTrue => "bool",
        ArgAction::Append => "paths",
        _ if is_any(&[TypeId::of::<f64>()]) => "float",
        _ if is_any(&[TypeId::of::<u32>(), TypeId::of::<u64>(), TypeId::of::<usize>()]) => "int",
        _ if is_any(&[TypeId::of::<String>()]) => "str",
        _ if is_any(&[TypeId::of::<PathBuf>()]) => "path",
        _ if is_any(&[TypeId::of::<Steps>()]) => "steps",
        _ if !words_of(arg).is_empty() => "word",
        _ => "any",
    }
}

/// The words that an option takes, where it takes no others.
fn words_of(arg: &Arg) -> Vec<String> {
    let takes_words = matches!(arg.get_action(), ArgAction::Set);
    let known = if takes_words { arg.get_possible_values() } else { Vec::new() };
    known.iter().map(|word| word.get_name().to_string()).collect()
}

/// What an argument is called in pipeline.yaml.
fn name_of(arg: &Arg) -> &str {
    arg.get_long().unwrap_or(arg.get_id().as_str())
}

/// The arguments that cannot stand together with `arg`.
fn excluded<'a>(command: &'a Command, arg: &Arg) -> impl Iterator<Item = &'a Arg> {
    let id = arg.get_id().clone();
    let forward: Vec<_> =
        command.get_arg_conflicts_with(arg).into_iter().map(|other| other.get_id().clone()).collect();
    command.get_arguments().filter(move |other| {
        let backward = command.get_arg_conflicts_with(other);
        forward.contains(other.get_id()) || backward.iter().any(|excluded| *excluded.get_id() == id)
    })
}

impl<'de, S: Declare> Deserialize<'de> for Section<S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Section<S>, D::Error> {
        deserializer.deserialize_map(SectionVisitor(PhantomData))
    }
}

struct SectionVisitor<S>(PhantomData<S>);

impl<'de, S: Declare> Visitor<'de> for SectionVisitor<S> {
    type Value = Section<S>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "the options of {}", S::NAME)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Section<S>, A::Error> {
        let command = command::<S>();
        let names = command.get_arguments().map(name_of).filter(|name| *name != OUT).collect();
        let (mut inputs, mut given) = (BTreeMap::new(), Vec::new());
        let keys = Keys { map, names, declared: S::INPUTS, inputs: &mut inputs, given: &mut given };
        let options = S::Options::deserialize(MapAccessDeserializer::new(keys))?;
        for arg in command.get_arguments().filter(|arg| given.contains(&name_of(arg))) {
            if let Some(other) = excluded(command, arg).find(|other| given.contains(&name_of(other))) {
                let (one, other) = (name_of(arg), name_of(other));
                return Err(A::Error::custom(format!(
                    "{one} and {other} exclude each other; keep one of them"
                )));
            }
        }
        Ok(Section { options, inputs })
    }
}

/// The entries of a section: options pass through, named inputs are kept back, unknown keys are refused where they stand.
struct Keys<'a, A> {
    map: A,
    names: Vec<&'static str>,
    declared: &'static [Input],
    inputs: &'a mut BTreeMap<&'static str, PathBuf>,
    given: &'a mut Vec<&'static str>,
}

impl<'de, A: MapAccess<'de>> MapAccess<'de> for Keys<'_, A> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, A::Error> {
        while let Some(key) = self.map.next_key_seed(KeySeed { names: &self.names })? {
            self.given.push(key);
            let Some(input) = self.declared.iter().find(|input| input.flag == key) else {
                return seed.deserialize(key.into_deserializer()).map(Some);
            };
            self.inputs.insert(input.flag, self.map.next_value()?);
        }
        Ok(None)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, A::Error> {
        self.map.next_value_seed(seed)
    }
}

/// Reads a key as one of the known names.
struct KeySeed<'a> {
    names: &'a [&'static str],
}

impl<'de> DeserializeSeed<'de> for KeySeed<'_> {
    type Value = &'static str;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<&'static str, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for KeySeed<'_> {
    type Value = &'static str;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the name of an option")
    }

    fn visit_str<E: serde::de::Error>(self, key: &str) -> Result<&'static str, E> {
        let known = self.names.iter().find(|name| **name == key);
        // The names live as long as the program: an error may hold them.
        known.copied().ok_or_else(|| E::unknown_field(key, self.names.to_vec().leak()))
    }
}
