//! State hashes: 64 bits that change when any bit of the simulated state does.
//!
//! Two runs that print the same trail of hashes went through the same states. Floating-point numbers enter by
//! their bits, so `0.0` and `-0.0` differ.

use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::{Xxh3, xxh3_64, xxh3_128};

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

/// What fits is digested at once, which for an entity takes a fraction of what a stream of its fields does, bytes.
const ROOM: usize = 512;

/// Accumulates a state (XXH3, 64 bit).
#[derive(Clone)]
pub struct StateHasher {
    /// What was added last and is no part of the stream yet.
    tail: [u8; ROOM],
    len: usize,
    /// Everything before, if it was more than fits.
    stream: Option<Box<Xxh3>>,
}

impl Default for StateHasher {
    fn default() -> Self {
        Self { tail: [0; ROOM], len: 0, stream: None }
    }
}

impl StateHasher {
    /// An empty hasher.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds raw bytes; add a length before bytes of variable length.
    pub fn bytes(&mut self, bytes: &[u8]) -> &mut Self {
        match self.tail.get_mut(self.len..self.len + bytes.len()) {
            Some(room) => {
                room.copy_from_slice(bytes);
                self.len += bytes.len();
            }
            None => self.pass_on(bytes),
        }
        self
    }

    /// Adds an integer.
    #[inline]
    pub fn u64(&mut self, value: u64) -> &mut Self {
        match self.tail.get_mut(self.len..self.len + 8) {
            Some(room) => {
                room.copy_from_slice(&value.to_le_bytes());
                self.len += 8;
            }
            None => self.pass_on(&value.to_le_bytes()),
        }
        self
    }

    /// Passes on to the stream what was added so far, and some more.
    #[cold]
    fn pass_on(&mut self, bytes: &[u8]) {
        let stream = self.stream.get_or_insert_default();
        stream.update(&self.tail[..self.len]);
        stream.update(bytes);
        self.len = 0;
    }

    /// The stream of everything added so far, if it is more than fits.
    fn whole(&self) -> Option<Box<Xxh3>> {
        let mut stream = self.stream.clone()?;
        stream.update(&self.tail[..self.len]);
        Some(stream)
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
        self.whole().map_or_else(|| xxh3_128(&self.tail[..self.len]), |stream| stream.digest128())
    }

    /// The digest of everything added so far.
    pub fn finish(&self) -> StateDigest {
        let digest = self.whole().map_or_else(|| xxh3_64(&self.tail[..self.len]), |stream| stream.digest());
        StateDigest(digest)
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
    fn whatever_the_parts_the_digest_is_that_of_the_bytes() {
        let mut rng = crate::seed::Seed(9).stream("test/hash").rng();
        for length in (0..600).chain([1000, 1024, 1025, 5000, 20_000]) {
            let bytes: Vec<u8> = (0..length).map(|_| rng.below(256) as u8).collect();
            let mut hasher = StateHasher::new();
            let mut left = bytes.as_slice();
            while !left.is_empty() {
                let (part, rest) =
                    left.split_at([1, 8, 8, 8, 24, 511, 512, 700][rng.below(8)].min(left.len()));
                match <[u8; 8]>::try_from(part) {
                    Ok(word) => hasher.u64(u64::from_le_bytes(word)),
                    Err(_) => hasher.bytes(part),
                };
                left = rest;
            }
            assert_eq!(hasher.finish().0, xxh3_64(&bytes), "{length} bytes");
            assert_eq!(hasher.finish_wide(), xxh3_128(&bytes), "{length} bytes");
            assert_eq!(hasher.u64(7).finish(), StateHasher::new().bytes(&bytes).u64(7).finish(), "goes on");
        }
    }

    #[test]
    fn a_digest_reads_as_hex_and_back() {
        let digest = StateHasher::new().str("city").finish();
        let text = serde_json::to_string(&digest).unwrap();
        assert_eq!(serde_json::from_str::<StateDigest>(&text).unwrap(), digest);
        assert!(serde_json::from_str::<StateDigest>("\"city\"").is_err());
    }
}
