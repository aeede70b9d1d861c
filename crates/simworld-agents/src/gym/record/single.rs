//! Recording one agent.

use std::io::Write;

use serde::Serialize;
use simworld_core::seam::{Env, EnvError, Info, Options, Space, Transition};
use simworld_core::seed::Seed;

use super::{Detail, Line, Record};

impl<E, W> Env for Record<E, W>
where
    E: Env<Observation: Serialize, Action: Serialize>,
    W: Write,
{
    type Observation = E::Observation;
    type Action = E::Action;

    fn reset(&mut self, seed: Option<Seed>, options: &Options) -> Result<(E::Observation, Info), EnvError> {
        let start = self.env.reset(seed, options)?;
        let episode = self.begin(seed)?;
        if self.detail == Detail::Steps {
            self.write(&Line::<_, (), ()>::Reset { episode, seed, start: &start })?;
        }
        Ok(start)
    }

    fn step(&mut self, action: &E::Action) -> Result<Transition<E::Observation>, EnvError> {
        let mut transition = self.env.step(action)?;
        let is_last = transition.is_last();
        if let Some(current) = &mut self.current {
            current.steps += 1;
            current.total += transition.reward;
            (current.terminated, current.truncated) = (transition.terminated, transition.truncated);
            if is_last {
                transition.info.insert("episode_return".to_owned(), current.total.into());
                transition.info.insert("episode_length".to_owned(), (current.steps as i64).into());
            }
        }
        if self.detail == Detail::Steps {
            self.write(&Line::<(), _, _>::Step { action, transition: &transition })?;
        }
        if is_last {
            self.end()?;
        }
        Ok(transition)
    }

    fn spaces(&self) -> (Space, Space) {
        self.env.spaces()
    }
}
