//! A contact sheet of a catalogue as an SVG picture: every asset from the front, beside a person of 1.75 m, with what is known of it.

use simworld_core::asset::{Asset, Catalogue, Season};
use simworld_core::scene::{EntityKind, Shape};
use svg::node::element::{Ellipse, Group, Rectangle, Text, Title};

use super::plan::to_srgb;

/// Cells in a row.
const COLUMNS: usize = 9;
/// A cell, and the picture within it.
const CELL: (f64, f64) = (150.0, 132.0);
const PICTURE: (f64, f64) = (132.0, 72.0);
const MARGIN: f64 = 24.0;
const HEADING: f64 = 40.0;
const PERSON: f64 = 1.75;
const INK: &str = "#33352f";
const FAINT: &str = "#85877e";
const FACE: &str = "Roboto, 'Helvetica Neue', Helvetica, Arial, sans-serif";

/// The picture of a catalogue, by class.
pub fn contact_sheet(catalogue: &Catalogue) -> svg::Document {
    let classes = ["Furniture and props", "Plants", "Vehicles", "People, animals, robots", "Buildings"];
    let mut sheet = Group::new();
    let mut top = MARGIN;
    for (class, heading) in classes.iter().enumerate() {
        let assets: Vec<&Asset> =
            catalogue.iter().map(|(_, asset)| asset).filter(|asset| class_of(asset.kind) == class).collect();
        if assets.is_empty() {
            continue;
        }
        let heading = format!("{heading}: {}", assets.len());
        sheet = sheet.add(words(&heading, (MARGIN, top + 22.0), 18.0, INK));
        top += HEADING;
        for (index, asset) in assets.iter().enumerate() {
            let corner =
                (MARGIN + CELL.0 * (index % COLUMNS) as f64, top + CELL.1 * (index / COLUMNS) as f64);
            sheet = sheet.add(cell(asset, corner));
        }
        top += CELL.1 * assets.len().div_ceil(COLUMNS) as f64;
    }
    let (width, height) = (MARGIN * 2.0 + CELL.0 * COLUMNS as f64, top + MARGIN);
    svg::Document::new()
        .set("width", width)
        .set("height", height)
        .set("viewBox", (0.0, 0.0, width, height))
        .add(Title::new("The catalogue"))
        .add(Rectangle::new().set("width", width).set("height", height).set("fill", "#ffffff"))
        .add(sheet)
}

const fn class_of(kind: EntityKind) -> usize {
    match kind {
        EntityKind::Tree | EntityKind::Shrub => 1,
        EntityKind::Building => 4,
        kind if kind.is_vehicle() => 2,
        kind if kind.is_mobile() => 3,
        _ => 0,
    }
}

fn cell(asset: &Asset, (left, top): (f64, f64)) -> Group {
    let size = asset.collider.size();
    // Vehicles and animals are known from their sides; everything else from its front.
    let from_side = asset.kind.is_vehicle() || asset.kind == EntityKind::Dog;
    let crown = asset.kind == EntityKind::Tree;
    let across = if crown {
        size.z * 0.5
    } else if from_side {
        size.x
    } else {
        size.y
    };
    let person = PERSON * 0.3;
    let room = 0.15 * size.z.max(across);
    let scale = (PICTURE.0 / (across + room + person)).min(PICTURE.1 / size.z.max(PERSON * 0.4));
    let ground = top + PICTURE.1;
    let fill = asset.color.map_or_else(|| "#cccccc".to_owned(), to_srgb);
    let mut group = Group::new().add(Title::new(told(asset)));
    let solid = |x: f64, width: f64, height: f64, fill: &str| {
        let box_of = Rectangle::new().set("x", x).set("y", ground - height).set("width", width);
        box_of.set("height", height).set("fill", fill).set("stroke", INK).set("stroke-width", 0.5)
    };
    let (wide, high) = (across * scale, size.z * scale);
    if crown {
        let trunk = (size.y * scale).max(1.0);
        group = group.add(solid(left + (wide - trunk) * 0.5, trunk, high * 0.5, "#6b4a2f"));
        let oval = Ellipse::new().set("cx", left + wide * 0.5).set("cy", ground - high * 0.62);
        let oval = oval.set("rx", wide * 0.5).set("ry", high * 0.38).set("fill", fill.as_str());
        group = group.add(oval.set("stroke", INK).set("stroke-width", 0.5));
    } else {
        let rounded =
            matches!(asset.collider, Shape::Cylinder { .. } | Shape::Capsule { .. } | Shape::Sphere { .. });
        let corner = if rounded { (wide * 0.3).min(high * 0.3) } else { 0.0 };
        group = group.add(solid(left, wide.max(1.0), high.max(1.0), &fill).set("rx", corner));
    }
    let tall = (PERSON * scale).min(PICTURE.1);
    if (PERSON * scale - tall).abs() < 1e-9 {
        let at = left + wide + room * scale;
        group = group.add(
            Rectangle::new()
                .set("x", at)
                .set("y", ground - tall)
                .set("width", (tall * 0.25).max(0.6))
                .set("height", tall)
                .set("rx", tall * 0.12)
                .set("fill", "#9fb7c9"),
        );
    }
    for (index, season) in Season::ALL.into_iter().enumerate().filter(|_| asset.seasons.is_some()) {
        let color = asset.color_in(season).map_or_else(String::new, to_srgb);
        let at = left + PICTURE.0 - 34.0 + 9.0 * index as f64;
        group = group.add(
            Rectangle::new()
                .set("x", at)
                .set("y", ground + 5.0)
                .set("width", 7.0)
                .set("height", 7.0)
                .set("fill", color),
        );
    }
    group
        .add(words(&asset.name.replace('_', " "), (left, ground + 13.0), 10.5, INK))
        .add(words(&measures(asset), (left, ground + 25.0), 8.5, FAINT))
        .add(words(&uses(asset), (left, ground + 36.0), 8.5, FAINT))
}

fn measures(asset: &Asset) -> String {
    let size = asset.collider.size();
    let meters = |side: f64| if side < 10.0 { format!("{side:.2}") } else { format!("{side:.0}") };
    let mass = asset.mass.map_or_else(|| "fixed".to_owned(), |mass| format!("{mass} kg"));
    format!("{} x {} x {} m, {mass}", meters(size.x), meters(size.y), meters(size.z))
}

fn uses(asset: &Asset) -> String {
    let can: Vec<String> = asset.affordances().iter().map(|can| can.to_string().replace('_', " ")).collect();
    let made_of = asset.material.map_or("", simworld_core::asset::Material::as_str);
    if can.is_empty() { made_of.to_owned() } else { format!("{made_of}; {}", can.join(", ")) }
}

fn told(asset: &Asset) -> String {
    format!("{}: {} ({}; {})", asset.name, asset.tags.join(", "), asset.source, asset.licence)
}

fn words(text: &str, (x, y): (f64, f64), size: f64, fill: &str) -> Text {
    Text::new(text).set("x", x).set("y", y).set("font-size", size).set("font-family", FACE).set("fill", fill)
}
