//! Open ground: squares and parks between the streets, water beside the place.

use simworld_core::geometry::{Obb, Point2, Point3, Vector2, Vector3, heading, pose_facing};
use simworld_core::net::{RoadNetwork, polyline};
use simworld_core::scene::{EntityDesc, EntityKind, Shape};
use simworld_core::spec::{FeatureWish, Water};

use super::SettlementError;
use crate::City;

/// Along and across a square and a park, m.
const SQUARE: (f64, f64) = (32.0, 26.0);
const PARK: (f64, f64) = (46.0, 36.0);
/// Between open ground and the sidewalks around it, m.
const ROOM: f64 = 1.0;
/// Places for open ground are tried so far from each other, m.
const STEP: f64 = 8.0;
/// Between the outermost pavement and water, and how far water reaches, m.
const SHORE: f64 = 6.0;
const BASIN: f64 = 80.0;
const RIVER: f64 = 24.0;
/// The ground's top lies so far below a sidewalk's, and open ground a hair above it, m.
const GROUND: f64 = -0.03;
const LAYER: f64 = 0.02;

/// A piece of ground with a use and a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// What it is called.
    pub name: String,
    /// What it is: `square`, `park`, `harbour`, `river` or `lake`; the value of the attribute `area` of its entity.
    pub used_as: &'static str,
    /// Its middle, m.
    pub middle: Point2,
    /// Along and across, m.
    pub size: Vector2,
    /// Direction of its first side, radians from east.
    pub facing: f64,
}

impl Area {
    /// The box that it fills.
    fn obb(&self) -> Obb {
        let pose = pose_facing(Point3::new(self.middle.x, self.middle.y, 0.0), self.facing);
        Obb { pose, half_extents: Vector3::new(self.size.x * 0.5, self.size.y * 0.5, 1.0) }
    }

    /// The ground as an entity.
    pub(super) fn desc(&self) -> EntityDesc {
        let color = match self.used_as {
            "park" => [0.12, 0.24, 0.07],
            "square" => [0.42, 0.36, 0.28],
            _ => [0.04, 0.12, 0.2],
        };
        let pose = pose_facing(Point3::new(self.middle.x, self.middle.y, GROUND), self.facing);
        let shape = Shape::cuboid(self.size.x, self.size.y, LAYER);
        EntityDesc::new(EntityKind::Ground, pose, shape)
            .named(self.name.as_str())
            .with("area", self.used_as)
            .colored(color)
    }
}

/// Lays all of it out, and takes away what stands there.
pub(super) fn laid_out(city: &mut City, wish: &FeatureWish) -> Result<Vec<Area>, SettlementError> {
    let mut areas: Vec<Area> = Vec::new();
    let squares = wish.squares.iter().map(|name| (name, "square", SQUARE));
    let parks = wish.parks.iter().map(|name| (name, "park", PARK));
    for (name, used_as, size) in squares.chain(parks) {
        let no_room = || SettlementError::NoGround { name: name.clone() };
        let site = site(city, &areas, size).ok_or_else(no_room)?;
        let area = Area { name: name.clone(), used_as, ..site };
        let taken = area.obb();
        city.buildings.retain(|building| !building.solids().any(|solid| solid.footprints_overlap(&taken)));
        // A park keeps its trees, and a square nothing.
        city.elements.retain(|element| {
            let stays = used_as == "park" && element.kind == EntityKind::Tree;
            stays || !element.obb().footprints_overlap(&taken)
        });
        areas.push(area);
    }
    for (rank, water) in wish.waters.iter().enumerate() {
        areas.extend(shore(&city.network, *water, rank));
    }
    Ok(areas)
}

/// The open ground nearest to the middle for which least has to go.
fn site(city: &City, areas: &[Area], (along, across): (f64, f64)) -> Option<Area> {
    let (low, high) = city.network.bounds()?;
    let middle = Point2::from((low.coords + high.coords) * 0.5);
    let steps = ((high - low) / STEP).map(f64::ceil);
    let mut best: Option<(f64, Area)> = None;
    for row in 0..=steps.y as u32 {
        for column in 0..=steps.x as u32 {
            let at = low + Vector2::new(f64::from(column), f64::from(row)) * STEP;
            let cost = (at - middle).norm();
            if best.as_ref().is_some_and(|(least, _)| cost >= *least) {
                continue;
            }
            let Some(facing) = street_beside(&city.network, at) else { continue };
            for turn in [0.0, std::f64::consts::FRAC_PI_2] {
                let size = Vector2::new(along, across);
                let area = Area { name: String::new(), used_as: "", middle: at, size, facing: facing + turn };
                let obb = area.obb();
                let gone = city.buildings.iter().filter(|one| one.obb().footprints_overlap(&obb)).count();
                let cost = cost + 6.0 * gone as f64;
                let is_better = best.as_ref().is_none_or(|(least, _)| cost < *least);
                if is_better && is_open(&city.network, areas, &obb) {
                    best = Some((cost, area));
                }
            }
        }
    }
    best.map(|(_, area)| area)
}

