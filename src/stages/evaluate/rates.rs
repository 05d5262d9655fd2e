//! Annual rates at a site, and in words.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::object::{Answer, ObjectRow, Predicted};
use super::target::{Base, Bases};
use super::words::{
    about_buildings, friction, line, model, model_of_all, mostly_unknown, table, title, too_far, validity,
};
use crate::fragility::Peak;
use crate::hazard::{Hazard, PeakHazard, Site, SiteRates, VelocitySource, probability_in_years};
use crate::number::{
    self, Limited, PERCENT, RATE, aligned, count, counted, name, period, plain, significant,
};
use crate::units::G_M_S2;

/// Annual rates of an object, and probabilities in the time of exposure. Where the hazard ends too early for
/// a value there is a range alone, in the columns of limits.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RatesRow {
    pub rocking_per_year: Option<f64>,
    pub failure_per_year: Limited,
    pub overturning_per_year: Limited,
    pub return_period_years: Option<f64>,
    pub years: Option<f64>,
    pub p_rocking: Option<f64>,
    pub p_failure: Limited,
    pub p_overturning: Limited,
    /// Whether the hazard ends too early for a rate of overturning.
    pub is_range: Option<bool>,
    /// Source of PGV / PGA.
    pub velocity_by: Option<VelocitySource>,
    /// Share of the rate of overturning beyond the last point of a curve that is extrapolated.
    pub share_extrapolated: Option<f64>,
    pub counted_motions: Option<i64>,
    pub counted_per_year: Limited,
    /// Widths of the base that meet the target by the estimate and by its upper limit.
    pub target_width_m: Option<f64>,
    pub target_width_m_high: Option<f64>,
    /// Where the depth is what is too small: the least of both sides.
    pub target_sides_m: Option<f64>,
    pub target_sides_m_high: Option<f64>,
}

impl RatesRow {
    pub fn new(rates: &SiteRates, years: f64, bases: Bases) -> RatesRow {
        let in_years = |rate: f64| probability_in_years(rate, years);
        let counted = rates.counted.as_ref();
        let rocking = rates.rocking.and_then(|rate| rate.value());
        let [failure, overturning] =
            [rates.failure, rates.overturning].map(|rate| rate.map(Limited::from).unwrap_or_default());
        RatesRow {
            rocking_per_year: rocking,
            failure_per_year: failure,
            overturning_per_year: overturning,
            return_period_years: overturning.value.map(f64::recip).filter(|years| years.is_finite()),
            years: Some(years),
            p_rocking: rocking.map(in_years),
            p_failure: failure.map(in_years),
            p_overturning: overturning.map(in_years),
            is_range: rates.overturning.map(|rate| rate.value().is_none()),
            velocity_by: rates.velocity,
            share_extrapolated: rates.beyond,
            counted_motions: counted.map(|rate| rate.motions as i64),
            counted_per_year: counted.map(|rate| rate.annual_rate.into()).unwrap_or_default(),
            target_width_m: bases.by_estimate.and_then(Base::width),
            target_width_m_high: bases.by_upper_limit.and_then(Base::width),
            target_sides_m: bases.by_estimate.and_then(Base::both_sides),
            target_sides_m_high: bases.by_upper_limit.and_then(Base::both_sides),
        }
    }
}

impl Predicted for RatesRow {
    fn overturning(&self) -> Limited {
        self.overturning_per_year
    }
}

/// The answer for all objects, in words.
pub fn text(all: &[Answer<RatesRow>], site: &Site, target: Option<f64>, out: Option<&Path>) -> String {
    let of_one = |answer: &Answer<RatesRow>| of_one(answer, site, target);
    super::words::text(all, of_one, || of_several(all, site, target, out))
}

fn of_one(answer: &Answer<RatesRow>, site: &Site, target: Option<f64>) -> String {
    let Answer { object, row: rates, .. } = answer;
    let years = rates.years.unwrap_or(f64::NAN);
    let cells = |name: String, rate: Limited| {
        let p = rate.map(|rate| probability_in_years(rate, years));
        vec![name, RATE.value(rate), PERCENT.value(p), PERCENT.limits(p, "")]
    };
    let mut lines = vec![
        vec![String::new(), "a year".to_string(), in_years(rates)],
        cells("rocks".to_string(), Limited::value(rates.rocking_per_year)),
        cells(format!("{}, or overturns", too_far(object)), rates.failure_per_year),
        cells("overturns".to_string(), rates.overturning_per_year),
    ];
    lines.extend(rates.counted_motions.map(|motions| {
        let motions = counted(motions as usize, "motion");
        cells(format!("overturns, counted among {motions}"), rates.counted_per_year)
    }));
    let widths = target.map_or(String::new(), |target| words_of_target(object, rates, target));
    format!(
        "{}: {}\n{}{}{widths}By {}{}.\n{}",
        title(object),
        how_often(rates, site),
        aligned(&lines, |_| false),
        about_limits(answer, site),
        model(object),
        usual_motion(site),
        validity(answer)
    )
}

