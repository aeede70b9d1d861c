//! A city on the streets of a real place, with its buildings and what stands in its streets.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::RoadNetwork;
use simworld_core::scene::EntityKind;
use simworld_core::seed::Seed;

use super::building::{self, Outline};
use super::error::Warning;
use super::ground;
use super::mask::Mask;
use super::near::Near;
use super::place::Place;
use super::street::{Planned, StreetOptions};
use super::{CREDIT, footway, things};
use crate::building::Building;
use crate::element::{self, Setting};
use crate::lot::Land;
use crate::occupancy::Occupancy;
use crate::threads::AllThreads;
use crate::zoning::Zoning;
use crate::{City, CityConfig, CityError, Provenance};

/// Whether something is generated where the map has nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fill {
    /// Where the map has nothing far and wide.
    #[default]
    WhereMissing,
    /// Never: nothing stands but what the map has.
    Never,
}

/// How a place becomes a city.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PlaceOptions {
    /// How ways become streets.
    pub streets: StreetOptions,
    /// Whether buildings are generated on lots far from all of the map's.
    pub buildings: Fill,
    /// Whether trees, lamps and the like are generated along streets, each kind if the map has few of it.
    pub elements: Fill,
}

/// Lots nearer than one or two of these to a building of the map are not filled, m.
const FILLED_CELL: f64 = 90.0;
/// A kind of thing of which the map has less than one on so much sidewalk is generated, m.
const FEW: f64 = 150.0;

impl City {
    /// Builds a city of a real place: its streets, its ways for walkers, its buildings, and what stands in its streets. The
    /// same place, settings and seed give the same city; the seed decides of what is generated only. Parks are not
    /// invented: their share is set to nothing in the configuration of the city.
    ///
    /// # Errors
    /// A setting out of range, or a place without a street that can be built.
    pub fn from_place(
        place: &Place,
        options: &PlaceOptions,
        config: &CityConfig,
        seed: Seed,
    ) -> Result<(Self, Vec<Warning>), CityError> {
        let mut config = config.clone();
        config.zoning.parks = 0.0;
        config.validate()?;
        options.streets.validate()?;
        let mut warnings = place.warnings.clone();
        let outlines = building::outlines(place, &mut warnings);
        let Planned { mut plan, off_ground } = place.plan_between(&options.streets, &outlines, &mut warnings);
        if plan.streets.is_empty() {
            return Err(CityError::NoStreets);
        }
        let low = crate::terrain::raise(&mut plan, &config.terrain, seed)?;
        warnings.extend(low.into_iter().map(|low| {
            let at = Some(place.geographic(Point2::new(low.x, low.y)));
            Warning { what: low.to_string(), element: None, at }
        }));
        let mut network = RoadNetwork::derive_with(&plan, &config.network, &AllThreads)?;
        let zoning = Zoning::new(&config.zoning, seed);
        let is_filled = (options.buildings, options.elements) != (Fill::Never, Fill::Never);
        let mut taken = land_of_roads(place, &network, &off_ground, is_filled);
        let of_network = || Land::of_network(&network, &zoning, &config.lots, seed, &taken);
        let land = if is_filled { of_network() } else { Land::default() };
        let (mut buildings, carriageways) =
            mapped(place, outlines, &network, &off_ground, &mut taken, &mut warnings);
        let footways = footway::lay(place, &network, &buildings, &mut warnings);
        // All that the map has stands before anything is made up.
        let mut elements = things::set(place, &network, &carriageways, &mut taken, &mut warnings);
        footways.take(&mut taken);
        (network.footpaths, network.plazas) = (footways.paths, footways.plazas);
        if options.buildings == Fill::WhereMissing {
            let open = without_lots_near(&land, &buildings);
            let built = crate::building::build(&network, &open, &config.buildings, seed, &mut taken);
            buildings.extend(footway::below_none(&network.footpaths, built));
        }
        let setting = Setting {
            plan: &plan,
            network: &network,
            zoning: &zoning,
            land: &land,
            buildings: &buildings,
            within: None,
        };
        if options.elements == Fill::WhereMissing {
            let wanted = left_by_the_map(&config.elements, &elements, &network);
            elements.extend(element::furnish(&setting, &wanted, seed, &mut taken));
        }
        let city = Self {
            config,
            provenance: provenance(place, seed),
            plan,
            network: Arc::new(network),
            buildings,
            elements,
            frontage: land.frontage,
        };
        Ok((city, warnings))
    }
}

