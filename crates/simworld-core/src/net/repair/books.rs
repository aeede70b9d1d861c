//! All arrays of a network under change, and the taking apart of what is to be derived anew.

use std::collections::BTreeSet;

use super::NetworkPatch;
use crate::id::{ConnectionId, CrossingId, IntersectionId, LaneId, RoadId, SidewalkId};
use crate::net::{
    Connection, Crossing, Intersection, Lane, Road, RoadNetwork, Sidewalk, SignalGroup, SignalPlan,
};
use crate::patch::Book;

/// A network under change.
#[derive(Debug)]
pub(super) struct Books<'a> {
    pub(super) roads: Book<'a, Road>,
    pub(super) lanes: Book<'a, Lane>,
    pub(super) connections: Book<'a, Connection>,
    pub(super) intersections: Book<'a, Intersection>,
    pub(super) sidewalks: Book<'a, Sidewalk>,
    pub(super) crossings: Book<'a, Crossing>,
    pub(super) signals: Book<'a, SignalPlan>,
    pub(super) names: Book<'a, String>,
    /// Signal groups that are nobody's.
    pub(super) groups: BTreeSet<SignalGroup>,
}

impl<'a> Books<'a> {
    pub(super) fn open(network: &'a mut RoadNetwork) -> Self {
        Self {
            roads: Book::open(&mut network.roads),
            lanes: Book::open(&mut network.lanes),
            connections: Book::open(&mut network.connections),
            intersections: Book::open(&mut network.intersections),
            sidewalks: Book::open(&mut network.sidewalks),
            crossings: Book::open(&mut network.crossings),
            signals: Book::open(&mut network.signals),
            names: Book::open(&mut network.names),
            groups: BTreeSet::new(),
        }
    }

    pub(super) fn close(self) -> NetworkPatch {
        NetworkPatch {
            roads: self.roads.close(),
            lanes: self.lanes.close(),
            connections: self.connections.close(),
            intersections: self.intersections.close(),
            sidewalks: self.sidewalks.close(),
            crossings: self.crossings.close(),
            signals: self.signals.close(),
            names: self.names.close(),
        }
    }

    /// Takes the crossings, the connections and the signals of an intersection away.
    pub(super) fn clear_intersection(&mut self, index: usize) {
        let place = self.intersections.edit(index);
        let (connections, crossings, signals) = (
            std::mem::take(&mut place.connections),
            std::mem::take(&mut place.crossings),
            place.signals.take(),
        );
        for connection in connections {
            let from = self.connections.get(connection.index()).from;
            self.lanes.edit(from.index()).outgoing.clear();
            self.connections.vacate(connection.index());
        }
        for crossing in crossings {
            self.crossings.vacate(crossing.index());
        }
        if let Some(plan) = signals {
            self.groups.extend(&self.signals.get(plan as usize).groups);
            self.signals.vacate(plan as usize);
        }
    }

    /// Takes the lanes and the sidewalks of a road away; the intersections at its ends are clear.
    pub(super) fn clear_road(&mut self, index: usize) {
        let road = self.roads.edit(index);
        let lists = [&mut road.forward, &mut road.backward, &mut road.cycle].map(std::mem::take);
        for lane in lists.into_iter().flatten() {
            self.lanes.vacate(lane.index());
        }
        for sidewalk in std::mem::take(&mut road.sidewalks).into_iter().flatten() {
            self.sidewalks.vacate(sidewalk.index());
        }
    }

    /// Parts a road from the intersections at its ends.
    pub(super) fn detach_road(&mut self, index: usize) {
        let ends = [self.roads.get(index).from, self.roads.get(index).to];
        for end in ends {
            self.intersections.edit(end.index()).roads.retain(|road| road.index() != index);
        }
    }

    /// Takes out a road that is clear and detached; the last one gets its number.
    pub(super) fn remove_road(&mut self, index: usize) {
        let last = self.roads.len() - 1;
        if index != last {
            let (old, new) = (RoadId::from_index(last), RoadId::from_index(index));
            let road = self.roads.get(last).clone();
            let (from, to) = (road.from, road.to);
            for end in [from, to] {
                let place = self.intersections.edit(end.index());
                rename(&mut place.roads, old, new);
                for crossing in place.crossings.clone() {
                    if self.crossings.get(crossing.index()).road == old {
                        self.crossings.edit(crossing.index()).road = new;
                    }
                }
            }
            for lane in road.lanes() {
                self.lanes.edit(lane.index()).road = new;
            }
            for sidewalk in road.sidewalks.into_iter().flatten() {
                self.sidewalks.edit(sidewalk.index()).road = new;
            }
        }
        self.roads.swap_remove(index);
    }

