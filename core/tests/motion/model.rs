//! Synthetic motions (sections 2.1.2 and 2.1.3) against numpy, closed forms, values of regression.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};

use proptest::prelude::*;
use realfft::RealFftPlanner;
use realfft::num_complex::Complex64;
use rockfrag_core::motion::amplification::SiteTableError;
use rockfrag_core::motion::pulse::largest_velocity;
use rockfrag_core::motion::stochastic::{PEAK_SHARE, Source, StochasticModel, Window, constant};
use rockfrag_core::motion::{
    Design, Difference, Epoch, MeasurePlan, MotionModel, Pulse, Scenario, ScenarioGrid, SiteAmplification,
    Suite, Synthesizer, SyntheticMotion, measures,
};
use strum::VariantArray;

use crate::shared::close;

/// Scenarios of one magnitude and distance.
fn cell(mw: f64, re_km: f64, samples: usize, seed: u64) -> Vec<Scenario> {
    ScenarioGrid { mw: vec![mw], re_km: vec![re_km], samples, design: Design::Lhs, seed }.scenarios_of_cell(0)
}

#[test]
fn a_latin_hypercube_has_a_sample_in_each_stratum() {
    // Independent samples miss a stratum with probability 1/e; the share hit has a deviation of 0.0097.
    for (design, expected, tolerance) in
        [(Design::Lhs, 1.0, 1e-9), (Design::Random, 1.0 - (-1.0_f64).exp(), 0.05)]
    {
        let grid = ScenarioGrid { mw: vec![6.0, 7.0], re_km: vec![5.0], samples: 1024, design, seed: 42 };
        let cell = grid.cell(1);
        let points: Vec<_> = (0..grid.samples).map(|sample| cell.quantiles(sample)).collect();
        assert!(points.iter().flatten().all(|u| *u > 0.0 && *u < 1.0));
        for dimension in 0..4 {
            let mut hit = [false; 1024];
            points.iter().for_each(|point| hit[(point[dimension] * 1024.0) as usize] = true);
            let share = hit.iter().filter(|hit| **hit).count() as f64 / 1024.0;
            assert!((share - expected).abs() < tolerance, "{design:?}: {share}");
        }
    }
}

/// Small and large earthquakes: pulses much shorter and much longer than the window.
fn varied_scenarios() -> Vec<Scenario> {
    let (mw, re_km) = (vec![5.5, 6.5, 7.5], vec![5.0, 20.0]);
    let grid = ScenarioGrid { mw, re_km, samples: 12, design: Design::Lhs, seed: 42 };
    (0..grid.cells()).flat_map(|cell| grid.scenarios_of_cell(cell)).collect()
}

fn synthesize(model: &MotionModel, scenarios: &[Scenario]) -> Vec<SyntheticMotion> {
    let mut synthesizer = Synthesizer::new(model.clone(), Suite::VARIANTS);
    scenarios.iter().map(|scenario| synthesizer.synthesize(scenario)).collect()
}

/// Crust, window and kappa of Boore (2003) and Atkinson & Silva (2000), which published values are of.
fn published_model() -> StochasticModel {
    StochasticModel {
        shear_velocity_km_s: 3.5,
        window: 2.0,
        kappa_s: 0.030,
        fmax_hz: f64::INFINITY,
        ..StochasticModel::default()
    }
}

/// Fourier coefficients of an acceleration, by the discrete transform.
fn spectrum(samples: &[f64]) -> Vec<Complex64> {
    let fft = RealFftPlanner::<f64>::new().plan_fft_forward(samples.len());
    let mut spectrum = fft.make_output_vec();
    fft.process(&mut samples.to_vec(), &mut spectrum).unwrap();
    spectrum
}

#[test]
fn the_largest_velocity_of_a_pulse_is_that_by_numpy() {
    for (gamma, expected) in [(1.0, 0.6495), (1.5, 0.7939), (1.93, 0.8616), (3.0, 0.9365)] {
        let f = largest_velocity(gamma, FRAC_PI_2);
        assert!((f - expected).abs() < 5e-5, "gamma = {gamma}: {f}");
        close(largest_velocity(gamma, 0.0), 1.0, 1e-12);
    }
    // The largest (1 + cos x) sin x / 2, in closed form.
    close(largest_velocity(1.0, FRAC_PI_2), 3.0 * 3f64.sqrt() / 8.0, 1e-14);
}

