//! Two conditions of which one is the contrary of the other: "if the door is shut, go to the library, and if it is open, go to
//! the lab".

use super::blocks::IF;
use super::clause::{Reference, Target, Test};
use super::parser::Parser;

impl Parser<'_> {
    /// Passes a condition that is the contrary of the one before, said in words of its own; whether there was one.
    pub(super) fn contrary_follows(&mut self, test: &Test) -> bool {
        let start = self.at;
        let kept = (self.tested.clone(), self.class, self.bearers.clone());
        self.eat_any(&["and", "but", "or", "and then"]);
        if (self.eat_any(IF) || self.eat_any(&["should", "when"]))
            && let Ok(other) = self.test()
            && is_contrary(test, &other)
        {
            return true;
        }
        self.at = start;
        (self.tested, self.class, self.bearers) = kept;
        false
    }
}

/// Whether one holds where the other does not.
pub(super) fn is_contrary(one: &Test, other: &Test) -> bool {
    match (one, other) {
        (Test::Not(one), other) | (other, Test::Not(one)) => is_same(one, other),
        _ => false,
    }
}

/// Whether both ask the same, also where the second says "it" or "there" for what the first names.
fn is_same(one: &Test, other: &Test) -> bool {
    match (one, other) {
        (Test::Sees(one), Test::Sees(other))
        | (Test::InUse(one), Test::InUse(other))
        | (Test::Open(one), Test::Open(other))
        | (Test::Holds(Some(one)), Test::Holds(Some(other)))
        | (Test::Near { what: one, .. }, Test::Near { what: other, .. }) => means_same(one, other),
        (Test::Together { one, other: place, .. }, Test::Together { one: two, other: there, .. }) => {
            means_same(one, two) && means_same(place, there)
        }
        (one, other) => one == other,
    }
}

fn means_same(one: &Reference, other: &Reference) -> bool {
    let stands_for = |what: &Reference| matches!(what.target, Target::It | Target::Them | Target::There);
    stands_for(one)
        || stands_for(other)
        || one.target == other.target
            && one.choice == other.choice
            && one.traits == other.traits
            && one.relation == other.relation
}
