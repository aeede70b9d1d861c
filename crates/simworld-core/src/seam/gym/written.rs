//! Numbers that may be infinite, as text formats take them: JSON has no infinity, so there they are words.

use std::fmt;

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number that is written as `"inf"`, `"-inf"` or `"nan"` where it is not finite and people read along.
struct Wide(f64);

impl Serialize for Wide {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() || !serializer.is_human_readable() {
            serializer.serialize_f64(self.0)
        } else if self.0.is_nan() {
            serializer.serialize_str("nan")
        } else {
            serializer.serialize_str(if self.0 > 0.0 { "inf" } else { "-inf" })
        }
    }
}

impl<'de> Deserialize<'de> for Wide {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            deserializer.deserialize_any(WideVisitor)
        } else {
            f64::deserialize(deserializer).map(Self)
        }
    }
}

struct WideVisitor;

impl Visitor<'_> for WideVisitor {
    type Value = Wide;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, \"inf\", \"-inf\" or \"nan\"")
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Wide, E> {
        Ok(Wide(number))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Wide, E> {
        Ok(Wide(number as f64))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Wide, E> {
        Ok(Wide(number as f64))
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<Wide, E> {
        match word {
            "inf" => Ok(Wide(f64::INFINITY)),
            "-inf" => Ok(Wide(f64::NEG_INFINITY)),
            "nan" => Ok(Wide(f64::NAN)),
            _ => Err(E::invalid_value(serde::de::Unexpected::Str(word), &self)),
        }
    }
}

/// One number.
pub(super) mod number {
    use super::{Deserialize, Deserializer, Serialize, Serializer, Wide};

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
    pub(in super::super) fn serialize<S: Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        Wide(*number).serialize(serializer)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Wide::deserialize(deserializer).map(|wide| wide.0)
    }
}

/// A list of numbers.
pub(super) mod numbers {
    use super::{Deserialize, Deserializer, Serializer, Wide};

    pub(in super::super) fn serialize<S: Serializer>(
        numbers: &[f64],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(numbers.iter().map(|number| Wide(*number)))
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Vec<f64>, D::Error> {
        let wide = Vec::<Wide>::deserialize(deserializer)?;
        Ok(wide.into_iter().map(|wide| wide.0).collect())
    }
}
