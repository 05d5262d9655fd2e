//! What a text says of a curve, by one parse of all: headings, comments, titles, cells and names of files.

use rockfrag_core::fragility::Peak;
use rockfrag_core::units::{G_M_S2, Quantity, Unit};

use super::told::Told;
use crate::inputs::words::is_one_of;
use crate::inputs::{Grid, Heading, Result};

#[derive(Debug, Clone, Copy, PartialEq, strum::Display)]
#[strum(serialize_all = "UPPERCASE")]
pub enum Imt {
    Pga,
    Pgv,
    /// Spectral acceleration at a period that is not named.
    Sa,
    /// At this period in s.
    #[strum(to_string = "SA({0:?} s)")]
    SaAt(f64),
}

impl Imt {
    pub const SA_1S: Imt = Imt::SaAt(1.0);

    /// The unit of its curves, g or m/s, in SI units.
    pub fn unit(self) -> f64 {
        if self == Imt::Pgv { 1.0 } else { G_M_S2 }
    }

    /// Whether two names may be of one measure.
    pub fn may_be(self, other: Imt) -> bool {
        self == other || matches!((self, other), (Imt::Sa, Imt::SaAt(_)) | (Imt::SaAt(_), Imt::Sa))
    }
}

/// Which of several curves of a measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Statistic {
    Mean,
    Median,
    #[strum(to_string = "16 %")]
    Low,
    #[strum(to_string = "84 %")]
    High,
}

/// How a column expresses the frequency of exceedance, or of pairs of peaks.
#[derive(Debug, Clone, Copy, PartialEq, strum::Display)]
pub enum Frequency {
    #[strum(to_string = "annual rate")]
    Rate,
    #[strum(to_string = "probability in {0} years")]
    ProbabilityIn(f64),
    #[strum(to_string = "return period in years")]
    ReturnPeriod,
    #[strum(to_string = "annual rate of occurrence")]
    Occurrence,
}

/// What the words of a text say: of the heading of values, of frequencies, or of neither, or of another text.
#[derive(Debug, Clone)]
pub struct Phrase {
    /// None in `Ground Motion (g)` and `AFE`.
    pub measures: Vec<Imt>,
    pub statistic: Option<Statistic>,
    /// Whether it has a word for fractiles.
    pub is_ranked: bool,
    pub unit: Option<Unit>,
    /// Unit of the values below, in m/s2 or m/s.
    pub of_values: Option<f64>,
    /// Of the frequencies below.
    pub frequency: Option<Frequency>,
    /// Words and numbers that say neither a measure nor a fractile.
    pub rest: Vec<String>,
}

impl Phrase {
    pub fn new(text: &str) -> Phrase {
        Phrase::of(&Heading::new(text), &Told::default())
    }

    /// Reads a heading, with what its file tells of units and years.
    pub fn of(heading: &Heading, told: &Told) -> Phrase {
        // A word may stand behind the unit: pga_g_16.
        let parted = heading.bare.rsplit_once('_').map(|(text, last)| (Heading::new(text), last));
        let parted = parted.filter(|(own, _)| heading.unit.is_none() && own.unit.is_some());
        let (own, last) = parted.as_ref().map_or((heading, ""), |(own, last)| (own, *last));
        // The unit of a period or of years is one of the words.
        let time = own.unit.filter(|unit| unit.quantity == Quantity::Time).map_or("", |unit| unit.name);
        let mut rest = words(&format!("{} {time} {last}", own.bare));
        let is_p = |pair: &[String]| pair[0] == "p" && is_number(&pair[1]);
        let is_ranked = rest.iter().any(|word| is_one_of(word, "of-fractiles")) || rest.windows(2).any(is_p);
        let measures = std::iter::from_fn(|| take_measure(&mut rest)).collect();
        let (statistic, unit) = (take_statistic(&mut rest), own.unit.filter(|_| time.is_empty()));
        let mut phrase =
            Phrase { measures, statistic, is_ranked, unit, of_values: None, frequency: None, rest };
        let unit = unit.or_else(|| told.unit(|unit| phrase.are_values(unit)));
        let unit = unit.filter(|unit| !heading.is_scaled && phrase.are_values(*unit));
        let is_frequency = unit.is_none() && !heading.is_scaled;
        phrase.of_values = unit.map(|unit| unit.si);
        phrase.frequency = phrase.frequency(told.years).filter(|_| is_frequency);
        if unit.is_some_and(|unit| unit.quantity == Quantity::Velocity) {
            phrase.measures = vec![Imt::Pgv];
        }
        phrase
    }

