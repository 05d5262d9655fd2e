//! The answers in words: the first line is the answer, then one small table, then what else matters.

use std::fmt::Write;

use super::object::{ObjectRow, TreeRow, words_of_kind};
use super::site::{RatesRow, Site};
use super::unit;
use crate::doubt::Doubt;
use crate::fragility::{Calibration, Kind, Model, Ratio, Scenarios};
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::rocking::{Structure, rectangular_p};
use crate::stages::shared::hazard::Hazard;
use crate::units::G_M_S2;

/// Objects with what is predicted, and what explains it.
type All<R> = [(ObjectRow, R, String)];

/// Probabilities at one PGA and PGV.
pub fn of_points(all: &All<TreeRow>, sentence: bool) -> String {
    let mut text = match all {
        [(object, tree, _)] => point(object, tree),
        all => points(all),
    };
    if sentence {
        let known = all.iter().filter(|(object, ..)| object.p_rad_s.is_some());
        known.for_each(|(object, tree, _)| text += &sentence_of_point(object, tree));
    }
    all.iter().for_each(|(.., more)| text += more);
    text
}

fn point(object: &ObjectRow, tree: &TreeRow) -> String {
    let [overturning, failure] = states(tree);
    let (im4, peaks) = (times_uplift(object, tree), words_of_peaks(tree));
    let rocks = match tree.p_nr == Some(1.0) {
        true => format!("does not rock: PGA is {im4} times what uplifts it\n"),
        false => format!("rocks: PGA is {im4} times what uplifts it\n"),
    };
    let valid = format!("{} {peaks}, by {}. {}\n", title(object), model(object), validity(object));
    if tree.p_nr == Some(1.0) {
        return rocks + &valid;
    }
    let too_far = format!("overturns, or {}", too_far(object));
    let lines = [line("overturns", overturning, "95 % limits "), line(&too_far, failure, "")];
    aligned(&lines) + &rocks + &valid
}

fn points(all: &All<TreeRow>) -> String {
    let Some((worst, tree, _)) = all.first() else { return String::new() };
    let [overturning, _] = states(tree);
    let limits = in_brackets(overturning, "95 % limits ");
    let first = match overturning[0] {
        None | Some(0.0) => "nothing overturns".to_string(),
        Some(p) => format!("{} overturns most probably: {} {limits}", worst.structure, percent(p)),
    };
    let heading = ["object", "size", "rocks", "overturns", "", "or too far", "friction", "doubt"];
    let row = |(object, tree, _): &(ObjectRow, TreeRow, String)| {
        let [overturning, failure] = states(tree);
        let rocks = tree.p_nr.map_or("-", |p_nr| if p_nr == 0.0 { "yes" } else { "no" });
        let p = |p: Option<f64>| p.map_or("-".to_string(), percent);
        let name = object.structure.clone();
        let [size, friction] = [size(object), friction(object)];
        let limits = in_brackets(overturning, "");
        vec![name, size, rocks.to_string(), p(overturning[0]), limits, p(failure[0]), friction, brief(&tree.doubts, object)]
    };
    let rows: Vec<_> = std::iter::once(heading.map(str::to_string).to_vec()).chain(all.iter().map(row)).collect();
    format!("{first}\n{}All {}, by {}.\n", aligned(&rows), words_of_peaks(tree), model(worst))
}

/// Value and limits of overturning, and of failure, over the whole tree.
fn states(tree: &TreeRow) -> [[Option<f64>; 3]; 2] {
    match tree.p_nr {
        Some(1.0) => [[Some(0.0); 3]; 2],
        _ => [[tree.p_ro, tree.p_ro_low, tree.p_ro_high], [tree.p_f_r, tree.p_f_r_low, tree.p_f_r_high]],
    }
}

fn sentence_of_point(object: &ObjectRow, tree: &TreeRow) -> String {
    let [[p, low, high], _] = states(tree).map(|state| state.map(|p| p.unwrap_or(f64::NAN)));
    let (title, peaks, model, friction) = (title(object), words_of_peaks(tree), model(object), friction(object));
    let comma = if title.contains(", ") { "," } else { "" };
    match tree.p_nr {
        Some(1.0) => format!("\n{title}{comma} does not rock {peaks}: PGA is below what uplifts it.\n"),
        _ => format!(
            "\n{title}{comma} overturns with a probability of {} (95 % confidence limits {} to {}) {peaks}, by {model}, if its friction is above {friction}.\n",
            percent(p), number(low), percent(high)
        ),
    }
}

