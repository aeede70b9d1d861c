//! Who goes first where ways meet: by gaps when leave is asked for, by the order of leave on the way.
//!
//! Leave has an order. Of two on ways that meet, the one whose leave is older goes first, and the other stops before the
//! stretch that they share until the first is out of it. Along a lane the order is that of the queue, so that nobody ever
//! waits for one who waits for him. One who asks is put behind all who hold ways that meet his own; before one of them
//! he goes only if that one has not reached its line, can still stop for it, and by all that is seen need not.
//!
//! Who waits for a gap starts to roll while the last one still passes, so that it comes to its line when that one has come to his.
//! Whoever could no longer stop before he is out of the way is relied on; others as long as one could still stop oneself.

use simworld_core::net::{Aspect, time_over};

use super::haste::Haste;
use super::junction::horizon;
use crate::vehicle::driving::lookahead::BEFORE_LINE;
use crate::vehicle::foreign::strangers;
use crate::vehicle::manager::{EXIT, NONE, STANDING, Vehicle};
use crate::vehicle::part::Part;
use crate::vehicle::scene::Scene;
use crate::vehicle::tracks::conflicts::Conflict;
use crate::vehicle::{Idm, Way};

/// Time that one wants between clearing a conflict and the arrival of who has no priority, s.
pub(in crate::vehicle) const MARGIN: f64 = 0.5;
/// Time by which one delays who has priority, at most, s: the gaps of the manual leave no more than that.
const DELAYS: f64 = 1.0;
/// Who comes up behind somebody that turns into its lane has lost so much time by its line, s, as it is seen in our streams; the
/// gaps of the manual are those that were measured there, with what was lost.
const EASES: f64 = 0.35;
/// Vehicles with priority are looked for within this distance, m.
pub(in crate::vehicle) const SIGHT: f64 = 120.0;
/// Braking with which one who is overtaken in the order could stop at its line, m/s².
pub(in crate::vehicle) const EASILY: f64 = 2.0;
/// Acceleration with which others are expected to clear the way, and to come, m/s².
pub(in crate::vehicle) const CLEARS: f64 = 1.0;
pub(in crate::vehicle) const COMES: f64 = 1.5;
/// A time is computed with this acceleration at least, m/s².
const LEAST: f64 = 1e-3;
/// One relies on somebody else being gone as long as one could still stop with this share of one's hardest braking, in so much
/// time before it, s, and so far before, m; and as soon as the other could no longer stop before.
const RELIES: f64 = 0.6;
const RELIES_FOR: f64 = 0.2;
const RELIES_UP_TO: f64 = 1.0;
/// The hardest braking of anybody, m/s².
const HARDEST: f64 = 10.0;

/// Who turns in a gap accelerates so much harder than else.
pub(in crate::vehicle) const HURRY: f64 = 1.3;

/// Whether one leave is older than another; numbers begin anew after the last.
pub(in crate::vehicle) fn is_before(one: u32, other: u32) -> bool {
    one.wrapping_sub(other) > u32::MAX / 2
}

/// Somebody who holds a way, seen along it.
#[derive(Clone, Copy, Debug)]
struct Holder {
    /// Its front, m along the way; negative before its line.
    front: f64,
    length: f64,
    v: f64,
    /// The acceleration that one sees, m/s².
    acceleration: f64,
    granted: u32,
    /// Its rank in the lane before the line.
    rank: u32,
}

impl Holder {
    fn rear(&self) -> f64 {
        self.front - self.length
    }

    /// When it will be out of the way of another, s.
    fn clears(&self, conflict: &Conflict, speed: f64) -> f64 {
        self.time(conflict.other.passed(), speed)
    }

    /// When it will be sure to come out of the way of another, s: it could no longer stop before.
    fn is_sure_to_clear(&self, conflict: &Conflict, speed: f64) -> f64 {
        self.time(conflict.other.passed() - self.v * self.v / (2.0 * HARDEST), speed)
    }

    /// When its rear comes to a station, s; never if it stands in the junction before that.
    fn time(&self, station: f64, speed: f64) -> f64 {
        if self.rear() >= station {
            return 0.0;
        }
        if self.front > 0.0 && self.v < STANDING {
            return f64::INFINITY;
        }
        time_over(station - self.rear(), self.v, self.acceleration.max(CLEARS), speed.max(3.0))
    }
}

