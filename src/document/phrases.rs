//! Every sentence about an answer, once.

use std::collections::BTreeSet;

use rockfrag_core::fragility::{MagnitudeSource, Peak};
use rockfrag_core::hazard::{
    Bases, Hazard, Lognormal, PeakHazard, SLENDERNESSES, SearchEnd, Side, strongest,
};
use rockfrag_core::object::UncertaintySource;
use rockfrag_core::paper::LIMIT_STATE;
use rockfrag_core::statistics::Interval;
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::{UNNAMED, Warning};

use crate::answer::{Answer, ObjectColumns, USUAL_YEARS, UncertaintyColumns, over_all};
use crate::chart::text::literal;
use crate::number::{self, PERCENT, count, fixed, listed, period, plain, significant};

impl ObjectColumns {
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
                let [p, alpha] = [p, alpha].map(|value| significant(value, 3));
                format!("p {p} rad/s, α {alpha}")
            }
            _ => "-".to_string(),
        }
    }

    /// The height of the centre of mass where it is not half of its height.
    pub fn raised_centre_m(&self) -> Option<f64> {
        let half = 0.5 * self.height_m?;
        self.centre_height_m.filter(|centre| (centre / half - 1.0).abs() > 1e-9)
    }

    /// Where it stands: `on the ground`, `on floor 3 of 5 at a wall`, `60 % up the building`.
    pub fn place(&self) -> String {
        let floor = match (&self.floor, self.floor_level) {
            (_, None) => "on the ground".to_string(),
            (Some(floor), _) => format!("on {}", literal(floor)),
            (None, Some(1.0)) => "on the roof".to_string(),
            (None, Some(level)) => format!("{} % up the building", fixed(100.0 * level, 0)),
        };
        let pedestal = self.is_fixed_to_pedestal.map_or("", |is_fixed| match is_fixed {
            true => " with its pedestal",
            false => " on a pedestal",
        });
        floor + self.wall_rebound.map_or("", |_| " at a wall") + pedestal
    }

    /// The place in a few words, for rows: `ground`, `floor 3 of 5`, `60 % up`.
    pub fn short_place(&self) -> String {
        let place = self.place().replace(" the building", "");
        place.trim_start_matches("on ").trim_start_matches("the ").replace(' ', "\u{a0}")
    }

    /// The place, and the period of the building: `on the roof (period 0.5 s)`.
    pub fn place_in_building(&self) -> String {
        let Some((period, level)) = self.floor_period_s.zip(self.floor_level) else { return self.place() };
        let period = plain((100.0 * period).round() / 100.0);
        // Floors are numbered in many ways.
        let height = self.floor.as_ref().map_or(String::new(), |_| format!("{:.0} % up, ", 100.0 * level));
        format!("{} ({height}period {period} s)", self.place())
    }

    /// The name, or what it is: `Block of 0.50 × 1.90 m`.
    pub fn called(&self) -> String {
        let kind = self.object_kind.as_deref().unwrap_or("Object");
        match self.name() {
            Some(name) => literal(&number::name(name)),
            None => format!("{kind} of {}", self.size()),
        }
    }

    pub fn title(&self) -> String {
        let size = self.name().map_or(String::new(), |_| format!(", {}", self.size()));
        self.called() + &size
    }

    pub fn too_far(&self) -> String {
        let share = PERCENT.one(self.limit_state.unwrap_or(LIMIT_STATE));
        format!("rocks beyond {share} of its slenderness angle, or overturns")
    }

    /// The friction without which it slides; none where it is known to have enough.
    pub fn friction_needed(&self) -> Option<f64> {
        self.friction.filter(|_| self.is_friction_known != Some(true))
    }
}

impl Answer {
    /// The exposure time, the motion or the peak: `in 50 years`, `at 0.5 g and 0.6 m/s`, `over PGA`.
    pub fn when(&self) -> Option<String> {
        let pga = self.tree.pga_m_s2.map(|pga| format!("{} g", plain(pga / G_M_S2)));
        let pgv = self.tree.pgv_m_s.map(|pgv| format!("{} m/s", plain(pgv)));
        let peaks: Vec<String> = [pga, pgv].into_iter().flatten().collect();
        match self.rates.years {
            Some(years) => Some(format!("in {} year{}", plain(years), if years == 1.0 { "" } else { "s" })),
            None if peaks.is_empty() => {
                self.fragility.over.map(|over| format!("over {}", over.name_and_unit().0))
            }
            None => Some(format!("at {}", peaks.join(" and "))),
        }
    }

