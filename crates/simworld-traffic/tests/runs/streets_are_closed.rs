//! Streets that the world has closed: the traffic goes round them from the next step on, and comes back when they are opened.

use std::sync::Arc;

use simworld_core::command::Command;
use simworld_core::hash::StateHash;
use simworld_core::id::RoadId;
use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::passage::Passage;
use simworld_core::scene::{Scene, World};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_core::traffic::RoadLeg;
use simworld_traffic::{TrafficConfig, TrafficDynamics};

/// So long it takes who is on a street of 120 m to leave it, and then the street is watched, steps of 0.1 s.
const CLEARING: u32 = 900;
const WATCHED: u32 = 600;

fn simulation() -> Simulation {
    let mut world = World::new();
    let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default())
        .expect("a grid is sound");
    world.set_roads(Arc::new(network));
    let config = TrafficConfig { vehicles: 60, pedestrians: 0, ..TrafficConfig::default() };
    let traffic = TrafficDynamics::new(&mut world, &config, Seed(5)).expect("sound settings");
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("traffic", Box::new(traffic));
    simulation
}

/// The street in the middle of the grid, both ways.
fn legs(world: &World) -> Vec<RoadLeg> {
    let network = world.roads().expect("the grid");
    let middle = network.roads.iter().position(|road| {
        let ends = [road.centerline[0], *road.centerline.last().expect("a road has two ends")];
        ends.iter().all(|end| end.y == 120.0) && ends.iter().any(|end| end.x == 0.0)
    });
    let road = RoadId::from_index(middle.expect("a grid of three has a middle"));
    [LaneDirection::Forward, LaneDirection::Backward].map(|direction| (road, direction)).to_vec()
}

/// How many vehicle-steps are spent on the street between its junctions.
fn spent(simulation: &mut Simulation, steps: u32) -> u32 {
    let mut seen = 0;
    for _ in 0..steps {
        simulation.step().expect("the world goes on");
        let on_it = simulation.world().iter().filter(|entity| {
            let at = entity.planar();
            (20.0..100.0).contains(&at.x) && (at.y - 120.0).abs() < 4.0
        });
        seen += on_it.count() as u32;
    }
    seen
}

#[test]
fn nobody_drives_where_it_is_closed_and_they_come_back() {
    let mut simulation = simulation();
    let legs = legs(simulation.world());
    assert!(spent(&mut simulation, WATCHED) > 50, "it is a street that is used");
    for leg in &legs {
        simulation.submit(Command::SetPassage { leg: *leg, passage: Passage::Closed });
    }
    spent(&mut simulation, CLEARING);
    assert_eq!(spent(&mut simulation, WATCHED), 0, "nobody drives on a closed street");

    // A save in between goes on the same way.
    let saved = simulation.save().unwrap();
    let mut copy = self::simulation();
    copy.restore(saved).unwrap();
    for leg in &legs {
        for run in [&mut simulation, &mut copy] {
            run.submit(Command::SetPassage { leg: *leg, passage: Passage::Open });
        }
    }
    assert!(spent(&mut simulation, CLEARING) > 50, "they come back");
    spent(&mut copy, CLEARING);
    assert_eq!(simulation.digest(), copy.digest());
}
