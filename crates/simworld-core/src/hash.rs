//! State hashes: 64 bits that change when any bit of the simulated state does.
//!
//! Two runs that print the same trail of hashes went through the same states. Floating-point numbers enter by
//! their bits, so `0.0` and `-0.0` differ.

use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::Xxh3;

use crate::geometry::{Point3, Pose, Twist, Vector3};

/// The digest of a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct StateDigest(pub u64);

impl std::fmt::Display for StateDigest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

impl Serialize for StateDigest {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for StateDigest {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = <std::borrow::Cow<'_, str>>::deserialize(deserializer)?;
        u64::from_str_radix(&text, 16).map(Self).map_err(|_| {
            serde::de::Error::invalid_value(
                serde::de::Unexpected::Str(&text),
                &"a state digest of 16 hex digits",
            )
        })
    }
}

/// Something whose state can be put into a [`StateHasher`].
pub trait StateHash {
    /// Feeds every bit of state that influences the future, in a fixed order.
    fn state_hash(&self, hasher: &mut StateHasher);

    /// The digest of this state alone.
    fn digest(&self) -> StateDigest {
        let mut hasher = StateHasher::new();
        self.state_hash(&mut hasher);
        hasher.finish()
    }
}

/// Accumulates a state (XXH3, 64 bit).
#[derive(Clone, Default)]
pub struct StateHasher(Xxh3);

impl StateHasher {
    /// An empty hasher.
    pub fn new() -> Self {
        Self(Xxh3::new())
    }

    /// Adds raw bytes; add a length before bytes of variable length.
    pub fn bytes(&mut self, bytes: &[u8]) -> &mut Self {
        self.0.update(bytes);
        self
    }

    /// Adds an integer.
    pub fn u64(&mut self, value: u64) -> &mut Self {
        self.bytes(&value.to_le_bytes())
    }

    /// Adds a number by its bits.
    pub fn f64(&mut self, value: f64) -> &mut Self {
        self.u64(value.to_bits())
    }

    /// Adds text with its length.
    pub fn str(&mut self, text: &str) -> &mut Self {
        self.u64(text.len() as u64).bytes(text.as_bytes())
    }

    /// Adds a vector.
    pub fn vector(&mut self, vector: &Vector3) -> &mut Self {
        self.f64(vector.x).f64(vector.y).f64(vector.z)
    }

    /// Adds a point.
    pub fn point(&mut self, point: &Point3) -> &mut Self {
        self.vector(&point.coords)
    }

    /// Adds a pose.
    pub fn pose(&mut self, pose: &Pose) -> &mut Self {
        let rotation = pose.rotation.coords;
        self.vector(&pose.translation.vector).f64(rotation.x).f64(rotation.y).f64(rotation.z).f64(rotation.w)
    }

    /// Adds a twist.
    pub fn twist(&mut self, twist: &Twist) -> &mut Self {
        self.vector(&twist.linear).vector(&twist.angular)
    }

    /// The digest of everything added so far, with 128 bits: for what has to be told apart among very many.
    pub fn finish_wide(&self) -> u128 {
        self.0.digest128()
    }

    /// The digest of everything added so far.
    pub fn finish(&self) -> StateDigest {
        StateDigest(self.0.digest())
    }
}

impl std::fmt::Debug for StateHasher {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "StateHasher({})", self.finish())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_of_zero_is_seen() {
        assert_ne!(StateHasher::new().f64(0.0).finish(), StateHasher::new().f64(-0.0).finish());
    }

    #[test]
    fn a_digest_reads_as_hex_and_back() {
        let digest = StateHasher::new().str("city").finish();
        let text = serde_json::to_string(&digest).unwrap();
        assert_eq!(serde_json::from_str::<StateDigest>(&text).unwrap(), digest);
        assert!(serde_json::from_str::<StateDigest>("\"city\"").is_err());
    }
}
