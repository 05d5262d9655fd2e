//! The base with which the rate of overturning of an object is a target: all else of the object the same.

use super::site::Site;
use crate::object::{Object, Subject};
use crate::statistics::{Limited, Range};

/// The base of an object, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Base {
    /// Has this width.
    Width(f64),
    /// Has no side below this.
    Sides(f64),
}

/// Bases that meet a target; none where none within the domain of the surface does.
///
/// ```
/// use rockfrag::fragility::{Kind, Peak};
/// use rockfrag::hazard::{Hazard, HazardCurve, Site};
/// use rockfrag::object::{Object, Subject};
///
/// let curve = HazardCurve::new(vec![(0.5, 2e-2), (5.0, 5e-4), (20.0, 8e-6), (45.0, 4e-7)])?;
/// let site = Site::new(Hazard::over(Peak::Pga, curve));
/// let subject = |object: &Object| Subject::shipped(object, Kind::Recorded, 0.10).ok();
/// let cabinet = Object::block("cabinet", 0.5, 1.9);
/// let rate = site.rates(&subject(&cabinet).expect("it rocks")).overturning;
/// // Once in 10,000 years.
/// let bases = site.bases(&cabinet, &subject, rate, 1e-4);
/// let [by_estimate, by_limit] = [bases.by_estimate, bases.by_limit].map(|base| base.and_then(|base| base.width()));
/// assert!(0.5 < by_estimate.unwrap() && by_estimate < by_limit);
/// # Ok::<(), rockfrag::hazard::HazardError>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Bases {
    /// The rate is the target.
    pub by_estimate: Option<Base>,
    /// The upper limit of the rate is.
    pub by_limit: Option<Base>,
}

/// Slendernesses of the structures that the surface knows, rad: eta of a wider solid block is below 0.7.
const SLENDERNESSES: [f64; 2] = [0.04, 0.46];
/// Relative accuracy of a side.
const ACCURACY: f64 = 2e-5;
/// Steps of ln side after which the next is right to that: by a fall that is assumed, by the line through two
/// sides, by the parabola through three.
const LAST_STEPS: [f64; 3] = [ACCURACY, 5e-4, 1e-3];
/// Such a step of a side at which limits are computed, which tell the rate there too.
const ROUGH_STEP: f64 = 0.02;
const MOST_STEPS: usize = 40;
/// By how much ln rate falls with ln side, about, where a search begins; and the least fall that it trusts.
const USUAL_FALL: f64 = 5.0;
const LEAST_FALL: f64 = 0.2;
/// By how much ln of the upper limit over the rate changes with ln rate, about, and this slope with it; and the
/// slopes that are trusted.
const USUAL_SLOPE: f64 = -0.27;
const USUAL_BEND: f64 = 0.05;
const SLOPES: Range = Range { low: -0.7, high: 0.3 };
/// By how little ln of an upper limit is off where by the next slope it is right.
const CLOSE: f64 = 0.02;
/// Annual rates count as no less.
const LEAST: f64 = 1e-12;

impl Site {
    /// Finds the bases with which the annual rate of overturning is a target, at the same height, rule of eta
    /// and relative offset: of another width, else with both sides changed. `rate` is that of the object as it
    /// is, `subject` joins an object with its models.
    pub fn bases(
        &self,
        object: &Object,
        subject: &dyn Fn(&Object) -> Option<Subject>,
        rate: Limited,
        target: f64,
    ) -> Bases {
        let (ln_target, mut bases) = (target.ln(), Bases::default());
        let own = rate.value.zip(rate.high).map(|(value, high)| Limit::new(value, high));
        let mut limit = own;
        for base in [Base::Width, Base::Sides] {
            let Some(mut search) = Search::new(self, object, subject, base) else { continue };
            let widest = search.known_at(search.most);
            // A wider base is no help where the depth is what is too small.
            if widest.is_some_and(|widest| widest.ln_rate > ln_target) {
                continue;
            }
            let own = own.filter(|_| search.is_as_is);
            let own = own.map(|Limit { ln_rate, .. }| Known { ln_side: search.start, ln_rate });
            search.known.extend(widest.into_iter().chain(own));
            let as_ln = |ln_side: f64| base(ln_side.exp());
            bases.by_estimate = bases.by_estimate.or_else(|| search.ln_side(ln_target, 0.0).map(as_ln));
            let least = widest.map_or(f64::NEG_INFINITY, |widest| widest.ln_rate);
            bases.by_limit =
                bases.by_limit.or_else(|| search.by_limit(&mut limit, least, ln_target).map(as_ln));
        }
        bases
    }
}

