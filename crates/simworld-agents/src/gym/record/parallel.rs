//! Recording several agents.

use std::collections::BTreeMap;
use std::io::Write;

use serde::Serialize;
use simworld_core::id::EntityId;
use simworld_core::seam::{EnvError, Options, ParallelEnv, ParallelStart, ParallelStep, Space};
use simworld_core::seed::Seed;

use super::{Detail, Line, Record};

impl<E, W> ParallelEnv for Record<E, W>
where
    E: ParallelEnv<Observation: Serialize, Action: Serialize>,
    W: Write,
{
    type Observation = E::Observation;
    type Action = E::Action;

    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<ParallelStart<E::Observation>, EnvError> {
        let start = self.env.reset(seed, options)?;
        let episode = self.begin(seed)?;
        if let Some(current) = &mut self.current {
            current.returns = start.keys().map(|id| (*id, 0.0)).collect();
        }
        if self.detail == Detail::Steps {
            self.write(&Line::<_, (), ()>::Reset { episode, seed, start: &start })?;
        }
        Ok(start)
    }

    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, E::Action>,
    ) -> Result<ParallelStep<E::Observation>, EnvError> {
        let mut transitions = self.env.step(actions)?;
        if let Some(current) = &mut self.current {
            current.steps += 1;
            for (id, transition) in &mut transitions {
                let sum = current.returns.entry(*id).or_insert(0.0);
                *sum += transition.reward;
                current.total += transition.reward;
                (current.terminated, current.truncated) = (transition.terminated, transition.truncated);
                if transition.is_last() {
                    transition.info.insert("episode_return".to_owned(), (*sum).into());
                    transition.info.insert("episode_length".to_owned(), (current.steps as i64).into());
                }
            }
        }
        if self.detail == Detail::Steps {
            self.write(&Line::<(), _, _>::Step { action: actions, transition: &transitions })?;
        }
        if transitions.values().all(simworld_core::seam::Transition::is_last) {
            self.end()?;
        }
        Ok(transitions)
    }

    fn spaces(&self, agent: EntityId) -> (Space, Space) {
        self.env.spaces(agent)
    }
}
