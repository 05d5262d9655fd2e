//! What the headings of a hazard say: measures by their units, rates, probabilities and return periods, means
//! and fractiles.

use std::fmt;

use rockfrag_core::fragility::Peak;
use rockfrag_core::units::{Quantity, Unit};

use super::said::Said;
use crate::inputs::words::is_one_of;
use crate::inputs::{Grid, Heading, Result};

/// An intensity measure type.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Imt {
    Pga,
    Pgv,
    /// Spectral acceleration, and its period in s where one is named.
    Spectral(Option<f64>),
}

impl Imt {
    pub const SA_1S: Imt = Imt::Spectral(Some(1.0));
}

impl fmt::Display for Imt {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Imt::Pga => write!(f, "PGA"),
            Imt::Pgv => write!(f, "PGV"),
            Imt::Spectral(Some(period_s)) => write!(f, "SA({period_s:?} s)"),
            Imt::Spectral(None) => write!(f, "SA"),
        }
    }
}

/// Which of several curves of a measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display)]
pub enum Statistic {
    #[strum(serialize = "mean")]
    Mean,
    #[strum(serialize = "median")]
    Median,
    #[strum(serialize = "16 %")]
    Low,
    #[strum(serialize = "84 %")]
    High,
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

impl fmt::Display for Frequency {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Frequency::Rate => write!(f, "annual rate"),
            Frequency::ProbabilityIn(years) => write!(f, "probability in {years} years"),
            Frequency::ReturnPeriod => write!(f, "return period in years"),
            Frequency::Occurrence => write!(f, "annual rate of occurrence"),
        }
    }
}

/// A column by its heading: of values, of frequencies, or of neither.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HazardColumn {
    pub at: usize,
    /// Unit of its values, in m/s2 or m/s.
    pub unit: Option<f64>,
    pub frequency: Option<Frequency>,
    /// None where the heading names none: `Ground Motion (g)`, `AFE`.
    pub measure: Option<Imt>,
    pub statistic: Option<Statistic>,
    /// Years that the heading names.
    years: Option<f64>,
}

/// What the words of a heading, or of a cell below it, say.
pub struct Phrase {
    pub measure: Option<Imt>,
    pub statistic: Option<Statistic>,
    /// Words that say neither.
    rest: Vec<String>,
}

impl Phrase {
    pub fn new(text: &str) -> Phrase {
        let text = parted(text);
        let mut words: Vec<&str> = text.split_whitespace().collect();
        let (measure, statistic) = (take_measure(&mut words), take_statistic(&mut words));
        Phrase { measure, statistic, rest: words.into_iter().map(str::to_string).collect() }
    }

    /// Whether all other words have one of these meanings.
    pub fn says_only(&self, meanings: &[&str]) -> bool {
        self.rest.iter().all(|word| meanings.iter().any(|meaning| is_one_of(word, meaning)))
    }

    /// Whether it is of values in a unit.
    fn are_values(&self, unit: &Unit) -> bool {
        let name = match (unit.quantity, self.measure) {
            (Quantity::Acceleration, None | Some(Imt::Pga | Imt::Spectral(_))) => "acceleration",
            (Quantity::Velocity, None | Some(Imt::Pgv)) => "velocity",
            _ => return false,
        };
        let is_named = self.measure.is_some() || self.rest.iter().any(|word| is_one_of(word, name));
        is_named && self.says_only(&[name, "of-values"])
    }

    fn years(&self) -> Option<f64> {
        let mut pairs = self.rest.windows(2).filter(|pair| is_one_of(&pair[1], "years"));
        pairs.find_map(|pair| pair[0].parse().ok())
    }
}

fn is_numeric(word: &str) -> bool {
    word.starts_with(|sign: char| sign.is_ascii_digit())
}

impl HazardColumn {
    /// Reads the heading of a column, with what its file says of units and years.
    pub fn new(at: usize, heading: &Heading, said: &Said) -> HazardColumn {
        // A fractile may stand behind the unit: pga_g_16.
        let ranked =
            heading.bare.rsplit_once('_').filter(|(_, rank)| matches!(*rank, "16" | "84" | "p16" | "p84"));
        let ranked = ranked.filter(|_| heading.unit.is_none()).map(|(text, rank)| (Heading::new(text), rank));
        let (own, rank) = ranked.as_ref().map_or((heading, ""), |(own, rank)| (own, *rank));
        let own_unit = own.unit.or(heading.unit);
        let mut phrase = Phrase::new(&match own_unit {
            // The unit of a period or of years is one of the words.
            Some(Unit { quantity: Quantity::Time, name, .. }) => format!("{} {name} {rank}", own.bare),
            _ => format!("{} {rank}", own.bare),
        });
        let own_unit = own_unit.filter(|unit| unit.quantity != Quantity::Time);
        let unit = own_unit.or_else(|| said.unit(|unit| phrase.are_values(unit)));
        let unit = unit.filter(|unit| !heading.is_scaled && phrase.are_values(unit));
        if unit.is_some_and(|unit| unit.quantity == Quantity::Velocity) {
            phrase.measure = Some(Imt::Pgv);
        }
        let is_frequency = unit.is_none() && own_unit.is_none() && !heading.is_scaled;
        let frequency = Frequency::new(&phrase.rest, said.years).filter(|_| is_frequency);
        let (measure, statistic, years) = (phrase.measure, phrase.statistic, phrase.years());
        HazardColumn { at, unit: unit.map(|unit| unit.si), frequency, measure, statistic, years }
    }

