//! Where minds drive: streets with signs, and the vehicles of the ambient traffic that they are given.

use simworld_core::id::EntityId;
use simworld_core::net::{Control, RoadNetwork, StreetPlan};
use simworld_traffic::TrafficDynamics;
use simworld_traffic::vehicle::VehicleKind;

use crate::driving::{Rush, Wheels};

/// Stop signs at every second junction of three streets; grown streets have none.
pub(crate) fn with_stop_signs(mut plan: StreetPlan) -> StreetPlan {
    let mut ends = vec![0; plan.nodes.len()];
    for street in &plan.streets {
        ends[street.from] += 1;
        ends[street.to] += 1;
    }
    let of_three = ends.iter().enumerate().filter(|(_, ends)| **ends == 3).map(|(node, _)| node);
    plan.controls.extend(of_three.step_by(2).map(|node| (node, Control::Stop)));
    plan
}

/// Cars, and of rolling wheels bicycles, motorcycles and trucks as well, with some road before them.
pub(crate) fn choose(traffic: &TrafficDynamics, network: &RoadNetwork, rush: &Rush) -> Vec<EntityId> {
    let own = traffic.traffic();
    let mut fitting: Vec<(u32, VehicleKind)> = own
        .stations()
        .filter(|(_, track, s, _)| {
            let lane = network.lanes.get(*track as usize);
            lane.is_some_and(|lane| lane.is_driven() && *s > 15.0 && *s < lane.length - 15.0)
        })
        .filter_map(|(id, ..)| Some((id, own.vehicle(id)?.kind)))
        .filter(|(_, kind)| match rush.wheels {
            Wheels::Tyres => *kind == VehicleKind::Car,
            Wheels::Rolling => *kind != VehicleKind::Scooter && *kind != VehicleKind::Emergency,
        })
        .collect();
    fitting.sort_by_key(|(id, _)| *id);
    // One of each kind first, then cars.
    let mut chosen: Vec<u32> = Vec::new();
    if rush.wheels == Wheels::Rolling {
        for kind in [VehicleKind::Bicycle, VehicleKind::Motorcycle, VehicleKind::Truck] {
            chosen.extend(fitting.iter().find(|(_, other)| *other == kind).map(|(id, _)| *id));
        }
        chosen.truncate(rush.minds / 2);
    }
    let cars = fitting.iter().filter(|(_, kind)| *kind == VehicleKind::Car).map(|(id, _)| *id);
    chosen.extend(cars.take(rush.minds - chosen.len()));
    chosen.iter().map(|id| traffic.vehicles()[*id as usize]).collect()
}
