/// Counts less likely than this, at either end, are dropped: even of a million events they add up to less than rounding does.
const NEGLIGIBLE: f64 = 1e-22;

/// The number of independent events that happen, each with a probability of its own: exactly, by convolution (Hong 2013, On
/// computing the distribution function for the Poisson binomial distribution, Computational Statistics & Data Analysis 59, 41-51).
#[derive(Debug, Clone, PartialEq)]
pub struct PoissonBinomial {
    /// The least count that is kept.
    first: usize,
    /// The probability of that count and of each above.
    masses: Vec<f64>,
}

impl PoissonBinomial {
    /// Of events with these probabilities.
    pub fn new(probabilities: impl IntoIterator<Item = f64>) -> PoissonBinomial {
        let mut count = PoissonBinomial { first: 0, masses: vec![1.0] };
        probabilities.into_iter().for_each(|probability| count.add(probability));
        count
    }

    fn add(&mut self, probability: f64) {
        let masses = &mut self.masses;
        masses.push(0.0);
        for k in (1..masses.len()).rev() {
            masses[k] = masses[k] * (1.0 - probability) + masses[k - 1] * probability;
        }
        masses[0] *= 1.0 - probability;
        let is_kept = |mass: &f64| *mass >= NEGLIGIBLE;
        masses.truncate(masses.iter().rposition(is_kept).map_or(masses.len(), |last| last + 1));
        let below = masses.iter().position(is_kept).unwrap_or(0);
        masses.drain(..below);
        self.first += below;
    }

    /// Probability of at most this count.
    pub fn at_most(&self, count: usize) -> f64 {
        let kept = (count + 1).saturating_sub(self.first).min(self.masses.len());
        self.masses[..kept].iter().sum()
    }

    /// Probability of at least this count.
    pub fn at_least(&self, count: usize) -> f64 {
        let below = count.saturating_sub(self.first).min(self.masses.len());
        self.masses[below..].iter().sum()
    }

    /// The least count that is exceeded with a probability of no more than 1 - `level`.
    pub fn quantile(&self, level: f64) -> usize {
        let mut sum = 0.0;
        let reaches = |mass: &f64| {
            sum += mass;
            sum >= level
        };
        self.first + self.masses.iter().position(reaches).unwrap_or(self.masses.len() - 1)
    }

    /// Probability of a count as far out as this one, in either tail: twice that of the tail it lies in.
    pub fn two_sided_p(&self, count: usize) -> f64 {
        (2.0 * self.at_most(count).min(self.at_least(count))).min(1.0)
    }
}
