//! The laws of mechanics: what bodies do is what the formulas say.
#![allow(clippy::unwrap_used)]

use crate::common::{Stage, ramp};
use nalgebra::UnitQuaternion;
use proptest::prelude::*;
use simworld_core::asset::Asset;
use simworld_core::geometry::{Point3, Pose, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::ops::{atan2, cos, sin, tan};
use simworld_core::scene::{EntityDesc, EntityKind, Shape};
use simworld_physics::rapier::prelude::{PhysicsWorld, RevoluteJointBuilder, RigidBodyBuilder, Vector};
use simworld_physics::{Material, PhysicsConfig};

const G: f64 = 9.81;

/// A box with a velocity, of a mass and a material.
fn thrown(stage: &mut Stage, from: Point3, velocity: Vector3, material: Material) -> EntityId {
    let mut desc = EntityDesc::new(EntityKind::Prop, pose_facing(from, 0.3), Shape::cuboid(0.4, 0.4, 0.4))
        .weighing(20.0)
        .with("material", material.as_str());
    desc.twist = Twist { linear: velocity, angular: Vector3::zeros() };
    let id = stage.world.spawn(desc).unwrap();
    stage.physics.add_rigid(&stage.world, id).unwrap();
    id
}

fn fine() -> Stage {
    Stage::with(PhysicsConfig { substeps: 10, ..PhysicsConfig::default() })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn a_projectile_flies_a_parabola(speed in 1.0..30.0f64, elevation in 0.1..1.4f64, yaw in -3.0..3.0f64) {
        let mut stage = fine();
        let velocity = Vector3::new(cos(elevation) * cos(yaw), cos(elevation) * sin(yaw), sin(elevation)) * speed;
        let start = Point3::new(3.0, -2.0, 60.0);
        let id = thrown(&mut stage, start, velocity, Material::Wood);
        stage.run(15);
        let t = 1.5;
        let expected = start + velocity * t - Vector3::z() * (0.5 * G * t * t);
        // The integrator is first order: it may be off by half a substep of gravity.
        prop_assert!((stage.position(id) - expected).norm() < 0.5 * G * t * 0.01 + 1e-6, "{}", stage.position(id));
        prop_assert!((stage.velocity(id) - (velocity - Vector3::z() * (G * t))).norm() < 1e-6);
    }

    #[test]
    fn a_box_slides_only_on_slopes_steeper_than_its_friction(over in 0.03..0.2f64, which in 0usize..3) {
        let material = [Material::Wood, Material::Metal, Material::Asphalt][which];
        let critical = atan2(material.friction(), 1.0);
        for (slope, slides) in [(critical - over, false), (critical + over, true)] {
            let (moved, down) = slide(material, slope);
            prop_assert_eq!(moved > 0.05, slides, "{:?} at {} rad: {} m", material, slope, moved);
            if slides {
                // s = (g sin θ - μ g cos θ) t² / 2 after one second.
                let expected = 0.5 * G * (sin(slope) - material.friction() * cos(slope));
                prop_assert!((down - expected).abs() < 0.03 + 0.04 * expected, "{} m, not {} m", down, expected);
            }
        }
    }
}

/// Lays a box on a slope of its own material: how far it is after a second, and along the slope.
fn slide(material: Material, slope: f64) -> (f64, f64) {
    let mut stage = fine();
    let (pose, shape) = ramp(0.0, slope);
    let desc = EntityDesc::new(EntityKind::Building, pose, shape).with("material", material.as_str());
    stage.world.spawn(desc).unwrap();
    let tilt = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -slope);
    let normal = tilt * Vector3::z();
    let start = Vector3::new(10.0, 0.0, 10.0 * tan(slope)) + normal * 1e-3;
    let pose = Pose::from_parts(start.into(), tilt);
    // The slope says itself what it is made of, the box by its asset.
    let shape = Shape::cuboid(1.0, 1.0, 0.2);
    let slab = Asset { material: Some(material), ..Asset::new("slab", EntityKind::Prop, shape) };
    let asset = stage.world.add_asset(slab.clone()).unwrap();
    let id = stage.world.spawn(slab.at(asset, pose).weighing(20.0)).unwrap();
    stage.physics.add_rigid(&stage.world, id).unwrap();
    stage.run(10);
    let moved = stage.position(id).coords - start;
    (moved.norm(), -(moved.dot(&(tilt * Vector3::x()))))
}