#[test]
fn the_source_has_the_constant_duration_and_amplitudes_of_its_equations_by_numpy() {
    close(constant(3.5), 5.155914e-24, 1e-7);
    // M 6.5 at 10 km: fa 0.09057 Hz and R 13.069 km by hand.
    assert!((Source::new(6.5, 10.0).duration_s() - (0.5 / 0.09057 + 0.05 * 13.069)).abs() < 1e-3);
    let model = published_model();
    for (mw, expected) in [
        (5.5, [0.3425, 8.4266, 12.363]),
        (6.5, [5.2749, 40.2875, 30.7246]),
        (7.5, [32.2084, 113.6216, 70.0324]),
    ] {
        for (f, expected) in [0.1, 1.0, 10.0].into_iter().zip(expected) {
            let amplitude = model.fourier_amplitude_cm_s(&Source::new(mw, 10.0), f);
            // Half a unit of the last digit: the fourth decimal, but the third of 12.363.
            let half_unit = if expected == 12.363 { 5e-4 } else { 5e-5 };
            assert!((amplitude - expected).abs() < 1.01 * half_unit, "M {mw}, {f} Hz: {amplitude}");
        }
    }
}

#[test]
fn amplitudes_fall_with_distance_and_filters_as_their_equations_say() {
    let near = published_model();
    // Spreading is 1/R up to 40 km and 1/sqrt(40 R) beyond: at 0.01 Hz only Q depends on the distance
    // besides.
    let spread = |re_km: f64| {
        let source = Source::new(6.0, re_km);
        let attenuation = PI * source.distance_km * 0.01_f64.powf(0.55) / (180.0 * 3.5);
        let amplitude = near.fourier_amplitude_cm_s(&source, 0.01) * attenuation.exp();
        (source.distance_km, amplitude)
    };
    let ((r1, a1), (r2, a2), (r3, a3)) = (spread(10.0), spread(30.0), spread(160.0));
    assert!((a1 * r1 / (a2 * r2) - 1.0).abs() < 1e-12);
    assert!((a1 * r1 / (a3 * (40.0 * r3).sqrt()) - 1.0).abs() < 1e-12);
    let source = Source::new(6.0, 10.0);
    let fmax = StochasticModel { fmax_hz: 15.0, ..near.clone() };
    let low_cut = StochasticModel { low_cut_hz: Some(0.1), ..near.clone() };
    for (model, f, expected) in [
        (&fmax, 15.0, FRAC_1_SQRT_2),
        (&fmax, 30.0, 1.0 / 257f64.sqrt()),
        (&low_cut, 0.1, 0.5),
        (&low_cut, 0.05, 1.0 / 257.0),
        (&StochasticModel { kappa_s: 0.040, ..near.clone() }, 10.0, (-0.1 * PI).exp()),
        (&StochasticModel { site: SiteAmplification::soil(), ..near.clone() }, 1.25, 2.76 / 1.74),
    ] {
        let ratio = model.fourier_amplitude_cm_s(&source, f) / near.fourier_amplitude_cm_s(&source, f);
        assert!((ratio - expected).abs() < 1e-14, "{f} Hz: {ratio}");
    }
}

#[test]
fn the_window_has_its_constants_by_numpy_and_its_peak_of_one_at_a_fifth() {
    let window = Window::new(6.0);
    assert_eq!(window.duration_s, 6.0);
    for (value, expected) in [(window.b, 1.2531497), (window.c, 6.2657487), (window.a, 26.3117724)] {
        assert!((value - expected).abs() < 5.1e-8, "{value}");
    }
    let peak_s = 0.2 * 6.0;
    assert!((window.value(peak_s) - 1.0).abs() < 1e-12);
    assert!(window.value(peak_s - 1e-3) < 1.0 && window.value(peak_s + 1e-3) < 1.0);
    assert!((window.value(6.0) - 0.05).abs() < 1e-12);
    assert_eq!((window.value(-1.0), window.value(0.0), window.value(6.1)), (0.0, 0.0, 0.0));
}

