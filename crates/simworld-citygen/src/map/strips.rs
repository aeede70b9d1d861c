//! What lies beside the lanes: parking with its bays, cycle lanes, medians, shoulders and verges.

use std::collections::BTreeMap;
use std::fmt;

use simworld_core::net::{LaneKind, Road};

use super::page::Page;
use super::path::Pen;
use super::style::strip_color;
use crate::City;
use crate::strips::{bays, is_planted};

/// Strips narrower than this on paper are left out, mm.
const FINEST: f64 = 0.3;
/// The ends of parking bays are drawn from this scale on, mm a metre.
const BAYS_FROM: f64 = 0.6;

/// Draws the strips of some of the roads.
pub(super) fn draw(
    f: &mut fmt::Formatter<'_>,
    page: &Page,
    city: &City,
    is_meant: impl Fn(&Road) -> bool,
) -> fmt::Result {
    let mut layers: BTreeMap<(&str, &str), Pen> = BTreeMap::new();
    let mut marks = Pen::at(page.middle);
    for road in city.network.roads.iter().filter(|road| is_meant(road)) {
        for strip in road.strips.iter().filter(|strip| strip.width * page.scale >= FINEST) {
            let Some(layer) = strip_color(strip.kind, is_planted(strip)) else { continue };
            let pen = layers.entry(layer).or_insert_with(|| Pen::at(page.middle));
            pen.polygon(&road.strip_outline(strip));
            if strip.kind == LaneKind::Parking && page.scale >= BAYS_FROM {
                for bay in bays(road, strip) {
                    marks.line(&bay);
                }
            }
        }
    }
    if layers.is_empty() {
        return Ok(());
    }
    writeln!(f, r#"<g class="strips">"#)?;
    for ((id, color), pen) in layers {
        writeln!(f, r#"<path class="{id}" fill="{color}" d="{}"/>"#, pen.into_data())?;
    }
    if !marks.is_empty() {
        writeln!(
            f,
            r##"<path class="parking-bays" fill="none" stroke="#ffffff" stroke-width="2" d="{}"/>"##,
            marks.into_data()
        )?;
    }
    writeln!(f, "</g>")
}
