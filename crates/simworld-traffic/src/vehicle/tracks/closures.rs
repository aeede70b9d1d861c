//! Which lanes are closed, and how drivers find their way around them.

use serde::{Deserialize, Serialize};
use simworld_core::id::LaneId;
use simworld_core::seed::Stream;

use super::{Track, Tracks};
use crate::closure::{Closed, Closure, NoWay};
use crate::vehicle::manager::{EXIT, NONE, Vehicle, VehicleManager};
use crate::{Counters, Leg, Route, TrafficConfig, TripEnd};

/// Who has stood for so long without a way on gives up, s.
const GIVE_UP: f64 = 5.0;

/// All closures, and which lanes they close now.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Closures {
    /// By number.
    list: Vec<(u32, Closure)>,
    next: u32,
    /// Lane by lane while anything is closed, and empty while nothing is.
    closed: Vec<bool>,
    /// Legs from one of which none of the ways that lead over a closed street inside of joined junctions leads on to the other.
    parted: Vec<(Leg, Leg)>,
    /// Blocked stretches: lane, from and to, m.
    pub(in crate::vehicle) blocks: Vec<(Track, f64, f64)>,
    /// When it was last seen to what is closed, s; less than nothing if that has changed.
    seen: f64,
}

impl Closures {
    pub(crate) fn add(&mut self, closure: Closure) -> u32 {
        let number = self.next;
        self.next += 1;
        self.list.push((number, closure));
        self.seen = -1.0;
        number
    }

    pub(crate) fn remove(&mut self, number: u32) -> bool {
        let count = self.list.len();
        self.list.retain(|(own, _)| *own != number);
        self.seen = -1.0;
        self.list.len() < count
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &(u32, Closure)> {
        self.list.iter()
    }

    #[inline]
    pub(in crate::vehicle) fn has(&self, lane: Track) -> bool {
        self.closed.get(lane as usize).copied().unwrap_or(false)
    }

    #[inline]
    pub(in crate::vehicle) fn is_empty(&self) -> bool {
        self.closed.is_empty()
    }

    /// Whether a way leads to a closed lane, or over one inside of joined junctions.
    #[inline]
    pub(in crate::vehicle) fn bars(&self, tracks: &Tracks, way: usize) -> bool {
        !self.is_empty()
            && (self.has(tracks.lane_after(way)) || tracks.through[way].iter().any(|lane| self.has(lane.0)))
    }

    /// Whether every lane of a leg is closed.
    pub(in crate::vehicle) fn has_leg(&self, tracks: &Tracks, leg: Leg) -> bool {
        !self.is_empty() && leg.lanes(&tracks.network).iter().all(|lane| self.has(lane.0))
    }

    /// Whether something began or ended since it was last seen to.
    fn is_due(&self, now: f64) -> bool {
        let passed = |time: f64| self.seen < time && time <= now;
        self.seen < 0.0 || self.list.iter().any(|(_, closure)| passed(closure.from) || passed(closure.until))
    }

    /// Takes up what is closed now.
    fn see_to(&mut self, tracks: &Tracks, now: f64) {
        self.seen = now;
        self.list.retain(|(_, closure)| now < closure.until);
        self.closed.clear();
        self.blocks.clear();
        for (_, closure) in self.list.iter().filter(|(_, closure)| closure.is_active(now)) {
            let lanes = match closure.what {
                Closed::Stretch(lane, from, to) => {
                    self.blocks.push((lane.0, from, to));
                    continue;
                }
                Closed::Lane(lane) => vec![lane],
                Closed::Leg(leg) => {
                    let road = &tracks.drawn.roads[leg.road().index()];
                    let on_leg = |lane: &LaneId| Leg::of(&tracks.drawn, *lane) == leg;
                    road.lanes().filter(on_leg).collect()
                }
            };
            self.closed.resize(tracks.lanes, false);
            for lane in lanes {
                self.closed[lane.index()] = true;
            }
        }
        self.parted = self.part(tracks);
    }

    /// The legs that what is closed inside of joined junctions parts, ascending.
    fn part(&self, tracks: &Tracks) -> Vec<(Leg, Leg)> {
        let network = &tracks.network;
        let ends = |way: usize| {
            let way = &network.connections[way];
            (Leg::of(network, way.from), Leg::of(network, way.to))
        };
        let ways =
            (0..tracks.ways.len()).filter(|way| !tracks.through[*way].is_empty() && self.bars(tracks, *way));
        let mut parted: Vec<(Leg, Leg)> = ways.map(ends).collect();
        parted.sort_unstable();
        parted.dedup();
        parted.retain(|(from, to)| {
            let lanes = from.lanes(network).iter().map(|lane| &network.lanes[lane.index()]);
            let mut ways = lanes.flat_map(|lane| &lane.outgoing).map(|way| way.index());
            ways.all(|way| ends(way).1 != *to || self.bars(tracks, way))
        });
        parted
    }

    pub(crate) fn fits(&self, tracks: &Tracks) -> bool {
        let is_lane = |lane: Track| (lane as usize) < tracks.lanes;
        (self.closed.is_empty() || self.closed.len() == tracks.lanes)
            && self.blocks.iter().all(|(lane, ..)| is_lane(*lane))
            && self.list.iter().all(|(_, closure)| match closure.what {
                Closed::Leg(leg) => !leg.lanes(&tracks.drawn).is_empty(),
                Closed::Lane(lane) | Closed::Stretch(lane, ..) => is_lane(lane.0),
            })
    }
}

impl Closures {
    /// The quickest route around what is closed.
    pub(in crate::vehicle) fn quickest(&self, tracks: &Tracks, from: Leg, to: Leg) -> Option<Route> {
        self.quickest_but(tracks, from, to, None)
    }

