//! The data of the page's scripts, as JSON.

use base64::prelude::{BASE64_STANDARD, Engine};
use serde_json::{Value, json};

use crate::fragility::{DemandLaw, DemandModel, Measure, Peak, PeaksDoubt, Predictor, universal};
use crate::keyword::Keyword;
use crate::motion::intensity::velocity;
use crate::report::axis::{Axis, range};
use crate::report::data::{Group, Model, Motion, Planes, ReportData, Trace, most_telling};
use crate::report::drawing::Ink;
use crate::report::figure::{Envelope, Figure, envelope};
use crate::report::plotted::{Plotted, Series};
use crate::rocking::{BOUNDS, Bound, SolverEvent, Structure};
use crate::units::G_M_S2;

/// Largest integer of sixteen bits.
const LARGEST: f64 = 32767.0;
/// Upper bound of the values of a series.
const MOST_VALUES: usize = 3000;
/// Upper bound of the points of a cloud in space.
const MOST_IN_SPACE: usize = 2500;

/// Writes all data. `<` is escaped, so that no name can end the script.
pub fn json(data: &ReportData, figures: &[&Figure]) -> String {
    let all = json!({
        "g": G_M_S2,
        "bounds": BOUNDS.iter().copied().chain([Peak::Pga, Peak::Pgv].map(Peak::bound)).map(bound).collect::<Vec<_>>(),
        "structures": data.groups.iter().map(structure).collect::<Vec<_>>(),
        "models": data.models.iter().map(model).collect::<Vec<_>>(),
        "surface": universal::SURFACE,
        "doubts": PeaksDoubt::ALL.map(|doubt| json!({ "words": doubt.words(), "bounds": doubt.bounds() })),
        "planes": data.groups.iter().filter_map(in_space).collect::<Vec<_>>(),
        "motions": data.motions.iter().map(motion).collect::<Vec<_>>(),
        "motion": most_telling(&data.motions),
        "figures": figures.iter().map(|of| (of.name.clone(), figure(of))).collect::<serde_json::Map<_, _>>(),
        "inks": Ink::ALL.iter().map(|ink| (ink.variable(), json!(ink.hex()))).collect::<serde_json::Map<_, _>>(),
    });
    all.to_string().replace('<', "\\u003c")
}

/// Writes what a figure shows, and what its files say.
fn figure(of: &Figure) -> Value {
    let panels: Vec<Value> = of.drawing.plotted.iter().map(panel).collect();
    json!({ "title": of.title, "about": of.description(), "panels": panels })
}

fn panel(Plotted { title, corner, size, axes, series }: &Plotted) -> Value {
    let axis = |axis: &Axis| json!({ "is": axis.label.words(), "log": axis.is_log(), "low": axis.low, "high": axis.high, "names": axis.names });
    let of_series = |of: &Series| match of.further {
        [] => cloud(of, axes),
        further => {
            // Seven digits are enough to be read.
            let bytes: Vec<u8> = of.values.iter().flat_map(|value| (*value as f32).to_le_bytes()).collect();
            json!({ "name": of.name, "further": further, "values": BASE64_STANDARD.encode(&bytes) })
        }
    };
    json!({ "title": title.words(), "corner": corner, "size": size, "x": axis(&axes[0]), "y": axis(&axes[1]),
        "series": series.iter().map(of_series).collect::<Vec<_>>() })
}

/// Points without anything besides, of which there may be many: sixteen bits a coordinate, from end to end of their own.
fn cloud(of: &Series, axes: &[Axis; 2]) -> Value {
    let scaled = |point: &[f64]| {
        [0, 1].map(|axis| if axes[axis].is_log() { libm::log(point[axis]) } else { point[axis] })
    };
    let finite = |point: &[f64; 2]| point.iter().all(|part| part.is_finite());
    let points: Vec<[f64; 2]> = of.points().map(scaled).filter(finite).collect();
    let ends = [0, 1].map(|axis| range(points.iter().map(|point| point[axis])));
    let part = |(value, [low, high]): (&f64, &[f64; 2])| {
        let share = (value - low) / (high - low).max(f64::MIN_POSITIVE);
        ((share * f64::from(u16::MAX)).round() as u16).to_le_bytes()
    };
    let bytes: Vec<u8> = points.iter().flat_map(|point| point.iter().zip(&ends).flat_map(part)).collect();
    json!({ "name": of.name, "further": [], "ends": ends, "values": BASE64_STANDARD.encode(&bytes) })
}

