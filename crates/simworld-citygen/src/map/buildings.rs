//! Buildings with their shadows, tinted by use, and the crowns of trees.

use std::collections::BTreeMap;
use std::fmt;

use simworld_core::scene::{EntityKind, Place};

use super::page::Page;
use super::path::Pen;
use super::style::{EDGE, SHADOW, TREE, place_color};
use crate::City;

/// Width of a crown of a tree, m.
const CROWN: f64 = 4.2;
/// Trees are drawn from this scale on, mm a metre.
const TREES_FROM: f64 = 0.1;

pub(super) fn draw(f: &mut fmt::Formatter<'_>, page: &Page, city: &City) -> fmt::Result {
    let mut pens: BTreeMap<Place, Pen> = BTreeMap::new();
    for building in &city.buildings {
        let pen = pens.entry(building.place).or_insert_with(|| Pen::at(page.middle));
        pen.polygon(&building.outline());
        for mut court in building.courtyards() {
            // The other way round, so that it is a hole.
            court.reverse();
            pen.polygon(&court);
        }
    }
    // Each shape is written once and drawn twice: as shadow and as house.
    writeln!(f, "<defs>")?;
    let places: Vec<Place> = pens.keys().copied().collect();
    for (place, pen) in pens {
        writeln!(f, r#"<path id="shape-{place}" d="{}"/>"#, pen.into_data())?;
    }
    writeln!(f, "</defs>")?;
    let (dx, dy) = (page.ink(0.28), page.ink(-0.28));
    let (dx, dy) = (dx.min(25.0), dy.max(-25.0));
    writeln!(
        f,
        r#"<g id="shadows" transform="translate({dx:.1} {dy:.1})" fill="{SHADOW}" fill-opacity="0.16">"#
    )?;
    for place in &places {
        writeln!(f, r##"<use xlink:href="#shape-{place}"/>"##)?;
    }
    writeln!(f, "</g>")?;
    trees(f, page, city)?;
    let edge = page.ink(0.07).min(4.0);
    writeln!(f, r#"<g id="buildings" stroke="{EDGE}" stroke-width="{edge:.2}" stroke-linejoin="round">"#)?;
    for place in &places {
        writeln!(f, r##"<use id="{place}" xlink:href="#shape-{place}" fill="{}"/>"##, place_color(*place))?;
    }
    writeln!(f, "</g>")
}

fn trees(f: &mut fmt::Formatter<'_>, page: &Page, city: &City) -> fmt::Result {
    if page.scale < TREES_FROM {
        return Ok(());
    }
    let mut pen = Pen::at(page.middle);
    for tree in city.elements.iter().filter(|element| element.kind == EntityKind::Tree) {
        pen.dot(&tree.position);
    }
    let (width, data) = (CROWN * 10.0, pen.into_data());
    writeln!(
        f,
        r#"<path id="trees" d="{data}" fill="none" stroke="{TREE}" stroke-opacity="0.75" stroke-width="{width}" stroke-linecap="round"/>"#
    )
}
