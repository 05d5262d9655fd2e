//! Pairs of horizontal components, their rotation, and their peaks over all directions.

use std::collections::HashMap;
use std::str::FromStr;

use super::{Origin, RecordedMotion};
use crate::motion::measures::{peak, velocity};

/// Directions of RotD: each degree of a half turn.
const DIRECTIONS: usize = 180;

/// Pairs each component, given its origin and time step (s), with the first unpaired one before it of the
/// same earthquake, station and time step at right angles. Returns the indices, in the order of the first
/// component of a pair. Components that are vertical, of unknown origin or without a partner are in no pair.
pub fn pairs(components: &[(&Origin, f64)]) -> Vec<[usize; 2]> {
    let mut waiting: HashMap<_, Vec<(usize, f64)>> = HashMap::new();
    let mut found = Vec::new();
    for (place, (Origin { earthquake, station, azimuth_deg, .. }, dt_s)) in components.iter().enumerate() {
        let is_known = earthquake.is_some() || station.is_some();
        let Some(azimuth_deg) = azimuth_deg.filter(|_| is_known) else { continue };
        let others = waiting.entry((earthquake, station, dt_s.to_bits())).or_default();
        match others.iter().position(|(_, other)| is_right_angle(*other, azimuth_deg)) {
            Some(at) => found.push([others.remove(at).0, place]),
            None => others.push((place, azimuth_deg)),
        }
    }
    found.sort_unstable();
    found
}

/// Returns whether two azimuths (degrees) are at right angles to a degree; either may be reversed.
fn is_right_angle(first_deg: f64, second_deg: f64) -> bool {
    ((first_deg - second_deg).rem_euclid(180.0) - 90.0).abs() <= 1.0
}

/// Two horizontal components of one station at right angles, of equal time step and length.
#[derive(Debug, Clone, PartialEq)]
pub struct HorizontalPair {
    pub first: RecordedMotion,
    pub second: RecordedMotion,
}

/// The parts of a direction along the components of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parts {
    pub first: f64,
    pub second: f64,
}

/// Peaks over all directions: RotD50, the median, and RotD100, the largest (Boore 2010).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotD {
    pub pga50_m_s2: f64,
    pub pga100_m_s2: f64,
    pub pgv50_m_s: f64,
    pub pgv100_m_s: f64,
}

impl HorizontalPair {
    /// Makes a pair of components that start together; the longer one is cut.
    pub fn new(mut first: RecordedMotion, mut second: RecordedMotion) -> HorizontalPair {
        let length = first.acceleration_m_s2.len().min(second.acceleration_m_s2.len());
        first.acceleration_m_s2.truncate(length);
        second.acceleration_m_s2.truncate(length);
        HorizontalPair { first, second }
    }

    /// Computes the acceleration in the direction of an azimuth (degrees), m/s2.
    pub fn towards(&self, azimuth_deg: f64) -> Vec<f64> {
        let weight = |component| (azimuth_deg - azimuth_of(component)).to_radians().cos();
        let (first, second) = (weight(&self.first), weight(&self.second));
        let both = self.first.acceleration_m_s2.iter().zip(&self.second.acceleration_m_s2);
        both.map(|(a, b)| first * a + second * b).collect()
    }

    /// Computes the azimuth (degrees, in [0, 360)) of a direction given by its parts.
    pub fn azimuth_of(&self, parts: Parts) -> f64 {
        let (first, second) = (azimuth_of(&self.first).to_radians(), azimuth_of(&self.second).to_radians());
        let north = parts.first * first.cos() + parts.second * second.cos();
        let east = parts.first * first.sin() + parts.second * second.sin();
        east.atan2(north).to_degrees().rem_euclid(360.0)
    }

    pub fn rotd(&self) -> RotD {
        let (first, second) = (&self.first.acceleration_m_s2, &self.second.acceleration_m_s2);
        let dt_s = self.first.dt_s;
        let accelerations = peaks_over_directions(first, second);
        let velocities = peaks_over_directions(&velocity(first, dt_s), &velocity(second, dt_s));
        RotD {
            pga50_m_s2: median(&accelerations),
            pga100_m_s2: peak(&accelerations),
            pgv50_m_s: median(&velocities),
            pgv100_m_s: peak(&velocities),
        }
    }
}

fn azimuth_of(component: &RecordedMotion) -> f64 {
    component.origin.azimuth_deg.unwrap_or_default()
}

/// Computes the peak in each direction, ascending.
fn peaks_over_directions(first: &[f64], second: &[f64]) -> Vec<f64> {
    let in_direction = |degrees: usize| {
        let (sin, cos) = (degrees as f64).to_radians().sin_cos();
        first.iter().zip(second).fold(0.0_f64, |peak, (a, b)| (cos * a + sin * b).abs().max(peak))
    };
    let mut peaks: Vec<f64> = (0..DIRECTIONS).map(in_direction).collect();
    peaks.sort_by(f64::total_cmp);
    peaks
}

fn median(ascending: &[f64]) -> f64 {
    0.5 * (ascending[(DIRECTIONS - 1) / 2] + ascending[DIRECTIONS / 2])
}

#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Orientation {
    /// Azimuth of the strongest wavelet (Shahi & Baker 2014).
    StrongestPulse,
    #[serde(untagged)]
    Azimuth(f64),
}

impl<'de> serde::Deserialize<'de> for Orientation {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Orientation, D::Error> {
        <String as serde::Deserialize>::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

impl FromStr for Orientation {
    type Err = String;

    fn from_str(text: &str) -> Result<Orientation, String> {
        match text.parse() {
            Ok(azimuth) if (0.0..=360.0).contains(&azimuth) => Ok(Orientation::Azimuth(azimuth)),
            Err(_) if text == "strongest-pulse" => Ok(Orientation::StrongestPulse),
            _ => Err(format!("'{text}'; expected an azimuth from 0 to 360 degrees, or strongest-pulse")),
        }
    }
}
