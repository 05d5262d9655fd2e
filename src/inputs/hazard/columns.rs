//! What the headings of a hazard say: peaks and spectral accelerations by their units, rates, probabilities
//! and return periods, means and fractiles.

use crate::fragility::Peak;
use crate::inputs::{Grid, Heading, InputError};
use crate::units::Quantity;

/// Whether one of the words of a list is among these.
fn has(words: &[&str], list: &str) -> bool {
    list.split(' ').any(|known| words.contains(&known))
}

/// The peak that a heading names, and its unit in m/s2 or m/s; none where it names none, or no unit, or has a
/// word more, which may change the meaning: `vertical PGA`.
pub fn peak(heading: &Heading) -> Option<(Peak, f64)> {
    const BESIDE: &str = "peak ground g motion horizontal mean rotd50 geomean h at site level iml";
    let unit = heading.unit?;
    let (peak, names) = match unit.quantity {
        Quantity::Acceleration => (Peak::Pga, "pga ag a acceleration motion iml level"),
        Quantity::Velocity => (Peak::Pgv, "pgv velocity"),
        _ => return None,
    };
    let words: Vec<&str> = heading.name.split('_').collect();
    let are_known = words.iter().all(|word| has(&[word], names) || has(&[word], BESIDE));
    (are_known && has(&words, names)).then_some((peak, unit.si))
}

/// How a column expresses frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Frequency {
    /// Annual rate of exceedance.
    Rate,
    /// Probability of exceedance in this many years.
    ProbabilityIn(f64),
    /// Years between exceedances.
    ReturnPeriod,
    /// Annual rate of occurrence of a pair of peaks.
    Occurrence,
}

/// More motions a year than any site has that a hazard counts.
const MOST_FREQUENT: f64 = 1000.0;

impl Frequency {
    /// None where a word stands beside that may change the meaning: `monthly rate`, `non-exceedance`.
    fn new(words: &[&str], investigation_years: Option<f64>) -> Option<Frequency> {
        const RATES: &str = "rate frequency frequenza afe afoe mafe mare lambda \u{3bb} tasa taux";
        const PERIODS: &str = "return ritorno retorno retour wiederkehrperiode tr rp arp";
        const PROBABILITIES: &str = "probability poe pe aep ape probabilidad probabilité wahrscheinlichkeit";
        const BESIDE: &str = "annual annua anual media mean of occurrence exceedance exceedence eccedenza \
                              excedencia per a in year years yr yrs y period recurrence average t r tempo \
                              periodo di de anni años ans jahre jahren";
        let (numbers, words): (Vec<&str>, Vec<&str>) =
            words.iter().partition(|word| word.starts_with(|sign: char| sign.is_ascii_digit()));
        let years: Option<f64> = numbers.first().and_then(|number| number.parse().ok());
        let is_known =
            |word: &&str| [RATES, PERIODS, PROBABILITIES, BESIDE].iter().any(|list| has(&[word], list));
        if !words.iter().all(is_known) {
            None
        } else if has(&words, PROBABILITIES) {
            let annual = has(&words, "annual aep ape").then_some(1.0);
            years.or(annual).or(investigation_years).map(Frequency::ProbabilityIn)
        } else if years.is_some_and(|years| years != 1.0) {
            None
        } else if has(&words, "occurrence") {
            Some(Frequency::Occurrence)
        } else if has(&words, PERIODS) || words.starts_with(&["t", "r"]) {
            Some(Frequency::ReturnPeriod)
        } else {
            has(&words, RATES).then_some(Frequency::Rate)
        }
    }

    /// Reads the annual rate in a cell; none if the motion is certain, whose rate is unknown.
    pub fn annual_rate(self, grid: &Grid, row: usize, column: usize) -> Result<Option<f64>, InputError> {
        let number = grid.number(row, column)?;
        let expected = match self {
            Frequency::Rate | Frequency::Occurrence if grid.is_percent(row, column) => {
                "a rate a year, such as 0.002; percent are probabilities"
            }
            Frequency::Rate | Frequency::Occurrence if (0.0..=MOST_FREQUENT).contains(&number) => {
                return Ok(Some(number));
            }
            Frequency::Rate | Frequency::Occurrence => "a rate a year from 0 to 1000",
            Frequency::ReturnPeriod if number > 0.0 => return Ok(Some(1.0 / number)),
            Frequency::ReturnPeriod => "years above 0",
            Frequency::ProbabilityIn(years) if (0.0..1.0).contains(&number) => {
                return Ok(Some(-(-number).ln_1p() / years));
            }
            Frequency::ProbabilityIn(_) if number == 1.0 => return Ok(None),
            Frequency::ProbabilityIn(_) => "a probability from 0 to 1, or with a percent sign",
        };
        Err(grid.refusal(row, column, expected))
    }
}

