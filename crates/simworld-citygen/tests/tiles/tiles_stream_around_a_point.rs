//! A stream holds the tiles around its point, no more and no fewer, and the world holds what the stream does.

use simworld_citygen::graph::StreetGraph;
use simworld_citygen::tile::{CityStream, StreamConfig, TileConfig, TileId, TileSource, WorldStream};
use simworld_citygen::{StreetStatistics, Style};
use simworld_core::geometry::Point2;
use simworld_core::scene::World;
use simworld_core::seed::Seed;

fn stream() -> CityStream {
    let source = TileSource::new(TileConfig::of_style(Style::Suburb), Seed(9)).expect("styles are valid");
    CityStream::new(source, StreamConfig { reach: 400.0, slack: 300.0 }).expect("distances are in range")
}

#[test]
fn what_is_near_is_held_and_what_is_far_is_not() {
    let mut stream = stream();
    for step in 0..40 {
        let point = Point2::new(f64::from(step) * 310.0 - 4000.0, f64::from(step % 7) * 150.0);
        let changes = stream.move_to(point).unwrap();
        let distance = |id: TileId| {
            let (low, high) = stream.source().square(id);
            (point - point.sup(&low).inf(&high)).norm()
        };
        assert!(stream.tiles().all(|tile| distance(tile.id) <= 700.0), "too far at {point}");
        let near = (-10..12).flat_map(|x| (-3..4).map(move |y| TileId::new(x, y)));
        for id in near.filter(|id| distance(*id) <= 400.0) {
            assert!(stream.tiles().any(|tile| tile.id == id), "{id:?} is missing at {point}");
        }
        assert!(changes.entered.iter().all(|tile| stream.tiles().any(|held| held == tile)));
        assert!(changes.left.iter().all(|tile| stream.tiles().all(|held| held.id != tile.id)));
        assert!(stream.tiles().count() <= 9, "memory is not bounded");
    }
}

#[test]
fn a_tile_comes_back_as_it_was() {
    let mut stream = stream();
    let first = stream.move_to(Point2::new(500.0, 500.0)).unwrap().entered;
    let left = stream.move_to(Point2::new(9500.0, 500.0)).unwrap().left;
    assert_eq!(first, left);
    assert_eq!(stream.move_to(Point2::new(500.0, 500.0)).unwrap().entered, first);
}

#[test]
fn the_streets_of_what_is_held_hang_together() {
    let mut stream = stream();
    stream.move_to(Point2::new(990.0, 10.0)).unwrap();
    let plan = stream.plan();
    assert!(stream.tiles().count() >= 4 && StreetGraph::of(&plan).is_ok());
    assert_eq!(StreetStatistics::of(&plan).components, 1);
}

#[test]
fn tiles_enter_a_world_and_leave_it_whole() {
    let (mut world, mut cities) = (World::new(), WorldStream::new(stream()));
    cities.move_to(Point2::new(500.0, 500.0), &mut world).unwrap();
    let count = |cities: &WorldStream| {
        let tiles = cities.stream().tiles();
        tiles
            .map(|tile| cities.entities(tile.id).map_or(0, |entities| entities.iter().count()))
            .sum::<usize>()
    };
    let tile = cities.stream().tiles().next().unwrap().clone();
    let entities = cities.entities(tile.id).unwrap();
    assert_eq!(entities.buildings.len(), tile.buildings.len());
    assert_eq!(entities.elements.len(), tile.elements.len());
    let mut most = 0;
    for step in 0..12 {
        cities.move_to(Point2::new(500.0 + 700.0 * f64::from(step), 480.0), &mut world).unwrap();
        assert_eq!(world.len(), count(&cities), "step {step}");
        most = most.max(world.len());
    }
    // Places of those who left are used again.
    assert!(world.slots() <= 2 * most, "{} slots for {most} entities", world.slots());
}

#[test]
fn a_point_that_is_nowhere_is_refused_and_changes_nothing() {
    let mut stream = stream();
    stream.move_to(Point2::new(500.0, 500.0)).unwrap();
    for bad in [Point2::new(f64::NAN, 0.0), Point2::new(0.0, 1e9)] {
        assert!(stream.move_to(bad).unwrap_err().to_string().contains("point."));
        assert_eq!(stream.tiles().count(), 1);
    }
}
