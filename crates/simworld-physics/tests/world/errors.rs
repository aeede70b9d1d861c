//! Bad input is refused with a typed error that names the fault.

use crate::common::{Stage, at};
use proptest::prelude::*;
use simworld_core::action::Action;
use simworld_core::event::EventKind;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Shape};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, PhysicsError, VehicleClass};

#[test]
fn settings_out_of_range_are_named() {
    let field = |config: PhysicsConfig| match PhysicsDynamics::new(config).unwrap_err() {
        PhysicsError::Config { field, .. } => field,
        other => panic!("{other}"),
    };
    let sound = PhysicsConfig::default;
    assert_eq!(field(PhysicsConfig { substeps: 0, ..sound() }), "substeps");
    assert_eq!(field(PhysicsConfig { gravity: f64::NAN, ..sound() }), "gravity");
    assert_eq!(field(PhysicsConfig { gravity: -9.81, ..sound() }), "gravity");
    assert_eq!(field(PhysicsConfig { ground_half_extent: f64::INFINITY, ..sound() }), "ground_half_extent");
    assert_eq!(field(PhysicsConfig { detail_radius: -0.1, ..sound() }), "detail_radius");
    assert_eq!(field(PhysicsConfig { max_slope: 2.0, ..sound() }), "max_slope");
    assert_eq!(field(PhysicsConfig { step_height: -1.0, ..sound() }), "step_height");
    assert_eq!(field(PhysicsConfig { mirror_radius: 0.0, ..sound() }), "mirror_radius");
    assert_eq!(field(PhysicsConfig { parallel_threshold: 0, ..sound() }), "parallel_threshold");
    assert!(HumanoidConfig { turning_rate: 0.0, ..HumanoidConfig::default() }.validate().is_err());
    let mut absurd = VehicleClass::Sedan.parameters();
    absurd.chassis.mass = f64::NAN;
    assert!(absurd.validate().is_err());
}

#[test]
fn unknown_occupied_and_unsuitable_entities_are_named() {
    let mut stage = Stage::new();
    let nobody = EntityId::new(77, 0);
    let person = stage.person(at(0.0, 0.0, 0.0));
    let flat = stage.spawn(EntityKind::Robot, at(5.0, 0.0, 0.0), Shape::cuboid(3.0, 3.0, 0.1));
    let (world, physics) = (&stage.world, &mut stage.physics);
    let walks = HumanoidConfig::default;
    assert_eq!(physics.add_humanoid(world, nobody, walks()), Err(PhysicsError::Missing { id: nobody }));
    assert_eq!(physics.add_rigid(world, nobody), Err(PhysicsError::Missing { id: nobody }));
    assert_eq!(physics.add_humanoid(world, person, walks()), Err(PhysicsError::Occupied { id: person }));
    assert!(
        matches!(physics.add_humanoid(world, flat, walks()), Err(PhysicsError::Shape { id, .. }) if id == flat)
    );
    let drives = VehicleClass::Sedan.parameters();
    assert!(matches!(physics.add_vehicle(world, flat, drives), Err(PhysicsError::Shape { .. })));
    assert_eq!(physics.remove(flat), Err(PhysicsError::Bodiless { id: flat }));
    assert_eq!(physics.state(flat), None);
}

#[test]
fn a_refused_action_becomes_an_event_and_an_accepted_one_does_not() {
    let mut stage = Stage::new();
    let person = stage.person(at(0.0, 0.0, 0.0));
    let parcel = stage.spawn(EntityKind::Parcel, at(0.5, 0.0, 0.0), Shape::cuboid(0.3, 0.3, 0.3));
    stage.tell(person, Action::PickUp { item: parcel });
    stage.tell(person, Action::MoveForward { speed: -1.0 });
    stage.tell(person, Action::Throttle { level: 1.0 });
    stage.step();
    let failed: Vec<_> = stage
        .events
        .iter()
        .filter_map(|event| match event {
            EventKind::ActionFailed { who, reason, .. } if *who == person => Some(reason.as_str()),
            _ => None,
        })
        .collect();
    assert_eq!(failed.len(), 2, "{failed:?}");
    assert!(failed[0].contains("speed = -1") && failed[1].contains("cannot throttle"), "{failed:?}");
}

