//! Figure 5: the responses of two similar structures to similar motions, which are one response in dimensionless axes.

use crate::report::axis::{Axis, range};
use crate::report::data::{Motion, ReportData};
use crate::report::drawing::{Dash, Ink, Stroke};
use crate::report::figure::{Figure, Grid, envelope};
use crate::report::panel::{Mark, Panel};
use crate::report::text::{Label, number};
use crate::rocking::{Outcome, Record, Structure, trace};

/// p and tan alpha of the second structure over those of the first, about as the paper's electrical equipment and frame.
const FASTER: f64 = 2.5;
const STOCKIER: f64 = 4.0 / 3.0;
/// Demands that show.
const SHOWN: std::ops::Range<f64> = 0.2..1.0;
/// Values that a line is drawn with.
const MOST_VALUES: usize = 900;

/// Rotation (rad) at the samples of a motion.
struct History {
    structure: Structure,
    dt_s: f64,
    theta_rad: Vec<f64>,
}

/// Draws the motion under which the first structure rocks most, of those that it and its like come through.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let Some(group) = data.groups.first() else { return Vec::new() };
    let demand = |motion: &&Motion| motion.demand().filter(|demand| SHOWN.contains(demand)).unwrap_or(0.0);
    let mut motions: Vec<&Motion> = data.motions.iter().collect();
    motions.sort_by(|a, b| demand(b).total_cmp(&demand(a)));
    let pairs = motions.into_iter().filter_map(|motion| Some((motion, pair(&group.structure, motion)?)));
    pairs.take(1).map(|(motion, pair)| figure(motion, &pair)).collect()
}

/// The histories of a structure and of one that is similar to it, with equal eta: its motion has the same wp/p and PGA/(g tan alpha)
/// (Eqs. 8 to 11).
fn pair(structure: &Structure, motion: &Motion) -> Option<[History; 2]> {
    let (acceleration, dt_s) = (&motion.acceleration_m_s2, motion.dt_s);
    let first = history(structure.clone(), acceleration, dt_s)?;
    let peak = first.theta_rad.iter().fold(0.0_f64, |peak, theta| peak.max(theta.abs()));
    if !SHOWN.contains(&(peak / structure.alpha_rad)) {
        return None;
    }
    let alpha_rad = libm::atan(STOCKIER * libm::tan(structure.alpha_rad));
    let similar = Structure { p_rad_s: FASTER * structure.p_rad_s, alpha_rad, ..structure.clone() };
    let scaled: Vec<f64> = acceleration.iter().map(|a| STOCKIER * a).collect();
    Some([first, history(similar, &scaled, dt_s / FASTER)?])
}

fn history(structure: Structure, acceleration: &[f64], dt_s: f64) -> Option<History> {
    let (response, points) = trace(&structure, &Record::new(acceleration, dt_s).ok()?);
    let at_samples = points.iter().filter(|point| point.solver_event.is_none());
    let theta_rad = at_samples.map(|point| point.theta_rad).collect();
    (response.outcome == Outcome::SafeRocking).then_some(History { structure, dt_s, theta_rad })
}

fn figure(motion: &Motion, pair: &[History; 2]) -> Figure {
    let strokes: [Stroke; 2] = [Ink::Data(0).line(1.6), Ink::Data(1).dashed(1.0, Dash::Short)];
    let labels = [
        [Label::plain("time (s)"), Label::marked("*θ* (rad)")],
        [Label::marked("*p t*"), Label::marked("*θ* / *α*")],
    ];
    let words = |history: &History| {
        let Structure { p_rad_s, alpha_rad, .. } = history.structure;
        Label::plain(format!("p = {} rad/s, α = {} rad", number::short(p_rad_s), number::short(alpha_rad)))
    };
    let entries: Vec<(Mark, Label)> =
        pair.iter().zip(strokes).map(|(history, stroke)| (Mark::Line(stroke), words(history))).collect();
    let (grid, mut drawing) = Grid::of(labels.len(), 110.0).with_legend(&entries);
    let titles = ["in their own units", "dimensionless"];
    for (index, ([x, y], title)) in labels.into_iter().zip(titles).enumerate() {
        let lines = pair.each_ref().map(|history| {
            let Structure { p_rad_s, alpha_rad, .. } = history.structure;
            let (of_time, of_angle) = if index == 0 { (1.0, 1.0) } else { (p_rad_s, 1.0 / alpha_rad) };
            let drawn = envelope(&history.theta_rad, MOST_VALUES);
            let step = drawn.each as f64 * history.dt_s * of_time;
            let point = |(k, theta): (usize, &f64)| [k as f64 * step, theta * of_angle];
            drawn.values.iter().enumerate().map(point).collect::<Vec<[f64; 2]>>()
        });
        let ends = |axis: usize| range(lines.iter().flatten().map(|point| point[axis]));
        let ([_, last], [low, high]) = (ends(0), ends(1));
        let (corner, width) = grid.place(index);
        let y = Axis::linear([1.08 * low, 1.08 * high], y);
        let panel = Panel { corner, width, height: grid.panel_height, x: Axis::linear([0.0, last], x), y };
        for ((line, stroke), history) in lines.iter().zip(strokes).zip(pair) {
            panel.curve(&mut drawing, &words(history).words(), line, stroke);
        }
        panel.frame(&mut drawing, Label::plain(title).bold());
    }
    Figure {
        name: "histories".to_string(),
        title: "Similarity: two responses that are one".to_string(),
        caption: format!(
            "Rotation of {} in motion {}{}, and of a structure of {} times its p and {} times its tan α, under the same motion {} times as fast and {} times as strong, so that ωp/p and PGA/(g tan α) are equal; η is {} for both. Left in their own units, right in dimensionless ones: there the two differ by what α adds beyond these measures. {}",
            pair[0].structure.name,
            motion.name,
            motion.words,
            number::plain(FASTER),
            number::short(STOCKIER),
            number::plain(FASTER),
            number::short(STOCKIER),
            number::plain(pair[0].structure.eta),
            super::of_paper("Figure 5")
        ),
        made: String::new(),
        drawing,
    }
}