/// Annual rates, and probabilities in the time of exposure.
pub fn of_rates(all: &All<RatesRow>, site: &Site, sentence: bool) -> String {
    let mut text = match all {
        [(object, rates, _)] => rate(object, rates, site),
        all => rates_of_list(all, site),
    };
    if sentence {
        let known = all.iter().filter(|(object, ..)| object.p_rad_s.is_some());
        known.for_each(|(object, rates, _)| {
            let (title, model, friction) = (title(object), model(object), friction(object));
            let comma = if title.contains(", ") { "," } else { "" };
            let how_often = how_often(rates, site, "95 % confidence limits ");
            let _ = writeln!(
                text,
                "\n{title}{comma} {how_often}, by {model} and a hazard whose own error is not included, if its friction is above {friction}."
            );
        });
    }
    all.iter().for_each(|(.., more)| text += more);
    text
}

fn rate(object: &ObjectRow, rates: &RatesRow, site: &Site) -> String {
    let years = whole(site.years);
    let p = |p: Option<f64>| p.map_or("-".to_string(), percent);
    let row = |name: String, rate: [Option<f64>; 3], of: [Option<f64>; 3]| match rate[0] {
        Some(_) => vec![name, per_year(rate[0]), p(of[0]), in_brackets(of, "")],
        None => vec![name, between(rate, |rate| per_year(Some(rate))), between(of, percent)],
    };
    let limited = |value: Option<f64>, low: Option<f64>, high: Option<f64>| [value, low, high];
    let mut lines = vec![
        vec![String::new(), "a year".to_string(), format!("in {years} years")],
        vec!["rocks".to_string(), per_year(rates.rocking_per_year), p(rates.p_rocking)],
        row(
            format!("{}, or more", too_far(object)),
            limited(rates.failure_per_year, rates.failure_per_year_low, rates.failure_per_year_high),
            limited(rates.p_failure, rates.p_failure_low, rates.p_failure_high),
        ),
        row(
            "overturns".to_string(),
            limited(rates.overturning_per_year, rates.overturning_per_year_low, rates.overturning_per_year_high),
            limited(rates.p_overturning, rates.p_overturning_low, rates.p_overturning_high),
        ),
    ];
    if let (Some(motions), Some(_)) = (rates.counted_motions, rates.counted_per_year) {
        let of = [rates.counted_per_year, rates.counted_per_year_low, rates.counted_per_year_high];
        let in_years = of.map(|rate| rate.map(|rate| crate::hazard::probability_in_years(rate, site.years)));
        lines.push(row(format!("overturns, counted among {} motions", grouped(motions as f64)), of, in_years));
    }
    let least_known = match (site.ratio, rates.overturning_per_year_less_velocity, rates.overturning_per_year_more_velocity) {
        (Ratio::Distributed, Some(less), Some(more)) if rates.overturning_per_year.is_some() => {
            format!(" Least known: PGV/PGA (one standard deviation: {} to {}).", per_year(Some(less)), per_year(Some(more)))
        }
        _ => String::new(),
    };
    format!(
        "{}: {}\n{}Not in the limits: the error of the hazard.{least_known}\nBy {}. {}\n",
        title(object), how_often(rates, site, "95 % limits "), aligned(&lines), model(object), validity(object)
    )
}

fn rates_of_list(all: &All<RatesRow>, site: &Site) -> String {
    let Some((worst, rates, _)) = all.first() else { return String::new() };
    let years = whole(site.years);
    let heading = ["object", "size", "rocks", "overturns", "once in years", &format!("in {years} years"), "", "friction", "doubt"];
    let row = |(object, rates, _): &(ObjectRow, RatesRow, String)| {
        let of = [rates.p_overturning, rates.p_overturning_low, rates.p_overturning_high];
        let rate = [rates.overturning_per_year, rates.overturning_per_year_low, rates.overturning_per_year_high];
        let (a_year, in_years) = match (rate[0], rate[1]) {
            (None, Some(_)) => (between(rate, |rate| per_year(Some(rate))), between(of, percent)),
            _ => (per_year(rate[0]), of[0].map_or("-".to_string(), percent)),
        };
        vec![
            object.structure.clone(),
            size(object),
            per_year(rates.rocking_per_year),
            a_year,
            rates.return_period_years.map_or("-".to_string(), period),
            in_years,
            if rate[0].is_some() { in_brackets(of, "") } else { String::new() },
            friction(object),
            brief(&rates.doubts, object),
        ]
    };
    let rows: Vec<_> = std::iter::once(heading.map(str::to_string).to_vec()).chain(all.iter().map(row)).collect();
    let error = match site.ratio {
        Ratio::Distributed => "the errors of the hazard and of PGV/PGA",
        _ => "the error of the hazard",
    };
    format!(
        "{} overturns most often: {}\n{}Rates a year, by {}. Not in the limits: {error}. Below its friction an object slides instead.\n",
        worst.structure,
        how_often(rates, site, "95 % limits ").trim_start_matches("overturns "),
        aligned(&rows), model(worst)
    )
}

