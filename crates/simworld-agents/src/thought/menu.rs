//! What a model may answer: calls that this body can do on things that it knows, as a schema, and back as orders.

use std::collections::BTreeMap;

use serde_json::{Value as Json, json};
use simworld_core::action::{ActionKind, ActionSet};
use simworld_core::intent::Intent;
use simworld_core::value::Value;

use super::checks;
use super::known::{Known, Use};
use super::schema::{any_of, defined, integer, list, object, one_of, whole, words};
use crate::language::Order;

/// How far away a point may be that is gone to, decimetres in each axis.
const FARTHEST: i64 = 20_000;
/// The most steps of a plan and of a block.
const STEPS: usize = 24;
/// How often a block may be repeated.
const TIMES: i64 = 1000;
/// The most characters that are said at once.
pub(super) const WORDS: usize = 300;

/// What an argument may be.
#[derive(Clone, Copy, Debug)]
enum Arg {
    Thing(Use),
    Goods,
    /// A coordinate, decimetres.
    East,
    North,
    /// Decimetres a second; 0 is the usual speed.
    Pace,
    /// Tenths of the call's own unit: metres, metres a second, seconds.
    Tenths(i64, i64),
    Degrees(i64, i64),
    Way,
    Words,
}

/// One call: its name in answers, the call that it stands for, the kinds of action of which the body needs one, its arguments
/// (name in answers, name in the call), and what it does.
struct Entry {
    act: &'static str,
    call: &'static str,
    needs: &'static [ActionKind],
    args: &'static [(&'static str, &'static str, Arg)],
    says: &'static str,
}

use ActionKind as A;

const ENTRIES: &[Entry] = &[
    Entry {
        act: "go_to",
        call: "navigate",
        needs: &[A::MoveForward, A::Throttle],
        args: &[("to", "to", Arg::Thing(Use::Any)), ("speed", "speed", Arg::Pace)],
        says: "goes to it and stops there; speed in decimetres a second, 0 for the usual",
    },
    Entry {
        act: "go_to_point",
        call: "navigate",
        needs: &[A::MoveForward, A::Throttle],
        args: &[("x", "x", Arg::East), ("y", "y", Arg::North), ("speed", "speed", Arg::Pace)],
        says: "goes to a point, decimetres to the east and north",
    },
    Entry {
        act: "follow",
        call: "follow",
        needs: &[A::MoveForward],
        args: &[("whom", "whom", Arg::Thing(Use::Mover))],
        says: "goes after it, and never ends: put it into until",
    },
    Entry {
        act: "face",
        call: "face",
        needs: &[A::Rotate],
        args: &[("what", "what", Arg::Thing(Use::Any))],
        says: "turns to look at it",
    },
    Entry {
        act: "pick_up",
        call: "pick_up",
        needs: &[A::PickUp, A::CarryHeavy],
        args: &[("item", "item", Arg::Thing(Use::Item))],
        says: "goes there and takes it",
    },
    Entry {
        act: "drop_off",
        call: "drop_off",
        needs: &[A::DropOff],
        args: &[],
        says: "lets go of what the hand holds",
    },
    Entry {
        act: "put_down",
        call: "put_down",
        needs: &[A::PutDownHeavy],
        args: &[],
        says: "puts down what both arms carry",
    },
    Entry {
        act: "give",
        call: "give",
        needs: &[A::Give],
        args: &[("to", "to", Arg::Thing(Use::Receiver))],
        says: "goes there and hands over what the hand holds",
    },
    Entry {
        act: "throw",
        call: "throw",
        needs: &[A::ThrowTo],
        args: &[("to", "to", Arg::Thing(Use::Receiver))],
        says: "goes near enough and throws what the hand holds at somebody",
    },
    Entry {
        act: "buy",
        call: "buy",
        needs: &[A::Buy],
        args: &[("goods", "goods", Arg::Goods)],
        says: "goes there and buys it",
    },
    Entry {
        act: "sit_down",
        call: "sit_down",
        needs: &[A::SitDown],
        args: &[("seat", "seat", Arg::Thing(Use::Seat))],
        says: "goes there and sits down",
    },
    Entry { act: "stand_up", call: "stand_up", needs: &[A::StandUp], args: &[], says: "gets up" },
    Entry {
        act: "crouch",
        call: "crouch",
        needs: &[A::Crouch],
        args: &[],
        says: "goes down on bent knees, until it gets up",
    },
    Entry { act: "stop", call: "stop", needs: &[A::Stop], args: &[], says: "halts" },
    Entry {
        act: "wait",
        call: "wait",
        needs: &[A::Stop],
        args: &[("tenths", "seconds", Arg::Tenths(1, 864_000))],
        says: "stands and waits, tenths of a second",
    },
    Entry {
        act: "ride_scooter",
        call: "ride_scooter",
        needs: &[A::RideScooter],
        args: &[("scooter", "scooter", Arg::Thing(Use::Scooter))],
        says: "goes there and gets on it",
    },
    Entry {
        act: "get_off_scooter",
        call: "get_off_scooter",
        needs: &[A::GetOffScooter],
        args: &[],
        says: "gets off the scooter",
    },
    Entry {
        act: "enter_car",
        call: "enter_car",
        needs: &[A::EnterCar],
        args: &[("car", "car", Arg::Thing(Use::Car))],
        says: "goes there and gets in, or on a bicycle or motorcycle",
    },
    Entry { act: "exit_car", call: "exit_car", needs: &[A::ExitCar], args: &[], says: "gets out of the car" },
    Entry {
        act: "open_door",
        call: "open_door",
        needs: &[A::OpenDoor],
        args: &[("door", "door", Arg::Thing(Use::Door))],
        says: "goes there and opens it",
    },
    Entry {
        act: "close_door",
        call: "close_door",
        needs: &[A::CloseDoor],
        args: &[("door", "door", Arg::Thing(Use::Door))],
        says: "goes there and closes it",
    },
    Entry {
        act: "step",
        call: "step",
        needs: &[A::Step],
        args: &[("direction", "direction", Arg::Way), ("distance", "distance", Arg::Tenths(1, 100))],
        says: "takes a step, decimetres",
    },
    Entry {
        act: "turn",
        call: "turn",
        needs: &[A::Rotate],
        args: &[("degrees", "angle", Arg::Degrees(-360, 360))],
        says: "turns, degrees to the left",
    },
    Entry {
        act: "look",
        call: "look",
        needs: &[A::LookUp],
        args: &[("degrees", "angle", Arg::Degrees(-90, 90))],
        says: "raises the gaze, degrees; below zero lowers it",
    },
    Entry {
        act: "change_speed",
        call: "change_speed",
        needs: &[A::ChangeSpeed],
        args: &[("speed", "speed", Arg::Tenths(1, 500))],
        says: "walks at another speed from now on, decimetres a second",
    },
    Entry {
        act: "say",
        call: "say",
        needs: &[A::Converse],
        args: &[("to", "to", Arg::Thing(Use::Listener)), ("words", "words", Arg::Words)],
        says: "goes there and says it",
    },
    Entry {
        act: "argue",
        call: "argue",
        needs: &[A::Argue],
        args: &[("with", "with", Arg::Thing(Use::Listener))],
        says: "goes there and argues",
    },
    Entry {
        act: "wave",
        call: "wave",
        needs: &[A::WaveHand],
        args: &[("to", "to", Arg::Thing(Use::Any))],
        says: "waves at it",
    },
    Entry {
        act: "point",
        call: "point",
        needs: &[A::PointDirection],
        args: &[("at", "at", Arg::Thing(Use::Any))],
        says: "points at it",
    },
    Entry { act: "take_photo", call: "take_photo", needs: &[A::TakePhoto], args: &[], says: "takes a photo" },
    Entry {
        act: "walk_on",
        call: "walk_on",
        needs: &[A::MoveForward],
        args: &[],
        says: "walks straight on, and never ends: put it into until",
    },
];

