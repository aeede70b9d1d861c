//! Those who walk together, as the crowd asks after them.

use simworld_core::geometry::{Point2, Vector2};

use super::{Person, Surroundings, Wall, Wish};

/// Those who walk together: who they are, what they want, and what stands around them.
pub(crate) trait Herd: Sync {
    /// How many are seen.
    fn count(&self) -> usize;

    /// One of them.
    fn person(&self, index: usize) -> Person;

    /// What somebody wants who decides now, or none for who goes on as before.
    fn wish(&self, index: usize) -> Option<Wish>;

    /// For how long the decision of one of them holds, s.
    fn hold(&self, index: usize) -> f64;

    /// How far somebody who does not decide now will go in a time, m, as far as it is known; none for who decides now.
    fn committed(&self, index: usize, time: f64) -> Option<Vector2>;

    /// Adds the walls near one of them.
    fn near(&self, index: usize, at: Point2, found: &mut Vec<Wall>);
}

/// People, wish by wish, among others who stand, as far as anybody knows.
pub(super) struct Slices<'a, S> {
    pub(super) people: &'a [Person],
    pub(super) wishes: &'a [Wish],
    pub(super) others: &'a [Person],
    pub(super) around: &'a S,
    pub(super) dt: f64,
}

impl<S: Surroundings> Herd for Slices<'_, S> {
    fn count(&self) -> usize {
        self.people.len() + self.others.len()
    }

    fn person(&self, index: usize) -> Person {
        let other = index.wrapping_sub(self.people.len());
        self.people.get(index).or(self.others.get(other)).copied().unwrap_or_default()
    }

    fn wish(&self, index: usize) -> Option<Wish> {
        self.wishes.get(index).filter(|_| index < self.people.len()).copied()
    }

    fn hold(&self, _: usize) -> f64 {
        self.dt
    }

    fn committed(&self, _: usize, _: f64) -> Option<Vector2> {
        None
    }

    fn near(&self, index: usize, at: Point2, found: &mut Vec<Wall>) {
        self.around.near(index, at, found);
    }
}
