//! The fits that evaluate and export start from: which suite, which structure, which model.

use std::collections::BTreeSet;
use std::path::Path;

use clap::Args;
use serde::{Deserialize, Serialize};

use super::chosen_fits::{ChosenFits, Line, Misfit, is_other_eta};
use super::transfers::is_other_block;
use crate::fragility::demand::Form;
use crate::fragility::{DemandModel, FragilityModel, Gap, Measure, has_few_events};
use crate::keyword::{Keyword, keywords};
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, StageOptions};
use crate::pipeline::options::{Word, defaults};
use crate::rocking::Structure;
use crate::stages::fit_pex::FitPex;
use crate::stages::fit_pro::FitPro;
use crate::statistics::FitStatus;
use crate::table::fits::{self, GroupKey, Unusable};
use crate::table::pex::PexRow;
use crate::table::pro::ProRow;
use crate::table::row::ReadRow;
use crate::table::store::source::Source;

/// The inputs of stages that start from fits.
pub const FIT_INPUTS: [Input; 2] = [
    Input::file("pex", "pex", FitPex::OUTPUT.file, "Demand fits, from fit-pex").under("Fits"),
    Input::file("pro", "pro", FitPro::OUTPUT.file, "Overturning curves, from fit-pro").under("Fits"),
];

/// Which fits of the files of fit-pex and fit-pro are asked for.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
#[command(next_help_heading = "Fits")]
pub struct FitsOptions {
    /// Suite of the fits [default: the only one]
    #[arg(long)]
    pub suite: Option<String>,
    /// Structure of the fits [default: the only one]
    #[arg(long)]
    pub structure: Option<String>,
    /// bivariate (two planes over im4 and im3, curve of im4 and im3_inv) or univariate, whose curve bends where tests reject the
    /// straight line; paper (the straight line always; univariate with --measure); or universal (the surface for all structures,
    /// without fits) [default: bivariate; universal where there are no fits, or those found here are of other structures]
    #[arg(long)]
    pub model: Option<Word<ModelForm>>,
    /// Measure of the univariate model, im1 to im6 [default: im5, or the two of paper]
    #[arg(long, value_name = "IM")]
    pub measure: Option<Word<Measure>>,
}

/// Which curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelForm {
    /// Of one measure.
    Univariate,
    /// Of two.
    Bivariate,
    /// Straight lines as in the paper, of two measures or one.
    Paper,
    /// None of one's own: the surface that is shipped.
    Universal,
}

/// The files of fit-pex and fit-pro, and which of their fits are asked for.
#[derive(Debug, Clone)]
pub struct FitFiles {
    pub pex: Source,
    pub pro: Source,
    pub options: FitsOptions,
}

keywords!(ModelForm { Univariate = "univariate", Bivariate = "bivariate", Paper = "paper", Universal = "universal" });

impl Default for FitsOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for FitsOptions {}

/// Tells of fits that could have answered in place of the universal surface, if nobody asked for that.
/// With a structure, only of fits of this one.
pub fn note_fits_of_run(options: &FitsOptions, structure: Option<&Structure>, console: &Console) {
    let can_answer = |row: &ProRow| {
        let is_of = |structure: &Structure| {
            row.block().is_some_and(|block| !is_other_block(block, structure))
                && row.eta.is_some_and(|eta| !is_other_eta(eta, structure.eta))
        };
        row.status.is_usable() && structure.is_none_or(is_of)
    };
    if let (None, Some(flags)) = (options.model, flags_of_run())
        && ProRow::read(Path::new(PRO_OF_RUN)).unwrap_or_default().iter().any(can_answer)
    {
        console.note(&format!("there are fits in out; {flags} uses them instead of the universal surface"));
    }
}

/// The fits of a run from here.
const PEX_OF_RUN: &str = "out/pex.parquet";
const PRO_OF_RUN: &str = "out/pro.parquet";

/// The flags that name the fits of a run from here, if there are any.
fn flags_of_run() -> Option<&'static str> {
    let are_there = [PEX_OF_RUN, PRO_OF_RUN].iter().all(|file| Path::new(file).exists());
    are_there.then_some("--pex out/pex.parquet --pro out/pro.parquet")
}

