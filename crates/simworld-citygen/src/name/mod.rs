//! Names of grown streets. A street keeps its name as long as it goes on straight as a road of the same class; no two
//! streets of a city share one.

mod words;

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::lists::Lists;
use simworld_core::net::{RoadClass, Street, StreetPlan, polyline};
use simworld_core::seed::Seed;

use words::{Kind, Names};

/// A street that turns by less than this at a junction goes on; the cosine of 40 degrees.
const STRAIGHT: f64 = 0.766;
/// Dead ends shorter than this are closes and courts, m.
const CLOSE: f64 = 220.0;
/// Streets longer than their beeline by this factor wind.
const WINDING: f64 = 1.06;
/// No street goes on there.
const NONE: u32 = u32::MAX;

/// Names every street of a plan that has none. The same plan and seed give the same names.
///
/// ```
/// use simworld_citygen::name;
/// use simworld_core::{net::StreetPlan, seed::Seed};
/// let mut plan = StreetPlan::grid(4, 3, 100.0);
/// name::streets(&mut plan, Seed(1));
/// // Three streets run through from east to west, four from south to north.
/// assert_eq!(plan.names.len(), 7);
/// assert!(plan.streets.iter().all(|street| street.name.is_some()));
/// ```
pub fn streets(plan: &mut StreetPlan, seed: Seed) {
    let onward = onward(plan);
    let mut degree = vec![0_u32; plan.nodes.len()];
    for street in &plan.streets {
        degree[street.from] += 1;
        degree[street.to] += 1;
    }
    let mut names = Names::new(&mut seed.stream("citygen/names").rng());
    let mut chain: Vec<usize> = Vec::new();
    for first in 0..plan.streets.len() {
        if plan.streets[first].name.is_some() {
            continue;
        }
        let ends = follow(plan, &onward, first, &mut chain);
        let kind = kind_of(plan, &chain, ends, &degree);
        let name = plan.add_name(names.next(kind));
        for street in &chain {
            plan.streets[*street].name = Some(name);
        }
    }
}

/// Which street goes on beyond the beginning and beyond the end of each: at every junction the pairs that turn least.
fn onward(plan: &StreetPlan) -> Vec<[u32; 2]> {
    let mut onward = vec![[NONE; 2]; plan.streets.len()];
    // Half 2i leaves the beginning of street i, half 2i + 1 its end.
    let halves =
        Lists::of(plan.nodes.len(), plan.streets.iter().flat_map(|street| [street.from, street.to]).zip(0..));
    let mut pairs: Vec<(f64, u32, u32)> = Vec::new();
    for node in 0..plan.nodes.len() {
        let here: &[u32] = &halves[node];
        pairs.clear();
        for (rank, a) in here.iter().enumerate() {
            for b in &here[rank + 1..] {
                let (first, second) = (&plan.streets[*a as usize / 2], &plan.streets[*b as usize / 2]);
                let straight = -leaving(plan, *a).dot(&leaving(plan, *b));
                let may_go_on = first.class == second.class && first.level == second.level && a / 2 != b / 2;
                let is_unnamed = first.name.is_none() && second.name.is_none();
                if straight > STRAIGHT && may_go_on && is_unnamed {
                    pairs.push((straight, *a, *b));
                }
            }
        }
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        for (_, a, b) in &pairs {
            let free = |half: u32| onward[half as usize / 2][half as usize % 2] == NONE;
            if free(*a) && free(*b) {
                onward[*a as usize / 2][*a as usize % 2] = *b;
                onward[*b as usize / 2][*b as usize % 2] = *a;
            }
        }
    }
    onward
}

/// The direction in which a half leaves its node.
fn leaving(plan: &StreetPlan, half: u32) -> Vector2 {
    let street = &plan.streets[half as usize / 2];
    let (from, to) = (plan.nodes[street.from], plan.nodes[street.to]);
    let (here, next) = if half.is_multiple_of(2) {
        (from, street.via.first().copied().unwrap_or(to))
    } else {
        (to, street.via.last().copied().unwrap_or(from))
    };
    (next - here).try_normalize(1e-9).unwrap_or_else(Vector2::zeros)
}

/// Collects all streets that a street goes on as, and gives the nodes at the two ends of the whole.
fn follow(plan: &StreetPlan, onward: &[[u32; 2]], first: usize, chain: &mut Vec<usize>) -> [usize; 2] {
    chain.clear();
    chain.push(first);
    [0, 1].map(|way| {
        let mut half = 2 * first + way;
        loop {
            let next = onward[half / 2][half % 2];
            // A ring comes back to where it began.
            if next == NONE || next as usize / 2 == first {
                let street = &plan.streets[half / 2];
                return if half.is_multiple_of(2) { street.from } else { street.to };
            }
            chain.push(next as usize / 2);
            half = next as usize ^ 1;
        }
    })
}

fn kind_of(plan: &StreetPlan, chain: &[usize], ends: [usize; 2], degree: &[u32]) -> Kind {
    let class = plan.streets[chain[0]].class;
    let length: f64 = chain.iter().map(|street| length(plan, &plan.streets[*street])).sum();
    let beeline = (plan.nodes[ends[1]] - plan.nodes[ends[0]]).norm();
    let is_dead = ends.iter().any(|end| degree[*end] == 1);
    match class {
        RoadClass::Highway => Kind::Highway,
        RoadClass::Arterial => Kind::Avenue,
        RoadClass::Local if is_dead && length < CLOSE => Kind::Close,
        RoadClass::Local if length > WINDING * beeline => Kind::Lane,
        RoadClass::Local => Kind::Street,
    }
}

fn length(plan: &StreetPlan, street: &Street) -> f64 {
    let ends = [plan.nodes[street.from], plan.nodes[street.to]];
    if street.via.is_empty() {
        return (ends[1] - ends[0]).norm();
    }
    let mut before: Point2 = ends[0];
    let mut sum = polyline::length(&street.via);
    sum += (street.via[0] - before).norm();
    before = street.via[street.via.len() - 1];
    sum + (ends[1] - before).norm()
}
