//! Figures 1 and 5: a combined motion and its parts; the responses of two similar structures to similar
//! motions, which are one in dimensionless axes.

use super::common::compare;
use crate::fragility::Cases;
use crate::keyword::Keyword;
use crate::motion::{Suite, measures};
use crate::number;
use crate::report::{Axis, Dash, Figure, Ink, Layer, Panel};
use crate::rocking::{Record, Structure, simulate, trace, with_tail};
use crate::table::motions::Motion;

/// Number of values that a line is drawn with; of a pulse and of rotations, which are smooth, fewer.
const VALUES: usize = 1200;
const SMOOTH_VALUES: usize = 450;
/// Free rocking that Figure 5 shows, in 1 / p.
const TAIL: f64 = 5.0;

/// Figure 1: the coherent pulse, the high frequencies, the whole motion, and the velocities; of a combined
/// motion that has its pulse beside it, else of any.
pub fn motion(motions: &[Motion]) -> Figure {
    let is = |motion: &Motion, suite: Suite| motion.suite.as_deref() == Some(suite.as_str());
    let same = |a: &Motion, b: &Motion| (a.mw, a.re_km, a.tp_s) == (b.mw, b.re_km, b.tp_s);
    let pulse = |whole: &Motion| motions.iter().find(|other| is(other, Suite::Pulse) && same(whole, other));
    let combined = motions.iter().find(|whole| is(whole, Suite::Csgm) && pulse(whole).is_some());
    let Some(whole) = combined.or(motions.first()) else { return Figure::default() };
    let Motion { dt_s, acceleration_m_s2, .. } = whole;
    let line = |label: &str, ink: Ink, values: &[f64], most: usize| {
        vec![Layer::line(label, ink, envelope(values, *dt_s, most))]
    };
    let whole_line = |values: &[f64]| line("whole motion", Ink::Data(0), values, VALUES);
    let coherent = |values: &[f64]| line("pulse", Ink::Data(1), values, SMOOTH_VALUES);
    let velocity = |motion: &Motion| measures::velocity(&motion.acceleration_m_s2, motion.dt_s);
    let panel = |title: &str, time: &str, unit: &str, layers: Vec<Layer>| {
        let time = Axis::linear(time).over(0.0, acceleration_m_s2.len() as f64 * dt_s);
        Panel::new(title, time, Axis::linear(unit), layers)
    };
    const UNIT: &str = "*a* (m/s^{2})";
    let mut panels = Vec::new();
    let mut velocities = whole_line(&velocity(whole));
    let mut caption = format!("Acceleration and velocity: {}.", words(whole));
    if let Some(pulse) = pulse(whole) {
        let parts = acceleration_m_s2.iter().zip(&pulse.acceleration_m_s2);
        let rest: Vec<f64> = parts.map(|(whole, pulse)| whole - pulse).collect();
        let rest = line("high frequencies", Ink::Muted, &rest, VALUES);
        panels.push(panel("Coherent pulse", "", UNIT, coherent(&pulse.acceleration_m_s2)));
        panels.push(panel("High frequencies", "", UNIT, rest));
        velocities.extend(coherent(&velocity(pulse)));
        caption = compare(&format!("A combined motion and its parts: {}.", words(whole)), "Figure 1");
    }
    panels.push(panel("Whole motion", "", UNIT, whole_line(acceleration_m_s2)));
    panels.push(panel("Velocity", "time (s)", "*v* (m/s)", velocities));
    Figure::new("motion", "A ground motion", caption, 1, 46.0, panels)
}

fn words(motion: &Motion) -> String {
    match motion.mw.zip(motion.re_km) {
        Some((mw, re_km)) => format!("magnitude {mw}, distance {re_km} km"),
        None => format!("motion {}", motion.motion_id),
    }
}

