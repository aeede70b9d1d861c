//! The order of surfaces that lie over one another in one plane, as the carriageways of a junction do.
//!
//! Each has a layer, another one than all of its kind that it overlaps: of two the one of the lower layer is seen, in every
//! picture and by every backend. Layers follow from the surfaces and their slots alone, not from what came before.

use simworld_core::geometry::Obb;

use crate::mesh::Drawn;

/// Width of the cells in which overlaps are looked for, m.
const CELL: f64 = 64.0;
/// Who covers more cells is compared with everybody.
const MOST_CELLS: f64 = 1024.0;
/// There are no more layers; surfaces beyond share the last.
const LAST: u8 = 20;

/// A flat surface.
pub(super) struct Surface {
    pub mesh: Drawn,
    pub solid: Obb,
}

/// The layers of surfaces that come by ascending slot: the lowest that no earlier one has which it overlaps.
pub(super) fn layers_of(surfaces: &[Surface]) -> Vec<u8> {
    let mut layers = vec![0_u8; surfaces.len()];
    let mut overlaps = overlaps(surfaces).into_iter().peekable();
    let mut taken: Vec<u8> = Vec::new();
    for later in 0..surfaces.len() as u32 {
        taken.clear();
        while let Some((_, earlier)) = overlaps.next_if(|pair| pair.0 == later) {
            taken.push(layers[earlier as usize]);
        }
        layers[later as usize] = (0..LAST).find(|layer| !taken.contains(layer)).unwrap_or(LAST);
    }
    layers
}

/// Pairs that overlap, the later one first, ascending.
fn overlaps(surfaces: &[Surface]) -> Vec<(u32, u32)> {
    let mut cells: Vec<(i64, i64, u32)> = Vec::new();
    let mut wide: Vec<u32> = Vec::new();
    for (number, surface) in (0..).zip(surfaces) {
        let bounds = surface.solid.aabb();
        let index = |coordinate: f64| (coordinate / CELL).floor() as i64;
        let (x, y) = ((index(bounds.min.x), index(bounds.max.x)), (index(bounds.min.y), index(bounds.max.y)));
        if ((x.1 - x.0 + 1) as f64) * ((y.1 - y.0 + 1) as f64) > MOST_CELLS {
            wide.push(number);
            continue;
        }
        cells.extend((x.0..=x.1).flat_map(|i| (y.0..=y.1).map(move |j| (i, j, number))));
    }
    cells.sort_unstable();
    let mut pairs = Vec::new();
    let mut note = |a: u32, b: u32| {
        let (one, other) = (&surfaces[a as usize], &surfaces[b as usize]);
        if a != b && one.mesh == other.mesh && one.solid.footprints_overlap(&other.solid) {
            pairs.push((a.max(b), a.min(b)));
        }
    };
    for cell in cells.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        for (rank, (.., a)) in cell.iter().enumerate() {
            cell[..rank].iter().for_each(|(.., b)| note(*a, *b));
        }
    }
    for a in wide {
        (0..surfaces.len() as u32).for_each(|b| note(a, b));
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use simworld_core::geometry::{Point3, Vector3, pose_facing};

    use super::*;
    use crate::mesh::MeshId;

    fn surface(x: f64, y: f64, yaw: f64, length: f64) -> Surface {
        let pose = pose_facing(Point3::new(x, y, 0.0), yaw);
        Surface {
            mesh: Drawn::Own(MeshId::Road),
            solid: Obb { pose, half_extents: Vector3::new(length, 4.0, 0.03) },
        }
    }

    proptest! {
        /// However they lie, also where one is as wide as a country.
        #[test]
        fn no_two_of_a_layer_overlap(
            places in prop::collection::vec((-300.0..300.0_f64, -300.0..300.0_f64, 0.0..6.3_f64, 5.0..150.0_f64), 1..30),
            wide in any::<bool>(),
        ) {
            let mut surfaces: Vec<Surface> =
                places.into_iter().map(|(x, y, yaw, length)| surface(x, y, yaw, length)).collect();
            if wide {
                surfaces.push(surface(0.0, 0.0, 0.4, 1e5));
            }
            let layers = layers_of(&surfaces);
            for (i, a) in surfaces.iter().enumerate() {
                for (j, b) in surfaces.iter().enumerate().take(i) {
                    prop_assert!(!a.solid.footprints_overlap(&b.solid) || layers[i] != layers[j], "{i} and {j}");
                }
            }
        }
    }

    #[test]
    fn what_lies_alone_is_on_top() {
        let alone: Vec<Surface> = (0..5).map(|k| surface(f64::from(k) * 50.0, 0.0, 0.0, 20.0)).collect();
        assert_eq!(layers_of(&alone), [0; 5]);
        let mut other = vec![surface(0.0, 0.0, 0.0, 20.0), surface(0.0, 0.0, 0.0, 20.0)];
        assert_eq!(layers_of(&other), [0, 1]);
        other[1].mesh = Drawn::Own(MeshId::Sidewalk);
        assert_eq!(layers_of(&other), [0, 0], "of another kind, and so at another height");
    }
}
