//! What stands on what: the thing that holds another up, and all that stands on a thing.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, Scene};

use super::check::SUPPORT_GAP;
use super::place::is_surface;
use super::solid::Solid;

/// What is no thicker than this holds nothing up, m: what lies on a mat stands on the ground.
pub(super) const THIN: f64 = 0.01;
/// So many things are followed down from one to the next that it stands or hangs on: what somebody holds may be below its own bearer,
/// and then there would be no end.
const DEEPEST: usize = 64;

/// Whether one thing may hold another up: it is no ground, it begins lower, and the other begins at its top.
fn holds(below: &EntityRef<'_>, above: &EntityRef<'_>) -> bool {
    below.id != above.id
        && !is_surface(below.kind)
        && above.attachment.is_none()
        && below.bounds.min.z + THIN < above.bounds.min.z
        && (below.bounds.max.z - above.bounds.min.z).abs() <= SUPPORT_GAP
        && Solid::of(below).is_over(&Solid::of(above))
}

/// The middle of a thing in the plane, m: what lies on its side has its origin elsewhere.
pub(super) fn middle_of(thing: &EntityRef<'_>) -> Point2 {
    thing.bounds.center().xy()
}

/// Something that a thing touches below, and that may hold it up.
#[derive(Clone, Copy)]
pub(super) struct Holder {
    id: EntityId,
    /// Whether things can stand on top of it.
    pub(super) is_flat: bool,
    pub(super) solid: Solid,
}

/// All that may hold a thing up, by ascending id.
pub(super) fn holders(scene: &dyn Scene, thing: &EntityRef<'_>) -> Vec<Holder> {
    let mut found = Vec::new();
    let _ = scene.visit(&thing.bounds.inflated(SUPPORT_GAP), &mut |other| {
        if holds(&other, thing) {
            found.push(Holder { id: other.id, is_flat: has_flat_top(other.kind), solid: Solid::of(&other) });
        }
        ControlFlow::Continue(())
    });
    found.sort_unstable_by_key(|holder| holder.id);
    found
}

/// What a thing stands on, if that is no ground: what is below its middle or, where nothing is, the first that it touches.
pub(super) fn support_of(scene: &dyn Scene, thing: EntityId) -> Option<EntityId> {
    let thing = scene.entity(thing)?;
    let (below, middle) = (holders(scene, &thing), middle_of(&thing));
    let under_it = below.iter().find(|holder| holder.solid.distance_to(middle) == 0.0);
    under_it.or(below.first()).map(|holder| holder.id)
}

/// With what a thing goes where that goes: with what is below its middle or, where nothing is, with what it stands on alone. What lies
/// between two goes with neither.
pub(super) fn bearer_of(scene: &dyn Scene, thing: EntityId) -> Option<EntityId> {
    let thing = scene.entity(thing)?;
    let (below, middle) = (holders(scene, &thing), middle_of(&thing));
    let under_it = below.iter().find(|holder| holder.solid.distance_to(middle) == 0.0);
    let alone = if let [only] = &below[..] { Some(only) } else { None };
    under_it.or(alone).map(|holder| holder.id)
}

/// What touches the top of a thing from above, whether it stands on that alone or on something else too; by ascending id.
pub(super) fn touching(scene: &dyn Scene, support: EntityId) -> Vec<EntityId> {
    let Some(below) = scene.entity(support).filter(|below| !is_surface(below.kind)) else {
        return Vec::new();
    };
    let mut top: Aabb = below.bounds.inflated(SUPPORT_GAP);
    top.min.z = below.bounds.max.z - SUPPORT_GAP;
    let mut found = Vec::new();
    let _ = scene.visit(&top, &mut |other| {
        if holds(&below, &other) {
            found.push(other.id);
        }
        ControlFlow::Continue(())
    });
    found.sort_unstable();
    found
}

/// Everything that stands on a thing, on what hangs on it, or on what stands there, each behind what it stands on. What is named
/// besides is left out with all that stands on it.
pub(super) fn load_of(scene: &dyn Scene, thing: EntityId, besides: &[EntityId]) -> Vec<EntityId> {
    let (mut load, mut carriers, mut next) = (Vec::new(), vec![thing], 0);
    while let Some(carrier) = carriers.get(next).copied() {
        next += 1;
        for above in touching(scene, carrier) {
            let goes_with_it = bearer_of(scene, above) == Some(carrier);
            if goes_with_it && !carriers.contains(&above) && !besides.contains(&above) {
                load.push(above);
                carriers.push(above);
            }
        }
        scene.visit_attached(carrier, &mut |part| {
            if !carriers.contains(&part.id) {
                carriers.push(part.id);
            }
        });
    }
    load
}

/// Things and all that hangs on them.
pub(super) fn with_what_hangs_on(scene: &dyn Scene, things: &[EntityId]) -> Vec<EntityId> {
    let (mut all, mut next) = (things.to_vec(), 0);
    while let Some(carrier) = all.get(next).copied() {
        next += 1;
        scene.visit_attached(carrier, &mut |part| {
            if !all.contains(&part.id) {
                all.push(part.id);
            }
        });
    }
    all
}

