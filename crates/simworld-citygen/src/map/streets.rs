//! Sidewalks, road casings and fills by class, crossings.

use std::collections::BTreeMap;
use std::fmt;

use simworld_core::geometry::Point2;
use simworld_core::net::{Road, Sidewalk, polyline};

use super::page::Page;
use super::path::Pen;
use super::style::{CASING, ROADS, RoadStyle, SIDEWALK};
use super::{bridges, footways, strips, tunnels};
use crate::City;

/// Sidewalks narrower than this on paper are left out, mm.
const FINEST_SIDEWALK: f64 = 0.22;
/// Crossings are drawn from this scale on, mm a metre.
const CROSSINGS_FROM: f64 = 0.28;

pub(super) fn draw(f: &mut fmt::Formatter<'_>, page: &Page, city: &City) -> fmt::Result {
    tunnels::draw(f, page, city)?;
    plazas(f, page, city)?;
    sidewalks(f, page, city)?;
    writeln!(f, r#"<g id="streets" fill="none" stroke-linejoin="round" stroke-linecap="round">"#)?;
    let layers: Vec<Layer> = ROADS.iter().map(|style| Layer::of(style, page, city)).collect();
    for layer in &layers {
        layer.casing(f, page)?;
    }
    for layer in &layers {
        layer.fill(f)?;
    }
    writeln!(f, "</g>")?;
    strips::draw(f, page, city, |road| road.level == 0)?;
    crossings(f, page, city)?;
    footways::subways(f, page, city)?;
    bridges::draw(f, page, city)
}

/// The roads of one class, by their width on paper in tenths of a millimetre.
struct Layer {
    style: &'static RoadStyle,
    lines: BTreeMap<u32, String>,
    junctions: String,
    unit: f64,
}

impl Layer {
    fn of(style: &'static RoadStyle, page: &Page, city: &City) -> Self {
        let mut pens: BTreeMap<u32, Pen> = BTreeMap::new();
        for road in city.network.roads.iter().filter(|road| road.class == style.class && road.level == 0) {
            let width = ((road.width * page.scale).max(style.least) * 10.0).round() as u32;
            let pen = pens.entry(width).or_insert_with(|| Pen::at(page.middle));
            pen.line(&middle_of_carriageway(road, page));
        }
        let lines = pens.into_iter().map(|(width, pen)| (width, pen.into_data())).collect();
        Self { style, lines, junctions: junctions(style, page, city), unit: page.ink(0.1) }
    }

    fn casing(&self, f: &mut fmt::Formatter<'_>, page: &Page) -> fmt::Result {
        let RoadStyle { id, casing, .. } = self.style;
        if self.lines.is_empty() {
            return Ok(());
        }
        writeln!(f, r#"<g id="{id}-casing" stroke="{casing}">"#)?;
        for (width, line) in &self.lines {
            let width = f64::from(*width) * self.unit + page.ink(2.0 * CASING);
            writeln!(f, r#"<path stroke-width="{width:.1}" d="{line}"/>"#)?;
        }
        if !self.junctions.is_empty() {
            let width = page.ink(2.0 * CASING);
            let data = &self.junctions;
            writeln!(f, r#"<path stroke-width="{width:.1}" fill="{casing}" d="{data}"/>"#)?;
        }
        writeln!(f, "</g>")
    }

    fn fill(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let RoadStyle { id, fill, .. } = self.style;
        if self.lines.is_empty() {
            return Ok(());
        }
        writeln!(f, r#"<g id="{id}" stroke="{fill}">"#)?;
        for (width, line) in &self.lines {
            writeln!(f, r#"<path stroke-width="{:.1}" d="{line}"/>"#, f64::from(*width) * self.unit)?;
        }
        if !self.junctions.is_empty() {
            writeln!(f, r#"<path stroke="none" fill="{fill}" d="{}"/>"#, self.junctions)?;
        }
        writeln!(f, "</g>")
    }
}

/// A road whose kerbs lie unevenly about its centreline is drawn between its kerbs.
pub(super) fn middle_of_carriageway(road: &Road, page: &Page) -> Vec<Point2> {
    let shift = (road.left_kerb - road.right_kerb) * 0.5;
    if shift.abs() * page.scale < 0.05 {
        road.centerline.clone()
    } else {
        polyline::offset(&road.centerline, shift)
    }
}

/// The paved areas of the intersections whose lowest road is of this class, where they are larger than ink.
fn junctions(style: &RoadStyle, page: &Page, city: &City) -> String {
    let mut pen = Pen::at(page.middle);
    for intersection in &city.network.intersections {
        let lowest = intersection.roads.iter().map(|road| city.network.roads[road.index()].class).min();
        if lowest == Some(style.class) && page.scale > 0.08 {
            pen.polygon(&intersection.outline);
        }
    }
    pen.into_data()
}

/// Open ground for walkers.
fn plazas(f: &mut fmt::Formatter<'_>, page: &Page, city: &City) -> fmt::Result {
    if city.network.plazas.is_empty() {
        return Ok(());
    }
    writeln!(f, r#"<g id="plazas" fill="{SIDEWALK}" fill-rule="evenodd" stroke="none">"#)?;
    for plaza in &city.network.plazas {
        let mut pen = Pen::at(page.middle);
        plaza.rings().for_each(|ring| pen.polygon(ring));
        writeln!(f, r#"<path d="{}"/>"#, pen.into_data())?;
    }
    writeln!(f, "</g>")
}

fn sidewalks(f: &mut fmt::Formatter<'_>, page: &Page, city: &City) -> fmt::Result {
    let mut pens: BTreeMap<u32, Pen> = BTreeMap::new();
    let mut draw = |path: &[Point2], width: f64| {
        if width * page.scale >= FINEST_SIDEWALK {
            let pen = pens.entry((width * 10.0).round() as u32).or_insert_with(|| Pen::at(page.middle));
            pen.line(path);
        }
    };
    let is_on_ground = |walk: &&Sidewalk| city.network.roads[walk.road.index()].level == 0;
    for sidewalk in city.network.sidewalks.iter().filter(is_on_ground) {
        draw(&sidewalk.path, sidewalk.width);
    }
    for way in city.network.footpaths.iter().filter(|way| way.level == 0 && way.plaza.is_none()) {
        draw(&way.path, way.width);
    }
    let usual = city.network.sidewalks.first().map_or(0.0, |sidewalk| sidewalk.width);
    for corner in city.network.intersections.iter().flat_map(|intersection| &intersection.corners) {
        draw(corner, usual);
    }
    if pens.is_empty() {
        return Ok(());
    }
    writeln!(f, r#"<g id="sidewalks" fill="none" stroke="{SIDEWALK}" stroke-linejoin="round">"#)?;
    for (width, pen) in pens {
        writeln!(f, r#"<path stroke-width="{width}" d="{}"/>"#, pen.into_data())?;
    }
    writeln!(f, "</g>")
}

/// Stripes on the carriageway; one unit is a decimetre.
fn crossings(f: &mut fmt::Formatter<'_>, page: &Page, city: &City) -> fmt::Result {
    if page.scale < CROSSINGS_FROM {
        return Ok(());
    }
    let mut pens: BTreeMap<u32, Pen> = BTreeMap::new();
    for crossing in &city.network.crossings {
        let pen = pens.entry((crossing.width * 10.0).round() as u32).or_insert_with(|| Pen::at(page.middle));
        pen.line(&[crossing.start, crossing.end]);
    }
    writeln!(f, r##"<g id="crossings" fill="none" stroke="#b9b3a4" stroke-dasharray="5 5">"##)?;
    for (width, pen) in pens.into_iter().filter(|(_, pen)| !pen.is_empty()) {
        writeln!(f, r#"<path stroke-width="{width}" d="{}"/>"#, pen.into_data())?;
    }
    writeln!(f, "</g>")
}
