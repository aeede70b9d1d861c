//! Cities on hills: no street is steeper than its class allows, gentle land is left alone, and what is built stands on its
//! ground. A city without relief is the flat one, bit for bit.

use proptest::prelude::*;
use simworld_citygen::terrain::{Ground, HeightField, Terrain, TerrainConfig, elevations};
use simworld_citygen::{City, CityConfig, Style, growth};
use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::{StreetPlan, polyline};
use simworld_core::scene::{Scene, World};
use simworld_core::seed::Seed;

fn hills(relief: f64) -> TerrainConfig {
    TerrainConfig { relief, wavelength: 500.0, ..TerrainConfig::default() }
}

fn city(config: TerrainConfig) -> City {
    let config = CityConfig { roads: Style::Organic.roads(120), terrain: config, ..CityConfig::default() };
    City::generate(&config, Seed(6)).expect("the configuration is valid")
}

/// The steepest street in shares of what its class allows.
fn steepest(plan: &StreetPlan, config: &TerrainConfig) -> f64 {
    let grade = |street: &simworld_core::net::Street| {
        let rise = (plan.elevation(street.to) - plan.elevation(street.from)).abs();
        rise / polyline::length(&plan.centerline(street)) / config.grade(street.class)
    };
    plan.streets.iter().map(grade).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn no_street_is_too_steep(
        seed in any::<u64>(),
        style in 0..4_usize,
        relief in 1.0..1000.0_f64,
        wavelength in 100.0..3000.0_f64,
        local_grade in 0.01..0.4_f64,
        arterial_grade in 0.01..0.4_f64,
    ) {
        let config = TerrainConfig { relief, wavelength, local_grade, arterial_grade };
        let land = Terrain::new(&config, Seed(seed));
        let mut plan = growth::grow(&Style::ALL[style].roads(80), Seed(seed));
        plan.elevations = elevations(&plan, &land, &config);
        prop_assert!(plan.validate().is_ok());
        prop_assert!(steepest(&plan, &config) <= 1.0 + 1e-12);
        let heights: Vec<f64> = plan.nodes.iter().map(|node| land.height(*node)).collect();
        let (low, high) = heights.iter().fold((f64::MAX, f64::MIN), |(l, h), z| (l.min(*z), h.max(*z)));
        prop_assert!(plan.elevations.iter().all(|z| (low - 1e-9..=high + 1e-9).contains(z)));
    }
}

#[test]
fn steep_land_is_cut_and_gentle_land_is_left_alone() {
    let plan = growth::grow(&Style::Mixed.roads(200), Seed(1));
    let graded = |config: &TerrainConfig| {
        let land = Terrain::new(config, Seed(1));
        let natural: Vec<f64> = plan.nodes.iter().map(|node| land.height(*node)).collect();
        (
            StreetPlan { elevations: natural.clone(), ..plan.clone() },
            natural,
            elevations(&plan, &land, config),
        )
    };
    let gentle = TerrainConfig { relief: 20.0, wavelength: 4000.0, ..TerrainConfig::default() };
    let (_, natural, found) = graded(&gentle);
    assert_eq!(natural, found);
    let steep = hills(90.0);
    let (on_land, natural, found) = graded(&steep);
    assert!(steepest(&on_land, &steep) > 2.0, "the hills are too gentle for this test");
    assert_ne!(natural, found);
    // What is taken from the hills about fills the valleys.
    let moved: Vec<f64> = natural.iter().zip(&found).map(|(land, street)| street - land).collect();
    let (cut, fill) =
        (moved.iter().filter(|m| **m < -0.1).count(), moved.iter().filter(|m| **m > 0.1).count());
    assert!(cut > 20 && fill > 20, "{cut} cuts and {fill} fills");
}

#[test]
fn the_ground_meets_every_street_and_the_land_between() {
    let city = city(hills(60.0));
    let land = city.terrain();
    let ground = Ground::new(&city.network, &land);
    for (index, road) in city.network.roads.iter().enumerate() {
        for share in [0.3, 0.5, 0.7] {
            let station = polyline::length(&road.centerline) * share;
            let (at, _) = polyline::at(&road.centerline, station);
            let expected = city.network.height(RoadId::from_index(index), station);
            assert!((ground.height(at) - expected).abs() < 1e-6, "road {index}");
        }
    }
    let far = Point2::new(5000.0, -5000.0);
    assert!((ground.height(far) - land.height(far)).abs() < 1e-9);
    for step in 0..4000 {
        let at = Point2::new(f64::from(step) * 0.1 - 200.0, 37.0);
        let beside = ground.height(Point2::new(at.x + 0.1, at.y));
        assert!((ground.height(at) - beside).abs() < 0.2, "a step in the ground at {at}");
    }
}

#[test]
fn all_stands_on_its_ground() {
    let city = city(hills(60.0));
    let land = city.terrain();
    let ground = Ground::new(&city.network, &land);
    let mut world = World::new();
    let entities = city.populate(&mut world).expect("the world takes it");
    let (mut least, mut most) = (f64::MAX, f64::MIN);
    for (building, id) in city.buildings.iter().zip(&entities.buildings) {
        let base = world.entity(*id).expect("it was spawned").position().z;
        assert!((base - ground.height(building.access)).abs() < 1e-9);
        // A floor that is level from front to rear leaves the sloping ground by half its depth times the slope.
        let off = (base - ground.height(building.center)).abs();
        assert!(off < 0.5 * (building.center - building.access).norm() + 0.5, "{off} m off the ground");
        (least, most) = (least.min(base), most.max(base));
    }
    assert!(most - least > 10.0, "the city is flat: {least} to {most}");
    for (element, id) in city.elements.iter().zip(&entities.elements) {
        let base = world.entity(*id).expect("it was spawned").position().z;
        assert!((base - ground.height(element.position)).abs() < 1e-9);
    }
}

#[test]
fn without_relief_nothing_changes() {
    let flat = city(TerrainConfig { wavelength: 777.0, ..TerrainConfig::default() });
    let usual = city(TerrainConfig::default());
    assert_eq!((&flat.plan, &flat.network, &flat.buildings), (&usual.plan, &usual.network, &usual.buildings));
    assert!(usual.plan.elevations.is_empty());
    let mut world = World::new();
    let entities = usual.populate(&mut world).expect("the world takes it");
    assert!(entities.buildings.iter().all(|id| world.entity(*id).is_some_and(|e| e.position().z == 0.0)));
    // Streets and lots lie where they lie, whatever the land.
    assert_eq!(city(hills(60.0)).buildings, usual.buildings);
}

#[test]
fn hills_come_back_from_a_file() {
    let city = city(hills(45.0));
    let mut bytes = Vec::new();
    city.write_to(&mut bytes).expect("memory takes it");
    assert_eq!(City::from_bytes(&bytes).expect("it was just written"), city);
}

#[test]
fn impossible_hills_are_named() {
    for (config, field) in [
        (TerrainConfig { relief: f64::NAN, ..hills(1.0) }, "terrain.relief"),
        (TerrainConfig { wavelength: 0.0, ..hills(1.0) }, "terrain.wavelength"),
        (TerrainConfig { local_grade: 2.0, ..hills(1.0) }, "terrain.local_grade"),
    ] {
        assert!(config.validate().unwrap_err().to_string().contains(field));
    }
}