impl Base {
    /// Returns the width, if that alone is meant.
    pub fn width(self) -> Option<f64> {
        if let Base::Width(width) = self { Some(width) } else { None }
    }

    /// Returns the least of both sides, if both are meant.
    pub fn sides(self) -> Option<f64> {
        if let Base::Sides(side) = self { Some(side) } else { None }
    }

    /// Puts it under an object.
    fn under(self, object: &Object) -> Object {
        let shape = &object.shape;
        match self {
            Base::Width(width) => object.resized(width, shape.depth),
            Base::Sides(side) => object
                .resized(shape.width.unwrap_or(side).max(side), shape.depth.map(|depth| depth.max(side))),
        }
    }
}

/// A search over the width, or over the smaller side, in its logarithm: ln rate is almost straight in it.
struct Search<'a> {
    site: &'a Site,
    object: &'a Object,
    subject: &'a dyn Fn(&Object) -> Option<Subject>,
    base: fn(f64) -> Base,
    /// Logarithms of the sides between which is searched.
    least: f64,
    most: f64,
    /// Where the search begins: the side of the object as it is, or the nearest one.
    start: f64,
    is_as_is: bool,
    /// From here on the hazard ends too early for a rate.
    early: f64,
    known: Vec<Known>,
}

/// ln of the annual rate at ln of a side.
#[derive(Clone, Copy)]
struct Known {
    ln_side: f64,
    ln_rate: f64,
}

/// ln of an annual rate, and of its upper limit over it, which is almost straight in the former.
#[derive(Clone, Copy)]
struct Limit {
    ln_rate: f64,
    ln_margin: f64,
    slope: f64,
}

impl Limit {
    fn new(value: f64, high: f64) -> Limit {
        let ln_rate = value.max(LEAST).ln();
        Limit { ln_rate, ln_margin: high.max(LEAST).ln() - ln_rate, slope: USUAL_SLOPE }
    }

    /// Returns it with the slope by another limit and this.
    fn after(self, other: Limit) -> Limit {
        let step = self.ln_rate - other.ln_rate;
        let slope = (self.ln_margin - other.ln_margin) / step + 0.5 * USUAL_BEND * step;
        if slope.is_finite() { Limit { slope: SLOPES.held(slope), ..self } } else { self }
    }

    /// Returns ln of the rate whose upper limit is this.
    fn ln_rate_at(&self, ln_limit: f64) -> f64 {
        self.ln_rate + (ln_limit - self.ln_rate - self.ln_margin) / (1.0 + self.slope)
    }
}

