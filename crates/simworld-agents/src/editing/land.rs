//! What the ground is for, and what may stand on it.

use std::sync::Arc;

use simworld_core::geometry::{Point2, direction};
use simworld_core::id::RoadId;
use simworld_core::net::{LaneKind, Road, RoadNetwork, Strip, polyline};

use super::solid::Solid;

/// Side of the squares by which roads are found, m.
const CELL: f64 = 64.0;
/// What stands on a sidewalk leaves so much of it to walkers, m: two can pass (Highway Capacity Manual, 0.76 m each).
const WALKING_WIDTH: f64 = 1.5;
/// Nothing stands so near before a crossing, m.
const CROSSING_ROOM: f64 = 2.0;
/// Stations that differ by less are the same, m.
const HAIR: f64 = 1e-6;

/// What the ground is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Land {
    /// The point, the thing or the piece of ground that was named: whoever names it means it.
    Asked,
    /// Ground of which nothing is known.
    Unknown,
    /// Beside a street and no part of it: lots, yards, front gardens.
    Lot,
    /// Parks, lawns, meadows, woods and fields.
    Green,
    /// Grass or trees between a kerb and a sidewalk.
    Verge,
    /// Sand or rock.
    Bare,
    /// Squares, and whatever else is paved and no street.
    Paving,
    /// A trodden path.
    Path,
    /// A piece of ground for parked vehicles.
    ParkingLot,
    /// A strip of a street for parked vehicles.
    Parking,
    /// At the kerb of a carriageway, along its outermost lane.
    Kerbside,
    /// For traffic.
    Carriageway,
    /// For bicycles.
    CycleLane,
    /// A road of which no lanes are known.
    Road,
    /// Where streets meet, and crossings.
    Junction,
    /// For walkers.
    Sidewalk,
    /// Rivers, lakes, harbours and the sea.
    Water,
}

impl Land {
    /// Where a thing stands that stands there, in words: "on a lawn or other soil".
    pub const fn told(self) -> &'static str {
        match self {
            Self::Asked => "where it was asked for",
            Self::Unknown => "on open ground",
            Self::Lot => "on open ground beside a street",
            Self::Green => "on a lawn or other soil",
            Self::Verge => "on the verge of a street",
            Self::Bare => "on sand or rock",
            Self::Paving => "on paving",
            Self::Path => "on a path",
            Self::ParkingLot => "on a parking lot",
            Self::Parking => "on a parking strip",
            Self::Kerbside => "beside the kerb of a street",
            Self::Carriageway => "in a lane",
            Self::CycleLane => "in a cycle lane",
            Self::Road => "on a road",
            Self::Junction => "where streets meet or walkers cross",
            Self::Sidewalk => "on a sidewalk",
            Self::Water => "in the water",
        }
    }

    /// Whether vehicles move or park there, as a part of a street.
    pub(super) const fn is_street(self) -> bool {
        matches!(self, Self::Parking | Self::Kerbside | Self::Carriageway | Self::CycleLane | Self::Road)
    }
}

/// How well the ground suits a thing that stands there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LandFit {
    /// What the ground is for; of a thing that stands on several pieces, that which suits it least.
    pub land: Land,
    /// From 0 to 1, which is ground that is for such things.
    pub suits: f64,
    /// Whether the ground is for something else, so that it is taken only where nothing better is found.
    pub astray: bool,
}

impl LandFit {
    /// Of what stands exactly where the words say.
    pub(super) const ASKED: Self = Self { land: Land::Asked, suits: 1.0, astray: false };
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

    /// What a point is for, by the streets near it: [`Land::Lot`] where it is part of none.
    pub(super) fn at_of(&self, point: Point2, roads: &[RoadId]) -> Land {
        if around(&self.places, point).any(|place| {
            let place = &self.network.intersections[place as usize];
            contains(&place.outline, point)
                || place.turning.is_some_and(|circle| (point - circle.center).norm() <= circle.radius)
        }) {
            return Land::Junction;
        }
        let mut land = Land::Lot;
        for id in roads {
            let road = self.road(*id);
            let Some(offset) = offset_along(&road.centerline, point) else { continue };
            let is_verge = || strip_at(road, point, offset) == Some(LaneKind::Verge);
            if (-road.right_kerb..=road.left_kerb).contains(&offset) {
                return self.of_carriageway(*id, point, offset);
            }
            if self.is_on_walk(*id, point) {
                land = Land::Sidewalk;
            } else if land == Land::Lot && is_verge() {
                land = Land::Verge;
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
        match strip_at(road, point, offset) {
            Some(LaneKind::Parking) => Land::Parking,
            Some(LaneKind::Cycle) => Land::CycleLane,
            _ => Land::Carriageway,
        }
    }

    fn is_on_walk(&self, id: RoadId, point: Point2) -> bool {
        let walks = self.road(id).sidewalks.into_iter().flatten();
        let mut walks = walks.map(|walk| &self.network.sidewalks[walk.index()]);
        let on = |near: Option<polyline::Closest>, width: f64| {
            near.is_some_and(|near| near.distance <= width * 0.5)
        };
        walks.any(|walk| on(polyline::closest(&walk.path, &point), walk.width))
    }

    /// Whether a thing on a sidewalk leaves room to walk past it.
    pub(super) fn leaves_way(&self, roads: &[RoadId], solid: &Solid) -> bool {
        let walks = roads.iter().flat_map(|road| self.road(*road).sidewalks).flatten();
        let mut walks = walks.map(|walk| &self.network.sidewalks[walk.index()]);
        walks.all(|walk| {
            // Corners beyond its ends are beside no part of it.
            let beside = solid.corners().into_iter().filter_map(|corner| offset_along(&walk.path, corner));
            leaves_width(walk.width * 0.5, beside)
        })
    }
}

/// Whether of a walkway of that half width enough is left to walk past a thing whose corners lie so far to the left of its
/// middle, m; so it is where the thing does not stand on it.
pub(super) fn leaves_width(half: f64, offsets: impl Iterator<Item = f64>) -> bool {
    let (least, most) = offsets.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), offset| {
        (least.min(offset), most.max(offset))
    });
    let is_on = least < half && most > -half;
    !is_on || (least + half).max(half - most) >= WALKING_WIDTH
}

