//! What the ground is for, and what may stand on it.

use std::sync::Arc;

use simworld_core::geometry::{Point2, direction};
use simworld_core::id::RoadId;
use simworld_core::net::{LaneKind, Road, RoadNetwork, polyline};
use simworld_core::scene::EntityKind;

use super::solid::Solid;

/// Side of the squares by which roads are found, m.
const CELL: f64 = 64.0;
/// What stands on a sidewalk leaves so much of it to walkers, m: two can pass (Highway Capacity Manual, 0.76 m each).
const WALKING_WIDTH: f64 = 1.5;
/// Nothing stands so near before a crossing, m.
const CROSSING_ROOM: f64 = 2.0;

/// What the ground is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Land {
    /// Lots, lawns, squares: everything that is no street.
    Open,
    /// For traffic.
    Carriageway,
    /// A strip for parked vehicles.
    Parking,
    /// Where streets meet, and crossings.
    Junction,
    /// For walkers.
    Sidewalk,
}

/// The streets of a scene, by place.
#[derive(Clone, Debug)]
pub(super) struct Streets {
    network: Arc<RoadNetwork>,
    /// Roads by the square that they touch, ascending.
    roads: Vec<((i32, i32), u32)>,
    /// Intersections by the square of their middle, ascending.
    places: Vec<((i32, i32), u32)>,
}

impl Streets {
    pub(super) fn of(network: &Arc<RoadNetwork>) -> Self {
        let mut roads = Vec::new();
        for (index, road) in network.roads.iter().enumerate() {
            for piece in road.centerline.windows(2) {
                let count = ((piece[1] - piece[0]).norm() / CELL).ceil().max(1.0);
                for step in 0..=count as u32 {
                    let at = piece[0] + (piece[1] - piece[0]) * (f64::from(step) / count);
                    roads.push((cell(at), index as u32));
                }
            }
        }
        roads.sort_unstable();
        roads.dedup();
        let places = network.intersections.iter().enumerate();
        let mut places: Vec<_> = places.map(|(index, place)| (cell(place.center), index as u32)).collect();
        places.sort_unstable();
        Self { network: Arc::clone(network), roads, places }
    }

    /// Whether these are the streets of that network.
    pub(super) fn is_of(&self, network: &Arc<RoadNetwork>) -> bool {
        Arc::ptr_eq(&self.network, network)
    }

    /// The roads within a square or so of a point, ascending.
    pub(super) fn roads_near(&self, point: Point2) -> Vec<RoadId> {
        let mut found: Vec<u32> = around(&self.roads, point).collect();
        found.sort_unstable();
        found.dedup();
        found.into_iter().map(|road| RoadId::from_index(road as usize)).collect()
    }

    /// Whether a street lies between two points.
    pub(super) fn crosses(&self, from: Point2, to: Point2) -> bool {
        let count = ((to - from).norm() / CELL).ceil().max(1.0) as u32;
        let mut near: Vec<u32> = (0..=count)
            .flat_map(|step| around(&self.roads, from + (to - from) * (f64::from(step) / f64::from(count))))
            .collect();
        near.sort_unstable();
        near.dedup();
        near.into_iter().any(|road| {
            let pieces = self.network.roads[road as usize].centerline.windows(2);
            pieces.into_iter().any(|piece| polyline::crossing(from, to, piece[0], piece[1]).is_some())
        })
    }

    pub(super) fn road(&self, id: RoadId) -> &Road {
        &self.network.roads[id.index()]
    }

    pub(super) fn network(&self) -> &RoadNetwork {
        &self.network
    }

    fn at_of(&self, point: Point2, roads: &[RoadId]) -> Land {
        if around(&self.places, point).any(|place| {
            let place = &self.network.intersections[place as usize];
            contains(&place.outline, point)
                || place.turning.is_some_and(|circle| (point - circle.center).norm() <= circle.radius)
        }) {
            return Land::Junction;
        }
        let mut land = Land::Open;
        for id in roads {
            let road = self.road(*id);
            let Some(offset) = offset_along(&road.centerline, point) else { continue };
            if (-road.right_kerb..=road.left_kerb).contains(&offset) {
                return self.of_carriageway(*id, point, offset);
            }
            if let Some(walk) = self.walk_at(*id, point) {
                land = walk;
            }
        }
        land
    }

