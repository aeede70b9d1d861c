//! A real llama.cpp edits a scene, with a model of random weights: every answer is edits that hold and can be taken back, or a typed
//! error and the scene as it was.
//!
//! What lies between a reader and a server is tried, nothing of understanding: the schema as a grammar, the repair, the accounts.
//! `ci/model-server` installs what this needs.
#![cfg(feature = "thought")]

use std::collections::BTreeSet;
use std::sync::{Arc, LazyLock};

use serde_json::{Value as Json, json};
use simworld_agents::editing::{Difference, EditError, Edited, ReadBy, SceneEditor, faults};
use simworld_agents::model::ChatRequest;
use simworld_agents::thought::{ModelReader, ModelReasoner, Prompt, Prompts};
use simworld_core::asset::Catalogue;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::hash::StateHash;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, EntityRef, Scene, Shape, World};
use simworld_core::seed::Seed;

use crate::city::{City, STREETS};
use crate::model_server::ModelServer;
use crate::model_server::watch::{Watch, as_asked, make_easy};
use crate::models_edit_scenes::STRANGE;

/// The tokens that things, assets and streets may take in a prompt.
const BUDGET: usize = 300;
/// As near as this a thing is in view without a word of it, m.
const NEAR: f64 = 60.0;
/// The most assets and things of a schema.
const MOST: (usize, usize) = (24, 60);
/// What an answer may call a thing that it makes itself.
const NEW: [&str; 5] = ["new1", "new2", "new3", "new4", "new5"];
/// Numbers that fit together, for what a model of random weights seldom hits: either of two is zero.
const SETTLED: [(&str, &[i64]); 4] =
    [("percent", &[100]), ("height", &[0]), ("every", &[0]), ("count", &[1, 2])];

/// What can be added.
static LIBRARY: LazyLock<Catalogue> = LazyLock::new(Catalogue::library);

/// How the server is asked.
struct Asking {
    change: fn(&mut ChatRequest),
    prompts: Arc<Prompts>,
}

/// So many rounds, many more under `SIMWORLD_SOAK`.
fn rounds(usual: i64) -> i64 {
    if std::env::var_os("SIMWORLD_SOAK").is_some() { 10 * usual } else { usual }
}

/// Prompts without the long lists of what there is: this model makes nothing of them, and they cost most of the time.
fn short_prompts() -> Prompts {
    let mut prompts = Prompts::standard();
    for (prompt, text) in [(Prompt::Editor, "You change a city."), (Prompt::Edit, "{{ request }}")] {
        prompts.replace(prompt, text.to_owned()).unwrap();
    }
    prompts
}

/// What is easy of the schema, and of sizes and rows what is possible. What conforms to what is left conforms to the whole.
fn make_possible(request: &mut ChatRequest) {
    make_easy(request);
    if let Some(asked) = &mut request.schema {
        settle(&mut asked.json);
    }
}

fn settle(part: &mut Json) {
    match part {
        Json::Array(parts) => parts.iter_mut().for_each(settle),
        Json::Object(fields) => {
            for (name, few) in SETTLED {
                if let Some(field) = fields.get_mut(name).filter(|field| field.is_object()) {
                    *field = json!({ "enum": few });
                }
            }
            fields.values_mut().for_each(settle);
        }
        _ => {}
    }
}

/// The quarter, with something far off that nobody speaks of.
fn city() -> City {
    let mut city = City::read("quarter");
    let far = pose_facing(Point3::new(3000.0, 0.0, 0.0), 0.0);
    let obelisk = EntityDesc::new(EntityKind::Prop, far, Shape::cuboid(1.0, 1.0, 8.0));
    city.world.spawn(obelisk.named("Obelisk of Thoth")).unwrap();
    city
}

fn editor(city: &City) -> SceneEditor {
    SceneEditor::new(Seed(7)).looking_as(city.me, &city.world)
}

