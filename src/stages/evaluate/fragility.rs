//! The fragility of objects: the intensities that half of the motions need, the curve, and in words.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::object::{Answer, Predicted};
use super::words::{
    about_buildings, line, model, model_of_all, mostly_unknown, table, title, too_far, validity,
};
use crate::fragility::Peak;
use crate::hazard::{Fragility, FragilityPoint, Lognormal, intensity_in_words};
use crate::number::{Limited, aligned, significant};
use crate::statistics::Estimate;
use crate::units::G_M_S2;

/// What the fragility of an object comes to, over PGA in g or PGV in m/s.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FragilityRow {
    pub over: Option<Peak>,
    pub failure_16: Limited,
    pub failure_theta: Limited,
    pub failure_84: Limited,
    pub failure_beta: Option<f64>,
    pub failure_error: Option<f64>,
    pub overturning_16: Limited,
    pub overturning_theta: Limited,
    pub overturning_84: Limited,
    pub overturning_beta: Option<f64>,
    pub overturning_error: Option<f64>,
    #[serde(skip)]
    pub curve: Option<Fragility>,
}

/// A point of the curve of an object: the shares of the motions of an intensity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CurveRow {
    pub structure: String,
    pub pga_g: Option<f64>,
    pub pgv_m_s: Option<f64>,
    pub p_rocks: Limited,
    pub p_fails: Limited,
    pub p_overturns: Limited,
}

impl FragilityRow {
    pub fn new(fragility: Fragility) -> FragilityRow {
        let (_, unit, _) = fragility.over.words();
        let [failure, overturning] = [fragility.failure, fragility.overturning].map(|of| Lognormal {
            at_16: of.at_16.map(|intensity| intensity / unit),
            theta: of.theta.map(|intensity| intensity / unit),
            at_84: of.at_84.map(|intensity| intensity / unit),
            ..of
        });
        FragilityRow {
            over: Some(fragility.over),
            failure_16: failure.at_16,
            failure_theta: failure.theta,
            failure_84: failure.at_84,
            failure_beta: failure.beta,
            failure_error: failure.largest_error,
            overturning_16: overturning.at_16,
            overturning_theta: overturning.theta,
            overturning_84: overturning.at_84,
            overturning_beta: overturning.beta,
            overturning_error: overturning.largest_error,
            curve: Some(fragility),
        }
    }
}

impl Predicted for FragilityRow {
    fn overturning(&self) -> Limited {
        self.overturning_theta
    }

    fn severity(&self) -> f64 {
        let weakest = self.overturning_theta.value.map_or(0.0, f64::recip);
        if self.over.is_some() { weakest } else { f64::NEG_INFINITY }
    }
}

/// The curves of all objects, one below the other.
pub fn curves(all: &[Answer<FragilityRow>]) -> Vec<CurveRow> {
    let known = |p: Estimate| if p.value.is_nan() { Limited::default() } else { p.into() };
    let curves = all.iter().filter_map(|answer| Some((&answer.object.structure, answer.row.curve.as_ref()?)));
    let points =
        curves.flat_map(|(name, curve)| curve.points.iter().map(move |point| (name, curve.over, point)));
    points
        .map(|(structure, over, FragilityPoint { intensity, p })| CurveRow {
            structure: structure.clone(),
            pga_g: (over == Peak::Pga).then_some(intensity / G_M_S2),
            pgv_m_s: (over == Peak::Pgv).then_some(*intensity),
            p_rocks: known(p.rocking),
            p_fails: known(p.failure),
            p_overturns: known(p.overturning),
        })
        .collect()
}

/// The answer for all objects, in words.
pub fn text(all: &[Answer<FragilityRow>], out: Option<&Path>) -> String {
    super::words::text(all, of_one, || of_several(all, out))
}

fn of_one(answer: &Answer<FragilityRow>) -> String {
    let Answer { object, row, .. } = answer;
    let Some(Fragility { over, failure, overturning, .. }) = &row.curve else { return String::new() };
    let heads = ["", "half", "", "16 %", "84 %"].map(String::from);
    let of_state = |name: String, of: &Lognormal| [vec![name], cells(*over, of)].concat();
    let too_far = format!("{}, or overturns", too_far(object));
    let states = [of_state(too_far, failure), of_state("overturns".to_string(), overturning)];
    let lines: Vec<Vec<String>> = std::iter::once(heads.to_vec()).chain(states).collect();
    let (half, lines) = (half(answer), aligned(&lines, |_| false));
    let lognormal = overturning.beta.zip(overturning.largest_error).map(|(beta, error)| {
        let [beta, error] = [beta, error].map(|value| significant(value, 2));
        format!("Overturning is lognormal with beta {beta}, within {error}.")
    });
    let unknown = line([mostly_unknown(answer, "Add --ratio, --vs30 or --hazard."), lognormal]);
    format!("{half}\n{lines}{unknown}By {}.\n{}", model(object), validity(answer))
}

/// The intensity at which half of the motions overturn an object.
fn half(Answer { object, row, .. }: &Answer<FragilityRow>) -> String {
    let Some(Fragility { over, overturning, .. }) = &row.curve else { return title(object) };
    let of = if overturning.theta.value.is_some() { "of " } else { "" };
    let half = intensity_in_words(*over, overturning.theta.value);
    format!("{}: half of the motions overturn it at a {} {of}{half}", title(object), over.words().0)
}

/// The intensity of one half, its limits, and those of 16 and 84 %.
fn cells(over: Peak, Lognormal { at_16, theta, at_84, .. }: &Lognormal) -> Vec<String> {
    let intensity = |value: Option<f64>| intensity_in_words(over, value);
    let limits = match theta.low {
        None => String::new(),
        low => format!("(95 % limits {} to {})", intensity(low), intensity(theta.high)),
    };
    vec![intensity(theta.value), limits, intensity(at_16.value), intensity(at_84.value)]
}

fn of_several(all: &[Answer<FragilityRow>], out: Option<&Path>) -> String {
    let rows = table(&["overturns", "", "16 %", "84 %", "too far"], all, out, |Answer { row, .. }| {
        row.curve.as_ref().map_or(
            vec!["-".to_string(); 5],
            |Fragility { over, failure, overturning, .. }| {
                let too_far = intensity_in_words(*over, failure.theta.value);
                [cells(*over, overturning), vec![too_far]].concat()
            },
        )
    });
    let over = all[0].row.over.unwrap_or(Peak::Pga).words().0;
    let by = format!("{over} at which half of the motions have the effect, by {}.", model_of_all(all));
    format!("{}\n{rows}{}", half(&all[0]), line([Some(by), about_buildings(all)]))
}