/// Figure 5: the rotations of two structures in their own units and in dimensionless ones, under the motion
/// in which the first rocks furthest without overturning.
pub fn similarity(groups: &[Cases], motions: &[Motion]) -> anyhow::Result<Figure> {
    let mut structures = groups.iter().map(|cases| &cases.structure);
    let Some(first) = structures.next() else { return Ok(Figure::default()) };
    let other = structures.find(|other| other.p_rad_s != first.p_rad_s);
    let Some(second) = other else { return Ok(Figure::default()) };
    let demand = |motion: &Motion| {
        let record = Record::new(&motion.acceleration_m_s2, motion.dt_s).ok()?;
        simulate(first, &record).outcome.demand().filter(|demand| *demand > 0.0)
    };
    let demands = motions.iter().filter_map(|motion| Some((demand(motion)?, motion)));
    let furthest = demands.max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, motion)) = furthest else { return Ok(Figure::default()) };
    let faster = second.p_rad_s / first.p_rad_s;
    let stronger = second.alpha_rad.tan() / first.alpha_rad.tan();
    let scaled: Vec<f64> = motion.acceleration_m_s2.iter().map(|sample| stronger * sample).collect();
    let second = Structure { eta: first.eta, ..second.clone() };
    let rotations = [
        (first, motion.dt_s, rotations(first, &motion.acceleration_m_s2, motion.dt_s)?),
        (&second, motion.dt_s / faster, rotations(&second, &scaled, motion.dt_s / faster)?),
    ];
    let panel = |title: &str, x: &str, y: &str, is_dimensionless: bool| {
        let styles = [(Ink::Data(0), Dash::Solid), (Ink::Data(1), Dash::Short)];
        let lines = rotations.iter().zip(styles).map(|((structure, dt_s, theta_rad), (ink, dash))| {
            let Structure { p_rad_s, alpha_rad, .. } = **structure;
            let [p, alpha] = [p_rad_s, alpha_rad].map(|value| number::significant(value, 3));
            let (time, angle) = if is_dimensionless { (p_rad_s, alpha_rad) } else { (1.0, 1.0) };
            let points = envelope(theta_rad, dt_s * time, SMOOTH_VALUES).into_iter();
            let points = points.map(|[t, theta]| [t, theta / angle]).collect();
            Layer::curve(&format!("*p* = {p} rad/s, *α* = {alpha} rad"), ink, dash, points, Vec::new())
        });
        Panel::new(title, Axis::linear(x), Axis::linear(y), lines.collect())
    };
    let panels = vec![
        panel("In their own units", "time (s)", "*θ* (rad)", false),
        panel("Dimensionless", "*p t*", "*θ* / *α*", true),
    ];
    let [faster, stronger] = [faster, stronger].map(|ratio| number::significant(ratio, 3));
    let caption = format!(
        "Rotation under a motion ({}), and of a structure of {faster} times the *p* under the same motion, \
         {faster} times as fast and {stronger} times as strong. In dimensionless axes the two responses \
         coincide, apart from a small effect of *α*.",
        words(motion)
    );
    let caption = compare(&caption, "Figure 5");
    Ok(Figure::new("similarity", "Two similar responses", caption, 2, 105.0, panels))
}

/// The rotation at each sample, rad, and in free rocking after them.
fn rotations(structure: &Structure, samples: &[f64], dt_s: f64) -> anyhow::Result<Vec<f64>> {
    let ended = with_tail(&Record::new(samples, dt_s)?, TAIL / structure.p_rad_s);
    let (_, points) = trace(structure, &Record::new(&ended, dt_s)?);
    let samples = points.iter().filter(|point| point.solver_event.is_none());
    Ok(samples.map(|point| point.theta_rad).collect())
}

/// Cuts a series down to `most` values or fewer: to the least and the largest value of each of `most` / 2
/// steps, in their order.
pub fn envelope(values: &[f64], step: f64, most: usize) -> Vec<[f64; 2]> {
    let each = values.len().div_ceil(most).max(1);
    let ends = values.chunks(2 * each).enumerate().flat_map(|(k, bucket)| {
        let index = |is_better: fn(&f64, &f64) -> bool| {
            (1..bucket.len())
                .fold(0, |best, at| if is_better(&bucket[at], &bucket[best]) { at } else { best })
        };
        let (least, largest) = (index(f64::lt), index(f64::gt));
        let value = move |at: usize| [(2 * k * each + at) as f64 * step, bucket[at]];
        [value(least.min(largest)), value(least.max(largest))]
    });
    match each {
        1 => values.iter().enumerate().map(|(k, value)| [k as f64 * step, *value]).collect(),
        _ => ends.collect(),
    }
}
