//! Everyday things from words: closed solids that stand on the ground, weigh what is plausible, and are what was asked for.

use std::collections::BTreeMap;

use proptest::prelude::*;
use simworld_agents::editing::{Edit, EditError, SceneEditor, Stand};
use simworld_agents::generation::{
    AssetGenerator, AssetPrompt, GenerateError, KnownThing, Made, ProceduralGenerator, SizeHint,
};
use simworld_core::asset::{Asset, Catalogue, Model};
use simworld_core::geometry::{Point2, Point3, pose_facing};
use simworld_core::hash::StateHash;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seed::Seed;

fn make(words: &str, seed: u64) -> Made {
    let prompt = AssetPrompt::new(words).seeded(seed);
    ProceduralGenerator::new().generate(&prompt).unwrap_or_else(|error| panic!("{words:?}: {error}"))
}

fn refused(words: &str) -> GenerateError {
    match ProceduralGenerator::new().generate(&AssetPrompt::new(words)) {
        Ok(made) => panic!("{words:?} was made: {}", made.asset.name),
        Err(error) => error,
    }
}

fn model(asset: &Asset) -> &Model {
    asset.model.as_deref().expect("what is made has a model")
}

fn height(words: &str) -> f64 {
    make(words, 1).asset.collider.size().z
}

/// Each thing in the words that change it, and in some that change every thing.
fn prompts(thing: &KnownThing) -> Vec<String> {
    let name = thing.name;
    let sizes = ["tall", "wide", "small", "very big", "thin", "long", "short"];
    let mut all = vec![name.to_owned(), format!("a blue {name}")];
    all.extend(sizes.iter().map(|size| format!("{size} {name}")));
    all.extend(thing.prompts.iter().cloned());
    all
}

#[test]
fn everything_is_closed_and_stands_on_the_ground() {
    let seeds: &[u64] = if soak() { &[1, 2, 3, 4, 5, 6, 7, 8] } else { &[1, 2] };
    assert!(ProceduralGenerator::things().count() >= 60, "a grammar of everyday things");
    for thing in ProceduralGenerator::things() {
        for words in prompts(&thing) {
            for seed in seeds {
                let made = make(&words, *seed);
                let asset = made.asset;
                assert_eq!(asset.validate(), Ok(()), "{words}");
                let model = model(&asset);
                let [low, high] = model.bounds().unwrap();
                let half = asset.collider.size() * 0.5;
                assert!(low[2].abs() < 1e-5, "{words}: its lowest point is at {}", low[2]);
                assert!(
                    f64::from(high[0]) <= half.x + 2e-3 && f64::from(high[1]) <= half.y + 2e-3,
                    "{words}"
                );
                is_closed(model, &words);
            }
        }
    }
}

/// Every edge is as often there one way as the other, and the triangles look outwards.
fn is_closed(model: &Model, words: &str) {
    let place = |vertex: u32| model.vertices[vertex as usize].position.map(f32::to_bits);
    for (part, triangles) in model.runs() {
        let mut edges: BTreeMap<([u32; 3], [u32; 3]), i32> = BTreeMap::new();
        let mut volume = 0.0;
        for triangle in triangles {
            for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                let (a, b) = (place(triangle[from]), place(triangle[to]));
                *edges.entry(if a < b { (a, b) } else { (b, a) }).or_default() += if a < b { 1 } else { -1 };
            }
            let [a, b, c] = triangle.map(|vertex| vector(model.vertices[vertex as usize].position));
            volume += a.dot(&b.cross(&c)) / 6.0;
            let (face, normal) =
                ((b - a).cross(&(c - a)), vector(model.vertices[triangle[0] as usize].normal));
            assert!(
                face.norm() < 1e-9 || face.normalize().dot(&normal) > 0.05,
                "{words}: {} is shaded from inside",
                part.name
            );
        }
        assert!(edges.values().all(|balance| *balance == 0), "{words}: {} is open", part.name);
        assert!(volume > 0.0, "{words}: {} is inside out, {volume} m³", part.name);
    }
}

