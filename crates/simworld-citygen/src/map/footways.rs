//! Ways for walkers off the open ground: subways below the streets and passages through buildings as broken lines over what
//! hides them, and the decks of footbridges.

use std::fmt;

use simworld_core::net::Footpath;

use super::page::Page;
use super::path::Pen;
use super::style::{BRIDGE_EDGE, PASSAGE, SIDEWALK};
use crate::City;

/// The narrowest on paper, mm; those that would be finer than a third of it are left out.
const LEAST: f64 = 0.3;
/// Lengths of dashes and of the gaps between them, mm.
const DASHES: (f64, f64) = (0.8, 0.55);
/// Share of its width in which a way that something hides is drawn.
const HIDDEN: f64 = 0.6;
/// The edge of a footbridge on each side, mm.
const EDGE: f64 = 0.14;

/// Ways below the ground.
pub(super) fn subways(f: &mut fmt::Formatter<'_>, page: &Page, city: &City) -> fmt::Result {
    broken(f, page, city, "subways", |way| way.level < 0)
}

/// Ways through buildings and below roofs.
pub(super) fn passages(f: &mut fmt::Formatter<'_>, page: &Page, city: &City) -> fmt::Result {
    broken(f, page, city, "passages", |way| way.level == 0 && way.covered)
}

fn broken(
    f: &mut fmt::Formatter<'_>,
    page: &Page,
    city: &City,
    id: &str,
    is_meant: impl Fn(&Footpath) -> bool,
) -> fmt::Result {
    let mut ways = drawn(page, city).filter(|way| is_meant(way)).peekable();
    if ways.peek().is_none() {
        return Ok(());
    }
    let (dash, gap) = (page.ink(DASHES.0), page.ink(DASHES.1));
    writeln!(
        f,
        r#"<g id="{id}" fill="none" stroke="{PASSAGE}" stroke-linejoin="round" stroke-dasharray="{dash:.1} {gap:.1}">"#
    )?;
    for way in ways {
        write(f, page, way, PASSAGE, width(page, way) * HIDDEN)?;
    }
    writeln!(f, "</g>")
}

/// The footbridges of a level, their edges or their decks.
pub(super) fn decks(
    f: &mut fmt::Formatter<'_>,
    page: &Page,
    city: &City,
    level: i8,
    edge: bool,
) -> fmt::Result {
    for way in drawn(page, city).filter(|way| way.level == level) {
        let (color, wider) = if edge { (BRIDGE_EDGE, page.ink(2.0 * EDGE)) } else { (SIDEWALK, 0.0) };
        write(f, page, way, color, width(page, way) + wider)?;
    }
    Ok(())
}

/// The ways that are not finer than ink.
fn drawn<'a>(page: &Page, city: &'a City) -> impl Iterator<Item = &'a Footpath> + use<'a> {
    let least = LEAST / 3.0 / page.scale;
    city.network.footpaths.iter().filter(move |way| way.width >= least)
}

/// Its width, in units of the drawing.
fn width(page: &Page, way: &Footpath) -> f64 {
    page.ink((way.width * page.scale).max(LEAST))
}

fn write(f: &mut fmt::Formatter<'_>, page: &Page, way: &Footpath, color: &str, width: f64) -> fmt::Result {
    let mut pen = Pen::at(page.middle);
    pen.line(&way.path);
    writeln!(f, r#"<path stroke="{color}" stroke-width="{width:.1}" d="{}"/>"#, pen.into_data())
}
