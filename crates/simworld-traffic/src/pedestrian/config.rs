//! Who walks in a city, and what they do at its kerbs.

use serde::{Deserialize, Serialize};

use crate::crowd::Steering;

/// Who walks in a city, and what they do at its kerbs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct People {
    /// By which model they find their way among one another.
    pub steering: Steering,
    /// Weights of the ages 6-14, 15-24, 25-49, 50-64, 65-79 and 80-89 years, each in [0, 1000], one of them positive. The
    /// default is roughly the population of the European Union (Eurostat 2023), of the eldest those who walk alone.
    pub ages: [f64; 6],
    /// Share of walkers in groups of two to four, in [0, 1]; on a weekday it is 0.55, on a Saturday in a shopping street
    /// 0.7 (Moussaïd, Perozo, Garnier, Helbing and Theraulaz 2010).
    pub in_groups: f64,
    /// Share of walkers who cross at red if there is a gap that is long enough, in [0, 1].
    pub jaywalking: f64,
    /// Time added to that of walking across for a gap to be long enough, s, in [0, 30]: to start, and to spare (Highway
    /// Capacity Manual: 3 s).
    pub gap_margin: f64,
    /// How often those decide who are far from every point of interest, s, in [0.1, 0.5].
    pub far_interval: f64,
}

impl Default for People {
    fn default() -> Self {
        Self {
            steering: Steering::default(),
            ages: [10.0, 12.0, 36.0, 22.0, 16.0, 2.0],
            in_groups: 0.5,
            jaywalking: 0.0,
            gap_margin: 3.0,
            far_interval: 0.5,
        }
    }
}

/// A field, its value, the range it is in, and that range in words.
type Range = (&'static str, f64, f64, f64, &'static str);

impl People {
    /// The fields and their ranges, for errors.
    pub(crate) fn ranges(&self) -> impl Iterator<Item = Range> + use<> {
        let names = [
            "people.ages[0]",
            "people.ages[1]",
            "people.ages[2]",
            "people.ages[3]",
            "people.ages[4]",
            "people.ages[5]",
        ];
        let each = |(name, weight)| (name, weight, 0.0, 1000.0, "0 to 1000");
        let sum = self.ages.iter().sum();
        let others = [
            ("people.ages (their sum)", sum, 1e-6, 6000.0, "at least one positive weight"),
            ("people.in_groups", self.in_groups, 0.0, 1.0, "0 to 1"),
            ("people.jaywalking", self.jaywalking, 0.0, 1.0, "0 to 1"),
            ("people.gap_margin", self.gap_margin, 0.0, 30.0, "0 to 30 s"),
            ("people.far_interval", self.far_interval, 0.1, 0.5, "0.1 to 0.5 s"),
        ];
        names.into_iter().zip(self.ages).map(each).chain(others)
    }
}
