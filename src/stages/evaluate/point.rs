//! Probabilities at a PGA, a PGV or both, and in words.

use std::path::Path;

use rockfrag_core::fragility::{LimitStates, RockingDirection, Tau};
use rockfrag_core::hazard::{Budget, GroundMotion, MotionProbabilities};
use rockfrag_core::motion::{Floor, IntensityMeasures, Peaks};
use rockfrag_core::object::RockingObject;
use rockfrag_core::statistics::Interval;
use rockfrag_core::units::G_M_S2;
use serde::{Deserialize, Serialize};

use super::object::Predicted;
use super::words::{
    about_buildings, friction, line, model, model_of_all, mostly_unknown, table, validity, where_silent,
};
use crate::number::{PERCENT, aligned, fixed, name, plain};
use crate::table::answers::{Answer, ObjectRow, RatesRow};

/// The probabilities of the tree at an intensity; none where they are not known.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TreeRow {
    pub pga_m_s2: Option<f64>,
    pub pgv_m_s: Option<f64>,
    pub p_nr: Option<f64>,
    pub p_ex: Interval<Option<f64>>,
    pub p_ro: Interval<Option<f64>>,
    pub p_f_r: Interval<Option<f64>>,
    pub p_f: Option<f64>,
    /// Failure, and overturning, over the whole tree.
    #[serde(skip)]
    states: LimitStates<Interval<Option<f64>>>,
}

impl TreeRow {
    /// Predicts for an object under a motion, with the budget of the logit of P_ro.
    pub fn new(motion: &GroundMotion, rocking_object: &RockingObject) -> (TreeRow, Budget) {
        let MotionProbabilities { states, budget } = motion.probabilities(rocking_object);
        let rocking = states.rocking.value;
        // The demand has a probability of its own under a motion that is known.
        let p_ex = match (&rocking_object.directions[..], motion.pga_m_s2, motion.pgv_m_s) {
            _ if motion.is_still() => None,
            ([RockingDirection { structure, model }], Some(pga_m_s2), Some(pgv_m_s)) => {
                let peaks = Peaks { pga_m_s2, pgv_m_s };
                let measures = IntensityMeasures::new(structure, peaks, None, None);
                model.probabilities(structure, &measures, motion.mw, Tau::Included).given_rocking
            }
            _ => None,
        };
        let row = TreeRow {
            pga_m_s2: motion.pga_m_s2,
            pgv_m_s: motion.pgv_m_s,
            p_nr: rocking.map(|p| 1.0 - p),
            p_ex: p_ex.and_then(|given| given.p_ex).into(),
            p_ro: over(rocking, states.overturning),
            p_f_r: over(rocking, states.failure),
            p_f: states.failure.value,
            states,
        };
        (row, budget)
    }

    /// What a page shows of it.
    pub fn without_rates(&self) -> RatesRow {
        let LimitStates { failure, overturning, .. } = self.states;
        let p_rocking = self.p_nr.map(|p_nr| 1.0 - p_nr);
        let (p_failure, p_overturning) = (Interval::without_limits(failure.value), overturning);
        RatesRow { p_rocking, p_failure, p_overturning, ..RatesRow::default() }
    }

    fn rocks(&self) -> bool {
        self.p_nr.is_some_and(|p_nr| p_nr < 1.0)
    }
}

/// A probability over that of rocking; none where that is 0.
fn over(rocking: Option<f64>, p: Interval<Option<f64>>) -> Interval<Option<f64>> {
    rocking.filter(|rocking| *rocking > 0.0).map_or(Interval::default(), |rocking| p.map(|p| p / rocking))
}

impl Predicted for TreeRow {
    fn overturning(&self) -> Interval<Option<f64>> {
        self.states.overturning
    }
}

/// The answer for all objects, in words.
pub fn text(all: &[Answer<TreeRow>], out: Option<&Path>) -> String {
    super::words::text(all, tell, || tell_list(all, out))
}