impl FitFiles {
    /// The fits that are asked for; none where the universal surface is, by its name, or because there are none and nothing is said
    /// of them.
    ///
    /// # Errors
    /// If fits are asked for and there are none.
    pub fn if_asked(options: &FitsOptions, files: &Files) -> anyhow::Result<Option<FitFiles>> {
        let FitsOptions { suite: _, structure, model, measure } = options;
        let unspecified = model.is_none() && structure.is_none() && measure.is_none();
        let none = FIT_INPUTS.iter().all(|input| files.optional(input.role).is_none());
        if *model == Some(Word(ModelForm::Universal)) || (unspecified && none) {
            return Ok(None);
        }
        if none {
            let flags = flags_of_run().unwrap_or("--pex FILE and --pro FILE");
            return Err(UsageError::because(format!(
                "no pex.parquet and pro.parquet here; expected {flags}, or --model universal, which needs no fits"
            )));
        }
        let mut files = files.clone();
        for (role, file, other) in [("pex", FitPex::OUTPUT.file, "pro"), ("pro", FitPro::OUTPUT.file, "pex")]
        {
            if files.optional(role).is_none() {
                let found = files.optional(other).filter(|found| found.name().exists());
                if let Some(found) = found.filter(|_| !Path::new(file).exists()) {
                    return Err(UsageError::because(format!(
                        "found {}, but no {file}; expected --{role} FILE beside it, or --model universal, which needs neither",
                        found.name().display()
                    )));
                }
                files.inputs.push((role, Path::new(file).into()));
            }
        }
        FitFiles::new(options, &files).map(Some)
    }

    /// Why these fits do not answer, if nobody asked for them: they are of other structures than this one, or none could be fitted.
    pub fn why_not(&self, files: &Files, structure: &Structure) -> Option<String> {
        let FitsOptions { suite, structure: name, measure, .. } = &self.options;
        let is_asked = suite.is_some() || name.is_some() || measure.is_some() || files.found.len() < 2;
        let rows = ProRow::read(self.pro.clone()).ok().filter(|_| !is_asked)?;
        let is_of = |row: &ProRow| {
            row.block().is_none_or(|block| !is_other_block(block, structure))
                && row.eta.is_none_or(|eta| !is_other_eta(eta, structure.eta))
        };
        let [pex, pro] = [FitPex::OUTPUT.file, FitPro::OUTPUT.file];
        let of_structure: Vec<&ProRow> = rows.iter().filter(|row| is_of(row)).collect();
        if of_structure.is_empty() {
            let names: BTreeSet<&str> = rows.iter().map(|row| row.structure.as_str()).collect();
            let words = || {
                let names = names.iter().copied().collect::<Vec<_>>().join(", ");
                format!(
                    "{pex} and {pro} here are fits of {names}, not of this structure, so the universal surface answers; --pex {pex} --pro {pro} takes these fits anyway"
                )
            };
            return (!names.is_empty()).then(words);
        }
        let regressions = PexRow::read(self.pex.clone()).ok()?;
        let is_named = |name: &str| of_structure.iter().any(|row| row.structure == name);
        let can_answer = of_structure.iter().any(|row| row.status.is_usable())
            && regressions.iter().any(|row| row.status.is_usable() && is_named(&row.structure));
        (!can_answer).then(|| {
            format!(
                "{pex} and {pro} here have no usable fit of this structure, so the universal surface answers"
            )
        })
    }

    /// Joins the options and the files of a stage.
    ///
    /// # Errors
    /// If there are no such files.
    pub fn new(options: &FitsOptions, files: &Files) -> anyhow::Result<FitFiles> {
        let model = options.model.or(Some(Word(ModelForm::Bivariate)));
        if model == Some(Word(ModelForm::Universal)) {
            return Err(UsageError::because(
                "model universal has no fits; expected bivariate, univariate or paper",
            ));
        }
        let options = FitsOptions { model, ..options.clone() };
        Ok(FitFiles { pex: files.input("pex")?, pro: files.input("pro")?, options })
    }

