//! What is surely blocked is blocked.

use simworld_core::net::{NetworkConfig, StreetPlan};
use simworld_core::seed::Seed;

use super::*;
use crate::block::{Block, Border};
use crate::lot::LotConfig;
use crate::zoning::{Zoning, ZoningConfig};

/// A block of four streets, its far corners so far aside, divided into lots.
fn land(aside: f64) -> Land {
    let corners = [(0.0, 0.0), (170.0, 0.0), (170.0 + aside, 110.0), (aside * 0.5, 90.0)];
    let corners = corners.map(|(x, y)| Point2::new(x + 2000.0, y - 900.0)).to_vec();
    let streets = (0..4).map(|road| Border::street(RoadId::from_index(road), Side::Left)).collect();
    let block = Block::closed(corners, streets).expect("a convex block is simple");
    let zoning = Zoning::new(&ZoningConfig { parks: 0.0, ..ZoningConfig::default() }, Seed(3));
    Land::of_block(block, &zoning, &LotConfig::default(), Seed(3))
}

/// Asks at every station along a street of a lot what is surely blocked; says how often it was.
fn sure_along(planner: &Planner<'_>, site: &Site<'_>) -> usize {
    let Some((mut start, end)) = planner.room(site, LEAST) else { return 0 };
    let mut count = 0;
    while end - start >= LEAST {
        for kind in ARCHETYPES {
            let can_fit = kind.width.0 <= end - start && kind.depth.0 <= planner.deepest(site);
            if !can_fit {
                continue;
            }
            let mut rng = Seed(5).stream("spots").rng();
            if let Some(spot) = planner.fit(site, kind, (start, end), &mut rng) {
                let meets = planner.blocked.meets(spot);
                assert!(!meets || !planner.is_apart(site, spot), "{} would stand at {start}", kind.name);
            }
            if !planner.blocked.is_sure((start, end), kind.width) {
                continue;
            }
            count += 1;
            for draw in 0..4 {
                let mut rng = Seed(5).stream("draws").indexed(draw).rng();
                let mut once = rng.clone();
                once.bits();
                let spot = planner.fit(site, kind, (start, end), &mut rng).expect("it surely fits");
                assert_eq!(rng, once, "{} fits at the first depth", kind.name);
                assert!(!planner.is_apart(site, spot), "{} would stand at {start}", kind.name);
            }
        }
        start += 0.7;
    }
    count
}

#[test]
fn what_is_surely_blocked_fits_and_is_never_free() {
    let network = RoadNetwork::derive(&StreetPlan::crossroads(120.0), &NetworkConfig::default())
        .expect("a crossroads is sound");
    let weights = Weights::new();
    let mut sure = 0;
    for (aside, gap) in [(0.0, 0.8), (14.0, 0.8), (-35.0, 0.8), (20.0, 0.0), (5.0, 6.0)] {
        let (land, config) = (land(aside), BuildingConfig { gap, ..BuildingConfig::default() });
        let streams = Seed(3).stream("buildings");
        let mut planner = Planner::new(&network, &land, &config, &weights, streams);
        for (index, lot) in (0..).zip(&land.lots) {
            let mut rng = streams.indexed(index).rng();
            planner.first = planner.plans.grounds.len();
            for (edge, border) in land.borders(lot).iter().enumerate() {
                let Some(site) = border.as_street().and_then(|street| planner.look(lot, edge, street)) else {
                    continue;
                };
                sure += sure_along(&planner, &site);
                planner.fill(&site, edge == 0, &mut rng);
            }
        }
    }
    assert!(sure > 500, "{sure}");
}

#[test]
fn no_kind_is_smaller_than_the_least() {
    assert!(ARCHETYPES.iter().all(|kind| kind.width.0 >= LEAST && kind.depth.0 >= LEAST));
    assert!(ARCHETYPES.iter().all(|kind| kind.depth.1 <= DEEPEST));
}
