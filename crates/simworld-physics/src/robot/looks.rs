//! What is drawn of a robot, link by link: what is seen of each, or else its solids.

use std::sync::Arc;

use simworld_core::asset::Model;
use simworld_core::geometry::{Pose, Vector3};
use simworld_core::id::EntityId;
use simworld_core::links::LinkForm;
use simworld_core::scene::{Shape, World, WorldError};

use super::description::{Form, LinkSolid, RobotDescription};
use super::solids::surface;
use super::tree::Tree;
use super::visual::{LEAST, LinkVisual, VisualForm, size_of};

/// What is drawn of a robot as core has it, and where it is.
#[derive(Clone, Debug)]
pub(super) struct Looks {
    forms: Arc<[LinkForm]>,
    /// For each, the part that it belongs to, and where it stands in that.
    places: Vec<(usize, Pose)>,
    /// Entity from what is drawn, as of the last step.
    poses: Vec<Pose>,
}

impl Looks {
    pub(super) fn of(description: &RobotDescription, tree: &Tree) -> Self {
        let (mut forms, mut places) = (Vec::new(), Vec::new());
        let mut add =
            |number: usize, Drawn { shape, model, form_from_shape }: Drawn, part_from_form: &Pose, color| {
                forms.push(LinkForm { shape, model, color });
                places.push((number, part_from_form * form_from_shape));
            };
        for (number, part) in tree.parts.iter().enumerate() {
            for (link, place, part_from_solid) in &part.solids {
                let link = &description.links[*link];
                if link.visuals.is_empty() {
                    let LinkSolid { form, color, .. } = &link.solids[*place];
                    add(number, drawn(form), part_from_solid, *color);
                }
            }
            for (link, place, part_from_visual) in &part.visuals {
                let LinkVisual { form, color, .. } = &description.links[*link].visuals[*place];
                let drawn = match form {
                    VisualForm::Solid(form) => drawn(form),
                    VisualForm::Model(model) => Drawn::model(Arc::clone(model), Pose::identity()),
                };
                add(number, drawn, part_from_visual, *color);
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

/// Something as core draws it.
struct Drawn {
    shape: Shape,
    model: Option<Arc<Model>>,
    /// Core's solids stand on their origin, and forms have theirs in the middle.
    form_from_shape: Pose,
}

impl Drawn {
    /// A solid as high as that.
    fn solid(shape: Shape, height: f64) -> Self {
        Self { shape, model: None, form_from_shape: Pose::translation(0.0, 0.0, -0.5 * height) }
    }

    /// A model where its own origin is.
    fn model(model: Arc<Model>, form_from_shape: Pose) -> Self {
        Self { shape: Shape::Box { size: size_of(&model) }, model: Some(model), form_from_shape }
    }
}

fn drawn(form: &Form) -> Drawn {
    match *form {
        Form::Box { size } => {
            let size = size.map(|edge| edge.max(LEAST));
            Drawn::solid(Shape::Box { size }, size.z)
        }
        Form::Cylinder { radius, length } => {
            let (radius, height) = (radius.max(LEAST), length.max(LEAST));
            Drawn::solid(Shape::Cylinder { radius, height }, height)
        }
        Form::Sphere { radius } => {
            let radius = radius.max(LEAST);
            Drawn::solid(Shape::Sphere { radius }, 2.0 * radius)
        }
        Form::Capsule { radius, length } => {
            let radius = radius.max(LEAST);
            let height = length + 2.0 * radius;
            Drawn::solid(Shape::Capsule { radius, height }, height)
        }
        Form::Convex { ref points } => match surface(form).and_then(|surface| surface.model()) {
            Some((model, at)) => Drawn::model(Arc::new(model), Pose::translation(at.x, at.y, at.z)),
            None => boxed(points),
        },
    }
}

/// The box around points: a solid so thin that its faces have no area is drawn as that.
fn boxed(points: &[Vector3]) -> Drawn {
    let first = points.first().copied().unwrap_or_default();
    let (low, high) =
        points.iter().fold((first, first), |(low, high), point| (low.inf(point), high.sup(point)));
    let (size, middle) = ((high - low).map(|edge| edge.max(LEAST)), (low + high) * 0.5);
    let form_from_shape = Pose::translation(middle.x, middle.y, middle.z - 0.5 * size.z);
    Drawn { shape: Shape::Box { size }, model: None, form_from_shape }
}
