//! MOBIL (Kesting, Treiber and Helbing 2007): change if one's own gain exceeds the threshold and the politeness times what
//! others lose, and nobody behind has to brake harder than is safe.

use serde::{Deserialize, Serialize};

use super::idm::Driver;
use super::lane_change::stretch;
use crate::vehicle::foreign::strangers;
use crate::vehicle::manager::{NONE, Vehicle};
use crate::vehicle::part::Part;
use crate::vehicle::scene::Scene;
use crate::vehicle::tracks::Track;

/// When drivers change lanes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mobil {
    /// Weight of what others lose against one's own gain, in [0, 2]; 0 is an egoist.
    pub politeness: f64,
    /// Gain below which one stays, m/s², in [0, 5].
    pub threshold: f64,
    /// Hardest braking to which one forces another, m/s², in [0.5, 8].
    pub safe_braking: f64,
}

impl Default for Mobil {
    /// The values of the model's authors.
    fn default() -> Self {
        Self { politeness: 0.3, threshold: 0.2, safe_braking: 4.0 }
    }
}

/// What a lane of one's own is worth, m/s²: buses keep to bus lanes, riders to cycle lanes and else to the right.
const OWN_LANE: f64 = 2.0;

/// Who is before and behind a place in a lane.
struct Neighbours {
    ahead: Option<(f64, f64)>,
    behind: Option<(f64, f64)>,
    rank: usize,
}

/// What a lane beside offers to one who may change to it.
pub(super) struct Offer {
    /// His place in its queue.
    pub(super) place: usize,
    /// What he gains there by himself, and what others gain by it as far as he cares, m/s².
    own: f64,
    others: f64,
    /// What a grade by which it leads on better is worth, m/s².
    grade: f64,
    /// Gain below which he stays, m/s².
    threshold: f64,
}

impl Offer {
    /// The advantage of a lane that leads on better by so many grades, m/s².
    pub(super) fn gain(&self, better: f64) -> f64 {
        self.own + better * self.grade + self.others
    }

    /// Whether that is enough to change.
    pub(super) fn is_worth(&self, better: f64) -> bool {
        self.gain(better) > self.threshold
    }
}

/// What it is worth to one who may change for speed to stay in his lane, and what he asks of another.
pub(super) struct Stay {
    /// His acceleration here, m/s².
    now: f64,
    /// What the one behind him gains if he leaves, as far as he cares, m/s².
    left_behind: f64,
    /// How well the lane suits him, beside what it would be for others.
    suits: i8,
    /// The weight of what others lose, and the gain below which he stays, m/s².
    politeness: f64,
    threshold: f64,
}

impl Stay {
    pub(super) fn new(scene: &Scene<'_>, queue: &[Vehicle], rank: usize, lane: Track) -> Self {
        let (vehicle, mobil) = (&queue[rank], &scene.config.mobil);
        // With a siren every gain is worth it, and what others lose is nothing.
        let siren = scene.sirens.is_on(vehicle.id);
        let (politeness, threshold) = if siren { (0.0, 0.0) } else { (mobil.politeness, mobil.threshold) };
        let (now, left_behind) = staying(scene, queue, rank, lane);
        let (left_behind, suits) = (politeness * left_behind, suits(scene, vehicle, lane));
        Self { now, left_behind, suits, politeness, threshold }
    }

    /// Whether a lane beside could be worth it even if it leads on better by so many grades: if nobody were ahead there, and nobody lost
    /// anything by it. Most have too little to gain, and for them nobody's place in that lane has to be found.
    pub(super) fn could_gain(
        &self,
        scene: &Scene<'_>,
        vehicle: &Vehicle,
        target: Track,
        better: f64,
    ) -> bool {
        let alone = drive(scene, vehicle, target, (f64::INFINITY, 0.0));
        self.offer(scene, vehicle, (target, 0), alone, 0.0).is_worth(better)
    }

    /// The offer of a lane and of a place in its queue, for an acceleration there and a loss of the one behind, m/s².
    fn offer(
        &self,
        scene: &Scene<'_>,
        vehicle: &Vehicle,
        (target, place): (Track, usize),
        mine: f64,
        loss: f64,
    ) -> Offer {
        let own = mine - self.now + f64::from(suits(scene, vehicle, target) - self.suits) * OWN_LANE;
        let others = self.left_behind - self.politeness * loss;
        Offer { place, own, others, grade: OWN_LANE, threshold: self.threshold }
    }
}

impl Part {
    /// What a lane beside offers; `None` if it is not safe to change to it. For one who must change, and so has nothing to say for staying,
    /// every lane is worth it.
    pub(super) fn offer(
        &self,
        scene: &Scene<'_>,
        (lane, rank): (Track, usize),
        target: Track,
        stay: Option<&Stay>,
    ) -> Option<Offer> {
        let Scene { tracks, config, .. } = scene;
        let vehicle = self.slabs.queue(tracks.layout.local(lane))[rank];
        let length = vehicle.length();
        let s = vehicle.s * stretch(tracks, lane, target);
        if s >= tracks.length[target as usize] - 1.0 || (s - length) < 0.5 {
            return None;
        }
        let there = self.neighbours(tracks.layout.local(target), s, length);
        let (ahead, behind) = self.room(scene, &there, &vehicle, s, target)?;
        let follower = self.slabs.queue(tracks.layout.local(target)).get(there.rank);
        let leader_speed = there.ahead.map_or(0.0, |a| a.1);
        let mine = drive(scene, &vehicle, target, (ahead, leader_speed));
        let follower = follower.map(|other| {
            let alone = there.ahead.map_or(f64::INFINITY, |(rear, _)| rear - (s - length - behind));
            let before = drive(scene, other, target, (alone, leader_speed));
            (before, drive(scene, other, target, (behind, vehicle.v)))
        });
        let safe = -config.mobil.safe_braking;
        if mine < safe || follower.is_some_and(|(_, after)| after < safe) {
            return None;
        }
        let place = there.rank;
        let Some(stay) = stay else {
            let (own, threshold) = (1e3 + mine, f64::NEG_INFINITY);
            return Some(Offer { place, own, others: 0.0, grade: 0.0, threshold });
        };
        // Nobody gains by one who comes in before him, however fast that one is.
        let loss = follower.map_or(0.0, |(before, after)| (before - after).max(0.0));
        Some(stay.offer(scene, &vehicle, (target, place), mine, loss))
    }

