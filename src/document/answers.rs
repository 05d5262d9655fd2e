//! Answers of evaluate in a reader's words, for texts and pages; and what pages show of an evaluation.

use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{Bases, Fragility, HazardCurve, RateByIntensity, SLENDERNESSES, SearchEnd};
use rockfrag_core::statistics::Interval;
use rockfrag_core::warning::UNNAMED;

use crate::chart::text::literal;
use crate::number::{self, PERCENT};
use crate::table::answers::{Answer, ObjectRow, RatesRow};

/// An object, and how often it reaches each limit state.
pub type Rated = Answer<RatesRow>;

/// An evaluation of objects over the hazard of a site, or under one motion.
#[derive(Debug, Clone, Default)]
pub struct Evaluation {
    /// The exposure time or the motion, in words: `in 50 years`.
    pub when: String,
    /// Probability of overturning that is aimed at.
    pub target: Option<f64>,
    /// The hazard or the motion, in words: `hazard: pga.csv`.
    pub hazard: String,
    /// Key of the hazard: the same for the same files.
    pub hazard_key: String,
    /// The worst first, those without an answer last.
    pub rows: Vec<Rated>,
    pub portrait: Portrait,
}

/// What the page of a single object shows beside its row.
#[derive(Debug, Clone, Default)]
pub struct Portrait {
    pub outline: Option<Outline>,
    pub fragility: Option<Fragility>,
    pub hazard: Option<SiteHazard>,
    /// What would change the answer; as it is first.
    pub changes: Vec<Change>,
}

/// A change of an object.
#[derive(Debug, Clone)]
pub struct Change {
    pub words: String,
    /// Whether it stands on another floor.
    pub is_moved: bool,
    /// The probability of overturning then; several where what is measured may come out low or high.
    pub p: Vec<Interval<Option<f64>>>,
}

impl Change {
    pub fn probability(&self) -> f64 {
        self.p[0].value.unwrap_or(1.0)
    }
}

/// An object in the plane in which it rocks, m.
#[derive(Debug, Clone, Copy)]
pub struct Outline {
    pub width: f64,
    pub height: f64,
    pub centre_height: f64,
    pub centre_offset: f64,
    pub alpha_rad: f64,
}

/// How often an intensity is exceeded at the site, and where the rate of overturning comes from.
#[derive(Debug, Clone)]
pub struct SiteHazard {
    pub peak: Peak,
    pub curve: HazardCurve,
    pub parts: RateByIntensity,
}

impl Evaluation {
    /// Joins evaluations of the same time of exposure.
    pub fn joined(all: &[Evaluation]) -> Evaluation {
        let mut joined = all.first().cloned().unwrap_or_default();
        for other in all.iter().skip(1) {
            joined.target = joined.target.filter(|target| other.target == Some(*target));
            if other.hazard_key != joined.hazard_key {
                joined.hazard = format!("{}; {}", joined.hazard, other.hazard);
            }
            joined.rows.extend(other.rows.iter().cloned());
        }
        joined.rows.sort_by(|a, b| b.severity().total_cmp(&a.severity()));
        joined
    }

    /// The name of its file; none of a call's own answers.
    pub fn file(&self) -> String {
        self.rows.first().map_or(String::new(), |rated| literal(&rated.object.file))
    }
}

impl ObjectRow {
    /// The name; none where it was given without one.
    pub fn name(&self) -> Option<&str> {
        Some(self.structure.as_str()).filter(|name| *name != UNNAMED)
    }

    /// Width, depth and height, else p and alpha.
    pub fn size(&self) -> String {
        let sides = [self.width_m, self.depth_m, self.height_m].into_iter().flatten().map(number::length);
        match (self.width_m.zip(self.height_m), self.p_rad_s.zip(self.alpha_rad)) {
            (Some(_), _) => format!("{} m", sides.collect::<Vec<_>>().join(" × ")),
            (_, Some((p, alpha))) => {
                let [p, alpha] = [p, alpha].map(|value| number::significant(value, 3));
                format!("p {p} rad/s, α {alpha}")
            }
            _ => "-".to_string(),
        }
    }

    pub fn is_upstairs(&self) -> bool {
        self.floor_level.is_some()
    }

    /// Where it stands: `on the ground`; `on floor 3 of 5`, as its list says, else `60 % up the building`.
    pub fn place(&self) -> String {
        match (&self.floor, self.floor_level) {
            (_, None) => "on the ground".to_string(),
            (Some(floor), _) => format!("on {floor}"),
            (None, Some(1.0)) => "on the roof".to_string(),
            (None, Some(level)) => format!("{} % up the building", number::fixed(100.0 * level, 0)),
        }
    }