#[test]
fn two_hundred_motions_have_the_amplitude_of_the_model_in_every_band() {
    let model = MotionModel::default();
    let source = Source::new(6.5, 10.0);
    // The last band has all frequencies. A band has 200 motions x its width x 5 s independent values: a
    // standard error of 1.3 % in the first.
    let bands = [(0.5, 2.0), (2.0, 5.0), (5.0, 10.0), (10.0, 20.0), (0.5, 20.0)];
    let mut sums = [(0.0, 0.0); 5];
    for motion in synthesize(&model, &cell(6.5, 10.0, 200, 3)) {
        let step_hz = 1.0 / (motion.high_frequency.len() as f64 * motion.dt_s);
        for (k, coefficient) in spectrum(&motion.high_frequency).iter().enumerate() {
            let f = k as f64 * step_hz;
            for (sum, _) in sums.iter_mut().zip(&bands).filter(|(_, band)| (band.0..band.1).contains(&f)) {
                let amplitude = coefficient.norm() * motion.dt_s * 100.0;
                sum.0 += (amplitude / model.stochastic.fourier_amplitude_cm_s(&source, f)).powi(2);
                sum.1 += 1.0;
            }
        }
    }
    for (band, (sum, count)) in bands.iter().zip(sums) {
        let rms = f64::sqrt(sum / count);
        assert!((rms - 1.0).abs() < 0.02, "{band:?} Hz: {rms}");
    }
}

#[test]
fn each_difference_leaves_its_own_amplitude_and_the_phase_of_the_high_frequencies() {
    let scenarios = [cell(5.5, 5.0, 5, 1), cell(6.5, 5.0, 5, 1), cell(7.5, 20.0, 5, 1)].concat();
    for difference in Difference::VARIANTS.iter().copied() {
        let motions = synthesize(&MotionModel { difference, ..MotionModel::default() }, &scenarios);
        for (motion, scenario) in motions.iter().zip(&scenarios) {
            let [h, p, c] = [&motion.high_frequency, &motion.pulse, &motion.combined].map(|a| spectrum(a));
            // Shares of the energy that are not as expected, and would not be with the other difference.
            let mut misfit = [0.0; 2];
            for k in 1..h.len() - 1 {
                let f = k as f64 / (motion.pulse.len() as f64 * motion.dt_s);
                // Fourier transform of a raised cosine as long as the pulse.
                let x = f * Pulse::of(scenario).duration_s();
                let faster = 1.0 - (PI * x).sin() / (PI * x * (1.0 - x * x));
                let d = (h[k].norm() - p[k].norm()).max(0.0);
                let kept = if difference == Difference::None { [h[k].norm(), d] } else { [d, h[k].norm()] };
                for (misfit, kept) in misfit.iter_mut().zip(kept) {
                    *misfit += (c[k] - p[k] - Complex64::from_polar(faster * kept, h[k].arg())).norm_sqr();
                }
            }
            let [this, other] = misfit.map(|sum| (sum / c.iter().map(|x| x.norm_sqr()).sum::<f64>()).sqrt());
            // What is left of the filters in the margins is tapered.
            assert!(this < 0.02 && other > 3.0 * this, "{difference:?} {scenario:?}: {this}, {other}");
        }
    }
}

#[test]
fn every_motion_begins_and_ends_at_rest_and_moves_the_ground_as_far_as_its_pulse() {
    let (mw, re_km) = ((0..5).map(|k| 5.5 + 0.5 * f64::from(k)).collect(), vec![5.0, 20.0]);
    let grid = ScenarioGrid { mw, re_km, samples: 100, design: Design::Lhs, seed: 42 };
    let scenarios: Vec<Scenario> = (0..grid.cells()).flat_map(|cell| grid.scenarios_of_cell(cell)).collect();
    assert_eq!(scenarios.len(), 1000);
    for (difference, stochastic) in Difference::VARIANTS.iter().flat_map(|difference| {
        [StochasticModel::default(), published_model()].map(|stochastic| (*difference, stochastic))
    }) {
        let model = MotionModel { difference, stochastic, ..MotionModel::default() };
        let mut further = 0;
        for motion in synthesize(&model, &scenarios) {
            let half_second = (0.5 / motion.dt_s) as usize;
            for suite in [Suite::Pulse, Suite::Hfc, Suite::Csgm] {
                let acceleration = motion.samples(suite);
                let velocity = measures::velocity(acceleration, motion.dt_s);
                for (series, quiet) in [(acceleration, 1e-3), (&velocity[..], 0.01)] {
                    let ends = [&series[..half_second], &series[series.len() - half_second..]];
                    let largest = ends.map(measures::peak)[..].iter().copied().fold(0.0, f64::max);
                    assert!(largest < quiet * measures::peak(series), "{suite} {difference}: {largest}");
                }
            }
            let [pulse, combined] = [&motion.pulse, &motion.combined]
                .map(|acceleration| MeasurePlan::default().measure(acceleration, motion.dt_s).pgd_m);
            further += usize::from(combined > 2.0 * pulse);
        }
        // Pulses much weaker than usual beside the high frequencies of M 7 and 7.5.
        assert!(further <= 5, "{difference}: {further}");
    }
}

