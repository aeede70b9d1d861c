//! Where walkers begin.

use std::collections::BTreeMap;

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::{CrossingId, WaypointId};
use simworld_core::net::WaypointGraph;
use simworld_core::seed::{Stream, StreamRng};

use super::party::{self, ABREAST};
use super::profile::{Profile, Profiles};
use super::walkway::MARGIN;
use super::{Habit, Pedestrian, PedestrianManager, Range, Stage};
use crate::TrafficConfig;

/// How far to the right of the middle people keep, m.
pub(super) const KEEP_RIGHT: (f64, f64) = (0.1, 0.8);
/// So many places are tried for each walker.
const TRIES: u32 = 50;

/// A walkway on which one may begin: from, to, and half its width, m.
type Walkway = (WaypointId, WaypointId, f64);

/// Who somebody is and what they do, apart from where.
#[derive(Clone, Copy, Debug)]
struct Character {
    profile: Profile,
    keep_right: f64,
    habit: Habit,
}

impl Character {
    fn draw(profiles: &Profiles, config: &TrafficConfig, rng: &mut StreamRng) -> Self {
        let profile = profiles.draw(rng);
        let keep_right = rng.uniform(KEEP_RIGHT.0, KEEP_RIGHT.1);
        let habit = if rng.chance(config.people.jaywalking) { Habit::Dares } else { Habit::Waits };
        Self { profile, keep_right, habit }
    }
}

/// Where somebody begins: at a place on a walkway.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    pub(crate) position: Point2,
    pub(crate) from: WaypointId,
    pub(crate) to: WaypointId,
}

impl PedestrianManager {
    /// Places walkers along walkways, apart from one another, and returns how many found a place: none without walkways.
    pub(crate) fn spawn(&mut self, ways: &WaypointGraph, config: &TrafficConfig, streams: Stream) -> u32 {
        let mut rng = streams.named("places").rng();
        let walkways: Vec<Walkway> = (0..ways.waypoints().len())
            .map(WaypointId::from_index)
            .flat_map(|from| ways.edges(from).iter().map(move |edge| (from, edge)))
            .filter(|(_, edge)| edge.crossing.is_none() && edge.length > 0.1)
            .map(|(from, edge)| (from, edge.to, f64::from(edge.width) * 0.5))
            .collect();
        let profiles = Profiles::new(config);
        let parties = party::share_of_parties(config.people.in_groups);
        let mut taken = Taken::new(2.0 * config.walking.radius);
        self.walkers.reserve_exact(config.pedestrians as usize);
        while self.walkers.len() < config.pedestrians as usize {
            let left = config.pedestrians - self.walkers.len() as u32;
            let size = if rng.chance(parties) { party::size(&mut rng).min(left) } else { 1 };
            let first = self.walkers.len() as u32;
            let character = Character::draw(&profiles, config, &mut rng);
            let mut tries = (0..TRIES).filter_map(|_| draw(ways, &walkways, character.keep_right, &mut rng));
            let Some((entry, half)) = tries.find(|(entry, _)| taken.take(entry.position)) else {
                break;
            };
            self.walkers.push(walker(&character, &entry, ways, first));
            for rank in 1..size {
                let character = Character { profile: profiles.draw(&mut rng), ..character };
                if !self.join(character, &entry, rank, half, ways, &mut taken) {
                    break;
                }
            }
            self.introduce(first);
        }
        self.number_by_place();
        self.walkers.len() as u32
    }

    /// Numbers parties in the order of the walkways on which they begin: those who are near one another in the city lie near one
    /// another in the memory, and so does what they look up of the ways.
    fn number_by_place(&mut self) {
        let mut parties: Vec<(WaypointId, u32)> = (0..)
            .zip(&self.walkers)
            .filter(|(number, walker)| walker.party == *number)
            .map(|(number, walker)| (walker.from, number))
            .collect();
        parties.sort_unstable();
        let mut walkers = Vec::with_capacity(self.walkers.capacity());
        for (_, first) in parties {
            let party = walkers.len() as u32;
            let members = self.walkers[first as usize..].iter().take_while(|walker| walker.party == first);
            walkers.extend(members.map(|walker| Pedestrian { party, ..*walker }));
        }
        self.walkers = walkers;
    }

