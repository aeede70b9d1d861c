//! A place as it is asked for: from a [`SceneSpec`] to a city with as many houses, with its squares, its parks and its water.

mod areas;
mod error;

use std::collections::BTreeMap;

use simworld_core::environment::Environment;
use simworld_core::geometry::Point2;
use simworld_core::scene::{Place, World};
use simworld_core::seed::Seed;
use simworld_core::spec::{Amount, BuildingWish, Height, Pattern, SceneKind, SceneSpec, Width};

pub use areas::Area;
pub use error::SettlementError;

use crate::building::Building;
use crate::{City, CityConfig, CityEntities, Style};

/// Houses that a piece of street has, on the safe side.
const HOUSES: u32 = 3;
/// Pieces of street where neither streets nor houses are counted.
const STREETS: u32 = 60;
/// So often a city with too few houses is grown anew with half as many streets again.
const TRIES: u32 = 9;
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
    /// A spec out of range, another kind of scene than a city, or more than finds room.
    pub fn build(spec: &SceneSpec, seed: Seed) -> Result<Self, SettlementError> {
        spec.validate()?;
        if spec.kind != SceneKind::City {
            return Err(SettlementError::Kind { kind: spec.kind.as_str() });
        }
        if let Some(name) = spec.features.landmarks.keys().next() {
            return Err(SettlementError::Landmark { name: name.clone() });
        }
        let wanted = spec.buildings.count.unwrap_or(0).max(spec.features.places.values().sum());
        let mut count = spec.streets.count.unwrap_or(match spec.buildings.count {
            Some(count) => (count / HOUSES).max(6),
            None => STREETS,
        });
        let mut most = 0;
        for _ in 0..TRIES {
            let mut city = City::generate(&config_of(spec, count), seed)?;
            city.provenance.title.clone_from(&spec.title);
            let areas = areas::laid_out(&mut city, &spec.features)?;
            most = city.buildings.len();
            if most >= wanted as usize {
                let mut place = Self { city, areas, environment: spec.environment };
                place.keep(&spec.buildings);
                place.use_as(&spec.features.places);
                return Ok(place);
            }
            count = count * 3 / 2 + 1;
        }
        Err(SettlementError::TooMany { wanted, most })
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
        world.set_environment(self.environment).map_err(simworld_core::spec::SpecError::from)?;
        Ok(entities)
    }

    /// Leaves so many houses as are wanted, those nearest to the middle, as high as they are wanted.
    fn keep(&mut self, wish: &BuildingWish) {
        let middle = middle_of(&self.city.buildings);
        let away = |building: &Building| (building.center - middle).norm();
        if let Some(count) = wish.count {
            let mut ranked: Vec<(usize, f64)> = self.city.buildings.iter().map(away).enumerate().collect();
            ranked.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
            let mut kept = vec![false; self.city.buildings.len()];
            ranked.iter().take(count as usize).for_each(|(index, _)| kept[*index] = true);
            let mut kept = kept.into_iter();
            self.city.buildings.retain(|_| kept.next().unwrap_or(false));
        }
        let farthest = self.city.buildings.iter().map(away).fold(0.0, f64::max);
        let is_small = wish.count.is_some_and(|count| count <= SMALL);
        for building in &mut self.city.buildings {
            let central = away(building) <= farthest * MIDDLE;
            building.storeys = match wish.height {
                Height::Low => building.storeys.min(LOW),
                Height::High if central => building.storeys.max(HIGH),
                Height::Usual if is_small => building.storeys.min(SMALL_STOREYS),
                Height::Usual | Height::High => building.storeys,
            };
        }
    }

    /// Has exactly so many houses of each use that is named: the largest near the middle take it on, and what is too much is lived in.
    fn use_as(&mut self, wanted: &BTreeMap<Place, u32>) {
        let middle = middle_of(&self.city.buildings);
        for (place, count) in wanted {
            let mut have: Vec<usize> = (0..self.city.buildings.len())
                .filter(|index| self.city.buildings[*index].place == *place)
                .collect();
            for index in have.split_off(have.len().min(*count as usize)) {
                let building = &mut self.city.buildings[index];
                (building.place, building.name) = (Place::Home, None);
            }
            for number in have.len()..*count as usize {
                let free = self
                    .city
                    .buildings
                    .iter()
                    .enumerate()
                    .filter(|(_, one)| !wanted.contains_key(&one.place));
                let fit = |one: &Building| one.footprint_area() / (50.0 + (one.center - middle).norm());
                let best = free.max_by(|a, b| fit(a.1).total_cmp(&fit(b.1)).then(b.0.cmp(&a.0)));
                let Some(index) = best.map(|(index, _)| index) else { return };
                let building = &mut self.city.buildings[index];
                building.place = *place;
                building.name = Some(name_of(*place, number, self.city.provenance.title.as_deref()));
            }
        }
    }
}

/// "Little Haven Museum", "Second Museum".
fn name_of(place: Place, number: usize, title: Option<&str>) -> String {
    let mut word = place.as_str().replace('_', " ");
    if let Some(first) = word.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    match number {
        0 => format!("{} {word}", title.unwrap_or("Town")),
        1 => format!("Second {word}"),
        2 => format!("Third {word}"),
        more => format!("{word} {}", more + 1),
    }
}

fn middle_of(buildings: &[Building]) -> Point2 {
    let count = buildings.len().max(1) as f64;
    Point2::from(
        buildings.iter().fold(nalgebra::Vector2::zeros(), |sum, one| sum + one.center.coords / count),
    )
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
