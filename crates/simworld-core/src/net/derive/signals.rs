//! Signal plans: stages of approaches that may go together, with pedestrians beside them.

use super::NetworkConfig;
use super::legs::{Leg, Legs};
use super::workers::{self, Workers};
use crate::geometry::Point2;
use crate::id::IntersectionId;
use crate::net::{Control, Crossing, Few, Phase, RoadNetwork, SignalGroup, SignalPlan};
use crate::ops::wrap_angle;
use crate::seed::Seed;

/// Walking speed for which the clearance of a crossing is laid out, m/s.
const CLEARANCE_SPEED: f64 = 1.0;
/// Shortest walk signal, s (MUTCD 2009, 4E.06: 4 to 7 s).
const LEAST_WALK: f64 = 5.0;
/// Two approaches go together if they face each other within this angle, radians.
const OPPOSITE: f64 = 0.8;

/// The groups of a plan, numbered on from those of the plans before: one for each leg's vehicles, one for each leg's crossing.
#[derive(Clone, Copy)]
struct Groups {
    first: u32,
    legs: u32,
}

impl Groups {
    const fn vehicles(self, leg: usize) -> SignalGroup {
        SignalGroup(self.first + leg as u32)
    }

    const fn walkers(self, leg: usize) -> SignalGroup {
        SignalGroup(self.first + self.legs + leg as u32)
    }

    /// The first number of the next plan.
    const fn end(self) -> u32 {
        self.first + 2 * self.legs
    }
}

/// Adds the plans of the intersections with signals.
pub(super) fn add(network: &mut RoadNetwork, legs: &Legs, config: &NetworkConfig, workers: &dyn Workers) {
    let mut next = 0;
    let groups = network.intersections.iter().zip(legs.by_node()).map(|(place, legs)| {
        let groups = Groups { first: next, legs: legs.len() as u32 };
        let has_signals = place.control == Control::Signals;
        has_signals.then(|| {
            next = groups.end();
            groups
        })
    });
    let groups: Vec<Option<Groups>> = groups.collect();
    let plans = workers::each(workers, legs.nodes(), |node| {
        groups[node]
            .map(|groups| plan(network, IntersectionId::from_index(node), &legs[node], groups, config))
    });
    network.signals.reserve_exact(groups.iter().flatten().count());
    for (node, (plan, groups)) in plans.into_iter().zip(groups).enumerate() {
        let (Some(plan), Some(groups)) = (plan, groups) else { continue };
        let place = &mut network.intersections[node];
        place.signals = Some(network.signals.len() as u32);
        network.signals.push(plan);
        for crossing in &place.crossings {
            let crossing = &mut network.crossings[crossing.index()];
            crossing.signal = crossed(&legs[node], crossing).map(|leg| groups.walkers(leg));
        }
    }
}

/// Over which of the legs of its intersection a crossing leads.
fn crossed(legs: &[Leg], crossing: &Crossing) -> Option<usize> {
    legs.iter().position(|leg| leg.street == crossing.road.index())
}

/// The plan of an intersection.
fn plan(
    network: &RoadNetwork,
    id: IntersectionId,
    legs: &[Leg],
    groups: Groups,
    config: &NetworkConfig,
) -> SignalPlan {
    let place = &network.intersections[id.index()];
    // Not every leg has a crossing: only those with a sidewalk on either side.
    let crossings = place.crossings.iter().map(|crossing| &network.crossings[crossing.index()]);
    let crossed_legs: Few<(usize, f64)> = crossings
        .filter_map(|crossing| Some((crossed(legs, crossing)?, distance(crossing.start, crossing.end))))
        .collect();
    let stages = stages(legs);
    let mut phases = Vec::with_capacity(4 * stages.len());
    for stage in stages {
        // People cross the legs whose own vehicles stand; those who turn into them give way.
        let crossed = || crossed_legs.iter().filter(|(leg, _)| !stage.contains(leg));
        let clearance = crossed().map(|(_, width)| *width).fold(0.0, f64::max) / CLEARANCE_SPEED;
        let go: Few<SignalGroup> = stage.iter().map(|leg| groups.vehicles(*leg)).collect();
        let walk: Few<SignalGroup> = crossed().map(|(leg, _)| groups.walkers(*leg)).collect();
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
    let offset = share_of_cycle(place.center) * cycle;
    let groups = (groups.first..groups.end()).map(SignalGroup).collect();
    SignalPlan { intersection: id, groups, offset, phases }
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
