//! Ground on which SA(1.0 s) and PGA do not tell PGV as they do at the sites that the routes were judged on.

use super::curve::HazardCurve;
use crate::warning::Warning;

/// Annual rates at which the curves are compared, if they reach so far: once in 475, 2,475 and 10,000 years.
const COMPARED: [f64; 3] = [1.0 / 475.0, 1.0 / 2475.0, 1e-4];
/// The least ratio of the first to the last of these by which slopes are told.
const LEAST_SPAN: f64 = 2.0;
/// SA(1.0 s) / PGA of ground with a period of its own is at least this, and rises by less than this power of
/// the rate: elsewhere the rarer motions are of larger earthquakes, which have more of it.
const OWN_PERIOD: f64 = 1.25;
const RISE: f64 = 0.02;
/// SA(1.0 s) / PGA on the hard rock of a stable continent is at most this, with a flatter curve of PGA.
const HARD_ROCK: f64 = 0.42;
const SLOPE: f64 = 1.8;

/// Of 180 ordinary sites of published ground-motion models one is taken for such ground, of 30 on clay with a
/// period of 1 to 3.5 s 19 are found, of 12 on hard rock 7 (scripts/reference/worlds.py has others of these).
pub(super) fn unusual_ground(pga: &HazardCurve, sa_1s: &HazardCurve) -> Option<Warning> {
    let [[_, (_, last)], [_, (_, last_of_sa)]] = [pga.ends(), sa_1s.ends()];
    let [frequent, middle, rare] = COMPARED.map(|rate| rate.max(last).max(last_of_sa));
    let ratio = |rate: f64| sa_1s.intensity(rate) / pga.intensity(rate);
    let span = frequent / rare;
    let rise = (ratio(rare) / ratio(frequent)).ln() / span.ln();
    let slope = span.ln() / (pga.intensity(rare) / pga.intensity(frequent)).ln();
    match ratio(middle) {
        _ if span < LEAST_SPAN => None,
        ratio if ratio > OWN_PERIOD && rise < RISE => Some(Warning::OwnPeriod),
        ratio if ratio < HARD_ROCK && slope < SLOPE => Some(Warning::HardRock),
        _ => None,
    }
}
