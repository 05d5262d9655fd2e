//! The distribution of the capacities of an incremental dynamic analysis against scipy.

use rand_distr::{Distribution, StandardNormal};
use rockfrag_core::fragility::{CapacityFit, KnownCapacity};
use rockfrag_core::statistics::FitStatus;

use crate::common::{close, random, read};

/// Each capacity is a cluster of its own.
fn fit_capacities(capacities: &[KnownCapacity]) -> Result<CapacityFit, FitStatus> {
    let clusters: Vec<u32> = (0..capacities.len() as u32).collect();
    rockfrag_core::fragility::fit_capacities(capacities, &clusters)
}

#[test]
fn a_capacity_that_comes_twice_in_a_cluster_counts_once() {
    let once: Vec<KnownCapacity> = (1..=20).map(|k| KnownCapacity::At(1.1_f64.powi(k * k % 17))).collect();
    let twice: Vec<KnownCapacity> = once.iter().flat_map(|&capacity| [capacity; 2]).collect();
    let clusters: Vec<u32> = (0..40).map(|k| k / 2).collect();
    let width = |fit: CapacityFit| (fit.theta.high / fit.theta.low).ln();
    let (alone, of_pairs) = (
        fit_capacities(&twice).unwrap(),
        rockfrag_core::fragility::fit_capacities(&twice, &clusters).unwrap(),
    );
    close(width(of_pairs) / width(alone), (2.0_f64 * (20.0 / 19.0) * (39.0 / 40.0)).sqrt(), 1e-12);
    close(of_pairs.theta.value, fit_capacities(&once).unwrap().theta.value, 1e-12);
}

#[test]
fn limits_of_known_capacities_are_scipys() {
    for row in read::<(String, [f64; 6], String)>("capacities.csv") {
        let (_, [theta, theta_low, theta_high, beta, beta_low, beta_high], capacities) = row;
        let known = capacities.split(' ').map(|text| KnownCapacity::At(text.parse().unwrap()));
        let fit = fit_capacities(&known.collect::<Vec<_>>()).unwrap();
        close(fit.theta.value, theta, 1e-12);
        close(fit.beta.value, beta, 1e-12);
        close(fit.theta.low, theta_low, 1e-10);
        close(fit.theta.high, theta_high, 1e-10);
        close(fit.beta.low, beta_low, 1e-10);
        close(fit.beta.high, beta_high, 1e-10);
    }
}

#[test]
fn limits_of_thirteen_capacities_hold_the_truth_in_19_of_20_samples() {
    const SAMPLES: u64 = 4000;
    let (mut of_theta, mut of_beta) = (0, 0);
    for seed in 0..SAMPLES {
        let mut random = random(seed);
        let mut draw = || {
            let normal: f64 = StandardNormal.sample(&mut random);
            KnownCapacity::At((0.4 * normal).exp())
        };
        let sample: Vec<KnownCapacity> = (0..13).map(|_| draw()).collect();
        let fit = fit_capacities(&sample).unwrap();
        of_theta += u32::from((fit.theta.low..=fit.theta.high).contains(&1.0));
        of_beta += u32::from((fit.beta.low..=fit.beta.high).contains(&0.4));
    }
    for held in [of_theta, of_beta] {
        let share = f64::from(held) / SAMPLES as f64;
        assert!((share - 0.95).abs() < 0.012, "{share}");
    }
}

#[test]
fn capacities_beyond_the_scan_count_as_scipy_has_it() {
    // scipy.stats.norm.fit(CensoredData(uncensored, left=..., right=...)) of the logarithms, refined by
    // scipy.optimize.
    let known = [0.4, 0.55, 0.62, 0.8, 0.81, 1.2, 1.7, 2.4].map(KnownCapacity::At);
    let censored = [KnownCapacity::Above(3.0); 3].into_iter().chain([KnownCapacity::Below(0.3); 2]);
    let fit = fit_capacities(&known.into_iter().chain(censored).collect::<Vec<_>>()).unwrap();
    close(fit.theta.value, 1.069_841_029_011_907_4, 1e-8);
    close(fit.beta.value, 1.281_314_815_684_608_6, 1e-8);
    assert_eq!(fit_capacities(&[KnownCapacity::At(1.0)]), Err(FitStatus::TooFewEvents));
    assert_eq!(fit_capacities(&[KnownCapacity::Above(1.0); 9]), Err(FitStatus::TooFewEvents));
    assert_eq!(fit_capacities(&[KnownCapacity::At(1.0); 3]), Err(FitStatus::Degenerate));
}
