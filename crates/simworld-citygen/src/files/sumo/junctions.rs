//! Junctions: internal lanes, crossings, walking areas, right of way, and how all of them connect.

use std::io::{self, Write};

use simworld_core::geometry::Point2;
use simworld_core::id::{ConnectionId, CrossingId, IntersectionId};
use simworld_core::net::{Control, Intersection, RoadNetwork, Turn, polyline};
use simworld_core::ops;

use super::edges::{
    Direction, Edges, WALK, as_line, edge_name, edge_of, exists, leaving, opposite, sidewalk,
};
use crate::files::xml::{Shape, Two};

/// Lateral acceleration that netconvert allows in a turn, m/s² (its option `junctions.limit-turn-speed`).
const LATERAL: f64 = 5.5;

/// One junction: its vehicle links first, in the order of the incoming edges, then its crossings.
pub(super) struct Junction {
    pub(super) id: IntersectionId,
    pub(super) links: Vec<ConnectionId>,
    pub(super) crossings: Vec<CrossingId>,
    /// Corners that have a walkway, and so a walking area.
    corners: Vec<usize>,
}

/// All junctions.
pub(super) fn of(network: &RoadNetwork, edges: &Edges) -> Vec<Junction> {
    (0..network.intersections.len()).map(|index| junction(network, edges, index)).collect()
}

fn junction(network: &RoadNetwork, edges: &Edges, index: usize) -> Junction {
    let place = &network.intersections[index];
    let mut links = place.connections.clone();
    // Clockwise by incoming edge, then from the right by lane, then by where it leads: as netconvert orders them.
    let order = |id: &ConnectionId| {
        let connection = &network.connections[id.index()];
        let road = network.lanes[connection.from.index()].road;
        let leg = place.roads.iter().rev().position(|other| *other == road).unwrap_or(0);
        let turn = match connection.turn {
            Turn::Right => 0,
            Turn::Straight => 1,
            Turn::Left => 2,
            Turn::UTurn => 3,
        };
        (leg, edges.rank(connection.from), turn, *id)
    };
    links.sort_by_key(order);
    let walks = |corner: &usize| place.corners.get(*corner).is_some_and(|path| path.len() > 1);
    let corners: Vec<usize> = (0..place.roads.len()).filter(walks).collect();
    let has = |leg: usize| corners.contains(&leg);
    let count = place.roads.len();
    let crossings = place.crossings.iter().copied().filter(|crossing| {
        let road = network.crossings[crossing.index()].road;
        // It leads from the corner on the left of its leg to the one on the right.
        place
            .roads
            .iter()
            .position(|other| *other == road)
            .is_some_and(|leg| has(leg) && has((leg + count - 1) % count))
    });
    Junction { id: IntersectionId::from_index(index), links, crossings: crossings.collect(), corners }
}

impl Junction {
    fn name(&self) -> String {
        format!("j{}", self.id.0)
    }

    fn internal(&self, link: usize) -> String {
        format!(":j{}_{link}", self.id.0)
    }

    fn crossing(&self, rank: usize) -> String {
        format!(":j{}_c{rank}", self.id.0)
    }

    fn area(&self, corner: usize) -> String {
        format!(":j{}_w{corner}", self.id.0)
    }

    /// The legs left and right of which a crossing ends: the corners that it joins.
    fn ends(&self, network: &RoadNetwork, crossing: CrossingId) -> (usize, usize) {
        let place = &network.intersections[self.id.index()];
        let road = network.crossings[crossing.index()].road;
        let leg = place.roads.iter().position(|other| *other == road).unwrap_or(0);
        (leg, (leg + place.roads.len() - 1) % place.roads.len())
    }

