//! export: the fits of a structure in the files of other risk programs.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::shared::answers::Answers;
use super::shared::fits::{FIT_INPUTS, FitFiles, FitsOptions, note_fits_of_run};
use super::shared::line::Line;
use super::shared::structure_options::StructureOptions;
use super::shared::structures::{StructureSpec, warn_of_size, words};
use super::shared::surface::{Surface, expect_no_limit};
use crate::export::{self, Function, Model, plain_id};
use crate::fragility::universal::Scenarios;
use crate::fragility::{LimitState, Peak, STRONGEST_PGA_M_S2, doubt_of_ratio};
use crate::keyword::Keyword;
use crate::keyword::keywords;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output, StageOptions};
use crate::pipeline::options::{Steps, Word, check, defaults};
use crate::pipeline::stage::Stage;
use crate::table::TableError;
use crate::table::store::provenance::{Provenance, Recorded};
use crate::table::store::source::{Source, Target};
use crate::table::store::text_file;
use crate::units::G_M_S2;

/// For which program, and at which intensities.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
pub struct ExportOptions {
    #[command(flatten)]
    #[serde(flatten)]
    pub fits: FitsOptions,
    /// Limit state of P_ex by the universal surface: a demand |theta|max / alpha from 0.02 to 0.5 [default: 0.1]
    #[arg(long, value_name = "DEMAND", help_heading = "Fits")]
    pub limit_state: Option<f64>,
    #[command(flatten)]
    #[serde(flatten)]
    pub structure: StructureOptions,
    /// Program to write for: openquake (NRML 0.5), openquake-continuous (the same, with overturning alone as a lognormal curve) or
    /// pelicun (CSV, and JSON beside it)
    #[arg(long, help_heading = "Export")]
    pub to: Option<Word<Program>>,
    /// Intensity of the functions: pga (g) or pgv (m/s)
    #[arg(long, default_value = "pga", help_heading = "Export")]
    pub im: Word<Peak>,
    /// p PGV / PGA of the motions (p in rad/s, PGV in m/s, PGA in m/s2, not g; usually 0.1 to 0.6): one function for each of these
    /// numbers [default: one function, averaged over PGV / PGA given PGA, as evaluate --hazard does]
    #[arg(long, value_name = "RATIO,...", help_heading = "Export")]
    pub ratio: Option<Steps>,
    /// Intensities of the table, g or m/s: first:last:step, or numbers separated by commas [default: as many as --tolerance needs]
    #[arg(long, value_name = "IM,...", conflicts_with_all = ["upto", "tolerance"], help_heading = "Export")]
    pub levels: Option<Steps>,
    /// Largest intensity, g or m/s [default: as in the data, but no more than 4.5 g, the strongest PGA ever recorded; for pelicun,
    /// where all probabilities are 1, but no more than that either]
    #[arg(long, value_name = "IM", help_heading = "Export")]
    pub upto: Option<f64>,
    /// Largest error of linear interpolation between levels [default: 1e-6; for pelicun 1e-5]
    #[arg(long, value_name = "P", help_heading = "Export")]
    pub tolerance: Option<f64>,
}

/// How the name of pelicun's second file ends.
const METADATA: &str = "json";

/// The largest error of lines between levels where nothing else is said.
const TOLERANCE: f64 = 1e-6;

impl Default for ExportOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for ExportOptions {
    fn resolve_paths(&mut self, folder: &Path) {
        self.structure.structures.resolve_path(folder);
    }
}

/// A program that reads fragility.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Program {
    /// OpenQuake, all limit states as tables.
    OpenQuake,
    /// OpenQuake, overturning as a lognormal curve.
    OpenQuakeContinuous,
    /// pelicun.
    Pelicun,
}

keywords!(Program {
    OpenQuake = "openquake",
    OpenQuakeContinuous = "openquake-continuous",
    Pelicun = "pelicun",
});

/// The stage, ready to run.
pub struct Export {
    options: ExportOptions,
    program: Program,
    tolerance: f64,
    /// One function each; none of them stands for all ratios, averaged.
    ratios: Vec<Option<f64>>,
    /// The fits; without them the surface that is shipped.
    fits: Option<FitFiles>,
    structure: StructureSpec,
    out: PathBuf,
}

