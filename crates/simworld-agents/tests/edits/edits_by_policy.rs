//! What an editor does beyond one plain answer: several things that fit, places that have no room, things that are made, and words
//! that mean what they do not say.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use simworld_agents::editing::{
    Difference, Edit, EditError, Edited, Line, Make, Relaxed, SceneEditor, Spacing, Stand,
};
use simworld_agents::generation::{AssetGenerator, AssetPrompt, GenerateError, Made, ProceduralGenerator};
use simworld_agents::language::AmbiguityPolicy;
use simworld_agents::retrieval::{EmbedError, Embedder};
use simworld_core::asset::{Asset, Catalogue};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Relation, Scene, Shape, World};
use simworld_core::seed::Seed;

use crate::city::City;
use crate::edits_common::{CITIES, taught_in};

fn put(world: &mut World, kind: EntityKind, [x, y]: [f64; 2], [length, width]: [f64; 2]) -> EntityId {
    let pose = pose_facing(Point3::new(x, y, 0.0), 0.0);
    world.spawn(EntityDesc::new(kind, pose, Shape::cuboid(length, width, 0.85))).unwrap()
}

fn bench(world: &mut World, x: f64) -> EntityId {
    put(world, EntityKind::Bench, [x, 0.0], [0.6, 1.8])
}

/// Blocks all around the origin: free within the inner half-sizes, and beyond the outer one.
fn fenced(world: &mut World, [x, y]: [f64; 2], outer: f64) {
    let mut block = |at, size| put(world, EntityKind::Building, at, size);
    for side in [-1.0, 1.0] {
        block([0.0, side * (y + outer) * 0.5], [outer * 2.0, outer - y]);
        block([side * (x + outer) * 0.5, 0.0], [outer - x, y * 2.0]);
    }
}

// ---- which of several ----

/// Three benches: the second is the nearest, the first has the lowest number.
fn benches() -> (World, [EntityId; 3]) {
    let mut world = World::new();
    let ids = [bench(&mut world, 20.0), bench(&mut world, 8.0), bench(&mut world, 14.0)];
    (world, ids)
}

fn under(policy: AmbiguityPolicy, words: &str, world: &mut World) -> Result<Edited, EditError> {
    SceneEditor::new(Seed(7)).with_policy(policy).say(words, world)
}

#[test]
fn every_policy_edits_the_thing_that_it_takes_and_says_which() {
    for (policy, which, how) in
        [(AmbiguityPolicy::Nearest, 1, "the nearest"), (AmbiguityPolicy::First, 0, "the first")]
    {
        let (mut world, ids) = benches();
        let before = world.clone();
        let done = under(policy, "remove the bench", &mut world).unwrap();
        assert_eq!(Difference::between(&before, &world).removed, [ids[which]], "{policy:?}");
        let [taken] = &done.taken[..] else { panic!("{:?}", done.taken) };
        assert_eq!((taken.thing, taken.of, taken.policy), (ids[which], 3, policy));
        let answer = done.answer.unwrap();
        assert!(answer.contains(how) && answer.contains(&format!("({})", ids[which])), "{answer}");
    }
}

#[test]
fn an_anchor_is_taken_as_the_policy_says() {
    for (policy, which) in [(AmbiguityPolicy::Nearest, 1), (AmbiguityPolicy::First, 0)] {
        let (mut world, ids) = benches();
        let done = under(policy, "add a chair next to the bench", &mut world).unwrap();
        let beside = Stand::To { relation: Relation::NextTo, anchor: ids[which] };
        assert!(beside.holds(&world, done.made[0]), "{policy:?}");
        assert_eq!(done.taken[0].thing, ids[which]);
    }
}

#[test]
fn of_several_that_are_counted_as_many_are_taken() {
    let (mut world, ids) = benches();
    under(AmbiguityPolicy::Nearest, "remove the two benches", &mut world).unwrap();
    assert!(world.entity(ids[0]).is_some() && world.len() == 1, "the farthest is left");
}

#[test]
fn of_two_that_are_named_one_is_taken() {
    for (policy, is_chair) in [(AmbiguityPolicy::Nearest, true), (AmbiguityPolicy::First, false)] {
        let mut world = World::new();
        let bench = bench(&mut world, 20.0);
        let chair = put(&mut world, EntityKind::Chair, [8.0, 0.0], [0.5, 0.5]);
        let words = "remove the bench or the chair";
        let asked = under(AmbiguityPolicy::Ask, words, &mut world);
        assert!(matches!(asked, Err(EditError::Ambiguous { .. })), "{asked:?}");
        let done = under(policy, words, &mut world).unwrap();
        assert_eq!(done.taken[0].thing, if is_chair { chair } else { bench }, "{policy:?}");
        assert_eq!(world.len(), 1);
    }
}