/// How one who asks would cross.
#[derive(Clone, Copy, Debug)]
pub(in crate::vehicle) struct Asker {
    /// To its line, m.
    distance: f64,
    v: f64,
    pub(in crate::vehicle) length: f64,
    acceleration: f64,
    /// The speed across, m/s.
    speed: f64,
    /// By how much who goes before it delays it, s.
    delay: f64,
    haste: Haste,
}

impl Asker {
    fn new(scene: &Scene<'_>, vehicle: &Vehicle, distance: f64) -> Self {
        let (tracks, way) = (scene.tracks, vehicle.next as usize);
        let row = scene.config.vehicle_type(vehicle.row);
        let hurry = if tracks.ways[way].turns_by_gaps { HURRY } else { 1.0 };
        Self {
            distance,
            v: vehicle.v,
            length: vehicle.length(),
            acceleration: row.driver.acceleration * hurry,
            speed: row.free_speed(scene.config, vehicle.factor, tracks.ways[way].speed),
            delay: 0.0,
            haste: Haste::NONE,
        }
    }

    /// One who is on its way already, or before it; `front` is where, m along it.
    pub(in crate::vehicle) fn on_way(scene: &Scene<'_>, vehicle: &Vehicle, way: usize, front: f64) -> Self {
        Self::new(scene, &Vehicle { next: way as u32, ..*vehicle }, -front)
    }

    /// Lets it come to its line no sooner than a headway after who goes before it has left room for it there (Newell 2002).
    fn stay_behind(&mut self, before: Option<Self>, driver: &Idm) {
        if let Some(before) = before.filter(|before| before.distance + before.length + driver.gap > 0.0) {
            let free = self.time(0.0);
            self.delay = (before.time(before.length + driver.gap) + driver.headway - free).max(0.0);
        }
    }

    pub(in crate::vehicle) fn time(&self, station: f64) -> f64 {
        time_over(self.distance + station, self.v, self.acceleration, self.speed) + self.delay
    }

    /// When its rear is out of what a way shares with its own, s.
    pub(in crate::vehicle) fn gone(&self, conflict: &Conflict) -> f64 {
        self.time(conflict.own.passed() + self.length)
    }

    /// Its speed when it has come to a station, m/s.
    fn speed_at(&self, station: f64) -> f64 {
        let square = self.v * self.v + 2.0 * self.acceleration * (self.distance + station);
        square.max(0.0).sqrt().min(self.speed)
    }

    /// Whether it could go after a holder without standing in the junction. Who gives way lets it come by first, and starts to roll
    /// so as to be at its own line then.
    fn goes_after(&self, holder: &Holder, conflict: &Conflict, speed: f64) -> bool {
        let has_come = !conflict.yields || holder.front + holder.v * self.time(0.0) >= 0.0;
        has_come && holder.clears(conflict, speed) <= self.time(conflict.own.enter())
    }

    /// Whether it would be gone before another, and takes the gap before it.
    pub(in crate::vehicle) fn goes_before(&self, conflict: &Conflict, comer: &Comer) -> bool {
        let gone = conflict.own.passed() + self.length;
        // Where both end in one lane the other must come down to one's own speed.
        let excess = if conflict.merges { (comer.v - self.speed_at(gone)).max(0.0) } else { 0.0 };
        let slowed = excess * excess / (2.0 * EASILY * comer.v.max(1.0));
        let delays = DELAYS + self.haste.delays();
        let margin = if conflict.yields { -delays } else { MARGIN };
        let takes_gap = || self.time(gone) + self.asks_for(conflict, gone) <= comer.time(0.0);
        (!conflict.yields || takes_gap())
            && self.time(gone) + slowed + margin <= comer.time(conflict.other.enter())
    }

    /// How much sooner it wants to be gone than somebody with priority comes to its line, s: as much as one who starts at the line
    /// in a gap that is just critical. Who rolls is over sooner, and needs so much less.
    fn asks_for(&self, conflict: &Conflict, gone: f64) -> f64 {
        let eases = if conflict.merges { EASES } else { 0.0 };
        let from_rest = |way| time_over(BEFORE_LINE + way, 0.0, self.acceleration, self.speed);
        self.haste.shortens(f64::from(conflict.critical)) - eases - (from_rest(gone) - from_rest(0.0))
    }
}

