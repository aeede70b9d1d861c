//! What bears a street or spans it is in nobody's way there: in the world of a city traffic flows as on its bare streets.

use std::sync::Arc;

use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::Point2;
use simworld_core::hash::{StateDigest, StateHash};
use simworld_core::net::{Street, StreetPlan};
use simworld_core::scene::{EntityKind, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::{TrafficConfig, TrafficDynamics};

/// A ring of streets with one through its middle from south to north, and another over that on a bridge, or under it.
fn city(level: i8) -> City {
    let at = |x: f64, y: f64| Point2::new(x, y);
    let (ring, middle) =
        ([at(-250.0, 0.0), at(0.0, -250.0), at(250.0, 0.0), at(0.0, 250.0)], [at(-70.0, 0.0), at(70.0, 0.0)]);
    let corner =
        |from: usize, to: usize, x: f64, y: f64| Street { via: vec![at(x, y)], ..Street::simple(from, to) };
    let streets = vec![
        corner(0, 1, -250.0, -250.0),
        corner(1, 2, 250.0, -250.0),
        corner(2, 3, 250.0, 250.0),
        corner(3, 0, -250.0, 250.0),
        Street::simple(1, 3),
        Street::simple(0, 4),
        Street { level, ..Street::simple(4, 5) },
        Street::simple(5, 2),
    ];
    let plan = StreetPlan { nodes: [&ring[..], &middle].concat(), streets, ..StreetPlan::default() };
    City::from_plan(plan, &CityConfig::default(), Seed(3)).unwrap()
}

/// What traffic came to after five minutes.
fn driven(mut world: World) -> StateDigest {
    let config = TrafficConfig { vehicles: 60, pedestrians: 0, ..TrafficConfig::default() };
    let mut dynamics = TrafficDynamics::new(&mut world, &config, Seed(5)).unwrap();
    for _ in 0..3000 {
        world.begin_step();
        dynamics.step(&mut world, 0.1).unwrap();
        world.finish_step();
    }
    dynamics.traffic().digest()
}

#[test]
fn in_a_world_with_bridges_and_tunnels_traffic_flows_as_on_bare_streets() {
    for level in [1, -1] {
        let city = city(level);
        let (mut bare, mut whole) = (World::new(), World::new());
        bare.set_roads(Arc::clone(&city.network));
        city.populate(&mut whole).unwrap();
        let decks =
            whole.iter().filter(|entity| entity.kind == EntityKind::Prop && entity.is_solid()).count();
        assert_eq!(decks > 3, level > 0, "{decks} parts of bridges");
        assert_eq!(driven(whole), driven(bare), "level {level}");
    }
}