    /// The files, by the role each plays.
    pub fn inputs(&self) -> [(&'static str, Source); 2] {
        [("pex", self.pex.clone()), ("pro", self.pro.clone())]
    }

    /// Reads the files and chooses.
    ///
    /// # Errors
    /// If a file cannot be read, the choice is open, or there is no such fit.
    pub fn choose(&self) -> anyhow::Result<ChosenFits> {
        let files = self.read()?;
        let asked = self.asked(&files);
        let [group] = &asked[..] else { return Err(self.open_choice(&files, asked)) };
        self.join(&files, group)
    }

    /// The suites and structures that the options leave, in the order of the file, with the fits of each, or why there are none.
    ///
    /// # Errors
    /// If a file cannot be read, or nothing is left.
    pub fn choose_each(&self) -> anyhow::Result<Vec<(GroupKey, anyhow::Result<ChosenFits>)>> {
        let files = self.read()?;
        let asked = self.asked(&files);
        if asked.is_empty() {
            return Err(self.open_choice(&files, asked));
        }
        let joined = |group: GroupKey| {
            let fits = self.join(&files, &group);
            (group, fits)
        };
        Ok(asked.into_iter().map(joined).collect())
    }

    /// Takes the fits of the structure of this name, where none is named and there are some.
    pub fn prefer(mut self, name: Option<&str>) -> FitFiles {
        let are_there = |name: &&str| {
            let rows = ProRow::read(self.pro.clone()).unwrap_or_default();
            rows.iter().any(|row| row.structure == *name)
        };
        if self.options.structure.is_none() {
            self.options.structure = name.filter(are_there).map(str::to_string);
        }
        self
    }

    fn read(&self) -> anyhow::Result<FitRows> {
        Ok(FitRows { regressions: PexRow::read(self.pex.clone())?, curves: ProRow::read(self.pro.clone())? })
    }

    /// The suites and structures that the options leave.
    fn asked(&self, files: &FitRows) -> Vec<GroupKey> {
        let asked = |(suite, structure): &GroupKey| {
            (self.options.suite.is_none() || self.options.suite == *suite)
                && self.options.structure.as_ref().is_none_or(|asked| asked == structure)
        };
        files.groups().into_iter().filter(asked).collect()
    }

    fn open_choice(&self, files: &FitRows, asked: Vec<GroupKey>) -> anyhow::Error {
        let named = [("--suite", &self.options.suite), ("--structure", &self.options.structure)];
        let named = named.into_iter().filter_map(|(flag, name)| Some(format!(" {flag} {}", name.as_ref()?)));
        let none = if asked.is_empty() {
            format!("no fits of{}; ", named.collect::<String>())
        } else {
            String::new()
        };
        let list = if asked.is_empty() { files.groups() } else { asked };
        let words = list.iter().map(|(suite, structure)| match suite {
            Some(suite) => format!("--suite {suite} --structure {structure}"),
            None => format!("--structure {structure}"),
        });
        let words = words.collect::<Vec<_>>().join(", or ");
        UsageError::because(format!(
            "{}: {none}expected the choice of one fit: {words}; or --model universal, the surface for all structures",
            self.pex.name().display()
        ))
    }

    /// All fits of a suite and structure, joined.
    fn join(&self, files: &FitRows, group: &GroupKey) -> anyhow::Result<ChosenFits> {
        let regressions: Vec<&PexRow> =
            files.regressions.iter().filter(|row| row.group() == *group).collect();
        let model = self.options.model.map_or(ModelForm::Bivariate, |word| word.0);
        let (demand, demand_r2, pair) = match (model, self.options.measure) {
            (ModelForm::Universal, _) => unreachable!("the surface has no fits to join"),
            (ModelForm::Bivariate, Some(measure)) => {
                return Err(UsageError::because(format!("measure {measure} needs --model univariate")));
            }
            (ModelForm::Bivariate | ModelForm::Paper, None) => {
                let (demand, r2) = self.biplanar(&regressions)?;
                (demand, r2, (Measure::Im4, Some(Measure::Im3Inverse)))
            }
            (ModelForm::Univariate | ModelForm::Paper, measure) => {
                let measure = measure.map_or(Measure::Im5, |word| word.0);
                let (demand, r2) = self.univariate(&regressions, measure)?;
                (demand, r2, (measure, None))
            }
        };
        let curve = self.curve(files.curves.iter().filter(|row| row.group() == *group), pair)?;
        let Some(eta) = curve.eta else {
            anyhow::bail!("{}: eta is null; expected the output of fit-pro", self.pro.name().display())
        };
        let straight = curve.probit().map_err(|why| in_file(self.pro.name(), &why))?;
        let bent = curve.bent_probit().filter(|_| model != ModelForm::Paper);
        let answer = if bent.is_some() { Line::Bent } else { Line::Straight };
        let overturning = bent.unwrap_or(straight);
        let limit = regressions.first().map_or(f64::NAN, |row| row.limit_state);
        let events = [curve.n_events, curve.n];
        let few_events = has_few_events(curve.n_events, curve.n, overturning.measures().count());
        let model = FragilityModel { demand, limit, overturning, eta };
        let (suite, structure) = group.clone();
        let (misfit, block) = (misfit_of(curve, answer), curve.block());
        Ok(ChosenFits {
            suite,
            structure,
            model,
            resampled: None,
            demand_r2,
            estimator: curve.estimator,
            events,
            few_events,
            few_clusters: curve.clustered_covariance.is_none(),
            aic_per_case: curve.aic.unwrap_or(f64::INFINITY) / curve.n as f64,
            misfit,
            block,
            peaks: curve.peaks(),
        })
    }

    /// The two planes, and their R2.
    fn biplanar(&self, rows: &[&PexRow]) -> anyhow::Result<(DemandModel, Option<f64>)> {
        let planes = fits::planes(rows.iter().copied());
        let any = rows.iter().find(|row| row.model == Form::Biplanar);
        if let (None, Some(PexRow { status, .. })) = (planes, any) {
            return Err(UsageError::because(format!(
                "{}: fit-pex did not find two planes ({}); take --model univariate, --model universal, or fit-pex --transition 1.3",
                self.pex.name().display(),
                status.as_str()
            )));
        }
        let plane = |index: usize, side: &str| {
            let row = planes.map(|planes| (planes[index], planes[index].status));
            found(row, self.pex.name(), &format!("plane {side} the transition"))
        };
        let model = fits::biplanar([plane(0, "below")?, plane(1, "above")?])
            .map_err(|why| in_file(self.pex.name(), &why))?;
        Ok((model, any.and_then(|row| row.r2_overall)))
    }

    /// The regression on a measure, and its R2.
    fn univariate(&self, rows: &[&PexRow], measure: Measure) -> anyhow::Result<(DemandModel, Option<f64>)> {
        let wanted = |row: &&&PexRow| row.model == Form::Univariate && row.im_x == measure;
        let row = rows.iter().find(wanted).map(|row| (*row, row.status));
        let row = found(row, self.pex.name(), &format!("univariate regression on {}", measure.as_str()))?;
        let law = row.demand().map_err(|why| in_file(self.pex.name(), &why))?;
        Ok((DemandModel::Everywhere(law), row.r2))
    }

    fn curve<'r>(
        &self,
        mut rows: impl Iterator<Item = &'r ProRow>,
        (x, y): (Measure, Option<Measure>),
    ) -> anyhow::Result<&'r ProRow> {
        let row = rows.find(|row| row.is_of_overturning() && row.im_x == x && row.im_y == y);
        let second = y.map_or(String::new(), |y| format!(":{}", y.as_str()));
        let what = format!("curve of overturning on {}{second}", x.as_str());
        found(row.map(|row| (row, row.status)), self.pro.name(), &what)
    }
}