    /// The time of exposure of all, or that each has its own.
    pub fn when_of_all(answers: &[Answer]) -> String {
        let times: BTreeSet<String> = answers.iter().filter_map(Answer::when).collect();
        match times.len() > 1 && answers.iter().any(|answer| answer.rates.years.is_some()) {
            true => "in the years of each".to_string(),
            false => times.into_iter().next().unwrap_or_default(),
        }
    }

    /// How likely it is to overturn, with limits: the sentence that begins with the object.
    pub fn how_often(&self) -> String {
        let (p, when) = (self.p.p_overturning, self.when().unwrap_or_default());
        let limits = PERCENT.limits(p, "95 % limits ");
        let halves = over_all([self]).filter_map(|Answer { fragility, .. }| {
            let [half, limits, ..] = intensity_cells(fragility.over?, &fragility.overturning);
            let limits = if limits.is_empty() { limits } else { format!(" (95 % limits {limits})") };
            Some(format!("a median {} of {half}{limits}", fragility.over?.name_and_unit().0))
        });
        let halves: Vec<String> = halves.collect();
        match (self.rates.years, self.rates.overturning_per_year) {
            _ if !halves.is_empty() => format!("overturns at {}", halves.join(", or at ")),
            _ if self.object.p_rad_s.is_none() => format!("has no answer: {}", self.reason()),
            (None, _) if self.p.p_rocking <= Some(0.0) => self.uplift(),
            (None, _) => format!("overturns with a probability of {} {when}{limits}", PERCENT.value(p)),
            (_, Interval { value: Some(0.0), .. }) => {
                "does not overturn: nothing of the hazard uplifts it".to_string()
            }
            (_, Interval { value: Some(rate), .. }) => {
                format!("overturns once in {} years; {} {when}{limits}", period(1.0 / rate), PERCENT.value(p))
            }
            _ => {
                "has no rate of overturning: its model has no probability for some of the motions".to_string()
            }
        }
    }

    /// Whether it rocks: on the ground by PGA over that of uplift.
    pub fn uplift(&self) -> String {
        let friction = self.object.friction.filter(|_| self.object.floor_level.is_none());
        let rocks = if self.p.p_rocking > Some(0.0) { "rocks" } else { "does not rock" };
        match (self.tree.pga_m_s2.zip(friction), self.p.p_rocking) {
            (Some((pga_m_s2, friction)), _) => {
                let times = pga_m_s2 / (friction * G_M_S2);
                let times = fixed(times, if times > 10.0 { 0 } else { 1 });
                format!("{rocks}: PGA is {times} times what uplifts it")
            }
            (None, Some(p)) => format!("rocks with a probability of {}", PERCENT.one(p)),
            _ => rocks.to_string(),
        }
    }

    /// The base with which it meets its target, or why none does; `whose` names it among others: ` of rack`.
    pub fn about_target(&self, whose: &str) -> Option<String> {
        let target = PERCENT.one(self.rates.target.filter(|_| self.rates.years.is_some())?);
        let (target, why_none) = (format!("{target} {}", self.when()?), self.why_no_base());
        let Some(base) = self.base(|side| side.value) else {
            return Some(format!(
                "No base{whose} is found for {target}: {why_none}. Anchored, it would not rock."
            ));
        };
        let by_limit = self.base(|side| side.high).map(|base| format!("{base} by the upper limit"));
        let by_limit = by_limit.unwrap_or_else(|| format!("none by the upper limit: {why_none}"));
        Some(format!("Base{whose} for {target}: {base}; {by_limit}."))
    }

    fn why_no_base(&self) -> String {
        match self.rates.bases.target_end {
            None => "its width and height are not known".to_string(),
            Some(SearchEnd::Model) => format!("the model ends at a slenderness of {}", SLENDERNESSES[1]),
            Some(SearchEnd::Hazard) => "the hazard curve ends too early".to_string(),
        }
    }

