//! What surrounds the map on its sheet: frame, title, scale, legend, figures, north.

use std::fmt;

use simworld_core::net::{RoadNetwork, polyline};
use simworld_core::scene::{EntityKind, Place};

use super::MapDrawing;
use super::page::{Frame, Page, escaped};
use super::style::{CASING, FAINT, INK, PAPER, ROADS, green_color, place_color};
use crate::City;
use crate::lot::{GreenKind, Land};

pub(super) fn draw(
    f: &mut fmt::Formatter<'_>,
    page: &Page,
    drawing: &MapDrawing<'_>,
    land: &Land,
) -> fmt::Result {
    // The map's own group ends here.
    writeln!(f, "</g>")?;
    frame(f, page)?;
    north(f, page)?;
    let foot = page.foot();
    title(f, &foot, drawing)?;
    scale_bar(f, page, &foot)?;
    legend(f, page, &foot, drawing.city, land)?;
    figures(f, &foot, &drawing.statistics)?;
    credit(f, page, drawing)
}

/// What the sheet is called.
pub(super) fn title_of(drawing: &MapDrawing<'_>) -> String {
    let own = drawing.title.as_ref().or(drawing.city.provenance.title.as_ref());
    own.cloned().unwrap_or_else(|| format!("City {}", drawing.city.provenance.seed.0))
}

fn frame(f: &mut fmt::Formatter<'_>, page: &Page) -> fmt::Result {
    let Frame { x, y, width, height } = page.map;
    writeln!(
        f,
        r#"<g id="frame" fill="none" stroke="{INK}"><rect x="{x}" y="{y}" width="{width}" height="{height:.2}" stroke-width="0.35"/><rect x="{}" y="{}" width="{}" height="{:.2}" stroke-width="0.9"/></g>"#,
        x - 2.0,
        y - 2.0,
        width + 4.0,
        height + 4.0
    )
}

fn north(f: &mut fmt::Formatter<'_>, page: &Page) -> fmt::Result {
    let (x, y) = (page.map.right() - 12.0, page.map.y + 15.5);
    writeln!(
        f,
        r#"<g id="north" transform="translate({x} {y:.2})"><circle r="8.6" fill="{PAPER}" fill-opacity="0.88" stroke="{INK}" stroke-width="0.3"/><path d="M0-4.2L2.3 5.2L0 3.6Z" fill="{INK}"/><path d="M0-4.2L-2.3 5.2L0 3.6Z" fill="none" stroke="{INK}" stroke-width="0.3" stroke-linejoin="round"/><text y="-5" font-size="2.8" font-weight="500" text-anchor="middle">N</text></g>"#
    )
}

fn title(f: &mut fmt::Formatter<'_>, foot: &Frame, drawing: &MapDrawing<'_>) -> fmt::Result {
    let title = title_of(drawing);
    let room = foot.width * 0.44;
    let shown = title.to_uppercase();
    // Capitals are wider than the mean letter and stand apart.
    let size = (room / (shown.chars().count() as f64 * 0.86)).clamp(4.5, 13.0);
    let spacing = size * 0.14;
    let subtitle = drawing.subtitle.clone().unwrap_or_else(|| subtitle_of(drawing.city));
    writeln!(
        f,
        r#"<g id="title"><text x="{}" y="{:.2}" font-size="{size:.2}" font-weight="300" letter-spacing="{spacing:.2}">{}</text><text x="{}" y="{:.2}" font-size="4.1" fill="{FAINT}" letter-spacing="0.25">{}</text></g>"#,
        foot.x,
        foot.y + 14.5,
        escaped(&shown),
        foot.x,
        foot.y + 23.0,
        escaped(&subtitle)
    )
}

