//! Near junctions as one: where the lanes between two nodes are too short to stand on, the nodes are one intersection.
//!
//! A map draws a crossing of dual carriageways as four nodes, and a bend before a junction as one more, with lanes of a few metres
//! between them. Nobody can wait there without standing in both junctions. What is joined has ways from every lane that leads in
//! to every lane that leads out to which the ways over the lanes inside lead, with conflicts and a right of way of their own, and
//! one signal plan. The streets as they are drawn stay what they are, with their sidewalks, crossings and paved areas.

mod find;
mod signals;
mod ways;

use self::find::Compound;
use self::ways::Composed;
use super::{Connection, Control, Few, RoadNetwork, derive};
use crate::id::{ConnectionId, IntersectionId, LaneId};

/// A network in which near junctions are one.
///
/// Every number is that of the network it was made from, but for those of connections and of signal plans: of lanes, roads,
/// intersections, crossings and signal groups. Roads inside have no lanes any more, and their lanes lead nowhere; intersections that
/// are joined to another have no connections and no signals, but their crossings. Roads and lanes that led to one of them lead to
/// the other, but for those inside.
#[derive(Clone, Debug, PartialEq)]
pub struct Joined {
    /// The network.
    pub network: RoadNetwork,
    /// By connection: the lanes inside over which it leads, in their order; none where nothing was joined.
    pub through: Vec<Vec<LaneId>>,
}

impl RoadNetwork {
    /// Joins the junctions between which all lanes are shorter than that, m. `None` if there are none.
    ///
    /// Roundabouts stay as they are, and junctions through which not every lane would lead on.
    ///
    /// ```
    /// use simworld_core::geometry::Point2;
    /// use simworld_core::net::{NetworkConfig, RoadNetwork, Street, StreetPlan};
    /// let mut plan = StreetPlan::crossroads(100.0);
    /// let config = NetworkConfig::default();
    /// assert_eq!(RoadNetwork::derive(&plan, &config)?.join_near(9.0), None);
    /// // A second street meets the eastern arm 18 m from the first.
    /// plan.nodes.extend([Point2::new(18.0, 0.0), Point2::new(18.0, 100.0)]);
    /// plan.streets[0].to = 5;
    /// plan.streets.extend([Street::simple(5, 1), Street::simple(5, 6)]);
    /// let network = RoadNetwork::derive(&plan, &config)?;
    /// let joined = network.join_near(9.0).expect("they are near").network;
    /// assert_eq!((network.signals.len(), joined.signals.len()), (2, 1));
    /// # Ok::<(), simworld_core::net::NetworkError>(())
    /// ```
    pub fn join_near(&self, shorter: f64) -> Option<Joined> {
        let compounds = find::compounds(self, shorter);
        let composed = |compound: Compound| {
            let ways = ways::composed(self, &compound)?;
            Some((compound, ways))
        };
        let joined: Vec<(Compound, Vec<Composed>)> = compounds.into_iter().filter_map(composed).collect();
        if joined.is_empty() {
            return None;
        }
        let mut network = self.clone();
        drop_ways(&mut network, &joined);
        let mut through = vec![Vec::new(); network.connections.len()];
        for (compound, ways) in joined {
            signals::join(&mut network, self, &compound, &ways);
            join(&mut network, &compound);
            for way in ways {
                let id = ConnectionId::from_index(network.connections.len());
                network.lanes[way.from.index()].outgoing.push(id);
                network.intersections[compound.main.index()].connections.push(id);
                network.connections.push(connection(compound.main, &way));
                through.push(way.through);
            }
            derive::settle(&mut network, compound.main, true);
            set_crossings(&mut network, &compound);
        }
        signals::close_gaps(&mut network);
        Some(Joined { network, through })
    }
}

