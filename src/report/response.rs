//! One response: rotation and ground motion over time, with its events; and the block as it moves.

use std::fmt::Write;

use super::figure::{Axis, Figure, Ink, Layer, Mark, Panel, Side, Span, Words};
use super::figures::envelope;
use super::page::Page;
use super::text::{escape, file_words, html, literal, words};
use crate::number;
use crate::rocking::SolverEvent;
use crate::table::responses::TraceRow;
use crate::units::G_M_S2;
use crate::warning::UNNAMED;

/// A structure under a motion: a row at each sample and event, one or more.
#[derive(Debug, Clone)]
pub struct Trace(pub Vec<TraceRow>);

/// Values of a line.
const VALUES: usize = 900;
/// Height of the area of the data of a panel, points.
const HEIGHT: f64 = 58.0;
/// Rotations over alpha are drawn up to this.
const MOST: f64 = 1.5;
/// Time between dots that are seen as two, of all time.
const APART: f64 = 0.005;
/// Time that is shown before the first event and after the last, s.
const AROUND_S: f64 = 1.5;
/// Pictures a second of what moves, and the most of them.
const PICTURES_A_SECOND: f64 = 25.0;
const MOST_PICTURES: f64 = 1200.0;

impl Trace {
    /// The structure; without a name, the block that rocks like it.
    fn structure(&self) -> String {
        match self.0[0].structure.as_str() {
            UNNAMED => format!("a block of {}", self.block()),
            name => literal(name),
        }
    }

    /// The sides of the block that rocks like it: `0.50 × 1.90 m`.
    fn block(&self) -> String {
        format!(
            "{} × {} m",
            number::length(self.0[0].block_width_m),
            number::length(self.0[0].block_height_m)
        )
    }

    fn title(&self) -> String {
        format!("Response of {} to motion {}", self.structure(), literal(&self.0[0].motion_id))
    }

    fn times(&self, event: SolverEvent) -> Vec<f64> {
        self.0.iter().filter(|point| point.solver_event == Some(event)).map(|point| point.time_s).collect()
    }

    fn overturned_at(&self) -> Option<f64> {
        self.times(SolverEvent::Overturn).first().copied()
    }

    /// The number of impacts, and of those that a dot does not show.
    fn impacts(&self) -> String {
        let (times, end) = (self.times(SolverEvent::Impact), self.0.last().map_or(0.0, |point| point.time_s));
        let close = times.windows(2).filter(|pair| pair[1] - pair[0] < APART * end).count();
        let hidden = if close > 0 {
            format!(" ({close} too close to the one before to be seen)")
        } else {
            String::new()
        };
        number::counted(times.len(), "impact") + &hidden
    }

    /// What came of it, in a sentence.
    pub fn sentence(&self) -> String {
        let impacts = self.impacts();
        let most = self.0.iter().map(|point| point.theta_over_alpha.abs()).fold(0.0, f64::max);
        let (structure, motion) = (self.structure(), literal(&self.0[0].motion_id));
        match (self.overturned_at(), self.times(SolverEvent::Uplift).first()) {
            (Some(at), _) => {
                format!(
                    "Motion {motion} overturns {structure} after {} s, with {impacts}.",
                    number::fixed(at, 1)
                )
            }
            (None, Some(at)) => format!(
                "Under motion {motion}, {structure} rocks from {} s on, at most {} of the rotation at which it tips, \
                 with {impacts}.",
                number::fixed(*at, 1),
                number::PERCENT.one(most)
            ),
            _ => format!("Motion {motion} does not uplift {structure}."),
        }
    }

    /// The block in words.
    fn size(&self) -> String {
        let Span { low, high } = self.span();
        let [start, end] = [low, high].map(|time_s| number::fixed(time_s, 1));
        let like = match self.0[0].structure.as_str() {
            UNNAMED => String::new(),
            _ => format!("A block of {} rocks like it. ", self.block()),
        };
        format!("{like}It moves in real time, from {start} to {end} s.")
    }

    /// From when to when something happens, s.
    fn span(&self) -> Span {
        let mut events = self.0.iter().filter(|point| point.solver_event.is_some()).map(|point| point.time_s);
        let end = self.0.last().map_or(0.0, |point| point.time_s);
        let Some(first) = events.next() else { return Span { low: 0.0, high: end.min(10.0) } };
        let moving = self.0.iter().rev().find(|point| point.theta_over_alpha.abs() > 1e-3);
        let last =
            events.next_back().unwrap_or(first).max(moving.map_or(first, |point| point.time_s.min(end)));
        Span { low: (first - AROUND_S).max(0.0), high: (last + AROUND_S).min(end) }
    }
}

