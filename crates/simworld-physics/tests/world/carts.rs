//! Carts roll as wheels do, and are led by hands.
#![allow(clippy::unwrap_used)]

use crate::common::{PERSON, Stage, at, ramp};
use simworld_core::action::{Action, StepDirection};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Pose, Twist, Vector3, pose_facing, yaw_of};
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Dynamics, DynamicsError};
use simworld_core::testing::check_dynamics;
use simworld_physics::{Cart, CartConfig, Castors, Grip, HumanoidConfig, PhysicsConfig, PhysicsDynamics};

const GRAVITY: f64 = 9.81;
const TROLLEY: Shape = Shape::Box { size: Vector3::new(0.9, 0.55, 0.6) };

fn cart(stage: &mut Stage, pose: Pose, mass: f64, config: CartConfig) -> EntityId {
    let id = stage.world.spawn(EntityDesc::new(EntityKind::Prop, pose, TROLLEY).weighing(mass)).unwrap();
    stage.physics.add_cart(&stage.world, id, config).unwrap();
    id
}

/// Somebody behind a cart with both hands on its handle, facing east.
fn pusher(stage: &mut Stage, mass: f64, config: CartConfig, strength: f64) -> (EntityId, EntityId) {
    let cart = cart(stage, at(1.0, 0.0, 0.0), mass, config);
    let who = stage.spawn(EntityKind::Person, at(0.0, 0.0, 0.0), PERSON);
    let person = HumanoidConfig { push_force: strength, ..HumanoidConfig::default() };
    stage.physics.add_humanoid(&stage.world, who, person).unwrap();
    stage.physics.grasp(&stage.world, who, cart, None, Grip::both_hands()).unwrap();
    (who, cart)
}

fn broke(stage: &Stage) -> bool {
    stage.events.iter().any(|event| matches!(event, EventKind::GraspBroke { .. }))
}

#[test]
fn a_pushed_cart_gains_speed_as_force_over_mass_says() {
    let config = CartConfig::default();
    for (mass, force) in [(80.0, 100.0), (200.0, 150.0), (400.0, 200.0)] {
        let mut stage = Stage::new();
        let (who, cart) = pusher(&mut stage, mass, config.clone(), force);
        stage.tell(who, Action::MoveForward { speed: 2.5 });
        stage.run(4);
        let before = stage.velocity(cart).x;
        stage.run(8);
        let gained = (stage.velocity(cart).x - before) / 0.8;

        let formula = (force - config.rolling_resistance * mass * GRAVITY) / mass;
        assert!(
            (gained - formula).abs() < 0.05 * formula,
            "{mass} kg, {force} N: {gained}, not {formula} m/s²"
        );
        let drift = stage.position(cart);
        assert!(drift.y.abs() < 0.02 && drift.z.abs() < 0.01, "{drift}");
    }
}

#[test]
fn who_pushes_a_cart_comes_to_walk_as_fast_as_told_and_stops_with_it() {
    let mut stage = Stage::new();
    let (who, cart) = pusher(&mut stage, 60.0, CartConfig::default(), 200.0);
    stage.tell(who, Action::MoveForward { speed: 1.2 });
    stage.run(50);
    assert!((stage.velocity(cart).x - 1.2).abs() < 0.05, "{}", stage.velocity(cart));
    assert!((stage.velocity(who).x - 1.2).abs() < 0.05, "{}", stage.velocity(who));
    stage.tell(who, Action::Stop);
    stage.run(30);
    assert!(stage.velocity(cart).norm() < 0.05 && !broke(&stage), "{}", stage.velocity(cart));
    let gap = stage.position(cart).x - stage.position(who).x;
    assert!((gap - 1.0).abs() < 0.1, "at arm's length: {gap}");
}

#[test]
fn a_cart_that_was_let_go_rolls_out_as_the_formula_says() {
    for castors in [Castors::Front, Castors::All, Castors::None] {
        let mut stage = Stage::new();
        let config = CartConfig { castors, ..CartConfig::default() };
        let mut desc = EntityDesc::new(EntityKind::Prop, at(0.0, 0.0, 0.0), TROLLEY).weighing(50.0);
        desc.twist.linear = Vector3::new(1.5, 0.0, 0.0);
        let id = stage.world.spawn(desc).unwrap();
        stage.physics.add_cart(&stage.world, id, config.clone()).unwrap();
        stage.run(120);
        let formula = 1.5 * 1.5 / (2.0 * config.rolling_resistance * GRAVITY);
        let way = stage.position(id).x;
        assert!((way - formula).abs() < 0.05 * formula, "{castors:?}: {way} m, not {formula} m");
        assert!(stage.velocity(id).norm() < 1e-3, "{castors:?}: {}", stage.velocity(id));
    }
}

