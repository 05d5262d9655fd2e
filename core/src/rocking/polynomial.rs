//! Real roots of one polynomial on the unit interval, by the signs of its Bernstein coefficients.

/// The order of the Taylor series of a step.
pub const ORDER: usize = 8;

/// A polynomial in the fraction of the step, 0 at its start and 1 at its end.
pub type Polynomial<T = f64> = [T; ORDER + 1];

/// A narrower bracket with several sign changes holds a multiple root.
const NARROWEST_BRACKET: f64 = 1e-12;

/// Newton steps before bisection alone, which always ends.
const MOST_NEWTON_STEPS: usize = 64;

pub fn value(c: &Polynomial, x: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

#[inline]
pub fn derivative(c: &Polynomial) -> Polynomial {
    std::array::from_fn(|k| if k < ORDER { (k + 1) as f64 * c[k + 1] } else { 0.0 })
}

/// Finds the roots in (0, 1), ascending. A root at 0 does not count.
pub fn roots(c: &Polynomial) -> Vec<f64> {
    let mut roots = Vec::new();
    if let Some(zeros) = c.iter().position(|&coefficient| coefficient != 0.0) {
        let deflated = std::array::from_fn(|k| c.get(k + zeros).copied().unwrap_or(0.0));
        add_roots(&deflated, &bernstein(&deflated), 0.0, 1.0, &mut roots);
    }
    roots
}

/// Adds the roots between `low` and `high` in ascending order. By Descartes' rule their number is at most the
/// number of sign changes of the Bernstein coefficients `b`, and of the same parity.
fn add_roots(c: &Polynomial, b: &Polynomial, low: f64, high: f64, roots: &mut Vec<f64>) {
    match sign_changes(b) {
        0 => {}
        1 => {
            let first = b.iter().find(|coefficient| **coefficient != 0.0);
            roots.push(root_in_bracket(c, low, high, first > Some(&0.0)));
        }
        _ if high - low < NARROWEST_BRACKET => roots.push(0.5 * (low + high)),
        _ => {
            let middle = 0.5 * (low + high);
            let (left, right) = halves(b);
            add_roots(c, &left, low, middle, roots);
            if left[ORDER] == 0.0 {
                roots.push(middle);
            }
            add_roots(c, &right, middle, high, roots);
        }
    }
}

/// Converts to Bernstein coefficients by repeated sums: `b[j] = sum over i <= j of
/// binomial(j,i) / binomial(ORDER,i) c[i]`.
#[inline(always)]
pub fn bernstein(c: &Polynomial) -> Polynomial {
    const INVERSE_BINOMIAL: Polynomial =
        [1.0, 1.0 / 8.0, 1.0 / 28.0, 1.0 / 56.0, 1.0 / 70.0, 1.0 / 56.0, 1.0 / 28.0, 1.0 / 8.0, 1.0];
    let mut b = *c;
    for (b, inverse) in b.iter_mut().zip(INVERSE_BINOMIAL) {
        *b *= inverse;
    }
    for pass in 1..=ORDER {
        for j in (pass..=ORDER).rev() {
            b[j] += b[j - 1];
        }
    }
    b
}

/// Computes the Bernstein coefficients of both halves by de Casteljau's algorithm.
fn halves(b: &Polynomial) -> (Polynomial, Polynomial) {
    let mut right = *b;
    let mut left = *b;
    for (pass, coefficient) in left.iter_mut().enumerate().skip(1) {
        for j in 0..=ORDER - pass {
            right[j] = 0.5 * (right[j] + right[j + 1]);
        }
        *coefficient = right[0];
    }
    (left, right)
}

fn sign_changes(b: &Polynomial) -> usize {
    let mut positive = b.iter().filter(|&&coefficient| coefficient != 0.0).map(|c| *c > 0.0);
    let Some(mut last) = positive.next() else { return 0 };
    positive.filter(|&sign| std::mem::replace(&mut last, sign) != sign).count()
}

/// Finds the only root in a bracket by Newton's method with bisection; `falling` if values are positive left
/// of it.
fn root_in_bracket(c: &Polynomial, low: f64, high: f64, falling: bool) -> f64 {
    let slope = derivative(c);
    let (mut low, mut high) = (low, high);
    let mut x = 0.5 * (low + high);
    let mut newton_steps = 0..MOST_NEWTON_STEPS;
    loop {
        let y = value(c, x);
        if y == 0.0 {
            return x;
        }
        if (y > 0.0) == falling {
            low = x;
        } else {
            high = x;
        }
        let newton = x - y / value(&slope, x);
        let inside = newton > low && newton < high;
        let next = if inside && newton_steps.next().is_some() { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= f64::EPSILON * next.abs() || next == low || next == high {
            return next;
        }
        x = next;
    }
}
