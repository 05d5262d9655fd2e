//! Annual rates at a site, and in words.

use serde::{Deserialize, Serialize};

use super::object::{Answer, ObjectRow, Predicted};
use super::words::{brief, friction, model, size, table, title, too_far, validity, with_sentences};
use crate::fragility::{Peak, Ratio};
use crate::hazard::{Hazard, Site, SiteRates, probability_in_years};
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
    /// With PGV / PGA a standard deviation below its median, and above.
    pub overturning_per_year_less_velocity: Option<f64>,
    pub overturning_per_year_more_velocity: Option<f64>,
    pub counted_motions: Option<i64>,
    pub counted_per_year: Option<f64>,
    pub counted_per_year_low: Option<f64>,
    pub counted_per_year_high: Option<f64>,
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
            overturning_per_year_less_velocity: rates.by_velocity.map(|rates| rates[0]),
            overturning_per_year_more_velocity: rates.by_velocity.map(|rates| rates[1]),
            counted_motions: counted.map(|rate| rate.motions as i64),
            counted_per_year: counted.map(|rate| rate.value),
            counted_per_year_low: counted.map(|rate| rate.limits.low),
            counted_per_year_high: counted.map(|rate| rate.limits.high),
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
pub fn text(all: &[Answer<RatesRow>], site: &Site, sentence: bool) -> String {
    let text = match all {
        [] => String::new(),
        [Answer { object, row, .. }] => of_one(object, row, site),
        [worst, ..] => of_several(worst, all, site),
    };
    with_sentences(text, all, sentence, |object, rates| {
        let extended = if site.extrapolate { ", with the hazard curve extrapolated" } else { "" };
        let how_often = how_often(rates, site, "95 % confidence limits ");
        format!("{how_often}, by {}{extended}, without {}", model(object), errors(site))
    })
}

fn of_one(object: &ObjectRow, rates: &RatesRow, site: &Site) -> String {
    let years = rates.years.unwrap_or(f64::NAN);
    let line = |name: String, rate: Limited| {
        let p = rate.map(|rate| Some(probability_in_years(rate?, years)));
        vec![name, RATE.value(rate), PERCENT.value(p), PERCENT.limits(p, "")]
    };
    let mut lines = vec![
        vec![String::new(), "a year".to_string(), in_years(rates)],
        line("rocks".to_string(), [rates.rocking_per_year, None, None]),
        line(format!("{}, or more", too_far(object)), rates.failure()),
        line("overturns".to_string(), rates.overturning()),
    ];
    if let Some(motions) = rates.counted_motions {
        let motions = counted(motions as usize, "motion");
        let rate = [rates.counted_per_year, rates.counted_per_year_low, rates.counted_per_year_high];
        lines.push(line(format!("overturns, counted among {motions}"), rate));
    }
    let by_velocity = rates.overturning_per_year_less_velocity.zip(rates.overturning_per_year_more_velocity);
    let least_known = by_velocity.map_or(String::new(), |(less, more)| {
        let [less, more] = [less, more].map(|rate| RATE.one(rate));
        format!(" Least known: PGV/PGA (one standard deviation: {less} to {more} a year).")
    });
    format!(
        "{}: {}\n{}Not in the limits: {}.{least_known}\nBy {}. {}\n",
        title(object),
        how_often(rates, site, "95 % limits "),
        aligned(&lines, |_| false),
        errors(site),
        model(object),
        validity(object)
    )
}

fn of_several(worst: &Answer<RatesRow>, all: &[Answer<RatesRow>], site: &Site) -> String {
    let years = in_years(&worst.row);
    let heading =
        ["object", "size", "rocks", "overturns", "once in years", &years, "", "friction", "warning"];
    let table = table(&heading, all, |answer| {
        let Answer { object, row: rates, .. } = answer;
        vec![
            object.structure.clone(),
            size(object),
            RATE.value([rates.rocking_per_year, None, None]),
            RATE.value(rates.overturning()),
            rates.return_period_years.map_or("-".to_string(), period),
            PERCENT.value(rates.in_years()),
            PERCENT.limits(rates.in_years(), ""),
            friction(object),
            brief(answer, &rates.warnings),
        ]
    });
    let how_often = how_often(&worst.row, site, "95 % limits ");
    format!(
        "{} overturns most often: {}\n{table}Rates a year, by {}. \
         Not in the limits: {}. Below its friction an object slides instead.\n",
        worst.object.structure,
        how_often.trim_start_matches("overturns "),
        model(&worst.object),
        errors(site)
    )
}

fn in_years(rates: &RatesRow) -> String {
    let years = rates.years.unwrap_or(f64::NAN);
    format!("in {} year{}", plain(years), if years == 1.0 { "" } else { "s" })
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
                Hazard::Curve(peak, curve) => {
                    let [_, (last, rate)] = curve.ends();
                    let last = match peak {
                        Peak::Pga => format!("{} g", significant(last / G_M_S2, 3)),
                        Peak::Pgv => format!("{} m/s", significant(last, 3)),
                    };
                    format!(
                        ": the curve ends at {last} (once in {} years)",
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