    pub fn is_of_curve(&self) -> bool {
        self.unit.is_some() || self.frequency.is_some()
    }

    /// The measure and the statistic that it and another column name; none where they differ.
    pub fn named_with(&self, other: &HazardColumn) -> Option<(Option<Imt>, Option<Statistic>)> {
        let is_same = !differ(self.measure, other.measure) && !differ(self.statistic, other.statistic);
        is_same.then(|| (self.measure.or(other.measure), self.statistic.or(other.statistic)))
    }
}

/// Of values by their measure, else of frequencies.
impl fmt::Display for HazardColumn {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let measure = self.measure.map(|measure| measure.to_string());
        let frequency = self.frequency.map(|frequency| frequency.to_string());
        let statistic = self.statistic.map(|statistic| statistic.to_string());
        let parts: Vec<String> = [frequency, measure, statistic].into_iter().flatten().collect();
        f.write_str(&parts.join(", "))
    }
}

fn differ<T: PartialEq>(one: Option<T>, other: Option<T>) -> bool {
    one.zip(other).is_some_and(|(one, other)| one != other)
}

/// Whether a heading says another measure, frequency or fractile than the name that a user gives its column.
pub fn contradict(heading: &Heading, name: &Heading) -> bool {
    let [own, given] = [heading, name].map(|heading| HazardColumn::new(0, heading, &Said::default()));
    let is_ranked = given.is_of_curve() && own.statistic.is_some() && own.statistic != given.statistic;
    let is_other = differ(own.measure, given.measure) || differ(own.frequency, given.frequency);
    is_ranked || is_other || differ(own.years, given.years)
}

/// The peak that a heading names, and its unit in m/s2 or m/s; none where it names none, or no unit, or has a
/// word more, which may change the meaning: `vertical PGA`. An acceleration without a name is PGA.
pub fn peak(heading: &Heading) -> Option<(Peak, f64)> {
    let HazardColumn { unit, measure, .. } = HazardColumn::new(0, heading, &Said::default());
    match measure {
        None | Some(Imt::Pga) => Some((Peak::Pga, unit?)),
        Some(Imt::Pgv) => Some((Peak::Pgv, unit?)),
        Some(Imt::Spectral(_)) => None,
    }
}

/// A text in lower case with blanks between words and numbers: `pe50` is `pe 50`. A percent sign behind a
/// number is that of a fractile.
pub fn parted(text: &str) -> String {
    let is_digit = |sign: char| sign.is_ascii_digit() || sign == '.';
    let (mut parted, mut before) = (String::new(), ' ');
    for sign in text.to_lowercase().chars() {
        let last = parted.chars().last().unwrap_or(' ');
        if is_digit(sign) != is_digit(last) {
            parted.push(' ');
        }
        let is_rank = sign == '%' && is_digit(before);
        parted.push(if sign.is_alphanumeric() || sign == '.' { sign } else { ' ' });
        parted.push_str(if is_rank { "percentile " } else { "" });
        before = if sign == ' ' { before } else { sign };
    }
    parted.replace(". ", " ").replace(" .", " ").trim_matches('.').to_string()
}

/// Takes the first measure out of words, with its period before or behind: `1.0 s SA`, `SA0P2`.
pub fn take_measure(words: &mut Vec<&str>) -> Option<Imt> {
    const SECONDS: [&str; 4] = ["s", "sec", "second", "seconds"];
    for at in 0..words.len() {
        let before = at.checked_sub(1).map_or("", |before| words[before]);
        let start = if before == "spectral" { at - 1 } else { at };
        let name = at
            + 1
            + words[at + 1..].iter().take_while(|word| matches!(**word, "at" | "t" | "period")).count();
        let behind = &words[name..];
        let count = behind.iter().take_while(|word| is_numeric(word) || **word == "p").count();
        let peak = match words[at] {
            "pgv" => Some(Imt::Pgv),
            "velocity" if before == "ground" => Some(Imt::Pgv),
            "pga" | "ag" => Some(Imt::Pga),
            "acceleration" if before == "ground" || start == at && words[..at].contains(&"peak") => {
                Some(Imt::Pga)
            }
            "sa" | "psa" => None,
            "s" if at == 0 && count > 0 => None,
            "acceleration" if before == "spectral" => None,
            _ => continue,
        };
        if peak.is_some() {
            words.remove(at);
            return peak;
        }
        let told: Vec<&str> = behind[..count].iter().copied().filter(|word| *word != "p").collect();
        let is_before = count == 0 && start > 1 && SECONDS.contains(&words[start - 1]);
        let period_s = if is_before { words[start - 2].parse() } else { told.join(".").parse() };
        let has_unit = behind.get(count).is_some_and(|next| count > 0 && SECONDS.contains(next));
        let end = if count == 0 { at + 1 } else { name + count + usize::from(has_unit) };
        words.drain(if is_before { start - 2 } else { start }..end);
        return Some(Imt::Spectral(period_s.ok()));
    }
    None
}