/// The rotation, the acceleration and the velocity of the ground.
pub fn figure(response: &Trace) -> Figure {
    let samples: Vec<&TraceRow> = response.0.iter().filter(|point| point.solver_event.is_none()).collect();
    let dt_s = samples.get(1).map_or(0.01, |point| point.time_s - samples[0].time_s);
    let end = samples.last().map_or(1.0, |point| point.time_s);
    let line = |ink: Ink, value: fn(&TraceRow) -> f64| {
        let values: Vec<f64> = samples.iter().map(|point| value(point)).collect();
        Layer::line("", ink, envelope(&values, dt_s, VALUES))
    };
    let rotation = line(Ink::Data(1), |point| point.theta_over_alpha.clamp(-MOST, MOST));
    let most = rotation.marks.iter().map(|mark| mark.y.abs()).fold(1.1, f64::max) * 1.08;
    let mut layers = Vec::new();
    for limit in [-1.0, 1.0] {
        layers.push(Layer::guide(Ink::Muted, [0.0, end].map(|time_s| Mark::new(time_s, limit))));
    }
    layers.push(rotation);
    for (name, ink, event) in
        [("uplift", Ink::Data(2), SolverEvent::Uplift), ("impact", Ink::Data(0), SolverEvent::Impact)]
    {
        let marks = response.times(event).into_iter().map(|time_s| Mark::new(time_s, 0.0));
        layers.push(Layer::points(name, ink, marks));
    }
    let y = Axis::linear("*θ*/*α*: beyond 1 it tips unless it is brought back").over(-most, most);
    let [above, below] = ["", "time, s"].map(|label| Axis::linear(label).over(0.0, end));
    let mut panels = vec![
        Panel::new("Rotation", above.clone(), y, layers),
        Panel::new(
            "Ground acceleration",
            above,
            Axis::linear("g"),
            vec![line(Ink::Text, |point| point.ground_acceleration_m_s2 / G_M_S2)],
        ),
        Panel::new(
            "Ground velocity",
            below,
            Axis::linear("m/s"),
            vec![line(Ink::Data(0), |point| point.ground_velocity_m_s)],
        ),
    ];
    if let Some(x) = response.overturned_at() {
        let text = "overturned".to_string();
        panels[0].add_upright(Words { x, y: most, text, side: Side::Along, ink: Ink::Muted }, -most);
    }
    let [structure, motion] =
        [&response.0[0].structure, &response.0[0].motion_id].map(|name| file_words(name));
    Figure::new(&format!("response-{structure}-{motion}"), &response.title(), 1, HEIGHT, panels)
        .explained("Dots: uplift and impacts. Dashed: the rotation *α* at which it tips.")
}

/// The page of responses: what moves, and what came of each.
pub fn page(all: &[Trace]) -> Page {
    let figures = all.iter().map(figure).collect();
    match all {
        [one] => Page {
            title: words(&one.title()),
            place: one.size(),
            sentence: one.sentence(),
            moving: vec![format!("<div>\n{}</div>\n", moving(one, 0))],
            figures,
            ..Page::default()
        },
        several => Page {
            title: format!("{} over time", number::counted(several.len(), "response")),
            sentence: format!(
                "{} of {} overturn. Each moves in real time.",
                several.iter().filter(|response| response.overturned_at().is_some()).count(),
                several.len()
            ),
            moving: several.iter().enumerate().map(|(id, response)| with_words(response, id)).collect(),
            figures,
            ..Page::default()
        },
    }
}

/// The block as it moves, with what came of it.
fn with_words(response: &Trace, id: usize) -> String {
    format!(
        "<div>\n{}<p class=\"caption\">{}</p>\n</div>\n",
        moving(response, id),
        html(&response.sentence())
    )
}

/// One moment of what moves: the time as a fraction of all, the rotation in degrees, and the corner about which.
#[derive(Clone, Copy)]
struct Keyframe {
    at: f64,
    degrees: f64,
    corner: f64,
}

