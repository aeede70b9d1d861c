//! What a program chooses, by what detectors tell.

use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};

use super::*;
use crate::signal::Demand;

/// What detectors tell of four groups: gaps, s, times since green, s, and who waits at kerbs.
#[derive(Clone, Copy)]
struct Seen([f64; 4], [f64; 4], [u32; 4]);

const NEVER: f64 = f64::INFINITY;

/// A stage for each of three groups, green for each 10 to 30 s, from each of which come both others; and people beside the third.
fn program() -> (Program, SignalPlan, Vec<Stage>) {
    let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default()).unwrap();
    let green = |groups: &[u32]| Phase {
        duration: 9.0,
        green: groups.iter().copied().map(SignalGroup).collect(),
        yellow: std::iter::empty().collect(),
    };
    let phases = vec![green(&[0]), green(&[1]), green(&[2, 3])];
    let plan = SignalPlan { phases, ..network.signals[0].clone() };
    let mut program = Program::new(Extends::Gap(3.0), vec![(10.0, 30.0); 3]);
    let branches = Branches { phases: Vec::new(), next: vec![vec![1, 2], vec![2, 0], vec![0, 1]] };
    let stages = branching(&plan, &branches.next);
    assert_eq!(program.choose(&plan, branches, None), None);
    (program, plan, stages)
}

fn chosen(elapsed: f64, Seen(gap, since_green, waiting): Seen) -> usize {
    let (program, plan, stages) = program();
    let (none, times) = ([0; 4], [0.0; 4]);
    let demand = Demand {
        approaching: &none,
        queued: &none,
        gap: &gap,
        pressure: &times,
        waiting: &waiting,
        waited: &times,
        kerb: &times,
        since_green: &since_green,
        delayed: &gap,
        in_range: &none,
    };
    let junction =
        JunctionView { plan: &plan, stages: &stages, current: 0, elapsed, seconds: elapsed, demand };
    program.next_stage(&junction)
}

#[test]
fn whoever_is_wanted_most_follows() {
    let red = [0.0, 20.0, 40.0, 40.0];
    let seen = |gap| Seen(gap, red, [0; 4]);
    assert_eq!(chosen(9.0, seen([NEVER; 4])), 0, "not before its least green");
    assert_eq!(chosen(11.0, seen([NEVER; 4])), 1, "nobody came: the first that is named");
    assert_eq!(chosen(11.0, seen([NEVER, NEVER, 35.0, NEVER])), 2, "who came since they had green");
    assert_eq!(chosen(11.0, seen([NEVER, NEVER, 45.0, NEVER])), 1, "but not who came before");
    assert_eq!(chosen(11.0, seen([NEVER, 1.0, 1.0, NEVER])), 1, "of as many the first");
    assert_eq!(chosen(11.0, seen([NEVER, 1.0, 1.0, 1.0])), 2, "of more the most");
    assert_eq!(chosen(11.0, seen([2.0, 1.0, 1.0, 1.0])), 0, "who comes while it is green counts for ten");
    assert_eq!(chosen(30.0, seen([2.0, NEVER, 1.0, NEVER])), 2, "and for nothing at its longest");
    let people = Seen([2.0, 1.0, NEVER, NEVER], red, [0, 0, 0, 2]);
    assert_eq!(chosen(11.0, people), 2, "people count for a hundred");
    let forgotten = Seen([2.0, 1.0, 1.0, NEVER], [0.0, 181.0, 40.0, 40.0], [0; 4]);
    assert_eq!(chosen(11.0, forgotten), 1, "who was forgotten counts seconds");
}
