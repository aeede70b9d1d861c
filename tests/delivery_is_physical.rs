//! Couriers are bodies: walls stop them, they begin to cross on walk alone, and the books balance at every tick.

use simworld_core::geometry::Obb;
use simworld_core::id::CrossingId;
use simworld_core::net::{Aspect, RoadNetwork, polyline};
use simworld_core::scene::{EntityKind, Scene};
use simworld_tests::{assembled, small};

/// Half the width of a body, m: who brushes the edge of a strip at the corner of the sidewalk is not on it.
const HALF_BODY: f64 = 0.25;

/// The crossing on whose strip, kerbs apart, somebody stands.
fn crossing_under(network: &RoadNetwork, at: &nalgebra::Point2<f64>) -> Option<CrossingId> {
    (0..network.crossings.len()).map(CrossingId::from_index).find(|id| {
        let crossing = &network.crossings[id.index()];
        let strip = [crossing.start, crossing.end];
        polyline::closest(&strip, at).is_some_and(|near| {
            let inside = near.station > 0.8 && near.station < polyline::length(&strip) - 0.8;
            inside && near.distance < crossing.width * 0.5 - HALF_BODY
        })
    })
}

#[test]
fn couriers_stay_out_of_walls_and_wait_at_red() {
    let (city, mut assembly) = assembled(&small(2500));
    let network = &city.network;
    let houses: Vec<Obb> = city.buildings.iter().map(simworld_citygen::building::Building::obb).collect();
    let mut on: Vec<Option<CrossingId>> = vec![None; assembly.couriers.len()];
    let mut recent: Vec<Vec<Aspect>> = Vec::new();
    let (mut walked, mut begun) = (0.0, 0);
    while !assembly.episode.is_over() {
        // The kerb is a step or two before the strip: what showed in the last two seconds counts.
        recent.push(assembly.episode.simulation().world().signals().to_vec());
        if recent.len() > 20 {
            recent.remove(0);
        }
        assembly.episode.step().unwrap();
        assembly.episode.task().audit().expect("the books balance at every tick");
        let world = assembly.episode.simulation().world();
        for (index, courier) in assembly.couriers.iter().enumerate() {
            let body = world.entity(*courier).expect("couriers live");
            assert_eq!(body.kind, EntityKind::Person);
            walked += body.twist.ground_speed() * 0.1;
            for house in &houses {
                let local = house.pose.inverse_transform_point(&body.position());
                let inside = local.x.abs() < house.half_extents.x - 0.05
                    && local.y.abs() < house.half_extents.y - 0.05;
                assert!(!inside, "courier {index} is in a wall");
            }
            let now = crossing_under(network, &body.planar());
            if let Some(crossing) = now.filter(|_| now != on[index]) {
                if let Some(group) = network.crossings[crossing.index()].signal {
                    let walk = recent.iter().any(|aspects| aspects[group.index()] == Aspect::Green);
                    assert!(walk, "courier {index} began to cross at red");
                }
                begun += 1;
            }
            on[index] = now;
        }
    }
    assert!(walked > 500.0, "couriers walked {walked:.0} m in all");
    assert!(begun > 3, "couriers crossed {begun} times");
    let delivered = assembly.episode.task().report().expect("the task has begun").delivered;
    assert!(delivered > 0, "nothing was delivered");
}
