//! Axes: from values to fractions of a length, and the places of ticks.

use super::text::{Label, number};

/// An axis of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    scale: Scale,
    /// Value at its beginning.
    pub low: f64,
    /// Value at its end.
    pub high: f64,
    /// Name and unit of what it measures.
    pub label: Label,
    /// What stands at 0, 1 and so on, from the far end on; none on an axis of numbers.
    pub names: Vec<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scale {
    Linear,
    Log,
}

/// A mark on an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    pub value: f64,
    /// Text; none at a minor tick.
    pub label: Option<Label>,
}

impl Axis {
    /// Makes an axis in equal steps.
    pub fn linear([low, high]: [f64; 2], label: Label) -> Axis {
        let high = if high > low { high } else { low + 1.0 };
        Axis { scale: Scale::Linear, low, high, label, names: Vec::new() }
    }

    /// Makes an axis in equal ratios.
    pub fn log([low, high]: [f64; 2], label: Label) -> Axis {
        let low = if low > 0.0 && low.is_finite() { low } else { 0.1 };
        let high = if high > low && high.is_finite() { high } else { 10.0 * low };
        Axis { scale: Scale::Log, low, high, label, names: Vec::new() }
    }

    /// Makes an axis of names, one below the other.
    pub fn names(names: Vec<String>) -> Axis {
        let low = names.len() as f64 - 0.5;
        Axis { scale: Scale::Linear, low, high: -0.5, label: Label::default(), names }
    }

    /// Makes an axis in equal ratios over all values that have a logarithm, with a margin.
    pub fn log_over(values: impl Iterator<Item = f64>, label: Label) -> Axis {
        let [low, high] = range(values.filter(|value| *value > 0.0));
        Axis::log([low / LOG_MARGIN, high * LOG_MARGIN], label)
    }

    /// Returns the fraction of the axis at a value; not finite where there is none.
    pub fn fraction(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Log => libm::log(value / self.low) / libm::log(self.high / self.low),
        }
    }

    /// Returns the value at a fraction of the axis.
    pub fn value(&self, fraction: f64) -> f64 {
        match self.scale {
            Scale::Linear => self.low + fraction * (self.high - self.low),
            Scale::Log => self.low * libm::pow(self.high / self.low, fraction),
        }
    }

    /// Iterates over `count` values from end to end.
    pub fn steps(&self, count: usize) -> impl Iterator<Item = f64> {
        (0..count).map(move |step| self.value(step as f64 / (count - 1) as f64))
    }

    pub fn holds(&self, value: f64) -> bool {
        (self.low.min(self.high)..=self.low.max(self.high)).contains(&value)
    }

    pub fn is_log(&self) -> bool {
        self.scale == Scale::Log
    }

    /// Places the ticks, of which `most` or fewer have labels.
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        if !self.names.is_empty() {
            let tick = |(k, name): (usize, &String)| Tick {
                value: k as f64,
                label: Some(Label::plain(name.as_str())),
            };
            return self.names.iter().enumerate().map(tick).collect();
        }
        match self.scale {
            Scale::Linear => linear_ticks(self.low, self.high, most),
            Scale::Log => log_ticks(self.low, self.high, most),
        }
    }
}

/// Margin beyond the data on either side, as a ratio.
const LOG_MARGIN: f64 = 1.08;

/// Finds the least and the largest finite value.
pub fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let finite = values.filter(|value| value.is_finite());
    finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

fn linear_ticks(low: f64, high: f64, most: usize) -> Vec<Tick> {
    let step = nice_step((high - low) / most.max(2) as f64);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    let decimals = (-libm::log10(step).floor()).max(0.0) as usize;
    let tick = |k: i64| {
        let value = k as f64 * step;
        Tick { value, label: Some(Label::plain(number::fixed(value, decimals))) }
    };
    (first..=last).map(tick).collect()
}

/// Rounds up to 1, 2 or 5 times a power of ten.
fn nice_step(least: f64) -> f64 {
    let power = libm::pow(10.0, libm::log10(least).floor());
    let step = [1.0, 2.0, 5.0].into_iter().find(|factor| factor * power >= least * (1.0 - 1e-9));
    step.unwrap_or(10.0) * power
}

/// Labels as many ticks as fit: several in each decade, one, or one in so many decades.
fn log_ticks(low: f64, high: f64, most: usize) -> Vec<Tick> {
    let decades = libm::log10(low).floor() as i32..=libm::log10(high).ceil() as i32;
    let inside = |value: &f64| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(value);
    let at = |factors: &'static [f64], every: i32| {
        let decades = decades.clone().filter(move |decade| decade.rem_euclid(every) == 0);
        let values =
            decades.flat_map(move |decade| factors.iter().map(move |factor| factor * 10_f64.powi(decade)));
        values.filter(inside).collect::<Vec<f64>>()
    };
    let choices = [
        at(&[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0], 1),
        at(&[1.0, 2.0, 3.0, 5.0], 1),
        at(&[1.0, 2.0, 5.0], 1),
        at(&[1.0, 3.0], 1),
        at(&[1.0], 1),
        at(&[1.0], 2),
        at(&[1.0], 3),
        at(&[1.0], 5),
    ];
    // Written as powers of ten, where numbers would be long.
    let as_powers = low < 0.0099 || high > 10_010.0;
    let choices = &choices[if as_powers { 4 } else { 0 }..];
    let labelled = choices.iter().find(|values| values.len() <= most).cloned().unwrap_or_default();
    let label = |value: f64| match as_powers {
        true => Label::marked(&number::power(value)),
        false => Label::plain(number::plain(value)),
    };
    let minor =
        if high / low < 1e6 { at(&[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0], 1) } else { at(&[1.0], 1) };
    let minor = minor.into_iter().filter(|value| !labelled.contains(value));
    let minor: Vec<Tick> = minor.map(|value| Tick { value, label: None }).collect();
    labelled.iter().map(|&value| Tick { value, label: Some(label(value)) }).chain(minor).collect()
}
