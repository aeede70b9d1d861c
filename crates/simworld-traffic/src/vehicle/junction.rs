//! Leave to cross: who may enter a junction, and when leave is taken back.
//!
//! A way across is granted to a vehicle only while no way that touches it is held, nobody with priority would be hindered,
//! nobody is on the strips that it passes over, and there is room behind it. Leave ends when the vehicle's rear is
//! out. Two vehicles on touching ways are therefore never in the junction at once, whatever their drivers do.

use simworld_core::net::Aspect;

use super::manager::{EXIT, NONE, STANDING, Sight, Vehicle, VehicleManager, room_for};
use super::tracks::{Track, Tracks};
use crate::{Counters, TrafficConfig};

/// Braking that drivers accept to stop at yellow, m/s².
const COMFORTABLE: f64 = 3.0;
/// Time that one wants between clearing a conflict and the arrival of who has priority, s.
const MARGIN: f64 = 1.0;
/// Yellow that has shown for less time than this leaves enough of it to get under way, s.
const FRESH: f64 = 0.6;
/// A vehicle nearer to its stop line than this stands at it, m.
const AT_LINE: f64 = 1.5;
/// Vehicles with priority are looked for within this distance, m.
const SIGHT: f64 = 90.0;

/// A vehicle that asks for leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Request {
    stood: f64,
    id: u32,
    lane: Track,
    rank: usize,
}

/// Takes leave back from those who can still stop for a signal that changed; counts those who cannot.
pub(super) fn revoke(
    manager: &mut VehicleManager,
    tracks: &Tracks,
    config: &TrafficConfig,
    sight: &Sight<'_>,
    counters: &mut Counters,
) {
    let VehicleManager { queues, active, holders, long_holders, inbound, .. } = manager;
    for track in active.iter().filter(|track| (**track as usize) < tracks.lanes) {
        let end = tracks.length[*track as usize];
        for vehicle in &mut queues[*track as usize] {
            if vehicle.holding == NONE || vehicle.holding != vehicle.next {
                if vehicle.holding == NONE && vehicle.next != EXIT {
                    break; // nobody behind has leave either
                }
                continue;
            }
            let way = vehicle.holding as usize;
            let Some(group) = tracks.network.connections[way].signal else { continue };
            let distance = end - vehicle.s;
            let needed = vehicle.v * vehicle.v / (2.0 * distance.max(0.01));
            let crosses_oncoming =
                tracks.network.connections[way].turn == tracks.network.driving_side.turn_across();
            let gone = match sight.aspects[group.index()] {
                Aspect::Green => false,
                Aspect::Yellow => {
                    needed <= at_yellow(config, vehicle) && !(crosses_oncoming && distance < AT_LINE)
                }
                Aspect::Red => needed <= config.vehicle_type(vehicle.row).driver.emergency_deceleration,
            };
            if gone {
                vehicle.holding = NONE;
                holders[way] -= 1;
                long_holders[way] -= u32::from(vehicle.is_long());
                inbound[tracks.lane_after(way) as usize] -= room_for(vehicle, config);
            } else if sight.aspects[group.index()] == Aspect::Red {
                counters.dilemmas += 1;
            }
        }
    }
}

/// Grants leave, to those who have stood longest first.
pub(super) fn grant(
    manager: &mut VehicleManager,
    tracks: &Tracks,
    config: &TrafficConfig,
    sight: &Sight<'_>,
    counters: &mut Counters,
) {
    let mut requests = std::mem::take(&mut manager.requests);
    requests.clear();
    for track in manager.active.iter().filter(|track| (**track as usize) < tracks.lanes) {
        collect(manager, tracks, *track, &mut requests);
    }
    // Within a lane the first in line asks first, whoever has stood longer.
    requests.sort_by(|a, b| b.stood.total_cmp(&a.stood).then(a.rank.cmp(&b.rank)).then(a.id.cmp(&b.id)));
    for request in &requests {
        let queue = &manager.queues[request.lane as usize];
        let vehicle = queue[request.rank];
        let before = request.rank.checked_sub(1).map(|rank| &queue[rank]);
        let stays = |before: &Vehicle| before.next != EXIT && before.holding != before.next;
        if before.is_some_and(|before| stays(before) || before.next == NONE) {
            continue; // one's turn comes after those before
        }
        if may_enter(manager, tracks, config, sight, request.lane, &vehicle) {
            let way = vehicle.next as usize;
            manager.queues[request.lane as usize][request.rank].holding = vehicle.next;
            manager.holders[way] += 1;
            manager.long_holders[way] += u32::from(vehicle.is_long());
            manager.inbound[tracks.lane_after(way) as usize] += room_for(&vehicle, config);
            counters.crossings += 1;
            if let Ok(place) = manager.passes.binary_search(&vehicle.id) {
                manager.passes.remove(place);
            }
        }
    }
    manager.requests = requests;
}