/// Somebody before its line, who may go at once.
pub(in crate::vehicle) struct Comer {
    /// To its line, m.
    pub(in crate::vehicle) distance: f64,
    pub(in crate::vehicle) v: f64,
    /// The speed to which it may go, m/s.
    pub(in crate::vehicle) limit: f64,
    /// The acceleration that one sees, m/s².
    pub(in crate::vehicle) acceleration: f64,
}

impl Comer {
    fn time(&self, station: f64) -> f64 {
        let limit = self.limit.max(self.v);
        let missing = 1.0 - self.v / limit;
        // Who nearly has his speed keeps it, unless one sees him speed up; who has just set off will speed up.
        let expected = COMES * missing * missing;
        let acceleration = self.acceleration.min(COMES).max(expected).max(LEAST);
        time_over(self.distance + station, self.v, acceleration, limit)
    }
}

impl Part {
    /// Whether one who asks finds its place among those who hold ways that meet its own, and a gap before those who have
    /// priority; lists whom it would overtake in the order.
    pub(super) fn finds_gap(
        &self,
        scene: &Scene<'_>,
        vehicle: &Vehicle,
        (distance, rank): (f64, usize),
        overtaken: &mut Vec<(u32, u32)>,
    ) -> bool {
        overtaken.clear();
        let way = vehicle.next as usize;
        // Who hears a siren waits for it.
        let siren = scene.sirens.is_on(vehicle.id);
        let (tracks, junctions) = (scene.tracks, scene.junctions);
        let mut asker = Asker::new(scene, vehicle, distance);
        asker.stay_behind(self.before(scene, vehicle, rank), &scene.config.vehicle_type(vehicle.row).driver);
        // A stranger need not give way to haste.
        let calm = asker;
        asker.haste = Haste::of(vehicle.stood);
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
                || strangers::hinder(scene, &calm, conflict))
        })
    }

    /// Who goes before one who asks, on its lane or on its way.
    fn before(&self, scene: &Scene<'_>, vehicle: &Vehicle, rank: usize) -> Option<Asker> {
        let (tracks, way) = (scene.tracks, vehicle.next as usize);
        let lane = tracks.ways[way].from;
        let end = tracks.length[lane as usize];
        if let Some(rank) = rank.checked_sub(1) {
            let before = &self.slabs.queue(tracks.layout.local(lane))[rank];
            return (before.next != EXIT).then(|| Asker::new(scene, before, end - before.s));
        }
        let on_way = self.slabs.queue(tracks.ways[way].local as usize).last()?;
        Some(Asker::on_way(scene, on_way, way, on_way.s))
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
        let Way { from, speed, .. } = tracks.ways[conflict.way as usize];
        let limit = tracks.speed[from as usize];
        let mut fits = true;
        self.holders(scene, conflict.way, |holder| {
            let concerns = conflict.pairs.has(asker.length, holder.length);
            if !fits || !concerns || asker.goes_after(holder, conflict, speed) {
                return;
            }
            let could_stop = holder.front < 0.0 && holder.v * holder.v <= -2.0 * EASILY * holder.front;
            let comer =
                Comer { distance: -holder.front, v: holder.v, limit, acceleration: holder.acceleration };
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
        let acceleration = f64::from(rival.acceleration);
        !asker.goes_before(conflict, &Comer { distance: end - rival.s, v: rival.v, limit, acceleration })
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
        let Way { from, local, there, length: way_length, .. } = tracks.ways[way as usize];
        let end = tracks.length[from as usize];
        let before = self.slabs.queue(tracks.layout.local(from)).iter().enumerate();
        for (rank, vehicle) in before.take_while(|(_, vehicle)| vehicle.has_leave_or_exits()) {
            if vehicle.holding == way {
                see(&Holder::of(vehicle, vehicle.s - end, rank));
            }
        }
        for vehicle in self.slabs.queue(local as usize) {
            see(&Holder::of(vehicle, vehicle.s, 0));
        }
        let tail = scene.tail_at(there);
        if tail.way == way {
            let (length, rear) = (f64::from(tail.length), tail.rear + way_length);
            let front = rear + length;
            see(&Holder { front, length, v: tail.v, acceleration: 0.0, granted: tail.granted, rank: 0 });
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
    pub(in crate::vehicle) fn mind_older(
        &self,
        scene: &Scene<'_>,
        vehicle: &Vehicle,
        (way, front): (usize, f64),
        mut mind: impl FnMut(Precedence),
    ) {
        let tracks = scene.tracks;
        let driver = &scene.drivers[usize::from(vehicle.row)].idm;
        let hardest = RELIES * driver.emergency_deceleration;
        let is_held = |other| scene.junctions.is_held(other);
        for conflict in tracks.conflicts_held(way, &self.work.held, is_held) {
            let to_zone = conflict.own.enter() - front;
            // Who is in the way of others already goes on, but for whom he follows.
            let is_in = to_zone <= -0.5;
            if to_zone > horizon(vehicle.v) || (is_in && !conflict.merges) {
                continue;
            }
            let speed = tracks.ways[conflict.way as usize].speed;
            self.holders(scene, conflict.way, |holder| {
                let concerns = conflict.pairs.has(vehicle.length(), holder.length);
                if !concerns || !is_before(holder.granted, vehicle.granted) {
                    return;
                }
                let rear = holder.rear();
                if conflict.merges && rear >= conflict.other.enter() {
                    let ends = (tracks.ways[way].length, conflict.other_length(scene));
                    mind(Precedence::Follow { gap: ends.0 - front - (ends.1 - rear), speed: holder.v });
                } else if rear < conflict.other.passed() && !is_in {
                    // So that it is gone when one could no longer stop for it.
                    let sure = vehicle.v * (vehicle.v / (2.0 * hardest) + RELIES_FOR) + RELIES_UP_TO;
                    let time = holder.clears(conflict, speed);
                    let open = holder.is_sure_to_clear(conflict, speed) - RELIES_FOR;
                    let arrives = 2.0 * (to_zone - vehicle.v * time) / (time * time).max(1e-9);
                    let arrives = arrives.min(in_time(vehicle.v, open, to_zone, hardest));
                    if (to_zone < sure && open > 0.0) || arrives < -EASILY {
                        mind(Precedence::Stop { distance: to_zone });
                    } else if arrives < driver.acceleration {
                        mind(Precedence::Slow { acceleration: arrives });
                    }
                }
            });
        }
    }
}

/// The acceleration with which one comes in so much time as near to a stretch as one may while somebody could still stop in it, m/s²;
/// infinite once nobody could.
fn in_time(v: f64, time: f64, to_zone: f64, hardest: f64) -> f64 {
    if time <= 0.0 {
        return f64::INFINITY;
    }
    // The speed `after` that one has then solves
    // (v + after) / 2 · time + after² / (2 · hardest) + after · RELIES_FOR + RELIES_UP_TO = to_zone.
    let half = time * 0.5 + RELIES_FOR;
    let rest = to_zone - RELIES_UP_TO - v * time * 0.5;
    let square = half * half + 2.0 * rest / hardest;
    let after = if square > 0.0 { hardest * (square.sqrt() - half) } else { f64::NEG_INFINITY };
    if after < 0.0 { f64::NEG_INFINITY } else { (after - v) / time }
}

/// What the older leave of another asks of one.
#[derive(Clone, Copy, Debug)]
pub(in crate::vehicle) enum Precedence {
    /// To stop so far ahead, m.
    Stop { distance: f64 },
    /// To accelerate by no more than this, m/s².
    Slow { acceleration: f64 },
    /// To follow it, m and m/s.
    Follow { gap: f64, speed: f64 },
}

impl Conflict {
    fn other_length(&self, scene: &Scene<'_>) -> f64 {
        scene.tracks.ways[self.way as usize].length
    }
}

impl Holder {
    fn of(vehicle: &Vehicle, front: f64, rank: usize) -> Self {
        let (v, acceleration, granted) = (vehicle.v, f64::from(vehicle.acceleration), vehicle.granted);
        Self { front, length: vehicle.length(), v, acceleration, granted, rank: rank as u32 }
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
mod tests;
