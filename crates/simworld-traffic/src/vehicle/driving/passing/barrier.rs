//! What stands on a lane: bodies of others, works, breakdowns; those near one another are passed at once.

use super::{JUNCTION, Mind, room_behind};
use crate::vehicle::foreign::strangers::of_track;
use crate::vehicle::manager::{STANDING, Vehicle, VehicleManager};
use crate::vehicle::tracks::{Obstacle, Track};

/// Nobody goes round more than this at once, m: farther than one sees whether the way is free.
const LONGEST: f64 = 40.0;

/// Something that stands on a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Barrier {
    /// Where it begins and ends, m along the lane.
    pub(super) near: f64,
    pub(super) far: f64,
    /// How far it reaches to the right and to the left of the middle of the lane: its least and its greatest place to the left, m.
    pub(super) reach: (f64, f64),
}

impl Barrier {
    /// Both at once.
    fn with(self, other: Self) -> Self {
        Self {
            near: self.near.min(other.near),
            far: self.far.max(other.far),
            reach: (self.reach.0.min(other.reach.0), self.reach.1.max(other.reach.1)),
        }
    }
}

impl VehicleManager {
    /// What stands before a vehicle, as far as it would pass it at once: between two of its parts it would not turn in. `apart` is how
    /// far it is to the middle of the oncoming lane, m.
    pub(super) fn barrier(
        &self,
        mind: &Mind<'_>,
        lane: Track,
        vehicle: &Vehicle,
        apart: f64,
    ) -> Option<Barrier> {
        let half_width = mind.config.vehicle_type(vehicle.row).width * 0.5;
        let front = vehicle.s;
        let beyond = || self.bars_of(mind, lane, half_width).filter(move |part| part.near > front);
        let mut barrier = beyond().min_by(|a, b| a.near.total_cmp(&b.near))?;
        let room = room_behind(vehicle.length(), apart) - JUNCTION;
        loop {
            let reached = barrier.far + room;
            let grown = beyond().filter(|part| part.near < reached).fold(barrier, Barrier::with);
            if grown == barrier {
                break;
            }
            barrier = grown;
        }
        (barrier.far - barrier.near <= LONGEST).then_some(barrier)
    }

    /// All that stands on a lane and leaves no room for a vehicle of half that width, m.
    fn bars_of(&self, mind: &Mind<'_>, lane: Track, half_width: f64) -> impl Iterator<Item = Barrier> {
        let bodies = of_track(mind.obstacles, lane).iter();
        let bars = move |body: &&Obstacle| body.stands && body.bars(half_width);
        let bodies = bodies.filter(bars).map(|body| {
            let Obstacle { near, far, reach, .. } = *body;
            Barrier { near, far, reach }
        });
        let half = mind.tracks.network.lanes[lane as usize].width * 0.5;
        let works = self.closures.blocks.iter().filter(move |(track, ..)| *track == lane);
        let works = works.map(move |(_, near, far)| Barrier { near: *near, far: *far, reach: (-half, half) });
        let queue = self.queue(mind.tracks, lane).iter();
        let (tracks, config) = (mind.tracks, mind.config);
        let halts = queue.filter(move |vehicle| self.is_in_the_way(vehicle)).map(move |vehicle| {
            let half = config.vehicle_type(vehicle.row).width * 0.5;
            let middle = f64::from(vehicle.shift);
            let (near, far) = (vehicle.s - vehicle.length(), vehicle.s.min(tracks.length[lane as usize]));
            Barrier { near, far, reach: (middle - half, middle + half) }
        });
        bodies.chain(works).chain(halts)
    }

    /// Whether a vehicle of a lane stands there because it broke down, is unloaded, or somebody else who drives it stopped it.
    pub(super) fn is_in_the_way(&self, vehicle: &Vehicle) -> bool {
        let halts = vehicle.halt.is_finite() && self.halts.is_breakdown(vehicle.id);
        vehicle.v < STANDING
            && (halts || self.controls.drives(vehicle.id))
            && self.passings.of(vehicle.id).is_none()
    }
}