    /// Takes out an intersection that is clear and without roads; the last one gets its number.
    pub(super) fn remove_intersection(&mut self, index: usize) {
        let last = self.intersections.len() - 1;
        if index != last {
            let (old, new) = (IntersectionId::from_index(last), IntersectionId::from_index(index));
            let Intersection { roads, connections, crossings, signals, .. } =
                self.intersections.get(last).clone();
            for road in roads {
                let road = self.roads.edit(road.index());
                rename([&mut road.from, &mut road.to], old, new);
                let lanes: Vec<LaneId> = road.lanes().collect();
                for lane in lanes {
                    let lane = self.lanes.edit(lane.index());
                    rename([&mut lane.from, &mut lane.to], old, new);
                }
            }
            for connection in connections {
                self.connections.edit(connection.index()).intersection = new;
            }
            for crossing in crossings {
                self.crossings.edit(crossing.index()).intersection = new;
            }
            if let Some(plan) = signals {
                self.signals.edit(plan as usize).intersection = new;
            }
        }
        self.intersections.swap_remove(index);
    }

    /// Closes the gaps that are left: the last entries take the numbers that nobody has.
    pub(super) fn close_gaps(&mut self) {
        while let Some((old, new)) = self.connections.close_gap() {
            self.renumber_connection(ConnectionId::from_index(old), ConnectionId::from_index(new));
        }
        while let Some((old, new)) = self.lanes.close_gap() {
            self.renumber_lane(LaneId::from_index(old), LaneId::from_index(new));
        }
        while let Some((old, new)) = self.crossings.close_gap() {
            self.renumber_crossing(CrossingId::from_index(old), CrossingId::from_index(new));
        }
        while let Some((old, new)) = self.sidewalks.close_gap() {
            let road = self.sidewalks.get(new).road;
            let sides = &mut self.roads.edit(road.index()).sidewalks;
            rename(sides.iter_mut().flatten(), SidewalkId::from_index(old), SidewalkId::from_index(new));
        }
        while let Some((_, new)) = self.signals.close_gap() {
            let place = self.signals.get(new).intersection;
            self.intersections.edit(place.index()).signals = Some(new as u32);
        }
    }

    fn renumber_connection(&mut self, old: ConnectionId, new: ConnectionId) {
        let Connection { from, intersection, conflicts, .. } = self.connections.get(new.index()).clone();
        rename(&mut self.lanes.edit(from.index()).outgoing, old, new);
        rename(&mut self.intersections.edit(intersection.index()).connections, old, new);
        for rival in conflicts {
            let rival = self.connections.edit(rival.index());
            for list in [&mut rival.conflicts, &mut rival.yields_to] {
                rename(list.iter_mut(), old, new);
                list.sort_unstable();
            }
        }
    }

    fn renumber_lane(&mut self, old: LaneId, new: LaneId) {
        let Lane { road, from, outgoing, .. } = self.lanes.get(new.index()).clone();
        let road = self.roads.edit(road.index());
        rename(road.forward.iter_mut().chain(&mut road.backward).chain(&mut road.cycle), old, new);
        for connection in outgoing {
            self.connections.edit(connection.index()).from = new;
        }
        for connection in self.intersections.get(from.index()).connections.clone() {
            if self.connections.get(connection.index()).to == old {
                self.connections.edit(connection.index()).to = new;
            }
        }
    }

    fn renumber_crossing(&mut self, old: CrossingId, new: CrossingId) {
        let place = self.crossings.get(new.index()).intersection;
        rename(&mut self.intersections.edit(place.index()).crossings, old, new);
        for connection in self.intersections.get(place.index()).connections.clone() {
            if self.connections.get(connection.index()).crossings.contains(&old) {
                let crossings = &mut self.connections.edit(connection.index()).crossings;
                rename(crossings.iter_mut(), old, new);
                crossings.sort_unstable();
            }
        }
    }
}

/// Gives a thing that changed its number its new one, wherever it is named.
fn rename<'a, T: Copy + PartialEq + 'a>(names: impl IntoIterator<Item = &'a mut T>, old: T, new: T) {
    for name in names {
        if *name == old {
            *name = new;
        }
    }
}
