//! Rocking against closed forms and invariances.

use std::f64::consts::{FRAC_PI_2, PI};

use proptest::prelude::*;
use rockfrag_core::motion::Pulse;
use rockfrag_core::motion::measures::peak;
use rockfrag_core::object::{Object, Place, Shape, Side};
use rockfrag_core::rocking::{
    Body, Outcome, Record, RecordError, SolverEvent, Structure, StructureError, TracePoint, trace,
};
use rockfrag_core::units::G_M_S2;

use crate::shared::{close, noise, respond};

fn structure(p: f64, alpha: f64, eta: f64) -> Structure {
    Structure::new("s", p, alpha, eta).unwrap()
}

#[test]
fn free_rocking_has_housners_period_and_decay() {
    // Housner (1963), small angles: T = 4/p acosh(1/(1 - theta0/alpha)), and an impact multiplies the kinetic
    // energy by eta^2.
    let (p, alpha, eta) = (2.0, 0.02, 0.9);
    let s = structure(p, alpha, eta);
    let dt = 0.001;
    // A pulse that ends while the block moves, then free rocking.
    let mut samples = vec![1.5 * s.uplift_acceleration_m_s2(); 301];
    samples.resize(12_300, 0.0);
    let (response, points) = trace(&s, &Record::new(&samples, dt).unwrap(), 0.0);
    assert!(matches!(response.outcome, Outcome::SafeRocking(_)));
    let impacts: Vec<_> = points.iter().filter(|q| q.solver_event == Some(SolverEvent::Impact)).collect();
    let bounce = |pair: &[&TracePoint]| {
        let inside = points.iter().filter(|q| q.time_s > pair[0].time_s && q.time_s < pair[1].time_s);
        let peak = inside.map(|q| q.theta_rad.abs()).fold(0.0, f64::max);
        let ratio = (pair[1].theta_dot_rad_s / pair[0].theta_dot_rad_s).abs();
        (peak, pair[1].time_s - pair[0].time_s, ratio)
    };
    let bounces = impacts.windows(2).take(8).map(bounce).take_while(|(peak, ..)| *peak >= 1e-3 * alpha);
    let bounces: Vec<(f64, f64, f64)> = bounces.collect();
    assert!(bounces.len() >= 5, "{bounces:?}");
    for (peak, duration, ratio) in bounces {
        // Half a period between two impacts.
        close(duration, 2.0 / p * (1.0 / (1.0 - peak / alpha)).acosh(), 2e-3);
        assert!((ratio - eta).abs() < 1e-9, "decay {ratio}");
    }
}

#[test]
fn similar_structures_have_the_same_response() {
    // Orientationless dimensionless groups (Eq. 10, Figure 5): with equal wp/p and PGA/(g tan alpha) the
    // response theta/alpha is equal, up to alpha.
    let pulse = |p: f64, alpha: f64| {
        let tp_s = 2.0 * PI / (5.0 * p);
        let pulse = Pulse { amplitude_m_s: 1.0, tp_s, gamma: 1.9, nu_rad: 0.8 };
        let dt = tp_s / 400.0;
        let shape: Vec<f64> = (0..1000).map(|k| pulse.acceleration_m_s2((k as f64 - 500.0) * dt)).collect();
        let scale = 1.6 * G_M_S2 * alpha.tan() / peak(&shape);
        let samples: Vec<f64> = shape.iter().map(|a| a * scale).collect();
        respond(&structure(p, alpha, 0.92), &samples, dt).outcome.demand().unwrap()
    };
    let master = pulse(1.0, 1e-4);
    let deviation = |alpha: f64| (pulse(2.5, alpha) / master - 1.0).abs();
    let deviations = [0.01, 0.05, 0.1, 0.2, 0.3].map(deviation);
    assert!(deviations[0] < 1e-3, "{deviations:?}");
    assert!(deviations.windows(2).all(|pair| pair[1] > pair[0]), "grows with alpha: {deviations:?}");
    // At equal slenderness the similarity is exact: only time and size change.
    close(pulse(0.7, 0.2), pulse(2.5, 0.2), 1e-9);
}

#[test]
fn what_the_record_leaves_in_motion_is_decided_by_energy() {
    // The same motion with zeros appended must give the result of the closed form.
    let s = structure(1.5, 0.2, 0.9);
    for seed in 1..200 {
        let mut samples = noise(seed, 300);
        samples[299] = 0.0;
        let short = respond(&s, &samples, 0.02).outcome;
        samples.resize(300 + 20_000, 0.0);
        match (short, respond(&s, &samples, 0.02).outcome) {
            (Outcome::SafeRocking(short), Outcome::SafeRocking(long)) => close(short, long, 1e-9),
            (short, long) => assert_eq!(short, long, "seed {seed}"),
        }
    }
}

