//! SUMO's files: networks, demand, stops and people.

mod sumo_demand;
mod sumo_networks;
mod sumo_people;