#[test]
fn the_pulse_is_whole_at_its_epoch_which_is_where_the_option_says() {
    let scenarios = varied_scenarios();
    let of = |epoch: Epoch| {
        let motions = synthesize(&MotionModel { epoch, ..MotionModel::default() }, &scenarios);
        scenarios.iter().zip(motions).map(move |of| (epoch, of))
    };
    for (epoch, (scenario, motion)) in Epoch::VARIANTS.iter().copied().flat_map(of) {
        let pulse = Pulse::of(scenario);
        let (half, end_s) = (0.5 * pulse.duration_s(), motion.pulse.len() as f64 * motion.dt_s);
        assert!(motion.epoch_s > half + 1.0 && end_s > motion.epoch_s + half + 1.0, "{epoch:?} {scenario:?}");
        assert_eq!((motion.pulse[0], *motion.pulse.last().unwrap()), (0.0, 0.0));
        for (k, a) in motion.pulse.iter().enumerate() {
            let from_epoch_s = k as f64 * motion.dt_s - motion.epoch_s;
            // Times of about 20 s, multiplied by wp, have rounding errors of their own.
            let largest = pulse.amplitude_m_s * 2.0 * PI / pulse.tp_s;
            assert!((a - pulse.acceleration_m_s2(from_epoch_s)).abs() < 1e-12 * largest);
            assert!(*a == 0.0 || from_epoch_s.abs() <= half + 1e-9);
        }
        let velocity = measures::velocity(&motion.pulse, motion.dt_s);
        let pgv = measures::peak(&velocity);
        // The highest frequency w of the pulse is wp (1 + 1/gamma). The relative error of a peak between
        // samples is at most (w dt)^2 / 8, that of trapezoids (w dt)^2 / 12.
        let x = 2.0 * PI / scenario.tp_s * (1.0 + 1.0 / scenario.gamma) * motion.dt_s;
        let sampling = x * x * (1.0 / 8.0 + 1.0 / 12.0);
        assert!((pgv / scenario.vp_m_s - 1.0).abs() < sampling, "{epoch:?} {scenario:?}: {pgv}");
        assert!(velocity.last().unwrap().abs() < sampling * scenario.vp_m_s);
        let combined = measures::velocity(&motion.combined, motion.dt_s);
        assert!(combined.last().unwrap().abs() < 1e-9 * scenario.vp_m_s, "no velocity is left");

        let duration_s = Source::new(scenario.mw, scenario.re_km).duration_s();
        let at = |series: &[f64]| {
            let peak = measures::peak(series);
            series.iter().position(|a| a.abs() == peak).unwrap() as f64 * motion.dt_s
        };
        let peak_s = PEAK_SHARE * StochasticModel::default().window * duration_s;
        // The margin before the pulse or the window, whichever begins first; the window begins at a sample.
        let expected = match epoch {
            Epoch::EnvelopePeak => {
                let onset = (f64::max(2.0, 0.5 * duration_s) + (half - peak_s).max(0.0)) / motion.dt_s;
                onset.ceil() * motion.dt_s + peak_s
            }
            Epoch::Pga => at(&motion.high_frequency),
            Epoch::Pgv => at(&measures::velocity(&motion.high_frequency, motion.dt_s)),
        };
        assert!((motion.epoch_s - expected).abs() < 1e-9, "{epoch:?} {scenario:?}: {}", motion.epoch_s);
    }
}

