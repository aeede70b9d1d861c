//! A city: streets, buildings and street elements, and the way they enter a world.

use std::sync::Arc;

use simworld_core::geometry::{Obb, Point2, Point3, Vector2, heading, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::net::{Crossing, RoadNetwork, StreetPlan};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World, WorldError};
use simworld_core::seed::Seed;

use crate::building::{self, Building};
use crate::element::{self, Element, Setting};
use crate::lot::Land;
use crate::occupancy::Occupancy;
use crate::strips::{lane_reach, strip};
use crate::zoning::Zoning;
use crate::{CityConfig, CityError, CityReport, Provenance, RoadSource};

/// Tops of the flat layers, m: a hair apart, so that each covers the one below; people stand on the sidewalk's.
const GROUND_TOP: f64 = -0.03;
const ROAD_TOP: f64 = -0.02;
const CROSSWALK_TOP: f64 = -0.01;
const SIDEWALK_TOP: f64 = 0.0;
/// Thickness of the flat layers, m.
const LAYER: f64 = 0.05;
/// Distance of a signal post from the kerb and from its crossing, m.
const POST_SETBACK: f64 = 0.35;
/// Ground beyond the outermost street, m.
const MARGIN: f64 = 120.0;

/// A generated city.
#[derive(Clone, Debug, PartialEq)]
pub struct City {
    /// What it was made from.
    pub config: CityConfig,
    /// Its seed, and the place that it is, if it is one.
    pub provenance: Provenance,
    /// Centrelines and junctions.
    pub plan: StreetPlan,
    /// Lanes, crossings, signals and all else that follows from the plan.
    pub network: Arc<RoadNetwork>,
    /// Buildings, road by road.
    pub buildings: Vec<Building>,
    /// Street elements, sidewalk by sidewalk.
    pub elements: Vec<Element>,
    pub(crate) frontage: f64,
    pub(crate) frontage_used: f64,
}

/// The entities that a city became.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CityEntities {
    /// One a building, in the order of [`City::buildings`].
    pub buildings: Vec<EntityId>,
    /// The other solids of buildings of more than one: rear wings, towers; in the order of [`City::buildings`].
    pub wings: Vec<EntityId>,
    /// One an element, in the order of [`City::elements`].
    pub elements: Vec<EntityId>,
    /// Ground, roads, sidewalks and crosswalks.
    pub surfaces: Vec<EntityId>,
    /// One post a signalised leg of an intersection, in the order of the network's crossings.
    pub signals: Vec<EntityId>,
}

impl City {
    /// Grows a city. The same configuration and seed give the same city, bit for bit.
    ///
    /// ```
    /// use simworld_citygen::{City, CityConfig};
    /// use simworld_core::seed::Seed;
    /// let city = City::generate(&CityConfig::with_roads(12), Seed(7))?;
    /// assert!(city.network.roads.len() >= 12);
    /// assert_eq!(city, City::generate(&CityConfig::with_roads(12), Seed(7))?);
    /// # Ok::<(), simworld_citygen::CityError>(())
    /// ```
    ///
    /// # Errors
    /// A setting out of range.
    pub fn generate(config: &CityConfig, seed: Seed) -> Result<Self, CityError> {
        Self::from_source(&config.roads, config, seed)
    }

    /// Builds a city on the streets of any source.
    ///
    /// # Errors
    /// A setting out of range, or what the source cannot do.
    pub fn from_source(source: &dyn RoadSource, config: &CityConfig, seed: Seed) -> Result<Self, CityError> {
        config.validate()?;
        Self::from_plan(source.streets(seed)?, config, seed)
    }

