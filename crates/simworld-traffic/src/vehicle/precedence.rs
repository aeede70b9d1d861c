//! Who goes first where ways meet: by gaps when leave is asked for, by the order of leave on the way.
//!
//! Leave has an order. Of two on ways that meet, the one whose leave is older goes first, and the other stops before the
//! stretch that they share until the first is out of it. Along a lane the order is that of the queue, so that nobody ever
//! waits for one who waits for him. One who asks is put behind all who hold ways that meet his own; before one of them
//! he goes only if that one has not reached its line, can still stop for it, and by all that is seen need not.

use simworld_core::net::{Aspect, time_over};

use super::Way;
use super::conflicts::Conflict;
use super::junction::horizon;
use super::manager::{EXIT, NONE, STANDING, Scene, Vehicle};
use super::part::Part;
use super::strangers;
use super::tracks::Track;

/// Time that one wants between clearing a conflict and the arrival of who has no priority, s.
pub(super) const MARGIN: f64 = 0.5;
/// Time by which one delays who has priority, at most, s: the gaps of the manual leave no more than that.
const DELAYS: f64 = 1.0;
/// Time from leave to the line of one who is about to stop at it, s. A gap is taken to begin with it.
const START: f64 = 1.2;
/// Vehicles with priority are looked for within this distance, m.
pub(super) const SIGHT: f64 = 90.0;
/// Braking with which one who is overtaken in the order could stop at its line, m/s².
pub(super) const EASILY: f64 = 2.0;
/// Acceleration with which others are expected to clear the way, and to come, m/s².
pub(super) const CLEARS: f64 = 1.0;
pub(super) const COMES: f64 = 1.5;
/// One relies on somebody else being gone as long as one could still stop with this share of one's hardest braking, in so much
/// time before it, s, and so far before, m.
const RELIES: f64 = 0.6;
const RELIES_FOR: f64 = 0.2;
const RELIES_UP_TO: f64 = 1.0;

/// Who turns in a gap accelerates so much harder than else.
pub(super) const HURRY: f64 = 1.3;

/// Whether one leave is older than another; numbers begin anew after the last.
pub(super) fn is_before(one: u32, other: u32) -> bool {
    one.wrapping_sub(other) > u32::MAX / 2
}

/// Somebody who holds a way, seen along it.
#[derive(Clone, Copy, Debug)]
struct Holder {
    /// Its front, m along the way; negative before its line.
    front: f64,
    length: f64,
    v: f64,
    granted: u32,
    /// Its rank in the lane before the line.
    rank: u32,
}

impl Holder {
    fn rear(&self) -> f64 {
        self.front - self.length
    }

    /// When it will be out of the way of another, s; never if it stands in the junction.
    fn clears(&self, conflict: &Conflict, speed: f64) -> f64 {
        if self.front > 0.0 && self.v < STANDING {
            return f64::INFINITY;
        }
        time_over(conflict.other.passed() - self.rear(), self.v, CLEARS, speed.max(3.0))
    }
}

/// How one who asks would cross.
pub(super) struct Asker {
    /// To its line, m.
    distance: f64,
    v: f64,
    pub(super) length: f64,
    acceleration: f64,
    /// The speed across, m/s.
    speed: f64,
}

impl Asker {
    pub(super) fn time(&self, station: f64) -> f64 {
        time_over(self.distance + station, self.v, self.acceleration, self.speed)
    }

    /// When its rear is out of what a way shares with its own, s.
    pub(super) fn gone(&self, conflict: &Conflict) -> f64 {
        self.time(conflict.own.passed() + self.length)
    }

    /// Its speed when it has come to a station, m/s.
    fn speed_at(&self, station: f64) -> f64 {
        let square = self.v * self.v + 2.0 * self.acceleration * (self.distance + station);
        square.max(0.0).sqrt().min(self.speed)
    }

    /// Whether it could go after a holder without standing in the junction. Who gives way lets it come by first.
    fn goes_after(&self, holder: &Holder, conflict: &Conflict, speed: f64) -> bool {
        let has_come = holder.front >= 0.0 || !conflict.yields;
        has_come && holder.clears(conflict, speed) <= self.time(conflict.own.enter())
    }

    /// Whether it would be gone before another, and takes the gap before it.
    pub(super) fn goes_before(&self, conflict: &Conflict, comer: &Comer) -> bool {
        let gone = conflict.own.passed() + self.length;
        // Where both end in one lane the other must come down to one's own speed.
        let excess = if conflict.merges { (comer.v - self.speed_at(gone)).max(0.0) } else { 0.0 };
        let slowed = excess * excess / (2.0 * EASILY * comer.v.max(1.0));
        let margin = if conflict.yields { -DELAYS } else { MARGIN };
        let has_gap =
            !conflict.yields || self.time(0.0) + f64::from(conflict.critical) - START <= comer.time(0.0);
        has_gap && self.time(gone) + slowed + margin <= comer.time(conflict.other.enter())
    }
}

