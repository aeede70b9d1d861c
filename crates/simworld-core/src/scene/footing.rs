//! Whether somebody stands on its feet, and why not.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::EntityRef;
use crate::value::Value;

/// The attribute of somebody that says how it fares on its feet, as [`Footing`] names it; upright without it.
pub const FOOTING: &str = "footing";

/// The attribute of somebody who crouches: true, and none while it does not.
pub const CROUCHED: &str = "crouched";

/// How somebody fares on its feet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Footing {
    /// It stands, walks, sits or rides.
    #[default]
    Upright,
    /// It has lost its footing and falls, tumbles or slides.
    Falling,
    /// It lies.
    Down,
    /// It gets up.
    Rising,
}

impl Footing {
    const NAMED: [Self; 4] = [Self::Upright, Self::Falling, Self::Down, Self::Rising];

    /// The name in the attribute.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Upright => "upright",
            Self::Falling => "falling",
            Self::Down => "down",
            Self::Rising => "rising",
        }
    }

    /// The value of the attribute; none while upright.
    pub fn to_attribute(self) -> Option<Value> {
        (self != Self::Upright).then(|| Value::Text(self.as_str().to_owned()))
    }
}

impl fmt::Display for Footing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// Why somebody lost its footing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum FallCause {
    /// Its feet were stopped by something low while it was fast.
    Tripped,
    /// It asked more of the ground than friction gives.
    Slipped,
    /// Something ran into it.
    Struck,
    /// It came down faster than legs take up.
    Landed,
}

impl fmt::Display for FallCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Tripped => "tripped",
            Self::Slipped => "slipped",
            Self::Struck => "struck",
            Self::Landed => "landed hard",
        })
    }
}

impl EntityRef<'_> {
    /// How it fares on its feet.
    pub fn footing(&self) -> Footing {
        let Some(Value::Text(name)) = self.info.attributes.get(FOOTING) else { return Footing::Upright };
        Footing::NAMED.into_iter().find(|footing| footing.as_str() == name).unwrap_or_default()
    }

    /// Whether it crouches.
    pub fn is_crouched(&self) -> bool {
        self.info.attributes.get(CROUCHED) == Some(&Value::Bool(true))
    }
}
