//! What is seen of somebody who walks: joint angles that carry the feet to where the ground is.
#![allow(clippy::unwrap_used)]

use crate::common::{Stage, at};
use simworld_core::action::Action;
use simworld_core::environment::Environment;
use simworld_core::geometry::{Point3, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::limbs::{JointAngles, LegAngles};
use simworld_core::ops;
use simworld_core::scene::Scene;

const HEIGHT: f64 = 1.75;

fn joints(stage: &Stage, who: EntityId) -> JointAngles {
    *stage.world.joints(who).unwrap()
}

/// Where the sole of a leg is by forward kinematics, m: ahead of the body's origin and above its height.
fn sole(joints: &JointAngles, leg: &LegAngles) -> (f64, f64) {
    let (thigh, shank, ankle) = (0.245 * HEIGHT, 0.246 * HEIGHT, 0.039 * HEIGHT);
    let hips = 0.530 * HEIGHT - joints.hip_drop;
    let shin = leg.hip_flexion - leg.knee_flexion;
    let ahead = thigh * ops::sin(leg.hip_flexion) + shank * ops::sin(shin);
    let down = thigh * ops::cos(leg.hip_flexion) + shank * ops::cos(shin);
    (ahead, hips - down - ankle)
}

/// Where the soles are in the world.
fn soles(stage: &Stage, who: EntityId) -> [Point3; 2] {
    let joints = joints(stage, who);
    let pose = *stage.world.entity(who).unwrap().pose;
    assert!(yaw_of(&pose).abs() < 1e-9);
    [joints.left_leg, joints.right_leg].map(|leg| {
        let (ahead, up) = sole(&joints, &leg);
        pose * Point3::new(ahead, 0.0, up)
    })
}

#[test]
fn feet_stay_where_they_tread_and_step_as_far_as_people() {
    let mut stage = Stage::new();
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.34 });
    stage.run(20);
    // Prints of the left foot: where it stays for a step of the world.
    let (mut prints, mut before) = (Vec::<f64>::new(), soles(&stage, walker)[0]);
    for _ in 0..60 {
        stage.run(1);
        let now = soles(&stage, walker)[0];
        assert!(now.z > -0.02 && now.z < 0.2, "on or over the ground: {now}");
        if (now - before).norm() < 0.005 && prints.last().is_none_or(|print| (print - now.x).abs() > 0.1) {
            assert!(now.z.abs() < 0.01, "{now}");
            prints.push(now.x);
        }
        before = now;
    }
    let cycles: Vec<f64> = prints.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!(cycles.len() >= 4, "{prints:?}");
    for cycle in cycles {
        assert!((1.35..1.6).contains(&cycle), "two steps of 0.68 to 0.8 m: {cycle}");
    }
}

#[test]
fn joints_bend_within_what_people_do() {
    let mut stage = Stage::new();
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.34 });
    stage.run(20);
    let (mut hip, mut knee) = ((f64::MAX, f64::MIN), f64::MIN);
    let mut opposite = 0;
    for _ in 0..60 {
        stage.run(1);
        let now = joints(&stage, walker);
        for leg in [now.left_leg, now.right_leg] {
            hip = (hip.0.min(leg.hip_flexion), hip.1.max(leg.hip_flexion));
            knee = knee.max(leg.knee_flexion);
            assert!(leg.knee_flexion >= 0.0);
        }
        if now.left_arm.shoulder_flexion * now.right_arm.shoulder_flexion < 0.0 {
            opposite += 1;
        }
    }
    // 20° back to 35° ahead, and 60° at the knee, are what is measured (Winter 1991); of two stiff links more.
    assert!(hip.0 < -0.15 && hip.0 > -0.8 && hip.1 > 0.3 && hip.1 < 1.1, "{hip:?}");
    assert!(knee > 0.5 && knee < 1.6, "{knee}");
    assert!(opposite > 40, "arms swing against one another: {opposite}");
    stage.tell(walker, Action::Stop);
    stage.run(10);
    assert_eq!(joints(&stage, walker), JointAngles::default(), "who stands stands straight");
}

#[test]
fn feet_are_put_on_the_treads_of_stairs() {
    let mut stage = Stage::new();
    for step in 0..12 {
        let step = f64::from(step);
        stage.building(2.0 + step * 0.3 + 5.0, 0.0, (10.0, 4.0, 0.17 * (step + 1.0)));
    }
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.34 });
    let (mut on_treads, mut before) = (0, soles_or_origin(&stage, walker));
    for _ in 0..70 {
        stage.run(1);
        let now = soles_or_origin(&stage, walker);
        for foot in 0..2 {
            let bears = (now[foot] - before[foot]).norm() < 0.01;
            if bears && now[foot].x > 2.2 && now[foot].x < 5.0 {
                let tread = ((now[foot].x - 2.0) / 0.3).floor() * 0.17 + 0.17;
                let off = (now[foot].z - tread).abs();
                assert!(off < 0.03 || (off - 0.17).abs() < 0.03, "{} is not on a tread", now[foot]);
                on_treads += usize::from(off < 0.03);
            }
        }
        before = now;
    }
    assert!(on_treads > 8, "{on_treads}");
}

fn soles_or_origin(stage: &Stage, who: EntityId) -> [Point3; 2] {
    if stage.world.joints(who).is_some() { soles(stage, who) } else { [Point3::origin(); 2] }
}

#[test]
fn limbs_of_who_falls_fold_within_their_limits_and_dogs_have_none() {
    let mut stage = Stage::new();
    let mut environment = Environment::default();
    (environment.weather.rain, environment.weather.temperature) = (1.0, -3.0);
    stage.world.set_environment(environment).unwrap();
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 2.0 });
    let mut folded = 0.0f64;
    for _ in 0..30 {
        stage.run(1);
        for (name, angle) in joints(&stage, walker).named() {
            assert!((-1.2..3.2).contains(&angle), "{name}: {angle}");
            folded = folded.max(angle);
        }
    }
    assert!(folded > 0.3, "{folded}");
    let dog = stage.spawn(
        simworld_core::scene::EntityKind::Dog,
        at(20.0, 0.0, 0.0),
        simworld_core::scene::Shape::cuboid(0.7, 0.35, 0.5),
    );
    stage.physics.add_dog(&stage.world, dog).unwrap();
    stage.run(2);
    assert!(stage.world.joints(dog).is_none());
}
