//! Tiles of a city without end: each is a function of the seed and its place alone, and neighbours meet exactly.

use proptest::prelude::*;
use rayon::prelude::*;
use simworld_citygen::building::Building;
use simworld_citygen::graph::StreetGraph;
use simworld_citygen::tile::{Tile, TileConfig, TileId, TileSource};
use simworld_citygen::{City, StreetStatistics, Style};
use simworld_core::geometry::{Obb, Point2};
use simworld_core::net::{RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;

fn source(style: Style, seed: u64) -> TileSource {
    TileSource::new(TileConfig::of_style(style), Seed(seed)).expect("styles are valid")
}

fn block(low: (i32, i32), size: i32) -> Vec<TileId> {
    (0..size * size).map(|index| TileId::new(low.0 + index % size, low.1 + index / size)).collect()
}

/// Streets by their courses, which are their own whatever else is in the plan.
fn courses(plan: &StreetPlan, count: usize) -> Vec<Vec<[u64; 2]>> {
    let bits = |point: &Point2| [point.x.to_bits(), point.y.to_bits()];
    let mut courses: Vec<Vec<[u64; 2]>> = plan.streets[..count]
        .iter()
        .map(|street| plan.centerline(street).iter().map(bits).collect())
        .collect();
    courses.sort_unstable();
    courses
}

#[test]
fn windows_are_sound_plans() {
    for (rank, style) in Style::ALL.into_iter().enumerate() {
        for seed in 0..4 {
            let source = source(style, seed);
            // Across the origin, where whole numbers change their sign, and far out.
            let low = if seed == 0 { (-2, -1) } else { (37 * seed as i32, -1900 + rank as i32) };
            let window = source.window(TileId::new(low.0, low.1), TileId::new(low.0 + 2, low.1 + 1)).unwrap();
            let plan = window.plan();
            StreetGraph::of(&plan).unwrap_or_else(|error| panic!("{style} {seed}: {error}"));
            let found = StreetStatistics::of(&plan);
            assert_eq!(found.components, 1, "{style} {seed} is in pieces");
            assert!(found.streets > 300, "{style} {seed} has {} streets", found.streets);
            let network = RoadNetwork::derive(&plan, &source.config().city.network).unwrap();
            assert_eq!(network.check(), Ok(()), "{style} {seed}");
        }
    }
}

#[test]
fn a_window_is_the_sum_of_its_tiles() {
    let source = source(Style::Mixed, 5);
    let ids = block((-1, -1), 2);
    let mut sum: Vec<_> = ids
        .iter()
        .flat_map(|id| {
            let tile = source.tile(*id).unwrap();
            courses(&tile.plan, tile.extent.streets)
        })
        .collect();
    sum.sort_unstable();
    let plan = source.window(ids[0], ids[3]).unwrap().plan();
    let all = courses(&plan, plan.streets.len());
    let mut own = sum.clone();
    own.dedup();
    assert_eq!(own.len(), sum.len(), "a street belongs to two tiles");
    assert!(
        sum.iter().all(|course| all.binary_search(course).is_ok()),
        "a tile's street is not in the window"
    );
    // What else the window has is the main streets on its north and its east.
    let border = all.iter().filter(|course| sum.binary_search(course).is_err()).count();
    assert!((20..80).contains(&border), "{border} streets belong to no tile");
}

#[test]
fn a_tile_is_the_same_in_any_order_and_on_any_threads() {
    let source = source(Style::Organic, 3);
    let ids = block((-1, 4), 3);
    let forward: Vec<Tile> = ids.iter().map(|id| source.tile(*id).unwrap()).collect();
    let mut backward: Vec<Tile> = ids.iter().rev().map(|id| source.tile(*id).unwrap()).collect();
    backward.reverse();
    assert!(forward == backward, "the order matters");
    for threads in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let tiles = pool.install(|| source.tiles(&ids)).unwrap();
        assert!(tiles == forward, "{threads} threads matter");
    }
    let other = TileSource::new(source.config().clone(), Seed(3)).unwrap();
    assert!(other.tile(ids[4]).unwrap() == forward[4], "a source remembers something");
}

