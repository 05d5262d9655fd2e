use crate::keyword::keywords;

/// What is removed from an acceleration that should be zero on average.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Baseline {
    /// Nothing.
    None,
    /// The mean.
    Mean,
    /// The line of least squares.
    Linear,
}

keywords!(Baseline { None = "none", Mean = "mean", Linear = "linear" });

impl Baseline {
    /// Removes it from these samples.
    pub fn remove_from(self, samples: &mut [f64]) {
        if samples.is_empty() {
            return;
        }
        let n = samples.len() as f64;
        let mean = samples.iter().sum::<f64>() / n;
        let middle = 0.5 * (n - 1.0);
        let slope = match self {
            Baseline::None => return,
            Baseline::Mean => 0.0,
            Baseline::Linear => {
                let moments = samples.iter().enumerate().map(|(k, a)| (k as f64 - middle, a));
                let (xy, xx) = moments.fold((0.0, 0.0), |(xy, xx), (x, a)| (xy + x * (a - mean), xx + x * x));
                if xx > 0.0 { xy / xx } else { 0.0 }
            }
        };
        for (k, sample) in samples.iter_mut().enumerate() {
            *sample -= mean + slope * (k as f64 - middle);
        }
    }
}
