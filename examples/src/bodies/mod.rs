//! Pictures of what bodies do.

mod gait;

pub use gait::gait_chart;
use simworld_physics::{RoadCondition, VehicleClass};
use svg::Document;
use svg::node::element::{Line, Polyline, Rectangle, Text};

/// Braking distances of a class on a road.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Which vehicle.
    pub class: VehicleClass,
    /// On which road.
    pub road: RoadCondition,
    /// Speed, km/h, and way to rest, m.
    pub points: Vec<(f64, f64)>,
}

/// The picture and the margins around its field, points.
const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 560.0;
const LEFT: f64 = 60.0;
const RIGHT: f64 = 190.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 50.0;
/// The axes end here: km/h and m.
const FASTEST: f64 = 130.0;
const LONGEST: f64 = 220.0;

/// Where a speed and a way are in the picture.
fn place(speed: f64, way: f64) -> (f64, f64) {
    let x = LEFT + (WIDTH - LEFT - RIGHT) * speed / FASTEST;
    let y = HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * way / LONGEST;
    (x, y)
}

fn color(class: VehicleClass) -> &'static str {
    // The palette of Okabe and Ito, which colour-blind people tell apart.
    match class {
        VehicleClass::SmallCar => "#e69f00",
        VehicleClass::Sedan => "#0072b2",
        VehicleClass::Suv => "#009e73",
        VehicleClass::Van => "#cc79a7",
        VehicleClass::Truck => "#d55e00",
        VehicleClass::Bus => "#000000",
        VehicleClass::Scooter => "#56b4e9",
    }
}

fn dashes(road: RoadCondition) -> &'static str {
    match road {
        RoadCondition::Dry => "none",
        RoadCondition::Wet => "8 4",
        RoadCondition::Snow | RoadCondition::Ice => "2 4",
    }
}

fn text(x: f64, y: f64, words: impl Into<String>) -> Text {
    Text::new(words).set("x", x).set("y", y).set("font-family", "sans-serif").set("font-size", 13)
}

/// Ways to rest by speed as an SVG: a colour for each class, whole lines on dry roads, dashes on wet ones, dots on
/// snow.
pub fn braking_chart(curves: &[Curve]) -> String {
    let mut picture = Document::new()
        .set("viewBox", (0, 0, WIDTH, HEIGHT))
        .set("width", WIDTH)
        .set("height", HEIGHT)
        .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", "#ffffff"));
    picture = axes(picture);
    for curve in curves {
        let inside = curve.points.iter().filter(|(speed, way)| *speed <= FASTEST && *way <= LONGEST);
        let points: Vec<String> = inside
            .map(|(speed, way)| {
                let (x, y) = place(*speed, *way);
                format!("{x:.1},{y:.1}")
            })
            .collect();
        let line = Polyline::new()
            .set("points", points.join(" "))
            .set("fill", "none")
            .set("stroke", color(curve.class))
            .set("stroke-width", 2)
            .set("stroke-dasharray", dashes(curve.road));
        picture = picture.add(line);
    }
    legend(picture, curves).to_string()
}

/// Grid, figures and titles.
fn axes(mut picture: Document) -> Document {
    for step in 0..=13 {
        let speed = f64::from(step) * 10.0;
        let ((x, bottom), (_, top)) = (place(speed, 0.0), place(speed, LONGEST));
        picture = picture.add(rule((x, bottom), (x, top)));
        picture = picture.add(text(x, bottom + 18.0, format!("{speed:.0}")).set("text-anchor", "middle"));
    }
    for step in 0..=11 {
        let way = f64::from(step) * 20.0;
        let ((left, y), (right, _)) = (place(0.0, way), place(FASTEST, way));
        picture = picture.add(rule((left, y), (right, y)));
        picture = picture.add(text(left - 8.0, y + 4.0, format!("{way:.0}")).set("text-anchor", "end"));
    }
    let middle = place(FASTEST * 0.5, 0.0);
    picture.add(text(middle.0, HEIGHT - 12.0, "speed, km/h").set("text-anchor", "middle")).add(text(
        LEFT - 45.0,
        TOP - 16.0,
        "braking distance, m",
    ))
}

fn rule(from: (f64, f64), to: (f64, f64)) -> Line {
    let line = Line::new().set("x1", from.0).set("y1", from.1).set("x2", to.0).set("y2", to.1);
    line.set("stroke", "#dddddd").set("stroke-width", 1)
}

fn legend(mut picture: Document, curves: &[Curve]) -> Document {
    let x = WIDTH - RIGHT + 20.0;
    let mut y = TOP + 10.0;
    let mut entry = |picture: Document, stroke: &str, dash: &str, words: &str| {
        let line = Line::new().set("x1", x).set("x2", x + 40.0).set("y1", y).set("y2", y);
        let line = line.set("stroke", stroke).set("stroke-width", 2).set("stroke-dasharray", dash);
        let picture = picture.add(line).add(text(x + 50.0, y + 4.0, words));
        y += 22.0;
        picture
    };
    for curve in curves.iter().filter(|curve| curve.road == RoadCondition::Dry) {
        picture = entry(picture, color(curve.class), "none", &curve.class.to_string().replace('_', " "));
    }
    for (road, words) in
        [(RoadCondition::Dry, "dry"), (RoadCondition::Wet, "wet"), (RoadCondition::Snow, "snow")]
    {
        picture = entry(picture, "#666666", dashes(road), words);
    }
    picture
}
