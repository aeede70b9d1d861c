//! Reward over steps as a picture.

use svg::Document;
use svg::node::element::{Line, Polyline, Rectangle, Text};

use super::Point;

/// The lesson of a seed, and what chance gets.
#[derive(Clone, Debug)]
pub struct Run {
    /// Which seed.
    pub seed: u64,
    /// How rewards came to be.
    pub curve: Vec<Point>,
    /// Mean sum of rewards of an episode under chance.
    pub chance: f64,
}

const WIDTH: f64 = 820.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 60.0;
const RIGHT: f64 = 150.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 50.0;
/// The palette of Okabe and Ito, which colour-blind people tell apart.
const COLORS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

/// The field of the picture, in its own units.
struct Frame {
    steps: f64,
    low: f64,
    high: f64,
}

impl Frame {
    fn place(&self, steps: f64, mean: f64) -> (f64, f64) {
        let x = LEFT + (WIDTH - LEFT - RIGHT) * steps / self.steps;
        let y = HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (mean - self.low) / (self.high - self.low);
        ((x * 100.0).round() / 100.0, (y * 100.0).round() / 100.0)
    }
}

/// A curve for each seed, and what chance gets as dashes, as an SVG.
pub fn curve_chart(runs: &[Run]) -> String {
    let points = || runs.iter().flat_map(|run| &run.curve);
    let values = || points().map(|point| point.mean).chain(runs.iter().map(|run| run.chance));
    // to the next quarter outside, so that the axis has round numbers
    let low = (values().fold(0.0, f64::min) * 4.0).floor() / 4.0;
    let high = (values().fold(1.0, f64::max) * 4.0).ceil() / 4.0;
    let steps = points().map(|point| point.steps as f64).fold(1.0, f64::max);
    let frame = Frame { steps, low, high };
    let mut picture = Document::new()
        .set("viewBox", (0, 0, WIDTH, HEIGHT))
        .set("width", WIDTH)
        .set("height", HEIGHT)
        .set("font-family", "sans-serif")
        .set("font-size", 13)
        .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", "#ffffff"));
    picture = axes(picture, &frame);
    for (index, run) in runs.iter().enumerate() {
        let color = COLORS[index % COLORS.len()];
        let path = run.curve.iter().map(|point| frame.place(point.steps as f64, point.mean));
        let path: Vec<String> = path.map(|(x, y)| format!("{x},{y}")).collect();
        let curve = Polyline::new().set("points", path.join(" ")).set("fill", "none").set("stroke", color);
        let (from, to) = (frame.place(0.0, run.chance), frame.place(frame.steps, run.chance));
        let key = TOP + 20.0 + 40.0 * index as f64;
        let x = WIDTH - RIGHT + 16.0;
        picture = picture
            .add(curve.set("stroke-width", 2))
            .add(line(from, to, color).set("stroke-dasharray", "6 4"))
            .add(line((x, key), (x + 24.0, key), color).set("stroke-width", 2))
            .add(text(x + 32.0, key + 4.0, "start", format!("seed {}", run.seed)))
            .add(line((x, key + 18.0), (x + 24.0, key + 18.0), color).set("stroke-dasharray", "6 4"))
            .add(text(x + 32.0, key + 22.0, "start", "chance"));
    }
    picture.to_string()
}

fn axes(mut picture: Document, frame: &Frame) -> Document {
    let quarters = ((frame.high - frame.low) * 4.0).round() as usize;
    for quarter in 0..=quarters {
        let mean = frame.low + quarter as f64 * 0.25;
        let (from, to) = (frame.place(0.0, mean), frame.place(frame.steps, mean));
        picture = picture.add(line(from, to, "#dddddd")).add(text(
            from.0 - 8.0,
            from.1 + 4.0,
            "end",
            format!("{mean:.2}"),
        ));
    }
    for fifth in 0..=5 {
        let steps = frame.steps * f64::from(fifth) / 5.0;
        let (x, y) = frame.place(steps, frame.low);
        picture = picture.add(text(x, y + 18.0, "middle", format!("{steps:.0}")));
    }
    let middle = frame.place(frame.steps * 0.5, frame.low).0;
    picture.add(text(middle, HEIGHT - 12.0, "middle", "steps of all environments")).add(text(
        LEFT - 40.0,
        TOP - 14.0,
        "start",
        "mean sum of rewards of an episode",
    ))
}

fn line((x1, y1): (f64, f64), (x2, y2): (f64, f64), color: &str) -> Line {
    Line::new().set("x1", x1).set("y1", y1).set("x2", x2).set("y2", y2).set("stroke", color)
}

fn text(x: f64, y: f64, anchor: &str, words: impl Into<String>) -> Text {
    Text::new(words).set("x", x).set("y", y).set("text-anchor", anchor).set("fill", "#222222")
}
