//! What a page shows of an object at a site: where its rate comes from, its fragility, and the rate after a
//! change.

use std::sync::Arc;

use rand_distr::{Distribution, StandardNormal};
use rockfrag_core::fragility::{LimitState, Model, MotionKind, Peak};
use rockfrag_core::hazard::{
    Budget, GenericSites, GroundMotion, Hazard, HazardCurve, ListProbabilities, ListedObject, Lognormal,
    PeakHazard, PgvPgaRatio, Site, SiteRates, probability_in_years,
};
use rockfrag_core::object::{Changed, Object, Place, Restitution, RockingObject, Shape, UncertaintySource};
use rockfrag_core::statistics::Interval;
use rockfrag_core::statistics::normal::Z_95;

use crate::common::{close, pair, random};

/// A curve that ends where nothing is stronger.
fn curve() -> HazardCurve {
    HazardCurve::new(vec![(0.1, 0.2), (1.0, 1.8e-2), (4.0, 2.1e-3), (8.0, 3e-4), (20.0, 1e-5), (45.0, 1e-7)])
        .unwrap()
}

fn over_pga() -> Site {
    Site::new(Hazard::over(Peak::Pga, curve()))
}

const GENERAL: GenericSites = GenericSites { over: Peak::Pga, mw: None, vs30_m_s: None, ratio_s: None };

fn uncalibrated(object: &Object) -> RockingObject {
    RockingObject::uncalibrated(object, MotionKind::Recorded, 0.1).unwrap()
}

fn block(width: f64) -> RockingObject {
    uncalibrated(&Object::block("block", width, 1.9))
}

#[test]
fn the_parts_of_a_rate_sum_to_the_rate() {
    let pairs = (1..13).map(f64::from).map(|k| pair(k, 0.1 * k, 1e-3 / k));
    let joint = Site::new(Hazard::Joint(pairs.collect()));
    for site in [over_pga(), joint] {
        let (rate, parts) = (site.overturning(&block(0.5)).unwrap(), site.rate_by_intensity(&block(0.5), 60));
        let sum = parts.rates.iter().sum::<f64>() + parts.beyond;
        close(sum, rate, 1e-3);
        assert!(parts.rates.iter().filter(|part| **part > 0.01 * rate).count() > 5);
    }
}

#[test]
fn the_fragility_at_a_site_integrates_to_its_rate() {
    let (site, object) = (over_pga(), block(0.5));
    let (rate, points) = (site.rates(&object), site.fragility(&object).unwrap().points);
    for p in points.iter().flat_map(|point| [point.p.failure, point.p.overturning]) {
        let p = p.estimate().unwrap();
        assert!((0.0..=p.value).contains(&p.low) && (p.value..=1.0).contains(&p.high), "{p:?}");
    }
    let at = |im: f64, state: LimitState| {
        let after = points.partition_point(|point| point.intensity < im).min(points.len() - 1);
        let [low, high] = [&points[after.saturating_sub(1)], &points[after]];
        let share =
            if after == 0 { 0.0 } else { (im / low.intensity).ln() / (high.intensity / low.intensity).ln() };
        let [a, b] = [low, high].map(|point| point.p.get(state).value.unwrap());
        if im < points[0].intensity { 0.0 } else { a + (b - a) * share.min(1.0) }
    };
    for state in [LimitState::Overturning, LimitState::Failure] {
        let sum = curve().mean_annual_rate(&[points[0].intensity], 0.02, |im| at(im, state));
        let rate = rate.states.get(state);
        close(sum, rate.value.unwrap(), 1e-3);
    }
}