#[test]
fn structures_are_made_of_their_dimensions() {
    // By hand, with tan(alpha) = 1/4: 2 R = sqrt(17) m, sin2(alpha) = 1/17, cos(2 alpha) = 15/17;
    // p2 = 3 g / (4 R) and eta of Housner (1963), and those of Makris & Vassiliou (2014) for a beam of twice
    // the mass of a column.
    let block = Structure::rectangular_block("b", 1.0, 4.0, None).unwrap();
    for block in [&block, &Body::solid(1.0, 4.0).structure("b", None).unwrap()] {
        close(block.alpha_rad, 0.25_f64.atan(), 1e-14);
        close(block.p_rad_s.powi(2), 3.0 * G_M_S2 / (2.0 * 17.0_f64.sqrt()), 1e-14);
        close(block.eta, 1.0 - 1.5 / 17.0, 1e-14);
        close(block.uplift_acceleration_m_s2(), G_M_S2 / 4.0, 1e-14);
    }
    let frame = Structure::frame("f", 1.0, 4.0, 2.0, None).unwrap();
    close(frame.p_rad_s / block.p_rad_s, (5.0_f64 / 7.0).sqrt(), 1e-14);
    close(frame.eta, (1.0 - 1.5 / 17.0 + 6.0 * 15.0 / 17.0) / 7.0, 1e-14);
    assert_eq!(Structure::rectangular_block("b", 1.0, 4.0, Some(0.5)).unwrap().eta, 0.5);
    assert_eq!(Structure::frame("f", 1.0, 4.0, 2.0, Some(0.5)).unwrap().eta, 0.5);
    assert_eq!(Structure::frame("b", 1.0, 4.0, 0.0, None).unwrap(), block);
}

fn expect(body: Body, [p2, tan_alpha, eta]: [f64; 3]) {
    let found = [body.p_rad_s().powi(2), body.alpha_rad().tan(), body.eta()];
    for (found, expected) in found.into_iter().zip([p2, tan_alpha, eta]) {
        assert!((found - expected).abs() < 1e-6 * expected, "{body:?}: {found}, {expected}");
    }
}

#[test]
fn bodies_have_their_closed_forms() {
    // A cylinder of radius r and height H: I/m about the edge is 5 r^2/4 + H^2/3.
    let (r, h) = (0.25_f64, 1.5_f64);
    let cylinder = Body {
        width_m: 2.0 * r,
        centre_height_m: h / 2.0,
        centre_offset_m: 0.0,
        inertia_m2: (3.0 * r * r + h * h) / 12.0,
    };
    let about_edge = 1.25 * r * r + h * h / 3.0;
    expect(cylinder, [9.81 * r.hypot(h / 2.0) / about_edge, 1.0 / 3.0, 1.0 - 2.0 * r * r / about_edge]);
    // A solid 0.6 x 1.8 m on contacts 0.1 m and 0.3 m from its centre line.
    let inertia_m2 = Body::solid_inertia_m2(0.6, 1.8);
    let off = Body { width_m: 0.4, centre_height_m: 0.9, centre_offset_m: 0.1, inertia_m2 };
    expect(off, [2.8163003_f64.powi(2), 0.1 / 0.9, (0.9642857_f64 * 0.9).sqrt()]);
}

/// Over the volume of boxes, each by its mass (kg), middle and width, bottom and height (m): by Gauss's rule
/// of three points, which is exact.
fn integral(boxes: &[[f64; 5]; 2], of: impl Fn(f64, f64) -> f64) -> f64 {
    let nodes = [(-0.15_f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.15_f64.sqrt(), 5.0 / 18.0)];
    let of_box = |[mass, x, width, z, height]: &[f64; 5]| {
        let at = |(u, by_u): (f64, f64)| {
            nodes.map(|(v, by_v)| mass * by_u * by_v * of(x + u * width, z + (0.5 + v) * height))
        };
        nodes.map(at).iter().flatten().sum::<f64>()
    };
    boxes.iter().map(of_box).sum()
}

