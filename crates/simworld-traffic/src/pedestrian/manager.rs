//! All walkers: what they decide, and how they move.

use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::hash::StateHasher;
use simworld_core::id::CrossingId;
use simworld_core::net::{RoadNetwork, WaypointGraph, Workers};
use simworld_core::seed::Stream;

use super::decide::{Deciding, Event, Sight};
use super::herd::Streets;
use super::journey::Journeys;
use super::takeover::Guides;
use super::walkway::Walkway;
use super::{Pedestrian, Range, Stage, Walk};
use crate::crowd::{Crowd, Person};
use crate::parts::{PARTS, in_parts};
use crate::{Counters, Interest, TrafficConfig};

/// Those within this distance of who decides in every step may be seen by them, m.
const FRINGE: f64 = 8.0;

/// All walkers.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct PedestrianManager {
    pub(crate) walkers: Vec<Pedestrian>,
    /// People on each crossing; foreign ones are added by the traffic.
    pub(crate) on_crossing: Vec<u32>,
    /// People at each kerb.
    at_kerb: Vec<u32>,
    /// Those of them who may walk as far as the signal says.
    pub(crate) waiting: Vec<u32>,
    pub(super) journeys: Journeys,
    /// Who is guided or moved by somebody else.
    pub(super) guides: Guides,
    /// Numbers that nobody has any more.
    pub(super) free: Vec<u32>,
    /// How long ago those far away were where they are, s.
    waited: f64,
    /// Numbers of those who entered since the last step, and walks that ended in it and since.
    #[serde(skip)]
    pub(crate) entered: Vec<u32>,
    #[serde(skip)]
    pub(crate) ended: Vec<Walk>,
    #[serde(skip)]
    crowd: Crowd,
    /// Those who matter between the turns of those far away, ascending, while it is known who they are.
    #[serde(skip)]
    subset: Vec<u32>,
    #[serde(skip)]
    knows_subset: bool,
    #[serde(skip)]
    scratch: Vec<Mutex<Scratch>>,
}

/// What a thread needs for the walkers of a part.
#[derive(Debug, Default)]
struct Scratch {
    weights: Vec<f64>,
    events: Vec<Event>,
    /// Those of its part who are not far away, at a turn.
    nearer: Vec<u32>,
}

/// Memory is not state.
impl Clone for PedestrianManager {
    fn clone(&self) -> Self {
        Self {
            walkers: self.walkers.clone(),
            on_crossing: self.on_crossing.clone(),
            at_kerb: self.at_kerb.clone(),
            waiting: self.waiting.clone(),
            journeys: self.journeys.clone(),
            guides: self.guides.clone(),
            free: self.free.clone(),
            waited: self.waited,
            ..Self::default()
        }
    }
}

impl PartialEq for PedestrianManager {
    fn eq(&self, other: &Self) -> bool {
        self.walkers == other.walkers
            && self.journeys == other.journeys
            && self.guides == other.guides
            && self.free == other.free
            && self.waited == other.waited
    }
}

/// The time of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Time {
    /// Steps before this one.
    pub(crate) steps: u64,
    pub(crate) seconds: f64,
    pub(crate) dt: f64,
}

/// Who works, on what, and what else is there.
pub(crate) struct Surroundings<'a> {
    pub(crate) workers: &'a dyn Workers,
    pub(crate) config: &'a TrafficConfig,
    /// Bodies of others, as people.
    pub(crate) bodies: &'a [Person],
    /// Places of interest; everywhere if nobody says.
    pub(crate) interest: Option<&'a [Interest]>,
}

impl PedestrianManager {
    pub(crate) fn new(network: &RoadNetwork) -> Self {
        let none = vec![0; network.crossings.len()];
        Self { on_crossing: none.clone(), at_kerb: none.clone(), waiting: none, ..Self::default() }
    }

    pub(crate) fn step(
        &mut self,
        sight: &Sight<'_>,
        around: &Surroundings<'_>,
        streams: Stream,
        time: Time,
        counters: &mut Counters,
    ) {
        let rounds = (around.config.people.far_interval / time.dt).round().max(1.0) as u64;
        let turn = around.interest.is_none() || time.steps.is_multiple_of(rounds);
        let until_turn = (rounds - time.steps % rounds) as f64 * time.dt;
        self.scratch.resize_with(PARTS, Mutex::default);
        self.decide(sight, around, streams, turn);
        self.tell(time, counters);
        self.choose_subset(turn, around.interest.is_some());
        self.walk(sight, around, turn, until_turn, time.dt);
        let Self { waiting, at_kerb, .. } = self;
        in_parts(around.workers, waiting, &|_, first, waiting| {
            for ((waiting, at_kerb), index) in waiting.iter_mut().zip(&at_kerb[first..]).zip(first..) {
                // Most kerbs are empty, and what shows there need not be looked up.
                let may_walk = *at_kerb > 0 && sight.shows_walk(CrossingId::from_index(index));
                *waiting = if may_walk { *at_kerb } else { 0 };
            }
        });
    }

