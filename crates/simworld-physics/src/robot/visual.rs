//! What is seen of a link: forms and models. Nothing of it is met.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use simworld_core::asset::Model;
use simworld_core::geometry::{Pose, Vector3};

use super::description::{Form, check_color, check_pose};
use super::error::RobotError;
use super::surface::Surface;

/// No box around a surface is thinner, m: core takes no smaller solids.
pub(super) const LEAST: f64 = 1e-3;

/// Something that is seen of a link. A link that has any is drawn as these, and as its solids otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinkVisual {
    /// Its form.
    pub form: VisualForm,
    /// Where it sits.
    pub link_from_visual: Pose,
    /// Its colour, linear-light sRGB primaries in [0, 1]; without one it has that of the entity, or else a grey.
    #[serde(default)]
    pub color: Option<[f32; 3]>,
}

/// The form of what is seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VisualForm {
    /// That of a solid.
    Solid(Form),
    /// A model: it stands on the origin of its frame. What robots of one kind have in common is in memory once.
    Model(Arc<Model>),
}

impl LinkVisual {
    /// A surface of triangles, seen in the frame that its points are in; none where there is no triangle that could be seen.
    pub fn of_surface(surface: &Surface, link_from_surface: &Pose, color: Option<[f32; 3]>) -> Option<Self> {
        let (model, middle) = surface.model()?;
        let link_from_visual = link_from_surface * Pose::translation(middle.x, middle.y, middle.z);
        Some(Self { form: VisualForm::Model(Arc::new(model)), link_from_visual, color })
    }

    pub(super) fn check(&self, place: &dyn Fn() -> String) -> Result<(), RobotError> {
        check_pose(place, &self.link_from_visual)?;
        check_color(place, self.color)?;
        match &self.form {
            VisualForm::Solid(form) => form.check(place),
            VisualForm::Model(model) => model
                .validate_surface(size_of(model))
                .map_err(|error| RobotError::Model { place: place(), error }),
        }
    }
}

/// The box that a model fills, m.
pub(super) fn size_of(model: &Model) -> Vector3 {
    let [low, high] = model.bounds().unwrap_or_default();
    Vector3::from_fn(|axis, _| f64::from(high[axis] - low[axis]).max(LEAST))
}