    /// Builds a city on streets from elsewhere.
    ///
    /// # Errors
    /// A setting out of range, or streets that cannot be built.
    pub fn from_plan(plan: StreetPlan, config: &CityConfig, seed: Seed) -> Result<Self, CityError> {
        config.validate()?;
        let network = RoadNetwork::derive(&plan, &config.network)?;
        let mut taken = Occupancy::of_roads(&network);
        let zoning = Zoning::new(&config.zoning, seed);
        let land = Land::of_network(&network, &zoning, &config.lots, seed, &taken);
        let built = building::build(&network, &land, &config.buildings, seed, &mut taken);
        let setting = Setting {
            plan: &plan,
            network: &network,
            zoning: &zoning,
            land: &land,
            buildings: &built.buildings,
        };
        let elements = element::furnish(&setting, &config.elements, seed, &mut taken);
        Ok(Self {
            config: config.clone(),
            provenance: Provenance::of_seed(seed),
            plan,
            network: Arc::new(network),
            buildings: built.buildings,
            elements,
            frontage: land.frontage,
            frontage_used: built.frontage_used,
        })
    }

    /// Share of the frontage that buildings take, in [0, 1].
    pub fn frontage_used(&self) -> f64 {
        if self.frontage > 0.0 { self.frontage_used / self.frontage } else { 0.0 }
    }

    /// The blocks, lots and greens between its streets. They follow from the streets, the configuration and the seed, and
    /// are divided anew by each call.
    pub fn land(&self) -> Land {
        let seed = self.provenance.seed;
        let zoning = Zoning::new(&self.config.zoning, seed);
        Land::of_network(&self.network, &zoning, &self.config.lots, seed, &Occupancy::of_roads(&self.network))
    }

    /// The statistics of the city.
    pub fn report(&self) -> CityReport {
        CityReport::of(self)
    }

    /// The map as an SVG document; build a [`map::MapDrawing`](crate::map::MapDrawing) to draw more on it.
    pub fn svg(&self) -> String {
        crate::map::MapDrawing::of(self).to_string()
    }

    /// Puts the city into a world: surfaces, buildings and elements as entities, and the roads.
    ///
    /// # Errors
    /// The world refused an entity.
    pub fn populate(&self, world: &mut World) -> Result<CityEntities, WorldError> {
        world.set_roads(Arc::clone(&self.network));
        let mut entities = CityEntities::default();
        self.spawn_surfaces(world, &mut entities.surfaces)?;
        for building in &self.buildings {
            let mut solids = building.solids();
            let Some(front) = solids.next() else { continue };
            entities.buildings.push(world.spawn(describe_building(building, &front))?);
            for wing in solids {
                entities.wings.push(world.spawn(describe_solid(building, &wing))?);
            }
        }
        for element in &self.elements {
            entities.elements.push(world.spawn(describe_element(element))?);
        }
        for crossing in self.network.crossings.iter().filter(|crossing| crossing.signal.is_some()) {
            entities.signals.push(world.spawn(describe_signal(crossing))?);
        }
        Ok(entities)
    }

    fn spawn_surfaces(&self, world: &mut World, spawned: &mut Vec<EntityId>) -> Result<(), WorldError> {
        let network = &self.network;
        if let Some((low, high)) = network.bounds() {
            let (a, b) =
                (Point2::new(low.x, (low.y + high.y) * 0.5), Point2::new(high.x, (low.y + high.y) * 0.5));
            let half = (high.y - low.y) * 0.5 + MARGIN;
            spawned.push(world.spawn(layer(
                EntityKind::Ground,
                &Stripe { a, b, half, extend: MARGIN },
                GROUND_TOP,
            ))?);
        }
        for road in &network.roads {
            let half = lane_reach(road);
            // Beyond its ends a road reaches as far as it is wide, and so covers its junctions.
            for piece in road.centerline.windows(2) {
                let stripe = Stripe { a: piece[0], b: piece[1], half, extend: half };
                spawned.push(world.spawn(layer(EntityKind::Road, &stripe, ROAD_TOP))?);
            }
        }
        for crossing in &network.crossings {
            let stripe =
                Stripe { a: crossing.start, b: crossing.end, half: crossing.width * 0.5, extend: 0.0 };
            spawned.push(world.spawn(layer(EntityKind::Crosswalk, &stripe, CROSSWALK_TOP))?);
        }
        let width = network.sidewalks.first().map_or(0.0, |sidewalk| sidewalk.width);
        let walks = network.sidewalks.iter().map(|sidewalk| &sidewalk.path);
        let corners = network.intersections.iter().flat_map(|intersection| &intersection.corners);
        for path in walks.chain(corners) {
            for piece in path.windows(2).filter(|piece| (piece[1] - piece[0]).norm() > 0.01) {
                let stripe = Stripe { a: piece[0], b: piece[1], half: width * 0.5, extend: 0.0 };
                spawned.push(world.spawn(layer(EntityKind::Sidewalk, &stripe, SIDEWALK_TOP))?);
            }
        }
        Ok(())
    }
}

