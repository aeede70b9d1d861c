//! Colours that are told apart, also by those who see few, on light paper and on dark (after Okabe and Ito 2008).

use crate::delivery::Doing;

/// For couriers in turn.
const COURIERS: [&str; 8] =
    ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#8577d6", "#a0714f"];
/// How lines of further couriers of a colour are broken, turn by turn.
const DASHES: [&str; 4] = ["none", "7 3", "2 3", "9 3 2 3"];

/// The colour of a courier, and how its line is broken.
pub(super) fn courier(index: usize) -> (&'static str, &'static str) {
    (COURIERS[index % COURIERS.len()], DASHES[index / COURIERS.len() % DASHES.len()])
}

/// The colour of what a courier is about.
pub(super) fn doing(doing: Doing) -> &'static str {
    match doing {
        Doing::Idle => "#8f8f8f",
        Doing::Fetching => "#56b4e9",
        Doing::Carrying => "#d55e00",
        Doing::Meeting => "#cc79a7",
        Doing::Shopping => "#e69f00",
        Doing::Resting => "#009e73",
    }
}