/// Words beside the number of a fractile.
const RANKS: [&str; 5] = ["p", "th", "percentile", "fractile", "quantile"];

pub fn is_ranked(words: &[&str], at: usize) -> bool {
    let beside =
        [at.checked_sub(1), Some(at + 1)].into_iter().flatten().filter_map(|beside| words.get(beside));
    is_numeric(words[at]) && beside.into_iter().any(|word| RANKS.contains(word))
}

/// Takes the words that name a fractile out of others. A number of years is none.
pub fn take_statistic(words: &mut Vec<&str>) -> Option<Statistic> {
    let (at, statistic) = (0..words.len()).find_map(|at| {
        let next = words.get(at + 1).copied().unwrap_or_default();
        let are_years = is_one_of(next, "years") || at > 0 && is_one_of(words[at - 1], "probability");
        let statistic = match words[at] {
            "median" => return Some((at, Statistic::Median)),
            "50" | "0.5" | "0.50" if is_ranked(words, at) => Statistic::Median,
            "16" | "0.16" => Statistic::Low,
            "84" | "0.84" => Statistic::High,
            _ => return None,
        };
        (is_ranked(words, at) || !are_years).then_some((at, statistic))
    })?;
    words.remove(at);
    words.retain(|word| !RANKS.contains(word));
    Some(statistic)
}

impl Frequency {
    /// None where a word stands beside that may change the meaning: `monthly rate`, `non-exceedance`.
    fn new(words: &[String], investigation_years: Option<f64>) -> Option<Frequency> {
        const MEANINGS: [&str; 5] = ["rate", "return-period", "probability", "years", "of-rates"];
        let (numbers, words): (Vec<&str>, Vec<&str>) =
            words.iter().map(String::as_str).partition(|word| is_numeric(word));
        let has = |meaning: &str| words.iter().any(|word| is_one_of(word, meaning));
        let years: Option<f64> = numbers.first().and_then(|number| number.parse().ok());
        match words.iter().all(|word| MEANINGS.iter().any(|meaning| is_one_of(word, meaning))) {
            false => None,
            _ if numbers.len() > 1 => None,
            _ if has("probability") => {
                let annual = words.iter().any(|word| matches!(*word, "annual" | "aep" | "ape"));
                years.or(annual.then_some(1.0)).or(investigation_years).map(Frequency::ProbabilityIn)
            }
            // The 475 of `1/475 yr` is of one row, or of none.
            _ if numbers.iter().any(|number| number.parse() != Ok(1.0)) => None,
            _ if words.contains(&"occurrence") => Some(Frequency::Occurrence),
            _ if has("return-period") || words.starts_with(&["t", "r"]) => Some(Frequency::ReturnPeriod),
            _ => has("rate").then_some(Frequency::Rate),
        }
    }

    /// Reads the annual rate in a cell; none if the motion is certain, whose rate is unknown.
    pub fn annual_rate(self, grid: &Grid, row: usize, column: usize) -> Result<Option<f64>> {
        let number = grid.number(row, column)?;
        let (rate, expected) = match self {
            Frequency::Rate | Frequency::Occurrence if grid.is_percent(row, column) => {
                (None, "a rate a year, such as 0.002; percent are probabilities")
            }
            Frequency::Rate | Frequency::Occurrence => {
                (Some(number).filter(|rate| (0.0..=1000.0).contains(rate)), "a rate a year from 0 to 1000")
            }
            Frequency::ReturnPeriod => ((number > 0.0).then_some(1.0 / number), "years above 0"),
            Frequency::ProbabilityIn(_) if number == 1.0 => return Ok(None),
            Frequency::ProbabilityIn(years) => {
                let rate = (0.0..1.0).contains(&number).then(|| -(-number).ln_1p() / years);
                (rate, "a probability from 0 to 1, or with a percent sign")
            }
        };
        rate.map(Some).ok_or_else(|| grid.refusal(row, column, expected))
    }
}
