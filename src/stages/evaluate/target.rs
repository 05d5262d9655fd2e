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
/// Relative accuracy of a width, and the most steps of a search.
const ACCURACY: f64 = 2e-5;
const LAST_STEP: f64 = 1e-3;
const MOST_STEPS: usize = 40;
/// The most full rates of a search by the upper limit, and the change of ln width after which a line
/// suffices.
const MOST_SPREADS: usize = 3;
const CLOSE: f64 = 0.01;
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
        searches.filter_map(|both_sides| Search::new(object, models, site, both_sides, rate)).collect();
    let by_estimate =
        searches.iter_mut().find_map(|search| Some((search.both_sides, search.by_estimate(target)?)));
    let by_limit = searches
        .iter_mut()
        .find_map(|search| Some((search.both_sides, search.by_upper_limit(rate, target)?)));
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
    /// ln of the rate at ln of a width, the latest last.
    known: Vec<(f64, f64)>,
}

impl Search<'_> {
    fn new<'a>(
        object: &'a Object,
        models: &'a Models,
        site: &'a Site,
        both_sides: bool,
        rate: Limited,
    ) -> Option<Search<'a>> {
        let shape = &object.shape;
        let (width, height) = shape.width.zip(shape.height)?;
        let centre_height = shape.centre_height.unwrap_or(0.5 * height);
        let nearer = 1.0 - shape.centre_offset.map_or(0.0, |offset| 2.0 * offset.abs() / width);
        let [least, most] = SLENDERNESSES.map(|alpha| (2.0 * centre_height * alpha.tan() / nearer).ln());
        let smaller = if both_sides { shape.depth.map_or(width, |depth| depth.min(width)) } else { width };
        let own = smaller.ln().clamp(least, most);
        let known = rate.value.filter(|_| own == smaller.ln()).map(|rate| (own, rate.max(LEAST).ln()));
        let known = known.into_iter().collect();
        Some(Search { object, models, site, both_sides, least, most, own, known })
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

    fn by_estimate(&mut self, target: f64) -> Option<f64> {
        Some(self.solve(|_| target.ln())?.exp())
    }

    /// Finds where the upper limit meets the target. By how much it is above the estimate changes little
    /// with width: a line through the last two widths tells it.
    fn by_upper_limit(&mut self, rate: Limited, target: f64) -> Option<f64> {
        let (mut at, mut above, mut per_ln) =
            (self.own, spread(rate).or_else(|| self.spread_at(self.own))?, 0.0);
        for _ in 0..MOST_SPREADS {
            let next = self.solve(|ln_width| target.ln() - above - per_ln * (ln_width - at))?;
            if (next - at).abs() < CLOSE {
                return Some(next.exp());
            }
            let there = self.spread_at(next)?;
            (at, above, per_ln) = (next, there, (there - above) / (next - at));
        }
        Some(self.solve(|ln_width| target.ln() - above - per_ln * (ln_width - at))?.exp())
    }

    /// ln of the upper limit over the estimate.
    fn spread_at(&mut self, ln_width: f64) -> Option<f64> {
        let rate = self.site.rates(&self.subject(ln_width)?).overturning;
        self.learn(ln_width, rate.value?);
        spread(rate)
    }

    fn is_known(&self, ln_width: f64) -> bool {
        self.known.last().is_some_and(|(last, _)| *last == ln_width)
    }

    fn learn(&mut self, ln_width: f64, rate: f64) {
        if !self.is_known(ln_width) {
            self.known.push((ln_width, rate.max(LEAST).ln()));
        }
    }

    /// Finds ln of the width at which ln rate is what is wanted of it, by secants from the last width on. Where
    /// the hazard ends too early for the rate of a wide object, the search ends there.
    fn solve(&mut self, wanted: impl Fn(f64) -> f64) -> Option<f64> {
        let mut halvings = 0;
        let mut at = self.known.last().map_or(self.own, |(ln_width, _)| *ln_width);
        for _ in 0..MOST_STEPS {
            if !self.is_known(at) {
                let Some(rate) = self.site.overturning(&self.subject(at)?) else {
                    let (known, _) = self.known.last()?;
                    halvings += 1;
                    self.most = 0.5 * (known + at);
                    if halvings > HALVINGS {
                        return None;
                    }
                    at = self.most;
                    continue;
                };
                self.learn(at, rate);
            }
            let excess = |(ln_width, ln_rate): (f64, f64)| ln_rate - wanted(ln_width);
            // A step by a fall that was measured nearby is right to a few per cent of itself.
            let (fall, enough) = match self.known[..] {
                [.., before, last] => ((excess(before) - excess(last)) / (last.0 - before.0), LAST_STEP),
                _ => (USUAL_FALL, ACCURACY),
            };
            let free = at + excess((at, self.known[self.known.len() - 1].1)) / fall.max(LEAST_FALL);
            let next = free.clamp(self.least, self.most);
            if (next - at).abs() < enough {
                return (free <= self.most + enough).then_some(next);
            }
            at = next;
        }
        None
    }
}

/// ln of the upper limit of a rate over the rate.
fn spread(rate: Limited) -> Option<f64> {
    Some((rate.high? / rate.value?).ln()).filter(|ln| ln.is_finite())
}
