//! Vehicles longer than their lane: they cross the next junction while their rear is still in the one behind.
//!
//! Between junctions near one another, as real maps have them, lanes may be shorter than a vehicle. One that waits there for
//! leave to go on would wait for its rear to clear the junction behind, which it never does. It is granted the next way as well
//! and *trails*: it keeps the way behind until its rear is out of it, nobody else shares that junction with it on ways that meet,
//! and its rear is shown as the end of the short lane wherever its front is. This is rare and is looked after by one thread
//! between steps.

use serde::{Deserialize, Serialize};

use crate::vehicle::manager::{NONE, Vehicle, VehicleManager};
use crate::vehicle::part::CLEARED;
use crate::vehicle::queues::path::Path;
use crate::vehicle::queues::tail::Tail;
use crate::vehicle::tracks::{Track, Tracks};

/// Room on a lane beyond a vehicle's length with which its rear clears the junction behind while it waits at the line, m: it
/// stops half a metre before that.
pub(in crate::vehicle) const SPARE: f64 = 1.0;

/// A vehicle whose rear is on a way that it was granted before the one that it holds now.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Trail {
    id: u32,
    /// The way on which its rear is, its place in the order of leave there, and the lane behind it.
    way: u32,
    granted: u32,
    lane: Track,
    length: f32,
    is_long: bool,
    /// What it had driven at the beginning of that lane, m.
    start: f64,
    /// Its rear on that lane, m: negative while it is on the way; and its speed, m/s.
    rear: f64,
    v: f64,
}

impl Trail {
    /// Of a vehicle that is granted another way than the one that it holds.
    pub(in crate::vehicle) fn new(vehicle: &Vehicle, path: &Path, lane: Track) -> Self {
        Self {
            id: vehicle.id,
            way: vehicle.holding,
            granted: vehicle.granted,
            lane,
            length: vehicle.length,
            is_long: vehicle.is_long(),
            start: path.driven(),
            rear: vehicle.s - vehicle.length(),
            v: vehicle.v,
        }
    }

    /// Whose rear it is.
    pub(in crate::vehicle) fn id(&self) -> u32 {
        self.id
    }

    /// Whether the rear is on a way, before a station of the lane behind it: a negative one is on the way.
    pub(in crate::vehicle) fn is_on(&self, way: u32, until: f64) -> bool {
        self.way == way && self.rear < until
    }

    /// The lane whose end it is, and how it looks there.
    pub(in crate::vehicle) fn shown(&self) -> (Track, Tail) {
        let Self { rear, v, length, way, granted, .. } = *self;
        (self.lane, Tail { rear, v, length, way, granted, ..Tail::default() })
    }
}

/// Whether a vehicle that waits at the end of a lane of that length has its rear in the junction behind.
pub(super) fn is_too_short(lane: f64, vehicle: &Vehicle) -> bool {
    lane < vehicle.length() + SPARE
}

impl VehicleManager {
    /// Takes up those who began to trail in this step, moves all on, and clears the ways of those whose rear is out.
    pub(in crate::vehicle) fn follow_trails(&mut self, tracks: &Tracks) {
        let known = self.trails.len();
        for part in &mut self.parts {
            self.trails.append(&mut part.work.trails);
        }
        for trail in self.trails[known..].iter().filter(|trail| !trail.is_long) {
            self.junctions.share_with_nobody(trail.way);
        }
        let mut trails = std::mem::take(&mut self.trails);
        trails.retain_mut(|trail| {
            let driven =
                self.find(tracks, trail.id).map(|(_, vehicle, path)| (path.driven() + vehicle.s, vehicle.v));
            if let Some((driven, v)) = driven {
                (trail.rear, trail.v) = (driven - trail.start - f64::from(trail.length), v);
                if trail.rear <= CLEARED {
                    let length = tracks.length[tracks.lanes + trail.way as usize];
                    self.junctions.claim_behind(tracks, trail.way, trail.rear + length);
                    return true;
                }
            }
            self.junctions.clear_way(trail.way, true);
            false
        });
        self.trails = trails;
    }

    /// A vehicle is taken out: it trails no more.
    pub(in crate::vehicle) fn end_trails(&mut self, id: u32) {
        let junctions = &self.junctions;
        self.trails.retain(|trail| {
            if trail.id == id {
                junctions.clear_way(trail.way, true);
            }
            trail.id != id
        });
    }

    /// Whether saved trails are of this network.
    pub(in crate::vehicle) fn trails_fit(&self, tracks: &Tracks) -> bool {
        let count = self.numbers();
        self.trails.iter().all(|trail| {
            (trail.id as usize) < count
                && self.whereabouts.get(trail.id as usize) != NONE
                && tracks.ways.get(trail.way as usize).is_some_and(|way| way.to == trail.lane)
                && trail.length > 0.0
                && trail.start.is_finite()
                && trail.rear.is_finite()
                && trail.v.is_finite()
        })
    }
}