    /// Returns the place in a few words, for rows: `ground`, `floor 3 of 5`, `60 % up`.
    pub fn short_place(&self) -> String {
        let place = self.place().replace(" the building", "");
        let bare = place.trim_start_matches("on ").trim_start_matches("the ");
        literal(bare).replace(' ', "\u{a0}")
    }

    /// The floor and the period of the building after a sign: `, 60 % up the building (period 0.5 s)`;
    /// nothing on the ground.
    pub fn floor_after(&self, sign: &str) -> String {
        let period = self.floor_period_s.filter(|_| self.is_upstairs());
        let Some((period, level)) = period.zip(self.floor_level) else { return String::new() };
        let period = number::plain((100.0 * period).round() / 100.0);
        // Floors are numbered in many ways.
        let height = self.floor.as_ref().map_or(String::new(), |_| format!("{:.0} % up, ", 100.0 * level));
        format!("{sign}{} ({height}period {period} s)", self.place())
    }

    /// What it is called in a text: `Block of 0.50 × 1.90 m, on the roof (period 0.5 s)`.
    pub fn title(&self) -> String {
        let floor = self.floor_after(", ");
        match self.name() {
            Some(name) => format!("{}, {}{floor}", number::name(name), self.size()),
            None => format!("{} of {}{floor}", self.kind(), self.size()),
        }
    }

    /// The name, or what it is: marked text.
    pub fn marked_name(&self) -> String {
        self.name().map_or_else(|| format!("{} of {}", self.kind(), self.size()), literal)
    }

    /// The name, and the floor if it stands on one: marked text.
    pub fn name_and_floor(&self) -> String {
        let floor = self.is_upstairs().then(|| format!(", {}", self.short_place()));
        self.marked_name() + &floor.unwrap_or_default()
    }

    /// The name and the size, for the title of a page.
    pub fn marked_title(&self) -> String {
        let size = self.name().map_or(String::new(), |_| format!(", {}", self.size()));
        self.marked_name() + &size
    }

    fn kind(&self) -> &'static str {
        if self.kind.is_empty() { "Object" } else { self.kind }
    }

    pub fn too_far(&self) -> String {
        format!("rocks beyond {} of its slenderness", PERCENT.one(self.limit_state.unwrap_or(0.1)))
    }
}

/// The exposure time in words: `in 50 years`.
pub fn in_years(years: f64) -> String {
    format!("in {} year{}", number::plain(years), if years == 1.0 { "" } else { "s" })
}

/// The base of an object that a search for a target found: of this width, or with both sides no less than
/// this. To the millimetre, never below.
fn base_in_words(object: &ObjectRow, width: Option<f64>, sides: Option<f64>) -> Option<String> {
    let least = sides.unwrap_or(0.0);
    let width = width.or_else(|| Some(object.width_m.filter(|_| sides.is_some())?.max(least)))?;
    // What is given in millimetres stays.
    let up = |side_m: f64| number::length((1e3 * side_m - 1e-6).ceil() / 1e3);
    let depth = object.depth_m.map(|depth| format!(" × {}", up(depth.max(least))));
    Some(format!("{}{} m", up(width), depth.unwrap_or_default()))
}

/// Said of an object that could rock, but has no rate.
pub const NO_RATE: &str =
    "has no rate of overturning: its model has no probability for some motions of the hazard";

/// Probabilities of overturning, in the exposure time, that part the bands of a figure: those of the
/// earthquakes that codes design for and consider, with 10 and 2 % in 50 years.
pub const BANDS: [f64; 2] = [0.02, 0.1];

/// A limit state, how likely it is in the exposure time, and how often it comes a year.
pub struct State {
    pub name: String,
    pub p: Interval<Option<f64>>,
    pub per_year: Interval<Option<f64>>,
}

impl Answer<RatesRow> {
    /// The limit states, each beyond those before.
    pub fn states(&self) -> [State; 3] {
        let row = &self.row;
        let too_far = format!("{}, or overturns", self.object.too_far());
        let [rocks, rocking_per_year] = [row.p_rocking, row.rocking_per_year].map(Interval::without_limits);
        [
            ("rocks", rocks, rocking_per_year),
            (&too_far, row.p_failure, row.failure_per_year),
            ("overturns", row.p_overturning, row.overturning_per_year),
        ]
        .map(|(name, p, per_year)| State { name: name.to_string(), p, per_year })
    }