/// The thing at the foot of what a thing stands or hangs on: the thing itself, if it stands on the ground.
pub(super) fn foot_of(scene: &dyn Scene, thing: EntityId) -> EntityId {
    let mut foot = thing;
    for _ in 0..DEEPEST {
        let bond = scene.entity(foot).and_then(|thing| thing.attachment.copied());
        match bond.map(|bond| bond.parent).or_else(|| support_of(scene, foot)) {
            Some(below) => foot = below,
            None => break,
        }
    }
    foot
}

/// Whether a thing that stands there rests on another with its whole footprint.
pub(super) fn carries(anchor: &EntityRef<'_>, solid: &Solid) -> bool {
    let below = Solid::of(anchor);
    has_flat_top(anchor.kind) && solid.corners().into_iter().all(|corner| below.distance_to(corner) <= 1e-6)
}

/// Whether things can stand on top of it.
pub(crate) const fn has_flat_top(kind: EntityKind) -> bool {
    !matches!(
        kind,
        EntityKind::Tree
            | EntityKind::Shrub
            | EntityKind::StreetLamp
            | EntityKind::TrafficSignal
            | EntityKind::Sign
            | EntityKind::Hydrant
            | EntityKind::Cone
            | EntityKind::Motorcycle
            | EntityKind::Bicycle
            | EntityKind::Scooter
            | EntityKind::Person
            | EntityKind::Dog
            | EntityKind::Door
    )
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Point3, pose_facing};
    use simworld_core::scene::{EntityDesc, Shape, World};

    use super::*;

    fn put(world: &mut World, kind: EntityKind, size: [f64; 3], at: [f64; 3]) -> EntityId {
        let pose = pose_facing(Point3::new(at[0], at[1], at[2]), 0.0);
        let shape = Shape::cuboid(size[0], size[1], size[2]);
        world.spawn(EntityDesc::new(kind, pose, shape)).expect("a box")
    }

    fn table(world: &mut World, x: f64) -> EntityId {
        put(world, EntityKind::Table, [1.0, 1.0, 0.8], [x, 0.0, 0.0])
    }

    #[test]
    fn a_load_is_told_from_the_bottom_up() {
        let mut world = World::new();
        put(&mut world, EntityKind::Ground, [50.0, 50.0, 1.0], [0.0, 0.0, -1.0]);
        let table = table(&mut world, 0.0);
        let cup = put(&mut world, EntityKind::Prop, [0.1, 0.1, 0.1], [0.0, 0.0, 1.0]);
        let tray = put(&mut world, EntityKind::Prop, [0.4, 0.4, 0.2], [0.0, 0.0, 0.8]);
        let beside = put(&mut world, EntityKind::Chair, [0.5, 0.5, 0.9], [1.0, 0.0, 0.0]);
        assert_eq!(load_of(&world, table, &[]), [tray, cup]);
        assert_eq!(load_of(&world, table, &[tray]), [], "nor what stands on what is left out");
        assert_eq!((support_of(&world, cup), support_of(&world, table)), (Some(tray), None));
        assert_eq!((foot_of(&world, cup), foot_of(&world, beside)), (table, beside));
    }

    #[test]
    fn a_board_on_two_tables_stands_on_that_below_its_middle_and_touches_both() {
        let mut world = World::new();
        let (one, other) = (table(&mut world, 0.0), table(&mut world, 1.2));
        let board = put(&mut world, EntityKind::Prop, [1.6, 0.3, 0.05], [0.8, 0.0, 0.8]);
        assert_eq!(support_of(&world, board), Some(other));
        assert_eq!((touching(&world, one), touching(&world, other)), (vec![board], vec![board]));
        assert_eq!((load_of(&world, one, &[]), load_of(&world, other, &[])), (vec![], vec![board]));
    }

    #[test]
    fn a_board_between_two_tables_goes_with_neither_and_one_that_leans_out_goes_with_the_only_one() {
        let mut world = World::new();
        let (one, other) = (table(&mut world, 0.0), table(&mut world, 2.0));
        let between = put(&mut world, EntityKind::Prop, [1.6, 0.3, 0.05], [1.0, 0.0, 0.8]);
        assert_eq!((bearer_of(&world, between), support_of(&world, between)), (None, Some(one)));
        assert_eq!((load_of(&world, one, &[]), load_of(&world, other, &[])), (vec![], vec![]));
        assert_eq!((touching(&world, one), touching(&world, other)), (vec![between], vec![between]));
        let far = table(&mut world, 9.0);
        let leans_out = put(&mut world, EntityKind::Prop, [1.0, 0.3, 0.05], [9.8, 0.0, 0.8]);
        assert_eq!(load_of(&world, far, &[]), [leans_out]);
    }
}
