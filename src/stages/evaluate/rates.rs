//! Annual rates at a site, and in words.

use serde::{Deserialize, Serialize};

use super::object::{Answer, Predicted};
use super::target::Target;
use super::words::{
    brief, friction, linear, model, model_of_all, mostly_unknown, size, table, title, too_far, unanswered,
    validity, with_sentences,
};
use crate::fragility::Peak;
use crate::hazard::{Hazard, PeakHazard, Site, SiteRates, VelocitySource, probability_in_years};
use crate::number::{Limited, PERCENT, RATE, aligned, count, counted, period, plain, significant};
use crate::units::G_M_S2;

/// Annual rates of an object, and probabilities in the time of exposure. Where the hazard ends too early for
/// a value there are bounds alone, in the columns of limits.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RatesRow {
    pub rocking_per_year: Option<f64>,
    pub failure_per_year: Option<f64>,
    pub failure_per_year_low: Option<f64>,
    pub failure_per_year_high: Option<f64>,
    pub overturning_per_year: Option<f64>,
    pub overturning_per_year_low: Option<f64>,
    pub overturning_per_year_high: Option<f64>,
    pub return_period_years: Option<f64>,
    pub years: Option<f64>,
    pub p_rocking: Option<f64>,
    pub p_failure: Option<f64>,
    pub p_failure_low: Option<f64>,
    pub p_failure_high: Option<f64>,
    pub p_overturning: Option<f64>,
    pub p_overturning_low: Option<f64>,
    pub p_overturning_high: Option<f64>,
    /// Source of PGV / PGA.
    pub velocity_by: Option<String>,
    /// Share of the rate of overturning beyond the last point of a curve that is extrapolated.
    pub share_extrapolated: Option<f64>,
    pub counted_motions: Option<i64>,
    pub counted_per_year: Option<f64>,
    pub counted_per_year_low: Option<f64>,
    pub counted_per_year_high: Option<f64>,
    /// Widths of the base that meet the target by the estimate and by its upper limit.
    pub target_width_m: Option<f64>,
    pub target_width_m_high: Option<f64>,
    pub warnings: Option<String>,
}

impl RatesRow {
    pub fn new(rates: &SiteRates, years: f64) -> RatesRow {
        let in_years = |rates: Limited| rates.map(|rate| Some(probability_in_years(rate?, years)));
        let ([failure, failure_low, failure_high], [value, low, high]) = (rates.failure, rates.overturning);
        let [p_failure, p_failure_low, p_failure_high] = in_years(rates.failure);
        let [p_overturning, p_overturning_low, p_overturning_high] = in_years(rates.overturning);
        let counted = rates.counted.as_ref();
        RatesRow {
            rocking_per_year: rates.rocking,
            failure_per_year: failure,
            failure_per_year_low: failure_low,
            failure_per_year_high: failure_high,
            overturning_per_year: value,
            overturning_per_year_low: low,
            overturning_per_year_high: high,
            return_period_years: value.map(|rate| 1.0 / rate).filter(|years| years.is_finite()),
            years: Some(years),
            p_rocking: rates.rocking.map(|rate| probability_in_years(rate, years)),
            p_failure,
            p_failure_low,
            p_failure_high,
            p_overturning,
            p_overturning_low,
            p_overturning_high,
            velocity_by: rates.velocity.map(|source| source.to_string()),
            share_extrapolated: rates.beyond,
            counted_motions: counted.map(|rate| rate.motions as i64),
            counted_per_year: counted.map(|rate| rate.value),
            counted_per_year_low: counted.map(|rate| rate.limits.low),
            counted_per_year_high: counted.map(|rate| rate.limits.high),
            target_width_m: None,
            target_width_m_high: None,
            warnings: None,
        }
    }

    /// Rate of failure with limits; limits alone are bounds.
    pub fn failure(&self) -> Limited {
        [self.failure_per_year, self.failure_per_year_low, self.failure_per_year_high]
    }

    /// Rate of overturning with limits; limits alone are bounds.
    pub fn overturning(&self) -> Limited {
        [self.overturning_per_year, self.overturning_per_year_low, self.overturning_per_year_high]
    }

    /// The probability of overturning in the time of exposure, as the rate.
    pub fn in_years(&self) -> Limited {
        [self.p_overturning, self.p_overturning_low, self.p_overturning_high]
    }
}

