//! Figure 1: a combined motion and its parts.

use super::{compare, envelope};
use crate::report::figure::{Axis, Figure, Ink, Layer, Panel};

/// A ground motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Magnitude, distance and period in words, as far as known.
    pub words: String,
    /// Time between samples, s.
    pub dt_s: f64,
    pub acceleration_m_s2: Vec<f64>,
    pub velocity_m_s: Vec<f64>,
    /// Acceleration and velocity of the pulse in it, if its parts are known.
    pub pulse: Option<[Vec<f64>; 2]>,
}

/// Number of values that a line is drawn with; of the smooth pulse, fewer.
const VALUES: usize = 1200;
const PULSE_VALUES: usize = 450;

/// Figure 1: the coherent pulse, the high frequencies, the whole motion, and the velocities.
pub fn motion(motion: &Motion) -> Figure {
    let Motion { words, dt_s, acceleration_m_s2, velocity_m_s, pulse } = motion;
    let line = |label: &str, ink: Ink, values: &[f64], most: usize| {
        Layer::line(label, ink, envelope(values, *dt_s, most))
    };
    let coherent = |values: &[f64]| line("pulse", Ink::Data(1), values, PULSE_VALUES);
    let panel = |title: &str, unit: &str, layers: Vec<Layer>| Panel {
        title: title.to_string(),
        y: Axis::linear(unit),
        x: Axis::default().over(0.0, acceleration_m_s2.len() as f64 * dt_s),
        layers,
        ..Panel::default()
    };
    const UNIT: &str = "*a* (m/s^{2})";
    let mut panels = Vec::new();
    let mut velocities = vec![line("whole motion", Ink::Data(0), velocity_m_s, VALUES)];
    if let Some([pulse_m_s2, pulse_m_s]) = pulse {
        let rest: Vec<f64> =
            acceleration_m_s2.iter().zip(pulse_m_s2).map(|(whole, pulse)| whole - pulse).collect();
        let rest = line("high frequencies", Ink::Muted, &rest, VALUES);
        panels.push(panel("Coherent pulse", UNIT, vec![coherent(pulse_m_s2)]));
        panels.push(panel("High frequencies", UNIT, vec![rest]));
        velocities.push(coherent(pulse_m_s));
    }
    let whole = line("whole motion", Ink::Data(0), acceleration_m_s2, VALUES);
    panels.push(panel("Whole motion", UNIT, vec![whole]));
    panels.push(Panel {
        x: Axis::linear("time (s)").over(0.0, acceleration_m_s2.len() as f64 * dt_s),
        ..panel("Velocity", "*v* (m/s)", velocities)
    });
    Figure {
        name: "motion".to_string(),
        title: "A ground motion".to_string(),
        caption: match pulse {
            Some(_) => format!("A combined motion and its parts: {words}. {}", compare("Figure 1")),
            None => format!("Acceleration and velocity: {words}."),
        },
        columns: 1,
        height: 46.0,
        panels,
    }
}
