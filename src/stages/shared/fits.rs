//! The options that select a model, and the fits of a structure.

use std::path::PathBuf;

use clap::{Args, ValueHint};

use crate::fragility::{Calibration, CurveFit, DemandFit, DemandModel, Event, Kind, Measure, Model};
use crate::keyword::{Keyword, keywords};
use crate::pipeline::UsageError;
use crate::pipeline::options::{listed, number};
use crate::rocking::Structure;
use crate::stages::shared::fitted::verdict;
use crate::table::rows;
use crate::warning::Warning;

/// The model that predicts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelName {
    /// The universal surface, calibrated where there are fits.
    Calibrated,
    /// The two planes and the lognormal curve of the paper.
    Paper,
}

keywords!(ModelName { Calibrated = "calibrated", Paper = "paper" });

/// The model of a call.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Model")]
pub struct FitsArgs {
    /// Folder of fits, from fit-pex and fit-pro [default: the universal surface as shipped]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub fits: Option<PathBuf>,
    /// Structure of the fits [default: the one with the same p, alpha and eta]
    #[arg(long, value_name = "NAME", requires = "fits")]
    pub name: Option<String>,
    /// Kind of motion: recorded, csgm, pulse or hfc [default: that of the fits, or recorded]
    #[arg(long, value_name = "KIND")]
    pub suite: Option<Kind>,
    /// calibrated (the surface, by the fits) or paper (its planes and hybrid curve)
    #[arg(long, default_value = "calibrated")]
    pub model: ModelName,
    /// Limit state: a demand |theta|max / alpha
    #[arg(long, value_name = "DEMAND", default_value = "0.1",
          value_parser = number(1e-6..=10.0, "a demand |theta|max / alpha above 0, such as 0.1"))]
    pub limit_state: f64,
}

impl FitsArgs {
    /// Reads the fits, if there are any.
    pub fn models(&self) -> anyhow::Result<FittedModels> {
        if self.model == ModelName::Paper && self.fits.is_none() {
            return Err(UsageError::because("--model paper needs --fits, the folder of fit-pex and fit-pro"));
        }
        let mut models = FittedModels {
            args: self.clone(),
            overturning: Vec::new(),
            exceeding: Vec::new(),
            curves: Vec::new(),
            demand: Vec::new(),
        };
        let Some(folder) = &self.fits else { return Ok(models) };
        models.overturning = rows::read(&folder.join("pro.calibration.parquet"))?;
        models.exceeding = rows::read(&folder.join("pex.calibration.parquet"))?;
        if self.model == ModelName::Paper {
            models.curves = rows::read(&folder.join("pro.parquet"))?;
            models.demand = rows::read(&folder.join("pex.parquet"))?;
        }
        Ok(models)
    }
}

/// Fits, and the surface where there are none.
#[derive(Debug, Clone)]
pub struct FittedModels {
    args: FitsArgs,
    overturning: Vec<Calibration>,
    exceeding: Vec<Calibration>,
    curves: Vec<CurveFit>,
    demand: Vec<DemandFit>,
}

/// By how much p, alpha and eta of a fitted structure may differ, relative to them.
const SAME: f64 = 0.01;

impl FittedModels {
    /// The model for a structure: that of the fitted structure of the same p, alpha and eta, or of the one
    /// named; without one, the surface, with a warning if there are fits.
    pub fn model(&self, structure: &Structure) -> anyhow::Result<(Model, Vec<Warning>)> {
        let limit_state = self.args.limit_state;
        if self.args.fits.is_none() {
            let kind = self.args.suite.unwrap_or(Kind::Recorded);
            return Ok((Model::shipped(kind, structure, limit_state), Vec::new()));
        }
        let fitted = self.of_structure(structure)?;
        if fitted.is_empty() && self.args.model == ModelName::Paper {
            let names = self.names();
            anyhow::bail!(
                "{}: no structure like '{}' (p, alpha and eta within 1 %); expected one of {names} by --name",
                self.folder(),
                structure.name
            );
        }
        let Some(overturning) = self.of_suite(fitted)? else {
            let kind = match self.args.suite {
                Some(kind) => kind,
                None => {
                    self.of_suite(self.overturning.iter().collect())?.map_or(Kind::Recorded, |row| row.kind)
                }
            };
            return Ok((Model::shipped(kind, structure, limit_state), vec![Warning::NotFitted]));
        };
        let exceeding = self.exceeding(overturning)?;
        let peaks =
            overturning.peaks().unwrap_or(*Model::shipped(overturning.kind, structure, limit_state).peaks());
        let model = match self.args.model {
            ModelName::Calibrated => {
                Model::Calibrated { overturning: overturning.clone(), exceeding: exceeding.clone(), peaks }
            }
            ModelName::Paper => Model::Paper {
                demand: self.planes(overturning),
                overturning: self.curve(overturning)?,
                limit_state,
                peaks,
            },
        };
        Ok((model, (overturning.n == 0).then_some(Warning::NotFitted).into_iter().collect()))
    }

    /// All fitted structures, or the one named.
    pub fn structures(&self) -> Vec<Structure> {
        let mut structures: Vec<Structure> = Vec::new();
        for row in &self.overturning {
            let Calibration { structure: name, p_rad_s, alpha_rad, eta, .. } = row;
            let is_wanted = self.args.name.as_ref().is_none_or(|wanted| wanted == name);
            if is_wanted && structures.iter().all(|other| other.name != *name) {
                structures.push(Structure {
                    name: name.clone(),
                    p_rad_s: *p_rad_s,
                    alpha_rad: *alpha_rad,
                    eta: *eta,
                });
            }
        }
        structures
    }

