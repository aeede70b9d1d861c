//! Who goes out on the oncoming lane, and when: the first behind what stands, after a wait, when nobody comes; some of those behind go
//! too. Who has waited for long is let out.

use simworld_core::net::{polyline, time_over};

use super::super::idm::advance;
use super::super::lane_change::STEEPNESS;
use super::barrier::Barrier;
use super::{
    Ask, BEHIND, IN_LANE, JUNCTION, Mind, PASSING_SPEED, Pass, ROOM, SPARE, TO_SIDE, aside, room_behind,
};
use crate::vehicle::foreign::strangers::of_track;
use crate::vehicle::junctions::precedence::COMES;
use crate::vehicle::manager::{NONE, STANDING, Vehicle, VehicleManager};
use crate::vehicle::tracks::{Obstacle, Track};

/// Who has stood for so long behind something sees that it does not go on, s; ours, two or three looks ahead.
const WAIT: f64 = 5.0;
/// Who stands farther behind it than this stands for something else, m.
const WAITS_FOR_IT: f64 = ROOM + 8.0;
/// One comes to nobody nearer than this in time, s: one who comes faster than it seemed need not brake.
const MARGIN: f64 = 2.0;
/// So many go one behind the other, then those who come have their turn.
const PLATOON: u32 = 3;
/// Who has been let wait for so long is let out by the next who can stop comfortably, s; ours, the green of others at works with signals.
const COURTESY: f64 = 60.0;
/// Room before the stretch that is kept free, m: who comes stops there.
const BEFORE: f64 = 1.0;
/// A rear is so far out of the junction behind, m.
const OUT_OF_JUNCTION: f64 = 1.0;
/// One goes so far aside at least, m.
const LEAST_ASIDE: f64 = 0.3;
/// And so far beyond the middle of the oncoming lane at most, m: bodies beside that leave this much room.
const BEYOND: f64 = 0.2;
/// What takes longer is not begun, s.
const LONGEST: f64 = 60.0;
/// Time between two looks at how it would go, s.
const LOOK: f64 = 0.1;
/// Stations of the same thing differ by no more, m.
const SAME: f64 = 0.1;

impl VehicleManager {
    /// Lets those go out who want to and may; how many do.
    pub(super) fn begin_passing(&mut self, mind: &Mind<'_>) -> u64 {
        let mut begun = 0;
        for body in mind.obstacles.iter().filter(|body| body.stands) {
            begun += self.look_past(mind, body.track);
        }
        for index in 0..self.closures.blocks.len() {
            let lane = self.closures.blocks[index].0;
            begun += self.look_past(mind, lane);
        }
        let mut from = 0;
        while let Some(id) = self.halts.next_breakdown(from) {
            begun += self.look_past(mind, self.whereabouts.get(id as usize));
            from = id + 1;
        }
        from = 0;
        while let Some(id) = self.controls.next_driven(from) {
            begun += self.look_past(mind, self.whereabouts.get(id as usize));
            from = id + 1;
        }
        begun
    }

    /// The same on one lane, in its turn; nobody on lanes that none comes along beside, or while those who come are out on this one.
    fn look_past(&mut self, mind: &Mind<'_>, lane: Track) -> u64 {
        let tracks = mind.tracks;
        let opposite = tracks.opposite.get(lane as usize).copied().unwrap_or(NONE);
        if opposite == NONE
            || self.closures.has(opposite)
            || self.passings.list.iter().any(|pass| pass.lane == opposite)
        {
            return 0;
        }
        let clocks = [lane, opposite].map(|track| {
            let part = tracks.layout.place(track).part;
            &self.parts[part as usize].clock
        });
        // While two parts are not at one time, nobody knows who comes. Those that go in rounds are once in each.
        let is_turn = mind.at.turn()(lane) || clocks.iter().any(|clock| clock.is_far());
        if !is_turn || clocks.iter().any(|clock| clock.waited() > 0.0) {
            return 0;
        }
        let count = self.queue(tracks, lane).len();
        (0..count).map(|rank| u64::from(self.consider_passing(mind, (lane, opposite), rank))).sum()
    }

