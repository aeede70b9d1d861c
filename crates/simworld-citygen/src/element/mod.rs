//! Street elements by zone: trees, lamps and small things at the kerb, furniture between sidewalk and houses, tables
//! before restaurants, cars in parking lanes, trees in parks and courtyards.
//!
//! A width of [`FREE_WIDTH`] in the middle of every sidewalk stays free for those who walk, and so do the places before
//! doors, at corners and at crossings. What stands at the kerb stands on the sidewalk, what stands behind it on the land
//! of the houses: nothing stands in a lane that is driven on.

mod green;
mod kinds;
mod parking;
mod sidewalk;
mod walk;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Obb, Point2, Point3, pose_facing};
use simworld_core::id::RoadId;
use simworld_core::net::{RoadNetwork, Side, StreetPlan};
use simworld_core::scene::{EntityKind, Shape};
use simworld_core::seed::Seed;

use crate::ElementConfig;
use crate::block::Border;
use crate::building::Building;
use crate::decks;
use crate::lot::Land;
use crate::occupancy::Occupancy;
use crate::range::{is_place, is_size};
use crate::zoning::Zoning;

/// Width kept free in the middle of every sidewalk, m: two people who pass, or one in a wheelchair.
pub const FREE_WIDTH: f64 = 1.5;

/// A thing that stands in the street.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Element {
    /// What it is.
    pub kind: EntityKind,
    /// Where it stands, m.
    pub position: Point2,
    /// Where it looks, radians: the street; a parked car the way that it drives.
    pub facing: f64,
    /// Its solid; a tree's is its trunk.
    pub shape: Shape,
    /// The side of the street along which it was set, or of the block that it stands in; [`Border::LAND`] of what a map or a
    /// hand put here.
    pub along: Border,
}

impl Element {
    /// Whether its place and size are possible.
    pub(crate) fn is_sound(&self) -> bool {
        let size = self.shape.size();
        is_place(&self.position) && self.facing.is_finite() && (0..3).all(|axis| is_size(size[axis]))
    }

    /// Its solid as an oriented box.
    pub fn obb(&self) -> Obb {
        self.shape.obb(&pose_facing(Point3::new(self.position.x, self.position.y, 0.0), self.facing))
    }
}

/// What there is before elements are set.
#[derive(Clone, Copy, Debug)]
pub struct Setting<'a> {
    /// The streets, for their cross-sections.
    pub plan: &'a StreetPlan,
    /// The roads derived from them.
    pub network: &'a RoadNetwork,
    /// The use of the land.
    pub zoning: &'a Zoning,
    /// The land between the streets.
    pub land: &'a Land,
    /// What stands on it.
    pub buildings: &'a [Building],
    /// The streets along which elements are set; all of them if nothing is said.
    pub within: Option<&'a Extent>,
}

/// A part of the streets of a plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Extent {
    /// So many streets, the first ones of the plan, belong to it with their carriageway.
    pub streets: usize,
    /// For each street, whether what lies on its left and on its right belongs to it.
    pub sides: Vec<[bool; 2]>,
}

impl Extent {
    /// The sides that belong to it, ascending: side 2i is the left of road i, side 2i + 1 its right.
    pub(crate) fn numbered_sides(&self) -> impl Iterator<Item = usize> + '_ {
        let all = self.sides.iter().flatten().enumerate();
        all.filter(|(_, belongs)| **belongs).map(|(side, _)| side)
    }

    /// Whether what lies on either side of a road belongs to it.
    pub(crate) fn has_any_side(&self, road: RoadId) -> bool {
        [Side::Left, Side::Right].into_iter().any(|side| self.has_side(road, side))
    }

    /// Whether what lies on one side of a road belongs to it.
    pub fn has_side(&self, road: RoadId, side: Side) -> bool {
        self.sides.get(road.index()).is_some_and(|sides| sides[usize::from(side == Side::Right)])
    }
}

impl Setting<'_> {
    /// Whether elements are set on one side of a road: nothing grows on bridges and in tunnels.
    fn has_side(&self, road: RoadId, side: Side) -> bool {
        self.network.roads[road.index()].level == 0
            && self.within.is_none_or(|extent| extent.has_side(road, side))
    }

    /// How many streets, the first ones, have parked cars.
    fn streets(&self) -> usize {
        self.within.map_or(self.plan.streets.len(), |extent| extent.streets)
    }
}

/// Whether something behind the sidewalks of a road would like to stand where something of another road would, so that it
/// matters whose sidewalk comes first.
pub(crate) fn is_contested(setting: &Setting<'_>, config: &ElementConfig, seed: Seed, road: RoadId) -> bool {
    sidewalk::is_contested(setting, config, seed.stream("citygen/elements").named("sidewalks"), road)
}

/// Sets elements along every sidewalk, in parking lanes and on greens; `taken` holds the land of the roads and the
/// buildings, and receives what stands beside them.
pub fn furnish(
    setting: &Setting<'_>,
    config: &ElementConfig,
    seed: Seed,
    taken: &mut Occupancy,
) -> Vec<Element> {
    let streams = seed.stream("citygen/elements");
    let mut elements = Vec::new();
    // Cars park where nothing else may stand, so nobody has to wait for them.
    let ((), parked) = rayon::join(
        || sidewalk::line(setting, config, streams.named("sidewalks"), taken, &mut elements),
        || parking::park(setting, config, streams.named("parking")),
    );
    green::plant(setting, config, streams.named("greens"), taken, &mut elements, parked);
    decks::clear_below(setting.network, &mut elements);
    elements
}
