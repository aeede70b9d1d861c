//! Where people order, eat, buy and charge: what follows from the scene and the seed, and never changes in an episode.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Aabb, Point2, Point3};
use simworld_core::grid::PointGrid;
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::scene::{Place, Scene};
use simworld_core::seam::TaskError;
use simworld_core::seed::{Stream, StreamRng};

use super::battery::Power;
use super::config::{DeliveryConfig, Shopping};

/// A meet-point lies at most this far from every place that anybody orders from or to, m.
const OUTSKIRTS: f64 = 1000.0;
/// Width of the cells in which doors are looked for, m: some doors in each.
const CELL: f64 = 100.0;

/// A place that somebody goes to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Site {
    pub(super) entity: EntityId,
    pub(super) access: Point3,
}

/// The places of an episode, as a snapshot keeps them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Sites {
    pub(super) restaurants: Vec<Site>,
    pub(super) homes: Vec<Site>,
    pub(super) stores: Vec<Site>,
    pub(super) stations: Vec<Site>,
    /// The home of each customer, by its place among the homes.
    customers: Vec<u32>,
}

/// The places, with what is needed to find the near ones.
#[derive(Debug)]
pub(super) struct Places {
    pub(super) sites: Sites,
    restaurants: PointGrid,
    stores: PointGrid,
    stations: PointGrid,
    /// The doors that orders come from and go to: restaurants, then homes with a customer.
    doors: Vec<Point3>,
    door_grid: PointGrid,
    /// A hash of the sites, taken once: they may be many.
    digest: u64,
}

impl Sites {
    /// The places of a scene, each kind by ascending id, with customers drawn for the homes.
    pub(super) fn of(scene: &dyn Scene, config: &DeliveryConfig, stream: Stream) -> Result<Self, TaskError> {
        let missing = |missing: &str, hint: &str| {
            Err(TaskError::Scene { missing: missing.to_owned(), hint: hint.to_owned() })
        };
        let [restaurants, homes, stores, stations] = found(scene);
        if restaurants.is_empty() {
            return missing("restaurant", "spawn a building used as Place::Restaurant");
        }
        if homes.is_empty() {
            return missing("home", "spawn a building used as Place::Home");
        }
        if stores.is_empty() && config.prices.shopping == Shopping::AtStore {
            return missing("store", "spawn a building used as Place::Store, or set prices.shopping");
        }
        if stations.is_empty() && config.battery.power == Power::Battery {
            let hint = "spawn a building used as Place::ChargingStation, or set battery.power";
            return missing("charging station", hint);
        }
        let mut rng = stream.named("customers").rng();
        let all: Vec<u32> = (0..homes.len() as u32).collect();
        let draw = |_| rng.choose(&all).copied();
        let customers = (0..config.orders.customers).filter_map(draw).collect();
        Ok(Self { restaurants, homes, stores, stations, customers })
    }

    /// How many people order.
    pub(super) fn customers(&self) -> usize {
        self.customers.len()
    }

    /// The home of a customer, drawn.
    pub(super) fn draw_home(&self, rng: &mut StreamRng) -> Option<Site> {
        let home = rng.choose(&self.customers)?;
        self.homes.get(*home as usize).copied()
    }
}

impl Places {
    /// Makes what is needed to find places.
    pub(super) fn new(sites: Sites) -> Self {
        let grid = |sites: &[Site]| PointGrid::new(sites.iter().map(|site| site.access.xy()).collect(), CELL);
        let mut lived_in = sites.customers.clone();
        lived_in.sort_unstable();
        lived_in.dedup();
        let homes = lived_in.iter().filter_map(|home| sites.homes.get(*home as usize));
        let doors: Vec<Point3> = sites.restaurants.iter().chain(homes).map(|site| site.access).collect();
        let bytes = postcard::to_allocvec(&sites).expect("plain data can be written to memory");
        Self {
            restaurants: grid(&sites.restaurants),
            stores: grid(&sites.stores),
            stations: grid(&sites.stations),
            door_grid: PointGrid::new(doors.iter().map(Point3::xy).collect(), CELL),
            doors,
            digest: StateHasher::new().bytes(&bytes).finish().0,
            sites,
        }
    }

    /// Adds the places to a hash of the state.
    pub(super) fn state_hash(&self, hasher: &mut StateHasher) {
        hasher.u64(self.digest);
    }

    /// A restaurant within a distance of a home, drawn; without any, the nearest.
    pub(super) fn draw_restaurant(&self, home: &Site, radius: f64, rng: &mut StreamRng) -> Option<Site> {
        let (at, mut near) = (home.access.xy(), Vec::new());
        self.restaurants.within(at, radius, &mut near);
        let drawn = rng.choose(&near).map(|index| *index as usize);
        let index = drawn.or_else(|| self.restaurants.nearest(at))?;
        self.sites.restaurants.get(index).copied()
    }

    /// The nearest store.
    pub(super) fn store(&self, from: Point2) -> Option<Point3> {
        self.stores.nearest(from).map(|index| self.sites.stores[index].access)
    }

    /// The nearest charging station.
    pub(super) fn station(&self, from: Point2) -> Option<Point3> {
        self.stations.nearest(from).map(|index| self.sites.stations[index].access)
    }

    /// The door nearest to a point: somewhere one can walk to.
    pub(super) fn door(&self, from: Point2) -> Option<Point3> {
        self.door_grid.nearest(from).map(|index| self.doors[index])
    }

    /// A point to meet at, on the ground; `None` outside the city.
    pub(super) fn meet_point(&self, point: Point2) -> Option<Point3> {
        let near = self.door_grid.nearest(point).map(|index| self.doors[index])?;
        let z = self.doors.first().map_or(0.0, |door| door.z);
        ((near.xy() - point).norm() <= OUTSKIRTS).then(|| Point3::new(point.x, point.y, z))
    }
}

/// Restaurants, homes, stores and charging stations, each by ascending id.
fn found(scene: &dyn Scene) -> [Vec<Site>; 4] {
    let mut found = [Vec::new(), Vec::new(), Vec::new(), Vec::new()];
    let _ = scene.visit(&Aabb::column_around(Point2::origin(), 1e9), &mut |entity| {
        let group = match entity.info.place {
            Some(Place::Restaurant) => 0,
            Some(Place::Home) => 1,
            Some(Place::Store) => 2,
            Some(Place::ChargingStation) => 3,
            _ => return ControlFlow::Continue(()),
        };
        found[group].push(Site { entity: entity.id, access: entity.access() });
        ControlFlow::Continue(())
    });
    for group in &mut found {
        group.sort_by_key(|site| site.entity);
    }
    found
}
