//! `progen_world.json`: the world file of the Python release, one node a road, building and element.
//!
//! Its numbers are those of the layout files times a hundred: centimetres, degrees, y as the layout has it. The engine
//! that shows it has y to the right of x, and so shows the layout's mirror image, as it does for the release's own.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use simworld_core::ops;

use super::files::round;
use super::{BuildingsFile, ElementsFile, RoadRecord, RoadsFile, Xy};
use crate::City;

/// Centimetres a metre.
const CENTIMETRES: f64 = 100.0;
/// What the release calls a piece of road.
const ROAD: &str = "BP_Road1_C";
/// Length of that piece at scale 1, cm.
const ROAD_LENGTH: f64 = 20_000.0;
/// The release makes roads this much shorter and narrower, so that they do not reach through their junctions.
const ROAD_SHARE: (f64, f64) = (0.95, 0.9);
/// Height at which elements are set down, cm.
const ELEMENT_HEIGHT: f64 = 30.0;

/// `progen_world.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldFile {
    /// The map below.
    pub base_map: BaseMap,
    /// What stands on it.
    pub nodes: Vec<WorldNode>,
}

/// The map on which a world is set up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BaseMap {
    /// Its name.
    pub name: String,
    /// The program that shows it.
    pub env_bin: String,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
}

impl Default for BaseMap {
    /// That of the release.
    fn default() -> Self {
        Self {
            name: "map_1".to_owned(),
            env_bin: r"gym_citynav\\Binaries\\Win64\\gym_citynav.exe".to_owned(),
            width: 1000,
            height: 1000,
        }
    }
}

/// A thing of a world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldNode {
    /// `GEN_`, its type, and its number among the nodes.
    pub id: String,
    /// Its type.
    pub instance_name: String,
    /// Where and how it stands.
    pub properties: NodeProperties,
    /// The street it stands at.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub segment_assignment: Option<Value>,
    /// The building it stands at.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub building_assignment: Option<Value>,
}

/// Where and how a thing stands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NodeProperties {
    /// cm.
    pub location: Xyz,
    /// Degrees.
    pub orientation: Orientation,
    /// Times its own size.
    pub scale: Xyz,
}

/// Three numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Xyz {
    /// The first.
    pub x: f64,
    /// The second.
    pub y: f64,
    /// The third.
    pub z: f64,
}

/// Three angles, degrees.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Orientation {
    /// Nose up.
    pub pitch: f64,
    /// Turned in the plane, from x towards y.
    pub yaw: f64,
    /// On one side.
    pub roll: f64,
}

fn node(number: usize, kind: &str, name: &str, at: (Xy, f64), yaw: f64) -> WorldNode {
    let (Xy { x, y }, z) = at;
    WorldNode {
        id: format!("GEN_{kind}_{number}"),
        instance_name: name.to_owned(),
        properties: NodeProperties {
            location: Xyz { x: round(x * CENTIMETRES), y: round(y * CENTIMETRES), z },
            orientation: Orientation { pitch: 0.0, yaw: round(yaw), roll: 0.0 },
            scale: Xyz { x: 1.0, y: 1.0, z: 1.0 },
        },
        segment_assignment: None,
        building_assignment: None,
    }
}

fn road_node(number: usize, road: &RoadRecord) -> WorldNode {
    let (dx, dy) = (road.end.x - road.start.x, road.end.y - road.start.y);
    let middle = Xy { x: (road.start.x + road.end.x) * 0.5, y: (road.start.y + road.end.y) * 0.5 };
    let mut node = node(number, "Road", ROAD, (middle, 0.0), ops::atan2(dy, dx).to_degrees());
    let share = (dx * dx + dy * dy).sqrt() * CENTIMETRES / ROAD_LENGTH;
    node.properties.scale = Xyz { x: round(share * ROAD_SHARE.0), y: ROAD_SHARE.1, z: 1.0 };
    node
}

impl WorldFile {
    /// The world of a layout: roads first, then buildings, then elements.
    pub fn of_layout(roads: &RoadsFile, buildings: &BuildingsFile, elements: &ElementsFile) -> Self {
        let mut nodes: Vec<WorldNode> =
            roads.roads.iter().enumerate().map(|(number, road)| road_node(number, road)).collect();
        for building in &buildings.buildings {
            let kind = &building.kind;
            let mut node = node(nodes.len(), kind, kind, (building.center, 0.0), building.rotation);
            // Plain numbers always become a value.
            node.segment_assignment = serde_json::to_value(building.segment_assignment).ok();
            nodes.push(node);
        }
        for element in &elements.elements {
            let kind = &element.kind;
            let mut node = node(nodes.len(), kind, kind, (element.center, ELEMENT_HEIGHT), element.rotation);
            node.segment_assignment =
                element.segment_assignment.and_then(|street| serde_json::to_value(street).ok());
            node.building_assignment.clone_from(&element.building_assignment);
            nodes.push(node);
        }
        Self { base_map: BaseMap::default(), nodes }
    }

    /// The roads of a world, as `roads.json` holds them. A world does not say which of them are highways.
    pub fn roads(&self) -> RoadsFile {
        let road = |node: &WorldNode| {
            let NodeProperties { location, orientation, scale } = node.properties;
            let half = scale.x / ROAD_SHARE.0 * ROAD_LENGTH / CENTIMETRES * 0.5;
            let (sin, cos) = ops::sin_cos(orientation.yaw.to_radians());
            let (x, y) = (location.x / CENTIMETRES, location.y / CENTIMETRES);
            RoadRecord {
                start: Xy { x: round(x - half * cos), y: round(y - half * sin) },
                end: Xy { x: round(x + half * cos), y: round(y + half * sin) },
                is_highway: false,
            }
        };
        RoadsFile { roads: self.nodes.iter().filter(|node| node.instance_name == ROAD).map(road).collect() }
    }
}

impl City {
    /// The city as `progen_world.json` holds it.
    ///
    /// ```
    /// use simworld_citygen::{City, CityConfig};
    /// use simworld_core::seed::Seed;
    /// let city = City::generate(&CityConfig::with_roads(6), Seed(7))?;
    /// let world = city.world_file();
    /// assert_eq!(world.nodes[0].instance_name, "BP_Road1_C");
    /// assert_eq!(world.roads().roads.len(), city.roads_file().roads.len());
    /// # Ok::<(), simworld_citygen::CityError>(())
    /// ```
    pub fn world_file(&self) -> WorldFile {
        WorldFile::of_layout(&self.roads_file(), &self.buildings_file(), &self.elements_file())
    }
}
