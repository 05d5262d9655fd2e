//! The command line: arguments only, and which stage they call.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};

use crate::pipeline::console::Console;
use crate::pipeline::options::{Parsed, resolve};
use crate::pipeline::stage::{Stage, beside};
use crate::pipeline::terminal::Terminal;
use crate::pipeline::{UsageError, cache};
use crate::stages::compare_paper::{ComparePaper, ComparePaperOptions};
use crate::stages::config::Config;
use crate::stages::evaluate::{EvaluateOptions, evaluate};
use crate::stages::export::{ExportOptions, export};
use crate::stages::fit_pex::{FitPex, FitPexOptions};
use crate::stages::fit_pro::{FitPro, FitProOptions};
use crate::stages::ida::{Ida, IdaOptions};
use crate::stages::import_motions::{ImportMotions, ImportMotionsOptions};
use crate::stages::inspect::inspect;
use crate::stages::partitions::{each_file, file_of};
use crate::stages::rank_ims::{RankIms, RankImsOptions};
use crate::stages::report::{Report, ReportOptions};
use crate::stages::run::{Files, dry_run, run, stages};
use crate::stages::sample_scenarios::{SampleScenarios, SampleScenariosOptions};
use crate::stages::seed_spread::{SeedSpreadOptions, seed_spread};
use crate::stages::simulate::{Simulate, SimulateOptions};
use crate::stages::synthesize_motions::{SynthesizeMotions, SynthesizeMotionsOptions};
use crate::stages::universality::{self, Universality, UniversalityOptions};
use crate::stages::validate::{Validate, ValidateOptions};
use crate::table::{ida, paper, ranking_verdict, validation};

/// Dimensionless fragility curves for rocking structures in near-fault earthquakes
#[derive(Debug, Parser)]
#[command(name = "rockfrag", version, max_term_width = 100)]
struct Cli {
    #[command(flatten)]
    common: Common,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Args)]
