//! Who moves its arms to say something, and until when.

use super::World;
use crate::action::Action;
use crate::clock::Tick;
use crate::id::EntityId;
use crate::ops::wrap_angle;
use crate::scene::{GESTURE, GESTURE_END, Gesture, POINTING, Scene};
use crate::value::Value;

impl World {
    /// Begins the gesture of an action, or ends the one of before if the action needs the arms.
    pub(in crate::scene) fn gesticulate(&mut self, who: EntityId, action: &Action) {
        let Some((gesture, seconds)) = Gesture::of(action) else {
            if !leaves_arms_alone(action) && self.gestures.contains_key(&who) {
                self.end_gesture(who);
            }
            return;
        };
        let clock = self.clock();
        let end = Tick(clock.tick().0 + clock.ticks_in(seconds).max(1));
        let pointing = match action {
            Action::PointDirection { heading } => Some(Value::Number(wrap_angle(*heading))),
            _ => None,
        };
        let set = [
            (GESTURE, Some(Value::Text(gesture.as_str().to_owned()))),
            (GESTURE_END, Some(Value::Integer(i64::try_from(end.0).unwrap_or(i64::MAX)))),
            (POINTING, pointing),
        ];
        for (key, value) in set {
            // It acts, so it lives.
            let _ = self.set_attribute(who, key, value);
        }
        self.gestures.insert(who, end);
    }

    /// Takes up the gestures of entities that came with one, as those of a snapshot do.
    pub(super) fn resume_gestures(&mut self) {
        let end = |value: &Value| u64::try_from(value.as_i64()?).ok().map(Tick);
        let found = self
            .iter()
            .filter_map(|entity| Some((entity.id, end(entity.info.attributes.get(GESTURE_END)?)?)));
        self.gestures = found.collect();
    }

    /// Ends the gestures whose time is over with this step; called at its end.
    pub(super) fn end_gestures(&mut self) {
        let next = Tick(self.clock().tick().0 + 1);
        let over: Vec<EntityId> =
            self.gestures.iter().filter(|(_, end)| **end <= next).map(|(who, _)| *who).collect();
        for who in over {
            self.end_gesture(who);
        }
    }

    fn end_gesture(&mut self, who: EntityId) {
        self.gestures.remove(&who);
        for key in [GESTURE, GESTURE_END, POINTING] {
            // Who is gone has no arms.
            let _ = self.set_attribute(who, key, None);
        }
    }
}

/// Whether one may go on waving or speaking meanwhile: who halts, halts its feet.
fn leaves_arms_alone(action: &Action) -> bool {
    matches!(
        action,
        Action::MoveForward { .. }
            | Action::Step { .. }
            | Action::Rotate { .. }
            | Action::ChangeSpeed { .. }
            | Action::LookUp { .. }
            | Action::LookDown { .. }
            | Action::Focus { .. }
            | Action::Stop
    )
}