    /// The base that meets the target by the estimate, or by the upper limit: of this width, or with both
    /// sides no less than this. To the millimetre, never below.
    pub fn base(&self, by: fn(Side) -> Option<f64>) -> Option<String> {
        let Bases { target_width_m, target_sides_m, .. } = self.rates.bases;
        let ([width, sides], object) = ([target_width_m, target_sides_m].map(by), &self.object);
        let least = sides.unwrap_or(0.0);
        let width = width.or_else(|| Some(object.width_m.filter(|_| sides.is_some())?.max(least)))?;
        // What is given in millimetres stays.
        let up = |side_m: f64| number::length((1e3 * side_m - 1e-6).ceil() / 1e3);
        let depth = object.depth_m.map(|depth| format!(" × {}", up(depth.max(least))));
        Some(format!("{}{} m", up(width), depth.unwrap_or_default()))
    }

    /// What of its rate lies beyond a curve that ends too early.
    fn beyond_the_curve(&self, whose: &str) -> Option<String> {
        let is_early = self.uncertainty.warnings().contains(&Warning::HazardEndsEarly);
        let share = PERCENT.one(self.rates.share_extrapolated.filter(|_| is_early)?);
        Some(format!(
            "{share} of the rate{whose} lies beyond the end of the hazard curve, continued by its last slope: \
             the limits range from none of these motions overturning it to all of them."
        ))
    }

    pub fn reason(&self) -> String {
        literal(self.uncertainty.warnings.as_deref().unwrap_or("no reason known"))
    }

    /// The magnitude, and of PGV / PGA that of the motion which the answer turns on.
    fn assumed(&self) -> Option<String> {
        let UncertaintyColumns { magnitude, magnitude_sd, magnitude_by, .. } = self.uncertainty;
        let whence = match magnitude_by? {
            MagnitudeSource::Given => "",
            MagnitudeSource::Usual => " (assumed: that of motions that overturn)",
            MagnitudeSource::Inferred => " (inferred from PGV/PGA)",
        };
        let sd = magnitude_sd.filter(|sd| *sd > 0.0);
        let sd = sd.map_or(String::new(), |sd| format!(" ± {}", significant(sd, 2)));
        let ratio = significant(self.uncertainty.pgv_pga_s?, 2);
        Some(format!("For magnitude {}{sd}{whence} and PGV/PGA {ratio} s.", fixed(magnitude?, 2)))
    }

    /// The largest part of the error, and what would narrow it.
    fn largest_uncertainty(&self, whose: &str) -> Option<String> {
        let is_known = self.rates.years.is_none() || self.rates.overturning_per_year.value > Some(0.0);
        let [name, remedy] = of_source(self.uncertainty.error_largest.filter(|_| is_known)?);
        Some(format!("Largest uncertainty{whose}: {name}, narrowed by {remedy}."))
    }
}

/// What is uncertain, and what narrows it.
pub fn of_source(source: UncertaintySource) -> [&'static str; 2] {
    match source {
        UncertaintySource::Fit => ["fragility", "records of the site"],
        UncertaintySource::Magnitude => ["magnitude", "a disaggregation"],
        UncertaintySource::Velocity => ["PGV", "its value or hazard"],
        UncertaintySource::Eta => ["restitution", "a rocking test"],
        UncertaintySource::Wall => ["rebound from the wall", "its measured value"],
        UncertaintySource::Object => ["centre of mass", "weighing or a tilt test"],
        UncertaintySource::Floor => ["building", "its measured period"],
        UncertaintySource::Hazard => ["hazard", "a study of the site"],
    }
}

/// An intensity with its unit; one beyond all records without a number.
pub fn intensity(over: Peak, intensity: Option<f64>) -> String {
    let (_, unit, symbol) = over.name_and_unit();
    match intensity {
        Some(value) => format!("{} {symbol}", significant(value, 2)),
        None => format!("> {} {symbol}", plain(strongest(over) / unit)),
    }
}

/// The intensity of one half, its limits, those of 16 and 84 %, and the dispersion.
pub fn intensity_cells(over: Peak, Lognormal { at_16, theta, at_84, beta, .. }: &Lognormal) -> [String; 5] {
    let [low, high] = [theta.low, theta.high].map(|limit| intensity(over, limit));
    let limits = theta.low.map_or(String::new(), |_| format!("{low} to {high}"));
    let [half, at_16, at_84] = [theta, at_16, at_84].map(|at| intensity(over, at.value));
    [half, limits, at_16, at_84, beta.map_or(String::new(), |beta| significant(beta, 2))]
}

