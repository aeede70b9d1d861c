//! The way of a city into a world: surfaces, buildings and street elements as entities, each made from an asset.

mod assets;
mod bridges;

use std::sync::Arc;

use assets::Assets;
use simworld_core::geometry::{Obb, Point2, Point3, Vector2, heading, pose_facing};
use simworld_core::id::{AssetId, EntityId, RoadId};
use simworld_core::net::{Crossing, DrivingSide, RoadNetwork, Side};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World, WorldError};

use crate::City;
use crate::building::Building;
use crate::element::{Element, Extent};
use crate::strips::{lane_reach, strip};
use crate::terrain::Ground;

/// Tops of the flat layers, m: a hair apart, so that each covers the one below; people stand on the sidewalk's.
const GROUND_TOP: f64 = -0.03;
const ROAD_TOP: f64 = -0.02;
const CROSSWALK_TOP: f64 = -0.01;
const SIDEWALK_TOP: f64 = 0.0;
/// Thickness of the flat layers, m.
const LAYER: f64 = 0.05;
/// Distance of a signal post from the kerb and from its crossing, m.
const POST_SETBACK: f64 = 0.35;
/// Width of a plate of hilly ground, and its top: a little lower, for between its ends it is straight, m.
const PLATE: f64 = 30.0;
const PLATE_TOP: f64 = -0.35;
/// Ground beyond the outermost street, m.
const MARGIN: f64 = 120.0;

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
    /// Puts the city into a world: surfaces, buildings and elements as entities, and the roads. Every kind of building and
    /// element is an asset of the world; one that the world has already keeps its own look.
    ///
    /// # Errors
    /// The world refused an entity.
    pub fn populate(&self, world: &mut World) -> Result<CityEntities, WorldError> {
        world.set_roads(Arc::clone(&self.network));
        let land = self.terrain();
        let heights = Ground::new(&self.network, &land);
        let parts = Parts {
            heights: &heights,
            network: &self.network,
            buildings: &self.buildings,
            elements: &self.elements,
            within: None,
            ground: self.network.bounds(),
            margin: MARGIN,
        };
        parts.spawn(world)
    }
}

impl CityEntities {
    /// Every one of them.
    pub fn iter(&self) -> impl Iterator<Item = EntityId> + '_ {
        let Self { buildings, wings, elements, surfaces, signals } = self;
        [buildings, wings, elements, surfaces, signals].into_iter().flatten().copied()
    }

    /// Takes all of them out of the world; those that are gone already are no fault.
    pub fn leave(self, world: &mut World) {
        for id in self.iter() {
            // Who removed it before us had the right to.
            let _ = world.remove(id);
        }
    }
}

/// What is put into a world: a city, or a part of one.
pub(crate) struct Parts<'a> {
    pub(crate) heights: &'a Ground<'a>,
    pub(crate) network: &'a RoadNetwork,
    pub(crate) buildings: &'a [Building],
    pub(crate) elements: &'a [Element],
    /// The part of the network that is meant; all of it if nothing is said.
    pub(crate) within: Option<&'a Extent>,
    /// The rectangle of the ground, least and greatest corner, and how far the ground goes on beyond it, m.
    pub(crate) ground: Option<(Point2, Point2)>,
    pub(crate) margin: f64,
}

