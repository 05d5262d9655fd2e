//! Enums with one word per variant, in options and in files.

/// An enum with one word per variant.
pub trait Keyword: Copy + PartialEq + 'static {
    /// All variants, in their order.
    const ALL: &'static [Self];
    /// Advice on words that a user may expect on the list.
    const ADVICE: &'static [(&'static str, &'static str)] = &[];

    /// Returns the word.
    fn as_str(self) -> &'static str;
}

/// Declares an enum with a word for each variant, with [`Keyword`], `FromStr`, `Display` and serde.
macro_rules! keywords {
    (
        $(#[$meaning:meta])*
        $visible:vis enum $type:ident { $($(#[$detail:meta])* $variant:ident = $word:literal),* $(,)? }
        $(but $advice:expr)?
    ) => {
        $(#[$meaning])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
        $visible enum $type {
            $($(#[$detail])* #[serde(rename = $word)] $variant),*
        }

        impl $crate::keyword::Keyword for $type {
            const ALL: &'static [Self] = &[$(Self::$variant),*];
            $(const ADVICE: &'static [(&'static str, &'static str)] = $advice;)?

            fn as_str(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),*
                }
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::keyword::UnknownKeyword;

            fn from_str(word: &str) -> Result<Self, Self::Err> {
                $crate::keyword::parse(word)
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.pad($crate::keyword::Keyword::as_str(*self))
            }
        }
    };
}
pub(crate) use keywords;

/// An unknown word: the known ones, and the most similar of them or advice.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct UnknownKeyword(String);

/// Returns the variant of a word.
///
/// # Errors
/// If no variant has it, with the most similar word.
pub fn parse<T: Keyword>(word: &str) -> Result<T, UnknownKeyword> {
    let found = T::ALL.iter().find(|keyword| keyword.as_str() == word).copied();
    found.ok_or_else(|| {
        let known: Vec<&str> = T::ALL.iter().map(|keyword| keyword.as_str()).collect();
        let advice = T::ADVICE.iter().find(|(other, _)| *other == word);
        let advice = advice.map_or_else(|| hint(word, &known), |(_, advice)| format!("; {advice}"));
        UnknownKeyword(format!("'{word}' is not one of {}{advice}", known.join(", ")))
    })
}

/// Asks whether the most similar known word was meant, if any is similar.
pub fn hint(word: &str, known: &[&str]) -> String {
    let similarity = |candidate: &&str| strsim::jaro_winkler(word, candidate);
    let best = known.iter().copied().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    let near = best.filter(|best| similarity(best) > 0.7);
    near.map_or(String::new(), |near| format!("; did you mean '{near}'?"))
}
