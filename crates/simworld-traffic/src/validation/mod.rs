//! Validation: the traffic measured as an engineer would measure a street, each figure beside its band.
//!
//! A [`Measure`] sets up a street or a hall, runs it, and returns [`Figure`]s. The crate's own tests and the example `validate`
//! run the same measures, so a figure is computed in one place. Bands that a source states are told apart from
//! tolerances that are ours.
//!
//! ```
//! use simworld_traffic::validation::{Effort, MEASURES};
//! let discharge = MEASURES.iter().find(|measure| measure.name == "queue discharge").expect("it is listed");
//! let figures = (discharge.run)(Effort::Short)?;
//! assert!(figures.iter().all(|figure| figure.is_ok()));
//! # Ok::<(), simworld_traffic::validation::ValidationError>(())
//! ```

mod actuated;
mod coordination;
pub mod corridor;
mod delay;
mod discharge;
mod following;
pub mod halls;
mod policies;
mod priority;
mod ring;
mod streets;
mod turning;
mod walking;

use std::fmt;

use simworld_core::net::NetworkError;
use thiserror::Error;

use crate::TrafficError;

/// How long measures run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Effort {
    /// Few seeds and settings, some seconds in all: for tests at every change.
    #[default]
    Short,
    /// All of them.
    Whole,
}

impl Effort {
    /// One of two values.
    pub(crate) fn pick<T>(self, short: T, whole: T) -> T {
        match self {
            Self::Short => short,
            Self::Whole => whole,
        }
    }
}

/// Who says how far a figure may be off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tolerance {
    /// The source itself.
    Stated,
    /// We do: the source gives a value without a tolerance.
    Ours,
}

/// A measured figure and the band in which it should be.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What it is.
    pub name: String,
    /// What was measured.
    pub value: f64,
    /// Least and greatest value that is right; either may be infinite.
    pub band: (f64, f64),
    /// Unit, empty for shares and ratios.
    pub unit: &'static str,
    /// Where the band comes from.
    pub source: &'static str,
    /// Who set the tolerance.
    pub tolerance: Tolerance,
}

impl Figure {
    /// Whether it is in its band; NaN never is.
    pub fn is_ok(&self) -> bool {
        (self.band.0..=self.band.1).contains(&self.value)
    }

    /// A figure that should be near a value, within a share of it; the tolerance is ours.
    fn near(name: impl Into<String>, value: f64, of: f64, share: f64, unit: &'static str) -> Self {
        let reach = of.abs() * share;
        Self::within(name, value, (of - reach, of + reach), unit)
    }

    /// A figure that should lie in a band; the tolerance is ours.
    fn within(name: impl Into<String>, value: f64, band: (f64, f64), unit: &'static str) -> Self {
        Self { name: name.into(), value, band, unit, source: "", tolerance: Tolerance::Ours }
    }

    fn cited(mut self, source: &'static str) -> Self {
        self.source = source;
        self
    }

    fn stated(mut self) -> Self {
        self.tolerance = Tolerance::Stated;
        self
    }
}

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mark = if self.is_ok() { "ok " } else { "OFF" };
        let (low, high) = self.band;
        let band = match (low.is_finite(), high.is_finite()) {
            (true, true) => format!("{} to {}", short(low), short(high)),
            (true, false) => format!("at least {}", short(low)),
            (false, true) => format!("at most {}", short(high)),
            (false, false) => "any".to_owned(),
        };
        write!(f, "{mark} {:<58} {:>9} {:<9} {band}", self.name, short(self.value), self.unit)
    }
}

/// Three figures or so.
fn short(value: f64) -> String {
    match value.abs() {
        size if size >= 100.0 || size == 0.0 => format!("{value:.0}"),
        size if size >= 10.0 => format!("{value:.1}"),
        size if size >= 0.1 => format!("{value:.2}"),
        _ => format!("{value:.4}"),
    }
}

/// Why a measure has no figures.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ValidationError {
    /// The street could not be built.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// The traffic could not be set up.
    #[error(transparent)]
    Traffic(#[from] TrafficError),
    /// The set-up ran and did not show what was to be measured.
    #[error("{measure}: {reason}")]
    Nothing {
        /// Which measure.
        measure: &'static str,
        /// What was missing.
        reason: String,
    },
}

type Figures = Result<Vec<Figure>, ValidationError>;

/// Something that can be measured.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Its name.
    pub name: &'static str,
    /// What is looked at, in a sentence.
    pub about: &'static str,
    /// Measures it.
    pub run: fn(Effort) -> Result<Vec<Figure>, ValidationError>,
}

/// All measures: of vehicles first, then of people.
pub const MEASURES: &[Measure] = &[
    Measure {
        name: "queue discharge",
        about: "22 stopped cars at a green light, straight on, at steps of 0.05, 0.1 and 0.2 s",
        run: discharge::measure,
    },
    Measure {
        name: "queue discharge, other models",
        about: "the same by Krauss beside SUMO's, and by each model on a street beside itself alone",
        run: discharge::other_models,
    },
    Measure {
        name: "ring",
        about: "flow over density on a ring without signals, against the curve of the model",
        run: ring::measure,
    },
    Measure {
        name: "equilibrium gap",
        about: "gaps in a platoon that follows at constant speed, on a lane",
        run: following::equilibrium,
    },
    Measure {
        name: "platoon",
        about: "how a wave grows or fades along a platoon, against the linear theory",
        run: following::platoon,
    },
    Measure {
        name: "late decisions",
        about: "how a wave grows along a platoon of drivers who decide every so often, against the linear theory",
        run: following::late_decisions,
    },
    Measure {
        name: "errors of drivers",
        about: "how much speeds differ on a ring of drivers who misjudge gaps, or dawdle",
        run: ring::errors,
    },
    Measure {
        name: "fixed signal",
        about: "control delay at the stop line, arrivals even and at random",
        run: delay::fixed_signal,
    },
    Measure {
        name: "Webster's cycle",
        about: "delay at the cycle of the formula against the best of a sweep",
        run: delay::cycle_sweep,
    },
    Measure {
        name: "green wave",
        about: "stops of a platoon on a street of three signals, in the wave and against it",
        run: coordination::measure,
    },
    Measure {
        name: "actuated signal",
        about: "when greens end: gap, least and longest green",
        run: actuated::measure,
    },
    Measure {
        name: "gap acceptance",
        about: "capacity of movements that give way, over the flow with priority",
        run: priority::measure,
    },
    Measure {
        name: "roundabout",
        about: "capacity of an entry, over the flow in the ring",
        run: priority::roundabout,
    },
    Measure {
        name: "uneven demand",
        about: "policies that look against fixed time, one road busier than the other",
        run: policies::measure,
    },
    Measure { name: "turning shares", about: "turns drawn by their weights", run: turning::measure },
    Measure {
        name: "walking speed",
        about: "speed over density in a corridor whose ends are joined",
        run: walking::speed_over_density,
    },
    Measure { name: "doors", about: "flow through a door, a second and metre", run: walking::doors },
    Measure { name: "streams that meet", about: "how far they part into lanes", run: walking::streams },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_knows_its_band() {
        let figure = Figure::near("flow", 1886.0, 1900.0, 0.05, "veh/h");
        assert!(figure.is_ok() && figure.to_string().starts_with("ok "));
        assert!(!Figure { value: f64::NAN, ..figure.clone() }.is_ok());
        assert!(Figure { value: 1700.0, ..figure }.to_string().starts_with("OFF"));
    }

    #[test]
    fn measures_have_names_of_their_own() {
        let mut names: Vec<&str> = MEASURES.iter().map(|measure| measure.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), MEASURES.len());
    }
}
