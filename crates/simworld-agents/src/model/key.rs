//! Keys of requests: 128 bits of their canonical JSON.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use xxhash_rust::xxh3::xxh3_128;

/// The hash of a request; written as 32 hex digits.
///
/// XXH3 (128 bit) of the JSON without spaces and with the members of every object in the order of their names. Two different
/// requests of a run share a key with a probability of less than 1 in 10^20 for a billion requests; who can choose requests
/// can make two that do, so a key proves nothing about its origin.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RequestKey(u128);

impl RequestKey {
    pub(super) fn of<T: Serialize>(value: &T) -> Self {
        // The types hashed here have text for names and numbers that JSON knows or writes as null: nothing fails.
        let value = serde_json::to_value(value).unwrap_or(Value::Null);
        let mut text = String::new();
        write_canonical(&value, &mut text);
        Self(xxh3_128(text.as_bytes()))
    }
}

impl std::fmt::Display for RequestKey {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl std::fmt::Debug for RequestKey {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "RequestKey({self})")
    }
}

impl Serialize for RequestKey {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for RequestKey {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = <std::borrow::Cow<'_, str>>::deserialize(deserializer)?;
        u128::from_str_radix(&text, 16).map(Self).map_err(|_| {
            serde::de::Error::invalid_value(
                serde::de::Unexpected::Str(&text),
                &"a request's key of 32 hex digits",
            )
        })
    }
}

/// Writes the members in the order of their names, whether or not `serde_json` was built to keep another.
fn write_canonical(value: &Value, out: &mut String) {
    match value {
        Value::Object(members) => {
            let mut members: Vec<_> = members.iter().collect();
            members.sort_unstable_by_key(|(name, _)| *name);
            out.push('{');
            for (index, (name, value)) in members.into_iter().enumerate() {
                out.push_str(if index == 0 { "" } else { "," });
                out.push_str(&Value::from(name.as_str()).to_string());
                out.push(':');
                write_canonical(value, out);
            }
            out.push('}');
        }
        Value::Array(items) => {
            out.push('[');
            for (index, item) in items.iter().enumerate() {
                out.push_str(if index == 0 { "" } else { "," });
                write_canonical(item, out);
            }
            out.push(']');
        }
        plain => out.push_str(&plain.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{ChatRequest, Image, Message};
    use super::*;

    #[test]
    fn keys_never_change() {
        // Golden: a change here makes every recording of every user useless.
        let mut request = ChatRequest::new([Message::system("You walk."), Message::user("Where to?")])
            .with_schema("step", serde_json::json!({"type": "object", "properties": {}}));
        request.temperature = Some(0.7);
        request.seed = Some(5);
        assert_eq!(request.key().to_string(), "54a5fccd77a2444945bfed1e01e9056a");
    }

    #[test]
    fn everything_asked_is_in_the_key() {
        let base = ChatRequest::new([Message::user("a"), Message::user("b")]);
        let mut others = vec![base.clone(); 9];
        others[0].model = Some("m".into());
        others[1].messages.swap(0, 1);
        others[2].max_tokens = Some(0);
        others[3].temperature = Some(0.0);
        others[4].seed = Some(0);
        others[5].stop = vec![String::new()];
        others[6] = base.clone().with_schema("a", Value::Null);
        others[7].messages[0] = Message::user("a").with_image(Image::png(vec![1]));
        others[8].messages[0] = Message::user("a").with_image(Image::png(vec![2]));
        let mut keys: Vec<_> = others.iter().chain([&base]).map(ChatRequest::key).collect();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), 10);
        assert_eq!(others[4].prompt_key(), base.prompt_key());
        assert_ne!(others[1].prompt_key(), base.prompt_key());
    }

    #[test]
    fn a_key_reads_back() {
        let key = ChatRequest::default().key();
        let text = serde_json::to_string(&key).unwrap();
        assert_eq!(text.len(), 34);
        assert_eq!(serde_json::from_str::<RequestKey>(&text).unwrap(), key);
        assert!(serde_json::from_str::<RequestKey>("\"key\"").is_err());
    }
}
