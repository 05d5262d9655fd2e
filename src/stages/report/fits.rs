use std::path::Path;

use crate::fragility::Measure;
use crate::fragility::demand::Form;
use crate::keyword::Keyword;
use crate::pipeline::console::Console;
use crate::pipeline::options::Word;
use crate::report::data::{Curve, Group, Model, Planes, Regression};
use crate::stages::shared::chosen_fits::{ChosenFits, Misfit};
use crate::stages::shared::fits::{FitFiles, FitsOptions, ModelForm};
use crate::table::fits::{self, GroupKey};
use crate::table::pex::PexRow;
use crate::table::pro::ProRow;
use crate::table::row::ReadRow;

fn key(group: &Group) -> GroupKey {
    (group.suite.clone(), group.structure.name.clone())
}

/// Gives each group its regressions; the demand that P_ex is about.
pub fn add_regressions(path: &Path, groups: &mut [Group]) -> anyhow::Result<Option<f64>> {
    let rows = PexRow::read(path)?;
    for group in groups {
        let key = key(group);
        let of_group = || rows.iter().filter(|row| row.group() == key);
        group.planes = fits::planes(of_group()).and_then(|[low, high]| {
            let sides = [regression(low)?, regression(high)?];
            Some(Planes { transition: high.range_low?, sides })
        });
        group.univariate =
            of_group().filter(|row| row.model == Form::Univariate).filter_map(regression).collect();
    }
    Ok(rows.first().map(|row| row.limit_state))
}

/// A row that holds a regression, whether it rises or falls.
fn regression(row: &PexRow) -> Option<Regression> {
    let law = row.demand().ok()?;
    Some(Regression { law, r2: row.r2?, rises: row.is_ok() })
}

/// Gives each group its curves of overturning.
pub fn add_curves(path: &Path, groups: &mut [Group], console: &Console) -> anyhow::Result<()> {
    let mut rows = ProRow::read(path)?;
    rows.retain(|row| row.is_of_overturning() && row.is_ok());
    if let Some(Err(why)) = rows.first().map(ProRow::probit) {
        console.warn(&format!("no curves of overturning in the figures: {}: {why}", path.display()));
    }
    for group in groups {
        let key = key(group);
        let of_group = rows.iter().filter(|row| row.group() == key);
        group.curves = of_group.filter_map(|row| row.probit().ok()).map(|index| Curve { index }).collect();
    }
    Ok(())
}

/// The fits of each group joined: bivariate, and over each measure that has both fits; of a group, the best first.
pub fn models(pex: &Path, pro: &Path, groups: &[Group]) -> Vec<Model> {
    let shown = |model: &Model| {
        groups.iter().any(|group| group.suite == model.suite && group.structure.name == model.structure)
    };
    let forms = std::iter::once(None).chain(Measure::SCALAR.map(Some));
    let models = forms.flat_map(|measure| {
        let model = Word(if measure.is_some() { ModelForm::Univariate } else { ModelForm::Bivariate });
        let options = FitsOptions { suite: None, structure: None, model, measure: measure.map(Word) };
        let files = FitFiles { pex: pex.into(), pro: pro.into(), options };
        let form = measure.map_or(ModelForm::Bivariate.as_str(), Keyword::as_str).to_string();
        let chosen = files.choose_each().unwrap_or_default().into_iter().flatten();
        chosen.map(move |fits| {
            let (doubt, aic) = (fits.misfit.as_ref().map(Misfit::words), fits.aic_per_case);
            let ChosenFits { suite, structure, model, .. } = fits;
            (Model { suite, structure, form: form.clone(), fits: model, doubt }, aic)
        })
    });
    let mut models: Vec<(Model, f64)> = models.filter(|(model, _)| shown(model)).collect();
    models.sort_by(|(_, a), (_, b)| a.total_cmp(b));
    models.into_iter().map(|(model, _)| model).collect()
}