#[test]
fn it_rolls_down_a_slope_as_the_formula_says_and_stays_on_one_that_its_bearings_hold() {
    let config = CartConfig::default();
    for slope in [0.01, 0.1, 0.25_f64] {
        let mut stage = Stage::new();
        // Its upper side rises towards east from x = 0: the cart stands 10 m up and looks down.
        let (pose, shape) = ramp(0.0, slope);
        stage.spawn(EntityKind::Building, pose, shape);
        let (sin, cos) = ops::sin_cos(slope);
        let tilt = nalgebra::UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -slope);
        let about = nalgebra::UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI);
        let place = Vector3::new(10.0 * cos, 0.0, 10.0 * sin);
        let id = cart(&mut stage, Pose::from_parts(place.into(), tilt * about), 40.0, config.clone());
        stage.run(5);
        let before = stage.velocity(id).norm();
        stage.run(10);
        let gained = stage.velocity(id).norm() - before;
        let formula = ((sin - config.rolling_resistance * cos) * GRAVITY).max(0.0);
        let pressed: f64 = stage.physics.body_as::<Cart>(id).unwrap().loads().iter().sum();
        if slope > 0.05 {
            assert!((pressed - 40.0 * GRAVITY * cos).abs() < 10.0, "{pressed} N");
        }
        assert!(
            (gained - formula).abs() < 0.04 + 0.05 * formula,
            "{slope} rad: {gained}, not {formula} m/s²"
        );
    }
}

#[test]
fn a_kerb_stops_it_and_who_pushes_it() {
    let mut stage = Stage::new();
    stage.building(5.0, 0.0, (3.0, 6.0, 0.12));
    let (who, cart) = pusher(&mut stage, 40.0, CartConfig::default(), 200.0);
    stage.tell(who, Action::MoveForward { speed: 1.0 });
    stage.run(80);
    let front = stage.position(cart).x + 0.45;
    assert!((3.3..3.55).contains(&front), "the kerb is at 3.5 m and its front at {front} m");
    let before = [cart, who].map(|id| stage.position(id));
    stage.run(10);
    let drift = [cart, who].map(|id| stage.position(id));
    assert!(
        (before[0] - drift[0]).norm() < 0.02 && (before[1] - drift[1]).norm() < 0.05,
        "{before:?} {drift:?}"
    );
    assert_eq!(stage.physics.grasped(who).count(), 1, "{:?}", stage.events);
    assert!(stage.position(who).x < 2.7, "{}", stage.position(who));
}

#[test]
fn it_is_drawn_backwards_and_steered() {
    let mut stage = Stage::new();
    let (who, cart) = pusher(&mut stage, 30.0, CartConfig::default(), 200.0);
    stage.tell(who, Action::Step { direction: StepDirection::Backward, distance: 2.0 });
    stage.run(40);
    assert!((stage.position(cart).x + 1.0).abs() < 0.15, "2 m back: {}", stage.position(cart));
    stage.tell(who, Action::MoveForward { speed: 0.8 });
    stage.tell(who, Action::Rotate { angle: std::f64::consts::FRAC_PI_2 });
    stage.run(80);
    let heading = yaw_of(stage.world.entity(cart).unwrap().pose);
    assert!((heading - std::f64::consts::FRAC_PI_2).abs() < 0.35, "{heading}");
    assert!(stage.position(cart).y > 2.0 && !broke(&stage), "{}", stage.position(cart));
}

#[test]
fn a_load_rides_along_and_weighs() {
    let mut stage = Stage::new();
    let (who, cart) = pusher(&mut stage, 30.0, CartConfig::default(), 100.0);
    let above = pose_facing(Point3::new(1.0, 0.0, 0.6), 0.0);
    let load = EntityDesc::new(EntityKind::Prop, above, Shape::cuboid(0.4, 0.4, 0.3)).weighing(50.0);
    let load = stage.world.spawn(load).unwrap();
    stage.physics.add_rigid(&stage.world, load).unwrap();
    stage.run(5);
    stage.tell(who, Action::MoveForward { speed: 1.2 });
    stage.run(5);
    let early = stage.velocity(cart).x;
    assert!((0.3..0.75).contains(&early), "100 N on 80 kg for half a second: {early} m/s");
    stage.run(40);
    let off = stage.position(load) - stage.position(cart);
    assert!(off.xy().norm() < 0.05 && (off.z - 0.6).abs() < 0.02, "{off}");
    assert!(stage.position(cart).x > 4.0);
}

