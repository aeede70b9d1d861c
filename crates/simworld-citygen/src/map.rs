//! The map: a city drawn as SVG, with room for trails and markers of others.
//!
//! North is up; one unit of the drawing is one metre.

use std::fmt::{self, Write};

use simworld_core::geometry::{Obb, Point2};
use simworld_core::net::polyline;
use simworld_core::scene::{EntityKind, Place};
use svg::Document;
use svg::node::element::{Circle, Group, Line, Path, Polygon, Rectangle, Text};

use crate::City;

const GROUND: &str = "#eef0e6";
const SIDEWALK: &str = "#d9d6ce";
const ROAD: &str = "#8b8e94";
const LANE_MARK: &str = "#f4f1e4";
const INK: &str = "#33373d";
const TREE: &str = "#8fb573";
/// Margin round the streets, m.
const MARGIN: f64 = 45.0;

/// The colour of a building by its use.
pub const fn place_color(place: Place) -> &'static str {
    match place {
        Place::Home => "#d8c3a5",
        Place::Restaurant => "#d9694a",
        Place::Store => "#e3b23c",
        Place::Hospital => "#e8788f",
        Place::Museum => "#9f7fb8",
        Place::School => "#7ea6c9",
        Place::Office => "#9aa7b1",
        Place::Factory => "#7d7468",
        Place::ChargingStation => "#4fa3a5",
        Place::RestArea => "#86b36b",
        _ => "#c9c4bb",
    }
}

/// A drawing of a city that others may add to.
///
/// ```
/// use simworld_citygen::{City, CityConfig, map::MapDrawing};
/// use simworld_core::{geometry::Point2, seed::Seed};
/// let city = City::generate(&CityConfig::with_roads(8), Seed(3))?;
/// let walk = [Point2::new(0.0, 0.0), Point2::new(40.0, 10.0)];
/// let svg = MapDrawing::of(&city).title("A walk").trail(&walk, "#c0392b", "Ada").to_string();
/// assert!(svg.contains("Ada") && svg.ends_with("</svg>"));
/// # Ok::<(), simworld_citygen::CityError>(())
/// ```
#[derive(Clone, Debug)]
pub struct MapDrawing {
    low: Point2,
    high: Point2,
    layers: Group,
    overlay: Group,
    legend: Vec<(String, String)>,
    title: Option<String>,
}

impl MapDrawing {
    /// The city alone.
    pub fn of(city: &City) -> Self {
        let (low, high) = city.network.bounds().unwrap_or((Point2::origin(), Point2::origin()));
        let layers = Group::new()
            .add(sidewalks(city))
            .add(roads(city))
            .add(markings(city))
            .add(buildings(city))
            .add(elements(city));
        let mut present: Vec<Place> = city.buildings.iter().map(|building| building.place).collect();
        present.sort_unstable();
        present.dedup();
        let legend = present
            .into_iter()
            .map(|place| (place.as_str().replace('_', " "), place_color(place).to_owned()))
            .collect();
        Self { low, high, layers, overlay: Group::new(), legend, title: None }
    }

