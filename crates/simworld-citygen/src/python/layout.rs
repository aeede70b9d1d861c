//! A whole layout read back: a city on its roads, with its own buildings and elements.
//!
//! A file says where a building stands, how large it is and what it is called, not what it looks like: a kind that is
//! not known becomes the one nearest to it in size. What overlaps a road or a neighbour is left out with a warning, as
//! much of what the release itself writes does.

use std::sync::Arc;

use simworld_core::geometry::{Point2, heading};
use simworld_core::net::RoadNetwork;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityKind, Shape};
use simworld_core::seed::Seed;
use thiserror::Error;

use super::files::Bounds;
use super::{BuildingRecord, BuildingsFile, ElementRecord, ElementsFile, FormatError, RoadsFile, Warning};
use crate::building::{ARCHETYPES, Archetype, Building, Footprint, RoofKind};
use crate::doors::Doors;
use crate::element::Element;
use crate::lot::Land;
use crate::occupancy::Occupancy;
use crate::zoning::Zoning;
use crate::{City, CityConfig, CityError, Provenance};

/// A building farther than this from every sidewalk has no way in, m.
const FARTHEST_DOOR: f64 = 80.0;
/// Sizes of a building and of an element, m.
const BUILDING_SIZE: (f64, f64) = (1.0, 500.0);
const ELEMENT_SIZE: (f64, f64) = (0.02, 50.0);
/// Height of an element of which the file says nothing, m; and of a tree.
const ELEMENT_HEIGHT: f64 = 1.0;
const TREE: Shape = Shape::Cylinder { radius: 0.2, height: 7.0 };

/// Why a layout is no city.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// A file that cannot be used.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// A city that cannot be.
    #[error(transparent)]
    City(#[from] CityError),
}

impl City {
    /// Builds a city from the files of a layout. The configuration says how wide streets are; nothing is added to what
    /// the files hold.
    ///
    /// ```
    /// use simworld_citygen::{City, CityConfig};
    /// use simworld_core::seed::Seed;
    /// let city = City::generate(&CityConfig::with_roads(6), Seed(7))?;
    /// let (roads, buildings, elements) = (city.roads_file(), city.buildings_file(), city.elements_file());
    /// let (again, warnings) =
    ///     City::from_layout(&roads, &buildings, &elements, &CityConfig::default(), Seed(7))?;
    /// assert!(again.buildings.len() > city.buildings.len() * 8 / 10, "{warnings:?}");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Roads that cannot be used, or a setting out of range.
    pub fn from_layout(
        roads: &RoadsFile,
        buildings: &BuildingsFile,
        elements: &ElementsFile,
        config: &CityConfig,
        seed: Seed,
    ) -> Result<(Self, Vec<Warning>), LayoutError> {
        config.validate()?;
        let (plan, mut warnings) = super::plan_from_roads(roads)?;
        let network = RoadNetwork::derive(&plan, &config.network).map_err(CityError::from)?;
        let zoning = Zoning::new(&config.zoning, seed);
        let mut taken = Occupancy::of_roads(&network);
        let land = Land::of_network(&network, &zoning, &config.lots, seed, &taken);
        let doors = Doors::of(&network, FARTHEST_DOOR);
        let mut built = Vec::with_capacity(buildings.buildings.len());
        for (index, record) in buildings.buildings.iter().enumerate() {
            match building(record, &network, &doors, &zoning)
                .filter(|building| taken.take(&building.outline()))
            {
                Some(building) => built.push(building),
                None => warnings.push(left_out("buildings", index)),
            }
        }
        let mut set = Vec::with_capacity(elements.elements.len());
        for (index, record) in elements.elements.iter().enumerate() {
            match element(record) {
                Some(element) => set.push(element),
                None => warnings.push(left_out("elements", index)),
            }
        }
        let city = Self {
            config: config.clone(),
            provenance: Provenance::of_seed(seed),
            plan,
            network: Arc::new(network),
            buildings: built,
            elements: set,
            frontage: land.frontage,
        };
        Ok((city, warnings))
    }
}

