//! Function calls to orders.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use simworld_core::action::StepDirection;
use simworld_core::id::EntityId;
use simworld_core::seam::PlanError;
use simworld_core::value::Value;

use super::clause::{Clause, Grip, Manner, Pace, Reference, Target, Vehicle};
use super::hearing::lex_speech;
use super::names::Names;
use super::parser::{Parser, shortened};
use super::resolve::View;
use super::spelling::correct;

/// Every call with its arguments; a question mark follows those that may be left out.
#[rustfmt::skip]
pub(super) const CALLS: &[(&str, &[&str])] = &[
    ("navigate", &["to?", "x?", "y?", "z?", "speed?", "within?"]), ("follow", &["whom"]), ("face", &["what"]),
    ("pick_up", &["item"]), ("drop_off", &[]), ("put_down", &[]), ("give", &["to", "item?"]), ("throw", &["to", "item?"]), ("buy", &["goods",
    "at?"]), ("sit_down", &["seat?"]), ("stand_up", &[]), ("crouch", &[]), ("stop", &[]), ("wait", &["seconds"]),
    ("ride_scooter", &["scooter"]), ("get_off_scooter", &[]), ("enter_car", &["car"]), ("exit_car", &[]),
    ("open_door", &["door?"]), ("close_door", &["door?"]), ("step", &["direction?", "distance?"]), ("turn",
    &["angle"]), ("change_speed", &["speed"]), ("say", &["to", "words"]), ("argue", &["with"]), ("wave",
    &["to"]), ("point", &["at"]), ("take_photo", &["of?"]), ("look", &["angle"]), ("walk_on", &[]),
];

/// Arguments being read.
struct Call<'a> {
    name: &'a str,
    args: &'a BTreeMap<String, Value>,
    names: &'a Names<'a>,
    view: &'a View<'a>,
}

/// The order that a call stands for.
pub(super) fn read(
    name: &str,
    args: &BTreeMap<String, Value>,
    names: &Names<'_>,
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
    if let Some(clause) = call.about_things(name)? {
        return Ok(clause);
    }
    match name {
        "navigate" => call.navigate(),
        "drop_off" => Ok(Clause::Drop { what: None, at: None, manner: Manner::DropOff }),
        "put_down" => Ok(Clause::Drop { what: None, at: None, manner: Manner::PutDown }),
        "sit_down" => Ok(Clause::Sit { on: call.optional_thing("seat")? }),
        "stand_up" => Ok(Clause::StandUp),
        "crouch" => Ok(Clause::Crouch),
        "stop" => Ok(Clause::Stop),
        "wait" => Ok(Clause::Wait { seconds: call.number("seconds", 0.001, 86_400.0)? }),
        "get_off_scooter" => Ok(Clause::Alight { from: Vehicle::Scooter }),
        "exit_car" => Ok(Clause::Alight { from: Vehicle::Car }),
        "step" => call.step(),
        "turn" => {
            Ok(Clause::Turn { angle: call.number("angle", -std::f64::consts::TAU, std::f64::consts::TAU)? })
        }
        "look" => Ok(Clause::LookUp { angle: call.number("angle", -FRAC_PI_2, FRAC_PI_2)? }),
        "walk_on" => Ok(Clause::Forward),
        "change_speed" => Ok(Clause::Speed { speed: call.number("speed", 0.1, 50.0)? }),
        _ => Ok(Clause::Photo { of: call.optional_thing("of")?, times: 1 }),
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

    /// Calls whose arguments name things.
    fn about_things(&self, name: &str) -> Result<Option<Clause>, PlanError> {
        Ok(Some(match name {
            "follow" => Clause::Follow { whom: self.thing("whom")?, pace: Pace::Usual },
            "face" => Clause::Face { what: self.thing("what")? },
            "pick_up" => Clause::Take { what: self.thing("item")?, to: None, grip: Grip::Lift },
            "give" => Clause::Give { what: self.optional_thing("item")?, to: self.thing("to")? },
            "throw" => Clause::Throw { what: self.optional_thing("item")?, to: self.thing("to")? },
            "buy" => Clause::Buy {
                goods: self.text("goods")?,
                times: 1,
                at: self.optional_thing("at")?,
                whom: None,
            },
            "ride_scooter" => Clause::Board { what: self.thing("scooter")?, to: None },
            "enter_car" => Clause::Board { what: self.thing("car")?, to: None },
            "open_door" => Clause::Door { what: self.optional_thing("door")?, open: true },
            "close_door" => Clause::Door { what: self.optional_thing("door")?, open: false },
            "say" => Clause::Say { to: self.thing("to")?, words: self.text("words")? },
            "argue" => Clause::Argue { with: self.thing("with")? },
            "wave" => Clause::Wave { to: self.thing("to")? },
            "point" => Clause::Point { at: self.thing("at")? },
            _ => return Ok(None),
        }))
    }

    fn text(&self, key: &str) -> Result<String, PlanError> {
        let text = self.args.get(key).and_then(Value::as_str).map(str::trim).filter(|text| !text.is_empty());
        text.map(str::to_owned).ok_or_else(|| self.refuse(format!("{key} must be words")))
    }

    fn optional_thing(&self, key: &str) -> Result<Option<Reference>, PlanError> {
        if self.args.contains_key(key) { self.thing(key).map(Some) } else { Ok(None) }
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
                let mut lexemes = lex_speech(words);
                correct(&mut lexemes, self.names);
                let mut parser = Parser::new(words, &lexemes, self.names, self.view);
                // Who or what is not here is no fault of the call.
                let thing = parser.reference(0).map_err(|error| match error {
                    PlanError::NotFound { .. } => error,
                    error => self.refuse(format!("{key}: {error}")),
                })?;
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
    Reference::to(target, text)
}
