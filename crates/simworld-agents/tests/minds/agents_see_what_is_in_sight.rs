//! What an agent sees: the field of view, what hides what, the receiver's fix, what became of its actions, and prompts that
//! keep their budget.

use proptest::prelude::*;
use simworld_agents::observer::{GpsObserver, SceneGraph, SceneGraphObserver, tokens_in};
use simworld_core::action::Action;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seam::{ObserveError, Observer};
use simworld_core::seed::Seed;
use simworld_core::testing::check_observer;

fn put(world: &mut World, kind: EntityKind, x: f64, y: f64, shape: Shape) -> EntityId {
    world.spawn(EntityDesc::new(kind, pose_facing(Point3::new(x, y, 0.0), 0.0), shape)).unwrap()
}

/// An agent that looks east at a house with a bench behind it, a tall tree behind it, and a bench beside it.
fn street() -> (World, EntityId, [EntityId; 4]) {
    let mut world = World::new();
    let me = put(&mut world, EntityKind::Person, 0.0, 0.0, Shape::Capsule { radius: 0.25, height: 1.8 });
    let house = put(&mut world, EntityKind::Building, 15.0, 0.0, Shape::cuboid(6.0, 10.0, 5.0));
    let hidden = put(&mut world, EntityKind::Bench, 25.0, 0.0, Shape::cuboid(0.6, 1.8, 0.8));
    let tree = put(&mut world, EntityKind::Tree, 22.0, 2.0, Shape::cuboid(0.6, 0.6, 30.0));
    let beside = put(&mut world, EntityKind::Bench, 15.0, 14.0, Shape::cuboid(0.6, 1.8, 0.8));
    (world, me, [house, hidden, tree, beside])
}

fn seen(
    observer: &mut SceneGraphObserver,
    world: &World,
    me: EntityId,
) -> Result<Vec<EntityId>, ObserveError> {
    let mut graph = SceneGraph::default();
    observer.observe(world, me, &mut graph)?;
    Ok(graph.sightings.iter().map(|sighting| sighting.id).collect())
}

#[test]
fn a_house_hides_what_is_behind_it_and_is_lower() {
    let (world, me, [house, hidden, tree, beside]) = street();
    let mut all = seen(&mut SceneGraphObserver::new(60.0), &world, me).unwrap();
    all.sort_unstable();
    assert_eq!(all, [house, hidden, tree, beside]);
    let mut open = seen(&mut SceneGraphObserver::new(60.0).with_occlusion(), &world, me).unwrap();
    open.sort_unstable();
    assert_eq!(open, [house, tree, beside], "the bench is behind the house; the tree stands out above it");
}

#[test]
fn what_is_behind_the_back_is_not_seen() {
    let (mut world, me, _) = street();
    let behind = put(&mut world, EntityKind::Chair, -4.0, 0.0, Shape::cuboid(0.5, 0.5, 0.9));
    let mut ahead = SceneGraphObserver::new(60.0).with_field_of_view(2.0);
    assert!(!seen(&mut ahead, &world, me).unwrap().contains(&behind));
    assert!(seen(&mut SceneGraphObserver::new(60.0), &world, me).unwrap().contains(&behind));
}

#[test]
fn what_one_holds_and_what_became_of_it_is_said() {
    let (mut world, me, _) = street();
    let parcel = put(&mut world, EntityKind::Parcel, 0.8, 0.0, Shape::cuboid(0.3, 0.3, 0.3));
    world.actuate(me, Action::PickUp { item: parcel }).unwrap();
    let mut graph = SceneGraph::default();
    let mut observer = SceneGraphObserver::new(60.0).with_gps(GpsObserver::new(3.0, 0.0, Seed(7)));
    observer.observe(&world, me, &mut graph).unwrap();
    let reason = "chair #3 is taken by #4".to_owned();
    world.emit(EventKind::ActionFailed { who: me, action: Action::StandUp.kind(), reason });
    world.emit(EventKind::PlanDone { who: EntityId::new(2, 0) });
    graph.hear(world.events(), me);
    assert_eq!(graph.feedback.len(), 1, "{:?}", graph.feedback);
    let prompt = graph.to_prompt(400);
    assert!(
        prompt.contains(&format!("holding {parcel}")) && prompt.contains("> stand up failed: chair #3"),
        "{prompt}"
    );
    assert!(graph.oneself.fix.position.coords.norm() > 1e-6, "the receiver errs by metres");
    assert!((graph.sightings[0].distance - 0.2).abs() < 0.5, "what is seen is seen from where one really is");
}

#[test]
fn the_seam_is_kept() {
    let (world, me, _) = street();
    let make = || {
        Box::new(SceneGraphObserver::new(60.0).with_occlusion().with_gps(GpsObserver::new(2.0, 0.1, Seed(3))))
    };
    check_observer(|| make(), &world, me, SceneGraph::default);
}

proptest! {
    #[test]
    fn a_prompt_keeps_its_budget_and_counts_what_it_leaves_out(tokens in 0_usize..300, things in 0_usize..40) {
        let mut world = World::new();
        let me = put(&mut world, EntityKind::Person, 0.0, 0.0, Shape::Capsule { radius: 0.25, height: 1.8 });
        for index in 0..things {
            put(&mut world, EntityKind::Bench, 3.0 + index as f64 * 2.0, 1.0, Shape::cuboid(0.6, 1.8, 0.8));
        }
        let mut graph = SceneGraph::default();
        SceneGraphObserver::new(200.0).observe(&world, me, &mut graph).unwrap();
        let prompt = graph.to_prompt(tokens);
        prop_assert!(tokens_in(&prompt) <= tokens);
        let (listed, left) = (prompt.matches("bench").count(), things);
        let counted = prompt.lines().find_map(|line| line.strip_prefix("... and ")?.split(' ').next()?.parse::<usize>().ok());
        if prompt.contains("bench") {
            prop_assert_eq!(listed + counted.unwrap_or(0), left, "{}", prompt);
        }
    }
}
