//! The Taylor series of the log-likelihood of a case in its index. The first derivative of each link obeys a differential
//! equation of products, from which its powers follow one after the other.

use super::link::Link;

/// The factors of t^0, t, t^2 ... in [`Link::ln_probability`] at `index + t`, from that at the index and its first derivative.
pub fn ln_probability_series<const N: usize>(
    link: Link,
    event: bool,
    index: f64,
    ln_probability: f64,
    slope: f64,
) -> [f64; N] {
    let (sign, z) = if event { (1.0, index) } else { (-1.0, -index) };
    let slopes: [f64; N] = match (link, event) {
        // Of the inverse Mills ratio m at z + u, with u = t or -t: m' = -m (z + u + m).
        (Link::Probit, _) => series(sign * slope, |m, n| {
            let linear = z * m[n] + if n > 0 { m[n - 1] } else { 0.0 };
            -linear - product(m, m, n)
        }),
        // Of the other outcome's probability: q' = q^2 - q.
        (Link::Logit, _) => series(sign * slope, |q, n| product(q, q, n) - q[n]),
        // Of r = h / (exp(h) - 1) with the hazard h = exp(index): r' = r (1 - h - r).
        (Link::Cloglog, true) => {
            let hazard: [f64; N] = series(index.exp(), |h, n| h[n]);
            series(slope, |r, n| r[n] - product(&hazard, r, n) - product(r, r, n))
        }
        // Of h, in t = -u.
        (Link::Cloglog, false) => series(-slope, |h, n| -h[n]),
    };
    std::array::from_fn(|n| match n {
        0 => ln_probability,
        _ => f64::powi(sign, n as i32) * slopes[n - 1] / n as f64,
    })
}

/// The powers of a function from its value, and those of its derivative from what is known by then.
fn series<const N: usize>(value: f64, derivative: impl Fn(&[f64; N], usize) -> f64) -> [f64; N] {
    let mut powers = [0.0; N];
    powers[0] = value;
    for n in 1..N {
        powers[n] = derivative(&powers, n - 1) / n as f64;
    }
    powers
}

/// Power `n` of a product.
fn product(a: &[f64], b: &[f64], n: usize) -> f64 {
    (0..=n).map(|i| a[i] * b[n - i]).sum()
}
