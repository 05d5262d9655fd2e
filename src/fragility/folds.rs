//! Cross-validation that respects the design: whole cells are left out, since the motions of one cell resemble each other
//! (Roberts et al. 2017, Ecography 40, 913-929).

/// The most folds.
const MOST_FOLDS: usize = 10;

/// The fold of each case: neighbouring cells fall into different folds, so that what is left out lies within what is kept.
/// None where all cases are of one cell, so that nothing can be left out.
pub fn folds(cells: &[usize]) -> Option<Vec<usize>> {
    let distinct = cells.iter().max().map_or(0, |largest| largest + 1);
    let folds = distinct.min(MOST_FOLDS);
    (folds > 1).then(|| cells.iter().map(|cell| cell % folds).collect())
}

/// The values that are kept.
pub fn kept<T: Copy>(values: &[T], keep: &[bool]) -> Vec<T> {
    values.iter().zip(keep).filter(|(_, keep)| **keep).map(|(value, _)| *value).collect()
}

/// Scores and predictions of each case by the fit without its fold; none if one of the fits does not exist.
pub fn leave_out(
    cells: &[usize],
    predict: impl Fn(&[bool], &[bool]) -> Option<(Vec<f64>, Vec<f64>)>,
) -> Option<(Vec<f64>, Vec<f64>)> {
    let folds = folds(cells)?;
    let (mut scores, mut predictions) = (vec![f64::NAN; cells.len()], vec![f64::NAN; cells.len()]);
    let rows: Vec<usize> = (0..cells.len()).collect();
    for fold in 0..=*folds.iter().max()? {
        let left_out: Vec<bool> = folds.iter().map(|&of| of == fold).collect();
        let keep: Vec<bool> = left_out.iter().map(|left| !left).collect();
        let places = kept(&rows, &left_out);
        if places.is_empty() {
            continue;
        }
        let (fold_scores, fold_predictions) = predict(&keep, &left_out)?;
        for (k, &row) in places.iter().enumerate() {
            (scores[row], predictions[row]) = (fold_scores[k], fold_predictions[k]);
        }
    }
    Some((scores, predictions))
}

/// By how much one forecast is better than another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gain {
    /// Mean difference of their log scores.
    pub value: f64,
    /// Its standard error; cases of one cell may depend on each other.
    pub standard_error: f64,
}

/// The gain of forecasts with these log scores over a reference, paired case by case; its error from the sums over
/// cells, C / (C - 1) sum (S_c - n_c mean)^2 / n^2 for C cells.
pub fn gain(scores: &[f64], reference: &[f64], cells: &[usize]) -> Gain {
    let n = scores.len() as f64;
    let mean = scores.iter().zip(reference).map(|(score, other)| score - other).sum::<f64>() / n;
    let mut sums = vec![None; cells.iter().max().map_or(0, |largest| largest + 1)];
    for ((score, other), &cell) in scores.iter().zip(reference).zip(cells) {
        *sums[cell].get_or_insert(0.0) += score - other - mean;
    }
    let sums: Vec<f64> = sums.into_iter().flatten().collect();
    let count = sums.len() as f64;
    let squares = sums.iter().map(|sum| sum * sum).sum::<f64>();
    Gain { value: mean, standard_error: (count / (count - 1.0) * squares).sqrt() / n }
}
