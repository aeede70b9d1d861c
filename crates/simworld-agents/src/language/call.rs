//! Function calls to orders.

use std::collections::BTreeMap;

use simworld_core::action::StepDirection;
use simworld_core::id::EntityId;
use simworld_core::seam::PlanError;
use simworld_core::value::Value;

use super::clause::{Choice, Clause, Manner, Pace, Reference, Target, Vehicle};
use super::lexer::lex;
use super::names::Names;
use super::parser::{Parser, shortened};
use super::resolve::View;

/// Every call with its arguments; a question mark follows those that may be left out.
pub(super) const CALLS: &[(&str, &[&str])] = &[
    ("navigate", &["to?", "x?", "y?", "z?", "speed?", "within?"]),
    ("pick_up", &["item"]),
    ("drop_off", &[]),
    ("put_down", &[]),
    ("sit_down", &["seat?"]),
    ("stand_up", &[]),
    ("stop", &[]),
    ("wait", &["seconds"]),
    ("ride_scooter", &["scooter"]),
    ("get_off_scooter", &[]),
    ("enter_car", &["car"]),
    ("exit_car", &[]),
    ("step", &["direction?", "distance?"]),
    ("turn", &["angle"]),
    ("wave", &["to"]),
    ("take_photo", &[]),
];

/// Arguments being read.
struct Call<'a> {
    name: &'a str,
    args: &'a BTreeMap<String, Value>,
    names: &'a Names,
    view: &'a View<'a>,
}

/// The order that a call stands for.
pub(super) fn read(
    name: &str,
    args: &BTreeMap<String, Value>,
    names: &Names,
    view: &View<'_>,
) -> Result<Clause, PlanError> {
    let call = Call { name, args, names, view };
    // The paper's name for it.
    let name = if name == "agent_sit_down" { "sit_down" } else { name };
    let Some((_, allowed)) = CALLS.iter().find(|(known, _)| *known == name) else {
        let known: Vec<&str> = CALLS.iter().map(|(known, _)| *known).collect();
        return Err(call.refuse(format!("there is no such call: use {}", known.join(", "))));
    };
    call.check_arguments(allowed)?;
    match name {
        "navigate" => call.navigate(),
        "pick_up" => Ok(Clause::Take { what: call.thing("item")?, to: None }),
        "drop_off" => Ok(Clause::Drop { what: None, at: None, manner: Manner::DropOff }),
        "put_down" => Ok(Clause::Drop { what: None, at: None, manner: Manner::PutDown }),
        "sit_down" if args.contains_key("seat") => Ok(Clause::Sit { on: Some(call.thing("seat")?) }),
        "sit_down" => Ok(Clause::Sit { on: None }),
        "stand_up" => Ok(Clause::StandUp),
        "stop" => Ok(Clause::Stop),
        "wait" => Ok(Clause::Wait { seconds: call.number("seconds", 0.001, 86_400.0)? }),
        "ride_scooter" => Ok(Clause::Board { what: call.thing("scooter")?, to: None }),
        "get_off_scooter" => Ok(Clause::Alight { from: Vehicle::Scooter }),
        "enter_car" => Ok(Clause::Board { what: call.thing("car")?, to: None }),
        "exit_car" => Ok(Clause::Alight { from: Vehicle::Car }),
        "step" => call.step(),
        "turn" => {
            Ok(Clause::Turn { angle: call.number("angle", -std::f64::consts::TAU, std::f64::consts::TAU)? })
        }
        "wave" => Ok(Clause::Wave { to: call.thing("to")? }),
        _ => Ok(Clause::Photo),
    }
}

impl Call<'_> {
    fn refuse(&self, reason: String) -> PlanError {
        PlanError::Call { call: shortened(self.name), reason }
    }

    fn check_arguments(&self, allowed: &[&str]) -> Result<(), PlanError> {
        let is_known = |key: &str| allowed.iter().any(|known| known.trim_end_matches('?') == key);
        if let Some(stranger) = self.args.keys().find(|key| !is_known(key)) {
            let takes = if allowed.is_empty() { "no arguments".to_owned() } else { allowed.join(", ") };
            return Err(
                self.refuse(format!("there is no argument {:?}: it takes {takes}", shortened(stranger)))
            );
        }
        match allowed.iter().find(|key| !key.ends_with('?') && !self.args.contains_key(**key)) {
            Some(missing) => Err(self.refuse(format!("the argument {missing} is missing"))),
            None => Ok(()),
        }
    }

    fn navigate(&self) -> Result<Clause, PlanError> {
        let to =
            match (self.args.contains_key("to"), self.args.contains_key("x"), self.args.contains_key("y")) {
                (true, false, false) => self.thing("to")?,
                (false, true, true) => {
                    let (x, y) = (self.number("x", -1e7, 1e7)?, self.number("y", -1e7, 1e7)?);
                    let z = self.optional("z", -1e7, 1e7)?;
                    reference(Target::Point { x, y, z }, format!("({x}, {y})"))
                }
                _ => return Err(self.refuse("give either to, or x and y".to_owned())),
            };
        let pace = self.optional("speed", 0.1, 50.0)?.map_or(Pace::Usual, Pace::At);
        Ok(Clause::Go { to, side: None, pace, within: self.optional("within", 0.1, 1000.0)? })
    }

    fn step(&self) -> Result<Clause, PlanError> {
        let direction = match self.args.get("direction").map(Value::as_str) {
            None | Some(Some("forward")) => StepDirection::Forward,
            Some(Some("backward")) => StepDirection::Backward,
            Some(Some("left")) => StepDirection::Left,
            Some(Some("right")) => StepDirection::Right,
            _ => return Err(self.refuse("direction is one of forward, backward, left, right".to_owned())),
        };
        Ok(Clause::Step { direction, distance: self.optional("distance", 0.01, 10.0)?.unwrap_or(0.5) })
    }

    fn optional(&self, key: &str, low: f64, high: f64) -> Result<Option<f64>, PlanError> {
        if self.args.contains_key(key) { self.number(key, low, high).map(Some) } else { Ok(None) }
    }

    fn number(&self, key: &str, low: f64, high: f64) -> Result<f64, PlanError> {
        let value = self.args.get(key).and_then(Value::as_f64);
        value.filter(|number| (low..=high).contains(number)).ok_or_else(|| {
            let given = self.args.get(key).map(|value| shortened(&value.to_string())).unwrap_or_default();
            self.refuse(format!("{key} = {given} is out of range: give a number from {low} to {high}"))
        })
    }

    /// An entity by its id, or a phrase that names one.
    fn thing(&self, key: &str) -> Result<Reference, PlanError> {
        match self.args.get(key) {
            Some(Value::Entity(id)) => Ok(reference(Target::Id(*id), id.to_string())),
            Some(Value::Integer(bits)) if *bits >= 0 => {
                let id = EntityId::from(bits.unsigned_abs());
                Ok(reference(Target::Id(id), id.to_string()))
            }
            Some(Value::Text(words)) => {
                let lexemes = lex(words);
                let mut parser = Parser::new(words, &lexemes, self.names, self.view);
                let thing = parser.reference(0).map_err(|error| self.refuse(format!("{key}: {error}")))?;
                if parser.at < lexemes.len() {
                    return Err(
                        self.refuse(format!("{key} = {:?} says more than one thing", shortened(words)))
                    );
                }
                Ok(thing)
            }
            _ => Err(self.refuse(format!("{key} must be an entity, or words such as \"the nearest bench\""))),
        }
    }
}

fn reference(target: Target, text: String) -> Reference {
    Reference { target, choice: Choice::Open, relation: None, text }
}
