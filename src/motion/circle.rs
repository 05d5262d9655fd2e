/// Every so many angles the sine and cosine are computed afresh.
const STRIDE: usize = 32;

/// Sine and cosine of `start`, `start + step`, `start + 2 step` ... (rad): by the addition theorem from those of every 32nd
/// angle and of the steps between.
pub fn equal_steps(start: f64, step: f64) -> impl Iterator<Item = (f64, f64)> {
    let between: [(f64, f64); STRIDE] = std::array::from_fn(|k| libm::sincos(k as f64 * step));
    (0_u32..).flat_map(move |stride| {
        let (sin, cos) = libm::sincos(start + f64::from(stride) * STRIDE as f64 * step);
        between.map(|(sin_step, cos_step)| (sin * cos_step + cos * sin_step, cos * cos_step - sin * sin_step))
    })
}
