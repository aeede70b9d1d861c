//! Streets and ways for walkers above the ground, over all that they pass: an abutment-dark edge, the deck with its sidewalks, the carriageway.

use std::collections::BTreeSet;
use std::fmt;

use simworld_core::id::RoadId;
use simworld_core::net::{RoadNetwork, Side, polyline};

use super::footways;
use super::page::Page;
use super::path::Pen;
use super::streets::middle_of_carriageway;
use super::strips;
use super::style::{BRIDGE_EDGE, CASING, SIDEWALK, road_style};
use crate::City;

/// The edge of a deck is drawn this much wider than the casing of a street.
const EDGE: f64 = 2.2;

pub(super) fn draw(f: &mut fmt::Formatter<'_>, page: &Page, city: &City) -> fmt::Result {
    let network = &city.network;
    let all =
        network.roads.iter().map(|road| road.level).chain(network.footpaths.iter().map(|way| way.level));
    let levels: BTreeSet<i8> = all.filter(|level| *level > 0).collect();
    for level in levels {
        writeln!(f, r#"<g id="bridges-{level}" fill="none" stroke-linejoin="round">"#)?;
        let roads = || city.network.roads.iter().enumerate().filter(|(_, road)| road.level == level);
        // All edges first, so that decks that meet are one.
        for edge in [true, false] {
            footways::decks(f, page, city, level, edge)?;
            for (index, road) in roads() {
                let deck = deck(&city.network, RoadId::from_index(index)) * page.scale;
                let style = road_style(road.class);
                let deck = page.ink(deck.max(style.least));
                let mut pen = Pen::at(page.middle);
                pen.line(&polyline::offset(
                    &road.centerline,
                    shift(&city.network, RoadId::from_index(index)),
                ));
                let (color, width) =
                    if edge { (BRIDGE_EDGE, deck + page.ink(2.0 * EDGE * CASING)) } else { (SIDEWALK, deck) };
                writeln!(f, r#"<path stroke="{color}" stroke-width="{width:.1}" d="{}"/>"#, pen.into_data())?;
            }
        }
        for (_, road) in roads() {
            let style = road_style(road.class);
            let width = page.ink((road.width * page.scale).max(style.least));
            let mut pen = Pen::at(page.middle);
            pen.line(&middle_of_carriageway(road, page));
            let fill = style.fill;
            writeln!(f, r#"<path stroke="{fill}" stroke-width="{width:.1}" d="{}"/>"#, pen.into_data())?;
        }
        writeln!(f, "</g>")?;
        strips::draw(f, page, city, |road| road.level == level)?;
    }
    Ok(())
}

/// How far a deck reaches to its left and its right, m.
fn sides(network: &RoadNetwork, id: RoadId) -> (f64, f64) {
    let road = &network.roads[id.index()];
    let walk = |side| network.sidewalk(id, side).map_or(0.0, |walk| walk.width);
    (road.left_kerb + walk(Side::Left), road.right_kerb + walk(Side::Right))
}

fn deck(network: &RoadNetwork, id: RoadId) -> f64 {
    let (left, right) = sides(network, id);
    left + right
}

fn shift(network: &RoadNetwork, id: RoadId) -> f64 {
    let (left, right) = sides(network, id);
    (left - right) * 0.5
}