    /// With a title.
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = Some(title.into());
        self
    }

    /// With the trail of somebody: a line, a dot at its end, a label.
    #[must_use]
    pub fn trail(mut self, points: &[Point2], color: &str, label: &str) -> Self {
        let Some(last) = points.last() else { return self };
        let line = Path::new()
            .set("d", path_data(points, false))
            .set("fill", "none")
            .set("stroke", color)
            .set("stroke-width", 2.2)
            .set("stroke-opacity", 0.75)
            .set("stroke-linejoin", "round")
            .set("stroke-linecap", "round");
        self.overlay = self.overlay.add(line).add(dot(last, 4.0, color)).add(label_at(last, label, 9.0, 5.0));
        self
    }

    /// With a marked place.
    #[must_use]
    pub fn marker(mut self, point: &Point2, color: &str, label: &str) -> Self {
        self.overlay = self.overlay.add(dot(point, 5.0, color)).add(label_at(point, label, 10.0, 6.0));
        self
    }

    fn document(&self) -> Document {
        let (left, bottom) = (self.low.x - MARGIN, self.low.y - MARGIN);
        let (width, height) =
            (self.high.x - self.low.x + 2.0 * MARGIN, self.high.y - self.low.y + 2.0 * MARGIN);
        let panel = (width.max(height) * 0.16).max(110.0);
        let top = -(self.high.y + MARGIN);
        let ground = Rectangle::new()
            .set("x", round(left))
            .set("y", round(top))
            .set("width", round(width + panel))
            .set("height", round(height))
            .set("fill", GROUND);
        let frame = Frame {
            left,
            right: left + width,
            top,
            bottom: -bottom,
            scale: width.max(height) / 700.0,
            panel,
        };
        Document::new()
            .set("viewBox", (round(left), round(top), round(width + panel), round(height)))
            .set("width", 1100)
            .set("height", (1100.0 * height / (width + panel)).round())
            .set("font-family", "Helvetica, Arial, sans-serif")
            .add(ground)
            .add(self.layers.clone())
            .add(self.overlay.clone())
            .add(self.furniture(&frame))
    }

    /// Title, legend, scale and north arrow, in the panel on the right.
    fn furniture(&self, frame: &Frame) -> Group {
        let (scale, x) = (frame.scale, frame.right);
        let text = |content: String, x: f64, y: f64, size: f64| {
            Text::new(content)
                .set("x", round(x))
                .set("y", round(y))
                .set("font-size", round(size))
                .set("fill", INK)
        };
        let mut group = Group::new();
        if let Some(title) = &self.title {
            let title =
                text(title.clone(), frame.left + 10.0 * scale, frame.top + 24.0 * scale, 18.0 * scale);
            group = group.add(title.set("font-weight", "bold"));
        }
        let mut y = frame.top + 30.0 * scale;
        for (label, color) in &self.legend {
            let swatch = Rectangle::new()
                .set("x", round(x))
                .set("y", round(y - 9.0 * scale))
                .set("width", round(12.0 * scale))
                .set("height", round(10.0 * scale))
                .set("fill", color.as_str());
            group = group.add(swatch).add(text(label.clone(), x + 17.0 * scale, y, 11.0 * scale));
            y += 17.0 * scale;
        }
        group
            .add(north_arrow(x + frame.panel * 0.5, frame.bottom - 70.0 * scale, scale))
            .add(scale_bar(frame))
    }
}

impl fmt::Display for MapDrawing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.document())
    }
}

/// The drawing's edges, with y downwards, and the size of a unit of lettering, m.
struct Frame {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    scale: f64,
    panel: f64,
}

fn north_arrow(x: f64, y: f64, scale: f64) -> Group {
    let arrow = format!(
        "M{} {} L{} {} L{} {} L{} {} Z",
        round(x),
        round(y - 22.0 * scale),
        round(x + 8.0 * scale),
        round(y + 6.0 * scale),
        round(x),
        round(y),
        round(x - 8.0 * scale),
        round(y + 6.0 * scale)
    );
    let letter = Text::new("N")
        .set("x", round(x))
        .set("y", round(y - 26.0 * scale))
        .set("font-size", round(11.0 * scale))
        .set("text-anchor", "middle")
        .set("fill", INK);
    Group::new().add(Path::new().set("d", arrow).set("fill", INK)).add(letter)
}

fn scale_bar(frame: &Frame) -> Group {
    // The longest round length that fits the panel.
    let room = frame.panel * 0.75;
    let length = [10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0]
        .into_iter()
        .filter(|length| *length <= room)
        .fold(10.0, f64::max);
    let y = frame.bottom - 20.0 * frame.scale;
    let bar = Line::new()
        .set("x1", round(frame.right))
        .set("x2", round(frame.right + length))
        .set("y1", round(y))
        .set("y2", round(y))
        .set("stroke", INK)
        .set("stroke-width", round(2.5 * frame.scale));
    let label = Text::new(format!("{length} m"))
        .set("x", round(frame.right))
        .set("y", round(y - 6.0 * frame.scale))
        .set("font-size", round(10.0 * frame.scale))
        .set("fill", INK);
    Group::new().add(bar).add(label)
}

