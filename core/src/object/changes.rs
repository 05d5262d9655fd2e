use super::given::{Object, Place, Restitution};
use super::rocking::{LowHigh, UncertaintySource};
use crate::motion::Floor;
use crate::number;
use crate::statistics::normal::Z_95;

#[derive(Debug, Clone, PartialEq)]
pub struct Changed {
    pub words: String,
    pub object: Object,
}

/// How much a base is widened on each side, of its width.
const WIDER: [f64; 2] = [0.1, 0.25];
const LOWER: f64 = 0.25;
/// The third of five storeys, with a tenth of a second for each.
const EXAMPLE_UPPER_FLOOR: Floor = Floor { period_s: 0.5, level: 0.6 };

impl Object {
    /// Changes one at a time: a base wider on all sides, a lower centre of mass, the ground floor or another
    /// one, a measured coefficient of restitution at its 16 and 84 % quantiles.
    pub fn changes(&self) -> Vec<Changed> {
        let mut all = Vec::new();
        if let (Some(width), Some(height), None) =
            (self.shape.width, self.shape.height, self.shape.beam_mass_ratio)
        {
            all.extend(WIDER.map(|part| self.widened(width, 2.0 * part * width)));
            let centre_height = (1.0 - LOWER) * self.shape.centre_height.unwrap_or(0.5 * height);
            let mut object = self.clone();
            object.shape.centre_height = Some(centre_height);
            all.push(Changed {
                words: format!("centre of mass at {} m", number::length(centre_height)),
                object,
            });
        }
        all.push(self.moved());
        all.extend(self.measured());
        all
    }

    fn widened(&self, width: f64, added: f64) -> Changed {
        let wide = self.resized(width + added, self.shape.depth.map(|depth| depth + added));
        let depth = wide.shape.depth.map_or(String::new(), |depth| format!(" × {}", number::length(depth)));
        Changed { words: format!("base of {}{depth} m", number::length(width + added)), object: wide }
    }

    fn moved(&self) -> Changed {
        let mut object = self.clone();
        let words = if matches!(self.place.floor(), Ok(Some(_))) {
            object.place = Place { period: None, level: None, period_sd: None, ..self.place };
            "on the ground floor"
        } else {
            let (period, level) = (Some(EXAMPLE_UPPER_FLOOR.period_s), Some(EXAMPLE_UPPER_FLOOR.level));
            object.place = Place { period, level, ..self.place };
            "on the third of five floors"
        };
        Changed { words: words.to_string(), object }
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
