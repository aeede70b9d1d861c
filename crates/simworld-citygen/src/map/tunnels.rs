//! Streets below the ground, under all else that is drawn of streets: pale, between broken edges, the deepest first.

use std::collections::BTreeSet;
use std::fmt;

use simworld_core::net::Road;

use super::page::Page;
use super::path::Pen;
use super::streets::middle_of_carriageway;
use super::style::{CASING, RoadStyle, road_style};
use crate::City;

/// The edge of a tunnel is drawn this much wider than the casing of a street.
const EDGE: f64 = 2.2;
/// Lengths of the dashes of an edge and of the gaps between them, mm.
const DASHES: (f64, f64) = (1.1, 0.8);
/// What of the ground shines through.
const OPACITY: f64 = 0.55;

pub(super) fn draw(f: &mut fmt::Formatter<'_>, page: &Page, city: &City) -> fmt::Result {
    let levels: BTreeSet<i8> =
        city.network.roads.iter().map(|road| road.level).filter(|level| *level < 0).collect();
    for level in levels {
        let id = level.unsigned_abs();
        writeln!(f, r#"<g id="tunnels-{id}" fill="none" stroke-linejoin="round" opacity="{OPACITY}">"#)?;
        let roads = || city.network.roads.iter().filter(|road| road.level == level);
        let (dash, gap) = (page.ink(DASHES.0), page.ink(DASHES.1));
        // All edges first, so that tunnels that meet are one.
        for road in roads() {
            let RoadStyle { casing, .. } = road_style(road.class);
            let width = width(page, road) + page.ink(2.0 * EDGE * CASING);
            let dashes = format_args!("{dash:.1} {gap:.1}");
            writeln!(
                f,
                r#"<path stroke="{casing}" stroke-width="{width:.1}" stroke-dasharray="{dashes}" d="{}"/>"#,
                course(page, road)
            )?;
        }
        for road in roads() {
            let RoadStyle { fill, .. } = road_style(road.class);
            let (width, course) = (width(page, road), course(page, road));
            writeln!(f, r#"<path stroke="{fill}" stroke-width="{width:.1}" d="{course}"/>"#)?;
        }
        writeln!(f, "</g>")?;
    }
    Ok(())
}

fn width(page: &Page, road: &Road) -> f64 {
    page.ink((road.width * page.scale).max(road_style(road.class).least))
}

fn course(page: &Page, road: &Road) -> String {
    let mut pen = Pen::at(page.middle);
    pen.line(&middle_of_carriageway(road, page));
    pen.into_data()
}