#[test]
fn half_of_the_motions_overturn_at_the_median_of_a_fragility() {
    for (over, mw) in [(Peak::Pga, None), (Peak::Pga, Some(7.0)), (Peak::Pgv, None), (Peak::Pgv, Some(5.5))] {
        let Lognormal { at_16, theta, beta, largest_error, .. } =
            GenericSites { over, mw, ..GENERAL }.fragility(&block(0.5)).overturning;
        let still = GroundMotion { pga_m_s2: None, pgv_m_s: None, mw, vs30_m_s: None };
        for (level, Interval { value, low, high }) in [(0.16, at_16), (0.5, theta)] {
            let motion = match over {
                Peak::Pga => GroundMotion { pga_m_s2: value, ..still },
                Peak::Pgv => GroundMotion { pgv_m_s: value, ..still },
            };
            let p = motion.probabilities(&block(0.5)).states.overturning.value.unwrap();
            assert!((p - level).abs() < 1e-6, "{p} for {level}");
            assert!(low < value && high.is_none_or(|high| high > value.unwrap()));
        }
        assert!(beta.unwrap() > 0.1 && largest_error.unwrap() < 0.15);
    }
}

#[test]
fn what_both_peaks_leave_open_of_the_magnitude_is_m_times_its_spread() {
    // m and the standard deviation of M by PGV / PGA: rows of universal.csv.
    let motion = |mw| GroundMotion { pga_m_s2: Some(5.0), pgv_m_s: Some(0.6), mw, vs30_m_s: None };
    let of = |mw| motion(mw).probabilities(&block(0.5)).budget.source_sd(UncertaintySource::Magnitude);
    close(of(None).unwrap(), 0.857 * 0.5398, 1e-6);
    assert_eq!(of(Some(6.5)), None);
}

#[test]
fn what_no_recorded_motion_overturns_has_no_median() {
    let overturning = GENERAL.fragility(&block(1.8)).overturning;
    assert_eq!((overturning.theta.value, overturning.beta), (None, None));
}

/// A block with its restitution, the model's parameters and the magnitude at these standard deviations.
fn drawn(width: f64, z: &[f64]) -> f64 {
    let mut object = Object::block("block", width, 1.9);
    let median = block(width).directions[0].structure.eta;
    object.shape.eta = Some(Restitution::Number(1.0 - (1.0 - median) * (-0.4 * z[0]).exp()));
    let mut object = uncalibrated(&object);
    let direction = &mut object.directions[0];
    let Model::Surface { overturning, .. } = Arc::make_mut(&mut direction.model) else {
        panic!("the surface")
    };
    for (z, [low, high]) in z[2..].iter().zip(overturning.errors()) {
        let step = z / (2.0 * Z_95);
        overturning.c += step * (high[0] - low[0]);
        overturning.ln_s += step * (high[1] - low[1]);
        overturning.m += step * (high[2] - low[2]);
    }
    // That of motions is above a mean of the disaggregation.
    let mean = 6.35 + 0.6 * z[1] - 0.25;
    Site { mw: Some(mean), ..of_one_ratio() }.overturning(&object).unwrap()
}

/// Of a PGV / PGA that does not depend on magnitude.
fn of_one_ratio() -> Site {
    let (peak, curve, pgv_pga) = (Peak::Pga, curve(), Some(PgvPgaRatio::given(0.1)));
    Site::new(Hazard::Curve(PeakHazard { peak, curve, warnings: vec![], fractiles: None, pgv_pga }))
}

#[test]
fn the_limits_of_a_ratio_are_those_of_draws_in_which_shared_unknowns_move_both() {
    // The restitution of a base of 0.9 m ends where the model does: limits upwards are the wider ones.
    for widths in [[0.5, 0.6], [0.6, 0.9]] {
        let [before, after] = widths.map(|width| of_one_ratio().rates(&block(width)));
        let [old, new] = [&before, &after].map(|rates| rates.states.overturning.value.unwrap());
        let limits = |shared: bool| {
            Budget::of_ratio(&before.budget, &after.budget, |_| shared).limit_rate(new / old, f64::INFINITY)
        };
        let mut random = random(7);
        let mut draws: Vec<f64> = (0..1000)
            .map(|_| {
                let z: Vec<f64> = (0..5).map(|_| StandardNormal.sample(&mut random)).collect();
                drawn(widths[1], &z) / drawn(widths[0], &z)
            })
            .collect();
        draws.sort_by(f64::total_cmp);
        let (ratio, apart) = (limits(true), limits(false));
        for (limit, drawn) in [(ratio.low, draws[25]), (ratio.high, draws[974])] {
            assert!((limit / drawn).ln().abs() < 0.15, "{limit} for {drawn}");
        }
        // What is not shared counts twice: the limits are wider.
        assert!(apart.low < ratio.low && apart.high > ratio.high);
    }
}