/// How often it overturns, with limits or bounds.
fn how_often(rates: &RatesRow, site: &Site, limits: &str) -> String {
    let of = [rates.p_overturning, rates.p_overturning_low, rates.p_overturning_high];
    match (rates.overturning_per_year, rates.overturning_per_year_low, rates.overturning_per_year_high) {
        (Some(0.0), ..) => "does not overturn: nothing of the hazard uplifts it".to_string(),
        (Some(rate), ..) => format!(
            "overturns once in {} years; {} in {} years {}",
            period(1.0 / rate), percent(of[0].unwrap_or(f64::NAN)), whole(site.years), in_brackets(of, limits)
        ),
        (None, Some(low), Some(high)) => {
            let end = match &site.hazard {
                Hazard::Curve(peak, curve) => {
                    let ([_, (last, rate)], (name, size)) = (curve.ends(), unit(*peak));
                    format!(": the curve ends at {} {name} (once in {} years)", significant(last / size, 3), grouped((1.0 / rate).round()))
                }
                Hazard::Joint(_) => String::new(),
            };
            format!("overturns between {} and {} times a year{end}", per_year(Some(low)), per_year(Some(high)))
        }
        _ => "has no rate of overturning".to_string(),
    }
}

/// What predicts, the measures of the motion, and what other kinds of motion would give.
pub fn explained(model: &Model, structure: &Structure, measures: &IntensityMeasures) -> String {
    let mut text = "\n".to_string();
    let calibration = |of: &Calibration| {
        format!(
            "logit P = {:.2} + {:.2} logit P of the surface ({}); tau {:.2}; {} events in {} responses of {} clusters",
            of.c, of.ln_s.exp(), words_of_kind(of.kind), of.tau, of.n_events, of.n, of.n_clusters
        )
    };
    match model {
        Model::Calibrated { overturning, exceeding, .. } => {
            let _ = writeln!(text, "overturning: {}", calibration(overturning));
            let _ = writeln!(text, "too far:     {}", calibration(exceeding));
            if let (Some(low), Some(high), Some(least), Some(most)) =
                (overturning.pga_low, overturning.pga_high, overturning.ratio_low, overturning.ratio_high)
            {
                let [low, high] = [low, high].map(|pga| significant(pga / G_M_S2, 3));
                let [least, most] = [least, most].map(|ratio| significant(ratio, 3));
                let _ = writeln!(text, "fitted to:   PGA of {low} to {high} g, PGV/PGA of {least} to {most} s");
            }
        }
        Model::Paper { demand, overturning, .. } => {
            let measures: Vec<String> = demand.iter().map(|fit| fit.model.to_string()).collect();
            let _ = writeln!(text, "overturning: {} over {}; too far: {}", overturning.status, overturning.im_x, measures.join(", "));
        }
    }
    let IntensityMeasures { im1, im2, im3, im4, im5, im6 } = *measures;
    let known = [("IM1", im1), ("IM2", im2), ("IM3", im3), ("IM4", Some(im4)), ("IM5", Some(im5)), ("IM6", im6)];
    let known = known.iter().filter_map(|(name, value)| Some(format!("{name} {}", significant((*value)?, 3))));
    let _ = writeln!(text, "measures:    {}", known.collect::<Vec<_>>().join(", "));
    let other = |&kind: &Kind| {
        let limit_state = match model {
            Model::Calibrated { exceeding, .. } => exceeding.limit_state?,
            Model::Paper { limit_state, .. } => *limit_state,
        };
        let shipped = Model::shipped(kind, structure, limit_state);
        let given = shipped.probabilities(structure, measures, Scenarios::One).given_rocking?;
        Some(format!("{} by the surface for {}", percent(given.p_ro.value), words_of_kind(kind)))
    };
    let others: Vec<String> = Kind::ALL.iter().filter_map(other).collect();
    if !others.is_empty() {
        let _ = writeln!(text, "overturning: {}", others.join(", "));
    }
    text
}

/// An object that has a name by it, others by what they are.
fn title(object: &ObjectRow) -> String {
    let size = size(object);
    match (object.structure.as_str(), object.width_m, object.height_m, object.p_rad_s) {
        ("structure", Some(width), Some(height), Some(p)) => {
            let is_block = (rectangular_p(0.5 * width.hypot(height)) / p - 1.0).abs() < 1e-9;
            format!("{} of {size}", if is_block { "Block" } else { "Frame of columns" })
        }
        ("structure", ..) => format!("Structure of {size}"),
        (name, ..) => format!("{name}, {size}"),
    }
}

fn size(object: &ObjectRow) -> String {
    match (object.width_m, object.height_m, object.p_rad_s, object.alpha_rad) {
        (Some(width), Some(height), ..) => format!("{} x {} m", plain(width), plain(height)),
        (.., Some(p), Some(alpha)) => format!("p {} rad/s, alpha {}", significant(p, 3), significant(alpha, 3)),
        _ => "-".to_string(),
    }
}