/// The rows of both files.
struct FitRows {
    regressions: Vec<PexRow>,
    curves: Vec<ProRow>,
}

impl FitRows {
    /// The suites and structures, in the order in which they first appear.
    fn groups(&self) -> Vec<GroupKey> {
        let mut groups: Vec<GroupKey> = Vec::new();
        for group in self.regressions.iter().map(PexRow::group) {
            if !groups.contains(&group) {
                groups.push(group);
            }
        }
        groups
    }
}

fn misfit_of(curve: &ProRow, answer: Line) -> Option<Misfit> {
    let gap = curve.gap_straight.zip(curve.gap_bent).map(|(straight, bent)| Gap { straight, bent });
    let tests = [
        ("Hosmer-Lemeshow", curve.hosmer_lemeshow_p),
        ("spline", curve.spline_p),
        ("interaction", curve.interaction_p),
    ];
    let tests = tests.into_iter().filter_map(|(test, p)| Some((test, p?))).collect();
    let log_scores = curve.held_out_log_score.zip(curve.bent_held_out_log_score);
    let log_scores = log_scores.map(|(straight, bent)| [straight, bent]);
    (curve.status == FitStatus::Misfit).then_some(Misfit { gap, tests, log_scores, answer })
}

fn in_file(path: &Path, why: &Unusable) -> anyhow::Error {
    anyhow::anyhow!("{}: {why}", path.display())
}

/// The row, if it is there and holds a fit.
fn found<'r, R>(row: Option<(&'r R, FitStatus)>, path: &Path, what: &str) -> anyhow::Result<&'r R> {
    match row {
        Some((row, status)) if status.is_usable() => Ok(row),
        Some((_, status)) => Err(UsageError::because(format!(
            "{}: the {what} is {}; choose a measure whose fit is ok, with --model univariate --measure IM, or --model universal",
            path.display(),
            status.as_str()
        ))),
        None => anyhow::bail!("{}: no {what}; expected the output of fit-pex or fit-pro", path.display()),
    }
}
