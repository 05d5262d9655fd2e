//! The results in words: the first line has the result, then one small table, then notes.

use std::fmt::Write;

use super::object::{Answer, ObjectRow, TreeRow, words_of_kind};
use super::site::{RatesRow, Site};
use super::unit;
use crate::fragility::{Calibration, Kind, Measure, Model, Ratio, Scenarios};
use crate::hazard::probability_in_years;
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::rocking::{Structure, rectangular_p};
use crate::stages::shared::hazard::Hazard;
use crate::units::G_M_S2;
use crate::warning::Warning;

/// Value and limits; there may be limits alone.
type Limited = [Option<f64>; 3];

/// Probabilities at one PGA and PGV.
pub fn of_points(all: &[Answer<TreeRow>], sentence: bool) -> String {
    let text = match all {
        [Answer { object, row, .. }] => point(object, row),
        all => points(all),
    };
    let of_object = |object: &ObjectRow, tree: &TreeRow| {
        let [overturning, _] = states(tree);
        let how = match tree.p_nr {
            Some(1.0) => "does not rock".to_string(),
            _ => {
                format!("overturns with a probability of {}", limited(overturning, "95 % confidence limits "))
            }
        };
        format!("{how} {}, by {}", words_of_peaks(tree), model(object))
    };
    with_more(text, all, |object, tree| sentence.then(|| of_object(object, tree)))
}

fn point(object: &ObjectRow, tree: &TreeRow) -> String {
    let rocks = if tree.p_nr == Some(1.0) { "does not rock" } else { "rocks" };
    let uplift = format!("{rocks}: PGA is {} times what uplifts it\n", times_uplift(object, tree));
    let by =
        format!("{} {}, by {}. {}\n", title(object), words_of_peaks(tree), model(object), validity(object));
    if tree.p_nr == Some(1.0) {
        return uplift + &by;
    }
    let [overturning, failure] = states(tree);
    let line =
        |name: &str, of: Limited, limits: &str| vec![name.to_string(), value(of), in_brackets(of, limits)];
    let too_far = format!("overturns, or {}", too_far(object));
    aligned(&[line("overturns", overturning, "95 % limits "), line(&too_far, failure, "")]) + &uplift + &by
}

fn points(all: &[Answer<TreeRow>]) -> String {
    let Some(Answer { object: worst, row: tree, .. }) = all.first() else { return String::new() };
    let first = match states(tree)[0] {
        [None | Some(0.0), ..] => "nothing overturns".to_string(),
        of => format!("{} overturns most probably: {}", worst.structure, limited(of, "95 % limits ")),
    };
    let heading = ["object", "size", "rocks", "overturns", "", "or too far", "friction", "warning"];
    let row = |Answer { object, row: tree, warnings, .. }: &Answer<TreeRow>| {
        let [overturning, failure] = states(tree);
        let rocks = tree.p_nr.map_or("-", |p_nr| if p_nr == 0.0 { "yes" } else { "no" }).to_string();
        let [p, limits, too_far] = [value(overturning), in_brackets(overturning, ""), value(failure)];
        let [name, size, friction] = [object.structure.clone(), size(object), friction(object)];
        vec![name, size, rocks, p, limits, too_far, friction, brief(warnings, &tree.warnings, object)]
    };
    let rows = std::iter::once(heading.map(str::to_string).to_vec()).chain(all.iter().map(row));
    let table = aligned(&rows.collect::<Vec<_>>());
    format!("{first}\n{table}All {}, by {}.\n", words_of_peaks(tree), model(worst))
}

/// Overturning, and failure, over the whole tree.
fn states(tree: &TreeRow) -> [Limited; 2] {
    match tree.p_nr {
        Some(1.0) => [[Some(0.0); 3]; 2],
        _ => [[tree.p_ro, tree.p_ro_low, tree.p_ro_high], [tree.p_f_r, tree.p_f_r_low, tree.p_f_r_high]],
    }
}

/// Annual rates, and probabilities in the time of exposure.
pub fn of_rates(all: &[Answer<RatesRow>], site: &Site, sentence: bool) -> String {
    let text = match all {
        [Answer { object, row, .. }] => rate(object, row, site),
        all => rates_of_list(all, site),
    };
    let of_object = |object: &ObjectRow, rates: &RatesRow| {
        let how_often = how_often(rates, site, "95 % confidence limits ");
        let model = model(object);
        let extended = if site.extrapolate { ", with the hazard curve extrapolated" } else { "" };
        format!("{how_often}, by {model}{extended}, without {}", errors(site))
    };
    with_more(text, all, |object, rates| sentence.then(|| of_object(object, rates)))
}

