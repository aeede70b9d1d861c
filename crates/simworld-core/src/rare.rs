//! What few of many have.

use std::fmt;
use std::ops::{Deref, DerefMut};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// What is as good as nothing.
pub trait Blank: Default + PartialEq + 'static {
    /// Nothing.
    const BLANK: &'static Self;
}

impl<T: PartialEq + 'static> Blank for Vec<T> {
    const BLANK: &'static Self = &Self::new();
}

/// Something that few of many have: it takes the room of a pointer where it is blank, and is read, changed and saved like what
/// it is.
///
/// ```
/// use simworld_core::rare::Rare;
/// let mut heights: Rare<Vec<f64>> = Rare::default();
/// assert!(heights.is_empty() && size_of_val(&heights) == size_of::<usize>());
/// heights.push(3.0);
/// assert_eq!(heights, vec![3.0].into());
/// ```
#[derive(Clone)]
pub struct Rare<T>(Option<Box<T>>);

impl<T> Default for Rare<T> {
    fn default() -> Self {
        Self(None)
    }
}

impl<T: Blank> Deref for Rare<T> {
    type Target = T;

    fn deref(&self) -> &T {
        self.0.as_deref().unwrap_or(T::BLANK)
    }
}

impl<T: Blank> DerefMut for Rare<T> {
    fn deref_mut(&mut self) -> &mut T {
        self.0.get_or_insert_default()
    }
}

impl<T: Blank> From<T> for Rare<T> {
    fn from(value: T) -> Self {
        Self((value != *T::BLANK).then(|| Box::new(value)))
    }
}

impl<T: Blank> PartialEq for Rare<T> {
    fn eq(&self, other: &Self) -> bool {
        (self.0.is_none() && other.0.is_none()) || **self == **other
    }
}

impl<T: Blank + fmt::Debug> fmt::Debug for Rare<T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(formatter)
    }
}

impl<'a, T: PartialEq + 'static> IntoIterator for &'a Rare<Vec<T>> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<T: Blank + Serialize> Serialize for Rare<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (**self).serialize(serializer)
    }
}

impl<'de, T: Blank + Deserialize<'de>> Deserialize<'de> for Rare<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::deserialize(deserializer).map(Into::into)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_emptied_is_the_same_as_what_never_was() {
        let mut rare: Rare<Vec<u32>> = vec![1, 2].into();
        assert_eq!(format!("{rare:?}"), "[1, 2]");
        assert_ne!(rare, Rare::default());
        rare.clear();
        assert_eq!(rare, Rare::default());
        assert_eq!(rare, Vec::new().into());
    }

    #[test]
    fn it_is_saved_like_what_it_is() {
        for value in [vec![], vec![3, 4]] {
            let rare: Rare<Vec<u32>> = value.clone().into();
            let saved = serde_json::to_string(&rare).expect("it is a list");
            assert_eq!(saved, serde_json::to_string(&value).expect("it is a list"));
            assert_eq!(serde_json::from_str::<Rare<Vec<u32>>>(&saved).expect("it is what was saved"), rare);
        }
    }
}
