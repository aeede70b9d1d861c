//! Those who have left a lane but for their rear and stand on a way: whom they keep from going on, and for which lane that one waits.
//!
//! A vehicle on a way waits for the lane behind it. Who stands behind its rear waits for that lane as well, by whichever way he
//! wants to go himself, and so does a lane that has nobody else on it.

use super::deadlock::{LOCKED, SHORT, has_leave};
use crate::vehicle::manager::{STANDING, Vehicle, VehicleManager};
use crate::vehicle::queues::tail::Tail;
use crate::vehicle::tracks::{Track, Tracks};

/// So many ways are followed on which one stands for another.
pub(in crate::vehicle) const FAR: usize = 3;

impl VehicleManager {
    /// The end of a lane: its last vehicle, or the rear of one who has left it.
    pub(super) fn end_of(&self, tracks: &Tracks, lane: Track) -> Tail {
        let mut tail = self.queue(tracks, lane).last().map_or_else(Tail::default, Tail::of);
        for way in &tracks.network.lanes[lane as usize].outgoing {
            let last = self.queue(tracks, (tracks.lanes + way.index()) as Track).last();
            if let Some(leaver) = last.and_then(|last| Tail::of_leaver(tracks, way.index(), last)) {
                tail.see_leaver(&leaver);
            }
        }
        tail
    }

    /// The lane to which somebody is on his way behind whose rear the first of a lane has long stood, who has no leave himself.
    pub(super) fn behind_a_leaver(&self, tracks: &Tracks, lane: Track, first: &Vehicle) -> Option<Track> {
        if first.stood <= LOCKED || first.halt.is_finite() || has_leave(first) {
            return None;
        }
        let front = first.s - tracks.length[lane as usize];
        let is_behind = |way: u32| {
            self.queue(tracks, tracks.lanes as Track + way).last().is_some_and(|last| {
                let rear = last.s - last.length();
                last.v < STANDING && rear < 0.0 && rear - front < SHORT
            })
        };
        let mut ways = tracks.network.lanes[lane as usize].outgoing.iter();
        ways.find(|way| is_behind(way.0)).map(|way| self.held_up_by(tracks, way.0, f64::INFINITY, FAR))
    }

    /// The lane for which those stand who have leave for a way: the one behind it, or that behind another way on which somebody stands in
    /// their way. `front` is where the first of them is along the way if nobody is on it, negative before it.
    pub(super) fn held_up_by(&self, tracks: &Tracks, way: u32, front: f64, far: usize) -> Track {
        let after = tracks.lane_after(way as usize);
        let track = tracks.lanes as Track + way;
        let front = self.queue(tracks, track).first().map_or(front, |first| first.s);
        if self.end_of(tracks, after).rear + tracks.length[track as usize] - front < SHORT {
            return after;
        }
        let siblings = tracks.siblings[way as usize].iter().map(|(other, clear)| (*other, *clear));
        let meeting = tracks.conflicts[way as usize].iter().map(|conflict| (conflict.way, f64::INFINITY));
        let stands = siblings.chain(meeting).find_map(|(other, clear)| self.stands_on(tracks, other, clear));
        match stands {
            Some((other, true)) if far > 0 => self.held_up_by(tracks, other, f64::INFINITY, far - 1),
            Some((other, _)) => tracks.lane_after(other as usize),
            None => after,
        }
    }

    /// A way if somebody stands on it with his rear before a station, and whether his front is on it as well.
    fn stands_on(&self, tracks: &Tracks, way: u32, clear: f64) -> Option<(u32, bool)> {
        let track = tracks.lanes as Track + way;
        let end = tracks.length[track as usize];
        let stands = |other: &Vehicle, s: f64| other.v < STANDING && s - other.length() < clear;
        if self.queue(tracks, track).iter().any(|other| stands(other, other.s)) {
            return Some((way, true));
        }
        let last = self.queue(tracks, tracks.lane_after(way as usize)).last()?;
        (last.holding == way && !has_leave(last) && stands(last, last.s + end)).then_some((way, false))
    }

