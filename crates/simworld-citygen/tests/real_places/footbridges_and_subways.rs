//! Footbridges, subways and passages through buildings: ways for walkers that pass what lies on another level and meet
//! others at their ends.
#![cfg(feature = "osm")]

use crate::osm_common::{Sketch, real};
use crate::ways_for_walkers::{
    FOOT, assert_beside_roads, assert_reached, block, built, distance, route, samples,
};
use simworld_citygen::map::MapDrawing;
use simworld_citygen::occupancy::overlap;
use simworld_citygen::osm::{OsmId, PlaceOptions, Warning};
use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::Footpath;
use simworld_core::seed::Seed;

const BRIDGE: [(&str, &str); 3] = [("highway", "footway"), ("bridge", "yes"), ("layer", "1")];
const SUBWAY: [(&str, &str); 2] = [("highway", "steps"), ("tunnel", "yes")];
const PASSAGE: [(&str, &str); 2] = [("highway", "footway"), ("tunnel", "building_passage")];

fn told(sketch: &Sketch) -> (City, Vec<Warning>) {
    City::from_place(&sketch.place(), &PlaceOptions::default(), &CityConfig::default(), Seed(1))
        .expect("it has streets")
}

/// A way over or under the southern street of a block, from a way south of it to one through the block.
fn across(tags: &[(&str, &str)]) -> Sketch {
    let sketch = block().node(20, (3.0, -110.0), &[]).node(21, (3.0, -85.0), &[]).node(22, (3.0, -35.0), &[]);
    sketch.way(&[20, 21], &FOOT).way(&[21, 22], tags).way(&[22, 5], &FOOT)
}

fn on_level(city: &City, level: i8) -> Vec<&Footpath> {
    city.network.footpaths.iter().filter(|way| way.level == level).collect()
}

#[test]
fn a_bridge_or_a_subway_leads_across_a_street_that_it_does_not_meet() {
    let without = built(&block().node(22, (3.0, -35.0), &[]).way(&[22, 5], &FOOT));
    for (tags, level) in [(&BRIDGE[..], 1), (&SUBWAY, -1), (&[("highway", "path"), ("layer", "-2")], -2)] {
        let city = built(&across(tags));
        let [way] = on_level(&city, level)[..] else { panic!("{tags:?}: {:?}", city.network.footpaths) };
        assert_eq!((way.joins, way.covered), ([false; 2], false));
        // It keeps its course, to the ends that it shares with the ways there.
        assert!(distance(&way.path, &Point2::new(3.0, -60.0)) < 0.05);
        assert!((way.path[0] - Point2::new(3.0, -85.0)).norm() < 0.05);
        assert_beside_roads(&city.network, "across");
        assert_reached(&city.network, "across");
        let (south, north) = (Point2::new(3.0, -109.0), Point2::new(3.0, 40.0));
        let length = route(&city, south, north);
        assert!((140.0..160.0).contains(&length), "{tags:?}: {length} m");
        // Who is on the sidewalk below has to go round to the northern street.
        let round = route(&city, south, Point2::new(10.0, -55.0));
        assert!(round > 350.0, "{tags:?}: {round} m to the sidewalk that it passes");
        assert_eq!(city.network.crossings, without.network.crossings, "{tags:?}");
    }
}

#[test]
fn what_stands_on_the_ground_stands_below_a_bridge() {
    let tree = |sketch: Sketch| sketch.node(40, (3.0, -48.0), &[("natural", "tree")]);
    let without = built(&tree(block().node(22, (3.0, -35.0), &[]).way(&[22, 5], &FOOT)));
    let city = built(&tree(across(&BRIDGE)));
    let square = |at: Point2| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| at + Vector2::new(x, y))
    };
    let [deck] = on_level(&city, 1)[..] else { panic!("one bridge") };
    // Between the street and the ends of the bridge, which lie on the ground.
    let below = |city: &City| {
        let places: Vec<Point2> =
            samples(&deck.path).into_iter().filter(|at| (-75.0..-40.0).contains(&at.y)).collect();
        let stands = |footprint: &[Point2; 4]| places.iter().any(|at| overlap(footprint, &square(*at)));
        let things = city.elements.iter().filter(|element| stands(&element.obb().footprint()));
        things.map(|element| (element.kind, element.position.x.to_bits())).collect::<Vec<_>>()
    };
    assert!(!below(&without).is_empty());
    assert_eq!(below(&without), below(&city));
    for (place, house) in city.buildings.iter().enumerate() {
        let pierces = |at: Point2| house.ground().iter().any(|piece| overlap(piece, &square(at)));
        assert!(!samples(&deck.path).into_iter().any(pierces), "house {place} rises through the bridge");
    }
}