/// Takes the ways across what is joined out of the network; the others move up.
fn drop_ways(network: &mut RoadNetwork, joined: &[(Compound, Vec<Composed>)]) {
    let mut is_joined = vec![false; network.intersections.len()];
    for node in joined.iter().flat_map(|(compound, _)| &compound.nodes) {
        is_joined[node.index()] = true;
        network.intersections[node.index()].connections.clear();
    }
    let stays = |way: &Connection| !is_joined[way.intersection.index()];
    let mut next = 0;
    let number = |way: &Connection| {
        let number = ConnectionId(next);
        next += u32::from(stays(way));
        stays(way).then_some(number)
    };
    let numbers: Vec<Option<ConnectionId>> = network.connections.iter().map(number).collect();
    let rename = |list: &mut Few<ConnectionId>| {
        *list = list.iter().filter_map(|way| numbers[way.index()]).collect();
    };
    network.connections.retain(stays);
    for way in &mut network.connections {
        rename(&mut way.conflicts);
        rename(&mut way.yields_to);
    }
    network.lanes.iter_mut().for_each(|lane| rename(&mut lane.outgoing));
    for place in &mut network.intersections {
        place.connections = place.connections.iter().filter_map(|way| numbers[way.index()]).collect();
    }
}

/// Lets everything that led to one of the nodes lead to the first of them, and empties the roads inside.
fn join(network: &mut RoadNetwork, compound: &Compound) {
    let main = compound.main;
    let control = control(network, compound);
    for node in &compound.nodes {
        let height = network.intersections[node.index()].height;
        let mut roads = network.intersections[node.index()].roads.clone();
        roads.retain(|road| !compound.is_inside(*road));
        for road in roads {
            let road = &mut network.roads[road.index()];
            // Where it was drawn to, it stays as high.
            if road.from == *node && *node != main {
                road.profile.insert(0, (0.0, height));
                road.from = main;
            }
            if road.to == *node && *node != main {
                road.profile.push((super::polyline::length(&road.centerline), height));
                road.to = main;
            }
        }
        network.intersections[node.index()].control = if *node == main { control } else { Control::None };
    }
    let is_joined = |node: IntersectionId| compound.nodes.binary_search(&node).is_ok();
    for lane in network.lanes.iter_mut().filter(|lane| !compound.is_inside(lane.road)) {
        for end in [&mut lane.from, &mut lane.to] {
            if is_joined(*end) {
                *end = main;
            }
        }
    }
    for road in &compound.roads {
        let road = &mut network.roads[road.index()];
        for list in [&mut road.forward, &mut road.backward, &mut road.cycle] {
            list.clear();
        }
    }
}

/// Signals where one of the nodes has them; stop signs where all junctions among them have some.
fn control(network: &RoadNetwork, compound: &Compound) -> Control {
    let controls = || compound.nodes.iter().map(|node| network.intersections[node.index()].control);
    let has = |control| controls().any(|own| own == control);
    match () {
        () if has(Control::Signals) => Control::Signals,
        () if has(Control::Priority) => Control::Priority,
        () if has(Control::Stop) => Control::Stop,
        () => Control::None,
    }
}

fn connection(main: IntersectionId, way: &Composed) -> Connection {
    Connection {
        from: way.from,
        to: way.to,
        intersection: main,
        turn: way.turn,
        path: way.path.clone(),
        length: super::polyline::length(&way.path),
        signal: way.signal,
        conflicts: Few::new(),
        yields_to: Few::new(),
        crossings: Few::new(),
    }
}

/// Sets over which crossings of all nodes the ways lead.
fn set_crossings(network: &mut RoadNetwork, compound: &Compound) {
    let mut all = compound.crossings(network);
    all.sort_unstable();
    for way in network.intersections[compound.main.index()].connections.clone() {
        let path = &network.connections[way.index()].path;
        let over = all.iter().copied().filter(|id| ways::leads_over(path, &network.crossings[id.index()]));
        let over = over.collect();
        network.connections[way.index()].crossings = over;
    }
}