/// The vehicles of a lane that are near enough to its end to ask.
fn collect(manager: &VehicleManager, tracks: &Tracks, lane: Track, requests: &mut Vec<Request>) {
    let end = tracks.length[lane as usize];
    for (rank, vehicle) in manager.queues[lane as usize].iter().enumerate() {
        let distance = end - vehicle.s;
        let horizon = 8.0 + vehicle.v * 1.5 + vehicle.v * vehicle.v / 4.0;
        if distance > horizon || vehicle.next == NONE {
            break;
        }
        if vehicle.next == EXIT {
            continue;
        }
        if vehicle.holding == NONE {
            requests.push(Request { stood: vehicle.stood, id: vehicle.id, lane, rank });
        } else if vehicle.holding != vehicle.next {
            break; // its rear is still in the junction behind it
        }
    }
}

fn may_enter(
    manager: &VehicleManager,
    tracks: &Tracks,
    config: &TrafficConfig,
    sight: &Sight<'_>,
    lane: Track,
    vehicle: &Vehicle,
) -> bool {
    let way = vehicle.next as usize;
    let connection = &tracks.network.connections[way];
    let distance = tracks.length[lane as usize] - vehicle.s;
    vehicle.shift == 0.0
        && signal_allows(tracks, config, sight, way, vehicle, distance)
        && connection.conflicts.iter().all(|other| manager.holders[other.index()] == 0)
        && tracks.tight[way].iter().all(|other| {
            let held = if vehicle.is_long() { &manager.holders } else { &manager.long_holders };
            held[*other as usize] == 0
        })
        && tracks.strips[way].iter().all(|strip| {
            sight.walkers[strip.crossing as usize] == 0 && sight.waiting[strip.crossing as usize] == 0
        })
        && (has_room(manager, tracks, config, way, vehicle) || may_pass(manager, vehicle))
        && connection
            .yields_to
            .iter()
            .all(|other| !is_hindered(manager, tracks, sight, other.index(), way, vehicle, distance))
}

/// The braking that a driver accepts to stop at yellow, m/s²: less on a slippery road.
fn at_yellow(config: &TrafficConfig, vehicle: &Vehicle) -> f64 {
    COMFORTABLE.min(config.vehicle_type(vehicle.row).driver.emergency_deceleration * 0.6)
}

fn signal_allows(
    tracks: &Tracks,
    config: &TrafficConfig,
    sight: &Sight<'_>,
    way: usize,
    vehicle: &Vehicle,
    distance: f64,
) -> bool {
    let connection = &tracks.network.connections[way];
    let Some(group) = connection.signal else { return true };
    match sight.aspects[group.index()] {
        Aspect::Green => true,
        Aspect::Red => false,
        Aspect::Yellow => {
            // Too late to stop; or a turn across oncoming traffic that waited through the whole green for its gap.
            let needed = vehicle.v * vehicle.v / (2.0 * distance.max(0.01));
            needed > at_yellow(config, vehicle)
                || (connection.turn == tracks.network.driving_side.turn_across()
                    && distance < AT_LINE
                    && vehicle.stood > 5.0
                    && sight.shown[group.index()] < FRESH)
        }
    }
}

/// Whether a vehicle may enter without room behind the junction, because it is in a lock.
fn may_pass(manager: &VehicleManager, vehicle: &Vehicle) -> bool {
    manager.passes.binary_search(&vehicle.id).is_ok()
}

/// Whether the lane behind the junction has room, so that the junction is not blocked.
pub(super) fn has_room(
    manager: &VehicleManager,
    tracks: &Tracks,
    config: &TrafficConfig,
    way: usize,
    vehicle: &Vehicle,
) -> bool {
    let lane = tracks.lane_after(way) as usize;
    let inbound = manager.inbound[lane];
    let Some(last) = manager.queues[lane].back() else {
        // An empty lane takes one vehicle even if it is longer than the lane.
        return inbound <= 0.0 || inbound + room_for(vehicle, config) <= tracks.length[lane];
    };
    // What moves will have moved on by the time one gets there.
    let rear = last.s - last.length() + if last.v > STANDING { last.v * 2.0 } else { 0.0 };
    rear - inbound >= room_for(vehicle, config)
}

/// Whether somebody with priority on another way would have to brake.
fn is_hindered(
    manager: &VehicleManager,
    tracks: &Tracks,
    sight: &Sight<'_>,
    other: usize,
    way: usize,
    vehicle: &Vehicle,
    distance: f64,
) -> bool {
    let rival_way = &tracks.network.connections[other];
    if rival_way.signal.is_some_and(|group| sight.aspects[group.index()] != Aspect::Green) {
        return false;
    }
    let rival_lane = rival_way.from.index();
    let end = tracks.length[rival_lane];
    let rival = manager.queues[rival_lane].iter().find(|rival| rival.next as usize == other);
    let Some(rival) = rival.filter(|rival| end - rival.s < SIGHT) else { return false };
    if rival.v < STANDING && rival.stood > 3.0 {
        return false; // it cannot go, or lets one go
    }
    let track = tracks.lanes + way;
    let pace = ((vehicle.v + tracks.speed[track].min(8.0)) * 0.5).max(2.5);
    let clear = (distance + tracks.length[track] + vehicle.length()) / pace;
    (end - rival.s) / rival.v.max(3.0) < clear + MARGIN
}
