//! From lanes that lead on to the ways of a plan: where each lane of a street leads at its ends.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::heading;
use simworld_core::net::{CrossSection, DrivingSide, LaneDirection, LaneWays, StreetPlan};

use super::error::OpenDriveWarning;
use super::lanes::{LaneKey, Leads};

/// Lanes that are passed on the way over a junction at most.
const MOST_PASSED: usize = 1000;

/// The end of a street at which its road ends or goes over into another street.
pub(super) struct Tip<'a> {
    pub(super) street: usize,
    pub(super) at_start: bool,
    /// The number of the road.
    pub(super) road: &'a str,
    /// The lane of the file for each strip of its cross-section.
    pub(super) lanes: &'a [LaneKey],
}

/// The ends of streets at nodes, with their lanes from the middle outwards.
struct Tips<'a> {
    all: &'a [Tip<'a>],
    nodes: Vec<usize>,
    arriving: Vec<Vec<LaneKey>>,
    leaving: Vec<Vec<LaneKey>>,
    /// The end and the rank of each lane on which one leaves a node.
    entries: BTreeMap<LaneKey, (usize, u8)>,
}

/// Which lanes lead from one end into others: pairs of ranks by the number of the other end.
type Known = BTreeMap<usize, BTreeSet<(u8, u8)>>;

