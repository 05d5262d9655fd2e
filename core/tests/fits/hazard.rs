//! Annual rates against closed forms.

use std::sync::Arc;

use rockfrag_core::fragility::{
    Event, GivenPeak, Measure, Model, MotionKind, Peak, RatioGiven, RockingDirection, fit_curve,
    p_overturning,
};
use rockfrag_core::hazard::{
    Budget, GenericSites, Hazard, HazardCurve, HazardError, MatchError, PeakHazard, PgvPgaRatio, Site,
    VelocitySource, exceedance, rates_over_curve, velocity_of_spectrum,
};
use rockfrag_core::object::{LowHigh, Object, RockingObject, UncertaintySource};
use rockfrag_core::rocking::Structure;
use rockfrag_core::statistics::normal;
use rockfrag_core::statistics::normal::Z_95;
use rockfrag_core::warning::Warning;

use crate::common::{Row, cases, close, equipment, pair, read};

/// H = k0 IM^-k at `n` intensities from 1e-4 to 1e4.
fn power_law(k0: f64, k: f64, n: usize) -> HazardCurve {
    let im = |i: usize| 10f64.powf(-4.0 + 8.0 * i as f64 / (n - 1) as f64);
    HazardCurve::new((0..n).map(|i| (im(i), k0 * im(i).powf(-k))).collect()).unwrap()
}

#[test]
fn a_power_law_has_a_rate_of_a_lognormal_and_of_a_jump_in_closed_form() {
    // H(theta) exp(k^2 beta^2 / 2), and H(theta), whatever the points of the curve.
    for (k, theta, beta, n) in
        [(1.0, 0.3, 0.4, 2), (2.5, 1.0, 0.2, 17), (3.0, 0.7, 0.08, 301), (2.0, 0.5, 0.3, 20_001)]
    {
        let curve = power_law(1e-3, k, n);
        let rate = curve.mean_annual_rate(&[theta], 0.02, |im| p_overturning(im, f64::ln(theta), beta));
        let jump = curve.mean_annual_rate(&[theta], 0.02, |im| f64::from(u8::from(im >= theta)));
        close(jump, 1e-3 * theta.powf(-k), 1e-9);
        close(rate, jump * (0.5 * k * k * beta * beta).exp(), 1e-9);
    }
}

#[test]
fn a_joint_hazard_has_a_curve_of_each_peak() {
    let rows = [(2.0, 0.3, 0.125), (1.0, 0.3, 0.5), (2.0, 0.1, 0.25), (4.0, 0.2, 0.0625)];
    let bins = rows.map(|(pga, pgv, annual_rate)| pair(pga, pgv, annual_rate));
    assert_eq!(exceedance(&bins, |bin| bin.peaks.pga_m_s2), [(1.0, 0.9375), (2.0, 0.4375), (4.0, 0.0625)]);
    assert_eq!(exceedance(&bins, |bin| bin.peaks.pgv_m_s), [(0.1, 0.9375), (0.2, 0.6875), (0.3, 0.625)]);
}

#[test]
fn what_is_no_hazard_curve_is_refused() {
    let curve = |points: &[(f64, f64)]| HazardCurve::new(points.to_vec()).unwrap_err();
    assert_eq!(curve(&[(0.1, 0.1)]), HazardError::TooFewPoints(1));
    assert_eq!(curve(&[(0.1, 0.1), (0.1, 0.05)]), HazardError::Unordered { point: 1 });
    assert_eq!(curve(&[(0.1, 0.1), (0.2, 0.2)]), HazardError::Unordered { point: 1 });
    assert!(matches!(curve(&[(0.1, 0.1), (0.2, 0.0)]), HazardError::NotPositive { point: 1, .. }));
    assert!(matches!(curve(&[(0.0, 0.1), (0.2, 0.05)]), HazardError::NotPositive { point: 0, .. }));
}

const B: [f64; 3] = [-15.0, 1.2, 1.6];

/// P_ro = Phi(B[0] + B[1] ln IM4 + B[2] ln IM5), with the paper's model of a block that hardly needs to
/// uplift.
fn lognormal_over_both_peaks() -> RockingDirection {
    let mut overturning = fit_curve(&cases([]), Event::Overturning, Measure::Im4, Some(Measure::Im5));
    (overturning.coefficients, overturning.covariance) = (B.to_vec(), vec![0.0; 9]);
    let peaks = Model::uncalibrated(MotionKind::Csgm, &equipment(), 0.1).peaks();
    let model = Model::Paper { demand: vec![], overturning, limit_state: 0.1, peaks };
    let structure = Structure::new("slender", 1.0, 1e-3, 0.9).unwrap();
    RockingDirection { structure, model: Arc::new(model), count: None }
}