/// Adds the sentence for a report and the explanation, if requested.
fn with_more<R>(
    mut text: String,
    all: &[Answer<R>],
    sentence: impl Fn(&ObjectRow, &R) -> Option<String>,
) -> String {
    for Answer { object, row, .. } in all.iter().filter(|answer| answer.object.p_rad_s.is_some()) {
        let title = title(object);
        let comma = if title.contains(", ") { "," } else { "" };
        if let Some(sentence) = sentence(object, row) {
            text += &format!("\n{title}{comma} {sentence}, if its friction is above {}.\n", friction(object));
        }
    }
    all.iter().fold(text, |text, answer| text + &answer.explained)
}

fn rate(object: &ObjectRow, rates: &RatesRow, site: &Site) -> String {
    let heading = ["", "a year", &format!("in {} years", significant(site.years, 6))].map(str::to_string);
    let in_years = |rates: Limited| rates.map(|rate| rate.map(|rate| probability_in_years(rate, site.years)));
    let row = |name: String, of: Limited| {
        vec![
            name,
            per_year(of),
            value(in_years(of)),
            of[0].map_or(String::new(), |_| in_brackets(in_years(of), "")),
        ]
    };
    let mut lines = vec![
        heading.to_vec(),
        row("rocks".to_string(), [rates.rocking_per_year, None, None]),
        row(format!("{}, or more", too_far(object)), rates.failure()),
        row("overturns".to_string(), rates.overturning()),
    ];
    if let Some(motions) = rates.counted_motions {
        let of = [rates.counted_per_year, rates.counted_per_year_low, rates.counted_per_year_high];
        lines.push(row(format!("overturns, counted among {} motions", grouped(motions as f64)), of));
    }
    let spread = rates.overturning_per_year_less_velocity.zip(rates.overturning_per_year_more_velocity);
    let least_known =
        spread.filter(|_| rates.overturning_per_year.is_some()).map_or(String::new(), |(less, more)| {
            format!(" Least known: PGV/PGA (one standard deviation: {less:.1e} to {more:.1e} a year).")
        });
    let (title, how_often) = (title(object), how_often(rates, site, "95 % limits "));
    let (table, error, model) = (aligned(&lines), errors(site), model(object));
    let validity = validity(object);
    format!("{title}: {how_often}\n{table}Not in the limits: {error}.{least_known}\nBy {model}. {validity}\n")
}

fn rates_of_list(all: &[Answer<RatesRow>], site: &Site) -> String {
    let Some(Answer { object: worst, row: rates, .. }) = all.first() else { return String::new() };
    let years = format!("in {} years", significant(site.years, 6));
    let heading =
        ["object", "size", "rocks", "overturns", "once in years", &years, "", "friction", "warning"];
    let row = |Answer { object, row: rates, warnings, .. }: &Answer<RatesRow>| {
        let of = [rates.p_overturning, rates.p_overturning_low, rates.p_overturning_high];
        vec![
            object.structure.clone(),
            size(object),
            per_year([rates.rocking_per_year, None, None]),
            per_year(rates.overturning()),
            rates.return_period_years.map_or("-".to_string(), period),
            value(of),
            of[0].map_or(String::new(), |_| in_brackets(of, "")),
            friction(object),
            brief(warnings, &rates.warnings, object),
        ]
    };
    let rows = std::iter::once(heading.map(str::to_string).to_vec()).chain(all.iter().map(row));
    let table = aligned(&rows.collect::<Vec<_>>());
    let error = errors(site);
    let how_often = how_often(rates, site, "95 % limits ");
    let (worst, most, model) = (&worst.structure, how_often.trim_start_matches("overturns "), model(worst));
    format!(
        "{worst} overturns most often: {most}\n{table}Rates a year, by {model}. \
         Not in the limits: {error}. Below its friction an object slides instead.\n"
    )
}

/// The errors that the limits of rates do not contain.
fn errors(site: &Site) -> &'static str {
    match site.ratio {
        Ratio::Distributed => "the errors of the hazard and of PGV/PGA",
        _ => "the error of the hazard",
    }
}

