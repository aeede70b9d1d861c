//! What a mind wants: a sentence, a structured call, or what it has planned itself.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::action::Action;
use crate::seam::{Plan, PlanStep};
use crate::value::Value;

/// An intent, the input of a [`Planner`](crate::seam::Planner) or of a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Intent {
    /// A sentence, such as "go to the nearest chair and sit down".
    Words(String),
    /// A function call, such as `bid_order(order = 4, price = 12.5)`.
    Call {
        /// The function.
        name: String,
        /// Its arguments.
        args: BTreeMap<String, Value>,
    },
    /// A plan that is ready, of a mind that plans for itself: no planner is asked, and the executor takes it up as it is.
    Plan(Plan),
    /// What the body does in this very step, of a mind that carries out its plans itself: neither planner nor executor is asked.
    /// A plan that the executor has goes on beside it.
    Act(Vec<Action>),
}

impl Intent {
    /// A call without arguments; add them with [`arg`](Self::arg).
    ///
    /// ```
    /// use simworld_core::intent::Intent;
    /// let bid = Intent::call("bid_order").arg("order", 4_i64).arg("price", 12.5);
    /// assert_eq!(bid.to_string(), "bid_order(order = 4, price = 12.5)");
    /// ```
    pub fn call(name: impl Into<String>) -> Self {
        Self::Call { name: name.into(), args: BTreeMap::new() }
    }

    /// The plan that it is already; none of words and calls, which have to be planned.
    pub fn ready(&self) -> Option<Plan> {
        match self {
            Self::Plan(plan) => Some(plan.clone()),
            Self::Act(actions) => Some(Plan { steps: actions.iter().cloned().map(PlanStep::Act).collect() }),
            Self::Words(_) | Self::Call { .. } => None,
        }
    }

    /// With an argument; only calls take any, and the others stay as they are.
    #[must_use]
    pub fn arg(mut self, key: &str, value: impl Into<Value>) -> Self {
        if let Self::Call { args, .. } = &mut self {
            args.insert(key.to_owned(), value.into());
        }
        self
    }
}

impl std::fmt::Display for Intent {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Words(words) => write!(f, "{words:?}"),
            Self::Call { name, args } => {
                write!(f, "{name}(")?;
                for (index, (key, value)) in args.iter().enumerate() {
                    write!(f, "{}{key} = {value}", if index > 0 { ", " } else { "" })?;
                }
                write!(f, ")")
            }
            Self::Plan(plan) => match plan.steps.len() {
                1 => write!(f, "a plan of one step"),
                steps => write!(f, "a plan of {steps} steps"),
            },
            Self::Act(actions) => {
                let kinds: Vec<String> = actions.iter().map(|action| action.kind().to_string()).collect();
                f.write_str(&kinds.join(", "))
            }
        }
    }
}
