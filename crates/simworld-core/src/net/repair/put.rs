//! What was derived anew goes to the place of what was taken apart.

use super::work::{Repair, Surroundings};
use crate::id::{ConnectionId, CrossingId, IntersectionId, LaneId, RoadId, SidewalkId};
use crate::net::{Crossing, Few, Lane, Sidewalk, SignalGroup, derive};

/// The numbers that derived things have in the network.
struct Numbers<'a> {
    derived: &'a Surroundings,
    lanes: Vec<LaneId>,
    /// Of the junction at hand.
    groups: Vec<(SignalGroup, SignalGroup)>,
    /// The first signal group that nobody ever had.
    next_group: u32,
}

impl Numbers<'_> {
    fn road(&self, derived: RoadId) -> RoadId {
        RoadId::from_index(self.derived.part.streets[derived.index()])
    }

    fn intersection(&self, derived: IntersectionId) -> IntersectionId {
        IntersectionId::from_index(self.derived.part.nodes[derived.index()])
    }

    fn lane(&self, derived: LaneId) -> LaneId {
        self.lanes[derived.index()]
    }

    fn group(&self, derived: SignalGroup) -> SignalGroup {
        self.groups.iter().find(|(known, _)| *known == derived).map_or(derived, |(_, group)| *group)
    }
}

impl Repair<'_> {
    /// Puts what was derived in the place of what was taken apart. `groups` is the number of signal groups before.
    pub(super) fn put_in(&mut self, derived: &Surroundings, groups: usize) {
        let mut numbers = Numbers {
            derived,
            lanes: vec![LaneId::default(); derived.network.lanes.len()],
            groups: Vec::new(),
            next_group: groups as u32,
        };
        let touched = self.touched();
        let anew = self.streets_at(&self.stirred);
        for street in self.streets_at(&touched) {
            let Some(local) = derived.part.street(street) else { continue };
            if anew.contains(&street) {
                self.put_road(street, local, &mut numbers);
            } else {
                let (road, same) = (self.books.roads.get(street), &derived.network.roads[local]);
                for (ours, theirs) in road.lanes().zip(same.lanes()) {
                    numbers.lanes[theirs.index()] = ours;
                }
            }
        }
        for node in touched {
            match derived.part.node(node) {
                Some(local) => self.put_intersection(node, local, &mut numbers),
                None => *self.books.intersections.edit(node) = derive::alone(self.plan, node, self.config),
            }
        }
    }

    fn put_road(&mut self, street: usize, local: usize, numbers: &mut Numbers<'_>) {
        let network = &numbers.derived.network;
        let id = RoadId::from_index(street);
        let mut road = network.roads[local].clone();
        (road.from, road.to) = (numbers.intersection(road.from), numbers.intersection(road.to));
        road.name = self.plan.streets[street].name;
        for lane in road.forward.iter_mut().chain(&mut road.backward).chain(&mut road.cycle) {
            let found = network.lanes[lane.index()].clone();
            let (from, to) = (numbers.intersection(found.from), numbers.intersection(found.to));
            let number = self.books.lanes.fill(Lane { road: id, from, to, outgoing: Few::new(), ..found });
            numbers.lanes[lane.index()] = LaneId::from_index(number);
            *lane = LaneId::from_index(number);
        }
        for sidewalk in road.sidewalks.iter_mut().flatten() {
            let found = network.sidewalks[sidewalk.index()].clone();
            *sidewalk = SidewalkId::from_index(self.books.sidewalks.fill(Sidewalk { road: id, ..found }));
        }
        *self.books.roads.edit(street) = road;
    }

    fn put_intersection(&mut self, node: usize, local: usize, numbers: &mut Numbers<'_>) {
        let network = &numbers.derived.network;
        let id = IntersectionId::from_index(node);
        let derived = &network.intersections[local];
        let mut place = derived.clone();
        place.roads.iter_mut().for_each(|leg| *leg = numbers.road(*leg));
        place.signals = derived.signals.map(|plan| self.put_signals(id, plan as usize, numbers));
        for crossing in &mut place.crossings {
            let found = network.crossings[crossing.index()].clone();
            let (road, signal) = (numbers.road(found.road), found.signal.map(|group| numbers.group(group)));
            let crossed = Crossing { intersection: id, road, signal, ..found };
            *crossing = CrossingId::from_index(self.books.crossings.fill(crossed));
        }
        for connection in &mut place.connections {
            let mut found = network.connections[connection.index()].clone();
            (found.from, found.to) = (numbers.lane(found.from), numbers.lane(found.to));
            found.intersection = id;
            found.signal = found.signal.map(|group| numbers.group(group));
            for crossing in &mut found.crossings {
                if let Some(rank) = derived.crossings.iter().position(|other| other == crossing) {
                    *crossing = place.crossings[rank];
                }
            }
            found.crossings.sort_unstable();
            let from = found.from;
            *connection = ConnectionId::from_index(self.books.connections.fill(found));
            self.books.lanes.edit(from.index()).outgoing.push(*connection);
        }
        self.rename_rivals(&derived.connections, &place.connections);
        *self.books.intersections.edit(node) = place;
    }

    /// Puts the signal plan of a junction in; its groups are those that are nobody's, or new ones. Gives its index.
    fn put_signals(&mut self, id: IntersectionId, derived: usize, numbers: &mut Numbers<'_>) -> u32 {
        let mut plan = numbers.derived.network.signals[derived].clone();
        numbers.groups.clear();
        for group in &mut plan.groups {
            let free = self.books.groups.pop_first().unwrap_or_else(|| {
                numbers.next_group += 1;
                SignalGroup(numbers.next_group - 1)
            });
            numbers.groups.push((*group, free));
            *group = free;
        }
        // Both numberings ascend, so the lists stay in order.
        let lists = plan.phases.iter_mut().flat_map(|phase| [&mut phase.green, &mut phase.yellow]);
        lists.flatten().for_each(|group| *group = numbers.group(*group));
        plan.intersection = id;
        self.books.signals.fill(plan) as u32
    }

    /// Gives the connections of an intersection the new numbers of those that they meet.
    fn rename_rivals(&mut self, old: &[ConnectionId], new: &[ConnectionId]) {
        // The connections of a derived intersection are numbered one after another.
        let Some(first) = old.first().map(|first| first.index()) else { return };
        for connection in new {
            let connection = self.books.connections.edit(connection.index());
            for list in [&mut connection.conflicts, &mut connection.yields_to] {
                for rival in list.iter_mut() {
                    *rival = new[rival.index() - first];
                }
                list.sort_unstable();
            }
        }
    }
}
