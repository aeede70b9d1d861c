//! What a mind wants: a sentence or a structured call.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

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

    /// With an argument; words take none and stay as they are.
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
        }
    }
}