#[test]
fn a_list_falls_as_its_objects_do_apart_or_together() {
    let objects = [0.4, 0.5, 0.6].map(block);
    for site in [
        over_pga(),
        Site::new(Hazard::Joint((1..13).map(|k| pair(k.into(), 0.1 * f64::from(k), 1e-3)).collect())),
    ] {
        let rates = objects.each_ref().map(|object| site.rates(object));
        let listed = |number: usize, count: f64, years: f64| {
            let SiteRates { states, budget, .. } = &rates[number];
            let overturning = states.overturning;
            ListedObject { object: &objects[number], count, years, overturning, budget }
        };
        let rate = |number: usize| rates[number].states.overturning.estimate().unwrap();
        // One object alone is what it is by itself; limits of a number lie about a mean.
        let ListProbabilities { at_least_one, expected_number } = site.list(&[listed(0, 1.0, 50.0)]);
        for found in [at_least_one, expected_number].map(|found| found.estimate().unwrap()) {
            let p = rate(0).map(|rate| probability_in_years(rate, 50.0));
            for (found, expected) in [(found.value, p.value), (found.low, p.low), (found.high, p.high)] {
                assert!((found / expected).ln().abs() < 0.05, "{found} for {expected}");
            }
        }
        let all = [listed(0, 1.0, 1e-6), listed(1, 2.0, 1e-6), listed(2, 1.0, 1e-6)];
        let ListProbabilities { at_least_one, expected_number } = site.list(&all);
        let [one, number] = [at_least_one, expected_number].map(|found| found.estimate().unwrap());
        let sum = rate(0).value + 2.0 * rate(1).value + rate(2).value;
        assert!((number.value / (1e-6 * sum) - 1.0).abs() < 1e-4);
        assert!(1e-6 * rate(0).value < one.value && one.value < number.value);
        assert!(number.low < number.value && one.low < one.value && one.value < one.high);
        // Each over its own years: those that are there fall together.
        let falls = |list: &[ListedObject]| -(-site.list(list).at_least_one.value.unwrap()).ln_1p();
        let each = |years: [f64; 3]| [0, 1, 2].map(|number| listed(number, 1.0, years[number]));
        let (all, year) = (each([30.0, 100.0, 10.0]), each([1.0; 3]));
        let expected = 10.0 * falls(&year) + 20.0 * falls(&year[..2]) + 70.0 * falls(&year[1..2]);
        assert!((falls(&all) / expected - 1.0).abs() < 1e-9);
    }
}

#[test]
fn a_change_is_one_thing_and_is_what_it_says() {
    let block = Object::block("a", 0.5, 1.9);
    let object = Object { shape: Shape { depth: Some(0.8), ..block.shape }, ..block };
    let changes = object.changes();
    let [wider, widest] = [&changes[0].object.shape, &changes[1].object.shape];
    close(wider.width.unwrap(), 0.6, 1e-12);
    close(wider.depth.unwrap(), 0.96, 1e-12);
    close(widest.width.unwrap(), 0.75, 1e-12);
    assert_eq!(changes[2].object.shape.centre_height, Some(0.75 * 0.95));
    let median = object.sides().unwrap()[0].structure.eta;
    let loss = |changed: &Changed| match changed.object.shape.eta {
        Some(Restitution::Number(eta)) => Some(((1.0 - eta) / (1.0 - median)).ln()),
        _ => None,
    };
    let losses: Vec<f64> = changes.iter().filter_map(loss).collect();
    assert!((losses[0] - 0.4).abs() < 1e-9 && (losses[1] + 0.4).abs() < 1e-9, "16 and 84 %");
    assert!(changes.iter().all(|changed| changed.object.place.level.is_none()), "it stands on the ground");
    let upstairs = object.at(&Place { period: Some(0.5), level: Some(0.6), ..Place::default() });
    assert!(upstairs.changes().iter().any(|changed| changed.object.place.level.is_none()));
}