    /// The probability of overturning by which objects are sorted: where there is no value its upper end.
    pub fn severity(&self) -> f64 {
        let p = self.row.p_overturning;
        p.value.or(p.high).unwrap_or(f64::NEG_INFINITY)
    }

    pub fn is_answered(&self) -> bool {
        self.severity() >= 0.0
    }

    /// Whether it meets a target, or what base would.
    pub fn about_target(&self, target: f64) -> String {
        let words = PERCENT.one(target);
        match self.base() {
            _ if self.meets(target) => format!("It meets the target of {words}."),
            Some(base) => format!("A base of {base} would meet the target of {words}."),
            None => {
                let why = self.why_no_base();
                format!("No base meets the target of {words}: {why}. Anchored, it would not rock.")
            }
        }
    }

    /// Why no base meets the target, or none by the upper limit.
    pub fn why_no_base(&self) -> String {
        match self.row.bases.target_end {
            None => "its width and height are not known".to_string(),
            Some(SearchEnd::Model) => format!("the model ends at a slenderness of {}", SLENDERNESSES[1]),
            Some(SearchEnd::Hazard) => "the hazard curve ends too early (--extrapolate)".to_string(),
        }
    }

    /// The base that meets the target, if there is one.
    pub fn base(&self) -> Option<String> {
        let Bases { target_width_m, target_sides_m, .. } = self.row.bases;
        base_in_words(&self.object, target_width_m, target_sides_m)
    }

    /// The same by the upper limit.
    pub fn base_by_limit(&self) -> Option<String> {
        let Bases { target_width_m_high, target_sides_m_high, .. } = self.row.bases;
        base_in_words(&self.object, target_width_m_high, target_sides_m_high)
    }

    pub fn meets(&self, target: f64) -> bool {
        self.row.p_overturning.value.or(self.row.p_overturning.high).is_some_and(|p| p <= target)
    }

    /// The sentence that answers how likely it overturns.
    pub fn sentence(&self, when: &str) -> String {
        let p = self.row.p_overturning;
        let is_exact = self.row.overturning_per_year.value.is_some() && self.doubts.error_hazard.is_none();
        let limits = PERCENT.limits(p, "95 % limits ");
        let limits = if is_exact { limits.replace(')', ", with the hazard taken as exact)") } else { limits };
        let often = format!("overturns with a probability of {} {when}", PERCENT.value(p));
        match (p.value, p.high, self.row.return_period_years) {
            (Some(0.0), ..) => "does not overturn: nothing of the hazard uplifts it".to_string(),
            (Some(_), _, Some(years)) => format!("{often} {limits}, once in {} years", number::period(years)),
            (Some(_), ..) => format!("{often} {limits}"),
            (_, Some(_), _) => format!("{often}: the hazard ends too early for one number"),
            _ if self.object.p_rad_s.is_none() => "has no answer".to_string(),
            _ => NO_RATE.to_string(),
        }
    }
}

/// How many objects of a list are expected to overturn, and how likely at least one does.
#[derive(Debug, Clone, Copy, Default)]
pub struct Expected {
    /// With the lower ends of what is known as a range alone.
    pub least: f64,
    /// With the upper ends.
    pub most: f64,
    /// The number of all objects.
    pub all: f64,
    /// If all fall together: the probability of the worst.
    pub together: f64,
    /// If each falls by itself.
    pub independent: f64,
}

impl Expected {
    pub fn new<'a>(rows: impl IntoIterator<Item = &'a Rated>) -> Expected {
        let (mut sum, mut ln_none) = (Expected::default(), 0.0);
        for rated in rows {
            let (count, Interval { value, low, high }) =
                (rated.object.count.unwrap_or(1.0), rated.row.p_overturning);
            let Some((low, high)) = value.or(low).zip(value.or(high)).filter(|_| count > 0.0) else {
                continue;
            };
            sum.all += count;
            sum.least += count * low;
            sum.most += count * high;
            sum.together = sum.together.max(low);
            ln_none += count * (-high).ln_1p();
        }
        Expected { independent: -f64::exp_m1(ln_none), ..sum }
    }

    /// The expected number, or its range.
    pub fn number(&self) -> String {
        let (low, high) = (number::significant(self.least, 2), number::significant(self.most, 2));
        if low == high { low } else { format!("{low} to {high}") }
    }
}
