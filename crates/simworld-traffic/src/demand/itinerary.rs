//! Itineraries: people who walk, wait and ride, one stage after the other, alone or as a flow.

use std::collections::{BTreeMap, VecDeque};

use simworld_core::geometry::Point2;
use simworld_core::seed::Stream;

use super::agenda::{Agenda, Beat};
use super::drive::{self, Drive};
use super::timetable::Timetable;
use super::{Arrivals, VehicleChoice};
use crate::vehicle::VehicleKind;
use crate::{Leg, Traffic, TrafficError, TripEnd};

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
    /// On foot and by the lines of the schedule, whatever is quickest when the stage begins: by straight ways, the timetable and
    /// free roads, with four rides at most.
    Journey {
        /// Near where it begins.
        from: Point2,
        /// Near where it ends.
        to: Point2,
    },
    /// In a vehicle of one's own, called `name_0` after its driver, the next `name_1` and so on; a bicycle `name_b0`.
    Drive(Drive),
    /// On foot, by the lines of the schedule, or in a vehicle of one's own from the very beginning, whatever is quickest when the stage
    /// begins: by straight ways on foot, the timetable and free roads.
    Trip {
        /// Near where it begins.
        from: Point2,
        /// Near where it ends.
        to: Point2,
        /// Whether one may take lines.
        public: bool,
        /// The drives among which one may choose.
        drives: Vec<Drive>,
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

/// People who keep coming, each of whom does the same.
///
/// ```
/// use std::sync::Arc;
/// use simworld_core::geometry::Point2;
/// use simworld_core::id::RoadId;
/// use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
/// use simworld_core::seed::Seed;
/// use simworld_traffic::{Leg, Line, PersonFlow, PersonStage, Route, Schedule, Stop, Traffic, TrafficConfig};
/// let network = Arc::new(RoadNetwork::derive(&StreetPlan::crossroads(300.0), &NetworkConfig::default())?);
/// let empty = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
/// let mut traffic = Traffic::new(network, &empty, Seed(1))?;
/// let mut schedule = Schedule::new(Seed(1));
/// // The 7 comes every two minutes: in on the first arm, out on the third.
/// let (into, out) = (Leg::new(RoadId(0), LaneDirection::Backward), Leg::new(RoadId(2), LaneDirection::Forward));
/// let stops = vec![Stop::new(into, 40.0, 20.0), Stop::new(out, 250.0, 20.0)];
/// schedule.add_flow("buses", Line::new(Route(vec![into, out]), stops, 120.0).flow(), 10)?;
/// schedule.name_line("7");
/// // From one end to the other; 7 minutes on foot.
/// let stage = PersonStage::Journey { from: Point2::new(290.0, 5.0), to: Point2::new(-290.0, 5.0) };
/// schedule.add_person_flow("people", PersonFlow { number: 3, ..PersonFlow::new(vec![stage], 600.0) })?;
/// let mut most = 0;
/// for _ in 0..4000 {
///     schedule.feed(&mut traffic)?;
///     traffic.step(0.1);
///     most = most.max(schedule.people().riding);
/// }
/// assert!(most > 0);
/// assert_eq!(schedule.people().arrived, 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PersonFlow {
    /// What each does.
    pub stages: Vec<Stage>,
    /// How many set out, people an hour, in (0, 10 000].
    pub per_hour: f64,
    /// How they come.
    pub arrivals: Arrivals,
    /// When the first may set out, s after the start.
    pub from: f64,
    /// When no more do, s after the start.
    pub until: f64,
    /// At most so many.
    pub number: u64,
}

impl PersonFlow {
    /// So many people an hour, at random, for ever.
    pub fn new(stages: Vec<Stage>, per_hour: f64) -> Self {
        let (from, until, number) = (0.0, f64::MAX, u64::MAX);
        Self { stages, per_hour, arrivals: Arrivals::Poisson, from, until, number }
    }
}

/// How many are where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Whereabouts {
    /// Those who wait somewhere or for a vehicle, and those who have not set out; of flows, those who came.
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
    /// The vehicle of this number, to a kerb.
    Riding(u32, Kerb),
    /// The own vehicle, which has that number among those who were sent, is to depart.
    Called(u64),
    /// The own vehicle of this number is under way.
    Driving(u32),
    Arrived,
    Stranded,
}

/// A vehicle under way, as those who wait for it know it: its own name, that of its flow, and that of its line.
pub(super) type Names = [String; 3];

