//! One drawn thing as the shaders read it.

use bytemuck::{Pod, Zeroable};
use nalgebra::{Quaternion, UnitQuaternion};
use simworld_core::geometry::{Obb, Pose, Vector3};
use simworld_core::id::EntityId;

use crate::look::Look;
use crate::mesh::{Drawn, MeshId};

/// Slots that fit beside the class in [`Instance::who`].
pub(crate) const MOST_SLOTS: usize = (1 << 24) - 1;

/// Layers of what is painted on surfaces, which lies over them; see `mark_layer` in shaders/surfaces.wgsl.
const PAINT_LAYERS: u8 = 3;

/// A mesh at a place: vertex = anchor * scale + offset * unit, turned and moved; the twin of `Instance` in shaders/globals.wgsl.
///
/// The place is in the world, as a float and what that float leaves over, so that what stands still stays on the device wherever
/// the eye goes: the difference to the eye, taken part by part, is exact to a float.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Instance {
    /// World from body, quaternion (i, j, k, w).
    rotation: [f32; 4],
    /// The body's origin, m, and the unit of offsets.
    place: [f32; 4],
    /// What the float of the place leaves over, m.
    rest: [f32; 3],
    /// Slot of the entity plus one, and its class from bit 24 on.
    who: u32,
    /// The body's box and the seed of its variation.
    scale: [f32; 4],
    /// Colour and state.
    color: [f32; 4],
    /// Second colour and parameter.
    second: [f32; 4],
}

impl Instance {
    pub(crate) fn new(pose: &Pose, look: &Look, id: EntityId, class: u8) -> Self {
        let with = |[x, y, z]: [f32; 3], w: f32| [x, y, z, w];
        let (place, rest) = split(&pose.translation.vector);
        Self {
            rotation: pose.rotation.coords.map(|component| component as f32).into(),
            place: with(place, look.unit),
            rest,
            who: (id.index() as u32 + 1) & 0x00ff_ffff | u32::from(class) << 24,
            scale: with(look.scale, look.seed),
            color: with(look.color, look.state),
            second: with(look.second, look.param),
        }
    }

    /// Where it is in the world.
    pub(crate) fn place(&self) -> Vector3 {
        Vector3::from_fn(|axis, _| f64::from(self.place[axis]) + f64::from(self.rest[axis]))
    }

    /// World from body.
    pub(crate) fn turn(&self) -> UnitQuaternion<f64> {
        let [i, j, k, w] = self.rotation.map(f64::from);
        UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k))
    }

    /// The body's box; like that of core it is told by its middle.
    pub(crate) fn solid(&self) -> Obb {
        let ([x, y, z], _) = self.measure();
        let half_extents = Vector3::new(f64::from(x), f64::from(y), f64::from(z)) * 0.5;
        let middle = self.place() + self.turn() * Vector3::new(0.0, 0.0, half_extents.z);
        Obb { pose: Pose::from_parts(middle.into(), self.turn()), half_extents }
    }

    /// Puts a surface into a layer below what is painted on it. As its parameter is none of its look, that is less than zero:
    /// the layer, negated.
    pub(crate) fn put_in_layer(&mut self, layer: u8) {
        self.second[3] = -f32::from(PAINT_LAYERS + layer);
    }

    /// The layer in which a part lies among those in its plane, with the mesh that it has; 0, the uppermost, of what is no surface.
    pub(crate) fn layer(&self, mesh: Drawn) -> u32 {
        if mesh == Drawn::Own(MeshId::Mark) {
            return crate::look::mark_layer(self.color[3]);
        }
        (-self.second[3]).max(0.0) as u32
    }

    /// Where a point of the body is in the world.
    pub(crate) fn at(&self, body: &Vector3) -> Vector3 {
        self.place() + self.turn() * body
    }

    /// The body's box, and the unit of offsets.
    pub(crate) const fn measure(&self) -> ([f32; 3], f32) {
        let [x, y, z, _] = self.scale;
        ([x, y, z], self.place[3])
    }
}

/// A place as a float and what that float leaves over.
pub(crate) fn split(place: &Vector3) -> ([f32; 3], [f32; 3]) {
    let high = [place.x, place.y, place.z].map(|coordinate| coordinate as f32);
    let low = std::array::from_fn(|axis| (place[axis] - f64::from(high[axis])) as f32);
    (high, low)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The difference of two places is exact to a float, 13 000 km from the origin.
    #[test]
    fn nearby_places_differ_exactly() {
        let eye = Vector3::new(1.2e7 + 0.123_456, -8.0e6 + 0.001, 1.7);
        let shift = Vector3::new(3.000_07, -0.25, 12.125_01);
        let ((eye_high, eye_low), (high, low)) = (split(&eye), split(&(eye + shift)));
        for axis in 0..3 {
            let apart = (high[axis] - eye_high[axis]) + (low[axis] - eye_low[axis]);
            assert!((f64::from(apart) - shift[axis]).abs() < 4e-7 * shift[axis].abs().max(1.0), "{apart}");
        }
    }
}