impl Declare for Export {
    type Options = ExportOptions;
    const NAME: &'static str = "export";
    const ABOUT: &'static str = "Write the fragility of a structure for OpenQuake or pelicun";
    const EXAMPLES: &'static str = "rockfrag export --to openquake --ratio 0.3 --suite csgm --structure electrical-equipment \\
    --p 2.5 --alpha 0.20";
    const HELPS: &'static [(&'static str, &'static str)] = &[(
        "eta",
        "Coefficient of restitution: a number, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions, or as in the fits]",
    )];
    const INPUTS: &'static [Input] = &[FIT_INPUTS[0].if_there(), FIT_INPUTS[1].if_there()];
    const OUTPUT: Output =
        Output::file("fragility.xml", "File to write [default: fragility.xml or fragility.csv]")
            .under("Export");
    const HAS_PROGRESS: bool = false;

    fn create(options: &ExportOptions, files: &Files) -> anyhow::Result<Export> {
        let Some(Word(program)) = options.to else {
            return Err(UsageError::because(
                "expected the program that reads the file: --to openquake, openquake-continuous or pelicun",
            ));
        };
        let ratios = match &options.ratio {
            Some(ratio) => ratio.values.iter().copied().map(Some).collect(),
            None => vec![None],
        };
        for &ratio in ratios.iter().flatten() {
            check(ratio > 0.0, "ratio", ratio, "a p PGV / PGA above 0")?;
        }
        if options.ratio.is_none() && options.im.0 == Peak::Pgv {
            return Err(UsageError::because(
                "functions of PGV are of one p PGV / PGA each: --ratio RATIO,...; only those of PGA are averaged over it",
            ));
        }
        let usual = if program == Program::Pelicun { export::PELICUN_TOLERANCE } else { TOLERANCE };
        let (tolerance, upto) = (options.tolerance.unwrap_or(usual), options.upto);
        check(tolerance > 0.0 && tolerance < 0.1, "tolerance", tolerance, "an error above 0 and below 0.1")?;
        check(
            program != Program::Pelicun || tolerance >= export::PELICUN_TOLERANCE,
            "tolerance",
            tolerance,
            "an error of 1e-5 or more for pelicun, which keeps six digits",
        )?;
        check(upto.is_none_or(f64::is_finite), "upto", upto.unwrap_or_default(), "a finite intensity")?;
        let file = if program == Program::Pelicun { "fragility.csv" } else { Self::OUTPUT.file };
        let Target::Path(out) = files.asked(file).unwrap_or_else(|| file.into()) else {
            return Err(UsageError::because("export writes text; expected the name of a file"));
        };
        let beside = out.extension().filter(|ending| ending.eq_ignore_ascii_case(METADATA));
        if let (Program::Pelicun, Some(_)) = (program, beside) {
            return Err(UsageError::because(format!(
                "out is {}, the name of the JSON that is written beside the functions; expected a name that ends in .csv",
                out.display()
            )));
        }
        Ok(Export {
            options: options.clone(),
            program,
            tolerance,
            ratios,
            fits: FitFiles::if_asked(&options.fits, files)?
                .map(|fits| fits.prefer(options.structure.name.as_deref())),
            structure: options.structure.spec(options.fits.structure.as_deref())?,
            out,
        })
    }
}

impl Export {
    /// The description of pelicun's functions, beside them.
    fn metadata(&self) -> Option<PathBuf> {
        (self.program == Program::Pelicun).then(|| self.out.with_extension(METADATA))
    }
}

impl Stage for Export {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        self.fits.iter().flat_map(FitFiles::inputs).collect()
    }

    fn targets(&self) -> Vec<Target> {
        self.metadata().into_iter().chain([self.out.clone()]).map(Target::Path).collect()
    }

    fn parameters(&self) -> Value {
        let ExportOptions { limit_state, to, im, ratio, levels, upto, .. } = &self.options;
        json!({
            "fits": self.fits.as_ref().map_or(&self.options.fits, |fits| &fits.options), "structure": self.structure, "to": to, "im": im, "ratio": ratio, "levels": levels,
            "upto": upto, "tolerance": self.tolerance, "limit-state": limit_state
        })
    }

    /// Nothing: these files have no place for it.
    fn recorded(&self, output: &Path) -> Result<Option<Recorded>, TableError> {
        if output.exists() {
            return Ok(None);
        }
        Err(TableError::Missing { path: output.to_path_buf(), hint: "run export".to_string() })
    }

    fn is_own_text(&self, head: &str) -> bool {
        export::is_own(head)
    }

    fn execute(&self, _provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let answers: Box<dyn Answers> = match &self.fits {
            Some(fits) => {
                expect_no_limit(self.options.limit_state)?;
                Box::new(fits.choose()?)
            }
            None => {
                let ExportOptions { fits, limit_state, .. } = &self.options;
                Box::new(Surface::new(fits.suite.as_deref(), *limit_state, Scenarios::Many)?)
            }
        };
        let structure = answers.structure(&self.structure)?;
        if self.fits.is_none() {
            note_fits_of_run(&self.options.fits, Some(&structure), console);
        }
        answers.warn(console);
        warn_of_size([&structure], console);
        answers.warn_of_structure(&structure, console);
        let given = self.ratios.iter().copied().flatten();
        given.filter_map(doubt_of_ratio).for_each(|doubt| console.warn(&doubt));
        let functions = self.ratios.iter().map(|&ratio| {
            let line = Line::new(ratio, &structure, self.options.im.0, &*answers)?;
            self.function(&line, ratio, &*answers, console)
        });
        let functions = functions.collect::<anyhow::Result<Vec<Function>>>()?;
        let model = Model {
            id: format!("{}{}", export::OWN_ID, plain_id(&structure.name)),
            description: format!(
                "rockfrag {}: {}; structure of {}",
                env!("CARGO_PKG_VERSION"),
                answers.words(),
                words(&structure)
            ),
            limit_states: LimitState::ALL.iter().map(|&state| answers.meaning(state)).collect(),
        };
        let content = match self.program {
            Program::OpenQuake => export::discrete(&model, &functions),
            Program::OpenQuakeContinuous => export::continuous(&model, &functions),
            Program::Pelicun => export::parameters(&functions)?,
        };
        if let Some(path) = self.metadata() {
            let metadata = serde_json::to_string_pretty(&export::metadata(&model, &functions))? + "\n";
            text_file::write(&path, metadata)?;
        }
        text_file::write(&self.out, content)?;
        let paths: Vec<String> = self.outputs().iter().map(|path| path.display().to_string()).collect();
        let most = functions.iter().map(|function| function.levels.len()).max().unwrap_or(0);
        let levels = match self.program {
            Program::OpenQuake | Program::Pelicun => format!(", up to {most} levels"),
            Program::OpenQuakeContinuous => String::new(),
        };
        Ok(format!("{} functions{levels}: {}", functions.len(), paths.join(", ")))
    }
}