#[test]
fn nothing_is_taken_where_nothing_is_open() {
    for words in ["remove the nearest bench", "remove all benches", "how many benches are there"] {
        let (mut plain, _) = benches();
        let (mut taken, _) = benches();
        let asked = SceneEditor::new(Seed(7)).say(words, &mut plain).unwrap();
        let done = under(AmbiguityPolicy::First, words, &mut taken).unwrap();
        assert_eq!(asked, done, "{words}");
        assert_eq!(done.taken, [], "{words}");
    }
}

#[test]
fn what_is_open_is_asked_about_by_default_and_settled_by_a_policy() {
    let (mut asked_back, mut unsettled) = (0, Vec::new());
    for name in CITIES {
        let city = City::read(name);
        for asked in taught_in(name).into_iter().filter(|asked| asked.meaning.starts_with("? ")) {
            let say = |policy: Option<AmbiguityPolicy>| {
                let mut world = city.world.clone();
                let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
                if let Some(policy) = policy {
                    editor = editor.with_policy(policy);
                }
                let outcome = editor.say(&asked.words, &mut world);
                (outcome, Difference::between(&city.world, &world))
            };
            let (outcome, changed) = say(None);
            let Err(EditError::Ambiguous { candidates, .. }) = &outcome else {
                panic!("{name}: {:?} did not ask: {outcome:?}", asked.words)
            };
            assert!(changed.is_empty(), "{}", asked.words);
            assert_eq!(say(Some(AmbiguityPolicy::Ask)).1, changed, "{}", asked.words);
            asked_back += 1;
            match say(Some(AmbiguityPolicy::First)).0 {
                Ok(done) => {
                    let is_taken =
                        |(id, _): &(EntityId, String)| done.taken.iter().any(|taken| taken.thing == *id);
                    assert!(
                        candidates.iter().any(is_taken),
                        "{name}: {:?} took {:?}",
                        asked.words,
                        done.taken
                    );
                }
                Err(EditError::Ambiguous { .. }) => unsettled.push(asked.words.clone()),
                // What was taken may have no room.
                Err(_) => {}
            }
        }
    }
    assert!(asked_back >= 20, "{asked_back} are open");
    assert!(unsettled.len() * 20 <= asked_back, "{unsettled:#?}");
}

// ---- what would be possible instead ----

/// Adds a sports car so, for which there is no room: what was found instead, and the words for it.
fn no_room(world: &mut World, stands: Vec<Stand>) -> (Relaxed, String) {
    let before = world.clone();
    let add = Edit::Add { make: Make::of("sports_car"), count: 1, stands };
    let refused = SceneEditor::new(Seed(3)).edit(&[add], world).unwrap_err();
    assert!(Difference::between(&before, world).is_empty());
    let EditError::NoRoom { relaxed, instead, .. } = &refused else { panic!("{refused}") };
    assert!(refused.to_string().ends_with(relaxed.as_str()), "{refused}");
    (*instead.clone(), relaxed.clone())
}

/// What was found can be had.
fn can_be_had(world: &mut World, stands: &[Stand]) {
    let add = Edit::Add { make: Make::of("sports_car"), count: 1, stands: stands.to_vec() };
    let done = SceneEditor::new(Seed(3)).edit(&[add], world).unwrap();
    assert!(stands.iter().all(|stand| stand.holds(world, done.made[0])), "{stands:?}");
}

#[test]
fn what_has_no_room_next_to_a_thing_has_it_a_little_farther_off() {
    let mut world = World::new();
    let anchor = bench(&mut world, 0.0);
    fenced(&mut world, [1.2, 1.4], 8.0);
    let (found, told) = no_room(&mut world, vec![Stand::To { relation: Relation::NextTo, anchor }]);
    let Relaxed::Wider { stands, at } = found else { panic!("{found:?}") };
    assert!(at.coords.norm() > 8.0, "beyond the fence");
    assert_eq!(stands, [Stand::Apart { anchor, least: 0.0, most: 15.0 }]);
    assert!(told.contains("there is room 0.0 to 15.0 m from"), "{told}");
    can_be_had(&mut world, &stands);
}

#[test]
fn what_has_no_room_before_a_thing_has_it_farther_on_that_side() {
    let mut world = World::new();
    let anchor = bench(&mut world, 0.0);
    put(&mut world, EntityKind::Building, [20.75, 0.0], [38.5, 90.0]);
    let (found, _) = no_room(&mut world, vec![Stand::To { relation: Relation::InFrontOf, anchor }]);
    let Relaxed::Wider { stands, at } = found else { panic!("{found:?}") };
    assert!(matches!(stands[0], Stand::Towards { .. }), "{stands:?}");
    assert!(at.x > 40.0, "{at}");
    can_be_had(&mut world, &stands);
}

