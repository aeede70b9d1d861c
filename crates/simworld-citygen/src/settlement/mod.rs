//! A place as it is asked for: from a [`SceneSpec`] to a city with as many houses, with its districts, its landmarks, its squares, its
//! parks and its water.

mod aim;
mod areas;
mod districts;
mod error;
mod extent;
mod landmarks;
mod layout;
mod uses;

use simworld_core::asset::Catalogue;
use simworld_core::environment::Environment;
use simworld_core::scene::World;
use simworld_core::seed::Seed;
use simworld_core::spec::{Amount, BuildingWish, DistrictKind, Height, Pattern, SceneKind, SceneSpec, Width};

pub use areas::Area;
pub use error::{SettlementError, SettlementRemark};
pub use landmarks::Landmark;

use crate::building::Building;
use crate::landscape::present_or_new;
use crate::{City, CityConfig, CityEntities, Style};
use extent::{Extent, middle_of};
use layout::Grounds;

/// Houses that a piece of street has, on the safe side.
const HOUSES: u32 = 3;
/// Pieces of street where neither streets nor houses are counted.
const STREETS: u32 = 60;
/// So often a city with too few houses is grown anew with half as many streets again.
const TRIES: u32 = 9;
/// So often it is grown anew where squares, parks and landmarks find no room.
const TRIES_FOR_GROUND: u32 = 3;
/// Storeys of low houses at the most, and of high ones in the middle at the least.
const LOW: u32 = 2;
const HIGH: u32 = 6;
/// So many houses are no city yet, and have so many storeys at the most where nothing else is said.
const SMALL: u32 = 150;
const SMALL_STOREYS: u32 = 4;
/// Where the middle of a place ends, as a share of the way to its farthest house.
const MIDDLE: f64 = 0.5;

/// A place that was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Settlement {
    /// Its streets, houses and all that stands along them.
    pub city: City,
    /// Squares, parks and water.
    pub areas: Vec<Area>,
    /// Buildings of the library that were asked for by name; they are none of the city's.
    pub landmarks: Vec<Landmark>,
    /// What is otherwise than it was asked for.
    pub remarks: Vec<SettlementRemark>,
    /// Sun and weather.
    pub environment: Environment,
}

impl Settlement {
    /// Makes what is asked for: what is counted in the spec is so in the result. The same spec and seed give the same place, bit for bit.
    ///
    /// ```
    /// use simworld_citygen::settlement::Settlement;
    /// use simworld_core::seed::Seed;
    /// use simworld_core::spec::SceneSpec;
    /// let mut spec = SceneSpec::default();
    /// spec.buildings.count = Some(20);
    /// spec.features.squares = vec!["Market Square".to_owned()];
    /// let place = Settlement::build(&spec, Seed(7))?;
    /// assert_eq!((place.city.buildings.len(), place.areas.len()), (20, 1));
    /// # Ok::<(), simworld_citygen::settlement::SettlementError>(())
    /// ```
    ///
    /// # Errors
    /// A spec out of range, another kind of scene than a city, a landmark that the library does not have, or more than finds room.
    pub fn build(spec: &SceneSpec, seed: Seed) -> Result<Self, SettlementError> {
        spec.validate()?;
        if spec.kind != SceneKind::City {
            return Err(SettlementError::Kind { kind: spec.kind.as_str() });
        }
        let wanted = spec.buildings.count.unwrap_or(0).max(spec.features.places.values().sum());
        let mut count = spec.streets.count.unwrap_or(match spec.buildings.count {
            Some(count) => (count / HOUSES).max(6),
            None => STREETS,
        });
        let mut most = 0;
        for rank in 0..TRIES {
            let may_grow = spec.streets.count.is_none() && rank + 1 < TRIES_FOR_GROUND;
            // What a block of some more streets may hold is not put outside of them.
            let grounds = if may_grow { Grounds::Within } else { Grounds::Beyond };
            match Self::grown(spec, (count, wanted), grounds, seed) {
                Ok(Ok(place)) => return Ok(place),
                Ok(Err(houses)) => most = houses,
                Err(SettlementError::NoGround { .. }) if may_grow => {}
                Err(error) => return Err(error),
            }
            count = count * 3 / 2 + 1;
        }
        Err(SettlementError::TooMany { wanted, most })
    }

