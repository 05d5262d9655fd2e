//! One response: rotation and ground motion over time, with its events; and the block as it moves.

use rockfrag_core::rocking::{SolverEvent, Structure};
use rockfrag_core::statistics::Range;
use rockfrag_core::units::G_M_S2;

use super::Document;
use crate::chart::round;
use crate::chart::text::{escape, file_words, literal, words};
use crate::chart::{Axis, Figure, Ink, LabelPosition, Layer, Mark, Panel, Symbol};
use crate::figures::common::called;
use crate::figures::envelope;
use crate::number;
use crate::table::responses::TraceRow;

/// A structure under a motion: a row at each sample and event, one or more.
#[derive(Debug, Clone)]
pub struct Trace(pub Vec<TraceRow>);

/// Values of a line.
const VALUES: usize = 900;
/// Height of the area of the data of a panel, points.
const HEIGHT: f64 = 58.0;
/// Rotations over alpha are drawn up to this.
const MOST: f64 = 1.5;
/// Time that is shown before the first event and after the last, s.
const AROUND_S: f64 = 1.5;
/// The picture of what moves: the diagonal of the block, the least width and the margin beside the block.
const DIAGONAL: f64 = 190.0;
const NARROWEST: f64 = 290.0;
const MARGIN: f64 = 24.0;
/// Pictures a second of what moves, and the most of them.
const PICTURES_A_SECOND: f64 = 25.0;
const MOST_PICTURES: f64 = 1200.0;

impl Trace {
    /// The motion, and the structure or the block that rocks like it.
    fn title(&self) -> String {
        let TraceRow { motion_id, structure, p_rad_s, alpha_rad, eta, .. } = &self.0[0];
        let (name, [p_rad_s, alpha_rad, eta]) = (structure.clone(), [*p_rad_s, *alpha_rad, *eta]);
        let structure = Structure { name, p_rad_s, alpha_rad, eta, rebound: None };
        format!("Motion {}: {}", literal(motion_id), called(&structure))
    }

    fn times(&self, event: SolverEvent) -> Vec<f64> {
        self.0.iter().filter(|point| point.solver_event == Some(event)).map(|point| point.time_s).collect()
    }

    fn overturned_at(&self) -> Option<f64> {
        self.times(SolverEvent::Overturn).first().copied()
    }

    /// When it passes alpha for good, of a structure that overturns.
    fn tipped_at(&self) -> Option<f64> {
        let stood = self.0.iter().rposition(|point| point.theta_over_alpha.abs() <= 1.0)?;
        self.overturned_at().and(self.0.get(stood + 1)).map(|point| point.time_s)
    }

    fn sentence(&self) -> String {
        let impacts = number::counted(self.times(SolverEvent::Impact).len(), "impact");
        let most = self.0.iter().map(|point| point.theta_over_alpha.abs()).fold(0.0, f64::max);
        let degrees = number::significant(self.0[0].alpha_rad.to_degrees(), 3);
        let angle = format!("its tipping angle of {degrees}°");
        match (self.overturned_at(), self.times(SolverEvent::Uplift).first()) {
            (Some(at), _) => {
                let [tips, lies] = [self.tipped_at().unwrap_or(at), at].map(|at| number::fixed(at, 1));
                format!(
                    "It overturns: it passes {angle} at {tips} s and lies flat at {lies} s, after {impacts}."
                )
            }
            (None, Some(at)) => {
                let (at, most) = (number::fixed(*at, 1), number::PERCENT.one(most));
                format!("It rocks from {at} s on, up to {most} of {angle}, with {impacts}.")
            }
            _ => "It does not rock.".to_string(),
        }
    }

    /// From when to when something happens, s.
    fn span(&self) -> Range {
        let end = self.0.last().map_or(0.0, |point| point.time_s);
        let is_moving = |one: &&TraceRow| one.solver_event.is_some() || one.theta_over_alpha.abs() > 1e-3;
        let moving = Range::over(self.0.iter().filter(is_moving).map(|point| point.time_s));
        match moving.low <= moving.high {
            true => Range { low: (moving.low - AROUND_S).max(0.0), high: (moving.high + AROUND_S).min(end) },
            false => Range { low: 0.0, high: end.min(10.0) },
        }
    }
}

