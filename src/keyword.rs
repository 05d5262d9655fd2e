//! Enums with one word per variant, in options and in files.

/// An enum with one word per variant.
pub trait Keyword: Copy + PartialEq + 'static {
    /// All variants, in their order.
    const ALL: &'static [Self];

    /// Returns the word.
    fn as_str(self) -> &'static str;
}

/// Declares an enum with a word for each variant, with [`Keyword`], `FromStr`, `Display` and serde.
macro_rules! keywords {
    (
        $(#[$meaning:meta])*
        $visible:vis enum $type:ident { $($(#[$detail:meta])* $variant:ident = $word:literal),* $(,)? }
    ) => {
        $(#[$meaning])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
        $visible enum $type {
            $($(#[$detail])* #[serde(rename = $word)] $variant),*
        }

        impl $crate::keyword::Keyword for $type {
            const ALL: &'static [Self] = &[$(Self::$variant),*];

            fn as_str(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),*
                }
            }
        }

        impl std::str::FromStr for $type {
            type Err = String;

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

/// Returns the variant of a word.
///
/// # Errors
/// If no variant has it, with the known words and the most similar of them.
pub fn parse<T: Keyword>(word: &str) -> Result<T, String> {
    let found = T::ALL.iter().find(|keyword| keyword.as_str() == word).copied();
    found.ok_or_else(|| {
        let known: Vec<&str> = T::ALL.iter().map(|keyword| keyword.as_str()).collect();
        format!("'{word}' is not one of {}{}", known.join(", "), hint(word, &known))
    })
}

/// Asks whether the most similar known word was meant, if any is similar.
pub fn hint(word: &str, known: &[&str]) -> String {
    let similarity = |candidate: &&str| strsim::jaro_winkler(word, candidate);
    let best = known.iter().copied().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    let near = best.filter(|best| similarity(best) > 0.7);
    near.map_or(String::new(), |near| format!("; did you mean '{near}'?"))
}
