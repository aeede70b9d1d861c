//! Zoning: what the land is used for, from seeded fields that can be asked at any point, and from the districts that were asked for.
//!
//! Two fields of value noise, the density of people and the character of the place, are functions of the seed and the
//! point alone. So a tile, a thread or an edit far away sees the same zones.

mod district;
mod noise;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::seed::Seed;

use crate::CityError;
pub use district::{District, DistrictForm};
pub(crate) use noise::{RememberedNoise, ValueNoise, floor};

/// What a piece of land is used for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Zone {
    /// Dwellings, with a shop here and there.
    #[default]
    Residential,
    /// Shops, restaurants and offices.
    Commercial,
    /// Factories and warehouses.
    Industrial,
    /// Schools, hospitals, museums.
    Civic,
    /// Green, without buildings but for a pavilion.
    Park,
}

impl Zone {
    /// Every zone.
    pub const ALL: [Self; 5] =
        [Self::Residential, Self::Commercial, Self::Industrial, Self::Civic, Self::Park];

    /// The name in files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Residential => "residential",
            Self::Commercial => "commercial",
            Self::Industrial => "industrial",
            Self::Civic => "civic",
            Self::Park => "park",
        }
    }
}

/// How the land is divided among its uses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ZoningConfig {
    /// Distance over which the density of people changes, m, in [50, 20 000].
    pub density_scale: f64,
    /// Distance over which the use of the land changes, m, in [50, 20 000].
    pub use_scale: f64,
    /// Radius of the densest quarter, round the origin, m, in [0, 50 000]; 0 for none.
    pub center_radius: f64,
    /// Share of the land that is industrial where few people live, in [0, 1].
    pub industry: f64,
    /// Share of the land for schools, hospitals and museums, in [0, 0.5].
    pub civic: f64,
    /// Share of the land that is park, in [0, 0.5].
    pub parks: f64,
    /// Parts of the city with a character of their own, at most 64; where they overlap the first counts.
    pub districts: Vec<District>,
}

impl Default for ZoningConfig {
    fn default() -> Self {
        Self {
            density_scale: 700.0,
            use_scale: 220.0,
            center_radius: 450.0,
            industry: 0.2,
            civic: 0.07,
            parks: 0.05,
            districts: Vec::new(),
        }
    }
}

impl ZoningConfig {
    pub(crate) fn validate(&self) -> Result<(), CityError> {
        crate::range::check(&[
            ("zoning.density_scale", self.density_scale, 50.0, 2e4, "50 to 20 000 m"),
            ("zoning.use_scale", self.use_scale, 50.0, 2e4, "50 to 20 000 m"),
            ("zoning.center_radius", self.center_radius, 0.0, 5e4, "0 to 50 000 m"),
            ("zoning.industry", self.industry, 0.0, 1.0, "0 to 1"),
            ("zoning.civic", self.civic, 0.0, 0.5, "0 to 0.5"),
            ("zoning.parks", self.parks, 0.0, 0.5, "0 to 0.5"),
        ])?;
        district::validate(&self.districts)
    }
}

/// The fields of a city; asks no other state.
///
/// ```
/// use simworld_citygen::zoning::{Zone, Zoning, ZoningConfig};
/// use simworld_core::{geometry::Point2, seed::Seed};
/// let zoning = Zoning::new(&ZoningConfig::default(), Seed(7));
/// let here = Point2::new(120.0, -40.0);
/// assert_eq!(zoning.zone(here), Zoning::new(&ZoningConfig::default(), Seed(7)).zone(here));
/// assert!((0.0..=1.0).contains(&zoning.density(here)));
/// ```
#[derive(Clone, Debug)]
pub struct Zoning {
    config: ZoningConfig,
    density: ValueNoise,
    character: ValueNoise,
}

impl Zoning {
    /// The fields of a seed; the configuration is taken as valid.
    pub fn new(config: &ZoningConfig, seed: Seed) -> Self {
        let streams = seed.stream("citygen/zoning");
        Self {
            config: config.clone(),
            density: ValueNoise::new(streams.named("density"), config.density_scale),
            character: ValueNoise::new(streams.named("character"), config.use_scale),
        }
    }

    /// The district at a point, if one lies there.
    pub fn district(&self, point: Point2) -> Option<&District> {
        self.config.districts.iter().find(|district| district.form.holds(point))
    }

    /// How densely people live and work at a point, from 0 (fields) to 1 (the middle of a metropolis).
    pub fn density(&self, point: Point2) -> f64 {
        let usual = self.usual_density(point, self.density.uniform_at(point));
        self.district(point).map_or(usual, |district| district.density(usual))
    }

