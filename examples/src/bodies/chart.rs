//! A chart of lines: a grid with figures, and a legend beside it.

use svg::node::element::{Line, Polyline, Rectangle, Text};
use svg::{Document, Node};

/// The picture and the margins around its field, points.
const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 560.0;
const LEFT: f64 = 60.0;
const RIGHT: f64 = 190.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 50.0;

/// What is written along a side, where it ends, and how far its lines are apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub(super) title: &'static str,
    pub(super) most: f64,
    pub(super) step: f64,
}

/// How a line is drawn: its colour and its dashes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pen {
    pub(super) color: &'static str,
    pub(super) dashes: &'static str,
}

/// A picture in the making.
pub(super) struct Chart {
    across: Axis,
    up: Axis,
    picture: Document,
    /// Where the next line of the legend comes.
    next: f64,
}

impl Chart {
    pub(super) fn new(across: Axis, up: Axis) -> Self {
        let mut chart = Self { across, up, picture: paper(WIDTH, HEIGHT), next: TOP + 10.0 };
        chart.grid();
        chart
    }

    /// A line through points, as far as they are inside.
    pub(super) fn line(&mut self, points: &[(f64, f64)], pen: Pen) {
        let inside = points.iter().filter(|(x, y)| *x <= self.across.most && *y <= self.up.most);
        let places: Vec<String> = inside
            .map(|(x, y)| {
                let (x, y) = self.place(*x, *y);
                format!("{x:.1},{y:.1}")
            })
            .collect();
        let line = Polyline::new().set("points", places.join(" ")).set("fill", "none");
        self.add(line.set("stroke", pen.color).set("stroke-width", 2).set("stroke-dasharray", pen.dashes));
    }

    /// What a pen stands for.
    pub(super) fn explain(&mut self, pen: Pen, words: &str) {
        let (x, y) = (WIDTH - RIGHT + 20.0, self.next);
        let line = Line::new().set("x1", x).set("x2", x + 40.0).set("y1", y).set("y2", y);
        self.add(line.set("stroke", pen.color).set("stroke-width", 2).set("stroke-dasharray", pen.dashes));
        self.add(text(x + 50.0, y + 4.0, words));
        self.next += 22.0;
    }

    pub(super) fn finish(self) -> String {
        self.picture.to_string()
    }

    fn grid(&mut self) {
        let (across, up) = (self.across, self.up);
        for step in 0..=(across.most / across.step).round() as u32 {
            let at = f64::from(step) * across.step;
            let ((x, bottom), (_, top)) = (self.place(at, 0.0), self.place(at, up.most));
            self.add(rule((x, bottom), (x, top)));
            self.add(text(x, bottom + 18.0, number(at)).set("text-anchor", "middle"));
        }
        for step in 0..=(up.most / up.step).round() as u32 {
            let at = f64::from(step) * up.step;
            let ((left, y), (right, _)) = (self.place(0.0, at), self.place(across.most, at));
            self.add(rule((left, y), (right, y)));
            self.add(text(left - 8.0, y + 4.0, number(at)).set("text-anchor", "end"));
        }
        let middle = self.place(across.most * 0.5, 0.0).0;
        self.add(text(middle, HEIGHT - 12.0, across.title).set("text-anchor", "middle"));
        self.add(text(LEFT - 45.0, TOP - 16.0, up.title));
    }

    /// Where a point of the field is in the picture.
    fn place(&self, x: f64, y: f64) -> (f64, f64) {
        let across = (WIDTH - LEFT - RIGHT) * x / self.across.most;
        let up = (HEIGHT - TOP - BOTTOM) * y / self.up.most;
        (LEFT + across, HEIGHT - BOTTOM - up)
    }

    fn add(&mut self, node: impl Into<Box<dyn Node>>) {
        self.picture.append(node);
    }
}

fn number(value: f64) -> String {
    let short = format!("{value:.1}");
    short.strip_suffix(".0").map_or(short.clone(), str::to_owned)
}

fn rule(from: (f64, f64), to: (f64, f64)) -> Line {
    let line = Line::new().set("x1", from.0).set("y1", from.1).set("x2", to.0).set("y2", to.1);
    line.set("stroke", "#dddddd").set("stroke-width", 1)
}

/// A white sheet of a size, points.
pub(super) fn paper(width: f64, height: f64) -> Document {
    let sheet = Rectangle::new().set("width", "100%").set("height", "100%").set("fill", "#ffffff");
    Document::new().set("viewBox", (0, 0, width, height)).set("width", width).set("height", height).add(sheet)
}

/// Words as all these pictures write them.
pub(super) fn text(x: f64, y: f64, words: impl Into<String>) -> Text {
    Text::new(words).set("x", x).set("y", y).set("font-family", "sans-serif").set("font-size", 13)
}
