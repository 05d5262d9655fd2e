//! Enums with one word per variant, in options and in files.

pub use strum::VariantArray;

/// Declares an enum with a word for each variant, which it is read from and written as.
macro_rules! keywords {
    (
        $(#[$meaning:meta])*
        $visible:vis enum $type:ident { $($(#[$detail:meta])* $variant:ident = $word:literal),* $(,)? }
    ) => {
        $(#[$meaning])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
        #[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
        #[strum(parse_err_ty = String, parse_err_fn = $crate::keyword::unknown::<$type>)]
        $visible enum $type {
            $($(#[$detail])* #[serde(rename = $word)] #[strum(serialize = $word)] $variant),*
        }
    };
}
pub(crate) use keywords;

/// Says which words are known, and which of them was meant.
pub(crate) fn unknown<T: VariantArray + Into<&'static str> + Copy>(word: &str) -> String {
    let known: Vec<&str> = T::VARIANTS.iter().map(|&keyword| keyword.into()).collect();
    format!("'{word}' is not one of {}{}", known.join(", "), hint(word, &known))
}

/// Asks whether the most similar known word was meant, if any is similar.
pub fn hint(word: &str, known: &[&str]) -> String {
    let similarity = |candidate: &&str| strsim::jaro_winkler(word, candidate);
    let best = known.iter().copied().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    let near = best.filter(|best| similarity(best) > 0.7);
    near.map_or(String::new(), |near| format!("; did you mean '{near}'?"))
}
