//! Car following as the published model predicts it.

use proptest::prelude::*;
use simworld_traffic::vehicle::{CarFollowing, HARDEST_BRAKING, Idm, Leader, VehicleType};
use simworld_traffic::{TrafficConfig, TrafficError};

/// A file of vehicles behind one that holds `leader(t)`; calls back with speeds and gaps every step.
fn platoon(
    count: usize,
    v: f64,
    leader: impl Fn(f64) -> f64,
    steps: usize,
    mut see: impl FnMut(&[f64], &[f64]),
) {
    const DT: f64 = 0.1;
    let driver = Idm::default();
    let mut speeds = vec![v; count];
    let mut gaps = vec![driver.gap + v * driver.headway; count];
    let mut ahead = v;
    for step in 0..steps {
        let next_ahead = leader(step as f64 * DT);
        let frozen = speeds.clone();
        let mut way_ahead = (ahead + next_ahead) * 0.5 * DT;
        for index in 0..count {
            let before = if index == 0 { ahead } else { frozen[index - 1] };
            let a = driver.acceleration(frozen[index], driver.desired_speed, gaps[index], before);
            speeds[index] = (frozen[index] + a * DT).max(0.0);
            let way = (frozen[index] + speeds[index]) * 0.5 * DT;
            gaps[index] += way_ahead - way;
            way_ahead = way;
        }
        ahead = next_ahead;
        see(&speeds, &gaps);
    }
}

#[test]
fn followers_settle_at_the_equilibrium_gap() {
    for tenths in [20_u32, 50, 80, 110] {
        let v = f64::from(tenths) * 0.1;
        let mut last = Vec::new();
        platoon(5, v, |_| v, 6000, |_, gaps| last = gaps.to_vec());
        // s_e(v) = (s0 + v T) / sqrt(1 - (v / v0)^4), Treiber, Hennecke and Helbing 2000, eq. 11.
        let ratio = (v / 13.9) * (v / 13.9);
        let expected = (2.0 + v) / (1.0 - ratio * ratio).sqrt();
        for gap in last {
            assert!((gap / expected - 1.0).abs() < 0.01, "{gap} m at {v} m/s instead of {expected} m");
        }
    }
}

#[test]
fn platoon_dissolves_without_collision() {
    // The first stops for ten seconds, then drives off freely.
    let first = |t: f64| if t < 10.0 { (10.0 - 3.0 * t).max(0.0) } else { ((t - 10.0) * 1.5).min(13.9) };
    let (mut least, mut last) = (f64::INFINITY, (Vec::new(), Vec::new()));
    platoon(20, 10.0, first, 1500, |speeds, gaps| {
        least = gaps.iter().copied().fold(least, f64::min);
        last = (speeds.to_vec(), gaps.to_vec());
    });
    assert!(least > 0.0, "vehicles touched: {least} m");
    let (speeds, gaps) = last;
    assert!(speeds.iter().all(|v| *v > 12.0), "still slow: {speeds:?}");
    assert!(gaps[0] > 15.0, "the platoon did not spread: {gaps:?}");
}

proptest! {
    #[test]
    fn no_leader_is_ever_hit(v in 0.0..13.9_f64, changes in prop::collection::vec(0.0..13.9_f64, 1..8)) {
        let targets = changes.clone();
        // The leader jumps towards each target as hard as tyres allow, for four seconds each.
        let leader_speed = std::cell::Cell::new(v);
        let leader = |t: f64| {
            let target = targets[(t / 4.0) as usize % targets.len()];
            let now = leader_speed.get();
            leader_speed.set(now + (target - now).clamp(-0.9, 0.3));
            leader_speed.get()
        };
        let mut least = f64::INFINITY;
        platoon(6, v, leader, 400, |_, gaps| least = gaps.iter().copied().fold(least, f64::min));
        prop_assert!(least > 0.0, "vehicles touched: {least} m");
    }
}

const MODELS: [CarFollowing; 3] =
    [CarFollowing::Idm, CarFollowing::Krauss { sigma: 0.0 }, CarFollowing::Acc { coolness: 0.99 }];

/// Speed and way after a step; it comes to rest within it rather than go backwards.
fn advance(v: f64, acceleration: f64, dt: f64) -> (f64, f64) {
    let after = v + acceleration * dt;
    if after >= 0.0 { (after, (v + after) * 0.5 * dt) } else { (0.0, v * v / (-2.0 * acceleration)) }
}

/// A leader brakes as hard as it can; the follower starts from any state in which it keeps its own gap at rest and time gap.
#[test]
fn by_no_model_a_leader_that_brakes_as_hard_as_it_can_is_hit() {
    let driver = Idm::default();
    for model in MODELS {
        for dt in [0.05, 0.1, 0.2, 0.5] {
            for (own, leading) in (0..28).flat_map(|own| (0..28).map(move |leading| (own, leading))) {
                let (mut v, mut speed) = (f64::from(own) * 0.5, f64::from(leading) * 0.5);
                let mut gap = driver.gap + v * driver.headway;
                // In the first step the leader has not begun to brake, as far as the follower can see.
                let mut acceleration = 0.0;
                for _ in 0..400 {
                    let ahead = Some(Leader { gap, speed, acceleration });
                    let a = model.acceleration(&driver, v, driver.desired_speed, ahead, dt);
                    assert!(a >= -HARDEST_BRAKING - 1e-9, "{model:?} brakes at {a} m/s²");
                    let (next, way) = advance(v, a, dt);
                    let (next_leader, leader_way) = advance(speed, -HARDEST_BRAKING, dt);
                    gap += leader_way - way;
                    (v, speed, acceleration) = (next, next_leader, -HARDEST_BRAKING);
                    assert!(gap > 0.0, "{model:?} hits from {own}/2 m/s behind {leading}/2 m/s at dt {dt}");
                }
                assert!(v < 0.1, "{model:?} still drives at {v} m/s");
            }
        }
    }
}

#[test]
fn models_have_ranges_that_are_checked() {
    let table = |model| {
        let car = VehicleType { model, ..VehicleType::default() };
        TrafficConfig { types: vec![car], ..TrafficConfig::default() }.validate()
    };
    for model in MODELS {
        table(model).expect("it is in range");
    }
    for (model, named) in [
        (CarFollowing::Krauss { sigma: 1.01 }, "model.krauss.sigma"),
        (CarFollowing::Krauss { sigma: f64::NAN }, "model.krauss.sigma"),
        (CarFollowing::Acc { coolness: -0.1 }, "model.acc.coolness"),
        (CarFollowing::Acc { coolness: f64::INFINITY }, "model.acc.coolness"),
    ] {
        let refused = table(model).expect_err("it is out of range");
        assert!(
            matches!(&refused, TrafficError::VehicleType { index: 0, field, .. } if *field == named),
            "{refused}"
        );
        assert!(refused.to_string().contains("types[0].model"), "{refused}");
    }
}
