//! What is drawn of a robot: its solids, link by link.

use std::sync::Arc;

use simworld_core::geometry::{Pose, Vector3};
use simworld_core::id::EntityId;
use simworld_core::links::LinkForm;
use simworld_core::scene::{Shape, World, WorldError};

use super::description::{Form, LinkSolid, RobotDescription};
use super::tree::Tree;

/// Nothing thinner than this is drawn, m: core takes no smaller solids.
const LEAST: f64 = 1e-3;

/// The solids of a robot as core has them, and where they are.
#[derive(Clone, Debug)]
pub(super) struct Looks {
    forms: Arc<[LinkForm]>,
    /// For each, the part that it belongs to, and where it stands in that.
    places: Vec<(usize, Pose)>,
    /// Entity from solid, as of the last step.
    poses: Vec<Pose>,
}

impl Looks {
    pub(super) fn of(description: &RobotDescription, tree: &Tree) -> Self {
        let (mut forms, mut places) = (Vec::new(), Vec::new());
        for (number, part) in tree.parts.iter().enumerate() {
            for (link, place, part_from_solid) in &part.solids {
                let LinkSolid { form, color, .. } = &description.links[*link].solids[*place];
                let (shape, solid_from_shape) = drawn(form);
                forms.push(LinkForm { shape, color: *color });
                places.push((number, part_from_solid * solid_from_shape));
            }
        }
        let poses = vec![Pose::identity(); places.len()];
        Self { forms: forms.into(), places, poses }
    }

    /// Takes in where the parts are.
    pub(super) fn follow(&mut self, entity_from_frame: &Pose, frame_from_parts: &[Pose]) {
        for (pose, (part, part_from_shape)) in self.poses.iter_mut().zip(&self.places) {
            if let Some(frame_from_part) = frame_from_parts.get(*part) {
                *pose = entity_from_frame * frame_from_part * part_from_shape;
            }
        }
    }

    /// Says so in the world; of a robot without solids there is nothing to say, and its entity is drawn as before.
    pub(super) fn tell(&self, id: EntityId, world: &mut World) -> Result<(), WorldError> {
        if self.forms.is_empty() { Ok(()) } else { world.set_links(id, &self.forms, &self.poses) }
    }
}

/// The solid of a form, and where it stands in the form's frame: core's solids stand on their origin. What is convex and no more is
/// drawn as the box around it along the axes of its frame.
fn drawn(form: &Form) -> (Shape, Pose) {
    let upright = |height: f64| Pose::translation(0.0, 0.0, -0.5 * height);
    match *form {
        Form::Box { size } => {
            let size = size.map(|edge| edge.max(LEAST));
            (Shape::Box { size }, upright(size.z))
        }
        Form::Cylinder { radius, length } => {
            let (radius, height) = (radius.max(LEAST), length.max(LEAST));
            (Shape::Cylinder { radius, height }, upright(height))
        }
        Form::Sphere { radius } => {
            let radius = radius.max(LEAST);
            (Shape::Sphere { radius }, upright(2.0 * radius))
        }
        Form::Capsule { radius, length } => {
            let radius = radius.max(LEAST);
            let height = length + 2.0 * radius;
            (Shape::Capsule { radius, height }, upright(height))
        }
        Form::Convex { ref points } => {
            let first = points.first().copied().unwrap_or_default();
            let around = |least: fn(f64, f64) -> f64| {
                points.iter().fold(first, |corner, point| corner.zip_map(point, least))
            };
            let (low, high) = (around(f64::min), around(f64::max));
            let size: Vector3 = (high - low).map(|edge| edge.max(LEAST));
            let middle = (low + high) * 0.5;
            (Shape::Box { size }, Pose::translation(middle.x, middle.y, middle.z) * upright(size.z))
        }
    }
}
