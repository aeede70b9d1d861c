//! SUMO's files: networks, demand, stops and people.
#![allow(clippy::unwrap_used, reason = "what fails in a helper fails the test")]

mod sumo_demand;
mod sumo_drivers;
mod sumo_networks;
mod sumo_orders;
mod sumo_people;
mod sumo_programs;
