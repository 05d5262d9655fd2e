//! Long series cut down to what can be seen of them.

/// A series in equal steps of its samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Envelope {
    /// Samples of the whole series in a step.
    pub each: usize,
    /// Its values.
    pub values: Vec<f64>,
}

/// The series itself if it has no more than `most` values, or else the least and the largest value of each of `most` / 2
/// buckets, in the order in which they come.
pub fn envelope(values: &[f64], most: usize) -> Envelope {
    let each = values.len().div_ceil(most).max(1);
    if each == 1 {
        return Envelope { each, values: values.to_vec() };
    }
    let ends = values.chunks(2 * each).flat_map(|bucket| {
        let best = |better: fn(f64, f64) -> bool| {
            (1..bucket.len()).fold(0, |best, at| if better(bucket[at], bucket[best]) { at } else { best })
        };
        let (least, largest) = (best(|a, b| a < b), best(|a, b| a > b));
        [bucket[least.min(largest)], bucket[least.max(largest)]]
    });
    Envelope { each, values: ends.collect() }
}
