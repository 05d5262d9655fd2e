use nalgebra::DVector;

/// The design of a regression: an intercept and the predictors of each case.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignMatrix {
    cases: usize,
    columns: Vec<Vec<f64>>,
}

impl DesignMatrix {
    /// Of `cases` cases and `predictors` that are each as long.
    pub fn new(predictors: &[&[f64]], cases: usize) -> DesignMatrix {
        let predictors = predictors.iter().map(|predictor| predictor[..cases].to_vec());
        DesignMatrix { cases, columns: std::iter::once(vec![1.0; cases]).chain(predictors).collect() }
    }

    /// How many cases there are.
    pub fn cases(&self) -> usize {
        self.cases
    }

    /// The columns: of the intercept, all ones, and of each predictor.
    pub fn columns(&self) -> &[Vec<f64>] {
        &self.columns
    }

    /// The rows in order.
    pub fn rows(&self) -> impl Iterator<Item = DVector<f64>> {
        let row = |case: usize| DVector::from_fn(self.columns.len(), |k, _| self.columns[k][case]);
        (0..self.cases).map(row)
    }

    /// b0 + b1 x1 + ... of each case.
    pub fn indices(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut indices = vec![0.0; self.cases];
        for (column, b) in self.columns.iter().zip(coefficients) {
            indices.iter_mut().zip(column).for_each(|(index, x)| *index += b * x);
        }
        indices
    }
}

/// The sum of products of two vectors.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