    pub(super) fn write_internal_edges(&self, network: &RoadNetwork, out: &mut impl Write) -> io::Result<()> {
        for (link, id) in self.links.iter().enumerate() {
            let connection = &network.connections[id.index()];
            let limit = network.lanes[connection.to.index()].speed_limit;
            let speed = limit.min(turning_speed(&connection.path, connection.length));
            let name = self.internal(link);
            writeln!(
                out,
                r#"<edge id="{name}" function="internal"><lane id="{name}_0" index="0" disallow="pedestrian" speed="{}" length="{}" shape="{}"/></edge>"#,
                Two(speed),
                Two(connection.length.max(0.1)),
                Shape(&as_line(&connection.path))
            )?;
        }
        for (rank, id) in self.crossings.iter().enumerate() {
            let crossing = &network.crossings[id.index()];
            let name = self.crossing(rank);
            let crossed: Vec<String> = [Direction::Along, Direction::Against]
                .into_iter()
                .filter(|direction| exists(network, crossing.road, *direction))
                .map(|direction| edge_name(crossing.road, direction))
                .collect();
            writeln!(
                out,
                r#"<edge id="{name}" function="crossing" crossingEdges="{}"><lane id="{name}_0" index="0" allow="pedestrian" speed="{}" length="{}" width="{}" shape="{}"/></edge>"#,
                crossed.join(" "),
                Two(WALK),
                Two((crossing.end - crossing.start).norm().max(0.1)),
                Two(crossing.width),
                Shape(&[crossing.start, crossing.end])
            )?;
        }
        for corner in &self.corners {
            let (name, path) = (self.area(*corner), &network.intersections[self.id.index()].corners[*corner]);
            let width = self.corner_width(network, *corner);
            writeln!(
                out,
                r#"<edge id="{name}" function="walkingarea"><lane id="{name}_0" index="0" allow="pedestrian" speed="{}" length="{}" width="{}" shape="{}"/></edge>"#,
                Two(WALK),
                Two(polyline::length(path).max(0.1)),
                Two(width),
                Shape(&around(path, width))
            )?;
        }
        Ok(())
    }

    fn corner_width(&self, network: &RoadNetwork, corner: usize) -> f64 {
        let road = network.intersections[self.id.index()].roads[corner];
        let direction = opposite(leaving(&network.roads[road.index()], self.id));
        sidewalk(network, road, direction).map_or(2.0, |walk| walk.width)
    }

