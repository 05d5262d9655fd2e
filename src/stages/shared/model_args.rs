//! The options that select a model, the fits that they name, and the model of a structure.

use std::collections::HashSet;
use std::path::PathBuf;

use anyhow::bail;
use clap::Args;
use clap::ValueHint::DirPath;
use rockfrag_core::fragility::{
    Calibration, CurveFit, DemandFit, DemandModel, Event, Measure, Model, MotionKind,
};
use rockfrag_core::motion::Suite;
use rockfrag_core::object::{Object, RockingObject};
use rockfrag_core::rocking::Structure;
use rockfrag_core::spelling::unknown_word;
use rockfrag_core::warning::Warning;
use serde::{Deserialize, Serialize};

use crate::number::listed;
use crate::pipeline::UsageError;
use crate::pipeline::options::{Rule, number};
use crate::pipeline::paths::Read;
use crate::stages::shared::fit_tables::{suite_name, verdict};
use crate::stages::shared::objects::named;
use crate::table::TableError;
use crate::table::rows::{self, Row};

/// The model that predicts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<ModelName>)]
pub enum ModelName {
    /// The universal surface, calibrated where there are fits.
    Calibrated,
    /// The two planes and the lognormal curve of the paper.
    Paper,
}

#[derive(Debug, Clone, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(next_help_heading = "Model")]
pub struct ModelArgs {
    /// Folder of fits, from fit-pex and fit-pro [default: the universal surface as shipped]
    #[arg(long, value_name = "DIR", value_hint = DirPath)]
    pub fits: Option<PathBuf>,
    /// Which structure of the fits to use [default: the one with the same p, alpha and eta]
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Kind of motion: recorded, csgm, pulse or hfc [default: the kind of the fits, else recorded]
    #[arg(long, value_name = "KIND")]
    pub suite: Option<MotionKind>,
    /// calibrated (the surface, by the fits) or paper (its planes and hybrid curve)
    #[arg(long, default_value = "calibrated")]
    pub model: ModelName,
    /// Limit state, as demand |theta|max / alpha
    #[arg(long, value_name = "DEMAND", default_value = "0.1",
          value_parser = number(1e-6..=1.0, "a demand |theta|max / alpha above 0 and up to 1, such as 0.1"))]
    pub limit_state: f64,
}

/// Fits, and the surface where there are none.
#[derive(Debug, Clone)]
pub struct Models {
    pub args: ModelArgs,
    overturning: Vec<Calibration>,
    exceeding: Vec<Calibration>,
    curves: Vec<CurveFit>,
    demand: Vec<DemandFit>,
}

impl ModelArgs {
    pub const RULES: [Rule; 1] = [Rule::Needs(&["name"], &["fits"])];

    /// Checks that there are fits where these alone predict.
    pub fn check(&self) -> anyhow::Result<()> {
        match self.model == ModelName::Paper && self.fits.is_none() {
            true => Err(UsageError::because("model is paper; expected its fits, too: --fits")),
            false => Ok(()),
        }
    }

    /// The files of the fits that the model reads.
    fn files(&self) -> &'static [&'static str] {
        const FILES: [&str; 4] =
            ["pro.calibration.parquet", "pex.calibration.parquet", "pro.parquet", "pex.parquet"];
        if self.model == ModelName::Paper { &FILES } else { &FILES[..2] }
    }

    pub fn input(&self) -> Read {
        let files =
            self.fits.iter().flat_map(|folder| self.files().iter().map(move |name| folder.join(name)));
        // Fits to what stood and what fell have none of demands.
        Read { optional: true, ..Read::new("fits", files) }
    }

    /// Reads the fits, if there are any.
    pub fn read(&self) -> anyhow::Result<Models> {
        fn read<R: Row>(folder: Option<&PathBuf>, name: &str) -> Result<Vec<R>, TableError> {
            folder.map_or(Ok(Vec::new()), |folder| rows::read(&folder.join(name)))
        }
        let fits = self.fits.as_ref();
        let for_paper = fits.filter(|_| self.model == ModelName::Paper);
        let overturning: Vec<Calibration> = read(fits, "pro.calibration.parquet")?;
        // What stood and what fell tells nothing of demands.
        let with_demand = fits.filter(|_| !overturning.iter().all(Calibration::is_of_outcomes));
        Ok(Models {
            overturning,
            exceeding: read(with_demand, "pex.calibration.parquet")?,
            curves: read(for_paper, "pro.parquet")?,
            demand: read(for_paper, "pex.parquet")?,
            args: self.clone(),
        })
    }
}