fn sidewalks(city: &City) -> Group {
    let mut group = Group::new()
        .set("fill", "none")
        .set("stroke", SIDEWALK)
        .set("stroke-linejoin", "round")
        .set("stroke-linecap", "round");
    let width = city.network.sidewalks.first().map_or(0.0, |sidewalk| sidewalk.width);
    let corners = city.network.intersections.iter().flat_map(|intersection| &intersection.corners);
    for path in city.network.sidewalks.iter().map(|sidewalk| &sidewalk.path).chain(corners) {
        group = group.add(Path::new().set("d", path_data(path, false)).set("stroke-width", round(width)));
    }
    group
}

fn roads(city: &City) -> Group {
    let mut group = Group::new().set("fill", ROAD).set("stroke", ROAD);
    for road in &city.network.roads {
        let line = Path::new()
            .set("d", path_data(&road.centerline, false))
            .set("fill", "none")
            .set("stroke-width", round(road.width));
        group = group.add(line);
    }
    for intersection in &city.network.intersections {
        let outline = Path::new().set("d", path_data(&intersection.outline, true)).set("stroke", "none");
        group = group.add(outline);
    }
    group
}

fn markings(city: &City) -> Group {
    let mut group = Group::new().set("fill", "none").set("stroke", LANE_MARK);
    for road in &city.network.roads {
        let length = polyline::length(&road.centerline);
        let middle = polyline::slice(&road.centerline, 14.0, length - 14.0);
        let mark = Path::new()
            .set("d", path_data(&middle, false))
            .set("stroke-width", 0.35)
            .set("stroke-dasharray", "3 4");
        group = group.add(mark);
    }
    for crossing in &city.network.crossings {
        let stripes = Path::new()
            .set("d", path_data(&[crossing.start, crossing.end], false))
            .set("stroke-width", round(crossing.width))
            .set("stroke-dasharray", "0.6 0.6");
        group = group.add(stripes);
    }
    group
}

fn buildings(city: &City) -> Group {
    let mut group = Group::new().set("stroke", "#6b6459").set("stroke-width", 0.5);
    for building in &city.buildings {
        let polygon = polygon(&building.obb()).set("fill", place_color(building.place));
        let hint = building.name.as_deref().unwrap_or(building.place.as_str());
        group = group.add(Group::new().add(polygon).add(svg::node::element::Title::new(hint)));
    }
    group
}

fn elements(city: &City) -> Group {
    let mut group = Group::new();
    for element in &city.elements {
        group = match element.kind {
            EntityKind::Tree => group.add(dot(&element.position, 2.4, TREE).set("fill-opacity", 0.8)),
            EntityKind::StreetLamp => group.add(dot(&element.position, 0.6, "#f2d16b")),
            _ => group.add(polygon(&element.obb()).set("fill", "#7a6a58")),
        };
    }
    group
}

fn polygon(obb: &Obb) -> Polygon {
    let corners = obb.footprint().map(|corner| format!("{},{}", round(corner.x), round(-corner.y)));
    Polygon::new().set("points", corners.join(" "))
}

fn dot(point: &Point2, radius: f64, color: &str) -> Circle {
    Circle::new().set("cx", round(point.x)).set("cy", round(-point.y)).set("r", radius).set("fill", color)
}

fn label_at(point: &Point2, label: &str, size: f64, offset: f64) -> Text {
    Text::new(label)
        .set("x", round(point.x + offset))
        .set("y", round(-point.y - offset))
        .set("font-size", size)
        .set("fill", INK)
        .set("stroke", GROUND)
        .set("stroke-width", 2.0)
        .set("paint-order", "stroke")
}

fn path_data(points: &[Point2], closed: bool) -> String {
    let mut data = String::new();
    for (index, point) in points.iter().enumerate() {
        let letter = if index == 0 { 'M' } else { 'L' };
        // Writing to a string never fails.
        let _ = write!(data, "{letter}{} {}", round(point.x), round(-point.y));
    }
    if closed {
        data.push('Z');
    }
    data
}

/// Centimetres are enough for a map.
fn round(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}
