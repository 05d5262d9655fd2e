//! The width of a base that meets a target: all else of the object the same.

use crate::hazard::Site;
use crate::object::{Object, Subject};
use crate::stages::shared::model_args::Models;
use crate::statistics::Limited;
use crate::table::answers::TargetBases;

/// Parses a probability of overturning in the time of exposure, such as 1%.
pub fn parse(text: &str) -> Result<f64, String> {
    match text.strip_suffix('%').map(|percent| percent.trim_end().parse::<f64>()) {
        Some(Ok(percent)) if percent > 0.0 && percent < 100.0 => Ok(0.01 * percent),
        _ => Err("expected a probability in --years with its percent sign, such as 1%".to_string()),
    }
}

/// Slendernesses of the structures that the surface knows, rad: eta of a wider solid block is below 0.7.
const SLENDERNESSES: [f64; 2] = [0.04, 0.46];
/// Relative accuracy of a width.
const ACCURACY: f64 = 2e-5;
/// Steps of ln width after which the next is right to that: by a fall that is assumed, by the line through two
/// widths, by the parabola through three.
const LAST_STEPS: [f64; 3] = [ACCURACY, 1e-3, 3e-3];
const MOST_STEPS: usize = 40;
/// By how much ln rate falls with ln width, about, where a search begins; and the least fall that it trusts.
const USUAL_FALL: f64 = 5.0;
const LEAST_FALL: f64 = 0.2;
/// Halvings of the widths to the end of the hazard.
const HALVINGS: usize = 8;
/// Annual rates count as no less.
const LEAST: f64 = 1e-12;

/// Finds the bases whose annual rate of overturning is the target, at the same height, rule of eta and
/// relative offset; none where none within the domain of the surface meets it. `rate` is that of the object
/// as it is.
pub fn bases(object: &Object, models: &Models, site: &Site, rate: Limited, target: f64) -> TargetBases {
    let both = object.shape.depth.map(|_| true);
    let searches = [false].into_iter().chain(both);
    let mut searches: Vec<Search> =
        searches.filter_map(|both_sides| Search::new(object, models, site, both_sides)).collect();
    let mut first = |sought: Sought| {
        let as_is = sought.in_rates(rate);
        searches.iter_mut().find_map(|search| Some((search.both_sides, search.solve(sought, as_is, target)?)))
    };
    let (by_estimate, by_limit) = (first(Sought::Estimate), first(Sought::UpperLimit));
    TargetBases {
        target_width_m: side(by_estimate, false),
        target_width_m_high: side(by_limit, false),
        target_sides_m: side(by_estimate, true),
        target_sides_m_high: side(by_limit, true),
    }
}

/// The side that a search over the width found, or one over both sides.
fn side(found: Option<(bool, f64)>, both_sides: bool) -> Option<f64> {
    found.filter(|(by_both, _)| *by_both == both_sides).map(|(_, side)| side)
}

/// What is to be the target.
#[derive(Debug, Clone, Copy)]
enum Sought {
    Estimate,
    UpperLimit,
}

impl Sought {
    /// Returns it where the rate is known.
    fn in_rates(self, rate: Limited) -> Option<f64> {
        rate.value.and(match self {
            Sought::Estimate => rate.value,
            Sought::UpperLimit => rate.high,
        })
    }
}

/// A search over the width, or over the smaller side, in its logarithm: ln rate is almost straight in it.
struct Search<'a> {
    object: &'a Object,
    models: &'a Models,
    site: &'a Site,
    both_sides: bool,
    /// Logarithms of the widths between which is searched, and of the object's own.
    least: f64,
    most: f64,
    own: f64,
    /// Whether that is of the object as it is.
    is_as_is: bool,
    /// By how much ln rate falls with ln width.
    fall: f64,
}