/// Somebody before its line, who may go at once.
pub(super) struct Comer {
    /// To its line, m.
    pub(super) distance: f64,
    pub(super) v: f64,
    /// The speed to which it may go, m/s.
    pub(super) limit: f64,
}

impl Comer {
    fn time(&self, station: f64) -> f64 {
        time_over(self.distance + station, self.v, COMES, self.limit.max(self.v))
    }
}

impl Part {
    /// Whether one who asks finds its place among those who hold ways that meet its own, and a gap before those who have
    /// priority; lists whom it would overtake in the order.
    pub(super) fn finds_gap(
        &self,
        scene: &Scene<'_>,
        way: usize,
        vehicle: &Vehicle,
        distance: f64,
        overtaken: &mut Vec<(u32, u32)>,
    ) -> bool {
        overtaken.clear();
        // Who hears a siren waits for it.
        let siren = scene.sirens.is_on(vehicle.id);
        let (tracks, junctions) = (scene.tracks, scene.junctions);
        let row = scene.config.vehicle_type(vehicle.row);
        let asker = Asker {
            distance,
            v: vehicle.v,
            length: vehicle.length(),
            acceleration: row.driver.acceleration * if tracks.ways[way].turns_by_gaps { HURRY } else { 1.0 },
            speed: row.free_speed(scene.config, vehicle.factor, tracks.speed[tracks.lanes + way]),
        };
        tracks.conflicts[way].iter().all(|conflict| {
            let is_held = junctions.is_held(conflict.way);
            if is_held && (vehicle.is_long() || junctions.has_long(conflict.way)) {
                return false; // long ones have the junction to themselves
            }
            if is_held && !self.fits_in(scene, &asker, conflict, overtaken) {
                return false;
            }
            let gives_way = conflict.yields && !siren;
            !(gives_way && self.is_hindered(scene, &asker, conflict)
                || strangers::hinder(scene, &asker, conflict))
        })
    }

    /// Whether one who asks may go after or before each of those who hold a way.
    fn fits_in(
        &self,
        scene: &Scene<'_>,
        asker: &Asker,
        conflict: &Conflict,
        overtaken: &mut Vec<(u32, u32)>,
    ) -> bool {
        let tracks = scene.tracks;
        let speed = tracks.speed[tracks.lanes + conflict.way as usize];
        let from = tracks.ways[conflict.way as usize].from;
        let limit = tracks.speed[from as usize];
        let mut fits = true;
        self.holders(scene, conflict.way, |holder| {
            let concerns = conflict.pairs.has(asker.length, holder.length);
            if !fits || !concerns || asker.goes_after(holder, conflict, speed) {
                return;
            }
            let could_stop = holder.front < 0.0 && holder.v * holder.v <= -2.0 * EASILY * holder.front;
            let comer = Comer { distance: -holder.front, v: holder.v, limit };
            fits = could_stop && asker.goes_before(conflict, &comer);
            if fits {
                overtaken.push((tracks.layout.local(from) as u32, holder.rank));
            }
        });
        fits
    }

    /// Whether somebody with priority who has no leave yet would have to brake.
    fn is_hindered(&self, scene: &Scene<'_>, asker: &Asker, conflict: &Conflict) -> bool {
        let tracks = scene.tracks;
        let Some((end, rival)) = self.next_rival(scene, conflict.way) else { return false };
        if rival.v < STANDING && rival.stood > 3.0 {
            return false; // it cannot go, or lets one go
        }
        let limit = tracks.speed[tracks.ways[conflict.way as usize].from as usize];
        !asker.goes_before(conflict, &Comer { distance: end - rival.s, v: rival.v, limit })
    }

    /// The first without leave on the way to a way that its signal lets go, and where its lane ends.
    fn next_rival(&self, scene: &Scene<'_>, way: u32) -> Option<(f64, &Vehicle)> {
        let tracks = scene.tracks;
        let Way { from, signal, .. } = tracks.ways[way as usize];
        if scene.aspect(signal) != Aspect::Green {
            return None;
        }
        let end = tracks.length[from as usize];
        let queue = self.slabs.queue(tracks.layout.local(from)).iter();
        let mut near = queue.take_while(|rival| end - rival.s < SIGHT);
        near.find(|rival| rival.next == way && rival.holding != way).map(|rival| (end, rival))
    }

