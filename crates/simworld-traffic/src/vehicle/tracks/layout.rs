//! The parts of a network: intersections near one another, with the lanes that lead into them and the ways across them.
//!
//! Each part is worked on by one thread at a time. Whatever happens at an intersection (who may cross, who follows whom, who
//! changes lanes on the road to it) happens within one part; only those who leave it for the next road pass to another.
//! The parts follow from the network alone, so results do not depend on the number of threads.

use std::ops::Range;

use simworld_core::geometry::Point2;
use simworld_core::net::RoadNetwork;

use super::Track;

/// At most so many parts.
pub(crate) const MOST_PARTS: usize = 128;
/// Tracks of a part, as long as there are few enough parts: a few hundred vehicles in a city.
const TRACKS: usize = 1024;

/// Where a track is kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) part: u32,
    /// Its number in the part: lanes first, those of one intersection after those of another, then ways.
    pub(crate) local: u32,
}

/// What everybody on a track goes by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Measure {
    /// Its length, m.
    pub(crate) length: f64,
    /// The speeds that the law allows, on ways that of the lane behind, and that its bends allow as well, m/s.
    pub(crate) limit: f64,
    pub(crate) bend: f64,
}

/// The tracks of one part.
#[derive(Clone, Debug, Default)]
pub(crate) struct PartLayout {
    /// The tracks by their number in the part.
    pub(crate) tracks: Vec<Track>,
    /// Of each of them, so that they lie in the order in which they are gone through.
    pub(crate) measures: Vec<Measure>,
    /// How many of them are lanes.
    pub(crate) lanes: usize,
    /// Of each way, the number in the part of the lane from which it leads.
    pub(crate) from: Vec<u32>,
    /// The lanes of each intersection, as ranges of their numbers in the part, ascending.
    pub(crate) junctions: Vec<Range<u32>>,
}

/// Which part each track belongs to.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    /// By track.
    pub(crate) places: Vec<Place>,
    pub(crate) parts: Vec<PartLayout>,
}

impl Layout {
    pub(crate) fn new(network: &RoadNetwork) -> Self {
        let tracks = network.lanes.len() + network.connections.len();
        Self::of_parts(network, tracks.div_ceil(TRACKS).clamp(1, MOST_PARTS))
    }

    /// About so many parts, of about as many tracks each.
    pub(crate) fn of_parts(network: &RoadNetwork, count: usize) -> Self {
        let lanes = network.lanes.len();
        let mut incoming: Vec<Vec<Track>> = vec![Vec::new(); network.intersections.len()];
        for (index, lane) in network.lanes.iter().enumerate() {
            incoming[lane.to.index()].push(index as Track);
        }
        let tracks = lanes + network.connections.len();
        let share = tracks.div_ceil(count.max(1)).max(1);
        let mut layout = Self { places: vec![Place::default(); tracks], parts: vec![PartLayout::default()] };
        let mut ways: Vec<Track> = Vec::new();
        for junction in along_a_curve(network) {
            let part = layout.parts.last_mut().filter(|part| part.tracks.len() + ways.len() < share);
            if part.is_none() {
                layout.close(&mut ways);
                layout.parts.push(PartLayout::default());
            }
            let Some(part) = layout.parts.last_mut() else { continue };
            let start = part.tracks.len() as u32;
            part.tracks.extend(&incoming[junction]);
            part.junctions.push(start..part.tracks.len() as u32);
            ways.extend(network.intersections[junction].connections.iter().map(|id| lanes as Track + id.0));
        }
        layout.close(&mut ways);
        layout
    }

    /// Takes up length and speed of each track, m and m/s, and from where ways lead.
    pub(super) fn measure(&mut self, network: &RoadNetwork, length: &[f64], speed: &[f64]) {
        let Self { places, parts } = self;
        for part in parts {
            let measure = |track: &Track| {
                let track = *track as usize;
                let way = track.checked_sub(network.lanes.len()).map(|way| &network.connections[way]);
                let limit = way.map_or(speed[track], |way| speed[way.to.index()]);
                Measure { length: length[track], limit, bend: speed[track] }
            };
            part.measures = part.tracks.iter().map(measure).collect();
            let ways = part.tracks[part.lanes..].iter().map(|way| *way as usize - network.lanes.len());
            part.from = ways.map(|way| places[network.connections[way].from.index()].local).collect();
        }
    }

    /// Gives the last part its ways.
    fn close(&mut self, ways: &mut Vec<Track>) {
        let number = self.parts.len() as u32 - 1;
        let Some(part) = self.parts.last_mut() else { return };
        part.lanes = part.tracks.len();
        part.tracks.append(ways);
        for (local, track) in part.tracks.iter().enumerate() {
            self.places[*track as usize] = Place { part: number, local: local as u32 };
        }
    }

    #[inline]
    pub(crate) fn place(&self, track: Track) -> Place {
        self.places[track as usize]
    }

    #[inline]
    pub(crate) fn local(&self, track: Track) -> usize {
        self.places[track as usize].local as usize
    }
}

/// The intersections along Morton's curve: those near one another on it are near one another in the city.
fn along_a_curve(network: &RoadNetwork) -> Vec<usize> {
    let position = |index: usize| network.intersections[index].center;
    let low = (0..network.intersections.len())
        .map(position)
        .fold(Point2::new(f64::MAX, f64::MAX), |low, at| Point2::new(low.x.min(at.x), low.y.min(at.y)));
    // Cells of 16 m; what is farther out than 2^20 of them falls into the last.
    let cell = |along: f64| ((along / 16.0) as u64).min((1 << 20) - 1);
    let mut order: Vec<(u64, usize)> = (0..network.intersections.len())
        .map(|index| {
            let at = position(index);
            (spread(cell(at.x - low.x)) | spread(cell(at.y - low.y)) << 1, index)
        })
        .collect();
    order.sort_unstable();
    order.into_iter().map(|(_, index)| index).collect()
}

/// The bits of a number with a zero between each two.
fn spread(mut bits: u64) -> u64 {
    let masks = [
        (16, 0x0000_ffff_0000_ffff_u64),
        (8, 0x00ff_00ff_00ff_00ff),
        (4, 0x0f0f_0f0f_0f0f_0f0f),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555),
    ];
    for (shift, mask) in masks {
        bits = (bits | bits << shift) & mask;
    }
    bits
}

#[cfg(test)]
mod tests {
    use simworld_core::net::{NetworkConfig, StreetPlan};

    use super::*;

    #[test]
    fn every_track_is_in_one_part_beside_those_of_its_intersection() {
        let plan = StreetPlan::grid(7, 5, 120.0);
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
        for count in [1, 2, 9, 1000] {
            let layout = Layout::of_parts(&network, count);
            let held: usize = layout.parts.iter().map(|part| part.tracks.len()).sum();
            assert_eq!(held, layout.places.len());
            for (track, place) in layout.places.iter().enumerate() {
                assert_eq!(layout.parts[place.part as usize].tracks[place.local as usize], track as Track);
            }
            for (index, way) in network.connections.iter().enumerate() {
                let way_place = layout.place((network.lanes.len() + index) as Track);
                assert_eq!(way_place.part, layout.place(way.from.0).part);
            }
        }
    }

    #[test]
    fn a_curve_interleaves_the_bits() {
        assert_eq!(spread(0b1011), 0b0100_0101);
        assert_eq!(spread((1 << 20) - 1), 0x0000_0055_5555_5555);
    }
}
