//! Robot dogs on legs slip, are knocked over and get up, within what their joints and motors do; and every run is the same.
#![allow(clippy::unwrap_used)]

use crate::common::{Stage, at};
use simworld_core::asset::Material;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Vector3};
use simworld_core::hash::{StateHash, StateHasher};
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityKind, FallCause, Footing, Scene, Shape};
use simworld_core::seam::Dynamics;
use simworld_physics::{
    Command, Detail, JointCommand, PhysicsConfig, PhysicsDynamics, QuadrupedConfig, QuadrupedModel,
};

/// The length of a substep on legs, s.
const SUBSTEP: f64 = 1.0 / 200.0;

fn forward(speed: f64) -> Command {
    Command { forward: speed, ..Command::default() }
}

/// A stage whose steps are single substeps.
fn fine(ground: Material) -> Stage {
    Stage::with(PhysicsConfig { substeps: 1, ground, ..PhysicsConfig::default() })
}

fn fell(stage: &Stage) -> bool {
    stage.events.iter().any(|event| matches!(event, EventKind::Fell { .. }))
}

/// Why it fell first.
fn cause(stage: &Stage) -> Option<FallCause> {
    stage.events.iter().find_map(|event| match event {
        EventKind::Fell { cause, .. } => Some(*cause),
        _ => None,
    })
}

/// Throws 12 kg at it so hard that it falls.
fn knock_over(stage: &mut Stage, dog: EntityId, (x, y): (f64, f64)) {
    let middle = stage.position(dog);
    let away = Vector3::new(x, y, 0.0).normalize();
    let from = middle + away * (0.2 + 0.4 * away.x.abs() + 0.3) + Vector3::z() * 0.25;
    stage.ball(Point3::from(from.coords), away * -6.0, 12.0);
}

#[test]
fn knocked_over_from_any_side_it_gets_up_by_itself() {
    for turn in 0..8 {
        let (sin, cos) = ops::sin_cos(f64::from(turn) * 0.785 + 0.2);
        let mut stage = Stage::new();
        let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
        stage.run(10);
        knock_over(&mut stage, dog, (cos, sin));
        let mut seen = Vec::new();
        let mut least = 1.0f64;
        for _ in 0..200 {
            stage.run(1);
            let footing = stage.world.entity(dog).unwrap().footing();
            least = least.min(stage.up(dog));
            if seen.last() != Some(&footing) {
                seen.push(footing);
            }
        }
        println!("from {cos:.2}, {sin:.2}: least up {least:.2}, {seen:?}");
        assert_eq!(stage.quadruped(dog).footing(), Footing::Upright, "{turn}: {seen:?}");
        assert!(stage.up(dog) > 0.97 && stage.quadruped(dog).trunk_height() > 0.27, "{turn}");
        if fell(&stage) {
            assert_eq!(cause(&stage), Some(FallCause::Struck));
            assert!(seen.contains(&Footing::Rising), "{seen:?}");
            assert!(stage.events.iter().any(|event| matches!(event, EventKind::GotUp { .. })));
        }
        // It still does what it is told.
        stage.command(dog, forward(0.5));
        let before = stage.position(dog);
        stage.run(30);
        assert!((stage.position(dog) - before).norm() > 0.8);
    }
}

/// Whatever happens to it, the torques are those of its motors, and its joints stay within their stops.
#[test]
fn joints_and_torques_keep_to_their_limits_at_every_substep() {
    let mut stage = fine(Material::Asphalt);
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    let model = stage.quadruped(dog).config().model.clone();
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for step in 0..3000 {
        match step {
            0 => stage.command(dog, forward(1.0)),
            700 => knock_over(&mut stage, dog, (0.3, 1.0)),
            _ => {}
        }
        stage.tick(SUBSTEP);
        for (leg, joints) in stage.quadruped(dog).readings().joints.iter().enumerate() {
            for (joint, reading) in joints.iter().enumerate() {
                let [low, high] = model.limits_of(leg, joint);
                least = least.min(reading.angle - low).min(high - reading.angle);
                most = most.max(reading.torque.abs() / model.torques[joint]);
            }
        }
    }
    println!("nearest to a limit {least:.4} rad, greatest share of a torque {most:.3}");
    assert!(least >= 0.0, "{least} rad beyond a limit");
    assert!(most <= 1.0 && most > 0.3, "{most}");
    assert!(stage.up(dog) > 0.9, "it got up: {}", stage.up(dog));
}