    /// All who hold a way: before it, on it, and with their rears still on it.
    fn holders(&self, scene: &Scene<'_>, way: u32, mut see: impl FnMut(&Holder)) {
        let tracks = scene.tracks;
        let track = tracks.lanes + way as usize;
        let Way { from, to, .. } = tracks.ways[way as usize];
        let end = tracks.length[from as usize];
        let before = self.slabs.queue(tracks.layout.local(from)).iter().enumerate();
        for (rank, vehicle) in before.take_while(|(_, vehicle)| vehicle.has_leave_or_exits()) {
            if vehicle.holding == way {
                see(&Holder::of(vehicle, vehicle.s - end, rank));
            }
        }
        for vehicle in self.slabs.queue(tracks.layout.local(track as Track)) {
            see(&Holder::of(vehicle, vehicle.s, 0));
        }
        let tail = scene.tail(to);
        if tail.way == way {
            let (length, rear) = (f64::from(tail.length), tail.rear + tracks.length[track]);
            see(&Holder { front: rear + length, length, v: tail.v, granted: tail.granted, rank: 0 });
        }
    }

    /// Puts those who were overtaken, and all with leave behind them, last in the order.
    pub(super) fn put_last(&mut self, overtaken: &mut Vec<(u32, u32)>) {
        overtaken.sort_unstable();
        overtaken.dedup_by_key(|place| place.0);
        for (lane, rank) in overtaken.drain(..) {
            let Self { slabs, leaves, .. } = self;
            let with_leave = slabs.queue_mut(lane as usize)[rank as usize..].iter_mut();
            with_leave.take_while(|vehicle| vehicle.has_leave_or_exits()).for_each(|vehicle| {
                *leaves = leaves.wrapping_add(1);
                vehicle.granted = *leaves;
            });
        }
    }

    /// What one with leave must mind of those whose leave is older: where to stop, or whom to follow.
    pub(super) fn mind_older(
        &self,
        scene: &Scene<'_>,
        vehicle: &Vehicle,
        (way, front): (usize, f64),
        mut mind: impl FnMut(Precedence),
    ) {
        let tracks = scene.tracks;
        let driver = &scene.config.vehicle_type(vehicle.row).driver;
        let hardest = RELIES * driver.emergency_deceleration;
        let sure = vehicle.v * (vehicle.v / (2.0 * hardest) + RELIES_FOR) + RELIES_UP_TO;
        for conflict in tracks.conflicts[way].iter().filter(|other| scene.junctions.is_held(other.way)) {
            let to_zone = conflict.own.enter() - front;
            if to_zone > horizon(vehicle.v) {
                continue;
            }
            let speed = tracks.speed[tracks.lanes + conflict.way as usize];
            self.holders(scene, conflict.way, |holder| {
                let concerns = conflict.pairs.has(vehicle.length(), holder.length);
                if !concerns || !is_before(holder.granted, vehicle.granted) {
                    return;
                }
                let rear = holder.rear();
                if conflict.merges && rear >= conflict.other.enter() {
                    let ends = (tracks.length[tracks.lanes + way], conflict.other_length(scene));
                    mind(Precedence::Follow { gap: ends.0 - front - (ends.1 - rear), speed: holder.v });
                } else if rear < conflict.other.passed() && to_zone > -0.5 {
                    // So that it is gone when one could no longer stop for it.
                    let time = holder.clears(conflict, speed);
                    let arrives = 2.0 * (to_zone - sure - vehicle.v * time) / (time * time).max(1e-9);
                    if to_zone < sure || arrives < -EASILY {
                        mind(Precedence::Stop { distance: to_zone });
                    } else if arrives < driver.acceleration {
                        mind(Precedence::Slow { acceleration: arrives });
                    }
                }
            });
        }
    }
}

/// What the older leave of another asks of one.
#[derive(Clone, Copy, Debug)]
pub(super) enum Precedence {
    /// To stop so far ahead, m.
    Stop { distance: f64 },
    /// To accelerate by no more than this, m/s².
    Slow { acceleration: f64 },
    /// To follow it, m and m/s.
    Follow { gap: f64, speed: f64 },
}

impl Conflict {
    fn other_length(&self, scene: &Scene<'_>) -> f64 {
        scene.tracks.length[scene.tracks.lanes + self.way as usize]
    }
}

impl Holder {
    fn of(vehicle: &Vehicle, front: f64, rank: usize) -> Self {
        let (v, granted) = (vehicle.v, vehicle.granted);
        Self { front, length: vehicle.length(), v, granted, rank: rank as u32 }
    }
}

impl Vehicle {
    /// Whether it has leave for the end of its lane or leaves the network there: nobody has leave behind one of whom neither
    /// is true.
    fn has_leave_or_exits(&self) -> bool {
        self.next == EXIT || (self.holding != NONE && self.holding == self.next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_goes_on_when_numbers_begin_anew() {
        assert!(is_before(3, 4) && !is_before(4, 3) && !is_before(4, 4));
        assert!(is_before(u32::MAX, 2) && !is_before(2, u32::MAX));
    }
}