#[test]
fn an_object_and_its_pedestal_rock_as_their_volumes_do() {
    // Width, depth, height and mass of both; how far the object stands aside.
    for (upper, lower, aside) in [
        ([0.35, 0.35, 0.57, 80.0], [0.4, 0.4, 1.15, 300.0], 0.0),
        ([0.2, 0.3, 0.62, 8.0], [0.45, 0.35, 0.95, 150.0], 0.0),
        ([0.9, 0.5, 1.6, 620.0], [0.6, 0.55, 0.4, 90.0], 0.02),
        ([0.15, 0.12, 1.2, 30.0], [0.5, 0.4, 0.3, 5.0], -0.05),
        ([0.3, 0.2, 0.5, 1.0], [0.3, 0.2, 0.5, 1.0], 0.0),
    ] {
        let [width, depth, height, mass] = upper.map(Some);
        let [pedestal_width, pedestal_depth, pedestal_height, pedestal_mass] = lower.map(Some);
        let on = |fixed: bool| {
            let shape = Shape { width, depth, height, centre_offset: Some(aside), ..Shape::default() };
            let sizes =
                Place { pedestal_width, pedestal_depth, pedestal_height, pedestal_mass, ..Place::default() };
            let place = Place { mass, fixed_to_pedestal: Some(fixed), ..sizes };
            Object { shape, place, ..Object::default() }
        };
        let directions = [(0, aside), (1, 0.0)].map(|(side, aside): (usize, f64)| {
            let bottom = [lower[3], 0.0, lower[side], 0.0, lower[2]];
            let boxes = [[upper[3], aside.abs(), upper[side], lower[2], upper[2]], bottom];
            let whole = integral(&boxes, |_, _| 1.0);
            let [x, z] = [integral(&boxes, |x, _| x) / whole, integral(&boxes, |_, z| z) / whole];
            let (near, far) = (0.5 * lower[side], -0.5 * lower[side]);
            let about = |a: f64, b: f64| integral(&boxes, |x, z| (x - a) * (x - b) + z * z);
            let eta = about(near, far) / (about(near, near) * about(far, far)).sqrt();
            let p2 = whole * G_M_S2 * (near - x).hypot(z) / about(near, near);
            [p2.sqrt(), ((near - x) / z).atan(), eta]
        });
        let mut expected = directions.to_vec();
        expected.sort_by(|a, b| a[1].total_cmp(&b[1]));
        let found = on(true).on_pedestal().sides().unwrap();
        for (Side { structure, .. }, expected) in found.iter().zip(expected) {
            let found = [structure.p_rad_s, structure.alpha_rad, structure.eta];
            found.into_iter().zip(expected).for_each(|(found, expected)| close(found, expected, 1e-9));
        }
        // Loose, it is itself, where it uplifts first.
        let loose = on(false).on_pedestal();
        let alone = [upper[0] - 2.0 * aside.abs(), upper[1]].map(|side| (side / upper[2]).atan());
        let uplifts_first = directions.iter().zip(alone).all(|(whole, alone)| whole[1] >= alone);
        assert_eq!(loose.refused.is_none().then(|| loose.sides()), uplifts_first.then(|| on(false).sides()));
    }
}

#[test]
fn impossible_structures_are_refused() {
    let wrong = |made: Result<Structure, StructureError>| made.unwrap_err().parameter;
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(wrong(Structure::rectangular_block("b", bad, 4.0, None)), "width");
        assert_eq!(wrong(Structure::rectangular_block("b", 1.0, bad, None)), "height");
        assert_eq!(wrong(Structure::frame("f", bad, 4.0, 1.0, None)), "width");
        assert_eq!(wrong(Structure::frame("f", 1.0, 4.0, bad, None)), "beam-mass-ratio");
    }
    for (p, alpha, eta, named) in [
        (0.0, 0.2, 0.9, "p"),
        (f64::NAN, 0.2, 0.9, "p"),
        (1.0, FRAC_PI_2, 0.9, "alpha"),
        (1.0, -0.1, 0.9, "alpha"),
        (1.0, 0.2, 1.01, "eta"),
        (1.0, 0.2, 0.0, "eta"),
    ] {
        assert_eq!(wrong(Structure::new("s", p, alpha, eta)), named);
    }
    // An impact would stop it.
    let flat = Body { width_m: 1.0, centre_height_m: 0.2, centre_offset_m: 0.0, inertia_m2: 0.09 };
    assert!(wrong(flat.structure("flat", None)) == "eta" && flat.structure("flat", Some(0.8)).is_ok());
}

