//! The structures of the files.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, planar, yaw_of};
use simworld_core::net::{RoadClass, polyline};

use crate::City;

/// A point, m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Xy {
    /// East.
    pub x: f64,
    /// North.
    pub y: f64,
}

impl From<Point2> for Xy {
    fn from(point: Point2) -> Self {
        Self { x: round(point.x), y: round(point.y) }
    }
}

impl From<Xy> for Point2 {
    fn from(point: Xy) -> Self {
        Self::new(point.x, point.y)
    }
}

/// Four decimals, as the Python release writes them.
pub(super) fn round(x: f64) -> f64 {
    (x * 1e4).round() / 1e4
}

/// `roads.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RoadsFile {
    /// Straight pieces of road.
    pub roads: Vec<RoadRecord>,
}

/// A straight piece of road.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RoadRecord {
    /// One end.
    pub start: Xy,
    /// The other end.
    pub end: Xy,
    /// Whether it is for through traffic.
    #[serde(default)]
    pub is_highway: bool,
}

impl RoadsFile {
    /// Every centreline as straight pieces, none so short that a reader would take its ends for one.
    pub(super) fn of(city: &City) -> Self {
        let mut roads = Vec::new();
        for road in &city.network.roads {
            roads.extend(coarse(&road.centerline).windows(2).map(|piece| RoadRecord {
                start: piece[0].into(),
                end: piece[1].into(),
                is_highway: road.class != RoadClass::Local,
            }));
        }
        Self { roads }
    }
}

/// A line without the points that are nearer than this to one that is kept, m; its ends are kept.
fn coarse(line: &[Point2]) -> Vec<Point2> {
    const LEAST: f64 = 1.3 * super::clean::MERGE;
    let [first, inner @ .., last] = line else { return line.to_vec() };
    let mut kept = vec![*first];
    for point in inner {
        let before = kept[kept.len() - 1];
        if (point - before).norm() >= LEAST && (last - point).norm() >= LEAST {
            kept.push(*point);
        }
    }
    kept.push(*last);
    kept
}

/// A rectangle: `x`, `y` are its lower left corner before it is turned about its centre.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// West edge, unrotated, m.
    pub x: f64,
    /// South edge, unrotated, m.
    pub y: f64,
    /// Size along x, unrotated, m.
    pub width: f64,
    /// Size along y, unrotated, m.
    pub height: f64,
    /// Counter-clockwise, degrees.
    pub rotation: f64,
}

/// The street that something was assigned to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SegmentAssignment {
    /// One end.
    pub start: Xy,
    /// The other end.
    pub end: Xy,
    /// Its heading, degrees.
    #[serde(default)]
    pub angle: f64,
}

/// `buildings.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BuildingsFile {
    /// The buildings.
    pub buildings: Vec<BuildingRecord>,
}

/// A building.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BuildingRecord {
    /// The middle of its footprint.
    pub center: Xy,
    /// Counter-clockwise, degrees.
    pub rotation: f64,
    /// Its kind.
    #[serde(rename = "type")]
    pub kind: String,
    /// Its footprint.
    pub bounds: Bounds,
    /// The street it stands at.
    #[serde(default)]
    pub segment_assignment: Option<SegmentAssignment>,
}

impl BuildingsFile {
    pub(super) fn of(city: &City) -> Self {
        let record = |building: &crate::building::Building| {
            let rotation = building.facing.to_degrees();
            let line = &city.network.roads[building.road.index()].centerline;
            let angle = polyline::at(line, 0.0).1.to_degrees();
            BuildingRecord {
                center: building.center.into(),
                rotation: round(rotation),
                kind: building.archetype.name.to_owned(),
                bounds: bounds(building.center, building.depth, building.width, rotation),
                segment_assignment: Some(SegmentAssignment {
                    start: line[0].into(),
                    end: line[line.len() - 1].into(),
                    angle: round(angle),
                }),
            }
        };
        Self { buildings: city.buildings.iter().map(record).collect() }
    }
}

/// `elements.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ElementsFile {
    /// The street elements.
    pub elements: Vec<ElementRecord>,
}

/// A street element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ElementRecord {
    /// Its middle.
    pub center: Xy,
    /// Counter-clockwise, degrees.
    pub rotation: f64,
    /// Its kind.
    #[serde(rename = "type")]
    pub kind: String,
    /// Its footprint.
    pub bounds: Bounds,
    /// The street it stands at.
    #[serde(default)]
    pub segment_assignment: Option<SegmentAssignment>,
    /// The building it stands at.
    #[serde(default)]
    pub building_assignment: Option<serde_json::Value>,
}

impl ElementsFile {
    pub(super) fn of(city: &City) -> Self {
        let record = |element: &crate::element::Element| {
            let obb = element.obb();
            let rotation = yaw_of(&obb.pose).to_degrees();
            let center = planar(&obb.pose);
            ElementRecord {
                center: center.into(),
                rotation: round(rotation),
                kind: element.kind.as_str().to_owned(),
                bounds: bounds(center, obb.half_extents.x * 2.0, obb.half_extents.y * 2.0, rotation),
                segment_assignment: None,
                building_assignment: None,
            }
        };
        Self { elements: city.elements.iter().map(record).collect() }
    }
}

fn bounds(center: Point2, along_x: f64, along_y: f64, rotation: f64) -> Bounds {
    Bounds {
        x: round(center.x - along_x * 0.5),
        y: round(center.y - along_y * 0.5),
        width: round(along_x),
        height: round(along_y),
        rotation: round(rotation),
    }
}

/// `routes.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RoutesFile {
    /// The routes.
    pub routes: Vec<RouteRecord>,
}

/// A route.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RouteRecord {
    /// Where it begins.
    pub start: Xy,
    /// Where it ends.
    pub end: Xy,
    /// The points it passes.
    pub points: Vec<Xy>,
}
