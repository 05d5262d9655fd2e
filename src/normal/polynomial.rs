/// c[0] + c[1] x + c[2] x^2 + ..., the even and the odd powers apart: two short chains of operations instead of a long one.
#[inline(always)]
pub fn polynomial<const N: usize>(c: &[f64; N], x: f64) -> f64 {
    const { assert!(N.is_multiple_of(2)) };
    let square = x * x;
    let (mut even, mut odd) = (c[N - 2], c[N - 1]);
    let mut power = N - 2;
    while power > 0 {
        power -= 2;
        even = even.mul_add(square, c[power]);
        odd = odd.mul_add(square, c[power + 1]);
    }
    x.mul_add(odd, even)
}