    /// The lanes of a part on which nobody is but the rears of those who have long stood on a way from there, with the lanes behind these
    /// ways.
    pub(in crate::vehicle) fn left_behind<'a>(
        &'a self,
        tracks: &'a Tracks,
        part: usize,
    ) -> impl Iterator<Item = (Track, Track)> + 'a {
        let (part, layout) = (&self.parts[part], &tracks.layout.parts[part]);
        let ways = part.slabs.occupied().skip_while(|local| *local < layout.lanes);
        ways.filter_map(move |local| {
            let number = layout.tracks[local] - tracks.lanes as Track;
            let way = &tracks.ways[number as usize];
            let last = part.slabs.queue(local).last()?;
            let is_left = last.s < last.length() && last.stood > LOCKED;
            (is_left && self.queue(tracks, way.from).is_empty())
                .then(|| (way.from, self.held_up_by(tracks, number, f64::INFINITY, FAR)))
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use simworld_core::geometry::Point2;
    use simworld_core::net::{Alone, Aspect, NetworkConfig, RoadNetwork, Street, StreetPlan};
    use simworld_core::seed::Seed;

    use super::super::junction::is_room;
    use super::*;
    use crate::vehicle::clock::Moment;
    use crate::vehicle::manager::{EXIT, NONE};
    use crate::vehicle::queues::path::Path;
    use crate::vehicle::scene::Sight;
    use crate::{Counters, TrafficConfig};

    /// Drivers and the streets of a plan, without anybody.
    fn empty(plan: &StreetPlan) -> (Tracks, TrafficConfig, VehicleManager) {
        let network = RoadNetwork::derive(plan, &NetworkConfig::default()).expect("it is a plan");
        let config = TrafficConfig::default();
        let tracks = Tracks::new(Arc::new(network), &config);
        let vehicles = VehicleManager::new(&tracks);
        (tracks, config, vehicles)
    }

    /// Two streets that meet in a bend, and the way from the first to the second.
    fn bend() -> (Tracks, TrafficConfig, VehicleManager, usize) {
        let nodes = [[-80.0, 0.0], [0.0, 0.0], [0.0, 80.0]].map(|[x, y]| Point2::new(x, y)).to_vec();
        let plan = StreetPlan {
            nodes,
            streets: vec![Street::simple(0, 1), Street::simple(1, 2)],
            ..StreetPlan::default()
        };
        let (tracks, config, vehicles) = empty(&plan);
        let ways = &tracks.network.connections;
        let road = |lane: simworld_core::id::LaneId| tracks.network.lanes[lane.index()].road.0;
        let way = ways.iter().position(|way| (road(way.from), road(way.to)) == (0, 1));
        let way = way.expect("the streets meet");
        (tracks, config, vehicles, way)
    }

    /// Puts a car behind all others of a track, at rest for some time.
    fn put(
        vehicles: &mut VehicleManager,
        tracks: &Tracks,
        config: &TrafficConfig,
        at: (Track, f64),
        stood: f64,
    ) {
        let id = vehicles.numbers() as u32;
        let car = Vehicle { stood, ..Vehicle::new(config.vehicle_type(0), 0, 1.0, id, at.1) };
        vehicles.whereabouts.push(at.0);
        if (at.0 as usize) < tracks.lanes {
            vehicles.storage.add(at.0, &car, config);
        }
        vehicles.push(tracks, at.0, car, Path::new(at.0, NONE, 0.0, 0.0));
    }

    #[test]
    fn who_stands_behind_a_rear_waits_for_the_lane_to_which_that_one_goes() {
        let (tracks, config, mut vehicles, way) = bend();
        let (from, to) = (tracks.ways[way].from, tracks.ways[way].to);
        let end = tracks.length[from as usize];
        put(&mut vehicles, &tracks, &config, ((tracks.lanes + way) as Track, 1.0), 60.0);
        let rear = 1.0 - vehicles.queue(&tracks, (tracks.lanes + way) as Track)[0].length();
        let left = |vehicles: &VehicleManager| -> Vec<(Track, Track)> {
            (0..vehicles.parts.len()).flat_map(|part| vehicles.left_behind(&tracks, part)).collect()
        };
        assert_eq!(left(&vehicles), [(from, to)]);
        put(&mut vehicles, &tracks, &config, (from, end + rear - 2.0), 60.0);
        assert_eq!(left(&vehicles), [], "somebody is on the lane");
        // Even if his way ends on this lane.
        let first = Vehicle { next: EXIT, ..vehicles.queue(&tracks, from)[0] };
        let waits = |first: &Vehicle| vehicles.behind_a_leaver(&tracks, from, first);
        assert_eq!(waits(&first), Some(to));
        assert_eq!(waits(&Vehicle { stood: 3.0, ..first }), None, "it has only just come");
        assert_eq!(waits(&Vehicle { s: end - 20.0, ..first }), None, "it stands far behind");
        assert!((vehicles.end_of(&tracks, from).rear - (first.s - first.length())).abs() < 1e-9);
    }

    #[test]
    fn who_stands_beside_a_rear_on_another_way_waits_for_the_lane_of_that_one() {
        let (tracks, config, mut vehicles) = empty(&StreetPlan::crossroads(100.0));
        let way = (0..tracks.ways.len()).find(|way| tracks.siblings[*way].len() > 1).expect("it has arms");
        let (sibling, _) = tracks.siblings[way][0];
        let (own, other) = (tracks.lane_after(way), tracks.lane_after(sibling as usize));
        let track = (tracks.lanes + way) as Track;
        put(&mut vehicles, &tracks, &config, (track, 1.0), 60.0);
        let far = f64::INFINITY;
        assert_eq!(vehicles.held_up_by(&tracks, way as u32, far, FAR), own, "nobody else is there");
        // One who has come to the lane behind the other way, but for his rear at the very beginning of that.
        let end = tracks.length[tracks.lanes + sibling as usize];
        put(&mut vehicles, &tracks, &config, (other, 0.1), 60.0);
        let last = &mut vehicles.both_mut(&tracks, other).0[0];
        (last.holding, last.length) = (sibling, (end + 0.1) as f32);
        assert_eq!(vehicles.held_up_by(&tracks, way as u32, far, FAR), other);
    }

    #[test]
    fn who_has_to_stand_on_a_bend_leaves_less_room_on_the_lane_before_it() {
        let (tracks, config, mut vehicles, _) = bend();
        let way =
            (0..tracks.ways.len()).find(|way| tracks.is_alone(*way)).expect("at the ends one turns round");
        let from = tracks.ways[way].from;
        let car = config.vehicle_type(0);
        let places = ((tracks.length[from as usize] - 2.0) / (car.length + car.driver.gap)) as usize;
        put(&mut vehicles, &tracks, &config, ((tracks.lanes + way) as Track, 0.1), 60.0);
        // All but one of those whom it holds stand at its end; the last moves.
        for place in 0..places - 1 {
            let s = tracks.length[from as usize] - 6.5 - place as f64 * (car.length + car.driver.gap);
            put(&mut vehicles, &tracks, &config, (from, s), 0.0);
        }
        let asks = Vehicle::new(car, 0, 1.0, 99, 0.0);
        let moving = Tail { rear: 4.0, v: 3.0, ..vehicles.end_of(&tracks, from) };
        assert!(moving.over() > car.length - 0.2);
        let room = |tail: &Tail| {
            is_room(&tracks, &config, (&vehicles.junctions, &vehicles.storage), (from, tail), &asks)
        };
        assert!(room(&Tail { over: 0.0, ..moving }), "it holds one more");
        assert!(!room(&moving), "his rear would stay in the junction");
    }

    #[test]
    fn behind_who_may_go_without_room_everybody_closes_up() {
        let gap = |has_pass: bool| {
            let (tracks, config, mut vehicles) = empty(&StreetPlan::crossroads(100.0));
            let ways = &tracks.network.connections;
            let way = ways.iter().position(|way| way.signal.is_some()).expect("it has lights");
            let lane = tracks.ways[way].from;
            let end = tracks.length[lane as usize];
            for (place, s) in [end - 0.5, end - 7.0, end - 13.5].into_iter().enumerate() {
                put(&mut vehicles, &tracks, &config, (lane, s), 60.0);
                vehicles.both_mut(&tracks, lane).0[place].next = way as u32;
            }
            vehicles.passes.extend(has_pass.then_some(0));
            let groups = tracks.network.signal_groups();
            let zeros = vec![0; tracks.network.crossings.len()];
            let (aspects, shown) = (vec![Aspect::Red; groups], vec![0.0; groups]);
            let sight =
                Sight { aspects: &aspects, shown: &shown, walkers: &zeros, waiting: &zeros, obstacles: &[] };
            let mut counters = Counters::default();
            for step in 0..300 {
                let at = Moment { now: step as f64 * 0.1, dt: 0.1, step };
                vehicles.step(&tracks, &config, Seed(1).stream("cars"), sight, at, &mut counters, &Alone);
            }
            let queue = vehicles.queue(&tracks, lane);
            assert_eq!(queue.len(), 3, "the light is red");
            assert_eq!(counters.forced_stops, 0);
            [0, 1].map(|ahead| queue[ahead].s - queue[ahead].length() - queue[ahead + 1].s)
        };
        assert!(gap(false).iter().all(|gap| (1.9..2.3).contains(gap)), "{:?}", gap(false));
        assert!(gap(true).iter().all(|gap| (0.6..1.2).contains(gap)), "{:?}", gap(true));
    }
}
