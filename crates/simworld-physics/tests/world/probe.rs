#![allow(clippy::unwrap_used)]
use crate::common::{PERSON, Stage, at};
use simworld_core::action::Action;
use simworld_core::geometry::{Point3, Vector3, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape};
use simworld_physics::{Cart, CartConfig, Castors, Grip, HumanoidConfig};
#[test]
fn probe_hang() {
    let mut stage = Stage::new();
    let who = stage.person(at(0.0, 0.0, 0.0));
    let pose = pose_facing(Point3::new(0.6, 0.0, 0.8), 0.0);
    let desc =
        EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(0.2, 0.2, 0.2)).weighing(0.97 * 20.0 / 9.81);
    let thing = stage.world.spawn(desc).unwrap();
    stage.physics.add_rigid(&stage.world, thing).unwrap();
    stage
        .physics
        .grasp(
            &stage.world,
            who,
            thing,
            Some(Point3::new(0.6, 0.0, 1.0)),
            Grip { strength: 20.0, ..Grip::default() },
        )
        .unwrap();
    for i in 0..60 {
        stage.tick(1.0 / 120.0);
        let f: Vec<_> = stage.physics.grasped(who).collect();
        println!("hang {i} {f:?} {:?} {:?}", stage.position(thing), stage.velocity(thing));
    }
}
#[test]
fn probe_cart() {
    for castors in [Castors::Front, Castors::All, Castors::None] {
        let mut stage = Stage::new();
        let mut desc = EntityDesc::new(EntityKind::Prop, at(0.0, 0.0, 0.0), Shape::cuboid(0.9, 0.55, 0.6))
            .weighing(50.0);
        desc.twist.linear = Vector3::new(1.5, 0.0, 0.0);
        let id = stage.world.spawn(desc).unwrap();
        stage.physics.add_cart(&stage.world, id, CartConfig { castors, ..CartConfig::default() }).unwrap();
        for i in 0..40 {
            stage.tick(1.0 / 120.0);
            let wheel = {
                use simworld_physics::PhysicsBody;
                let _ = stage.physics.body_as::<Cart>(id).unwrap().parts();
                stage.physics.momentum(id)
            };
            println!(
                "{castors:?} {i} {:?} {:?} w {wheel:?}",
                stage.position(id),
                stage.world.entity(id).unwrap().twist
            );
        }
        stage.contacts.clear();
    }
}
#[test]
fn probe_push() {
    let mut stage = Stage::new();
    let id = stage
        .world
        .spawn(
            EntityDesc::new(EntityKind::Prop, at(1.0, 0.0, 0.0), Shape::cuboid(0.9, 0.55, 0.6))
                .weighing(80.0),
        )
        .unwrap();
    stage.physics.add_cart(&stage.world, id, CartConfig::default()).unwrap();
    let who = stage.spawn(EntityKind::Person, at(0.0, 0.0, 0.0), PERSON);
    stage
        .physics
        .add_humanoid(&stage.world, who, HumanoidConfig { push_force: 100.0, ..HumanoidConfig::default() })
        .unwrap();
    stage.physics.grasp(&stage.world, who, id, None, Grip::default()).unwrap();
    stage.tell(who, Action::MoveForward { speed: 2.5 });
    for i in 0..60 {
        stage.tick(1.0 / 120.0);
        let f: Vec<_> = stage.physics.grasped(who).collect();
        println!(
            "push {i} {f:?} {:?} {:?} who {:?}",
            stage.position(id),
            stage.velocity(id),
            stage.velocity(who)
        );
    }
}