#[test]
fn what_is_to_be_far_is_never_offered_near() {
    let far = |anchor| Stand::To { relation: Relation::FarFrom, anchor };
    let mut world = World::new();
    let anchor = bench(&mut world, 0.0);
    fenced(&mut world, [3.0, 3.0], 150.0);
    let (found, told) = no_room(&mut world, vec![far(anchor)]);
    let Relaxed::Wider { stands, at } = found else { panic!("{found:?}") };
    assert!(stands.contains(&far(anchor)) && at.coords.norm() > 150.0, "{stands:?} at {at}");
    assert!(told.contains("far from"), "{told}");
    can_be_had(&mut world, &stands);

    let mut world = World::new();
    let anchor = bench(&mut world, 0.0);
    // There is room beside the bench, and nowhere else.
    fenced(&mut world, [3.0, 3.0], 900.0);
    let (found, told) = no_room(&mut world, vec![far(anchor)]);
    assert_eq!(found, Relaxed::Nothing);
    assert_eq!(told, "nothing else was found that would do");
}

#[test]
fn what_has_no_room_along_a_house_has_it_near_by() {
    let mut world = World::new();
    let anchor = put(&mut world, EntityKind::Building, [0.0, 0.0], [10.0, 6.0]);
    fenced(&mut world, [6.0, 4.0], 12.0);
    let (found, told) = no_room(&mut world, vec![Stand::Along { anchor }]);
    let Relaxed::Near { stands, at } = found else { panic!("{found:?}") };
    assert_eq!(stands, [Stand::To { relation: Relation::Near, anchor }]);
    assert!(at.coords.norm() > 12.0 && told.contains("there is room near"), "{told}");
    can_be_had(&mut world, &stands);
}

#[test]
fn what_has_no_room_on_a_thing_is_not_offered_beside_it() {
    let mut world = World::new();
    let anchor = put(&mut world, EntityKind::Table, [0.0, 0.0], [0.8, 0.8]);
    let (found, told) = no_room(&mut world, vec![Stand::To { relation: Relation::OnTopOf, anchor }]);
    assert!(matches!(found, Relaxed::Elsewhere { .. }), "{found:?}");
    assert!(told.contains("there is room elsewhere, at ("), "{told}");
}