/// Somebody who has set out, and the stages that they have not begun.
#[derive(Clone, Debug)]
struct Traveller {
    name: String,
    ahead: VecDeque<Stage>,
    state: State,
    /// How many vehicles of their own have departed.
    driven: u32,
}

/// Everybody with an itinerary.
#[derive(Clone, Debug, Default)]
pub(super) struct Travellers {
    /// Those who set out once, until they do.
    single: Vec<Option<Itinerary>>,
    due: Agenda,
    flows: Vec<(String, Vec<Stage>, Beat)>,
    next_of_flows: Agenda,
    under_way: Vec<Traveller>,
    arrived: u32,
    /// The names of those who were.
    stranded: Vec<String>,
}

/// What somebody meets who begins a stage.
pub(super) struct Surroundings<'a> {
    /// The names of vehicles under way.
    pub(super) vehicles: &'a BTreeMap<u32, Names>,
    /// The lines of the schedule.
    pub(super) timetable: &'a Timetable,
    /// Who halts where.
    pub(super) halting: Vec<(u32, Leg, f64)>,
}

impl Travellers {
    pub(super) fn add(&mut self, person: Itinerary) {
        self.due.add(person.depart, self.single.len());
        self.single.push(Some(person));
    }

    pub(super) fn add_flow(
        &mut self,
        name: String,
        flow: PersonFlow,
        stream: Stream,
    ) -> Result<(), TrafficError> {
        super::check_times(flow.per_hour, flow.from, flow.until)?;
        let PersonFlow { stages, per_hour, arrivals, from, until, number } = flow;
        let stream = stream.indexed(self.flows.len() as u64);
        let beat = Beat { per_hour, arrivals, until, number, drawn: 0, stream };
        if let Some(first) = beat.first(from) {
            self.next_of_flows.add(first, self.flows.len());
        }
        self.flows.push((name, stages, beat));
        Ok(())
    }

    /// Whether nobody is under way, and nobody sets out now.
    pub(super) fn is_idle(&self, now: f64) -> bool {
        self.under_way.is_empty() && !self.due.is_due(now) && !self.next_of_flows.is_due(now)
    }

    pub(super) fn stranded(&self) -> impl Iterator<Item = &str> {
        self.stranded.iter().map(String::as_str)
    }

    pub(super) fn whereabouts(&self) -> Whereabouts {
        let mut count = Whereabouts {
            waiting: self.due.len() as u32,
            arrived: self.arrived,
            stranded: self.stranded.len() as u32,
            ..Whereabouts::default()
        };
        for one in &self.under_way {
            match one.state {
                State::Before(_) | State::Called(_) => count.waiting += 1,
                State::Walking(_) => count.walking += 1,
                State::Riding(..) | State::Driving(_) => count.riding += 1,
                State::Arrived => count.arrived += 1,
                State::Stranded => count.stranded += 1,
            }
        }
        count
    }

    /// Takes up what happened in the last step, and lets those begin their next stage who may. Returns the numbers of the vehicles that
    /// were sent for them, with their names.
    pub(super) fn feed(&mut self, traffic: &mut Traffic, around: &Surroundings<'_>) -> Vec<(u64, String)> {
        let now = traffic.seconds();
        let mut sent = Vec::new();
        self.set_out(now + 1e-9);
        for one in &mut self.under_way {
            one.take_note(traffic, around);
            if let State::Before(since) = one.state
                && since <= now + 1e-9
            {
                one.begin(traffic, since, around, &mut sent);
            }
        }
        for one in self.under_way.extract_if(.., |one| matches!(one.state, State::Arrived | State::Stranded))
        {
            match one.state {
                State::Stranded => self.stranded.push(one.name),
                _ => self.arrived += 1,
            }
        }
        sent
    }

    /// Those who are due set out.
    fn set_out(&mut self, now: f64) {
        while let Some((_, index)) = self.due.take(now) {
            let Some(Itinerary { name, depart, stages }) = self.single[index].take() else { continue };
            let state = State::Before(depart);
            self.under_way.push(Traveller { name, ahead: stages.into(), state, driven: 0 });
        }
        while let Some((time, index)) = self.next_of_flows.take(now) {
            let (name, stages, beat) = &mut self.flows[index];
            let name = format!("{name}.{}", beat.drawn);
            self.under_way.push(Traveller {
                name,
                ahead: stages.iter().cloned().collect(),
                state: State::Before(time),
                driven: 0,
            });
            if let Some(next) = beat.count(time) {
                self.next_of_flows.add(next, index);
            }
        }
    }
}