#[test]
fn impossible_records_are_refused_where_they_are_wrong() {
    for (samples, dt, error) in [
        (&[0.0, 1.0][..], 0.0, RecordError::TimeStep(0.0)),
        (&[1.0], 0.01, RecordError::TooShort(1)),
        (&[0.0, -f64::INFINITY, f64::NAN], 0.01, RecordError::NotFinite { sample: 1, value: -f64::INFINITY }),
        (&[0.0, 1e4, 1.0, -1.5e4, 2e4], 0.01, RecordError::TooLarge { sample: 3, value: -1.5e4 }),
    ] {
        assert_eq!(Record::new(samples, dt).unwrap_err(), error);
    }
    assert_eq!(Record::new(&[0.0, -1e4], 0.01).unwrap().peak_m_s2(), 1e4);
}

#[test]
fn a_trace_tells_what_happens_when() {
    // Uplift (Eq. 5): under a push to the positive side the structure rocks to the negative side, from the
    // root of |a| = g tan(alpha), here half way to the first sample.
    let (alpha, eta, dt) = (0.2, 0.6, 0.01);
    let s = structure(2.5, alpha, eta);
    let mut samples = vec![0.0];
    samples.resize(12, 2.0 * s.uplift_acceleration_m_s2());
    samples.resize(1200, 0.0);
    let (response, points) = trace(&s, &Record::new(&samples, dt).unwrap(), 0.0);
    let Outcome::SafeRocking(demand) = response.outcome else { panic!("{response:?}") };
    let of = |event| points.iter().filter(move |point| point.solver_event == Some(event));
    let first = of(SolverEvent::Uplift).next().unwrap();
    assert!((first.time_s - 0.5 * dt).abs() < 1e-12);
    assert_eq!((first.theta_rad, first.theta_dot_rad_s), (0.0, 0.0));
    let sampled: Vec<_> = points.iter().filter(|point| point.solver_event.is_none()).collect();
    assert_eq!(sampled.len(), samples.len());
    assert!((0..).zip(&sampled).all(|(k, point)| (point.time_s - f64::from(k) * dt).abs() < 1e-9));
    assert!(sampled[5].theta_rad < 0.0 && sampled[5].theta_dot_rad_s < 0.0);
    let largest = points.iter().map(|point| point.theta_rad.abs()).fold(0.0, f64::max);
    assert!(largest <= demand * alpha && largest > 0.999 * demand * alpha);

    // An impact multiplies the velocity by eta, on the other side; after the last one the structure rests.
    assert_eq!(of(SolverEvent::Impact).count(), response.impacts as usize);
    for around in points.windows(3).filter(|around| around[1].solver_event == Some(SolverEvent::Impact)) {
        let [before, impact, after] = [around[0], around[1], around[2]];
        if before.solver_event.is_none() && after.solver_event.is_none() && before.theta_rad.abs() > 1e-3 {
            assert!(before.theta_rad * after.theta_rad < 0.0, "{around:?}");
            assert!(impact.theta_dot_rad_s * after.theta_rad > 0.0, "{around:?}");
        }
    }
    let (rest, impact) =
        (of(SolverEvent::Rest).next_back().unwrap(), of(SolverEvent::Impact).next_back().unwrap());
    assert_eq!((rest.time_s, rest.theta_rad, rest.theta_dot_rad_s), (impact.time_s, 0.0, 0.0));
    let mut after = sampled.iter().skip_while(|point| point.time_s <= rest.time_s).peekable();
    assert!(after.peek().is_some());
    assert!(after.all(|point| point.theta_rad == 0.0 && point.theta_dot_rad_s == 0.0));
    let (fallen, points) = trace(&s, &Record::new(&[20.0; 400], dt).unwrap(), 0.0);
    let angle = points.last().unwrap().theta_rad.abs();
    assert!(fallen.outcome == Outcome::Overturned && (angle - FRAC_PI_2).abs() < 1e-9, "{angle}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn mirrored_motions_have_mirrored_responses(
        seed in 1u64..10_000,
        p in 0.5..4.0f64,
        alpha in 0.05..0.35f64,
    ) {
        let s = structure(p, alpha, 0.92);
        let samples = noise(seed, 200);
        let mirrored: Vec<f64> = samples.iter().map(|a| -a).collect();
        prop_assert_eq!(respond(&s, &samples, 0.02), respond(&s, &mirrored, 0.02));
        let [(_, here), (_, there)] =
            [&samples, &mirrored].map(|samples| trace(&s, &Record::new(samples, 0.02).unwrap(), 0.0));
        prop_assert!(here.iter().zip(&there).all(|(a, b)| a.theta_rad == -b.theta_rad));
    }
}
