//! Edges: each road in each direction in which somebody goes along it, with its lanes from right to left.

use std::io::{self, Write};

use simworld_core::geometry::Point2;
use simworld_core::id::{IntersectionId, LaneId, RoadId};
use simworld_core::net::{Lane, LaneKind, Road, RoadClass, RoadNetwork, Side, Sidewalk, polyline};

use crate::files::xml::{Shape, Two, escaped};

/// Walking speed on sidewalks, m/s: the default of SUMO's pedestrian lanes.
pub(super) const WALK: f64 = 2.78;
/// Who never drives on a lane for cars.
const NO_CARS: &str = "pedestrian tram rail_urban rail rail_electric rail_fast ship";

/// A direction of a road.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    Along,
    Against,
}

/// Which edges there are, and where every lane lies among those of its edge.
pub(super) struct Edges {
    /// Of each lane, its index in its edge, from the right.
    ranks: Vec<usize>,
}

impl Edges {
    pub(super) fn of(network: &RoadNetwork) -> Self {
        let mut ranks = vec![0; network.lanes.len()];
        for (index, road) in network.roads.iter().enumerate() {
            for direction in [Direction::Along, Direction::Against] {
                let first = usize::from(sidewalk(network, RoadId::from_index(index), direction).is_some());
                for (rank, lane) in lanes(network, road, direction).iter().rev().enumerate() {
                    ranks[lane.index()] = first + rank;
                }
            }
        }
        Self { ranks }
    }

    /// The index of a lane in its edge.
    pub(super) fn rank(&self, lane: LaneId) -> usize {
        self.ranks[lane.index()]
    }

    pub(super) fn write(&self, network: &RoadNetwork, out: &mut impl Write) -> io::Result<()> {
        for index in 0..network.roads.len() {
            for direction in [Direction::Along, Direction::Against] {
                self.write_edge(network, RoadId::from_index(index), direction, out)?;
            }
        }
        Ok(())
    }

    fn write_edge(
        &self,
        network: &RoadNetwork,
        id: RoadId,
        direction: Direction,
        out: &mut impl Write,
    ) -> io::Result<()> {
        if !exists(network, id, direction) {
            return Ok(());
        }
        let road = &network.roads[id.index()];
        let (from, to) = match direction {
            Direction::Along => (road.from, road.to),
            Direction::Against => (road.to, road.from),
        };
        let edge = edge_name(id, direction);
        let name =
            network.road_name(id).map_or_else(String::new, |name| format!(r#" name="{}""#, escaped(name)));
        let priority = match road.class {
            RoadClass::Local => 1,
            RoadClass::Arterial => 7,
            RoadClass::Highway => 13,
        };
        writeln!(out, r#"<edge id="{edge}" from="j{}" to="j{}"{name} priority="{priority}">"#, from.0, to.0)?;
        let walk = sidewalk(network, id, direction);
        let walk_path = walk.map(|walk| match direction {
            Direction::Along => walk.path.clone(),
            Direction::Against => polyline::reversed(&walk.path),
        });
        // All lanes of an edge have the length of its lanes for vehicles, as SUMO wants it.
        let own = lanes(network, road, direction);
        let length = own
            .last()
            .map(|lane| network.lanes[lane.index()].length)
            .or(walk_path.as_deref().map(polyline::length))
            .unwrap_or(0.1)
            .max(0.1);
        if let (Some(walk), Some(path)) = (walk, walk_path) {
            writeln!(
                out,
                r#"<lane id="{edge}_0" index="0" allow="pedestrian" speed="{}" length="{}" width="{}" shape="{}"/>"#,
                Two(WALK),
                Two(length),
                Two(walk.width),
                Shape(&path)
            )?;
        }
        self.write_lanes(network, &own, (&edge, length), out)?;
        writeln!(out, "</edge>")
    }

    /// The lanes for vehicles of an edge, from the outside inwards, all of one length.
    fn write_lanes(
        &self,
        network: &RoadNetwork,
        lanes: &[LaneId],
        (edge, length): (&str, f64),
        out: &mut impl Write,
    ) -> io::Result<()> {
        for lane in lanes.iter().rev() {
            let (rank, lane) = (self.rank(*lane), &network.lanes[lane.index()]);
            let who = match lane.kind {
                LaneKind::Bus => r#"allow="bus""#.to_owned(),
                LaneKind::Cycle => r#"allow="bicycle""#.to_owned(),
                _ => format!(r#"disallow="{NO_CARS}""#),
            };
            writeln!(
                out,
                r#"<lane id="{edge}_{rank}" index="{rank}" {who} speed="{}" length="{}" width="{}" shape="{}"/>"#,
                Two(lane.speed_limit),
                Two(length),
                Two(lane.width),
                Shape(&lane.path)
            )?;
        }
        Ok(())
    }
}

/// The edge of a lane.
pub(super) fn edge_of(network: &RoadNetwork, lane: LaneId) -> String {
    let Lane { road, from, .. } = network.lanes[lane.index()];
    let along = network.roads[road.index()].from == from;
    edge_name(road, if along { Direction::Along } else { Direction::Against })
}

/// `r7`, or `-r7` against the centreline.
pub(super) fn edge_name(road: RoadId, direction: Direction) -> String {
    match direction {
        Direction::Along => format!("r{}", road.0),
        Direction::Against => format!("-r{}", road.0),
    }
}

/// Lanes in a direction, from the middle outwards: from left to right, those for bicycles last.
pub(super) fn lanes(network: &RoadNetwork, road: &Road, direction: Direction) -> Vec<LaneId> {
    let (driven, leaves) = match direction {
        Direction::Along => (&road.forward, road.from),
        Direction::Against => (&road.backward, road.to),
    };
    let cycle = road.cycle.iter().filter(|lane| network.lanes[lane.index()].from == leaves);
    driven.iter().chain(cycle).copied().collect()
}

/// The sidewalk on the right of a direction.
pub(super) fn sidewalk(network: &RoadNetwork, road: RoadId, direction: Direction) -> Option<&Sidewalk> {
    let side = match direction {
        Direction::Along => Side::Right,
        Direction::Against => Side::Left,
    };
    network.sidewalk(road, side).filter(|walk| walk.path.len() > 1)
}

/// Whether a road is an edge in a direction: somebody drives or walks there.
pub(super) fn exists(network: &RoadNetwork, road: RoadId, direction: Direction) -> bool {
    !lanes(network, &network.roads[road.index()], direction).is_empty()
        || sidewalk(network, road, direction).is_some()
}

/// The direction in which a road leaves an intersection; the other one arrives.
pub(super) fn leaving(road: &Road, from: IntersectionId) -> Direction {
    if road.from == from { Direction::Along } else { Direction::Against }
}

pub(super) fn opposite(direction: Direction) -> Direction {
    match direction {
        Direction::Along => Direction::Against,
        Direction::Against => Direction::Along,
    }
}

/// A point is no shape: SUMO wants two.
pub(super) fn as_line(points: &[Point2]) -> Vec<Point2> {
    match points {
        [] => vec![Point2::origin(); 2],
        [one] => vec![*one; 2],
        more => more.to_vec(),
    }
}
