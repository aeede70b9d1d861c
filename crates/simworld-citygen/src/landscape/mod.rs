//! Places beyond the city, from a [`SceneSpec`]: countryside, wilderness, islands, with land that rises and falls, water, woods,
//! fields, ways for walkers, and houses where they are asked for.
//!
//! World frame, metres; the water stands at 0. Ways, pads under houses and streets are cut into the land before it is finished,
//! so that one [`Ground`] is what everybody stands on.

mod draft;
mod error;
mod green;
mod grid;
mod lots;
mod plants;
mod relief;
mod roads;
mod sites;
mod surface;
mod trails;
mod wishes;

use std::sync::Arc;

use simworld_core::asset::{Asset, Catalogue};
use simworld_core::environment::Environment;
use simworld_core::geometry::{Point2, Point3, Pose, Vector2, pose_facing};
use simworld_core::ground::Ground;
use simworld_core::id::{AssetId, EntityId};
use simworld_core::net::RoadNetwork;
use simworld_core::scene::{EntityDesc, EntityKind, Place, Scene, Shape, World, WorldError};
use simworld_core::seed::Seed;
use simworld_core::spec::{SceneKind, SceneSpec, SpecError};

pub use error::LandscapeError;
pub use plants::FOREST;
pub use trails::{TRAIL_GRADE, TRAIL_WIDTH};

use crate::populate::{Parts, Scope};
use crate::terrain::{self, HeightField};

/// Pavements lie so high above the ground under them, m: a hair, so that they are seen.
const PAVED: f64 = 0.035;
/// Thickness of water and open ground as entities, m.
const LAYER: f64 = 0.02;

/// A place beyond the city.
#[derive(Clone, Debug, PartialEq)]
pub struct Landscape {
    /// What kind of place.
    pub kind: SceneKind,
    /// The land.
    pub ground: Arc<Ground>,
    /// Its roads, and its ways for walkers alone.
    pub network: Arc<RoadNetwork>,
    /// Houses and landmarks, then what grows and lies about.
    pub things: Vec<Thing>,
    /// Water, squares and parks.
    pub areas: Vec<Sheet>,
    /// Sun and weather.
    pub environment: Environment,
}

/// Something that stands on the land.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// The asset of the library.
    pub asset: String,
    /// World from body, m.
    pub pose: Pose,
    /// How large it is beside its asset.
    pub scale: f64,
    /// What it is called.
    pub name: Option<String>,
    /// What it is used for, where that is another use than its asset's.
    pub place: Option<Place>,
    /// Where one stands to use it, m.
    pub access: Option<Point3>,
}

/// Level ground or water with a use and a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// What it is called.
    pub name: String,
    /// What it is: `sea`, `lake`, `river`, `square` or `park`; the value of the attribute `area` of its entity.
    pub used_as: &'static str,
    /// The middle of its surface, m. Land that is higher lies over it.
    pub middle: Point3,
    /// Along and across, m.
    pub size: Vector2,
    /// Direction of its first side, radians from east.
    pub facing: f64,
    /// Where one stands beside it, m.
    pub access: Option<Point3>,
}

/// The entities that a place became.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LandscapeEntities {
    /// One a thing, in the order of [`Landscape::things`].
    pub things: Vec<EntityId>,
    /// The land, the pavements, then one a sheet.
    pub surfaces: Vec<EntityId>,
}

impl Landscape {
    /// Makes what is asked for: what is counted in the spec is so in the result. The same spec and seed give the same place, bit
    /// for bit.
    ///
    /// ```
    /// use simworld_citygen::landscape::Landscape;
    /// use simworld_core::seed::Seed;
    /// use simworld_core::spec::{SceneKind, SceneSpec};
    /// let spec = SceneSpec { kind: SceneKind::Wilderness, ..SceneSpec::default() };
    /// let place = Landscape::build(&spec, Seed(7))?;
    /// let hut = place.things.iter().find(|thing| thing.name.as_deref() == Some("Hut")).unwrap();
    /// let under = place.ground.height(hut.pose.translation.vector.xy().into());
    /// assert!((under - hut.pose.translation.z).abs() < 0.05);
    /// # Ok::<(), simworld_citygen::landscape::LandscapeError>(())
    /// ```
    ///
    /// # Errors
    /// A spec out of range, a city, something that such a place does not have, or more than finds room.
    pub fn build(spec: &SceneSpec, seed: Seed) -> Result<Self, LandscapeError> {
        draft::build(spec, seed)
    }

