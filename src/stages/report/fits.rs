use std::path::Path;

use crate::fragility::Event;
use crate::fragility::Measure;
use crate::fragility::demand::Form;
use crate::keyword::Keyword;
use crate::pipeline::console::Console;
use crate::pipeline::options::Word;
use crate::report::data::{Curve, Group, Model, Planes, Regression};
use crate::stages::shared::fits::{FitFiles, FitsOptions, ModelForm};
use crate::table::fits::{self, FitRow};
use crate::table::schema;

/// The row, if it is of this group.
fn is_of(row: &FitRow, group: &Group) -> bool {
    row.text(&schema::suite) == group.suite.as_deref()
        && row.text(&schema::structure) == Some(group.structure.name.as_str())
}

/// Gives each group its regressions; the demand that P_ex is about.
pub fn add_regressions(path: &Path, groups: &mut [Group]) -> anyhow::Result<Option<f64>> {
    let rows = fits::regressions(path)?;
    for group in groups {
        let of_group = |model: Form| {
            let rows = rows.iter().filter(|row| is_of(row, group));
            rows.filter(move |row| row.text(&schema::model) == Some(model.as_str())).collect::<Vec<_>>()
        };
        let univariate = of_group(Form::Univariate);
        let planes = of_group(Form::Biplanar);
        group.planes = match &planes[..] {
            [low, high] => regression(low).zip(regression(high)).and_then(|(below, above)| {
                let transition = high.optional_number(&schema::range_low)?;
                Some(Planes { transition, sides: [below, above] })
            }),
            _ => None,
        };
        group.univariate = univariate.into_iter().filter_map(regression).collect();
    }
    Ok(rows.iter().find_map(|row| row.optional_number(&schema::limit_state)))
}

/// A row that holds a regression, whether it rises or falls.
fn regression(row: &FitRow) -> Option<Regression> {
    let r2 = row.optional_number(&schema::r2)?;
    row.demand().ok().map(|law| Regression { law, r2, rises: row.is_ok() })
}

/// Gives each group its curves of overturning.
pub fn add_curves(path: &Path, groups: &mut [Group], console: &Console) -> anyhow::Result<()> {
    let rows = fits::curves(path)?;
    let overturning = |row: &&FitRow| row.text(&schema::fitted_event) == Some(Event::Overturning.as_str());
    let rows: Vec<&FitRow> = rows.iter().filter(overturning).filter(|row| row.is_ok()).collect();
    if let Some(Err(why)) = rows.first().map(|row| row.probit()) {
        console.warn(&format!("no curves of overturning in the figures: {why}"));
    }
    for group in groups {
        let of_group = rows.iter().filter(|row| is_of(row, group));
        group.curves = of_group.filter_map(|row| row.probit().ok()).map(|index| Curve { index }).collect();
    }
    Ok(())
}

/// The fits of each group joined: bivariate, and over each measure that has both fits.
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
        chosen.map(move |fits| Model {
            suite: fits.suite,
            structure: fits.structure,
            form: form.clone(),
            fits: fits.model,
        })
    });
    models.filter(shown).collect()
}
