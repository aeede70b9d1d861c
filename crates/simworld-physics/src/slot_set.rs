//! A set of slots of a world, a bit for each.

/// Slots, looked through in ascending order.
#[derive(Clone, Debug, Default)]
pub(crate) struct SlotSet {
    words: Vec<u64>,
}

impl SlotSet {
    pub(crate) fn clear(&mut self) {
        self.words.fill(0);
    }

    pub(crate) fn insert(&mut self, slot: usize) {
        if self.words.len() <= slot / 64 {
            self.words.resize(slot / 64 + 1, 0);
        }
        self.words[slot / 64] |= 1 << (slot % 64);
    }

    pub(crate) fn remove(&mut self, slot: usize) {
        if let Some(word) = self.words.get_mut(slot / 64) {
            *word &= !(1 << (slot % 64));
        }
    }

    /// Adds all of another set.
    pub(crate) fn unite(&mut self, other: &Self) {
        let length = self.words.len().max(other.words.len());
        self.words.resize(length, 0);
        for (word, more) in self.words.iter_mut().zip(&other.words) {
            *word |= more;
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.words.iter().enumerate().flat_map(|(index, word)| {
            let mut left = *word;
            std::iter::from_fn(move || {
                let bit = (left != 0).then(|| left.trailing_zeros() as usize)?;
                left &= left - 1;
                Some(index * 64 + bit)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn it_is_a_set() {
        let mut rng = Seed(5).stream("test/slots").rng();
        let (mut set, mut expected) = (SlotSet::default(), BTreeSet::new());
        for _ in 0..2000 {
            let slot = rng.below(300);
            if rng.chance(0.6) {
                set.insert(slot);
                expected.insert(slot);
            } else {
                set.remove(slot);
                expected.remove(&slot);
            }
            assert!(set.iter().eq(expected.iter().copied()));
        }
        let mut other = SlotSet::default();
        other.insert(1000);
        set.unite(&other);
        expected.insert(1000);
        assert!(set.iter().eq(expected.iter().copied()));
        set.clear();
        assert_eq!(set.iter().count(), 0);
    }
}