/// The rate of Phi(c + d ln IM) over k0 IM^-k.
fn rate_in_closed_form(k0: f64, k: f64, c: f64, d: f64) -> f64 {
    k0 * (k * c / d).exp() * (0.5 * (k / d).powi(2)).exp()
}

#[test]
fn a_power_law_and_a_bivariate_lognormal_have_a_rate_in_closed_form() {
    let directions = [lognormal_over_both_peaks()];
    let ln_uplift = directions[0].structure.uplift_acceleration_m_s2().ln();
    let (k0, k) = (1e-3, 2.2);
    for (level, slope, sd, n) in [(-2.9, 0.1, 0.5, 9), (-2.5, -0.2, 0.3, 20_001), (-3.0, 0.0, 0.0, 9)] {
        let (curve, ratio) = (power_law(k0, k, n), RatioGiven::line(level, slope, sd));
        // ln PGV = level + (1 + slope) ln PGA + sd z, and the other way.
        let of_constant = B[0] - (B[1] + B[2]) * ln_uplift;
        for (peak, constant, per_ln, per_z) in [
            (Peak::Pga, of_constant + B[2] * level, B[1] + B[2] * (1.0 + slope), B[2] * sd),
            (Peak::Pgv, of_constant - B[1] * level, B[1] * (1.0 - slope) + B[2], B[1] * sd),
        ] {
            let wider = 1.0_f64.hypot(per_z);
            let given = GivenPeak::new(&directions, peak, ratio, None);
            let rate = rates_over_curve(&given, &curve).overturning.unwrap().value;
            close(rate, rate_in_closed_form(k0, k, constant / wider, per_ln / wider), 1e-6);
        }
    }
}

#[test]
fn a_joint_hazard_of_lognormal_velocities_has_a_rate_in_closed_form() {
    // With ln PGV normal (m, s), Phi(c + d ln PGV) has the mean Phi((c + d m) / sqrt(1 + d^2 s^2)).
    let slender = lognormal_over_both_peaks();
    let (pga_m_s2, m, s, n) = (5.0, 0.4, 0.5, 4000);
    let ln_pgv = |k: usize| m + s * normal::quantile((k as f64 + 0.5) / n as f64);
    let bin = |k| pair(pga_m_s2, ln_pgv(k).exp(), 0.02 / n as f64);
    let ln_uplift = slender.structure.uplift_acceleration_m_s2().ln();
    let z = B[0] + B[1] * (pga_m_s2.ln() - ln_uplift) + B[2] * (m - ln_uplift);
    let expected = 0.02 * normal::cdf(z / 1.0_f64.hypot(B[2] * s));
    let object = RockingObject { directions: vec![slender], perturbations: vec![] };
    let rate = Site::new(Hazard::Joint((0..n).map(bin).collect())).overturning(&object).unwrap();
    close(rate, expected, 1e-4);
}

#[test]
fn an_error_of_velocity_moves_a_rate_as_in_closed_form() {
    // ln rate rises by k b2 / d for each unit of ln(PGV / PGA), d = b1 + b2 (1 + slope).
    let k = 2.2;
    let pga = power_law(1e-3, k, 9);
    let (slope, sd) = (0.1, 0.45);
    let pgv = curve_of_velocity(k, -2.9, slope, sd);
    let velocity = PgvPgaRatio::by_curves(&pga, &pgv, VelocitySource::Sa).unwrap();
    let fractiles = Some([power_law(1e-3 / 1.5, k, 9), power_law(1e-3 * 1.5, k, 9)]);
    let hazard =
        PeakHazard { peak: Peak::Pga, curve: pga, warnings: vec![], fractiles, pgv_pga: Some(velocity) };
    let object = RockingObject { directions: vec![lognormal_over_both_peaks()], perturbations: vec![] };
    let rates = Site::new(Hazard::Curve(hazard)).rates(&object);
    let budget = rates.budget;
    let expected = k * B[2] / (B[1] + B[2] * (1.0 + slope)) * velocity.at_quantiles().high / Z_95;
    close(budget.source_sd(UncertaintySource::Velocity).unwrap(), expected, 1e-5);
    assert!((budget.source_sd(UncertaintySource::Hazard).unwrap() - 1.5_f64.ln()).abs() < 1e-9);
    assert_eq!(budget.source_sd(UncertaintySource::Magnitude), None);
    let rate = rates.states.overturning.estimate().unwrap();
    assert!(((rate.value / rate.low).ln() - 1.959_964 * budget.sds()[0]).abs() < 1e-6);
    assert!(rate.high > rate.value);
}