/// Whether the model behind the server edits the scene; what it did, or why it did nothing, is looked at.
fn is_edited(server: &ModelServer, city: &City, how: &Asking, seed: i64) -> bool {
    let mut world = city.world.clone();
    let before = world.digest();
    let watch = Watch::default();
    let reasoner = ModelReasoner::new(watch.model(server, how.change))
        .with_prompts(Arc::clone(&how.prompts))
        .with_temperature(1.0, Some(seed))
        .with_max_tokens(400);
    let reader = ModelReader::with_reasoner(Box::new(reasoner), Arc::clone(&how.prompts)).with_budget(BUDGET);
    let mut editor = editor(city).with_reader(reader);
    let outcome = editor.say(STRANGE, &mut world);

    let repairs = check_requests(&watch, city);
    let conforms = watch.all().last().is_some_and(|last| last.value().is_some());
    let is_edited = match &outcome {
        Ok(done) => {
            assert!(conforms, "what is carried out conforms to the schema: {:?}", done.edits);
            check_edits(done, city, &world);
            let after = world.digest();
            if editor.undo(&mut world).unwrap().is_some() {
                assert_eq!(world.digest(), before, "{:?}", done.edits);
                editor.redo(&mut world).unwrap();
                assert_eq!(world.digest(), after, "{:?}", done.edits);
                editor.undo(&mut world).unwrap();
            }
            true
        }
        Err(error) => {
            check_error(error, conforms, repairs);
            assert!(Difference::between(&city.world, &world).is_empty(), "{error}");
            assert_eq!(editor.undo(&mut world), Ok(None), "there is nothing to take back");
            false
        }
    };
    assert_eq!(world.digest(), before, "{outcome:?}");
    is_edited
}

/// How many repairs there were. One question is asked, each request is booked, and each holds in its schema what is in view.
fn check_requests(watch: &Watch, city: &City) -> usize {
    let (questions, repairs) = watch.settled();
    assert!(questions == 1 && (watch.faulty()..=1).contains(&repairs), "{repairs} repairs");
    let account = watch.account();
    assert_eq!(account.answered, (questions + repairs) as u64);
    assert!(account.usage.prompt > 0 && account.usage.completion > 0, "{account:?}");
    for exchange in watch.all() {
        check_schema(&exchange.request.schema.expect("an answer is asked for by a schema").json, city);
    }
    repairs
}

/// The texts that a definition of the schema allows.
fn allowed<'a>(schema: &'a Json, name: &str) -> Vec<&'a str> {
    let texts = schema["$defs"][name]["enum"].as_array();
    texts.into_iter().flatten().filter_map(Json::as_str).collect()
}

fn check_schema(schema: &Json, city: &City) {
    let things = allowed(schema, "thing");
    let ids: Vec<&str> = things.iter().copied().filter(|id| !NEW.contains(id)).collect();
    assert!((1..=MOST.1).contains(&ids.len()) && things.len() == ids.len() + NEW.len(), "{things:?}");
    assert!(ids.contains(&city.ids["square"].to_string().as_str()), "it is spoken of: {ids:?}");
    for id in ids {
        let thing = city.world.iter().find(|thing| thing.id.to_string() == id);
        let thing = thing.unwrap_or_else(|| panic!("nothing is called {id}"));
        assert!(thing.id != city.me && is_in_view(&thing, city), "{id} ({}) is not in view", thing.label());
    }
    let mut anchors = things;
    anchors.push("me");
    assert_eq!(allowed(schema, "anchor"), anchors);

    let streets: BTreeSet<&str> = allowed(schema, "street").into_iter().collect();
    assert!(streets.iter().all(|name| STREETS.iter().any(|street| street.1 == *name)), "{streets:?}");
    let mut assets = BTreeSet::new();
    values_of(schema, "asset", &mut assets);
    assert!((1..=MOST.0).contains(&assets.len()), "{assets:?}");
    assert!(assets.iter().all(|name| LIBRARY.find(name).is_some()), "{assets:?}");
}

/// Whether a thing stands near who asks, or something is said of it.
fn is_in_view(thing: &EntityRef<'_>, city: &City) -> bool {
    let me = city.world.entity(city.me).expect("who asks is there").planar();
    let text = format!("{} {} {:?}", thing.kind, thing.label(), thing.info).to_lowercase();
    let own: BTreeSet<&str> = text.split(|sign: char| !sign.is_alphanumeric()).collect();
    let is_said = |word: &str| word.len() > 2 && own.contains(word);
    (thing.planar() - me).norm() <= NEAR || STRANGE.split([' ', ',']).any(is_said)
}

