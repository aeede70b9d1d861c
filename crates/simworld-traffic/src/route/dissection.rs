//! The order in which legs are contracted: nested dissection (George 1973) by position. Few legs part a town in two; those
//! come last, and each half is parted likewise. Streets of one kind all over a town rank alike, so an order by what each
//! contraction adds takes long to find and serves no better.

use petgraph::graph::{DiGraph, NodeIndex};
use simworld_core::geometry::Point2;

/// So few legs are not parted further.
const SMALL: usize = 8;
/// Cuts are tried from a third to two thirds of the way across, in steps of one part.
const CUTS: std::ops::RangeInclusive<usize> = 8..=16;
const PARTS: usize = 24;

/// The legs in their order, each once; `places` are their positions.
pub(super) fn order(graph: &DiGraph<(), f64, u32>, places: &[Point2]) -> Vec<usize> {
    let is_alone =
        |leg: &usize| graph.neighbors_undirected(NodeIndex::new(*leg)).all(|other| other.index() == *leg);
    let (order, mut legs): (Vec<usize>, Vec<usize>) = (0..places.len()).partition(is_alone);
    let mut dissection = Dissection { graph, places, sides: vec![0; places.len()], far: 0, order };
    dissection.part(&mut legs);
    dissection.order
}

struct Dissection<'a> {
    graph: &'a DiGraph<(), f64, u32>,
    places: &'a [Point2],
    /// A number for the side of the last cut on which each leg lay.
    sides: Vec<u32>,
    /// The number of the far side of the cut being tried.
    far: u32,
    order: Vec<usize>,
}

impl Dissection<'_> {
    fn part(&mut self, legs: &mut [usize]) {
        if legs.len() <= SMALL {
            self.order.extend_from_slice(legs);
            return;
        }
        self.sort(legs);
        let cuts = CUTS.map(|part| legs.len() * part / PARTS);
        let widths = cuts.map(|cut| (self.mark(legs, cut), cut));
        let Some((_, cut)) = widths.min() else { return };
        self.mark(legs, cut);
        let (near, far) = legs.split_at_mut(cut);
        let (border, mut inner): (Vec<usize>, Vec<usize>) = near.iter().partition(|leg| self.borders(**leg));
        self.part(&mut inner);
        self.part(far);
        self.order.extend(border);
    }

    /// Sorts legs along the longer side of their bounding box.
    fn sort(&self, legs: &mut [usize]) {
        let (mut low, mut high) = (Point2::new(f64::MAX, f64::MAX), Point2::new(f64::MIN, f64::MIN));
        for leg in legs.iter() {
            (low, high) = (low.inf(&self.places[*leg]), high.sup(&self.places[*leg]));
        }
        let axis = usize::from(high.y - low.y > high.x - low.x);
        legs.sort_unstable_by(|a, b| {
            self.places[*a][axis].total_cmp(&self.places[*b][axis]).then_with(|| a.cmp(b))
        });
    }

    /// Cuts sorted legs in two: how many before the cut border on those behind.
    fn mark(&mut self, legs: &[usize], cut: usize) -> usize {
        self.far += 2;
        for (rank, leg) in legs.iter().enumerate() {
            self.sides[*leg] = self.far - u32::from(rank < cut);
        }
        legs[..cut].iter().filter(|leg| self.borders(**leg)).count()
    }

    fn borders(&self, leg: usize) -> bool {
        let mut others = self.graph.neighbors_undirected(NodeIndex::new(leg));
        others.any(|other| self.sides[other.index()] == self.far)
    }
}
