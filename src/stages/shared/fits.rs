//! The fits that evaluate and export start from: which suite, which structure, which model.

use std::path::Path;

use clap::Args;
use serde::{Deserialize, Serialize};

use super::chosen_fits::ChosenFits;
use crate::fragility::Event;
use crate::fragility::demand::Form;
use crate::fragility::{DemandModel, FragilityModel, Measure, has_few_events};
use crate::keyword::{Keyword, keywords};
use crate::pipeline::UsageError;
use crate::pipeline::declare::{Declare, Files, Input, StageOptions};
use crate::pipeline::options::{Word, defaults};
use crate::stages::fit_pex::FitPex;
use crate::stages::fit_pro::FitPro;
use crate::table::fits::{self, FitRow};
use crate::table::schema;
use crate::table::store::source::Source;

/// The inputs of stages that start from fits.
pub const FIT_INPUTS: [Input; 2] = [
    Input::file("pex", "pex", FitPex::OUTPUT.file, "Regressions of fit-pex").under("Fits"),
    Input::file("pro", "pro", FitPro::OUTPUT.file, "Curves of fit-pro").under("Fits"),
];

/// Which fits of the files of fit-pex and fit-pro are asked for.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
#[command(next_help_heading = "Fits")]
pub struct FitsOptions {
    /// Suite of the fits [default: the only one; of validate, all]
    #[arg(long)]
    pub suite: Option<String>,
    /// Structure of the fits [default: the only one; of validate, all]
    #[arg(long)]
    pub structure: Option<String>,
    /// bivariate (two planes over im4 and im3, hybrid curve of im4 and im3_inv) or univariate
    #[arg(long, default_value = "bivariate")]
    pub model: Word<ModelForm>,
    /// Measure of the univariate model, im1 to im6 [default: im5]
    #[arg(long, value_name = "IM")]
    pub measure: Option<Word<Measure>>,
}

/// How many measures the curves have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelForm {
    /// One.
    Univariate,
    /// Two.
    Bivariate,
}

/// The files of fit-pex and fit-pro, and which of their fits are asked for.
#[derive(Debug, Clone)]
pub struct FitFiles {
    pub pex: Source,
    pub pro: Source,
    pub options: FitsOptions,
}

keywords!(ModelForm { Univariate = "univariate", Bivariate = "bivariate" });

impl Default for FitsOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for FitsOptions {}

