//! Annual rates against closed forms.

use rockfrag::fragility::p_overturning;
use rockfrag::hazard::{HazardCurve, HazardError, JointHazard, PairOfPeaks, probability_in_years};
use rockfrag::statistics::normal;

/// H = k0 IM^-k at `n` intensities from 1e-4 to 1e4.
fn power_law(k0: f64, k: f64, n: usize) -> HazardCurve {
    let im = |i: usize| 10f64.powf(-4.0 + 8.0 * i as f64 / (n - 1) as f64);
    HazardCurve::new((0..n).map(|i| (im(i), k0 * im(i).powf(-k))).collect()).unwrap()
}

#[test]
fn a_power_law_and_a_lognormal_have_a_rate_in_closed_form() {
    // H(theta) exp(k^2 beta^2 / 2), whatever the points of the curve.
    for (k, theta, beta, n) in [(1.0, 0.3, 0.4, 2), (2.5, 1.0, 0.2, 17), (3.0, 0.7, 0.08, 301)] {
        let curve = power_law(1e-3, k, n);
        let [rate] = curve.mean_annual_rates(&[], 0.02, |im| [p_overturning(im, f64::ln(theta), beta)]);
        let expected = 1e-3 * theta.powf(-k) * (0.5 * k * k * beta * beta).exp();
        assert!((rate / expected - 1.0).abs() < 1e-9, "k {k}: {rate} for {expected}");
    }
}

#[test]
fn the_rate_of_a_jump_is_the_hazard_there() {
    let curve = power_law(1e-3, 2.0, 5);
    let jump = 0.37;
    let [rate] = curve.mean_annual_rates(&[jump], 0.02, |im| [f64::from(u8::from(im >= jump))]);
    assert!((rate / (1e-3 / (jump * jump)) - 1.0).abs() < 1e-9);
}

#[test]
fn a_joint_hazard_has_a_curve_of_each_peak() {
    let bin = |(pga_m_s2, pgv_m_s, annual_rate)| PairOfPeaks { pga_m_s2, pgv_m_s, annual_rate, mw: None };
    let bins = [(2.0, 0.3, 0.125), (1.0, 0.3, 0.5), (2.0, 0.1, 0.25), (4.0, 0.2, 0.0625)].map(bin).to_vec();
    let joint = JointHazard { bins };
    assert_eq!(joint.exceedance(|bin| bin.pga_m_s2), [(1.0, 0.9375), (2.0, 0.4375), (4.0, 0.0625)]);
    assert_eq!(joint.exceedance(|bin| bin.pgv_m_s), [(0.1, 0.9375), (0.2, 0.6875), (0.3, 0.625)]);
}

#[test]
fn motions_beyond_the_curve_count_as_its_last_one() {
    let curve = HazardCurve::new(vec![(0.1, 0.01), (1.0, 0.001)]).unwrap();
    let [all, half] = curve.mean_annual_rates(&[], 0.02, |_| [1.0, 0.5]);
    assert!((all - 0.01).abs() < 1e-12 && (half - 0.005).abs() < 1e-12);
}

#[test]
fn a_joint_hazard_of_lognormal_velocities_widens_the_curve() {
    // At one PGA, with ln PGV normal: P(z <= (ln PGV - mu)/beta) has mean Phi((m - mu)/sqrt(beta^2 + s^2)).
    let (m, s, mu, beta) = (-0.4, 0.5, 0.1, 0.3);
    let n = 4000;
    let bin = |k: usize| PairOfPeaks {
        pga_m_s2: 5.0,
        pgv_m_s: f64::exp(m + s * normal::quantile((k as f64 + 0.5) / n as f64)),
        annual_rate: 0.02 / n as f64,
        mw: None,
    };
    let joint = JointHazard { bins: (0..n).map(bin).collect() };
    let [rate] = joint.mean_annual_rates(|bin| [p_overturning(bin.pgv_m_s, mu, beta)]);
    let expected = 0.02 * normal::cdf((m - mu) / beta.hypot(s));
    assert!((rate / expected - 1.0).abs() < 1e-4, "{rate} for {expected}");
}

#[test]
fn a_rate_becomes_a_probability() {
    assert!((probability_in_years(1.0 / 475.0, 50.0) - 0.0999).abs() < 1e-4);
    assert!((probability_in_years(1e-12, 50.0) / 5e-11 - 1.0).abs() < 1e-9);
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
