//! Edits in a running world: the entities that an edit changed go and come by commands, all others stay.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::command::{Command, CommandError};
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::patch::ArrayPatch;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, World};

use super::index::now_at;
use super::patch::CityPatch;
use super::reach::{Reach, View};
use super::{CityEditor, EditError};
use crate::populate::{MARGIN, Parts, Scope, Touched};
use crate::terrain::Ground;
use crate::{City, CityEntities};

/// What an entity of a city looks like to a search: its kind, where it is, and a digest of all that is said of it.
type Key = (EntityKind, [u64; 3], u64);

/// The entities that a city became, found by what they are.
///
/// ```
/// use simworld_citygen::edit::{CityEdit, CityEditor, CityInWorld, NewStreet};
/// use simworld_citygen::{City, CityConfig};
/// use simworld_core::geometry::Point2;
/// use simworld_core::net::StreetPlan;
/// use simworld_core::scene::World;
/// use simworld_core::seed::Seed;
/// let city = City::from_plan(StreetPlan::grid(2, 2, 220.0), &CityConfig::default(), Seed(5))?;
/// let mut world = World::new();
/// let entities = city.populate(&mut world)?;
/// let mut there = CityInWorld::of(&entities, &world);
/// let mut editor = CityEditor::new(city);
/// let street = NewStreet::local([Point2::new(0.0, 100.0), Point2::new(220.0, 110.0)]);
/// let back = editor.apply(&CityEdit::AddStreet(street))?;
/// let before = world.len();
/// let done = there.follow(&mut editor, back, &mut world)?;
/// assert_ne!(world.len(), before);
/// // The undo of the edit is followed like an edit.
/// let forth = editor.put(done.back)?;
/// there.follow(&mut editor, forth, &mut world)?;
/// assert_eq!(world.len(), before);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CityInWorld {
    known: BTreeMap<Key, Vec<EntityId>>,
}

/// What a world did to follow an edit.
#[derive(Clone, Debug)]
pub struct Followed {
    /// The patch that takes the edit back, as it was given.
    pub back: CityPatch,
    /// What was done, in order: for a record, or for another world of the same city.
    pub commands: Vec<Command>,
    /// What takes it back in the world.
    pub undo: Vec<Command>,
}

/// Why a world does not follow an edit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FollowError {
    /// The patch is not that of the last edit.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// The world refused a command; it is as it was.
    #[error(transparent)]
    World(#[from] CommandError),
}

fn key_of(desc: &EntityDesc) -> Key {
    let mut hasher = StateHasher::new();
    hasher.pose(&desc.pose);
    desc.info.shape.size().iter().for_each(|part| {
        hasher.f64(*part);
    });
    hasher.str(desc.info.name.as_deref().unwrap_or_default());
    let at = desc.pose.translation.vector;
    (desc.kind, [at.x, at.y, at.z].map(f64::to_bits), hasher.finish().0)
}

impl CityInWorld {
    /// Takes note of the entities of a city that was just put into a world.
    pub fn of(entities: &CityEntities, world: &World) -> Self {
        let mut there = Self { known: BTreeMap::new() };
        for id in entities.iter() {
            if let Some(entity) = world.entity(id) {
                there.note(key_of(&entity.to_desc()), id);
            }
        }
        there
    }

    fn note(&mut self, key: Key, id: EntityId) {
        self.known.entry(key).or_default().push(id);
    }

