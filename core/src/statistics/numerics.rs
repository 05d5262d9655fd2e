//! Quadrature, bisection and steps of equal ratio.

const ORDER: usize = 8;

/// Nodes and weights on (0, 1) of the Gauss-Legendre rule, exact for polynomials of degree 15.
const GAUSS_LEGENDRE: [(f64, f64); ORDER] = [
    (0.019_855_071_751_231_884, 0.050_614_268_145_188_13),
    (0.101_666_761_293_186_63, 0.111_190_517_226_687_24),
    (0.237_233_795_041_835_5, 0.156_853_322_938_943_64),
    (0.408_282_678_752_175_1, 0.181_341_891_689_181),
    (0.591_717_321_247_825, 0.181_341_891_689_181),
    (0.762_766_204_958_164_5, 0.156_853_322_938_943_64),
    (0.898_333_238_706_813_4, 0.111_190_517_226_687_24),
    (0.980_144_928_248_768_1, 0.050_614_268_145_188_13),
];

/// An interval over which a function is taken as the polynomial through its values at the nodes.
#[derive(Debug, Clone, Copy)]
pub struct QuadraturePanel {
    pub from: f64,
    pub to: f64,
}

/// Returns the equal panels between two values, none wider than `widest`.
pub fn panels(from: f64, to: f64, widest: f64) -> impl Iterator<Item = QuadraturePanel> {
    let count = ((to - from) / widest).ceil().max(1.0);
    let width = (to - from) / count;
    (0..count as usize)
        .map(move |k| QuadraturePanel { from: from + width * k as f64, to: from + width * (k + 1) as f64 })
}

impl QuadraturePanel {
    pub fn nodes(self) -> impl Iterator<Item = (f64, f64)> {
        let width = self.to - self.from;
        GAUSS_LEGENDRE.into_iter().map(move |(node, weight)| (self.from + node * width, weight * width))
    }

    /// Returns nodes and weights of the integral over point masses (place, mass) within the panel: that over
    /// the density of degree 7 which has their moments on the Legendre polynomials.
    pub fn nodes_of(self, masses: impl Iterator<Item = (f64, f64)>) -> [(f64, f64); ORDER] {
        let width = self.to - self.from;
        let mut moments = [0.0; ORDER];
        for (at, mass) in masses {
            let values = legendre((at - self.from) / width);
            moments.iter_mut().zip(values).for_each(|(moment, value)| *moment += mass * value);
        }
        GAUSS_LEGENDRE.map(|(node, weight)| {
            let terms = legendre(node).into_iter().zip(moments).enumerate();
            let density: f64 = terms.map(|(n, (value, moment))| (2 * n + 1) as f64 * value * moment).sum();
            (self.from + node * width, weight * density)
        })
    }
}

/// Computes the Legendre polynomials of degree 0, 1, ... on (0, 1).
fn legendre(place: f64) -> [f64; ORDER] {
    let x = 2.0 * place - 1.0;
    let mut values = [1.0, x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    for n in 1..ORDER - 1 {
        let k = n as f64;
        values[n + 1] = ((2.0 * k + 1.0) * x * values[n] - k * values[n - 1]) / (k + 1.0);
    }
    values
}

/// Returns the ends of `steps` steps of equal ratio between two values.
pub fn equal_ratios(from: f64, to: f64, steps: usize) -> impl Iterator<Item = f64> {
    (0..=steps).map(move |k| from * (to / from).powf(k as f64 / steps as f64))
}

/// Halvings of an interval to rounding.
const HALVINGS: usize = 60;

/// Finds by bisection the least value from `low` to `high` at which a condition holds, which then holds up to
/// `high`.
pub fn bisect_first_true(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *(if holds(middle) { &mut high } else { &mut low }) = middle;
    }
    high
}