impl Predicted for RatesRow {
    fn with_warnings(self, warnings: Option<String>) -> RatesRow {
        RatesRow { warnings, ..self }
    }

    fn severity(&self) -> f64 {
        self.overturning_per_year.or(self.overturning_per_year_high).unwrap_or(f64::NEG_INFINITY)
    }
}

/// The answer for all objects, in words.
pub fn text(all: &[Answer<RatesRow>], site: &Site, target: Option<Target>, sentence: bool) -> String {
    let text = match all {
        [] => String::new(),
        _ if all.iter().all(|answer| answer.object.p_rad_s.is_none()) => {
            all.iter().map(|answer| unanswered(answer, &answer.row.warnings)).collect()
        }
        [answer] => of_one(answer, site, target),
        [worst, ..] => of_several(worst, all, site, target),
    };
    with_sentences(text, all, sentence, |object, rates| {
        let how_often = how_often(rates, site, "95 % confidence limits ");
        let extended = extrapolated(rates).map_or(String::new(), |text| format!(" ({text})"));
        format!("{how_often}{extended}, by {}{}", model(object), not_in_limits(site, ", without "))
    })
}

fn of_one(answer: &Answer<RatesRow>, site: &Site, target: Option<Target>) -> String {
    let Answer { object, row: rates, .. } = answer;
    let years = rates.years.unwrap_or(f64::NAN);
    let line = |name: String, rate: Limited| {
        let p = rate.map(|rate| Some(probability_in_years(rate?, years)));
        vec![name, RATE.value(rate), PERCENT.value(p), PERCENT.limits(p, "")]
    };
    let mut lines = vec![
        vec![String::new(), "a year".to_string(), in_years(rates)],
        line("rocks".to_string(), [rates.rocking_per_year, None, None]),
        line(format!("{}, or overturns", too_far(object)), rates.failure()),
        line("overturns".to_string(), rates.overturning()),
    ];
    if let Some(motions) = rates.counted_motions {
        let motions = counted(motions as usize, "motion");
        let rate = [rates.counted_per_year, rates.counted_per_year_low, rates.counted_per_year_high];
        lines.push(line(format!("overturns, counted among {motions}"), rate));
    }
    let widths = target.map_or(String::new(), |target| {
        let width = |width: Option<f64>| width.map_or("none".to_string(), |width| format!("{width:.2} m"));
        let (target, by) =
            (PERCENT.one(target.0), [rates.target_width_m, rates.target_width_m_high].map(width));
        format!("Width for {target} {}: {}; {} by the upper limit.\n", in_years(rates), by[0], by[1])
    });
    format!(
        "{}: {}\n{}{}{widths}By {}{}.\n{}\n",
        title(object),
        how_often(rates, site, "95 % limits "),
        aligned(&lines, |_| false),
        about_limits(answer, site),
        model(object),
        usual_motion(site),
        validity(object)
    )
}

/// The expected number of a list, and the probability that one or more overturns: between that of the worst
/// and that of independent ones.
fn of_all(all: &[Answer<RatesRow>]) -> Option<String> {
    let known: Vec<(f64, f64)> = all
        .iter()
        .filter_map(|answer| Some((answer.object.count.unwrap_or(1.0), answer.row.p_overturning?)))
        .collect();
    let number: f64 = known.iter().map(|(count, _)| count).sum();
    let expected: f64 = known.iter().map(|(count, p)| count * p).sum();
    let worst = known.iter().filter(|(count, _)| *count > 0.0).map(|(_, p)| *p).fold(0.0, f64::max);
    let independent = -known.iter().map(|(count, p)| count * (-p).ln_1p()).sum::<f64>();
    let years = in_years(&all.first()?.row);
    (number > 1.0).then(|| {
        let [low, high] = [worst, -(-independent).exp_m1()];
        let limits = PERCENT.value([None, Some(low), Some(high)]);
        format!(
            "Of {} objects {} overturn {years} on average; at least one: {limits}.\n",
            plain(number),
            significant(expected, 2)
        )
    })
}

