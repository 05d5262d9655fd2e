//! What predicts, the motion and its measures, and what other kinds of motion would give.

use crate::fragility::{Calibration, Kind, Measure, Model, Scenarios};
use crate::hazard::Budget;
use crate::keyword::Keyword;
use crate::motion::{IntensityMeasures, Peaks};
use crate::number::{PERCENT, count, significant};
use crate::object::Part;
use crate::rocking::Structure;
use crate::units::G_M_S2;

/// Explains the answer for a structure; `motion` is the one that matters.
pub fn explained(model: &Model, structure: &Structure, motion: Peaks, budget: &Budget) -> String {
    let measures = IntensityMeasures::new(structure, motion, None, None);
    let mut lines = Vec::new();
    let limit_state = match model {
        Model::Calibrated { overturning, exceeding, .. } => {
            lines.push(("overturning:", calibration(overturning)));
            lines.push(("too far:", calibration(exceeding)));
            let Calibration { pga, ratio, .. } = overturning;
            if let Some(((low, high), (least, most))) = pga.low.zip(pga.high).zip(ratio.low.zip(ratio.high)) {
                let [low, high, least, most] =
                    [low / G_M_S2, high / G_M_S2, least, most].map(|value| significant(value, 3));
                let words = format!("PGA of {low} to {high} g, PGV/PGA of {least} to {most} s");
                lines.push(("fitted to:", words));
            }
            exceeding.limit_state
        }
        Model::Paper { demand, overturning, limit_state, .. } => {
            let forms: Vec<String> = demand.iter().map(|fit| fit.model.to_string()).collect();
            let (status, im_x, forms) = (overturning.status, overturning.im_x, forms.join(", "));
            lines.push(("overturning:", format!("{status} over {im_x}; too far: {forms}")));
            Some(*limit_state)
        }
    };
    let [pga, pgv] = [motion.pga_m_s2 / G_M_S2, motion.pgv_m_s].map(|peak| significant(peak, 3));
    lines.push(("motion:", format!("PGA {pga} g, PGV {pgv} m/s")));
    let mut words = Vec::new();
    for measure in Measure::SCALAR {
        let value = measure.raw_value_of(&measures).map(|value| significant(value, 3));
        words.extend(value.map(|value| format!("{} {value}", measure.as_str().to_uppercase())));
    }
    lines.push(("measures:", words.join(", ")));
    let mut parts = Vec::new();
    for part in Part::ALL {
        parts.extend(budget.part_sd(*part).map(|sd| format!("{part} {}", significant(sd, 2))));
    }
    if !parts.is_empty() {
        let ([down, up], parts) = (budget.sds().map(|sd| significant(sd, 2)), parts.join(", "));
        lines.push(("errors:", format!("{parts}; all -{down} +{up} (sd of ln rate, or of logit)")));
    }
    let mut others = Vec::new();
    for kind in Kind::ALL.iter().filter(|_| limit_state.is_some()) {
        let shipped = Model::shipped(*kind, structure, limit_state.unwrap_or_default());
        let given = shipped.probabilities(structure, &measures, None, Scenarios::One).given_rocking;
        others.extend(
            given.map(|given| {
                format!("{} by the surface for {}", PERCENT.one(given.p_ro.value), kind.words())
            }),
        );
    }
    if !others.is_empty() {
        lines.push(("overturning:", others.join(", ")));
    }
    let lines: String = lines.iter().map(|(name, words)| format!("{name:12} {words}\n")).collect();
    format!("\n{}\n{lines}", structure.name)
}

fn calibration(of: &Calibration) -> String {
    let fit = match of.n {
        0 => String::new(),
        _ => {
            let [events, n, clusters] = [of.n_events, of.n, of.n_clusters].map(|n| count(n as usize));
            format!("; {events} events in {n} responses of {clusters} clusters")
        }
    };
    let (c, s, kind, m, tau) = (of.c, of.ln_s.exp(), of.kind.words(), of.m, of.tau);
    format!("logit P = {c:.2} + {s:.2} logit P of the surface ({kind}) + {m:.2} (M - 6.9); tau {tau:.2}{fit}")
}
