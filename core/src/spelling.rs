//! Messages about unknown words: the known ones, and the most similar one.

use strum::VariantArray;

pub fn unknown_word<T: VariantArray + Into<&'static str> + Copy>(word: &str) -> String {
    let known: Vec<&str> = T::VARIANTS.iter().map(|&keyword| keyword.into()).collect();
    format!("'{word}' is not one of {}{}", known.join(", "), hint(word, &known))
}

/// Empty if no known word is similar.
pub fn hint(word: &str, known: &[&str]) -> String {
    let similarity = |candidate: &&str| strsim::jaro_winkler(word, candidate);
    let best = known.iter().copied().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    let near = best.filter(|best| similarity(best) > 0.7);
    near.map_or(String::new(), |near| format!("; did you mean '{near}'?"))
}
