//! The way of a city into a world: surfaces, buildings and street elements as entities, each made from an asset.

mod assets;
mod bridges;
mod footbridges;
mod ground;
mod plazas;
mod scope;

use std::sync::Arc;

use assets::Assets;
pub(crate) use footbridges::{PIER, RAILING};
pub(crate) use scope::{Scope, Touched};
use simworld_core::geometry::{Obb, Point2, Point3, Pose, Vector2, heading, pose_facing};
use simworld_core::id::{AssetId, EntityId};
use simworld_core::net::{Crossing, DrivingSide, RoadNetwork, Side, polyline};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World, WorldError};

use crate::City;
use crate::building::Building;
use crate::element::Element;
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
/// Longest strip of a way for walkers alone on hills, m.
const CLIMB: f64 = 10.0;
/// Ground beyond the outermost street, m.
pub(crate) const MARGIN: f64 = 120.0;

/// The entities that a city became.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CityEntities {
    /// One a building, in the order of [`City::buildings`]; behind these the landmarks of a
    /// [`Settlement`](crate::settlement::Settlement).
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
            scope: Scope::All,
            ground: self.network.bounds(),
            rows: None,
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
    /// The part of the network that is meant.
    pub(crate) scope: Scope<'a>,
    /// The rectangle of the ground, least and greatest corner, and how far the ground goes on beyond it, m.
    pub(crate) ground: Option<(Point2, Point2)>,
    pub(crate) margin: f64,
    /// From where to where northwards plates of hilly ground are meant, m; all of them if it is not said.
    pub(crate) rows: Option<(f64, f64)>,
}

