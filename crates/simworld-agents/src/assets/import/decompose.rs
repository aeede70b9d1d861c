//! Convex solids that together are what bodies meet: approximate convex decomposition by voxels (V-HACD, of parry).
//!
//! The only place that knows parry's vectors.

use std::panic::{AssertUnwindSafe, catch_unwind};

use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};
use parry3d_f64::transformation::voxelization::FillMode;
use simworld_core::asset::Hull;
use simworld_core::geometry::{Point3, Vector3};
use simworld_core::ops;

use super::measure::{Bulk, enclosed};

/// The most points of a hull: those that lie outermost in so many directions.
const DIRECTIONS: usize = 96;

/// The most voxels that are looked at for all triangles together; with more the grid is coarser.
const MOST_TESTS: f64 = 1e7;

/// A convex solid and what it encloses.
pub(super) struct Solid {
    pub(super) hull: Hull,
    pub(super) bulk: Bulk,
}

/// How fine a decomposition is to be.
#[derive(Clone, Copy)]
pub(super) struct Fineness {
    /// The most solids.
    pub(super) hulls: u32,
    /// Voxels along the longest side.
    pub(super) voxels: u32,
    /// What a closed surface encloses, m³, if it is closed: one hull does where it hardly holds more.
    pub(super) volume: Option<f64>,
}

/// Solids that cover a surface. Where it cannot be taken apart, one that holds all of it; none if it is flat.
pub(super) fn decompose(points: &[Point3], triangles: &[[u32; 3]], fineness: Fineness) -> Vec<Solid> {
    const NEARLY_ALL: f64 = 0.97;
    let vectors: Vec<Vector> = points.iter().map(|point| Vector::new(point.x, point.y, point.z)).collect();
    // parry answers a hull that it cannot find by a panic; what it may have left half done is dropped with it.
    let whole = catch_unwind(AssertUnwindSafe(|| solid(&vectors))).ok().flatten();
    let Some(whole) = whole else { return Vec::new() };
    // A tree of cuts has a power of two of leaves, and the decomposition goes one cut deeper than it is told.
    let leaves = 1 << fineness.hulls.max(1).ilog2();
    let is_convex = fineness.volume.is_some_and(|volume| volume > NEARLY_ALL * whole.bulk.volume);
    if is_convex || leaves < 4 {
        return vec![whole];
    }
    let parts = catch_unwind(AssertUnwindSafe(|| parts(&vectors, triangles, leaves / 2, fineness.voxels)))
        .unwrap_or_default();
    if parts.is_empty() { vec![whole] } else { parts }
}

fn parts(points: &[Vector], triangles: &[[u32; 3]], hulls: u32, voxels: u32) -> Vec<Solid> {
    let parameters = VHACDParameters {
        resolution: affordable(points, triangles, voxels),
        max_convex_hulls: hulls,
        concavity: 0.005,
        fill_mode: FillMode::FloodFill { detect_cavities: false },
        ..VHACDParameters::default()
    };
    let apart = VHACD::decompose(&parameters, points, triangles, true);
    apart
        .compute_exact_convex_hulls(points, triangles)
        .iter()
        .filter_map(|(points, _)| solid(points))
        .collect()
}

/// The fineness at which the boxes around all triangles have few enough voxels together.
fn affordable(points: &[Vector], triangles: &[[u32; 3]], wanted: u32) -> u32 {
    const COARSEST: u32 = 12;
    let Some(low) = points.iter().copied().reduce(Vector::min) else { return COARSEST };
    let high = points.iter().copied().fold(low, Vector::max);
    let longest = (high - low).max_element();
    let mut voxels = wanted;
    loop {
        let size = longest / f64::from(voxels);
        let tests: f64 = triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = triangle.map(|point| points[point as usize]);
                let box_around = (a.max(b).max(c) - a.min(b).min(c)) / size;
                (box_around.x + 2.0) * (box_around.y + 2.0) * (box_around.z + 2.0)
            })
            .sum();
        if tests <= MOST_TESTS || voxels <= COARSEST {
            return voxels;
        }
        voxels = (voxels * 3 / 4).max(COARSEST);
    }
}

/// The hull of points; none if they are flat.
fn solid(points: &[Vector]) -> Option<Solid> {
    let outer = outermost(points);
    let (corners, faces) = try_convex_hull(&outer).ok()?;
    let place = |corner: u32| {
        let corner = corners[corner as usize];
        Point3::new(corner.x, corner.y, corner.z)
    };
    let about = place(0);
    let bulk = enclosed(about, faces.iter().map(|face| face.map(place)));
    let high = corners.iter().copied().fold(corners[0], Vector::max);
    let low = corners.iter().copied().fold(corners[0], Vector::min);
    let size = high - low;
    // A solid has some of the volume of its box.
    let is_solid =
        corners.len() >= 4 && bulk.volume > 1e-6 * size.x * size.y * size.z && size.min_element() > 0.0;
    let mut points: Vec<[f32; 3]> =
        corners.iter().map(|corner| [corner.x as f32, corner.y as f32, corner.z as f32]).collect();
    // In whatever order a file has them.
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2])));
    is_solid.then_some(Solid { hull: Hull { points }, bulk })
}

