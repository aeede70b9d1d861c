//! From a scene to sorted instances: cull, dress, order by mesh.

use std::ops::{ControlFlow, Range};

use bytemuck::{Pod, Zeroable};
use simworld_core::geometry::{Aabb, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, Scene};

use crate::classes::class_of;
use crate::look::{Look, Looks};
use crate::mesh::Drawn;
use crate::models::model_of;
use crate::shadow::ShadowView;
use crate::view::View;

/// The farthest that a silhouette reaches beyond the bounds of its entity, m.
const OVERHANG: f64 = 8.0;

/// One entity as the shaders read it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Instance {
    /// World from body, quaternion (i, j, k, w).
    rotation: [f32; 4],
    /// From the eye to the body's origin, m, and the unit of offsets.
    translation: [f32; 4],
    /// The body's box and the seed of its variation.
    scale: [f32; 4],
    /// Colour and state.
    color: [f32; 4],
    /// Second colour and parameter.
    second: [f32; 4],
}

impl Instance {
    fn new(entity: &EntityRef<'_>, relative: &Vector3, look: &Look) -> Self {
        let with = |[x, y, z]: [f32; 3], w: f32| [x, y, z, w];
        Self {
            rotation: entity.pose.rotation.coords.map(|component| component as f32).into(),
            translation: [relative.x as f32, relative.y as f32, relative.z as f32, look.unit],
            scale: with(look.scale, look.seed),
            color: with(look.color, look.state),
            second: with(look.second, look.param),
        }
    }
}

/// A run of instances of one mesh.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Batch {
    pub mesh: Drawn,
    pub instances: Range<u32>,
}

/// One instance to sort: mesh, then rank, then position among the found.
type Entry = (Drawn, u32, u32);

/// Instances in the order in which they are drawn, first those on the picture, then those that cast shadows.
#[derive(Default)]
pub(crate) struct DrawList {
    pub instances: Vec<Instance>,
    /// Entity and class of the instances on the picture.
    pub entities: Vec<(EntityId, u8)>,
    pub visible: Vec<Batch>,
    pub casters: Vec<Batch>,
    found: Vec<(Drawn, Instance, EntityId, u8)>,
    seen: Vec<Entry>,
    shading: Vec<Entry>,
}

impl DrawList {
    /// Gathers what the view sees and what throws shadows on it; `hidden` is left out of the picture.
    pub(crate) fn gather(
        &mut self,
        scene: &dyn Scene,
        view: &View,
        shadow: Option<&ShadowView>,
        min_pixels: f64,
        hidden: Option<EntityId>,
    ) {
        self.found.clear();
        self.seen.clear();
        self.shading.clear();
        let looks = Looks::new();
        let signals = scene.signals();
        let region = shadow.map_or_else(|| view.region(), |shadow| view.region().union(&shadow.region()));
        let _ = scene.visit(&region.inflated(OVERHANG), &mut |entity| {
            if entity.is_visible() {
                let look_of = |entity: &EntityRef<'_>| match entity.info.asset {
                    Some(id) if model_of(scene, id).is_some() => (Drawn::Model(id), looks.of_model(entity)),
                    _ => {
                        let look = looks.of(entity, signals);
                        (Drawn::Own(look.mesh), look)
                    }
                };
                self.consider(&entity, view, shadow, min_pixels, hidden, look_of);
            }
            ControlFlow::Continue(())
        });
        self.arrange();
    }

    fn consider(
        &mut self,
        entity: &EntityRef<'_>,
        view: &View,
        shadow: Option<&ShadowView>,
        min_pixels: f64,
        hidden: Option<EntityId>,
        look_of: impl Fn(&EntityRef<'_>) -> (Drawn, Look),
    ) {
        // The ball around the bounds may miss what overhangs them, so it is tested with the most first.
        let (center, radius) = ball(entity.bounds, view);
        let roughly = radius + OVERHANG;
        let shades = |radius: f64| shadow.is_some_and(|shadow| shadow.reaches(&center, radius));
        let hidden = hidden == Some(entity.id);
        if !(view.sees(&center, roughly, min_pixels) && !hidden || shades(roughly)) {
            return;
        }
        let (mesh, look) = look_of(entity);
        let radius = radius + look.reach;
        let seen = !hidden && view.sees(&center, radius, min_pixels);
        let shading = casts(entity.kind) && shades(radius);
        if !seen && !shading {
            return;
        }
        let index = self.found.len() as u32;
        let relative = entity.position() - view.eye;
        let instance = Instance::new(entity, &relative, &look);
        self.found.push((mesh, instance, entity.id, class_of(entity.kind)));
        if seen {
            self.seen.push((mesh, rank(mesh, &center), index));
        }
        if shading {
            self.shading.push((mesh, 0, index));
        }
    }

    /// Sorts by mesh and rank, in the order of the visit within a rank.
    fn arrange(&mut self) {
        self.seen.sort_unstable();
        self.shading.sort_unstable();
        self.instances.clear();
        self.entities.clear();
        batch(&mut self.visible, &self.seen, 0);
        batch(&mut self.casters, &self.shading, self.seen.len() as u32);
        for (_, _, index) in &self.seen {
            let (_, instance, id, class) = self.found[*index as usize];
            self.instances.push(instance);
            self.entities.push((id, class));
        }
        self.instances.extend(self.shading.iter().map(|(_, _, index)| self.found[*index as usize].1));
    }
}

fn batch(batches: &mut Vec<Batch>, sorted: &[Entry], first: u32) {
    batches.clear();
    for (position, (mesh, ..)) in (first..).zip(sorted) {
        match batches.last_mut() {
            Some(last) if last.mesh == *mesh => last.instances.end = position + 1,
            _ => batches.push(Batch { mesh: *mesh, instances: position..position + 1 }),
        }
    }
}

/// Near ones first, so that what they hide is not shaded; flat surfaces keep the order of the visit, because where two
/// lie in one plane the first is seen, and that must not change with the camera.
fn rank(mesh: Drawn, center: &Vector3) -> u32 {
    // The bits of positive floats sort as the floats do.
    if mesh.pattern().is_flat() { 0 } else { (center.norm_squared() as f32).to_bits() }
}

/// The ball around a box; its centre is relative to the eye.
fn ball(bounds: &Aabb, view: &View) -> (Vector3, f64) {
    (bounds.center() - view.eye, bounds.half_extents().norm())
}

/// Whether it throws a shadow that one would miss; surfaces lie flat.
fn casts(kind: EntityKind) -> bool {
    !matches!(kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk)
}