fn provenance(place: &Place, seed: Seed) -> Provenance {
    let credit = Some(CREDIT.to_owned());
    Provenance { credit, origin: Some(place.origin), ..Provenance::of_seed(seed) }
}

/// The land of the roads on the ground; unless something will be generated, as far as things of the map may stand on it.
fn land_of_roads(place: &Place, network: &RoadNetwork, off_ground: &[bool], is_filled: bool) -> Occupancy {
    let on_ground = |road: RoadId| !off_ground[road.index()];
    if is_filled {
        return Occupancy::of_roads_where(network, on_ground);
    }
    let mut mask = Mask::new();
    things::mark(place, &mut mask, things::LARGEST);
    Near::of(network, on_ground, &mask, 0.0).land(network)
}

/// The buildings of the map that stand, out of the way of traffic, and what is driven on near what the map has.
fn mapped(
    place: &Place,
    mut outlines: Vec<Outline>,
    network: &RoadNetwork,
    off_ground: &[bool],
    taken: &mut Occupancy,
    warnings: &mut Vec<Warning>,
) -> (Vec<Building>, Occupancy) {
    building::adopt(place, &mut outlines);
    let raised = building::raise_all(&mut outlines, network);
    let mut mask = Mask::new();
    raised.iter().flatten().flat_map(|raised| &raised.pieces).for_each(|piece| mask.mark(piece, 0.0));
    things::mark(place, &mut mask, things::LARGEST);
    let carriageways = ground::carriageways(network, off_ground, &mask);
    let buildings = building::stand(place, &outlines, raised, &carriageways, taken, warnings);
    (buildings, carriageways)
}

/// The land without the lots that lie near a building.
fn without_lots_near(land: &Land, buildings: &[Building]) -> Land {
    let cell =
        |point: Point2| ((point.x / FILLED_CELL).floor() as i64, (point.y / FILLED_CELL).floor() as i64);
    let mut built: Vec<(i64, i64)> = buildings.iter().map(|building| cell(building.center)).collect();
    built.sort_unstable();
    built.dedup();
    let mut open = land.clone();
    open.lots.retain(|lot| {
        let outline = land.outline(lot);
        let Some(corner) = outline.first() else { return false };
        let (column, row) = cell(*corner);
        let around = (column - 1..=column + 1).flat_map(|x| (row - 1..=row + 1).map(move |y| (x, y)));
        around.into_iter().all(|cell| built.binary_search(&cell).is_err())
    });
    open
}

/// What is left to be generated: nothing of what the map has already.
fn left_by_the_map(
    config: &crate::ElementConfig,
    elements: &[crate::element::Element],
    network: &RoadNetwork,
) -> crate::ElementConfig {
    let mut wanted = config.clone();
    let sidewalks: f64 =
        network.sidewalks.iter().map(|sidewalk| simworld_core::net::polyline::length(&sidewalk.path)).sum();
    let are_many = |kind: EntityKind| {
        let count = elements.iter().filter(|element| element.kind == kind).count();
        count as f64 * FEW > sidewalks
    };
    if are_many(EntityKind::Tree) {
        (wanted.trees, wanted.green_trees) = (0.0, 0.0);
    }
    if are_many(EntityKind::StreetLamp) {
        wanted.lamps = 0.0;
    }
    wanted
}
