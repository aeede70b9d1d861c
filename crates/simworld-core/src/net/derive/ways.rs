//! Ways that a plan knows lane by lane: which of them lead from one leg of a junction into another.

use super::connections::{arriving, leaving};
use super::legs::Leg;
use crate::id::LaneId;
use crate::net::{LaneWays, RoadNetwork, StreetPlan, Turn};
use crate::ops::wrap_angle;

/// How far from the direction that is told a street may leave, radians.
const NEAR: f64 = 0.2;

/// What is known of the lanes that arrive over a leg; none where all is left to the rules.
pub(super) fn of<'a>(plan: &'a StreetPlan, leg: &Leg) -> &'a [LaneWays] {
    let turns = &plan.streets[leg.street].turns;
    if leg.at_start { &turns.backward_ways } else { &turns.forward_ways }
}

/// Those of the ways from a leg that lead into another one; `None` if nothing is known of that one.
fn into<'a>(known: &'a [LaneWays], legs: &[Leg], (leg, other): (&Leg, &Leg)) -> Option<&'a LaneWays> {
    let apart = |ways: &LaneWays, leg: &Leg| wrap_angle(ways.heading - leg.heading).abs();
    let own = known.iter().min_by(|a, b| apart(a, other).total_cmp(&apart(b, other)))?;
    let away = apart(own, other);
    let is_rival = |rival: &&Leg| rival.street != leg.street && rival.street != other.street;
    let is_meant = legs.iter().filter(is_rival).all(|rival| apart(own, rival) >= away);
    (is_meant && away <= NEAR).then_some(own)
}

/// Adds the ways from one leg into another that are known. False if none are.
pub(super) fn add(
    network: &RoadNetwork,
    known: &[LaneWays],
    legs: &[Leg],
    (leg, other, turn): (&Leg, &Leg, Turn),
    found: &mut Vec<(LaneId, LaneId, Turn)>,
) -> bool {
    let Some(ways) = into(known, legs, (leg, other)) else { return false };
    let (from, to) = (arriving(network, leg), leaving(network, other));
    // The other street may have become narrower since.
    let pairs = ways
        .lanes
        .iter()
        .filter_map(|(a, b)| Some((*from.get(usize::from(*a))?, *to.get(usize::from(*b))?, turn)));
    found.extend(pairs);
    true
}