fn vector([x, y, z]: [f32; 3]) -> nalgebra::Vector3<f64> {
    nalgebra::Vector3::new(f64::from(x), f64::from(y), f64::from(z))
}

#[test]
fn what_is_met_is_what_is_seen() {
    for thing in ProceduralGenerator::things() {
        let made = make(thing.name, 3);
        let model = model(&made.asset);
        let hulls: Vec<Vec<nalgebra::Vector3<f64>>> =
            model.hulls.iter().map(|hull| hull.points.iter().copied().map(vector).collect()).collect();
        let met: Vec<_> = hulls.iter().flatten().copied().collect();
        let is_near = |points: &[nalgebra::Vector3<f64>], point: &nalgebra::Vector3<f64>| {
            points.iter().any(|other| (other - point).norm_squared() < 1e-8)
        };
        let corners: Vec<_> = model.vertices.iter().map(|vertex| vector(vertex.position)).collect();
        for point in &corners {
            let gap = || hulls.iter().map(|hull| distance(hull, *point)).fold(f64::INFINITY, f64::min);
            let is_met = is_near(&met, point) || gap() < 0.02;
            assert!(is_met, "{}: {} is {} m outside of what is met", thing.name, point.transpose(), gap());
        }
        // A hull has its corners on what is seen, so that no opening is filled.
        for point in &met {
            let is_seen = is_near(&corners, point)
                || hulls.iter().filter(|hull| distance(hull, *point) < 1e-3).count() > 1;
            assert!(is_seen, "{}: a hull reaches out to {}", thing.name, point.transpose());
        }
    }
}