/// The points that lie outermost in directions spread evenly over the sphere, each once.
fn outermost(points: &[Vector]) -> Vec<Vector> {
    let mut chosen: Vec<usize> = directions()
        .filter_map(|direction| {
            let along =
                |point: &Vector| direction.x * point.x + direction.y * point.y + direction.z * point.z;
            let farther = |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0));
            points.iter().map(along).enumerate().max_by(farther).map(|(index, _)| index)
        })
        .collect();
    chosen.sort_unstable();
    chosen.dedup();
    let mut outer: Vec<Vector> = chosen.into_iter().map(|index| points[index]).collect();
    outer.dedup();
    outer
}

/// The directions of axes and corners of a box, so that boxes keep theirs, and a spiral from pole to pole.
fn directions() -> impl Iterator<Item = Vector3> {
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    let signs = [-1.0, 1.0];
    let corners = signs.into_iter().flat_map(move |x| {
        signs.into_iter().flat_map(move |y| signs.into_iter().map(move |z| Vector3::new(x, y, z)))
    });
    let axes = (0..6).map(|which| Vector3::ith(which / 2, if which % 2 == 0 { 1.0 } else { -1.0 }));
    let rest = DIRECTIONS - 14;
    let spiral = (0..rest).map(move |step| {
        let height = 1.0 - (2.0 * step as f64 + 1.0) / rest as f64;
        let radius = (1.0 - height * height).sqrt();
        let (sine, cosine) = ops::sin_cos(GOLDEN_ANGLE * step as f64);
        Vector3::new(radius * cosine, radius * sine, height)
    });
    corners.chain(axes).chain(spiral)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANY: Fineness = Fineness { hulls: 32, voxels: 32, volume: None };

    fn boxes(boxes: &[([f64; 3], [f64; 3])]) -> (Vec<Point3>, Vec<[u32; 3]>) {
        let (mut points, mut triangles) = (Vec::new(), Vec::new());
        for (low, high) in boxes {
            let first = points.len() as u32;
            points.extend((0..8).map(|corner| {
                Point3::from(std::array::from_fn::<f64, 3, _>(|axis| {
                    if corner >> axis & 1 == 0 { low[axis] } else { high[axis] }
                }))
            }));
            for [a, b, c, d] in
                [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
            {
                triangles.extend([[a, b, c], [a, c, d]].map(|face| face.map(|corner| first + corner)));
            }
        }
        (points, triangles)
    }

    #[test]
    fn a_box_is_one_hull_of_eight_corners() {
        let (points, triangles) = boxes(&[([0.0, 0.0, 0.0], [2.0, 1.0, 0.5])]);
        let solids = decompose(&points, &triangles, Fineness { volume: Some(1.0), ..ANY });
        assert_eq!(solids.len(), 1);
        assert_eq!(solids[0].hull.points.len(), 8);
        assert!((solids[0].bulk.volume - 1.0).abs() < 1e-9);
        assert!((solids[0].bulk.center - Point3::new(1.0, 0.5, 0.25)).norm() < 1e-9);
    }

    #[test]
    fn a_table_is_taken_apart_and_stays_open_below() {
        let leg = |x: f64, y: f64| ([x, y, 0.0], [x + 0.1, y + 0.1, 0.7]);
        let (points, triangles) = boxes(&[
            ([0.0, 0.0, 0.7], [1.0, 1.0, 0.8]),
            leg(0.0, 0.0),
            leg(0.9, 0.0),
            leg(0.0, 0.9),
            leg(0.9, 0.9),
        ]);
        let solids = decompose(&points, &triangles, ANY);
        assert!((5..=32).contains(&solids.len()), "{} hulls", solids.len());
        for most in [1, 3, 4, 9] {
            let fewer = decompose(&points, &triangles, Fineness { hulls: most, ..ANY });
            assert!((1..=most as usize).contains(&fewer.len()), "{} of {most}", fewer.len());
        }
        let volume: f64 = solids.iter().map(|solid| solid.bulk.volume).sum();
        assert!((0.1..0.25).contains(&volume), "0.128 m³ and not {volume}");
        // The room below the top is free.
        let below = |solid: &Solid| {
            let range = |axis: usize| {
                let of = solid.hull.points.iter().map(|point| point[axis]);
                (of.clone().fold(f32::MAX, f32::min), of.fold(f32::MIN, f32::max))
            };
            (0..2).all(|axis| range(axis).0 < 0.4 && range(axis).1 > 0.6) && range(2).0 < 0.6
        };
        assert!(!solids.iter().any(below));
    }

    #[test]
    fn what_is_flat_has_no_hull() {
        let points: Vec<Point3> =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Point3::new(x, y, 0.0)).to_vec();
        assert!(decompose(&points, &[[0, 1, 2], [0, 2, 3]], ANY).is_empty());
        assert!(decompose(&points[..2], &[], ANY).is_empty());
        assert!(decompose(&[], &[], ANY).is_empty());
    }
}
