//! Some of many, spread over all.

/// Steps of this share of a turn come to no case, cell or cluster more often than to another, however these follow each other.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Whether this row is among a share of all; those of a smaller share are among those of a larger one.
pub fn is_among(row: usize, share: f64) -> bool {
    (row as f64 * GOLDEN).fract() < share
}

/// What comes, while it is no more than can be held, and of more between half as many and as many, spread over all.
#[derive(Debug)]
pub struct Spread<T> {
    most: usize,
    share: f64,
    seen: usize,
    kept: Vec<(usize, T)>,
}

impl<T> Spread<T> {
    /// Of at most so many.
    pub fn new(most: usize) -> Spread<T> {
        Spread { most, share: 1.0, seen: 0, kept: Vec::new() }
    }

    /// Adds one, or passes it over.
    pub fn push(&mut self, item: T) {
        if is_among(self.seen, self.share) {
            self.kept.push((self.seen, item));
        }
        self.seen += 1;
        while self.kept.len() > self.most {
            self.share *= 0.5;
            self.kept.retain(|(row, _)| is_among(*row, self.share));
        }
    }

    /// How many have come and are not kept.
    pub fn passed_over(&self) -> usize {
        self.seen - self.kept.len()
    }

    /// Those that are kept, in order.
    pub fn into_kept(self) -> Vec<T> {
        self.kept.into_iter().map(|(_, item)| item).collect()
    }
}