/// The calls that one body can make on the things that it knows.
pub(super) struct Menu<'a> {
    known: &'a Known,
    entries: Vec<&'static Entry>,
}

impl<'a> Menu<'a> {
    /// The menu follows from the body and from what it knows, and from nothing that is written anywhere.
    pub(super) fn new(abilities: ActionSet, known: &'a Known) -> Self {
        let possible = |entry: &&Entry| {
            let able = entry.needs.iter().any(|kind| abilities.contains(*kind));
            able && entry.args.iter().all(|(_, _, arg)| match arg {
                Arg::Thing(wanted) => known.ids(*wanted).next().is_some(),
                Arg::Goods => known.goods().next().is_some(),
                _ => true,
            })
        };
        Self { known, entries: ENTRIES.iter().filter(possible).collect() }
    }

    /// The calls as lines for a prompt.
    pub(super) fn described(&self) -> String {
        let line = |entry: &&Entry| {
            let args: Vec<&str> = entry.args.iter().map(|(name, _, _)| *name).collect();
            format!("{}({}): {}", entry.act, args.join(", "), entry.says)
        };
        self.entries.iter().map(line).collect::<Vec<_>>().join("\n")
    }

    /// The schema of a plan with blocks nested that deep.
    pub(super) fn plan_schema(&self, depth: u32) -> Json {
        let mut definitions = self.definitions();
        for level in 0..=depth {
            let mut branches = self.leaves();
            if level > 0 {
                let inner = defined(&format!("step_{}", level - 1));
                let some = |least| list(&inner, least, STEPS);
                let check = || defined(checks::TOP);
                let when = |act: &str| ("act", one_of([act]));
                branches.extend([
                    object([when("if"), ("check", check()), ("then", some(1)), ("otherwise", some(0))]),
                    object([when("repeat"), ("times", integer(1, TIMES)), ("steps", some(1))]),
                    object([when("until"), ("check", check()), ("steps", some(0))]),
                ]);
            }
            definitions.insert(format!("step_{level}"), any_of(branches));
        }
        if depth > 0 {
            definitions.extend(checks::definitions(self.known));
        }
        let steps = list(&defined(&format!("step_{depth}")), 0, STEPS);
        let mut schema = object([("aim", words(WORDS)), ("cannot", words(WORDS)), ("steps", steps)]);
        schema["$defs"] = json!(definitions);
        schema
    }

