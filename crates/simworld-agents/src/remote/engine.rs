//! The world's thread: it takes requests in turn, steps the world when it is time, and sends what is to be sent.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::{Duration, Instant};

use simworld_core::command::{Applied, Command};
use simworld_core::id::EntityId;
use simworld_core::traffic::TrafficOrder;

use super::cameras::Cameras;
use super::clock::{now, span};
use super::frame::Framing;
use super::hub::{ClientId, GLANCE, Hub};
use super::kept::{Kept, Note, brought_by};
use super::link::Link;
use super::unrealcv::Desk;
use super::watch::Watcher;
use super::{Limits, Pace, Picture, PictureKind, RemoteError, ServerConfig, Stage, StageError, typed};

/// Requests of a client that are taken over at once.
const HANDFUL: usize = 8;
/// A world in real time that is so many steps late begins to count anew.
const LATE: u32 = 5;
/// So often are clients looked at who have not taken their replies.
const HELD: Duration = Duration::from_millis(1);

/// What requests act on.
pub(super) struct Served<'a> {
    pub(super) stage: &'a mut dyn Stage,
    pub(super) cameras: Cameras,
    pub(super) pace: Pace,
    pub(super) limits: &'a Limits,
    pub(super) name: &'a str,
    /// Things that clients brought and did not take away.
    spawned: usize,
    /// What they left in things.
    pub(super) kept: Kept,
}

impl Served<'_> {
    /// Carries out a command, within what clients may bring.
    pub(super) fn apply(&mut self, command: Command) -> Result<Applied, Refused> {
        let change = change_by(&command);
        if change > 0 && self.spawned >= self.limits.spawned {
            return Err(Refused::Full(self.limits.spawned));
        }
        self.room_for(brought_by(&command))?;
        let note = Note::of(&command);
        let applied = self.stage.apply(command).map_err(Refused::Stage)?;
        self.spawned = self.spawned.saturating_add_signed(change);
        if let Some(note) = note {
            self.kept.count(&note, &applied);
        }
        Ok(applied)
    }

    /// Whether so many bytes more may be left in the world.
    pub(super) fn room_for(&mut self, bytes: usize) -> Result<(), Refused> {
        if bytes == 0 {
            return Ok(());
        }
        let fits = |kept: &Kept| kept.total().saturating_add(bytes) <= self.limits.kept_bytes;
        if !fits(&self.kept) {
            self.kept.forget_gone(self.stage.scene());
        }
        if fits(&self.kept) { Ok(()) } else { Err(Refused::Kept(self.limits.kept_bytes)) }
    }

    /// What a camera sees.
    pub(super) fn picture(&mut self, camera: u32, kind: PictureKind) -> Result<Picture, Refused> {
        let place = self.cameras.get(camera).ok_or(Refused::NoCamera(camera))?;
        let view = place.view(self.stage.scene()).ok_or(Refused::NoWearer(camera))?;
        self.stage.picture(&view, kind).map_err(Refused::Stage)
    }

    /// A camera at the eyes of somebody, if it has any and there is room for one more.
    pub(super) fn wear_camera(&mut self, id: EntityId) -> Option<u32> {
        self.cameras.forget_gone(self.stage.scene());
        let wearer = self.stage.scene().entity(id).filter(|entity| entity.kind.is_mobile())?;
        self.cameras.wear(&wearer)
    }
}

/// How many things more a command brings.
fn change_by(command: &Command) -> isize {
    match command {
        Command::Spawn(_)
        | Command::Respawn { .. }
        | Command::Traffic(
            TrafficOrder::SendVehicle { .. }
            | TrafficOrder::AddWalker { .. }
            | TrafficOrder::Close { .. }
            | TrafficOrder::Reroute { .. }
            | TrafficOrder::TurnRound { .. },
        ) => 1,
        Command::Remove { .. } => -1,
        _ => 0,
    }
}

