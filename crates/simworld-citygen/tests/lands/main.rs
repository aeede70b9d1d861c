//! Places by a spec: settlements, and land beyond the city.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod lands_hold_what_was_asked;
mod settlements_hold_what_was_asked;
