//! Bodies that somebody else drives, at junctions and beside: one gives way to them as to others.
//!
//! Where they will turn nobody knows: who is in a lane may take each of its ways.

use simworld_core::net::{Aspect, time_over};

use crate::vehicle::Way;
use crate::vehicle::junctions::junction::horizon;
use crate::vehicle::junctions::precedence::{Asker, CLEARS, COMES, Comer, EASILY, MARGIN, SIGHT};
use crate::vehicle::manager::{STANDING, Vehicle};
use crate::vehicle::scene::{Scene, Sight};
use crate::vehicle::tracks::conflicts::Conflict;
use crate::vehicle::tracks::{Obstacle, Track};

/// Whether one who asks to cross would be in the way of a stranger on a way that meets its own, or before it. Those who stand are
/// not waited for: they wait themselves, or are in one's path, where one stops for them.
pub(in crate::vehicle) fn hinder(scene: &Scene<'_>, asker: &Asker, conflict: &Conflict) -> bool {
    if scene.sight.obstacles.is_empty() {
        return false;
    }
    let tracks = scene.tracks;
    let Way { from, signal, .. } = tracks.ways[conflict.way as usize];
    let (limit, end) = (tracks.speed[from as usize], tracks.length[from as usize]);
    let way = (tracks.lanes + conflict.way as usize) as Track;
    let comes = |body: &Obstacle| {
        let distance = (end - body.far).max(0.0);
        let could_stop = body.v * body.v <= 2.0 * EASILY * distance;
        // Who has priority is relied on; of others only those count who cannot stop any more.
        let counts = (conflict.yields && scene.aspect(signal) == Aspect::Green) || !could_stop;
        let comer = Comer { distance, v: body.v, limit, acceleration: COMES };
        distance < SIGHT && counts && !asker.goes_before(conflict, &comer)
    };
    let concerns =
        |body: &&Obstacle| body.v > STANDING && conflict.pairs.has(asker.length, body.far - body.near);
    let moving = |track: Track| on_track(&scene.sight, track).iter().filter(concerns);
    moving(way).any(|body| crosses(scene, asker, conflict, body)) || moving(from).any(comes)
}

/// How far ahead of one on its way across, or with leave to cross, the way of a stranger begins who moves on it and would be met
/// there, m: strangers keep no order of leave, and one that set off late, or against the rules, is not run into. Who could no longer
/// stop, or is there already, goes on.
pub(in crate::vehicle) fn meets(
    scene: &Scene<'_>,
    vehicle: &Vehicle,
    (way, front): (usize, f64),
) -> Option<f64> {
    if scene.sight.obstacles.is_empty() {
        return None;
    }
    let tracks = scene.tracks;
    let hardest = scene.config.vehicle_type(vehicle.row).driver.emergency_deceleration;
    let stopping = vehicle.v * vehicle.v / (2.0 * hardest);
    let asker = Asker::on_way(scene, vehicle, way, front);
    let met = |conflict: &&Conflict| {
        let to_zone = conflict.own.enter() - front;
        if !(stopping..horizon(vehicle.v)).contains(&to_zone) {
            return false;
        }
        let bodies = on_track(&scene.sight, (tracks.lanes + conflict.way as usize) as Track).iter();
        let mut moving = bodies
            .filter(|body| body.v > STANDING && conflict.pairs.has(vehicle.length(), body.far - body.near));
        moving.any(|body| crosses(scene, &asker, conflict, body))
    };
    let zones = tracks.conflicts[way].iter().filter(met).map(|conflict| conflict.own.enter() - front);
    zones.min_by(f64::total_cmp)
}

/// Whether a stranger on a way that meets one's own is there when one comes, and would be met.
fn crosses(scene: &Scene<'_>, asker: &Asker, conflict: &Conflict, body: &Obstacle) -> bool {
    let tracks = scene.tracks;
    let limit = tracks.speed[tracks.ways[conflict.way as usize].from as usize];
    let speed = tracks.speed[tracks.lanes + conflict.way as usize];
    let clears = time_over(conflict.other.passed() - body.near, body.v, CLEARS, speed.max(3.0));
    let comes = time_over(conflict.other.enter() - body.far, body.v, COMES, limit.max(body.v));
    body.near < conflict.other.passed()
        && clears > asker.time(conflict.own.enter())
        && asker.gone(conflict) + MARGIN > comes
}

/// Whether strangers behind a place in a lane let somebody in whose rear would be there: with this much room at least, m, and no
/// harder braking than this, m/s².
pub(in crate::vehicle) fn let_in(
    sight: &Sight<'_>,
    lane: Track,
    (rear, v): (f64, f64),
    least: f64,
    braking: f64,
) -> bool {
    on_track(sight, lane).iter().filter(|body| body.far <= rear).all(|body| {
        let (gap, closing) = (rear - body.far - least, (body.v - v).max(0.0));
        gap >= 0.0 && closing * closing <= 2.0 * braking * gap
    })
}

/// Those on a track.
pub(in crate::vehicle) fn on_track<'a>(sight: &Sight<'a>, track: Track) -> &'a [Obstacle] {
    of_track(sight.obstacles, track)
}

/// Those of a sorted list that are on a track.
pub(in crate::vehicle) fn of_track(obstacles: &[Obstacle], track: Track) -> &[Obstacle] {
    let from = obstacles.partition_point(|body| body.track < track);
    let count = obstacles[from..].partition_point(|body| body.track == track);
    &obstacles[from..from + count]
}
