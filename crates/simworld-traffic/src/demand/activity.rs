//! Activity chains: people who are at home, at work, in shops, and drive from one to the next.
//!
//! A person leaves a place when its activity ends: at a time of day, or so long after the arrival, whichever is later. Who
//! arrives late thus leaves late, as people do; trips that find no room or stand in jams shift all that comes after.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use simworld_core::seed::{Seed, StreamRng};

use super::{Kerbs, VehicleChoice};
use crate::output::Recorder;
use crate::vehicle::VehicleKind;
use crate::{Leg, Route, Traffic, TrafficError, TripEnd};

/// One stay in a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Activity {
    /// Where: the leg on which one arrives and from which one departs.
    pub place: Leg,
    /// Where one parks there and departs from, m from the beginning of the leg's lanes; without it one leaves the traffic at the
    /// end of the leg and enters it at the beginning.
    pub parking: Option<f64>,
    /// It lasts at least so long after the arrival, s.
    pub duration: f64,
    /// It does not end before this, s after the start.
    pub until: f64,
}

impl Activity {
    /// A stay without a parking place.
    pub const fn new(place: Leg, duration: f64, until: f64) -> Self {
        Self { place, parking: None, duration, until }
    }
}

/// One person: a name and the stays of a day. The last one does not end.
#[derive(Clone, Debug, PartialEq)]
pub struct Person {
    /// What the person is called in outputs.
    pub name: String,
    /// What the person drives.
    pub vehicle: VehicleChoice,
    /// The stays, in their order.
    pub chain: Vec<Activity>,
}

/// The usual times of a day, s after midnight: mean and deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DayTimes {
    /// When people leave home for work.
    pub to_work: (f64, f64),
    /// How long they work, s.
    pub work: (f64, f64),
    /// How long they shop on the way home, s.
    pub shop: (f64, f64),
    /// The share of people who shop on the way home, 0 to 1.
    pub shoppers: f64,
}

impl Default for DayTimes {
    /// Off at half past seven, eight hours of work and half a break, half an hour in a shop for a third.
    fn default() -> Self {
        Self {
            to_work: (7.5 * 3600.0, 2400.0),
            work: (8.5 * 3600.0, 2400.0),
            shop: (1800.0, 600.0),
            shoppers: 0.33,
        }
    }
}

/// Draws so many people with a home, a work place and perhaps a shop among named places, given by their legs: home, work,
/// shop, home.
pub fn commuters(
    count: u32,
    (homes, works, shops): (&[Leg], &[Leg], &[Leg]),
    times: &DayTimes,
    seed: Seed,
) -> Vec<Person> {
    let stream = seed.stream("traffic/commuters");
    let draw = |number: u32| {
        let mut rng = stream.indexed(u64::from(number)).rng();
        let home = *rng.choose(homes)?;
        let work = *rng.choose(works)?;
        let normal = |(mean, deviation): (f64, f64), rng: &mut StreamRng| {
            rng.normal_clamped(mean, deviation, (mean - 3.0 * deviation).max(0.0), mean + 3.0 * deviation)
        };
        let until = normal(times.to_work, &mut rng);
        let mut chain = vec![Activity::new(home, 0.0, until)];
        chain.push(Activity::new(work, normal(times.work, &mut rng), 0.0));
        let shops = if rng.unit() < times.shoppers { shops } else { &[] };
        if let Some(shop) = rng.choose(shops).copied() {
            chain.push(Activity::new(shop, normal(times.shop, &mut rng), 0.0));
        }
        chain.push(Activity::new(home, 0.0, 0.0));
        Some(Person { name: format!("p{number}"), vehicle: VehicleKind::Car.into(), chain })
    };
    (0..count).filter_map(draw).collect()
}

/// Where a person is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    /// At the stay of that index.
    At(u32),
    /// On the way to it.
    To(u32),
}

