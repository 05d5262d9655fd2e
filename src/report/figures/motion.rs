//! Figure 1: a combined motion and its parts.

use crate::motion::intensity::velocity;
use crate::report::axis::{Axis, range};
use crate::report::data::{Parts, ReportData};
use crate::report::drawing::{Drawing, Ink, Stroke, TWO_COLUMNS};
use crate::report::figure::{Figure, envelope};
use crate::report::panel::{Mark, Panel, legend};
use crate::report::text::Label;

/// Height of a panel, points.
const HEIGHT: f64 = 46.0;
/// From one panel to the next, points.
const PITCH: f64 = 70.0;
/// Values that a line is drawn with.
const MOST_VALUES: usize = 1200;

const LINE: f64 = 0.6;

/// One motion, if the files hold any.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    data.parts.iter().map(figure).collect()
}

/// A series of a panel.
struct Series {
    name: &'static str,
    values: Vec<f64>,
    stroke: Stroke,
}

fn figure(parts: &Parts) -> Figure {
    let Parts { words, dt_s, pulse_m_s2, whole_m_s2 } = parts;
    let whole = |values| Series { name: "whole", values, stroke: Ink::Data(0).line(LINE) };
    let coherent = |values| Series { name: "pulse", values, stroke: Ink::Data(1).line(1.1) };
    let unit = "*a* (m/s^{2})";
    let mut rows: Vec<(&str, &str, Vec<Series>)> = Vec::new();
    let mut velocities = vec![whole(velocity(whole_m_s2, *dt_s))];
    if let Some(pulse) = pulse_m_s2 {
        let kept = whole_m_s2.iter().zip(pulse).map(|(whole, pulse)| whole - pulse).collect();
        rows.push(("coherent pulse", unit, vec![coherent(pulse.clone())]));
        rows.push((
            "high frequencies as they are combined",
            unit,
            vec![Series { name: "high frequencies", values: kept, stroke: Ink::Muted.line(LINE) }],
        ));
        velocities.push(coherent(velocity(pulse, *dt_s)));
    }
    rows.push(("whole motion", unit, vec![whole(whole_m_s2.clone())]));
    rows.push(("velocity", "*v* (m/s)", velocities));
    let mut drawing = Drawing::new(TWO_COLUMNS, PITCH * rows.len() as f64 + 22.0);
    if pulse_m_s2.is_some() {
        let entries = [
            (Mark::Line(Ink::Data(0).line(1.0)), Label::plain("whole")),
            (Mark::Line(Ink::Data(1).line(1.1)), Label::plain("pulse")),
        ];
        legend(&mut drawing, [150.0, 3.0 * PITCH + 12.0], &entries);
    }
    let duration_s = whole_m_s2.len() as f64 * dt_s;
    let last = rows.len() - 1;
    for (index, (title, unit, series)) in rows.iter().enumerate() {
        let peak = series
            .iter()
            .flat_map(|series| range(series.values.iter().copied()))
            .fold(0.0_f64, |peak, end| peak.max(end.abs()));
        let x = Axis::linear([0.0, duration_s], Label::plain(if index == last { "time (s)" } else { "" }));
        let y = Axis::linear([-1.08 * peak, 1.08 * peak], Label::marked(unit));
        let panel = Panel {
            corner: [40.0, PITCH * index as f64 + 17.0],
            width: TWO_COLUMNS - 49.0,
            height: HEIGHT,
            x,
            y,
        };
        for Series { name, values, stroke } in series {
            let drawn = envelope(values, MOST_VALUES);
            let step_s = drawn.each as f64 * dt_s;
            let line: Vec<[f64; 2]> =
                drawn.values.iter().enumerate().map(|(k, value)| [k as f64 * step_s, *value]).collect();
            panel.curve(&mut drawing, name, &line, *stroke);
        }
        panel.frame(&mut drawing, Label::plain(*title).bold());
    }
    let (title, made) = match pulse_m_s2 {
        Some(_) => (
            "A ground motion and its parts",
            format!(
                " The high frequencies are what the combination keeps of them: the whole motion less the pulse. {}",
                super::of_paper("Figure 1")
            ),
        ),
        None => ("A ground motion", String::new()),
    };
    Figure {
        name: "motion".to_string(),
        title: title.to_string(),
        caption: format!("Acceleration and velocity of {words}.{made}"),
        made: String::new(),
        drawing,
    }
}
