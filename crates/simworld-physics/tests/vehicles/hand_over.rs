//! A vehicle goes over between full and reduced detail without a jump.
#![allow(clippy::unwrap_used)]

use simworld_core::action::Action;
use simworld_core::geometry::Point3;
use simworld_core::seam::{BodyState, Dynamics};
use simworld_physics::proving::{Run, STEP};
use simworld_physics::{Detail, RoadCondition, VehicleClass};

fn state(run: &Run) -> BodyState {
    run.physics.state(run.vehicle).unwrap()
}

/// Drives past a point of interest in a wide turn and checks every step against the one before.
fn drive_by(class: VehicleClass, speed: f64) -> usize {
    let mut run = Run::new(&class.parameters(), RoadCondition::Dry, speed).unwrap();
    let mut changes = 0;
    run.tell(Action::Steer { angle: 0.01 }).unwrap();
    run.physics.set_interest(&[Point3::new(900.0, 0.0, 0.0)]);
    run.hold_speed(speed).unwrap();
    run.coast(1.0).unwrap(); // until it turns steadily
    let mut before = (state(&run), run.physics.detail(run.vehicle));
    for step in 0..(14.0 / STEP) as usize {
        // Interest moves across the vehicle: reduced, full, reduced again.
        let interest = Point3::new(run.position().x + 400.0 - 60.0 * step as f64 * STEP, 0.0, 0.0);
        run.physics.set_interest(&[interest]);
        run.hold_speed(speed).unwrap();
        run.step().unwrap();
        let now = (state(&run), run.physics.detail(run.vehicle));
        changes += usize::from(step > 0 && now.1 != before.1);
        let (a, b) = (&before.0, &now.0);
        let moved = b.pose.translation.vector - a.pose.translation.vector;
        let expected = (a.twist.linear + b.twist.linear) * (0.5 * STEP);
        assert!((moved - expected).norm() < 0.01, "{class} step {step}: moved {moved:?}, not {expected:?}");
        let change = (b.twist.linear - a.twist.linear).norm();
        assert!(change < 12.0 * STEP, "{class} step {step}: velocity jumps by {change} m/s");
        let turn = (b.twist.angular.z - a.twist.angular.z).abs();
        assert!(turn < 0.02, "{class} step {step}: yaw rate jumps by {turn} rad/s");
        let tilt = a.pose.rotation.angle_to(&b.pose.rotation);
        assert!(tilt < 0.02, "{class} step {step}: attitude jumps by {tilt} rad");
        before = now;
    }
    changes
}

#[test]
fn no_class_jumps_when_its_detail_changes() {
    for class in VehicleClass::ALL {
        let speed = if *class == VehicleClass::Scooter { 5.0 } else { 12.0 };
        assert_eq!(drive_by(*class, speed), 2, "{class} goes over twice");
    }
}

#[test]
fn far_from_interest_a_vehicle_still_accelerates_and_brakes() {
    let drive = |interest: &[Point3]| {
        let mut run = Run::new(&VehicleClass::Sedan.parameters(), RoadCondition::Dry, 0.0).unwrap();
        run.physics.set_interest(interest);
        run.tell(Action::Throttle { level: 1.0 }).unwrap();
        run.coast(6.0).unwrap();
        let speed = run.speed();
        run.tell(Action::Brake { level: 0.5 }).unwrap();
        run.coast(8.0).unwrap();
        assert!(run.speed() < 0.01, "it stands: {} m/s", run.speed());
        (speed, run.position().x)
    };
    let (full, full_way) = drive(&[]);
    let (reduced, reduced_way) = drive(&[Point3::new(1e5, 0.0, 0.0)]);
    assert!((reduced / full - 1.0).abs() < 0.05, "{reduced} and {full} m/s");
    assert!((reduced_way / full_way - 1.0).abs() < 0.08, "{reduced_way} and {full_way} m");
}

#[test]
fn restoring_in_the_middle_of_a_turn_goes_on_bit_for_bit() {
    for interest in [vec![], vec![Point3::new(1e5, 0.0, 0.0)]] {
        for class in VehicleClass::ALL {
            let make = || {
                let mut run = Run::new(&class.parameters(), RoadCondition::Wet, 5.0).unwrap();
                run.physics.set_interest(&interest);
                run.tell(Action::Steer { angle: 0.05 }).unwrap();
                run.tell(Action::Throttle { level: 0.6 }).unwrap();
                run
            };
            let mut straight = make();
            straight.coast(1.0).unwrap();
            let (saved, world) = (straight.physics.save().unwrap(), straight.world.clone());
            straight.coast(1.0).unwrap();
            let mut resumed = make();
            resumed.world = world;
            resumed.physics.restore(&resumed.world, &saved).unwrap();
            resumed.coast(1.0).unwrap();
            assert_eq!(state(&straight), state(&resumed), "{class}");
            assert_eq!(straight.physics.save().unwrap(), resumed.physics.save().unwrap(), "{class}");
            let expected = if interest.is_empty() { Detail::Full } else { Detail::Reduced };
            assert_eq!(resumed.physics.detail(resumed.vehicle), Some(expected));
        }
    }
}