/// Where on Earth, or style and seed, and extent.
fn subtitle_of(city: &City) -> String {
    let extent = city.network.bounds().map_or_else(String::new, |(low, high)| {
        let span = (high - low) / 1000.0;
        format!("{:.1} × {:.1} km", span.x, span.y)
    });
    let provenance = &city.provenance;
    if let Some(origin) = provenance.origin {
        let ns = if origin.latitude < 0.0 { 'S' } else { 'N' };
        let ew = if origin.longitude < 0.0 { 'W' } else { 'E' };
        let (latitude, longitude) = (origin.latitude.abs(), origin.longitude.abs());
        return format!("{latitude:.4}° {ns} · {longitude:.4}° {ew} · {extent}");
    }
    let style = provenance.style.map_or_else(String::new, |style| format!("{style} · "));
    format!("{style}{extent} · seed {}", provenance.seed.0)
}

/// Four steps of a round length, and the scale in words.
fn scale_bar(f: &mut fmt::Formatter<'_>, page: &Page, foot: &Frame) -> fmt::Result {
    const STEPS: [f64; 9] = [10.0, 20.0, 25.0, 50.0, 100.0, 250.0, 500.0, 1000.0, 2500.0];
    let step = STEPS.into_iter().filter(|step| step * 4.0 * page.scale <= 92.0).fold(10.0, f64::max);
    let width = step * page.scale;
    let (x, y) = (foot.x, foot.y + 35.0);
    writeln!(f, r#"<g id="scale" font-size="2.6" fill="{FAINT}" text-anchor="middle">"#)?;
    for index in 0..4 {
        let fill = if index % 2 == 0 { INK } else { PAPER };
        let left = x + f64::from(index) * width;
        writeln!(
            f,
            r#"<rect x="{left:.2}" y="{y:.2}" width="{width:.2}" height="1.5" fill="{fill}" stroke="{INK}" stroke-width="0.25"/>"#
        )?;
    }
    for index in [0, 2, 4] {
        let metres = step * f64::from(index);
        let text = match metres {
            0.0 => "0".to_owned(),
            m if m >= 1000.0 => format!("{} km", m / 1000.0),
            m => format!("{m} m"),
        };
        let at = x + f64::from(index) * width;
        writeln!(f, r#"<text x="{at:.2}" y="{:.2}">{text}</text>"#, y - 1.4)?;
    }
    let ratio = (1000.0 / page.scale / 50.0).round() * 50.0;
    writeln!(
        f,
        r#"<text x="{x:.2}" y="{:.2}" text-anchor="start">1 : {}</text></g>"#,
        y + 5.2,
        grouped(ratio as u64)
    )
}

/// Swatches of the uses and classes that there are.
fn legend(f: &mut fmt::Formatter<'_>, page: &Page, foot: &Frame, city: &City, land: &Land) -> fmt::Result {
    let mut present: Vec<Place> = city.buildings.iter().map(|building| building.place).collect();
    present.sort_unstable();
    present.dedup();
    let (left, top, row) = (foot.x + foot.width * 0.48, foot.y + 4.0, 5.6);
    let rows = 6;
    writeln!(f, r#"<g id="legend" font-size="2.9">"#)?;
    let mut slot = 0;
    let mut next = || {
        let at = (left + f64::from(slot / rows) * 33.0, top + f64::from(slot % rows) * row);
        slot += 1;
        at
    };
    let classes =
        ROADS.iter().filter(|style| city.network.roads.iter().any(|road| road.class == style.class));
    for style in classes {
        let (x, y) = next();
        let width = (style.least * 1.4).max(0.9);
        writeln!(
            f,
            r#"<path d="M{x:.2} {y:.2}h6" stroke="{}" stroke-width="{:.2}"/><path d="M{x:.2} {y:.2}h6" stroke="{}" stroke-width="{width:.2}"/><text x="{:.2}" y="{:.2}">{}</text>"#,
            style.casing,
            width + 2.0 * CASING * 1.6,
            style.fill,
            x + 8.0,
            y + 1.0,
            style.label
        )?;
    }
    for place in present {
        let (x, y) = next();
        writeln!(
            f,
            r##"<rect x="{x:.2}" y="{:.2}" width="6" height="3.2" fill="{}" stroke="#8d8271" stroke-width="0.15"/><text x="{:.2}" y="{:.2}">{}</text>"##,
            y - 1.6,
            place_color(place),
            x + 8.0,
            y + 1.0,
            label_of(place)
        )?;
    }
    if land.greens.iter().any(|green| green.kind == GreenKind::Park) {
        let ((x, y), (_, color)) = (next(), green_color(GreenKind::Park));
        writeln!(
            f,
            r#"<rect x="{x:.2}" y="{:.2}" width="6" height="3.2" fill="{color}"/><text x="{:.2}" y="{:.2}">Park</text>"#,
            y - 1.6,
            x + 8.0,
            y + 1.0
        )?;
    }
    // A page that shows crowns says so.
    if page.scale >= 0.1 && city.elements.iter().any(|element| element.kind == EntityKind::Tree) {
        let (x, y) = next();
        writeln!(
            f,
            r#"<circle cx="{:.2}" cy="{y:.2}" r="1.5" fill="{}" fill-opacity="0.75"/><text x="{:.2}" y="{:.2}">Tree</text>"#,
            x + 3.0,
            super::style::TREE,
            x + 8.0,
            y + 1.0
        )?;
    }
    writeln!(f, "</g>")
}

fn label_of(place: Place) -> String {
    let words = place.as_str().replace('_', " ");
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn figures(f: &mut fmt::Formatter<'_>, foot: &Frame, statistics: &[(String, String)]) -> fmt::Result {
    if statistics.is_empty() {
        return Ok(());
    }
    let (right, top, row) = (foot.right(), foot.y + 5.0, 5.6);
    writeln!(f, r#"<g id="figures" font-size="2.9">"#)?;
    for (index, (label, value)) in statistics.iter().take(6).enumerate() {
        let y = top + index as f64 * row;
        writeln!(
            f,
            r#"<text x="{:.2}" y="{y:.2}" fill="{FAINT}">{}</text><text x="{right:.2}" y="{y:.2}" font-weight="500" text-anchor="end">{}</text>"#,
            right - 48.0,
            escaped(label),
            escaped(value)
        )?;
        if index > 0 {
            writeln!(
                f,
                r#"<path d="M{:.2} {:.2}H{right:.2}" stroke="{FAINT}" stroke-width="0.12"/>"#,
                right - 48.0,
                y - 3.7
            )?;
        }
    }
    writeln!(f, "</g>")
}

/// The line that a licence asks for, at the very foot.
fn credit(f: &mut fmt::Formatter<'_>, page: &Page, drawing: &MapDrawing<'_>) -> fmt::Result {
    let made = "Drawn by simworld";
    let text = match &drawing.city.provenance.credit {
        Some(credit) => format!("{credit} · {made}"),
        None => made.to_owned(),
    };
    let foot = page.foot();
    writeln!(
        f,
        r#"<text id="credit" x="{:.2}" y="{:.2}" font-size="2.2" fill="{FAINT}" text-anchor="end">{}</text>"#,
        foot.right(),
        foot.bottom() + 4.0,
        escaped(&text)
    )
}

/// The figures of a city, as its map shows them.
pub(super) fn statistics(city: &City) -> Vec<(String, String)> {
    let network: &RoadNetwork = &city.network;
    let length: f64 = network.roads.iter().map(|road| polyline::length(&road.centerline)).sum();
    let junctions = network.intersections.iter().filter(|place| place.roads.len() > 2).count();
    let signals = network.signals.len();
    let trees = city.elements.iter().filter(|element| element.kind == EntityKind::Tree).count();
    let tallest = city.buildings.iter().map(|building| building.storeys).max().unwrap_or(0);
    [
        ("Streets", format!("{:.1} km", length / 1000.0)),
        ("Junctions", grouped(junctions as u64)),
        ("Traffic signals", grouped(signals as u64)),
        ("Buildings", grouped(city.buildings.len() as u64)),
        ("Tallest", format!("{tallest} storeys")),
        ("Trees", grouped(trees as u64)),
    ]
    .map(|(label, value)| (label.to_owned(), value))
    .into()
}

/// A number with thin spaces between thousands.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() + 4);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}
