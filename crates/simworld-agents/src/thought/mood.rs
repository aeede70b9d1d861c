//! How an agent feels.

use serde::{Deserialize, Serialize};
use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use simworld_core::ops::pow;

/// A state of mind that events change and time heals.
pub trait MentalState: Send {
    /// Takes in what happened, and that so many seconds passed.
    fn feel(&mut self, events: &[Event], who: EntityId, seconds: f64);

    /// In words that follow "you feel": "calm".
    fn describe(&self) -> String;

    /// The state as bytes for a snapshot.
    fn save(&self) -> Vec<u8>;

    /// Takes up a saved state; false if the bytes are not this one's.
    fn restore(&mut self, saved: &[u8]) -> bool;
}

/// The time after which a feeling is half as strong, s; chosen.
const HALF_LIFE: f64 = 120.0;
/// Feelings weaker than this are not felt.
const FELT: f64 = 0.15;

/// Pleasure and arousal, each in [-1, 1], after the circumplex of Russell (1980): eight words around a calm middle. The sizes of
/// what events do are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mood {
    /// Pleasant (1) or unpleasant (-1).
    pub pleasure: f64,
    /// Roused (1) or drowsy (-1).
    pub arousal: f64,
}

impl Mood {
    fn moved(&mut self, pleasure: f64, arousal: f64) {
        self.pleasure = (self.pleasure + pleasure).clamp(-1.0, 1.0);
        self.arousal = (self.arousal + arousal).clamp(-1.0, 1.0);
    }
}

impl MentalState for Mood {
    fn feel(&mut self, events: &[Event], who: EntityId, seconds: f64) {
        let fading = pow(0.5, seconds.max(0.0) / HALF_LIFE);
        self.pleasure *= fading;
        self.arousal *= fading;
        for event in events {
            match &event.kind {
                EventKind::PlanDone { who: actor } if *actor == who => self.moved(0.2, -0.05),
                EventKind::PlanFailed { who: actor, .. } if *actor == who => self.moved(-0.3, 0.3),
                EventKind::IntentRefused { who: actor, .. } if *actor == who => self.moved(-0.2, 0.1),
                EventKind::Said { to, .. } if *to == who => self.moved(0.05, 0.15),
                EventKind::Contact { a, b, .. } if *a == who || *b == who => self.moved(-0.2, 0.4),
                _ => {}
            }
        }
    }

    fn describe(&self) -> String {
        let level = |value: f64| if value > FELT { 1 } else { -i32::from(value < -FELT) };
        let word = match (level(self.pleasure), level(self.arousal)) {
            (1, 1) => "excited",
            (1, 0) => "pleased",
            (1, _) => "content",
            (0, 1) => "alert",
            (0, 0) => "calm",
            (0, _) => "drowsy",
            (_, 1) => "upset",
            (_, 0) => "displeased",
            _ => "gloomy",
        };
        word.to_owned()
    }

    fn save(&self) -> Vec<u8> {
        // Two numbers, which postcard always takes.
        postcard::to_stdvec(self).expect("plain data serialises")
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        match postcard::from_bytes(saved) {
            Ok(mood) => {
                *self = mood;
                true
            }
            Err(_) => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::clock::Tick;

    use super::*;

    #[test]
    fn failures_upset_and_time_heals() {
        let me = EntityId::new(1, 0);
        let failed =
            |who| Event { tick: Tick(0), kind: EventKind::PlanFailed { who, reason: "lost".into() } };
        let mut mood = Mood::default();
        mood.feel(&[failed(EntityId::new(2, 0))], me, 0.1);
        assert_eq!(mood.describe(), "calm");
        mood.feel(&[failed(me)], me, 0.1);
        assert_eq!(mood.describe(), "upset");
        let mut other = Mood::default();
        assert!(other.restore(&mood.save()) && other == mood && !other.restore(&[1]));
        mood.feel(&[], me, 3.0 * HALF_LIFE);
        assert_eq!(mood.describe(), "calm");
    }
}
