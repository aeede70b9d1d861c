//! The map of a run: the city with the couriers' trails.

use simworld_citygen::City;
use simworld_citygen::map::MapDrawing;

use super::SeedRun;

/// Colours told apart on a map, for trails in turn.
const COLORS: [&str; 10] = [
    "#1f4e9c", "#b3261e", "#1b7f4b", "#8e3ba8", "#c25e00", "#00798c", "#7a4b23", "#d6336c", "#4d5bd6",
    "#5c7a00",
];

/// The map as an SVG document.
pub fn draw_map(city: &City, run: &SeedRun) -> String {
    let title = format!("Couriers of seed {} after {} steps", run.report.seed.0, run.report.steps);
    let drawing = MapDrawing::of(city).title(title);
    let drawn = run.trails.iter().enumerate().fold(drawing, |drawing, (index, trail)| {
        drawing.trail(trail, COLORS[index % COLORS.len()], &index.to_string())
    });
    drawn.to_string()
}
