//! The runs as a picture: the arm from the side and from above, and the way of the one on wheels.

use simworld_core::geometry::Vector3;
use svg::node::element::{Circle, Polyline, Rectangle, Text};
use svg::{Document, Node};

use super::{Reach, Roll};

/// A field, pixels, and what a metre of the arm and of the way is.
const FIELD: f64 = 320.0;
const ARM: f64 = 200.0;
const WAY: f64 = 55.0;
/// One colour a target or stretch.
const COLORS: [&str; 5] = ["#1b6ca8", "#c2571a", "#2e8b57", "#8a3b8f", "#b08900"];

/// Where something is in a field: to the right, and up.
type View<'a> = &'a dyn Fn(&Vector3) -> (f64, f64);

/// The picture, as SVG.
pub fn picture(reaches: &[Reach], rolls: &[Roll]) -> String {
    let mut picture = Document::new().set("viewBox", (0, 0, 3 * FIELD as i32, FIELD as i32));
    picture.append(Rectangle::new().set("width", 3.0 * FIELD).set("height", FIELD).set("fill", "#ffffff"));
    let side = |place: &Vector3| (FIELD * 0.45 + ARM * place.x, FIELD * 0.85 - ARM * place.z);
    let above = |place: &Vector3| (FIELD * 1.5 + ARM * place.x, FIELD * 0.5 - ARM * place.y);
    let way = |place: &Vector3| (FIELD * 2.3 + WAY * place.x, FIELD * 0.5 - WAY * place.y);
    for (reach, color) in reaches.iter().zip(COLORS) {
        for view in [&side as View<'_>, &above as View<'_>] {
            line(&mut picture, &reach.way, view, (color, 1.0));
            line(&mut picture, &reach.shape, view, (color, 4.0));
            let (x, y) = view(&reach.target);
            picture.append(Circle::new().set("cx", x).set("cy", y).set("r", 5).set("fill", color));
        }
    }
    for (roll, color) in rolls.iter().zip(COLORS) {
        line(&mut picture, &roll.way, &way, (color, 2.0));
    }
    for (words, x) in
        [("the arm from the side", 0.0), ("from above", FIELD), ("the way on wheels", 2.0 * FIELD)]
    {
        let text = Text::new(words).set("x", x + 12.0).set("y", 22).set("font-size", 14);
        picture.append(text.set("font-family", "sans-serif"));
    }
    picture.to_string()
}

fn line(picture: &mut Document, places: &[Vector3], view: View<'_>, (color, width): (&str, f64)) {
    let points: Vec<String> = places
        .iter()
        .map(|place| {
            let (x, y) = view(place);
            format!("{x:.1},{y:.1}")
        })
        .collect();
    let line = Polyline::new().set("points", points.join(" ")).set("fill", "none");
    picture.append(line.set("stroke", color).set("stroke-width", width).set("stroke-opacity", 0.8));
}
