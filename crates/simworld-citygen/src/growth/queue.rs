//! The ends that wait to grow, in order of cost.

use simworld_core::net::RoadClass;

use super::fitted::Start;

/// More buckets than this are not made: what costs more counts the same.
const MOST: f64 = 1e6;
/// No end.
const NONE: u32 = u32::MAX;

/// An end that waits to grow: what was drawn and known when it was proposed. What it would build is worked out when its turn
/// comes, which for many is never.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// What its children's costs go on from: its cost without what its place adds.
    pub(super) steps: f64,
    /// The direction in which it grows, radians.
    pub(super) heading: f64,
    /// By so much the logarithm of its length differs from that of the mean.
    pub(super) spread: f64,
    /// How densely people live where it begins, in [0, 1].
    pub(super) density: f64,
    pub(super) from: Start,
    pub(super) class: RoadClass,
    /// Whether it runs along the grain of the land rather than across it.
    pub(super) with_grain: bool,
    /// Whether it is built only where it divides a large block.
    pub(super) divides: bool,
}

/// An end and the one below it in its bucket.
#[derive(Clone, Copy, Debug)]
struct Slot {
    end: End,
    below: u32,
}

/// A priority queue of buckets: an end of the least cost, in steps of some size, leaves first; of those, the youngest.
///
/// Ends that are proposed one after the other lie near each other, and so they leave one after the other: what growth
/// looks at is in the caches still. By exact cost it would go to and fro across the whole edge of the town.
#[derive(Clone, Debug)]
pub(super) struct Queue {
    steps_per_cost: f64,
    /// The ends of all buckets. A place that was left is taken by the next end that comes: it is in the caches still.
    slots: Vec<Slot>,
    /// The uppermost of the places that are free.
    free: u32,
    /// The uppermost end of each bucket.
    buckets: Vec<u32>,
    /// No bucket before this one holds any.
    first: usize,
}

impl Queue {
    /// An empty queue that tells so many steps of cost from one unit of it to the next.
    pub(super) fn new(steps_per_cost: f64) -> Self {
        Self { steps_per_cost, slots: Vec::new(), free: NONE, buckets: Vec::new(), first: 0 }
    }

    /// Puts in an end with a cost; what is below zero counts as zero.
    pub(super) fn push(&mut self, cost: f64, end: End) {
        let bucket = (cost * self.steps_per_cost).min(MOST) as usize;
        if bucket >= self.buckets.len() {
            self.buckets.resize(bucket + 1, NONE);
        }
        let slot = Slot { end, below: self.buckets[bucket] };
        self.buckets[bucket] = if let Some(place) = self.slots.get_mut(self.free as usize) {
            let taken = std::mem::replace(&mut self.free, place.below);
            *place = slot;
            taken
        } else {
            self.slots.push(slot);
            self.slots.len() as u32 - 1
        };
        self.first = self.first.min(bucket);
    }

    /// Takes out an end of the least cost.
    pub(super) fn pop(&mut self) -> Option<End> {
        let waiting = self.buckets.get(self.first..)?.iter().position(|top| *top != NONE);
        self.first = waiting.map_or(self.buckets.len(), |steps| self.first + steps);
        let top = self.buckets.get_mut(self.first)?;
        let place = &mut self.slots[*top as usize];
        let (end, below) = (place.end, std::mem::replace(&mut place.below, self.free));
        self.free = std::mem::replace(top, below);
        Some(end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_leave_by_steps_of_cost() {
        let end = |steps: f64| End {
            steps,
            heading: 0.0,
            spread: 0.0,
            density: 0.5,
            from: Start::Node(0),
            class: RoadClass::Local,
            with_grain: true,
            divides: false,
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
