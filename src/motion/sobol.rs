/// Points of Sobol's sequence in four dimensions as 32 binary digits each, after Joe and Kuo (2008), in the order of
/// Gray codes; the first point is 0.
#[derive(Debug, Clone, Default)]
pub struct SobolSequence {
    index: u32,
    digits: [u32; 4],
}

/// A primitive polynomial, without its first and last coefficient, and the initial direction numbers.
struct Direction {
    polynomial: u32,
    initial: &'static [u32],
}

/// The dimensions after the first, which is van der Corput's sequence.
const DIRECTIONS: [Direction; 3] = [
    Direction { polynomial: 0, initial: &[1] },
    Direction { polynomial: 1, initial: &[1, 3] },
    Direction { polynomial: 1, initial: &[1, 3, 1] },
];

impl Iterator for SobolSequence {
    type Item = [u32; 4];

    fn next(&mut self) -> Option<[u32; 4]> {
        let point = self.digits;
        let bit = self.index.trailing_ones();
        for (dimension, digits) in self.digits.iter_mut().enumerate() {
            *digits ^= direction_number(dimension, bit as usize);
        }
        self.index = self.index.checked_add(1)?;
        Some(point)
    }
}

fn direction_number(dimension: usize, bit: usize) -> u32 {
    if dimension == 0 {
        return 1 << (31 - bit);
    }
    let Direction { polynomial, initial } = &DIRECTIONS[dimension - 1];
    let degree = initial.len();
    let mut numbers: Vec<u32> = initial.iter().enumerate().map(|(k, m)| m << (31 - k)).collect();
    for k in degree..=bit {
        let mut number = numbers[k - degree] ^ (numbers[k - degree] >> degree);
        for j in 1..degree {
            if polynomial >> (degree - 1 - j) & 1 == 1 {
                number ^= numbers[k - j];
            }
        }
        numbers.push(number);
    }
    numbers[bit]
}
