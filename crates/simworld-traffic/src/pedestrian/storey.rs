//! People above one another, who do not see each other.

use simworld_core::net::{FOOTBRIDGE_STOREY, WaypointGraph};

use crate::crowd::Person;

/// Each storey has a place of its own, so far from the next, m: no city is so wide.
const APART: f64 = 1e6;

/// Somebody so high above the ground, m, as those see them who are on the same storey; the others see nobody. Where all ways lie on the
/// ground, all are on one.
pub(crate) fn on_storey(person: Person, height: f64, ways: &WaypointGraph) -> Person {
    let storey = (height / FOOTBRIDGE_STOREY).round();
    if ways.is_level() || storey == 0.0 {
        return person;
    }
    let mut moved = person;
    moved.position.x += APART * storey;
    moved
}
