//! Violins: how values are distributed, group by group.

use simworld_core::ops;
use svg::node::element::{Circle, Path};

use super::{COLORS, line, rounded, sheet, text};

/// The values of a group, each with whether it is marked.
pub(in crate::experiment) type Dots = Vec<(f64, bool)>;

const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 380.0;
const LEFT: f64 = 60.0;
const TOP: f64 = 20.0;
const BOTTOM: f64 = 110.0;
/// Points of the outline of a violin.
const STEPS: usize = 60;
/// Most dots of a group that are drawn.
const MOST_DOTS: usize = 150;

/// One violin a group over values in `range`; marked values as full dots, the others as faint ones.
pub(in crate::experiment) fn violins(groups: &[(String, Dots)], range: (f64, f64), axis: &str) -> String {
    let height = HEIGHT - TOP - BOTTOM;
    let y = |value: f64| TOP + height * (1.0 - ((value - range.0) / (range.1 - range.0)).clamp(0.0, 1.0));
    let mut drawing = sheet(WIDTH, HEIGHT);
    for step in 0..=5 {
        let value = range.0 + (range.1 - range.0) * f64::from(step) / 5.0;
        drawing = drawing.add(line((LEFT, y(value)), (WIDTH, y(value)), 0.15)).add(text(
            LEFT - 8.0,
            y(value) + 4.0,
            "end",
            format!("{value:.1}"),
        ));
    }
    let middle = TOP + height * 0.5;
    drawing =
        drawing.add(text(14.0, middle, "middle", axis).set("transform", format!("rotate(-90 14 {middle})")));
    let room = (WIDTH - LEFT) / groups.len().max(1) as f64;
    for (index, (name, dots)) in groups.iter().enumerate() {
        let center = LEFT + room * (index as f64 + 0.5);
        let values: Vec<f64> = dots.iter().map(|dot| dot.0).collect();
        let color = COLORS[index % COLORS.len()];
        if let Some(outline) = outline(&values, range, (center, room * 0.42), y) {
            drawing = drawing.add(outline.set("fill", color).set("fill-opacity", 0.35).set("stroke", color));
        }
        let every = dots.len().div_ceil(MOST_DOTS).max(1);
        for (rank, (value, marked)) in dots.iter().enumerate().step_by(every) {
            // Spread by the golden ratio, so that dots lie beside each other.
            let aside = ((rank as f64 * 0.618_033_988_75).fract() - 0.5) * room * 0.4;
            let dot = Circle::new().set("cx", rounded(center + aside)).set("cy", rounded(y(*value)));
            drawing = drawing.add(if *marked {
                dot.set("r", 2.6).set("fill", color)
            } else {
                dot.set("r", 1.3).set("fill-opacity", 0.35)
            });
        }
        let (x, at) = (rounded(center), HEIGHT - BOTTOM + 16.0);
        let label = text(center, at, "end", name.as_str());
        drawing = drawing.add(label.set("transform", format!("rotate(-35 {x} {at})")));
    }
    drawing.to_string()
}

/// The density of values, mirrored, by a Gaussian kernel with Silverman's rule of thumb (1986).
fn outline(
    values: &[f64],
    range: (f64, f64),
    (center, half): (f64, f64),
    y: impl Fn(f64) -> f64,
) -> Option<Path> {
    let summary: simworld_core::evaluation::Accumulator = values.iter().copied().collect();
    if summary.count() < 2 {
        return None;
    }
    let count = summary.count() as f64;
    let narrowest = (range.1 - range.0) * 0.008;
    let bandwidth = (1.06 * summary.deviation() * ops::pow(count, -0.2)).max(narrowest);
    let density = |at: f64| -> f64 {
        let kernel = |value: &f64| {
            let away = (at - value) / bandwidth;
            ops::exp(-0.5 * away * away)
        };
        values.iter().map(kernel).sum()
    };
    let at = |step: usize| range.0 + (range.1 - range.0) * step as f64 / STEPS as f64;
    let densities: Vec<f64> = (0..=STEPS).map(|step| density(at(step))).collect();
    let most = densities.iter().copied().fold(0.0, f64::max);
    let point = |step: usize, sign: f64| {
        let x = center + sign * half * densities[step] / most;
        format!("{:.1},{:.1}", x, y(at(step)))
    };
    // Not where next to nothing lies.
    let inside = |step: &usize| densities[*step] > most * 0.01;
    let right = (0..=STEPS).filter(inside).map(|step| point(step, 1.0));
    let left = (0..=STEPS).rev().filter(inside).map(|step| point(step, -1.0));
    let points: Vec<String> = right.chain(left).collect();
    Some(Path::new().set("d", format!("M{}Z", points.join("L"))))
}