/// Rubber on ice has a coefficient of 0.21: no more than that share of its weight moves it along, on its feet or not.
#[test]
fn on_ice_it_slips_by_the_law_of_friction() {
    let mut stage = fine(Material::Ice);
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    let friction = (Material::Ice.friction() * Material::Rubber.friction()).sqrt();
    assert!((friction - 0.2).abs() < 0.02, "{friction}");
    let weight = stage.quadruped(dog).config().model.mass() * 9.81;
    stage.command(dog, forward(1.0));
    let mut before = stage.physics.momentum(dog).unwrap();
    let (mut fallen, mut least, mut most) = (false, 1.0f64, 0.0f64);
    for _ in 0..40 {
        for _ in 0..20 {
            stage.tick(SUBSTEP);
            least = least.min(stage.up(dog));
            fallen |= stage.quadruped(dog).footing() == Footing::Falling;
        }
        let momentum = stage.physics.momentum(dog).unwrap();
        let force = (momentum - before) / (20.0 * SUBSTEP) + Vector3::z() * weight;
        most = most.max(force.xy().norm() / force.z.max(0.1 * weight));
        before = momentum;
    }
    println!(
        "on ice: it was moved along by {most:.3} of the force that bore it, with a coefficient of {friction:.3}"
    );
    assert!(most < 1.05 * friction && most > 0.5 * friction, "{most}");
    println!("on ice: fallen {fallen}, least up {least:.2}");
    // At a metre a second it loses its balance there, whether it falls or catches itself; on asphalt its trunk hardly
    // sways (the walking tests).
    assert!(least < 0.9, "least up {least}");
    // Slowly it keeps it.
    let mut stage = Stage::with(PhysicsConfig { ground: Material::Ice, ..PhysicsConfig::default() });
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    stage.command(dog, forward(0.3));
    stage.run(80);
    assert!(!fell(&stage) && stage.position(dog).x > 1.2, "{}", stage.position(dog).x);
}

fn digest(stage: &Stage) -> u64 {
    let mut hasher = StateHasher::new();
    StateHash::state_hash(&stage.physics, &mut hasher);
    hasher.finish().0
}

/// Two that trot, of which one is knocked over.
fn scene() -> (Stage, EntityId) {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    let other = stage.legged_dog(at(0.0, 2.0, 1.0));
    stage.command(dog, forward(0.6));
    stage.command(other, Command { lateral: 0.2, turning: 0.5, ..Command::default() });
    stage.run(10);
    knock_over(&mut stage, dog, (0.2, 1.0));
    (stage, dog)
}

#[test]
fn every_run_is_the_same_to_the_bit() {
    let (mut one, _) = scene();
    let (mut two, _) = scene();
    for _ in 0..60 {
        one.run(1);
        two.run(1);
        assert_eq!(digest(&one), digest(&two));
    }
}

#[test]
fn saved_in_the_middle_of_a_step_or_a_fall_it_goes_on_to_the_bit() {
    let (mut stage, dog) = scene();
    let mut footings = Vec::new();
    for _ in 0..8 {
        let (world, saved) = (stage.world.clone(), stage.physics.save().unwrap());
        footings.push(stage.quadruped(dog).footing());
        stage.run(7);
        let expected = (digest(&stage), stage.physics.save().unwrap());
        let again = restored(world, &saved, &stage);
        assert_eq!(digest(&again), expected.0);
        assert!(again.physics.save().unwrap() == expected.1, "the saved bytes differ");
    }
    assert!(footings.contains(&Footing::Upright) && footings.iter().any(|f| *f != Footing::Upright));
}