/// A rectangle along a line.
struct Stripe {
    a: Point2,
    b: Point2,
    half: f64,
    extend: f64,
}

fn layer(kind: EntityKind, stripe: &Stripe, top: f64) -> EntityDesc {
    let mut flat = strip(stripe.a, stripe.b, stripe.half, stripe.half, stripe.extend);
    flat.pose.translation.z = top - LAYER;
    let size = flat.half_extents * 2.0;
    EntityDesc::new(kind, flat.pose, Shape::cuboid(size.x.max(0.01), size.y.max(0.01), LAYER))
}

fn describe_building(building: &Building, front: &Obb) -> EntityDesc {
    let mut desc = describe_solid(building, front)
        .used_as(building.place)
        .accessed_at(Point3::new(building.access.x, building.access.y, 0.0))
        .with("storeys", i64::from(building.storeys))
        .with("roof", building.roof.as_str());
    desc.info.name.clone_from(&building.name);
    desc
}

fn describe_solid(building: &Building, solid: &Obb) -> EntityDesc {
    let mut pose = solid.pose;
    pose.translation.z = 0.0;
    let size = solid.half_extents * 2.0;
    EntityDesc::new(EntityKind::Building, pose, Shape::cuboid(size.x, size.y, size.z))
        .colored(building.archetype.color)
        .with("type", building.archetype.name)
}

/// A post at the kerb that vehicles pass on their right, beyond the crossing; it looks at those who come.
fn describe_signal(crossing: &Crossing) -> EntityDesc {
    let across = (crossing.end - crossing.start).normalize();
    let outwards = Vector2::new(-across.y, across.x);
    let at = crossing.start - across * POST_SETBACK + outwards * (crossing.width * 0.5 + POST_SETBACK);
    let pose = pose_facing(Point3::new(at.x, at.y, 0.0), heading(&outwards));
    EntityDesc::new(EntityKind::TrafficSignal, pose, Shape::Cylinder { radius: 0.08, height: 3.5 })
}

fn describe_element(element: &Element) -> EntityDesc {
    let pose = pose_facing(Point3::new(element.position.x, element.position.y, 0.0), element.facing);
    let desc = EntityDesc::new(element.kind, pose, element.shape);
    if element.kind.is_vehicle() {
        desc.with("parked", true).colored(car_color(element))
    } else if element.kind.is_seat() {
        // One sits down from the front.
        desc.accessed_at(pose * Point3::new(element.shape.size().x * 0.5 + 0.6, 0.0, 0.0))
    } else {
        desc
    }
}

/// The paint of a parked car, linear-light sRGB: a function of where it stands.
fn car_color(element: &Element) -> [f32; 3] {
    const PAINTS: [[f32; 3]; 6] = [
        [0.6, 0.6, 0.62],
        [0.03, 0.03, 0.035],
        [0.8, 0.8, 0.8],
        [0.05, 0.12, 0.3],
        [0.35, 0.03, 0.03],
        [0.16, 0.18, 0.17],
    ];
    let decimetres = (element.position.x * 10.0) as i64 ^ (element.position.y * 10.0) as i64;
    PAINTS[decimetres.rem_euclid(PAINTS.len() as i64) as usize]
}
