//! Stacked bars: what a whole is made of, level by level.

use super::{COLORS, line, rectangle, sheet, text};

const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 380.0;
const LEFT: f64 = 60.0;
const TOP: f64 = 16.0;
const BOTTOM: f64 = 46.0;
/// Room for the legend.
const RIGHT: f64 = 190.0;

/// One bar a level; `parts` are names with a share for each level, from the bottom up.
pub(in crate::experiment) fn stacked(levels: &[String], parts: &[(String, Vec<f64>)], axis: &str) -> String {
    let (height, width) = (HEIGHT - TOP - BOTTOM, WIDTH - LEFT - RIGHT);
    let total = |level: usize| parts.iter().map(|part| part.1[level]).sum::<f64>();
    let mut drawing = sheet(WIDTH, HEIGHT);
    for step in 0..=4 {
        let y = TOP + height * f64::from(step) / 4.0;
        drawing = drawing.add(line((LEFT, y), (LEFT + width, y), 0.15)).add(text(
            LEFT - 8.0,
            y + 4.0,
            "end",
            format!("{} %", 100 - 25 * step),
        ));
    }
    let room = width / levels.len().max(1) as f64;
    for (level, name) in levels.iter().enumerate() {
        let (x, whole) = (LEFT + room * (level as f64 + 0.15), total(level).max(f64::MIN_POSITIVE));
        let mut y = TOP + height;
        for (part, (_, shares)) in parts.iter().enumerate() {
            let tall = height * shares[level] / whole;
            y -= tall;
            let bar = rectangle((x, y), (room * 0.7, tall));
            drawing = drawing.add(bar.set("fill", COLORS[part % COLORS.len()]));
        }
        drawing = drawing.add(text(x + room * 0.35, HEIGHT - BOTTOM + 18.0, "middle", name.as_str()));
    }
    drawing = drawing.add(text(LEFT + width * 0.5, HEIGHT - 8.0, "middle", axis));
    for (part, (name, _)) in parts.iter().enumerate().rev() {
        let y = TOP + 20.0 * (parts.len() - part) as f64;
        let key = rectangle((LEFT + width + 20.0, y - 10.0), (12.0, 12.0));
        drawing = drawing.add(key.set("fill", COLORS[part % COLORS.len()])).add(text(
            LEFT + width + 40.0,
            y,
            "start",
            name.as_str(),
        ));
    }
    drawing.to_string()
}
