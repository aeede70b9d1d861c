//! The streets of one tile, and as much of its neighbours' as decides what they look like at the seam.
//!
//! Every street belongs to one tile: those within a superblock to its tile, and of the main streets those on the southern
//! and the western side of a superblock. A tile's plan holds its own streets first, then the *seam*: the main streets on
//! its northern and eastern side, which its neighbours own; then the *margin*: the streets of the neighbours that meet the
//! tile's outline, each with an end of its own that joins nothing. With them every junction on the outline has all its
//! streets, so that both tiles derive the same kerbs and lots along it.

use std::collections::BTreeMap;

use simworld_core::geometry::Point2;
use simworld_core::net::{RoadClass, Street, StreetPlan};

use super::lattice::{Axis, Junction};
use super::{Superblock, TileId, TileSource};
use crate::RoadConfig;
use crate::growth::{self, Soil, Within};

/// Streets of a superblock with its main streets and a share of the margin: most have fewer.
const STREETS: usize = 96;

/// The streets of a tile.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    /// Own streets, then the seam, then the margin.
    pub(super) plan: StreetPlan,
    /// How many are own.
    pub(super) own: usize,
    /// For each street, whether the land on its left and on its right belongs to the tile.
    pub(super) sides: Vec<[bool; 2]>,
}

/// What of the neighbours a draft holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Beyond {
    /// All that meets the outline.
    Margin,
    /// The main streets on the northern side, and on the eastern one, where asked for.
    Seam {
        /// On the northern side.
        north: bool,
        /// On the eastern side.
        east: bool,
    },
}

/// Lays a plan out, joining nodes at the same place.
pub(super) struct Drawer {
    pub(super) plan: StreetPlan,
    sections: [u32; 3],
    /// Nodes on main streets, by the bits of their coordinates: both sides of a seam compute the same ones.
    known: BTreeMap<[u64; 2], usize>,
    /// What all superblocks grow in.
    soil: Soil,
    sides: Vec<[bool; 2]>,
}

impl Drawer {
    pub(super) fn new(source: &TileSource) -> Self {
        let roads = &source.config().city.roads;
        let (plan, sections) = growth::plan_of_sections(roads);
        let soil = Soil::new(roads, source.seed());
        Self { plan, sections, known: BTreeMap::new(), soil, sides: Vec::new() }
    }

    /// The node on a main street at a point; new if there is none yet.
    fn node(&mut self, at: Point2) -> usize {
        let plan = &mut self.plan;
        *self.known.entry(bits(at)).or_insert_with(|| {
            plan.nodes.push(at);
            plan.nodes.len() - 1
        })
    }

    fn push(&mut self, street: Street, sides: [bool; 2]) {
        self.plan.streets.push(street);
        self.sides.push(sides);
    }

    /// A piece of a main street.
    fn main(&mut self, from: usize, to: usize, sides: [bool; 2]) {
        let (class, section) = (RoadClass::Arterial, self.sections[RoadClass::Arterial as usize]);
        self.push(Street { class, section, ..Street::simple(from, to) }, sides);
    }

    /// A main street from crossing to crossing.
    fn main_street(&mut self, junctions: &[Junction], sides: [bool; 2]) {
        for pair in junctions.windows(2) {
            let (from, to) = (self.node(pair[0].at), self.node(pair[1].at));
            self.main(from, to, sides);
        }
    }

    /// All streets within a superblock.
    fn within(&mut self, superblock: Superblock) {
        let Superblock { within: Within { nodes, streets }, walls } = superblock;
        let mut numbers = Vec::with_capacity(nodes.len());
        for (index, at) in nodes.iter().enumerate() {
            numbers.push(if index < walls { None } else { Some(self.plan.nodes.len()) });
            if index >= walls {
                self.plan.nodes.push(*at);
            }
        }
        for street in streets {
            let [from, to] =
                [street.from, street.to].map(|end| numbers[end].unwrap_or_else(|| self.node(nodes[end])));
            self.push(Street { from, to, ..street }, [true; 2]);
        }
    }

