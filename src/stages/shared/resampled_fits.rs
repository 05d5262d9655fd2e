//! The fits of resampled cases, from the files that fit-pex and fit-pro write with --bootstrap.

use std::cmp::Ordering;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::chosen_fits::ChosenFits;
use super::fits::FitFiles;
use crate::fragility::Event;
use crate::fragility::demand::Form;
use crate::fragility::{Bend, DemandLaw, DemandModel, FragilityModel, Predictor};
use crate::pipeline::UsageError;
use crate::table::pex::PexReplicateRow;
use crate::table::pro::ProReplicateRow;
use crate::table::row::ReadRow;
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
    let demands = demands(&pex, chosen)?;
    let curves = curves(&pro, chosen)?;
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

/// The fits of the chosen measures in each resample.
fn demands(path: &Path, chosen: &ChosenFits) -> anyhow::Result<Vec<Option<DemandModel>>> {
    let rows: Vec<PexReplicateRow> =
        of_group(PexReplicateRow::read(path)?, chosen, |row| (&row.suite, &row.structure));
    let of = |model: Form, law: &DemandLaw| -> Vec<&PexReplicateRow> {
        let Predictor { im_x, im_y, .. } = law.ln_median;
        rows.iter().filter(|row| (row.model, row.im_x, row.im_y) == (model, im_x, im_y)).collect()
    };
    Ok(match &chosen.model.demand {
        DemandModel::Everywhere(law) => of(Form::Univariate, law)
            .iter()
            .map(|row| Some(DemandModel::Everywhere(resampled(row, law)?)))
            .collect(),
        DemandModel::Biplanar { low, high, .. } => {
            let mut both = of(Form::Biplanar, high);
            both.sort_by(|a, b| {
                a.replicate
                    .cmp(&b.replicate)
                    .then(a.range_low.partial_cmp(&b.range_low).unwrap_or(Ordering::Equal))
            });
            let planes = |[below, above]: &[&PexReplicateRow; 2]| {
                let (low, high) = (resampled(below, low)?, resampled(above, high)?);
                Some(DemandModel::Biplanar { transition: above.range_low?, low, high })
            };
            both.as_chunks().0.iter().map(planes).collect()
        }
    })
}

fn resampled(row: &PexReplicateRow, law: &DemandLaw) -> Option<DemandLaw> {
    let ln_median = with_coefficients(&law.ln_median, [row.ln_a, row.b1, row.b2])?;
    Some(DemandLaw { ln_median, beta: row.beta?, degrees: law.degrees })
}

/// The curve of the chosen measures in each resample.
fn curves(path: &Path, chosen: &ChosenFits) -> anyhow::Result<Vec<Option<Predictor>>> {
    let rows: Vec<ProReplicateRow> =
        of_group(ProReplicateRow::read(path)?, chosen, |row| (&row.suite, &row.structure));
    let fit = &chosen.model.overturning;
    let wanted = (Event::Overturning, fit.im_x, fit.im_y);
    let same = rows.iter().filter(|row| (row.event, row.im_x, row.im_y) == wanted);
    Ok(same.map(|row| resampled_curve(row, fit)).collect())
}

fn resampled_curve(row: &ProReplicateRow, fit: &Predictor) -> Option<Predictor> {
    let Some(bend) = fit.bend else { return with_coefficients(fit, [row.b0, row.b1, row.b2]) };
    let [b0, b1, b2, bends @ ..] = row.bent?;
    Some(Predictor { coefficients: [b0, b1, b2], bend: Some(Bend { coefficients: bends, ..bend }), ..*fit })
}

/// The suite and the structure of a row.
type KeyOf<R> = fn(&R) -> (&Option<Arc<str>>, &Arc<str>);

fn of_group<R>(mut rows: Vec<R>, chosen: &ChosenFits, key: KeyOf<R>) -> Vec<R> {
    rows.retain(|row| {
        let (suite, structure) = key(row);
        suite.as_deref() == chosen.suite.as_deref() && **structure == *chosen.structure
    });
    rows
}

/// The fit with the coefficients of a replicate.
fn with_coefficients(fit: &Predictor, [intercept, first, second]: [Option<f64>; 3]) -> Option<Predictor> {
    let second = if fit.im_y.is_some() { second? } else { 0.0 };
    Some(Predictor { coefficients: [intercept?, first?, second], ..*fit })
}