impl Search<'_> {
    fn new<'a>(
        object: &'a Object,
        models: &'a Models,
        site: &'a Site,
        both_sides: bool,
    ) -> Option<Search<'a>> {
        let shape = &object.shape;
        let (width, height) = shape.width.zip(shape.height)?;
        let centre_height = shape.centre_height.unwrap_or(0.5 * height);
        let nearer = 1.0 - shape.centre_offset.map_or(0.0, |offset| 2.0 * offset.abs() / width);
        let [least, most] = SLENDERNESSES.map(|alpha| (2.0 * centre_height * alpha.tan() / nearer).ln());
        let smaller = if both_sides { shape.depth.map_or(width, |depth| depth.min(width)) } else { width };
        let own = smaller.ln().clamp(least, most);
        let (is_as_is, fall) = (own == smaller.ln(), USUAL_FALL);
        Some(Search { object, models, site, both_sides, least, most, own, is_as_is, fall })
    }

    /// The object with another base.
    fn subject(&self, ln_width: f64) -> Option<Subject> {
        let (shape, side) = (&self.object.shape, ln_width.exp());
        let resized = match self.both_sides {
            true => {
                let [width, depth] = [shape.width, shape.depth].map(|own| own.map(|own| own.max(side)));
                self.object.resized(width?, depth)
            }
            false => self.object.resized(side, shape.depth),
        };
        Some(self.models.subject(&resized).ok()?.0)
    }

    fn rate(&self, sought: Sought, ln_width: f64) -> Option<f64> {
        let subject = self.subject(ln_width)?;
        match sought {
            Sought::Estimate => self.site.overturning(&subject),
            Sought::UpperLimit => sought.in_rates(self.site.rates(&subject).overturning),
        }
    }

    /// Finds the width at which a rate is the target, from that of the object as it is on. Where the hazard ends
    /// too early for the rate of a wide object, the search ends there.
    fn solve(&mut self, sought: Sought, as_is: Option<f64>, target: f64) -> Option<f64> {
        let (mut at, mut halvings, mut known) = (self.own, 0, Vec::new());
        let mut next_rate = as_is.filter(|_| self.is_as_is).or_else(|| self.rate(sought, at));
        for _ in 0..MOST_STEPS {
            let Some(rate_there) = next_rate else {
                let Known { ln_width, .. } = known.last()?;
                halvings += 1;
                self.most = 0.5 * (ln_width + at);
                if halvings > HALVINGS {
                    return None;
                }
                at = self.most;
                next_rate = self.rate(sought, at);
                continue;
            };
            known.push(Known { ln_width: at, excess: (rate_there.max(LEAST) / target).ln() });
            let (free, enough) = self.next(&known);
            let next = free.clamp(self.least, self.most);
            if (next - at).abs() < enough {
                return (free <= self.most + ACCURACY).then_some(next.exp());
            }
            at = next;
            next_rate = self.rate(sought, at);
        }
        None
    }

    /// Returns ln of the width at which the excess is 0 by what is known, and the step below which it is right.
    fn next(&mut self, known: &[Known]) -> (f64, f64) {
        let last = known[known.len() - 1];
        if let [.., before, last] = known {
            let fall = (before.excess - last.excess) / (last.ln_width - before.ln_width);
            self.fall = fall.max(LEAST_FALL);
        }
        let by_line = last.ln_width + last.excess / self.fall;
        let step = (by_line - last.ln_width).abs();
        match known {
            [.., a, b, c] => match parabola_at_zero([*a, *b, *c]) {
                by_parabola if (by_parabola - by_line).abs() < 0.5 * step => (by_parabola, LAST_STEPS[2]),
                _ => (by_line, LAST_STEPS[1]),
            },
            [_, _] => (by_line, LAST_STEPS[1]),
            _ => (by_line, LAST_STEPS[0]),
        }
    }
}

/// ln of a rate over the target at ln of a width.
#[derive(Clone, Copy)]
struct Known {
    ln_width: f64,
    excess: f64,
}

/// Finds ln of the width at excess 0 by the parabola of ln width over the excess through three points.
fn parabola_at_zero(points: [Known; 3]) -> f64 {
    let weight = |k: usize| {
        let others = points.iter().enumerate().filter(|(other, _)| *other != k);
        others.map(|(_, other)| other.excess / (other.excess - points[k].excess)).product::<f64>()
    };
    (0..3).map(|k| weight(k) * points[k].ln_width).sum()
}
