//! From a scene to instances: what the camera may see, in camera-relative coordinates.

use std::ops::ControlFlow;

use bytemuck::{Pod, Zeroable};
use simworld_core::camera::Camera;
use simworld_core::geometry::{Aabb, Point3, Vector3};
use simworld_core::scene::{EntityKind, EntityRef, Scene, Shape};

use crate::classes::class_of;
use crate::mesh::MeshKind;

/// One drawn entity, as the shader reads it.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Instance {
    /// Columns of the rotation, scaled by the size; then the position relative to the camera, m.
    pub(crate) x: [f32; 3],
    pub(crate) y: [f32; 3],
    pub(crate) z: [f32; 3],
    pub(crate) origin: [f32; 3],
    pub(crate) size: [f32; 3],
    pub(crate) color: [f32; 3],
    /// Slot of the entity plus one.
    pub(crate) id: u32,
    pub(crate) class: u32,
    /// The look: see the shader.
    pub(crate) look: u32,
}

/// Instances in the order of their meshes.
#[derive(Debug, Default)]
pub(crate) struct Gathered {
    buckets: [Vec<Instance>; MeshKind::ALL.len()],
    pub(crate) instances: Vec<Instance>,
    /// The range of each mesh's instances.
    pub(crate) ranges: [std::ops::Range<u32>; MeshKind::ALL.len()],
}

/// What the camera sees at most.
struct View {
    eye: Point3,
    forward: Vector3,
    right: Vector3,
    down: Vector3,
    /// Tangents of the half angles to the outermost edges.
    half_x: f64,
    half_y: f64,
    far: f64,
    /// Half extent per distance below which an entity covers less than half a pixel.
    smallest: f64,
}

impl View {
    fn of(camera: &Camera, far: f64) -> Self {
        let k = &camera.intrinsics;
        let axis = |axis: Vector3| camera.world_from_optical * axis;
        Self {
            eye: camera.world_from_optical.translation.vector.into(),
            forward: axis(Vector3::z()),
            right: axis(Vector3::x()),
            down: axis(Vector3::y()),
            half_x: k.cx.max(f64::from(k.width) - k.cx) / k.fx,
            half_y: k.cy.max(f64::from(k.height) - k.cy) / k.fy,
            far,
            smallest: 0.25 / k.fx.max(k.fy),
        }
    }

    /// Whether a ball may be in the picture; shadows of what is outside are given up.
    fn sees(&self, center: &Point3, radius: f64) -> bool {
        let offset = center - self.eye;
        let depth = offset.dot(&self.forward);
        let within = |across: f64, half: f64| {
            across.abs() - radius * (1.0 + half * half).sqrt() <= depth.max(0.0) * half + radius
        };
        depth > -radius
            && depth - radius < self.far
            && radius > self.smallest * depth
            && within(offset.dot(&self.right), self.half_x)
            && within(offset.dot(&self.down), self.half_y)
    }
}

impl Gathered {
    pub(crate) fn gather(&mut self, scene: &dyn Scene, camera: &Camera, far: f64, shadow_reach: f64) {
        for bucket in &mut self.buckets {
            bucket.clear();
        }
        let view = View::of(camera, far);
        let _ = scene.visit(&Aabb::around(view.eye, Vector3::repeat(far)), &mut |entity| {
            let reach = entity.bounds.half_extents().norm() + crown(entity.kind);
            let center = entity.bounds.center();
            // Near the camera everything is kept, because it may throw a shadow into the picture.
            if view.sees(&center, reach) || (center - view.eye).norm() < shadow_reach + reach {
                let (mesh, instance) = instance(&entity, &view.eye);
                self.buckets[mesh as usize].push(instance);
            }
            ControlFlow::Continue(())
        });
        self.instances.clear();
        for (range, bucket) in self.ranges.iter_mut().zip(&self.buckets) {
            let start = self.instances.len() as u32;
            self.instances.extend_from_slice(bucket);
            *range = start..self.instances.len() as u32;
        }
    }
}

/// How far a mesh reaches beyond the entity's solid, m.
const fn crown(kind: EntityKind) -> f64 {
    match kind {
        EntityKind::Tree => 3.0,
        EntityKind::StreetLamp => 1.0,
        _ => 0.0,
    }
}

fn instance(entity: &EntityRef<'_>, eye: &Point3) -> (MeshKind, Instance) {
    let solid = match entity.info.shape {
        Shape::Cylinder { .. } | Shape::Capsule { .. } => MeshKind::Cylinder,
        Shape::Sphere { .. } => MeshKind::Sphere,
        _ => MeshKind::Box,
    };
    let size = entity.info.shape.size();
    let rotation = entity.pose.rotation.to_rotation_matrix();
    let scaled = |axis: usize| {
        let column = rotation.matrix().column(axis) * size[axis];
        [column[0] as f32, column[1] as f32, column[2] as f32]
    };
    // Subtracted in f64, so that a city far from the origin looks as one at it.
    let origin = entity.position() - eye;
    let instance = Instance {
        x: scaled(0),
        y: scaled(1),
        z: scaled(2),
        origin: [origin.x as f32, origin.y as f32, origin.z as f32],
        size: [size.x as f32, size.y as f32, size.z as f32],
        color: color_of(entity),
        id: entity.id.index() as u32 + 1,
        class: u32::from(class_of(entity.kind)),
        look: look_of(entity.kind),
    };
    (MeshKind::of(entity.kind).unwrap_or(solid), instance)
}

/// Which pattern the shader draws: 1 façade, 2 road, 3 crosswalk, 4 paving, 5 grass.
const fn look_of(kind: EntityKind) -> u32 {
    match kind {
        EntityKind::Building => 1,
        EntityKind::Road => 2,
        EntityKind::Crosswalk => 3,
        EntityKind::Sidewalk => 4,
        EntityKind::Ground => 5,
        _ => 0,
    }
}

/// The entity's colour, or that of its kind, varied a little from one to the next; linear light.
fn color_of(entity: &EntityRef<'_>) -> [f32; 3] {
    let base = entity.info.color.unwrap_or(match entity.kind {
        EntityKind::Ground => [0.13, 0.17, 0.07],
        EntityKind::Road | EntityKind::Crosswalk => [0.075, 0.077, 0.082],
        EntityKind::Sidewalk => [0.32, 0.31, 0.29],
        EntityKind::Building => [0.5, 0.42, 0.34],
        EntityKind::Tree | EntityKind::Shrub => [0.07, 0.17, 0.04],
        EntityKind::Bench | EntityKind::Chair | EntityKind::Table => [0.25, 0.14, 0.06],
        EntityKind::Hydrant | EntityKind::Mailbox => [0.5, 0.03, 0.03],
        EntityKind::TrashBin => [0.05, 0.09, 0.06],
        EntityKind::Cone => [0.75, 0.2, 0.02],
        EntityKind::Parcel => [0.42, 0.27, 0.13],
        EntityKind::Scooter => [0.08, 0.45, 0.5],
        _ => [0.3, 0.3, 0.32],
    });
    if matches!(entity.kind, EntityKind::Road | EntityKind::Crosswalk | EntityKind::Sidewalk | EntityKind::Ground) {
        return base;
    }
    let mixed = (entity.id.index() as u32).wrapping_mul(0x9E37_79B9);
    let shade = 0.85 + 0.3 * (mixed >> 16) as f32 / 65_535.0;
    base.map(|channel| channel * shade)
}
