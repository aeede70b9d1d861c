//! Whether a condition holds, as the agent finds the world.

use std::ops::ControlFlow;

use simworld_core::geometry::Aabb;
use simworld_core::id::EntityId;
use simworld_core::net::Aspect;
use simworld_core::scene::{EntityRef, Role, Scene};
use simworld_core::seam::{Condition, Which};
use simworld_core::value::Value;

use super::sees;

/// How far one makes out things, m.
const SIGHT: f64 = 60.0;

/// Whether it holds, so many seconds after it was first asked.
pub(crate) fn holds(condition: &Condition, scene: &dyn Scene, me: &EntityRef<'_>, elapsed: f64) -> bool {
    let again = |inner: &Condition| holds(inner, scene, me, elapsed);
    match condition {
        Condition::Signal { light, shows } => shown(scene, *light) == Some(*shows),
        Condition::Sees(what) => any(scene, me, what, SIGHT, &|entity| sees(scene, me, entity, SIGHT)),
        Condition::Near { what, within } => any(scene, me, what, *within, &|_| true),
        Condition::FreeNear { what, within } => {
            any(scene, me, what, *within, &|entity| !is_used(scene, entity.id, Some(me.id)))
        }
        Condition::InUse(id) => is_used(scene, *id, Some(me.id)),
        Condition::Open(id) => scene.entity(*id).is_some_and(|door| door.is_open()),
        Condition::Holds(what) => {
            let held = [Role::Held, Role::Carried].map(|role| scene.attached(me.id, role));
            held.iter().flatten().any(|held| what.is_none_or(|what| what == *held))
        }
        Condition::Seated => me.attachment.is_some_and(|bond| bond.role == Role::Seated),
        Condition::Raining => scene.environment().weather.rain > 0.0,
        Condition::Snowing => scene.environment().weather.snow > 0.0,
        Condition::Dark => scene.environment().sun.elevation < 0.0,
        Condition::Elapsed(seconds) => elapsed >= *seconds,
        Condition::Not(inner) => !again(inner),
        Condition::All(inner) => inner.iter().all(again),
        Condition::Any(inner) => inner.iter().any(again),
        Condition::Together { one, other, within } => {
            let both = scene.entity(*one).zip(scene.entity(*other));
            both.is_some_and(|(one, other)| are_together(&one, &other, *within))
        }
        _ => false,
    }
}

/// What a traffic light shows: by its group, or else by that of the crossing nearest to the post.
fn shown(scene: &dyn Scene, light: EntityId) -> Option<Aspect> {
    /// How far a post stands from the crossing that it is for, m.
    const POST: f64 = 15.0;
    let post = scene.entity(light)?;
    let stated = post.info.attributes.get("signal_group").and_then(Value::as_i64);
    let group = if let Some(group) = stated {
        usize::try_from(group).ok()?
    } else {
        let at = post.planar();
        let signalled = scene.roads()?.crossings.iter().filter_map(|crossing| {
            let distance = (crossing.start - at).norm().min((crossing.end - at).norm());
            crossing.signal.filter(|_| distance <= POST).map(|group| (distance, group))
        });
        signalled.min_by(|a, b| a.0.total_cmp(&b.0))?.1.index()
    };
    scene.signals().get(group).copied()
}

/// Whether one of them is within a distance of the agent and passes the test.
fn any(
    scene: &dyn Scene,
    me: &EntityRef<'_>,
    what: &Which,
    within: f64,
    test: &dyn Fn(&EntityRef<'_>) -> bool,
) -> bool {
    let here = me.planar();
    let near = |entity: &EntityRef<'_>| {
        let to_access = (entity.access().xy() - here).norm();
        entity.info.shape.planar_distance(entity.pose, &here).min(to_access) <= within
    };
    if let Which::Entity(id) = what {
        return scene.entity(*id).is_some_and(|entity| near(&entity) && test(&entity));
    }
    let mut found = false;
    let _ = scene.visit(&Aabb::column_around(here, within), &mut |entity| {
        found = entity.id != me.id && what.holds(&entity) && near(&entity) && test(&entity);
        if found { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    found
}

/// Whether the gap between two footprints, or between one and where the other is entered, is at most so wide, m.
fn are_together(one: &EntityRef<'_>, other: &EntityRef<'_>, within: f64) -> bool {
    let gap = |of: &EntityRef<'_>, to: &EntityRef<'_>| {
        let reach = of.info.shape.planar_distance(of.pose, &to.planar());
        reach.min((of.access().xy() - to.planar()).norm())
    };
    gap(one, other).min(gap(other, one)) <= within
}

/// Whether somebody sits on it, is in it, or has it; oneself does not count.
fn is_used(scene: &dyn Scene, id: EntityId, me: Option<EntityId>) -> bool {
    let by_other = |by: Option<EntityId>| by.is_some() && by != me;
    [Role::Seated, Role::Aboard].iter().any(|role| by_other(scene.attached(id, *role)))
        || by_other(scene.entity(id).and_then(|entity| entity.attachment.map(|bond| bond.parent)))
}
