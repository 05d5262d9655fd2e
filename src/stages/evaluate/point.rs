use serde_json::json;

use super::PointOptions;
use super::answer::Answer;
use crate::fragility::Probability;
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::check;
use crate::rocking::Structure;
use crate::stages::chosen_fits::ChosenFits;
use crate::stages::structures::words;
use crate::table::evaluated::{self, AnswerRow};
use crate::table::schema::{
    ANSWER, Column, HYBRID, IM1, IM2, IM3, IM4, IM5, IM6, P_EX, P_F, P_F_R, P_NR, P_RO,
};
use crate::units::G_M_S2;

/// All probabilities at one intensity.
pub fn answer(
    options: &PointOptions,
    fits: &ChosenFits,
    structure: &Structure,
    console: &Console,
) -> anyhow::Result<Answer> {
    let (Some(pga_g), Some(pgv_m_s)) = (options.pga, options.pgv) else {
        return Err(UsageError::because(
            "expected --pga (g) and --pgv (m/s); or --in TABLE, or --hazard CURVE",
        ));
    };
    check(pga_g >= 0.0 && pga_g.is_finite(), "pga", pga_g, "0 g or more")?;
    check(pgv_m_s >= 0.0 && pgv_m_s.is_finite(), "pgv", pgv_m_s, "0 m/s or more")?;
    let measures = IntensityMeasures::new(structure, pga_g * G_M_S2, pgv_m_s, options.tp, options.tm);
    let probabilities = fits.probabilities(&measures);
    let failure = probabilities.limit_states().map(|[_, failure, _]| failure);
    if failure.is_none() {
        console.note("warning: the fits need a measure that is missing: give --pgv above 0, --tp or --tm");
    }
    fits.warn_of_range(&measures, "", console);
    let row = |column: Column, value: Option<f64>, p: Option<Probability>| AnswerRow {
        quantity: column.name,
        value: value.or(p.map(|p| p.value)),
        limits: p.filter(|p| !p.low.is_nan()).map(|p| (p.low, p.high)),
        meaning: column.description.to_string(),
    };
    let given = probabilities.given_rocking;
    let mut rows = vec![
        row(P_NR, Some(probabilities.p_nr), None),
        row(P_EX, None, given.map(|given| given.p_ex)),
        row(P_RO, None, given.map(|given| given.p_ro)),
        row(P_F_R, None, given.map(|given| given.p_failure)),
        row(P_F, None, failure),
    ];
    let hybrid = fits.model.overturning.im_y.and_then(|_| fits.model.overturning.hybrid_measure(&measures));
    let measured = [
        (IM1, measures.im1),
        (IM2, measures.im2),
        (IM3, measures.im3),
        (IM4, Some(measures.im4)),
        (IM5, Some(measures.im5)),
        (IM6, measures.im6),
        (HYBRID, hybrid),
    ];
    rows.extend(
        measured.into_iter().filter(|(_, value)| value.is_some()).map(|(im, value)| row(im, value, None)),
    );
    let Structure { p_rad_s, alpha_rad, eta, .. } = structure;
    Ok(Answer {
        table: ANSWER,
        rows: evaluated::answer(&rows)?,
        heading: format!(
            "fits of {}\nstructure of {}, at PGA {pga_g} g and PGV {pgv_m_s} m/s\nlimit state |theta|max / alpha = {}; low and high are 95 % limits of confidence, {}\n",
            fits.words(),
            words(structure),
            fits.model.limit,
            fits.words_of_limits(),
        ),
        parameters: json!({ "p": p_rad_s, "alpha": alpha_rad, "eta": eta, "pga": pga_g, "pgv": pgv_m_s,
            "tp": options.tp, "tm": options.tm, "fits": fits.words(), "limits": fits.words_of_limits() }),
        input: None,
    })
}
