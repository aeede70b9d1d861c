//! Open ground: squares and parks between the streets, water beside the place.

use simworld_core::geometry::{Point2, Point3, Vector2, pose_facing};
use simworld_core::net::RoadNetwork;
use simworld_core::scene::{EntityDesc, EntityKind, Shape};
use simworld_core::spec::Water;

/// Between the outermost pavement and water, and how far water reaches, m.
const SHORE: f64 = 6.0;
const BASIN: f64 = 80.0;
const RIVER: f64 = 24.0;
/// The ground's top lies so far below a sidewalk's, and open ground a hair above it, m.
pub(super) const GROUND: f64 = -0.03;
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

/// What the streets cover: their kerbs, turning circles, hammerheads and sidewalks within.
fn paved(network: &RoadNetwork) -> Option<(Point2, Point2)> {
    let walk = network.sidewalks.iter().map(|walk| walk.width).fold(0.0, f64::max);
    let roads = network.roads.iter().flat_map(|road| {
        let reach = road.left_kerb.max(road.right_kerb);
        // A road ends in corners, which lie farther out than its sides.
        road.centerline.iter().map(move |point| (*point, reach * std::f64::consts::SQRT_2))
    });
    let circles = network.intersections.iter().filter_map(|place| place.turning);
    let heads = network.intersections.iter().filter_map(|place| place.hammerhead);
    let tips =
        heads.flat_map(|head| head.tips.map(|tip| (tip, head.width * std::f64::consts::FRAC_1_SQRT_2)));
    let discs = roads.chain(circles.map(|circle| (circle.center, circle.radius))).chain(tips);
    let ends = discs.map(|(point, reach)| {
        let out = Vector2::repeat(reach + walk);
        (point - out, point + out)
    });
    ends.reduce(|(low, high), (from, to)| (low.inf(&from), high.sup(&to)))
}

/// Water along one side: the first in the south, then east, north and west.
pub(super) fn shore(network: &RoadNetwork, water: Water, rank: usize) -> Option<Area> {
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
