//! Enums with one word per variant, in options and in files.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{EnumAccess, Error, VariantAccess, Visitor};

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
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        $visible enum $type {
            $($(#[$detail])* $variant),*
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

        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str($crate::keyword::Keyword::as_str(*self))
            }
        }

        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let words = $crate::keyword::Words(std::marker::PhantomData);
                deserializer.deserialize_enum(stringify!($type), &[$($word),*], words)
            }
        }
    };
}
pub(crate) use keywords;

/// Takes the word of a variant from a file.
pub struct Words<T>(pub PhantomData<T>);

impl<'de, T: Keyword> Visitor<'de> for Words<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a word")
    }

    fn visit_enum<A: EnumAccess<'de>>(self, access: A) -> Result<T, A::Error> {
        let (word, variant) = access.variant::<String>()?;
        variant.unit_variant()?;
        parse(&word).map_err(A::Error::custom)
    }
}

/// An unknown word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownKeyword {
    word: String,
    known: Vec<&'static str>,
    advice: Option<&'static str>,
}

impl fmt::Display for UnknownKeyword {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "'{}' is not one of {}", self.word, self.known.join(", "))?;
        match self.advice {
            Some(advice) => write!(f, "; {advice}"),
            None => f.write_str(&hint(&self.word, &self.known)),
        }
    }
}

impl std::error::Error for UnknownKeyword {}

/// Returns the variant of a word.
///
/// # Errors
/// If no variant has it, with the most similar word.
pub fn parse<T: Keyword>(word: &str) -> Result<T, UnknownKeyword> {
    let found = T::ALL.iter().find(|keyword| keyword.as_str() == word).copied();
    found.ok_or_else(|| UnknownKeyword {
        word: word.to_string(),
        known: T::ALL.iter().map(|keyword| keyword.as_str()).collect(),
        advice: T::ADVICE.iter().find(|(other, _)| *other == word).map(|(_, advice)| *advice),
    })
}

/// Asks whether the most similar known word was meant, if any is similar.
pub fn hint(word: &str, known: &[&str]) -> String {
    let similarity = |candidate: &&str| strsim::jaro_winkler(word, candidate);
    let best = known.iter().copied().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    let near = best.filter(|best| similarity(best) > 0.7);
    near.map_or(String::new(), |near| format!("; did you mean '{near}'?"))
}