    /// Lets one of a lane go out, if it wants to and may; else asks for it, if it was let wait for too long.
    fn consider_passing(&mut self, mind: &Mind<'_>, (lane, opposite): (Track, Track), rank: usize) -> bool {
        let queue = self.queue(mind.tracks, lane);
        let (vehicle, ahead) = (queue[rank], &queue[..rank]);
        if !self.may_want(&vehicle) {
            return false;
        }
        let apart = mind.tracks.apart(lane, opposite);
        let Some(barrier) = self.barrier(mind, lane, &vehicle, apart) else { return false };
        let Some((number, yields)) = self.let_out(ahead, &vehicle, &barrier) else { return false };
        let Some(pass) = course(mind, (lane, opposite), &vehicle, &barrier) else { return false };
        if !self.is_landing_free(mind, ahead, &vehicle, &pass) {
            return false;
        }
        let asked = self.passings.asks.iter().find(|ask| ask.id == vehicle.id).map(|ask| ask.yields);
        let yields = asked.unwrap_or(yields);
        let Some(time) = duration(mind, &vehicle, &pass) else { return false };
        if self.is_free(mind, &vehicle, &pass, (time, yields)) {
            self.passings.asks.retain(|ask| ask.id != vehicle.id);
            self.passings.list.push(Pass { number, yields, ..pass });
            return true;
        }
        if vehicle.stood > COURTESY {
            self.ask(mind, &pass);
        }
        false
    }

    /// Whether a vehicle is one that could pass at all: in its lane, whole, driven by its own driver, and not about to halt or to cross.
    fn may_want(&self, vehicle: &Vehicle) -> bool {
        (vehicle.stood >= WAIT || !self.passings.list.is_empty())
            && vehicle.v < PASSING_SPEED
            && vehicle.shift == 0.0
            && vehicle.halt.is_infinite()
            && vehicle.holding == NONE
            && vehicle.s - vehicle.length() >= OUT_OF_JUNCTION
            && !self.controls.drives(vehicle.id)
            && self.passings.of(vehicle.id).is_none()
    }

    /// Whether it is one's turn: as the first behind what stands, after the wait, or right behind one who is out and moves. How many go
    /// before one then, and who lets them.
    fn let_out(&self, ahead: &[Vehicle], vehicle: &Vehicle, barrier: &Barrier) -> Option<(u32, u32)> {
        if barrier.near - vehicle.s > WAITS_FOR_IT {
            return None;
        }
        let is_part = |other: &Vehicle| other.s <= barrier.far + SAME && self.is_in_the_way(other);
        let before = ahead.iter().rev().find(|other| !is_part(other));
        let out = before.and_then(|before| Some((before, self.passes(before, barrier.far)?)));
        match (before, out) {
            (_, Some((before, pass))) => {
                let goes_on = before.v > STANDING && pass.is_clear(before);
                (goes_on && pass.number + 1 < PLATOON).then_some((pass.number + 1, pass.yields))
            }
            // Somebody stands between, or has not quite come out from where something was put.
            (Some(before), None) if before.s - before.length() < barrier.far => None,
            _ => (vehicle.stood >= WAIT).then_some((0, NONE)),
        }
    }

    /// How a vehicle passes what ends at a station, if it does.
    fn passes(&self, vehicle: &Vehicle, far: f64) -> Option<&Pass> {
        self.passings.of(vehicle.id).filter(|pass| (pass.far - far).abs() < SAME)
    }

    /// Whether there is room to turn in again, also behind those who are out before one.
    fn is_landing_free(&self, mind: &Mind<'_>, ahead: &[Vehicle], vehicle: &Vehicle, pass: &Pass) -> bool {
        let gap = |vehicle: &Vehicle| mind.config.vehicle_type(vehicle.row).driver.gap;
        let mut room = pass.back + gap(vehicle);
        for other in ahead.iter().rev() {
            if self.passes(other, pass.far).is_some() {
                room += other.length() + gap(other);
            } else if other.s > pass.far + SAME {
                return other.s - other.length() >= room;
            }
        }
        room + SPARE <= mind.tracks.length[pass.lane as usize]
    }