/// Why a request was not done.
#[derive(Debug, thiserror::Error)]
pub(super) enum Refused {
    #[error(transparent)]
    Stage(StageError),
    #[error("clients have brought {0} things into the world, and more are not allowed: take some away")]
    Full(usize),
    #[error(
        "clients may leave {0} bytes in names, attributes and ways of things, and this is more: take some away"
    )]
    Kept(usize),
    #[error("there is no camera {0}: ask for the list of cameras")]
    NoCamera(u32),
    #[error("whoever wore camera {0} is gone")]
    NoWearer(u32),
}

/// What a request led to.
pub(super) enum Outcome {
    /// An answer.
    Reply(Vec<u8>),
    /// An answer when so many steps have passed.
    After(u32, Later),
    /// An answer, and somebody who watches from now on, or no longer.
    Watch(Vec<u8>, Option<Watcher>),
}

/// An answer that waits for steps.
pub(super) enum Later {
    /// To a client of `UnrealCV`: the whole answer.
    Text(Vec<u8>),
    /// To the call of that number.
    Typed(u64),
}

/// One client, as the world's thread knows it.
struct Session {
    link: Arc<Link>,
    todo: VecDeque<Vec<u8>>,
    is_waiting: bool,
    watcher: Option<Watcher>,
}

/// Steps that somebody asked for.
struct Ticking {
    client: ClientId,
    left: u32,
    later: Later,
}

/// The world's thread.
pub(super) struct Engine<'a> {
    served: Served<'a>,
    desk: Desk,
    hub: &'a Hub,
    sessions: BTreeMap<ClientId, Session>,
    ticking: VecDeque<Ticking>,
    /// When the next step is due in real time.
    due: Instant,
    /// Who is asked first in the next round.
    turn: ClientId,
    seen: u64,
    requests: u64,
    steps: u64,
}

impl<'a> Engine<'a> {
    pub(super) fn new(stage: &'a mut dyn Stage, hub: &'a Hub, config: &'a ServerConfig) -> Self {
        let served = Served {
            stage,
            cameras: Cameras::new(config.camera, config.limits.cameras),
            pace: config.pace,
            limits: &config.limits,
            name: &config.name,
            spawned: 0,
            kept: Kept::default(),
        };
        Self {
            served,
            desk: Desk::default(),
            hub,
            sessions: BTreeMap::new(),
            ticking: VecDeque::new(),
            due: now(),
            turn: 0,
            seen: 0,
            requests: 0,
            steps: 0,
        }
    }

    pub(super) fn requests(&self) -> u64 {
        self.requests
    }

    pub(super) fn steps(&self) -> u64 {
        self.steps
    }

    /// Serves until the server is stopped.
    pub(super) fn run(&mut self) -> Result<(), RemoteError> {
        while !self.hub.is_stopping() {
            self.collect();
            let mut busy = self.step_if_due()?;
            busy |= self.serve_a_round()?;
            if !busy {
                self.rest();
            }
        }
        Ok(())
    }

    /// Takes requests over from the clients' threads.
    fn collect(&mut self) {
        let sessions = std::cell::RefCell::new(&mut self.sessions);
        self.seen = self.hub.collect(
            &mut |id, link| {
                let mut sessions = sessions.borrow_mut();
                let session = sessions.entry(id).or_insert_with(|| Session {
                    link: Arc::clone(link),
                    todo: VecDeque::new(),
                    is_waiting: false,
                    watcher: None,
                });
                HANDFUL.saturating_sub(session.todo.len())
            },
            &mut |id, request| {
                if let Some(session) = sessions.borrow_mut().get_mut(&id) {
                    session.todo.push_back(request);
                }
            },
        );
        let ticking = &mut self.ticking;
        self.sessions.retain(|id, session| {
            if session.link.is_open() {
                return true;
            }
            // What it asked is still done; steps that nobody waits for are not taken.
            ticking.retain(|ticking| ticking.client != *id);
            (session.is_waiting, session.watcher) = (false, None);
            !session.todo.is_empty()
        });
    }

