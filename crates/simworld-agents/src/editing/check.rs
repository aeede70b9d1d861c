//! The judge of edits: what changed between two states of a world, and what is wrong with how things stand. It shares
//! no code with the placement solver.

use std::ops::ControlFlow;

use simworld_core::geometry::Obb;
use simworld_core::ground::Ground;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, Scene, World};
use simworld_core::traffic::RoadLeg;

/// How far above what holds it up a thing may be, or sunk into it, m.
pub(crate) const SUPPORT_GAP: f64 = 0.05;
/// Bodies that share less than this in height or width touch, m.
const TOUCH: f64 = 2e-3;

/// What changed between two states of a world, by ascending id.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Difference {
    /// Things that are new.
    pub added: Vec<EntityId>,
    /// Things that are gone.
    pub removed: Vec<EntityId>,
    /// Things that stand elsewhere, are turned, move otherwise or hang on something else.
    pub moved: Vec<EntityId>,
    /// Things that look or are called otherwise.
    pub altered: Vec<EntityId>,
    /// Whether sun or weather is another.
    pub environment: bool,
    /// Directions of roads that were closed or opened.
    pub passages: Vec<RoadLeg>,
}

impl Difference {
    /// What changed from one state to another.
    pub fn between(before: &World, after: &World) -> Self {
        let mut difference =
            Self { environment: before.environment() != after.environment(), ..Self::default() };
        difference.passages =
            before.closed_roads().symmetric_difference(after.closed_roads()).copied().collect();
        for old in before.iter() {
            match after.entity(old.id) {
                None => difference.removed.push(old.id),
                Some(new) => {
                    if (old.pose, old.twist, old.attachment) != (new.pose, new.twist, new.attachment) {
                        difference.moved.push(old.id);
                    }
                    if (old.kind, old.info) != (new.kind, new.info) {
                        difference.altered.push(old.id);
                    }
                }
            }
        }
        let is_new = |entity: &EntityRef<'_>| before.entity(entity.id).is_none();
        difference.added = after.iter().filter(is_new).map(|entity| entity.id).collect();
        difference
    }

    /// Whether nothing changed.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// What is wrong with how a thing stands.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// It is not there.
    Missing,
    /// Two things share space.
    Penetrates {
        /// The other.
        other: EntityId,
    },
    /// It hangs in the air, or is sunk into what it stands on.
    Unsupported {
        /// How far above the nearest support its bottom is, m; below zero it is sunk in.
        gap: f64,
    },
}

/// What is wrong with how a thing stands in a world: nothing, if it shares no space with anything and stands on the ground
/// or on something that holds it up. The ground is that of the world, or else that level on which most things nearby stand.
pub fn faults(world: &World, thing: EntityId) -> Vec<Fault> {
    let Some(entity) = world.entity(thing) else { return vec![Fault::Missing] };
    let own = entity.info.shape.obb(entity.pose);
    let (low, high) = span(&own);
    let mut found = Vec::new();
    let mut support: Option<f64> = None;
    let _ = world.visit(&entity.bounds.inflated(0.5), &mut |other| {
        if other.id == thing {
            return ControlFlow::Continue(());
        }
        let flat = matches!(
            other.kind,
            EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk
        );
        let box_of = other.info.shape.obb(other.pose);
        let (other_low, other_high) = span(&box_of);
        let above = own.footprints_overlap(&box_of);
        if !flat && above && low + TOUCH < other_high && other_low + TOUCH < high {
            found.push(Fault::Penetrates { other: other.id });
        }
        if above {
            nearer(&mut support, low - other_high);
        }
        ControlFlow::Continue(())
    });
    let gap = match world.ground() {
        Some(land) => Some(land_gap(land, &entity, &own)),
        None => ground_level(world, &entity).map(|level| low - level),
    };
    if let Some(gap) = gap {
        nearer(&mut support, gap);
    }
    if let Some(gap) = support.filter(|gap| gap.abs() > SUPPORT_GAP) {
        found.push(Fault::Unsupported { gap });
    }
    found
}

fn nearer(support: &mut Option<f64>, gap: f64) {
    if support.is_none_or(|best| gap.abs() < best.abs()) {
        *support = Some(gap);
    }
}

/// Bottom and top of a box, m.
fn span(own: &Obb) -> (f64, f64) {
    let middle = own.pose.translation.z;
    (middle - own.half_extents.z, middle + own.half_extents.z)
}

/// Whether it stands on land that slopes without a level base: on legs, on roots, on a post that is let into the ground, or on
/// foundations. All else stands on its corners.
pub(super) const fn finds_footing(kind: EntityKind) -> bool {
    matches!(
        kind,
        EntityKind::Person
            | EntityKind::Dog
            | EntityKind::Robot
            | EntityKind::Tree
            | EntityKind::Shrub
            | EntityKind::StreetLamp
            | EntityKind::TrafficSignal
            | EntityKind::Sign
            | EntityKind::Hydrant
            | EntityKind::Building
    )
}

