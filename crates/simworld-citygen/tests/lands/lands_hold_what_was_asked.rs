//! Places beyond the city: land, water, ways, woods and houses as the spec has them, by the same bits on any thread count.

use std::collections::BTreeMap;

use simworld_citygen::landscape::{FOREST, Landscape, LandscapeError, TRAIL_GRADE};
use simworld_core::geometry::{Compass, Point2, Vector2};
use simworld_core::ground::Cover;
use simworld_core::net::{Route, RouteScratch, WaypointConfig, WaypointGraph, polyline};
use simworld_core::scene::{EntityKind, Place, Scene, World};
use simworld_core::seed::Seed;
use simworld_core::spec::{
    Amount, DistrictKind, DistrictWish, Height, SceneKind, SceneSpec, SiteWish, Water, Whereabouts,
};

const KINDS: [SceneKind; 3] = [SceneKind::Countryside, SceneKind::Wilderness, SceneKind::Island];

fn spec(kind: SceneKind) -> SceneSpec {
    let mut spec = SceneSpec { kind, ..SceneSpec::default() };
    if kind == SceneKind::Island {
        spec.buildings.count = Some(14);
        spec.features.landmarks = BTreeMap::from([("lighthouse".to_owned(), 1)]);
    }
    spec
}

fn seeds() -> std::ops::Range<u64> {
    if std::env::var_os("SIMWORLD_SOAK").is_some() { 0..40 } else { 1..3 }
}

fn every(check: impl Fn(&Landscape, &str)) {
    for kind in KINDS {
        for seed in seeds() {
            let name = format!("{} {seed}", kind.as_str());
            let place =
                Landscape::build(&spec(kind), Seed(seed)).unwrap_or_else(|error| panic!("{name}: {error}"));
            check(&place, &name);
        }
    }
}

fn planar(thing: &simworld_citygen::landscape::Thing) -> Point2 {
    thing.pose.translation.vector.xy().into()
}

fn trees(place: &Landscape) -> impl Iterator<Item = Point2> + '_ {
    let other = ["boulder", "tall_hedge", "campfire"];
    let built: Vec<Point2> = place.buildings().map(planar).collect();
    place
        .things
        .iter()
        .filter(move |thing| !other.contains(&thing.asset.as_str()) && !built.contains(&planar(thing)))
        .map(planar)
}

#[test]
fn nothing_floats_sinks_or_grows_in_the_water_or_on_a_way() {
    every(|place, name| {
        for thing in &place.things {
            let at = planar(thing);
            let off = thing.pose.translation.z - place.ground.height(at);
            assert!(off.abs() < 0.05, "{name}: {} at {at} is {off} m off the ground", thing.asset);
            assert!(!place.ground.is_wet(at), "{name}: {} at {at} stands in the water", thing.asset);
        }
        for tree in trees(place) {
            for way in &place.network.footpaths {
                let near = polyline::closest(&way.path, &tree).unwrap();
                assert!(near.distance > way.width * 0.5 + 0.5, "{name}: a tree on a path at {tree}");
            }
            for road in &place.network.roads {
                let near = polyline::closest(&road.centerline, &tree).unwrap();
                assert!(near.distance > road.width * 0.5, "{name}: a tree on a road at {tree}");
            }
        }
    });
}

#[test]
fn trails_keep_their_grade_on_the_finished_ground_and_stay_dry() {
    every(|place, name| {
        assert!(!place.network.footpaths.is_empty(), "{name}: no way for walkers");
        for way in &place.network.footpaths {
            let length = polyline::length(&way.path);
            // By the metre a way passes over the edges of triangles; by five metres it is what one walks. Where ways meet, one
            // bed leads over into the other, and may do so more steeply.
            let (step, meeting, steepest) = (5.0, 8.0, 0.25);
            let others = place.network.footpaths.iter().filter(|other| !std::ptr::eq(*other, way));
            let others: Vec<_> = others.map(|other| &other.path).collect();
            let walks: Vec<_> = place.network.sidewalks.iter().map(|walk| &walk.path).collect();
            let near = |paths: &[&Vec<Point2>], at: Point2, reach: f64| {
                paths
                    .iter()
                    .any(|path| polyline::closest(path, &at).is_some_and(|near| near.distance < reach))
            };
            // The bed of a road is level to its edge, and a bank wide.
            let meets = |at: Point2| near(&others, at, meeting) || near(&walks, at, 2.0 * meeting);
            let mut station = meeting;
            while station + step + meeting <= length {
                let [from, to] = [station, station + step].map(|at| polyline::at(&way.path, at).0);
                let rise = (place.ground.height(to) - place.ground.height(from)).abs();
                let most = if meets(from) || meets(to) { steepest } else { TRAIL_GRADE };
                assert!(rise / step <= most, "{name}: {:.3} at {from}", rise / step);
                assert!(!place.ground.is_wet(from), "{name}: a wet way at {from}");
                station += step;
            }
        }
    });
}