#[test]
fn a_motion_is_the_same_whatever_else_is_made() {
    for epoch in Epoch::VARIANTS.iter().copied() {
        let model = MotionModel { epoch, ..MotionModel::default() };
        let scenarios = varied_scenarios();
        let together = synthesize(&model, &scenarios);
        for suite in Suite::VARIANTS.iter().copied() {
            let mut one = Synthesizer::new(model.clone(), &[suite]);
            for (scenario, motion) in scenarios.iter().zip(&together).rev().step_by(11) {
                let alone = one.synthesize(scenario);
                assert!(alone.samples(suite) == motion.samples(suite), "{epoch:?} {suite:?}");
            }
        }
    }
    // Its noise is of its seed and scenario.
    let of = |seed: u64, scenario_id: i64| {
        let scenario = Scenario { scenario_id, ..cell(6.5, 5.0, 1, 1)[0] };
        synthesize(&MotionModel { seed, ..MotionModel::default() }, &[scenario]).remove(0)
    };
    let one = of(1, 0);
    for other in [of(2, 0), of(1, 1)] {
        assert!(one.high_frequency != other.high_frequency && one.pulse == other.pulse);
    }
}

#[test]
fn sites_keep_their_amplification() {
    for (f, rock, soil) in
        [(0.0, 1.0, 1.0), (0.51, 1.42, 2.24), (6.05, 2.58, 3.05), (61.2, 4.0, 3.21), (100.0, 4.0, 3.21)]
    {
        let both = [SiteAmplification::rock(), SiteAmplification::soil()].map(|site| site.amplification(f));
        assert_eq!(both, [rock, soil], "{f} Hz");
    }
    assert_eq!(SiteAmplification::none().amplification(3.0), 1.0);
}

#[test]
fn a_site_table_interpolates_between_its_rows_or_says_which_cannot_be_used() {
    let site = SiteAmplification::table(vec![(1.0, 2.0), (3.0, 8.0)]).unwrap();
    for (f, expected) in [(0.0, 2.0), (1.0, 2.0), (2.0, 4.0), (3.0, 8.0), (50.0, 8.0)] {
        close(site.amplification(f), expected, 1e-14);
    }
    assert_eq!(SiteAmplification::table(vec![(1.0, 2.0)]), Err(SiteTableError { row: 1 }));
    for (rows, bad) in [
        (vec![(1.0, 2.0), (1.0, 3.0)], 1),
        (vec![(0.0, 2.0), (1.0, 3.0)], 0),
        (vec![(1.0, 1.0), (2.0, 1.0), (3.0, -1.0)], 2),
        (vec![(f64::NAN, 1.0), (2.0, 1.0)], 0),
        (vec![(1.0, f64::INFINITY), (2.0, 1.0)], 0),
    ] {
        let error = SiteAmplification::table(rows.clone()).unwrap_err();
        assert!(matches!(error, SiteTableError { row } if row == bad), "{rows:?}: {error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn a_pulse_has_its_amplitude_and_its_acceleration_is_the_slope(
        vp in 0.1..3.0f64, tp in 0.3..8.0f64, gamma in 1.0..4.0f64, nu in -3.0..6.0f64,
    ) {
        let scenario = Scenario { vp_m_s: vp, tp_s: tp, gamma, nu_rad: nu, ..cell(6.0, 5.0, 1, 1)[0] };
        let pulse = Pulse::of(&scenario);
        prop_assert!((pulse.duration_s() - gamma * tp).abs() < 1e-14);
        let half = 0.5 * pulse.duration_s();
        let times: Vec<f64> = (0..=20_000).map(|k| half * (k as f64 / 10_000.0 - 1.0)).collect();
        let largest = times.iter().map(|&t| pulse.velocity_m_s(t).abs()).fold(0.0, f64::max);
        prop_assert!(largest <= vp * (1.0 + 1e-12) && largest > vp * (1.0 - 1e-5), "{largest} for {vp}");
        let (h, wp) = (1e-5 * tp, 2.0 * PI / tp);
        for t in [-0.7 * half, -0.2 * half, 0.1 * half, 0.8 * half] {
            let slope = (pulse.velocity_m_s(t + h) - pulse.velocity_m_s(t - h)) / (2.0 * h);
            prop_assert!((pulse.acceleration_m_s2(t) - slope).abs() < 1e-7 * vp * wp);
        }
        for side in [-1.0, 1.0] {
            // The acceleration rises from 0 with the distance from the end, the velocity with its square.
            let inside = side * half * (1.0 - 1e-6);
            prop_assert!(pulse.acceleration_m_s2(inside).abs() < 1e-4 * vp * wp);
            prop_assert!(pulse.velocity_m_s(inside).abs() < 1e-9 * vp);
            prop_assert_eq!(pulse.acceleration_m_s2(side * half * 1.0001), 0.0);
            prop_assert_eq!(pulse.velocity_m_s(side * half * 1.0001), 0.0);
        }
    }

}
