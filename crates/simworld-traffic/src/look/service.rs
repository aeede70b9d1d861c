//! Level of service of a junction, by control delay.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Level of service: the classes of control delay of the Highway Capacity Manual (6th edition, exhibits 19-8 and 20-2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LevelOfService {
    /// Up to 10 s.
    A,
    /// Up to 20 s with signals, 15 s without.
    B,
    /// Up to 35 s with signals, 25 s without.
    C,
    /// Up to 55 s with signals, 35 s without.
    D,
    /// Up to 80 s with signals, 50 s without.
    E,
    /// Beyond.
    F,
}

impl LevelOfService {
    /// All, from the best to the worst.
    pub const ALL: [Self; 6] = [Self::A, Self::B, Self::C, Self::D, Self::E, Self::F];

    /// The class of a control delay, s.
    ///
    /// ```
    /// use simworld_traffic::look::LevelOfService;
    /// assert_eq!(LevelOfService::of(30.0, true), LevelOfService::C);
    /// assert_eq!(LevelOfService::of(30.0, false), LevelOfService::D);
    /// ```
    pub fn of(delay: f64, has_signals: bool) -> Self {
        let bounds = Self::bounds(has_signals);
        bounds.iter().position(|bound| delay <= *bound).map_or(Self::F, |class| Self::ALL[class])
    }

    /// The greatest delay of A to E, s.
    pub const fn bounds(has_signals: bool) -> [f64; 5] {
        if has_signals { [10.0, 20.0, 35.0, 55.0, 80.0] } else { [10.0, 15.0, 25.0, 35.0, 50.0] }
    }

    /// The colour in which it is drawn.
    pub const fn color(self) -> &'static str {
        match self {
            Self::A => "#3f8f6b",
            Self::B => "#8fbf8a",
            Self::C => "#e9d27c",
            Self::D => "#f0a75b",
            Self::E => "#d7613f",
            Self::F => "#8e1b2b",
        }
    }
}

impl fmt::Display for LevelOfService {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}
