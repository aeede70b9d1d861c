//! An episode as data.

use serde::{Deserialize, Serialize};
use simworld_core::id::EntityId;
use simworld_core::seam::Task;
use simworld_core::simulation::SimulationSnapshot;

use super::{Episode, EpisodeError};

/// The whole state of an [`Episode`]; restore it onto an episode made with the same parts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EpisodeSnapshot {
    simulation: SimulationSnapshot,
    task: Vec<u8>,
    agents: Vec<AgentSnapshot>,
    spawned: Vec<EntityId>,
    returns: Vec<f64>,
    terminated: bool,
    truncated: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct AgentSnapshot {
    id: EntityId,
    mind: Vec<u8>,
    executor: Vec<u8>,
}

impl<T: Task> Episode<T> {
    /// The whole state as data.
    ///
    /// # Errors
    /// A part of the simulation cannot be saved.
    pub fn save(&self) -> Result<EpisodeSnapshot, EpisodeError> {
        let agent = |agent: &super::Agent<T>| AgentSnapshot {
            id: agent.id,
            mind: agent.mind.save(),
            executor: agent.executor.save(),
        };
        Ok(EpisodeSnapshot {
            simulation: self.simulation.save()?,
            task: self.task.save(),
            agents: self.agents.iter().map(agent).collect(),
            spawned: self.spawned.clone(),
            returns: self.returns.clone(),
            terminated: self.outcome.terminated,
            truncated: self.outcome.truncated,
        })
    }

    /// Goes back to a saved state; the recording and the trail start anew.
    ///
    /// # Errors
    /// The snapshot does not fit; the episode must then not be stepped any further.
    pub fn restore(&mut self, snapshot: EpisodeSnapshot) -> Result<(), EpisodeError> {
        let saved: Vec<EntityId> = snapshot.agents.iter().map(|agent| agent.id).collect();
        if saved != self.ids {
            return Err(EpisodeError::Agents { saved, present: self.ids.clone() });
        }
        self.simulation.restore(snapshot.simulation)?;
        let fits = |restored: bool, part: &dyn Fn() -> String| {
            if restored { Ok(()) } else { Err(EpisodeError::SavedState { part: part() }) }
        };
        fits(self.task.restore(&snapshot.task), &|| "the task".to_owned())?;
        for (agent, saved) in self.agents.iter_mut().zip(&snapshot.agents) {
            fits(agent.mind.restore(&saved.mind), &|| format!("the mind of {}", saved.id))?;
            fits(agent.executor.restore(&saved.executor), &|| format!("the executor of {}", saved.id))?;
        }
        self.spawned = snapshot.spawned;
        self.returns = snapshot.returns;
        self.failed = false;
        self.outcome.terminated = snapshot.terminated;
        self.outcome.truncated = snapshot.truncated;
        self.trail.clear();
        Ok(())
    }
}
