//! The options that select a model, the fits that they name, and the model of a structure.

use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};

use anyhow::{Context, ensure};
use clap::Args;
use clap::ValueHint::DirPath;
use rockfrag_core::fragility::{
    Calibration, CurveFit, DemandFit, DemandModel, Event, Measure, Model, MotionKind, Predictors,
};
use rockfrag_core::motion::Suite;
use rockfrag_core::object::{Object, RockingObject};
use rockfrag_core::plausibility::GIVEN_LIMIT_STATE;
use rockfrag_core::rocking::Structure;
use rockfrag_core::spelling::unknown_word;
use rockfrag_core::warning::Warning;
use serde::{Deserialize, Serialize};

use crate::number::listed;
use crate::pipeline::UsageError;
use crate::pipeline::options::given;
use crate::pipeline::paths::Read;
use crate::stages::shared::objects::named;
use crate::table::TableError;
use crate::table::rows::{self, Row};

#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<ModelName>)]
pub enum ModelName {
    Calibrated,
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
          value_parser = given(GIVEN_LIMIT_STATE))]
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
    pub fn input(&self) -> Read {
        const FILES: [&str; 4] =
            ["pro.calibration.parquet", "pex.calibration.parquet", "pro.parquet", "pex.parquet"];
        let files = if self.model == ModelName::Paper { &FILES } else { &FILES[..2] };
        let files = self.fits.iter().flat_map(|folder| files.iter().map(move |name| folder.join(name)));
        // Fits to what stood and what fell have none of demands.
        Read { optional: true, ..Read::new("fits", files) }
    }

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
        let sides = object.sides().map_err(|reason| named(object, &reason))?;
        let models = sides.iter().map(|side| self.model(&side.structure));
        let (models, warnings): (_, Vec<_>) = models.collect::<anyhow::Result<_>>()?;
        if let Ok(Some(_)) = object.place.floor() {
            self.expect_ground()?;
        }
        let rocking_object = RockingObject::new(object, models).map_err(|reason| named(object, &reason))?;
        Ok((rocking_object, warnings.concat()))
    }

    /// The model for a structure, and warnings about it: by its fit or, without one, the surface.
    pub fn model(&self, structure: &Structure) -> anyhow::Result<(Model, Vec<Warning>)> {
        let ModelArgs { limit_state, suite, model, .. } = self.args;
        let Some(overturning) = self.fit(structure)? else {
            let kind = match suite {
                None if !self.overturning.is_empty() => {
                    self.of_one_suite(&self.overturning.iter().collect::<Vec<_>>())?.kind
                }
                asked => asked.unwrap_or_default(),
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
        let is_other = !overturning.is_of_outcomes() && !structure.is_like(&overturning.structure);
        let warnings =
            [(overturning.n == 0).then_some(Warning::NotFitted), is_other.then_some(Warning::OtherStructure)];
        Ok((model, warnings.into_iter().flatten().collect()))
    }

    /// All fitted structures, or the one named.
    pub fn structures(&self) -> anyhow::Result<Vec<Structure>> {
        let (name, mut known) = (self.args.name.as_ref(), HashSet::new());
        let mut rows: Vec<&Calibration> = self.overturning.iter().collect();
        rows.retain(|Calibration { structure, .. }| {
            name.is_none_or(|name| *name == structure.name) && known.insert(&structure.name)
        });
        ensure!(!rows.is_empty(), self.not_fitted(name.map_or("", String::as_str)));
        Ok(rows.into_iter().map(|row| row.structure.clone()).collect())
    }

    /// Refuses fits to motions of a floor, whose intensity measures are those of the floor.
    pub fn expect_ground(&self) -> anyhow::Result<()> {
        let is_of_floor = self.overturning.iter().any(|row| Suite::is_floor(row.suite.as_deref()));
        let problem = "fits to motions of a floor; expected those of the ground, with period and level";
        ensure!(!is_of_floor, UsageError::because(self.problem(problem)));
        Ok(())
    }

    fn problem(&self, what: &str) -> String {
        format!("{}: {what}", self.args.fits.as_deref().unwrap_or(Path::new("")).display())
    }

    fn not_fitted(&self, name: &str) -> anyhow::Error {
        let known = distinct(self.overturning.iter().map(|row| row.structure.name.as_str()));
        let problem = format!("no structure like '{name}'; expected one of {known} by --name");
        UsageError::because(self.problem(&problem))
    }

    /// The fit of the structure that is named, or else has the same p, alpha and eta. The paper's model needs
    /// one.
    fn fit(&self, structure: &Structure) -> anyhow::Result<Option<&Calibration>> {
        let name = self.args.name.as_ref();
        let is_like = |row: &&Calibration| match name {
            Some(name) => row.structure.name == *name,
            None => row.is_of_outcomes() || structure.is_like(&row.structure),
        };
        let like = self.overturning.iter().filter(is_like);
        match like.min_by_key(|row| row.structure.name != structure.name) {
            Some(like) => {
                let its = self.overturning.iter().filter(|row| row.structure.name == like.structure.name);
                self.of_one_suite(&its.collect::<Vec<_>>()).map(Some)
            }
            None if name.is_some() || self.args.model == ModelName::Paper => {
                Err(self.not_fitted(name.unwrap_or(&structure.name)))
            }
            None => Ok(None),
        }
    }

    /// The first row of the kind of motion that is asked for; all of this kind must be of one suite.
    fn of_one_suite<'a>(&self, rows: &[&'a Calibration]) -> anyhow::Result<&'a Calibration> {
        let mut of_kind = rows.iter().filter(|row| self.args.suite.is_none_or(|kind| row.kind == kind));
        if let Some(first) = of_kind.next()
            && of_kind.all(|row| row.suite == first.suite)
        {
            return Ok(first);
        }
        let suites = distinct(rows.iter().map(|row| row.suite.as_deref().unwrap_or("-")));
        let problem = format!("fits of {suites}; expected --suite with one of them");
        Err(UsageError::because(self.problem(&problem)))
    }

    /// The row of P_ex beside one of P_ro; outcomes tell nothing of demands.
    fn exceeding(&self, overturning: &Calibration, structure: &Structure) -> anyhow::Result<Calibration> {
        let limit_state = self.args.limit_state;
        if overturning.is_of_outcomes() {
            return Ok(Calibration::uncalibrated(overturning.kind, structure, Some(limit_state)));
        }
        // Fits to the same responses have the same PGV/PGA, to the last bit.
        let is_beside = |row: &&Calibration| {
            row.group() == overturning.group() && row.ratio_given_pga == overturning.ratio_given_pga
        };
        let is_asked = |row: &&Calibration| {
            row.limit_state.is_some_and(|other| (other - limit_state).abs() <= 1e-9 * limit_state)
        };
        let row = self.exceeding.iter().filter(is_beside).find(is_asked).cloned();
        row.with_context(|| {
            self.problem(&format!(
                "no P_ex of '{}' for this limit state and the responses of P_ro; run fit-pex --limit-state \
                 {limit_state} on these",
                overturning.structure.name
            ))
        })
    }

    /// The paper's curve of the hybrid measure of its worked example; where that has no fit, of IM5.
    fn curve(&self, row: &Calibration) -> anyhow::Result<CurveFit> {
        let usable = self.curves.iter().filter(|fit| {
            fit.event == Event::Overturning && fit.group() == row.group() && fit.status.is_usable()
        });
        let of = |predictors| usable.clone().find(|fit| fit.predictors() == predictors).cloned();
        let hybrid = of(Predictors::two([Measure::Im4, Measure::Im3Inverse]));
        hybrid.or_else(|| of(Predictors::one(Measure::Im5))).with_context(|| {
            let problem = format!("no usable curve of '{}'; use --model calibrated", row.structure.name);
            self.problem(&problem)
        })
    }
}

fn distinct<'a>(texts: impl Iterator<Item = &'a str>) -> String {
    listed(&texts.collect::<BTreeSet<_>>().into_iter().collect::<Vec<_>>(), 8)
}