impl Search<'_> {
    /// Begins a search; none over both sides of an object without a depth.
    fn new<'a>(
        site: &'a Site,
        object: &'a Object,
        subject: &'a dyn Fn(&Object) -> Option<Subject>,
        base: fn(f64) -> Base,
    ) -> Option<Search<'a>> {
        let shape = &object.shape;
        let (width, height) = shape.width.zip(shape.height)?;
        let side = match base(width) {
            Base::Width(width) => width,
            Base::Sides(width) => shape.depth?.min(width),
        };
        let centre_height = shape.centre_height.unwrap_or(0.5 * height);
        let nearer = 1.0 - shape.centre_offset.map_or(0.0, |offset| 2.0 * offset.abs() / width);
        let [least, most] = SLENDERNESSES.map(|alpha| (2.0 * centre_height * alpha.tan() / nearer).ln());
        let start = side.ln().clamp(least, most);
        let is_as_is = start == side.ln();
        Some(Search {
            site,
            object,
            subject,
            base,
            least,
            most,
            start,
            is_as_is,
            early: f64::INFINITY,
            known: Vec::new(),
        })
    }

    fn subject(&self, ln_side: f64) -> Option<Subject> {
        (self.subject)(&(self.base)(ln_side.exp()).under(self.object))
    }

    fn known_at(&self, ln_side: f64) -> Option<Known> {
        let rate = self.site.overturning(&self.subject(ln_side)?)?;
        Some(Known { ln_side, ln_rate: rate.max(LEAST).ln() })
    }

    /// Finds ln of the side at which ln rate is this; no better than by one more step if that is less than
    /// `rough`. Where the hazard ends too early for the rate of a wide object, the search ends there.
    fn ln_side(&mut self, ln_rate: f64, rough: f64) -> Option<f64> {
        for _ in 0..MOST_STEPS {
            let (free, enough) = self.next(ln_rate);
            let (mut next, last) = (free.clamp(self.least, self.most), self.known.last().copied());
            if next >= self.early {
                next = 0.5 * (last?.ln_side + self.early);
            }
            if last.is_some_and(|last| (next - last.ln_side).abs() < enough.max(rough)) {
                return (free <= next + ACCURACY).then_some(next);
            }
            match self.known_at(next) {
                Some(known) => self.known.push(known),
                None => self.early = next,
            }
        }
        None
    }

    /// Returns ln of the side at which ln rate is this by what is known, and the step below which it is right.
    fn next(&self, ln_rate: f64) -> (f64, f64) {
        let by_line = |last: &Known, fall: f64| last.ln_side + (last.ln_rate - ln_rate) / fall;
        match &self.known[..] {
            [] => (self.start, 0.0),
            [last] => (by_line(last, USUAL_FALL), LAST_STEPS[0]),
            [.., before, last] => {
                let fall = (before.ln_rate - last.ln_rate) / (last.ln_side - before.ln_side);
                let by_line = by_line(last, fall.max(LEAST_FALL));
                let step = (by_line - last.ln_side).abs();
                match self.known.last_chunk().map(|three| parabola(three, ln_rate)) {
                    Some(by_parabola) if (by_parabola - by_line).abs() < 0.5 * step => {
                        (by_parabola, LAST_STEPS[2])
                    }
                    _ => (by_line, LAST_STEPS[1]),
                }
            }
        }
    }

    /// Finds ln of the side at which ln of the upper limit is this, from a limit that is known. The rate, which
    /// is no less than `least`, costs a tenth of its limits.
    fn by_limit(&mut self, known: &mut Option<Limit>, least: f64, ln_limit: f64) -> Option<f64> {
        let mut is_close = false;
        for _ in 0..MOST_STEPS {
            let sought = known.map_or(ln_limit, |known| known.ln_rate_at(ln_limit));
            if is_close {
                return self.ln_side(sought, 0.0);
            }
            // Elsewhere the limit may be another than by its slope.
            let ln_side = if sought < least { self.most } else { self.ln_side(sought, ROUGH_STEP)? };
            let Limited { value, high, .. } = self.site.rates(&self.subject(ln_side)?).overturning;
            let here = Limit::new(value?, high?);
            let off = here.ln_rate + here.ln_margin - ln_limit;
            if ln_side == self.most && off > 0.0 {
                return None;
            }
            self.known.push(Known { ln_side, ln_rate: here.ln_rate });
            is_close = off.abs() < CLOSE;
            *known = Some(known.map_or(here, |before| here.after(before)));
        }
        None
    }
}

/// Finds ln of the side at ln of a rate by the parabola of the former over the latter through three points.
fn parabola(points: &[Known; 3], ln_rate: f64) -> f64 {
    let weight = |k: usize| {
        let others = points.iter().enumerate().filter(|(other, _)| *other != k);
        others
            .map(|(_, other)| (ln_rate - other.ln_rate) / (points[k].ln_rate - other.ln_rate))
            .product::<f64>()
    };
    (0..3).map(|k| weight(k) * points[k].ln_side).sum()
}