    pub fn measure(&self) -> Option<Imt> {
        self.measures.first().copied()
    }

    pub fn is_of_curve(&self) -> bool {
        self.of_values.is_some() || self.frequency.is_some()
    }

    /// Whether both say something of the measure, the fractile, the frequency or the years, and not the same.
    pub fn contradicts(&self, other: &Phrase) -> bool {
        fn differ<T: PartialEq>(one: Option<T>, other: Option<T>) -> bool {
            one.zip(other).is_some_and(|(one, other)| one != other)
        }
        self.measure().zip(other.measure()).is_some_and(|(one, other)| !one.may_be(other))
            || differ(self.statistic, other.statistic)
            || differ(self.frequency, other.frequency)
            || differ(self.years(), other.years())
    }

    pub fn meaning(&self) -> String {
        let frequency = self.frequency.map(|frequency| frequency.to_string());
        let measure = self.measure().map(|measure| measure.to_string());
        let statistic = self.statistic.map(|statistic| statistic.to_string());
        Vec::from_iter([frequency, measure, statistic].into_iter().flatten()).join(", ")
    }

    fn has(&self, meaning: &str) -> bool {
        self.rest.iter().any(|word| is_one_of(word, meaning))
    }

    /// Whether all other words have one of these meanings.
    pub fn says_only(&self, meanings: &[&str]) -> bool {
        self.rest.iter().all(|word| meanings.iter().any(|meaning| is_one_of(word, meaning)))
    }

    fn are_values(&self, unit: Unit) -> bool {
        let name = match (unit.quantity, &self.measures[..]) {
            (Quantity::Acceleration, [] | [Imt::Pga | Imt::Sa | Imt::SaAt(_)]) => "acceleration",
            (Quantity::Velocity, [] | [Imt::Pgv]) => "velocity",
            _ => return false,
        };
        (self.has(name) || !self.measures.is_empty()) && self.says_only(&[name, "of-values"])
    }

    /// A number before a word for years.
    fn years(&self) -> Option<f64> {
        let mut pairs = self.rest.windows(2).filter(|pair| is_one_of(&pair[1], "years"));
        pairs.find_map(|pair| pair[0].parse().ok())
    }

    /// None where a word or number stands beside that may change the meaning: `monthly rate`, `1/475 years`.
    fn frequency(&self, years_of_file: Option<f64>) -> Option<Frequency> {
        let mut words = self.clone();
        let numbers: Vec<String> = words.rest.extract_if(.., |word| is_number(word)).collect();
        let numbers: Vec<f64> = numbers.iter().filter_map(|number| number.parse().ok()).collect();
        let is = |name: &str| words.rest.iter().any(|word| word == name);
        let is_annual = is("annual") || is("aep") || is("ape");
        let meanings = ["rate", "return-period", "probability", "years", "of-rates"];
        match numbers[..] {
            _ if self.unit.is_some() || self.measures.len() > 1 || !words.says_only(&meanings) => None,
            [] if self.has("probability") => {
                is_annual.then_some(1.0).or(years_of_file).map(Frequency::ProbabilityIn)
            }
            [years] if self.has("probability") => Some(Frequency::ProbabilityIn(years)),
            [] | [1.0] if is("occurrence") => Some(Frequency::Occurrence),
            [] | [1.0] if self.has("return-period") || self.rest.join(" ").starts_with("t r") => {
                Some(Frequency::ReturnPeriod)
            }
            [] | [1.0] if self.has("rate") => Some(Frequency::Rate),
            _ => None,
        }
    }
}

/// Words and numbers of a text in lower case, `pe50` as `pe` and `50`, and percent signs behind numbers.
fn words(text: &str) -> Vec<String> {
    let (mut parted, mut before) = (String::new(), ' ');
    for sign in text.to_lowercase().replace(" %", "%").chars() {
        let kind = match sign {
            '.' | '0'..='9' => '0',
            '%' if before == '0' => '%',
            _ if sign.is_alphanumeric() => 'a',
            _ => ' ',
        };
        parted.push_str(if kind == before { "" } else { " " });
        parted.extend((kind != ' ').then_some(sign));
        before = kind;
    }
    let words = parted.split(' ').map(|word| word.trim_matches('.'));
    words.filter(|word| !word.is_empty()).map(str::to_string).collect()
}

fn is_number(word: &str) -> bool {
    word.starts_with(|sign: char| sign.is_ascii_digit())
}

