//! Normals where a file has none: smooth over gentle bends, sharp over edges.

use simworld_core::geometry::Vector3;

use crate::assets::surface::Surface;

/// Triangles whose normals are less than 40° apart share theirs: the cosine.
const GENTLE: f64 = 0.766;

/// At points of more triangles each has its own normal, for all of them would have to be compared with all.
const MOST_AROUND: usize = 64;

/// Gives each corner the mean normal of the triangles around its point that bend gently from its own, by area. Points are
/// doubled where their triangles disagree.
pub(super) fn smooth(surface: &mut Surface) {
    let faces: Vec<Vector3> = surface.triangles.iter().map(|triangle| surface.cross(*triangle)).collect();
    let flat = |face: usize| faces[face].try_normalize(0.0).unwrap_or_else(Vector3::z);
    // Corners at one place, whatever point they belong to.
    let key = |corner: u32| {
        let point = surface.triangles[corner as usize / 3][corner as usize % 3];
        surface.points[point as usize].coords.map(f64::to_bits)
    };
    let mut order: Vec<(nalgebra::Vector3<u64>, u32)> =
        (0..surface.triangles.len() as u32 * 3).map(|corner| (key(corner), corner)).collect();
    order.sort_unstable_by_key(|(place, corner)| ([place.x, place.y, place.z], *corner));
    let mut normals = vec![Vector3::zeros(); surface.triangles.len() * 3];
    for around in order.chunk_by(|a, b| a.0 == b.0) {
        for (_, corner) in around {
            let own = flat(*corner as usize / 3);
            let mean: Vector3 = if around.len() > MOST_AROUND {
                own
            } else {
                let others = around.iter().map(|(_, other)| *other as usize / 3);
                others.filter(|other| flat(*other).dot(&own) > GENTLE).map(|other| faces[other]).sum()
            };
            normals[*corner as usize] = mean.try_normalize(0.0).unwrap_or(own);
        }
    }
    share(surface, &normals);
}

/// A point for each point and normal.
fn share(surface: &mut Surface, normals: &[Vector3]) {
    let point = |corner: u32| surface.triangles[corner as usize / 3][corner as usize % 3];
    let bits = |corner: u32| {
        let normal = normals[corner as usize];
        (point(corner), normal.x.to_bits(), normal.y.to_bits(), normal.z.to_bits())
    };
    let mut order: Vec<u32> = (0..normals.len() as u32).collect();
    order.sort_unstable_by_key(|corner| (bits(*corner), *corner));
    let (mut former, mut kept) = (Vec::new(), Vec::new());
    let mut corners = vec![0u32; normals.len()];
    for same in order.chunk_by(|a, b| bits(*a) == bits(*b)) {
        for corner in same {
            corners[*corner as usize] = former.len() as u32;
        }
        former.push(point(same[0]) as usize);
        kept.push(normals[same[0] as usize]);
    }
    surface.triangles = corners.as_chunks::<3>().0.to_vec();
    surface.points = former.iter().map(|point| surface.points[*point]).collect();
    surface.colors = former.iter().map(|point| surface.colors[*point]).collect();
    surface.places = former.iter().map(|point| surface.places[*point]).collect();
    surface.alphas = former.iter().map(|point| surface.alphas[*point]).collect();
    surface.pick_rig(&former);
    // Those of the file stood beside normals that are no more.
    surface.tangents = vec![[0.0; 4]; former.len()];
    surface.normals = kept;
}
