//! What people mean comes true: of plans without conditions the effects are read off their meaning, as it was written by hand, and looked
//! for in the world after a body has carried them out.

use std::collections::BTreeMap;

use crate::sentences_common::city::City;
use crate::sentences_common::outcome::{carry_out, shows};
use crate::sentences_common::{PLACES, Said, Verdict, said_in, understand, verdict};
use simworld_agents::language::GrammarPlanner;
use simworld_core::scene::{LOCKED, Scene};
use simworld_core::seam::{Plan, PlanStep};
use simworld_core::value::Value;

/// One of so many sentences is carried out where not all are.
const SAMPLED: usize = 12;

/// What a meaning leaves behind, as far as it is known while its steps are read.
#[derive(Default)]
struct Left {
    at: Option<String>,
    held: Option<String>,
    carried: Option<String>,
    seat: Option<String>,
    ridden: Option<String>,
    boarded: Option<String>,
    /// What others were given.
    facts: Vec<String>,
    /// How doors are left.
    doors: BTreeMap<String, &'static str>,
}

impl Left {
    /// After one more step; false if it says nothing of the end, or never comes to one.
    fn after(&mut self, step: &str) -> bool {
        let (verb, object) = step.split_once(' ').unwrap_or((step, ""));
        let thing = || Some(object.split(" at ").next().unwrap_or(object).to_owned());
        match verb {
            // Nobody is at the wheel here.
            "go" if self.boarded.is_some() => return false,
            "go" => self.at = thing().filter(|place| !place.starts_with('(')),
            "take" | "buy" => self.held = thing(),
            "carry" => self.carried = thing(),
            "drop" => self.held = Some("nothing".to_owned()),
            "put" => self.carried = Some("nothing".to_owned()),
            "give" => {
                let Some(held) = self.held.replace("nothing".to_owned()) else { return false };
                self.facts.push(format!("gave {object} {held}"));
            }
            "sit" => (self.seat, self.at) = (thing(), None),
            "stand" => self.seat = None,
            "ride" => (self.ridden, self.at) = (thing(), None),
            "off" => self.ridden = None,
            "enter" => (self.boarded, self.at) = (thing(), None),
            "exit" => self.boarded = None,
            "open" => drop(self.doors.insert(object.to_owned(), "open")),
            "close" => drop(self.doors.insert(object.to_owned(), "closed")),
            "step" | "forward" => self.at = None,
            // It need not come to that here.
            "wait" if object.starts_with("until") => return false,
            "face" | "point" | "wave" | "argue" | "say" | "photo" | "turn" | "wait" | "speed" | "stop" => {}
            _ => return false,
        }
        true
    }

    fn facts(mut self) -> Vec<String> {
        let told = [
            ("at", self.at),
            ("holds", self.held),
            ("carries", self.carried),
            ("seated", self.seat),
            ("rides", self.ridden),
            ("aboard", self.boarded),
        ];
        let told = told.into_iter().filter_map(|(verb, object)| Some(format!("{verb} {}", object?)));
        self.facts.extend(told);
        self.facts.extend(self.doors.into_iter().map(|(door, how)| format!("{how} {door}")));
        self.facts
    }
}

/// What the world is to show after a meaning; nothing where that cannot be told from the words alone.
fn effects(meaning: &str, city: &City) -> Vec<String> {
    if meaning.contains(['{', '!', '?', '\'']) {
        return Vec::new();
    }
    let mut left = Left::default();
    for step in meaning.split(", ") {
        let door = step.strip_prefix("open ").and_then(|door| city.world.entity(*city.ids.get(door)?));
        if door.is_some_and(|door| door.info.attributes.get(LOCKED) == Some(&Value::Bool(true))) {
            return vec!["fails locked".to_owned()];
        }
        // A hand holds one thing: who was given one already cannot take the next.
        let has_one = |to: &str| left.facts.iter().any(|fact| fact.starts_with(&format!("gave {to} ")));
        if step.strip_prefix("give ").is_some_and(has_one) {
            return vec!["fails cannot take it".to_owned()];
        }
        if !left.after(step) {
            return Vec::new();
        }
    }
    left.facts()
}

/// How near the last way of a plan leads, m, where that is farther off than anybody stands who has come to a thing ("within five metres of
/// the statue").
fn how_near(plan: &Plan) -> Option<f64> {
    let within = plan.steps.iter().rev().find_map(|step| match step {
        PlanStep::Navigate { within, .. } => Some(*within),
        _ => None,
    });
    within.filter(|within| *within > 2.0)
}

/// What is wrong after the sentence was carried out; `None` if it leaves nothing that could be looked for.
fn faults_of(city: &City, said: &Said) -> Option<Vec<String>> {
    let expected = effects(&said.meaning, city);
    let is_mine = said.family != "dog" && said.family != "driver";
    if expected.is_empty() || !is_mine || verdict(city, said) != Verdict::Right {
        return None;
    }
    let plan = understand(&GrammarPlanner::default(), city, said).ok()?;
    let reach = how_near(&plan);
    let (simulation, ended) = carry_out(city.world.clone(), city.me, plan);
    let missing = expected.iter().filter_map(|fact| {
        let afar = reach.filter(|_| fact.starts_with("at ")).map(|reach| format!("{fact} {reach}"));
        let found = shows(city, afar.as_ref().unwrap_or(fact), &simulation, &ended).err()?;
        Some(format!("{:?} should leave {fact:?}, and left {found:?}", said.words))
    });
    Some(missing.collect())
}

#[test]
fn what_people_mean_comes_true() {
    let every = if std::env::var_os("SIMWORLD_SOAK").is_some() { 1 } else { SAMPLED };
    let (mut tried, mut faults) = (0, Vec::new());
    for place in PLACES.into_iter().filter(|place| *place != "town") {
        let city = City::read(place);
        for said in said_in(place).iter().step_by(every) {
            if let Some(found) = faults_of(&city, said) {
                tried += 1;
                faults.extend(found.into_iter().map(|fault| format!("{place}: {fault}")));
            }
        }
    }
    println!("{tried} sentences were carried out");
    assert!(
        tried * every > 1000,
        "only {tried} sentences of every {every}th leave something that is looked for"
    );
    assert!(faults.is_empty(), "{} of {tried}:\n{}", faults.len(), faults.join("\n"));
}
