//! What models cost: prices, budgets and accounts, in whole micro-cents.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use serde::{Deserialize, Serialize};

use super::{ModelError, Usage};

/// Money: a millionth of a cent. A dollar is 100,000,000.
pub type MicroCents = u64;

/// What a model's tokens cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Price {
    /// Of a million tokens of the prompt. 0.15 dollars are 15,000,000.
    pub prompt: MicroCents,
    /// Of a million tokens of the answer.
    pub completion: MicroCents,
}

impl Price {
    /// What that many tokens cost, rounded up to the next micro-cent.
    pub fn of(self, usage: Usage) -> MicroCents {
        let cost = u128::from(usage.prompt) * u128::from(self.prompt)
            + u128::from(usage.completion) * u128::from(self.completion);
        MicroCents::try_from(cost.div_ceil(1_000_000)).unwrap_or(MicroCents::MAX)
    }
}

/// What may be spent; `None`: as much as one likes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Budget {
    /// By all agents together.
    pub cost: Option<MicroCents>,
    /// By each agent.
    pub agent_cost: Option<MicroCents>,
    /// Tokens of all agents together.
    pub tokens: Option<u64>,
    /// Tokens of each agent.
    pub agent_tokens: Option<u64>,
}

/// What one agent, or all of them, took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Account {
    /// Requests that were answered.
    pub answered: u64,
    /// Requests that failed.
    pub failed: u64,
    /// Requests that were not sent, for want of budget.
    pub stopped: u64,
    /// Tokens of what was answered.
    pub usage: Usage,
    /// What that cost.
    pub cost: MicroCents,
    /// The most tokens that failed requests may have taken: a server that was cut off may have worked all the same.
    pub uncertain_tokens: u64,
    /// The most that those cost. It counts against budgets.
    pub uncertain_cost: MicroCents,
}

/// The accounts of all agents; clones share them.
#[derive(Clone, Default)]
pub struct Ledger {
    books: Arc<Mutex<Books>>,
}

#[derive(Default)]
struct Books {
    budget: Budget,
    agents: BTreeMap<String, Account>,
    total: Account,
    /// Held for requests under way: of each agent, and of all.
    held: BTreeMap<String, Held>,
    held_total: Held,
}

/// The most that a request under way can take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Held {
    pub(super) tokens: u64,
    pub(super) cost: MicroCents,
}

/// How a request under way ended.
pub(super) enum Outcome {
    Answered(Usage, MicroCents),
    /// The server did nothing for it.
    Failed,
    /// The server may have done all of it.
    Uncertain,
}

impl Ledger {
    /// Empty accounts with that budget.
    pub fn new(budget: Budget) -> Self {
        Self { books: Arc::new(Mutex::new(Books { budget, ..Books::default() })) }
    }

    /// What all took together.
    pub fn total(&self) -> Account {
        self.books().total
    }

    /// What that agent took.
    pub fn of(&self, agent: &str) -> Account {
        self.books().agents.get(agent).copied().unwrap_or_default()
    }

    /// What each agent took, by name.
    pub fn agents(&self) -> BTreeMap<String, Account> {
        self.books().agents.clone()
    }

    /// Holds the most that a request can take, so that requests under way never exceed a budget together.
    pub(super) fn hold(&self, agent: &str, most: Held) -> Result<(), ModelError> {
        let mut books = self.books();
        if let Err(error) = books.check(agent, most) {
            books.each(agent, |account| account.stopped += 1);
            return Err(error);
        }
        let held = books.held.entry(agent.to_owned()).or_default();
        *held = held.plus(most);
        books.held_total = books.held_total.plus(most);
        Ok(())
    }

    /// Gives back what was held and books what was taken.
    pub(super) fn settle(&self, agent: &str, most: Held, outcome: &Outcome) {
        let mut books = self.books();
        if let Some(held) = books.held.get_mut(agent) {
            *held = held.minus(most);
        }
        books.held_total = books.held_total.minus(most);
        books.each(agent, |account| match outcome {
            Outcome::Answered(usage, cost) => {
                account.answered += 1;
                account.usage = account.usage.and(*usage);
                account.cost = account.cost.saturating_add(*cost);
            }
            Outcome::Failed => account.failed += 1,
            Outcome::Uncertain => {
                account.failed += 1;
                account.uncertain_tokens = account.uncertain_tokens.saturating_add(most.tokens);
                account.uncertain_cost = account.uncertain_cost.saturating_add(most.cost);
            }
        });
    }

    fn books(&self) -> std::sync::MutexGuard<'_, Books> {
        self.books.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl std::fmt::Debug for Ledger {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Ledger({:?})", self.total())
    }
}

impl Books {
    fn each(&mut self, agent: &str, change: impl Fn(&mut Account)) {
        change(self.agents.entry(agent.to_owned()).or_default());
        change(&mut self.total);
    }

    fn check(&self, agent: &str, most: Held) -> Result<(), ModelError> {
        let own = self.agents.get(agent).copied().unwrap_or_default();
        let own = taken(&own).plus(self.held.get(agent).copied().unwrap_or_default());
        let all = taken(&self.total).plus(self.held_total);
        let everybody = "everybody together";
        for (budget, taken, needed, whose, unit) in [
            (self.budget.agent_cost, own.cost, most.cost, agent, "micro-cents"),
            (self.budget.agent_tokens, own.tokens, most.tokens, agent, "tokens"),
            (self.budget.cost, all.cost, most.cost, everybody, "micro-cents"),
            (self.budget.tokens, all.tokens, most.tokens, everybody, "tokens"),
        ] {
            let left = budget.map_or(u64::MAX, |budget| budget.saturating_sub(taken));
            if needed > left {
                return Err(ModelError::Budget { whose: whose.into(), needed, left, unit: unit.into() });
            }
        }
        Ok(())
    }
}

/// What counts against a budget.
fn taken(account: &Account) -> Held {
    Held {
        tokens: account.usage.total().saturating_add(account.uncertain_tokens),
        cost: account.cost.saturating_add(account.uncertain_cost),
    }
}

impl Held {
    fn plus(self, other: Self) -> Self {
        Self { tokens: self.tokens.saturating_add(other.tokens), cost: self.cost.saturating_add(other.cost) }
    }

    fn minus(self, other: Self) -> Self {
        Self { tokens: self.tokens.saturating_sub(other.tokens), cost: self.cost.saturating_sub(other.cost) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_are_rounded_up_and_never_wrap() {
        let price = Price { prompt: 15_000_000, completion: 60_000_000 };
        assert_eq!(price.of(Usage { prompt: 1000, completion: 100 }), 21_000);
        assert_eq!(Price { prompt: 1, completion: 0 }.of(Usage { prompt: 1, completion: 0 }), 1);
        assert_eq!(price.of(Usage { prompt: u64::MAX, completion: u64::MAX }), u64::MAX);
    }
}