    /// Puts the place into a world, with its ground, its ways, its sun and its weather.
    ///
    /// # Errors
    /// The world refused an entity, or the weather is out of range.
    pub fn populate(&self, world: &mut World) -> Result<LandscapeEntities, LandscapeError> {
        world.set_ground(Arc::clone(&self.ground));
        world.set_roads(Arc::clone(&self.network));
        let mut entities = LandscapeEntities::default();
        let (asset, pose) = surface::asset(&self.ground);
        let id = present_or_new(asset.clone(), world)?;
        entities.surfaces.push(world.spawn(asset.at(id, pose))?);
        let paved = Paved(&self.ground);
        let parts = Parts {
            heights: &terrain::Ground::of_land(&paved),
            network: &self.network,
            buildings: &[],
            elements: &[],
            scope: Scope::All,
            ground: None,
            rows: None,
            margin: 0.0,
        };
        entities.surfaces.extend(parts.spawn(world)?.surfaces);
        for sheet in &self.areas {
            entities.surfaces.push(world.spawn(sheet.desc())?);
        }
        let library = Catalogue::library();
        for thing in &self.things {
            let asset = library.find(&thing.asset).and_then(|id| library.get(id));
            let asset = asset.ok_or_else(|| LandscapeError::Landmark { name: thing.asset.clone() })?;
            let id = present_or_new(asset.clone(), world)?;
            entities.things.push(world.spawn(thing.desc(asset, id))?);
        }
        world.set_environment(self.environment).map_err(SpecError::from)?;
        Ok(entities)
    }

    /// The houses and landmarks among its things.
    pub fn buildings(&self) -> impl Iterator<Item = &Thing> {
        let library = Catalogue::library();
        self.things.iter().filter(move |thing| {
            let asset = library.find(&thing.asset).and_then(|id| library.get(id));
            asset.is_some_and(|asset| asset.kind == EntityKind::Building)
        })
    }
}

/// The world's own asset of that name, or this one, which it then has.
pub(crate) fn present_or_new(asset: Asset, world: &mut World) -> Result<AssetId, WorldError> {
    match world.assets().and_then(|assets| assets.find(&asset.name)) {
        Some(id) => Ok(id),
        None => Ok(world.add_asset(asset)?),
    }
}

impl Thing {
    fn desc(&self, asset: &Asset, id: AssetId) -> EntityDesc {
        let mut desc = asset.at(id, self.pose);
        desc.info.shape = scaled(&desc.info.shape, self.scale);
        desc.info.mass = desc.info.mass.map(|mass| mass * self.scale * self.scale * self.scale);
        desc.info.name.clone_from(&self.name);
        desc.info.place = self.place.or(desc.info.place);
        accessible(desc, self.access)
    }
}

fn accessible(desc: EntityDesc, access: Option<Point3>) -> EntityDesc {
    match access {
        Some(point) => desc.accessed_at(point),
        None => desc,
    }
}

/// A shape that much larger in all three directions.
pub(crate) fn scaled(shape: &Shape, scale: f64) -> Shape {
    match *shape {
        Shape::Box { size } => Shape::Box { size: size * scale },
        Shape::Cylinder { radius, height } => {
            Shape::Cylinder { radius: radius * scale, height: height * scale }
        }
        Shape::Sphere { radius } => Shape::Sphere { radius: radius * scale },
        other => other,
    }
}

impl Sheet {
    fn desc(&self) -> EntityDesc {
        let color = match self.used_as {
            "park" => [0.12, 0.24, 0.07],
            "square" => [0.42, 0.36, 0.28],
            _ => [0.035, 0.13, 0.2],
        };
        let below = Point3::new(self.middle.x, self.middle.y, self.middle.z - LAYER);
        let shape = Shape::cuboid(self.size.x, self.size.y, LAYER);
        let desc = EntityDesc::new(EntityKind::Ground, pose_facing(below, self.facing), shape)
            .named(self.name.as_str())
            .with("area", self.used_as)
            .colored(color);
        accessible(desc, self.access)
    }
}

/// The land a hair higher, where pavements lie.
struct Paved<'a>(&'a Ground);

impl HeightField for Paved<'_> {
    fn height(&self, point: Point2) -> f64 {
        self.0.height(point) + PAVED
    }
}