    /// Has a world follow the last edit of a city, or the last undo: `back` is what takes it back. Roads are patched, what
    /// is gone is removed and what is new is spawned; everything else keeps its id. The ground follows too: where a city
    /// lies in hills, all that stands on ground that rose or sank with a street goes and comes at its new height.
    ///
    /// # Errors
    /// A patch of another edit, or a command that the world refuses: then the world is as it was.
    pub fn follow(
        &mut self,
        editor: &mut CityEditor,
        back: CityPatch,
        world: &mut World,
    ) -> Result<Followed, FollowError> {
        let roads = back.network.mirrored(&editor.city().network);
        let (mut now, mut then) = (touched_now(&back, editor.city()), touched_then(&back));
        let view_now = View::of(editor.city(), &now);
        let mut raised = raised(editor.city());
        let forth = editor.put(back)?;
        // Footbridges rise over what comes below them.
        raised.extend(self::raised(editor.city()));
        then.roads.footpaths.extend(&raised);
        now.roads.footpaths.extend(&raised);
        let reach = Reach::between(&View::of(editor.city(), &then), &view_now);
        reach.widen(editor, &mut then);
        let old = describe(editor.city(), &then, &reach, world);
        let back = editor.put(forth)?;
        reach.widen(editor, &mut now);
        let new = describe(editor.city(), &now, &reach, world)?;
        let (gone, come) = differences(old?, new);
        let mut commands = vec![Command::PatchRoads(Box::new(roads))];
        let mut removed = Vec::new();
        for desc in &gone {
            let key = key_of(desc);
            // Somebody may have removed or moved it since.
            if let Some(id) = self.known.get_mut(&key).and_then(Vec::pop) {
                removed.push((key, id));
                if world.entity(id).is_some() {
                    commands.push(Command::Remove { id });
                }
            }
        }
        let first = commands.len();
        commands.extend(come.into_iter().map(|desc| Command::Spawn(Box::new(desc))));
        match world.apply_all(&commands) {
            Ok(done) => {
                for (command, id) in commands[first..].iter().zip(done.spawned) {
                    if let Command::Spawn(desc) = command {
                        self.note(key_of(desc), id);
                    }
                }
                Ok(Followed { back, commands, undo: done.undo })
            }
            Err(error) => {
                removed.into_iter().rev().for_each(|(key, id)| self.note(key, id));
                Err(error.into())
            }
        }
    }
}

/// Things of a city by their numbers.
pub(super) struct Things {
    pub(super) roads: Touched,
    pub(super) buildings: BTreeSet<usize>,
    pub(super) elements: BTreeSet<usize>,
}

/// The ways for walkers that leave the ground, by their numbers.
fn raised(city: &City) -> BTreeSet<usize> {
    city.network.footpath_heights().raised().map(|(way, _)| way).collect()
}

fn touched_now(back: &CityPatch, city: &City) -> Things {
    fn now<T>(back: &ArrayPatch<T>, len: usize) -> impl Iterator<Item = usize> {
        now_at(back, len).into_iter().map(|number| number as usize)
    }
    let network = &city.network;
    Things {
        roads: Touched {
            roads: now(&back.network.roads, network.roads.len()).collect(),
            intersections: now(&back.network.intersections, network.intersections.len()).collect(),
            sidewalks: now(&back.network.sidewalks, network.sidewalks.len()).collect(),
            crossings: now(&back.network.crossings, network.crossings.len()).collect(),
            footpaths: BTreeSet::new(),
        },
        buildings: now(&back.buildings, city.buildings.len()).collect(),
        elements: now(&back.elements, city.elements.len()).collect(),
    }
}

fn touched_then(back: &CityPatch) -> Things {
    fn then<T>(back: &ArrayPatch<T>) -> impl Iterator<Item = usize> + '_ {
        back.set.iter().map(|(number, _)| *number as usize)
    }
    Things {
        roads: Touched {
            roads: then(&back.network.roads).collect(),
            intersections: then(&back.network.intersections).collect(),
            sidewalks: then(&back.network.sidewalks).collect(),
            crossings: then(&back.network.crossings).collect(),
            footpaths: BTreeSet::new(),
        },
        buildings: then(&back.buildings).collect(),
        elements: then(&back.elements).collect(),
    }
}

/// Some things of a city as recipes of entities.
fn describe(
    city: &City,
    things: &Things,
    reach: &Reach,
    world: &mut World,
) -> Result<Vec<EntityDesc>, FollowError> {
    let land = city.terrain();
    let heights = Ground::new(&city.network, &land);
    let buildings: Vec<_> = things.buildings.iter().map(|number| city.buildings[*number].clone()).collect();
    let elements: Vec<_> = things.elements.iter().map(|number| city.elements[*number]).collect();
    let parts = Parts {
        heights: &heights,
        network: &city.network,
        buildings: &buildings,
        elements: &elements,
        scope: Scope::Touched(&things.roads),
        ground: city.network.bounds().filter(|_| reach.plates),
        rows: reach.rows,
        margin: MARGIN,
    };
    Ok(parts.describe(world).map_err(CommandError::from)?)
}

/// What is among the old only, and what is among the new only.
fn differences(old: Vec<EntityDesc>, new: Vec<EntityDesc>) -> (Vec<EntityDesc>, Vec<EntityDesc>) {
    let mut there: BTreeMap<Key, Vec<EntityDesc>> = BTreeMap::new();
    for desc in old {
        there.entry(key_of(&desc)).or_default().push(desc);
    }
    let come =
        new.into_iter().filter(|desc| there.get_mut(&key_of(desc)).and_then(Vec::pop).is_none()).collect();
    (there.into_values().flatten().collect(), come)
}
