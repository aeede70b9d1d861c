//! Assets by words: what people call things is found first, and nothing is taken for what it is not.

use std::collections::BTreeMap;

use proptest::prelude::*;
use simworld_agents::retrieval::{AssetIndex, Choice, EmbedError, Embedder, Embeddings, Matched};
use simworld_core::asset::{Asset, Catalogue};
use simworld_core::scene::{EntityKind, Shape};

/// `tests/retrieval/queries.toml`, by family: what is said, and the assets that may come first.
fn queries() -> BTreeMap<String, BTreeMap<String, String>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/retrieval/queries.toml");
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    toml::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
}

#[test]
fn the_asset_that_is_meant_comes_first() {
    let catalogue = Catalogue::library();
    let index = AssetIndex::of(&catalogue);
    let (mut asked, mut wrong) = (0, Vec::new());
    for (family, queries) in queries() {
        for (words, gold) in queries {
            let hits = index.retrieve(&words, 3);
            let names: Vec<&str> = hits.iter().map(|hit| hit.name.as_str()).collect();
            for name in gold.split('|').filter(|name| !name.is_empty()) {
                assert!(catalogue.find(name).is_some(), "{family}: there is no {name}");
            }
            let is_right = match names.first() {
                Some(first) => gold.split('|').any(|name| name == *first),
                None => gold.is_empty(),
            };
            // Of what is not there something may be near, and must not be taken.
            let is_right = is_right || gold.is_empty() && matches!(index.choose(&words), Choice::Unsure(_));
            asked += 1;
            if !is_right {
                wrong.push(format!("{family}: {words:?} wants {gold}, got {names:?}"));
            }
        }
    }
    assert!(asked >= 80, "{asked} queries");
    assert!(wrong.is_empty(), "{} of {asked} are wrong:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn every_asset_is_found_by_its_name() {
    let catalogue = Catalogue::library();
    let index = AssetIndex::of(&catalogue);
    for (id, asset) in catalogue.iter() {
        let hits = index.retrieve(&asset.name.replace('_', " "), 1);
        assert_eq!(hits.first().map(|hit| hit.asset), Some(id), "{}: {hits:?}", asset.name);
    }
}

#[test]
fn a_hit_says_why() {
    let index = AssetIndex::of(&Catalogue::library());
    let hits = index.retrieve("wooden sofas", 2);
    assert_eq!(hits[0].name, "couch");
    assert_eq!(hits[0].because, [("couch".to_owned(), Matched::Name)]);
    assert!(!hits[0].is_whole, "it is not wooden");
    let Choice::Sure(hit) = index.choose("a settee") else { panic!("a settee is a couch") };
    assert!(hit.is_whole && hit.name == "couch");
}

#[test]
fn of_equals_the_first_comes_first_and_nothing_is_sure() {
    let prop =
        |name: &str| Asset::new(name, EntityKind::Prop, Shape::cuboid(1.0, 1.0, 1.0)).tagged(["gizmo"]);
    let mut catalogue = Catalogue::new();
    for name in ["zeta", "alpha", "beta"] {
        catalogue.add(prop(name)).unwrap();
    }
    let index = AssetIndex::of(&catalogue);
    let hits = index.retrieve("gizmo", 3);
    let names: Vec<&str> = hits.iter().map(|hit| hit.name.as_str()).collect();
    assert_eq!(names, ["zeta", "alpha", "beta"]);
    assert_eq!(index.retrieve("gizmo", 2), hits[..2]);
    assert!(matches!(index.choose("gizmo"), Choice::Unsure(hits) if hits.len() == 3));
    assert!(matches!(index.choose("alpha gizmo"), Choice::Sure(hit) if hit.name == "alpha"));
    assert!(
        index.retrieve("gizmo", 0).is_empty()
            && AssetIndex::of(&Catalogue::new()).retrieve("gizmo", 3).is_empty()
    );
}

/// Knows two meanings: what swims, and what flies.
struct TwoMeanings;

impl Embedder for TwoMeanings {
    fn embed(&mut self, text: &str) -> Result<Vec<f32>, EmbedError> {
        let has = |words: &[&str]| f32::from(u8::from(words.iter().any(|word| text.contains(word))));
        if text.contains("unspeakable") {
            return Err(EmbedError::Failed {
                text: text.to_owned(),
                why: "it has no words for it".to_owned(),
            });
        }
        if text.contains("flat") {
            return Ok(vec![1.0]);
        }
        Ok(vec![has(&["boat", "vessel"]), has(&["airport", "plane"]), 0.01])
    }
}

#[test]
fn meaning_finds_what_words_do_not() {
    let catalogue = Catalogue::library();
    let index = AssetIndex::of(&catalogue);
    assert!(index.retrieve("vessel", 3).is_empty());
    let embeddings = Embeddings::of(&catalogue, &mut TwoMeanings).unwrap_err();
    assert!(
        matches!(embeddings, EmbedError::Vector { .. }),
        "flats have a vector of another length: {embeddings}"
    );
    let mut boats = Catalogue::new();
    for name in ["bench", "rowing_boat", "taxi", "lighthouse"] {
        boats.add(catalogue.get(catalogue.find(name).unwrap()).unwrap().clone()).unwrap();
    }
    let index = AssetIndex::of(&boats);
    let embeddings = Embeddings::of(&boats, &mut TwoMeanings).unwrap();
    let hits = index.retrieve_with("vessel", 2, &embeddings, &mut TwoMeanings).unwrap();
    assert_eq!((hits[0].name.as_str(), hits[0].because[0].1), ("rowing_boat", Matched::Meaning));
    let hits = index.retrieve_with("boat", 2, &embeddings, &mut TwoMeanings).unwrap();
    assert_eq!((hits[0].name.as_str(), hits[0].because[0].1), ("rowing_boat", Matched::Name));
    assert!(hits[0].score > hits[1].score * 1.5, "two rankings agree");
    assert!(index.retrieve_with("unspeakable", 2, &embeddings, &mut TwoMeanings).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn any_words_are_answered_and_always_the_same(words in "\\PC{0,60}", k in 0usize..20) {
        let mut catalogue = Catalogue::standard();
        let index = AssetIndex::of(&catalogue);
        let hits = index.retrieve(&words, k);
        prop_assert!(hits.len() <= k);
        prop_assert!(hits.windows(2).all(|pair| pair[0].score >= pair[1].score));
        prop_assert_eq!(&hits, &AssetIndex::of(&catalogue).retrieve(&words, k));
        // What is added and shares no word changes no order.
        catalogue.add(Asset::new("qqqq", EntityKind::Door, Shape::cuboid(1.0, 1.0, 1.0))).unwrap();
        let names = |hits: Vec<simworld_agents::retrieval::Hit>| hits.into_iter().map(|hit| hit.name).collect::<Vec<_>>();
        let after = names(AssetIndex::of(&catalogue).retrieve(&words, 40));
        prop_assert_eq!(names(index.retrieve(&words, 40)).len(), after.iter().filter(|name| *name != "qqqq").count());
    }
}