/// Which of several curves of an intensity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Statistic {
    Mean,
    Median,
    Low,
    High,
}

/// What a curve is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Intensity {
    Peak(Peak),
    /// Spectral acceleration at 1 s.
    Spectral,
    /// At another period, or an acceleration that is told beside the rates.
    Other,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Content {
    /// With the unit in m/s2 or m/s.
    Intensity(Intensity, f64),
    /// With the intensity whose frequency it is, where the heading tells.
    Frequency(Frequency, Option<Intensity>),
    Magnitude,
    Period,
    Unknown,
}

const YEARS: &str = "year years yr yrs y anni a\u{f1}os ans jahre jahren";

/// Splits a name at its underscores, and between letters and digits: `pe50` is `pe` and `50`.
fn parts(name: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    for word in name.split('_') {
        let is_digit = |sign: &char| sign.is_ascii_digit();
        let mut start = 0;
        for ((at, sign), (_, before)) in word.char_indices().skip(1).zip(word.char_indices()) {
            if is_digit(&sign) != is_digit(&before) {
                parts.push(&word[start..at]);
                start = at;
            }
        }
        parts.push(&word[start..]);
    }
    parts
}

/// The intensity that words name, and the other words.
fn intensity_named<'a>(words: &[&'a str]) -> (Option<Intensity>, Vec<&'a str>) {
    let is_number = |word: &&&str| word.starts_with(|sign: char| sign.is_ascii_digit());
    for (at, word) in words.iter().enumerate() {
        let periods = words[at + 1..].iter().take_while(is_number).copied().collect::<Vec<_>>();
        let (intensity, length) = match *word {
            "pga" => (Intensity::Peak(Peak::Pga), 1),
            "pgv" => (Intensity::Peak(Peak::Pgv), 1),
            "sa" | "psa" | "s" | "acceleration" if *word != "s" || at == 0 && !periods.is_empty() => {
                let period: Option<f64> = periods.join(".").parse().ok();
                let is_spectral = *word != "acceleration" || at > 0 && words[at - 1] == "spectral";
                if !is_spectral {
                    continue;
                }
                let of = if period == Some(1.0) { Intensity::Spectral } else { Intensity::Other };
                let in_s = words.get(at + 1 + periods.len()).is_some_and(|next| has(&[next], "s sec"));
                (of, 1 + periods.len() + usize::from(in_s))
            }
            _ => continue,
        };
        let others = words[..at].iter().chain(&words[at + length..]).filter(|word| **word != "spectral");
        return (Some(intensity), others.copied().collect());
    }
    (None, words.to_vec())
}

/// What a heading says of its column, and of which curve it is.
pub fn content(heading: &Heading, investigation_years: Option<f64>) -> (Content, Statistic) {
    const STATISTICS: [(Statistic, &[&str]); 3] = [
        (Statistic::Low, &["16", "0.16", "p16", "16th"]),
        (Statistic::High, &["84", "0.84", "p84", "84th"]),
        (Statistic::Median, &["median", "p50", "50th", "0.5"]),
    ];
    let mut words: Vec<&str> = heading.text.split(['_', ' ', '(', ')', '[', ']', '-', '%', ',']).collect();
    // A number of years is no fractile.
    let is_of_years = |at: usize| words.get(at + 1).is_some_and(|next| has(&[next], YEARS));
    let named = (0..words.len()).filter(|at| !is_of_years(*at)).find_map(|at| {
        let word = words[at].to_lowercase();
        let (statistic, _) = STATISTICS.iter().find(|(_, names)| names.contains(&word.as_str()))?;
        Some((at, *statistic))
    });
    let (statistic, heading) = match named {
        Some((at, statistic)) => {
            words.remove(at);
            let rest = Heading::new(words.join(" ").trim());
            (statistic, Heading { unit: heading.unit, ..rest })
        }
        None => (Statistic::Mean, heading.clone()),
    };
    let words = parts(&heading.name);
    let (of, others) = intensity_named(&words);
    let frequency = Frequency::new(&others, investigation_years);
    let acceleration = heading.unit.filter(|unit| unit.quantity == Quantity::Acceleration);
    let content = match (peak(&heading), frequency, heading.name.as_str()) {
        (Some((peak, unit)), ..) => Content::Intensity(Intensity::Peak(peak), unit),
        (None, Some(frequency), _) => Content::Frequency(frequency, of),
        (.., "mw" | "magnitude" | "m" | "mag") => Content::Magnitude,
        (.., "t" | "period" | "periods" | "periodo") => Content::Period,
        _ => match (of, acceleration) {
            (Some(of @ (Intensity::Spectral | Intensity::Other)), Some(unit)) if others.is_empty() => {
                Content::Intensity(of, unit.si)
            }
            _ => Content::Unknown,
        },
    };
    (content, statistic)
}
