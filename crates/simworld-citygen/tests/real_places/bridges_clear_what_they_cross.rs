//! Streets that pass over others: high enough to pass below, not too steep, and solid in a world.

use simworld_citygen::terrain::{DECK, HEADROOM, TerrainConfig, raise_bridges};
use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::{Point2, Point3};
use simworld_core::id::{EntityId, RoadId};
use simworld_core::net::{RoadClass, Street, StreetPlan, polyline};
use simworld_core::scene::{EntityKind, Scene, World};
use simworld_core::seed::Seed;

/// An arterial from west to east, `half` m to either side, above a street from south to north and one more beside it.
fn overpass(half: f64) -> StreetPlan {
    let nodes = [(-half, 0.0), (half, 0.0), (0.0, -90.0), (0.0, 90.0), (30.0, -90.0), (30.0, 90.0)]
        .map(|(x, y)| Point2::new(x, y))
        .to_vec();
    let over = Street { level: 1, class: RoadClass::Arterial, ..Street::simple(0, 1) };
    let streets = vec![over, Street::simple(2, 3), Street::simple(4, 5)];
    StreetPlan { nodes, streets, ..StreetPlan::default() }
}

/// Steepest grade of every street, rise over run.
fn grades(city: &City) -> Vec<f64> {
    let steepest = |index: usize| {
        let length = polyline::length(&city.network.roads[index].centerline);
        let height =
            |step: u32| city.network.height(RoadId::from_index(index), length * f64::from(step) / 500.0);
        (0..500).map(|step| (height(step + 1) - height(step)).abs() / (length / 500.0)).fold(0.0, f64::max)
    };
    (0..city.network.roads.len()).map(steepest).collect()
}

#[test]
fn there_is_room_below_and_ramps_are_gentle() {
    let city = City::from_plan(overpass(220.0), &CityConfig::default(), Seed(1)).unwrap();
    for station in [220.0, 250.0] {
        let above = city.network.height(RoadId(0), station);
        assert!((above - HEADROOM - DECK).abs() < 1e-6, "{above} m at {station}");
    }
    let grades = grades(&city);
    assert!((grades[0] - 0.08).abs() < 1e-6, "an arterial of {} %", grades[0] * 100.0);
    assert_eq!(grades[1..], [0.0, 0.0], "what is below stays level");
    assert!(city.network.intersections.iter().all(|place| place.height == 0.0));
}

#[test]
fn a_short_bridge_raises_the_streets_that_lead_to_it() {
    // 25 m from the crossing to the end of the bridge, and 200 m on from there.
    let mut plan = overpass(25.0);
    plan.streets.pop();
    plan.nodes.extend([Point2::new(-225.0, 0.0), Point2::new(225.0, 0.0)]);
    let approach = |from, to| Street { class: RoadClass::Arterial, ..Street::simple(from, to) };
    plan.streets.extend([approach(6, 0), approach(1, 7)]);
    assert_eq!(raise_bridges(&mut plan.clone(), &TerrainConfig::default()), []);
    let city = City::from_plan(plan, &CityConfig::default(), Seed(1)).unwrap();
    assert!((city.network.height(RoadId(0), 25.0) - HEADROOM - DECK).abs() < 1e-6);
    let ends = [0, 1].map(|node| city.network.intersections[node].height);
    assert!(ends.iter().all(|height| (4.0..5.8).contains(height)), "{ends:?}");
    assert!(grades(&city).iter().all(|grade| *grade < 0.08 + 1e-6), "{:?}", grades(&city));
    assert_eq!(city.network.intersections[6].height, 0.0);
}

#[test]
fn what_cannot_be_cleared_is_said() {
    // The street below leads to the bridge itself, and rises with it.
    let mut plan = overpass(40.0);
    plan.nodes[3] = Point2::new(40.0, 20.0);
    plan.streets.truncate(2);
    plan.streets.push(Street::simple(3, 1));
    let warnings = raise_bridges(&mut plan, &TerrainConfig::default());
    let [warning] = warnings.as_slice() else { panic!("{warnings:?}") };
    assert_eq!((warning.upper, warning.lower), (0, 1));
    assert!(warning.headroom < HEADROOM && warning.to_string().contains("longer ramps"), "{warning}");
    assert!(plan.elevations.iter().all(|height| (0.0..50.0).contains(height)));
    plan.validate().unwrap();
}

#[test]
fn bridges_over_bridges_are_twice_as_high() {
    let mut plan = overpass(400.0);
    plan.nodes.extend([Point2::new(15.0, -400.0), Point2::new(15.0, 400.0)]);
    plan.streets.push(Street { level: 2, class: RoadClass::Highway, ..Street::simple(6, 7) });
    let city = City::from_plan(plan, &CityConfig::default(), Seed(1)).unwrap();
    let (low, high) = (city.network.height(RoadId(0), 415.0), city.network.height(RoadId(3), 400.0));
    assert!((high - low - HEADROOM - DECK).abs() < 1e-6, "{high} over {low}");
}

