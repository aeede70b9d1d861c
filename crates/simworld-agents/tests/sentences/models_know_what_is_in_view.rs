//! What a model may name: all that is about, or only what its body has in view.
#![cfg(feature = "thought")]

use std::collections::BTreeSet;
use std::f64::consts::PI;

use crate::executor_common::{at, person, thing};
use crate::thought_common::{answering, text};
use serde_json::Value;
use simworld_agents::thought::{ModelPlanner, Sight, ViewConfig};
use simworld_core::geometry::{Point3, Twist, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{Attachment, EntityKind, Role, Scene, Shape, World};
use simworld_core::seam::{Goal, PlanError, PlanStep, Planner};

/// What stands round a body that looks east.
struct Square {
    world: World,
    me: EntityId,
    /// Before it, in clear sight.
    ahead: [EntityId; 3],
    /// Before it, with the last of those in between.
    hidden: EntityId,
    behind: [EntityId; 2],
    /// What it has on its back.
    held: EntityId,
    /// Far behind it: on its map, whatever it sees.
    house: EntityId,
}

fn square() -> Square {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let (chair, bench) = (Shape::cuboid(0.5, 0.5, 0.9), Shape::cuboid(0.6, 1.8, 0.8));
    let ahead = [
        thing(&mut world, EntityKind::Chair, 6.0, 0.0, chair),
        person(&mut world, 4.0, 3.0),
        thing(&mut world, EntityKind::Bus, 15.0, 0.0, Shape::cuboid(2.5, 12.0, 3.1)),
    ];
    let hidden = thing(&mut world, EntityKind::Bench, 25.0, 0.0, bench);
    let behind = [thing(&mut world, EntityKind::Chair, -5.0, 0.0, chair), person(&mut world, -3.0, 2.0)];
    let held = thing(&mut world, EntityKind::Parcel, -0.4, 0.0, Shape::cuboid(0.3, 0.3, 0.3));
    let bond = Attachment { parent: me, role: Role::Held, parent_from_body: at(-0.4, 0.0) };
    world.attach(held, Some(bond)).unwrap();
    let house = thing(&mut world, EntityKind::Building, -60.0, 0.0, Shape::cuboid(10.0, 10.0, 8.0));
    Square { world, me, ahead, hidden, behind, held, house }
}

/// Every id that stands in an enum anywhere in a schema.
fn ids_in(schema: &Value, found: &mut BTreeSet<String>) {
    match schema {
        Value::Object(members) => {
            let allowed = members.get("enum").and_then(Value::as_array).into_iter().flatten();
            let ids = allowed.filter_map(Value::as_str).filter(|text| text.starts_with('#'));
            found.extend(ids.map(str::to_owned));
            members.values().for_each(|member| ids_in(member, found));
        }
        Value::Array(items) => items.iter().for_each(|item| ids_in(item, found)),
        _ => {}
    }
}

/// What a planner with that sight offers its model, and what it tells it of.
fn offered(square: &Square, sight: Sight) -> (BTreeSet<String>, String) {
    let (model, asked) = answering(&[r#"{"aim": "", "cannot": "no", "steps": []}"#]);
    let view = ViewConfig { sight, ..ViewConfig::default() };
    let mut planner = ModelPlanner::new(model).with_view(view).unwrap();
    let refused = planner.plan(&Intent::Words("do something".to_owned()), &square.world, square.me);
    assert!(matches!(refused, Err(PlanError::NotUnderstood { .. })), "{refused:?}");
    let request = asked.last();
    let mut found = BTreeSet::new();
    ids_in(&request.schema.as_ref().expect("a plan is asked for by a schema").json, &mut found);
    (found, text(&request, 1))
}

fn written(ids: &[EntityId]) -> BTreeSet<String> {
    ids.iter().map(EntityId::to_string).collect()
}

/// Whether the words have a line about a thing, which begins with its id and its kind.
fn tells_of(told: &str, square: &Square, id: EntityId) -> bool {
    let kind = square.world.entity(id).unwrap().kind;
    told.contains(&format!("{id} {kind}"))
}

#[test]
fn what_is_in_view_and_nothing_behind_the_back_may_be_named() {
    let mut square = square();
    let Square { me, ahead: [chair, other, bus], hidden, behind: [seat, walker], held, house, .. } = square;
    let (all, told) = offered(&square, Sight::All);
    assert_eq!(all, written(&[chair, other, bus, hidden, seat, walker, held, house]));
    assert!(tells_of(&told, &square, seat) && tells_of(&told, &square, chair), "{told}");

    let (seen, told) = offered(&square, Sight::InView);
    assert_eq!(seen, written(&[chair, other, bus, held, house]), "and what one has, and the map");
    assert!(tells_of(&told, &square, chair) && !tells_of(&told, &square, seat), "{told}");
    assert!(!tells_of(&told, &square, hidden), "{told}");

    // Who turns round has the other half in view.
    square.world.set_motion(me, pose_facing(Point3::origin(), PI), Twist::ZERO).unwrap();
    let (seen, _) = offered(&square, Sight::InView);
    assert_eq!(seen, written(&[seat, walker, held, house]));
    assert_eq!(offered(&square, Sight::All).0, all, "who knows the street knows it as before");
}

#[test]
fn what_is_out_of_view_is_refused_if_a_model_names_it_all_the_same() {
    let square = square();
    let [seat, _] = square.behind;
    let answer =
        format!(r#"{{"aim": "", "cannot": "", "steps": [{{"act": "go_to", "to": "{seat}", "speed": 0}}]}}"#);
    let plan = |sight| {
        let (model, _) = answering(&[&answer, &answer]);
        let view = ViewConfig { sight, ..ViewConfig::default() };
        let mut planner = ModelPlanner::new(model).with_view(view).unwrap();
        planner.plan(&Intent::Words("rest".to_owned()), &square.world, square.me)
    };
    let blind = plan(Sight::InView);
    assert!(
        matches!(&blind, Err(PlanError::Answer { fault, .. }) if fault.contains("give one of")),
        "{blind:?}"
    );
    let knowing = plan(Sight::All).unwrap();
    let PlanStep::Navigate { to, .. } = &knowing.steps[0] else { panic!("{knowing:?}") };
    assert_eq!(*to, Goal::Entity(seat));
}