/// How far a thing is above the land, m; below zero it is sunk in. What has a level base is looked at under its middle and its four
/// corners, of which the worst counts; what [finds its footing](finds_footing) under its middle.
fn land_gap(land: &Ground, thing: &EntityRef<'_>, own: &Obb) -> f64 {
    let (low, _) = span(own);
    let middle = low - land.height(thing.planar());
    if finds_footing(thing.kind) {
        return middle;
    }
    let gaps = own.footprint().map(|corner| low - land.height(corner));
    gaps.into_iter().fold(middle, |worst, gap| if gap.abs() > worst.abs() { gap } else { worst })
}

/// The level on which most things within 60 m stand, to the centimetre, m; of two as frequent the lower.
fn ground_level(world: &World, thing: &EntityRef<'_>) -> Option<f64> {
    let mut levels: Vec<i64> = Vec::new();
    let _ = world.visit(&thing.bounds.inflated(60.0), &mut |other| {
        if other.id != thing.id && other.attachment.is_none() {
            levels.push((other.position().z * 100.0).round() as i64);
        }
        ControlFlow::Continue(())
    });
    levels.sort_unstable();
    let groups = levels.chunk_by(|a, b| a == b);
    let most = groups.max_by_key(|group| (group.len(), std::cmp::Reverse(group[0])))?;
    Some(most[0] as f64 * 0.01)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use simworld_core::geometry::{Point2, Point3, pose_facing};
    use simworld_core::ground::{Cover, GroundData};
    use simworld_core::scene::{EntityDesc, Shape};

    use super::*;

    fn world() -> World {
        let mut world = World::new();
        for (x, z) in [(0.0, 0.0), (10.0, 0.0), (20.0, 0.0)] {
            put(&mut world, x, z);
        }
        world
    }

    fn put(world: &mut World, x: f64, z: f64) -> EntityId {
        let pose = pose_facing(Point3::new(x, 0.0, z), 0.0);
        world.spawn(EntityDesc::new(EntityKind::Table, pose, Shape::cuboid(1.0, 1.0, 0.8))).unwrap()
    }

    #[test]
    fn what_floats_sinks_or_runs_into_others_is_found() {
        let mut world = world();
        let sound = put(&mut world, 5.0, 0.0);
        let stacked = put(&mut world, 0.0, 0.8);
        let floats = put(&mut world, 30.0, 0.4);
        let sunk = put(&mut world, 40.0, -0.2);
        let inside = put(&mut world, 10.5, 0.0);
        assert_eq!(faults(&world, sound), []);
        assert_eq!(faults(&world, stacked), []);
        assert!(matches!(faults(&world, floats)[..], [Fault::Unsupported { gap }] if gap > 0.3));
        assert!(matches!(faults(&world, sunk)[..], [Fault::Unsupported { gap }] if gap < -0.1));
        assert!(matches!(faults(&world, inside)[..], [Fault::Penetrates { .. }]));
    }

    #[test]
    fn on_a_slope_the_corner_that_hangs_in_the_air_counts() {
        // It rises to the east by 35 cm a metre: under the middle of a table of a metre all is well, and 17 cm off at its edges.
        let ground = Ground::new(GroundData {
            origin: Point2::new(-10.0, -10.0),
            spacing: 20.0,
            columns: 2,
            rows: 2,
            heights: vec![-3.5, 3.5, -3.5, 3.5],
            covers: vec![Cover::Grass; 4],
            water: None,
        });
        let mut world = World::new();
        world.set_ground(Arc::new(ground.unwrap()));
        let table = put(&mut world, 1.0, 0.35);
        assert!(matches!(faults(&world, table)[..], [Fault::Unsupported { gap }] if gap.abs() > 0.17));
        let pose = pose_facing(Point3::new(5.0, 5.0, 1.75), 0.0);
        let tree = EntityDesc::new(EntityKind::Tree, pose, Shape::cuboid(1.0, 1.0, 8.0));
        let tree = world.spawn(tree).unwrap();
        assert_eq!(faults(&world, tree), [], "its roots are in the ground");
    }

    #[test]
    fn nothing_that_changes_escapes() {
        let before = world();
        let mut after = before.clone();
        assert!(Difference::between(&before, &after).is_empty());
        let ids: Vec<EntityId> = before.iter().map(|entity| entity.id).collect();
        after.remove(ids[0]).unwrap();
        after.set_attribute(ids[1], "open", Some(true.into())).unwrap();
        let new = put(&mut after, 50.0, 0.0);
        let difference = Difference::between(&before, &after);
        assert_eq!((difference.removed, difference.altered), (vec![ids[0]], vec![ids[1]]));
        assert_eq!((difference.added, difference.moved), (vec![new], vec![]));
    }
}