    /// Where to go on, and whether to cross.
    fn decide(&mut self, sight: &Sight<'_>, around: &Surroundings<'_>, streams: Stream, turn: bool) {
        let Self { walkers, journeys, scratch, waited, subset, knows_subset, .. } = self;
        let waited = if turn { std::mem::take(waited) } else { 0.0 };
        let (config, interest) = (around.config, around.interest);
        let some = Some(&subset[..]).filter(|_| *knows_subset && !turn);
        in_parts(around.workers, walkers, &|part, first, walkers| {
            let mut scratch = scratch[part].lock().unwrap_or_else(PoisonError::into_inner);
            let Scratch { weights, events, nearer } = &mut *scratch;
            let mut decide = |walker: &mut Pedestrian, index: u32| {
                if walker.is_present() && walker.decides(turn) && walker.is_due(sight) {
                    let by = Deciding { index, sight, config, streams, journeys };
                    walker.decide(&by, weights, events);
                }
            };
            if let Some(some) = some {
                // Others need not be looked at.
                let begin = some.partition_point(|index| (*index as usize) < first);
                for index in &some[begin..] {
                    let Some(walker) = walkers.get_mut(*index as usize - first) else { break };
                    decide(walker, *index);
                }
                return;
            }
            for (walker, index) in walkers.iter_mut().zip(first as u32..) {
                if turn && walker.is_present() {
                    if walker.range == Range::Far {
                        walker.go(waited);
                    }
                    walker.range = range(walker.position, interest);
                    if interest.is_some() && walker.range != Range::Far {
                        nearer.push(index);
                    }
                }
                decide(walker, index);
            }
        });
    }

    /// Takes note of what changed, in the order of the walkers.
    fn tell(&mut self, time: Time, counters: &mut Counters) {
        let mut scratch = std::mem::take(&mut self.scratch);
        for part in &mut scratch {
            let part = part.get_mut().unwrap_or_else(PoisonError::into_inner);
            for event in part.events.drain(..) {
                match event {
                    Event::Waits(crossing) => self.at_kerb[crossing.index()] += 1,
                    Event::Crosses(crossing, dares) => {
                        self.at_kerb[crossing.index()] -= 1;
                        self.on_crossing[crossing.index()] += 1;
                        counters.jaywalks += u64::from(dares);
                    }
                    Event::Leaves(crossing) => self.on_crossing[crossing.index()] -= 1,
                    Event::Arrives(index) => self.arrive(index, time.seconds, counters),
                }
            }
        }
        self.scratch = scratch;
    }

    /// Nobody is on or before a crossing any more who was.
    pub(super) fn take_from_crossing(&mut self, index: u32) {
        let walker = &self.walkers[index as usize];
        match walker.stage {
            Stage::Waiting => self.at_kerb[walker.crossing.index()] -= 1,
            Stage::Crossing => self.on_crossing[walker.crossing.index()] -= 1,
            Stage::Walking | Stage::Gone | Stage::Free => {}
        }
    }

    /// Who came or left may have been among those who matter.
    pub(super) fn forget_subset(&mut self) {
        self.knows_subset = false;
    }

    /// Between turns, those who decide and those whom they may see: at a turn it is found out for the steps before the next.
    fn choose_subset(&mut self, turn: bool, some_are_far: bool) {
        let Self { walkers, scratch, subset, knows_subset, .. } = self;
        if !turn && *knows_subset {
            return;
        }
        subset.clear();
        if turn {
            let parts = scratch.iter_mut().map(|part| part.get_mut().unwrap_or_else(PoisonError::into_inner));
            subset.extend(parts.flat_map(|part| part.nearer.drain(..)));
            subset.retain(|index| walkers[*index as usize].is_present());
        } else {
            let matters =
                |(_, walker): &(u32, &Pedestrian)| walker.range != Range::Far && walker.is_present();
            subset.extend((0..).zip(&*walkers).filter(matters).map(|(index, _)| index));
        }
        *knows_subset = !turn || some_are_far;
    }