    /// The density without districts, where the field says `wild`.
    fn usual_density(&self, point: Point2, wild: f64) -> f64 {
        let radius = self.config.center_radius;
        if radius <= 0.0 {
            return wild;
        }
        // A bell without exponentials: 1 in the middle, 1/2 at the radius, 1/5 at twice the radius.
        let bell = 1.0 / (1.0 + point.coords.norm_squared() / (radius * radius));
        (0.62 * wild + 0.55 * bell).min(1.0)
    }

    /// What the land at a point is used for.
    pub fn zone(&self, point: Point2) -> Zone {
        self.at(point).0
    }

    /// Both of them.
    pub(crate) fn at(&self, point: Point2) -> (Zone, f64) {
        self.by(point, self.character.uniform_at(point), self.density.uniform_at(point))
    }

    /// Both from what the fields say of a point.
    fn by(&self, point: Point2, character: f64, wild: f64) -> (Zone, f64) {
        let density = self.usual_density(point, wild);
        match self.district(point) {
            Some(district) => (district.zone(character), district.density(density)),
            None => (self.usual_zone(character, density), density),
        }
    }

    /// What land of a character and a density is used for where no district says so.
    fn usual_zone(&self, character: f64, density: f64) -> Zone {
        let Self { config, .. } = self;
        // The character of the land is spread evenly over [0, 1]: each use takes its share of it, from either end.
        if character < config.parks {
            Zone::Park
        } else if character < config.parks + config.civic {
            Zone::Civic
        } else if density < 0.42 && character > 1.0 - config.industry {
            Zone::Industrial
        } else if character > 1.0 - (density * 1.35 - 0.4).clamp(0.0, 0.8) {
            Zone::Commercial
        } else {
            Zone::Residential
        }
    }
}

/// The fields of a city for one who asks of many places beside each other: the same zones.
#[derive(Clone, Debug)]
pub(crate) struct RememberedZoning<'a> {
    zoning: &'a Zoning,
    density: RememberedNoise,
    character: RememberedNoise,
}

impl<'a> RememberedZoning<'a> {
    /// Squares of each field that are remembered: those of a quarter.
    const SQUARES: usize = 256;

    pub(crate) fn new(zoning: &'a Zoning) -> Self {
        let remembered = |noise: &ValueNoise| RememberedNoise::new(noise.clone(), Self::SQUARES);
        Self { zoning, density: remembered(&zoning.density), character: remembered(&zoning.character) }
    }

    /// [`Zoning::zone`].
    pub(crate) fn zone(&mut self, point: Point2) -> Zone {
        let (character, wild) = (self.character.uniform_at(point), self.density.uniform_at(point));
        self.zoning.by(point, character, wild).0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_use_has_about_its_share() {
        let config = ZoningConfig::default();
        let zoning = Zoning::new(&config, Seed(5));
        let mut counts = [0_usize; 5];
        let side = 400_usize;
        for index in 0..side * side {
            let at = Point2::new((index % side) as f64 * 97.0, (index / side) as f64 * 97.0);
            counts[zoning.zone(at) as usize] += 1;
        }
        let share = |zone: Zone| counts[zone as usize] as f64 / (side * side) as f64;
        assert!((share(Zone::Park) - config.parks).abs() < 0.015, "parks {}", share(Zone::Park));
        assert!((share(Zone::Civic) - config.civic).abs() < 0.015, "civic {}", share(Zone::Civic));
        assert!((0.03..0.2).contains(&share(Zone::Industrial)), "industry {}", share(Zone::Industrial));
        assert!((0.05..0.4).contains(&share(Zone::Commercial)), "commerce {}", share(Zone::Commercial));
        assert!((0.4..0.85).contains(&share(Zone::Residential)), "homes {}", share(Zone::Residential));
    }

    #[test]
    fn what_is_remembered_is_the_same_zone() {
        let zoning = Zoning::new(&ZoningConfig::default(), Seed(5));
        let mut remembered = RememberedZoning::new(&zoning);
        for index in 0..10_000_u32 {
            let at = Point2::new(f64::from(index % 97) * 31.0, f64::from(index / 97) * 13.0);
            assert_eq!(remembered.zone(at), zoning.zone(at));
        }
    }

    #[test]
    fn the_middle_is_dense_and_commercial() {
        let mut commercial = 0;
        for seed in 0..200 {
            let zoning = Zoning::new(&ZoningConfig::default(), Seed(seed));
            assert!(zoning.density(Point2::origin()) >= 0.55);
            commercial += usize::from(zoning.zone(Point2::origin()) == Zone::Commercial);
        }
        assert!(commercial > 80, "{commercial} of 200 city centres are commercial");
    }
}
