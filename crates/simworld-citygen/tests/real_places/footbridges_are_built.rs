//! Footbridges in worlds and in files: decks that one walks on, room to pass below, stairs to the ground.
#![cfg(feature = "osm")]

use gltf::Gltf;
use simworld_citygen::edit::{CityEdit, CityEditor, CityInWorld};
use simworld_citygen::osm::PlaceOptions;
use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::{Point2, Point3, Vector3};
use simworld_core::id::RoadId;
use simworld_core::net::{FOOTBRIDGE_HEADROOM, FOOTBRIDGE_STOREY, Footpath, polyline};
use simworld_core::scene::{EntityKind, World};
use simworld_core::seed::Seed;

use crate::osm_common::{Sketch, real};
use crate::ways_for_walkers::{FOOT, block, built, samples};

const BRIDGE: [(&str, &str); 3] = [("highway", "footway"), ("bridge", "yes"), ("layer", "1")];
const STEPS: [(&str, &str); 2] = [("highway", "steps"), ("layer", "1")];

/// A bridge over the southern street of a block with steps to its south end, from a way there, and its other end on a way through the
/// block.
fn sketch() -> Sketch {
    let south = block().node(20, (3.0, -110.0), &[]).node(21, (3.0, -90.0), &[]).node(23, (3.0, -75.0), &[]);
    let sketch = south.node(22, (3.0, -25.0), &[]);
    sketch.way(&[20, 21], &FOOT).way(&[21, 23], &STEPS).way(&[23, 22], &BRIDGE).way(&[22, 5], &FOOT)
}

fn populated(city: &City) -> World {
    let mut world = World::new();
    city.populate(&mut world).unwrap();
    world
}

