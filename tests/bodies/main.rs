//! What bodies do in whole worlds: primitive actions under physics, the obstacle course, what eyes lead to, land beyond the city, walkers who
//! learn; and what the fuzz targets check.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod courses_are_run;
mod episodes_go_the_same_way;
mod eyes_come_to_what_they_see;
mod fuzz_targets_hold;
mod gestures_are_seen;
mod lands;
mod primitives;
mod walkers_learn_by_the_contract;
