//! YAML as JSON values, with numbers and the like as the texts that were written: a name may be `007` or
//! `yes`.

use std::fmt;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error as _, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};
use serde_saphyr::{Spanned, UserMessageFormatter, with_deserializer_from_str};

/// Parses YAML. What is left empty, or null outside of a mapping in a list, is null.
pub fn parse(text: &str) -> Result<Value, String> {
    let whole = serde_saphyr::from_str(text).and_then(|shape: Value| {
        with_deserializer_from_str(text, |yaml| Written { text, shape: &shape, depth: 0 }.deserialize(yaml))
    });
    whole.map_err(|error| {
        let told = error.without_snippet().render_with_formatter(&UserMessageFormatter);
        told.lines().next().unwrap_or_default().to_string()
    })
}

/// A value to read, which has the shape of one read before.
#[derive(Clone, Copy)]
struct Written<'a> {
    text: &'a str,
    shape: &'a Value,
    depth: usize,
}

/// The least depth of the options of a structure in a pipeline file: section, option, structure.
const IN_STRUCTURE: usize = 3;

impl<'de> DeserializeSeed<'de> for Written<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, yaml: D) -> Result<Value, D::Error> {
        match self.shape {
            Value::Array(_) => yaml.deserialize_seq(self),
            Value::Object(_) => yaml.deserialize_map(self),
            Value::Null if self.depth < IN_STRUCTURE => yaml.deserialize_any(self),
            Value::Null => {
                let span = Spanned::<Value>::deserialize(yaml)?.referenced.span();
                let start = span.byte_offset().unwrap_or_default() as usize;
                let written = self.text.get(start..start + span.byte_len().unwrap_or_default() as usize);
                Ok(written.filter(|text| !text.is_empty()).map_or(Value::Null, Value::from))
            }
            _ => yaml.deserialize_string(self),
        }
    }
}

impl<'de> Visitor<'de> for Written<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a text, a list or a mapping")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_str<E>(self, text: &str) -> Result<Value, E> {
        Ok(Value::from(text))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        static NOTHING: Value = Value::Null;
        let mut values = Vec::new();
        loop {
            let shape = self.shape.get(values.len()).unwrap_or(&NOTHING);
            match items.next_element_seed(Written { shape, depth: self.depth + 1, ..self })? {
                Some(item) => values.push(item),
                None => return Ok(Value::Array(values)),
            }
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, mut pairs: A) -> Result<Value, A::Error> {
        let mut values = Map::new();
        while let Some(key) = pairs.next_key::<String>()? {
            let shape =
                self.shape.get(&key).ok_or_else(|| A::Error::custom(format!("unexpected '{key}'")))?;
            let value = pairs.next_value_seed(Written { shape, depth: self.depth + 1, ..self })?;
            values.insert(key, value);
        }
        Ok(Value::Object(values))
    }
}
