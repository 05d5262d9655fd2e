//! Floors as people write them, as the level and the first period of a building.

use super::words::{joined, means, words};
use crate::object::Place;

/// Height of a storey, m.
const STOREY_M: f64 = 3.5;

/// Standard deviation of ln(period) of a building of a known type.
const SD_OF_TYPE: f64 = 0.25;

/// A floor of a building.
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
    /// Reads a floor as `3`, `3rd floor`, `G`, `EG`, `2. OG`, `B1`, `-1`, `roof`.
    pub fn parse(cell: &str) -> Option<Storey> {
        const BESIDE: [&str; 23] = [
            "st",
            "nd",
            "rd",
            "th",
            "f",
            "fl",
            "floor",
            "storey",
            "story",
            "level",
            "l",
            "stock",
            "stockwerk",
            "geschoss",
            "etage",
            "étage",
            "e",
            "er",
            "ème",
            "piano",
            "planta",
            "piso",
            "階",
        ];
        const ABOVE: [&str; 2] = ["og", "obergeschoss"];
        let text = joined(cell);
        let digits: String = text.chars().filter(char::is_ascii_digit).collect();
        let letters = text.replace(|sign: char| sign.is_ascii_digit(), "-");
        let letters: Vec<&str> = letters.split('-').filter(|word| !word.is_empty()).collect();
        let is_all = |list: &[&str]| letters.iter().all(|word| list.contains(word));
        if means(cell, "ground") {
            return Some(Storey::Ground);
        }
        if means(cell, "roof") {
            return Some(Storey::Roof);
        }
        if letters.iter().any(|word| words("basement").any(|known| known == *word)) {
            return Some(Storey::Basement);
        }
        let number = cell.trim().parse().ok().filter(|number: &f64| number.fract() == 0.0);
        let number = number.or_else(|| digits.parse().ok().filter(|_| !cell.contains([',', '/', '+'])))?;
        match number {
            ..0.0 => Some(Storey::Basement),
            0.0 => Some(Storey::Ground),
            200.0.. => None,
            _ if !letters.is_empty() && is_all(&ABOVE) => Some(Storey::Above(number as u32)),
            _ if is_all(&BESIDE) => Some(Storey::Number(number as u32)),
            _ => None,
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

/// The number of the ground floor by floors of a list: 0 where one is called so; none where nothing tells,
/// with the lowest number.
pub fn ground_floor(storeys: &[Storey]) -> Result<u32, u32> {
    let says_ground = |storey: &Storey| matches!(storey, Storey::Ground | Storey::Above(_));
    let number = |storey: &Storey| if let Storey::Number(number) = storey { Some(*number) } else { None };
    match storeys.iter().filter_map(number).min() {
        Some(lowest) if !storeys.iter().any(says_ground) => Err(lowest),
        _ => Ok(0),
    }
}

/// How a building resists earthquakes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Building {
    Walls,
    ConcreteFrame,
    SteelFrame,
}

impl Building {
    const ALL: [Building; 3] = [Building::Walls, Building::ConcreteFrame, Building::SteelFrame];

    pub fn parse(cell: &str) -> Option<Building> {
        let known = [("walls", Building::Walls), ("concrete", Building::ConcreteFrame)];
        let known = known.into_iter().chain([("steel", Building::SteelFrame)]);
        known.into_iter().find(|(meaning, _)| means(cell, meaning)).map(|(_, building)| building)
    }

    /// The first period, s, of a building of this height, by ASCE 7.
    fn period_s(self, height_m: f64) -> f64 {
        match self {
            Building::Walls => 0.0488 * height_m.powf(0.75),
            Building::ConcreteFrame => 0.0466 * height_m.powf(0.9),
            Building::SteelFrame => 0.0724 * height_m.powf(0.8),
        }
    }
}

/// The place on a floor that has so many storeys below it; what is known of the period already stays. A
/// building of unknown type has the period of a concrete frame, with the scatter between the types beside
/// that of one.
pub fn place(above: u32, storeys: u32, building: Option<Building>, known: Place) -> Place {
    let height_m = STOREY_M * f64::from(storeys);
    let period_s = |building: Building| building.period_s(height_m);
    let middle = period_s(building.unwrap_or(Building::ConcreteFrame));
    let of_types = Building::ALL.iter().map(|building| (period_s(*building) / middle).ln().powi(2));
    let between = if building.is_none() { of_types.sum::<f64>() / Building::ALL.len() as f64 } else { 0.0 };
    let sd = (SD_OF_TYPE.powi(2) + between).sqrt();
    let period_sd = known.period_sd.or(building.is_none().then_some(sd).filter(|_| known.period.is_none()));
    Place {
        level: known.level.or(Some(f64::from(above) / f64::from(storeys))),
        period: known.period.or(Some(middle)),
        period_sd,
        ..known
    }
}
