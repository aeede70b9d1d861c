//! The small movements by which a body is steered: which a body has, their schema, and how they are carried out.

use serde::{Deserialize, Serialize};
use serde_json::Value as Json;
use simworld_core::action::{Action, ActionKind, ActionSet, StepDirection};
use simworld_core::geometry::{Point2, yaw_of};
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityRef, Scene};

use super::aim::Aim;
use super::steered::rides;
use crate::thought::schema::{integer, object, one_of, whole, words};

/// Heading errors below this are left alone, radians.
const FACED: f64 = 0.03;
/// The time that a step takes at most, s.
const STEPPING: f64 = 1.0;
/// The angle by which the slowest body turns in a second, radians.
const SLOWEST_TURN: f64 = 0.3;
/// The braking with which a scooter comes to rest, m/s²: what European rules ask of it.
const ROLLING: f64 = 3.5;
/// Slower than this one stands, m/s.
const STANDING: f64 = 0.2;

/// One movement.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Movement {
    /// Straight ahead, m.
    Forward(f64),
    /// On the spot, radians to the left.
    Turn(f64),
    /// One step, m.
    Step(StepDirection, f64),
    /// The gaze, radians upwards.
    Look(f64),
    /// Pedal (-1 to 1) and wheels (radians to the left) for some time, s.
    Drive(f64, f64, f64),
    /// The brake for some time, s.
    Brake(f64),
}

/// What a model decided.
pub(super) enum Deed {
    Move(Movement),
    Done,
    GiveUp(String),
}

/// A movement under way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Moving {
    movement: Movement,
    from: Point2,
    /// The heading wanted, radians.
    heading: f64,
    /// Steps of the simulation that it may still take.
    left: u64,
    begun: bool,
    /// Whether it was told to stop, and only has to come to rest.
    stopping: bool,
    /// Whether it rolls on meanwhile.
    rolls: bool,
}

/// The calls of a body, each with its schema and what it does.
fn calls(able: ActionSet, aim: Aim) -> Vec<(&'static str, Json, &'static str)> {
    let has = |kind| able.contains(kind);
    let call = |act: &'static str, fields: Vec<(&'static str, Json)>, says| {
        (act, object(std::iter::once(("act", one_of([act]))).chain(fields)), says)
    };
    let mut calls = Vec::new();
    if has(ActionKind::MoveForward) {
        calls.push(call(
            "forward",
            vec![("decimetres", integer(1, 100))],
            "forward(decimetres): goes straight ahead",
        ));
    }
    if has(ActionKind::Rotate) {
        calls.push(call(
            "turn",
            vec![("degrees", integer(-180, 180))],
            "turn(degrees): turns, to the left if positive",
        ));
    }
    if has(ActionKind::Step) {
        let way = one_of(["forward", "backward", "left", "right"]);
        let fields = vec![("direction", way), ("decimetres", integer(1, 10))];
        calls.push(call("step", fields, "step(direction, decimetres): takes a step"));
    }
    if has(ActionKind::LookUp) {
        calls.push(call(
            "look",
            vec![("degrees", integer(-60, 60))],
            "look(degrees): raises the camera, below zero lowers it",
        ));
    }
    if has(ActionKind::Throttle) && has(ActionKind::Steer) {
        let fields =
            vec![("percent", integer(-100, 100)), ("degrees", integer(-35, 35)), ("tenths", integer(1, 50))];
        let says = "drive(percent, degrees, tenths): accelerator (below zero reverse), front wheels (to the left if positive), for so many tenths of a second";
        calls.push(call("drive", fields, says));
    }
    if has(ActionKind::Brake) {
        calls.push(call(
            "brake",
            vec![("tenths", integer(1, 100))],
            "brake(tenths): brakes for so many tenths of a second",
        ));
    }
    if aim.ends() {
        calls.push(call("done", Vec::new(), "done(): the aim is reached"));
    }
    calls.push(call("give_up", vec![("why", words(200))], "give_up(why): the aim cannot be reached"));
    calls
}

/// What a body can be told, as schemas and as lines for a prompt.
pub(super) fn offered(able: ActionSet, aim: Aim) -> (Vec<Json>, String) {
    let calls = calls(able, aim);
    let lines: Vec<&str> = calls.iter().map(|(_, _, says)| *says).collect();
    (calls.iter().map(|(_, schema, _)| schema.clone()).collect(), lines.join("\n"))
}

