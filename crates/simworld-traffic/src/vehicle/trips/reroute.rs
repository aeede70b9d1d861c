//! Vehicles that are sent another way while they drive.

use serde::{Deserialize, Serialize};
use simworld_core::hash::StateHasher;
use simworld_core::id::LaneId;
use simworld_core::net::LaneDirection;
use simworld_core::seed::Stream;

use crate::takeover::ControlError;
use crate::vehicle::manager::{NONE, VehicleManager};
use crate::vehicle::tracks::closures::is_committed;
use crate::vehicle::tracks::{Track, Tracks};
use crate::{Leg, Route, TrafficConfig};

/// Legs that a vehicle may be sent through at once: each is a way to look for.
const MOST_LEGS: usize = 1000;

/// Those who have no route of their own and turn round: by number, with the leg from which they drive as they like again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(in crate::vehicle) struct Rounds(Vec<(u32, Leg)>);

impl Rounds {
    pub(in crate::vehicle) fn forget(&mut self, id: u32) {
        self.0.retain(|(own, _)| *own != id);
    }

    pub(in crate::vehicle) fn has(&self, id: u32) -> bool {
        self.0.iter().any(|(own, _)| *own == id)
    }

    pub(in crate::vehicle) fn fits(&self, tracks: &Tracks, numbers: usize) -> bool {
        self.0.iter().all(|(id, leg)| (*id as usize) < numbers && !leg.lanes(&tracks.network).is_empty())
    }

    pub(in crate::vehicle) fn state_hash(&self, hasher: &mut StateHasher) {
        for (id, leg) in &self.0 {
            hasher.u64(u64::from(*id)).u64(leg.index() as u64);
        }
    }
}

/// Where a vehicle is on its way: its track, its place there, and the legs that it cannot but drive, of which the last is where it
/// may choose again.
struct Standing {
    track: Track,
    rank: usize,
    legs: Vec<Leg>,
}

impl VehicleManager {
    /// Turns a vehicle round: to the other direction of the road that it is on or comes to, and on to the end of its route.
    ///
    /// # Errors
    /// It is not on a lane, its road has no other direction, or no open way leads there or on from there.
    pub(crate) fn turn_round(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        id: u32,
    ) -> Result<(), ControlError> {
        let refused = |reason| ControlError::NoWay { id, reason };
        let standing = self.standing(tracks, id)?;
        let here = *standing.legs.last().ok_or(refused("it is on no road"))?;
        let back = opposite(here);
        if back.lanes(&tracks.network).is_empty() {
            return Err(refused("its road has no lanes the other way"));
        }
        let path = self.paths(tracks, standing.track)[standing.rank];
        let goal = self.last_leg(path.route).filter(|goal| *goal != back);
        // Who was turning round already still has no route of its own.
        let wanders = self.last_leg(path.route).is_none() || self.rounds.0.iter().any(|(own, _)| *own == id);
        let through = match goal.filter(|_| !wanders) {
            Some(goal) => vec![back, goal],
            None => vec![back],
        };
        self.send(tracks, config, streams, id, &standing, &through)?;
        if wanders {
            self.rounds.0.push((id, back));
        }
        Ok(())
    }

    /// Sends a vehicle through legs, by the quickest open way to each; it leaves at the end of the last.
    ///
    /// # Errors
    /// It is not on a lane, there are no legs, or no open way leads to one of them.
    pub(crate) fn reroute(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        id: u32,
        through: &[Leg],
    ) -> Result<(), ControlError> {
        let standing = self.standing(tracks, id)?;
        if !(1..=MOST_LEGS).contains(&through.len()) {
            return Err(ControlError::NoWay { id, reason: "give 1 to 1000 legs to go through" });
        }
        self.send(tracks, config, streams, id, &standing, through)
    }

