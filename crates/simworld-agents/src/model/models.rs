//! The models of all agents: everything around a backend, in the order that keeps its promises.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use simworld_core::seed::Seed;

use super::{
    Budget, ChatModel, Clock, Ledger, Logged, Metered, ModelError, ModelLog, Pace, Paced, Recorded, Retried,
    RetryConfig, Tape, Tariff,
};

/// What all agents' models share.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ModelsConfig {
    /// How often failures are asked again.
    pub retry: RetryConfig,
    /// The most requests that a server allows in a minute, over all agents.
    pub requests_per_minute: Option<u32>,
    /// The most tokens that it allows in a minute, over all agents.
    pub tokens_per_minute: Option<u64>,
    /// What tokens cost.
    pub tariff: Tariff,
    /// What may be spent.
    pub budget: Budget,
}

/// Makes each agent's model out of a backend.
///
/// From the outside in: [`Logged`], so that the log has what the agent got; [`Recorded`], so that a replay touches nothing
/// below; [`Retried`]; [`Metered`], so that each attempt is booked and budgets hold; [`Paced`], so that each attempt waits
/// its turn; the backend. A replay costs nothing and waits for nothing.
///
/// ```
/// use std::sync::Arc;
/// use simworld_agents::model::{ChatModel, ChatReply, ChatRequest, Message, Models, ModelsConfig, Scripted, Tariff, WallClock};
/// use simworld_core::seed::Seed;
///
/// let config = ModelsConfig { tariff: Tariff::free(), ..ModelsConfig::default() };
/// let models = Models::new(config, Seed(7), Arc::new(WallClock::new()));
/// let backend = Scripted::rule(|_| Ok(ChatReply::of("Go to the bench.")));
/// let mut ann = models.agent("ann", backend)?;
/// ann.chat(&ChatRequest::new([Message::user("Where to?")]))?;
/// assert_eq!(models.ledger().of("ann").answered, 1);
/// # Ok::<(), simworld_agents::model::ModelError>(())
/// ```
pub struct Models {
    config: ModelsConfig,
    seed: Seed,
    clock: Arc<dyn Clock>,
    pace: Arc<Pace>,
    ledger: Ledger,
    tape: Option<Arc<Tape>>,
    log: Option<Arc<ModelLog>>,
}

impl Models {
    /// Models without a recording or a log.
    pub fn new(config: ModelsConfig, seed: Seed, clock: Arc<dyn Clock>) -> Self {
        let pace = Pace::new(config.requests_per_minute, config.tokens_per_minute, clock.clone());
        let ledger = Ledger::new(config.budget);
        Self { config, seed, clock, pace: Arc::new(pace), ledger, tape: None, log: None }
    }

    /// The same on a tape.
    #[must_use]
    pub fn with_tape(mut self, tape: Tape) -> Self {
        self.tape = Some(Arc::new(tape));
        self
    }

    /// The same with a log.
    #[must_use]
    pub fn with_log(mut self, log: ModelLog) -> Self {
        self.log = Some(Arc::new(log));
        self
    }

    /// The accounts of all agents.
    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// The model of an agent, whose name is its own in accounts, log and recording.
    ///
    /// # Errors
    /// [`ModelError::Config`] for retries that cannot be.
    pub fn agent(
        &self,
        name: &str,
        backend: impl ChatModel + 'static,
    ) -> Result<Box<dyn ChatModel>, ModelError> {
        let paced = Paced::new(backend, self.pace.clone());
        let metered = Metered::new(paced, name, self.config.tariff.clone(), self.ledger.clone());
        let stream = self.seed.stream("agents/model/retry").named(name);
        let retried = Retried::new(metered, self.config.retry, stream, self.clock.clone())?;
        let model: Box<dyn ChatModel> = match &self.tape {
            Some(tape) => Box::new(Recorded::new(retried, name, tape.clone())),
            None => Box::new(retried),
        };
        Ok(match &self.log {
            Some(log) => Box::new(Logged::new(model, name, log.clone(), self.clock.clone())),
            None => model,
        })
    }
}