impl Parts<'_> {
    /// Spawns all of it.
    pub(crate) fn spawn(&self, world: &mut World) -> Result<CityEntities, WorldError> {
        let mut assets = Assets::new();
        let mut entities = CityEntities::default();
        self.spawn_surfaces(world, &mut entities.surfaces)?;
        for building in self.buildings {
            let mut solids = building.solids();
            let Some(front) = solids.next() else { continue };
            let asset = assets.of_building(building.archetype, world)?;
            // Its threshold is level with the sidewalk.
            let base = self.heights.height(building.access);
            entities.buildings.push(world.spawn(lifted(describe_building(building, &front, asset), base))?);
            for wing in solids {
                entities.wings.push(world.spawn(lifted(describe_solid(building, &wing, asset), base))?);
            }
        }
        for element in self.elements {
            let mut desc = describe_element(element);
            desc.info.asset = assets.of_kind(element.kind, world)?;
            let desc = lifted(desc, self.heights.height(element.position));
            entities.elements.push(world.spawn(desc)?);
        }
        for crossing in self.crossings().filter(|crossing| crossing.signal.is_some()) {
            let mut desc = describe_signal(crossing, self.network.driving_side);
            desc.info.asset = assets.of_kind(EntityKind::TrafficSignal, world)?;
            let at = desc.pose.translation.vector.xy();
            let desc = lifted(desc, self.heights.height(at.into()));
            entities.signals.push(world.spawn(desc)?);
        }
        Ok(entities)
    }

    fn has_road(&self, road: RoadId) -> bool {
        self.within.is_none_or(|extent| road.index() < extent.streets)
    }

    fn has_side(&self, road: RoadId, side: Side) -> bool {
        self.within.is_none_or(|extent| extent.has_side(road, side))
    }

    fn crossings(&self) -> impl Iterator<Item = &Crossing> {
        self.network.crossings.iter().filter(|crossing| self.has_road(crossing.road))
    }

    /// The walkways along streets and round corners.
    fn walkways(&self) -> impl Iterator<Item = &Vec<Point2>> {
        // Decks carry their own.
        let on_ground = |road: RoadId| self.network.roads[road.index()].level <= 0;
        let along = self.network.sidewalks.iter();
        let along = along.filter(move |walk| self.has_side(walk.road, walk.side) && on_ground(walk.road));
        let corners = self.network.intersections.iter().enumerate().flat_map(move |(index, place)| {
            let meant = move |rank: usize| {
                place.roads.get(rank).is_none_or(|road| {
                    // A corner begins on the left of its road, seen from the intersection.
                    let leaves = self.network.roads[road.index()].from.index() == index;
                    self.has_side(*road, if leaves { Side::Left } else { Side::Right })
                })
            };
            place.corners.iter().enumerate().filter(move |(rank, _)| meant(*rank)).map(|(_, corner)| corner)
        });
        along.map(|walk| &walk.path).chain(corners)
    }

    /// One level plate, or many that follow the hills.
    fn spawn_ground(&self, world: &mut World, spawned: &mut Vec<EntityId>) -> Result<(), WorldError> {
        let Some((low, high)) = self.ground else { return Ok(()) };
        if self.heights.is_level() {
            let middle = (low.y + high.y) * 0.5;
            let (a, b) = (Point2::new(low.x, middle), Point2::new(high.x, middle));
            let half = (high.y - low.y) * 0.5 + self.margin;
            let stripe = Stripe { a, b, half, extend: self.margin };
            spawned.push(world.spawn(layer(EntityKind::Ground, &stripe, GROUND_TOP))?);
            return Ok(());
        }
        let margin = Vector2::repeat(self.margin);
        let (low, high) = (low - margin, high + margin);
        let count = ((high - low) / PLATE).map(f64::ceil);
        for row in 0..count.y as u32 {
            let y = low.y + (f64::from(row) + 0.5) * PLATE;
            for column in 0..count.x as u32 {
                let x = low.x + f64::from(column) * PLATE;
                let stripe = Stripe {
                    a: Point2::new(x, y),
                    b: Point2::new(x + PLATE, y),
                    half: PLATE * 0.5,
                    extend: 0.0,
                };
                spawned.push(world.spawn(self.layer(EntityKind::Ground, &stripe, PLATE_TOP))?);
            }
        }
        Ok(())
    }

    /// A flat layer along a line, which rises as the ground does from one end to the other.
    fn layer(&self, kind: EntityKind, stripe: &Stripe, top: f64) -> EntityDesc {
        let mut desc = layer(kind, stripe, top);
        if self.heights.is_level() {
            return desc;
        }
        let (from, to) = (self.heights.height(stripe.a), self.heights.height(stripe.b));
        let (run, rise) = ((stripe.b - stripe.a).norm(), to - from);
        let climb = nalgebra::UnitQuaternion::from_axis_angle(
            &nalgebra::Vector3::y_axis(),
            -simworld_core::ops::atan2(rise, run),
        );
        desc.pose.translation.z += (from + to) * 0.5;
        desc.pose.rotation *= climb;
        let size = desc.info.shape.size();
        // As long as the slope is, so that it still reaches both ends.
        let length = size.x * (run * run + rise * rise).sqrt() / run.max(1e-6);
        desc.info.shape = Shape::cuboid(length, size.y, size.z);
        desc
    }

    fn spawn_surfaces(&self, world: &mut World, spawned: &mut Vec<EntityId>) -> Result<(), WorldError> {
        self.spawn_ground(world, spawned)?;
        for (index, road) in self.network.roads.iter().enumerate() {
            if !self.has_road(RoadId::from_index(index)) || road.level > 0 {
                continue;
            }
            let half = lane_reach(road);
            // Beyond its ends a road reaches as far as it is wide, and so covers its junctions.
            for piece in road.centerline.windows(2) {
                let stripe = Stripe { a: piece[0], b: piece[1], half, extend: half };
                spawned.push(world.spawn(self.layer(EntityKind::Road, &stripe, ROAD_TOP))?);
            }
        }
        self.spawn_bridges(world, spawned)?;
        for place in &self.network.intersections {
            let Some(circle) = place.turning.filter(|_| place.roads.iter().all(|road| self.has_road(*road)))
            else {
                continue;
            };
            let pose = pose_facing(Point3::new(circle.center.x, circle.center.y, ROAD_TOP - LAYER), 0.0);
            let disc = Shape::Cylinder { radius: circle.radius, height: LAYER };
            let desc = EntityDesc::new(EntityKind::Road, pose, disc);
            spawned.push(world.spawn(lifted(desc, self.heights.height(place.center)))?);
        }
        for crossing in self.crossings() {
            let stripe =
                Stripe { a: crossing.start, b: crossing.end, half: crossing.width * 0.5, extend: 0.0 };
            spawned.push(world.spawn(self.layer(EntityKind::Crosswalk, &stripe, CROSSWALK_TOP))?);
        }
        let width = self.network.sidewalks.first().map_or(0.0, |sidewalk| sidewalk.width);
        for path in self.walkways() {
            for piece in path.windows(2).filter(|piece| (piece[1] - piece[0]).norm() > 0.01) {
                let stripe = Stripe { a: piece[0], b: piece[1], half: width * 0.5, extend: 0.0 };
                spawned.push(world.spawn(self.layer(EntityKind::Sidewalk, &stripe, SIDEWALK_TOP))?);
            }
        }
        Ok(())
    }
}