struct Common {
    /// Pipeline file whose options hold where no flag is given
    #[arg(long, global = true, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Threads [default: all cores]
    #[arg(long, global = true, value_name = "N")]
    threads: Option<usize>,
    /// Say nothing but errors and results
    #[arg(long, global = true)]
    quiet: bool,
    /// Progress bars on a terminal
    #[arg(long, global = true, default_value = "auto")]
    progress: Progress,
    /// Run even what is up to date
    #[arg(long, global = true)]
    force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Progress {
    Auto,
    Never,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Sample earthquake scenarios on a magnitude-distance grid
    SampleScenarios {
        /// Scenarios file to write
        #[arg(long, default_value = "scenarios.parquet")]
        out: PathBuf,
        #[command(flatten)]
        options: SampleScenariosOptions,
    },
    /// Synthesize near-fault ground motions: coherent pulse and stochastic high frequencies
    SynthesizeMotions {
        /// Scenarios to read
        #[arg(long = "in", value_name = "FILE", default_value = "scenarios.parquet")]
        input: PathBuf,
        /// Motions file to write, or folder of partitions [default: motions.parquet beside the input, motions of partitions]
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        options: SynthesizeMotionsOptions,
    },
    /// Import recorded ground motions from the files of strong-motion networks, CSV or Parquet
    ImportMotions {
        /// Motions file to write
        #[arg(long, default_value = "motions.parquet")]
        out: PathBuf,
        #[command(flatten)]
        options: ImportMotionsOptions,
    },
    /// Simulate the rocking response of structures to motions
    Simulate {
        /// Motions to read, a file or a folder: ours, or anyone's with motion_id, dt_s and acceleration_m_s2
        #[arg(long = "in", value_name = "FILE", default_value = "motions.parquet")]
        input: PathBuf,
        /// Responses file to write, or folder of partitions [default: responses.parquet beside the input, responses of
        /// partitions]
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        options: SimulateOptions,
    },
    /// Incremental dynamic analysis: at which intensities of each motion each structure overturns, and which larger ones it
    /// survives
    Ida {
        /// Motions to read, as simulate does
        #[arg(long = "in", value_name = "FILE", default_value = "motions.parquet")]
        input: PathBuf,
        /// File of overturning intensities to write; NAME.stripes, NAME.windows, NAME.shares and NAME.fragility stand beside it
        /// [default: ida.parquet beside the input]
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        options: IdaOptions,
    },
    /// Fit the demand in safe rocking: P_ex
    FitPex {
        /// Responses to read
        #[arg(long = "in", value_name = "FILE", default_value = "responses.parquet")]
        input: PathBuf,
        /// Fits to write [default: pex.parquet beside the input]
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        options: FitPexOptions,
    },
    /// Fit the probability of overturning: P_ro
    FitPro {
        /// Responses to read
        #[arg(long = "in", value_name = "FILE", default_value = "responses.parquet")]
        input: PathBuf,
        /// Fits to write [default: pro.parquet beside the input]
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        options: FitProOptions,
    },
    /// Rank intensity measures, alone, in pairs and triples, by how well they predict unseen cells or earthquakes
    ///
    /// Besides im1 to im6 of the paper, the measures of --motions, made dimensionless with p and g tan alpha: p D of the
    /// significant durations (d5_75, d5_95); p^2 PGD / (g tan alpha) (pgd), the same of the Housner intensity (housner);
    /// p CAV / (g tan alpha) (cav); p times the integral of a^2 / (g tan alpha)^2 (arias); Sa / (g tan alpha) (sa_0p50 is that at
    /// 0.5 s). Measures enter as a product, each to a power that the fit finds. PGA, PGV, Tm and Tp are those of im1 to im6.
    RankIms {
        /// Responses to read
        #[arg(long = "in", value_name = "FILE", default_value = "responses.parquet")]
        input: PathBuf,
        /// Motions that the responses are to, for their further measures
        #[arg(long, value_name = "FILE")]
        motions: Option<PathBuf>,
        /// Ranking to write [default: ranking.parquet beside the input]
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        options: RankImsOptions,
    },
    /// Hold our numbers against the published ones
    ComparePaper {
        /// Regressions of fit-pex
        #[arg(long, default_value = "pex.parquet")]
        pex: PathBuf,
        /// Curves of fit-pro
        #[arg(long, default_value = "pro.parquet")]
        pro: PathBuf,
        /// Responses that both were fitted to
        #[arg(long, default_value = "responses.parquet")]
        responses: PathBuf,
        /// Comparison file to write [default: paper.parquet beside the regressions]
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        options: ComparePaperOptions,
    },
    /// Probabilities of rocking, failure and overturning: at one intensity, at each of a table, or a year at a site
    Evaluate(Box<EvaluateOptions>),
    /// Hold fits against responses they were not made from, such as those to records: counts seen and expected, scores
    Validate(Box<ValidateOptions>),
    /// How universal the curves of one structure are: held against the responses of all others to the same motions
    Universality {
        /// Responses of all structures to read
        #[arg(long = "in", value_name = "FILE", default_value = "responses.parquet")]
        input: PathBuf,
        /// File to write [default: universality.parquet beside the input]
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        options: UniversalityOptions,
    },
    /// Write the fragility of a structure for OpenQuake or pelicun
    Export(Box<ExportOptions>),
    /// Draw all that a folder of files holds: one page to open in a browser, and each figure as SVG and PNG
    Report {
        /// Folder of the files: responses.parquet, and what else there is of them
        #[arg(long = "in", value_name = "DIR", default_value = "out")]
        input: PathBuf,
        /// Page to write; its figures go into a folder of the same name [default: report.html in the input]
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        options: ReportOptions,
    },
    /// Run all stages of a pipeline file, skipping what is up to date
    Run {
        /// The pipeline file
        #[arg(default_value = "pipeline.yaml")]
        pipeline: PathBuf,
        /// Folder of all files [default: as the pipeline file says, or out beside it]
        #[arg(long)]
        out: Option<PathBuf>,
        /// Seed of all stages
        #[arg(long)]
        seed: Option<u64>,
        /// Only print the resolved plan, and why each stage would or would not run
        #[arg(long)]
        dry_run: bool,
    },
    /// Repeat the pipeline over seeds, to see how far its numbers move by chance
    SeedSpread {
        /// The pipeline file
        #[arg(default_value = "pipeline.yaml")]
        pipeline: PathBuf,
        #[command(flatten)]
        options: SeedSpreadOptions,
    },
    /// Show what a file holds and where it came from
    Inspect {
        /// A Parquet file
        file: PathBuf,
    },
}

/// Parses the command line and does what it says.
///
/// # Errors
/// Those of the stage that was called; [`UsageError`] for a mistake in the call.
pub fn main() -> anyhow::Result<()> {
    let matches = Cli::command().get_matches();
    let Cli { common, command } = Cli::from_arg_matches(&matches)?;
    let console =
        Console { quiet: common.quiet, progress: common.progress == Progress::Auto, follower: None };
    if let Some(threads) = common.threads {
        if threads == 0 {
            return Err(UsageError::because("threads is 0; expected 1 or more"));
        }
        rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    }
    let config = common.config.as_deref().map(Config::read).transpose()?.unwrap_or_default();
    let (_, flags) = matches.subcommand().ok_or_else(|| UsageError::because("no subcommand"))?;
    let call = Call { config, flags, force: common.force, console };
    call.dispatch(command)
}

/// A subcommand with what it needs of the command line.
struct Call<'a> {
    config: Config,
    flags: &'a ArgMatches,
    force: bool,
    console: Console,
}

