//! The fits of resampled cases, from the files that fit-pex and fit-pro write with --bootstrap.

use std::path::{Path, PathBuf};

use super::chosen_fits::ChosenFits;
use super::fits::FitFiles;
use crate::fragility::Event;
use crate::fragility::demand::Form;
use crate::fragility::{DemandLaw, DemandModel, FragilityModel, Predictor};
use crate::keyword::Keyword;
use crate::pipeline::UsageError;
use crate::table::fits::{self, FitRow};
use crate::table::pex::PEX_BOOTSTRAP;
use crate::table::pro::PRO_BOOTSTRAP;
use crate::table::schema::{self, Column, Table};
use crate::table::store::contents::recorded;
use crate::table::store::source::{Source, with_part};

/// The bootstrap files beside those of the fits, of P_ex and of P_ro.
///
/// # Errors
/// If the fits are in memory.
pub fn files(fits: &FitFiles) -> anyhow::Result<[PathBuf; 2]> {
    let file = |source| -> anyhow::Result<PathBuf> { Ok(with_part(path_of(source)?, "bootstrap")) };
    Ok([file(&fits.pex)?, file(&fits.pro)?])
}

fn path_of(fits: &Source) -> anyhow::Result<&Path> {
    match fits {
        Source::Path(path) => Ok(path),
        Source::Memory(table) => Err(UsageError::because(format!(
            "{}: a table in memory; limits by resamples need the files that fit-pex and fit-pro write with --bootstrap",
            table.name.display()
        ))),
    }
}

/// Checks that the bootstrap files are there.
///
/// # Errors
/// If one is missing.
pub fn expect_files(fits: &FitFiles) -> anyhow::Result<()> {
    match files(fits)?.iter().find(|bootstrap| !bootstrap.exists()) {
        Some(missing) => Err(UsageError::because(format!(
            "{}: no such file; limits by replicates need fit-pex and fit-pro with --bootstrap 2000",
            missing.display()
        ))),
        None => Ok(()),
    }
}

/// The chosen fits in each resample.
///
/// # Errors
/// If there are no such files, or they are not of the same resamples as the fits and each other.
pub fn read(fits: &FitFiles, chosen: &ChosenFits) -> anyhow::Result<Vec<Option<FragilityModel>>> {
    let [pex, pro] = files(fits)?;
    same_cache_key(path_of(&fits.pex)?, &pex)?;
    same_cache_key(path_of(&fits.pro)?, &pro)?;
    let seed = |path: &Path| {
        anyhow::Ok(recorded(path)?.map(|recorded| recorded.provenance.parameters["seed"].clone()))
    };
    if seed(&pex)? != seed(&pro)? {
        return Err(UsageError::because(format!(
            "{} and {} have other seeds; expected the same --seed in fit-pex and fit-pro",
            pex.display(),
            pro.display()
        )));
    }
    let demands = demands(&rows(&pex, &PEX_BOOTSTRAP, chosen)?, &chosen.model.demand);
    let curves = curves(&rows(&pro, &PRO_BOOTSTRAP, chosen)?, &chosen.model.overturning);
    if demands.len() != curves.len() || demands.is_empty() {
        return Err(UsageError::because(format!(
            "{} has {} resamples and {} has {}; expected the same --bootstrap in fit-pex and fit-pro",
            pex.display(),
            demands.len(),
            pro.display(),
            curves.len()
        )));
    }
    let model = |(demand, overturning): (Option<DemandModel>, Option<Predictor>)| {
        Some(FragilityModel { demand: demand?, overturning: overturning?, ..chosen.model })
    };
    Ok(demands.into_iter().zip(curves).map(model).collect())
}

/// That a bootstrap file was made together with the fits.
fn same_cache_key(fits: &Path, bootstrap: &Path) -> anyhow::Result<()> {
    let key = |path: &Path| anyhow::Ok(recorded(path)?.map(|recorded| recorded.cache_key));
    if key(fits)? != key(bootstrap)? {
        return Err(UsageError::because(format!(
            "{} was not made together with {}; fit again with --bootstrap",
            bootstrap.display(),
            fits.display()
        )));
    }
    Ok(())
}

/// The replicates of the chosen suite and structure.
fn rows(path: &Path, table: &Table, chosen: &ChosenFits) -> anyhow::Result<Vec<FitRow>> {
    let mut rows = fits::rows(path, table)?;
    rows.retain(|row| {
        row.text(&schema::suite) == chosen.suite.as_deref()
            && row.text(&schema::structure) == Some(&chosen.structure)
    });
    Ok(rows)
}

/// Of the fit of the chosen measures, in the order of the replicates.
fn demands(rows: &[FitRow], chosen: &DemandModel) -> Vec<Option<DemandModel>> {
    let of = |model: Form, law: &DemandLaw| -> Vec<&FitRow> {
        let same = |row: &&FitRow| {
            row.text(&schema::model) == Some(model.as_str()) && has_measures(row, &law.ln_median)
        };
        rows.iter().filter(same).collect()
    };
    match chosen {
        DemandModel::Everywhere(law) => of(Form::Univariate, law)
            .iter()
            .map(|row| Some(DemandModel::Everywhere(resampled(row, law)?)))
            .collect(),
        DemandModel::Biplanar { low, high, .. } => {
            // All replicates of the lower plane come first.
            let both = of(Form::Biplanar, high);
            let (below, above) = both.split_at(both.len() / 2);
            let planes = |(below, above): (&&FitRow, &&FitRow)| {
                let transition = above.optional_number(&schema::range_low)?;
                let (low, high) = (resampled(below, low)?, resampled(above, high)?);
                Some(DemandModel::Biplanar { transition, low, high })
            };
            below.iter().zip(above).map(planes).collect()
        }
    }
}

fn resampled(row: &FitRow, law: &DemandLaw) -> Option<DemandLaw> {
    let ln_median = with_coefficients(row, &law.ln_median, [schema::ln_a, schema::b1, schema::b2])?;
    Some(DemandLaw { ln_median, beta: row.optional_number(&schema::beta)?, degrees: law.degrees })
}

fn curves(rows: &[FitRow], chosen: &Predictor) -> Vec<Option<Predictor>> {
    let same = |row: &&FitRow| {
        row.text(&schema::fitted_event) == Some(Event::Overturning.as_str()) && has_measures(row, chosen)
    };
    let columns = [schema::b0, schema::index_b1, schema::index_b2];
    rows.iter().filter(same).map(|row| with_coefficients(row, chosen, columns)).collect()
}

fn has_measures(row: &FitRow, fit: &Predictor) -> bool {
    row.text(&schema::im_x) == Some(fit.im_x.as_str())
        && row.text(&schema::im_y) == fit.im_y.map(Keyword::as_str)
}

/// The fit with the coefficients of a replicate.
fn with_coefficients(row: &FitRow, fit: &Predictor, columns: [Column; 3]) -> Option<Predictor> {
    let [intercept, first, second] = columns.map(|column| row.optional_number(&column));
    let second = if fit.im_y.is_some() { second? } else { 0.0 };
    Some(Predictor { coefficients: [intercept?, first?, second], ..*fit })
}
