//! What somebody says with its arms.

use serde::{Deserialize, Serialize};

use super::EntityRef;
use crate::action::Action;
use crate::value::Value;

/// The attribute of somebody that says what its arms do, as [`Gesture`] names it; nothing of the kind without it. Actions that
/// are gestures set it, and the world takes it away when they end.
pub const GESTURE: &str = "gesture";

/// The attribute of somebody that says where it points to, radians counter-clockwise from east; straight ahead without it.
pub const POINTING: &str = "pointing";

/// The attribute of somebody that says in which tick its gesture ends; one without an end goes on until somebody sets another.
pub const GESTURE_END: &str = "gesture_end";

/// How long gestures last, s: two swings of a wave, a glance along an arm.
const WAVING: f64 = 2.5;
const POINTING_OUT: f64 = 2.5;
const ARGUING: f64 = 4.0;
/// Words a second of somebody who speaks: 150 a minute (Tauroza and Allison, Speech rates in British English, 1990, find 160 in
/// interviews), and the bounds of how long one speaks, s.
const WORDS_A_SECOND: f64 = 2.5;
const SPEAKING: (f64, f64) = (1.5, 20.0);

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

    /// What the arms do in an action, and for how long, s; none if the action leaves them alone.
    ///
    /// ```
    /// use simworld_core::action::Action;
    /// use simworld_core::id::EntityId;
    /// use simworld_core::scene::Gesture;
    /// let words = "the bridge is closed".into();
    /// let said = Gesture::of(&Action::Converse { with: EntityId::new(1, 0), words });
    /// assert_eq!(said, Some((Gesture::Talk, 4.0 / 2.5)));
    /// ```
    pub fn of(action: &Action) -> Option<(Self, f64)> {
        match action {
            Action::WaveHand { .. } => Some((Self::Wave, WAVING)),
            Action::PointDirection { .. } => Some((Self::Point, POINTING_OUT)),
            Action::Argue { .. } => Some((Self::Argue, ARGUING)),
            Action::Converse { words, .. } => {
                let seconds = words.split_whitespace().count() as f64 / WORDS_A_SECOND;
                Some((Self::Talk, seconds.clamp(SPEAKING.0, SPEAKING.1)))
            }
            _ => None,
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

    /// Where it points to, radians counter-clockwise from east, if it says so.
    pub fn pointing(&self) -> Option<f64> {
        self.info.attributes.get(POINTING).and_then(Value::as_f64).filter(|heading| heading.is_finite())
    }
}
