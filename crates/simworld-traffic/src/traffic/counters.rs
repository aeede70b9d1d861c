//! What is counted.

use serde::{Deserialize, Serialize};

/// What was counted since the start; the first two say how much was done, the others what went less than well.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counters {
    /// Vehicle updates.
    pub updates: u64,
    /// Leaves to cross an intersection.
    pub crossings: u64,
    /// Steps in which a vehicle went on at red because it could no longer stop.
    pub dilemmas: u64,
    /// Times that an emergency vehicle passed a red light with its siren on.
    pub reds_by_siren: u64,
    /// Times that a vehicle was held at a stop line, or far from all interest behind another, by more than its brakes.
    pub forced_stops: u64,
    /// Times that a vehicle had stood for three minutes.
    pub long_waits: u64,
    /// Lane changes.
    pub lane_changes: u64,
    /// Times that a vehicle went out on the oncoming lane to pass what stood on its own.
    pub obstacles_passed: u64,
    /// Vehicles that took another route because they could not get into the lane of theirs, or to undo a lock.
    pub rerouted: u64,
    /// Vehicles that took another route because theirs had become slow.
    pub detours: u64,
    /// Rings of full lanes, each waiting for the next, that were found and undone.
    pub locks: u64,
    /// Vehicles that entered a junction without room behind it to undo a lock.
    pub passes: u64,
    /// Halts that were made: at stops, and where somebody was told to halt.
    pub halts: u64,
    /// Stops that were given up because the way no longer led by, or because they came too soon.
    pub missed_stops: u64,
    /// Vehicles that entered after the start.
    pub entered: u64,
    /// Vehicles that came to the end of their route.
    pub arrived: u64,
    /// Vehicles that were taken out, gave up without a way, or parked: [`Trip::end`](crate::Trip::end) says which.
    pub removed: u64,
    /// Walkers that entered after the start.
    pub walkers_entered: u64,
    /// Walks that came to their destination.
    pub walkers_arrived: u64,
    /// Walkers that left there.
    pub walkers_left: u64,
    /// Walkers that were taken out.
    pub walkers_removed: u64,
    /// Times that a walker crossed at red.
    pub jaywalks: u64,
}

impl Counters {
    /// Adds what was counted elsewhere.
    pub(crate) fn absorb(&mut self, other: &Self) {
        let Self {
            updates,
            crossings,
            dilemmas,
            reds_by_siren,
            forced_stops,
            long_waits,
            lane_changes,
            obstacles_passed,
            rerouted,
            detours,
            locks,
            passes,
            halts,
            missed_stops,
            entered,
            arrived,
            removed,
            walkers_entered,
            walkers_arrived,
            walkers_left,
            walkers_removed,
            jaywalks,
        } = other;
        self.updates += updates;
        self.crossings += crossings;
        self.dilemmas += dilemmas;
        self.reds_by_siren += reds_by_siren;
        self.forced_stops += forced_stops;
        self.long_waits += long_waits;
        self.lane_changes += lane_changes;
        self.obstacles_passed += obstacles_passed;
        self.rerouted += rerouted;
        self.detours += detours;
        self.locks += locks;
        self.passes += passes;
        self.halts += halts;
        self.missed_stops += missed_stops;
        self.entered += entered;
        self.arrived += arrived;
        self.removed += removed;
        self.walkers_entered += walkers_entered;
        self.walkers_arrived += walkers_arrived;
        self.walkers_left += walkers_left;
        self.walkers_removed += walkers_removed;
        self.jaywalks += jaywalks;
    }
}