/// The block as it moves in real time, from a click on its button: a picture without any code. `id` is its
/// own on the page.
pub fn moving(response: &Trace, id: usize) -> String {
    let span = response.span();
    let seconds = span.high - span.low;
    let (half, high) = drawn_size(response);
    let (mut times, mut turns) = (Vec::new(), Vec::new());
    for Keyframe { at, degrees, corner } in keyframes(response, span) {
        times.push(short(at, 4));
        turns.push(format!("{} {} 0", short(degrees, 2), short(corner * half, 1)));
    }
    let (times, turns) = (times.join(";"), turns.join(";"));
    let attributes = format!(
        "begin=\"play{id}.click\" dur=\"{}s\" keyTimes=\"{times}\" fill=\"freeze\"",
        short(seconds, 2)
    );
    let (width, height, ground) = (360.0, high + 46.0, high + 18.0);
    let mut text = String::new();
    let name = escape(&format!("{}, moving", words(&response.title())));
    let _ = write!(
        text,
        "<svg class=\"moving\" viewBox=\"0 0 {width} {height:.0}\" role=\"img\" aria-label=\"{name}\">\n\
         <path d=\"M20 {ground}H340\" stroke=\"var(--muted)\" stroke-width=\"1.2\"/>\n\
         <g transform=\"translate(180 {ground})\"><g>\n\
         <rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"var(--data0)\" fill-opacity=\"0.2\" \
         stroke=\"var(--ink)\" stroke-width=\"1.6\"/>\n\
         <circle cx=\"0\" cy=\"{}\" r=\"3.4\" fill=\"var(--data1)\"/>\n\
         <animateTransform attributeName=\"transform\" type=\"rotate\" {attributes} values=\"{turns}\"/>\n</g></g>\n",
        short(-half, 1),
        short(-high, 1),
        short(2.0 * half, 1),
        short(high, 1),
        short(-0.5 * high, 1),
    );
    let middle = ground + 15.0;
    let _ = write!(
        text,
        "<path d=\"M20 {middle}H300\" stroke=\"var(--rule)\" stroke-width=\"2\"/>\n\
         <circle cx=\"20\" cy=\"{middle}\" r=\"4\" fill=\"var(--data1)\"><animate attributeName=\"cx\" \
         begin=\"play{id}.click\" dur=\"{}s\" from=\"20\" to=\"300\" fill=\"freeze\"/></circle>\n\
         <text x=\"308\" y=\"{}\" font-size=\"10\" fill=\"var(--muted)\">{} s</text>\n\
         <g id=\"play{id}\" class=\"play\" role=\"button\" tabindex=\"0\" aria-label=\"play\">\
         <rect x=\"20\" y=\"8\" width=\"62\" height=\"24\" rx=\"12\" fill=\"var(--data1)\"/>\
         <path d=\"M34 14v12l10-6z\" fill=\"var(--paper)\"/>\
         <text x=\"50\" y=\"24\" font-size=\"11.5\" fill=\"var(--paper)\">play</text></g>\n</svg>\n",
        short(seconds, 2),
        middle + 3.5,
        number::fixed(seconds, 1),
    );
    text
}

/// Half the width and the height of the drawn block, of which the diagonal is always the same.
fn drawn_size(response: &Trace) -> (f64, f64) {
    const DIAGONAL: f64 = 190.0;
    let TraceRow { block_width_m: width, block_height_m: height, .. } = response.0[0];
    let scale = DIAGONAL / width.hypot(height);
    (0.5 * scale * width, scale * height)
}

/// The rotation at equal times, and at each sample where it changes its corner; a block turns about the
/// corner on the side to which it leans.
fn keyframes(response: &Trace, Span { low: start, high: end }: Span) -> Vec<Keyframe> {
    let seconds = (end - start).max(1e-9);
    let step = (1.0 / PICTURES_A_SECOND).max(seconds / MOST_PICTURES);
    let alpha = response.0[0].alpha_rad.to_degrees();
    let (mut frames, mut next, mut corner): (Vec<Keyframe>, f64, f64) = (Vec::new(), start, 1.0);
    for point in response.0.iter().filter(|point| (start..=end).contains(&point.time_s)) {
        let at = (point.time_s - start) / seconds;
        let side = if point.theta_over_alpha < 0.0 { -1.0 } else { 1.0 };
        let is_turning = point.theta_over_alpha != 0.0 && side != corner;
        if is_turning {
            // At no rotation both corners are on the ground.
            frames.extend([corner, side].map(|corner| Keyframe { at, degrees: 0.0, corner }));
            corner = side;
        }
        if point.time_s >= next || is_turning {
            let degrees = (alpha * point.theta_over_alpha).clamp(-90.0, 90.0);
            frames.push(Keyframe { at, degrees, corner });
            next = point.time_s + step;
        }
    }
    if let Some((first, last)) = frames.first().copied().zip(frames.last().copied()) {
        frames.insert(0, Keyframe { at: 0.0, ..first });
        frames.push(Keyframe { at: 1.0, ..last });
    }
    frames
}

/// A number without zeros at its end.
fn short(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_string() } else { text.to_string() }
}