#[test]
fn let_alone_it_sleeps_and_who_walks_into_it_moves_it() {
    let mut stage = Stage::new();
    let id = cart(&mut stage, at(3.0, 0.0, 0.0), 60.0, CartConfig::default());
    stage.run(40);
    assert!((stage.position(id).x - 3.0).abs() < 1e-3 && stage.velocity(id).norm() == 0.0);
    let who = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(who, Action::MoveForward { speed: 1.0 });
    stage.run(60);
    assert!(stage.position(id).x > 4.0, "{}", stage.position(id));
}

#[test]
fn it_is_carried_off_and_put_down_on_its_wheels() {
    let mut stage = Stage::new();
    let id = cart(&mut stage, at(3.0, 0.0, 0.0), 20.0, CartConfig::default());
    let who = stage.person(at(2.0, 0.0, 0.0));
    stage.run(2);
    stage.tell(who, Action::CarryHeavy { item: id });
    stage.run(5);
    assert_eq!(stage.world.attached(who, simworld_core::scene::Role::Carried), Some(id));
    stage.tell(who, Action::PutDownHeavy);
    stage.run(20);
    assert!(stage.position(id).z.abs() < 0.01, "{}", stage.position(id));
    stage.world.set_motion(id, at(8.0, 4.0, 1.0), Twist::ZERO).unwrap();
    stage.run(20);
    assert!((stage.position(id) - Point3::new(8.0, 4.0, 0.0)).norm() < 0.02, "{}", stage.position(id));
}

/// Somebody who leads a cart by the clock alone.
struct Led(PhysicsDynamics, EntityId);

impl Dynamics for Led {
    fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
        let tick = world.clock().tick().0;
        if tick.is_multiple_of(9) {
            let _ = world.actuate(self.1, Action::MoveForward { speed: 0.4 + 0.1 * (tick % 5) as f64 });
            let _ = world.actuate(self.1, Action::Rotate { angle: 0.6 - 0.2 * (tick % 7) as f64 });
        }
        self.0.step(world, dt)
    }
    fn save(&self) -> Result<Vec<u8>, DynamicsError> {
        self.0.save()
    }
    fn restore(&mut self, world: &World, saved: &[u8]) -> Result<(), DynamicsError> {
        self.0.restore(world, saved)
    }
    fn state_hash(&self, hasher: &mut StateHasher) {
        Dynamics::state_hash(&self.0, hasher);
    }
}

#[test]
fn a_led_cart_repeats_is_saved_and_goes_on_bit_for_bit() {
    let mut stage = Stage::new();
    let who = stage.spawn(EntityKind::Person, at(0.0, 0.0, 0.0), PERSON);
    let id = stage.spawn(EntityKind::Prop, at(1.0, 0.0, 0.0), TROLLEY);
    stage.building(4.0, 2.0, (2.0, 2.0, 0.12));
    check_dynamics(&stage.world, || {
        let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).unwrap();
        physics.add_humanoid(&stage.world, who, HumanoidConfig::default()).unwrap();
        physics.add_cart(&stage.world, id, CartConfig::default()).unwrap();
        physics.grasp(&stage.world, who, id, None, Grip::both_hands()).unwrap();
        Box::new(Led(physics, who))
    });
}

#[test]
fn settings_and_shapes_without_sense_are_refused() {
    let mut stage = Stage::new();
    let usual = CartConfig::default();
    let id = stage.spawn(EntityKind::Prop, at(0.0, 0.0, 0.0), TROLLEY);
    for wild in [f64::NAN, f64::INFINITY, -1.0, 1e9] {
        for config in [
            CartConfig { wheel_radius: wild, ..usual.clone() },
            CartConfig { rolling_resistance: wild, ..usual.clone() },
            CartConfig { handle: wild, ..usual.clone() },
        ] {
            let error = stage.physics.add_cart(&stage.world, id, config).unwrap_err();
            assert!(error.to_string().contains("CartConfig"), "{error}");
        }
    }
    for shape in [Shape::Sphere { radius: 1.0 }, Shape::cuboid(0.2, 0.2, 0.2)] {
        let id = stage.spawn(EntityKind::Prop, at(0.0, 0.0, 0.0), shape);
        let error = stage.physics.add_cart(&stage.world, id, usual.clone()).unwrap_err();
        assert!(error.to_string().contains("cart"), "{error}");
    }
    // A mass without sense is none.
    let desc = EntityDesc::new(EntityKind::Prop, at(9.0, 0.0, 0.0), TROLLEY).weighing(1e300);
    if let Ok(id) = stage.world.spawn(desc) {
        stage.physics.add_cart(&stage.world, id, usual).unwrap();
        stage.run(5);
        assert!(stage.position(id).z.abs() < 0.01);
    }
}