    /// Those who have turned round and had no route drive on as they like.
    pub(in crate::vehicle) fn come_round(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
    ) {
        if self.rounds.0.is_empty() {
            return;
        }
        let mut rounds = std::mem::take(&mut self.rounds.0);
        rounds.retain(|(id, leg)| {
            let Some((track, ..)) = self.find(tracks, *id) else { return false };
            let is_round =
                tracks.connection(track).is_none() && Leg::of(&tracks.network, LaneId(track)) == *leg;
            if is_round && let Some(rank) = self.rank_of(tracks, track, *id) {
                self.set_route(tracks, config, streams, (track, rank), NONE);
            }
            !is_round
        });
        self.rounds.0 = rounds;
    }

    fn standing(&self, tracks: &Tracks, id: u32) -> Result<Standing, ControlError> {
        if self.free_body(id).is_some() {
            let (wanted, mend) = ("on a lane", "give it back first");
            return Err(ControlError::NotSo { what: "vehicle", id, wanted, mend });
        }
        let nobody = ControlError::Nobody { what: "vehicle", id };
        let Some((track, vehicle, _)) = self.find(tracks, id) else { return Err(nobody) };
        let network = &tracks.network;
        let legs = match tracks.connection(track) {
            Some(way) => {
                let way = &network.connections[way];
                vec![Leg::of(network, way.from), Leg::of(network, way.to)]
            }
            None if is_committed(tracks, track, vehicle) => {
                let after = tracks.lane_after(vehicle.holding as usize);
                vec![Leg::of(network, LaneId(track)), Leg::of(network, LaneId(after))]
            }
            None => vec![Leg::of(network, LaneId(track))],
        };
        let rank = self.rank_of(tracks, track, id).ok_or(nobody)?;
        Ok(Standing { track, rank, legs })
    }

    fn rank_of(&self, tracks: &Tracks, track: Track, id: u32) -> Option<usize> {
        self.queue(tracks, track).iter().position(|vehicle| vehicle.id == id)
    }

    fn send(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        id: u32,
        standing: &Standing,
        through: &[Leg],
    ) -> Result<(), ControlError> {
        let mut legs = standing.legs.clone();
        let driven = through.iter().filter(|leg| !tracks.is_inside(**leg));
        if driven.clone().next().is_none() {
            return Err(ControlError::NoWay { id, reason: "all of the roads are inside of junctions" });
        }
        for leg in driven {
            let from = *legs.last().unwrap_or(leg);
            if leg.lanes(&tracks.network).is_empty() {
                return Err(ControlError::NoWay { id, reason: "one of the roads has no lanes that way" });
            }
            if from == *leg {
                continue;
            }
            let reason = "no open way leads there from where it is";
            let way = self.closures.quickest(tracks, from, *leg).ok_or(ControlError::NoWay { id, reason })?;
            legs.extend(way.0.into_iter().skip(1));
        }
        self.rounds.forget(id);
        let route = self.add_route(Route(legs));
        self.set_route(tracks, config, streams, (standing.track, standing.rank), route);
        Ok(())
    }

    /// Gives a vehicle a route that begins with the leg it is on or comes from; [`NONE`] lets it drive as it likes.
    fn set_route(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        (track, rank): (Track, usize),
        route: u32,
    ) {
        let (vehicle, mut path) = (self.queue(tracks, track)[rank], self.paths(tracks, track)[rank]);
        (path.route, path.leg) = (route, 0);
        let next = if is_committed(tracks, track, &vehicle) {
            vehicle.next
        } else {
            self.choose((tracks, config), streams, &mut Vec::new(), &vehicle, &mut path, track)
        };
        let (queue, paths) = self.both_mut(tracks, track);
        queue[rank].next = next;
        paths[rank] = path;
    }
}

fn opposite(leg: Leg) -> Leg {
    let is_forward = leg.index().is_multiple_of(2);
    let direction = if is_forward { LaneDirection::Backward } else { LaneDirection::Forward };
    Leg::new(leg.road(), direction)
}