/// What a deed that conforms to its schema stands for.
pub(super) fn read(deed: &Json) -> Option<Deed> {
    let number = |name: &str| whole(&deed[name]).map(|number| number as f64);
    let movement = match deed["act"].as_str()? {
        "forward" => Movement::Forward(number("decimetres")? / 10.0),
        "turn" => Movement::Turn(number("degrees")?.to_radians()),
        "step" => {
            let direction = match deed["direction"].as_str()? {
                "forward" => StepDirection::Forward,
                "backward" => StepDirection::Backward,
                "left" => StepDirection::Left,
                _ => StepDirection::Right,
            };
            Movement::Step(direction, number("decimetres")? / 10.0)
        }
        "look" => Movement::Look(number("degrees")?.to_radians()),
        "drive" => {
            let (pedal, wheels) = (number("percent")? / 100.0, number("degrees")?.to_radians());
            Movement::Drive(pedal, wheels, number("tenths")? / 10.0)
        }
        "brake" => Movement::Brake(number("tenths")? / 10.0),
        "done" => return Some(Deed::Done),
        "give_up" => return Some(Deed::GiveUp(deed["why"].as_str()?.to_owned())),
        _ => return None,
    };
    Some(Deed::Move(movement))
}

impl Moving {
    /// A movement from where a body is, at this speed (m/s) if it goes somewhere.
    pub(super) fn new(movement: Movement, scene: &dyn Scene, me: &EntityRef<'_>, speed: f64) -> Self {
        let turn = if let Movement::Turn(angle) = movement { angle } else { 0.0 };
        let seconds = match movement {
            // Twice the time that it takes unhindered, and a second to get going.
            Movement::Forward(distance) => 1.0 + 2.0 * distance / speed,
            Movement::Turn(angle) => 1.0 + angle.abs() / SLOWEST_TURN,
            Movement::Step(..) => STEPPING,
            Movement::Look(_) => 0.0,
            Movement::Drive(_, _, seconds) | Movement::Brake(seconds) => seconds,
        };
        let left = scene.clock().ticks_in(seconds).max(1);
        let heading = wrap_angle(yaw_of(me.pose) + turn);
        let (from, rolls) = (me.planar(), rides(scene, me));
        Self { movement, from, heading, left, begun: false, stopping: false, rolls }
    }

    /// Goes on for one step of the simulation; what came of it once it has ended.
    pub(super) fn advance(
        &mut self,
        me: &EntityRef<'_>,
        dt: f64,
        speed: f64,
        out: &mut Vec<Action>,
    ) -> Option<String> {
        let first = !std::mem::replace(&mut self.begun, true);
        let over = self.left == 0;
        self.left = self.left.saturating_sub(1);
        match self.movement {
            Movement::Forward(distance) => {
                out.extend(first.then_some(Action::MoveForward { speed }));
                return self.come_to_rest(me, (distance, 0.5 * speed * dt), over, out);
            }
            Movement::Turn(angle) => {
                let error = wrap_angle(self.heading - yaw_of(me.pose));
                if error.abs() <= FACED || over {
                    let turned = (angle - error).to_degrees();
                    return Some(format!("turned {turned:.0}° of {:.0}° to the left", angle.to_degrees()));
                }
                out.push(Action::Rotate { angle: error });
            }
            Movement::Step(direction, distance) => {
                if first {
                    out.push(Action::Step { direction, distance });
                } else if over {
                    let gone = (me.planar() - self.from).norm();
                    return Some(format!("stepped {gone:.1} m of {distance:.1} m {direction:?}"));
                }
            }
            Movement::Look(angle) => {
                if !first {
                    return Some(format!("raised the camera by {:.0}°", angle.to_degrees()));
                }
                let up = angle >= 0.0;
                let angle = angle.abs();
                out.push(if up { Action::LookUp { angle } } else { Action::LookDown { angle } });
            }
            Movement::Drive(level, angle, seconds) => {
                if first {
                    out.extend([Action::Steer { angle }, Action::Throttle { level }]);
                } else if over {
                    let gone = (me.planar() - self.from).norm();
                    return Some(format!("drove {gone:.1} m in {seconds:.1} s"));
                }
            }
            Movement::Brake(seconds) => {
                if first {
                    out.push(Action::Brake { level: 1.0 });
                } else if over {
                    let speed = me.twist.ground_speed();
                    return Some(format!("braked for {seconds:.1} s, now at {speed:.1} m/s"));
                }
            }
        }
        None
    }
    /// Tells a body that goes ahead to stop where it is to come to rest, this far (m) and give or take so much; says how far that was
    /// when it stands.
    fn come_to_rest(
        &mut self,
        me: &EntityRef<'_>,
        (distance, slack): (f64, f64),
        over: bool,
        out: &mut Vec<Action>,
    ) -> Option<String> {
        let gone = (me.planar() - self.from).norm();
        let pace = me.twist.ground_speed();
        if self.stopping {
            // The next picture is taken where it stands.
            let rests = over || pace < STANDING;
            return rests.then(|| format!("went {gone:.1} m of {distance:.1} m forward"));
        }
        let rolling = if self.rolls { 0.5 * pace * pace / ROLLING } else { 0.0 };
        if over || gone + rolling >= distance - slack {
            self.stopping = true;
            out.push(Action::Stop);
        }
        None
    }
}
