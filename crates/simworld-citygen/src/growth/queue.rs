//! The ends that wait to grow, in order of cost.

use super::proposal::Proposal;

/// More buckets than this are not made: what costs more counts the same.
const MOST: f64 = 1e6;

/// An end that waits to grow.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// What its children's costs go on from: its cost without what its place adds.
    pub(super) steps: f64,
    /// The direction in which it grows, radians.
    pub(super) heading: f64,
    pub(super) proposal: Proposal,
}

/// A priority queue of buckets: an end of the least cost, in steps of some size, leaves first; of those, the youngest.
///
/// Ends that are proposed one after the other lie near each other, and so they leave one after the other: what growth
/// looks at is in the caches still. By exact cost it would go to and fro across the whole edge of the town.
#[derive(Clone, Debug)]
pub(super) struct Queue {
    steps_per_cost: f64,
    buckets: Vec<Vec<End>>,
    /// No bucket before this one holds any.
    first: usize,
}

impl Queue {
    /// An empty queue that tells so many steps of cost from one unit of it to the next.
    pub(super) fn new(steps_per_cost: f64) -> Self {
        Self { steps_per_cost, buckets: Vec::new(), first: 0 }
    }

    /// Puts in an end with a cost; what is below zero counts as zero.
    pub(super) fn push(&mut self, cost: f64, end: End) {
        let bucket = (cost * self.steps_per_cost).min(MOST) as usize;
        if bucket >= self.buckets.len() {
            self.buckets.resize_with(bucket + 1, Vec::new);
        }
        self.buckets[bucket].push(end);
        self.first = self.first.min(bucket);
    }

    /// Takes out an end of the least cost.
    pub(super) fn pop(&mut self) -> Option<End> {
        while let Some(bucket) = self.buckets.get_mut(self.first) {
            if let Some(end) = bucket.pop() {
                return Some(end);
            }
            *bucket = Vec::new();
            self.first += 1;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Vector2;
    use simworld_core::net::RoadClass;

    use super::super::fitted::Start;
    use super::*;

    #[test]
    fn ends_leave_by_steps_of_cost() {
        let end = |steps: f64| {
            let proposal = Proposal {
                from: Start::Node(0),
                along: Vector2::x(),
                length: 1.0,
                class: RoadClass::Local,
                emptiness: 0.0,
            };
            End { steps, heading: 0.0, proposal }
        };
        let mut queue = Queue::new(2.0);
        for (number, cost) in [1.5, 0.75, 0.25, 1e9, 0.6].into_iter().enumerate() {
            queue.push(cost, end(number as f64));
        }
        let mut left: Vec<f64> = (0..2).filter_map(|_| queue.pop()).map(|end| end.steps).collect();
        // One that costs less than those that left already.
        queue.push(0.05, end(5.0));
        left.extend(std::iter::from_fn(|| queue.pop()).map(|end| end.steps));
        assert_eq!(left, [2.0, 4.0, 5.0, 1.0, 0.0, 3.0]);
        assert!(queue.pop().is_none());
    }
}
