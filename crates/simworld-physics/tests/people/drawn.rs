//! What a picture is told of people who fall and get up is how their bodies lie, without a jump.

use crate::common::{Stage, at};
use simworld_core::action::Action;
use simworld_core::environment::Environment;
use simworld_core::geometry::{Point3, Vector3};
use simworld_core::id::EntityId;
use simworld_core::limbs::{JointAngles, Side};
use simworld_core::scene::{Footing, Scene};

/// The crown, hands and feet of somebody 1.75 m tall, by pose and joints alone.
fn ends(stage: &Stage, who: EntityId) -> [Point3; 5] {
    let entity = stage.world.entity(who).unwrap();
    let joints: JointAngles = *stage.world.joints(who).unwrap();
    let h = 1.75;
    let down = -Vector3::z();
    let bent = |forward: f64| {
        let (sin, cos) = simworld_core::ops::sin_cos(forward);
        Vector3::new(sin, 0.0, -cos)
    };
    let hand = |side: Side| {
        let arm = if side == Side::Left { joints.left_arm } else { joints.right_arm };
        let shoulder = Vector3::new(0.0, 0.129 * side.sign(), 0.818) * h;
        let reach = down * 0.188 * h + bent(arm.elbow_flexion) * 0.23 * h;
        shoulder + arm.trunk_from_upper_arm(side) * reach
    };
    let foot = |side: Side| {
        let leg = if side == Side::Left { joints.left_leg } else { joints.right_leg };
        let hip = Vector3::new(0.0, 0.052 * side.sign() * h, 0.53 * h - joints.hip_drop);
        hip + leg.trunk_from_thigh(side) * (down * 0.245 * h + bent(-leg.knee_flexion) * 0.246 * h)
    };
    let crown = Vector3::z() * 0.85 * h + joints.neck.trunk_from_head() * Vector3::z() * 0.15 * h
        - Vector3::z() * joints.hip_drop;
    let points = [crown, hand(Side::Left), hand(Side::Right), foot(Side::Left), foot(Side::Right)];
    points.map(|point| entity.pose * Point3::from(point))
}

#[test]
fn who_has_fallen_lies_low_with_all_limbs_and_gets_up_without_a_jump() {
    let mut stage = Stage::new();
    let mut environment = Environment::default();
    (environment.weather.rain, environment.weather.temperature) = (1.0, -3.0);
    stage.world.set_environment(environment).unwrap();
    let who = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(who, Action::MoveForward { speed: 2.5 });
    stage.run(20);
    stage.tell(who, Action::Stop);
    let footing = |stage: &Stage| stage.world.entity(who).unwrap().footing();
    let (mut lay, mut rose, mut before) = (0, 0, None);
    for step in 0..1200 {
        stage.tick(1.0 / 60.0);
        let (footing, ends) = (footing(&stage), ends(&stage, who));
        if footing == Footing::Down {
            lay += 1;
            let highest = ends.iter().map(|end| end.z).fold(f64::NEG_INFINITY, f64::max);
            let lowest = ends.iter().map(|end| end.z).fold(f64::INFINITY, f64::min);
            assert!(highest < 0.75 && lowest > -0.1, "step {step}: {ends:?}");
        }
        if footing == Footing::Rising {
            rose += 1;
            let jump = before.map_or(0.0, |before: [Point3; 5]| {
                before.iter().zip(&ends).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
            });
            assert!(jump < 0.12, "step {step}: something moved by {jump} m in a sixtieth of a second");
        }
        before = Some(ends);
        if rose > 0 && footing == Footing::Upright {
            break;
        }
    }
    assert!(lay > 30 && rose > 60 && footing(&stage) == Footing::Upright, "{lay}, {rose}");
    let stood = ends(&stage, who);
    assert!(stood[0].z > 1.7 && stood[3].z < 0.1 && stood[4].z < 0.1, "{stood:?}");
}
