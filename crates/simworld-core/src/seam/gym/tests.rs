//! What is true of spaces.

use std::collections::BTreeMap;

use super::*;
use crate::seed::Seed;

fn street() -> Space {
    Space::dict([
        ("gear", Space::Discrete { n: 5, start: -1 }),
        ("pedals", Space::bounded(vec![-1.0, 0.0], vec![1.0, f64::INFINITY], vec![2, 1])),
        ("horn", Space::MultiBinary { n: 3 }),
        ("lamps", Space::MultiDiscrete { n: vec![3, 2], start: vec![0, 7] }),
        ("shout", Space::Text { max_length: 12 }),
        ("pair", Space::Tuple(vec![Space::discrete(2), Space::bounded(-2.0, 2.0, vec![])])),
    ])
}

fn town() -> Space {
    let node = Box::new(Space::bounded(0.0, 1.0, vec![2]));
    let edge = Some(Box::new(Space::discrete(4)));
    let graph = Space::Graph { node, edge, max_nodes: 6, max_edges: 9 };
    Space::Tuple(vec![street(), Space::Sequence { of: Box::new(street()), max_length: 4 }, graph])
}

#[test]
fn samples_are_members_and_follow_from_the_seed() {
    let draw = |seed| {
        let mut rng = Seed(seed).stream("spaces").rng();
        (0..200).map(|_| town().sample(&mut rng)).collect::<Vec<_>>()
    };
    assert_eq!(town().validate(), Ok(()));
    assert!(draw(5).iter().all(|value| town().check(value) == Ok(())));
    assert_eq!(draw(5), draw(5));
    assert_ne!(draw(5), draw(6));
    // every value of a small space turns up, and extreme bounds overflow nothing
    let mut rng = Seed(5).stream("spaces").rng();
    let gear = Space::Discrete { n: 3, start: -1 };
    let drawn: std::collections::BTreeSet<_> =
        (0..99).filter_map(|_| gear.sample(&mut rng).as_discrete()).collect();
    assert_eq!(drawn.into_iter().collect::<Vec<_>>(), [-1, 0, 1]);
    let wide = Space::bounded(f64::MIN, f64::MAX, vec![50]);
    assert_eq!(wide.check(&wide.sample(&mut rng)), Ok(()));
}

#[test]
fn strangers_are_named_with_their_place() {
    let mut rng = Seed(5).stream("spaces").rng();
    let SpaceValue::Dict(parts) = street().sample(&mut rng) else { panic!("a dict samples a dict") };
    let changed = |key: &str, value: Option<SpaceValue>| {
        let mut parts: BTreeMap<_, _> = parts.clone();
        parts.remove(key);
        parts.extend(value.map(|value| (key.to_owned(), value)));
        street().check(&SpaceValue::Dict(parts)).expect_err("it is no member")
    };
    let cases = [
        ("gear", Some(SpaceValue::Discrete(4)), "value.gear", "none of the 5 integers from -1"),
        ("gear", Some(SpaceValue::Text(String::new())), "value.gear", "another kind"),
        ("gear", None, "value.gear", "missing"),
        ("reins", Some(SpaceValue::Discrete(0)), "value", "unknown key reins"),
        (
            "pedals",
            Some(SpaceValue::Box(vec![0.0, -0.1])),
            "value.pedals",
            "entry 1 = -0.1 is not in [0, inf]",
        ),
        ("pedals", Some(SpaceValue::Box(vec![f64::NAN, 0.0])), "value.pedals", "entry 0 = NaN"),
        ("pedals", Some(SpaceValue::Box(vec![0.0])), "value.pedals", "1 entries do not fill"),
        ("horn", Some(SpaceValue::MultiBinary(vec![true])), "value.horn", "1 bits where 3"),
        ("lamps", Some(SpaceValue::MultiDiscrete(vec![0, 6])), "value.lamps[1]", "from 7 on"),
        ("shout", Some(SpaceValue::Text("a".repeat(13))), "value.shout", "13 characters"),
        (
            "pair",
            Some(SpaceValue::Tuple(vec![SpaceValue::Discrete(1), SpaceValue::Box(vec![3.0])])),
            "value.pair[1]",
            "not in [-2, 2]",
        ),
    ];
    for (key, value, path, reason) in cases {
        let error = changed(key, value);
        assert_eq!(error.path, path);
        assert!(error.reason.contains(reason), "{error}");
    }
    let graph =
        SpaceValue::Graph { nodes: vec![], edges: vec![SpaceValue::Discrete(0)], links: vec![[0, 0]] };
    let Space::Tuple(parts) = town() else { panic!("a tuple") };
    assert!(parts[2].check(&graph).expect_err("no node").reason.contains("node 0 of 0"));
}

