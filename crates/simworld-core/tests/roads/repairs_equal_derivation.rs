//! A network that follows changes of its plan is the one that the whole plan gives, and every change can be taken back.

use std::sync::Arc;

use proptest::prelude::*;
use simworld_core::command::{Command, CommandError};
use simworld_core::geometry::{Point2, Vector2, direction, heading};
use simworld_core::net::{
    Control, CrossSection, DrivingSide, NetworkConfig, NetworkError, PatchError, PlanChange, RoadClass,
    RoadNetwork, Street, StreetPlan,
};
use simworld_core::scene::{Scene, World};
use simworld_core::testing::numbered_in_order;

/// A change of a plan, by rank among what it can be made of.
#[derive(Clone, Debug)]
enum Edit {
    RemoveStreet(usize),
    AddStreet(usize, usize, bool),
    MoveNode(usize, Vector2),
    Control(usize, Control),
    Widen(usize),
    Cut(usize),
}

fn any_edit() -> impl Strategy<Value = Edit> {
    let rank = 0_usize..1000;
    let control = prop::sample::select(vec![Control::Priority, Control::Signals]);
    prop_oneof![
        3 => rank.clone().prop_map(Edit::RemoveStreet),
        3 => (rank.clone(), rank.clone(), any::<bool>()).prop_map(|(a, b, new)| Edit::AddStreet(a, b, new)),
        2 => (rank.clone(), -14.0..14.0, -14.0..14.0).prop_map(|(node, x, y)| Edit::MoveNode(node, Vector2::new(x, y))),
        1 => (rank.clone(), control).prop_map(|(node, control)| Edit::Control(node, control)),
        1 => rank.clone().prop_map(Edit::Widen),
        1 => rank.prop_map(Edit::Cut),
    ]
}

/// A town of crooked blocks, streets of all widths, short ones among them.
fn town(columns: usize, rows: usize, shifts: &[(f64, f64)], side: DrivingSide) -> StreetPlan {
    let mut plan = StreetPlan { driving_side: side, ..StreetPlan::grid(columns, rows, 60.0) };
    plan.add_section(CrossSection::two_way(2, 2).with_parking(2.0).with_cycle_lanes(1.8));
    plan.add_section(CrossSection::plain(1, 1, 3.0, 0.0));
    for (node, (x, y)) in plan.nodes.iter_mut().zip(shifts) {
        *node += Vector2::new(*x, *y);
    }
    for (index, street) in plan.streets.iter_mut().enumerate() {
        street.section = [0, 0, 1, 0, 2][index % 5];
        street.class = if street.section == 1 { RoadClass::Arterial } else { RoadClass::Local };
    }
    plan
}

/// Makes the change; what it was, or nothing where it is not to be made.
fn make(plan: &mut StreetPlan, edit: &Edit) -> Option<PlanChange> {
    let mut change = PlanChange::default();
    match edit {
        Edit::RemoveStreet(rank) => {
            if plan.streets.len() < 4 {
                return None;
            }
            let index = rank % plan.streets.len();
            plan.streets.swap_remove(index);
            change.streets_removed.push(index);
            while let Some(lone) = (0..plan.nodes.len())
                .find(|node| plan.streets.iter().all(|street| street.from != *node && street.to != *node))
            {
                let last = plan.nodes.len() - 1;
                plan.nodes.swap_remove(lone);
                let control = plan.controls.remove(&last);
                plan.controls.remove(&lone);
                if let Some(control) = control.filter(|_| last != lone) {
                    plan.controls.insert(lone, control);
                }
                for street in &mut plan.streets {
                    for end in [&mut street.from, &mut street.to] {
                        *end = if *end == last { lone } else { *end };
                    }
                }
                change.nodes_removed.push(lone);
            }
        }
        Edit::AddStreet(a, b, is_new) => {
            let count = plan.nodes.len();
            let (from, mut to) = (a % count, b % count);
            if *is_new {
                // No two streets leave a node in the same direction.
                plan.nodes.push(plan.nodes[from] + direction((count * 7 + b) as f64) * 45.0);
                to = count;
            }
            let joined = |street: &Street| {
                [street.from, street.to] == [from, to] || [street.to, street.from] == [from, to]
            };
            if from == to
                || plan.streets.iter().any(joined)
                || (plan.nodes[to] - plan.nodes[from]).norm() < 16.0
            {
                plan.nodes.truncate(count);
                return None;
            }
            let (section, hammerhead) = ((*b % 3) as u32, [true; 2]);
            plan.streets.push(Street { section, hammerhead, ..Street::simple(from, to) });
        }
        Edit::MoveNode(rank, shift) => {
            let index = rank % plan.nodes.len();
            plan.nodes[index] += *shift;
            change.nodes_changed.push(index);
        }
        Edit::Control(rank, control) => {
            let index = rank % plan.nodes.len();
            plan.controls.insert(index, *control);
            change.nodes_changed.push(index);
        }
        Edit::Widen(rank) => {
            let index = rank % plan.streets.len();
            plan.streets[index].section = 1;
            change.streets_changed.push(index);
        }
        Edit::Cut(rank) => {
            let index = rank % plan.streets.len();
            let (from, to) = (plan.streets[index].from, plan.streets[index].to);
            let middle = nalgebra::center(&plan.nodes[from], &plan.nodes[to]);
            plan.nodes.push(middle);
            let node = plan.nodes.len() - 1;
            plan.streets[index].to = node;
            plan.streets.push(Street { from: node, to, ..plan.streets[index].clone() });
            change.streets_changed.push(index);
        }
    }
    (plan.validate().is_ok() && streets_part(plan)).then_some(change)
}