fn of_several(
    worst: &Answer<RatesRow>,
    all: &[Answer<RatesRow>],
    site: &Site,
    target: Option<Target>,
) -> String {
    let years = in_years(&worst.row);
    let width = target.map(|target| format!("width for {}", PERCENT.one(target.0)));
    let heading = ["object", "size", "rocks", "overturns", "once in years", &years, "", "friction"];
    let heading: Vec<&str> = heading.into_iter().chain(width.as_deref()).chain(["warning"]).collect();
    let table = table(&heading, all, |answer| {
        let Answer { object, row: rates, .. } = answer;
        let mut cells = vec![
            object.structure.clone(),
            size(object),
            RATE.value([rates.rocking_per_year, None, None]),
            RATE.value(rates.overturning()),
            rates.return_period_years.map_or("-".to_string(), period),
            PERCENT.value(rates.in_years()),
            PERCENT.limits(rates.in_years(), ""),
            friction(object),
        ];
        if target.is_some() {
            cells.push(rates.target_width_m.map_or("-".to_string(), |width| format!("{width:.2} m")));
        }
        cells.push(brief(answer, &rates.warnings));
        cells
    });
    let how_often = how_often(&worst.row, site, "95 % limits ");
    format!(
        "{} overturns most often: {}\n{table}{}{}Rates a year, by {}{}. Below its friction an object slides instead.{}\n",
        worst.object.structure,
        how_often.trim_start_matches("overturns "),
        of_all(all).unwrap_or_default(),
        about_limits(worst, site),
        model_of_all(all),
        usual_motion(site),
        linear(all.iter().map(|answer| &answer.object)),
    )
}

fn in_years(rates: &RatesRow) -> String {
    let years = rates.years.unwrap_or(f64::NAN);
    format!("in {} year{}", plain(years), if years == 1.0 { "" } else { "s" })
}

/// The largest part of the error, what the limits do not contain, and what was extrapolated: a line, or none.
fn about_limits(answer: &Answer<RatesRow>, site: &Site) -> String {
    let advice = match answer.row.velocity_by.as_deref().and_then(|source| source.parse().ok()) {
        Some(VelocitySource::Spectrum) => "Add the PGV curve.",
        Some(VelocitySource::Sites | VelocitySource::Motions) => match &site.hazard {
            Hazard::Curve(PeakHazard { peak: Peak::Pgv, .. }) => "Add the PGA curve.",
            _ => "Add the PGV or SA(1.0 s) curve.",
        },
        _ => "",
    };
    let is_known = answer.row.overturning_per_year.is_some_and(|rate| rate > 0.0);
    let unknown = mostly_unknown(&answer.budget, advice).filter(|_| is_known);
    let without = not_in_limits(site, "The limits exclude ");
    let without = Some(format!("{without}.")).filter(|without| is_known && without.len() > 1);
    let parts = [unknown, without, extrapolated(&answer.row).map(|text| format!("{text}."))];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    if parts.is_empty() { String::new() } else { parts.join(" ") + "\n" }
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
        Peak::Pga => format!("{} g", significant(intensity / G_M_S2, 2)),
        Peak::Pgv => format!("{} m/s", significant(intensity, 2)),
    }
}

fn not_in_limits(site: &Site, before: &str) -> String {
    match &site.hazard {
        Hazard::Curve(PeakHazard { fractiles: Some(_), .. }) => String::new(),
        _ => format!("{before}the uncertainty of the hazard"),
    }
}

fn extrapolated(rates: &RatesRow) -> Option<String> {
    let share = rates.share_extrapolated?;
    Some(format!("{} of the rate lies beyond the curve", PERCENT.one(share)))
}

/// How often it overturns, with limits or bounds.
fn how_often(rates: &RatesRow, site: &Site, limits: &str) -> String {
    match rates.overturning() {
        [Some(0.0), ..] => "does not overturn: nothing of the hazard uplifts it".to_string(),
        [Some(rate), ..] => {
            let (period, in_years) = (period(1.0 / rate), in_years(rates));
            let p = rates.in_years();
            format!(
                "overturns once in {period} years; {} {in_years} {}",
                PERCENT.value(p),
                PERCENT.limits(p, limits)
            )
        }
        bounds @ [None, Some(_), Some(_)] => {
            let end = match &site.hazard {
                Hazard::Curve(PeakHazard { peak, curve, .. }) => {
                    let [_, (last, rate)] = curve.ends();
                    format!(
                        ": the curve ends at {} (once in {} years)",
                        with_unit(*peak, last),
                        count((1.0 / rate).round() as usize)
                    )
                }
                Hazard::Joint(_) => String::new(),
            };
            let bounds = RATE.value(bounds).replacen(" to ", " and ", 1);
            format!("overturns between {bounds} times a year{end}")
        }
        _ => "has no rate of overturning".to_string(),
    }
}
