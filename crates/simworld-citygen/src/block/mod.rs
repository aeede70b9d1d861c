//! Blocks: the land between the streets, up to the outer edges of their sidewalks.
//!
//! A block is a face of the street network. Its boundary follows the sidewalks round the face on the left, so that
//! dead ends that reach into a block are part of its boundary like any other street. The one face outside of all
//! streets is an open block: it has an inner boundary only.

mod convex;
mod inset;
mod ring;
mod trace;

pub(crate) use convex::decompose;
use rayon::prelude::*;
pub(crate) use ring::{Ring, Split};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::{RoadNetwork, Side};
use trace::Boundary;
pub(crate) use trace::sides_round;

/// What lies beyond one edge of a block or a lot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Border(u32);

impl Default for Border {
    fn default() -> Self {
        Self::LAND
    }
}

impl Border {
    /// More land.
    pub const LAND: Self = Self(u32::MAX);
    /// A corner of a street, or a street without a sidewalk: nobody can come in from there.
    pub const CORNER: Self = Self(u32::MAX - 1);

    /// The sidewalk on one side of a road.
    pub fn street(road: RoadId, side: Side) -> Self {
        Self(2 * road.index() as u32 + u32::from(side == Side::Right))
    }

    /// The sidewalk on a side by its number, see [`Block::of_sides`].
    pub(crate) fn of_side(side: usize) -> Self {
        Self(side as u32)
    }

    /// The number of the side of the road, as in [`Block::of_sides`], where it is a sidewalk.
    pub(crate) fn side(self) -> Option<usize> {
        self.is_street().then_some(self.0 as usize)
    }

    /// The road and its side, where it is a sidewalk.
    pub fn as_street(self) -> Option<(RoadId, Side)> {
        let side = if self.0 & 1 == 0 { Side::Left } else { Side::Right };
        (self.0 < Self::CORNER.0).then(|| (RoadId::from_index((self.0 >> 1) as usize), side))
    }

    pub(crate) fn is_street(self) -> bool {
        self.0 < Self::CORNER.0
    }
}

/// The land between some streets.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Its corners, counter-clockwise round a closed block and clockwise round an open one, m.
    pub outline: Vec<Point2>,
    /// What lies beyond each edge; the i-th edge leads from corner i to the next.
    pub borders: Vec<Border>,
    /// Area, m²; none of an open block, which has no end.
    pub area: Option<f64>,
}

impl Block {
    /// The blocks of a network, in the order of the roads that bound them.
    pub fn of_network(network: &RoadNetwork) -> Vec<Self> {
        Self::of_sides(network, 0..2 * network.roads.len())
    }

    /// The blocks of a network that some of the sides of its roads bound, in the order of those roads: of ascending sides, where side 2i is the
    /// left of road i and side 2i + 1 its right.
    pub(crate) fn of_sides(network: &RoadNetwork, sides: impl IntoIterator<Item = usize>) -> Vec<Self> {
        let boundaries = trace::boundaries(network, sides);
        boundaries.par_iter().with_min_len(64).filter_map(Self::within).collect()
    }

    /// The land within a boundary, if there is any.
    fn within(boundary: &Boundary) -> Option<Self> {
        let mut ring = inset::inset(boundary)?;
        ring.begin_at_least();
        let area = ring.area();
        let is_closed = area > 0.0 && ring.is_simple();
        Some(Self {
            outline: ring.corners.into_vec(),
            borders: ring.borders.into_vec(),
            area: is_closed.then_some(area),
        })
    }

    /// A closed block from its corners, counter-clockwise, and what lies beyond each edge.
    ///
    /// `None` if the corners are fewer than three or other than the borders, if they do not go counter-clockwise, or if
    /// the outline crosses itself.
    pub fn closed(outline: Vec<Point2>, borders: Vec<Border>) -> Option<Self> {
        if outline.len() < 3 || outline.len() != borders.len() {
            return None;
        }
        let ring = Ring { corners: outline.into(), borders: borders.into() };
        let area = ring.area();
        (area > 0.0 && ring.is_simple()).then_some(Self {
            outline: ring.corners.into_vec(),
            borders: ring.borders.into_vec(),
            area: Some(area),
        })
    }

    /// Length of its edges along sidewalks, m.
    pub fn frontage(&self) -> f64 {
        let next = self.outline.iter().cycle().skip(1);
        let edges = self.outline.iter().zip(next).zip(&self.borders);
        edges.filter(|(_, border)| border.is_street()).map(|((a, b), _)| (b - a).norm()).sum()
    }

    pub(crate) fn ring(&self) -> Ring {
        Ring { corners: self.outline[..].into(), borders: self.borders[..].into() }
    }
}
