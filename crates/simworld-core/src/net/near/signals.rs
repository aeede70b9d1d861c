//! One signal plan for joined junctions: arms that face each other go together, with people beside them.

use super::find::Compound;
use super::ways::{Composed, leads_over};
use crate::id::CrossingId;
use crate::net::{Few, Phase, RoadNetwork, SignalGroup, SignalPlan, Turn, polyline};
use crate::ops::wrap_angle;

/// Walking speed for which the clearance of a crossing is laid out, m/s.
const CLEARANCE_SPEED: f64 = 1.0;
/// Shortest walk signal, s (MUTCD 2009, 4E.06: 4 to 7 s).
const LEAST_WALK: f64 = 5.0;
/// Two arms go together if they face each other within this angle, radians.
const OPPOSITE: f64 = 0.8;
/// Arms side by side go together as well, if they do not differ by more than this angle, radians.
const BESIDE: f64 = 0.4;

/// Times of a plan, s.
#[derive(Clone, Copy, Debug)]
struct Times {
    green: f64,
    yellow: f64,
    all_red: f64,
}

/// The vehicles of one signal group.
#[derive(Debug)]
struct Arm {
    group: SignalGroup,
    /// The direction in which the arm leads away.
    heading: f64,
    /// Ranks of its ways.
    ways: Vec<usize>,
}

/// Joins the plans of all nodes into one at the first; `network` still has them, and its connections are those of `before` no more.
/// One that is alone stays as it is.
pub(super) fn join(network: &mut RoadNetwork, before: &RoadNetwork, compound: &Compound, ways: &[Composed]) {
    let plans: Vec<u32> =
        compound.nodes.iter().filter_map(|node| before.intersections[node.index()].signals).collect();
    let Some(own) = before.intersections[compound.main.index()].signals.or(plans.first().copied()) else {
        return;
    };
    for node in &compound.nodes {
        network.intersections[node.index()].signals = (*node == compound.main).then_some(own);
    }
    if plans.len() == 1 {
        network.signals[own as usize].intersection = compound.main;
        return;
    }
    let known = &before.signals[own as usize];
    let mut groups: Vec<SignalGroup> =
        plans.iter().flat_map(|plan| before.signals[*plan as usize].groups.iter().copied()).collect();
    groups.sort_unstable();
    let phases = phases(before, compound, ways, times(known));
    let share = if known.cycle() > 0.0 { known.offset / known.cycle() } else { 0.0 };
    let mut plan = SignalPlan { intersection: compound.main, groups, offset: 0.0, phases };
    plan.offset = share * plan.cycle();
    for other in plans {
        network.signals[other as usize].groups.clear();
    }
    network.signals[own as usize] = plan;
}

/// Takes out the plans that were joined to others, which have no groups any more.
pub(super) fn close_gaps(network: &mut RoadNetwork) {
    let stays = |plan: &SignalPlan| network.intersections[plan.intersection.index()].signals.is_some();
    let kept: Vec<bool> = network.signals.iter().map(|plan| stays(plan) && !plan.groups.is_empty()).collect();
    let mut kept = kept.into_iter();
    network.signals.retain(|_| kept.next().unwrap_or(false));
    for (index, plan) in network.signals.iter().enumerate() {
        network.intersections[plan.intersection.index()].signals = Some(index as u32);
    }
}

/// The times by which a plan was laid out.
fn times(plan: &SignalPlan) -> Times {
    let shows = |phase: &&Phase| !phase.green.is_empty();
    let ends = plan.phases.iter().find(|phase| phase.green.is_empty() && !phase.yellow.is_empty());
    let rests = plan.phases.iter().find(|phase| phase.green.is_empty() && phase.yellow.is_empty());
    Times {
        green: plan.phases.iter().take_while(shows).map(|phase| phase.duration).sum(),
        yellow: ends.map_or(0.0, |phase| phase.duration),
        all_red: rests.map_or(0.0, |phase| phase.duration),
    }
}

/// What ways share each light, counter-clockwise from east by the direction of the arm.
fn arms(network: &RoadNetwork, ways: &[Composed]) -> Vec<Arm> {
    let mut arms: Vec<Arm> = Vec::new();
    for (rank, way) in ways.iter().enumerate() {
        let Some(group) = way.signal else { continue };
        if let Some(arm) = arms.iter_mut().find(|arm| arm.group == group) {
            arm.ways.push(rank);
            continue;
        }
        let lane = &network.lanes[way.from.index()];
        let heading = wrap_angle(polyline::at(&lane.path, lane.length).1 + std::f64::consts::PI);
        arms.push(Arm { group, heading, ways: vec![rank] });
    }
    arms.sort_by(|a, b| a.heading.total_cmp(&b.heading).then(a.group.cmp(&b.group)));
    arms
}