/// People on their days. [`feed`](Self::feed) it before every step, and let it [`follow`](Self::follow) after.
#[derive(Clone, Debug)]
pub struct ActivityChains {
    people: Vec<Person>,
    stages: Vec<Stage>,
    /// Who leaves when: the bits of a time that is not negative are in its order.
    leaving: BinaryHeap<Reverse<(u64, u32)>>,
    /// Who was sent and has not entered, by the number that the traffic gave.
    outside: BTreeMap<u64, u32>,
    /// Who drives what: people by the numbers of vehicles.
    driving: BTreeMap<u32, u32>,
    /// Trips for which there was no route: the person stays where it is.
    stranded: usize,
}

impl ActivityChains {
    /// People at their first stays, since time 0.
    pub fn new(people: Vec<Person>) -> Self {
        let mut chains = Self {
            stages: vec![Stage::At(0); people.len()],
            people,
            leaving: BinaryHeap::new(),
            outside: BTreeMap::new(),
            driving: BTreeMap::new(),
            stranded: 0,
        };
        for person in 0..chains.people.len() {
            chains.stay(person as u32, 0, 0.0);
        }
        chains
    }

    /// A person comes to a stay; plans when it ends, if another follows.
    fn stay(&mut self, person: u32, index: u32, now: f64) {
        self.stages[person as usize] = Stage::At(index);
        let chain = &self.people[person as usize].chain;
        if let Some(activity) = chain.get(index as usize).filter(|_| chain.len() > index as usize + 1) {
            let end = (now + activity.duration.max(0.0)).max(activity.until);
            self.leaving.push(Reverse((end.to_bits(), person)));
        }
    }

    /// Sends those whose stay ends now, each on the route that `find` gives. Who is where the next stay is needs none.
    ///
    /// # Errors
    /// A route that cannot be driven, or a parking place that is none.
    pub fn feed(
        &mut self,
        traffic: &mut Traffic,
        mut find: impl FnMut(Leg, Leg) -> Option<Route>,
    ) -> Result<(), TrafficError> {
        let now = traffic.seconds() + 1e-9;
        while let Some(Reverse((bits, person))) = self.leaving.peek().copied() {
            let end = f64::from_bits(bits);
            if end > now {
                break;
            }
            self.leaving.pop();
            let Stage::At(index) = self.stages[person as usize] else { continue };
            let Person { vehicle, chain, .. } = &self.people[person as usize];
            let (here, there) = (chain[index as usize], chain[index as usize + 1]);
            if here.place == there.place {
                self.stay(person, index + 1, end);
                continue;
            }
            let Some(route) = find(here.place, there.place) else {
                self.stranded += 1;
                continue;
            };
            let kerbs = Kerbs { from: here.parking, to: there.parking };
            let number = traffic.insert_between(route, *vehicle, end, kerbs)?;
            self.outside.insert(number, person);
            self.stages[person as usize] = Stage::To(index + 1);
        }
        Ok(())
    }

    /// Takes note of who entered and who arrived in the last step, and names them to a recorder.
    pub fn follow(&mut self, traffic: &Traffic, mut recorder: Option<&mut Recorder>) {
        for (id, number) in traffic.admitted() {
            let Some(person) = number.and_then(|number| self.outside.remove(&number)) else { continue };
            self.driving.insert(id, person);
            if let (Some(recorder), Stage::To(index)) = (&mut recorder, self.stages[person as usize]) {
                recorder.name(id, format!("{}.{index}", self.people[person as usize].name));
            }
        }
        for trip in traffic.ended() {
            let Some(person) = self.driving.remove(&trip.id) else { continue };
            let Stage::To(index) = self.stages[person as usize] else { continue };
            if matches!(trip.end, TripEnd::Arrived | TripEnd::Parked) {
                self.stay(person, index, trip.left);
            } else {
                self.stranded += 1;
            }
        }
    }

    /// The people.
    pub fn people(&self) -> &[Person] {
        &self.people
    }

    /// At which of its stays a person is, from 0; `None` on the way.
    pub fn stay_of(&self, person: usize) -> Option<usize> {
        match self.stages.get(person)? {
            Stage::At(index) => Some(*index as usize),
            Stage::To(_) => None,
        }
    }

    /// Trips that were not made or not ended: no route, or the vehicle was taken out.
    pub fn stranded(&self) -> usize {
        self.stranded
    }
}
