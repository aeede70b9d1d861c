//! Itineraries: people who walk, wait and ride, one stage after the other.

use std::collections::BTreeMap;

use simworld_core::geometry::Point2;

use crate::{Leg, Traffic, TripEnd};

/// Who waits this near to where a vehicle halts gets in, m.
const NEAR: f64 = 30.0;

/// A place at a road: a leg, and how far along it, m.
pub type Kerb = (Leg, f64);

/// One stage of a day.
#[derive(Clone, Debug, PartialEq)]
pub enum Stage {
    /// On foot, from one place to another, m.
    Walk {
        /// Near where it begins.
        from: Point2,
        /// Near where it ends.
        to: Point2,
    },
    /// Somewhere off the street.
    Wait {
        /// How long, s.
        seconds: f64,
        /// Until when at least, s after the start.
        until: f64,
    },
    /// In a vehicle that halts at both places.
    Ride {
        /// Where one gets in.
        from: Kerb,
        /// Where one gets out.
        to: Kerb,
        /// The names of vehicles, flows or lines that one takes; any if there are none.
        lines: Vec<String>,
    },
}

/// The stages of one person.
#[derive(Clone, Debug, PartialEq)]
pub struct Itinerary {
    /// What the person is called.
    pub name: String,
    /// When they set out, s after the start.
    pub depart: f64,
    /// What they do then.
    pub stages: Vec<Stage>,
}

/// How many are where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Whereabouts {
    /// Those who have not set out, wait somewhere, or for a vehicle.
    pub waiting: u32,
    /// Those on foot.
    pub walking: u32,
    /// Those in vehicles.
    pub riding: u32,
    /// Those who came to the end.
    pub arrived: u32,
    /// Those whose walk is not possible, or whose vehicle ended its trip before it halted where they get out.
    pub stranded: u32,
}

/// Where somebody is in their stages.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// The next stage begins at this time, s.
    Before(f64),
    /// The walker of this number.
    Walking(u32),
    /// The vehicle of this number.
    Riding(u32),
    Arrived,
    Stranded,
}

/// A vehicle under way, as those who wait for it know it: its own name, that of its flow, and that of its line.
pub(super) type Names = [String; 3];

/// Everybody with an itinerary.
#[derive(Clone, Debug, Default)]
pub(super) struct Travellers {
    people: Vec<(Itinerary, usize, State)>,
}

impl Travellers {
    pub(super) fn add(&mut self, person: Itinerary) {
        let state = State::Before(person.depart);
        self.people.push((person, 0, state));
    }

    pub(super) fn whereabouts(&self) -> Whereabouts {
        let mut count = Whereabouts::default();
        for (_, _, state) in &self.people {
            match state {
                State::Before(_) => count.waiting += 1,
                State::Walking(_) => count.walking += 1,
                State::Riding(_) => count.riding += 1,
                State::Arrived => count.arrived += 1,
                State::Stranded => count.stranded += 1,
            }
        }
        count
    }

    /// Takes up what happened in the last step, and lets those begin their next stage who may.
    pub(super) fn feed(&mut self, traffic: &mut Traffic, vehicles: &BTreeMap<u32, Names>) {
        if self.people.is_empty() {
            return;
        }
        let now = traffic.seconds();
        let halting: Vec<(u32, Leg, f64)> = traffic.halting().collect();
        for (person, stage, state) in &mut self.people {
            match *state {
                State::Walking(id) => {
                    match traffic.walks().iter().find(|walk| walk.id == id).map(|walk| walk.end) {
                        Some(TripEnd::Arrived) => (*stage, *state) = (*stage + 1, State::Before(now)),
                        Some(_) => *state = State::Stranded,
                        None => {}
                    }
                }
                State::Riding(id) => {
                    let Some(Stage::Ride { to, .. }) = person.stages.get(*stage) else { continue };
                    if halting.iter().any(|halt| halt.0 == id && is_at((halt.1, halt.2), *to)) {
                        (*stage, *state) = (*stage + 1, State::Before(now));
                    } else if !vehicles.contains_key(&id) {
                        *state = State::Stranded;
                    }
                }
                State::Before(_) | State::Arrived | State::Stranded => {}
            }
            if let State::Before(since) = *state
                && since <= now + 1e-9
            {
                *state = begin(traffic, person.stages.get(*stage), stage, since, &halting, vehicles);
            }
        }
    }
}

/// The state of who may begin a stage.
fn begin(
    traffic: &mut Traffic,
    next: Option<&Stage>,
    stage: &mut usize,
    since: f64,
    halting: &[(u32, Leg, f64)],
    vehicles: &BTreeMap<u32, Names>,
) -> State {
    match next {
        None => State::Arrived,
        Some(Stage::Wait { seconds, until }) => {
            *stage += 1;
            State::Before((since + seconds).max(*until))
        }
        Some(Stage::Walk { from, to }) => match traffic.add_walker(*from, Some(*to)) {
            Ok(id) => State::Walking(id),
            // Somebody may stand there only now; where nobody can walk, nobody ever will.
            Err(_) if traffic.can_walk(*from, *to) => State::Before(since),
            Err(_) => State::Stranded,
        },
        Some(Stage::Ride { from, lines, .. }) => {
            let takes = |id: &u32| {
                let names = vehicles.get(id);
                names.is_some_and(|names| lines.is_empty() || names.iter().any(|name| lines.contains(name)))
            };
            let comes = halting.iter().find(|halt| is_at((halt.1, halt.2), *from) && takes(&halt.0));
            comes.map_or(State::Before(since), |halt| State::Riding(halt.0))
        }
    }
}

fn is_at(halt: Kerb, place: Kerb) -> bool {
    halt.0 == place.0 && (halt.1 - place.1).abs() <= NEAR
}