/// The expected number of a list, and the probability that one or more overturns: between that of the worst
/// and that of independent ones. Of an object of which only a range is known both ends count.
pub fn expected_number(all: &[Answer<RatesRow>]) -> Option<String> {
    let known = |Answer { object, row, .. }: &Answer<RatesRow>| {
        let Limited { value, low, high } = row.p_overturning;
        Some((object.count.unwrap_or(1.0), value.or(low)?, value.or(high)?))
    };
    let known: Vec<(f64, f64, f64)> = all.iter().filter_map(known).collect();
    let number: f64 = known.iter().map(|(count, ..)| count).sum();
    let least: f64 = known.iter().map(|(count, low, _)| count * low).sum();
    let most: f64 = known.iter().map(|(count, _, high)| count * high).sum();
    let worst = known.iter().filter(|(count, ..)| *count > 0.0).map(|(_, low, _)| *low).fold(0.0, f64::max);
    let independent = -known.iter().map(|(count, _, high)| count * (-high).ln_1p()).sum::<f64>();
    let years = in_years(&all.first()?.row);
    let (low, high) = (significant(least, 2), significant(most, 2));
    let expected = if low == high { low } else { format!("{low} to {high}") };
    (number > 1.0).then(|| {
        format!(
            "Expected number overturning {years}: {expected} of {}. Probability that at least one does: {} (if all \
             fall together) to {} (if independent).",
            plain(number),
            PERCENT.one(worst),
            PERCENT.one(-(-independent).exp_m1())
        )
    })
}

/// The bases that meet a target, or why none does.
fn words_of_target(object: &ObjectRow, rates: &RatesRow, target: f64) -> String {
    let (target, years) = (PERCENT.one(target), in_years(rates));
    let base = |width: Option<f64>, sides: Option<f64>| match (width, sides) {
        (Some(width), _) => format!("{width:.2} m"),
        (_, Some(side)) => format!("both sides {side:.2} m"),
        _ => "none".to_string(),
    };
    let [by_estimate, by_limit] = [
        base(rates.target_width_m, rates.target_sides_m),
        base(rates.target_width_m_high, rates.target_sides_m_high),
    ];
    let depth = object.depth_m.filter(|_| rates.target_width_m.is_none());
    let depth = depth.map(|depth| {
        format!(
            "No width reaches {target} {years}: it then falls over its depth ({} m).\n",
            number::length(depth)
        )
    });
    let none = || format!("No width below its height reaches {target} {years}.\n");
    match (by_estimate.as_str(), rates.overturning_per_year.value) {
        (_, None) => {
            format!("No width for {target} {years}: the hazard curve ends too early (--extrapolate).\n")
        }
        ("none", _) => depth.unwrap_or_else(none),
        _ => format!(
            "{}Width for {target} {years}: {by_estimate}; {by_limit} by the upper limit.\n",
            depth.unwrap_or_default()
        ),
    }
}

fn of_several(all: &[Answer<RatesRow>], site: &Site, target: Option<f64>, out: Option<&Path>) -> String {
    let worst = &all[0];
    let years = in_years(&worst.row);
    let width = target.map(|target| format!("width for {}", PERCENT.one(target)));
    let headings = ["rocks", "overturns", "once in years", &years, "", "friction"];
    let headings: Vec<&str> = headings.into_iter().chain(width.as_deref()).collect();
    let table = table(&headings, all, out, |Answer { object, row: rates, .. }| {
        let width = || {
            let sides = rates.target_sides_m.map(|side| format!("both {side:.2} m"));
            let width = rates.target_width_m.map(|width| format!("{width:.2} m"));
            width.or(sides).unwrap_or("-".to_string())
        };
        let cells = [
            RATE.value(Limited::value(rates.rocking_per_year)),
            RATE.value(rates.overturning_per_year),
            rates.return_period_years.map_or("-".to_string(), period),
            PERCENT.value(rates.p_overturning),
            PERCENT.limits(rates.p_overturning, ""),
            friction(object),
        ];
        cells.into_iter().chain(target.map(|_| width())).collect()
    });
    let (name, how_often) = (name(&worst.object.structure), how_often(&worst.row, site));
    let first = match how_often.strip_prefix("overturns ") {
        Some(often) => format!("{name} overturns most often: {often}"),
        None => format!("{name} {how_often}"),
    };
    let (model, usual) = (model_of_all(all), usual_motion(site));
    let by = format!(
        "Rates are a year, by {model}{usual}. With less friction than shown, an object slides instead of rocking."
    );
    format!(
        "{first}\n{table}{}{}{}",
        line([expected_number(all)]),
        about_limits(worst, site),
        line([Some(by), about_buildings(all)]),
    )
}

fn in_years(rates: &RatesRow) -> String {
    let years = rates.years.unwrap_or(f64::NAN);
    format!("in {} year{}", plain(years), if years == 1.0 { "" } else { "s" })
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
        Limited { value: Some(0.0), .. } => "does not overturn: nothing of the hazard uplifts it".to_string(),
        Limited { value: Some(rate), .. } => {
            let (period, in_years, p) = (period(1.0 / rate), in_years(rates), rates.p_overturning);
            let (value, limits) = (PERCENT.value(p), PERCENT.limits(p, "95 % limits "));
            format!("overturns once in {period} years; {value} {in_years} {limits}")
        }
        bounds @ Limited { value: None, low: Some(_), high: Some(_) } => {
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
            let (in_years, p) = (in_years(rates), PERCENT.value(rates.p_overturning));
            format!("overturns between {bounds} times a year, {p} {in_years}{end}")
        }
        _ => "has no rate of overturning".to_string(),
    }
}
