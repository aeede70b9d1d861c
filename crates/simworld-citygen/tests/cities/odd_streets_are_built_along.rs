//! Streets that no generator makes: without sidewalks, on one side only, wide, one-way, acute, in loops and in two
//! parts. Whatever they are, buildings keep off lanes and off one another, and doors open to sidewalks.

use proptest::prelude::*;
use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::{Obb, Point2, Point3, Vector3, direction, heading, pose_facing};
use simworld_core::net::{CrossSection, LaneDirection, LaneKind, LaneSpec, Street, StreetPlan, polyline};
use simworld_core::seed::Seed;

fn section(sidewalks: (f64, f64), parking: f64, lanes: (u8, u8), width: f64) -> CrossSection {
    let mut section = CrossSection::plain(lanes.0, lanes.1, width, 0.0);
    let strip = |kind, width| LaneSpec { kind, direction: LaneDirection::Both, width };
    if parking > 0.0 {
        section.lanes.insert(0, strip(LaneKind::Parking, parking));
        section.reference += parking;
    }
    if sidewalks.0 > 0.0 {
        section.lanes.insert(0, strip(LaneKind::Sidewalk, sidewalks.0));
        section.reference += sidewalks.0;
    }
    if sidewalks.1 > 0.0 {
        section.lanes.push(strip(LaneKind::Sidewalk, sidewalks.1));
    }
    section
}

fn sections() -> impl Strategy<Value = CrossSection> {
    let walk = prop::sample::select(vec![0.0, 1.2, 3.0, 6.0]);
    let walks = (walk.clone(), walk);
    let lanes = prop::sample::select(vec![(1_u8, 1_u8), (1, 0), (3, 2), (4, 4)]);
    (walks, prop::sample::select(vec![0.0, 2.2]), lanes, 2.5..4.5_f64)
        .prop_map(|(walks, parking, lanes, width)| section(walks, parking, lanes, width))
}

/// A wheel: spokes from a hub, a rim between some of their ends, and a second part far away.
fn plans() -> impl Strategy<Value = StreetPlan> {
    let spokes = prop::collection::vec((60.0..260.0_f64, 0.25..1.0_f64, any::<bool>(), 0_usize..3), 3..9);
    (spokes, prop::collection::vec(sections(), 3)).prop_map(|(spokes, sections)| {
        let mut plan = StreetPlan { sections, nodes: vec![Point2::origin()], ..StreetPlan::default() };
        let total: f64 = spokes.iter().map(|(_, angle, _, _)| angle).sum();
        let mut at = 0.0;
        for (length, angle, _, section) in &spokes {
            at += angle / total * std::f64::consts::TAU;
            plan.nodes.push(Point2::origin() + direction(at) * *length);
            let street = Street::simple(0, plan.nodes.len() - 1);
            plan.streets.push(Street { section: *section as u32, ..street });
        }
        let count = spokes.len();
        for (index, (_, angle, has_rim, section)) in spokes.iter().enumerate() {
            let (from, to) = (1 + (index + count - 1) % count, 1 + index);
            let long_enough = (plan.nodes[from] - plan.nodes[to]).norm() > 40.0;
            // A rim over more than half the circle would cross the spokes.
            if *has_rim && long_enough && angle / total < 0.4 {
                plan.streets.push(Street { section: *section as u32, ..Street::simple(from, to) });
            }
        }
        let far = plan.nodes.len();
        plan.nodes.extend([Point2::new(900.0, 0.0), Point2::new(1000.0, 30.0)]);
        plan.streets.push(Street::simple(far, far + 1));
        plan
    })
}

fn strip(a: Point2, b: Point2, width: f64) -> Obb {
    let middle = nalgebra::center(&a, &b);
    Obb {
        pose: pose_facing(Point3::new(middle.x, middle.y, 0.0), heading(&(b - a))),
        half_extents: Vector3::new((b - a).norm() * 0.5, width * 0.5, 1.0),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if std::env::var_os("SIMWORLD_SOAK").is_some() { 5000 } else { 80 }))]

    #[test]
    fn odd_streets_are_built_along(plan in plans(), seed in 0_u64..1000) {
        let Ok(city) = City::from_plan(plan, &CityConfig::default(), Seed(seed)) else { return Ok(()) };
        let lanes: Vec<Obb> = city
            .network
            .lanes
            .iter()
            .flat_map(|lane| lane.path.windows(2).map(|pair| strip(pair[0], pair[1], lane.width)))
            .collect();
        let houses: Vec<Obb> = city.buildings.iter().map(simworld_citygen::building::Building::obb).collect();
        for (index, house) in houses.iter().enumerate() {
            prop_assert!(!houses[..index].iter().any(|other| other.footprints_overlap(house)), "buildings overlap");
            prop_assert!(!lanes.iter().any(|lane| lane.footprints_overlap(house)), "a building on a lane");
        }
        for element in &city.elements {
            let obb = element.obb();
            prop_assert!(!lanes.iter().any(|lane| lane.footprints_overlap(&obb)), "{} on a lane", element.kind);
            prop_assert!(!houses.iter().any(|house| house.footprints_overlap(&obb)), "{} in a house", element.kind);
        }
        for building in &city.buildings {
            let walk = city.network.sidewalk(building.road, building.side);
            prop_assert!(walk.is_some(), "a building at a street without a sidewalk");
            let road = &city.network.roads[building.road.index()];
            let corners = [road.from, road.to].map(|end| &city.network.intersections[end.index()].corners);
            let near = corners.into_iter().flatten().chain(walk.map(|walk| &walk.path));
            let away = near.filter_map(|path| polyline::closest(path, &building.access)).map(|c| c.distance);
            prop_assert!(away.fold(f64::INFINITY, f64::min) < 1e-6, "a door off the walkways");
        }
    }
}
