//! Annual rates at a site, and in words.

use std::path::Path;

use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{Hazard, PeakHazard, Site, VelocitySource};
use rockfrag_core::statistics::Interval;
use rockfrag_core::units::G_M_S2;

use super::object::Predicted;
use super::words::{about_buildings, friction, line, model, model_of_all, mostly_unknown, table, validity};
use crate::document::answers::{Expected, NO_RATE, State, in_years};
use crate::number::{self, PERCENT, RATE, aligned, count, name, period, plain, significant};
use crate::table::answers::{Answer, RatesRow};

impl Predicted for RatesRow {
    fn overturning(&self) -> Interval<Option<f64>> {
        self.overturning_per_year
    }
}

/// The answer for all objects, in words.
pub fn text(all: &[Answer<RatesRow>], site: &Site, target: Option<f64>, out: Option<&Path>) -> String {
    super::words::text(all, |answer| tell(answer, site, target), || tell_list(all, site, target, out))
}

fn tell(answer: &Answer<RatesRow>, site: &Site, target: Option<f64>) -> String {
    let Answer { object, row: rates, .. } = answer;
    let mut lines = vec![vec![String::new(), "a year".to_string(), when(rates)]];
    for State { name, p, per_year } in answer.states() {
        lines.push(vec![name, RATE.value(per_year), PERCENT.value(p), PERCENT.limits(p, "")]);
    }
    let widths = target.map_or(String::new(), |target| words_of_target(answer, target));
    format!(
        "{}: {}\n{}{}{widths}By {}{}.\n{}",
        object.title(),
        how_often(rates, site),
        aligned(&lines, |_| false),
        about_limits(answer, site),
        model(object),
        usual_motion(site),
        validity(answer)
    )
}

/// The expected number of a list of several, and the probability that one or more overturns.
fn expected_number(all: &[Answer<RatesRow>]) -> Option<String> {
    let expected = Expected::new(all);
    (expected.all > 1.0).then(|| {
        format!(
            "Expected number overturning {}: {} of {}. Probability that at least one does: {} (if all fall \
             together) to {} (if independent).",
            when(&all[0].row),
            expected.number(),
            plain(expected.all),
            PERCENT.one(expected.together),
            PERCENT.one(expected.independent)
        )
    })
}

/// The bases that meet a target, or why none does.
fn words_of_target(answer: &Answer<RatesRow>, target: f64) -> String {
    let (rates, why_none) = (&answer.row, answer.why_no_base());
    let target = format!("{} {}", PERCENT.one(target), when(rates));
    let Some(base) = answer.base() else { return format!("No base reaches {target}: {why_none}.\n") };
    let depth = answer.object.depth_m.filter(|_| rates.bases.target_width_m.is_none()).map(|depth| {
        let depth = number::length(depth);
        format!("No width reaches {target}: it then falls over its depth ({depth} m).\n")
    });
    let by_limit = match answer.base_by_limit() {
        Some(base) => format!("{base} by the upper limit"),
        None => format!("none by the upper limit: {why_none}"),
    };
    format!("{}Base for {target}: {base}; {by_limit}.\n", depth.unwrap_or_default())
}

fn tell_list(all: &[Answer<RatesRow>], site: &Site, target: Option<f64>, out: Option<&Path>) -> String {
    let worst = &all[0];
    let years = when(&worst.row);
    let width = target.map(|target| format!("base for {}", PERCENT.one(target)));
    let headings = ["rocks", "overturns", "once in years", &years, "", "friction"];
    let headings: Vec<&str> = headings.into_iter().chain(width.as_deref()).collect();
    let table = table(&headings, all, out, |answer| {
        let (object, rates) = (&answer.object, &answer.row);
        let mut cells = vec![
            RATE.value(Interval::without_limits(rates.rocking_per_year)),
            RATE.value(rates.overturning_per_year),
            rates.return_period_years.map_or("-".to_string(), period),
            PERCENT.value(rates.p_overturning),
            PERCENT.limits(rates.p_overturning, ""),
            friction(object),
        ];
        cells.extend(target.map(|_| answer.base().unwrap_or("-".to_string())));
        cells
    });
    let (name, how_often) = (name(&worst.object.structure), how_often(&worst.row, site));
    let first = match how_often.strip_prefix("overturns ") {
        Some(often) => format!("{name} overturns most often: {often}"),
        None => format!("{name} {how_often}"),
    };
    let (model, usual) = (model_of_all(all), usual_motion(site));
    let by = format!(
        "Annual rates by {model}{usual}. With less friction than shown, an object slides instead of rocking."
    );
    format!(
        "{first}\n{table}{}{}{}",
        line([expected_number(all)]),
        about_limits(worst, site),
        line([Some(by), about_buildings(all)]),
    )
}

