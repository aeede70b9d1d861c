//! What the offline generator makes, one of each kind, as an SVG picture: seen from the front, a little from the right and above.

use simworld_agents::generation::{AssetGenerator, AssetPrompt, GenerateError, ProceduralGenerator};
use simworld_core::asset::{Asset, Model, Paint};
use simworld_core::geometry::Vector3;
use svg::node::element::{Group, Polygon, Rectangle, Text, Title};

use super::plan::to_srgb;

/// Cells in a row.
const COLUMNS: usize = 10;
/// A cell, and the picture within it.
const CELL: (f64, f64) = (140.0, 140.0);
const PICTURE: f64 = 112.0;
const MARGIN: f64 = 20.0;
const INK: &str = "#33352f";
const FACE: &str = "Roboto, 'Helvetica Neue', Helvetica, Arial, sans-serif";
/// Where the light comes from, and how much there is in the shade.
const LIGHT: [f64; 3] = [0.6, 0.35, 0.75];
const SHADE: f64 = 0.55;

/// A triangle on the sheet.
struct Seen {
    corners: [(f64, f64); 3],
    /// How near the eye it is.
    near: f64,
    color: [f32; 3],
}

/// One of everything that the offline generator knows.
///
/// # Errors
/// One that it cannot make.
pub fn made_sheet() -> Result<svg::Document, GenerateError> {
    let mut sheet = Group::new();
    let mut count = 0;
    for thing in ProceduralGenerator::things() {
        let made = ProceduralGenerator::new().generate(&AssetPrompt::new(thing.name))?;
        let corner = (MARGIN + CELL.0 * (count % COLUMNS) as f64, MARGIN + CELL.1 * (count / COLUMNS) as f64);
        sheet = sheet.add(cell(thing.name, &made.asset, corner));
        count += 1;
    }
    let (width, height) =
        (MARGIN * 2.0 + CELL.0 * COLUMNS as f64, MARGIN * 2.0 + CELL.1 * count.div_ceil(COLUMNS) as f64);
    let ground = Rectangle::new().set("width", width).set("height", height).set("fill", "#f4f4ef");
    Ok(svg::Document::new()
        .set("width", width)
        .set("height", height)
        .set("viewBox", (0.0, 0.0, width, height))
        .add(Title::new("What is made from words"))
        .add(ground)
        .add(sheet))
}

fn cell(name: &str, asset: &Asset, (left, top): (f64, f64)) -> Group {
    let mut group = Group::new();
    let seen = asset.model.as_deref().map_or_else(Vec::new, |model| triangles(model, asset.color));
    let corners = || seen.iter().flat_map(|triangle| triangle.corners);
    let low = corners().fold((f64::INFINITY, f64::INFINITY), |low, at| (low.0.min(at.0), low.1.min(at.1)));
    let high = corners()
        .fold((f64::NEG_INFINITY, f64::NEG_INFINITY), |high, at| (high.0.max(at.0), high.1.max(at.1)));
    let scale = PICTURE / (high.0 - low.0).max(high.1 - low.1).max(1e-6);
    let aside = (PICTURE - (high.0 - low.0) * scale) * 0.5;
    for triangle in &seen {
        let place =
            |(x, y): (f64, f64)| (left + aside + (x - low.0) * scale, top + PICTURE - (y - low.1) * scale);
        let points: Vec<String> =
            triangle.corners.iter().map(|at| place(*at)).map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let color = to_srgb(triangle.color);
        // An edge in the same colour closes the seams between triangles.
        let shape = Polygon::new().set("points", points.join(" ")).set("fill", color.as_str());
        group = group.add(shape.set("stroke", color).set("stroke-width", 0.3));
    }
    let size = asset.collider.size();
    let told =
        format!("{:.1} x {:.1} x {:.1} m, {:.0} kg", size.x, size.y, size.z, asset.mass.unwrap_or(0.0));
    group.add(words(name, (left, top + PICTURE + 12.0), 10.5)).add(words(
        &told,
        (left, top + PICTURE + 23.0),
        8.0,
    ))
}

/// The triangles that look towards the eye, the farthest first.
fn triangles(model: &Model, color: Option<[f32; 3]>) -> Vec<Seen> {
    let body = color.unwrap_or([0.6; 3]);
    let mut seen = Vec::new();
    for (part, triangles) in model.runs() {
        for triangle in triangles {
            let corners =
                triangle.map(|index| Vector3::from(model.vertices[index as usize].position.map(f64::from)));
            let own = model.vertices[triangle[0] as usize].color;
            let painted = match part.paint {
                Paint::Own => own,
                Paint::Entity => std::array::from_fn(|channel| own[channel] * body[channel]),
            };
            seen.extend(look(corners, painted));
        }
    }
    seen.sort_by(|a, b| a.near.total_cmp(&b.near));
    seen
}

/// A triangle as it is seen; nothing of one that looks away.
fn look(corners: [Vector3; 3], color: [f32; 3]) -> Option<Seen> {
    // Towards the eye: before the thing, which looks along x, to its right and above it.
    let eye = Vector3::new(0.8, -0.45, 0.4).normalize();
    let right = Vector3::new(0.45, 0.8, 0.0).normalize();
    let up = eye.cross(&right);
    let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).try_normalize(1e-12)?;
    if normal.dot(&eye) <= 0.0 {
        return None;
    }
    let lit = SHADE + (1.0 - SHADE) * normal.dot(&Vector3::from(LIGHT).normalize()).max(0.0);
    Some(Seen {
        corners: corners.map(|corner| (right.dot(&corner), up.dot(&corner))),
        near: corners.iter().map(|corner| eye.dot(corner)).sum::<f64>() / 3.0,
        color: color.map(|channel| channel * lit as f32),
    })
}

fn words(text: &str, (x, y): (f64, f64), size: f64) -> Text {
    Text::new(text).set("x", x).set("y", y).set("font-size", size).set("font-family", FACE).set("fill", INK)
}