/// How far a point is outside of the hull of others (Gilbert's algorithm), m.
fn distance(hull: &[nalgebra::Vector3<f64>], point: nalgebra::Vector3<f64>) -> f64 {
    let mut nearest = hull[0] - point;
    for _ in 0..3000 {
        let support = hull
            .iter()
            .map(|corner| corner - point)
            .min_by(|a, b| a.dot(&nearest).total_cmp(&b.dot(&nearest)));
        let support = support.expect("a hull has corners");
        let gap = nearest.norm_squared() - nearest.dot(&support);
        if gap <= 1e-9 || nearest.norm() < 1e-4 {
            break;
        }
        let way = support - nearest;
        let share = (-nearest.dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
        nearest += way * share;
    }
    nearest.norm()
}

#[test]
fn masses_are_plausible() {
    let mut odd = Vec::new();
    for thing in ProceduralGenerator::things() {
        for seed in 0..4 {
            let mass = make(thing.name, seed).asset.mass.unwrap();
            if !(thing.mass[0]..=thing.mass[1]).contains(&mass) {
                odd.push(format!("a {} of {mass:.1} kg: {:?}", thing.name, thing.mass));
            }
        }
    }
    assert!(odd.is_empty(), "{odd:#?}");
    let kilograms = |words: &str| make(words, 1).asset.mass.unwrap();
    assert!(kilograms("concrete bench") > 2.0 * kilograms("wooden bench"));
    assert!(kilograms("plastic bucket") < kilograms("metal bucket"));
}

#[test]
fn the_same_words_make_the_same_bits() {
    for thing in ProceduralGenerator::things() {
        let [one, again, other] = [7, 7, 8].map(|seed| make(thing.name, seed));
        assert!(one == again, "{}", thing.name);
        assert!(one.asset.model != other.asset.model, "{}: another seed is another one", thing.name);
        assert_ne!(one.asset.name, other.asset.name);
    }
}

#[test]
fn every_word_that_is_said_to_change_a_thing_does() {
    for thing in ProceduralGenerator::things() {
        let look = |asset: &Asset| (asset.model.clone(), asset.color, asset.mass.map(f64::to_bits));
        let plain = make(thing.name, 5).asset;
        for words in &thing.prompts {
            let made = make(words, 5);
            assert!(made.unused.is_empty(), "{words:?}: {:?} unused", made.unused);
            assert!(look(&made.asset) != look(&plain), "{words:?} is just a {}", thing.name);
        }
    }
}

#[test]
fn words_mean_what_they_say() {
    assert!(height("tall lamp post") > 1.3 * height("lamp post"));
    assert!(height("a very tall lamp post") > height("tall lamp post"));
    assert!(height("a tiny snowman") < 0.5 * height("a snowman"));
    let red = make("a red wooden bench", 1).asset;
    let [r, g, b] = red.color.unwrap();
    assert!(r > 5.0 * g && r > 5.0 * b, "{red:?}");
    assert_eq!(red.material.unwrap().as_str(), "wood");
    let long = make("a long bench", 1).asset.collider.size();
    assert!(long.y > 2.4 && long.z < 1.0, "{long}");

    for (words, axis, size) in [
        ("a wooden gate 2 m high", 2, 2.0),
        ("a bench 250 cm long", 1, 2.5),
        ("a table with a width of 1.2 metres", 1, 1.2),
        ("a 6 m flag pole", 2, 6.0),
        ("a lamp post that is 5 metres tall", 2, 5.0),
        ("a 3 by 2 m market stall", 1, 3.0),
        ("a 3 by 2 m market stall", 0, 2.0),
    ] {
        let made = make(words, 1);
        let side = made.asset.collider.size()[axis];
        assert!((side - size).abs() < 1e-3, "{words}: {side}");
        assert!(made.unused.is_empty(), "{words}: {:?}", made.unused);
    }
    let parts = |words: &str, name: &str| {
        model(&make(words, 1).asset)
            .parts
            .iter()
            .filter(|part| part.name == name)
            .map(|part| part.triangles)
            .sum::<u32>()
    };
    assert_eq!(parts("five-legged stool", "leg") * 3, parts("stool with three legs", "leg") * 5);
    assert_eq!(parts("shelf without books", "books"), 0);
    assert!(parts("shelf", "books") > 0);
    assert_eq!(parts("ladder with twelve rungs", "rung") * 4, parts("ladder with 4 rungs", "rung") * 12);
    let hinted = AssetPrompt {
        size: SizeHint { height: Some(1.2), ..SizeHint::default() },
        ..AssetPrompt::new("barrel")
    };
    let barrel = ProceduralGenerator::new().generate(&hinted).unwrap();
    assert!((barrel.asset.collider.size().z - 1.2).abs() < 1e-6);
}

#[test]
fn names_go_to_the_thing_that_they_name() {
    for (words, name) in [
        ("a tall green lamp post", "lamp_post"),
        ("a wooden market stall", "market_stall"),
        ("three-legged stool", "stool"),
        ("a stone arch bridge", "bridge"),
        ("a dog house with a red roof", "dog_house"),
        ("an old see-saw", "see_saw"),
        ("a red and white parasol", "parasol"),
        ("two benches", "bench"),
        ("a bale of hay", "hay_bale"),
        ("a palm tree", "palm"),
    ] {
        let made = make(words, 1).asset.name;
        assert!(made.starts_with(name), "{words}: {made}");
    }
    let striped = make("a red and white parasol", 1).asset;
    let colors = &model(&striped).vertices;
    assert!(colors.iter().any(|vertex| vertex.color == [0.8, 0.8, 0.8]), "its second colour is white");
}

#[test]
fn what_was_not_understood_is_said() {
    assert_eq!(make("a melancholy bench with 3 cats", 1).unused, ["melancholy", "3", "cats"]);
    assert_eq!(make("a round fence", 1).unused, ["round"]);
    assert_eq!(make("a wooden cactus", 1).unused, ["wooden"]);
    for words in ["a zeppelin", "a chair lift", "spaghetti", "a thing with a chair", "12 34", "of", "?!"] {
        match refused(words) {
            GenerateError::Unknown { near, .. } => assert_eq!(near.len(), 3, "{words}"),
            other => panic!("{words}: {other}"),
        }
    }
    match refused("a wooden lampost") {
        GenerateError::Unknown { near, .. } => assert_eq!(near[0], "lamp post"),
        other => panic!("{other}"),
    }
    for words in [
        "a bench 90 m long",
        "a stool with 100 legs",
        "a table without legs",
        "a very huge giant table",
        "a stool with 2.5 legs",
    ] {
        assert!(matches!(refused(words), GenerateError::Range { .. }), "{words}");
    }
    assert!(matches!(refused(" "), GenerateError::Empty));
    assert!(matches!(refused(&"bench ".repeat(200)), GenerateError::TooLong { .. }));
    let pictured = AssetPrompt { image: Some(vec![1, 2]), ..AssetPrompt::new("bench") };
    assert!(matches!(ProceduralGenerator::new().generate(&pictured), Err(GenerateError::Image { .. })));
}

#[test]
fn an_editor_makes_what_no_catalogue_has() {
    let say = |editor: SceneEditor| {
        let (mut editor, mut world) = (editor.with_catalogue(Catalogue::standard()), World::new());
        let outcome = editor.say("add a tall wooden obelisk", &mut world);
        (editor, world, outcome)
    };
    let (_, world, outcome) = say(SceneEditor::new(Seed(3)));
    assert!(
        matches!(outcome, Err(EditError::UnknownThing { .. })),
        "only who wants a generator has one: {outcome:?}"
    );
    assert!(world.is_empty());

    let (mut editor, mut world, outcome) =
        say(SceneEditor::new(Seed(3)).with_generator(ProceduralGenerator::new()));
    let done = outcome.unwrap();
    let made = world.entity(done.made[0]).unwrap();
    assert!(made.info.shape.size().z > 7.0, "it is tall: {:?}", made.info.shape);
    let asset = world.assets().unwrap().get(made.info.asset.unwrap()).unwrap();
    assert!(asset.model.is_some() && asset.material.unwrap().as_str() == "wood");
    assert!(done.answer.unwrap().contains("generated obelisk from"), "the answer says that it was generated");
    let (_, again, _) = say(SceneEditor::new(Seed(3)).with_generator(ProceduralGenerator::new()));
    assert_eq!(StateHash::digest(&world), StateHash::digest(&again));

    editor.undo(&mut world).unwrap();
    assert!(world.is_empty());
    editor.redo(&mut world).unwrap();
    assert_eq!(world.len(), 1);
    let refused = editor.say("add a zeppelin", &mut world);
    assert!(matches!(refused, Err(EditError::UnknownThing { .. })), "{refused:?}");
    assert!(refused.unwrap_err().to_string().contains("not generated: "), "it says why nothing was made");
    assert_eq!(world.len(), 1);
}

/// Whether something of a text tells assets of one name from each other, and nothing to people.
fn has_address(text: &str) -> bool {
    let mut words = text.split(|letter: char| !letter.is_ascii_alphanumeric());
    words.any(|word| word.len() >= 8 && word.bytes().all(|letter| letter.is_ascii_hexdigit()))
}

#[test]
fn what_was_made_is_known_by_its_words_in_later_orders_and_in_answers() {
    let mut world = World::new();
    let pose = pose_facing(Point3::new(30.0, 0.0, 0.0), 0.0);
    world.spawn(EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.85))).unwrap();
    let mut editor = SceneEditor::new(Seed(3))
        .with_catalogue(Catalogue::standard())
        .with_generator(ProceduralGenerator::new());
    let done = editor.say("add a tall wooden obelisk", &mut world).unwrap();
    let obelisk = done.made[0];
    let told = done.answer.expect("it says that it was made");
    assert!(told.contains("generated obelisk from") && !has_address(&told), "{told}");

    let done = editor.say("paint the obelisk red", &mut world).unwrap();
    assert!(matches!(&done.edits[..], [Edit::Paint { things, .. }] if *things == [obelisk]), "{done:?}");
    let [red, green, blue] = world.entity(obelisk).unwrap().info.color.unwrap();
    assert!(red > 5.0 * green && red > 5.0 * blue);
    for (edit, begins) in [
        (Edit::Describe { thing: obelisk }, format!("obelisk ({obelisk}), a prop, ")),
        (Edit::List { things: vec![obelisk] }, format!("obelisk ({obelisk}) at ")),
    ] {
        let told = editor.edit(&[edit], &mut world).unwrap().answer.expect("it is a question");
        assert!(told.starts_with(&begins) && !has_address(&told), "{told}");
    }

    let done = editor.say("add another one like that next to the bench", &mut world).unwrap();
    assert!(matches!(&done.edits[..], [Edit::Copy { thing, count: 1, .. }] if *thing == obelisk), "{done:?}");
    assert!(done.answer.is_none_or(|told| !has_address(&told)));
    let copy = world.entity(done.made[0]).unwrap();
    assert_eq!(copy.info.asset, world.entity(obelisk).unwrap().info.asset);
    assert!((copy.planar() - Point2::new(30.0, 0.0)).norm() < 10.0, "it stands beside the bench");

    // Of two nobody knows which; both are called so, also by an editor that has made nothing.
    let mut other = SceneEditor::new(Seed(4)).with_catalogue(Catalogue::standard());
    let asked = other.say("remove the obelisk", &mut world).unwrap_err();
    let EditError::Ambiguous { candidates, .. } = &asked else { panic!("{asked}") };
    assert!(candidates.len() == 2 && candidates.iter().all(|(_, label)| label.starts_with("obelisk")));
    assert!(!has_address(&asked.to_string()), "{asked}");
    let done = other.say("paint both obelisks blue", &mut world).unwrap();
    assert!(matches!(&done.edits[..], [Edit::Paint { things, .. }] if things.len() == 2), "{done:?}");
    let stands = vec![Stand::At { point: Point2::new(30.0, 0.0) }];
    let refused = other.edit(&[Edit::Copy { thing: obelisk, count: 1, stands }], &mut world).unwrap_err();
    assert!(matches!(&refused, EditError::NoRoom { what, .. } if what == "obelisk"), "{refused}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if soak() { 20_000 } else { 300 }))]

    #[test]
    fn no_words_break_it(words in "\\PC{0,60}", seed: u64) {
        check(&words, seed);
    }

    #[test]
    fn no_sentence_of_its_own_words_breaks_it(words in prop::collection::vec(prop::sample::select(VOCABULARY), 1..8), seed in 0_u64..100) {
        check(&words.join(" "), seed);
    }
}

/// What comes is an asset, or a typed error.
fn check(words: &str, seed: u64) {
    if let Ok(made) = ProceduralGenerator::new().generate(&AssetPrompt::new(words).seeded(seed)) {
        assert_eq!(made.asset.validate(), Ok(()), "{words:?}");
        is_closed(model(&made.asset), words);
    }
}

#[rustfmt::skip]
const VOCABULARY: &[&str] = &["bench", "table", "arch", "fence", "bridge", "boat", "slide", "cactus", "snowman", "pyramid", "fountain", "bookshelf", "gate",
    "wall", "lamp post", "tower", "water tower", "with", "without", "no", "and", "of", "tall", "very", "tiny", "huge", "wide", "thin", "long", "round",
    "square", "red", "dark", "blue", "light", "stone", "metal", "legs", "boards", "steps", "sails", "rows", "bars", "0", "1", "2", "three", "7", "12",
    "m", "cm", "high", "height", "by", "x", "-3", "1e9", "0.0001", "roof", "handle", "striped"];

fn soak() -> bool {
    std::env::var_os("SIMWORLD_SOAK").is_some_and(|value| value == "1")
}
