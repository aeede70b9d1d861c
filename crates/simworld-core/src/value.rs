//! Small typed values: attributes of entities and arguments of calls.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::hash::StateHasher;
use crate::id::EntityId;

/// A value of an attribute or an argument.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Value {
    /// Yes or no.
    Bool(bool),
    /// A whole number.
    Integer(i64),
    /// A finite number.
    Number(f64),
    /// Words.
    Text(String),
    /// An entity of the same world.
    Entity(EntityId),
}

impl Value {
    /// The number, also of an integer.
    pub fn as_f64(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Integer(integer) => Some(*integer as f64),
            _ => None,
        }
    }

    /// The whole number.
    pub fn as_i64(&self) -> Option<i64> {
        if let Self::Integer(integer) = self { Some(*integer) } else { None }
    }

    /// The words.
    pub fn as_str(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    /// The entity.
    pub fn as_entity(&self) -> Option<EntityId> {
        if let Self::Entity(id) = self { Some(*id) } else { None }
    }

    pub(crate) fn state_hash(&self, hasher: &mut StateHasher) {
        match self {
            Self::Bool(yes) => hasher.u64(0).u64(u64::from(*yes)),
            Self::Integer(integer) => hasher.u64(1).u64(*integer as u64),
            Self::Number(number) => hasher.u64(2).f64(*number),
            Self::Text(text) => hasher.u64(3).str(text),
            Self::Entity(id) => hasher.u64(4).u64((*id).into()),
        };
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bool(yes) => yes.fmt(f),
            Self::Integer(integer) => integer.fmt(f),
            Self::Number(number) => number.fmt(f),
            Self::Text(text) => text.fmt(f),
            Self::Entity(id) => id.fmt(f),
        }
    }
}

impl From<bool> for Value {
    fn from(yes: bool) -> Self {
        Self::Bool(yes)
    }
}

impl From<i64> for Value {
    fn from(integer: i64) -> Self {
        Self::Integer(integer)
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<EntityId> for Value {
    fn from(id: EntityId) -> Self {
        Self::Entity(id)
    }
}
