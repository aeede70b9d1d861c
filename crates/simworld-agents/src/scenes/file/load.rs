//! From a scene file to a world.

use std::collections::BTreeMap;

use simworld_core::asset::{Asset, Catalogue};
use simworld_core::clock::Clock;
use simworld_core::geometry::{Point2, Point3, Pose, Vector2, planar, pose_facing};
use simworld_core::id::{AssetId, EntityId};
use simworld_core::net::StreetPlan;
use simworld_core::scene::{EntityDesc, Scene, Shape, World, WorldError};
use simworld_core::seed::Seed;

use super::check::{MOST_THINGS, check, say_at};
use super::colour::Colour;
use super::error::{Fault, Problems, SceneFileError};
use super::facing::Facing;
use super::inspect::Standing;
use super::items::{COMPARED, Item, Supports, items, shortened};
use super::near::assets_like;
use super::place::{PlaceMaker, ground};
use super::scene::SceneFile;
use super::streets;
use crate::editing::{Edited, Make, SceneEditor, called_in, land_under, recipe_of};
use crate::retrieval::AssetIndex;

/// A scene that was loaded.
#[derive(Debug)]
pub struct Loaded {
    /// The scene.
    pub world: World,
    /// The entities of each row of things, in the order of [`SceneFile::things`].
    pub things: Vec<Vec<EntityId>>,
    /// What each sentence did, in the order of [`SceneFile::says`].
    pub said: Vec<Edited>,
    /// What is wrong with how things stand, which stand as they are written all the same: as it was before the first sentence.
    pub problems: Problems,
    /// Who said the sentences, and can take them back.
    pub editor: SceneEditor,
}

impl Loaded {
    /// The same, unless something is wrong with how things stand.
    ///
    /// # Errors
    /// All of what is wrong.
    pub fn sound(mut self) -> Result<Self, SceneFileError> {
        std::mem::take(&mut self.problems).none_or(self)
    }
}

impl SceneFile {
    /// Makes the scene: the place or the ground, the sky, every thing where it is written, and then what is said, in order. The same
    /// file, assets and maker of places give the same world, bit for bit.
    ///
    /// # Errors
    /// Everything at once that the file asks for and cannot be, of each row; a place that cannot be made. How things stand is no
    /// error: [`Loaded::problems`] has that.
    pub fn load(&self, catalogue: &Catalogue, places: &mut dyn PlaceMaker) -> Result<Loaded, SceneFileError> {
        self.load_with(SceneEditor::new(Seed(self.seed)).with_catalogue(catalogue.clone()), places)
    }