impl Models {
    /// Joins an object with the model of each of its directions, and returns the warnings about these models.
    pub fn rocking_object(&self, object: &Object) -> anyhow::Result<(RockingObject, Vec<Warning>)> {
        let (mut models, mut warnings) = (Vec::new(), Vec::new());
        for side in object.sides().map_err(|reason| named(object, &reason))? {
            let (model, about) = self.model(&side.structure)?;
            warnings.extend(about);
            models.push(model);
        }
        if object.place.floor().is_ok_and(|floor| floor.is_some()) {
            self.expect_ground()?;
        }
        Ok((RockingObject::new(object, models).map_err(|reason| named(object, &reason))?, warnings))
    }

    /// The model for a structure: that of the fitted structure of the same p, alpha and eta, or of the one
    /// named; without one, the surface, with a warning if there are fits.
    pub fn model(&self, structure: &Structure) -> anyhow::Result<(Model, Vec<Warning>)> {
        let ModelArgs { limit_state, suite, model, .. } = self.args;
        let Some(overturning) = self.fit(structure)? else {
            if model == ModelName::Paper {
                let (folder, name, names) = (self.folder(), &structure.name, self.names());
                bail!(
                    "{folder}: no structure like '{name}' (p, alpha and eta within 1 %); expected one of \
                     {names} by --name"
                );
            }
            let all: Vec<&Calibration> = self.overturning.iter().collect();
            let kind = match suite {
                Some(kind) => kind,
                None if all.is_empty() => MotionKind::Recorded,
                None => self.kind(&all)?,
            };
            let warning = self.args.fits.as_ref().map(|_| Warning::NotFitted);
            return Ok((Model::uncalibrated(kind, structure, limit_state), warning.into_iter().collect()));
        };
        let exceeding = self.exceeding(overturning, structure)?;
        let model = match model {
            ModelName::Calibrated => {
                Model::Surface { overturning: overturning.clone(), exceeding, floor: None }
            }
            ModelName::Paper => {
                let planes = self.demand.iter().filter(|fit| fit.model == DemandModel::Biplanar);
                Model::Paper {
                    demand: planes.filter(|fit| fit.group() == overturning.group()).cloned().collect(),
                    overturning: self.curve(overturning)?,
                    limit_state,
                    peaks: overturning.peaks(),
                }
            }
        };
        let is_other = self.args.name.is_some()
            && !overturning.is_of_outcomes()
            && !structure.is_like(&structure_of(overturning));
        let warnings =
            [(overturning.n == 0).then_some(Warning::NotFitted), is_other.then_some(Warning::OtherStructure)];
        Ok((model, warnings.into_iter().flatten().collect()))
    }

    /// All fitted structures, or the one named.
    pub fn structures(&self) -> anyhow::Result<Vec<Structure>> {
        let mut structures: Vec<Structure> = self.overturning.iter().map(structure_of).collect();
        structures.retain(|structure| self.args.name.as_ref().is_none_or(|name| *name == structure.name));
        let mut known = HashSet::new();
        structures.retain(|structure| known.insert(structure.name.clone()));
        match (&self.args.name, structures.is_empty()) {
            (_, false) => Ok(structures),
            (Some(name), true) => Err(self.not_fitted(name)),
            (None, true) => Err(self.refuse("no fits of overturning; run fit-pro")),
        }
    }

    /// Refuses fits to motions of a floor, whose intensity measures are those of the floor.
    pub fn expect_ground(&self) -> anyhow::Result<()> {
        match self.overturning.iter().any(|row| Suite::is_floor(row.suite.as_deref())) {
            true => Err(self.refuse(
                "fits to motions of a floor; expected fits to motions of the ground, with period and level",
            )),
            false => Ok(()),
        }
    }

    fn refuse(&self, problem: &str) -> anyhow::Error {
        UsageError::because(format!("{}: {problem}", self.folder()))
    }

    fn folder(&self) -> String {
        self.args.fits.as_ref().map_or(String::new(), |folder| folder.display().to_string())
    }