#[test]
fn every_named_place_can_be_walked_to_from_every_other() {
    every(|place, name| {
        let ways = WaypointGraph::walkable(&place.network, &WaypointConfig::default()).unwrap();
        let named = place.things.iter().filter(|thing| thing.name.is_some());
        let goals: Vec<Point2> = named
            .filter_map(|thing| thing.access)
            .chain(place.areas.iter().filter(|area| area.used_as != "sea").filter_map(|area| area.access))
            .map(|point| point.xy())
            .collect();
        assert!(!goals.is_empty(), "{name}");
        let (mut scratch, mut route) = (RouteScratch::default(), Route::default());
        for goal in &goals {
            let to = ways.nearest(*goal).unwrap();
            assert!((ways.waypoint(to).position - goal).norm() < 16.0, "{name}: no way near {goal}");
            let from = ways.nearest(goals[0]).unwrap();
            assert!(ways.route(from, to, &mut scratch, &mut route), "{name}: no way to {goal}");
        }
    });
}

#[test]
fn an_island_is_one_piece_of_land_with_the_sea_all_round() {
    for seed in 0..4 {
        let place = Landscape::build(&spec(SceneKind::Island), Seed(seed)).unwrap();
        let data = place.ground.data();
        let (columns, rows) = (data.columns as usize, data.rows as usize);
        let dry = |index: usize| data.heights[index] >= 0.0;
        for index in 0..columns * rows {
            let (column, row) = (index % columns, index / columns);
            let at_edge = column == 0 || row == 0 || column + 1 == columns || row + 1 == rows;
            assert!(!(at_edge && dry(index)), "{seed}: land at the edge");
        }
        let mut seen = vec![false; columns * rows];
        let mut pieces = 0;
        for first in 0..columns * rows {
            if !dry(first) || seen[first] {
                continue;
            }
            pieces += 1;
            let mut open = vec![first];
            seen[first] = true;
            while let Some(at) = open.pop() {
                for next in [at - 1, at + 1, at - columns, at + columns] {
                    if dry(next) && !seen[next] {
                        seen[next] = true;
                        open.push(next);
                    }
                }
            }
        }
        assert_eq!(pieces, 1, "{seed}: pieces of land");
    }
}

#[test]
fn woods_are_as_dense_as_they_are_asked_to_be() {
    let count = |amount: Amount| {
        let mut spec = spec(SceneKind::Wilderness);
        spec.streets.trees = amount;
        let place = Landscape::build(&spec, Seed(3)).unwrap();
        // Deep in the woods: wood all round, within 15 m.
        let deep = |at: Point2| {
            (0..8).all(|turn| {
                let way = simworld_core::geometry::direction(f64::from(turn) * std::f64::consts::FRAC_PI_4);
                place.ground.cover(at + way * 15.0) == Cover::Wood
            }) && place.ground.cover(at) == Cover::Wood
        };
        let (low, high) = place.ground.extent();
        let mut area = 0.0;
        let mut y = low.y + 20.0;
        while y < high.y - 20.0 {
            let mut x = low.x + 20.0;
            while x < high.x - 20.0 {
                area += if deep(Point2::new(x, y)) { 25.0 } else { 0.0 };
                x += 5.0;
            }
            y += 5.0;
        }
        let inside = |at: &Point2| (at.coords.abs() + Vector2::repeat(20.0)).max() < high.x && deep(*at);
        (trees(&place).filter(inside).count() as f64 / area * 1e4, trees(&place).count())
    };
    let (usual, all) = count(Amount::Usual);
    assert!((0.7 * FOREST..1.1 * FOREST).contains(&usual), "{usual} trees a hectare");
    let (_, few) = count(Amount::Few);
    let (_, none) = count(Amount::None);
    assert!(few * 2 < all && few > 0 && none == 0, "{all} {few} {none}");
}

