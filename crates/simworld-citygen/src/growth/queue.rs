//! The ends that wait to grow, in order of cost.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::proposal::Proposal;

/// An end that waits to grow.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// What its children's costs go on from: its cost without what its place adds.
    pub(super) steps: f64,
    pub(super) proposal: Proposal,
}

/// A priority queue: the end with the least cost leaves first, the older of two that cost the same.
///
/// What is moved to keep the order is one number for each end; the ends themselves stay where they are.
#[derive(Clone, Debug, Default)]
pub(super) struct Queue {
    /// From the highest bits down: cost (64 bits), order of insertion (32), place of the end (32).
    keys: BinaryHeap<Reverse<u128>>,
    ends: Vec<End>,
    /// Places that are free, last in first out.
    free: Vec<u32>,
    serial: u32,
}

impl Queue {
    /// Puts in an end with a cost that is not below zero.
    pub(super) fn push(&mut self, cost: f64, end: End) {
        debug_assert!(cost >= 0.0, "the bits of costs are in order from zero up");
        let place = if let Some(place) = self.free.pop() {
            self.ends[place as usize] = end;
            place
        } else {
            self.ends.push(end);
            self.ends.len() as u32 - 1
        };
        let key = u128::from(cost.to_bits()) << 64 | u128::from(self.serial) << 32 | u128::from(place);
        // Four thousand million ends later, the order of equal costs would start again: a million streets need ten.
        self.serial = self.serial.wrapping_add(1);
        self.keys.push(Reverse(key));
    }

    /// Takes out the end with the least cost.
    pub(super) fn pop(&mut self) -> Option<End> {
        let Reverse(key) = self.keys.pop()?;
        let place = key as u32;
        self.free.push(place);
        Some(self.ends[place as usize])
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Vector2;
    use simworld_core::net::RoadClass;

    use super::super::fitted::Start;
    use super::*;

    #[test]
    fn ends_leave_by_cost_and_then_by_age() {
        let end = |steps: f64| {
            let proposal = Proposal {
                from: Start::Node(0),
                along: Vector2::x(),
                length: 1.0,
                class: RoadClass::Local,
                emptiness: 0.0,
            };
            End { steps, proposal }
        };
        let mut queue = Queue::default();
        let mut left = Vec::new();
        for (number, cost) in [3.0, 0.5, 0.0, 1e9, 0.5, 0.25].into_iter().enumerate() {
            queue.push(cost, end(number as f64));
        }
        left.extend(queue.pop().map(|end| end.steps));
        // The place that became free is used again, and says nothing of age.
        queue.push(0.5, end(6.0));
        left.extend(std::iter::from_fn(|| queue.pop()).map(|end| end.steps));
        assert_eq!(left, [2.0, 5.0, 1.0, 4.0, 6.0, 0.0, 3.0]);
    }
}