#[test]
fn a_plan_on_the_ground_stays_as_it_is() {
    let mut plan = StreetPlan::grid(4, 4, 100.0);
    let before = plan.clone();
    assert_eq!(raise_bridges(&mut plan, &TerrainConfig::default()), []);
    assert_eq!(plan, before);
}

/// Heights of the tops of all solids above a point, ascending, and of their undersides.
fn solids_at(world: &World, parts: &[EntityId], at: Point2) -> Vec<(f64, f64)> {
    let mut found = Vec::new();
    for entity in parts.iter().map(|id| world.entity(*id).unwrap()) {
        if entity.kind != EntityKind::Prop {
            continue;
        }
        let local = entity.pose.inverse_transform_point(&Point3::new(at.x, at.y, entity.pose.translation.z));
        let size = entity.info.shape.size();
        if local.x.abs() <= size.x * 0.5 && local.y.abs() <= size.y * 0.5 {
            let [bottom, top] = [0.0, size.z].map(|z| entity.pose * Point3::new(local.x, local.y, z));
            found.push((bottom.z, top.z));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

#[test]
fn one_drives_over_and_under() {
    let city = City::from_plan(overpass(220.0), &CityConfig::default(), Seed(1)).unwrap();
    let mut world = World::new();
    let parts = city.populate(&mut world).unwrap().surfaces;
    // Over the street below: one deck, with room under it.
    let over = solids_at(&world, &parts, Point2::new(1.0, -1.8));
    let [(bottom, top)] = over.as_slice() else { panic!("{over:?}") };
    assert!(*bottom > HEADROOM - 0.1 && (top - 5.8).abs() < 0.1, "{over:?}");
    // Along the street below nothing stands in the way.
    for y in (-80..=80).map(f64::from) {
        let low = solids_at(&world, &parts, Point2::new(1.8, y))
            .into_iter()
            .filter(|solid| solid.0 < HEADROOM - 0.1);
        assert_eq!(low.count(), 0, "something stands at y = {y}");
    }
    // The deck bears all the way, without steps, and is low where it begins.
    let mut last = 0.0;
    for x in (-219..=219).map(f64::from) {
        let top =
            solids_at(&world, &parts, Point2::new(x, -1.8)).iter().map(|solid| solid.1).fold(0.0, f64::max);
        assert!((top - last).abs() < 0.15, "a step of {} m at x = {x}", top - last);
        last = top;
    }
}

#[test]
fn level_land_beside_a_bridge_is_one_plate_a_row() {
    let mut plan = overpass(25.0);
    plan.nodes.extend([Point2::new(-225.0, 0.0), Point2::new(225.0, 0.0), Point2::new(225.0, 2000.0)]);
    let approach = |from, to| Street { class: RoadClass::Arterial, ..Street::simple(from, to) };
    plan.streets.extend([approach(6, 0), approach(1, 7), approach(7, 8)]);
    let city = City::from_plan(plan, &CityConfig::default(), Seed(1)).unwrap();
    let mut world = World::new();
    let parts = city.populate(&mut world).unwrap().surfaces;
    let ground: Vec<_> = parts
        .iter()
        .map(|id| world.entity(*id).unwrap())
        .filter(|it| it.kind == EntityKind::Ground)
        .collect();
    let raised = ground.iter().filter(|it| it.position().z > 0.5).count();
    assert!(raised > 3, "the approach is no embankment");
    assert!(ground.len() < 400, "{} plates", ground.len());
    let area: f64 = ground.iter().map(|it| it.info.shape.size()).map(|size| size.x * size.y).sum();
    let (low, high) = city.network.bounds().unwrap();
    assert!(area >= (high.x - low.x + 240.0) * (high.y - low.y + 240.0));
}

#[cfg(feature = "osm")]
#[test]
fn real_bridges_clear_what_they_cross() {
    use simworld_citygen::osm::StreetOptions;
    for (file, place) in crate::osm_common::all_real() {
        let (mut plan, _) = place.plan(&StreetOptions::default());
        assert_eq!(raise_bridges(&mut plan, &TerrainConfig::default()), [], "{file}");
        plan.validate().unwrap();
        // One street over another, on level land: nothing is higher than that asks for.
        let nodes = plan.elevations.iter().copied();
        let ways = plan.streets.iter().flat_map(|street| &street.profile).map(|(_, height)| *height);
        let highest = nodes.chain(ways).fold(0.0, f64::max);
        assert!(highest < 2.0 * (HEADROOM + DECK), "{file}: {highest} m");
    }
}