impl FitFiles {
    /// Joins the options and the files of a stage.
    ///
    /// # Errors
    /// If there are no such files.
    pub fn new(options: &FitsOptions, files: &Files) -> anyhow::Result<FitFiles> {
        Ok(FitFiles { pex: files.input("pex")?, pro: files.input("pro")?, options: options.clone() })
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

    /// The fits of each suite and structure that the options leave, in the order of the file; each one, or why there is none.
    ///
    /// # Errors
    /// If a file cannot be read, or nothing is left.
    pub fn choose_each(&self) -> anyhow::Result<Vec<anyhow::Result<ChosenFits>>> {
        let files = self.read()?;
        let asked = self.asked(&files);
        if asked.is_empty() {
            return Err(self.open_choice(&files, asked));
        }
        Ok(asked.iter().map(|group| self.join(&files, group)).collect())
    }

    fn read(&self) -> anyhow::Result<FitRows> {
        Ok(FitRows { regressions: fits::regressions(&self.pex)?, curves: fits::curves(&self.pro)? })
    }

    /// The suites and structures that the options leave.
    fn asked(&self, files: &FitRows) -> Vec<Group> {
        let asked = |(suite, structure): &Group| {
            (self.options.suite.is_none() || self.options.suite == *suite)
                && self.options.structure.as_ref().is_none_or(|asked| asked == structure)
        };
        files.groups().into_iter().filter(asked).collect()
    }

    fn open_choice(&self, files: &FitRows, asked: Vec<Group>) -> anyhow::Error {
        let list = if asked.is_empty() { files.groups() } else { asked };
        let words = list.iter().map(|(suite, structure)| match suite {
            Some(suite) => format!("--suite {suite} --structure {structure}"),
            None => format!("--structure {structure}"),
        });
        let words = words.collect::<Vec<_>>().join(", or ");
        UsageError::because(format!("{}: expected the choice of one fit: {words}", self.pex.name().display()))
    }

    /// All fits of a suite and structure, joined.
    fn join(&self, files: &FitRows, group: &Group) -> anyhow::Result<ChosenFits> {
        let of_group = |row: &&FitRow| group_of(row) == *group;
        let regressions: Vec<&FitRow> = files.regressions.iter().filter(of_group).collect();
        let curves: Vec<&FitRow> = files.curves.iter().filter(of_group).collect();
        let (demand, pair) = match (self.options.model.0, self.options.measure) {
            (ModelForm::Bivariate, Some(measure)) => {
                return Err(UsageError::because(format!("measure {measure} needs --model univariate")));
            }
            (ModelForm::Bivariate, None) => {
                (self.biplanar(&regressions)?, (Measure::Im4, Some(Measure::Im3Inverse)))
            }
            (ModelForm::Univariate, measure) => {
                let measure = measure.map_or(Measure::Im5, |word| word.0);
                (self.univariate(&regressions, measure)?, (measure, None))
            }
        };
        let curve = self.curve(&curves, pair)?;
        let limit = regressions.first().map(|row| row.number(&schema::limit_state));
        let limit = limit.transpose()?.unwrap_or(f64::NAN);
        let model =
            FragilityModel { demand, limit, overturning: curve.probit()?, eta: curve.number(&schema::eta)? };
        let (suite, structure) = group.clone();
        let (n, events) = (curve.number(&schema::n)?, curve.number(&schema::n_events)?);
        let few_events = has_few_events(events as usize, n as usize, model.overturning.measures().count());
        Ok(ChosenFits { suite, structure, model, resampled: None, few_events })
    }

    fn biplanar(&self, rows: &[&FitRow]) -> anyhow::Result<DemandModel> {
        let planes = || rows.iter().filter(|row| row.text(&schema::model) == Some(Form::Biplanar.as_str()));
        let plane = |below: bool, side: &str| -> anyhow::Result<&FitRow> {
            let mut on_side =
                planes().filter(|row| row.optional_number(&schema::range_high).is_some() == below);
            found(on_side.next().copied(), self.pex.name(), &format!("plane {side} the transition"))
        };
        let (low, high) = (plane(true, "below")?, plane(false, "above")?);
        let transition = high.number(&schema::range_low)?;
        Ok(DemandModel::Biplanar { transition, low: low.demand()?, high: high.demand()? })
    }

    fn univariate(&self, rows: &[&FitRow], measure: Measure) -> anyhow::Result<DemandModel> {
        let mut rows = rows.iter().filter(|row| row.text(&schema::model) == Some(Form::Univariate.as_str()));
        let row = rows.find(|row| row.text(&schema::im_x) == Some(measure.as_str()));
        let row =
            found(row.copied(), self.pex.name(), &format!("univariate regression on {}", measure.as_str()))?;
        Ok(DemandModel::Everywhere(row.demand()?))
    }

    fn curve<'a>(
        &self,
        rows: &[&'a FitRow],
        (x, y): (Measure, Option<Measure>),
    ) -> anyhow::Result<&'a FitRow> {
        let wanted = |row: &&&FitRow| {
            row.text(&schema::fitted_event) == Some(Event::Overturning.as_str())
                && row.text(&schema::im_x) == Some(x.as_str())
                && row.text(&schema::im_y) == y.map(Keyword::as_str)
        };
        let second = y.map_or(String::new(), |y| format!(":{}", y.as_str()));
        let what = format!("curve of overturning on {}{second}", x.as_str());
        found(rows.iter().find(wanted).copied(), self.pro.name(), &what)
    }
}

/// The rows of both files.
struct FitRows {
    regressions: Vec<FitRow>,
    curves: Vec<FitRow>,
}

impl FitRows {
    /// The suites and structures, in the order in which they first appear.
    fn groups(&self) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for group in self.regressions.iter().map(group_of) {
            if !groups.contains(&group) {
                groups.push(group);
            }
        }
        groups
    }
}

/// A suite and a structure.
type Group = (Option<String>, String);

fn group_of(row: &FitRow) -> Group {
    let structure = row.text(&schema::structure).unwrap_or_default().to_string();
    (row.text(&schema::suite).map(str::to_string), structure)
}

/// The row, if it is there and holds a fit.
fn found<'a>(row: Option<&'a FitRow>, path: &Path, what: &str) -> anyhow::Result<&'a FitRow> {
    match row {
        Some(row) if row.is_ok() => Ok(row),
        Some(row) => Err(UsageError::because(format!(
            "{}: the {what} is {}; choose a measure whose fit is ok",
            path.display(),
            row.status()
        ))),
        None => anyhow::bail!("{}: no {what}; expected the output of fit-pex or fit-pro", path.display()),
    }
}