    /// The place on so many pieces of street, or how many houses it has if these are fewer than are wanted.
    fn grown(
        spec: &SceneSpec,
        (streets, wanted): (u32, u32),
        grounds: Grounds,
        seed: Seed,
    ) -> Result<Result<Self, usize>, SettlementError> {
        let mut config = config_of(spec, streets);
        let mut city = City::generate(&config, seed)?;
        let mut extent = Extent::of(&city.buildings, spec.buildings.count);
        if !spec.features.districts.is_empty() {
            // How far the place reaches is known once there are houses; the streets stay the same.
            config.zoning.districts = districts::placed(&spec.features, extent, seed);
            city = City::generate(&config, seed)?;
            extent = Extent::of(&city.buildings, spec.buildings.count);
        }
        city.provenance.title.clone_from(&spec.title);
        let mut laid = layout::laid_out(&mut city, &spec.features, (extent, grounds), &Catalogue::library())?;
        if city.buildings.len() < wanted as usize {
            return Ok(Err(city.buildings.len()));
        }
        keep(&mut city, &spec.buildings);
        let told = uses::use_as(&mut city, &spec.features, &laid);
        laid.remarks.extend(told);
        let layout::Laid { areas, landmarks, remarks } = laid;
        Ok(Ok(Self { city, areas, landmarks, remarks, environment: spec.environment }))
    }

    /// Puts the place into a world, with its sun and weather.
    ///
    /// # Errors
    /// The world refused an entity, or the weather is out of range.
    pub fn populate(&self, world: &mut World) -> Result<CityEntities, SettlementError> {
        let mut entities = self.city.populate(world)?;
        for area in &self.areas {
            entities.surfaces.push(world.spawn(area.desc())?);
        }
        let library = Catalogue::library();
        for landmark in &self.landmarks {
            let missing = || SettlementError::Landmark { name: landmark.asset.clone() };
            let asset = library.find(&landmark.asset).and_then(|id| library.get(id)).ok_or_else(missing)?;
            if let Some(ground) = landmark.ground(asset, self.city.network.bounds()) {
                entities.surfaces.push(world.spawn(ground)?);
            }
            let id = present_or_new(asset.clone(), world)?;
            entities.buildings.push(world.spawn(landmark.desc(asset, id))?);
        }
        world.set_environment(self.environment).map_err(simworld_core::spec::SpecError::from)?;
        Ok(entities)
    }
}

/// Leaves so many houses as are wanted, those nearest to the middle, as high as they are wanted.
fn keep(city: &mut City, wish: &BuildingWish) {
    let middle = middle_of(&city.buildings);
    let away = |building: &Building| (building.center - middle).norm();
    if let Some(count) = wish.count {
        let mut ranked: Vec<(usize, f64)> = city.buildings.iter().map(away).enumerate().collect();
        ranked.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        let mut kept = vec![false; city.buildings.len()];
        ranked.iter().take(count as usize).for_each(|(index, _)| kept[*index] = true);
        let mut kept = kept.into_iter();
        city.buildings.retain(|_| kept.next().unwrap_or(false));
    }
    let farthest = city.buildings.iter().map(away).fold(0.0, f64::max);
    let is_small = wish.count.is_some_and(|count| count <= SMALL);
    let districts = &city.config.zoning.districts;
    for building in &mut city.buildings {
        let central = away(building) <= farthest * MIDDLE;
        let district = districts.iter().find(|district| district.form.holds(building.center));
        let is_old = district.is_some_and(|district| district.kind == DistrictKind::OldTown);
        building.storeys = match wish.height {
            Height::Low => building.storeys.min(LOW),
            Height::High if central && !is_old => building.storeys.max(HIGH),
            Height::Usual if is_small => building.storeys.min(SMALL_STOREYS),
            _ if is_old => building.storeys.min(SMALL_STOREYS),
            Height::Usual | Height::High => building.storeys,
        };
    }
}

/// The settings of the generator that a spec means, for so many pieces of street.
pub fn config_of(spec: &SceneSpec, streets: u32) -> CityConfig {
    let style = match spec.streets.pattern {
        Pattern::Mixed => Style::Mixed,
        Pattern::Grid => Style::Grid,
        Pattern::Winding => Style::Organic,
        Pattern::Suburb => Style::Suburb,
    };
    let mut config = CityConfig { roads: style.roads(streets), ..CityConfig::default() };
    let roads = &mut config.roads;
    match spec.streets.width {
        Width::Narrow => {
            (roads.lane_width, roads.sidewalk_width, roads.parking_width) = (2.6, 1.8, 0.0);
            (roads.arterial_lanes, roads.highways) = (1, 0);
            (roads.arterial_median_width, roads.arterial_cycle_width, roads.arterial_parking_width) =
                (0.0, 0.0, 0.0);
        }
        Width::Usual => {}
        Width::Wide => (roads.lane_width, roads.sidewalk_width, roads.arterial_lanes) = (3.75, 5.0, 2),
    }
    let share = |amount| match amount {
        Amount::None => 0.0,
        Amount::Few => 0.35,
        Amount::Usual => 1.0,
        Amount::Many => 1.5,
    };
    config.elements.trees *= share(spec.streets.trees);
    config.elements.green_trees *= share(spec.streets.trees);
    config.elements.parked = (config.elements.parked * share(spec.streets.parked)).min(1.0);
    config
}