/// All texts that a field may have anywhere in a schema.
fn values_of<'a>(part: &'a Json, field: &str, found: &mut BTreeSet<&'a str>) {
    match part {
        Json::Array(parts) => parts.iter().for_each(|part| values_of(part, field, found)),
        Json::Object(fields) => {
            let own = fields.get(field).and_then(|schema| schema["enum"].as_array());
            found.extend(own.into_iter().flatten().filter_map(Json::as_str));
            fields.values().for_each(|part| values_of(part, field, found));
        }
        _ => {}
    }
}

/// The edits alone lead to the same world, nothing came but by them, and what stands elsewhere now stands soundly.
fn check_edits(done: &Edited, city: &City, world: &World) {
    assert!(done.read_by == ReadBy::Reader && !done.edits.is_empty());
    let mut again = city.world.clone();
    let by_hand = editor(city).edit(&done.edits, &mut again);
    let by_hand = by_hand.unwrap_or_else(|error| panic!("{:?}: {error}", done.edits));
    assert_eq!((again.digest(), &by_hand.made), (world.digest(), &done.made), "{:?}", done.edits);
    let change = Difference::between(&city.world, world);
    assert!(change.added.iter().all(|thing| done.made.contains(thing)), "{:?}", done.edits);
    for thing in change.added.iter().chain(&change.moved) {
        check_stands(*thing, city, world, done);
    }
}

/// Nothing is amiss with how a thing stands that was not so before. What lies under other things shares space with them.
fn check_stands(thing: EntityId, city: &City, world: &World, done: &Edited) {
    let kind = world.entity(thing).expect("what was put somewhere is there").kind;
    let before = faults(&city.world, thing);
    let new: Vec<_> = faults(world, thing).into_iter().filter(|fault| !before.contains(fault)).collect();
    assert!(kind == EntityKind::Ground || new.is_empty(), "{thing} {new:?}: {:?}", done.edits);
}

/// The error says what is wrong with the answer or, where that conforms, what the scene has against it.
fn check_error(error: &EditError, conforms: bool, repairs: usize) {
    assert!(!error.to_string().is_empty());
    match error {
        EditError::Reader { words, fault } => {
            assert!(repairs == 1 && words == STRANGE && !fault.is_empty(), "one repair was tried: {error}");
        }
        EditError::NotUnderstood { hint, .. } => assert!(conforms && !hint.is_empty(), "{error}"),
        EditError::NoRoom { .. }
        | EditError::Impossible { .. }
        | EditError::NotFound { .. }
        | EditError::Refused(_) => assert!(conforms, "{error}"),
        other => panic!("an answer by ids and names of assets is never so: {other}"),
    }
}

#[test]
fn every_answer_by_the_readers_own_schema_is_edits_that_hold_or_a_typed_error() {
    let Some(server) = ModelServer::start() else { return };
    let city = city();
    let how = Asking { change: as_asked, prompts: Arc::new(Prompts::standard()) };
    let edits = (0..rounds(3)).filter(|seed| is_edited(&server, &city, &how, *seed)).count();
    println!("{edits} edits of {} answers, else typed errors", rounds(3));
}

#[test]
fn a_server_that_keeps_to_what_is_possible_gives_edits_that_are_carried_out() {
    let Some(server) = ModelServer::start() else { return };
    let city = city();
    let how = Asking { change: make_possible, prompts: Arc::new(short_prompts()) };
    let all = rounds(24);
    let edits = (0..all).filter(|seed| is_edited(&server, &city, &how, *seed)).count() as i64;
    println!("{edits} edits of {all} answers, else typed errors");
    assert!(edits * 6 >= all, "{edits} edits of {all} answers");
}

#[test]
fn what_is_possible_is_a_part_of_what_is_asked() {
    let request = || {
        let size = json!({ "type": "integer", "minimum": 0, "maximum": 2000 });
        let properties = json!({ "percent": size, "height": size, "things": { "type": "array", "items": {}, "minItems": 1, "maxItems": 9 } });
        ChatRequest::default().with_schema("edits", json!({ "properties": properties }))
    };
    let mut changed = request();
    make_possible(&mut changed);
    let schema = changed.schema.unwrap();
    let fields = &schema.json["properties"];
    assert_eq!((&fields["percent"]["enum"], &fields["height"]["enum"]), (&json!([100]), &json!([0])));
    assert_eq!(fields["things"]["maxItems"], 2, "a short list");
}
