//! Things one after the other, the nearest first; how far away a thing is exactly is worked out only when its turn may have come.
//!
//! The box around a thing is never farther away than the thing, and lies side by side with those of others in memory, where shapes and
//! poses do not: most of what is around is never looked at (incremental nearest neighbours; Hjaltason and Samet 1999).

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use std::collections::binary_heap::PeekMut;

use simworld_core::id::EntityId;

/// What is around; kept from one look to the next for its memory alone.
#[derive(Clone, Debug, Default)]
pub(super) struct Nearest {
    around: BinaryHeap<Reverse<Candidate>>,
}

#[derive(Clone, Copy, Debug)]
struct Candidate {
    /// Its distance, or what it is not nearer than, m.
    distance: f64,
    is_exact: bool,
    id: EntityId,
}

impl Nearest {
    /// Takes the place of what was around before with things and what they are not nearer than, m.
    pub(super) fn fill(&mut self, gather: impl FnOnce(&mut dyn FnMut(EntityId, f64))) {
        let mut all = std::mem::take(&mut self.around).into_vec();
        all.clear();
        gather(&mut |id, distance| all.push(Reverse(Candidate { distance, is_exact: false, id })));
        self.around = all.into();
    }

    /// The next of them and how far away it is, m, of two at the same distance the lower id; `exact` says it for a thing, or that the
    /// thing is left out.
    pub(super) fn next(&mut self, mut exact: impl FnMut(EntityId) -> Option<f64>) -> Option<(f64, EntityId)> {
        loop {
            let mut first = self.around.peek_mut()?;
            if first.0.is_exact {
                let Reverse(Candidate { distance, id, .. }) = PeekMut::pop(first);
                return Some((distance, id));
            }
            match exact(first.0.id) {
                Some(distance) => first.0 = Candidate { distance, is_exact: true, id: first.0.id },
                None => drop(PeekMut::pop(first)),
            }
        }
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        // What may be as near is looked at before what is.
        let by_distance = self.distance.total_cmp(&other.distance);
        by_distance.then(self.is_exact.cmp(&other.is_exact)).then(self.id.cmp(&other.id))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Whatever the bounds say, things come as if all distances had been sorted.
        #[test]
        fn things_come_in_the_order_of_their_distance(
            around in prop::collection::vec((0_u32..20, 0_u32..4, prop::bool::weighted(0.8)), 0..60),
        ) {
            let exact = |id: EntityId| {
                let (distance, _, is_there) = around[id.index()];
                is_there.then_some(f64::from(distance))
            };
            let mut nearest = Nearest::default();
            nearest.fill(|put| {
                for (index, (distance, nearer, _)) in around.iter().enumerate() {
                    put(EntityId::new(index as u32, 0), f64::from(distance.saturating_sub(*nearer)));
                }
            });
            let seen: Vec<_> = std::iter::from_fn(|| nearest.next(exact)).collect();
            let ids = (0..around.len() as u32).map(|index| EntityId::new(index, 0));
            let mut expected: Vec<_> = ids.filter_map(|id| Some((exact(id)?, id))).collect();
            expected.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            prop_assert_eq!(seen, expected);
        }

        /// What is far is not looked at while enough is near.
        #[test]
        fn what_is_far_is_not_looked_at(count in 1_u32..100, most in 1_usize..10) {
            let mut nearest = Nearest::default();
            nearest.fill(|put| (0..count).for_each(|index| put(EntityId::new(index, 0), f64::from(index))));
            let mut looked_at = 0;
            for _ in 0..most {
                nearest.next(|id| { looked_at += 1; Some(id.index() as f64 + 0.5) });
            }
            prop_assert!(looked_at <= most + 1, "{looked_at}");
        }
    }
}
