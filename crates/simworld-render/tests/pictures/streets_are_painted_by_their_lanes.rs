//! What is on a carriageway follows from the lanes of its network, and of surfaces in one plane it is always the same that is seen.

use std::collections::{BTreeMap, BTreeSet};

use crate::common::{crossroads, draw, renderer};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, Vector2};
use simworld_core::net::{Lane, LaneKind, polyline};
use simworld_core::scene::{EntityKind, Scene, World};
use simworld_render::{Backend, Frame, RenderConfig, Renderer};

const SIZE: u32 = 120;

fn intrinsics() -> Intrinsics {
    Intrinsics::from_fov(SIZE, SIZE, 1.0).unwrap()
}

/// Where on the world each pixel lies, with its id.
fn points(frame: &Frame, camera: &Camera) -> Vec<(Point3, u32)> {
    let point = |index: usize| {
        let (x, y) = ((index % SIZE as usize) as f64 + 0.5, (index / SIZE as usize) as f64 + 0.5);
        let depth = f64::from(frame.depth[index]);
        camera.world_from_optical * camera.intrinsics.unproject(&Point2::new(x, y), depth)
    };
    frame.ids.iter().enumerate().map(|(index, id)| (point(index), *id)).filter(|(_, id)| *id != 0).collect()
}

/// Roads whose boxes hold a point well within, as the ids of pixels.
fn roads_at(world: &World, at: &Point3) -> Vec<u32> {
    let holds = |entity: &simworld_core::scene::EntityRef<'_>| {
        let (local, half) = (entity.pose.inverse_transform_point(at), entity.info.shape.size() * 0.5);
        entity.kind == EntityKind::Road && local.x.abs() < half.x - 0.2 && local.y.abs() < half.y - 0.2
    };
    world.iter().filter(holds).map(|entity| entity.id.index() as u32 + 1).collect()
}

