//! Quadrature and bisection.

/// Nodes and weights on (0, 1) of the Gauss-Legendre rule of order 8, exact for polynomials of degree 15.
const GAUSS_LEGENDRE: [(f64, f64); 8] = [
    (0.019_855_071_751_231_884, 0.050_614_268_145_188_13),
    (0.101_666_761_293_186_63, 0.111_190_517_226_687_24),
    (0.237_233_795_041_835_5, 0.156_853_322_938_943_64),
    (0.408_282_678_752_175_1, 0.181_341_891_689_181),
    (0.591_717_321_247_825, 0.181_341_891_689_181),
    (0.762_766_204_958_164_5, 0.156_853_322_938_943_64),
    (0.898_333_238_706_813_4, 0.111_190_517_226_687_24),
    (0.980_144_928_248_768_1, 0.050_614_268_145_188_13),
];

/// Returns nodes and weights of the integral between two values: the Gauss-Legendre rule of order 8 on equal
/// panels, none wider than `widest`.
pub fn quadrature(from: f64, to: f64, widest: f64) -> impl Iterator<Item = (f64, f64)> {
    let panels = ((to - from) / widest).ceil().max(1.0);
    let width = (to - from) / panels;
    (0..panels as usize).flat_map(move |panel| {
        let start = from + width * panel as f64;
        GAUSS_LEGENDRE.map(|(node, weight)| (start + node * width, weight * width))
    })
}

/// Returns by how much each value at the nodes of a panel counts in the polynomial through all, at a place
/// between its ends, from 0 to 1.
pub fn interpolation(place: f64) -> [f64; 8] {
    std::array::from_fn(|k| {
        let others =
            (0..GAUSS_LEGENDRE.len()).filter(|other| *other != k).map(|other| GAUSS_LEGENDRE[other].0);
        others.map(|other| (place - other) / (GAUSS_LEGENDRE[k].0 - other)).product()
    })
}

/// Halvings of an interval to rounding.
const HALVINGS: usize = 60;

/// Finds by bisection the least value between two at which a condition holds; it holds from there on, and at
/// `high`.
pub fn first(low: f64, high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let halve = |(before, after): (f64, f64), _| {
        let middle = 0.5 * (before + after);
        if holds(middle) { (before, middle) } else { (middle, after) }
    };
    (0..HALVINGS).fold((low, high), halve).1
}