#[test]
fn a_sliding_box_stops_after_v_squared_by_two_mu_g() {
    let mut stage = fine();
    let id = thrown(&mut stage, Point3::new(0.0, 0.0, 0.0), Vector3::new(5.0, 0.0, 0.0), Material::Asphalt);
    stage.run(40);
    let expected = 25.0 / (2.0 * Material::Asphalt.friction() * G);
    let way = stage.position(id).coords.norm();
    assert!((way / expected - 1.0).abs() < 0.05, "{way} m, not {expected} m");
}

/// The period of a pendulum of small swing is 2π √(l / g), of a wide one longer by the elliptic integral.
#[test]
fn a_pendulum_swings_with_its_period_and_gains_no_energy() {
    for (swing, longer) in [(0.1, 1.000_625), (1.0, 1.066_3)] {
        let (length, dt) = (2.0, 1e-3);
        let mut physics = PhysicsWorld::new();
        physics.gravity = Vector::new(0.0, 0.0, -G);
        physics.integration_parameters.dt = dt;
        let pivot = physics.insert_body(RigidBodyBuilder::fixed());
        let at = Vector::new(length * sin(swing), 0.0, -length * cos(swing));
        let bob = RigidBodyBuilder::dynamic().translation(at).additional_mass(1.0).can_sleep(false);
        let bob = physics.insert_body(bob);
        let joint = RevoluteJointBuilder::new(Vector::new(0.0, 1.0, 0.0)).local_anchor2(-at);
        physics.insert_multibody_joint(pivot, bob, joint);
        let energy = |physics: &PhysicsWorld| {
            let bob = &physics.bodies[bob];
            0.5 * bob.linvel().length_squared() + G * bob.translation().z
        };
        let start = energy(&physics);
        let mut crossings = Vec::new();
        let mut before = physics.bodies[bob].translation().x;
        for step in 0..9000 {
            physics.step();
            let now = physics.bodies[bob].translation().x;
            if before < 0.0 && now >= 0.0 {
                crossings.push((f64::from(step) + before / (before - now)) * dt);
            }
            before = now;
            assert!(energy(&physics) < start + 0.01, "energy grows: {} from {start} J", energy(&physics));
        }
        let period = (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64;
        let expected = std::f64::consts::TAU * (length / G).sqrt() * longer;
        assert!((period / expected - 1.0).abs() < 0.01, "{period} s, not {expected} s");
    }
}

#[test]
fn a_heap_of_boxes_never_gains_energy() {
    let mut stage = fine();
    let ids: Vec<_> = (0..12)
        .map(|i| {
            let f = f64::from(i);
            let from = Point3::new(0.13 * f, 0.1 * (f - 5.0), 1.0 + 0.6 * f);
            thrown(&mut stage, from, Vector3::new(1.0 - 0.2 * f, 0.3, 0.0), Material::Wood)
        })
        .collect();
    let energy = |stage: &Stage| -> f64 {
        let inertia = 20.0 * 0.4 * 0.4 / 6.0;
        let one = |id: &EntityId| {
            let state = stage.physics.state(*id).unwrap();
            let middle = state.pose * Point3::new(0.0, 0.0, 0.2);
            let arm = middle.coords - state.pose.translation.vector;
            let velocity = state.twist.linear + state.twist.angular.cross(&arm);
            20.0 * (G * middle.z + 0.5 * velocity.norm_squared())
                + 0.5 * inertia * state.twist.angular.norm_squared()
        };
        ids.iter().map(one).sum()
    };
    let start = energy(&stage);
    let mut least = start;
    for step in 0..60 {
        stage.step();
        let now = energy(&stage);
        // A contact may push out what the step before let in: a few joules of five thousand.
        assert!(now < least + 0.005 * start, "step {step}: {now} J after {least} J");
        least = least.min(now);
    }
    assert!(least < 0.5 * start, "it came to rest");
}
