//! Values gathered into bins.

/// The value below which a share of sorted values lies.
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let last = sorted.len().saturating_sub(1);
    let place = share * last as f64;
    let (below, above) = (place.floor() as usize, place.ceil() as usize);
    match (sorted.get(below), sorted.get(above)) {
        (Some(low), Some(high)) => low + (place - below as f64) * (high - low),
        _ => f64::NAN,
    }
}

/// Finite values in rising order.
pub fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    values.sort_unstable_by(f64::total_cmp);
    values
}

/// Bins of equal ratio between two values: for each, what `values` of x and y lie in it.
pub fn by_ratio(values: &[[f64; 2]], [low, high]: [f64; 2], count: usize) -> Vec<(f64, Vec<f64>)> {
    let ratio = (high / low).powf(1.0 / count as f64);
    let middle = |bin: usize| low * ratio.powf(bin as f64 + 0.5);
    let mut bins: Vec<(f64, Vec<f64>)> = (0..count).map(|bin| (middle(bin), Vec::new())).collect();
    for &[x, y] in values {
        let bin = ((x / low).ln() / ratio.ln()).floor();
        if bin >= 0.0
            && let Some((_, inside)) = bins.get_mut(bin as usize)
        {
            inside.push(y);
        }
    }
    bins
}
