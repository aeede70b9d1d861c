//! Cities without end, tile by tile.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod tiles_lie_in_their_bands;
mod tiles_meet_exactly;
mod tiles_stream_around_a_point;