    /// Answers one request of each client, beginning with another one each time; says whether there was any.
    fn serve_a_round(&mut self) -> Result<bool, RemoteError> {
        let first = self.turn;
        let order: Vec<ClientId> =
            self.sessions.range(first..).chain(self.sessions.range(..first)).map(|(id, _)| *id).collect();
        let mut busy = false;
        for id in order {
            let Some(session) = self.sessions.get_mut(&id) else { continue };
            if session.is_waiting || session.link.is_full() {
                continue;
            }
            let Some(request) = session.todo.pop_front() else { continue };
            let framing = session.link.framing();
            busy = true;
            self.turn = id + 1;
            self.requests += 1;
            let outcome = match framing {
                Framing::UnrealCv => self.desk.answer(&mut self.served, &request),
                Framing::Typed => typed::answer(&mut self.served, &request),
            };
            self.carry_out(id, outcome);
            // A picture may take longer than a step.
            self.step_if_due()?;
        }
        Ok(busy)
    }

    fn carry_out(&mut self, id: ClientId, outcome: Outcome) {
        let Some(session) = self.sessions.get_mut(&id) else { return };
        match outcome {
            Outcome::Reply(payload) => session.link.send(&payload),
            Outcome::Watch(payload, watcher) => {
                session.watcher = watcher;
                session.link.send(&payload);
            }
            Outcome::After(left, later) => {
                session.is_waiting = true;
                self.ticking.push_back(Ticking { client: id, left, later });
            }
        }
    }

    /// Takes a step if somebody asked for one, or if it is time; says whether it did.
    fn step_if_due(&mut self) -> Result<bool, RemoteError> {
        match self.served.pace {
            Pace::Lockstep => {
                if self.ticking.is_empty() {
                    return Ok(false);
                }
            }
            Pace::RealTime(factor) => {
                let (now, length) = (now(), self.step_length(factor));
                if now < self.due {
                    return Ok(false);
                }
                self.due += length;
                if self.due + length * LATE < now {
                    self.due = now + length;
                }
            }
        }
        self.step()?;
        Ok(true)
    }

    fn step_length(&self, factor: f64) -> Duration {
        span(self.served.stage.scene().clock().dt() / factor)
    }

    fn step(&mut self) -> Result<(), RemoteError> {
        self.desk.before_step(&mut self.served);
        self.served.stage.step()?;
        self.steps += 1;
        let stage = &*self.served.stage;
        self.desk.after_step(stage.scene(), stage.events());
        for session in self.sessions.values_mut() {
            let Session { link, watcher: Some(watcher), .. } = session else { continue };
            let most = self.served.limits.entities;
            // One observation on its way is enough: whoever is slow sees fewer, and all of them are fresh.
            let can_take = || link.waiting() == 0;
            if let Some(observation) = watcher.after_step(stage.scene(), stage.events(), most, can_take) {
                link.send(&typed::observation(observation));
            }
        }
        self.count_down();
        Ok(())
    }

    /// Answers those whose steps have passed. In lockstep a step is taken for the one who asked first.
    fn count_down(&mut self) {
        let counted = match self.served.pace {
            Pace::Lockstep => 1.min(self.ticking.len()),
            Pace::RealTime(_) => self.ticking.len(),
        };
        for ticking in self.ticking.iter_mut().take(counted) {
            ticking.left = ticking.left.saturating_sub(1);
        }
        let tick = self.served.stage.scene().clock().tick();
        let sessions = &mut self.sessions;
        self.ticking.retain(|ticking| {
            if ticking.left > 0 {
                return true;
            }
            if let Some(session) = sessions.get_mut(&ticking.client) {
                session.is_waiting = false;
                match &ticking.later {
                    Later::Text(payload) => session.link.send(payload),
                    Later::Typed(call) => session.link.send(&typed::ticked(*call, tick)),
                }
            }
            false
        });
    }

    /// Waits for something to do.
    fn rest(&self) {
        let is_held = self.sessions.values().any(|session| !session.todo.is_empty());
        let longest = if is_held { HELD } else { GLANCE };
        let until_due = match self.served.pace {
            Pace::Lockstep => longest,
            Pace::RealTime(_) => self.due.saturating_duration_since(now()).min(longest),
        };
        if !until_due.is_zero() {
            self.hub.wait(self.seen, until_due);
        }
    }
}
