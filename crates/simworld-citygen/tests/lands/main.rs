//! Places by a spec: settlements, and land beyond the city.

mod lands_hold_what_was_asked;
mod settlements_hold_what_was_asked;