/// Undersides and tops of all solid props at a point, ascending, m.
fn solids_at(world: &World, at: Point2) -> Vec<(f64, f64)> {
    let mut found = Vec::new();
    for entity in world.iter().filter(|entity| entity.kind == EntityKind::Prop && entity.is_solid()) {
        let from = entity.pose.inverse_transform_point(&Point3::new(at.x, at.y, 0.0));
        let up = entity.pose.rotation.inverse() * Vector3::z();
        let size = entity.info.shape.size();
        let (low, high) = (
            Vector3::new(-size.x * 0.5, -size.y * 0.5, 0.0),
            Vector3::new(size.x * 0.5, size.y * 0.5, size.z),
        );
        let (mut bottom, mut top) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let ends = [low[axis], high[axis]].map(|side| (side - from[axis]) / up[axis]);
            if up[axis].abs() > 1e-9 {
                (bottom, top) = (bottom.max(ends[0].min(ends[1])), top.min(ends[0].max(ends[1])));
            } else if !(low[axis]..=high[axis]).contains(&from[axis]) {
                top = f64::NEG_INFINITY;
            }
        }
        found.extend((bottom < top).then_some((bottom, top)));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

fn raised(city: &City) -> Vec<&Footpath> {
    let heights = city.network.footpath_heights();
    heights.raised().map(|(way, _)| &city.network.footpaths[way]).collect()
}

#[test]
fn one_walks_over_and_drives_under() {
    let city = built(&sketch());
    let [steps, deck] = raised(&city)[..] else { panic!("{:?}", city.network.footpaths) };
    assert!(steps.steps && !deck.steps);
    let world = populated(&city);
    // Over the street: one deck, with room under it.
    let over = solids_at(&world, Point2::new(3.0, -60.0));
    let [(bottom, top)] = over.as_slice() else { panic!("{over:?}") };
    assert!(*bottom >= FOOTBRIDGE_HEADROOM - 0.05 && (top - FOOTBRIDGE_STOREY).abs() < 0.05, "{over:?}");
    // Along the street below nothing stands in the way.
    for x in (-80..=80).map(f64::from) {
        for y in [-62.5, -60.0, -57.5] {
            let low = solids_at(&world, Point2::new(x, y));
            assert!(low.iter().all(|solid| solid.0 >= FOOTBRIDGE_HEADROOM - 0.05), "{low:?} at {x} {y}");
        }
    }
    // It bears from end to end, without a step, on the ground where it begins.
    let mut last = 0.0;
    for at in samples(&steps.path).iter().chain(&samples(&deck.path)) {
        let tops = solids_at(&world, *at).into_iter().map(|solid| solid.1);
        let top = tops.filter(|top| *top < last + 1.0).fold(0.0, f64::max);
        assert!((top - last).abs() < 0.55, "from {last} to {top} m at {at}");
        last = top;
    }
    assert!(last < 0.1, "{last}");
    let railings = world.iter().filter(|it| it.kind == EntityKind::Prop && it.info.shape.size().y < 0.1);
    assert!(railings.count() >= 6);
}

#[test]
fn files_have_them_where_there_are_some() {
    let names = |city: &City| {
        let mut bytes = Vec::new();
        city.write_glb(&mut bytes).unwrap();
        let file = Gltf::from_slice(&bytes).unwrap();
        let mesh = file.meshes().find(|mesh| mesh.name() == Some("footbridges"))?;
        let boxes: Vec<_> = mesh.primitives().map(|part| part.bounding_box()).collect();
        let top = boxes.iter().map(|part| part.max[1]).fold(0.0, f32::max);
        Some((boxes.len(), top))
    };
    let (parts, top) = names(&built(&sketch())).expect("it has a bridge");
    assert_eq!(parts, 3);
    assert!((f64::from(top) - FOOTBRIDGE_STOREY - 1.07).abs() < 0.01, "{top}");
    assert_eq!(names(&built(&block())), None);
    // Steps are known after the city was saved.
    let city = built(&sketch());
    let mut bytes = Vec::new();
    city.write_to(&mut bytes).unwrap();
    assert_eq!(City::from_bytes(&bytes).unwrap().network.footpath_heights(), city.network.footpath_heights());
}

#[test]
fn they_follow_edits_of_what_is_below() {
    let city = built(&sketch());
    let mut world = World::new();
    let mut there = CityInWorld::of(&city.populate(&mut world).unwrap(), &world);
    let mut editor = CityEditor::new(city.clone());
    let content = |world: &World| {
        let mut all: Vec<String> =
            world.iter().map(|it| format!("{:?} {:?} {:?}", it.kind, it.pose, it.info.shape)).collect();
        all.sort_unstable();
        all
    };
    let below = city.network.roads.iter().position(|road| {
        polyline::closest(&road.centerline, &Point2::new(3.0, -60.0)).is_some_and(|near| near.distance < 1.0)
    });
    let edit = CityEdit::RemoveStreet(RoadId::from_index(below.expect("a street passes below")));
    let back = editor.apply(&edit).unwrap();
    let followed = there.follow(&mut editor, back, &mut world).unwrap();
    let now = editor.city();
    assert_ne!(now.network.footpath_heights(), city.network.footpath_heights());
    assert_eq!(content(&world), content(&populated(now)));
    let forth = editor.put(followed.back).unwrap();
    there.follow(&mut editor, forth, &mut world).unwrap();
    assert_eq!(content(&world), content(&populated(&city)));
}

/// Footbridges of real places: how they climb, and that all of them clear the carriageways that they cross.
#[test]
fn real_ones_clear_what_they_cross() {
    for file in ["monaco.osm.gz", "helsinki.osm.pbf"] {
        let Some(place) = real(file) else { continue };
        let (city, _) =
            City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), Seed(1)).unwrap();
        let network = &city.network;
        let heights = network.footpath_heights();
        let (mut over, mut low, mut lengths) = (0, Vec::new(), [0.0; 4]);
        for (way, profile) in heights.raised() {
            let footpath = &network.footpaths[way];
            for pair in profile.windows(2) {
                let run = pair[1].0 - pair[0].0;
                let grade = (pair[1].1 - pair[0].1).abs() / run;
                let kind = [0.001, 0.09, 0.51].iter().take_while(|most| grade > **most).count();
                lengths[kind] += run;
                assert!(grade < 8.0, "{file}: way {way} climbs {profile:?}");
            }
            let length = polyline::length(&footpath.path);
            for step in 0..=(length * 4.0) as u32 {
                let station = f64::from(step) * 0.25;
                let at = polyline::at(&footpath.path, station).0;
                for road in network.roads.iter().filter(|road| (0..footpath.level).contains(&road.level)) {
                    let Some(near) = polyline::closest(&road.centerline, &at) else { continue };
                    if road.level == 0 && near.distance < road.left_kerb.min(road.right_kerb) {
                        over += 1;
                        let free = heights.at(way, station);
                        if free < FOOTBRIDGE_STOREY - 0.3 {
                            low.push((way, station, free));
                        }
                    }
                }
            }
        }
        let count = heights.raised().count();
        println!("{file}: {count} ways leave the ground; level, ramps, stairs, steeper: {lengths:.0?} m");
        println!("{over} places over carriageways, {} too low", low.len());
        assert!(low.is_empty(), "{file}: {low:?}");
        // The footbridges of the other place pass over parks.
        assert!(file != "monaco.osm.gz" || over > 30, "{over}");
    }
}