    /// Whether nobody is on the stretch, or comes to it before one is back, in so many seconds; one who lets one out is relied on.
    fn is_free(&self, mind: &Mind<'_>, vehicle: &Vehicle, pass: &Pass, (time, yields): (f64, u32)) -> bool {
        let Mind { tracks, config, obstacles, .. } = *mind;
        let (lane, (start, end)) = (pass.opposite, pass.kept);
        let half_width = config.vehicle_type(vehicle.row).width * 0.5;
        let works = self.closures.blocks.iter().filter(|(track, ..)| *track == lane);
        let mut bodies = of_track(obstacles, lane).iter();
        if works.clone().any(|(_, from, to)| *from < end + BEFORE && *to > start - BEFORE)
            || bodies.any(|body| !lets_pass(body, (start, end), time, half_width))
            || self.is_leaving_stretch(mind, lane, end)
        {
            return false;
        }
        // Nobody comes past what stands before the stretch.
        let standing = of_track(obstacles, lane).iter().filter(|body| body.stands && body.bars(half_width));
        let fences =
            works.map(|(_, from, to)| (*from, *to)).chain(standing.map(|body| (body.near, body.far)));
        let fence = fences.filter(|(_, to)| *to < start).map(|(from, _)| from).fold(0.0, f64::max);
        let limit = tracks.speed[lane as usize];
        for other in self.queue(tracks, lane) {
            let distance = start - other.s;
            if other.s - other.length() > end + BEFORE {
                continue; // it is past
            }
            if distance < BEFORE {
                return false;
            }
            if other.id == yields || other.s <= fence || self.is_in_the_way(other) {
                return true; // nobody comes before it goes on
            }
            let row = config.vehicle_type(other.row);
            let most = row.free_speed(config, other.factor, limit).max(other.v);
            if time_over(distance, other.v, COMES, most) < time + MARGIN {
                return false;
            }
        }
        // Who crosses the junction behind is about to be there.
        fence > 0.0 || self.junctions.inbound(lane) <= 0.0 || start / limit > time + MARGIN
    }

    /// Whether the rear of somebody who has left the end of a lane is still beside where one begins.
    fn is_leaving_stretch(&self, mind: &Mind<'_>, lane: Track, end: f64) -> bool {
        let tracks = mind.tracks;
        let ways = &tracks.network.lanes[lane as usize].outgoing;
        ways.iter().any(|way| {
            let last = self.queue(tracks, tracks.lanes as Track + way.0).last();
            last.is_some_and(|last| {
                last.s < last.length() && tracks.length[lane as usize] + last.s - last.length() < end + BEFORE
            })
        })
    }

    /// Asks the first who comes and can stop comfortably to let one out, unless one who was asked is still to come.
    fn ask(&mut self, mind: &Mind<'_>, pass: &Pass) {
        let line = pass.kept.0 - BEFORE;
        let comes = |other: &Vehicle| other.s <= line;
        let queue = self.queue(mind.tracks, pass.opposite);
        let known = self.passings.asks.iter().position(|ask| ask.id == pass.id);
        if let Some(place) = known {
            let yields = self.passings.asks[place].yields;
            if queue.iter().any(|other| other.id == yields && comes(other)) {
                return;
            }
        }
        let can_stop = |other: &&Vehicle| {
            let braking = mind.config.vehicle_type(other.row).driver.deceleration;
            comes(other) && line - other.s >= other.v * other.v / (2.0 * braking) + SPARE
        };
        // Who has leave to cross uses it: the junction waits for him.
        let found = queue.iter().find(can_stop).filter(|other| {
            other.holding == NONE && other.halt.is_infinite() && !self.controls.drives(other.id)
        });
        let Some(yields) = found.map(|other| other.id) else { return };
        let ask = Ask { id: pass.id, lane: pass.lane, yields, opposite: pass.opposite, line };
        match known {
            Some(place) => self.passings.asks[place] = ask,
            None => self.passings.asks.push(ask),
        }
    }
}