    /// Puts somebody beside the first of a party; false if there is no room.
    fn join(
        &mut self,
        character: Character,
        entry: &Entry,
        rank: u32,
        half: f64,
        ways: &WaypointGraph,
        taken: &mut Taken,
    ) -> bool {
        let along = ways.waypoint(entry.to).position - ways.waypoint(entry.from).position;
        let Some(along) = along.try_normalize(1e-9) else { return false };
        let first = self.walkers.len() as u32 - rank;
        let begun = f64::from(self.walkers[first as usize].keep_right);
        // Abreast to the left, as far as the walkway goes; those who do not fit walk behind.
        let room = (half - MARGIN).max(0.0);
        let abreast = begun.min(room) - ABREAST * f64::from(rank);
        let (keep_right, behind) =
            if abreast > -room { (abreast, 0.0) } else { (begun.min(room), 0.8 * f64::from(rank)) };
        let aside = Vector2::new(along.y, -along.x) * (keep_right - begun.min(room));
        let entry = Entry { position: entry.position + aside - along * behind, ..*entry };
        if !taken.take(entry.position) {
            return false;
        }
        self.walkers.push(walker(&Character { keep_right, ..character }, &entry, ways, first));
        true
    }

    /// Those who begin together from a number on stay together, at the pace of the slowest.
    fn introduce(&mut self, first: u32) {
        let members = &mut self.walkers[first as usize..];
        let slowest = members.iter().map(|walker| walker.free_speed).fold(f32::INFINITY, f32::min);
        let companions = members.len() as u8 - 1;
        for walker in members {
            walker.free_speed = slowest;
            walker.companions = companions;
        }
    }

    /// Lets somebody enter, alone, and returns their number; none if somebody stands there.
    pub(crate) fn enter(
        &mut self,
        entry: &Entry,
        ways: &WaypointGraph,
        config: &TrafficConfig,
        stream: Stream,
    ) -> Option<u32> {
        let apart = 2.0 * config.walking.radius;
        let touches = |walker: &Pedestrian| {
            walker.is_present() && (walker.position - entry.position).norm_squared() < apart * apart
        };
        if self.walkers.iter().any(touches) {
            return None;
        }
        let character = Character::draw(&Profiles::new(config), config, &mut stream.rng());
        let index = self.free.pop().unwrap_or(self.walkers.len() as u32);
        let walker = walker(&character, entry, ways, index);
        match self.walkers.get_mut(index as usize) {
            Some(free) => *free = walker,
            None => self.walkers.push(walker),
        }
        self.entered.push(index);
        self.forget_subset();
        Some(index)
    }
}

fn walker(character: &Character, entry: &Entry, ways: &WaypointGraph, party: u32) -> Pedestrian {
    let along = ways.waypoint(entry.to).position - ways.waypoint(entry.from).position;
    let along = along.try_normalize(1e-9).unwrap_or_else(Vector2::x);
    Pedestrian {
        position: entry.position,
        velocity: Vector2::zeros(),
        facing: [along.x as f32, along.y as f32],
        free_speed: character.profile.free_speed as f32,
        keep_right: character.keep_right as f32,
        from: entry.from,
        to: entry.to,
        left: 0.0,
        decisions: 0,
        party,
        crossing: CrossingId(0),
        stage: Stage::Walking,
        companions: 0,
        age: character.profile.age,
        sex: character.profile.sex,
        habit: character.habit,
        range: Range::Near,
    }
}

/// A place on some walkway, and half the width of that, m.
fn draw(
    ways: &WaypointGraph,
    walkways: &[Walkway],
    keep_right: f64,
    rng: &mut StreamRng,
) -> Option<(Entry, f64)> {
    let (from, to, half) = rng.choose(walkways).copied()?;
    let (a, b) = (ways.waypoint(from).position, ways.waypoint(to).position);
    let along = (b - a).try_normalize(1e-9)?;
    let right = Vector2::new(along.y, -along.x) * keep_right.min((half - MARGIN).max(0.0));
    Some((Entry { position: a + (b - a) * rng.unit() + right, from, to }, half))
}

/// The places that are taken, by cells so small that each holds one.
struct Taken {
    apart: f64,
    cell: f64,
    places: BTreeMap<(i64, i64), Point2>,
}

impl Taken {
    fn new(apart: f64) -> Self {
        Self { apart, cell: apart * std::f64::consts::FRAC_1_SQRT_2, places: BTreeMap::new() }
    }

    /// Takes a place; false if somebody is too near.
    fn take(&mut self, place: Point2) -> bool {
        let (column, row) = ((place.x / self.cell).floor() as i64, (place.y / self.cell).floor() as i64);
        let near = (column - 2..=column + 2)
            .flat_map(|column| self.places.range((column, row - 2)..=(column, row + 2)))
            .any(|(_, other)| (other - place).norm() <= self.apart);
        !near && self.places.insert((column, row), place).is_none()
    }
}
