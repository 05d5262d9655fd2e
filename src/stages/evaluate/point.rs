//! Probabilities at one PGA and PGV, and in words.

use serde::{Deserialize, Serialize};

use super::object::{Answer, ObjectRow, Predicted, Subject};
use super::words::{
    brief, friction, linear, model, model_of_all, mostly_unknown, size, table, title, too_far, unanswered,
    validity, with_sentences,
};
use crate::fragility::{Probability, Scenarios};
use crate::hazard::{Budget, Motion, MotionProbabilities};
use crate::motion::{Floor, IntensityMeasures};
use crate::number::{Limited, PERCENT, aligned, fixed, plain};
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
    /// Of an object under a motion, with the errors of the logit of P_ro.
    pub fn new(motion: &Motion, subject: &Subject) -> (TreeRow, Budget) {
        let MotionProbabilities { states: [rocking, failure, overturning], budgets } =
            motion.probabilities(&subject.directions, &subject.unknowns);
        let given_rocking = |p: Probability| {
            let known = |p: f64| Some(p / rocking.value).filter(|p| p.is_finite());
            [known(p.value), known(p.low), known(p.high)]
        };
        // The demand has a probability of its own under a motion that is known.
        let p_ex = match (&subject.directions[..], motion.pga_m_s2, motion.pgv_m_s) {
            ([(structure, model)], Some(pga), Some(pgv)) => {
                let measures = IntensityMeasures::new(structure, pga, pgv, None, None);
                let given =
                    model.probabilities(structure, &measures, motion.mw, Scenarios::One).given_rocking;
                given.map(|given| given.p_ex).filter(|p| !p.value.is_nan())
            }
            _ => None,
        };
        let [p_ex, p_ex_low, p_ex_high] = match p_ex {
            Some(p) => [p.value, p.low, p.high].map(Some),
            None => [None; 3],
        };
        let [p_ro, p_ro_low, p_ro_high] = given_rocking(overturning);
        let [p_f_r, p_f_r_low, p_f_r_high] = given_rocking(failure);
        let row = TreeRow {
            pga_m_s2: motion.pga_m_s2,
            pgv_m_s: motion.pgv_m_s,
            p_nr: Some(1.0 - rocking.value),
            p_ex,
            p_ex_low,
            p_ex_high,
            p_ro,
            p_ro_low,
            p_ro_high,
            p_f_r,
            p_f_r_low,
            p_f_r_high,
            p_f: Some(failure.value).filter(|p| !p.is_nan()),
            warnings: None,
        };
        (row, budgets.overturning)
    }

    /// Overturning, and failure, over the whole tree.
    fn states(&self) -> [Limited; 2] {
        let given_rocking =
            [[self.p_ro, self.p_ro_low, self.p_ro_high], [self.p_f_r, self.p_f_r_low, self.p_f_r_high]];
        match self.p_nr {
            Some(1.0) => [[Some(0.0); 3]; 2],
            p_nr => given_rocking.map(|p| p.map(|p| Some(p? * (1.0 - p_nr.unwrap_or(0.0))))),
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
        _ if all.iter().all(|answer| answer.object.p_rad_s.is_none()) => {
            all.iter().map(|answer| unanswered(answer, &answer.row.warnings)).collect()
        }
        [answer] => of_one(answer),
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

fn of_one(answer: &Answer<TreeRow>) -> String {
    let Answer { object, row: tree, budget, .. } = answer;
    let rocks = if tree.rocks() { "rocks" } else { "does not rock" };
    let peak = if object.floor_level.is_some() { "the floor's peak acceleration" } else { "PGA" };
    let uplift = match tree.pga_m_s2 {
        Some(pga) => {
            format!("{rocks}: {peak} is {} times what uplifts it\n", times_uplift(object, tree, pga))
        }
        None => format!("rocks with a probability of {}\n", PERCENT.one(1.0 - tree.p_nr.unwrap_or(f64::NAN))),
    };
    let add = match (tree.pga_m_s2, tree.pgv_m_s) {
        (Some(_), None) => "Add --pgv.",
        _ => "Add --pga.",
    };
    let unknown = mostly_unknown(budget, add).map_or(String::new(), |text| text + "\n");
    let peaks = words_of_peaks(tree);
    let by = format!("{} {peaks}, by {}.\n{}\n", title(object), model(object), validity(object));
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
    aligned(&lines, |_| false) + &uplift + &unknown + &by
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
    let linear = linear(all.iter().map(|answer| &answer.object));
    format!("{first}\n{table}All {}, by {}.{linear}\n", words_of_peaks(&worst.row), model_of_all(all))
}

fn words_of_peaks(tree: &TreeRow) -> String {
    let pga = tree.pga_m_s2.map(|pga| format!("{} g", plain(pga / G_M_S2)));
    let pgv = tree.pgv_m_s.map(|pgv| format!("{} m/s", plain(pgv)));
    format!("at {}", [pga, pgv].into_iter().flatten().collect::<Vec<_>>().join(" and "))
}

/// PGA over that of uplift.
fn times_uplift(object: &ObjectRow, tree: &TreeRow, pga_m_s2: f64) -> String {
    let floor = object.floor_period_s.zip(object.floor_level);
    let pfa_m_s2 = floor
        .zip(tree.pgv_m_s)
        .map_or(pga_m_s2, |((period_s, level), pgv)| Floor { period_s, level }.peaks(pga_m_s2, pgv).pfa_m_s2);
    let times = pfa_m_s2 / (object.friction.unwrap_or(f64::NAN) * G_M_S2);
    fixed(times, if times > 10.0 { 0 } else { 1 })
}