    /// The junction with its lanes and its right of way.
    pub(super) fn write(&self, network: &RoadNetwork, edges: &Edges, out: &mut impl Write) -> io::Result<()> {
        let place = &network.intersections[self.id.index()];
        let kind = match place.control {
            Control::Signals => "traffic_light",
            _ if place.roads.len() < 2 && self.links.is_empty() => "dead_end",
            Control::Stop if is_of_one_class(network, place) => "allway_stop",
            Control::Stop => "priority_stop",
            _ => "priority",
        };
        let incoming = self.incoming_lanes(network, edges);
        let crossings = (0..self.crossings.len()).map(|rank| format!("{}_0", self.crossing(rank)));
        let internal: Vec<String> =
            (0..self.links.len()).map(|link| format!("{}_0", self.internal(link))).chain(crossings).collect();
        writeln!(
            out,
            r#"<junction id="{}" type="{kind}" x="{}" y="{}" incLanes="{}" intLanes="{}" shape="{}">"#,
            self.name(),
            Two(place.center.x),
            Two(place.center.y),
            incoming.join(" "),
            internal.join(" "),
            Shape(&as_line(&place.outline))
        )?;
        for index in 0..self.links.len() + self.crossings.len() {
            let (response, foes) = self.request(network, index);
            writeln!(out, r#"<request index="{index}" response="{response}" foes="{foes}" cont="0"/>"#)?;
        }
        writeln!(out, "</junction>")
    }

    fn incoming_lanes(&self, network: &RoadNetwork, edges: &Edges) -> Vec<String> {
        let place = &network.intersections[self.id.index()];
        let mut lanes = Vec::new();
        for road in place.roads.iter().rev() {
            let direction = opposite(leaving(&network.roads[road.index()], self.id));
            let edge = edge_name(*road, direction);
            if sidewalk(network, *road, direction).is_some() {
                lanes.push(format!("{edge}_0"));
            }
            for lane in super::edges::lanes(network, &network.roads[road.index()], direction).iter().rev() {
                lanes.push(format!("{edge}_{}", edges.rank(*lane)));
            }
        }
        lanes.extend(self.crossings.iter().map(|crossing| {
            let (from, _) = self.ends(network, *crossing);
            format!("{}_0", self.area(from))
        }));
        lanes
    }

    /// To whom a link gives way, and whom it meets at all; the last character is the first link.
    fn request(&self, network: &RoadNetwork, index: usize) -> (String, String) {
        let count = self.links.len() + self.crossings.len();
        let (mut response, mut foes) = (vec![b'0'; count], vec![b'0'; count]);
        let set = |bits: &mut Vec<u8>, other: usize| bits[count - 1 - other] = b'1';
        if let Some(id) = self.links.get(index) {
            let connection = &network.connections[id.index()];
            for (other, rival) in self.links.iter().enumerate() {
                if connection.conflicts.binary_search(rival).is_ok() {
                    set(&mut foes, other);
                }
                if connection.yields_to.binary_search(rival).is_ok() {
                    set(&mut response, other);
                }
            }
            for (rank, crossing) in self.crossings.iter().enumerate() {
                if connection.crossings.binary_search(crossing).is_ok() {
                    set(&mut foes, self.links.len() + rank);
                    set(&mut response, self.links.len() + rank);
                }
            }
        } else {
            let crossing = self.crossings[index - self.links.len()];
            for (other, id) in self.links.iter().enumerate() {
                if network.connections[id.index()].crossings.binary_search(&crossing).is_ok() {
                    set(&mut foes, other);
                }
            }
        }
        let text = |bits: Vec<u8>| bits.into_iter().map(char::from).collect();
        (text(response), text(foes))
    }

    pub(super) fn write_connections(
        &self,
        network: &RoadNetwork,
        edges: &Edges,
        out: &mut impl Write,
    ) -> io::Result<()> {
        let signals = network.intersections[self.id.index()].control == Control::Signals;
        for (link, id) in self.links.iter().enumerate() {
            let connection = &network.connections[id.index()];
            let (from, to) = (edge_of(network, connection.from), edge_of(network, connection.to));
            let (from_rank, to_rank) = (edges.rank(connection.from), edges.rank(connection.to));
            let dir = match connection.turn {
                Turn::Straight => 's',
                Turn::Right => 'r',
                Turn::Left => 'l',
                Turn::UTurn => 't',
            };
            let light = self.light(signals, link);
            let state = if signals {
                'o'
            } else if connection.yields_to.is_empty() {
                'M'
            } else {
                'm'
            };
            let via = self.internal(link);
            writeln!(
                out,
                r#"<connection from="{from}" to="{to}" fromLane="{from_rank}" toLane="{to_rank}" via="{via}_0"{light} dir="{dir}" state="{state}"/>"#
            )?;
            writeln!(
                out,
                r#"<connection from="{via}" to="{to}" fromLane="0" toLane="{to_rank}" dir="{dir}" state="M"/>"#
            )?;
        }
        self.write_walks(network, signals, out)
    }

    fn light(&self, signals: bool, link: usize) -> String {
        if signals { format!(r#" tl="{}" linkIndex="{link}""#, self.name()) } else { String::new() }
    }

    /// Sidewalk to walking area, walking area to crossing, and so on.
    fn write_walks(&self, network: &RoadNetwork, signals: bool, out: &mut impl Write) -> io::Result<()> {
        let place = &network.intersections[self.id.index()];
        let plain = |from: &str, to: &str| {
            format!(r#"<connection from="{from}" to="{to}" fromLane="0" toLane="0" dir="s" state="M"/>"#)
        };
        for corner in &self.corners {
            let area = self.area(*corner);
            // The left sidewalk of this leg arrives, the right one of the next leaves.
            let (here, next) = (place.roads[*corner], place.roads[(corner + 1) % place.roads.len()]);
            let arrives = opposite(leaving(&network.roads[here.index()], self.id));
            if sidewalk(network, here, arrives).is_some() {
                writeln!(out, "{}", plain(&edge_name(here, arrives), &area))?;
            }
            let leaves = leaving(&network.roads[next.index()], self.id);
            if sidewalk(network, next, leaves).is_some() {
                writeln!(out, "{}", plain(&area, &edge_name(next, leaves)))?;
            }
        }
        for (rank, crossing) in self.crossings.iter().enumerate() {
            let (from, to) = self.ends(network, *crossing);
            let light = self.light(signals, self.links.len() + rank);
            let state = if signals { 'o' } else { 'M' };
            let (from, name) = (self.area(from), self.crossing(rank));
            writeln!(
                out,
                r#"<connection from="{from}" to="{name}" fromLane="0" toLane="0"{light} dir="s" state="{state}"/>"#
            )?;
            writeln!(out, "{}", plain(&name, &self.area(to)))?;
        }
        Ok(())
    }
}

/// The speed of a turn of that length, m/s: v² = a r, with r the length over the angle. A right angle of 6 m has a
/// radius of 3.8 m and is taken at 4.6 m/s.
fn turning_speed(path: &[Point2], length: f64) -> f64 {
    let (from, to) = (polyline::at(path, 0.0).1, polyline::at(path, length).1);
    let angle = ops::wrap_angle(to - from).abs();
    (LATERAL * length / angle.max(1e-3)).sqrt()
}

/// The outline of a path of some width.
fn around(path: &[Point2], width: f64) -> Vec<Point2> {
    let mut outline = polyline::offset(path, -width * 0.5);
    outline.extend(polyline::reversed(&polyline::offset(path, width * 0.5)));
    outline
}

fn is_of_one_class(network: &RoadNetwork, place: &Intersection) -> bool {
    let mut classes = place.roads.iter().map(|road| network.roads[road.index()].class);
    let first = classes.next();
    classes.all(|class| Some(class) == first)
}