/// What answers rest on, one or more, the worst of which is the first: a line each.
pub fn facts(all: &[&Answer], hazard: Option<&Hazard>) -> Vec<String> {
    let (worst, is_alone) = (all[0], all.len() == 1);
    let whose = if is_alone { String::new() } else { format!(" of {}", worst.object.called()) };
    let valid = match (is_alone, worst.object.friction_needed()) {
        (false, _) => {
            Some("With less friction than it needs, an object slides instead of rocking.".to_string())
        }
        (true, least) => {
            least.map(|it| format!("Valid if friction is well above {}; else it slides.", fixed(it, 2)))
        }
    };
    let is_upstairs = all.iter().any(|answer| answer.object.floor_level.is_some());
    let building = is_upstairs.then(|| "The building is taken as linear.".to_string());
    let models = Vec::from_iter(BTreeSet::from_iter(all.iter().flat_map(|answer| &answer.object.model)));
    let models = literal(&listed(&models, 1));
    let model = (!models.is_empty()).then(|| format!("By {models}{}.", usual_motion(hazard)));
    let uncertain = [worst.assumed(), worst.largest_uncertainty(&whose), limits_cover(all)];
    let others = [worst.beyond_the_curve(&whose), model, valid, building];
    uncertain.into_iter().chain(others).flatten().collect()
}

type Value = fn(&Answer) -> Option<f64>;

/// What else answers rest on, for who signs them: each where a value of one of them is known, with the span
/// of these values for @.
const ASSUMPTIONS: [(Value, &str); 7] = [
    (|of| of.rates.years, "The hazard is that of the ground for which its curve was made."),
    (
        |of| of.object.floor_period_s,
        "Buildings: linear, first period @ s, as given or by ASCE 7 for 3.5 m a storey; torsion and yielding \
         are not counted.",
    ),
    (|of| of.object.depth_m, "What has a width and a depth may fall in both directions: the rates add up."),
    (
        |of| of.object.eta,
        "Restitution η, the angular velocity after an impact over that before: @, with its scatter; by \
         Housner's formula for a solid block where none is given.",
    ),
    (
        |of| of.object.alpha_rad.map(f64::to_degrees),
        "Rocks too far: beyond {limit} of the slenderness α, the angle at which it tips (@°).",
    ),
    (
        |_| Some(0.0),
        "Rigid objects that stand free and do not slide. Not counted: vertical motion; edges rounded below, bases \
         round in plan, soft floors and thin bottoms, all of which overturn more often.",
    ),
    (
        |_| Some(0.0),
        "FEMA P-58 has more falls: its median velocities for unanchored components are 1.7 to 2.0 times lower. \
         Under records scaled to them 5 to 10 % of such blocks overturn, not half.",
    ),
];

pub fn assumptions(all: &[&Answer]) -> Vec<String> {
    let limit = all.iter().find_map(|answer| answer.object.limit_state).unwrap_or(LIMIT_STATE);
    let said = ASSUMPTIONS.iter().filter_map(|(value, words)| {
        let values = || all.iter().filter_map(|answer| value(answer));
        let ends = [values().reduce(f64::min)?, values().reduce(f64::max)?].map(|end| significant(end, 2));
        let span = if ends[0] == ends[1] { ends[0].clone() } else { ends.join(" to ") };
        Some(words.replace('@', &span).replace("{limit}", &PERCENT.one(limit)))
    });
    said.collect()
}

/// The motions that codes design for and consider, by the curve: who knows the site sees a wrong unit or
/// column by them.
fn usual_motion(hazard: Option<&Hazard>) -> String {
    let Some(Hazard::Curve(PeakHazard { peak, curve, .. })) = hazard else { return String::new() };
    let (what, unit, symbol) = peak.name_and_unit();
    let once_in = |years: f64| {
        let intensity = curve.intensity(1.0 / years);
        let years = count((1.0 / curve.exceedance(intensity)).round() as usize);
        format!("{} {symbol} once in {years} years", significant(intensity / unit, 3))
    };
    let mut usual = USUAL_YEARS.map(once_in).to_vec();
    usual.dedup();
    format!("; {what} {}", usual.join(", "))
}

fn limits_cover(all: &[&Answer]) -> Option<String> {
    let sds = all.iter().flat_map(|answer| answer.uncertainty.source_sds());
    let sources: BTreeSet<UncertaintySource> = sds.map(|(source, _)| source).collect();
    let names = sources.into_iter().map(|source| of_source(source)[0]).collect::<Vec<_>>().join(", ");
    (!names.is_empty()).then(|| format!("The 95 % limits cover only the uncertainty of: {names}."))
}