fn bound(Bound { parameter, range, expected, slip }: Bound) -> Value {
    json!({ "parameter": parameter, "range": range, "expected": expected, "slip": slip })
}

fn structure(Group { structure, .. }: &Group) -> Value {
    let Structure { name, p_rad_s, alpha_rad, eta } = structure;
    json!({ "name": name, "p": p_rad_s, "alpha": alpha_rad, "eta": eta })
}

fn model(Model { suite, structure, form, fits, doubt }: &Model) -> Value {
    let demand = match &fits.demand {
        DemandModel::Everywhere(all) => json!({ "all": law(all) }),
        DemandModel::Biplanar { transition, low, high } => {
            json!({ "transition": transition, "low": law(low), "high": law(high) })
        }
    };
    json!({ "suite": suite, "structure": structure, "form": form, "limit": fits.limit, "eta": fits.eta,
        "demand": demand, "overturning": predictor(&fits.overturning), "doubt": doubt })
}

fn law(law: &DemandLaw) -> Value {
    json!({ "median": predictor(&law.ln_median), "beta": law.beta, "degrees": law.degrees })
}

fn predictor(of: &Predictor) -> Value {
    let (mut b, mut covariance) = (of.coefficients.to_vec(), of.covariance.map(|row| row.to_vec()).to_vec());
    if let Some(bend) = &of.bend {
        b.extend(bend.coefficients);
        covariance = bend.covariance.map(|row| row.to_vec()).to_vec();
    }
    covariance[0][0] += of.spread * of.spread;
    json!({ "x": of.im_x.as_str(), "y": of.im_y.map(Keyword::as_str), "b": b, "covariance": covariance,
        "knots": of.bend.map(|bend| bend.knots), "ranges": of.ranges })
}

/// Writes the cloud of a group in ln IM4, ln IM3 and ln EDP, and its two planes.
fn in_space(group: &Group) -> Option<Value> {
    let Planes { transition, sides } = group.planes?;
    let [im_x, im_y] = [Measure::Im4, Measure::Im3];
    let points: Vec<[f64; 3]> = group
        .safe()
        .filter_map(|response| {
            Some([
                libm::log(im_x.of(&response.case)?),
                libm::log(im_y.of(&response.case)?),
                libm::log(response.case.edp),
            ])
        })
        .collect();
    let every = points.len().div_ceil(MOST_IN_SPACE).max(1);
    let rounded = |number: f64| (number * 1000.0).round() / 1000.0;
    let shown: Vec<[f64; 3]> = points.iter().step_by(every).map(|point| point.map(rounded)).collect();
    Some(json!({ "name": group.name(), "transition": libm::log(transition), "points": shown, "every": every,
        "sides": sides.map(|side| side.law.ln_median.coefficients) }))
}

fn motion(motion: &Motion) -> Value {
    let velocity = velocity(&motion.acceleration_m_s2, motion.dt_s);
    json!({ "name": motion.name, "words": motion.words,
        "acceleration": series(&motion.acceleration_m_s2, motion.dt_s),
        "velocity": series(&velocity, motion.dt_s),
        "traces": motion.traces.iter().map(|of| trace(of, motion.dt_s)).collect::<Vec<_>>() })
}

fn trace(Trace { structure, alpha_rad, outcome, points }: &Trace, dt_s: f64) -> Value {
    let samples: Vec<f64> = points
        .iter()
        .filter(|point| point.solver_event.is_none())
        .map(|point| point.theta_rad / alpha_rad)
        .collect();
    let impacts = points.iter().filter(|point| point.solver_event == Some(SolverEvent::Impact));
    let impacts: Vec<f64> = impacts.map(|point| (point.time_s * 1000.0).round() / 1000.0).collect();
    json!({ "structure": structure, "outcome": outcome.as_str().replace('_', " "),
        "theta": series(&samples, dt_s), "impacts": impacts })
}

/// Encodes a series in sixteen bits a value, cut down where it is long.
fn series(values: &[f64], dt_s: f64) -> Value {
    let Envelope { each, values } = envelope(values, MOST_VALUES);
    let peak = values.iter().fold(0.0_f64, |peak, value| peak.max(value.abs()));
    let unit = if peak > 0.0 { peak / LARGEST } else { 1.0 };
    let bytes: Vec<u8> =
        values.iter().flat_map(|value| ((value / unit).round() as i16).to_le_bytes()).collect();
    json!({ "step": each as f64 * dt_s, "unit": unit, "values": BASE64_STANDARD.encode(&bytes) })
}