#[test]
fn pgv_of_sites_falls_with_vs30_as_by_ground_motion_models() {
    let model = Model::uncalibrated(MotionKind::Recorded, &equipment(), 0.1);
    let unknown = PgvPgaRatio::by_model(&model, Peak::Pga, None).at_quantiles().high;
    for (vs30, mw, ln_ratio) in read::<(f64, f64, f64)>("site_levels.csv") {
        let velocity = PgvPgaRatio::by_model(&model, Peak::Pga, Some(vs30));
        let ours = velocity.at(mw, 0.0).ratio(0.4 * 9.81, 0.0).ln();
        assert!((ours - ln_ratio).abs() < 0.1, "{vs30} m/s: {ours} for {ln_ratio}");
        assert!(velocity.at_quantiles().high < unknown);
    }
}

#[test]
fn pgv_of_a_spectrum_is_that_by_ground_motion_models() {
    for (mw, pga, sa_1s, pgv) in read::<(f64, f64, f64, f64)>("site_spectra.csv") {
        let curve = |im: f64| HazardCurve::new(vec![(0.5 * im, 1e-3), (2.0 * im, 1e-5)]).unwrap();
        let ours = velocity_of_spectrum(&curve(pga), &curve(sa_1s)).intensity(1e-4);
        assert!((ours / pgv).ln().abs() < 0.05, "M {mw}: {ours} m/s for {pgv}");
    }
}

#[test]
fn hard_rock_and_the_clay_of_a_lake_are_told_from_other_ground() {
    // PGA and SA(1.0 s), m/s2, once in 475, 2,475 and 10,000 years, of sites in scripts/reference/worlds.py.
    let sites = [
        ([3.49, 7.27, 11.85], [2.00, 5.14, 9.29], vec![]),
        ([2.48, 3.87, 5.14], [4.69, 9.19, 14.11], vec![]),
        ([0.251, 0.826, 2.552], [0.098, 0.274, 0.598], vec![Warning::HardRock]),
        ([0.637, 1.140, 1.695], [0.948, 1.738, 2.629], vec![Warning::OwnPeriod]),
    ];
    for (pga, sa_1s, warnings) in sites {
        let [pga, sa_1s] = [pga, sa_1s].map(|[low, middle, high]: [f64; 3]| {
            // Their first and last slopes go on to once in 20 and in a million years.
            let [first, last] = [low * (low / middle).powf(1.92), high * (high / middle).powf(3.3)];
            let rates = [20.0_f64, 475.0, 2475.0, 1e4, 1e6].map(f64::recip);
            HazardCurve::new([first, low, middle, high, last].into_iter().zip(rates).collect()).unwrap()
        });
        let Hazard::Curve(hazard) = Hazard::with_spectrum(pga, &sa_1s).unwrap() else { panic!("curves") };
        assert_eq!(hazard.warnings, warnings);
    }
}

/// The curve of PGV that a line of PGV / PGA gives over 1e-3 PGA^-k, which is a power law too.
fn curve_of_velocity(k: f64, level: f64, slope: f64, sd: f64) -> HazardCurve {
    let rate = |v: f64| rate_in_closed_form(1e-3, k, (level - v.ln()) / sd, (1.0 + slope) / sd);
    let pgv = |i: i32| 10f64.powf(-2.0 + 0.25 * f64::from(i));
    HazardCurve::new((0..13).map(|i| (pgv(i), rate(pgv(i)))).collect()).unwrap()
}

#[test]
fn two_curves_tell_the_line_by_which_they_belong_together() {
    let pga = power_law(1e-3, 2.2, 33);
    for (level, slope) in [(-2.9, 0.0), (-2.2, -0.3), (-3.3, 0.2)] {
        let pgv = curve_of_velocity(2.2, level, slope, 0.42);
        let velocity = PgvPgaRatio::by_curves(&pga, &pgv, VelocitySource::Pgv).unwrap();
        for pga_m_s2 in [1.0, 5.0] {
            let ratio = velocity.at(6.5, 0.0).ratio(pga_m_s2, 0.0);
            close(ratio, (level + slope * f64::ln(pga_m_s2)).exp(), 1e-4);
        }
    }
    let matched = |pgv: &HazardCurve| PgvPgaRatio::by_curves(&pga, pgv, VelocitySource::Pgv).unwrap_err();
    assert!(matches!(matched(&curve_of_velocity(2.2, 1.0, 0.0, 0.42)), MatchError::ImpossibleRatio { .. }));
    let kinked = HazardCurve::new(vec![(0.05, 0.1), (0.1, 1e-4), (0.5, 5e-5), (2.0, 1e-6)]).unwrap();
    assert!(matches!(matched(&kinked), MatchError::Unlike(_)));
    let rare = HazardCurve::new(vec![(0.5, 3e-8), (2.0, 1e-9)]).unwrap();
    assert!(matches!(matched(&rare), MatchError::NothingInCommon(..)));
}

