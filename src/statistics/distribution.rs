//! Student's t, F and chi squared, and the number of events of unequal probability.

/// The `x` below which Student's t with `degrees` > 0 of freedom lies with probability `p` in (0, 1).
pub fn t_quantile(p: f64, degrees: f64) -> f64 {
    if p < 0.5 {
        return -t_quantile(1.0 - p, degrees);
    }
    let (mut low, mut high) = (0.0, 1.0);
    while t_cdf(high, degrees) < p {
        high *= 2.0;
    }
    // Bisection to the last bit: called once a fit, it need not be fast.
    loop {
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            return middle;
        }
        if t_cdf(middle, degrees) < p {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// Cumulative probability of Student's t for x >= 0.
fn t_cdf(x: f64, degrees: f64) -> f64 {
    let upper_tail =
        0.5 * incomplete_beta(0.5 * degrees, 0.5, degrees / (degrees + x * x), x * x / (degrees + x * x));
    1.0 - upper_tail
}

/// Probability that F with these degrees of freedom lies above `f` >= 0.
pub fn f_upper_tail(f: f64, numerator: f64, denominator: f64) -> f64 {
    let sum = denominator + numerator * f;
    incomplete_beta(0.5 * denominator, 0.5 * numerator, denominator / sum, numerator * f / sum)
}

/// Probability that chi squared with so many degrees of freedom lies above `x` >= 0: a finite sum.
pub fn chi_squared_upper_tail(x: f64, degrees: usize) -> f64 {
    let half = 0.5 * x;
    // Q(a + 1, x/2) = Q(a, x/2) + (x/2)^a exp(-x/2) / Gamma(a + 1), from a = 1/2 or a = 0.
    let (mut a, mut tail) = if degrees % 2 == 1 { (0.5, libm::erfc(half.sqrt())) } else { (0.0, 0.0) };
    while a < 0.5 * degrees as f64 {
        tail += if half > 0.0 {
            libm::exp(a * libm::log(half) - half - libm::lgamma(a + 1.0))
        } else {
            f64::from(a == 0.0)
        };
        a += 1.0;
    }
    tail
}

/// The `x` below which chi squared with so many degrees of freedom lies with probability `p` in (0, 1).
pub fn chi_squared_quantile(p: f64, degrees: usize) -> f64 {
    let is_above = |x: f64| chi_squared_upper_tail(x, degrees) <= 1.0 - p;
    let (mut low, mut high) = (0.0, 1.0);
    while !is_above(high) {
        high *= 2.0;
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            return middle;
        }
        if is_above(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
}

/// The regularised incomplete beta function I_x(a, b), with `y` = 1 - x, by its continued fraction.
fn incomplete_beta(a: f64, b: f64, x: f64, y: f64) -> f64 {
    if x <= 0.0 || y <= 0.0 {
        return if x <= 0.0 { 0.0 } else { 1.0 };
    }
    let ln_front =
        libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b) + a * libm::log(x) + b * libm::log(y);
    if x < (a + 1.0) / (a + b + 2.0) {
        libm::exp(ln_front) * continued_fraction(a, b, x) / a
    } else {
        1.0 - libm::exp(ln_front) * continued_fraction(b, a, y) / b
    }
}

/// Lentz's evaluation.
fn continued_fraction(a: f64, b: f64, x: f64) -> f64 {
    const TINY: f64 = 1e-300;
    let away_from_zero = |value: f64| if value.abs() < TINY { TINY } else { value };
    let mut c = 1.0;
    let mut d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
    let mut fraction = d;
    for m in 1..1000 {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let mut change = 1.0;
        for term in [even, odd] {
            d = 1.0 / away_from_zero(1.0 + term * d);
            c = away_from_zero(1.0 + term / c);
            change = c * d;
            fraction *= change;
        }
        if (change - 1.0).abs() < 1e-16 {
            break;
        }
    }
    fraction
}

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
        self.trim();
    }

    fn trim(&mut self) {
        let masses = &mut self.masses;
        let is_kept = |mass: &f64| *mass >= NEGLIGIBLE;
        masses.truncate(masses.iter().rposition(is_kept).map_or(masses.len(), |last| last + 1));
        let below = masses.iter().position(is_kept).unwrap_or(0);
        masses.drain(..below);
        self.first += below;
    }

    /// The sum of both counts.
    fn plus(&self, other: &PoissonBinomial) -> PoissonBinomial {
        let mut masses = vec![0.0; self.masses.len() + other.masses.len() - 1];
        for (k, mass) in self.masses.iter().enumerate() {
            masses[k..].iter_mut().zip(&other.masses).for_each(|(sum, other)| *sum += mass * other);
        }
        let mut count = PoissonBinomial { first: self.first + other.first, masses };
        count.trim();
        count
    }

    /// Adds the count of further events to those of a stack, in which each is of twice as many as the next: so that the sum of all
    /// takes time in proportion to their number, but for its logarithm.
    pub fn stack(counts: &mut Vec<(u32, PoissonBinomial)>, count: PoissonBinomial) {
        let mut top = (0, count);
        while let Some((_, below)) = counts.pop_if(|(level, _)| *level == top.0) {
            top = (top.0 + 1, below.plus(&top.1));
        }
        counts.push(top);
    }

    /// The sum of a stack.
    pub fn of_stack(counts: Vec<(u32, PoissonBinomial)>) -> PoissonBinomial {
        let counts = counts.into_iter().rev().map(|(_, count)| count);
        counts.reduce(|sum, count| count.plus(&sum)).unwrap_or_else(|| PoissonBinomial::new([]))
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
