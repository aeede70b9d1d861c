//! A crowd: how people walk among people and walls, by the [anticipation velocity model](AnticipationVelocity).
//!
//! It knows nothing of streets. Somebody else says where everybody wants to go; one step then moves all of them from the
//! state at its start, so nobody has an advantage by their number, and no two bodies ever overlap.
//!
//! ```
//! use simworld_core::geometry::{Point2, Vector2};
//! use simworld_traffic::crowd::{AnticipationVelocity, Crowd, Person, Walls, Wish};
//! // Two people meet in a passage.
//! let walls = Walls::new(vec![
//!     (Point2::new(0.0, -0.8), Point2::new(20.0, -0.8)),
//!     (Point2::new(0.0, 0.8), Point2::new(20.0, 0.8)),
//! ]);
//! let mut people = [Person::standing(Point2::new(5.0, 0.0), Vector2::x()),
//!                   Person::standing(Point2::new(15.0, 0.0), -Vector2::x())];
//! let wishes = people.map(|person| Wish { direction: person.direction, speed: 1.34 });
//! let (model, mut crowd) = (AnticipationVelocity::default(), Crowd::default());
//! for _ in 0..70 {
//!     crowd.step(&model, &mut people, &wishes, &[], &walls, 0.1);
//! }
//! assert!(people[0].position.x > 13.0 && people[1].position.x < 7.0);
//! ```

mod exp;
mod grid;
mod herd;
mod model;
mod nearby;
mod step;
mod walls;

use herd::Slices;
pub(crate) use herd::{Herd, Look};
pub use model::{AnticipationVelocity, Steering};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::{Alone, Workers};
pub use step::Crowd;
pub use walls::Walls;

use crate::parts::in_parts;

/// One looks this far, m: as far as one walks towards another in a second.
const REACH: f64 = 3.0;

/// A body in a crowd.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Person {
    /// Its middle, m.
    pub position: Point2,
    /// Where it walks, of length one.
    pub direction: Vector2,
    /// How fast, m/s.
    pub speed: f64,
}

impl Default for Person {
    fn default() -> Self {
        Self::standing(Point2::origin(), Vector2::x())
    }
}

impl Person {
    /// Somebody who stands and looks in a direction of length one.
    pub fn standing(position: Point2, direction: Vector2) -> Self {
        Self { position, direction, speed: 0.0 }
    }
}

/// Where somebody would walk if alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish {
    /// The direction, of length one.
    pub direction: Vector2,
    /// How fast, m/s; nobody who wants to stand is moved.
    pub speed: f64,
}

/// A wall near somebody: its nearest point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// The unit vector towards it.
    pub toward: Vector2,
    /// How far it is from the middle of the body, m; negative for who is beyond it.
    pub distance: f64,
}

/// What stands around people and does not move.
pub trait Surroundings: Sync {
    /// Adds the walls near the person of this number, who is here.
    fn near(&self, index: usize, at: Point2, found: &mut Vec<Wall>);
}

impl<F: Fn(usize, Point2, &mut Vec<Wall>) + Sync> Surroundings for F {
    fn near(&self, index: usize, at: Point2, found: &mut Vec<Wall>) {
        self(index, at, found);
    }
}

impl Crowd {
    /// Moves people for `dt` s as they wish, wish by wish, among themselves, others and what stands around.
    ///
    /// The others are seen and not moved. Nobody overlaps after the step who did not before, whatever `dt`, as long as the
    /// others stand still; people are looked for within 3 m, so `dt` times twice the speed must stay below that.
    pub fn step(
        &mut self,
        model: &AnticipationVelocity,
        people: &mut [Person],
        wishes: &[Wish],
        others: &[Person],
        around: &impl Surroundings,
        dt: f64,
    ) {
        self.step_on(&Alone, model, people, wishes, others, around, dt);
    }

    /// As [`step`](Self::step), on the threads that are lent; what comes of it does not depend on them.
    #[expect(clippy::too_many_arguments, reason = "those of `step`, and who works")]
    pub fn step_on(
        &mut self,
        workers: &dyn Workers,
        model: &AnticipationVelocity,
        people: &mut [Person],
        wishes: &[Wish],
        others: &[Person],
        around: &impl Surroundings,
        dt: f64,
    ) {
        let herd = Slices { people, wishes, others, around, dt };
        self.decide(workers, (model, Steering::default()), &herd);
        in_parts(workers, people, &|_, first, people| {
            for (person, index) in people.iter_mut().zip(first..) {
                if let Some(decision) = self.decision(index) {
                    person.position += decision.velocity * dt;
                    person.speed = decision.velocity.norm();
                    person.direction = decision.direction();
                }
            }
        });
    }
}
