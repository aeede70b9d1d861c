//! Seasons: what plants look like through the year.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A quarter of the year.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Season {
    /// Buds and blossom.
    Spring,
    /// Full leaf.
    Summer,
    /// Coloured leaves.
    Autumn,
    /// Bare twigs, or needles.
    Winter,
}

impl Season {
    /// Every season, from spring on.
    pub const ALL: [Self; 4] = [Self::Spring, Self::Summer, Self::Autumn, Self::Winter];

    /// The name in files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Spring => "spring",
            Self::Summer => "summer",
            Self::Autumn => "autumn",
            Self::Winter => "winter",
        }
    }

    /// The season of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|season| season.as_str() == name)
    }

    /// The season on the other half of the globe at the same time.
    #[must_use]
    pub const fn opposite(self) -> Self {
        match self {
            Self::Spring => Self::Autumn,
            Self::Summer => Self::Winter,
            Self::Autumn => Self::Spring,
            Self::Winter => Self::Summer,
        }
    }
}

impl fmt::Display for Season {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// The surface colour of a plant in each season, linear-light sRGB primaries in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Seasons {
    /// In spring.
    pub spring: [f32; 3],
    /// In summer.
    pub summer: [f32; 3],
    /// In autumn.
    pub autumn: [f32; 3],
    /// In winter.
    pub winter: [f32; 3],
}

impl Seasons {
    /// The colour in a season.
    pub const fn color(&self, season: Season) -> [f32; 3] {
        match season {
            Season::Spring => self.spring,
            Season::Summer => self.summer,
            Season::Autumn => self.autumn,
            Season::Winter => self.winter,
        }
    }
}
