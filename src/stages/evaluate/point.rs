//! Probabilities at one PGA and PGV, and in words.

use serde::{Deserialize, Serialize};

use super::object::{Answer, ObjectRow, Predicted};
use super::words::{brief, friction, model, size, table, title, too_far, validity, with_sentences};
use crate::fragility::{GivenRocking, Model, Probabilities, Probability, Scenarios};
use crate::motion::IntensityMeasures;
use crate::number::{Limited, PERCENT, aligned, fixed, plain};
use crate::rocking::Structure;
use crate::units::G_M_S2;

/// The probabilities of the tree at an intensity; none where they are not known.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TreeRow {
    pub pga_m_s2: Option<f64>,
    pub pgv_m_s: Option<f64>,
    pub p_nr: Option<f64>,
    pub p_ex: Option<f64>,
    pub p_ex_low: Option<f64>,
    pub p_ex_high: Option<f64>,
    pub p_ro: Option<f64>,
    pub p_ro_low: Option<f64>,
    pub p_ro_high: Option<f64>,
    pub p_f_r: Option<f64>,
    pub p_f_r_low: Option<f64>,
    pub p_f_r_high: Option<f64>,
    pub p_f: Option<f64>,
    pub warnings: Option<String>,
}

impl TreeRow {
    /// Of a structure under a motion.
    pub fn new(
        structure: &Structure,
        model: &Model,
        measures: &IntensityMeasures,
        peaks: [f64; 2],
    ) -> TreeRow {
        TreeRow::of(peaks, &model.probabilities(structure, measures, None, Scenarios::One))
    }

    fn of(peaks: [f64; 2], probabilities: &Probabilities) -> TreeRow {
        let given = probabilities.given_rocking;
        let of = |p: fn(&GivenRocking) -> Probability| {
            let known = given.as_ref().map(p).filter(|p| !p.value.is_nan());
            [known.map(|p| p.value), known.map(|p| p.low), known.map(|p| p.high)]
        };
        let [p_ex, p_ex_low, p_ex_high] = of(|given| given.p_ex);
        let [p_ro, p_ro_low, p_ro_high] = of(|given| given.p_ro);
        let [p_f_r, p_f_r_low, p_f_r_high] = of(|given| given.p_failure);
        TreeRow {
            pga_m_s2: Some(peaks[0]),
            pgv_m_s: Some(peaks[1]),
            p_nr: Some(probabilities.p_nr),
            p_ex,
            p_ex_low,
            p_ex_high,
            p_ro,
            p_ro_low,
            p_ro_high,
            p_f_r,
            p_f_r_low,
            p_f_r_high,
            p_f: probabilities.limit_states().map(|states| states[1].value).filter(|p| !p.is_nan()),
            warnings: None,
        }
    }

    /// Overturning, and failure, over the whole tree.
    fn states(&self) -> [Limited; 2] {
        match self.p_nr {
            Some(1.0) => [[Some(0.0); 3]; 2],
            _ => [[self.p_ro, self.p_ro_low, self.p_ro_high], [self.p_f_r, self.p_f_r_low, self.p_f_r_high]],
        }
    }

    fn rocks(&self) -> bool {
        self.p_nr != Some(1.0)
    }
}

impl Predicted for TreeRow {
    fn with_warnings(self, warnings: Option<String>) -> TreeRow {
        TreeRow { warnings, ..self }
    }

    fn severity(&self) -> f64 {
        self.p_ro.or(self.p_nr.map(|p_nr| -p_nr)).unwrap_or(f64::NEG_INFINITY)
    }
}

/// The answer for all objects, in words.
pub fn text(all: &[Answer<TreeRow>], sentence: bool) -> String {
    let text = match all {
        [] => String::new(),
        [Answer { object, row, .. }] => of_one(object, row),
        [worst, ..] => of_several(worst, all),
    };
    with_sentences(text, all, sentence, |object, tree| {
        let overturns = match tree.rocks() {
            false => "does not rock".to_string(),
            true => {
                let p = PERCENT.both(tree.states()[0], "95 % confidence limits ");
                format!("overturns with a probability of {p}")
            }
        };
        format!("{overturns} {}, by {}", words_of_peaks(tree), model(object))
    })
}

fn of_one(object: &ObjectRow, tree: &TreeRow) -> String {
    let rocks = if tree.rocks() { "rocks" } else { "does not rock" };
    let uplift = format!("{rocks}: PGA is {} times what uplifts it\n", times_uplift(object, tree));
    let peaks = words_of_peaks(tree);
    let by = format!("{} {peaks}, by {}. {}\n", title(object), model(object), validity(object));
    if !tree.rocks() {
        return uplift + &by;
    }
    let [overturning, failure] = tree.states();
    let line = |name: &str, p: Limited, limits: &str| {
        vec![name.to_string(), PERCENT.value(p), PERCENT.limits(p, limits)]
    };
    let lines = [
        line("overturns", overturning, "95 % limits "),
        line(&format!("overturns, or {}", too_far(object)), failure, ""),
    ];
    aligned(&lines, |_| false) + &uplift + &by
}

fn of_several(worst: &Answer<TreeRow>, all: &[Answer<TreeRow>]) -> String {
    let first = match worst.row.states()[0] {
        [None | Some(0.0), ..] => "nothing overturns".to_string(),
        p => {
            let (name, p) = (&worst.object.structure, PERCENT.both(p, "95 % limits "));
            format!("{name} overturns most probably: {p}")
        }
    };
    let heading = ["object", "size", "rocks", "overturns", "", "or too far", "friction", "warning"];
    let table = table(&heading, all, |answer| {
        let Answer { object, row: tree, .. } = answer;
        let [overturning, failure] = tree.states();
        let rocks = tree.p_nr.map_or("-", |_| if tree.rocks() { "yes" } else { "no" });
        vec![
            object.structure.clone(),
            size(object),
            rocks.to_string(),
            PERCENT.value(overturning),
            PERCENT.limits(overturning, ""),
            PERCENT.value(failure),
            friction(object),
            brief(answer, &tree.warnings),
        ]
    });
    format!("{first}\n{table}All {}, by {}.\n", words_of_peaks(&worst.row), model(&worst.object))
}

fn words_of_peaks(tree: &TreeRow) -> String {
    let [pga, pgv] = [tree.pga_m_s2.unwrap_or_default() / G_M_S2, tree.pgv_m_s.unwrap_or_default()];
    format!("at {} g and {} m/s", plain(pga), plain(pgv))
}

/// PGA over that of uplift.
fn times_uplift(object: &ObjectRow, tree: &TreeRow) -> String {
    let uplift = object.friction.unwrap_or(f64::NAN) * G_M_S2;
    let times = tree.pga_m_s2.unwrap_or_default() / uplift;
    fixed(times, if times > 10.0 { 0 } else { 1 })
}