    /// The gaps before and behind a place in a lane; nothing if one must not go there, however safe it would be.
    fn room(
        &self,
        scene: &Scene<'_>,
        there: &Neighbours,
        vehicle: &Vehicle,
        s: f64,
        target: Track,
    ) -> Option<(f64, f64)> {
        let rear = s - vehicle.length();
        let ahead = there.ahead.map_or(f64::INFINITY, |(rear, _)| rear - s);
        let behind = there.behind.map_or(f64::INFINITY, |(front, _)| rear - front);
        let gap = scene.config.vehicle_type(vehicle.row).driver.gap;
        let least = if vehicle.v < 1.0 { 0.5 } else { gap * 0.5 };
        // Who has leave to cross is not cut off: the junction waits for it.
        let follower = self.slabs.queue(scene.tracks.layout.local(target)).get(there.rank);
        let cuts_off =
            follower.is_some_and(|follower| follower.holding != NONE && follower.holding == follower.next);
        // Whoever comes out of the junction behind has not joined the queue yet.
        let comes = there.behind.is_none() && scene.junctions.inbound(target) > 0.0 && rear < 25.0;
        let braking = scene.config.mobil.safe_braking;
        let strangers = strangers::let_in(&scene.sight, target, (rear, vehicle.v), least, braking);
        (ahead >= least && behind >= least && !cuts_off && !comes && strangers).then_some((ahead, behind))
    }

    /// Those around a place in a lane, bodies that are changing out of it included.
    fn neighbours(&self, lane: usize, s: f64, length: f64) -> Neighbours {
        let queue = self.slabs.queue(lane);
        let rank = queue.partition_point(|other| other.s >= s);
        let mut ahead = rank.checked_sub(1).map(|rank| (queue[rank].s - queue[rank].length(), queue[rank].v));
        let behind = queue.get(rank).map(|other| (other.s, other.v));
        // One that is beside the place counts as ahead, with a gap that forbids the change.
        for ghost in self.ghosts(lane) {
            let beside = ghost.rear + ghost.length > s - length - 1.0;
            if beside && ahead.is_none_or(|ahead| ghost.rear < ahead.0) {
                ahead = Some((ghost.rear, ghost.v));
            }
        }
        Neighbours { ahead, behind, rank }
    }
}

/// How well a lane suits a vehicle, beside where it leads.
fn suits(scene: &Scene<'_>, vehicle: &Vehicle, lane: Track) -> i8 {
    let stops_there = vehicle.halt.is_finite() && scene.tracks.outermost[lane as usize];
    let kind = scene.config.vehicle_type(vehicle.row).kind;
    scene.tracks.suits(lane, kind) + 2 * i8::from(stops_there)
}

/// The acceleration of a vehicle on a lane, m/s², so far behind somebody with that speed, m and m/s.
fn drive(scene: &Scene<'_>, vehicle: &Vehicle, lane: Track, leader: (f64, f64)) -> f64 {
    let Driver { idm, closes_by, is_perfect } = &scene.drivers[usize::from(vehicle.row)];
    let free = idm.free_speed(scene.config, vehicle.factor, scene.tracks.speed[lane as usize]);
    if *is_perfect {
        return idm.respond(vehicle.v, free, idm.pressure_by(*closes_by, vehicle.v, leader.0, leader.1));
    }
    scene.config.vehicle_type(vehicle.row).drive(vehicle.v, free, leader, scene.at.dt)
}

/// The acceleration of a vehicle that stays in its lane, and what the one behind it gains if it leaves, m/s².
fn staying(scene: &Scene<'_>, queue: &[Vehicle], rank: usize, lane: Track) -> (f64, f64) {
    let vehicle = &queue[rank];
    let leader = rank.checked_sub(1).map(|rank| &queue[rank]);
    let gap = |s: f64| leader.map_or(f64::INFINITY, |leader| leader.s - leader.length() - s);
    let speed = leader.map_or(0.0, |leader| leader.v);
    let now = drive(scene, vehicle, lane, (gap(vehicle.s), speed));
    let gain = queue.get(rank + 1).map_or(0.0, |other| {
        let near = vehicle.s - vehicle.length() - other.s;
        drive(scene, other, lane, (gap(other.s), speed)) - drive(scene, other, lane, (near, vehicle.v))
    });
    (now, gain)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicle::Idm;

    #[test]
    fn the_defaults_never_ask_for_harder_braking_than_tyres_give() {
        let mobil = Mobil::default();
        assert!(mobil.safe_braking < crate::vehicle::HARDEST_BRAKING);
        let idm = Idm::default();
        // A gap of the model's own headway is safe, half a car length at speed is not.
        assert!(idm.acceleration(10.0, 13.9, 12.0, 10.0) > -mobil.safe_braking);
        assert!(idm.acceleration(10.0, 13.9, 2.0, 10.0) < -mobil.safe_braking);
    }
}