/// A block of .9 x 1.4 m, whose rate of overturning a curve up to 4 g leaves open.
fn squat() -> RockingObject {
    RockingObject::uncalibrated(&Object::block("squat", 0.9, 1.4), MotionKind::Recorded, 0.1).unwrap()
}

#[test]
fn a_curve_that_ends_early_goes_on_with_its_last_slope() {
    let to = |last_g: f64| {
        let points = [0.05, 0.2, last_g].map(|g: f64| (9.81 * g, 1e-3 * (g / 0.2).powf(-2.5)));
        Site::new(Hazard::over(Peak::Pga, HazardCurve::new(points.to_vec()).unwrap()))
    };
    let [early, whole] = [0.8, 4.51].map(|last_g| to(last_g).rates(&squat()));
    let [cut, rate] = [&early, &whole].map(|rates| rates.states.overturning.estimate().unwrap());
    close(cut.value, rate.value, 1e-3);
    assert!(early.warnings.contains(&Warning::HazardEndsEarly) && whole.beyond == Some(0.0));
    // Whatever comes beyond, nothing or each motion overturning it, the limits hold it, and the other errors.
    let known = (1.0 - early.beyond.unwrap()) * cut.value;
    let margin = |to: f64| (to / cut.value).ln().abs();
    let [down, up] = [rate.low, rate.high].map(margin);
    close(margin(cut.low), down.hypot(margin(known)), 1e-3);
    close(margin(cut.high), up.hypot(margin(known + 1e-3 * 4.0_f64.powf(-2.5))), 1e-3);
    assert!(cut.high < early.states.rocking.high.unwrap());
}

#[test]
fn limits_are_those_of_normal_errors() {
    // What only raises a result, such as an offset to either side, has no lower side.
    let by = |source, result: fn(f64) -> f64| LowHigh { source, low: -Z_95, high: Z_95 }.map(|x| result(*x));
    let unknowns = [
        by(UncertaintySource::Eta, |x| 1.0 + 0.4 * x),
        by(UncertaintySource::Object, |x| 1.0 + 1.2 * x.abs()),
    ];
    let mut budget = Budget::new(&1.0, &unknowns, |result| Some(*result));
    budget.add(LowHigh { source: UncertaintySource::Fit, low: -0.3, high: 0.3 });
    budget.add(LowHigh { source: UncertaintySource::Floor, low: f64::NAN, high: f64::NAN });
    let [down, up] = budget.sds();
    assert!((down - 0.5).abs() < 1e-12 && (up - 1.3).abs() < 1e-12);
    assert_eq!(budget.largest(), Some(UncertaintySource::Object));
    assert_eq!(budget.source_sd(UncertaintySource::Floor), None);
    let limits = budget.limit_rate(1e-4, 2e-4);
    assert!((limits.low / (1e-4 * (-0.979_982_f64).exp()) - 1.0).abs() < 1e-6);
    assert_eq!(limits.high, 2e-4, "never above the rate of rocking");
    let p = budget.limit_probability(0.5, 1.0, 1.2);
    close(p.low, 1.0 / (1.0 + (1.959_964 * 1.3_f64).exp()), 1e-6);
    close(p.high, 1.0 / (1.0 + (-1.959_964 * 1.3_f64.hypot(1.2)).exp()), 1e-6);
}

#[test]
fn averages_over_pgv_pga_are_those_of_scipy() {
    // scripts/reference/fragility.py.
    for row in read::<Row>("fragility_answers.csv") {
        let (structure, over, mw) = (row.structure(), row.get("over"), row.text("mw").parse().ok());
        let model = Model::uncalibrated(MotionKind::Recorded, &structure, 0.2);
        let directions = [RockingDirection { structure, model: Arc::new(model), count: None }];
        let unit = if over == Peak::Pga { 9.81 } else { 1.0 };
        let intensity = unit * row.get::<f64>("intensity");
        let general = GenericSites { over, mw, vs30_m_s: None, ratio_s: None };
        let p = general.given_peak(&directions).limit_states(intensity).map(Option::unwrap);
        for (found, column) in [(p.failure, "p_failure"), (p.overturning, "p_overturning")] {
            assert!((found - row.get::<f64>(column)).abs() < 2e-6, "{found}, {column} of {row:?}");
        }
    }
}