fn tell(answer: &Answer<TreeRow>) -> String {
    let Answer { object, row: tree, .. } = answer;
    let LimitStates { failure, overturning, .. } = tree.states;
    let limits = PERCENT.limits(overturning, "95 % limits ");
    let lines = [
        vec!["overturns".to_string(), PERCENT.value(overturning), limits],
        vec![
            format!("overturns, or {}", object.too_far()),
            PERCENT.value(failure),
            PERCENT.limits(failure, ""),
        ],
    ];
    let add = if tree.pga_m_s2.is_some() { "Add --pgv." } else { "Add --pga." };
    let (lines, unknown) = match tree.rocks() {
        true => (aligned(&lines, |_| false), line([mostly_unknown(answer, add)])),
        false => Default::default(),
    };
    let (uplift, title, peaks, model) =
        (uplift(object, tree), object.title(), words_of_peaks(tree), model(object));
    format!("{lines}{uplift}{unknown}{title} {peaks}, by {model}.\n{}", validity(answer))
}

fn tell_list(all: &[Answer<TreeRow>], out: Option<&Path>) -> String {
    let worst = &all[0];
    let first = match worst.row.overturning() {
        _ if !all.iter().any(|answer| answer.row.rocks()) => "nothing rocks".to_string() + &where_silent(all),
        Interval { value: None | Some(0.0), .. } => "nothing overturns".to_string() + &where_silent(all),
        p => {
            let (name, p) = (name(&worst.object.structure), PERCENT.both(p, "95 % limits "));
            format!("{name} is the most likely to overturn: {p}")
        }
    };
    let table = table(
        &["rocks", "overturns", "", "or too far", "friction"],
        all,
        out,
        |Answer { object, row, .. }| {
            let LimitStates { failure, overturning, .. } = row.states;
            let rocks = row.p_nr.map_or("-", |_| if row.rocks() { "yes" } else { "no" });
            vec![
                rocks.to_string(),
                PERCENT.value(overturning),
                PERCENT.limits(overturning, ""),
                PERCENT.value(failure),
                friction(object),
            ]
        },
    );
    let by = format!("All {}, by {}.", words_of_peaks(&worst.row), model_of_all(all));
    format!("{first}\n{table}{}", line([Some(by), about_buildings(all)]))
}

pub fn words_of_peaks(tree: &TreeRow) -> String {
    let pga = tree.pga_m_s2.map(|pga| format!("{} g", plain(pga / G_M_S2)));
    let pgv = tree.pgv_m_s.map(|pgv| format!("{} m/s", plain(pgv)));
    format!("at {}", [pga, pgv].into_iter().flatten().collect::<Vec<_>>().join(" and "))
}

/// Whether it rocks: by the peak of the ground, or of the floor, over that of uplift.
fn uplift(object: &ObjectRow, tree: &TreeRow) -> String {
    if tree.pga_m_s2 == Some(0.0) || tree.pgv_m_s == Some(0.0) {
        return "does not rock: nothing moves it\n".to_string();
    }
    let Some((pga_m_s2, friction)) = tree.pga_m_s2.zip(object.friction) else {
        let rocks = |p_nr| format!("rocks with a probability of {}\n", PERCENT.one(1.0 - p_nr));
        return tree.p_nr.map_or(String::new(), rocks);
    };
    let floor = object.floor_period_s.zip(object.floor_level);
    let floor = floor.map(|(period_s, level)| Floor { period_s, level });
    let on_floor = floor.zip(tree.pgv_m_s);
    let pfa_m_s2 = on_floor.map(|(floor, pgv_m_s)| floor.peaks(Peaks { pga_m_s2, pgv_m_s }).pga_m_s2);
    let times = pfa_m_s2.unwrap_or(pga_m_s2) / (friction * G_M_S2);
    let rocks = if tree.rocks() { "rocks" } else { "does not rock" };
    let peak = if floor.is_some() { "the floor's peak acceleration" } else { "PGA" };
    format!("{rocks}: {peak} is {} times what uplifts it\n", fixed(times, if times > 10.0 { 0 } else { 1 }))
}
