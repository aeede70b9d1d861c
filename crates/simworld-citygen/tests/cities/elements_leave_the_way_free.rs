//! No element stands in a lane that is driven on, on a crossing, in a building or in another element; the middle of
//! every sidewalk is free. Parked cars keep within their parking lanes.
//!
//! Every test is made on the exact shapes of the finished city, without the index that the generator uses.

use simworld_citygen::element::{Element, FREE_WIDTH};
use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::{Obb, Point2, Point3, Vector2, Vector3, heading, pose_facing};
use simworld_core::net::{CrossSection, LaneDirection, LaneKind, LaneSpec, Street, StreetPlan, polyline};
use simworld_core::scene::EntityKind;
use simworld_core::seed::Seed;

fn strip(a: Point2, b: Point2, width: f64) -> Obb {
    let middle = nalgebra::center(&a, &b);
    Obb {
        pose: pose_facing(Point3::new(middle.x, middle.y, 0.0), heading(&(b - a))),
        half_extents: Vector3::new((b - a).norm() * 0.5, width * 0.5, 1.0),
    }
}

fn strips(path: &[Point2], width: f64) -> impl Iterator<Item = Obb> + '_ {
    path.windows(2)
        .filter(|pair| (pair[1] - pair[0]).norm() > 1e-6)
        .map(move |pair| strip(pair[0], pair[1], width))
}

/// The pairs of boxes that overlap, found by sorting along x alone.
fn overlaps(boxes: &[(usize, Obb)], others: &[(usize, Obb)]) -> Option<(usize, usize)> {
    let mut sorted: Vec<(f64, f64, usize)> = others
        .iter()
        .enumerate()
        .map(|(index, (_, obb))| (obb.aabb().min.x, obb.aabb().max.x, index))
        .collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let widest = sorted.iter().map(|(low, high, _)| high - low).fold(0.0, f64::max);
    boxes.iter().find_map(|(id, obb)| {
        let (low, high) = (obb.aabb().min.x, obb.aabb().max.x);
        let first = sorted.partition_point(|entry| entry.0 < low - widest);
        let near = sorted[first..].iter().take_while(|entry| entry.0 <= high);
        near.map(|entry| &others[entry.2])
            .find(|(other, shape)| other != id && shape.footprints_overlap(obb))
            .map(|(other, _)| (*id, *other))
    })
}

fn numbered(boxes: impl Iterator<Item = Obb>, from: usize) -> Vec<(usize, Obb)> {
    boxes.enumerate().map(|(index, obb)| (index + from, obb)).collect()
}

fn check(city: &City, what: &str) {
    let network = &city.network;
    let elements = numbered(city.elements.iter().map(Element::obb), 0);
    let far = elements.len();
    let lanes = network.lanes.iter().flat_map(|lane| strips(&lane.path, lane.width));
    assert_eq!(overlaps(&elements, &numbered(lanes, far)), None, "{what}: an element in a lane");
    let crossings =
        network.crossings.iter().map(|crossing| strip(crossing.start, crossing.end, crossing.width));
    assert_eq!(overlaps(&elements, &numbered(crossings, far)), None, "{what}: an element on a crossing");
    let walks = network.sidewalks.iter().flat_map(|walk| strips(&walk.path, FREE_WIDTH - 1e-6));
    assert_eq!(overlaps(&elements, &numbered(walks, far)), None, "{what}: an element in the way");
    let solids = city.buildings.iter().flat_map(simworld_citygen::building::Building::solids);
    assert_eq!(overlaps(&elements, &numbered(solids, far)), None, "{what}: an element in a building");
    assert_eq!(overlaps(&elements, &elements), None, "{what}: an element in another");
}

#[test]
fn elements_leave_the_way_free() {
    let seeds = if std::env::var_os("SIMWORLD_SOAK").is_some() { 2000 } else { 25 };
    for seed in 0..seeds {
        let city = City::generate(&CityConfig::with_roads(20 + (seed % 30) as u32), Seed(seed)).unwrap();
        assert!(city.elements.len() > 100, "seed {seed} has {} elements", city.elements.len());
        check(&city, &format!("seed {seed}"));
    }
}

