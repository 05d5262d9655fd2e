use serde_json::Value;

use super::answer::Answer;
use super::options::PointOptions;
use crate::fragility::universal::Scenarios;
use crate::fragility::{GivenRocking, JointPeaks, Peak, Probability, doubt_of_peaks};
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::{check, check_bound};
use crate::rocking::Structure;
use crate::stages::shared::answers::Answers;
use crate::stages::shared::structures::{words, words_of_friction};
use crate::table::evaluated::{self, ANSWER, AnswerRow};
use crate::table::schema::{self, Column};
use crate::units::G_M_S2;

/// Standard deviations from the median of a normal distribution within which nine of ten lie.
const Z_90: f64 = 1.645;
/// From which factor on two probabilities differ by a factor rather than by a difference.
const LARGE_RATIO: f64 = 3.0;

/// All probabilities at one intensity.
pub fn answer(
    options: &PointOptions,
    answers: &dyn Answers,
    structure: &Structure,
    console: &Console,
) -> anyhow::Result<Answer> {
    let (Some(pga_g), Some(pgv_m_s)) = (options.pga, options.pgv) else {
        let range = options.pga.zip(answers.peaks()).and_then(|(pga_g, peaks)| range_of_pgv(pga_g, peaks));
        let range = range.map_or(String::new(), |[low, high]| {
            format!(
                "; overturning depends strongly on the PGV: nine of ten motions {} with this PGA have {low:.2} to {high:.2} m/s; try both ends",
                answers.words_of_motions()
            )
        });
        return Err(UsageError::because(format!(
            "expected --pga (g) and --pgv (m/s); or --in TABLE, or --hazard CURVE{range}"
        )));
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
    if let Some(doubt) = doubt_of_peaks(pga_g * G_M_S2, pgv_m_s) {
        console.warn(doubt.words());
    }
    let measures = IntensityMeasures::new(structure, pga_g * G_M_S2, pgv_m_s, options.tp, options.tm);
    let probabilities = answers.probabilities(structure, &measures);
    let failure = probabilities.limit_states().map(|[_, failure, _]| failure);
    if failure.is_none() {
        let missing = answers.words_of_missing(&measures);
        if pgv_m_s > 0.0 {
            return Err(UsageError::because(missing));
        }
        console.warn(&missing);
    }
    answers.warn_of_range(&measures, "", console);
    let row = |column: Column, value: Option<f64>, p: Option<Probability>| AnswerRow {
        quantity: column.name,
        value: value.or(p.map(|p| p.value)),
        limits: p.filter(|p| !p.low.is_nan()).map(|p| (p.low, p.high)),
        meaning: column.description.to_string(),
    };
    let surface = answers.surface(Scenarios::One);
    // The equations of these two are of fits, and the surface answers without them.
    let without_equation = |row: AnswerRow| match (&surface, row.meaning.split_once(" (Eq.")) {
        (None, Some((meaning, _))) => AnswerRow { meaning: meaning.to_string(), ..row },
        _ => row,
    };
    let given = probabilities.given_rocking;
    let mut rows = vec![
        row(schema::p_nr, Some(probabilities.p_nr), None),
        without_equation(row(schema::p_ex, None, given.map(|given| given.p_ex))),
        without_equation(row(schema::p_ro, None, given.map(|given| given.p_ro))),
        row(schema::p_f_r, None, given.map(|given| given.p_failure)),
        row(schema::p_f, None, failure),
    ];
    let hybrid = answers.hybrid_measure(&measures);
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
    let besides = |quantity, value, limits, meaning| AnswerRow { quantity, value, limits, meaning };
    let surface = surface.map(|surface| surface.probabilities(structure, &measures));
    if let Some(GivenRocking { p_ro, .. }) = surface.and_then(|surface| surface.given_rocking) {
        let apart = given.map_or(String::new(), |given| apart(p_ro.value, given.p_ro.value));
        let meaning = format!("P_ro by the universal surface (--model universal){apart}");
        rows.push(besides("p_ro_universal", Some(p_ro.value), Some((p_ro.low, p_ro.high)), meaning));
    }
    // Below uplift the answer is exact, wherever the data are.
    let distance = given.and_then(|_| answers.model().distance(structure, &measures));
    if let Some((distance, coordinate)) = distance {
        let meaning =
            format!("from the middle of the data (0) to their rim (1) and beyond, farthest in {coordinate}");
        rows.push(besides("distance", Some(distance), None, meaning));
    }
    rows.push(besides("model", None, None, answers.words()));
    Ok(Answer {
        table: ANSWER,
        rows: evaluated::answer(&rows)?,
        shown: Value::Null,
        heading: format!(
            "{}\nstructure of {}, {}, at PGA {pga_g} g and PGV {pgv_m_s} m/s\nlimit state |theta|max / alpha = {}; low and high are 95 % confidence limits, {}\n",
            answers.words(),
            words(structure),
            words_of_friction(structure),
            answers.limit(),
            answers.words_of_limits(),
        ),
    })
}

/// The PGV (m/s) that nine of ten motions of a PGA (g) have.
fn range_of_pgv(pga_g: f64, peaks: JointPeaks) -> Option<[f64; 2]> {
    let pga_m_s2 = pga_g * G_M_S2;
    let pgv = |deviations: f64| pga_m_s2 * peaks.pgv_over_pga(Peak::Pga, pga_m_s2, deviations);
    (pga_g > 0.0 && pga_g.is_finite()).then(|| [-Z_90, Z_90].map(pgv))
}

/// How far the surface is from the fits: by a factor where that is large, else by a difference.
fn apart(surface: f64, fits: f64) -> String {
    let (ratio, digits) = (surface / fits, |ratio: f64| usize::from(ratio < 10.0));
    if ratio > LARGE_RATIO && ratio.is_finite() {
        format!(": {ratio:.*} times the fits", digits(ratio))
    } else if ratio > 0.0 && ratio.recip() > LARGE_RATIO {
        format!(": the fits are {:.*} times as large", digits(ratio.recip()), ratio.recip())
    } else {
        format!(": {:+.3} from the fits", surface - fits)
    }
}
