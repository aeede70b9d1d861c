//! Heat maps: a number for each pair of a row and a column.

use super::{rectangle, sheet, text};

const CELL: (f64, f64) = (58.0, 28.0);
const LEFT: f64 = 130.0;
const TOP: f64 = 96.0;

/// From which value to which colours run, and the one in their middle.
#[derive(Clone, Copy)]
pub(in crate::experiment) struct Scale {
    pub(in crate::experiment) middle: f64,
    /// Farthest value from the middle, either way.
    pub(in crate::experiment) reach: f64,
}

impl Scale {
    /// Blue below the middle, red above, and how strong.
    fn color(self, value: f64) -> (&'static str, f64) {
        let share = ((value - self.middle) / self.reach).clamp(-1.0, 1.0);
        (if share < 0.0 { "#0072b2" } else { "#d55e00" }, share.abs() * 0.85)
    }
}

/// A map of rows and columns; cells without a value stay empty.
pub(in crate::experiment) fn heat(
    rows: &[String],
    columns: &[String],
    values: &[Vec<Option<f64>>],
    scale: Scale,
) -> String {
    let width = LEFT + CELL.0 * columns.len() as f64 + 40.0;
    let mut drawing = sheet(width, TOP + CELL.1 * rows.len() as f64 + 10.0);
    for (column, name) in columns.iter().enumerate() {
        let (x, y) = (LEFT + CELL.0 * (column as f64 + 0.4), TOP - 8.0);
        let label = text(x, y, "start", name.as_str());
        drawing = drawing.add(label.set("transform", format!("rotate(-40 {x} {y})")));
    }
    for (row, (name, values)) in rows.iter().zip(values).enumerate() {
        let y = TOP + CELL.1 * row as f64;
        drawing = drawing.add(text(LEFT - 8.0, y + CELL.1 * 0.65, "end", name.as_str()));
        for (column, value) in values.iter().enumerate() {
            let Some(value) = value else { continue };
            let x = LEFT + CELL.0 * column as f64;
            let (color, strength) = scale.color(*value);
            let cell = rectangle((x, y), (CELL.0 - 2.0, CELL.1 - 2.0));
            drawing = drawing.add(cell.set("fill", color).set("fill-opacity", strength)).add(text(
                x + CELL.0 * 0.5 - 1.0,
                y + CELL.1 * 0.65,
                "middle",
                format!("{value:.2}"),
            ));
        }
    }
    drawing.to_string()
}
