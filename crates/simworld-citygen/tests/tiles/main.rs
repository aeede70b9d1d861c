//! Cities without end, tile by tile.

mod tiles_lie_in_their_bands;
mod tiles_meet_exactly;
mod tiles_stream_around_a_point;
