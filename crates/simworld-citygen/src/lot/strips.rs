//! The fronts of open land in the order in which lots are fitted along them, and what each may take: so that a change is followed only
//! as far as it reaches.

use simworld_core::geometry::{Point2, bounds};

use super::LotConfig;
use super::corner::{Corner, Front};
use super::ribbon::{depth_of, enter, in_order, street_of};
use crate::block::{Block, Ring};
use crate::zoning::{Zone, Zoning};

/// A rectangle along the axes, its least and its greatest corner, m.
type Bounds = (Point2, Point2);

/// The land along one front of an open block.
#[derive(Clone, Debug)]
pub(crate) struct Strip {
    /// The side of a road that it lies along, see [`Block::of_sides`].
    pub(crate) side: usize,
    /// The edge of the block.
    pub(crate) edge: usize,
    /// Where the edge before it, itself and the edge after it begin, and where that ends, m.
    pub(crate) course: [Point2; 4],
    /// Length of the front, m.
    pub(crate) length: f64,
    /// Whether buildings may stand there; else it is a park.
    pub(crate) is_built: bool,
    /// Round all that its lots may take.
    pub(crate) lots: Bounds,
    /// Round the fronts on the other side of a bay that lots here are less deep for.
    pub(crate) view: Bounds,
}

impl Strip {
    /// Those of an open block, in the order in which lots are fitted.
    pub(crate) fn of_block(block: &Block, zoning: &Zoning, config: &LotConfig) -> Vec<Self> {
        let ring = block.ring();
        let order = in_order(&ring);
        let mut fronts = vec![Front::default(); ring.len()];
        for (edge, length) in &order {
            fronts[*edge].length = *length;
        }
        let strip = |(edge, length): (usize, f64)| {
            let street = street_of(&ring, edge, length);
            let (zone, _) = zoning.at(enter(&street, length));
            let depth = depth_of(config.size(zone));
            let leans = [false, true].map(|is_end| {
                Corner::of(&ring, &fronts, (edge, street.along), is_end).map_or(0.0, |end| end.lean())
            });
            let (start, end) = (ring.corners[edge], ring.next(edge));
            let corners = |deep: f64| {
                let inwards = street.inwards() * deep;
                let [before, after] = leans.map(|lean| street.along * (lean * depth));
                [start, end, end + inwards + after, start + inwards - before]
            };
            Some(Self {
                side: ring.borders[edge].side()?,
                edge,
                course: course_of(&ring, edge),
                length,
                is_built: zone != Zone::Park,
                lots: bounds(&corners(depth))?,
                view: bounds(&corners(3.0 * depth))?,
            })
        };
        order.into_iter().filter_map(strip).collect()
    }
}

/// The corners of a ring from the one before an edge to the one after it.
fn course_of(ring: &Ring, edge: usize) -> [Point2; 4] {
    let count = ring.len();
    [count - 1, 0, 1, 2].map(|step| ring.corners[(edge + step) % count])
}