/// Takes the first measure out of words, with its period behind or before: `Sa(T=1.0 s)`, `1.0 s SA`.
fn take_measure(words: &mut Vec<String>) -> Option<Imt> {
    let ranges = (0..words.len()).flat_map(|at| [3, 2, 1].map(|count| at..at + count));
    let (meaning, range) = ranges.into_iter().find_map(|range| {
        let name = words.get(range.clone())?.join("-");
        let meaning = ["pga", "pgv", "spectral"].into_iter().find(|meaning| is_one_of(&name, meaning));
        Some((meaning?, range))
    })?;
    let at = range.start;
    words.drain(range);
    if meaning != "spectral" {
        return Some(if meaning == "pga" { Imt::Pga } else { Imt::Pgv });
    }
    let number = |at: usize| words.get(at).and_then(|word| word.parse().ok());
    let unit = |at: usize| words.get(at).and_then(|word| Unit::parse(word));
    let is_second = |at: usize| unit(at).is_some_and(|unit| unit.name == "s");
    let is_period = |word: &&String| *word == "at" || is_one_of(word, "spectral-period");
    let behind = at + words[at..].iter().take_while(is_period).count();
    let before = at.checked_sub(2).filter(|_| is_second(at - 1));
    let (period_s, said) = match (number(behind), before.and_then(number)) {
        (Some(period_s), _) => (period_s, at..behind + 1 + usize::from(is_second(behind + 1))),
        (None, Some(period_s)) => (period_s, at - 2..at),
        (None, None) => return Some(Imt::Sa),
    };
    words.drain(said);
    Some(Imt::SaAt(period_s))
}

/// Takes the words that name a fractile out of others. A number of years is none.
fn take_statistic(words: &mut Vec<String>) -> Option<Statistic> {
    let is = |at: usize, meaning: &str| words.get(at).is_some_and(|word| is_one_of(word, meaning));
    let (at, statistic) = (0..words.len()).find_map(|at| {
        let are_years = is(at + 1, "years") || at > 0 && is(at - 1, "probability");
        let is_ranked = (at.saturating_sub(1)..at + 3).any(|beside| is(beside, "fractile"));
        let statistic = match words[at].as_str() {
            "median" | "mediana" | "médiane" => Statistic::Median,
            "50" | "0.5" | "0.50" if is_ranked && !are_years => Statistic::Median,
            "16" | "0.16" if !are_years => Statistic::Low,
            "84" | "0.84" if !are_years => Statistic::High,
            _ => return None,
        };
        Some((at, statistic))
    })?;
    words.remove(at);
    words.retain(|word| !is_one_of(word, "fractile"));
    Some(statistic)
}

/// Whether a heading says another measure, frequency or fractile than the name that a user gives its column.
pub fn contradict(heading: &Heading, name: &Heading) -> bool {
    let [own, given] = [heading, name].map(|heading| Phrase::of(heading, &Told::default()));
    given.is_of_curve() && own.statistic.is_some() && given.statistic.is_none() || own.contradicts(&given)
}

/// The peak that a heading names, and its unit in m/s2 or m/s; none where it names none, or no unit, or has a
/// word more, which may change the meaning: `vertical PGA`. An acceleration without a name is PGA.
pub fn peak(heading: &Heading) -> Option<(Peak, f64)> {
    let phrase = Phrase::of(heading, &Told::default());
    match phrase.measure() {
        None | Some(Imt::Pga) => Some((Peak::Pga, phrase.of_values?)),
        Some(Imt::Pgv) => Some((Peak::Pgv, phrase.of_values?)),
        Some(Imt::Sa | Imt::SaAt(_)) => None,
    }
}

impl Frequency {
    /// Reads the annual rate in a cell, infinite if the motion is certain.
    pub fn annual_rate(self, grid: &Grid, row: usize, column: usize) -> Result<f64> {
        let number = grid.number(row, column)?;
        let (is_possible, rate, expected) = match self {
            Frequency::ProbabilityIn(years) => {
                let expected = "a probability from 0 to 1, or with a percent sign";
                ((0.0..=1.0).contains(&number), -(-number).ln_1p() / years, expected)
            }
            Frequency::ReturnPeriod => (number > 0.0, 1.0 / number, "years above 0"),
            Frequency::Rate | Frequency::Occurrence => {
                let expected = "a rate a year from 0 to 1000; percent are probabilities";
                ((0.0..=1000.0).contains(&number) && !grid.is_percent(row, column), number, expected)
            }
        };
        if is_possible { Ok(rate) } else { Err(grid.refusal(row, column, expected)) }
    }
}
