use std::path::Path;

use crate::fragility::demand::Form;
use crate::fragility::overturning::LEAST_EVENTS;
use crate::fragility::{Gap, Measure};
use crate::keyword::Keyword;
use crate::pipeline::console::Console;
use crate::pipeline::options::Word;
use crate::report::data::{Curve, Group, Median, Model, Planes, Regression, Summary};
use crate::rocking::Structure;
use crate::stages::shared::chosen_fits::{ChosenFits, Misfit};
use crate::stages::shared::fits::{FitFiles, FitsOptions, ModelForm};
use crate::table::fits::{self, GroupKey};
use crate::table::pex::PexRow;
use crate::table::pro::ProRow;
use crate::table::row::ReadRow;
use crate::units::G_M_S2;

fn key(group: &Group) -> GroupKey {
    (group.suite.clone(), group.structure.name.clone())
}

/// Gives each group its regressions.
pub fn add_regressions(rows: &[PexRow], groups: &mut [Group]) {
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
}

/// A row that holds a regression, whether it rises or falls.
fn regression(row: &PexRow) -> Option<Regression> {
    let law = row.demand().ok()?;
    Some(Regression { law, r2: row.r2?, rises: row.is_ok() })
}

/// Gives each group its curves of overturning, and each summary the middle of one.
pub fn add_curves(
    path: &Path,
    groups: &mut [Group],
    summaries: &mut [Summary],
    console: &Console,
) -> anyhow::Result<()> {
    let mut rows = ProRow::read(path)?;
    rows.retain(ProRow::is_of_overturning);
    for summary in summaries {
        let of_summary =
            |row: &&ProRow| row.suite == summary.suite && row.structure == summary.structure.name;
        let over_velocity = |row: &&ProRow| row.im_x == Measure::Im5 && row.im_y.is_none();
        summary.curve = rows.iter().filter(over_velocity).find(of_summary).map(|row| median(row, summary));
    }
    rows.retain(ProRow::is_ok);
    if let Some(Err(why)) = rows.first().map(ProRow::probit) {
        console.warn(&format!("no curves of overturning in the figures: {}: {why}", path.display()));
    }
    for group in groups {
        let key = key(group);
        let of_group = rows.iter().filter(|row| row.group() == key);
        let curve =
            |row: &ProRow| Some(Curve { index: row.probit().ok()?, status: row.status, gap: gap(row) });
        group.curves = of_group.filter_map(curve).collect();
    }
    Ok(())
}

fn gap(row: &ProRow) -> Option<Gap> {
    Some(Gap { straight: row.gap_straight?, bent: row.gap_bent? })
}

/// The middle of a curve over p PGV / (g tan alpha), as a PGV.
fn median(row: &ProRow, summary: &Summary) -> Median {
    let Structure { p_rad_s, alpha_rad, .. } = summary.structure;
    let pgv_m_s = |im5: f64| im5 * G_M_S2 * libm::tan(alpha_rad) / p_rad_s;
    // Of few events, standard errors are too small.
    let [low, high] = match summary.has_few_events() {
        true => [row.mu_profile_low, row.mu_profile_high].map(|mu| mu.map(libm::exp)),
        false => [row.theta_low, row.theta_high],
    };
    let limits = || Some([row.theta?, low.unwrap_or(0.0), high.unwrap_or(f64::INFINITY)]);
    let there = limits().filter(|_| row.is_ok() && summary.fewer() >= LEAST_EVENTS);
    Median { status: row.status, pgv_m_s: there.map(|limits| limits.map(pgv_m_s)), gap: gap(row) }
}

/// The fits of each group joined: bivariate, and over each measure that has both fits; of a group, the best first.
pub fn models(pex: &Path, pro: &Path, groups: &[Group]) -> Vec<Model> {
    let shown = |model: &Model| {
        groups.iter().any(|group| group.suite == model.suite && group.structure.name == model.structure)
    };
    let forms = std::iter::once(None).chain(Measure::SCALAR.map(Some));
    let models = forms.flat_map(|measure| {
        let model = Word(if measure.is_some() { ModelForm::Univariate } else { ModelForm::Bivariate });
        let options =
            FitsOptions { suite: None, structure: None, model: Some(model), measure: measure.map(Word) };
        let files = FitFiles { pex: pex.into(), pro: pro.into(), options };
        let form = measure.map_or(ModelForm::Bivariate.as_str(), Keyword::as_str).to_string();
        let chosen = files.choose_each().unwrap_or_default().into_iter().filter_map(|(_, fits)| fits.ok());
        chosen.map(move |fits| {
            let few = fits.doubt_of_events().map(|doubt| format!("P_ro comes {doubt}"));
            let doubts: Vec<String> =
                few.into_iter().chain(fits.misfit.as_ref().map(Misfit::words)).collect();
            let doubt = (!doubts.is_empty()).then(|| doubts.join("; "));
            let aic = fits.aic_per_case;
            let ChosenFits { suite, structure, model, .. } = fits;
            (Model { suite, structure, form: form.clone(), fits: model, doubt }, aic)
        })
    });
    let mut models: Vec<(Model, f64)> = models.filter(|(model, _)| shown(model)).collect();
    models.sort_by(|(_, a), (_, b)| a.total_cmp(b));
    models.into_iter().map(|(model, _)| model).collect()
}
