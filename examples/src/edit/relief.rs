//! Land on a plan: covers under a hill shade, water, and contour lines.
//!
//! The shade is that of a sun in the north-west, 45° high, as is usual on maps (Horn 1981); contour lines are found by marching
//! squares on the grid of the ground.

use simworld_core::geometry::{Point2, Vector2, Vector3};
use simworld_core::ground::{Cover, Ground};
use svg::node::element::{Group, Path, Rectangle};

/// Cells of shade along a side.
const CELLS: u32 = 200;
/// Steps of shade, so that cells of one colour are drawn in one piece.
const SHADES: f64 = 7.0;
/// Contour lines between the lowest and the highest land at the most.
const CONTOURS: f64 = 14.0;
const CONTOUR: &str = "#7a5a33";
const SHORE: &str = "#1d4f73";

/// The land around a middle; map coordinates, with the south below.
pub(super) fn drawn(ground: &Ground, middle: Point2, reach: f64) -> Group {
    let mut group = Group::new();
    let cell = 2.0 * reach / f64::from(CELLS);
    for row in 0..CELLS {
        let y = -reach + f64::from(row) * cell;
        let color = |column: u32| {
            let x = -reach + (f64::from(column) + 0.5) * cell;
            color_at(ground, middle + Vector2::new(x, -(y + cell * 0.5)))
        };
        let mut column = 0;
        while column < CELLS {
            let fill = color(column);
            let run = (column..CELLS).take_while(|next| color(*next) == fill).count() as u32;
            let rectangle = Rectangle::new()
                .set("x", -reach + f64::from(column) * cell)
                .set("y", y)
                .set("width", f64::from(run) * cell * 1.001)
                // A hair more, so that no seam shows between rows.
                .set("height", cell * 1.02);
            if let Some(fill) = fill {
                group = group.add(rectangle.set("fill", fill));
            }
            column += run;
        }
    }
    let (low, high) =
        ground.data().heights.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), height| {
            (low.min(*height), high.max(*height))
        });
    let water = ground.water().unwrap_or(f64::from(low));
    let step = [1.0, 2.0, 2.5, 5.0, 10.0, 20.0, 50.0];
    let step = step.into_iter().find(|step| (f64::from(high) - water) / step <= CONTOURS).unwrap_or(100.0);
    let mut level = step;
    while water + level < f64::from(high) {
        let strong = (level / step).rem_euclid(5.0) < 0.5;
        let width = reach / if strong { 500.0 } else { 1100.0 };
        group = group.add(contour(ground, middle, water + level, CONTOUR).set("stroke-width", width));
        level += step;
    }
    group.add(contour(ground, middle, water + 1e-3, SHORE).set("stroke-width", reach / 500.0))
}

/// The colour of a place; none beyond the land.
fn color_at(ground: &Ground, place: Point2) -> Option<String> {
    let base: [f64; 3] = if ground.is_wet(place) {
        [0.60, 0.76, 0.86]
    } else if !ground.holds(place) {
        return ground.water().map(|_| "#99c2db".to_owned());
    } else {
        match ground.cover(place) {
            Cover::Wood => [0.62, 0.76, 0.55],
            Cover::Crop => [0.95, 0.89, 0.64],
            Cover::Soil => [0.85, 0.76, 0.64],
            Cover::Sand => [0.97, 0.92, 0.77],
            Cover::Rock => [0.79, 0.77, 0.74],
            Cover::Meadow => [0.86, 0.91, 0.72],
            Cover::Path | Cover::Built => [0.89, 0.87, 0.80],
            _ => [0.82, 0.90, 0.71],
        }
    };
    let sun = Vector3::new(-0.5, 0.5, std::f64::consts::FRAC_1_SQRT_2);
    let lit = if ground.is_wet(place) { 1.0 } else { ground.normal(place).dot(&sun) / sun.z };
    let shade = ((0.45 + 0.55 * lit).clamp(0.35, 1.12) * SHADES).round() / SHADES;
    let [r, g, b] = base.map(|channel| ((channel * shade).min(1.0) * 255.0) as u8);
    Some(format!("#{r:02x}{g:02x}{b:02x}"))
}

/// The line of a height, in pieces of a cell each.
fn contour(ground: &Ground, middle: Point2, level: f64, color: &str) -> Path {
    let data = ground.data();
    let (columns, rows) = (data.columns as usize, data.rows as usize);
    let at = |column: usize, row: usize| f64::from(data.heights[row * columns + column]) - level;
    let place = |column: f64, row: f64| {
        let point = data.origin + Vector2::new(column, row) * data.spacing;
        format!("{:.1} {:.1}", point.x - middle.x, middle.y - point.y)
    };
    let mut line = String::new();
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            // Counter-clockwise from the south-west.
            let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(dx, dy)| (column + dx, row + dy));
            let ends: Vec<String> = (0..4)
                .filter_map(|side| {
                    let (a, b) = (corners[side], corners[(side + 1) % 4]);
                    let (from, to) = (at(a.0, a.1), at(b.0, b.1));
                    ((from < 0.0) != (to < 0.0)).then(|| {
                        let share = from / (from - to);
                        let mix = |a: usize, b: usize| a as f64 + (b as f64 - a as f64) * share;
                        place(mix(a.0, b.0), mix(a.1, b.1))
                    })
                })
                .collect();
            for pair in ends.chunks_exact(2) {
                line.extend(["M", &pair[0], "L", &pair[1]]);
            }
        }
    }
    Path::new().set("d", line).set("fill", "none").set("stroke", color)
}