    fn of_carriageway(&self, id: RoadId, point: Point2, offset: f64) -> Land {
        let road = self.road(id);
        let ends = [road.from, road.to].map(|end| &self.network.intersections[end.index()]);
        let crossings = ends.into_iter().flat_map(|end| &end.crossings);
        let crosses = crossings.map(|crossing| &self.network.crossings[crossing.index()]).any(|crossing| {
            let room = crossing.width * 0.5 + CROSSING_ROOM;
            crossing.road == id
                && polyline::closest(&[crossing.start, crossing.end], &point)
                    .is_some_and(|near| near.distance <= room)
        });
        if crosses {
            return Land::Junction;
        }
        let station = polyline::closest(&road.centerline, &point).map_or(0.0, |near| near.station);
        let parks = road.strips.iter().any(|strip| {
            strip.kind == LaneKind::Parking
                && (offset - strip.offset).abs() <= strip.width * 0.5
                && (strip.stations.0..=strip.stations.1).contains(&station)
        });
        if parks { Land::Parking } else { Land::Carriageway }
    }

    fn walk_at(&self, id: RoadId, point: Point2) -> Option<Land> {
        let walks = self.road(id).sidewalks.into_iter().flatten();
        let mut walks = walks.map(|walk| &self.network.sidewalks[walk.index()]);
        let on = |near: Option<polyline::Closest>, width: f64| {
            near.is_some_and(|near| near.distance <= width * 0.5)
        };
        walks.any(|walk| on(polyline::closest(&walk.path, &point), walk.width)).then_some(Land::Sidewalk)
    }

    /// Whether a thing on a sidewalk leaves room to walk past it.
    fn leaves_way(&self, roads: &[RoadId], solid: &Solid) -> bool {
        let walks = roads.iter().flat_map(|road| self.road(*road).sidewalks).flatten();
        let mut walks = walks.map(|walk| &self.network.sidewalks[walk.index()]);
        walks.all(|walk| {
            let half = walk.width * 0.5;
            let offsets =
                solid.corners().map(|corner| offset_along(&walk.path, corner).unwrap_or(f64::INFINITY));
            let least = offsets.into_iter().fold(f64::INFINITY, f64::min);
            let most = offsets.into_iter().fold(f64::NEG_INFINITY, f64::max);
            let is_on = least < half && most > -half;
            !is_on || (least + half).max(half - most) >= WALKING_WIDTH
        })
    }

    /// How well a thing of that kind stands there, from 0 to 1, or why it may not.
    pub(super) fn suits(&self, kind: EntityKind, solid: &Solid) -> Result<f64, &'static str> {
        let roads = self.roads_near(solid.planar());
        if roads.is_empty() {
            return Ok(1.0);
        }
        let [a, b, c, d] = solid.corners();
        let lands = [a, b, c, d, solid.planar()].map(|at| self.at_of(at, &roads));
        let any = |land: Land| lands.contains(&land);
        if any(Land::Junction) && kind != EntityKind::Cone {
            return Err("streets meet there, or walkers cross");
        }
        let on_street = any(Land::Carriageway) || any(Land::Parking);
        match kind {
            EntityKind::Cone => Ok(1.0),
            EntityKind::Car | EntityKind::Truck | EntityKind::Bus | EntityKind::Motorcycle => {
                if any(Land::Sidewalk) {
                    Err("a sidewalk is for walkers")
                } else if any(Land::Parking) {
                    Ok(1.0)
                } else {
                    Ok(if any(Land::Carriageway) { 0.5 } else { 0.7 })
                }
            }
            EntityKind::Building if any(Land::Sidewalk) || on_street => Err("a street is there"),
            _ if on_street => Err("a carriageway is for traffic"),
            _ if !self.leaves_way(&roads, solid) => {
                Err("too little of the sidewalk would be left to walk on")
            }
            EntityKind::Tree | EntityKind::Shrub if any(Land::Sidewalk) => Ok(0.4),
            _ => Ok(1.0),
        }
    }
}

