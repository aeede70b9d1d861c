//! Charts as SVG. Lines and letters take the colour of the text around them, so that they read on light and dark pages.

mod bars;
mod heat;
mod violin;

pub(super) use bars::stacked;
pub(super) use heat::{Scale, heat};
pub(super) use violin::{Dots, violins};

use svg::Document;
use svg::node::element::{Line, Rectangle, Text};

/// Colours that are told apart, also by those who see few (Okabe and Ito 2008).
const COLORS: [&str; 10] = [
    "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#a0714f", "#7a7a7a", "#8577d6",
    "#b8b8b8",
];

/// A sheet of that size, in points of a screen.
fn sheet(width: f64, height: f64) -> Document {
    Document::new()
        .set("viewBox", (0.0, 0.0, width, height))
        .set("width", width)
        .set("height", height)
        .set("font-family", "system-ui, sans-serif")
        .set("font-size", 12)
        .set("fill", "currentColor")
}

/// A text; `anchor` is start, middle or end.
fn text(x: f64, y: f64, anchor: &str, words: impl Into<String>) -> Text {
    Text::new(words).set("x", rounded(x)).set("y", rounded(y)).set("text-anchor", anchor)
}

fn line((x1, y1): (f64, f64), (x2, y2): (f64, f64), opacity: f64) -> Line {
    Line::new()
        .set("x1", rounded(x1))
        .set("y1", rounded(y1))
        .set("x2", rounded(x2))
        .set("y2", rounded(y2))
        .set("stroke", "currentColor")
        .set("stroke-opacity", opacity)
}

fn rectangle((x, y): (f64, f64), (width, height): (f64, f64)) -> Rectangle {
    Rectangle::new()
        .set("x", rounded(x))
        .set("y", rounded(y))
        .set("width", rounded(width.max(0.0)))
        .set("height", rounded(height.max(0.0)))
}

/// To a hundredth of a point: finer is not seen.
fn rounded(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}