/// How often it overturns, with limits or bounds.
fn how_often(rates: &RatesRow, site: &Site, limits: &str) -> String {
    match rates.overturning() {
        [Some(0.0), ..] => "does not overturn: nothing of the hazard uplifts it".to_string(),
        [Some(rate), ..] => {
            let of = [rates.p_overturning, rates.p_overturning_low, rates.p_overturning_high];
            let (period, years) = (period(1.0 / rate), significant(site.years, 6));
            format!(
                "overturns once in {period} years; {} in {years} years {}",
                value(of),
                in_brackets(of, limits)
            )
        }
        [None, Some(low), Some(high)] => {
            let end = match &site.hazard {
                Hazard::Curve(peak, curve) => {
                    let ([_, (last, rate)], (name, size)) = (curve.ends(), unit(*peak));
                    let (last, years) = (significant(last / size, 3), grouped((1.0 / rate).round()));
                    format!(": the curve ends at {last} {name} (once in {years} years)")
                }
                Hazard::Joint(_) => String::new(),
            };
            format!("overturns between {} and {} times a year{end}", a_year(low), a_year(high))
        }
        _ => "has no rate of overturning".to_string(),
    }
}

/// What predicts, the measures of the motion, and what other kinds of motion would give.
pub fn explained(model: &Model, structure: &Structure, measures: &IntensityMeasures) -> String {
    let mut text = format!("\n{}\n", structure.name);
    let calibration = |of: &Calibration| {
        if of.n == 0 {
            return format!(
                "logit P = {:.2} + {:.2} logit P of the surface ({}); tau {:.2}",
                of.c,
                of.ln_s.exp(),
                words_of_kind(of.kind),
                of.tau
            );
        }
        format!(
            "logit P = {:.2} + {:.2} logit P of the surface ({}); tau {:.2}; {} events in {} responses of {} clusters",
            of.c,
            of.ln_s.exp(),
            words_of_kind(of.kind),
            of.tau,
            of.n_events,
            of.n,
            of.n_clusters
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
                let _ =
                    writeln!(text, "fitted to:   PGA of {low} to {high} g, PGV/PGA of {least} to {most} s");
            }
        }
        Model::Paper { demand, overturning, .. } => {
            let measures: Vec<String> = demand.iter().map(|fit| fit.model.to_string()).collect();
            let _ = writeln!(
                text,
                "overturning: {} over {}; too far: {}",
                overturning.status,
                overturning.im_x,
                measures.join(", ")
            );
        }
    }
    let known = |measure: &Measure| {
        Some(format!("{} {}", measure.as_str().to_uppercase(), significant(measure.value(measures)?, 3)))
    };
    let known = Measure::SCALAR.iter().filter_map(known);
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
        (.., Some(p), Some(alpha)) => {
            format!("p {} rad/s, alpha {}", significant(p, 3), significant(alpha, 3))
        }
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

fn in_brackets([_, low, high]: Limited, limits: &str) -> String {
    low.zip(high)
        .map_or(String::new(), |(low, high)| format!("({limits}{} to {})", number(low), percent(high)))
}

/// A probability, or its bounds.
fn value([value, low, high]: Limited) -> String {
    match (value, low, high) {
        (Some(value), ..) => percent(value),
        (None, Some(low), Some(high)) => format!("{} to {}", number(low), percent(high)),
        _ => "-".to_string(),
    }
}

fn limited(of: Limited, limits: &str) -> String {
    format!("{} {}", value(of), in_brackets(of, limits))
}

fn a_year(rate: f64) -> String {
    if rate == 0.0 { "0".to_string() } else { format!("{rate:.1e}") }
}

/// An annual rate, or its bounds.
fn per_year([value, low, high]: Limited) -> String {
    match (value, low, high) {
        (Some(value), ..) => a_year(value),
        (None, Some(low), Some(high)) => format!("{} to {}", a_year(low), a_year(high)),
        _ => "-".to_string(),
    }
}

/// The warnings of a row in a few words; the reason in full if the row cannot be right.
fn brief(warnings: &[Warning], reason: &Option<String>, object: &ObjectRow) -> String {
    match reason {
        Some(reason) if object.p_rad_s.is_none() => {
            reason.rsplit("': ").next().unwrap_or_default().to_string()
        }
        _ => {
            let words = warnings.iter().map(|warning| warning.to_string().replace('_', " "));
            words.collect::<Vec<_>>().join(", ")
        }
    }
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

/// A return period in years, with two digits.
fn period(years: f64) -> String {
    if years >= 1e9 {
        return "more than 1e9".to_string();
    }
    let size = 10f64.powf((years.log10().floor() - 1.0).max(0.0));
    if years < 10.0 { significant(years, 2) } else { grouped((years / size).round() * size) }
}

/// A whole number with commas between thousands.
fn grouped(number: f64) -> String {
    let digits = format!("{number:.0}");
    let groups: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().filter_map(|part| std::str::from_utf8(part).ok()).collect();
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
