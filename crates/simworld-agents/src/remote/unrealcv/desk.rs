//! Where lines are answered: the table's commands, each by the file that knows its subject.

use simworld_core::event::Event;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Scene};

use super::answer::{Answered, Failed, Said, payload};
use super::command::{COMMANDS, Order, Verb, parse};
use super::errand::Errands;
use super::names::Names;
use super::tally::Tally;
use super::{LineError, act, farewell, manage, objects, read_line, signals, views};
use crate::remote::engine::{Later, Outcome, Served};
use crate::remote::{Pace, Stage};

/// What is kept for clients of `UnrealCV`, beside the world.
#[derive(Default)]
pub(in crate::remote) struct Desk {
    pub(super) names: Names,
    pub(super) errands: Errands,
    pub(super) tally: Tally,
    /// Time of a tick, s; that of a step until it is set.
    interval: Option<f64>,
}

impl Desk {
    /// Answers a request.
    pub(in crate::remote) fn answer(&mut self, served: &mut Served<'_>, request: &[u8]) -> Outcome {
        let Ok((number, line)) = read_line(request) else {
            return Outcome::Reply(farewell(&LineError));
        };
        let answered = parse(line).and_then(|order| self.carry_out(served, &order));
        match answered {
            Ok(Said::After(steps)) => Outcome::After(steps, Later::Text(payload(number, Ok(Said::Done)))),
            answered => Outcome::Reply(payload(number, answered)),
        }
    }

    /// Lets errands go on.
    pub(in crate::remote) fn before_step(&mut self, served: &mut Served<'_>) {
        self.errands.run(served);
    }

    /// Takes note of what happened.
    pub(in crate::remote) fn after_step(&mut self, scene: &dyn Scene, events: &[Event]) {
        self.tally.count(scene, events);
    }

    /// The entity that a line names.
    pub(super) fn find(&mut self, stage: &dyn Stage, name: &str) -> Result<EntityId, Failed> {
        self.names.find(stage, name).ok_or_else(|| Failed::NoObject(name.to_owned()))
    }

    fn carry_out(&mut self, served: &mut Served<'_>, order: &Order<'_>) -> Answered {
        let verb = order.verb;
        if verb <= Verb::Batch {
            plugin(served, order)
        } else if verb <= Verb::Destroy {
            objects::answer(self, served, order)
        } else if verb <= Verb::CleanGarbage {
            self.time(served, order)
        } else if verb <= Verb::ObjectMask {
            views::answer(self, served, order)
        } else if verb <= Verb::EnableController {
            act::answer(self, served, order)
        } else if verb <= Verb::GetFog {
            manage::answer(self, served, order)
        } else if verb <= Verb::StartSignals {
            signals::answer(self, served, order)
        } else {
            Err(Failed::NoCounterpart(reason(verb)))
        }
    }

    /// Commands about time.
    fn time(&mut self, served: &mut Served<'_>, order: &Order<'_>) -> Answered {
        let dt = served.stage.scene().clock().dt();
        match order.verb {
            Verb::Tick => Ok(Said::After(self.steps(served)?)),
            Verb::TickInterval | Verb::FrameRate => {
                let [value] = order.numbers(0);
                let interval = if order.verb == Verb::FrameRate { 1.0 / value } else { value };
                if !(interval >= dt * 0.999 && interval / dt <= f64::from(served.limits.steps)) {
                    let text = format!(
                        "a tick takes whole steps of {dt:.6} s here, from one to {}",
                        served.limits.steps
                    );
                    return Err(Failed::Value(text));
                }
                self.interval = Some(interval);
                Ok(Said::Done)
            }
            Verb::Pause => {
                served.pace = Pace::Lockstep;
                Ok(Said::Done)
            }
            Verb::Resume => {
                served.pace = Pace::RealTime(1.0);
                Ok(Said::Done)
            }
            _ => Ok(Said::Done),
        }
    }

    /// Steps of a tick.
    fn steps(&self, served: &Served<'_>) -> Result<u32, Failed> {
        let dt = served.stage.scene().clock().dt();
        let steps = self.interval.map_or(1.0, |interval| (interval / dt).round().max(1.0));
        if steps <= f64::from(served.limits.steps) {
            Ok(steps as u32)
        } else {
            Err(Failed::Value(format!(
                "a tick of {steps} steps is longer than {} allowed",
                served.limits.steps
            )))
        }
    }
}

/// An entity that was found a moment ago.
pub(super) fn entity<'a>(served: &'a Served<'_>, id: EntityId) -> Result<EntityRef<'a>, Failed> {
    served.stage.scene().entity(id).ok_or_else(|| Failed::NoObject(id.to_string()))
}

/// Why a command is refused whatever it says: what the table says of it.
fn reason(verb: Verb) -> &'static str {
    let help = COMMANDS.iter().find(|(own, ..)| *own == verb).map_or("", |(_, _, help)| help);
    help.strip_prefix("refused: ").unwrap_or(help)
}

/// Commands about the server itself.
fn plugin(served: &mut Served<'_>, order: &Order<'_>) -> Answered {
    let lines = |line: &dyn Fn(&(Verb, &str, &str)) -> String| {
        COMMANDS.iter().map(line).collect::<Vec<_>>().join("\n")
    };
    match order.verb {
        Verb::Status => Ok(Said::Text("Is Listening\nClient Connected".to_owned())),
        Verb::Version => Ok(Said::Text(format!("simworld {}", env!("CARGO_PKG_VERSION")))),
        Verb::Commands => Ok(Said::Text(lines(&|(_, template, _)| (*template).to_owned()))),
        Verb::Help => Ok(Said::Text(lines(&|(_, template, help)| format!("{template}\n{help}")))),
        Verb::Echo => Ok(Said::Text(order.word(0).to_owned())),
        Verb::Auth => Ok(Said::Text("Authentication succeeded".to_owned())),
        Verb::SceneName => Ok(Said::Text(served.name.to_owned())),
        Verb::SetResolution => views::set_resolution(served, order.word(0)),
        Verb::Run => Err(Failed::Alias(order.words.join(" "))),
        _ => Ok(Said::Done),
    }
}
