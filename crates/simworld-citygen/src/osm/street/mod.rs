//! From ways to a plan of streets.
//!
//! Ways are split where they meet, lanes are read from tags, ways that cross without a node are cut, pieces too short
//! for a street are merged away, and what is not connected with the rest is left out or kept as the options say.

mod circle;
mod collapse;
mod control;
mod cross;
mod emit;
mod ends;
mod kind;
mod merge;
mod over;
mod pair;
mod profile;
mod room;
mod split;
mod tidy;
mod turns;
mod web;

use serde::{Deserialize, Serialize};
use simworld_core::net::StreetPlan;
use simworld_core::seed::Seed;

use super::building::Outline;
use super::error::Warning;
use super::place::Place;
use super::side::is_left_hand;
use crate::{CityError, RoadSource};
use kind::Kind;
pub(super) use kind::is_street;
pub(super) use split::{level, uses};

/// Which service roads become streets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ServiceRoads {
    /// None.
    #[default]
    None,
    /// Those that lead somewhere: no driveways, no aisles of car parks.
    Through,
}

/// What becomes of streets that are not connected with the most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Parts {
    /// They are left out.
    #[default]
    Largest,
    /// They are kept.
    All,
}

/// How ways become streets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StreetOptions {
    /// Which service roads become streets.
    pub service: ServiceRoads,
    /// What becomes of streets that are not connected with the most.
    pub parts: Parts,
    /// Junctions of the two carriageways of a road, or of one set of signals, nearer to each other than this become
    /// one, m, in [0, 60].
    pub merge: f64,
}

impl Default for StreetOptions {
    fn default() -> Self {
        Self { service: ServiceRoads::None, parts: Parts::Largest, merge: 32.0 }
    }
}

impl StreetOptions {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), CityError> {
        crate::range::check(&[("streets.merge", self.merge, 0.0, 60.0, "0 to 60 m")])
    }
}

/// A plan, and which of its streets do not lie open on the ground: bridges, tunnels, passages through buildings.
pub(super) struct Planned {
    pub(super) plan: StreetPlan,
    pub(super) off_ground: Vec<bool>,
}

impl Place {
    /// Its streets, and what was odd about them. A place without streets gives a plan without any.
    pub fn plan(&self, options: &StreetOptions) -> (StreetPlan, Vec<Warning>) {
        let mut warnings = self.warnings.clone();
        let planned = self.plan_between(options, &[], &mut warnings);
        (planned.plan, warnings)
    }

    /// Its streets, no wider than the buildings leave room for.
    pub(super) fn plan_between(
        &self,
        options: &StreetOptions,
        buildings: &[Outline],
        warnings: &mut Vec<Warning>,
    ) -> Planned {
        let mut web = split::web_of(self, options, is_left_hand(self), warnings);
        web.join_all();
        cross::cut_crossings(&mut web, None, self, warnings);
        web.simplify();
        let lengths = cross::lengths(&web);
        if options.merge > 0.0 {
            merge::merge_junctions(&mut web, self, options.merge);
            pair::join_carriageways(&mut web, options.merge);
            web.join_all();
        }
        collapse::collapse(&mut web, self, warnings);
        collapse::collapse_tight(&mut web);
        pair::join_carriageways(&mut web, options.merge);
        // Joined carriageways are wider, and their junctions reach farther.
        collapse::collapse_tight(&mut web);
        // What was drawn together may lie across others now.
        if cross::cut_crossings(&mut web, Some(&lengths), self, warnings) {
            collapse::collapse(&mut web, self, warnings);
        }
        tidy::part_doubles(&mut web, self, warnings);
        if options.parts == Parts::Largest {
            tidy::keep_largest(&mut web, self, warnings);
        }
        room::fit(&mut web, buildings);
        ends::straighten(&mut web);
        over::settle(&mut web, warnings);
        emit::plan(&web, self, warnings)
    }
}

/// The streets of a place, with the usual options; warnings are dropped.
impl RoadSource for Place {
    fn streets(&self, _: Seed) -> Result<StreetPlan, CityError> {
        let (plan, _) = self.plan(&StreetOptions::default());
        if plan.streets.is_empty() { Err(CityError::NoStreets) } else { Ok(plan) }
    }
}
