use std::ops::{Add, Mul, Neg, Sub};

/// Repeats a block for each value of a constant. Nested loops over arrays of vectors stay loops otherwise, with every
/// vector in memory.
macro_rules! unrolled {
    ($k:ident in [$($value:literal)*] $block:block) => {
        $({
            let $k: usize = $value;
            $block
        })*
    };
}
pub(super) use unrolled;

/// A real number, or several that are worked on at once: what the equation of motion is written in.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Neg<Output = Self>
{
    /// `self * factor + addend`, rounded once where the processor can.
    fn mul_add(self, factor: Self, addend: Self) -> Self;

    /// Sine and cosine of an angle from 0 to pi/2.
    fn sin_cos(self) -> (Self, Self);
}

impl Real for f64 {
    #[inline]
    fn mul_add(self, factor: f64, addend: f64) -> f64 {
        self * factor + addend
    }

    #[inline]
    fn sin_cos(self) -> (f64, f64) {
        libm::sincos(self)
    }
}
