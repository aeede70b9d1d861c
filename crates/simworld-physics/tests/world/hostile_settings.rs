//! Settings, descriptions and models with any numbers in them are refused with the reason, or move on and stay finite.

use crate::hostile::{Change, Hostile, KINDS, changed, survives};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, QuadrupedConfig, VehicleClass};

/// Numbers that somebody means, that somebody mistypes, and that nobody means.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => 1e-3..1e3f64,
        2 => (-20.0..20.0f64).prop_map(simworld_core::ops::exp),
        1 => prop_oneof![Just(0.0), Just(-1.0), Just(f64::NAN), Just(f64::INFINITY), Just(1e300), Just(5e-324)],
        1 => proptest::num::f64::ANY,
    ]
}

fn change() -> impl Strategy<Value = Change> {
    (any::<u16>(), number())
}

fn near_one() -> impl Strategy<Value = f64> {
    prop_oneof![8 => Just(1.0), 4 => 0.3..3.0f64, 1 => number()]
}

fn corner() -> impl Strategy<Value = [f32; 3]> {
    let axis = prop_oneof![30 => -1.0..1.0f32, 10 => Just(0.0f32), 1 => proptest::num::f32::ANY];
    [axis.clone(), axis.clone(), axis]
}

fn hostile() -> impl Strategy<Value = Hostile> {
    let size = ([near_one(), near_one(), near_one()], prop_oneof![3 => 0.5..2000.0f64, 1 => number()]);
    let moving = prop_oneof![4 => Just([0.0; 3]), 1 => [number(), number(), number()]];
    (0..KINDS, vec(change(), 0..2), vec(change(), 0..4), size, moving, vec(corner(), 0..12)).prop_map(
        |(kind, world, body, (stretch, mass), velocity, corners)| Hostile {
            kind,
            world,
            body,
            stretch,
            mass,
            velocity,
            corners,
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn nothing_hostile_ends_in_a_panic_or_in_a_world_that_is_not_finite(hostile in hostile()) {
        survives(&hostile);
    }
}

#[test]
fn bodies_of_every_kind_are_taken_up_and_refused() {
    // Otherwise the property above would say nothing.
    let mut runner = TestRunner::deterministic();
    let mut counts = [[0; 2]; KINDS as usize];
    for _ in 0..800 {
        let case = hostile().new_tree(&mut runner).unwrap().current();
        counts[usize::from(case.kind)][usize::from(survives(&case))] += 1;
    }
    assert!(counts.iter().flatten().all(|count| *count >= 3), "refused and well, by kind: {counts:?}");
}

#[test]
fn every_number_of_settings_is_reached_and_none_may_be_nan() {
    fn refused<T: std::fmt::Debug + serde::Serialize + serde::de::DeserializeOwned>(
        settings: &T,
        count: usize,
        is_valid: impl Fn(&T) -> bool,
    ) {
        assert!(is_valid(&changed(settings, &[]).unwrap()));
        let mut distinct = std::collections::BTreeSet::new();
        for which in 0..200 {
            let Some(settings) = changed(settings, &[(which, f64::NAN)]) else { continue };
            assert!(!is_valid(&settings), "number {which} may be NaN: {settings:?}");
            distinct.insert(postcard::to_allocvec(&settings).unwrap());
        }
        assert!(distinct.len() >= count, "{} numbers", distinct.len());
    }
    refused(&PhysicsConfig::default(), 6, |config| PhysicsDynamics::new(config.clone()).is_ok());
    refused(&HumanoidConfig::default(), 8, |config| config.validate().is_ok());
    refused(&VehicleClass::Sedan.parameters(), 20, |config| config.validate().is_ok());
    refused(&QuadrupedConfig::default(), 20, |config| config.validate().is_ok());
}