    fn walk(&mut self, sight: &Sight<'_>, around: &Surroundings<'_>, turn: bool, until_turn: f64, dt: f64) {
        let Self { walkers, crowd, subset, guides, .. } = self;
        let some = if turn { &[][..] } else { subset };
        if turn || !some.is_empty() {
            let Surroundings { workers, config, bodies, .. } = around;
            let Sight { ways, plazas, .. } = *sight;
            let free = &guides.free;
            let herd = Streets { walkers, subset: some, bodies, ways, plazas, free, turn, until_turn, dt };
            crowd.decide(*workers, (&config.walking, config.people.steering), &herd);
        }
        for (rank, index) in some.iter().enumerate() {
            let walker = &mut walkers[*index as usize];
            walker.take_up(crowd, rank);
            walker.go(dt);
        }
        if turn {
            in_parts(around.workers, walkers, &|_, first, walkers| {
                for (walker, index) in walkers.iter_mut().zip(first..) {
                    walker.take_up(crowd, index);
                    if walker.range != Range::Far {
                        walker.go(dt);
                    }
                }
            });
        }
        self.waited += dt;
    }

    /// Bytes that the walkers take, with their journeys and all that is kept for a step.
    pub(crate) fn bytes(&self) -> usize {
        self.walkers.capacity() * size_of::<Pedestrian>()
            + self.crowd.bytes()
            + self.journeys.bytes()
            + self.free.capacity() * 4
            + self.subset.capacity() * 4
    }

    /// Whether a saved state is one of this network.
    pub(crate) fn fits(&self, ways: &WaypointGraph, crossings: usize) -> bool {
        let (count, walkers) = (ways.waypoints().len(), self.walkers.len());
        let fits = |walker: &Pedestrian| {
            walker.from.index().max(walker.to.index()) < count
                && (walker.party as usize) < walkers
                && (matches!(walker.stage, Stage::Walking | Stage::Gone | Stage::Free)
                    || walker.crossing.index() < crossings)
        };
        [&self.on_crossing, &self.at_kerb, &self.waiting].into_iter().all(|counts| counts.len() == crossings)
            && self.walkers.iter().all(fits)
            && self.free.iter().all(|index| (*index as usize) < walkers)
            && self.journeys.fit(walkers, count)
            && self.waited.is_finite()
            && self.guides.fit(&self.walkers)
    }

    pub(crate) fn state_hash(&self, hasher: &mut StateHasher) {
        for walker in &self.walkers {
            hasher
                .f64(walker.position.x)
                .f64(walker.position.y)
                .f64(walker.velocity.x)
                .f64(walker.velocity.y);
            let [x, y] = walker.facing.map(f32::to_bits).map(u64::from);
            hasher.u64(x << 32 | y).u64(u64::from(walker.from.0) << 32 | u64::from(walker.to.0));
            hasher.u64(u64::from(walker.decisions) << 8 | walker.stage as u64);
        }
        self.guides.state_hash(hasher);
    }
}

impl Pedestrian {
    /// Walks on for a time, s.
    fn go(&mut self, time: f64) {
        if self.stage != Stage::Free {
            self.position += self.velocity * time;
            self.left -= (self.speed() * time) as f32;
        }
    }

    /// Whether it is at the end of its way, or waits there.
    fn is_due(&mut self, sight: &Sight<'_>) -> bool {
        if self.stage == Stage::Waiting {
            return true;
        }
        if self.left > 0.0 {
            return false;
        }
        let walkway = Walkway::of(self, sight.ways, sight.plazas);
        self.left = walkway.left(self.position);
        walkway.is_walked(self.position)
    }

    fn take_up(&mut self, crowd: &Crowd, rank: usize) {
        if let Some(decision) = crowd.decision(rank) {
            self.velocity = decision.velocity;
            self.facing = decision.facing;
        }
    }
}

/// How closely somebody is looked at.
fn range(at: Point2, interest: Option<&[Interest]>) -> Range {
    let Some(interest) = interest else { return Range::Near };
    let beyond = |place: &Interest| (at - place.center).norm() - place.radius;
    let nearest = interest.iter().map(beyond).fold(f64::INFINITY, f64::min);
    match nearest {
        beyond if beyond <= 0.0 => Range::Near,
        beyond if beyond <= FRINGE => Range::Fringe,
        _ => Range::Far,
    }
}