fn left_out(list: &str, index: usize) -> Warning {
    let message =
        format!("{list}[{index}] left out: its place or size is impossible, taken, or far from any sidewalk");
    Warning { road: None, message }
}

fn has_size(bounds: &Bounds, (least, most): (f64, f64)) -> bool {
    let fits = |x: f64| (least..=most).contains(&x);
    fits(bounds.width) && fits(bounds.height)
}

fn building(
    record: &BuildingRecord,
    network: &RoadNetwork,
    doors: &Doors,
    zoning: &Zoning,
) -> Option<Building> {
    let center = Point2::from(record.center);
    if !has_size(&record.bounds, BUILDING_SIZE) || !record.rotation.is_finite() {
        return None;
    }
    let door = doors.nearest(network, center)?;
    // Of the four sides the one that looks to the sidewalk has the entrance.
    let turned = record.rotation.to_radians();
    let to_street = heading(&(door.at - center));
    let quarter = std::f64::consts::FRAC_PI_2;
    let side = (wrap_angle(to_street - turned) / quarter).round();
    let (along, across) = (record.bounds.width, record.bounds.height);
    let (depth, width) = if side as i64 % 2 == 0 { (along, across) } else { (across, along) };
    let archetype = Archetype::from_name(&record.kind).unwrap_or_else(|| nearest_kind(width, depth));
    Some(Building {
        archetype,
        place: archetype.place,
        name: None,
        center,
        facing: wrap_angle(turned + side * quarter),
        width,
        depth,
        footprint: Footprint::Rectangle,
        storeys: archetype.storeys.0,
        roof: RoofKind::Flat,
        zone: zoning.zone(center),
        access: door.at,
        road: door.road,
        side: door.side,
        frontage: width,
        given: true,
    })
}

/// The kind whose middle size is nearest; the first of equals.
fn nearest_kind(width: f64, depth: f64) -> &'static Archetype {
    let middle = |(low, high): (f64, f64)| (low + high) * 0.5;
    let away = |kind: &Archetype| (middle(kind.width) - width).abs() + (middle(kind.depth) - depth).abs();
    ARCHETYPES.iter().min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(&ARCHETYPES[0])
}

fn element(record: &ElementRecord) -> Option<Element> {
    let position = Point2::from(record.center);
    let is_near = position.x.abs() <= 1e6 && position.y.abs() <= 1e6;
    if !is_near || !has_size(&record.bounds, ELEMENT_SIZE) || !record.rotation.is_finite() {
        return None;
    }
    let kind = kind_of(&record.kind);
    let shape = match kind {
        EntityKind::Tree => TREE,
        _ => Shape::cuboid(record.bounds.width, record.bounds.height, ELEMENT_HEIGHT),
    };
    Some(Element {
        kind,
        position,
        facing: wrap_angle(record.rotation.to_radians()),
        shape,
        along: crate::block::Border::LAND,
    })
}

/// Words in the names of the release's assets, and what they are here.
const ASSETS: [(&str, EntityKind); 12] = [
    ("tree", EntityKind::Tree),
    ("bench", EntityKind::Bench),
    ("couch", EntityKind::Bench),
    ("chair", EntityKind::Chair),
    ("table", EntityKind::Table),
    ("can", EntityKind::TrashBin),
    ("bin", EntityKind::TrashBin),
    ("hydrant", EntityKind::Hydrant),
    ("cone", EntityKind::Cone),
    ("mail", EntityKind::Mailbox),
    ("sign", EntityKind::Sign),
    ("lamp", EntityKind::StreetLamp),
];

fn kind_of(name: &str) -> EntityKind {
    let lower = name.to_lowercase();
    let known = EntityKind::from_name(&lower);
    let asset = || ASSETS.iter().find(|(word, _)| lower.contains(word)).map(|(_, kind)| *kind);
    known.or_else(asset).unwrap_or(EntityKind::Prop)
}