    fn folder(&self) -> String {
        self.args.fits.as_ref().map_or(String::new(), |folder| folder.display().to_string())
    }

    fn names(&self) -> String {
        let mut names: Vec<&str> = self.overturning.iter().map(|row| row.structure.as_str()).collect();
        names.dedup();
        listed(&names, 8)
    }

    /// The rows of a structure, of one name.
    fn of_structure(&self, structure: &Structure) -> anyhow::Result<Vec<&Calibration>> {
        let rows = || self.overturning.iter();
        if let Some(name) = &self.args.name {
            let named: Vec<&Calibration> = rows().filter(|row| row.structure == *name).collect();
            return match named.is_empty() {
                true => Err(UsageError::because(format!(
                    "{}: no structure '{name}'; expected one of {}",
                    self.folder(),
                    self.names()
                ))),
                false => Ok(named),
            };
        }
        let is_near = |a: f64, b: f64| (a - b).abs() <= SAME * b.abs();
        let is_same = |row: &&Calibration| {
            is_near(row.p_rad_s, structure.p_rad_s)
                && is_near(row.alpha_rad, structure.alpha_rad)
                && is_near(row.eta, structure.eta)
        };
        let same: Vec<&Calibration> = rows().filter(is_same).collect();
        let name = same.iter().find(|row| row.structure == structure.name).or(same.first());
        let name = name.map(|row| row.structure.clone());
        Ok(same.into_iter().filter(|row| Some(&row.structure) == name.as_ref()).collect())
    }

    /// Returns the row of the requested suite, or the only row; none if there is no row.
    fn of_suite<'a>(&self, rows: Vec<&'a Calibration>) -> anyhow::Result<Option<&'a Calibration>> {
        let wanted = self.args.suite;
        let mut suites: Vec<&str> = rows.iter().map(|row| row.kind.as_str()).collect();
        suites.sort_unstable();
        suites.dedup();
        match (wanted, &suites[..]) {
            (_, []) => Ok(None),
            (None, [_]) => Ok(rows.first().copied()),
            (None, _) => {
                let (folder, suites) = (self.folder(), suites.join(", "));
                Err(UsageError::because(format!(
                    "{folder}: fits of {suites}; expected --suite with one of them"
                )))
            }
            (Some(kind), _) => match rows.iter().find(|row| row.kind == kind) {
                Some(row) => Ok(Some(row)),
                None => {
                    let (folder, suites) = (self.folder(), suites.join(", "));
                    Err(UsageError::because(format!("{folder}: no fits of {kind}, only of {suites}")))
                }
            },
        }
    }

    /// The row of P_ex beside one of P_ro.
    fn exceeding(&self, overturning: &Calibration) -> anyhow::Result<&Calibration> {
        let limit_state = self.args.limit_state;
        let is_its =
            |row: &&Calibration| (&row.suite, &row.structure) == (&overturning.suite, &overturning.structure);
        let of_limit = |row: &&Calibration| {
            row.limit_state.is_some_and(|other| (other - limit_state).abs() <= 1e-9 * limit_state)
        };
        if let Some(row) = self.exceeding.iter().filter(is_its).find(of_limit) {
            return Ok(row);
        }
        let mut fitted: Vec<f64> =
            self.exceeding.iter().filter(is_its).filter_map(|row| row.limit_state).collect();
        let found = if fitted.is_empty() { "none".to_string() } else { listed(&fitted, 8) };
        fitted.push(limit_state);
        anyhow::bail!(
            "{}: P_ex of '{}' has limit states {found}, not {limit_state}; run fit-pex --limit-state {}",
            self.folder(),
            overturning.structure,
            fitted.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
        )
    }

    /// The two planes of the paper.
    fn planes(&self, row: &Calibration) -> Vec<DemandFit> {
        let is_its = |fit: &&DemandFit| {
            (&fit.suite, &fit.structure, fit.model) == (&row.suite, &row.structure, DemandModel::Biplanar)
        };
        self.demand.iter().filter(is_its).cloned().collect()
    }

    /// The paper's curve of the hybrid measure of its worked example; where that has no fit, of IM5.
    fn curve(&self, row: &Calibration) -> anyhow::Result<CurveFit> {
        let is_its = |fit: &&CurveFit| {
            (&fit.suite, &fit.structure, fit.event) == (&row.suite, &row.structure, Event::Overturning)
        };
        let of = |im_x, im_y| {
            let is_of = move |fit: &&CurveFit| (fit.im_x, fit.im_y) == (im_x, im_y);
            self.curves.iter().filter(is_its).find(is_of)
        };
        let curves = [of(Measure::Im4, Some(Measure::Im3Inverse)), of(Measure::Im5, None)];
        let mut usable = curves.into_iter().flatten().filter(|fit| fit.status.is_usable());
        usable.next().cloned().ok_or_else(|| {
            let first = curves.into_iter().flatten().next();
            let status = first.map_or("missing".to_string(), |fit| verdict(fit.status));
            anyhow::anyhow!(
                "{}: the paper's curve of '{}' has the status '{status}'; use --model calibrated",
                self.folder(),
                row.structure
            )
        })
    }
}
