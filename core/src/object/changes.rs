use super::given::{Object, Place, Restitution};
use super::rocking::{LowHigh, UncertaintySource};
use crate::number;
use crate::statistics::normal::Z_95;

#[derive(Debug, Clone, PartialEq)]
pub struct Changed {
    pub words: String,
    pub object: Object,
}

/// How much both sides of a base are widened.
const WIDER: [f64; 2] = [0.2, 0.5];
const LOWER: f64 = 0.25;

impl Object {
    /// Changes one at a time: a base wider on all sides, a lower centre of mass, from a floor to the ground, a
    /// measured coefficient of restitution at its 16 and 84 % quantiles.
    pub fn changes(&self) -> Vec<Changed> {
        let mut all = Vec::new();
        if let (Some(width), Some(height), None) =
            (self.shape.width, self.shape.height, self.shape.beam_mass_ratio)
        {
            all.extend(WIDER.map(|part| self.widened(width, part)));
            let mut object = self.clone();
            let centre_height = self.shape.centre_height.unwrap_or(0.5 * height);
            object.shape.centre_height = Some((1.0 - LOWER) * centre_height);
            let words = format!("centre of mass {} % lower", number::fixed(100.0 * LOWER, 0));
            all.push(Changed { words, object });
        }
        if matches!(self.place.floor(), Ok(Some(_))) {
            let place = Place { period: None, level: None, period_sd: None, ..self.place };
            let object = Object { place, floor: None, ..self.clone() };
            all.push(Changed { words: "on the ground floor".to_string(), object });
        }
        all.extend(self.measured());
        all
    }

    fn widened(&self, width: f64, part: f64) -> Changed {
        let wider = |side: f64| (1.0 + part) * side;
        let object = self.resized(wider(width), self.shape.depth.map(wider));
        Changed { words: format!("base {} % wider", number::fixed(100.0 * part, 0)), object }
    }

    /// With eta known: one standard deviation below and above its median.
    fn measured(&self) -> Vec<Changed> {
        let Ok(sides) = self.sides() else { return Vec::new() };
        let Some(LowHigh { low, high, .. }) =
            sides[0].at_quantiles.iter().find(|structure| structure.source == UncertaintySource::Eta)
        else {
            return Vec::new();
        };
        let median = sides[0].structure.eta;
        let etas = [low.eta, high.eta].map(|end| match (self.place.eta_sd, self.place.base) {
            (Some(_), _) | (_, Some(_)) => median + (end - median) / Z_95,
            (None, None) => 1.0 - ((1.0 - median).ln() + ((1.0 - end) / (1.0 - median)).ln() / Z_95).exp(),
        });
        let changes = etas.map(|eta| {
            let mut object = self.clone();
            object.shape.eta = Some(Restitution::Number(eta));
            object.place.eta_sd = None;
            Changed { words: format!("restitution {}", number::fixed(eta, 2)), object }
        });
        changes.into()
    }
}
