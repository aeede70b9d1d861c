//! What grows and what lies about: trees in blue noise as dense as the land wants them, boulders, hedges.
//!
//! Trees stand where darts in a random order find no neighbour too near (Cook 1986, with the radius of the density at each
//! place). Such a packing comes to rest at 0.547 of the plane under discs of that diameter (Feder 1980), so the distance for a
//! density of n a square metre is sqrt(0.547 * 4 / (pi * n)). Densities: an old mixed forest has 200 to 500 trees of more than
//! 10 cm a hectare (FAO, Global Forest Resources Assessment 2020, terms; Burrascano et al. 2013), an orchard of tall trees 70
//! to 100 (hochstamm, 10 to 12 m apart).

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::seed::Stream;

use super::grid::Grid;

/// Trees a hectare of closed forest where the spec says "usual".
pub const FOREST: f64 = 300.0;
/// Distance of neighbours for a density of one a square metre, m, as it comes out with as many darts as are thrown.
const PACKED: f64 = 0.795;
/// Darts a cell side, m.
const DART: f64 = 1.4;
/// The least dense that trees stand, trees a square metre: what is less is open land.
const SPARSE: f64 = 2e-4;

/// Something that grows or lies somewhere.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plant {
    /// The asset of the library.
    pub(super) asset: &'static str,
    /// Where, m.
    pub(super) at: Point2,
    /// The direction it faces, radians.
    pub(super) facing: f64,
    /// How large it is beside its asset.
    pub(super) scale: f64,
}

/// Places in blue noise with `density` of them a square metre, none where that is next to nothing.
pub(super) fn scattered(grid: &Grid, stream: Stream, density: impl Fn(Point2) -> f64) -> Vec<Point2> {
    let mut rng = stream.rng();
    let side = (2.0 * grid.half / DART) as usize;
    let mut darts: Vec<(u64, Point2, f64)> = Vec::new();
    for index in 0..side * side {
        let (jitter, order) = (Vector2::new(rng.unit(), rng.unit()), rng.bits());
        let cell = Vector2::new((index % side) as f64, (index / side) as f64);
        let at = Point2::from((cell + jitter) * DART - Vector2::repeat(grid.half));
        let density = density(at);
        if density >= SPARSE {
            darts.push((order, at, PACKED / density.sqrt()));
        }
    }
    darts.sort_by_key(|(order, ..)| *order);
    let widest = darts.iter().map(|dart| dart.2).fold(1.0, f64::max);
    let across = (2.0 * grid.half / widest).ceil() as usize + 1;
    let cell = |x: f64| ((x + grid.half) / widest) as usize;
    let mut cells: Vec<Vec<(Point2, f64)>> = vec![Vec::new(); across * across];
    let mut places = Vec::new();
    for (_, at, apart) in darts {
        let (column, row) = (cell(at.x), cell(at.y));
        let near = (row.saturating_sub(1)..=(row + 1).min(across - 1)).flat_map(|row| {
            (column.saturating_sub(1)..=(column + 1).min(across - 1)).map(move |column| (column, row))
        });
        let is_free = near.into_iter().all(|(column, row)| {
            cells[row * across + column]
                .iter()
                .all(|(other, theirs)| (other - at).norm() >= 0.5 * (apart + theirs))
        });
        if is_free {
            cells[row * across + column].push((at, apart));
            places.push(at);
        }
    }
    places
}

/// Which trees grow there: by the height above the water as a share of the tree line, and by how far the water is.
pub(super) fn species(share: f64, damp: f64, chance: f64) -> &'static str {
    let choice = |of: &[&'static str]| of[(chance * of.len() as f64) as usize % of.len()];
    if damp > 0.75 {
        choice(&["willow", "birch", "poplar"])
    } else if share > 0.6 {
        choice(&["spruce", "pine", "spruce"])
    } else if share > 0.3 {
        choice(&["spruce", "beech", "pine", "birch"])
    } else {
        choice(&["oak", "beech", "maple", "birch"])
    }
}
