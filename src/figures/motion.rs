//! Figures 1 and 5: a combined motion and its parts; the responses of two similar structures to similar
//! motions, which are one in dimensionless axes.

use rockfrag_core::fragility::Cases;
use rockfrag_core::motion::{Suite, measures};
use rockfrag_core::rocking::{Record, Structure, simulate, trace};

use super::common::compare;
use crate::chart::{Axis, Dash, Figure, Ink, Layer, Mark, MarkStyle, Panel};
use crate::number;
use crate::table::motions::MotionRow;

/// Number of values that a line is drawn with.
const VALUES: usize = 900;
const UNITS: [&str; 2] = ["*a* (m/s^{2})", "*v* (m/s)"];
/// Free rocking that Figure 5 shows, in 1 / p.
const TAIL: f64 = 5.0;

/// Figure 1: acceleration and velocity of a combined motion that has its pulse beside it, and of its parts.
pub fn motion(motions: &[MotionRow]) -> Figure {
    let of = |suite: Suite| motions.iter().filter(move |one| one.suite.as_deref() == Some(suite.into()));
    let scenario = |motion: &MotionRow| (motion.mw, motion.re_km, motion.tp_s);
    let pulse = |whole| of(Suite::Pulse).find(|pulse| scenario(pulse) == scenario(whole));
    let pair = of(Suite::Csgm).find_map(|whole| Some((whole, pulse(whole)?)));
    let Some((whole, pulse)) = pair else { return Figure::default() };
    let samples = whole.acceleration_m_s2.iter().zip(&pulse.acceleration_m_s2);
    let parts = [
        ("Coherent pulse", Ink::Data(1), pulse.acceleration_m_s2.clone()),
        ("High frequencies", Ink::Muted, samples.map(|(whole, pulse)| whole - pulse).collect()),
        ("Whole motion", Ink::Data(0), whole.acceleration_m_s2.clone()),
    ];
    // The axes of all parts are the same, so that they compare.
    let mut most = [0.0_f64; 2];
    let mut panels = Vec::new();
    for (title, ink, acceleration) in parts {
        let velocity = measures::velocity(&acceleration, whole.dt_s);
        for (place, series) in [acceleration, velocity].iter().enumerate() {
            most[place] = series.iter().fold(most[place], |most, value| most.max(value.abs()));
            let line = Layer::line(title, ink, envelope(series, whole.dt_s, VALUES)).unlisted();
            panels.push(Panel::new(title, Axis::linear("time (s)"), Axis::linear(UNITS[place]), vec![line]));
        }
    }
    for (panel, most) in panels.iter_mut().zip(most.into_iter().cycle()) {
        panel.y.range = Some([-1.05 * most, 1.05 * most]);
    }
    let caption = format!("A combined motion and its parts: {}.", words(whole));
    Figure::new("motion", "A ground motion", 2, 60.0, panels).explained(compare(&caption, "Figure 1"))
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
    let second = Structure { eta: first.eta, ..second.clone() };
    let (mut own, mut dimensionless) = (Vec::new(), Vec::new());
    for (structure, ink, dash) in [(first, Ink::Data(0), Dash::Solid), (&second, Ink::Data(1), Dash::Short)] {
        let (p, alpha) = (structure.p_rad_s, structure.alpha_rad);
        let (faster, stronger) = (p / first.p_rad_s, alpha.tan() / first.alpha_rad.tan());
        let samples: Vec<f64> = motion.acceleration_m_s2.iter().map(|sample| stronger * sample).collect();
        let dt_s = motion.dt_s / faster;
        let [p_words, alpha_words] = [p, alpha].map(|value| number::significant(value, 3));
        let name = format!("*p* = {p_words} rad/s, *α* = {alpha_words} rad");
        let layer = |marks: Vec<Mark>| Layer::new(&name, ink, MarkStyle::Line(dash), marks);
        let marks = envelope(&rotations(structure, &samples, dt_s)?, dt_s, VALUES);
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
