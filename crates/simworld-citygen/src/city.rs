//! A city: streets, buildings and street elements.

use std::sync::Arc;

use simworld_core::net::{RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;

use crate::building::{self, Building};
use crate::element::{self, Element, Setting};
use crate::lot::Land;
use crate::occupancy::Occupancy;
use crate::terrain::{self, Terrain};
use crate::threads::AllThreads;
use crate::zoning::Zoning;
use crate::{CityConfig, CityError, CityReport, Provenance, RoadSource};

/// A generated city.
#[derive(Clone, Debug, PartialEq)]
pub struct City {
    /// What it was made from.
    pub config: CityConfig,
    /// Its seed, and the place that it is, if it is one.
    pub provenance: Provenance,
    /// Centrelines and junctions.
    pub plan: StreetPlan,
    /// Lanes, crossings, signals and all else that follows from the plan; and the ways for walkers of a real place.
    pub network: Arc<RoadNetwork>,
    /// Buildings, road by road.
    pub buildings: Vec<Building>,
    /// Street elements, sidewalk by sidewalk.
    pub elements: Vec<Element>,
    pub(crate) frontage: f64,
}

impl City {
    /// Grows a city. The same configuration and seed give the same city, bit for bit.
    ///
    /// ```
    /// use simworld_citygen::{City, CityConfig};
    /// use simworld_core::seed::Seed;
    /// let city = City::generate(&CityConfig::with_roads(12), Seed(7))?;
    /// assert!(city.network.roads.len() >= 12);
    /// assert_eq!(city, City::generate(&CityConfig::with_roads(12), Seed(7))?);
    /// # Ok::<(), simworld_citygen::CityError>(())
    /// ```
    ///
    /// # Errors
    /// A setting out of range.
    pub fn generate(config: &CityConfig, seed: Seed) -> Result<Self, CityError> {
        Self::from_source(&config.roads, config, seed)
    }

    /// Builds a city on the streets of any source.
    ///
    /// # Errors
    /// A setting out of range, or what the source cannot do.
    pub fn from_source(source: &dyn RoadSource, config: &CityConfig, seed: Seed) -> Result<Self, CityError> {
        config.validate()?;
        Self::from_plan(source.streets(seed)?, config, seed)
    }

    /// Builds a city on streets from elsewhere.
    ///
    /// # Errors
    /// A setting out of range, or streets that cannot be built.
    pub fn from_plan(mut plan: StreetPlan, config: &CityConfig, seed: Seed) -> Result<Self, CityError> {
        config.validate()?;
        // What a bridge lacks stands in the map of the place, or is told by `terrain::raise_bridges`.
        terrain::raise(&mut plan, &config.terrain, seed)?;
        let network = RoadNetwork::derive_with(&plan, &config.network, &AllThreads)?;
        let zoning = Zoning::new(&config.zoning, seed);
        let (land, mut taken) = Land::beside_roads(&network, &zoning, &config.lots, seed);
        let buildings = building::build(&network, &land, &config.buildings, seed, &mut taken);
        let land = land.greens_alone();
        let setting = Setting {
            plan: &plan,
            network: &network,
            zoning: &zoning,
            land: &land,
            buildings: &buildings,
            within: None,
        };
        let elements = element::furnish(&setting, &config.elements, seed, &mut taken);
        Ok(Self {
            config: config.clone(),
            provenance: Provenance::of_seed(seed),
            plan,
            network: Arc::new(network),
            buildings,
            elements,
            frontage: land.frontage,
        })
    }

    /// Share of the frontage that buildings take, in [0, 1].
    pub fn frontage_used(&self) -> f64 {
        let used: f64 = self.buildings.iter().map(|building| building.frontage).sum();
        if self.frontage > 0.0 { (used / self.frontage).min(1.0) } else { 0.0 }
    }

    /// The blocks, lots and greens between its streets. They follow from the streets, the configuration and the seed, and
    /// are divided anew by each call.
    pub fn land(&self) -> Land {
        let seed = self.provenance.seed;
        let zoning = Zoning::new(&self.config.zoning, seed);
        Land::of_network(&self.network, &zoning, &self.config.lots, seed, &Occupancy::of_roads(&self.network))
    }

    /// The land under it, before streets were cut into it.
    pub fn terrain(&self) -> Terrain {
        Terrain::new(&self.config.terrain, self.provenance.seed)
    }

    /// The statistics of the city.
    pub fn report(&self) -> CityReport {
        CityReport::of(self)
    }

    /// The map as an SVG document; build a [`map::MapDrawing`](crate::map::MapDrawing) to draw more on it.
    pub fn svg(&self) -> String {
        crate::map::MapDrawing::of(self).to_string()
    }
}
