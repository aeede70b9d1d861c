//! The pedestrian manager: walkers on sidewalks and crossings.
//!
//! A walker heads for its next waypoint, within the width of the walkway, and finds its way among the others as a
//! [`crowd`](crate::crowd) does. It waits at the kerb until it may walk, and never hurries back.

mod config;
mod decide;
mod herd;
mod journey;
mod manager;
mod party;
mod place;
mod plaza;
mod profile;
mod storey;
mod takeover;
mod walkway;

pub use config::People;
pub(crate) use decide::Sight;
pub use journey::{AtDestination, Walk};
pub(crate) use manager::{PedestrianManager, Surroundings, Time};
pub(crate) use place::Entry;
pub(crate) use plaza::Plazas;
pub use profile::Sex;
pub(crate) use storey::on_storey;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Vector2, heading};
use simworld_core::id::{CrossingId, WaypointId};
use simworld_core::net::WaypointGraph;

use crate::crowd::Person;

/// A walker.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pedestrian {
    /// Where it stands, m.
    pub position: Point2,
    /// m/s.
    velocity: Vector2,
    /// Where it looks, of length one.
    facing: [f32; 2],
    /// m/s.
    free_speed: f32,
    /// How far to the right of the middle it keeps, m.
    keep_right: f32,
    from: WaypointId,
    to: WaypointId,
    /// Before it has gone so far it is not at the end of its way, m.
    left: f32,
    decisions: u32,
    /// Whose draws it makes: its own, or those of the first of its party.
    party: u32,
    /// The crossing that it waits for or is on.
    crossing: CrossingId,
    stage: Stage,
    companions: u8,
    age: u8,
    sex: Sex,
    habit: Habit,
    range: Range,
}

/// What a walker is about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
enum Stage {
    /// On a sidewalk.
    #[default]
    Walking,
    /// At the kerb.
    Waiting,
    /// On a crossing.
    Crossing,
    /// It has left; its number is free.
    Gone,
    /// Somebody else moves it.
    Free,
}

/// What a walker does at red.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
enum Habit {
    #[default]
    Waits,
    /// Crosses if there is a gap.
    Dares,
}

/// How closely a walker is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
enum Range {
    /// It decides in every step.
    #[default]
    Near,
    /// It decides now and then, and may be seen by those who decide in every step.
    Fringe,
    /// It decides now and then.
    Far,
}

impl Pedestrian {
    /// Where it looks, radians.
    pub fn heading(&self) -> f64 {
        heading(&self.direction())
    }

    /// How fast it walks now, m/s.
    pub fn speed(&self) -> f64 {
        self.velocity.norm()
    }

    /// Its velocity, m/s; who slides along somebody else does not go where it looks.
    pub fn velocity(&self) -> Vector2 {
        self.velocity
    }

    /// How fast it walks alone, m/s.
    pub fn free_speed(&self) -> f64 {
        f64::from(self.free_speed)
    }

    /// The crossing it is on.
    pub fn crossing(&self) -> Option<CrossingId> {
        (self.stage == Stage::Crossing).then_some(self.crossing)
    }

    /// The crossing at whose kerb it waits.
    pub fn waits_at(&self) -> Option<CrossingId> {
        (self.stage == Stage::Waiting).then_some(self.crossing)
    }

    /// Whether it is still there; a number whose walker has left goes to who comes next.
    pub fn is_present(&self) -> bool {
        self.stage != Stage::Gone
    }

    /// Its age, years.
    pub fn age(&self) -> u8 {
        self.age
    }

    /// Its sex.
    pub fn sex(&self) -> Sex {
        self.sex
    }

    /// The number of the first of those who walk together with it, its own if it walks alone.
    pub fn party(&self) -> u32 {
        self.party
    }

    /// The waypoints that it walks between, of [`Traffic::walkways`](crate::Traffic::walkways).
    pub fn way(&self) -> (WaypointId, WaypointId) {
        (self.from, self.to)
    }

    /// How high it is on its way, m above the ground.
    pub(crate) fn height(&self, ways: &WaypointGraph) -> f64 {
        ways.height_between(self.from, self.to, self.position)
    }

    fn direction(&self) -> Vector2 {
        let [x, y] = self.facing.map(f64::from);
        Vector2::new(x, y)
    }

    fn person(&self) -> Person {
        Person { position: self.position, direction: self.direction(), speed: self.speed() }
    }
}
