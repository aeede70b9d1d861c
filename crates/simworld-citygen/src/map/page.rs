//! The sheet: its size in millimetres, where the map lies on it, and how metres become millimetres.

use std::fmt::{self, Write};

use simworld_core::geometry::Point2;

use super::style::{FONT, INK, LAND, PAPER};
use crate::City;
pub(super) use crate::files::xml::escaped;

/// Width of the sheet.
const WIDTH: f64 = 420.0;
/// Paper around the map.
const MARGIN: f64 = 17.0;
/// The foot of the sheet, below the map: title, legend, figures.
const FOOT: f64 = 66.0;
/// Land around the outermost street, share of the city's size.
const SURROUND: f64 = 0.025;
/// Least and greatest height of the map over its width.
const ASPECT: (f64, f64) = (0.62, 1.6);

/// A rectangle on paper, y downwards, mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Frame {
    pub(super) fn right(&self) -> f64 {
        self.x + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.y + self.height
    }

    pub(super) fn contains(&self, (x, y): (f64, f64), margin: f64) -> bool {
        (self.x + margin..=self.right() - margin).contains(&x)
            && (self.y + margin..=self.bottom() - margin).contains(&y)
    }
}

/// The sheet of one city.
#[derive(Clone, Debug)]
pub(super) struct Page {
    /// Height of the sheet, mm.
    height: f64,
    /// The map on it.
    pub(super) map: Frame,
    /// Millimetres a metre.
    pub(super) scale: f64,
    /// The middle of the map, m.
    pub(super) middle: Point2,
}

impl Page {
    pub(super) fn of(city: &City) -> Self {
        let (low, high) = city.network.bounds().unwrap_or((Point2::origin(), Point2::origin()));
        let span = high - low;
        // However small a city is, it is shown with some room.
        let surround = (span.max() * SURROUND).max(25.0);
        let (across, up) = (span.x + 2.0 * surround, span.y + 2.0 * surround);
        let width = WIDTH - 2.0 * MARGIN;
        let height = width * (up / across).clamp(ASPECT.0, ASPECT.1);
        Self {
            height: MARGIN + height + FOOT,
            map: Frame { x: MARGIN, y: MARGIN, width, height },
            scale: (width / across).min(height / up),
            middle: nalgebra::center(&low, &high),
        }
    }

    /// The foot of the sheet.
    pub(super) fn foot(&self) -> Frame {
        let y = self.map.bottom() + 9.0;
        Frame { x: MARGIN, y, width: self.map.width, height: self.height - y - 10.0 }
    }

    /// A place of the city on paper, mm.
    pub(super) fn place(&self, point: &Point2) -> (f64, f64) {
        let away = (point - self.middle) * self.scale;
        (self.map.x + self.map.width * 0.5 + away.x, self.map.y + self.map.height * 0.5 - away.y)
    }

    /// Path data of a line of the city, on paper.
    pub(super) fn line(&self, points: &[Point2]) -> String {
        path_data(points.iter().map(|point| self.place(point)))
    }

    /// So many millimetres on paper, in the decimetres in which the city is drawn.
    pub(super) fn ink(&self, millimetres: f64) -> f64 {
        millimetres / self.scale * 10.0
    }

    pub(super) fn begin(&self, f: &mut fmt::Formatter<'_>, title: &str) -> fmt::Result {
        let Frame { x, y, width, height } = self.map;
        writeln!(
            f,
            r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="{WIDTH}mm" height="{0:.1}mm" viewBox="0 0 {WIDTH} {0:.1}" font-family="{FONT}" fill="{INK}">"#,
            self.height
        )?;
        writeln!(f, "<title>{}</title>", escaped(title))?;
        let map = format!(r#"x="{x}" y="{y}" width="{width}" height="{height:.2}""#);
        writeln!(f, r#"<defs><clipPath id="map-frame"><rect {map}/></clipPath></defs>"#)?;
        writeln!(f, r#"<rect id="paper" width="{WIDTH}" height="{:.1}" fill="{PAPER}"/>"#, self.height)?;
        writeln!(f, r#"<g id="map" clip-path="url(#map-frame)"><rect id="land" {map} fill="{LAND}"/>"#)
    }

    /// Begins the group in which one unit is a decimetre, x east, y north.
    pub(super) fn begin_city(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (x, y) = self.place(&self.middle);
        let scale = self.scale * 0.1;
        writeln!(f, r#"<g id="city" transform="matrix({scale:.8} 0 0 -{scale:.8} {x:.3} {y:.3})">"#)
    }
}

/// Path data of a line on paper, mm.
pub(super) fn path_data(points: impl Iterator<Item = (f64, f64)>) -> String {
    let mut data = String::new();
    for (index, (x, y)) in points.enumerate() {
        let letter = if index == 0 { 'M' } else { 'L' };
        // Writing to a string never fails.
        let _ = write!(data, "{letter}{x:.2} {y:.2}");
    }
    data
}