    /// The schema of one call with words before it, or of one of the branches that are given beside the calls.
    pub(super) fn deed_schema(&self, beside: Vec<Json>) -> Json {
        let mut branches = self.leaves();
        branches.extend(beside);
        let mut schema = object([("because", words(WORDS)), ("deed", any_of(branches))]);
        schema["$defs"] = json!(self.definitions());
        schema
    }

    fn leaves(&self) -> Vec<Json> {
        self.entries.iter().map(|entry| defined(entry.act)).collect()
    }

    fn definitions(&self) -> BTreeMap<String, Json> {
        let mut definitions = BTreeMap::new();
        for wanted in Use::ALL {
            let ids: Vec<String> = self.known.ids(wanted).collect();
            if !ids.is_empty() {
                definitions.insert(wanted.name().to_owned(), one_of(ids));
            }
        }
        for entry in &self.entries {
            let args = entry.args.iter().map(|(name, _, arg)| (*name, self.arg_schema(*arg)));
            let schema = object(std::iter::once(("act", one_of([entry.act]))).chain(args));
            definitions.insert(entry.act.to_owned(), schema);
        }
        definitions
    }

    fn arg_schema(&self, arg: Arg) -> Json {
        let around = |at: f64| {
            let middle = (at * 10.0).round() as i64;
            integer(middle - FARTHEST, middle + FARTHEST)
        };
        match arg {
            Arg::Thing(wanted) => defined(wanted.name()),
            Arg::Goods => one_of(self.known.goods()),
            Arg::East => around(self.known.here.x),
            Arg::North => around(self.known.here.y),
            Arg::Pace => integer(0, 500),
            Arg::Tenths(low, high) | Arg::Degrees(low, high) => integer(low, high),
            Arg::Way => one_of(["forward", "backward", "left", "right"]),
            Arg::Words => words(WORDS),
        }
    }

    /// The orders of a plan that conforms to [`plan_schema`](Self::plan_schema).
    pub(super) fn orders(&self, steps: &Json) -> Result<Vec<Order>, String> {
        let steps = steps.as_array().ok_or("the steps must be a list")?;
        steps.iter().map(|step| self.order(step)).collect()
    }

    fn order(&self, step: &Json) -> Result<Order, String> {
        let condition = || checks::read(&step["check"], self.known);
        Ok(match step["act"].as_str().unwrap_or_default() {
            "if" => Order::If {
                condition: condition()?,
                then: self.orders(&step["then"])?,
                otherwise: self.orders(&step["otherwise"])?,
            },
            "repeat" => {
                let times = whole(&step["times"]).and_then(|times| u32::try_from(times).ok());
                Order::Repeat {
                    times: times.ok_or("times must be a whole number")?,
                    orders: self.orders(&step["steps"])?,
                }
            }
            "until" => Order::Until { condition: condition()?, orders: self.orders(&step["steps"])? },
            _ => {
                let (name, args) = self.call(step)?;
                Order::Call { name, args }
            }
        })
    }

    /// The intent of a call that conforms to [`deed_schema`](Self::deed_schema).
    pub(super) fn intent(&self, deed: &Json) -> Result<Intent, String> {
        self.call(deed).map(|(name, args)| Intent::Call { name: name.to_owned(), args })
    }

    fn call(&self, step: &Json) -> Result<(&'static str, BTreeMap<String, Value>), String> {
        let act = step["act"].as_str().unwrap_or_default();
        let entry = self.entries.iter().find(|entry| entry.act == act);
        let entry = entry.ok_or_else(|| format!("{act:?} is not possible here"))?;
        let mut args = BTreeMap::new();
        for (name, key, arg) in entry.args {
            self.read_arg(*arg, &step[*name], key, &mut args)
                .ok_or_else(|| format!("{name} cannot be read"))?;
        }
        Ok((entry.call, args))
    }

    fn read_arg(&self, arg: Arg, given: &Json, key: &str, args: &mut BTreeMap<String, Value>) -> Option<()> {
        let value: Value = match arg {
            Arg::Thing(_) => self.known.find(given.as_str()?)?.id.into(),
            Arg::Goods => {
                let (place, index) = given.as_str()?.rsplit_once('/')?;
                let place = self.known.find(place)?;
                let sold = place.goods.get(index.parse::<usize>().ok()?)?;
                args.insert("at".to_owned(), place.id.into());
                sold.as_str().into()
            }
            Arg::Pace if whole(given)? == 0 => return Some(()),
            Arg::East | Arg::North | Arg::Pace | Arg::Tenths(..) => (whole(given)? as f64 / 10.0).into(),
            Arg::Degrees(..) => (whole(given)? as f64).to_radians().into(),
            Arg::Way | Arg::Words => given.as_str()?.into(),
        };
        args.insert(key.to_owned(), value);
        Some(())
    }
}
