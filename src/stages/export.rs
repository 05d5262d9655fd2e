//! export: the fits of a structure in the files of other risk programs.

use std::path::PathBuf;

use clap::Args;

use super::chosen_fits::ChosenFits;
use super::fits::FitsOptions;
use super::structure_options::StructureOptions;
use super::structures::words;
use crate::export::{self, Function, Model, plain_id};
use crate::fragility::{LimitState, Peak, Slice};
use crate::keyword::keywords;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::{Steps, Word, check};
use crate::table::text_file;

/// To whom, and at which intensities.
#[derive(Debug, Clone, Args)]
pub struct ExportOptions {
    #[command(flatten, next_help_heading = "Fits")]
    fits: FitsOptions,
    #[command(flatten, next_help_heading = "Structure")]
    structure: StructureOptions,
    /// openquake (NRML 0.5), openquake-continuous (the same, overturning alone as a lognormal curve) or pelicun (CSV, and
    /// JSON beside it)
    #[arg(long, help_heading = "Export")]
    to: Word<Program>,
    /// Intensity: pga or pgv
    #[arg(long, default_value = "pga", help_heading = "Export")]
    im: Word<Peak>,
    /// p PGV / PGA of the motions: one function for each of these numbers
    #[arg(long, value_name = "RATIO,...", help_heading = "Export")]
    ratio: Steps,
    /// Intensities of the table, g or m/s, as numbers or first:last:step [default: as many as the tolerance needs]
    #[arg(long, value_name = "IM,...", conflicts_with_all = ["upto", "tolerance"], help_heading = "Export")]
    levels: Option<Steps>,
    /// Largest intensity, g or m/s [default: that of the data; of pelicun, where all probabilities are 1]
    #[arg(long, value_name = "IM", help_heading = "Export")]
    upto: Option<f64>,
    /// Largest error of straight lines between the levels
    #[arg(long, default_value = "1e-6", help_heading = "Export")]
    tolerance: f64,
    /// File to write [default: fragility.xml or fragility.csv]
    #[arg(long, value_name = "FILE", help_heading = "Export")]
    out: Option<PathBuf>,
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

/// Writes the fits of the options for the program that they name.
///
/// # Errors
/// If the fits or the structure cannot be used, an option is out of range, or a file cannot be written.
pub fn export(options: &ExportOptions, console: &Console) -> anyhow::Result<()> {
    let fits = options.fits.choose()?;
    let structure = options.structure.structure(fits.model.eta)?;
    fits.warn_of_eta(&structure, console);
    let (tolerance, upto) = (options.tolerance, options.upto);
    check(tolerance > 0.0 && tolerance < 0.1, "tolerance", tolerance, "an error above 0 and below 0.1")?;
    check(upto.is_none_or(f64::is_finite), "upto", upto.unwrap_or_default(), "a finite intensity")?;
    let functions = options.ratio.values.iter().map(|&ratio| {
        check(ratio > 0.0, "ratio", ratio, "a p PGV / PGA above 0")?;
        let slice = Slice { structure: structure.clone(), peak: options.im.0, ratio };
        options.function(&slice, &fits, console)
    });
    let functions = functions.collect::<anyhow::Result<Vec<Function>>>()?;
    let model = Model {
        id: format!("rockfrag_{}", plain_id(&structure.name)),
        description: format!(
            "rockfrag {}: fits of {}; structure of {}",
            env!("CARGO_PKG_VERSION"),
            fits.words(),
            words(&structure)
        ),
        limit_states: [LimitState::Rocking, LimitState::Failure, LimitState::Overturning]
            .map(|state| fits.meaning(state)),
    };
    let out = |default: &str| options.out.clone().unwrap_or_else(|| PathBuf::from(default));
    let files = match options.to.0 {
        Program::OpenQuake => vec![(out("fragility.xml"), export::discrete(&model, &functions))],
        Program::OpenQuakeContinuous => vec![(out("fragility.xml"), export::continuous(&model, &functions))],
        Program::Pelicun => {
            let (rows, words) = (out("fragility.csv"), export::metadata(&model, &functions));
            let words = serde_json::to_string_pretty(&words)? + "\n";
            vec![(rows.with_extension("json"), words), (rows, export::parameters(&functions)?)]
        }
    };
    for (path, content) in &files {
        text_file::write(path, content)?;
    }
    let paths: Vec<String> = files.iter().map(|(path, _)| path.display().to_string()).collect();
    let levels = functions.iter().map(|function| function.levels.len()).max().unwrap_or(0);
    console.note(&format!(
        "{:20} {} functions, up to {levels} levels: {}",
        "export",
        functions.len(),
        paths.join(", ")
    ));
    Ok(())
}

impl ExportOptions {
    /// One slice, tabulated.
    fn function(&self, slice: &Slice, fits: &ChosenFits, console: &Console) -> anyhow::Result<Function> {
        let model = &fits.model;
        let needs_period = || {
            UsageError::because(
                "these fits do not grow with the peak along a slice, or need the period of each motion: use the bivariate model, or --measure im4 or im5",
            )
        };
        let overturning = slice.overturning(&model.overturning).ok_or_else(needs_period)?;
        let jumps = slice.jumps(model);
        slice.limit_states(model, jumps[0]).ok_or_else(needs_period)?;
        let reaching = |intensity: f64| {
            slice.limit_states(model, intensity).map_or([f64::NAN; 3], |states| states.map(|p| p.value))
        };
        let range_of_data = [jumps[0], slice.largest_in_data(model)];
        let levels = self.levels(&jumps, range_of_data[1], reaching)?;
        let id = plain_id(&format!("{}_ratio{}", slice.structure.name, slice.ratio));
        fits.warn_of_slice(slice, levels[levels.len() - 1], &format!("{id}: "), console);
        let probabilities = levels.iter().map(|&level| reaching(level)).collect();
        Ok(Function { id, peak: slice.peak, levels, probabilities, overturning, range_of_data })
    }

    /// Rising from uplift, m/s2 or m/s.
    fn levels(
        &self,
        jumps: &[f64],
        largest_in_data: f64,
        reaching: impl Fn(f64) -> [f64; 3],
    ) -> anyhow::Result<Vec<f64>> {
        // pelicun knows a whole distribution or none.
        let whole = (self.to.0 == Program::Pelicun)
            .then(|| export::whole_curve_end(jumps[0], self.tolerance, &reaching));
        let end = self.upto.map_or(whole.unwrap_or(largest_in_data), |upto| upto * self.unit());
        let mut levels = match &self.levels {
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
        let last = levels.last().copied().unwrap_or(end);
        levels.extend(whole.filter(|&whole| whole > last));
        let expected = format!("an intensity above uplift, {:.4}", jumps[0] / self.unit());
        check(levels.len() > 1, "the largest intensity", end / self.unit(), &expected)?;
        Ok(levels)
    }

    /// The unit of the options, in m/s2 or m/s.
    fn unit(&self) -> f64 {
        self.im.0.usual_unit().1
    }
}