    /// As [`load`](Self::load), with an editor of one's own: its catalogue is what things are made from, and its reader and its
    /// generator do what they do for sentences. Then what is said follows from its seed too.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn load_with(
        &self,
        editor: SceneEditor,
        places: &mut dyn PlaceMaker,
    ) -> Result<Loaded, SceneFileError> {
        self.load_by(Clock::default(), editor, places)
    }

    /// As [`load_with`](Self::load_with), in a world with a clock of one's own.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn load_by(
        &self,
        clock: Clock,
        editor: SceneEditor,
        places: &mut dyn PlaceMaker,
    ) -> Result<Loaded, SceneFileError> {
        let mut problems = check(self);
        let count: u64 = self.things.iter().map(|thing| u64::from(thing.many())).sum();
        let items = if count <= MOST_THINGS { items(self) } else { Vec::new() };
        let supports = Supports::find(self, &items, &mut problems);
        let assets = self.assets(editor.catalogue(), &mut problems);
        let plan = streets::plan(self, &mut problems);
        let assets = problems.none_or(assets)?;
        let mut world = World::with_clock(clock);
        self.make_place(plan.as_ref(), places, &mut world)?;
        let ids = self.set_down(&items, &supports, &assets, &mut world)?;
        // They are the editor's.
        drop(assets);
        let ranks = ids.iter().enumerate().map(|(rank, id)| (*id, rank)).collect();
        let (scene, supports) = (self, &supports);
        let problems = Standing { scene, world: &world, items: &items, supports, ids: &ids, ranks }.inspect();
        let (said, editor) = self.say_all(editor, &mut world)?;
        let mut things = vec![Vec::new(); self.things.len()];
        for (item, id) in items.iter().zip(ids) {
            things[item.row].push(id);
        }
        Ok(Loaded { world, things, said, problems, editor })
    }

    /// The assets of the rows by their names; of those that are not there it is told what is like them.
    fn assets<'a>(&self, catalogue: &'a Catalogue, problems: &mut Problems) -> BTreeMap<String, &'a Asset> {
        let mut found = BTreeMap::new();
        let mut missing: BTreeMap<&str, Vec<String>> = BTreeMap::new();
        let mut index: Option<AssetIndex> = None;
        for thing in self.things.iter().take(MOST_THINGS as usize) {
            let name = thing.asset.as_str();
            if let Some(asset) = catalogue.find(name).and_then(|id| catalogue.get(id)) {
                found.insert(thing.asset.clone(), asset);
            } else if !missing.contains_key(name) && missing.len() < COMPARED {
                let index = index.get_or_insert_with(|| AssetIndex::of(catalogue));
                missing.insert(name, assets_like(&shortened(name), catalogue, index));
            }
        }
        for (row, thing) in self.things.iter().enumerate().take(MOST_THINGS as usize) {
            // An empty name was told of already.
            if found.contains_key(&thing.asset) || thing.asset.trim().is_empty() {
                continue;
            }
            let near = missing.get(thing.asset.as_str()).cloned().unwrap_or_default();
            let item = Item { thing, row, rank: 0, name: thing.name.clone() };
            problems.push(item.place(self), Fault::UnknownAsset { name: shortened(&thing.asset), near });
        }
        found
    }

    /// The place, its streets, or empty ground, and the sky over it.
    fn make_place(
        &self,
        plan: Option<&StreetPlan>,
        places: &mut dyn PlaceMaker,
        world: &mut World,
    ) -> Result<(), SceneFileError> {
        let seed = Seed(self.seed);
        if let Some(spec) = &self.place {
            let at = self.place_of(self.origin.0.place, "[place]");
            places.wishes(spec, seed, world).map_err(|error| SceneFileError::Place { at, error })?;
        } else if let Some(plan) = plan {
            let at = streets::at(self, 0);
            places.streets(plan, seed, world).map_err(|error| SceneFileError::Place { at, error })?;
        } else {
            let wish = self.ground.clone().unwrap_or_default();
            let half = Vector2::new(wish.size.x, wish.size.y) * 0.5;
            let color = wish.colour.map(Colour::linear);
            let desc = ground(Point2::from(-half), Point2::from(half), color);
            world.spawn(desc).map_err(|error| self.refused(self.origin.0.ground, "[ground]", error))?;
        }
        let Some(sky) = &self.environment else { return Ok(()) };
        let line = self.origin.0.environment;
        let sky = sky.environment().map_err(|fault| self.refused(line, "[environment]", fault))?;
        world.set_environment(sky).map_err(|error| self.refused(line, "[environment]", error))?;
        Ok(())
    }

    /// Puts every thing where it is written; gives their ids.
    fn set_down(
        &self,
        items: &[Item<'_>],
        supports: &Supports,
        assets: &BTreeMap<String, &Asset>,
        world: &mut World,
    ) -> Result<Vec<EntityId>, SceneFileError> {
        let refused = |item: &Item<'_>, error: WorldError| {
            let mut problems = Problems::default();
            problems.push(item.place(self), error);
            SceneFileError::Refused(problems)
        };
        let mut ids: BTreeMap<&str, AssetId> = BTreeMap::new();
        let mut descs: Vec<EntityDesc> = Vec::with_capacity(items.len());
        for item in items {
            let name = item.thing.asset.as_str();
            let asset = assets.get(name).expect("every asset was looked up before");
            let id = if let Some(id) = ids.get(name) {
                *id
            } else {
                let called = called_in(world, asset);
                world.add_asset(called).map_err(|error| refused(item, error.into()))?
            };
            ids.insert(name, id);
            descs.push(recipe_of(asset, id, &make_of(item)));
        }
        for index in &supports.order {
            let under = supports.under[*index].map(|under| (descs[under].pose, descs[under].info.shape));
            descs[*index].pose = pose_of(&items[*index], &descs[*index], under, world);
        }
        let spawn =
            |(item, desc): (&Item<'_>, EntityDesc)| world.spawn(desc).map_err(|error| refused(item, error));
        items.iter().zip(descs).map(spawn).collect()
    }

    /// Says every sentence; all that were not carried out are told of.
    fn say_all(
        &self,
        mut editor: SceneEditor,
        world: &mut World,
    ) -> Result<(Vec<Edited>, SceneEditor), SceneFileError> {
        let (mut said, mut problems) = (Vec::new(), Problems::default());
        for (row, say) in self.says.iter().enumerate() {
            if let Some(from) = say.from {
                editor = editor.looking_from(from.point());
            }
            match editor.say(&say.words, world) {
                Ok(edited) => said.push(edited),
                Err(answer) => {
                    let fault = Fault::Said { words: shortened(&say.words), answer: Box::new(answer) };
                    problems.push(say_at(self, row), fault);
                }
            }
        }
        problems.none_or((said, editor))
    }

    /// What the world refused, as an error.
    fn refused(&self, line: Option<usize>, row: &str, fault: impl Into<Fault>) -> SceneFileError {
        let mut problems = Problems::default();
        problems.push(self.place_of(line, row), fault);
        SceneFileError::Refused(problems)
    }
}

fn make_of(item: &Item<'_>) -> Make {
    let thing = item.thing;
    Make {
        asset: thing.asset.clone(),
        color: thing.colour.map(Colour::linear),
        scale: thing.scale.unwrap_or(1.0),
        name: item.name.clone(),
    }
}

/// Where a thing stands: at its point, at its height or on the top of what it stands on, or else on the ground.
fn pose_of(item: &Item<'_>, desc: &EntityDesc, under: Option<(Pose, Shape)>, world: &World) -> Pose {
    let thing = item.thing;
    let yaw = thing.facing.map_or(0.0, Facing::yaw);
    let middle = under.map_or_else(Point2::origin, |(pose, _)| planar(&pose));
    let first = thing.at.map_or(middle, |at| Point2::new(at.x, at.y));
    let step = thing.step.map_or_else(Vector2::zeros, |step| Vector2::new(step.x, step.y));
    let at = first + step * f64::from(item.rank);
    let top = under.map(|(pose, shape)| pose.translation.z + shape.size().z);
    let height = thing.at.and_then(|at| at.z).or(top).unwrap_or_else(|| match world.ground() {
        Some(land) => land_under(land, desc.kind, desc.info.shape, at, yaw).1,
        None => 0.0,
    });
    pose_facing(Point3::new(at.x, at.y, height), yaw)
}
