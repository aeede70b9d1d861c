//! Trees in parks and courtyards: on a jittered lattice, clear of the edges.

use rayon::prelude::*;
use simworld_core::geometry::{Point2, Vector2, bounds};
use simworld_core::scene::EntityKind;
use simworld_core::seed::Stream;
use smallvec::SmallVec;

use super::kinds::shape_of;
use super::{Element, Setting};
use crate::ElementConfig;
use crate::block::Border;
use crate::key::stream_at;
use crate::lot::{Green, GreenKind};
use crate::occupancy::{Occupancy, least, most};
use crate::threads;

/// Distance of a tree from the edge of its green, m.
const EDGE: f64 = 2.0;
/// An edge farther than this above or below a row of the lattice is not near to any of its points, m: a little more than
/// that, so that rounding decides nothing.
const ROW_SLACK: f64 = EDGE + 0.01;
/// Lattice points of one green.
const MOST_POINTS: f64 = 20_000.0;
/// Greens that one thread thinks of at once.
const CHUNK: usize = 16;

/// Plants trees on every park and courtyard; before them go elements of elsewhere, which are put in meanwhile.
pub(super) fn plant(
    setting: &Setting<'_>,
    config: &ElementConfig,
    streams: Stream,
    taken: &mut Occupancy,
    elements: &mut Vec<Element>,
    mut before: Vec<Vec<Element>>,
) {
    let spacing = 1.0 / config.green_trees.sqrt();
    let is_planted = |green: &&Green| green.kind != GreenKind::Leftover && config.green_trees > 0.0;
    let greens: Vec<&Green> = setting.land.greens.iter().filter(is_planted).collect();
    // Trees are functions of their greens, so they are thought of on all threads; who gets room is decided in order.
    let think = |batch: &[&Green]| -> Vec<Vec<Element>> {
        let trees = batch.par_chunks(CHUNK).map(|greens| {
            let area: f64 = greens.iter().map(|green| green.area).sum();
            let mut trees = Vec::with_capacity((area * config.green_trees).min(MOST_POINTS) as usize);
            for green in greens {
                let outline = setting.land.green_outline(green);
                think_of(outline, green.along, spacing, streams, &mut trees);
            }
            trees
        });
        trees.collect()
    };
    threads::in_order(greens.chunks(64 * CHUNK), think, |trees| {
        // Each part goes as it is taken over: this is when a city takes the most memory.
        before.drain(..).for_each(|part| elements.extend(part));
        elements.extend(trees.into_iter().flatten().flatten().filter(|tree| taken.take(&ground_of(tree))));
    });
}

/// Thinks of the trees that would stand on a green.
fn think_of(outline: &[Point2], along: Border, spacing: f64, streams: Stream, trees: &mut Vec<Element>) {
    let Some((low, high)) = bounds(outline) else { return };
    let size: Vector2 = high - low;
    let (columns, rows) = ((size.x / spacing).ceil(), (size.y / spacing).ceil());
    if columns * rows > MOST_POINTS {
        return;
    }
    let (edges, mut row_edges) = (edges(outline), Beside::default());
    let mut rng = stream_at(low, 100.0, streams).rng();
    for row in 0..rows as u32 {
        let south = low.y + f64::from(row) * spacing;
        row_edges.set(&edges, (south, south + spacing));
        for column in 0..columns as u32 {
            let jitter = Vector2::new(rng.unit(), rng.unit());
            let position = low + (Vector2::new(f64::from(column), f64::from(row)) + jitter) * spacing;
            if !row_edges.hold(position) {
                continue;
            }
            let shape = shape_of(EntityKind::Tree, &mut rng);
            trees.push(Element { kind: EntityKind::Tree, position, facing: 0.0, shape, along });
        }
    }
}

/// The ground of a tree, which looks nowhere: its box lies along the axes.
fn ground_of(tree: &Element) -> [Point2; 4] {
    let half = tree.shape.size() * 0.5;
    [(half.x, half.y), (-half.x, half.y), (-half.x, -half.y), (half.x, -half.y)]
        .map(|(x, y)| tree.position + Vector2::new(x, y))
}

/// An edge of a green: its ends, the way from the one to the other, and the square of its length, m².
type Edge = ([Point2; 2], Vector2, f64);

/// The edges of an outline: measured once, for each point of the lattice asks all of them.
fn edges(outline: &[Point2]) -> SmallVec<[Edge; 8]> {
    let next = outline.iter().skip(1).chain(outline.first());
    outline.iter().zip(next).map(|(a, b)| ([*a, *b], b - a, (b - a).norm_squared())).collect()
}

/// The edges beside a row of the lattice: no other is passed at its heights, or near to it. They keep their place from one row
/// to the next.
#[derive(Default)]
struct Beside {
    edges: SmallVec<[Edge; 8]>,
    /// From where to where they reach.
    span: (f64, f64),
}

impl Beside {
    /// Takes those of an outline between two heights.
    fn set(&mut self, edges: &[Edge], (south, north): (f64, f64)) {
        let is_beside =
            |([a, b], ..): &Edge| most(a.y, b.y) >= south - ROW_SLACK && least(a.y, b.y) <= north + ROW_SLACK;
        self.edges.clear();
        self.edges.extend(edges.iter().filter(|edge| is_beside(edge)).copied());
        let ends = self.edges.iter().flat_map(|(ends, ..)| ends);
        self.span = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), end| {
            (least(low, end.x), most(high, end.x))
        });
    }

    /// Whether a point of the row lies within the outline, clear of its edges.
    fn hold(&self, point: Point2) -> bool {
        // Who is within has an edge on either side.
        self.span.0 < point.x && point.x < self.span.1 && is_inside(&self.edges, point)
    }
}

/// Whether a point lies within an outline, clear of its edges.
#[expect(clippy::needless_bitwise_bool, reason = "which edges pass the height of a point cannot be foretold")]
fn is_inside(edges: &[Edge], point: Point2) -> bool {
    let mut inside = false;
    for ([a, b], edge, squared) in edges {
        let to = point - a;
        let aside = edge.perp(&to);
        // Most are far from the line of the edge, and so from the edge: a hair of slack, so that rounding decides nothing.
        if aside * aside <= EDGE * EDGE * squared * (1.0 + 1e-9) && is_near(to, edge, *squared, aside) {
            return false;
        }
        // On the left of an edge that rises past the height of the point, or on the right of one that falls.
        inside ^= ((a.y > point.y) != (b.y > point.y)) & ((aside > 0.0) == (edge.y > 0.0));
    }
    inside
}

/// Whether what lies so far from the beginning of an edge, and so far aside of it times its length, is too near to it.
fn is_near(to: Vector2, edge: &Vector2, squared: f64, aside: f64) -> bool {
    let along = to.dot(edge);
    if along <= 0.0 {
        to.norm_squared() < EDGE * EDGE
    } else if along >= squared {
        (to - edge).norm_squared() < EDGE * EDGE
    } else {
        aside * aside < EDGE * EDGE * squared
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn the_ground_of_a_tree_is_that_of_its_box_to_the_bit() {
        let mut rng = Seed(4).stream("trees").rng();
        for _ in 0..1000 {
            let position = Point2::new(rng.uniform(-1e6, 1e6), rng.uniform(-1e6, 1e6));
            let shape = shape_of(EntityKind::Tree, &mut rng);
            let tree = Element { kind: EntityKind::Tree, position, facing: 0.0, shape, along: Border::LAND };
            assert_eq!(ground_of(&tree), tree.obb().footprint(), "{tree:?}");
        }
    }
}
