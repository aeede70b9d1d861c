//! What can be altered of an entity that is there: its solid, its colour, its name, whether it is seen and met.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::id::EntityId;
use crate::scene::{EntityInfo, Scene, Shape, Solidity, Visibility, World, WorldError};

/// One alteration of an entity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Alteration {
    /// Its solid; it stands where it stood.
    Shape(Shape),
    /// Its surface colour, linear-light sRGB primaries in [0, 1], or that of its kind.
    Color(Option<[f32; 3]>),
    /// What people call it, if it has a name.
    Name(Option<String>),
    /// Whether eyes and cameras see it.
    Visibility(Visibility),
    /// Whether bodies collide with it.
    Solidity(Solidity),
}

/// A colour that no surface has.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{value} is no share of a primary colour: give 0 to 1 for red, green and blue")]
pub struct ColorError {
    /// The refused value.
    pub value: f32,
}

impl Alteration {
    /// Checks its numbers.
    ///
    /// # Errors
    /// A shape that is no solid, or a colour out of range.
    pub fn validate(&self) -> Result<(), WorldError> {
        match self {
            Self::Shape(shape) => Ok(shape.validate()?),
            Self::Color(Some(channels)) => {
                match channels.iter().find(|channel| !(0.0..=1.0).contains(*channel)) {
                    Some(value) => Err(ColorError { value: *value }.into()),
                    None => Ok(()),
                }
            }
            Self::Color(None) | Self::Name(_) | Self::Visibility(_) | Self::Solidity(_) => Ok(()),
        }
    }

    /// Puts it into what an entity is made of, and gives what was there.
    fn exchange(self, info: &mut EntityInfo) -> Self {
        use std::mem::replace;
        match self {
            Self::Shape(shape) => Self::Shape(replace(&mut info.shape, shape)),
            Self::Color(color) => Self::Color(replace(&mut info.color, color)),
            Self::Name(name) => Self::Name(replace(&mut info.name, name)),
            Self::Visibility(visibility) => Self::Visibility(replace(&mut info.visibility, visibility)),
            Self::Solidity(solidity) => Self::Solidity(replace(&mut info.solidity, solidity)),
        }
    }
}

impl World {
    /// Alters an entity that is there; gives the alteration that takes it back.
    ///
    /// ```
    /// use simworld_core::alteration::Alteration;
    /// use simworld_core::geometry::Pose;
    /// use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, Visibility, World};
    /// let mut world = World::new();
    /// let cone = EntityDesc::new(EntityKind::Cone, Pose::identity(), Shape::Cylinder { radius: 0.2, height: 0.7 });
    /// let id = world.spawn(cone)?;
    /// let back = world.alter(id, Alteration::Visibility(Visibility::Hidden))?;
    /// assert!(!world.entity(id).unwrap().is_visible());
    /// world.alter(id, back)?;
    /// assert!(world.entity(id).unwrap().is_visible());
    /// # Ok::<(), simworld_core::scene::WorldError>(())
    /// ```
    ///
    /// # Errors
    /// No such entity, a shape that is no solid, or a colour out of range; then nothing has changed.
    pub fn alter(&mut self, id: EntityId, alteration: Alteration) -> Result<Alteration, WorldError> {
        alteration.validate()?;
        let pose = *self.entity(id).ok_or(WorldError::Missing { id })?.pose;
        let back = self.change_info(id, |info| alteration.exchange(info))?;
        // Its bounds follow its shape.
        self.place(id, pose);
        Ok(back)
    }
}