/// What strip of a road lies at an offset to the left of its centreline, m, beside a point.
fn strip_at(road: &Road, point: Point2, offset: f64) -> Option<LaneKind> {
    let is_at = |strip: &&Strip| (offset - strip.offset).abs() <= strip.width * 0.5;
    let mut strips = road.strips.iter().filter(is_at).peekable();
    strips.peek()?;
    let station = polyline::closest(&road.centerline, &point)?.station;
    strips.find(|strip| (strip.stations.0..=strip.stations.1).contains(&station)).map(|strip| strip.kind)
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
    // On the way the nearest point is straight across, or the corner of a bend that the point lies on the outside of.
    if near.station > HAIR && near.station < polyline::length(line) - HAIR {
        return Some(near.lateral);
    }
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
    use simworld_core::net::{CrossSection, LaneDirection, LaneSpec, NetworkConfig, StreetPlan};
    use simworld_core::scene::Shape;

    use super::*;

    fn crossroads(section: CrossSection) -> Streets {
        let mut plan = StreetPlan::crossroads(100.0);
        plan.sections[0] = section;
        Streets::of(&Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap()))
    }

    fn at(streets: &Streets, point: Point2) -> Land {
        streets.at_of(point, &streets.roads_near(point))
    }

    #[test]
    fn the_ground_is_for_what_the_section_says() {
        let streets = crossroads(CrossSection::two_way(1, 1).with_parking(2.0));
        assert_eq!(at(&streets, Point2::new(0.0, 0.0)), Land::Junction);
        assert_eq!(at(&streets, Point2::new(60.0, 1.5)), Land::Carriageway);
        assert_eq!(at(&streets, Point2::new(60.0, 4.5)), Land::Parking);
        assert_eq!(at(&streets, Point2::new(60.0, 7.0)), Land::Sidewalk);
        assert_eq!(at(&streets, Point2::new(60.0, 30.0)), Land::Lot);
        let streets = crossroads(CrossSection::two_way(1, 1).with_cycle_lanes(1.5));
        assert_eq!(at(&streets, Point2::new(60.0, 4.25)), Land::CycleLane);
    }

    #[test]
    fn between_kerb_and_sidewalk_lies_a_verge() {
        let mut section = CrossSection::two_way(1, 1);
        let verge = LaneSpec { kind: LaneKind::Verge, direction: LaneDirection::Both, width: 2.0 };
        // From left to right: sidewalk, verge, lane, lane, verge, sidewalk.
        section.lanes.insert(3, verge);
        section.lanes.insert(1, verge);
        section.reference += 2.0;
        let streets = crossroads(section);
        assert_eq!(at(&streets, Point2::new(60.0, 4.5)), Land::Verge);
        assert_eq!(at(&streets, Point2::new(60.0, 7.0)), Land::Sidewalk);
    }

    #[test]
    fn on_the_outside_of_a_bend_one_is_beside_the_line_and_beyond_its_end_one_is_not() {
        let line = [(0.0, 0.0), (50.0, 0.0), (50.0, 50.0)].map(|(x, y)| Point2::new(x, y));
        // Nearest to it is the corner: to the right of the line that turns left.
        let offset = offset_along(&line, Point2::new(53.0, -4.0));
        assert!(offset.is_some_and(|offset| (offset + 5.0).abs() < 1e-12), "{offset:?}");
        assert_eq!(offset_along(&line, Point2::new(-3.0, 4.0)), None);
        assert_eq!(offset_along(&line, Point2::new(20.0, 4.0)), Some(4.0));
    }

    #[test]
    fn walkers_keep_a_width_of_the_sidewalk() {
        let streets = crossroads(CrossSection::two_way(1, 1));
        // The sidewalk reaches from 3.5 to 6.5 m.
        let leaves_way = |y: f64, depth: f64| {
            let solid = Solid::standing(Shape::cuboid(1.8, depth, 0.8), Point3::new(60.0, y, 0.0), 0.0);
            streets.leaves_way(&streets.roads_near(solid.planar()), &solid)
        };
        assert!(leaves_way(4.0, 0.6), "2.2 m are left");
        assert!(!leaves_way(5.0, 0.6), "1.2 m are left on either side");
        assert!(leaves_way(8.0, 0.6), "it stands beside it");
    }
}