#[test]
fn lines_that_merely_cross_do_not_meet() {
    // A bridge over a way through the block, from the western street to the eastern; they share no node.
    let sketch = block().node(20, (-100.0, 0.0), &[]).node(21, (100.0, 10.0), &[]);
    let sketch = sketch.node(30, (-60.0, 2.0), &[]).node(31, (60.0, 8.0), &[]);
    let sketch =
        sketch.way(&[20, 30], &FOOT).way(&[30, 31], &BRIDGE).way(&[31, 21], &FOOT).way(&[2, 5], &FOOT);
    let (city, warnings) = told(&sketch);
    assert_eq!(warnings, []);
    let on_the_bridge = route(&city, Point2::new(0.0, -20.0), Point2::new(40.0, 7.0));
    assert!(on_the_bridge > 100.0, "{on_the_bridge} m");
    assert_reached(&city.network, "a bridge over a way");
}

/// A way through the block and one of some tags from the western street, which share a node in the middle of both, and the
/// length of the way from one to the other.
fn sharing(tags: &[(&str, &str)], node: &[(&str, &str)]) -> (f64, Vec<Warning>) {
    let sketch = block().node(20, (-60.0, 2.0), &[]).node(21, (60.0, 8.0), &[]).node(22, (0.0, 5.0), node);
    let sketch = sketch.node(30, (-100.0, 0.0), &[]).way(&[2, 22, 5], &FOOT).way(&[30, 20], &FOOT);
    let (city, warnings) = told(&sketch.way(&[20, 22, 21], tags));
    (route(&city, Point2::new(-60.0, 2.0), Point2::new(0.0, 40.0)), warnings)
}

#[test]
fn a_bridge_that_shares_a_node_with_what_it_passes_is_told_and_not_joined() {
    let (length, warnings) = sharing(&BRIDGE, &[]);
    let [warning] = &warnings[..] else { panic!("{warnings:?}") };
    assert_eq!(warning.element, Some(OsmId::Way(1007)));
    assert!(warning.what.contains("way 1005") && warning.at.is_some(), "{warning}");
    assert!(length > 150.0, "{length} m");
    // A lift leads from one to the other, and so does a node of what is neither a bridge nor a tunnel.
    let lift = sharing(&BRIDGE, &[("highway", "elevator")]);
    let layer = sharing(&[("highway", "footway"), ("layer", "1")], &[]);
    for (length, warnings) in [lift, layer] {
        assert!(warnings.is_empty() && length < 110.0, "{length} m, {warnings:?}");
    }
}

#[test]
fn a_subway_that_ends_at_a_street_leads_to_its_sidewalk() {
    // From the node in the middle of the southern street below the block to the northern one, and one that nobody meets.
    let (city, warnings) = told(&block().way(&[2, 5], &SUBWAY));
    assert_eq!(warnings, []);
    let [way] = on_level(&city, -1)[..] else { panic!("{:?}", city.network.footpaths) };
    assert_eq!(way.joins, [true; 2]);
    assert_beside_roads(&city.network, "a subway");
    assert_reached(&city.network, "a subway");
    let through = route(&city, Point2::new(0.0, -55.0), Point2::new(0.0, 55.0));
    assert!((100.0..140.0).contains(&through), "{through} m");
    let alone = block().node(20, (-40.0, 0.0), &[]).node(21, (40.0, 5.0), &[]).way(&[20, 21], &SUBWAY);
    let (city, warnings) = told(&alone);
    assert_eq!(city.network.footpaths, []);
    let [warning] = &warnings[..] else { panic!("{warnings:?}") };
    assert_eq!(warning.element, Some(OsmId::Way(1005)));
}

/// A house across the block, so that nobody passes beside it, turned a little, with a way to either side.
fn house_across(through: &[(&str, &str)]) -> Sketch {
    let mut sketch = block();
    for (id, at) in (30..).zip([(-85.0, -22.0), (85.0, -4.0), (83.0, 14.0), (-87.0, -4.0)]) {
        sketch = sketch.node(id, at, &[]);
    }
    // On its walls.
    let walls = [(0.0, -13.0), (-2.0, 5.0)];
    for (id, at) in (40..).zip(walls) {
        sketch = sketch.node(id, at, &[]);
    }
    let house = [30, 40, 31, 32, 41, 33, 30];
    sketch
        .way(&house, &[("building", "yes")])
        .way(&[2, 40], &FOOT)
        .way(&[40, 41], through)
        .way(&[41, 5], &FOOT)
}

