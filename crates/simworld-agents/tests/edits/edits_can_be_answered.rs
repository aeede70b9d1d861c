//! Whatever the grammar makes of a sentence a model can answer: written by the schema and read back, its edits are the same. So the two
//! can never drift apart.
#![cfg(feature = "thought")]

use serde_json::Value;
use simworld_agents::editing::{Asked, Edit, SceneEditor};
use simworld_agents::thought::EditAnswer;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::Scene;
use simworld_core::seed::Seed;

use crate::city::City;
use crate::edits_common::{CITIES, is_whole, sampled_in};

/// Of the sentences that are judged so many are a sample of one, unless all are asked for.
const SAMPLED: usize = 4;
/// Half of a centimetre and of a percentage, and a little; half of a degree.
const ROUNDED: f64 = 0.0051;
const TURNED: f64 = 0.0088;

/// What came of a sentence.
#[derive(Default)]
struct Count {
    edits: usize,
    /// Edits that came back to the last bit.
    exact: usize,
}

#[test]
fn edits_of_the_grammar_can_be_answered_and_are_read_back() {
    let (mut count, mut faults) = (Count::default(), Vec::new());
    for name in CITIES {
        let city = City::read(name);
        let sample = sampled_in(name).into_iter().enumerate();
        for (_, asked) in sample.filter(|(index, _)| is_whole() || index % SAMPLED == 0) {
            match come_back(&city, &asked.words) {
                Ok((edits, exact)) => {
                    count.edits += edits;
                    count.exact += exact;
                }
                Err(fault) => faults.push(format!("{name}: {:?}: {fault}", asked.words)),
            }
        }
    }
    println!("{} edits, {} of them to the last bit", count.edits, count.exact);
    assert!(faults.is_empty(), "{} sentences:\n{}", faults.len(), faults.join("\n"));
    assert!(count.edits > 300 && count.exact * 10 > count.edits * 7, "{} of {}", count.exact, count.edits);
}

/// How many edits a sentence means, and how many of them came back to the last bit; none if the grammar refuses it.
fn come_back(city: &City, words: &str) -> Result<(usize, usize), String> {
    let mut world = city.world.clone();
    let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
    let Ok(done) = editor.say(words, &mut world) else { return Ok((0, 0)) };
    let from = city.world.entity(city.me).expect("somebody looks").planar();
    let asked = Asked {
        words,
        scene: &city.world,
        catalogue: editor.catalogue(),
        from,
        who: Some(city.me),
        it: None,
    };
    let answer = EditAnswer::of(&done.edits, &done.made, &asked).map_err(|error| error.to_string())?;
    let again = answer.edits(&asked)?.map_err(|error| error.to_string())?;
    let again = again.iter().map(|edit| edit.with_made(&done.made)).collect::<Result<Vec<Edit>, _>>();
    let again = again.map_err(|error| error.to_string())?;
    if again.len() != done.edits.len() {
        return Err(format!("{:?} came back as {again:?}", done.edits));
    }
    let mut exact = 0;
    for (one, other) in done.edits.iter().zip(&again) {
        let (written, read) = (json(one), json(other));
        if !is_same("", &written, &read) {
            return Err(format!("{one:?} came back as {other:?}, by {}", answer.value()));
        }
        exact += usize::from(one == other);
    }
    Ok((done.edits.len(), exact))
}

fn json(edit: &Edit) -> Value {
    serde_json::to_value(edit).expect("edits can be written")
}

/// Whether two values are the same within what an answer rounds; things and streets that are named twice count once.
fn is_same(key: &str, one: &Value, other: &Value) -> bool {
    match (one, other) {
        (Value::Object(one), Value::Object(other)) => {
            one.len() == other.len()
                && one
                    .iter()
                    .all(|(key, value)| other.get(key).is_some_and(|other| is_same(key, value, other)))
        }
        (Value::Array(one), Value::Array(other)) => {
            let (one, other) = (once(one), once(other));
            one.len() == other.len()
                && one.into_iter().zip(other).all(|(one, other)| is_same(key, one, other))
        }
        (Value::Number(one), Value::Number(other)) if one.is_f64() && other.is_f64() => {
            // Numbers that are no integers are finite floats here.
            let apart = one.as_f64().unwrap() - other.as_f64().unwrap();
            match key {
                "angle" | "heading" => wrap_angle(apart).abs() <= TURNED,
                _ => apart.abs() <= ROUNDED,
            }
        }
        (one, other) => one == other,
    }
}

/// Ids of a list, each once.
fn once(list: &[Value]) -> Vec<&Value> {
    let mut kept: Vec<&Value> = Vec::new();
    for value in list {
        if !(value.is_u64() && kept.contains(&value)) {
            kept.push(value);
        }
    }
    kept
}