fn cell(point: Point2) -> (i32, i32) {
    ((point.x / CELL).floor() as i32, (point.y / CELL).floor() as i32)
}

/// What is filed under the square of a point and those around it.
fn around(filed: &[((i32, i32), u32)], point: Point2) -> impl Iterator<Item = u32> + '_ {
    let (x, y) = cell(point);
    (x - 1..=x + 1).flat_map(move |x| {
        let from = filed.partition_point(|(at, _)| *at < (x, y - 1));
        let to = filed.partition_point(|(at, _)| *at <= (x, y + 1));
        filed[from..to].iter().map(|(_, index)| *index)
    })
}

/// How far to the left of a line a point is, m; `None` beyond its ends.
pub(super) fn offset_along(line: &[Point2], point: Point2) -> Option<f64> {
    let near = polyline::closest(line, &point)?;
    let (foot, heading) = polyline::at(line, near.station);
    // Beyond an end the nearest point is the end, and the way there is not straight across.
    let ahead = direction(heading).dot(&(point - foot)).abs();
    (ahead <= 0.5).then_some(near.lateral)
}

/// Whether a point is within an outline, by the crossings of a ray to the east.
fn contains(outline: &[Point2], point: Point2) -> bool {
    let mut inside = false;
    for (index, a) in outline.iter().enumerate() {
        let b = &outline[(index + 1) % outline.len()];
        let spans = (a.y > point.y) != (b.y > point.y);
        if spans && point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y) {
            inside = !inside;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Point3;
    use simworld_core::net::{CrossSection, NetworkConfig, StreetPlan};
    use simworld_core::scene::Shape;

    use super::*;

    fn crossroads() -> Streets {
        let mut plan = StreetPlan::crossroads(100.0);
        plan.sections[0] = CrossSection::two_way(1, 1).with_parking(2.0);
        Streets::of(&Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap()))
    }

    fn at(streets: &Streets, point: Point2) -> Land {
        streets.at_of(point, &streets.roads_near(point))
    }

    #[test]
    fn the_ground_is_for_what_the_section_says() {
        let streets = crossroads();
        assert_eq!(at(&streets, Point2::new(0.0, 0.0)), Land::Junction);
        assert_eq!(at(&streets, Point2::new(60.0, 1.5)), Land::Carriageway);
        assert_eq!(at(&streets, Point2::new(60.0, 4.5)), Land::Parking);
        assert_eq!(at(&streets, Point2::new(60.0, 7.0)), Land::Sidewalk);
        assert_eq!(at(&streets, Point2::new(60.0, 30.0)), Land::Open);
    }

    #[test]
    fn everything_has_its_place() {
        let streets = crossroads();
        let car = |y| Solid::standing(Shape::cuboid(4.4, 1.8, 1.4), Point3::new(60.0, y, 0.0), 0.0);
        let bench =
            |y, depth| Solid::standing(Shape::cuboid(depth, 1.8, 0.8), Point3::new(60.0, y, 0.0), 1.57);
        assert_eq!(streets.suits(EntityKind::Car, &car(4.5)), Ok(1.0), "parked");
        assert!(streets.suits(EntityKind::Car, &car(7.0)).is_err(), "on the sidewalk");
        assert!(streets.suits(EntityKind::Bench, &bench(1.5, 0.6)).is_err(), "in a lane");
        assert_eq!(streets.suits(EntityKind::Bench, &bench(30.0, 0.6)), Ok(1.0), "on a lawn");
        assert!(streets.suits(EntityKind::Bench, &bench(6.8, 2.5)).is_err(), "across the way of walkers");
        assert!(
            streets.suits(EntityKind::Tree, &bench(0.0, 0.6)).is_err(),
            "a tree in the middle of the street"
        );
    }
}