/// Puts a row of benches along a house, and gives what would be possible where it does not fit.
fn row(world: &World, anchor: EntityId, spacing: Spacing) -> Option<Relaxed> {
    let mut world = world.clone();
    let row = Edit::Row { make: Make::of("bench"), line: Line::Along { anchor }, spacing };
    match SceneEditor::new(Seed(3)).edit(&[row], &mut world) {
        Ok(_) => None,
        Err(EditError::NoRoom { instead, .. }) => Some(*instead),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn of_a_row_that_is_too_long_the_largest_number_that_fits_is_told() {
    let mut world = World::new();
    let anchor = put(&mut world, EntityKind::Building, [0.0, 0.0], [20.0, 4.0]);
    let Some(Relaxed::Fewer { count, spacing }) = row(&world, anchor, Spacing::Count(60)) else {
        panic!("sixty stand along a house of 20 m")
    };
    assert!((10..60).contains(&count) && (spacing * f64::from(count) - 20.0).abs() < 1e-9, "{count}");
    assert_eq!(row(&world, anchor, Spacing::Count(count)), None, "so many fit");
    assert!(row(&world, anchor, Spacing::Count(count + 1)).is_some(), "and one more does not");
}

#[test]
fn of_a_row_with_most_places_taken_those_that_are_free_are_told() {
    let mut world = World::new();
    let anchor = put(&mut world, EntityKind::Building, [0.0, 0.0], [20.0, 4.0]);
    for side in [-1.0, 1.0] {
        put(&mut world, EntityKind::Building, [-2.75, side * 5.05], [15.5, 6.0]);
    }
    let Some(Relaxed::Free { at }) = row(&world, anchor, Spacing::Every(2.0)) else {
        panic!("no number of them stands evenly")
    };
    assert!(!at.is_empty() && at.iter().all(|at| at.x > 5.0), "{at:?}");
}

// ---- what is made ----

/// Counts how often it is asked.
struct Counted(Arc<AtomicUsize>);

impl AssetGenerator for Counted {
    fn name(&self) -> &'static str {
        "counted"
    }

    fn generate(&mut self, prompt: &AssetPrompt) -> Result<Made, GenerateError> {
        self.0.fetch_add(1, Ordering::SeqCst);
        ProceduralGenerator::new().generate(prompt)
    }
}

fn maker() -> (SceneEditor, Arc<AtomicUsize>) {
    let asked = Arc::new(AtomicUsize::new(0));
    let editor = SceneEditor::new(Seed(3)).with_catalogue(Catalogue::standard());
    (editor.with_generator(Counted(Arc::clone(&asked))), asked)
}

#[test]
fn what_was_made_is_found_again_by_some_of_its_words() {
    let (mut editor, asked) = maker();
    let mut world = World::new();
    bench(&mut world, 8.0);
    let first = editor.say("add a tall wooden obelisk", &mut world).unwrap().made[0];
    for words in ["add a wooden obelisk", "add an obelisk", "put a tall obelisk near the bench"] {
        let done = editor.say(words, &mut world).unwrap_or_else(|error| panic!("{words}: {error}"));
        let asset = |thing| world.entity(thing).unwrap().info.asset;
        assert_eq!(asset(done.made[0]), asset(first), "{words}");
        assert_eq!(done.answer, None, "{words}: nothing was made");
    }
    assert_eq!(asked.load(Ordering::SeqCst), 1);
    let other = editor.say("add a concrete obelisk", &mut world).unwrap();
    assert!(other.answer.unwrap().contains("generated"), "a wooden one is not of concrete");
}

#[test]
fn what_was_made_for_a_sentence_that_failed_is_no_part_of_the_catalogue() {
    let (mut editor, asked) = maker();
    let mut world = World::new();
    bench(&mut world, 8.0);
    let before = editor.catalogue().len();
    let refused = editor.say("add a tall wooden obelisk on top of the bench", &mut world);
    assert!(matches!(refused, Err(EditError::NoRoom { .. })), "{refused:?}");
    assert_eq!(editor.catalogue().len(), before);
    editor.say("add a tall wooden obelisk", &mut world).unwrap();
    assert_eq!(editor.catalogue().len(), before + 1);
    assert_eq!(asked.load(Ordering::SeqCst), 1, "it stood on the shelf");
}

// ---- what words mean ----

/// Knows that a watercraft is a boat, and nothing of dragons.
struct Sailor;

impl Embedder for Sailor {
    fn embed(&mut self, text: &str) -> Result<Vec<f32>, EmbedError> {
        if text.contains("zyzzyva") {
            let why = "it has no words for it".to_owned();
            return Err(EmbedError::Failed { text: text.to_owned(), why });
        }
        let swims = ["boat", "watercraft"].iter().any(|word| text.contains(word));
        let lies = ["bale", "obelisk"].iter().any(|word| text.contains(word));
        Ok(vec![f32::from(u8::from(swims)), f32::from(u8::from(lies)), 0.1])
    }
}

fn shore() -> Catalogue {
    let mut catalogue = Catalogue::new();
    for (name, size) in
        [("rowing_boat", [3.0, 1.3, 0.6]), ("bale", [1.2, 1.2, 1.0]), ("obelisk", [1.4, 1.4, 6.0])]
    {
        let [length, width, height] = size;
        catalogue.add(Asset::new(name, EntityKind::Prop, Shape::cuboid(length, width, height))).unwrap();
    }
    catalogue
}

#[test]
fn an_embedder_finds_what_words_alone_do_not() {
    let words = "add a watercraft near the bench";
    let mut world = World::new();
    bench(&mut world, 8.0);
    let plain = SceneEditor::new(Seed(3)).with_catalogue(shore()).say(words, &mut world);
    assert!(matches!(plain, Err(EditError::UnknownThing { .. })), "{plain:?}");
    // In whatever order the two are given.
    let editors = [
        SceneEditor::new(Seed(3)).with_catalogue(shore()).with_embedder(Sailor),
        SceneEditor::new(Seed(3)).with_embedder(Sailor).with_catalogue(shore()),
    ];
    for mut editor in editors {
        let mut world = world.clone();
        let done = editor.say(words, &mut world).unwrap();
        let boat = world.entity(done.made[0]).unwrap();
        let asset = world.assets().unwrap().get(boat.info.asset.unwrap()).unwrap();
        assert_eq!(asset.name, "rowing_boat");
    }
}

#[test]
fn an_embedder_takes_nothing_for_what_it_is_not_near_to() {
    let mut world = World::new();
    bench(&mut world, 8.0);
    let mut editor = SceneEditor::new(Seed(3)).with_catalogue(shore()).with_embedder(Sailor);
    let refused = editor.say("add a dragon near the bench", &mut world).unwrap_err();
    assert!(matches!(refused, EditError::UnknownThing { .. }), "{refused}");
    assert_eq!(world.len(), 1);
}

#[test]
fn an_embedder_that_fails_is_named_in_the_answer() {
    let mut world = World::new();
    bench(&mut world, 8.0);
    let mut editor = SceneEditor::new(Seed(3)).with_catalogue(shore()).with_embedder(Sailor);
    let refused = editor.say("add a zyzzyva near the bench", &mut world).unwrap_err();
    assert!(matches!(refused, EditError::UnknownThing { .. }), "{refused}");
    assert!(refused.to_string().contains("gives no vector"), "{refused}");
}
