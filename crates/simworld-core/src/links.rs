//! What of an entity moves for itself: rigid solids, for whoever draws it. An arm of a robot, a boom, a rotor.
//!
//! Whoever moves such an entity gives its links out by [`World::set_links`](crate::scene::World::set_links), once a step; readers ask
//! [`Scene::links`](crate::scene::Scene::links). They follow from what else is known and are no part of what is saved. Who has links
//! is drawn as these, and no longer as the shape of its entity.

use std::sync::Arc;

use crate::asset::Model;
use crate::geometry::{Pose, Vector3};
use crate::scene::Shape;

/// What one link looks like, which never changes.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkForm {
    /// Its solid, standing on its origin as those of entities do.
    pub shape: Shape,
    /// The surface that is drawn in place of the solid, if there is one. It fills the box of the solid, as a model does that of its
    /// asset's collider; nobody meets it, so that it needs no hulls. Links that share one cost its memory once.
    pub model: Option<Arc<Model>>,
    /// Its colour, linear-light sRGB primaries in [0, 1]; without one it has that of the entity.
    pub color: Option<[f32; 3]>,
}

impl LinkForm {
    /// A link that is drawn as its solid.
    pub const fn solid(shape: Shape, color: Option<[f32; 3]>) -> Self {
        Self { shape, model: None, color }
    }
}

/// The links of an entity as they are.
#[derive(Clone, Copy, Debug)]
pub struct Links<'a> {
    forms: &'a [LinkForm],
    poses: &'a [Pose],
}

impl<'a> Links<'a> {
    /// Forms and, for each, entity from link; beyond the shorter of both lists there is nothing.
    pub fn new(forms: &'a [LinkForm], poses: &'a [Pose]) -> Self {
        Self { forms, poses }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.forms.len().min(self.poses.len())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Each with entity from link.
    pub fn iter(&self) -> impl Iterator<Item = (&'a LinkForm, &'a Pose)> + use<'a> {
        self.forms.iter().zip(self.poses)
    }

    /// The radius of a ball around the origin of the entity that holds all of them, m.
    pub fn radius(&self) -> f64 {
        let reach = |(form, pose): (&LinkForm, &Pose)| {
            let size = form.shape.size();
            let middle = pose * nalgebra::Point3::from(Vector3::new(0.0, 0.0, 0.5 * size.z));
            middle.coords.norm() + 0.5 * size.norm()
        };
        self.iter().map(reach).fold(0.0, f64::max)
    }
}

/// The links of an entity as the world keeps them.
#[derive(Clone, Debug)]
pub(crate) struct KeptLinks {
    pub(crate) forms: Arc<[LinkForm]>,
    pub(crate) poses: Vec<Pose>,
}

impl KeptLinks {
    pub(crate) fn view(&self) -> Links<'_> {
        Links::new(&self.forms, &self.poses)
    }
}
