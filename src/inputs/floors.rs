//! Floors as people write them, as the level and the first period of a building.

use rockfrag_core::object::Place;

use super::words::{is_one_of, joined, means, normal, synonyms};

const STOREY_M: f64 = 3.5;
/// Standard deviation of ln(period) of a building of a known type.
const SD_OF_TYPE: f64 = 0.25;

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Storey {
    /// The ground floor by its name, or a basement, which moves with the ground.
    Ground,
    Basement,
    /// A number; which one the ground floor has depends on the country.
    Number(u32),
    /// So many storeys above the ground: 2. OG.
    Above(u32),
    Roof,
}

impl Storey {
    /// Reads a floor as `3`, `3rd floor`, `third floor`, `G`, `EG`, `2. OG`, `B1`, `-1`, `roof`; none where anything else
    /// stands beside: `2-3`, `1.5`.
    pub fn parse(cell: &str) -> Option<Storey> {
        const BESIDE: &str = " .-_#():";
        // Signs of ordinals: 1° piano.
        let cell = cell.replace(['\u{b0}', '\u{ba}', '\u{aa}'], ".");
        let cell = &*normal(&cell);
        let names = [("ground", Storey::Ground), ("roof", Storey::Roof), ("basement", Storey::Basement)];
        if let Some((_, storey)) = names.into_iter().find(|(meaning, _)| means(cell, meaning)) {
            return Some(storey);
        }
        if let Ok(number) = cell.trim().parse::<f64>() {
            return Some(number).filter(|number| number.fract() == 0.0).and_then(Storey::of_number);
        }
        let text = joined(&cell.replace(|sign: char| sign.is_ascii_digit(), "-"));
        let digits = cell.split(|sign: char| !sign.is_ascii_digit()).filter_map(|digits| digits.parse().ok());
        let (ordinals, words): (Vec<&str>, Vec<&str>) =
            text.split_terminator('-').partition(|word| ordinal(word).is_some());
        let numbers: Vec<f64> = digits.chain(ordinals.into_iter().filter_map(ordinal)).collect();
        let are_all = |meanings: &[&str]| {
            words.iter().all(|word| meanings.iter().any(|meaning| is_one_of(word, meaning)))
        };
        if numbers.len() > 1 || !cell.chars().all(|sign| sign.is_alphanumeric() || BESIDE.contains(sign)) {
            return None;
        }
        if are_all(&["basement", "of-floors"]) && words.iter().any(|word| is_one_of(word, "basement")) {
            return Some(Storey::Basement);
        }
        // L-3 may be below the ground.
        let is_below = cell.split(|sign: char| sign.is_ascii_digit()).next()?.trim_end().ends_with('-');
        match Storey::of_number(*numbers.first().filter(|_| !is_below)?)? {
            Storey::Number(number) if !words.is_empty() && are_all(&["above"]) => Some(Storey::Above(number)),
            storey => Some(storey).filter(|_| are_all(&["of-floors"])),
        }
    }

    fn of_number(number: f64) -> Option<Storey> {
        match number {
            ..0.0 => Some(Storey::Basement),
            0.0 => Some(Storey::Ground),
            200.0.. => None,
            _ => Some(Storey::Number(number as u32)),
        }
    }

    /// The number of storeys below it, above the ground; none of a roof.
    pub fn above(self, ground_floor: u32) -> Option<u32> {
        match self {
            Storey::Ground | Storey::Basement => Some(0),
            Storey::Number(number) => Some(number.saturating_sub(ground_floor)),
            Storey::Above(number) => Some(number),
            Storey::Roof => None,
        }
    }
}

/// The number of an ordinal, by the beginning of its word: third, terzo, dritter.
pub fn ordinal(word: &str) -> Option<f64> {
    let of_number = |words: &str| words.split('|').any(|start| word.starts_with(start));
    synonyms("ordinal").position(of_number).map(|at| (at + 1) as f64)
}

/// The number of the ground floor by floors of a list: 0 where one is called so; none where nothing tells,
/// with the lowest number.
pub fn ground_floor(storeys: &[Storey]) -> Result<u32, u32> {
    let numbers = storeys.iter().filter_map(|storey| match storey {
        Storey::Number(number) => Some(*number),
        _ => None,
    });
    let is_told = storeys.iter().any(|storey| matches!(storey, Storey::Ground | Storey::Above(_)));
    numbers.min().filter(|_| !is_told).map_or(Ok(0), Err)
}

/// How a building resists earthquakes, and its first period by ASCE 7: factor x (height in m)^exponent, s.
#[derive(Debug, PartialEq)]
pub struct Building {
    /// A meaning of data/headings.csv.
    meaning: &'static str,
    factor: f64,
    exponent: f64,
}

static BUILDINGS: [Building; 3] = [
    Building { meaning: "concrete", factor: 0.0466, exponent: 0.9 },
    Building { meaning: "walls", factor: 0.0488, exponent: 0.75 },
    Building { meaning: "steel", factor: 0.0724, exponent: 0.8 },
];

impl Building {
    pub fn parse(cell: &str) -> Option<&'static Building> {
        BUILDINGS.iter().find(|building| means(cell, building.meaning))
    }

    fn period_s(&self, storeys: u32) -> f64 {
        self.factor * (STOREY_M * f64::from(storeys)).powf(self.exponent)
    }
}

/// The place on a floor that has so many storeys below it; what is known of the period already stays. A
/// building of unknown type has the period of a concrete frame, with the scatter between the types beside
/// that of one.
pub fn place(above: u32, storeys: u32, building: Option<&Building>, known: Place) -> Place {
    let period_s = building.unwrap_or(&BUILDINGS[0]).period_s(storeys);
    let squares = BUILDINGS.iter().map(|other| (other.period_s(storeys) / period_s).ln().powi(2));
    let between = squares.sum::<f64>() / BUILDINGS.len() as f64;
    let is_guessed = building.is_none() && known.period.is_none();
    let period_sd = is_guessed.then_some((SD_OF_TYPE.powi(2) + between).sqrt());
    Place {
        level: known.level.or(Some(f64::from(above) / f64::from(storeys))),
        period: known.period.or(Some(period_s)),
        period_sd: known.period_sd.or(period_sd),
        ..known
    }
}
