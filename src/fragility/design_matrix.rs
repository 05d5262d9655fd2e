/// The rows of a regression: an intercept and the predictors of each case.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignMatrix {
    columns: usize,
    /// Row after row.
    values: Vec<f64>,
}

impl DesignMatrix {
    /// Of `cases` cases and `predictors` that are each as long.
    pub fn new(predictors: &[&[f64]], cases: usize) -> DesignMatrix {
        let row =
            |row: usize| std::iter::once(1.0).chain(predictors.iter().map(move |predictor| predictor[row]));
        DesignMatrix { columns: predictors.len() + 1, values: (0..cases).flat_map(row).collect() }
    }

    /// Coefficients of a regression on it: the intercept and a slope for each predictor.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The rows in order.
    pub fn rows(&self) -> std::slice::ChunksExact<'_, f64> {
        self.values.chunks_exact(self.columns)
    }
}

/// The sum of products of two vectors.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