impl Export {
    /// One line, tabulated.
    fn function(
        &self,
        line: &Line,
        ratio: Option<f64>,
        answers: &dyn Answers,
        console: &Console,
    ) -> anyhow::Result<Function> {
        let (model, slice) = (answers.model(), &line.slice);
        let jumps = model.jumps(slice);
        let reaching = |intensity: f64| line.limit_states(model, intensity);
        let strongest = slice.intensity_at_strongest_pga();
        let range_of_data = [jumps[0], model.largest_in_data(slice).min(strongest)];
        if range_of_data[1] <= range_of_data[0] {
            return Err(UsageError::because(format!(
                "ratio {}: with this p PGV / PGA no motion of the data rocks this structure; usually it is 0.1 to 0.6, with p in rad/s, PGV in m/s and PGA in m/s2",
                slice.ratio
            )));
        }
        let overturning = |intensity: f64| reaching(intensity)[2];
        let rises = overturning(jumps[0]) < overturning(range_of_data[1]);
        if !rises {
            return Err(UsageError::because(
                "these fits do not grow with the peak along a slice, or need the period of each motion: use the bivariate model, or --measure im4 or im5",
            ));
        }
        let lognormal = line.lognormal(model);
        if self.program == Program::OpenQuakeContinuous && lognormal.is_none() {
            return Err(UsageError::because(
                "P_ro is not lognormal: it bends, is averaged over the ratio, or is the surface's; expected --to openquake, which takes a table, or --model paper, the straight line, with --ratio",
            ));
        }
        let end = match self.program {
            Program::Pelicun => export::whole_curve_end(jumps[0], self.tolerance, reaching).min(strongest),
            Program::OpenQuake | Program::OpenQuakeContinuous => range_of_data[1],
        };
        let levels = self.levels(&jumps, end, reaching)?;
        let last = levels[levels.len() - 1];
        let ratio = ratio.map_or("_distributed".to_string(), |ratio| ratio.to_string());
        let id = plain_id(&format!("{}{}{ratio}", slice.structure.name, export::OF_RATIO));
        answers.warn_of_slice(slice, last, &format!("{id}: "), console);
        if last > strongest * (1.0 + 1e-9) {
            let ((unit, size), pga_g) = (slice.peak.usual_unit(), STRONGEST_PGA_M_S2 / G_M_S2);
            console.warn(&format!(
                "{id}: up to {:.3e} {unit}, but no PGA above {pga_g} g ({:.4} {unit} here) was ever recorded: use no probability from beyond it",
                last / size,
                strongest / size
            ));
        }
        let probabilities = levels.iter().map(|&level| reaching(level)).collect();
        Ok(Function { id, peak: slice.peak, levels, probabilities, overturning: lognormal, range_of_data })
    }

    /// Rising from uplift, m/s2 or m/s.
    fn levels(
        &self,
        jumps: &[f64],
        usual_end: f64,
        reaching: impl Fn(f64) -> [f64; 3],
    ) -> anyhow::Result<Vec<f64>> {
        let end = self.options.upto.map_or(usual_end, |upto| upto * self.unit());
        let levels: Vec<f64> = match &self.options.levels {
            Some(steps) => {
                let given = steps.values.iter().map(|level| level * self.unit());
                std::iter::once(jumps[0]).chain(given.filter(|&level| level > jumps[0])).collect()
            }
            None => {
                let inner = jumps.iter().copied().filter(|&jump| jump < end);
                let edges: Vec<f64> = inner.chain([end]).collect();
                export::levels(&edges, self.tolerance, &reaching)
            }
        };
        let expected = format!("an intensity above uplift, {:.4}", jumps[0] / self.unit());
        check(levels.len() > 1, "the largest intensity", end / self.unit(), &expected)?;
        Ok(levels)
    }

    /// The unit of the options, in m/s2 or m/s.
    fn unit(&self) -> f64 {
        self.options.im.0.usual_unit().1
    }
}