impl Traveller {
    /// Takes up how a walk or a ride ended in the last step.
    fn take_note(&mut self, traffic: &Traffic, around: &Surroundings<'_>) {
        let now = traffic.seconds();
        self.state = match self.state {
            State::Walking(id) => {
                match traffic.walks().iter().find(|walk| walk.id == id).map(|walk| walk.end) {
                    Some(TripEnd::Arrived) => State::Before(now),
                    Some(_) => State::Stranded,
                    None => self.state,
                }
            }
            State::Riding(id, to) => {
                if around.halting.iter().any(|halt| halt.0 == id && is_at((halt.1, halt.2), to)) {
                    State::Before(now)
                } else if around.vehicles.contains_key(&id) {
                    self.state
                } else {
                    State::Stranded
                }
            }
            State::Called(number) => {
                let departed = traffic.admitted().find(|(_, admitted)| *admitted == Some(number));
                departed.map_or(self.state, |(id, _)| State::Driving(id))
            }
            State::Driving(id) => {
                match traffic.ended().iter().find(|trip| trip.id == id).map(|trip| trip.end) {
                    Some(TripEnd::Arrived | TripEnd::Parked) => State::Before(now),
                    Some(_) => State::Stranded,
                    None => self.state,
                }
            }
            same => same,
        };
    }

    /// Begins the next stage, if one may.
    fn begin(
        &mut self,
        traffic: &mut Traffic,
        since: f64,
        around: &Surroundings<'_>,
        sent: &mut Vec<(u64, String)>,
    ) {
        let found = match self.ahead.front() {
            Some(Stage::Journey { from, to }) => Some(around.timetable.journey(*from, *to, since).1),
            Some(Stage::Trip { from, to, public, drives }) => {
                Some(drive::chosen(traffic, around.timetable, (*from, *to), (*public, drives), since))
            }
            _ => None,
        };
        if let Some(stages) = found {
            self.ahead.pop_front();
            for stage in stages.into_iter().rev() {
                self.ahead.push_front(stage);
            }
        }
        let begun = match self.ahead.front() {
            None => State::Arrived,
            Some(Stage::Wait { seconds, until }) => State::Before((since + seconds).max(*until)),
            Some(Stage::Walk { from, to }) => match traffic.add_walker(*from, Some(*to)) {
                Ok(id) => State::Walking(id),
                // Somebody may stand there only now; where nobody can walk, nobody ever will.
                Err(_) if traffic.can_walk(*from, *to) => return,
                Err(_) => State::Stranded,
            },
            Some(Stage::Ride { from, to, lines }) => {
                match around
                    .halting
                    .iter()
                    .find(|halt| is_at((halt.1, halt.2), *from) && around.is_of(halt.0, lines))
                {
                    Some(halt) => State::Riding(halt.0, *to),
                    None => return,
                }
            }
            Some(Stage::Drive(drive)) => match drive.send(traffic, since) {
                Ok(number) => {
                    sent.push((number, self.vehicle_name(traffic, drive.vehicle)));
                    State::Called(number)
                }
                Err(_) => State::Stranded,
            },
            // They have become stages.
            Some(Stage::Journey { .. } | Stage::Trip { .. }) => return,
        };
        self.driven += u32::from(matches!(begun, State::Called(_)));
        self.ahead.pop_front();
        self.state = begun;
    }

    /// What the next vehicle of their own is called.
    fn vehicle_name(&self, traffic: &Traffic, vehicle: VehicleChoice) -> String {
        let kind = match vehicle {
            VehicleChoice::Kind(kind) => Some(kind),
            VehicleChoice::Type(row) => traffic.config().types.get(row).map(|row| row.kind),
        };
        let bicycle = if kind == Some(VehicleKind::Bicycle) { "b" } else { "" };
        format!("{}_{bicycle}{}", self.name, self.driven)
    }
}

impl Surroundings<'_> {
    /// Whether a vehicle is one of some, by any of its names; any is if there are none.
    fn is_of(&self, vehicle: u32, lines: &[String]) -> bool {
        let names = self.vehicles.get(&vehicle);
        names.is_some_and(|names| lines.is_empty() || names.iter().any(|name| lines.contains(name)))
    }
}

fn is_at(halt: Kerb, place: Kerb) -> bool {
    halt.0 == place.0 && (halt.1 - place.1).abs() <= NEAR
}