#[test]
fn wishes_hold_to_the_number() {
    let mut spec = spec(SceneKind::Island);
    spec.buildings.count = Some(24);
    spec.features.places = BTreeMap::from([(Place::Restaurant, 2), (Place::School, 1)]);
    spec.features.squares = vec!["Market Square".to_owned()];
    spec.features.waters = vec![Water::Harbour, Water::Lake];
    for seed in 0..2 {
        let place = Landscape::build(&spec, Seed(seed)).unwrap();
        assert_eq!(place.buildings().count(), 24 + 1, "{seed}: houses and a lighthouse");
        let of = |used_as| place.buildings().filter(|thing| thing.place == Some(used_as)).count();
        assert_eq!((of(Place::Restaurant), of(Place::School)), (2, 1));
        let areas: Vec<&str> = place.areas.iter().map(|area| area.used_as).collect();
        assert_eq!(areas, ["square", "lake", "sea"], "{seed}");
        let mut world = World::new();
        let entities = place.populate(&mut world).unwrap();
        assert_eq!(entities.things.len(), place.things.len());
        let buildings = world.iter().filter(|entity| entity.kind == EntityKind::Building);
        let boxes: Vec<_> = buildings.map(|entity| entity.obb()).collect();
        for (index, one) in boxes.iter().enumerate() {
            assert!(
                boxes[index + 1..].iter().all(|other| !one.footprints_overlap(other)),
                "{seed}: houses overlap"
            );
        }
    }
}

#[test]
fn a_world_with_land_goes_on_from_its_snapshot() {
    let place = Landscape::build(&spec(SceneKind::Wilderness), Seed(1)).unwrap();
    let mut world = World::new();
    place.populate(&mut world).unwrap();
    world.finish_step();
    let bytes = postcard::to_allocvec(&world.snapshot()).unwrap();
    let again = World::restore(postcard::from_bytes(&bytes).unwrap()).unwrap();
    assert_eq!(again.ground(), world.ground());
    let digest = |world: &World| simworld_core::hash::StateHash::digest(world);
    assert_eq!(digest(&again), digest(&world));
    let mut flat = again.clone();
    let mut data = place.ground.data().clone();
    data.heights[4711] += 1.0;
    flat.set_ground(std::sync::Arc::new(simworld_core::ground::Ground::new(data).unwrap()));
    assert_ne!(digest(&flat), digest(&world), "another ground is another state");
}

#[test]
fn the_same_seed_is_the_same_place_on_any_number_of_threads() {
    for kind in KINDS {
        let build = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Landscape::build(&spec(kind), Seed(5)).unwrap())
        };
        let one = build(1);
        assert_eq!(one, build(3), "{}", kind.as_str());
        assert_ne!(one.ground, Landscape::build(&spec(kind), Seed(6)).unwrap().ground);
    }
}

#[test]
fn what_such_a_place_does_not_have_is_refused() {
    let refused = |kind, change: fn(&mut SceneSpec)| {
        let mut spec = spec(kind);
        change(&mut spec);
        Landscape::build(&spec, Seed(1)).unwrap_err()
    };
    let unsuited =
        |error: LandscapeError| assert!(matches!(error, LandscapeError::Unsuited { .. }), "{error}");
    unsuited(refused(SceneKind::Wilderness, |spec| spec.features.squares.push("Square".to_owned())));
    unsuited(refused(SceneKind::Wilderness, |spec| spec.buildings.count = Some(50)));
    unsuited(refused(SceneKind::Countryside, |spec| spec.features.waters.push(Water::Harbour)));
    unsuited(refused(SceneKind::Island, |spec| spec.features.waters.push(Water::River)));
    unsuited(refused(SceneKind::Island, |spec| spec.buildings.height = Height::High));
    unsuited(refused(SceneKind::Countryside, |spec| spec.streets.parked = Amount::Many));
    unsuited(refused(SceneKind::Countryside, |spec| {
        let (kind, at) = (DistrictKind::Industrial, Whereabouts::Towards(Compass::East));
        spec.features.districts.push(DistrictWish { kind, at, by: None });
    }));
    unsuited(refused(SceneKind::Island, |spec| {
        let (what, at) = ("lighthouse".to_owned(), Whereabouts::Towards(Compass::North));
        spec.features.sites.push(SiteWish { what, at, by: None });
    }));
    let error = refused(SceneKind::Island, |spec| spec.buildings.count = Some(700));
    assert!(matches!(error, LandscapeError::TooMany { .. }), "{error}");
    let error = refused(SceneKind::Island, |spec| {
        spec.features.landmarks.insert("atlantis".to_owned(), 1);
    });
    assert!(matches!(error, LandscapeError::Landmark { .. }), "{error}");
    let error = refused(SceneKind::Countryside, |spec| spec.streets.count = Some(400));
    assert!(matches!(error, LandscapeError::Streets { wanted: 400, .. }), "{error}");
    assert!(matches!(refused(SceneKind::City, |_| ()), LandscapeError::City));
}