/// Which arms go together: opposite ones, with those beside either.
fn stages(arms: &[Arm]) -> Vec<Vec<usize>> {
    let between = |a: usize, b: usize| wrap_angle(arms[a].heading - arms[b].heading).abs();
    let mut left: Vec<usize> = (0..arms.len()).collect();
    let mut stages = Vec::new();
    while let Some(first) = left.first().copied() {
        let facing = |other: usize| std::f64::consts::PI - between(first, other);
        let partner = left.iter().copied().skip(1).min_by(|a, b| facing(*a).total_cmp(&facing(*b)));
        let partner = partner.filter(|other| facing(*other) <= OPPOSITE);
        let goes = |other: usize| {
            let is_beside = |one: usize| one == other || between(one, other) <= BESIDE;
            is_beside(first) || partner.is_some_and(is_beside)
        };
        stages.push(left.iter().copied().filter(|arm| goes(*arm)).collect());
        left.retain(|arm| !goes(*arm));
    }
    stages
}

fn phases(network: &RoadNetwork, compound: &Compound, ways: &[Composed], times: Times) -> Vec<Phase> {
    let arms = arms(network, ways);
    let stages = stages(&arms);
    let walks = walks(network, compound, ways, &arms, &stages);
    let mut phases = Vec::new();
    for (stage, walks) in stages.iter().chain([&Vec::new()]).zip(&walks) {
        let mut go: Few<SignalGroup> = stage.iter().map(|arm| arms[*arm].group).collect();
        go.extend(inside(network, compound, ways, stage.iter().flat_map(|arm| &arms[*arm].ways)));
        add_stage(&mut phases, network, sorted(go), walks, times);
    }
    phases.retain(|phase| phase.duration > 0.0);
    phases
}

fn add_stage(
    phases: &mut Vec<Phase>,
    network: &RoadNetwork,
    go: Few<SignalGroup>,
    walks: &[CrossingId],
    times: Times,
) {
    if go.is_empty() && walks.is_empty() {
        return;
    }
    let crossings = || walks.iter().map(|id| &network.crossings[id.index()]);
    let width = crossings().map(|crossing| (crossing.end - crossing.start).norm()).fold(0.0, f64::max);
    let clearance = width / CLEARANCE_SPEED;
    let walk = sorted(crossings().filter_map(|crossing| crossing.signal).collect());
    let both = sorted(go.iter().chain(&walk).copied().collect());
    let green = if go.is_empty() { LEAST_WALK } else { (times.green - clearance).max(LEAST_WALK) };
    phases.push(Phase { duration: green, green: both, yellow: Few::new() });
    if clearance > 0.0 {
        phases.push(Phase { duration: clearance, green: go.clone(), yellow: walk });
    }
    if !go.is_empty() {
        phases.push(Phase { duration: times.yellow, green: Few::new(), yellow: go });
    }
    phases.push(Phase { duration: times.all_red, green: Few::new(), yellow: Few::new() });
}

fn sorted(mut groups: Few<SignalGroup>) -> Few<SignalGroup> {
    groups.sort_unstable();
    groups.dedup();
    groups
}

/// The crossings on which people walk in each stage, and in one of their own at the end those for which there is no other.
///
/// They cross where nobody goes straight on, and comes by the road that they cross; who turns into it gives way.
fn walks(
    network: &RoadNetwork,
    compound: &Compound,
    ways: &[Composed],
    arms: &[Arm],
    stages: &[Vec<usize>],
) -> Vec<Vec<CrossingId>> {
    let mut walks = vec![Vec::new(); stages.len() + 1];
    for id in compound.crossings(network) {
        let crossing = &network.crossings[id.index()];
        if crossing.signal.is_none() {
            continue;
        }
        let bars = |way: &Composed, strictly: bool| {
            let comes_by = network.lanes[way.from.index()].road == crossing.road;
            let passes =
                || way.turn == Turn::Straight || comes_by || (strictly && compound.is_inside(crossing.road));
            passes() && leads_over(&way.path, crossing)
        };
        let is_open = |stage: &Vec<usize>, strictly: bool| {
            let mut all = stage.iter().flat_map(|arm| &arms[*arm].ways);
            !all.any(|way| bars(&ways[*way], strictly))
        };
        let strictly = stages.iter().any(|stage| is_open(stage, true));
        let mut finds_one = false;
        for (walk, stage) in walks.iter_mut().zip(stages) {
            if is_open(stage, strictly) {
                walk.push(id);
                finds_one = true;
            }
        }
        if !finds_one {
            walks[stages.len()].push(id);
        }
    }
    walks
}

/// The groups of the legs inside over which some ways lead: nobody waits there, and what is shown goes with those who come.
fn inside<'a>(
    network: &RoadNetwork,
    compound: &Compound,
    ways: &[Composed],
    going: impl Iterator<Item = &'a usize>,
) -> Vec<SignalGroup> {
    let lanes = going.flat_map(|way| &ways[*way].through);
    let group = |lane: &crate::id::LaneId| {
        let lane = &network.lanes[lane.index()];
        let place = &network.intersections[lane.to.index()];
        let plan = &network.signals[place.signals? as usize];
        let leg = place.roads.iter().position(|road| *road == lane.road)?;
        // One group for each leg's vehicles, and one for its crossing; other plans are made otherwise.
        (compound.has(lane.to) && plan.groups.len() == 2 * place.roads.len()).then(|| plan.groups[leg])
    };
    lanes.filter_map(group).collect()
}