/// A new physics that takes up a saved state and runs seven steps.
fn restored(world: simworld_core::scene::World, saved: &[u8], like: &Stage) -> Stage {
    let mut physics = PhysicsDynamics::new(like.physics.config().clone()).unwrap();
    for id in like.physics.bodies() {
        if like.physics.body_as::<simworld_physics::Quadruped>(id).is_some() {
            physics.add_quadruped(&world, id, QuadrupedConfig::default()).unwrap();
        } else {
            physics.add_rigid(&world, id).unwrap();
        }
    }
    physics.restore(&world, saved).unwrap();
    let mut stage = Stage { world, physics, contacts: Vec::new(), events: Vec::new() };
    stage.run(7);
    stage
}

#[test]
fn far_from_what_is_of_interest_it_is_a_cylinder_and_comes_back_on_its_legs() {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    stage.tell(dog, simworld_core::action::Action::MoveForward { speed: 0.8 });
    stage.run(30);
    assert!(stage.quadruped(dog).is_on_legs());
    let handed = |stage: &mut Stage| {
        let (place, velocity) = (stage.position(dog), stage.velocity(dog));
        stage.run(1);
        let moved = stage.position(dog) - place;
        assert!(moved.norm() < 0.16, "no jump: {moved}, at {velocity}");
    };
    stage.physics.set_interest(&[Point3::new(1e4, 0.0, 0.0)]);
    handed(&mut stage);
    assert_eq!(stage.physics.detail(dog), Some(Detail::Reduced));
    assert!(!stage.quadruped(dog).is_on_legs());
    let before = stage.position(dog);
    stage.run(20);
    assert!((stage.position(dog).x - before.x - 1.6).abs() < 0.1, "it goes on at its speed");
    stage.physics.set_interest(&[]);
    handed(&mut stage);
    handed(&mut stage);
    assert!(stage.quadruped(dog).is_on_legs());
    let before = stage.position(dog);
    stage.run(30);
    assert!((1.8..2.6).contains(&(stage.position(dog).x - before.x)), "{}", stage.position(dog).x - before.x);
    assert!(stage.up(dog) > 0.95 && !fell(&stage));
    assert!(stage.world.joints(dog).is_some(), "its legs can be drawn");
}

#[test]
fn it_is_put_elsewhere_and_taken_away() {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    stage.run(10);
    stage.world.set_motion(dog, at(5.0, 5.0, 2.0), simworld_core::geometry::Twist::ZERO).unwrap();
    stage.run(10);
    let place = stage.position(dog);
    assert!((place - Point3::new(5.0, 5.0, 0.0)).norm() < 0.1, "{place}");
    assert!(stage.quadruped(dog).is_on_legs() && stage.up(dog) > 0.98);
    stage.physics.remove(dog).unwrap();
    stage.run(1);
    assert_eq!(stage.physics.bodies().count(), 0);
    stage.physics.add_quadruped(&stage.world, dog, QuadrupedConfig::default()).unwrap();
    stage.run(20);
    assert!(stage.up(dog) > 0.98 && !fell(&stage));
}

/// As above, at every third step of falls to eight sides. Under `SIMWORLD_SOAK=1`: it takes minutes.
#[test]
fn saved_at_any_moment_it_goes_on_to_the_bit() {
    let whole = std::env::var("SIMWORLD_SOAK").is_ok_and(|value| value == "1");
    for turn in 0..if whole { 8 } else { 1 } {
        let (sin, cos) = ops::sin_cos(f64::from(turn) * 0.785 + 0.2);
        let mut stage = Stage::new();
        let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
        stage.run(8);
        knock_over(&mut stage, dog, (cos, sin));
        for _ in 0..if whole { 40 } else { 8 } {
            let (world, saved) = (stage.world.clone(), stage.physics.save().unwrap());
            let again = restored(world, &saved, &stage);
            stage.run(7);
            assert_eq!(digest(&again), digest(&stage));
        }
    }
}