#[test]
fn an_absurd_velocity_ends_in_an_error_and_leaves_the_world_as_it_was() {
    let mut stage = Stage::new();
    let id = stage.spawn(EntityKind::Prop, at(0.0, 0.0, 0.0), Shape::cuboid(1.0, 1.0, 1.0));
    let mut twist = simworld_core::geometry::Twist::ZERO;
    twist.angular.z = 1e200;
    twist.linear.x = 1e300;
    stage.world.set_motion(id, at(0.0, 0.0, 0.0), twist).unwrap();
    stage.physics.add_rigid(&stage.world, id).unwrap();
    let before = stage.position(id);
    let result = (0..20).try_for_each(|_| stage.physics.step(&mut stage.world, 0.1));
    assert!(result.is_err());
    assert!(stage.position(id).iter().all(|x| x.is_finite()), "{before}");
    assert!(stage.physics.step(&mut stage.world, f64::NAN).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn no_number_of_an_action_makes_a_body_infinite(number in proptest::num::f64::ANY, which in 0usize..8) {
        let mut stage = Stage::new();
        let person = stage.person(at(0.0, 0.0, 0.0));
        let car = stage.spawn(EntityKind::Car, at(10.0, 0.0, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
        stage.physics.add_vehicle(&stage.world, car, VehicleClass::Sedan.parameters()).unwrap();
        let (who, action) = match which {
            0 => (person, Action::MoveForward { speed: number }),
            1 => (person, Action::Rotate { angle: number }),
            2 => (person, Action::ChangeSpeed { speed: number }),
            3 => (person, Action::LookUp { angle: number }),
            4 => (person, Action::Focus { horizontal_fov: number }),
            5 => (car, Action::Throttle { level: number }),
            6 => (car, Action::Steer { angle: number }),
            _ => (car, Action::Brake { level: number }),
        };
        // What the world refuses does not reach the body.
        let _ = stage.world.actuate(who, action);
        stage.run(5);
        prop_assert!(stage.position(who).iter().all(|x| x.abs() < 100.0));
    }

    #[test]
    fn any_person_shape_is_taken_or_refused(radius in 1e-3..3.0f64, stretch in 1.0..20.0f64) {
        let mut stage = Stage::new();
        let shape = Shape::Capsule { radius, height: 2.0 * radius * stretch };
        let id = stage.spawn(EntityKind::Person, at(0.0, 0.0, 0.0), shape);
        if stage.physics.add_humanoid(&stage.world, id, HumanoidConfig::default()).is_ok() {
            stage.tell(id, Action::MoveForward { speed: 1.0 });
            stage.run(5);
            prop_assert!((stage.position(id).x - 0.5).abs() < 1e-6);
        }
    }
}

#[test]
fn slender_people_come_as_far_as_they_are_told() {
    // The ground is a solid of 200 km, of which casts of slender forms find faces that lean.
    let mut rng = Seed(5).stream("builds").rng();
    for _ in 0..4000 {
        let (radius, stretch) = (rng.uniform(0.065, 0.08), rng.uniform(2.0, 20.0));
        let mut stage = Stage::new();
        let shape = Shape::Capsule { radius, height: 2.0 * radius * stretch };
        let id = stage.spawn(EntityKind::Person, at(0.0, 0.0, 0.0), shape);
        if stage.physics.add_humanoid(&stage.world, id, HumanoidConfig::default()).is_ok() {
            stage.tell(id, Action::MoveForward { speed: 1.0 });
            stage.run(2);
            let there = stage.position(id);
            assert!((there.x - 0.2).abs() < 1e-9, "{radius} m, {stretch}: {there}");
        }
    }
}
