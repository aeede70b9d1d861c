//! Road networks: derived, repaired, and searched.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod bicycles_have_their_own_lanes;
mod dead_ends_have_hammerheads;
mod derived_networks_hold_together;
mod junctions_have_round_kerbs;
mod lanes_lead_where_they_are_said_to;
mod near_junctions_are_one;
mod petgraph_agrees;
mod repairs_equal_derivation;
mod roads_of_every_kind;
mod ways_for_walkers_join;
