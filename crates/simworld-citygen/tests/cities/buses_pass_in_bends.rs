//! Two buses that meet in a bend of a grown street pass each other: no bend is too narrow for both.

use simworld_citygen::{Style, growth};
use simworld_core::geometry::{Obb, Point2, Point3, Vector3, heading, pose_facing};
use simworld_core::net::{Lane, NetworkConfig, RoadNetwork, polyline};
use simworld_core::seed::Seed;

/// A bus, m, and where it is held to its lane, as shares of its length from the front (as the traffic does).
const LENGTH: f64 = 11.5;
const WIDTH: f64 = 2.5;
const AXLES: (f64, f64) = (0.1, 0.95);
/// Two that meet are looked at after so much of their ways, m.
const STEP: f64 = 1.0;

#[test]
fn buses_pass_in_bends() {
    let mut bends = 0;
    for style in Style::ALL {
        for seed in 0..6 {
            let plan = growth::grow(&style.roads(150), Seed(seed));
            let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a city is a network");
            for road in network.roads.iter().filter(|road| road.centerline.len() > 2) {
                let (Some(own), Some(other)) = (road.forward.first(), road.backward.first()) else {
                    continue;
                };
                let lanes = [own, other].map(|lane| &network.lanes[lane.index()]);
                bends += 1;
                assert!(pass(lanes), "two buses touch on {road:?}, {style} {seed}");
            }
        }
    }
    assert!(bends > 300, "only {bends} streets bend");
}

/// Whether buses on the two lanes are apart wherever they meet.
fn pass(lanes: [&Lane; 2]) -> bool {
    let [own, others] = lanes.map(|lane| {
        let steps = ((lane.length - LENGTH) / STEP).max(0.0) as u32;
        (0..=steps).map(|step| bus(&lane.path, LENGTH + f64::from(step) * STEP)).collect::<Vec<Obb>>()
    });
    own.iter().all(|own| others.iter().all(|other| !own.footprints_overlap(other)))
}

fn bus(lane: &[Point2], front: f64) -> Obb {
    let at = |share: f64| polyline::at(lane, front - share * LENGTH).0;
    let (fore, aft) = (at(AXLES.0), at(AXLES.1));
    let middle = aft + (fore - aft) * ((AXLES.1 - 0.5) / (AXLES.1 - AXLES.0));
    let pose = pose_facing(Point3::new(middle.x, middle.y, 0.0), heading(&(fore - aft)));
    Obb { pose, half_extents: Vector3::new(LENGTH, WIDTH, 3.0) * 0.5 }
}
