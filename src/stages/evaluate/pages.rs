//! Answers as pages and figures show them, and what the page of one object shows besides.

use super::fragility::FragilityRow;
use super::object::{Answer, DoubtsRow, ObjectRow, Predicted};
use super::point::{self, TreeRow};
use super::rates::RatesRow;
use serde_json::Value;

use crate::fragility::Peak;
use crate::hazard::{Hazard, Site, exceedance, probability_in_years};
use crate::keyword::Keyword;
use crate::number::{self, Limited};
use crate::object::{Object, Part, Subject};
use crate::pipeline::UsageError;
use crate::report::portrait::{HazardCurve, Outline, Portrait};
use crate::report::rated::{Evaluation, Rated};
use crate::report::{Figure, Page, list, object};
use crate::stages::shared::model_args::Models;
use crate::table::provenance::Provenance;
use crate::warning::UNNAMED;

/// Answers over a hazard as a page shows them, and what their call tells.
pub fn over_hazard(answers: &[Answer<RatesRow>], made: &Provenance) -> Evaluation {
    let years = answers.iter().find_map(|answer| answer.row.years);
    Evaluation {
        years,
        when: years.map_or(String::new(), in_years),
        target: made.arguments.get("target").and_then(Value::as_f64),
        hazard: made.names("hazard").unwrap_or("of another program".to_string()),
        hazard_key: made.input("hazard").unwrap_or_default(),
        limit_state: answers.iter().find_map(|answer| answer.object.limit_state).unwrap_or(0.1),
        rows: answers.iter().map(rated).collect(),
        ..Evaluation::default()
    }
}

/// The exposure time in words: `in 50 years`.
fn in_years(years: f64) -> String {
    format!("in {} year{}", number::plain(years), if years == 1.0 { "" } else { "s" })
}

/// An object with its doubts, without any probability.
fn described(object: &ObjectRow, doubts: &DoubtsRow) -> Rated {
    let floor = object.floor_level.zip(object.floor_period_s).map(|(level, period)| {
        format!("level {} of a {} s building", number::plain(level), number::plain(period))
    });
    let sds = Part::ALL.iter().filter_map(|part| Some((*part, doubts.part_sd(*part)?)));
    Rated {
        name: Some(object.structure.clone()).filter(|name| name != UNNAMED),
        kind: if object.kind.is_empty() { "Object".to_string() } else { object.kind.to_string() },
        size: size(object),
        floor,
        count: object.count,
        friction: object.friction.filter(|_| !object.is_friction_known),
        sds: sds.collect(),
        doubts: doubts.warnings.clone(),
        model: object.model.clone().unwrap_or_default(),
        ..Rated::default()
    }
}

fn rated(Answer { object, row, doubts, .. }: &Answer<RatesRow>) -> Rated {
    Rated {
        rate: row.overturning_per_year,
        once_in_years: row.return_period_years,
        rocking: row.p_rocking,
        failure: row.p_failure,
        overturning: row.p_overturning,
        ..described(object, doubts)
    }
}

/// Answers under one motion as a page shows them.
pub fn under_motion(answers: &[Answer<TreeRow>]) -> Evaluation {
    let peaks = answers.first().map(|answer| point::words_of_peaks(&answer.row)).unwrap_or_default();
    let rated = |Answer { object, row, doubts, .. }: &Answer<TreeRow>| Rated {
        rate: row.overturning(),
        rocking: row.p_nr.map(|p_nr| 1.0 - p_nr),
        failure: Limited::value(row.p_f),
        overturning: row.overturning(),
        ..described(object, doubts)
    };
    Evaluation {
        when: peaks,
        hazard: "none: under one motion".to_string(),
        limit_state: answers.iter().find_map(|answer| answer.object.limit_state).unwrap_or(0.1),
        rows: answers.iter().map(rated).collect(),
        ..Evaluation::default()
    }
}

/// The fragility of one object as a figure shows it.
pub fn of_fragility(
    answers: &[Answer<FragilityRow>],
    object: &Object,
    models: &Models,
) -> anyhow::Result<Evaluation> {
    let [Answer { object: row, row: FragilityRow { curve, .. }, doubts, .. }] = answers else {
        return Err(UsageError::because("out: expected one object for a figure of its fragility"));
    };
    let outline = outline(object, &models.subject(object)?.0);
    Ok(Evaluation {
        limit_state: row.limit_state.unwrap_or(0.1),
        rows: vec![Rated { sds: Vec::new(), ..described(row, doubts) }],
        portrait: Portrait { outline, fragility: curve.clone(), ..Portrait::default() },
        ..Evaluation::default()
    })
}