/// The rotation and the motion of the ground, beside what moves; `id` is its own on the page.
pub fn figure(response: &Trace, id: usize) -> Figure {
    let samples: Vec<&TraceRow> = response.0.iter().filter(|point| point.solver_event.is_none()).collect();
    let dt_s = samples.get(1).map_or(0.01, |point| point.time_s - samples[0].time_s);
    let Range { low, high } = response.span();
    let line = |ink: Ink, value: fn(&TraceRow) -> f64| {
        let values: Vec<f64> = samples.iter().map(|point| value(point)).collect();
        let marks = envelope(&values, dt_s, VALUES);
        Layer::line("", ink, marks.into_iter().filter(|mark| (low..=high).contains(&mark.x)))
    };
    let mut rotation = line(Ink::Data(1), |point| point.theta_over_alpha);
    rotation.marks.retain(|mark| mark.y.abs() < MOST);
    let most = rotation.marks.iter().map(|mark| mark.y.abs()).fold(1.1, f64::max) * 1.08;
    let guide = |limit: f64| [low, high].map(|time_s| Mark::new(time_s, limit));
    let guides = [-1.0, 1.0].map(|limit| Layer::guide("tipping angle", Ink::Muted, guide(limit)));
    let dots = |event| response.times(event).into_iter().map(|time_s| Mark::new(time_s, 0.0));
    let events = [
        Layer::points("uplift", Ink::Data(2), Symbol::Disc, dots(SolverEvent::Uplift)),
        Layer::points("impact", Ink::Data(0), Symbol::Disc, dots(SolverEvent::Impact)),
    ];
    let layers = guides.into_iter().chain([rotation]).chain(events).collect();
    let time = |label: &str| Axis::linear(label).over(low, high);
    let y = Axis::linear("*θ*/*α*: beyond 1 it tips unless it is brought back").over(-most, most);
    let ground = |title, unit, label, line| Panel::new(title, time(label), Axis::linear(unit), vec![line]);
    let acceleration = line(Ink::Text, |point| point.ground_acceleration_m_s2 / G_M_S2);
    let velocity = line(Ink::Data(0), |point| point.ground_velocity_m_s);
    let mut panels = vec![
        Panel::new("Rotation", time(""), y, layers),
        ground("Ground acceleration", "g", "", acceleration),
        ground("Ground velocity", "m/s", "time, s", velocity),
    ];
    for (moment, words) in [(response.tipped_at(), "tips"), (response.overturned_at(), "lies")] {
        let Some(x) = moment else { continue };
        panels[0].add_upright(x, [-most, most], words.to_string(), LabelPosition::Along);
    }
    let [structure, motion] =
        [&response.0[0].structure, &response.0[0].motion_id].map(|name| file_words(name));
    let figure = Figure::new(&format!("response-{structure}-{motion}"), &response.title(), 1, HEIGHT, panels);
    let ([start, end], sentence) = ([low, high].map(|time_s| number::fixed(time_s, 1)), response.sentence());
    Figure { beside: moving(response, id), ..figure }.explained(format!(
        "{sentence} A block that rocks alike, in real time from {start} to {end} s; dashed: the tipping angle."
    ))
}

pub fn figures(all: &[Trace]) -> Vec<Figure> {
    all.iter().enumerate().map(|(id, response)| figure(response, id)).collect()
}

/// The document of responses: what came of each, and what moves.
pub fn document(all: &[Trace]) -> Document {
    let overturned = all.iter().filter(|response| response.overturned_at().is_some()).count();
    let (title, sentence) = match all {
        [one] => (one.title(), one.sentence()),
        all => (
            format!("{} over time", number::counted(all.len(), "response")),
            format!("{overturned} of {} overturn.", all.len()),
        ),
    };
    Document { title, lead: vec![sentence], figures: figures(all), ..Document::default() }
}

/// The block as it moves in real time, from a click on its button: a picture without any code.
fn moving(response: &Trace, id: usize) -> String {
    let span = response.span();
    let seconds = span.high - span.low;
    let TraceRow { block_width_m: width_m, block_height_m: height_m, .. } = response.0[0];
    let scale = DIAGONAL / width_m.hypot(height_m);
    let (half, high) = (0.5 * scale * width_m, scale * height_m);
    let turns = turns(response, span);
    // How far the corners go to each side.
    let [left, right] = [-1.0, 1.0].map(|side| {
        let most = turns.iter().map(|degrees| side * degrees).fold(0.0, f64::max);
        half + high * most.to_radians().sin() + MARGIN
    });
    let spare = (NARROWEST - left - right).max(0.0);
    let (middle, width) = (left + 0.5 * spare, left + right + spare);
    let (ground, height) = (high + 40.0, high + 55.0);
    // A block turns about the corner on the side to which it leans.
    let turns =
        turns.iter().map(|degrees| format!("{} {} 0", round(*degrees), round(half.copysign(*degrees))));
    let turns = turns.collect::<Vec<_>>().join(";");
    let clock = format!("begin=\"play{id}.click\" dur=\"{}s\" fill=\"freeze\"", round(seconds));
    let name = escape(&format!("{}, moving", words(&response.title())));
    let [edge, top, wide, tall, centre] = [-half, -high, 2.0 * half, high, -0.5 * high].map(round);
    format!(
        "<svg class=\"moving\" viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" aria-label=\"{name}\">\n\
         <path d=\"M20 {ground:.1}H{:.0}\" stroke=\"var(--muted)\" stroke-width=\"1.2\"/>\n\
         <g transform=\"translate({middle:.1} {ground:.1})\"><g>\n\
         <rect x=\"{edge}\" y=\"{top}\" width=\"{wide}\" height=\"{tall}\" fill=\"var(--data0)\" \
         fill-opacity=\"0.2\" stroke=\"var(--ink)\" stroke-width=\"1.6\"/>\n\
         <circle cx=\"0\" cy=\"{centre}\" r=\"3.4\" fill=\"var(--data1)\"/>\n\
         <animateTransform attributeName=\"transform\" type=\"rotate\" {clock} values=\"{turns}\"/>\n</g></g>\n\
         <g id=\"play{id}\" class=\"play\" role=\"button\" tabindex=\"0\" aria-label=\"play\">\
         <rect x=\"20\" y=\"8\" width=\"62\" height=\"24\" rx=\"12\" fill=\"var(--data1)\"/>\
         <path d=\"M34 14v12l10-6z\" fill=\"var(--paper)\"/>\
         <text x=\"50\" y=\"24\" font-size=\"11.5\" fill=\"var(--paper)\">play</text></g>\n</svg>\n",
        width - 20.0,
    )
}

/// The rotation at equal times, degrees.
fn turns(response: &Trace, Range { low, high }: Range) -> Vec<f64> {
    let pictures = (PICTURES_A_SECOND * (high - low)).clamp(1.0, MOST_PICTURES).ceil();
    let alpha = response.0[0].alpha_rad.to_degrees();
    let turn = |picture: i32| {
        let time_s = low + (high - low) * f64::from(picture) / pictures;
        let at = response.0.partition_point(|point| point.time_s < time_s).min(response.0.len() - 1);
        (alpha * response.0[at].theta_over_alpha).clamp(-90.0, 90.0)
    };
    (0..=pictures as i32).map(turn).collect()
}