/// Where thigh and shank of a leg run, from its readings: hip, knee and foot as seen from the trunk, m.
fn bones(stage: &Stage, dog: EntityId, leg: usize) -> [Vector3; 3] {
    let model = QuadrupedModel::default();
    let [aside, thigh, knee] = stage.quadruped(dog).readings().joints[leg].map(|joint| joint.angle);
    let (ahead, left) = (if leg < 2 { 1.0 } else { -1.0 }, if leg.is_multiple_of(2) { 1.0 } else { -1.0 });
    let turned = |place: Vector3| {
        let (sin, cos) = ops::sin_cos(aside);
        let place = Vector3::new(place.x, cos * place.y - sin * place.z, sin * place.y + cos * place.z);
        Vector3::new(ahead * model.hip[0], left * model.hip[1], 0.0) + place
    };
    let down = |angle: f64| -Vector3::new(ops::sin(angle), 0.0, ops::cos(angle));
    let hip = Vector3::new(0.0, left * model.hip_offset, 0.0);
    let middle = hip + down(thigh) * model.thigh;
    [hip, middle, middle + down(thigh + knee) * model.shank].map(turned)
}

/// The least distance of the axes of two legs, m.
fn between(one: [Vector3; 3], other: [Vector3; 3]) -> f64 {
    let along = |bones: [Vector3; 3]| {
        (0..100).map(move |at| {
            let share = f64::from(at % 50) / 49.0;
            let first = usize::from(at >= 50);
            bones[first].lerp(&bones[first + 1], share)
        })
    };
    along(one).flat_map(|a| along(other).map(move |b| (a - b).norm())).fold(f64::INFINITY, f64::min)
}

/// In free fall the fore leg of a side is led back and the hind leg forward, by all that their motors give.
#[test]
fn legs_that_are_led_against_one_another_touch() {
    let mut stage = fine(Material::Asphalt);
    let mut pose = at(0.0, 0.0, 0.0);
    pose.translation.z = 6.0;
    let dog = stage.legged_dog(pose);
    let hold = |angle| JointCommand { angle, stiffness: 40.0, damping: 1.0, ..JointCommand::default() };
    let back = [hold(0.0), hold(1.5), hold(-1.0)];
    let ahead = [hold(0.0), hold(-0.6), hold(-1.0)];
    stage.quadruped_mut(dog).control_joints([back, back, ahead, ahead]).unwrap();
    let (mut least, mut loads) = (f64::INFINITY, 0.0_f64);
    for _ in 0..160 {
        stage.tick(0.005);
        least = least.min(between(bones(&stage, dog, 0), bones(&stage, dog, 2)));
        loads = stage.quadruped(dog).readings().feet.iter().copied().fold(loads, f64::max);
    }
    let shanks = 2.0 * 0.06 * QuadrupedModel::default().shank;
    println!("axes of legs come within {least:.4} m, shanks are {shanks:.4} m thick together");
    assert!(least > shanks - 0.005, "{least}");
    assert!(least < shanks + 0.03, "they came to one another: {least}");
    assert!(loads == 0.0, "a foot on a leg stands on nothing: {loads} N");
}

/// Whose thighs begin within the trunk, since the hips are narrow, stands and walks as well.
#[test]
fn narrow_hips_are_no_trouble() {
    let mut stage = Stage::new();
    let model = QuadrupedModel { trunk_radius: 0.1, hip_offset: 0.06, ..QuadrupedModel::default() };
    let id = stage.spawn(EntityKind::Dog, at(0.0, 0.0, 0.0), Shape::cuboid(0.7, 0.35, 0.5));
    let config = QuadrupedConfig { model, ..QuadrupedConfig::default() };
    stage.physics.add_quadruped(&stage.world, id, config).unwrap();
    stage.run(10);
    stage.command(id, forward(0.4));
    for _ in 0..40 {
        stage.run(1);
        assert!(stage.up(id) > 0.97, "{}", stage.up(id));
    }
    assert!(stage.position(id).x > 1.0, "{}", stage.position(id));
}
