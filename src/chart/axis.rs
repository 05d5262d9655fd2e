//! Axes: from values to places in a picture, and the ticks.

use std::ops::RangeInclusive;

use rockfrag_core::statistics::Range;

use super::figure::{Axis, Panel, Scale};
use super::text::minus;
use crate::number;

/// An axis with its range, and where in the picture the range begins and ends.
#[derive(Debug, Clone, Copy)]
pub struct Ruler<'a> {
    pub scale: &'a Scale,
    /// The ends of the range as [`Scale::of`] them.
    low: f64,
    high: f64,
    pub from: f64,
    pub to: f64,
}

/// A value on an axis and its label; a minor one has none.
pub type Tick = (f64, String);

/// Margin beyond the data on either side, of the range.
const MARGIN: f64 = 0.04;
/// The least and the largest number that an axis reaches to, but for 0; and the least width of a range beside
/// its ends, which is no accident of rounding.
const SHOWN: RangeInclusive<f64> = 1e-30..=1e30;
const NARROWEST: f64 = 1e-9;
/// Multiples of a power of ten that have labels, the densest first.
const DENSE: [&[f64]; 4] =
    [&[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0], &[1.0, 2.0, 3.0, 5.0], &[1.0, 2.0, 5.0], &[1.0, 3.0]];

impl Panel {
    /// The axes, each from one place to another.
    pub fn rulers(&self, across: [f64; 2], upwards: [f64; 2]) -> [Ruler<'_>; 2] {
        let (mut x, mut y) = (Vec::new(), Vec::new());
        for mark in self.layers.iter().flat_map(|layer| &layer.marks) {
            x.push(mark.x);
            y.push(mark.y);
            if self.names().is_empty() { &mut y } else { &mut x }.extend([mark.low, mark.high]);
        }
        let rulers = [Ruler::new(&self.x, x, across), Ruler::new(&self.y, y, upwards)];
        if !self.is_to_scale {
            return rulers;
        }
        let per_point = rulers.map(|ruler| (ruler.high - ruler.low) / (ruler.to - ruler.from).abs());
        // The ranges are stretched about their middles.
        rulers.map(|ruler| {
            let half = 0.5 * per_point[0].max(per_point[1]) * (ruler.to - ruler.from).abs();
            let middle = 0.5 * (ruler.low + ruler.high);
            Ruler { low: middle - half, high: middle + half, ..ruler }
        })
    }
}

impl<'a> Ruler<'a> {
    fn new(axis: &'a Axis, mut values: Vec<f64>, [from, to]: [f64; 2]) -> Ruler<'a> {
        let scale = &axis.scale;
        let (least, most) = SHOWN.into_inner();
        values.retain(|value| value.abs() <= most && (*scale != Scale::Log || *value >= least));
        let Range { low, high } = Range::over(values.into_iter().map(|value| scale.of(value)));
        let [low, high] = match (axis.range, scale) {
            (Some([low, high]), _) if low < high && high <= most => [low, high].map(|end| scale.of(end)),
            (_, Scale::Names(names)) => [names.len() as f64 - 0.5, -0.5],
            _ if low > high => [1.0, 10.0].map(|end| scale.of(end)),
            _ => {
                let is_wide = high - low > (NARROWEST * low.abs().max(high.abs())).max(least);
                let margin = if is_wide { MARGIN * (high - low) } else { 0.3 + 0.1 * low.abs() };
                [low - margin, high + margin]
            }
        };
        Ruler { scale, low, high, from, to }
    }

    pub fn at(&self, value: f64) -> f64 {
        let fraction = (self.scale.of(value) - self.low) / (self.high - self.low);
        self.from + (self.to - self.from) * fraction
    }

    /// Places the ticks, of which `most` or fewer have labels.
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        match self.scale {
            Scale::Names(names) => {
                names.iter().enumerate().map(|(row, name)| (row as f64, name.clone())).collect()
            }
            Scale::Linear => self.linear_ticks(most),
            Scale::Log => self.log_ticks(most),
        }
    }

    fn linear_ticks(&self, most: usize) -> Vec<Tick> {
        let least = (self.high - self.low) / most.max(2) as f64;
        let power = 10_f64.powf(least.log10().floor());
        let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| factor * power >= least * (1.0 - 1e-9));
        let step = factor.unwrap_or(10.0) * power;
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        let all = (self.low / step - 1e-9).ceil() as i64..=(self.high / step + 1e-9).floor() as i64;
        let values = all.map(|k| k as f64 * step);
        values.map(|value| (value, minus(number::fixed(value, decimals)))).collect()
    }

    /// Labels as many ticks as fit: several in each decade, one, or one in so many decades.
    fn log_ticks(&self, most: usize) -> Vec<Tick> {
        // Powers of ten where plain numbers would be long.
        let as_powers = self.low < -3.004 || self.high > 5.0004;
        let label = if as_powers { power_of_ten } else { number::plain };
        let mut dense = DENSE.into_iter().skip(if as_powers { 2 } else { 0 });
        let dense = dense.find_map(|factors| self.in_decades(factors, 1, most));
        // Whole decades have short labels, as wide apart as they can be.
        let whole = || (1..).find_map(|every| self.in_decades(&[1.0], every, most + 1));
        let labelled = dense.or_else(whole).unwrap_or_default();
        let factors = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        let factors = if self.high - self.low < 6.0 { &factors[..] } else { &factors[..1] };
        let minor = self.in_decades(factors, 1, usize::MAX).unwrap_or_default();
        let minor = minor.into_iter().filter(|value| !labelled.contains(value));
        let minor = minor.map(|value| (value, String::new()));
        labelled.iter().map(|&value| (value, label(value))).chain(minor).collect()
    }

    /// These multiples of each power of ten, or of one in so many; if they are not too many.
    fn in_decades(&self, factors: &[f64], every: i32, most: usize) -> Option<Vec<f64>> {
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        let inside = self.low - 1e-9..=self.high + 1e-9;
        let powers = decades.filter(|decade| decade.rem_euclid(every) == 0).map(|decade| 10_f64.powi(decade));
        let values = powers.flat_map(|power| factors.iter().map(move |factor| factor * power));
        let values: Vec<f64> = values.filter(|value| inside.contains(&value.log10())).collect();
        (values.len() <= most).then_some(values)
    }
}

impl Scale {
    /// Where a value lies on an even scale: its decimal logarithm if that is what counts.
    fn of(&self, value: f64) -> f64 {
        if *self == Scale::Log { value.log10() } else { value }
    }
}

fn power_of_ten(value: f64) -> String {
    let power = minus(format!("{value:.0e}}}")).replace('e', "\u{b7}10^{");
    power.strip_prefix("1\u{b7}").map_or(power.clone(), str::to_string)
}
