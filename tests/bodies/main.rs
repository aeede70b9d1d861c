//! What bodies do in whole worlds: primitive actions under physics, the obstacle course, land beyond the city, walkers who learn.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod courses_are_run;
mod gestures_are_seen;
mod lands;
mod primitives;
mod walkers_learn_by_the_contract;