#[test]
fn a_passage_leads_through_its_building() {
    let blocked = built(&house_across(&FOOT));
    let (south, north) = (Point2::new(0.0, -55.0), Point2::new(0.0, 55.0));
    assert!(route(&blocked, south, north) > 250.0);
    for tags in [&PASSAGE[..], &[("highway", "footway"), ("covered", "yes")]] {
        let (city, warnings) = told(&house_across(tags));
        assert_eq!(warnings, []);
        let through: Vec<&Footpath> = city.network.footpaths.iter().filter(|way| way.covered).collect();
        assert_eq!((through.len(), through[0].level), (1, 0));
        assert_reached(&city.network, "a passage");
        let length = route(&city, south, north);
        assert!(length < 130.0, "{tags:?}: {length} m");
        // The building keeps all of its ground.
        let whole = |city: &City| {
            city.buildings
                .iter()
                .map(simworld_citygen::building::Building::footprint_area)
                .fold(0.0, f64::max)
        };
        assert_eq!(whole(&city).to_bits(), whole(&blocked).to_bits());
    }
}

#[test]
fn a_passage_that_opens_on_a_street_leads_to_its_sidewalk() {
    // A house at the southern street, through which a passage leads from the street to a yard.
    let mut sketch = block();
    for (id, at) in
        (30..).zip([(-30.0, -52.0), (0.0, -52.0), (30.0, -52.0), (30.0, -30.0), (0.0, -30.0), (-30.0, -30.0)])
    {
        sketch = sketch.node(id, at, &[]);
    }
    let sketch = sketch.way(&[30, 31, 32, 33, 34, 35, 30], &[("building", "yes")]).way(&[31, 34], &PASSAGE);
    let (city, warnings) = told(&sketch.way(&[34, 5], &FOOT));
    assert_eq!(warnings, []);
    let through = route(&city, Point2::new(0.0, -55.0), Point2::new(0.0, 55.0));
    assert!(through < 130.0, "{through} m");
    assert_reached(&city.network, "a passage");
}

#[test]
fn files_and_maps_tell_them() {
    let mut sketch = across(&BRIDGE).node(23, (40.0, -110.0), &[]).node(24, (40.0, -35.0), &[]);
    sketch = sketch.way(&[20, 23], &FOOT).way(&[23, 24], &SUBWAY).way(&[24, 5], &FOOT);
    let city = built(&sketch);
    assert_eq!((on_level(&city, 1).len(), on_level(&city, -1).len()), (1, 1));
    let mut bytes = Vec::new();
    city.write_to(&mut bytes).unwrap();
    assert_eq!(City::from_bytes(&bytes).unwrap(), city);
    let mut text = Vec::new();
    city.write_geojson(&mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    let ways: Vec<&str> = text.lines().filter(|line| line.contains(r#""layer":"footpath""#)).collect();
    assert_eq!(ways.len(), city.network.footpaths.len());
    for (level, count) in [(1, 1), (-1, 1), (0, ways.len() - 2)] {
        let told = format!(r#""level":{level},"#);
        assert_eq!(ways.iter().filter(|line| line.contains(&told)).count(), count, "{level}");
    }
    let svg = MapDrawing::of(&city).to_string();
    let place = |id: &str| svg.find(&format!(r#"id="{id}""#)).unwrap_or_else(|| panic!("{id} is not drawn"));
    assert!(place("streets") < place("subways") && place("subways") < place("bridges-1"));
    assert!(svg[place("subways")..].starts_with(r#"id="subways" fill="none" stroke="#));
    assert!(!svg.contains(r#"id="passages""#));
    let svg = MapDrawing::of(&built(&house_across(&PASSAGE))).to_string();
    assert!(svg.find(r#"id="buildings""#).unwrap() < svg.find(r#"id="passages""#).unwrap());
}

#[test]
fn real_places_have_them() {
    for (file, least) in [("monaco.osm.gz", [9, 17, 0]), ("helsinki.osm.pbf", [1, 100, 10])] {
        let Some(place) = real(file) else { continue };
        let (city, warnings) =
            City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), Seed(1)).unwrap();
        let count = |is: fn(&&Footpath) -> bool| city.network.footpaths.iter().filter(is).count();
        let counts = [count(|way| way.level > 0), count(|way| way.level < 0), count(|way| way.covered)];
        println!("{file}: bridges, subways and passages {counts:?}");
        assert!(counts.iter().zip(least).all(|(count, least)| *count >= least), "{file}: {counts:?}");
        let left_out = warnings.iter().filter(|warning| warning.what.contains("no sidewalk is reached"));
        assert!(left_out.count() < 20, "{file}");
    }
}