impl Parts<'_> {
    /// Spawns all of it.
    pub(crate) fn spawn(&self, world: &mut World) -> Result<CityEntities, WorldError> {
        let mut assets = Assets::new();
        let mut entities = CityEntities::default();
        for desc in self.surfaces() {
            entities.surfaces.push(world.spawn(desc)?);
        }
        for building in self.buildings {
            let asset = assets.of_building(building.archetype, world)?;
            let mut solids = self.building(building, asset).into_iter();
            let Some(front) = solids.next() else { continue };
            entities.buildings.push(world.spawn(front)?);
            for wing in solids {
                entities.wings.push(world.spawn(wing)?);
            }
        }
        for element in self.elements {
            let asset = assets.of_kind(element.kind, world)?;
            entities.elements.push(world.spawn(self.element(element, asset))?);
        }
        let asset = assets.of_kind(EntityKind::TrafficSignal, world)?;
        for desc in self.signals(asset) {
            entities.signals.push(world.spawn(desc)?);
        }
        Ok(entities)
    }

    /// All of it as recipes of entities.
    pub(crate) fn describe(&self, world: &mut World) -> Result<Vec<EntityDesc>, WorldError> {
        let mut assets = Assets::new();
        let mut descs = self.surfaces();
        for building in self.buildings {
            let asset = assets.of_building(building.archetype, world)?;
            descs.extend(self.building(building, asset));
        }
        for element in self.elements {
            let asset = assets.of_kind(element.kind, world)?;
            descs.push(self.element(element, asset));
        }
        let asset = assets.of_kind(EntityKind::TrafficSignal, world)?;
        descs.extend(self.signals(asset));
        Ok(descs)
    }

    /// The solids of a building, the one with the entrance first.
    fn building(&self, building: &Building, asset: AssetId) -> Vec<EntityDesc> {
        // Its threshold is level with the sidewalk.
        let base = self.heights.height(building.access);
        let solids = building.solids().enumerate().map(|(rank, solid)| match rank {
            0 => describe_building(building, &solid, asset),
            _ => describe_solid(building, &solid, asset),
        });
        solids.map(|desc| lifted(desc, base)).collect()
    }

    fn element(&self, element: &Element, asset: Option<AssetId>) -> EntityDesc {
        let mut desc = describe_element(element);
        if element.kind.is_seat() {
            let before = self.before_seat(element, &desc.pose);
            desc = desc.accessed_at(before);
        }
        desc.info.asset = asset;
        lifted(desc, self.heights.height(element.position))
    }

    /// Where one stands to sit down: before a bench; beside a chair, which has its table before it, towards the sidewalk.
    fn before_seat(&self, seat: &Element, pose: &Pose) -> Point3 {
        let size = seat.shape.size();
        let before = Point3::new(size.x * 0.5 + 0.6, 0.0, 0.0);
        let walk =
            seat.along.as_street().filter(|_| seat.kind == EntityKind::Chair).and_then(|(road, side)| {
                let walks = self.network.roads.get(road.index())?.sidewalks;
                let id = walks[usize::from(side == Side::Right)]?;
                let path = &self.network.sidewalks.get(id.index())?.path;
                let station = polyline::closest(path, &seat.position)?.station;
                Some(polyline::at(path, station).0)
            });
        let spot = walk.map_or(before, |walk| {
            let local = pose.inverse_transform_point(&Point3::new(walk.x, walk.y, 0.0));
            Point3::new(0.0, (size.y * 0.5 + 0.4).copysign(local.y), 0.0)
        });
        pose * spot
    }

    fn signals(&self, asset: Option<AssetId>) -> Vec<EntityDesc> {
        let signalled = self.crossings().filter(|crossing| crossing.signal.is_some());
        let described = signalled.map(|crossing| {
            let mut desc = describe_signal(crossing, self.network.driving_side);
            desc.info.asset = asset;
            let at = desc.pose.translation.vector.xy();
            lifted(desc, self.heights.height(at.into()))
        });
        described.collect()
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

    /// Ground, roads, bridges, crosswalks and sidewalks.
    fn surfaces(&self) -> Vec<EntityDesc> {
        let mut descs = Vec::new();
        self.plates(&mut descs);
        for (_, road) in self.roads().filter(|(_, road)| road.level <= 0) {
            let half = lane_reach(road);
            // Beyond its ends a road reaches as far as it is wide, and so covers its junctions.
            for piece in road.centerline.windows(2) {
                let stripe = Stripe { a: piece[0], b: piece[1], half, extend: half };
                descs.push(self.layer(EntityKind::Road, &stripe, ROAD_TOP));
            }
        }
        self.bridges(&mut descs);
        self.room_to_turn(&mut descs);
        for crossing in self.crossings() {
            let stripe =
                Stripe { a: crossing.start, b: crossing.end, half: crossing.width * 0.5, extend: 0.0 };
            descs.push(self.layer(EntityKind::Crosswalk, &stripe, CROSSWALK_TOP));
        }
        for (path, width) in self.walkways() {
            self.walk(path, width, &mut descs);
        }
        self.plazas(&mut descs);
        for way in self.footpaths().filter(|way| way.plaza.is_none()) {
            if self.heights.is_level() {
                self.walk(&way.path, way.width, &mut descs);
            } else {
                // Away from streets the ground rises and falls on the way.
                self.walk(&in_pieces(&way.path, CLIMB), way.width, &mut descs);
            }
        }
        self.footbridges(&mut descs);
        descs
    }

    /// The strips of a way for walkers.
    fn walk(&self, path: &[Point2], width: f64, descs: &mut Vec<EntityDesc>) {
        for piece in path.windows(2).filter(|piece| (piece[1] - piece[0]).norm() > 0.01) {
            let stripe = Stripe { a: piece[0], b: piece[1], half: width * 0.5, extend: 0.0 };
            descs.push(self.layer(EntityKind::Sidewalk, &stripe, SIDEWALK_TOP));
        }
    }

    /// Turning circles, and the heads of hammerheads.
    fn room_to_turn(&self, descs: &mut Vec<EntityDesc>) {
        for place in self.intersections() {
            let circle = place.turning.map(|circle| {
                let middle = Point3::new(circle.center.x, circle.center.y, ROAD_TOP - LAYER);
                let disc = Shape::Cylinder { radius: circle.radius, height: LAYER };
                EntityDesc::new(EntityKind::Road, pose_facing(middle, 0.0), disc)
            });
            let head = place.hammerhead.map(|head| {
                let stripe = Stripe { a: head.tips[0], b: head.tips[1], half: head.width * 0.5, extend: 0.0 };
                layer(EntityKind::Road, &stripe, ROAD_TOP)
            });
            let found = circle.into_iter().chain(head);
            descs.extend(found.map(|desc| lifted(desc, self.heights.height(place.center))));
        }
    }
}

/// A line with as many points as no piece needs to be longer than so much, m.
fn in_pieces(path: &[Point2], longest: f64) -> Vec<Point2> {
    let mut points: Vec<Point2> = path.first().copied().into_iter().collect();
    for pair in path.windows(2) {
        let piece = pair[1] - pair[0];
        let count = (piece.norm() / longest).ceil().max(1.0);
        points.extend((1..=count as u32).map(|index| pair[0] + piece * (f64::from(index) / count)));
    }
    points
}

/// The same, so much higher.
fn lifted(mut desc: EntityDesc, height: f64) -> EntityDesc {
    desc.pose.translation.z += height;
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
    if element.kind.is_vehicle() { desc.with("parked", true).colored(car_color(element)) } else { desc }
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
