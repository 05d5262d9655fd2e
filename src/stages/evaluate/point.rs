use super::answer::Answer;
use super::answering::Answering;
use super::options::PointOptions;
use crate::fragility::universal::Scenarios;
use crate::fragility::{DOUBTFUL_PEAKS, Peak, Probability, are_doubtful};
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::{check, check_bound};
use crate::rocking::Structure;
use crate::stages::shared::structures::words;
use crate::table::evaluated::{self, ANSWER, AnswerRow};
use crate::table::schema::{self, Column};
use crate::units::G_M_S2;

/// All probabilities at one intensity.
pub fn answer(
    options: &PointOptions,
    answering: &Answering,
    structure: &Structure,
    console: &Console,
) -> anyhow::Result<Answer> {
    let (Some(pga_g), Some(pgv_m_s)) = (options.pga, options.pgv) else {
        return Err(UsageError::because(
            "expected --pga (g) and --pgv (m/s); or --in TABLE, or --hazard CURVE",
        ));
    };
    check_bound(&Peak::Pga.bound(), pga_g)?;
    check_bound(&Peak::Pgv.bound(), pgv_m_s)?;
    for (name, period) in [("tp", options.tp), ("tm", options.tm)] {
        check(
            period.is_none_or(|s| s > 0.0 && s <= 60.0),
            name,
            period.unwrap_or_default(),
            "a period above 0 s, up to 60",
        )?;
    }
    if are_doubtful(pga_g * G_M_S2, pgv_m_s) {
        console.warn(DOUBTFUL_PEAKS);
    }
    let measures = IntensityMeasures::new(structure, pga_g * G_M_S2, pgv_m_s, options.tp, options.tm);
    let probabilities = answering.probabilities(structure, &measures);
    let failure = probabilities.limit_states().map(|[_, failure, _]| failure);
    if failure.is_none() {
        console.warn(match answering {
            Answering::Fits(_) => "the fits need a measure that is missing: give --pgv above 0, --tp or --tm",
            Answering::Universal(_) => "the surface needs a velocity: give --pgv above 0",
        });
    }
    answering.warn_of_range(&measures, "", console);
    let universal = answering.beside_misfit(Scenarios::One);
    if let Some(given) = universal.and_then(|model| model.probabilities(structure, &measures).given_rocking) {
        let Probability { value, low, high } = given.p_ro;
        console.warn(&format!(
            "the universal surface (--model universal) has P_ro {value:.3} ({low:.3} to {high:.3})"
        ));
    }
    let row = |column: Column, value: Option<f64>, p: Option<Probability>| AnswerRow {
        quantity: column.name,
        value: value.or(p.map(|p| p.value)),
        limits: p.filter(|p| !p.low.is_nan()).map(|p| (p.low, p.high)),
        meaning: column.description.to_string(),
    };
    let given = probabilities.given_rocking;
    let mut rows = vec![
        row(schema::p_nr, Some(probabilities.p_nr), None),
        row(schema::p_ex, None, given.map(|given| given.p_ex)),
        row(schema::p_ro, None, given.map(|given| given.p_ro)),
        row(schema::p_f_r, None, given.map(|given| given.p_failure)),
        row(schema::p_f, None, failure),
    ];
    let hybrid = answering.hybrid_measure(&measures);
    let measured = [
        (schema::im1, measures.im1),
        (schema::im2, measures.im2),
        (schema::im3, measures.im3),
        (schema::im4, Some(measures.im4)),
        (schema::im5, Some(measures.im5)),
        (schema::im6, measures.im6),
        (schema::im_hybrid, hybrid),
    ];
    rows.extend(
        measured.into_iter().filter(|(_, value)| value.is_some()).map(|(im, value)| row(im, value, None)),
    );
    if let Answering::Universal(_) = answering {
        // Other formats than the table have no heading.
        rows.push(AnswerRow { quantity: "model", value: None, limits: None, meaning: answering.words() });
    }
    Ok(Answer {
        table: ANSWER,
        rows: evaluated::answer(&rows)?,
        heading: format!(
            "{}\nstructure of {}, at PGA {pga_g} g and PGV {pgv_m_s} m/s\nlimit state |theta|max / alpha = {}; low and high are 95 % limits of confidence, {}\n",
            answering.words(),
            words(structure),
            answering.limit(),
            answering.words_of_limits(),
        ),
    })
}