/// Width, depth and height, else p and alpha.
fn size(object: &ObjectRow) -> String {
    let sides = [object.width_m, object.depth_m, object.height_m].into_iter().flatten().map(number::length);
    match (object.width_m, object.p_rad_s, object.alpha_rad) {
        (Some(_), ..) => format!("{} m", sides.collect::<Vec<_>>().join(" × ")),
        (None, Some(p), Some(alpha)) => {
            format!("p {} rad/s, α {}", number::significant(p, 3), number::significant(alpha, 3))
        }
        _ => String::new(),
    }
}

/// Return periods whose intensities are marked, years: those of the earthquakes that codes design for and
/// consider.
const USUAL_YEARS: [f64; 2] = [475.0, 2475.0];
/// Bins of intensity.
const BINS: usize = 60;

/// The page of answers: of one object its portrait, of several a list.
pub fn page(evaluation: &Evaluation) -> Page {
    match &evaluation.rows[..] {
        [one] => object::page(evaluation, one),
        _ => list::page(std::slice::from_ref(evaluation)),
    }
}

/// The main figure of answers.
pub fn figure(evaluation: &Evaluation) -> Figure {
    match &evaluation.rows[..] {
        [one] => object::figure(evaluation, one),
        _ => list::figure(std::slice::from_ref(evaluation)),
    }
}

/// What the page of one object shows besides its row.
pub fn portrait(object: &Object, models: &Models, site: &Site, years: f64) -> anyhow::Result<Portrait> {
    let (subject, _) = models.subject(object)?;
    let mut changes = vec![("as it is".to_string(), overturning(&subject, site, years))];
    for changed in object.changes() {
        // What would not rock, or lies outside the model, has no row.
        if let Ok((subject, _)) = models.subject(&changed.object) {
            changes.push((changed.words, overturning(&subject, site, years)));
        }
    }
    Ok(Portrait {
        outline: outline(object, &subject),
        fragility: site.fragility(&subject),
        hazard: Some(hazard(&subject, site)),
        changes,
    })
}

fn overturning(subject: &Subject, site: &Site, years: f64) -> Limited {
    let rate = site.rates(subject).overturning.map(Limited::from).unwrap_or_default();
    rate.map(|rate| probability_in_years(rate, years))
}

/// The object over the side to which it falls first.
fn outline(object: &Object, subject: &Subject) -> Option<Outline> {
    let shape = &object.shape;
    let (width, height) = shape.width.zip(shape.height)?;
    let centre_height = shape.centre_height.unwrap_or(0.5 * height);
    let offset = shape.centre_offset.unwrap_or(0.0);
    let alpha_rad = subject.directions[0].structure.alpha_rad;
    let slenderness = |side: f64, offset: f64| ((0.5 * side - offset.abs()) / centre_height).atan();
    let is_depth = |depth: &f64| (slenderness(*depth, 0.0) - alpha_rad).abs() < 1e-9;
    let (width, centre_offset) = match shape.depth.filter(is_depth) {
        Some(depth) => (depth, 0.0),
        None => (width, offset),
    };
    Some(Outline { width, height, centre_height, centre_offset, alpha_rad })
}

fn hazard(subject: &Subject, site: &Site) -> HazardCurve {
    let (name, unit, symbol) = match &site.hazard {
        Hazard::Curve(hazard) => hazard.peak.words(),
        Hazard::Joint(_) => Peak::Pga.words(),
    };
    let points: Vec<(f64, f64)> = match &site.hazard {
        Hazard::Curve(hazard) => hazard.curve.points().to_vec(),
        Hazard::Joint(pairs) => exceedance(pairs, |pair| pair.peaks.pga_m_s2),
    };
    let mut usual = Vec::new();
    for years in USUAL_YEARS {
        let crossing = points.windows(2).find(|pair| pair[0].1 >= 1.0 / years && pair[1].1 < 1.0 / years);
        if let Some([(low, often), (high, rarely)]) = crossing {
            let share = (often * years).ln() / (often / rarely).ln();
            usual.push((low * (high / low).powf(share) / unit, years));
        }
    }
    let parts = site.rate_by_intensity(subject, BINS);
    let all = parts.rates.iter().sum::<f64>() + parts.beyond;
    let bins = parts.edges.windows(2).zip(&parts.rates);
    let share = |(edge, rate): (&[f64], &f64)| ([edge[0] / unit, edge[1] / unit], rate / all);
    HazardCurve {
        label: format!("{name} ({symbol})"),
        points: points.iter().map(|(intensity, rate)| [intensity / unit, *rate]).collect(),
        usual,
        shares: if all > 0.0 { bins.map(share).collect() } else { Vec::new() },
        beyond: if all > 0.0 { parts.beyond / all } else { 0.0 },
    }
}