/// Whether a body on the oncoming lane is neither on a stretch nor comes to it within a time, s.
fn lets_pass(body: &Obstacle, (start, end): (f64, f64), time: f64, half_width: f64) -> bool {
    let is_there = body.far > start - BEFORE && body.near < end + BEFORE;
    let comes = body.far <= start && body.v > STANDING && (start - body.far) / body.v <= time + MARGIN;
    !comes && !(is_there && (body.bars(half_width) || !body.stands))
}

/// The way round what stands on a lane; none where it would reach beyond the oncoming lane, or into a junction.
fn course(
    mind: &Mind<'_>,
    (lane, opposite): (Track, Track),
    vehicle: &Vehicle,
    barrier: &Barrier,
) -> Option<Pass> {
    let tracks = mind.tracks;
    let (own, other) = (tracks.path(lane), tracks.path(opposite));
    let Barrier { near, far, reach } = *barrier;
    let middle = polyline::at(own, (near + far) * 0.5).0;
    let across = polyline::closest(other, &middle)?;
    let there = polyline::at(other, across.station).0;
    let lateral = polyline::closest(own, &there)?.lateral;
    let half_width = mind.config.vehicle_type(vehicle.row).width * 0.5;
    let reach = if lateral > 0.0 { reach.1 } else { -reach.0 };
    let away = (reach + half_width + TO_SIDE).max(LEAST_ASIDE);
    if away > lateral.abs() + BEYOND
        || far + room_behind(vehicle.length(), away) > tracks.length[lane as usize]
    {
        return None;
    }
    let back = far + BEHIND + vehicle.length() + away / STEEPNESS + SPARE;
    let span = (vehicle.s - vehicle.length() - OUT_OF_JUNCTION, back + SPARE);
    let station = |s: f64| Some(polyline::closest(other, &polyline::at(own, s).0)?.station);
    let kept = (station(span.1)?, station(span.0)?);
    // Who comes out of the junction ahead stops before the stretch, clear of that.
    if kept.0 < JUNCTION - SPARE || kept.1 < kept.0 + vehicle.length() {
        return None;
    }
    Some(Pass {
        id: vehicle.id,
        lane,
        opposite,
        near,
        far,
        aside: away.copysign(lateral),
        back,
        kept,
        own: span,
        number: 0,
        yields: NONE,
    })
}

/// How long it takes from here to where the oncoming lane is free again, s; none if it takes too long.
fn duration(mind: &Mind<'_>, vehicle: &Vehicle, pass: &Pass) -> Option<f64> {
    let row = mind.config.vehicle_type(vehicle.row);
    let limit = row.free_speed(mind.config, vehicle.factor, mind.tracks.speed[pass.lane as usize]);
    let free = limit.min(PASSING_SPEED);
    let (mut s, mut v, mut shift, wanted) = (vehicle.s, vehicle.v, 0.0_f64, pass.aside.abs());
    for look in 1..=(LONGEST / LOOK) as u32 {
        let is_by = s - vehicle.length() > pass.far + BEHIND;
        let step = aside(v) * LOOK;
        shift = if is_by { (shift - step).max(0.0) } else { (shift + step).min(wanted) };
        if is_by && shift <= IN_LANE {
            return Some(f64::from(look) * LOOK);
        }
        // Until it is clear it comes up to what stands there as to anything.
        let gap = if shift < wanted { pass.near - s + row.driver.gap * 0.5 } else { f64::INFINITY };
        let gap = if is_by { f64::INFINITY } else { gap };
        let acceleration = row.drive(v, free, (gap, 0.0), LOOK);
        let stands_close = v < STANDING && gap < row.driver.gap;
        let (after, way) = advance(v, if stands_close { acceleration.min(0.0) } else { acceleration }, LOOK);
        (s, v) = (s + way, after);
    }
    None
}
