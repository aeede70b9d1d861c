//! What somebody says with its arms.

use serde::{Deserialize, Serialize};

use super::EntityRef;
use crate::value::Value;

/// The attribute of somebody that says what its arms do, as [`Gesture`] names it; nothing of the kind without it.
pub const GESTURE: &str = "gesture";

/// What somebody says with its arms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Gesture {
    /// Waves with the right hand.
    Wave,
    /// Points straight ahead.
    Point,
    /// Speaks, the hand moving with the words.
    Talk,
    /// Disagrees with both hands.
    Argue,
}

impl Gesture {
    /// Every gesture.
    pub const ALL: [Self; 4] = [Self::Wave, Self::Point, Self::Talk, Self::Argue];

    /// The name in the attribute.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Wave => "wave",
            Self::Point => "point",
            Self::Talk => "talk",
            Self::Argue => "argue",
        }
    }
}

impl EntityRef<'_> {
    /// What it says with its arms, if anything.
    ///
    /// ```
    /// use simworld_core::geometry::{Point3, pose_facing};
    /// use simworld_core::scene::{EntityDesc, EntityKind, GESTURE, Gesture, Scene, Shape, World};
    ///
    /// let mut world = World::new();
    /// let body = Shape::Capsule { radius: 0.25, height: 1.7 };
    /// let pose = pose_facing(Point3::origin(), 0.0);
    /// let who = EntityDesc::new(EntityKind::Person, pose, body).with(GESTURE, Gesture::Wave.as_str());
    /// let who = world.spawn(who).unwrap();
    /// assert_eq!(world.entity(who).unwrap().gesture(), Some(Gesture::Wave));
    /// ```
    pub fn gesture(&self) -> Option<Gesture> {
        let Some(Value::Text(name)) = self.info.attributes.get(GESTURE) else { return None };
        Gesture::ALL.into_iter().find(|gesture| gesture.as_str() == name)
    }
}