    fn names(&self) -> String {
        let mut names: Vec<&str> = self.overturning.iter().map(|row| row.structure.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        listed(&names, 8)
    }

    fn not_fitted(&self, name: &str) -> anyhow::Error {
        self.refuse(&format!("no structure '{name}'; expected one of {}", self.names()))
    }

    /// The fit of the structure that is named, or else is like one, to its kind of motion.
    fn fit(&self, structure: &Structure) -> anyhow::Result<Option<&Calibration>> {
        let name = self.args.name.as_ref().or_else(|| {
            let is_like = |row: &&Calibration| row.is_of_outcomes() || structure.is_like(&structure_of(row));
            let mut like = self.overturning.iter().filter(is_like);
            let row = like.clone().find(|row| row.structure == structure.name).or_else(|| like.next());
            row.map(|row| &row.structure)
        });
        let Some(name) = name else { return Ok(None) };
        let mut rows: Vec<&Calibration> = self.overturning.iter().collect();
        rows.retain(|row| row.structure == *name);
        if rows.is_empty() {
            return Err(self.not_fitted(name));
        }
        let kind = self.kind(&rows)?;
        rows.retain(|row| row.kind == kind);
        match rows.iter().find(|row| row.suite != rows[0].suite) {
            None => Ok(Some(rows[0])),
            Some(other) => Err(self.refuse(&format!(
                "fits of {} and {}; run fit-pex and fit-pro on the responses of one suite",
                suite_name(&rows[0].suite),
                suite_name(&other.suite)
            ))),
        }
    }

    /// Returns the requested kind of motion, or the only one of rows.
    fn kind(&self, rows: &[&Calibration]) -> anyhow::Result<MotionKind> {
        let mut kinds: Vec<&str> = rows.iter().map(|row| row.kind.into()).collect();
        kinds.sort_unstable();
        kinds.dedup();
        let names = kinds.join(", ");
        match self.args.suite {
            Some(kind) if rows.iter().any(|row| row.kind == kind) => Ok(kind),
            Some(kind) => Err(self.refuse(&format!("no fits of {kind}, only of {names}"))),
            None if kinds.len() == 1 => Ok(rows[0].kind),
            None => Err(self.refuse(&format!("fits of {names}; expected --suite with one of them"))),
        }
    }

    /// The row of P_ex beside one of P_ro; outcomes tell nothing of demands.
    fn exceeding(&self, overturning: &Calibration, structure: &Structure) -> anyhow::Result<Calibration> {
        let limit_state = self.args.limit_state;
        if overturning.is_of_outcomes() {
            return Ok(Calibration::uncalibrated(overturning.kind, structure, Some(limit_state)));
        }
        let rows = self.exceeding.iter().filter(|row| row.group() == overturning.group());
        let mut limits = rows.clone().filter_map(|row| Some((row, row.limit_state?)));
        let (folder, name) = (self.folder(), &overturning.structure);
        if let Some((row, _)) = limits.find(|(_, other)| (other - limit_state).abs() <= 1e-9 * limit_state) {
            // Fits to the same responses have the same PGV/PGA, to the last bit.
            if row.ratio_given_pga != overturning.ratio_given_pga {
                bail!(
                    "{folder}: P_ex and P_ro of '{name}' are of different responses; run fit-pex and \
                     fit-pro on one file"
                );
            }
            return Ok(row.clone());
        }
        let mut fitted: Vec<f64> = rows.filter_map(|row| row.limit_state).collect();
        let found = if fitted.is_empty() { "none".to_string() } else { listed(&fitted, 8) };
        fitted.push(limit_state);
        bail!(
            "{folder}: P_ex of '{name}' has limit states {found}, not {limit_state}; run fit-pex \
             --limit-state {}",
            listed(&fitted, usize::MAX).replace(", ", ",")
        )
    }

    /// The paper's curve of the hybrid measure of its worked example; where that has no fit, of IM5.
    fn curve(&self, row: &Calibration) -> anyhow::Result<CurveFit> {
        let curves = self.curves.iter().filter(|fit| fit.event == Event::Overturning);
        let curves: Vec<&CurveFit> = curves.filter(|fit| fit.group() == row.group()).collect();
        let over = [(Measure::Im4, Some(Measure::Im3Inverse)), (Measure::Im5, None)];
        let fits = over
            .iter()
            .filter_map(|over| curves.iter().find(|fit| (&fit.im_x, &fit.im_y) == (&over.0, &over.1)));
        let fits: Vec<&CurveFit> = fits.copied().collect();
        if let Some(usable) = fits.iter().find(|fit| fit.status.is_usable()) {
            return Ok((*usable).clone());
        }
        let (folder, structure) = (self.folder(), &row.structure);
        let status = fits.first().map_or("missing".to_string(), |fit| verdict(fit.status));
        bail!(
            "{folder}: the paper's curve of '{structure}' has the status '{status}'; use --model calibrated"
        )
    }
}

/// The structure that a row is about.
fn structure_of(Calibration { structure: name, p_rad_s, alpha_rad, eta, .. }: &Calibration) -> Structure {
    Structure { name: name.clone(), p_rad_s: *p_rad_s, alpha_rad: *alpha_rad, eta: *eta }
}