#[test]
fn a_space_that_is_none_is_found() {
    let cases = [
        (Space::discrete(0), "n = 1 or more"),
        (Space::Discrete { n: 2, start: i64::MAX }, "pass the greatest"),
        (Space::bounded(vec![0.0], 1.0, vec![2]), "1 bounds where 2"),
        (Space::bounded(1.0, 0.0, vec![2]), "above its high"),
        (Space::bounded(f64::NAN, 0.0, vec![2]), "above its high"),
        (Space::bounded(0.0, 1.0, vec![usize::MAX, 2]), "too large"),
        (Space::MultiDiscrete { n: vec![2], start: vec![] }, "0 starts where 1"),
        (Space::Sequence { of: Box::new(Space::discrete(0)), max_length: 1 }, "n = 1 or more"),
    ];
    for (space, reason) in cases {
        let error = Space::dict([("part", space)]).validate().expect_err(reason);
        assert!(error.path.starts_with("space.part") && error.reason.contains(reason), "{error}");
    }
}

#[test]
fn flat_forms_have_their_length_and_lead_back() {
    let space = street();
    let length = space.flat_length().expect("its length is known");
    assert_eq!(length, 5 + 2 + 3 + (3 + 2) + 12 + (2 + 1));
    let flat_space = space.flattened().expect("its length is known");
    assert_eq!(flat_space.validate(), Ok(()));
    let mut rng = Seed(8).stream("spaces").rng();
    for _ in 0..200 {
        let value = space.sample(&mut rng);
        let flat = space.flatten(&value).expect("a member");
        assert_eq!(flat.len(), length);
        assert_eq!(flat_space.check(&SpaceValue::Box(flat.clone())), Ok(()));
        assert_eq!(space.unflatten(&flat), Ok(value));
    }
    assert_eq!(Space::Discrete { n: 3, start: 4 }.flatten(&SpaceValue::Discrete(5)), Ok(vec![0.0, 1.0, 0.0]));
    for wrong in [vec![0.0; length], vec![1.0; length], vec![f64::NAN; length], vec![0.0; length - 1]] {
        assert!(space.unflatten(&wrong).is_err());
    }
    assert_eq!(town().flat_length(), None);
    assert_eq!(Space::discrete(u64::MAX).flat_length(), None);
    assert!(town().flattened().is_none());
}

#[test]
fn spaces_and_values_are_written_and_read_back() {
    let mut rng = Seed(8).stream("spaces").rng();
    let (space, value) = (town(), town().sample(&mut rng));
    let text = serde_json::to_string(&space).unwrap();
    assert!(text.contains("\"inf\"") && !text.contains("null,\"inf"), "{text}");
    assert_eq!(serde_json::from_str::<Space>(&text).unwrap(), space);
    let bytes = postcard::to_allocvec(&space).unwrap();
    assert_eq!(postcard::from_bytes::<Space>(&bytes).unwrap(), space);
    let text = serde_json::to_string(&value).unwrap();
    assert_eq!(serde_json::from_str::<SpaceValue>(&text).unwrap(), value);
    let wide = SpaceValue::Box(vec![f64::NEG_INFINITY, 1.0]);
    let text = serde_json::to_string(&wide).unwrap();
    assert_eq!(serde_json::from_str::<SpaceValue>(&text).unwrap(), wide);
    assert!(serde_json::from_str::<SpaceValue>(r#"{"box":["much"]}"#).is_err());
}

#[test]
fn unknown_options_are_refused_by_name() {
    let options = Options::from([("difficulty".to_owned(), 3_i64.into())]);
    assert!(EnvError::refuse_unknown(&options, &["difficulty"]).is_ok());
    let error =
        EnvError::refuse_unknown(&options, &["level", "size"]).expect_err("it is unknown").to_string();
    assert!(error.contains("difficulty") && error.contains("give level, size"), "{error}");
}