/// A length in full, to the millimetre.
fn plain(length_m: f64) -> String {
    let text = format!("{length_m:.3}");
    let shortest = text.trim_end_matches('0');
    if shortest.ends_with('.') { format!("{shortest}0") } else { shortest.to_string() }
}

fn model(object: &ObjectRow) -> &str {
    object.model.as_deref().unwrap_or("no model")
}

fn validity(object: &ObjectRow) -> String {
    format!("Valid if friction is above {}; else it slides.", friction(object))
}

fn friction(object: &ObjectRow) -> String {
    object.friction.map_or("-".to_string(), |friction| format!("{friction:.2}"))
}

fn too_far(object: &ObjectRow) -> String {
    format!("rocks beyond {} of its slenderness", percent(object.limit_state.unwrap_or(f64::NAN)))
}

fn words_of_peaks(tree: &TreeRow) -> String {
    let [pga, pgv] = [tree.pga_m_s2.unwrap_or_default() / G_M_S2, tree.pgv_m_s.unwrap_or_default()];
    format!("at {} g and {} m/s", significant(pga, 4), significant(pgv, 4))
}

/// PGA over that of uplift.
fn times_uplift(object: &ObjectRow, tree: &TreeRow) -> String {
    let uplift = object.friction.unwrap_or(f64::NAN) * G_M_S2;
    let times = tree.pga_m_s2.unwrap_or_default() / uplift;
    if times > 10.0 { format!("{times:.0}") } else { format!("{times:.1}") }
}

fn line(name: &str, [value, low, high]: [Option<f64>; 3], limits: &str) -> Vec<String> {
    let value_text = value.map_or("unknown".to_string(), percent);
    vec![name.to_string(), value_text, in_brackets([value, low, high], limits)]
}

fn in_brackets([_, low, high]: [Option<f64>; 3], limits: &str) -> String {
    match (low, high) {
        (Some(low), Some(high)) => format!("({limits}{} to {})", number(low), percent(high)),
        _ => String::new(),
    }
}

fn between([_, low, high]: [Option<f64>; 3], text: impl Fn(f64) -> String) -> String {
    low.zip(high).map_or("-".to_string(), |(low, high)| format!("{} to {}", text(low).trim_end_matches(" %"), text(high)))
}

/// The doubts of a row in a few words; what is wrong with one that cannot be right in full.
fn brief(doubts: &Option<String>, object: &ObjectRow) -> String {
    let Some(doubts) = doubts else { return String::new() };
    if object.p_rad_s.is_none() {
        return doubts.rsplit("': ").next().unwrap_or_default().to_string();
    }
    let is_in = |doubt: &&Doubt| doubts.contains(doubt.text());
    let words = Doubt::ALL.iter().filter(is_in).map(|doubt| doubt.to_string().replace('_', " "));
    words.collect::<Vec<_>>().join(", ")
}

/// A probability in percent, with the digits that it deserves.
fn percent(p: f64) -> String {
    format!("{} %", number(p))
}

fn number(p: f64) -> String {
    match 100.0 * p {
        0.0 => "0".to_string(),
        x if x > 99.9 => ">99.9".to_string(),
        x if x >= 99.0 => format!("{x:.1}"),
        x if x < 0.001 => "<0.001".to_string(),
        x => significant(x, 2),
    }
}

/// A number with so many significant digits, without zeros at its end.
fn significant(number: f64, digits: i32) -> String {
    let magnitude = number.abs().log10().floor() as i32;
    if number == 0.0 || !number.is_finite() {
        return if number == 0.0 { "0".to_string() } else { "-".to_string() };
    }
    let text = format!("{number:.*}", (digits - 1 - magnitude).max(0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}

fn per_year(rate: Option<f64>) -> String {
    match rate {
        None => "-".to_string(),
        Some(0.0) => "0".to_string(),
        Some(rate) => format!("{rate:.1e}"),
    }
}

/// A return period in years, with two digits.
fn period(years: f64) -> String {
    if years >= 1e9 {
        return "more than 1e9".to_string();
    }
    let size = 10f64.powf((years.log10().floor() - 1.0).max(0.0));
    if years < 10.0 { significant(years, 2) } else { grouped((years / size).round() * size) }
}

fn whole(years: f64) -> String {
    significant(years, 6)
}

/// A whole number with commas between thousands.
fn grouped(number: f64) -> String {
    let digits = format!("{number:.0}");
    let groups: Vec<&str> = digits.as_bytes().rchunks(3).rev().filter_map(|part| std::str::from_utf8(part).ok()).collect();
    groups.join(",")
}

/// Rows of cells as aligned columns.
fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:width$}"));
        format!("{}\n", cells.collect::<Vec<_>>().join("  ").trim_end())
    };
    rows.iter().map(line).collect()
}