    /// The streets within a neighbouring superblock that meet the outline, cut off where they meet others.
    fn margin_within(&mut self, mut superblock: Superblock, roads: &RoadConfig) {
        let meets = |node: Point2| self.known.contains_key(&bits(node));
        // Only theirs is the room to turn that shows; most lead on.
        let nodes = &superblock.within.nodes;
        if superblock.has_dead_end(|street| meets(nodes[street.from]) || meets(nodes[street.to])) {
            superblock.make_turning_room(roads);
        }
        let Superblock { within: Within { nodes, streets }, walls } = superblock;
        for street in &streets {
            // Only at the wall could they meet the outline.
            for end in [street.from, street.to].into_iter().filter(|end| *end < walls) {
                let Some(here) = self.known.get(&bits(nodes[end])).copied() else { continue };
                let far = self.plan.nodes.len();
                self.plan.nodes.push(nodes[street.from + street.to - end]);
                let (from, to) = if end == street.from { (here, far) } else { (far, here) };
                self.push(Street { from, to, ..street.clone() }, [false; 2]);
            }
        }
    }

    /// The first piece of a main street that leaves the outline from its beginning, or from its end.
    fn margin_main(&mut self, junctions: &[Junction], from_end: bool) {
        let count = junctions.len();
        let (near, far) = if from_end {
            (junctions[count - 1], junctions[count - 2])
        } else {
            (junctions[0], junctions[1])
        };
        let here = self.node(near.at);
        let there = self.plan.nodes.len();
        self.plan.nodes.push(far.at);
        let (from, to) = if from_end { (there, here) } else { (here, there) };
        self.main(from, to, [false; 2]);
    }

    /// Adds the own streets of a tile, and what of its neighbours is asked for; gives the number of own
    /// streets.
    pub(super) fn tile(&mut self, source: &TileSource, id: TileId, beyond: Beyond) -> usize {
        let lattice = source.lattice();
        let roads = &source.config().city.roads;
        let count = i64::from(source.config().lattice.superblocks);
        let (west, south) = (i64::from(id.x) * count, i64::from(id.y) * count);
        let (east, north) = (west + count, south + count);
        self.plan.streets.reserve(STREETS * (count * count) as usize);
        for row in south..north {
            for column in west..east {
                self.main_street(&lattice.street(column, row, Axis::East), [true, row > south]);
                self.main_street(&lattice.street(column, row, Axis::North), [column > west, true]);
            }
        }
        for row in south..north {
            for column in west..east {
                let mut superblock = source.superblock(column, row, &mut self.soil);
                superblock.make_turning_room(roads);
                self.within(superblock);
            }
        }
        let own = self.plan.streets.len();
        let (seam_north, seam_east) = match beyond {
            Beyond::Margin => (true, true),
            Beyond::Seam { north, east } => (north, east),
        };
        for column in (west..east).filter(|_| seam_north) {
            self.main_street(&lattice.street(column, north, Axis::East), [false, true]);
        }
        for row in (south..north).filter(|_| seam_east) {
            self.main_street(&lattice.street(east, row, Axis::North), [true, false]);
        }
        if beyond == Beyond::Margin {
            self.margin(source, (west, south), (east, north));
        }
        own
    }

    fn margin(&mut self, source: &TileSource, (west, south): (i64, i64), (east, north): (i64, i64)) {
        let lattice = source.lattice();
        let beside = (west..east).flat_map(|column| [(column, south - 1), (column, north)]);
        let beside: Vec<(i64, i64)> =
            beside.chain((south..north).flat_map(|row| [(west - 1, row), (east, row)])).collect();
        for (column, row) in beside {
            let superblock = source.superblock(column, row, &mut self.soil);
            self.margin_within(superblock, &source.config().city.roads);
        }
        for column in west..=east {
            self.margin_main(&lattice.street(column, south - 1, Axis::North), true);
            self.margin_main(&lattice.street(column, north, Axis::North), false);
        }
        for row in south..=north {
            self.margin_main(&lattice.street(west - 1, row, Axis::East), true);
            self.margin_main(&lattice.street(east, row, Axis::East), false);
        }
    }
}

impl Draft {
    /// The streets of a tile with the margin of its neighbours.
    pub(super) fn of(source: &TileSource, id: TileId) -> Self {
        let mut drawer = Drawer::new(source);
        let own = drawer.tile(source, id, Beyond::Margin);
        Self { plan: drawer.plan, own, sides: drawer.sides }
    }
}

/// A place by its bits: nodes on main streets lie at least a gate apart, so equal places are equal in every bit.
fn bits(at: Point2) -> [u64; 2] {
    [at.x.to_bits(), at.y.to_bits()]
}