/// The direction of the nearest street, if one is near enough to lead there.
fn street_beside(network: &RoadNetwork, at: Point2) -> Option<f64> {
    let near = network.roads.iter().filter_map(|road| {
        let near = polyline::closest(&road.centerline, &at)?;
        let (_, along) = polyline::at(&road.centerline, near.station);
        Some((near.distance, along))
    });
    let (distance, along) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (distance <= 60.0).then_some(along)
}

/// Whether no street and no other open ground lies there.
fn is_open(network: &RoadNetwork, areas: &[Area], taken: &Obb) -> bool {
    if areas.iter().any(|area| area.obb().footprints_overlap(taken)) {
        return false;
    }
    network.roads.iter().all(|road| {
        let widest = road.sidewalks.into_iter().flatten().map(|walk| network.sidewalks[walk.index()].width);
        let reach = road.left_kerb.max(road.right_kerb) + widest.fold(0.0, f64::max) + ROOM;
        road.centerline.windows(2).all(|piece| {
            let way = piece[1] - piece[0];
            let middle = piece[0] + way * 0.5;
            let pose = pose_facing(Point3::new(middle.x, middle.y, 0.0), heading(&way));
            let half_extents = Vector3::new(way.norm() * 0.5 + reach, reach, 1.0);
            !Obb { pose, half_extents }.footprints_overlap(taken)
        })
    })
}

/// What the streets cover: their kerbs, turning circles and sidewalks within.
fn paved(network: &RoadNetwork) -> Option<(Point2, Point2)> {
    let walk = network.sidewalks.iter().map(|walk| walk.width).fold(0.0, f64::max);
    let roads = network.roads.iter().flat_map(|road| {
        let reach = road.left_kerb.max(road.right_kerb);
        // A road ends in corners, which lie farther out than its sides.
        road.centerline.iter().map(move |point| (*point, reach * std::f64::consts::SQRT_2))
    });
    let circles = network.intersections.iter().filter_map(|place| place.turning);
    let discs = roads.chain(circles.map(|circle| (circle.center, circle.radius)));
    let ends = discs.map(|(point, reach)| {
        let out = Vector2::repeat(reach + walk);
        (point - out, point + out)
    });
    ends.reduce(|(low, high), (from, to)| (low.inf(&from), high.sup(&to)))
}

/// Water along one side: the first in the south, then east, north and west.
fn shore(network: &RoadNetwork, water: Water, rank: usize) -> Option<Area> {
    let (low, high) = paved(network)?;
    let (middle, size) = (Point2::from((low.coords + high.coords) * 0.5), high - low);
    let reach = if water == Water::River { RIVER } else { BASIN };
    let (along, off, turn): (f64, Vector2, f64) = match rank % 4 {
        0 => (size.x, Vector2::new(0.0, -size.y * 0.5 - SHORE - reach * 0.5), 0.0),
        1 => (size.y, Vector2::new(size.x * 0.5 + SHORE + reach * 0.5, 0.0), std::f64::consts::FRAC_PI_2),
        2 => (size.x, Vector2::new(0.0, size.y * 0.5 + SHORE + reach * 0.5), 0.0),
        _ => (size.y, Vector2::new(-size.x * 0.5 - SHORE - reach * 0.5, 0.0), std::f64::consts::FRAC_PI_2),
    };
    let name = match water {
        Water::Harbour => "Harbour",
        Water::River => "River",
        Water::Lake => "Lake",
    };
    let size = Vector2::new(if water == Water::Lake { along * 0.6 } else { along }, reach);
    Some(Area { name: name.to_owned(), used_as: water.as_str(), middle: middle + off, size, facing: turn })
}