/// The same, so much higher.
fn lifted(mut desc: EntityDesc, height: f64) -> EntityDesc {
    desc.pose.translation.z += height;
    if let Some(point) = &mut desc.info.access {
        point.z += height;
    }
    desc
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

fn describe_building(building: &Building, front: &Obb, asset: AssetId) -> EntityDesc {
    let mut desc = describe_solid(building, front, asset)
        .used_as(building.place)
        .accessed_at(Point3::new(building.access.x, building.access.y, 0.0))
        .with("storeys", i64::from(building.storeys))
        .with("roof", building.roof.as_str());
    desc.info.name.clone_from(&building.name);
    desc
}

fn describe_solid(building: &Building, solid: &Obb, asset: AssetId) -> EntityDesc {
    let mut pose = solid.pose;
    pose.translation.z = 0.0;
    let size = solid.half_extents * 2.0;
    let mut desc = EntityDesc::new(EntityKind::Building, pose, Shape::cuboid(size.x, size.y, size.z))
        .colored(building.archetype.color)
        .with("type", building.archetype.name);
    desc.info.asset = Some(asset);
    desc
}

/// A post at the kerb along which vehicles come, beyond the crossing; it looks at those who come.
fn describe_signal(crossing: &Crossing, driving_side: DrivingSide) -> EntityDesc {
    let across = (crossing.end - crossing.start).normalize();
    let outwards = Vector2::new(-across.y, across.x);
    let kerb = match driving_side {
        DrivingSide::Right => crossing.start - across * POST_SETBACK,
        DrivingSide::Left => crossing.end + across * POST_SETBACK,
    };
    let at = kerb + outwards * (crossing.width * 0.5 + POST_SETBACK);
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
