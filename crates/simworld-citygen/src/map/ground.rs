//! What lies between the streets: blocks, lots by zone, parks and courtyards.

use std::collections::BTreeMap;
use std::fmt;

use super::page::Page;
use super::path::Pen;
use super::style::{BLOCK, green_color, zone_color};
use crate::lot::{GreenKind, Land, Lot};
use crate::zoning::Zone;

/// Lots are tinted from this scale on, mm a metre; below it a block has one tint.
const LOTS_FROM: f64 = 0.05;

pub(super) fn draw(f: &mut fmt::Formatter<'_>, page: &Page, land: &Land) -> fmt::Result {
    let mut blocks = Pen::at(page.middle);
    for block in land.blocks.iter().filter(|block| block.area.is_some()) {
        blocks.polygon(&block.outline);
    }
    if !blocks.is_empty() {
        writeln!(f, r#"<path id="blocks" fill="{BLOCK}" d="{}"/>"#, blocks.into_data())?;
    }
    let mut zones: BTreeMap<Zone, Pen> = BTreeMap::new();
    // Within a block homes stand on its tint; beyond the last street nothing else is below them.
    let shows = |lot: &&Lot| lot.zone != Zone::Residential || land.blocks[lot.block as usize].area.is_none();
    for lot in land.lots.iter().filter(shows).filter(|_| page.scale >= LOTS_FROM) {
        zones.entry(lot.zone).or_insert_with(|| Pen::at(page.middle)).polygon(land.outline(lot));
    }
    writeln!(f, r#"<g id="zones">"#)?;
    for (zone, pen) in zones {
        writeln!(
            f,
            r#"<path id="zone-{}" fill="{}" d="{}"/>"#,
            zone.as_str(),
            zone_color(zone),
            pen.into_data()
        )?;
    }
    writeln!(f, "</g>")?;
    let mut greens: BTreeMap<GreenKind, Pen> = BTreeMap::new();
    for green in land.greens.iter().filter(|green| green.kind != GreenKind::Leftover) {
        greens.entry(green.kind).or_insert_with(|| Pen::at(page.middle)).polygon(land.green_outline(green));
    }
    writeln!(f, r#"<g id="greens">"#)?;
    for (kind, pen) in greens {
        let (id, color) = green_color(kind);
        writeln!(f, r#"<path id="{id}" fill="{color}" d="{}"/>"#, pen.into_data())?;
    }
    writeln!(f, "</g>")
}
