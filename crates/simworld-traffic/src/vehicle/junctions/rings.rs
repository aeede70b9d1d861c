//! Roundabouts all of whose lanes are too short for any vehicle.
//!
//! If one stands on each lane of such a ring, with its rear in the way of the next, nobody can go. As long as one place is free somebody
//! can, so that whoever is to come in needs a [permit](super::clusters), of which there is one less than there are places.

use simworld_core::net::{Lane, RoadNetwork};

use crate::vehicle::manager::NONE;

/// The lanes of a ring.
pub(super) struct Ring {
    pub(in crate::vehicle) lanes: Vec<usize>,
    /// The junctions round which it leads.
    pub(in crate::vehicle) places: usize,
}

/// The rings among sets of lanes that follow one another, by lane.
pub(super) fn rings_of(sets: &[u32], network: &RoadNetwork) -> Vec<Ring> {
    let mut lanes: Vec<usize> = (0..sets.len()).filter(|lane| sets[*lane] != NONE).collect();
    lanes.sort_by_key(|lane| sets[*lane]);
    let ends = |lanes: &[usize], end: fn(&Lane) -> u32| {
        let mut ends: Vec<u32> = lanes.iter().map(|lane| end(&network.lanes[*lane])).collect();
        ends.sort_unstable();
        ends.dedup();
        ends
    };
    let rings = lanes.chunk_by(|a, b| sets[*a] == sets[*b]).filter_map(|lanes| {
        let (from, to) = (ends(lanes, |lane| lane.from.0), ends(lanes, |lane| lane.to.0));
        let goes_round = from == to && from.len() > 1;
        goes_round.then(|| Ring { lanes: lanes.to_vec(), places: from.len() })
    });
    rings.collect()
}