#[test]
fn nothing_of_neighbouring_tiles_overlaps() {
    for style in Style::ALL {
        let tiles = source(style, 11).tiles(&block((0, 0), 2)).unwrap();
        let buildings: Vec<&Building> = tiles.iter().flat_map(|tile| &tile.buildings).collect();
        let boxes: Vec<Obb> = buildings.iter().map(|building| building.obb()).collect();
        assert!(boxes.len() > 1500, "{style}: {} buildings on 4 km²", boxes.len());
        let pairs = (0..boxes.len()).into_par_iter().map(|a| {
            let near = |b: &usize| (buildings[a].center - buildings[*b].center).norm() < 150.0;
            (0..a).filter(near).filter(|b| boxes[a].footprints_overlap(&boxes[*b])).count()
        });
        assert_eq!(pairs.sum::<usize>(), 0, "{style}: buildings overlap");
        let solid: Vec<Obb> = tiles
            .iter()
            .flat_map(|tile| &tile.elements)
            .map(simworld_citygen::element::Element::obb)
            .collect();
        let inside = solid.par_iter().filter(|obb| {
            let at = obb.pose.translation.vector.xy();
            let near = |house: &&Obb| (house.pose.translation.vector.xy() - at).norm() < 90.0;
            boxes.iter().filter(near).any(|house| house.footprints_overlap(obb))
        });
        assert_eq!(inside.count(), 0, "{style}: elements stand in buildings");
    }
}

#[test]
fn buildings_keep_off_the_roads_of_the_whole_window() {
    let source = source(Style::Mixed, 2);
    let ids = block((0, 0), 2);
    let plan = source.window(ids[0], ids[3]).unwrap().plan();
    let network = RoadNetwork::derive(&plan, &source.config().city.network).unwrap();
    let roads = simworld_citygen::occupancy::Occupancy::of_roads(&network);
    for tile in source.tiles(&ids).unwrap() {
        let on_road = tile.buildings.iter().filter(|building| !roads.is_free_box(&building.obb())).count();
        assert_eq!(on_road, 0, "tile {:?}: buildings on roads", tile.id);
    }
}

#[test]
fn a_city_stands_on_a_window() {
    let source = source(Style::Suburb, 4);
    let window = source.window(TileId::new(2, 2), TileId::new(2, 2)).unwrap();
    let city = City::from_source(&window, &source.config().city, Seed(4)).unwrap();
    let report = city.report();
    assert_eq!((report.overlaps, report.streets.components), (0, 1));
}

#[test]
fn impossible_requests_are_named() {
    let source = source(Style::Grid, 1);
    let error = source.tile(TileId::new(3, -5000)).unwrap_err().to_string();
    assert!(error.contains("tile.y = -5000") && error.contains("2000"), "{error}");
    let error = source.window(TileId::new(1, 0), TileId::new(0, 0)).unwrap_err().to_string();
    assert!(error.contains("window"), "{error}");
    let mut config = TileConfig::default();
    config.lattice.gates = f64::NAN;
    assert!(TileSource::new(config, Seed(1)).unwrap_err().to_string().contains("lattice.gates"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if std::env::var_os("SIMWORLD_SOAK").is_some() { 2000 } else { 24 }))]

    #[test]
    fn any_window_of_any_lattice_is_planar_and_connected(
        seed in any::<u64>(),
        at in (-1999..1998_i32, -1999..1998_i32),
        style in 0..4_usize,
        spacing in 300.0..1000.0_f64,
        superblocks in 1..=2_u32,
        jitter in 0.0..=0.15_f64,
        bow in 0.0..=0.1_f64,
        gates in 60.0..250.0_f64,
    ) {
        let mut config = TileConfig::of_style(Style::ALL[style]);
        config.lattice.spacing = spacing;
        config.lattice.superblocks = superblocks;
        config.lattice.jitter = jitter;
        config.lattice.bow = bow;
        config.lattice.gates = gates;
        let source = TileSource::new(config, Seed(seed)).unwrap();
        let (low, high) = (TileId::new(at.0, at.1), TileId::new(at.0 + 1, at.1));
        let plan = source.window(low, high).unwrap().plan();
        prop_assert!(plan.validate().is_ok());
        prop_assert!(StreetGraph::of(&plan).is_ok());
        prop_assert_eq!(StreetStatistics::of(&plan).components, 1);
    }
}
