//! The single-track models against the values that `CommonRoad` publishes for them.
//!
//! `CommonRoad` vehicle models 3.0.2, unit tests of the derivatives: vehicle 2, a BMW 320i, with a steering rate of 0.15
//! rad/s and 0.63 g.

#![expect(clippy::excessive_precision, reason = "the digits are those that are published")]

use simworld_physics::{SingleTrackInput, SingleTrackParameters, SingleTrackState, VehicleClass};

/// The BMW 320i of `CommonRoad` (vehicle models, 2020, table 6) on its tyres (table 7).
fn bmw() -> SingleTrackParameters {
    SingleTrackParameters {
        mass: 1_093.295_233_467_404_6,
        yaw_inertia: 1_791.599_530_012_285_6,
        front: 1.156_195_706_4,
        rear: 1.422_717_093_6,
        height: 0.613_730_04,
        friction: 1.0489,
        front_stiffness: 21.92 / 1.0489,
        rear_stiffness: 21.92 / 1.0489,
        steering_limit: 1.066,
        steering_rate: 0.4,
        acceleration: 11.5,
        switching_speed: 7.319,
        top_speed: 50.8,
        reverse_speed: 13.9,
    }
}

const INPUT: SingleTrackInput = SingleTrackInput { steering_rate: 0.15, acceleration: 0.63 * 9.81 };

fn assert_rates(found: &SingleTrackState, expected: &SingleTrackState) {
    let fields = |s: &SingleTrackState| [s.x, s.y, s.steering, s.speed, s.yaw, s.yaw_rate, s.slip];
    for (index, (a, b)) in fields(found).into_iter().zip(fields(expected)).enumerate() {
        assert!((a - b).abs() < 1e-12, "field {index}: {a} is not {b}");
    }
}

#[test]
fn the_kinematic_rates_are_those_of_commonroad() {
    let state = SingleTrackState {
        x: 3.957_942_229_793_652_6,
        y: 0.039_165_010_277_140_5,
        steering: 0.037_849_142_721_181_1,
        speed: 16.354_695_786_088_356_6,
        yaw: 0.029_471_735_105_281_6,
        ..SingleTrackState::default()
    };
    let expected = SingleTrackState {
        x: 16.347_593_593_425_020_9,
        y: 0.481_931_488_601_312_1,
        steering: 0.15,
        speed: 5.146_442_410_233_975_2,
        yaw: 0.240_142_657_862_762_9,
        ..SingleTrackState::default()
    };
    assert_rates(&bmw().kinematic_rate(&state, &INPUT), &expected);
}

#[test]
fn the_rates_with_slip_are_those_of_commonroad() {
    let state = SingleTrackState {
        x: 2.023_334_814_206_567_7,
        y: 0.004_190_713_771_663_6,
        steering: 0.019_754_524_855_961_7,
        speed: 15.721_623_633_429_011_6,
        yaw: 0.002_585_791_477_685_9,
        yaw_rate: 0.052_900_105_665_403_8,
        slip: 0.003_301_217_061_029_8,
    };
    let expected = SingleTrackState {
        x: 15.721_351_203_086_239_7,
        y: 0.092_552_797_971_935_5,
        steering: 0.15,
        speed: 5.353_677_327_641_392_5,
        yaw: 0.052_900_105_665_403_8,
        yaw_rate: 0.643_558_939_774_860_6,
        slip: 0.031_329_797_164_129_1,
    };
    assert_rates(&bmw().rate(&state, &INPUT), &expected);
}

/// Steps at constant speed and returns the yaw rates.
fn turn(model: &SingleTrackParameters, speed: f64, steering: f64, dt: f64, time: f64) -> Vec<f64> {
    let mut state = SingleTrackState { speed, ..SingleTrackState::default() };
    (0..(time / dt).round() as usize)
        .map(|_| {
            state = model.step(&state, steering, 0.0, dt);
            state.yaw_rate
        })
        .collect()
}

/// Steady yaw rates of the multi-body model of the same car for 0.02 rad: .0779 and .1573 rad/s at 10 and 20 m/s. The
/// single track has no camber, so 5 % are left to it.
#[test]
fn steady_yaw_rates_are_near_those_of_the_multi_body_model() {
    for (speed, expected) in [(10.0, 0.0779), (20.0, 0.1573), (30.0, 0.2277)] {
        let steady = turn(&bmw(), speed, 0.02, 0.01, 10.0)[999];
        assert!((steady / expected - 1.0).abs() < 0.05, "{steady} at {speed} m/s is not {expected}");
    }
    let yaw = turn(&bmw(), 20.0, 0.02, 0.001, 10.0);
    let rise = yaw.iter().position(|rate| *rate >= 0.9 * yaw[9999]).expect("it rises") as f64 * 0.001;
    assert!(
        rise > 0.1 && rise < 0.3,
        "90 % of the yaw rate after {rise} s; the multi-body model 0.22 to 0.24 s"
    );
}

#[test]
fn the_step_is_stable_at_any_speed_and_converges_with_its_length() {
    for class in VehicleClass::ALL {
        let model = SingleTrackParameters::of(&class.parameters(), 1.0);
        for speed in [0.0, 0.05, 0.11, 0.5, 2.0, 8.0, 20.0] {
            let (coarse, fine) = (turn(&model, speed, 0.03, 0.1, 6.0), turn(&model, speed, 0.03, 0.001, 6.0));
            let (coarse, fine) = (coarse[59], fine[5999]);
            assert!(
                (coarse - fine).abs() <= 0.02 * fine.abs() + 1e-9,
                "{class} at {speed}: {coarse} and {fine}"
            );
            let kinematic = speed * simworld_core::ops::tan(0.03) / model.wheelbase();
            if speed < 1.0 {
                assert!((fine - kinematic).abs() <= 0.02 * kinematic + 1e-9, "{class}: slow turns roll");
            }
        }
    }
}