    /// The same, but not from one leg to another that are to be avoided.
    pub(in crate::vehicle) fn quickest_but(
        &self,
        tracks: &Tracks,
        from: Leg,
        to: Leg,
        avoid: Option<(Leg, Leg)>,
    ) -> Option<Route> {
        tracks.router.quickest_between(from, to, |before, leg| {
            self.leads_on(tracks, before, leg) && avoid != Some((before, leg))
        })
    }

    /// Whether one can go on from a leg to one that follows it.
    pub(in crate::vehicle) fn leads_on(&self, tracks: &Tracks, before: Leg, leg: Leg) -> bool {
        !self.has_leg(tracks, leg) && self.parted.binary_search(&(before, leg)).is_err()
    }
}

impl VehicleManager {
    /// Sees to what is closed; when that changes, everybody thinks his way over.
    pub(crate) fn mind_closures(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        now: f64,
        counters: &mut Counters,
    ) {
        if self.closures.is_due(now) {
            self.closures.see_to(tracks, now);
            for track in 0..tracks.count() as Track {
                for rank in 0..self.queue(tracks, track).len() {
                    counters.rerouted += u64::from(self.replan(tracks, track, rank));
                    self.redirect((tracks, config), streams, track, rank);
                }
            }
        }
        if config.no_way == NoWay::Leave && !self.closures.is_empty() {
            self.give_up(tracks, config, now, counters);
        }
    }

    /// Chooses the way on anew for who has no leave to cross yet.
    pub(in crate::vehicle) fn redirect(
        &mut self,
        mind: (&Tracks, &TrafficConfig),
        streams: Stream,
        track: Track,
        rank: usize,
    ) {
        let (tracks, _) = mind;
        let (vehicle, mut path) = (self.queue(tracks, track)[rank], self.paths(tracks, track)[rank]);
        let way = vehicle.next;
        let has_route = self.routes.get(path.route as usize).is_some();
        let is_shut = way < EXIT && self.closures.bars(tracks, way as usize);
        if is_committed(tracks, track, &vehicle) || way == EXIT || !(has_route || way == NONE || is_shut) {
            return;
        }
        let next = self.choose(mind, streams, &mut Vec::new(), &vehicle, &mut path, track);
        let (queue, paths) = self.both_mut(tracks, track);
        queue[rank].next = next;
        paths[rank] = path;
    }

    /// Takes a route around what is closed, if that is on the rest of a route and there is a way around.
    fn replan(&mut self, tracks: &Tracks, track: Track, rank: usize) -> bool {
        let (vehicle, path) = (self.queue(tracks, track)[rank], self.paths(tracks, track)[rank]);
        let Some(route) = self.routes.get(path.route as usize) else { return false };
        // Who crosses, or is about to, does so.
        let ahead = usize::from(is_committed(tracks, track, &vehicle));
        let legs = route.0.get(path.leg as usize..).unwrap_or_default();
        let rest = legs.get(ahead + 1..).unwrap_or_default();
        let is_shut = rest.iter().any(|leg| self.closures.has_leg(tracks, *leg));
        let (true, Some(here), Some(goal)) = (is_shut, legs.get(ahead), rest.last()) else { return false };
        let Some(mut around) = self.closures.quickest(tracks, *here, *goal) else { return false };
        around.0.splice(0..0, legs[..ahead].iter().copied());
        let route = self.add_route_for(path.route, around);
        let (_, paths) = self.both_mut(tracks, track);
        (paths[rank].route, paths[rank].leg) = (route, 0);
        true
    }

    /// Those leave who stand first in their lane without any way on.
    fn give_up(&mut self, tracks: &Tracks, config: &TrafficConfig, now: f64, counters: &mut Counters) {
        let firsts = self.queues(tracks).filter_map(|(lane, queue)| Some((lane, queue.first()?)));
        let stands =
            |first: &Vehicle| first.next == NONE && first.holding == NONE && first.halt.is_infinite();
        let stranded: Vec<u32> = firsts
            .filter(|(lane, first)| stands(first) && first.stood > GIVE_UP && !self.has_way(tracks, *lane))
            .map(|(_, first)| first.id)
            .collect();
        for id in stranded {
            counters.removed += u64::from(self.remove(tracks, config, id, TripEnd::NoWay, now));
        }
    }

    /// Whether any way leads the first of a lane to the end of its route; without a route, none does.
    fn has_way(&self, tracks: &Tracks, lane: Track) -> bool {
        let here = Leg::of(&tracks.network, LaneId(lane));
        let reaches = |goal: Leg| self.closures.quickest(tracks, here, goal).is_some();
        self.goal(tracks, lane, 0).is_some_and(reaches)
    }
}

/// Whether a vehicle crosses a junction, or has leave to.
pub(in crate::vehicle) fn is_committed(tracks: &Tracks, track: Track, vehicle: &Vehicle) -> bool {
    tracks.connection(track).is_some() || (vehicle.holding != NONE && vehicle.holding == vehicle.next)
}
