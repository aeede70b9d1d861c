//! Those who walk together, as the crowd asks after them.

use simworld_core::geometry::Vector2;

use super::{Person, Surroundings, Wall, Wish};

/// Those who walk together: who they are, what they want, and what stands around them.
pub(crate) trait Herd: Sync {
    /// How many are seen.
    fn count(&self) -> usize;

    /// One of them.
    fn person(&self, index: usize) -> Person;

    /// Reads what [`look`](Self::look) will, without a branch that depends on it, so that processors wait for many such places of
    /// the memory at once; the value means nothing.
    fn touch(&self, index: usize) -> u64;

    /// What somebody wants who decides now, with the walls near them added to the rest, or none for who goes on as before.
    fn look(&self, index: usize, walls: &mut Vec<Wall>) -> Option<Look>;

    /// How far somebody who does not decide now will go in a time, m, as far as it is known; none for who decides now.
    fn committed(&self, index: usize, time: f64) -> Option<Vector2>;
}

/// What one of those who decide now wants, and for how long.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    pub(crate) person: Person,
    pub(crate) wish: Wish,
    /// For how long the decision holds, s.
    pub(crate) hold: f64,
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

    fn touch(&self, _: usize) -> u64 {
        0 // slices are read in order
    }

    fn look(&self, index: usize, walls: &mut Vec<Wall>) -> Option<Look> {
        let (wish, person) = (*self.wishes.get(index)?, *self.people.get(index)?);
        if wish.speed > 0.0 {
            self.around.near(index, person.position, walls);
        }
        Some(Look { person, wish, hold: self.dt })
    }

    fn committed(&self, _: usize, _: f64) -> Option<Vector2> {
        None
    }
}
