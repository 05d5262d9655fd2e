//! Figure 5: the responses of two similar structures to similar motions, which are one in dimensionless axes.

use super::{compare, envelope};
use crate::number;
use crate::report::figure::{Axis, Dash, Figure, Ink, Layer, Panel};

/// The rotation of a structure over time.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    pub p_rad_s: f64,
    pub alpha_rad: f64,
    /// Time between samples, s.
    pub dt_s: f64,
    pub theta_rad: Vec<f64>,
}

/// Number of values that a line is drawn with.
const VALUES: usize = 450;

/// Figure 5: two histories in their own units and in dimensionless ones; `motion` names the motion of the
/// first.
pub fn similarity(histories: &[History; 2], motion: &str) -> Figure {
    let [first, second] = histories;
    let panel = |title: &str, x: &str, y: &str, is_dimensionless: bool| {
        let line = |(history, (ink, dash)): (&History, (Ink, Dash))| {
            let History { p_rad_s, alpha_rad, dt_s, theta_rad } = history;
            let [p, alpha] = [p_rad_s, alpha_rad].map(|value| number::significant(*value, 3));
            let (time, angle) = if is_dimensionless { (*p_rad_s, *alpha_rad) } else { (1.0, 1.0) };
            let points = envelope(theta_rad, dt_s * time, VALUES);
            let points = points.into_iter().map(|[t, theta]| [t, theta / angle]).collect();
            Layer::curve(&format!("*p* = {p} rad/s, *α* = {alpha} rad"), ink, dash, points, Vec::new())
        };
        let styles = [(Ink::Data(0), Dash::Solid), (Ink::Data(1), Dash::Short)];
        Panel {
            title: title.to_string(),
            x: Axis::linear(x),
            y: Axis::linear(y),
            layers: histories.iter().zip(styles).map(line).collect(),
            notes: Vec::new(),
        }
    };
    let [faster, stronger] = [second.p_rad_s / first.p_rad_s, second.alpha_rad.tan() / first.alpha_rad.tan()]
        .map(|ratio| number::significant(ratio, 3));
    Figure {
        name: "similarity".to_string(),
        title: "Two similar responses".to_string(),
        caption: format!(
            "Rotation under {motion}, and of a structure of {faster} times the *p* under the same motion, {faster} times as fast and {stronger} times as strong. In dimensionless axes both are one, but for what *α* adds. {}",
            compare("Figure 5")
        ),
        columns: 2,
        height: 105.0,
        panels: vec![
            panel("In their own units", "time (s)", "*θ* (rad)", false),
            panel("Dimensionless", "*p t*", "*θ* / *α*", true),
        ],
    }
}
