//! In which order the phases of a program come: those that the file names after each, or the next.
//!
//! Source: SUMO user documentation, *Simulation/Traffic Lights*, attribute `next` of phases: a program by the clock goes to the first that
//! is named, one that follows its vehicles to any of them. The offset finds the first phase of all by the durations in the file's order.

use std::collections::BTreeSet;

use simworld_core::net::Phase;

use super::raw::Logic;

/// The order of the phases that are shown.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Order {
    /// Positions among the phases that are shown: first those of the cycle in which the first that is named follows, then others that may
    /// be chosen. A phase may be there twice.
    pub(super) phases: Vec<usize>,
    /// How many of them are of the cycle.
    pub(super) cycle: usize,
    /// Of each, the places in this order of those that may follow.
    pub(super) next: Vec<Vec<usize>>,
    /// How much of the cycle is over at the start, s.
    pub(super) offset: f64,
    /// Positions of those that come at the start and never again.
    pub(super) only_first: BTreeSet<usize>,
    /// Positions of those that never come.
    pub(super) unreached: BTreeSet<usize>,
}

impl Order {
    /// Of a program with those of its phases that are shown, by their numbers in the file and as they are shown here.
    pub(super) fn of(logic: &Logic, numbers: &[usize], phases: &[Phase]) -> Self {
        let mut graph = graph(logic, numbers);
        if doubles(&graph, phases) {
            graph = doubled(&graph, phases);
        }
        let count = phases.len();
        let length = |place: usize| phases[place % count].duration;
        let cycle: f64 = phases.iter().map(|phase| phase.duration).sum();
        // A positive offset delays the program; here it is the time into the cycle at the start.
        let into = (-logic.offset).rem_euclid(cycle);
        let (start, elapsed) = at(into, phases);
        let (first, mut round) = walk(&graph, start);
        let lead: f64 = first.iter().map(|place| length(*place)).sum::<f64>() - elapsed;
        let least = (0..round.len()).min_by_key(|index| round[*index]).unwrap_or_default();
        round.rotate_left(least);
        let of_round: f64 = round.iter().map(|place| length(*place)).sum();
        let offset = match round.iter().position(|place| *place == start) {
            // As the file has it, to the bit.
            Some(index) if round[..=index].iter().copied().eq(0..=index) => into,
            Some(index) => round[..index].iter().map(|place| length(*place)).sum::<f64>() + elapsed,
            None => {
                let first = (round.len() - least) % round.len();
                let before: f64 = round[..first].iter().map(|place| length(*place)).sum();
                (before - lead).rem_euclid(of_round)
            }
        };
        let order = reached(&graph, &round);
        let of = |places: &[usize]| -> BTreeSet<usize> { places.iter().map(|place| place % count).collect() };
        let (shown, first) = (of(&order), of(&first));
        let only_first: BTreeSet<usize> = first.difference(&shown).copied().collect();
        let unreached =
            (0..count).filter(|index| !shown.contains(index) && !only_first.contains(index)).collect();
        let mut rank = vec![0; graph.len()];
        for (index, place) in order.iter().enumerate() {
            rank[*place] = index;
        }
        let next = order.iter().map(|place| graph[*place].iter().map(|next| rank[*next]).collect()).collect();
        let phases = order.iter().map(|place| place % count).collect();
        Self { phases, cycle: round.len(), next, offset, only_first, unreached }
    }

    /// Whether vehicles choose what follows some phase.
    pub(super) fn has_choice(&self) -> bool {
        self.next.iter().any(|next| next.len() > 1)
    }
}

/// Of each phase that is shown, those that may follow; one without duration is passed over.
fn graph(logic: &Logic, numbers: &[usize]) -> Vec<Vec<usize>> {
    let count = logic.phases.len();
    let named = |number: usize| {
        let phase = &logic.phases[number];
        let chosen = if logic.kind == "actuated" { phase.next.len() } else { phase.next.len().min(1) };
        match &phase.next[..chosen] {
            [] => vec![(number + 1) % count],
            next => next.to_vec(),
        }
    };
    let followers = |number: usize| {
        let mut found = Vec::new();
        let mut seen = BTreeSet::new();
        let mut ahead: Vec<usize> = named(number).into_iter().rev().collect();
        while let Some(next) = ahead.pop() {
            if !seen.insert(next) {
                continue;
            }
            match numbers.binary_search(&next) {
                Ok(place) => found.push(place),
                Err(_) => ahead.extend(named(next).into_iter().rev()),
            }
        }
        found
    };
    let or_itself = |(place, number): (usize, &usize)| match followers(*number) {
        none if none.is_empty() => vec![place],
        some => some,
    };
    numbers.iter().enumerate().map(or_itself).collect()
}

/// Whether somebody has green in a phase and nobody yellow.
pub(super) fn is_stage(phase: &Phase) -> bool {
    !phase.green.is_empty() && phase.yellow.is_empty()
}

/// Whether some stage comes again after its own ending: no stage follows itself here.
fn doubles(graph: &[Vec<usize>], phases: &[Phase]) -> bool {
    let comes_again = |stage: usize| {
        let mut seen = BTreeSet::new();
        let is_ending = |next: &usize| !is_stage(&phases[*next]);
        let mut ahead: Vec<usize> = graph[stage].iter().copied().filter(is_ending).collect();
        while let Some(ending) = ahead.pop() {
            if seen.insert(ending) {
                if graph[ending].contains(&stage) {
                    return true;
                }
                ahead.extend(graph[ending].iter().copied().filter(is_ending));
            }
        }
        false
    };
    (0..graph.len()).any(|place| is_stage(&phases[place]) && comes_again(place))
}

/// Two of each phase: whoever comes to a stage comes to that of the other half. A stage that goes on as it is stays itself.
fn doubled(graph: &[Vec<usize>], phases: &[Phase]) -> Vec<Vec<usize>> {
    let count = graph.len();
    let half = |own: usize, other: usize| {
        graph.iter().enumerate().map(move |(place, next)| {
            let follow = |next: &usize| {
                let changes = is_stage(&phases[*next]) && *next != place;
                next + if changes { other } else { own }
            };
            next.iter().map(follow).collect()
        })
    };
    half(0, count).chain(half(count, 0)).collect()
}

/// The phase that is shown so long after the first of the file began, s, and for how long it has been.
fn at(into: f64, phases: &[Phase]) -> (usize, f64) {
    let mut left = into;
    for (place, phase) in phases.iter().enumerate() {
        if left < phase.duration {
            return (place, left);
        }
        left -= phase.duration;
    }
    (0, 0.0)
}

/// By the first that may follow: what comes once, and what comes again and again.
fn walk(graph: &[Vec<usize>], start: usize) -> (Vec<usize>, Vec<usize>) {
    let mut came = vec![None; graph.len()];
    let mut way = Vec::new();
    let mut place = start;
    while came[place].is_none() {
        came[place] = Some(way.len());
        way.push(place);
        place = graph[place].first().copied().unwrap_or(place);
    }
    let round = way.split_off(came[place].unwrap_or_default());
    (way, round)
}

/// All that may come after those of a cycle, these first.
fn reached(graph: &[Vec<usize>], round: &[usize]) -> Vec<usize> {
    let mut seen: BTreeSet<usize> = round.iter().copied().collect();
    let mut order = round.to_vec();
    let mut index = 0;
    while index < order.len() {
        for next in &graph[order[index]] {
            if seen.insert(*next) {
                order.push(*next);
            }
        }
        index += 1;
    }
    order[round.len()..].sort_unstable();
    order
}