#[test]
fn of_two_roads_in_one_plane_one_is_seen_from_everywhere_and_by_every_backend() {
    let world = crossroads();
    let mut winners: BTreeMap<Vec<u32>, BTreeSet<u32>> = BTreeMap::new();
    let mut seen = 0;
    for backend in [Backend::Raster, Backend::Raycast] {
        let Some(mut renderer) = renderer(&RenderConfig { backend, ..RenderConfig::default() }) else {
            return;
        };
        for (eye, target) in [
            ([-30.0, -3.0, 1.5], [0.0, 0.0, 0.0]),
            ([3.0, 25.0, 1.7], [0.0, 0.0, 0.2]),
            ([14.0, -14.0, 6.0], [-2.0, 2.0, 0.0]),
            ([1.0, -1.0, 40.0], [0.0, 0.0, 0.0]),
            ([60.0, 2.0, 2.5], [0.0, 1.0, 0.0]),
        ] {
            let camera = Camera::looking_at(Point3::from(eye), Point3::from(target), intrinsics());
            let frame = draw(&mut renderer, &world, &camera);
            for (point, id) in points(&frame, &camera) {
                let roads = roads_at(&world, &point);
                if roads.len() > 1 && roads.contains(&id) {
                    winners.entry(roads).or_default().insert(id);
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 5_000, "{seen} pixels where roads overlap, {} sets of them", winners.len());
    let torn: Vec<_> = winners.iter().filter(|(_, ids)| ids.len() > 1).collect();
    assert!(torn.is_empty(), "now the one and now the other is seen: {torn:?}");
}

/// The mean colour of 5 x 5 pixels from 6 m above a point, in clear light.
fn color_at(renderer: &mut Renderer, world: &World, at: Point2) -> [f64; 3] {
    let (eye, target) = (Point3::new(at.x, at.y, 6.0), Point3::new(at.x, at.y, 0.0));
    let frame = draw(renderer, world, &Camera::looking_at(eye, target, intrinsics()));
    let middle = SIZE as usize / 2;
    let pixels = (middle - 2..=middle + 2).flat_map(|y| (middle - 2..=middle + 2).map(move |x| (y, x)));
    let mut sum = [0.0; 3];
    for (y, x) in pixels {
        let first = (y * SIZE as usize + x) * 3;
        sum = std::array::from_fn(|channel| sum[channel] + f64::from(frame.rgb[first + channel]) / 25.0);
    }
    sum
}

/// A point on a lane: so far before its end, and so far to its left, m.
fn on(lane: &Lane, before: f64, left: f64) -> Point2 {
    let (point, heading) = polyline::at(&lane.path, lane.length - before);
    let normal = Vector2::new(-simworld_core::ops::sin(heading), simworld_core::ops::cos(heading));
    point + normal * left
}

#[test]
fn lines_arrows_and_cycle_lanes_are_where_the_lanes_say() {
    let world = crossroads();
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let network = std::sync::Arc::clone(world.roads().unwrap());
    let road = &network.roads[0];
    // The lanes that come to the junction: of crossroads the streets begin in their middle, or end there.
    let coming =
        if network.intersections[road.to.index()].roads.len() > 2 { &road.forward } else { &road.backward };
    let (inner, outer) = (&network.lanes[coming[0].index()], &network.lanes[coming[1].index()]);
    let mut light = |lane: &Lane, before: f64, left: f64| -> f64 {
        color_at(&mut renderer, &world, on(lane, before, left)).iter().sum()
    };
    // Between an arrow and the next, beside a manhole.
    let bare = light(outer, 15.0, 0.9);
    let stop = light(outer, 0.2, 0.0);
    assert!(stop > 1.8 * bare, "a stop line: {stop} beside {bare}");
    let shaft = light(outer, 7.5, 0.0);
    assert!(shaft > 1.5 * bare, "an arrow: {shaft} beside {bare}");
    let double = light(inner, 12.0, inner.width * 0.5 - 0.15);
    assert!(double > 1.5 * bare, "a line between the directions: {double} beside {bare}");
    // A broken line is there on a third of its way.
    let border: Vec<bool> =
        (0..36).map(|k| light(inner, 10.0 + f64::from(k) * 0.5, -inner.width * 0.5) > 1.5 * bare).collect();
    let painted = border.iter().filter(|painted| **painted).count();
    assert!((8..=17).contains(&painted), "{painted} of 36 places on a broken line");
    let cycle =
        road.cycle.iter().map(|id| &network.lanes[id.index()]).find(|lane| lane.kind == LaneKind::Cycle);
    let cycle = on(cycle.expect("a cycle lane"), 25.0, 0.0);
    let [red, green, _] = color_at(&mut renderer, &world, cycle);
    assert!(red > 1.4 * green, "a cycle lane is red: {red}, {green}");
    let middle = network.intersections.iter().find(|place| place.roads.len() > 2).unwrap().center;
    let free: f64 = color_at(&mut renderer, &world, middle).iter().sum();
    assert!((free - bare).abs() < 0.5 * bare, "nothing is painted in the middle: {free}, {bare}");
}

#[test]
fn kerbs_stand_out_and_are_let_down_at_crossings() {
    let world = crossroads();
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let network = std::sync::Arc::clone(world.roads().unwrap());
    let (road, crossing) = (&network.roads[0], &network.crossings[0]);
    // On the stones, half their width from the edge of the carriageway.
    let mut height = |at: Point2| {
        let camera =
            Camera::looking_at(Point3::new(at.x, at.y, 3.0), Point3::new(at.x, at.y, 0.0), intrinsics());
        let frame = draw(&mut renderer, &world, &camera);
        let middle = (SIZE * SIZE / 2 + SIZE / 2) as usize;
        (3.0 - f64::from(frame.depth[middle]), frame.classes[middle])
    };
    let station = polyline::length(&road.centerline) * 0.5;
    let (point, heading) = polyline::at(&road.centerline, station);
    let left = Vector2::new(-simworld_core::ops::sin(heading), simworld_core::ops::cos(heading));
    let (stone, class) = height(point + left * (road.left_kerb + 0.07));
    assert!((stone - 0.03).abs() < 1e-3 && class == 8, "{stone} m high, of class {class}");
    assert!(height(point + left * (road.left_kerb - 0.1)).0 < -0.015, "the carriageway before it");
    assert!(height(point + left * (road.left_kerb + 0.3)).0 < 0.005, "the sidewalk behind it");
    let across = (crossing.end - crossing.start).normalize();
    assert!(height(crossing.start - across * 0.07).0 < 0.005, "let down at the crossing");
}