/// Tells a plan the ways that the file has; where it has none they are left to the rules.
pub(super) fn set(
    plan: &mut StreetPlan,
    tips: &[Tip<'_>],
    leads: &Leads,
    warnings: &mut Vec<OpenDriveWarning>,
) {
    let tips = Tips::of(plan, tips);
    let mut at_nodes: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (index, node) in tips.nodes.iter().enumerate() {
        at_nodes.entry(*node).or_default().push(index);
    }
    for here in at_nodes.values().filter(|here| here.len() > 1) {
        let known: Vec<Known> = here.iter().map(|tip| tips.known(*tip, leads, warnings)).collect();
        let is_known = known.iter().any(|known| !known.is_empty());
        for (tip, known) in here.iter().zip(known) {
            if !known.is_empty() {
                tips.tell(plan, (*tip, here), &known);
            } else if is_known && !tips.arriving[*tip].is_empty() {
                let what = "leads into no other road by the lanes of the file; its turns are derived";
                warnings.push(OpenDriveWarning::of(tips.all[*tip].road, what));
            }
        }
    }
}

/// The strips of a cross-section that are driven along and against it, from the middle outwards.
fn ranked(section: &CrossSection, side: DrivingSide) -> [Vec<usize>; 2] {
    let of = |direction: LaneDirection| -> Vec<usize> {
        let strips = section.lanes.iter().enumerate();
        let own = strips.filter(|(_, lane)| {
            let is_own =
                (lane.direction == LaneDirection::Backward) == (direction == LaneDirection::Backward);
            lane.kind.is_driven() && is_own
        });
        own.map(|(index, _)| index).collect()
    };
    let [mut along, mut against] = [LaneDirection::Forward, LaneDirection::Backward].map(of);
    // The other side is seen in a mirror, from right to left.
    if side == DrivingSide::Left {
        along.reverse();
        against.reverse();
    }
    let is_usual = match (along.first(), against.first()) {
        (Some(a), Some(b)) => (a > b) == (side == DrivingSide::Right),
        _ => true,
    };
    if is_usual {
        against.reverse();
    } else {
        along.reverse();
    }
    [along, against]
}

impl<'a> Tips<'a> {
    fn of(plan: &StreetPlan, all: &'a [Tip<'a>]) -> Self {
        let mut tips = Self {
            all,
            nodes: Vec::with_capacity(all.len()),
            arriving: Vec::with_capacity(all.len()),
            leaving: Vec::with_capacity(all.len()),
            entries: BTreeMap::new(),
        };
        for (index, tip) in all.iter().enumerate() {
            let street = &plan.streets[tip.street];
            let ranked = ranked(plan.section(street), plan.driving_side);
            let [along, against] = ranked
                .map(|strips| strips.iter().filter_map(|strip| tip.lanes.get(*strip)).copied().collect());
            let (arriving, leaving): (Vec<LaneKey>, Vec<LaneKey>) =
                if tip.at_start { (against, along) } else { (along, against) };
            tips.entries.extend(leaving.iter().zip(0..).map(|(lane, rank)| (*lane, (index, rank))));
            tips.nodes.push(if tip.at_start { street.from } else { street.to });
            tips.arriving.push(arriving);
            tips.leaving.push(leaving);
        }
        tips
    }

    /// The ways on from an end; none if the file knows none.
    fn known(&self, tip: usize, leads: &Leads, warnings: &mut Vec<OpenDriveWarning>) -> Known {
        let mut known = Known::new();
        let (mut turns_back, mut ranks) = (false, BTreeMap::new());
        for (rank, lane) in (0_u8..).zip(&self.arriving[tip]) {
            for (other, to) in self.reached(*lane, self.nodes[tip], leads) {
                turns_back |= other == tip;
                if other != tip {
                    known.entry(other).or_default().insert((rank, to));
                    ranks.entry(rank).or_insert_with(Vec::new).push((other, to));
                }
            }
        }
        let road = self.all[tip].road;
        if turns_back {
            warnings.push(OpenDriveWarning::of(road, "turns back within a junction; that way was left out"));
        }
        let count = self.arriving[tip].len() as u8;
        let lost: Vec<u8> = (0..count).filter(|rank| !ranks.contains_key(rank)).collect();
        if known.is_empty() || lost.is_empty() {
            return known;
        }
        for rank in lost {
            // As the nearest lane goes, to the nearest of its lanes.
            let nearest = ranks.iter().min_by_key(|(other, _)| other.abs_diff(rank));
            let to = nearest.and_then(|(_, ways)| ways.iter().min_by_key(|(_, to)| to.abs_diff(rank)));
            if let Some((other, to)) = to {
                known.entry(*other).or_default().insert((rank, *to));
            }
        }
        let what = "a lane leads nowhere by the file; it leads where the one beside it does";
        warnings.push(OpenDriveWarning::of(road, what));
        known
    }

    /// The ends at a node, with the ranks of their lanes, to which a lane leads over whatever is no street.
    fn reached(&self, lane: LaneKey, node: usize, leads: &Leads) -> Vec<(usize, u8)> {
        let mut passed = BTreeSet::from([lane]);
        let (mut ahead, mut found) = (vec![lane], Vec::new());
        while let Some(lane) = ahead.pop().filter(|_| passed.len() < MOST_PASSED) {
            for next in leads.get(&lane).into_iter().flatten() {
                if !passed.insert(*next) {
                    continue;
                }
                match self.entries.get(next) {
                    Some((tip, rank)) if self.nodes[*tip] == node => found.push((*tip, *rank)),
                    // Streets begin there, elsewhere.
                    Some(_) => {}
                    None => ahead.push(*next),
                }
            }
        }
        found
    }

    /// Writes down what is known of the ways from one of the ends at a node into each of the others.
    fn tell(&self, plan: &mut StreetPlan, (tip, here): (usize, &[usize]), known: &Known) {
        let others = here.iter().filter(|other| **other != tip && !self.leaving[**other].is_empty());
        let ways = others.map(|other| LaneWays {
            heading: self.heading(plan, *other),
            lanes: known.get(other).into_iter().flatten().copied().collect(),
        });
        let ways: Vec<LaneWays> = ways.collect();
        let Tip { street, at_start, .. } = self.all[tip];
        let turns = &mut plan.streets[street].turns;
        if at_start {
            turns.backward_ways = ways;
        } else {
            turns.forward_ways = ways;
        }
    }

    /// Direction in which a street leaves at one of its ends, radians.
    fn heading(&self, plan: &StreetPlan, tip: usize) -> f64 {
        let Tip { street, at_start, .. } = self.all[tip];
        let street = &plan.streets[street];
        let (from, next, to) = if at_start {
            (street.from, street.via.first(), street.to)
        } else {
            (street.to, street.via.last(), street.from)
        };
        heading(&(next.unwrap_or(&plan.nodes[to]) - plan.nodes[from]))
    }
}
