//! Normal random numbers by the ziggurat of Marsaglia & Tsang (2000, Journal of Statistical Software 5(8)): those of `rand_distr`, number
//! by number, but for last digits. Its exponentials and logarithms are the platform's, ours are not.

use std::sync::LazyLock;

use rand_chacha::rand_core::Rng;

const LAYERS: usize = 256;

/// Where the tail begins, below the layer at the bottom.
const TAIL: f64 = 3.654_152_885_361_009;

/// The area of a layer.
const AREA: f64 = 0.004_928_673_233_99;

/// Layers of the same area under exp(-x^2 / 2), from the bottom to the top.
struct Ziggurat {
    /// Half the width of each layer.
    width: [f64; LAYERS + 1],
    /// The density at its outer edge.
    density: [f64; LAYERS + 1],
}

static ZIGGURAT: LazyLock<Ziggurat> = LazyLock::new(|| {
    let mut width = [0.0; LAYERS + 1];
    (width[0], width[1]) = (AREA / density(TAIL), TAIL);
    for layer in 2..LAYERS {
        let inner = width[layer - 1];
        width[layer] = (-2.0 * libm::log(AREA / inner + density(inner))).sqrt();
    }
    Ziggurat { width, density: width.map(density) }
});

fn density(x: f64) -> f64 {
    libm::exp(-0.5 * x * x)
}

/// Returns an endless series of standard normal numbers.
pub fn normals(mut random: impl Rng) -> impl Iterator<Item = f64> {
    let ziggurat = &*ZIGGURAT;
    std::iter::repeat_with(move || ziggurat.draw(&mut random))
}

impl Ziggurat {
    #[inline]
    fn draw(&self, random: &mut impl Rng) -> f64 {
        loop {
            // The last bits choose a layer, the others a number from -1 to 1.
            let bits = random.next_u64();
            let layer = bits as usize % LAYERS;
            let u = f64::from_bits(2.0_f64.to_bits() | bits >> 12) - 3.0;
            let x = u * self.width[layer];
            if x.abs() < self.width[layer + 1] || layer > 0 && self.is_below_density(x, layer, random) {
                return x;
            }
            if layer == 0 {
                return tail(random).copysign(u);
            }
        }
    }

    /// Whether a number of the edge of a layer is one of the distribution.
    #[cold]
    fn is_below_density(&self, x: f64, layer: usize, random: &mut impl Rng) -> bool {
        let (outer, inner) = (self.density[layer], self.density[layer + 1]);
        let share = (random.next_u64() >> 11) as f64 * (0.5 * f64::EPSILON);
        inner + (outer - inner) * share < density(x)
    }
}

/// Draws from the tail (Marsaglia 1964).
#[cold]
fn tail(random: &mut impl Rng) -> f64 {
    let mut exponential = || {
        let above_0 =
            f64::from_bits(1.0_f64.to_bits() | random.next_u64() >> 12) - (1.0 - 0.5 * f64::EPSILON);
        -libm::log(above_0)
    };
    loop {
        let beyond = exponential() / TAIL;
        if 2.0 * exponential() >= beyond * beyond {
            return TAIL + beyond;
        }
    }
}
