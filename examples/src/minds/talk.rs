//! What people on a promenade want, and minds that want it.

use std::time::Duration;

use simworld_agents::mind::{Mind, MindError};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seed::StreamRng;

/// What they say, one after the other: every family of the grammar that a city without named places can answer.
pub const SENTENCES: [&str; 10] = [
    "go to the nearest bench",
    "walk to the nearest tree and then wait 2 seconds",
    "go to the second street lamp",
    "look at the nearest building",
    "go to the nearest trash bin, then wave",
    "please walk to the bench near the nearest building, thank you",
    "go to the nearst bnech and sit down",
    "if it is raining go to the nearest building, otherwise go to the nearest tree",
    "follow the nearest person for 5 seconds",
    "turn left and walk 5 metres",
];

/// Says the next sentence every so many steps; at another step than its neighbours.
pub struct Speaker {
    index: u64,
    every: u64,
}

impl Speaker {
    /// The mind of the `index`-th agent.
    pub fn new(index: usize, every: u64) -> Self {
        Self { index: index as u64, every }
    }
}

impl<T: ?Sized> Mind<T> for Speaker {
    fn decide(
        &mut self,
        _: &T,
        scene: &dyn Scene,
        _: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        let time = scene.clock().tick().0 + self.index;
        if time.is_multiple_of(self.every) {
            let which = (time / self.every + self.index) as usize % SENTENCES.len();
            out.push(Intent::Words(SENTENCES[which].to_owned()));
        }
        Ok(())
    }
}

/// Thinks for a random time, from 1 ms to a longest one, each length of time as likely as its half; then says a sentence.
pub struct Dawdler {
    rng: StreamRng,
    longest: Duration,
}

impl Dawdler {
    /// A mind with thoughts of its own.
    pub fn new(rng: StreamRng, longest: Duration) -> Self {
        Self { rng, longest }
    }
}

impl<T: ?Sized> Mind<T> for Dawdler {
    fn decide(&mut self, _: &T, _: &dyn Scene, _: EntityId, out: &mut Vec<Intent>) -> Result<(), MindError> {
        let range = (self.longest.as_secs_f64() / 1e-3).max(1.0);
        std::thread::sleep(Duration::from_secs_f64(1e-3 * simworld_core::ops::pow(range, self.rng.unit())));
        let which = self.rng.below(SENTENCES.len());
        out.push(Intent::Words(SENTENCES[which].to_owned()));
        Ok(())
    }
}