impl Call<'_> {
    fn dispatch(&self, command: Command) -> anyhow::Result<()> {
        match command {
            Command::SampleScenarios { out, .. } => {
                let mut options: SampleScenariosOptions =
                    resolve(self.flags, self.config.sample_scenarios.as_ref())?;
                options.seed = options.seed.or(self.config.seed);
                self.stage(&SampleScenarios::new(&options, out)?)
            }
            Command::SynthesizeMotions { input, out, .. } => {
                let mut options: SynthesizeMotionsOptions =
                    resolve(self.flags, self.config.synthesize_motions.as_ref())?;
                options.seed = options.seed.or(self.config.seed);
                let partition = options.partition.map(|Parsed(partition)| partition);
                let out = file_of(out.as_deref(), &input, "motions", partition);
                self.stage(&SynthesizeMotions::new(&options, input, out)?)
            }
            Command::ImportMotions { out, .. } => {
                let options = resolve(self.flags, self.config.import_motions.as_ref())?;
                self.stage(&ImportMotions::new(&options, out)?)
            }
            Command::Simulate { input, out, .. } => {
                let mut options: SimulateOptions = resolve(self.flags, self.config.simulate.as_ref())?;
                // One structure in flags wins over those of the file.
                if self.one_structure_is_given() {
                    options.structures = None;
                }
                if let Some(stages) = each_file(&options, &input, out.as_deref())? {
                    return stages.iter().try_for_each(|stage| self.stage(stage));
                }
                let partition = options.partition.map(|Parsed(partition)| partition);
                let out = file_of(out.as_deref(), &input, "responses", partition);
                self.stage(&Simulate::new(&options, input, out)?)
            }
            Command::Ida { input, out, .. } => {
                let mut options: IdaOptions = resolve(self.flags, self.config.ida.as_ref())?;
                if self.one_structure_is_given() {
                    options.structures = None;
                }
                let out = out.unwrap_or_else(|| beside(&input, "ida.parquet"));
                self.stage(&Ida::new(&options, input, out.clone())?)?;
                print(&ida::show(&Ida::fragility_path(&out))?)
            }
            Command::FitPex { input, out, .. } => {
                let mut options: FitPexOptions = resolve(self.flags, self.config.fit_pex.as_ref())?;
                options.seed = options.seed.or(self.config.seed);
                let out = out.unwrap_or_else(|| beside(&input, "pex.parquet"));
                self.stage(&FitPex::new(&options, input, out)?)
            }
            Command::FitPro { input, out, .. } => {
                let mut options: FitProOptions = resolve(self.flags, self.config.fit_pro.as_ref())?;
                options.seed = options.seed.or(self.config.seed);
                let out = out.unwrap_or_else(|| beside(&input, "pro.parquet"));
                self.stage(&FitPro::new(&options, input, out)?)
            }
            Command::RankIms { input, motions, out, .. } => {
                let options = resolve(self.flags, self.config.rank_ims.as_ref())?;
                let out = out.unwrap_or_else(|| beside(&input, "ranking.parquet"));
                self.stage(&RankIms::new(&options, input, motions, out.clone())?)?;
                print(&ranking_verdict::show(&out)?)
            }
            Command::ComparePaper { pex, pro, responses, out, .. } => {
                let options = resolve(self.flags, self.config.compare_paper.as_ref())?;
                let out = out.unwrap_or_else(|| beside(&pex, "paper.parquet"));
                self.stage(&ComparePaper::new(&options, [pex, pro, responses], out.clone())?)?;
                print(&Terminal::stdout().table(&paper::show(&out)?))
            }
            Command::Evaluate(options) => print(&evaluate(&options, self.force, &self.console)?),
            Command::Validate(options) => {
                let out = options.out.clone();
                let out = out.unwrap_or_else(|| beside(&options.input, "validation.parquet"));
                self.stage(&Validate::new(&options, out.clone())?)?;
                print(&Terminal::stdout().table(&validation::show(&out)?))
            }
            Command::Report { input, out, .. } => {
                let options = resolve(self.flags, self.config.report.as_ref())?;
                let out = out.unwrap_or_else(|| input.join("report.html"));
                self.stage(&Report::new(&options, input, out)?)
            }
            Command::Universality { input, out, .. } => {
                let options = resolve(self.flags, self.config.universality.as_ref())?;
                let out = out.unwrap_or_else(|| beside(&input, "universality.parquet"));
                self.stage(&Universality::new(&options, input, out.clone())?)?;
                print(&universality::show(&out)?)
            }
            Command::Export(options) => export(&options, &self.console),
            Command::Run { pipeline, out, seed, dry_run } => self.run(&pipeline, out, seed, dry_run),
            Command::SeedSpread { pipeline, options } => {
                let console = Console { progress: false, ..self.console.clone() };
                seed_spread(&Config::read(&pipeline)?, &options, &console)
            }
            Command::Inspect { file } => print(&inspect(&file, &Terminal::stdout())?),
        }
    }

    fn run(&self, pipeline: &Path, out: Option<PathBuf>, seed: Option<u64>, dry: bool) -> anyhow::Result<()> {
        let config = Config::read(pipeline)?;
        let config = seed.map_or(config.clone(), |seed| config.with_seed(seed));
        let folder =
            out.unwrap_or_else(|| beside(pipeline, "").join(config.out.clone().unwrap_or("out".into())));
        let files = Files::in_folder(&folder);
        let stages = stages(&config, &files)?;
        if stages.is_empty() {
            return Err(UsageError::because(format!(
                "{}: no stage; expected at least one",
                pipeline.display()
            )));
        }
        if dry {
            return print(&dry_run(&stages, self.force)?);
        }
        run(&stages, self.force, &self.console)?;
        if config.compare_paper.is_some() {
            print(&Terminal::stdout().table(&paper::show(&files.paper)?))?;
        }
        if config.universality.is_some() { print(&universality::show(&files.universality)?) } else { Ok(()) }
    }

    fn stage(&self, stage: &dyn Stage) -> anyhow::Result<()> {
        cache::run_alone(stage, self.force, &self.console)
    }

    fn one_structure_is_given(&self) -> bool {
        let given = |flag: &&str| self.flags.value_source(flag) == Some(ValueSource::CommandLine);
        ["p", "alpha", "eta"].iter().any(given)
    }
}

/// To stdout; a reader that has seen enough (`| head`) is no error.
fn print(text: &str) -> anyhow::Result<()> {
    match std::io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        done => Ok(done?),
    }
}