/// Whether no two streets leave a node in the same direction: of those the order round the node says nothing.
fn streets_part(plan: &StreetPlan) -> bool {
    let leaving = |from: usize, to: usize| (from, heading(&(plan.nodes[to] - plan.nodes[from])));
    let mut legs: Vec<(usize, f64)> = plan
        .streets
        .iter()
        .flat_map(|street| [leaving(street.from, street.to), leaving(street.to, street.from)])
        .collect();
    legs.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    legs.windows(2).all(|pair| pair[0].0 != pair[1].0 || pair[1].1 - pair[0].1 > 1e-9)
}

proptest! {
    #[test]
    fn a_repaired_network_is_the_derived_one(
        size in (2_usize..6, 2_usize..5),
        shifts in prop::collection::vec((-12.0..12.0, -12.0..12.0), 30),
        is_left in any::<bool>(),
        edits in prop::collection::vec(any_edit(), 1..12),
    ) {
        let side = if is_left { DrivingSide::Left } else { DrivingSide::Right };
        let config = NetworkConfig::default();
        let mut plan = town(size.0, size.1, &shifts, side);
        let mut network = RoadNetwork::derive(&plan, &config).unwrap();
        for edit in edits {
            let mut next = plan.clone();
            let Some(change) = make(&mut next, &edit) else { continue };
            let before = network.clone();
            let back = network.repair(&next, &config, &change).unwrap();
            prop_assert_eq!(network.check(), Ok(()));
            let derived = RoadNetwork::derive(&next, &config).unwrap();
            let (repaired, derived) = (numbered_in_order(&network), numbered_in_order(&derived));
            prop_assert_eq!(&repaired.roads, &derived.roads);
            prop_assert_eq!(&repaired.lanes, &derived.lanes);
            prop_assert_eq!(&repaired.intersections, &derived.intersections);
            prop_assert_eq!(&repaired.connections, &derived.connections);
            prop_assert!(repaired == derived, "after {:?}", edit);
            // Back, and there again.
            let after = network.clone();
            let forth = back.mirrored(&network);
            let size = back.lanes.set.len();
            network.put(back).unwrap();
            prop_assert!(network == before, "{:?} is not taken back", edit);
            network.put(forth).unwrap();
            prop_assert!(network == after, "{:?} is not done again", edit);
            prop_assert!(size <= before.lanes.len());
            plan = next;
        }
    }
}

/// Far from a change nothing is touched, whatever the size of the network.
#[test]
fn a_repair_is_as_small_as_its_change() {
    let config = NetworkConfig::default();
    let touched = |side: usize| {
        let mut plan = StreetPlan::grid(side, side, 80.0);
        let mut network = RoadNetwork::derive(&plan, &config).unwrap();
        let middle = (side / 2) * side + side / 2;
        plan.nodes[middle] += Vector2::new(5.0, -3.0);
        let change = PlanChange { nodes_changed: vec![middle], ..PlanChange::default() };
        let back = network.repair(&plan, &config, &change).unwrap();
        (back.roads.set.len(), back.lanes.set.len(), back.connections.set.len(), back.intersections.set.len())
    };
    let small = touched(9);
    assert_eq!(small, touched(40));
    assert!(small.1 <= 60 && small.3 <= 13, "{small:?}");
}

#[test]
fn a_change_of_another_network_is_refused() {
    let config = NetworkConfig::default();
    let plan = StreetPlan::crossroads(100.0);
    let mut network = RoadNetwork::derive(&plan, &config).unwrap();
    let before = network.clone();
    let changes = [
        PlanChange { streets_removed: vec![9], ..PlanChange::default() },
        PlanChange { streets_changed: vec![4], ..PlanChange::default() },
        PlanChange { nodes_removed: vec![0], ..PlanChange::default() },
        PlanChange { streets_removed: vec![3, 3], ..PlanChange::default() },
    ];
    for change in changes {
        let error = network.repair(&plan, &config, &change).unwrap_err();
        assert!(matches!(error, NetworkError::Change { .. }), "{error}");
        assert_eq!(network, before);
    }
    // A street too short to be built: what was begun is taken back.
    let mut close = plan.clone();
    close.nodes[1] = Point2::new(3.0, 0.0);
    let change = PlanChange { nodes_changed: vec![1], ..PlanChange::default() };
    let error = network.repair(&close, &config, &change).unwrap_err();
    assert!(matches!(error, NetworkError::Street { street: 0, .. }), "{error}");
    assert_eq!(network, before);
}

/// The roads of a world change by a command, and back by its undo.
#[test]
fn a_world_follows_by_commands() {
    let config = NetworkConfig::default();
    let mut plan = StreetPlan::grid(4, 4, 90.0);
    let before = RoadNetwork::derive(&plan, &config).unwrap();
    let mut world = World::new();
    world.set_roads(Arc::new(before.clone()));
    plan.streets.swap_remove(7);
    let mut after = before.clone();
    let change = PlanChange { streets_removed: vec![7], ..PlanChange::default() };
    let patch = after.repair(&plan, &config, &change).unwrap().mirrored(&after);
    let undo = world.apply_all(&[Command::PatchRoads(Box::new(patch.clone()))]).unwrap().undo;
    assert_eq!(**world.roads().unwrap(), after);
    assert_eq!(world.signals().len(), after.signal_groups());
    // A second time it is for a network that is no more.
    let mut worse = patch;
    worse.lanes.len = 3;
    worse.lanes.set.clear();
    let error = world.apply(&Command::PatchRoads(Box::new(worse))).unwrap_err();
    assert!(matches!(error, CommandError::Roads(PatchError::Fault(_) | PatchError::Misfit(_))), "{error}");
    assert_eq!(**world.roads().unwrap(), after);
    world.apply_all(&undo).unwrap();
    assert_eq!(**world.roads().unwrap(), before);
}