/// A crossroads of streets with parking on both sides, one arm of which is bent.
fn plan_with_parking() -> StreetPlan {
    let strip = |kind, direction, width| LaneSpec { kind, direction, width };
    let lanes = vec![
        strip(LaneKind::Sidewalk, LaneDirection::Both, 3.5),
        strip(LaneKind::Parking, LaneDirection::Backward, 2.2),
        strip(LaneKind::Driving, LaneDirection::Backward, 3.2),
        strip(LaneKind::Driving, LaneDirection::Forward, 3.2),
        strip(LaneKind::Parking, LaneDirection::Both, 2.4),
        strip(LaneKind::Sidewalk, LaneDirection::Both, 3.5),
    ];
    let mut plan =
        StreetPlan { sections: vec![CrossSection { lanes, reference: 8.9 }], ..StreetPlan::default() };
    let at = |x: f64, y: f64| Point2::new(x, y);
    plan.nodes = vec![at(0.0, 0.0), at(180.0, 10.0), at(-170.0, 0.0), at(10.0, 160.0), at(0.0, -150.0)];
    plan.streets = (1..5).map(|node| Street::simple(0, node)).collect();
    plan.streets[0].via = vec![at(60.0, 0.0), at(110.0, 20.0), at(150.0, 22.0)];
    plan
}

#[test]
fn cars_park_in_parking_lanes_alone() {
    let plan = plan_with_parking();
    let mut config = CityConfig::default();
    config.elements.parked = 1.0;
    let city = City::from_plan(plan.clone(), &config, Seed(4)).unwrap();
    check(&city, "parking");
    let cars: Vec<&Element> =
        city.elements.iter().filter(|element| element.kind == EntityKind::Car).collect();
    assert!(cars.len() > 80, "{} cars are parked", cars.len());
    // Offsets of the two parking lanes from the centreline, their widths, and the way their cars look.
    let lanes = [(4.3, 2.2, -1.0), (-4.4, 2.4, 1.0)];
    for car in cars {
        let held = plan.streets.iter().any(|street| {
            let line = plan.centerline(street);
            lanes.iter().any(|(offset, width, way)| {
                let path = polyline::offset(&line, *offset);
                let inside = |corner: &Point2| {
                    polyline::closest(&path, corner).is_some_and(|c| c.distance <= width * 0.5 + 1e-6)
                };
                let Some(near) = polyline::closest(&path, &car.position) else { return false };
                let along = polyline::at(&path, near.station).1;
                let looks = simworld_core::geometry::direction(car.facing)
                    .dot(&simworld_core::geometry::direction(along));
                car.obb().footprint().iter().all(inside) && looks * way > 0.8
            })
        });
        assert!(held, "a car at {} stands outside of its lane", car.position);
    }
}

#[test]
fn no_space_is_taken_where_nobody_parks() {
    let mut config = CityConfig::default();
    config.elements.parked = 0.0;
    let city = City::from_plan(plan_with_parking(), &config, Seed(4)).unwrap();
    assert!(city.elements.iter().all(|element| element.kind != EntityKind::Car));
}

#[test]
fn elements_look_at_their_street() {
    let city = City::generate(&CityConfig::default(), Seed(9)).unwrap();
    let benches = city.elements.iter().filter(|element| element.kind == EntityKind::Bench);
    let mut count = 0;
    for bench in benches {
        let ahead: Vector2 = simworld_core::geometry::direction(bench.facing);
        let distance = |point: Point2| {
            let to = |road: &simworld_core::net::Road| polyline::closest(&road.centerline, &point);
            city.network.roads.iter().filter_map(to).map(|c| c.distance).fold(f64::INFINITY, f64::min)
        };
        assert!(distance(bench.position + ahead) < distance(bench.position), "a bench turns its back");
        count += 1;
    }
    assert!(count > 3);
}
