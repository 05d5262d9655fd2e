//! Figures 1 and 5: a combined motion and its parts; the responses of two similar structures to similar
//! motions, which are one in dimensionless axes.

use rockfrag_core::fragility::Cases;
use rockfrag_core::motion::{Suite, measures};
use rockfrag_core::rocking::{Record, Structure, simulate, trace};

use super::common::compare;
use crate::chart::{Axis, Dash, Figure, Ink, Layer, Mark, MarkStyle, Panel};
use crate::number;
use crate::table::motions::MotionRow;

/// Number of values that a line is drawn with; of a pulse and of rotations, which are smooth, fewer.
const VALUES: usize = 900;
const SMOOTH_VALUES: usize = 450;
const UNITS: [&str; 2] = ["*a* (m/s^{2})", "*v* (m/s)"];
/// Free rocking that Figure 5 shows, in 1 / p.
const TAIL: f64 = 5.0;

/// Figure 1: acceleration and velocity of a combined motion that has its pulse beside it, and of its parts.
pub fn motion(motions: &[MotionRow]) -> Figure {
    let combined = motions.iter().find(|whole| is_of(whole, Suite::Csgm) && pulse(whole, motions).is_some());
    let Some(whole) = combined.or(motions.first()) else { return Figure::default() };
    let mut parts = vec![("Whole motion", Ink::Data(0), VALUES, whole.acceleration_m_s2.clone())];
    let mut caption = format!("Acceleration and velocity: {}.", words(whole));
    if let Some(pulse) = pulse(whole, motions) {
        let pulse = &pulse.acceleration_m_s2;
        let rest = whole.acceleration_m_s2.iter().zip(pulse).map(|(whole, pulse)| whole - pulse).collect();
        parts.insert(0, ("Coherent pulse", Ink::Data(1), SMOOTH_VALUES, pulse.clone()));
        parts.insert(1, ("High frequencies", Ink::Muted, VALUES, rest));
        caption = compare(&format!("A combined motion and its parts: {}.", words(whole)), "Figure 1");
    }
    let end = whole.acceleration_m_s2.len() as f64 * whole.dt_s;
    // The axes of all parts are the same, so that they compare.
    let mut most = [0.0_f64; 2];
    let mut panels = Vec::new();
    for (title, ink, values, acceleration) in parts {
        let velocity = measures::velocity(&acceleration, whole.dt_s);
        for (place, series) in [acceleration, velocity].iter().enumerate() {
            most[place] = series.iter().fold(most[place], |most, value| most.max(value.abs()));
            let line = Layer::line(title, ink, envelope(series, whole.dt_s, values)).unlisted();
            let time = Axis::linear("time (s)").over(0.0, end);
            panels.push(Panel::new(title, time, Axis::linear(UNITS[place]), vec![line]));
        }
    }
    for (panel, most) in panels.iter_mut().zip(most.into_iter().cycle()) {
        panel.y.range = Some([-1.05 * most, 1.05 * most]);
    }
    Figure::new("motion", "A ground motion", 2, 60.0, panels).explained(caption)
}

fn is_of(motion: &MotionRow, suite: Suite) -> bool {
    motion.suite.as_deref() == Some(suite.into())
}

fn pulse<'a>(whole: &MotionRow, motions: &'a [MotionRow]) -> Option<&'a MotionRow> {
    motions.iter().find(|other| {
        let is_same = (other.mw, other.re_km, other.tp_s) == (whole.mw, whole.re_km, whole.tp_s);
        is_same && is_of(other, Suite::Pulse)
    })
}

fn words(motion: &MotionRow) -> String {
    match motion.mw.zip(motion.re_km) {
        Some((mw, re_km)) => format!("magnitude {mw}, distance {re_km} km"),
        None => format!("motion {}", motion.motion_id),
    }
}

/// Figure 5: the rotations of two structures, under the motion in which the first rocks furthest and stands.
pub fn similarity(groups: &[Cases], motions: &[MotionRow]) -> Option<Figure> {
    let mut structures = groups.iter().map(|cases| &cases.structure);
    let first = structures.next()?;
    let second = structures.find(|other| other.p_rad_s != first.p_rad_s)?;
    let demands = motions.iter().filter_map(|motion| Some((safe_demand(first, motion)?, motion)));
    let (_, motion) = demands.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let faster = second.p_rad_s / first.p_rad_s;
    let stronger = second.alpha_rad.tan() / first.alpha_rad.tan();
    let second = Structure { eta: first.eta, ..second.clone() };
    let responses = [
        (first, 1.0, 1.0, Ink::Data(0), Dash::Solid),
        (&second, faster, stronger, Ink::Data(1), Dash::Short),
    ];
    let (mut own, mut dimensionless) = (Vec::new(), Vec::new());
    for (structure, faster, stronger, ink, dash) in responses {
        let samples: Vec<f64> = motion.acceleration_m_s2.iter().map(|sample| stronger * sample).collect();
        let dt_s = motion.dt_s / faster;
        let (p, alpha) = (structure.p_rad_s, structure.alpha_rad);
        let [p_words, alpha_words] = [p, alpha].map(|value| number::significant(value, 3));
        let name = format!("*p* = {p_words} rad/s, *α* = {alpha_words} rad");
        let layer = |marks: Vec<Mark>| Layer::new(&name, ink, MarkStyle::Line(dash), marks);
        let marks = envelope(&rotations(structure, &samples, dt_s)?, dt_s, SMOOTH_VALUES);
        dimensionless.push(layer(marks.iter().map(|mark| Mark::new(p * mark.x, mark.y / alpha)).collect()));
        own.push(layer(marks));
    }
    let panels = vec![
        Panel::new("In their own units", Axis::linear("time (s)"), Axis::linear("*θ* (rad)"), own),
        Panel::new("Dimensionless", Axis::linear("*p t*"), Axis::linear("*θ* / *α*"), dimensionless),
    ];
    let motion = words(motion);
    let caption = format!(
        "Rotation of two structures under one motion ({motion}), its time scaled by 1/*p*, its acceleration \
         by tan *α*."
    );
    let figure = Figure::new("similarity", "Two similar responses", 2, 105.0, panels);
    Some(figure.explained(compare(&caption, "Figure 5")))
}

fn safe_demand(structure: &Structure, motion: &MotionRow) -> Option<f64> {
    let record = Record::new(&motion.acceleration_m_s2, motion.dt_s).ok()?;
    simulate(structure, &record).outcome.demand().filter(|demand| *demand > 0.0)
}

/// The rotation at each sample, rad, and in free rocking after them.
fn rotations(structure: &Structure, samples: &[f64], dt_s: f64) -> Option<Vec<f64>> {
    let (_, points) = trace(structure, &Record::new(samples, dt_s).ok()?, TAIL / structure.p_rad_s);
    let samples = points.iter().filter(|point| point.solver_event.is_none());
    Some(samples.map(|point| point.theta_rad).collect())
}

/// Cuts a series down to `most` values or fewer: to the least and the largest value of each of `most` / 2
/// steps, in their order.
pub fn envelope(values: &[f64], step: f64, most: usize) -> Vec<Mark> {
    let each = values.len().div_ceil(most).max(1);
    let by_value = |a: &usize, b: &usize| values[*a].total_cmp(&values[*b]);
    let mut kept: Vec<usize> = Vec::new();
    for start in (0..values.len()).step_by(2 * each) {
        let step = start..values.len().min(start + 2 * each);
        kept.extend(step.clone().min_by(by_value).into_iter().chain(step.max_by(by_value)));
    }
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|k| Mark::new(k as f64 * step, values[k])).collect()
}