fn when(rates: &RatesRow) -> String {
    rates.years.map_or(String::new(), in_years)
}

/// The motion that codes design for, by the curve: who knows the site sees a wrong unit or column by it.
fn usual_motion(site: &Site) -> String {
    let Hazard::Curve(PeakHazard { peak, curve, .. }) = &site.hazard else { return String::new() };
    let intensity = curve.intensity(1.0 / 475.0);
    let years = count((1.0 / curve.exceedance(intensity)).round() as usize);
    format!("; {} {} once in {years} years", peak.to_string().to_uppercase(), with_unit(*peak, intensity))
}

fn with_unit(peak: Peak, intensity: f64) -> String {
    match peak {
        Peak::Pga => format!("{} g", significant(intensity / G_M_S2, 3)),
        Peak::Pgv => format!("{} m/s", significant(intensity, 3)),
    }
}

/// The largest part of the error, what the limits do not contain, and what was extrapolated: a line, or none.
fn about_limits(answer: &Answer<RatesRow>, site: &Site) -> String {
    let advice = match answer.row.velocity_by {
        Some(VelocitySource::Spectrum) => "Add the PGV curve.",
        Some(VelocitySource::Sites | VelocitySource::Motions) => match &site.hazard {
            Hazard::Curve(PeakHazard { peak: Peak::Pgv, .. }) => "Add the PGA curve.",
            _ => "Add the PGV or SA(1.0 s) curve.",
        },
        _ => "",
    };
    let is_known = answer.row.overturning_per_year.value.is_some_and(|rate| rate > 0.0);
    let without = "The limits exclude the uncertainty of the hazard.".to_string();
    line([
        mostly_unknown(answer, advice).filter(|_| is_known),
        Some(without).filter(|_| is_known && !has_fractiles(site)),
        extrapolated(&answer.row).map(|text| format!("{text}.")),
    ])
}

fn has_fractiles(site: &Site) -> bool {
    matches!(site.hazard, Hazard::Curve(PeakHazard { fractiles: Some(_), .. }))
}

fn extrapolated(rates: &RatesRow) -> Option<String> {
    let share = rates.share_extrapolated?;
    Some(format!("{} of the rate lies beyond the curve", PERCENT.one(share)))
}

/// How often it overturns, with limits or bounds.
fn how_often(rates: &RatesRow, site: &Site) -> String {
    match rates.overturning_per_year {
        Interval { value: Some(0.0), .. } => {
            "does not overturn: nothing of the hazard uplifts it".to_string()
        }
        Interval { value: Some(rate), .. } => {
            let (period, in_years, p) = (period(1.0 / rate), when(rates), rates.p_overturning);
            let (value, limits) = (PERCENT.value(p), PERCENT.limits(p, "95 % limits "));
            format!("overturns once in {period} years; {value} {in_years} {limits}")
        }
        bounds @ Interval { value: None, low: Some(_), high: Some(_) } => {
            let end = match &site.hazard {
                Hazard::Curve(PeakHazard { peak, curve, .. }) => {
                    let [_, (last, rate)] = curve.ends();
                    let last = with_unit(*peak, last);
                    let years = count((1.0 / rate).round() as usize);
                    format!(": the curve ends at {last} (once in {years} years)")
                }
                Hazard::Joint(_) => String::new(),
            };
            let bounds = RATE.value(bounds).replacen(" to ", " and ", 1);
            let (in_years, p) = (when(rates), PERCENT.value(rates.p_overturning));
            format!("overturns between {bounds} times a year, {p} {in_years}{end}")
        }
        _ => NO_RATE.to_string(),
    }
}
