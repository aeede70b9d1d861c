//! Signal plans: stages of approaches that may go together, with pedestrians beside them.

use super::NetworkConfig;
use super::legs::Leg;
use crate::geometry::Point2;
use crate::id::{CrossingId, IntersectionId};
use crate::net::{Control, Few, Phase, RoadNetwork, SignalGroup, SignalPlan};
use crate::ops::wrap_angle;
use crate::seed::Seed;

/// Walking speed for which the clearance of a crossing is laid out, m/s.
const CLEARANCE_SPEED: f64 = 1.0;
/// Shortest walk signal, s (MUTCD 2009, 4E.06: 4 to 7 s).
const LEAST_WALK: f64 = 5.0;
/// Two approaches go together if they face each other within this angle, radians.
const OPPOSITE: f64 = 0.8;

/// Adds a plan if the intersection has signals: one group for each leg's vehicles, one for each leg's crossing.
pub(super) fn add(network: &mut RoadNetwork, id: IntersectionId, legs: &[Leg], config: &NetworkConfig) {
    if network.intersections[id.index()].control != Control::Signals {
        return;
    }
    // Groups are numbered on, plan after plan; to count them anew would take ever longer.
    let first = network.signals.last().and_then(|plan| plan.groups.last()).map_or(0, |group| group.0 + 1);
    let count = legs.len() as u32;
    let vehicles = |leg: usize| SignalGroup(first + leg as u32);
    let walkers = |leg: usize| SignalGroup(first + count + leg as u32);
    let crossings = network.intersections[id.index()].crossings.clone();
    // Not every leg has a crossing: only those with a sidewalk on either side.
    let leg_of = |crossing: &CrossingId| {
        let road = network.crossings[crossing.index()].road;
        legs.iter().position(|leg| leg.street == road.index())
    };
    let crossed_legs: Few<(usize, CrossingId)> =
        crossings.iter().filter_map(|crossing| Some((leg_of(crossing)?, *crossing))).collect();
    for (leg, crossing) in &crossed_legs {
        network.crossings[crossing.index()].signal = Some(walkers(*leg));
    }
    let stages = stages(legs);
    let mut phases = Vec::with_capacity(4 * stages.len());
    for stage in stages {
        // People cross the legs whose own vehicles stand; those who turn into them give way.
        let crossed: Few<(usize, CrossingId)> =
            crossed_legs.iter().copied().filter(|(leg, _)| !stage.contains(leg)).collect();
        let width = |(_, crossing): &(usize, CrossingId)| {
            let crossing = &network.crossings[crossing.index()];
            distance(crossing.start, crossing.end)
        };
        let clearance = crossed.iter().map(width).fold(0.0, f64::max) / CLEARANCE_SPEED;
        let go: Few<SignalGroup> = stage.iter().map(|leg| vehicles(*leg)).collect();
        let walk: Few<SignalGroup> = crossed.iter().map(|(leg, _)| walkers(*leg)).collect();
        let both = go.iter().chain(&walk).copied().collect();
        let walking_time = (config.green - clearance).max(LEAST_WALK);
        phases.push(Phase { duration: walking_time, green: both, yellow: Few::new() });
        if clearance > 0.0 {
            phases.push(Phase { duration: clearance, green: go.clone(), yellow: walk });
        }
        phases.push(Phase { duration: config.yellow, green: Few::new(), yellow: go });
        phases.push(Phase { duration: config.all_red, green: Few::new(), yellow: Few::new() });
    }
    phases.retain(|phase| phase.duration > 0.0);
    let cycle: f64 = phases.iter().map(|phase| phase.duration).sum();
    let offset = share_of_cycle(network.intersections[id.index()].center) * cycle;
    let groups = (first..first + 2 * count).map(SignalGroup).collect();
    network.intersections[id.index()].signals = Some(network.signals.len() as u32);
    network.signals.push(SignalPlan { intersection: id, groups, offset, phases });
}

/// Where in its cycle a junction begins, as a share of it: a function of its place, so that it stays when others come and go.
fn share_of_cycle(center: Point2) -> f64 {
    let key = |x: f64| (x * 100.0).round() as i64 as u64;
    Seed(0).stream("core/signals").indexed(key(center.x)).indexed(key(center.y)).rng().unit()
}

/// The approaches that go together: opposite ones in pairs, the rest alone; legs ascending.
fn stages(legs: &[Leg]) -> Few<Few<usize>> {
    let mut left: Few<usize> = (0..legs.len()).collect();
    let mut stages = Few::new();
    while let Some(leg) = left.first().copied() {
        left.remove(0);
        let facing =
            |other: &usize| wrap_angle(legs[*other].heading - legs[leg].heading + std::f64::consts::PI).abs();
        let partner = left.iter().copied().min_by(|a, b| facing(a).total_cmp(&facing(b)));
        match partner.filter(|other| facing(other) <= OPPOSITE) {
            Some(other) => {
                left.retain(|leg| *leg != other);
                stages.push(Few::from_slice(&[leg, other]));
            }
            None => stages.push(Few::from_slice(&[leg])),
        }
    }
    stages
}

fn distance(a: Point2, b: Point2) -> f64 {
    (b - a).norm()
}
