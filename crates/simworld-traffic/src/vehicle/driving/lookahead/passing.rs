//! What a driver sees of [passing](super::super::passing): where he waits behind what stands, how he goes round it, and how others let him.

use super::super::lane_change::STEEPNESS;
use super::super::passing::{PASSING_SPEED, Pass, ROOM, room_behind};
use super::{Lane, View, first_obstacle, on_track};
use crate::vehicle::manager::{NONE, Vehicle};
use crate::vehicle::queues::ghosts::first_ghost;

/// How far aside one gets on the way from where one waits, m: enough to go round a lorry.
const ASIDE: f64 = ROOM * STEEPNESS;
/// Stations of the same thing differ by no more, m.
const SAME: f64 = 0.1;
/// Who waits behind something keeps its rear so far out of the junction behind, m.
const OUT_OF_JUNCTION: f64 = 1.0;

impl<'a> Lane<'a> {
    /// Whom one follows who passes what stands on the lane: who is out before one, or is beyond it.
    pub(super) fn leader_beyond(&self, vehicle: &Vehicle, pass: &Pass) -> Option<&'a Vehicle> {
        let scene = self.scene;
        let queue = self.part.slabs.queue(scene.tracks.layout.local(self.track));
        let rank = queue.iter().position(|other| other.id == vehicle.id)?;
        let is_beyond = |other: &&Vehicle| other.s > pass.far + SAME || scene.passings.of(other.id).is_some();
        queue[..rank].iter().rev().find(is_beyond)
    }
}

impl View<'_> {
    /// Passes what stands on its lane: up to it while it is not beside the way past, then by, minding what is beyond and what is on the
    /// oncoming lane, and back.
    pub(super) fn pass(&mut self, lane: &Lane<'_>, vehicle: &Vehicle, pass: &Pass) {
        let sight = &lane.scene.sight;
        let half_width = lane.scene.config.vehicle_type(vehicle.row).width * 0.5;
        let closer = self.idm.gap * 0.5;
        self.slow_to(PASSING_SPEED, 0.0);
        if !pass.is_clear(vehicle) && !pass.is_by(vehicle) {
            self.follow(pass.near - self.s + closer, 0.0);
        }
        let beyond = self.s.max(pass.far);
        if let Some((gap, speed)) = first_ghost(lane.ghosts, beyond) {
            self.follow(beyond + gap - self.s, speed);
        }
        if let Some(body) = first_obstacle(sight, lane.track, beyond, half_width) {
            self.follow(body.near - self.s, body.v);
        }
        let mut bodies = on_track(sight, lane.track).iter();
        if let Some(body) = bodies.find(|body| body.near >= self.s && pass.meets(body, half_width)) {
            self.follow(body.near - self.s + closer, 0.0);
        }
        if pass.needs_lane(vehicle)
            && let Some(gap) = pass.gap_on_oncoming(sight.obstacles, vehicle, half_width)
        {
            self.follow(gap + closer, 0.0);
        }
        if pass.is_by(vehicle) && pass.is_kept_out(sight.obstacles, vehicle, half_width) {
            // No farther than the lane is kept free.
            self.stop_in(pass.back - self.s, self.idm.gap);
        }
    }

    /// Lets those pass who do: behind what they pass one stays behind it, as part of it where one is, and as who was asked to let one out
    /// before the stretch.
    pub(super) fn mind_passings(&mut self, lane: &Lane<'_>, vehicle: &Vehicle) {
        let passings = lane.scene.passings;
        for pass in passings.list.iter().filter(|pass| pass.lane == lane.track) {
            if self.s <= pass.near {
                let gap = pass.near - self.s;
                self.follow(gap + self.idm.gap * 0.5, 0.0);
                self.stop_to_pass(lane, vehicle, gap, pass.far);
            } else if self.s <= pass.far + SAME {
                self.follow(0.0, 0.0);
            }
        }
        for line in passings.asks.iter().filter_map(|ask| ask.line_for(vehicle, lane.track)) {
            self.stop_in(line - self.s, self.idm.gap);
        }
    }

    /// Behind one who broke down, or is about to stand: far enough that one gets out beside it.
    pub(super) fn mind_breakdown(&mut self, lane: &Lane<'_>, vehicle: &Vehicle, leader: &Vehicle) {
        if !may_pass(lane) || !lane.scene.halts.is_breakdown(leader.id) {
            return;
        }
        let front = leader.s.max(f64::from(leader.halt));
        self.stop_to_pass(lane, vehicle, front - leader.length() - self.s, front);
    }

    /// The same behind bodies and works.
    pub(super) fn mind_block(&mut self, lane: &Lane<'_>, vehicle: &Vehicle) {
        let mut fixed = lane.ghosts.iter().filter(|ghost| ghost.is_fixed && ghost.rear >= self.s);
        if let Some(ghost) = fixed.next() {
            self.stop_to_pass(lane, vehicle, ghost.rear - self.s, ghost.rear + ghost.length);
        }
    }

    /// Stops some way before something that stands `gap` m ahead and ends at a station, if one may get round it and can still stop there.
    fn stop_to_pass(&mut self, lane: &Lane<'_>, vehicle: &Vehicle, gap: f64, far: f64) {
        let early = gap - ROOM;
        // Harder than comfortably, so that who has begun to brake for it does not think better of it half way.
        let stopping = self.v * self.v / self.idm.emergency_deceleration;
        let is_whole = self.s + early - vehicle.length() > OUT_OF_JUNCTION;
        let is_far_from_end = far + room_behind(vehicle.length(), ASIDE) <= lane.end;
        if may_pass(lane) && early > stopping && is_whole && is_far_from_end {
            self.stop_in(early, self.idm.gap);
        }
    }
}

/// Whether one may get round what stands on a lane over the oncoming one.
fn may_pass(lane: &Lane<'_>) -> bool {
    let opposite = lane.scene.tracks.opposite.get(lane.track as usize);
    lane.scene.config.pass_obstacles && opposite.is_some_and(|opposite| *opposite != NONE)
}
