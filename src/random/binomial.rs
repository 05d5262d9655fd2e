//! Binomial random numbers, the same on any platform.

use rand_chacha::rand_core::Rng;

/// How many of so many trials succeed, each with this probability, from the gaps between those that do, which are geometric (Devroye
/// 1986, Non-uniform random variate generation, section X.4.3): as many steps as there are successes, or failures if these are fewer.
pub fn binomial(trials: u64, probability: f64, random: &mut impl Rng) -> u64 {
    if probability > 0.5 {
        return trials - binomial(trials, 1.0 - probability, random);
    }
    let ln_failure = libm::log1p(-probability);
    let (mut last, mut successes) = (0_u64, 0);
    loop {
        let above_0 = 1.0 - (random.next_u64() >> 11) as f64 * (0.5 * f64::EPSILON);
        last = last.saturating_add((libm::log(above_0) / ln_failure) as u64 + 1);
        if last > trials {
            return successes;
        }
        successes += 1;
    }
}
