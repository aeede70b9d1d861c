//! The map of a network, every lane in the colour of what was measured on it.

use std::collections::BTreeMap;

use simworld_core::geometry::Point2;
use simworld_core::net::RoadNetwork;

use super::Recorder;
use super::sheet::{Anchor, FAINT, Frame, INK, Sheet, path_data};

/// Width of the sheet, mm.
const WIDTH: f64 = 420.0;
const MARGIN: f64 = 14.0;
/// Below the map: the legend.
const FOOT: f64 = 26.0;
/// Lanes where nobody was.
const UNUSED: &str = "#cfc9ba";

/// What a map of the network shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Vehicles a kilometre and lane.
    Density,
    /// Mean speed as a share of the free speed.
    Speed,
    /// Vehicles an hour and lane.
    Flow,
}

impl Quantity {
    /// The upper bounds of its classes but the last, and the colours of all, from the least value to the greatest.
    const fn classes(self) -> ([f64; 5], [&'static str; 6]) {
        match self {
            Self::Density => ([5.0, 10.0, 20.0, 40.0, 70.0], HEAT),
            Self::Flow => ([50.0, 100.0, 200.0, 400.0, 800.0], HEAT),
            Self::Speed => (
                [0.15, 0.3, 0.45, 0.6, 0.8],
                ["#8e1b2b", "#d7613f", "#f0a75b", "#e9d27c", "#8fbf8a", "#3f8f6b"],
            ),
        }
    }

    const fn title(self) -> &'static str {
        match self {
            Self::Density => "Density",
            Self::Speed => "Speed",
            Self::Flow => "Flow",
        }
    }

    const fn unit(self) -> &'static str {
        match self {
            Self::Density => "vehicles a kilometre and lane",
            Self::Speed => "mean speed over free speed",
            Self::Flow => "vehicles an hour and lane",
        }
    }

    fn color(self, value: f64) -> &'static str {
        let (bounds, colors) = self.classes();
        colors[bounds.iter().position(|bound| value <= *bound).unwrap_or(5)]
    }
}

/// From light to dark.
const HEAT: [&str; 6] = ["#f4dfa6", "#f2c14e", "#ee964b", "#d7613f", "#a62b43", "#571845"];

/// The map as an SVG text, to print on A3; lanes that nobody used are grey.
pub fn network_map(recorder: &Recorder, network: &RoadNetwork, quantity: Quantity) -> String {
    let (low, high) = network.bounds().unwrap_or((Point2::origin(), Point2::new(1.0, 1.0)));
    let span = high - low;
    let (across, up) = (span.x.max(1.0) + 40.0, span.y.max(1.0) + 40.0);
    let width = WIDTH - 2.0 * MARGIN;
    let height = width * (up / across).clamp(0.4, 1.3);
    let frame = Frame { x: MARGIN, y: 30.0, width, height };
    let totals = recorder.totals();
    let subtitle = format!(
        "{}; {:.0} minutes, {:.0} vehicle-kilometres, mean speed {:.1} km/h",
        quantity.unit(),
        totals.seconds / 60.0,
        totals.distance / 1000.0,
        totals.mean_speed() * 3.6
    );
    let mut sheet = Sheet::new((WIDTH, frame.bottom() + FOOT), quantity.title(), &subtitle);
    let scale = (width / across).min(height / up);
    let middle = nalgebra::center(&low, &high);
    let place = |point: &Point2| {
        let away = (point - middle) * scale;
        (frame.x + frame.width * 0.5 + away.x, frame.y + frame.height * 0.5 - away.y)
    };
    sheet.rect(frame, "#f3efe4");
    sheet.begin_clip("map", frame);
    draw_lanes(&mut sheet, recorder, network, quantity, scale, &place);
    sheet.end_group();
    draw_legend(&mut sheet, quantity, frame.bottom() + 6.0);
    draw_scale(&mut sheet, frame, scale);
    sheet.finish()
}

/// The lanes, those of one colour in one path, the unused first.
fn draw_lanes(
    sheet: &mut Sheet,
    recorder: &Recorder,
    network: &RoadNetwork,
    quantity: Quantity,
    scale: f64,
    place: &impl Fn(&Point2) -> (f64, f64),
) {
    let (_, colors) = quantity.classes();
    let mut paths: BTreeMap<usize, String> = BTreeMap::new();
    let seconds = recorder.totals().seconds;
    for (index, lane) in network.lanes.iter().enumerate().filter(|(_, lane)| lane.is_driven()) {
        let used = recorder.lane(index);
        let value = match quantity {
            Quantity::Density => used.density(lane.length, seconds) * 1000.0,
            Quantity::Flow => used.flow(lane.length, seconds) * 3600.0,
            Quantity::Speed => used.speed() / recorder.free_speed(index),
        };
        let color = if used.time > 0.0 { quantity.color(value) } else { UNUSED };
        let rank = colors.iter().position(|own| *own == color).map_or(0, |rank| rank + 1);
        paths.entry(rank).or_default().push_str(&path_data(lane.path.iter().map(place)));
    }
    // A lane is drawn at its width where that can be seen.
    let wide = (3.2 * scale).clamp(0.35, 4.0);
    for (rank, data) in paths {
        let (color, width) = rank.checked_sub(1).map_or((UNUSED, wide * 0.7), |rank| (colors[rank], wide));
        sheet.raw(&format!(
            r#"<path d="{data}" fill="none" stroke="{color}" stroke-width="{width:.2}" stroke-linejoin="round"/>"#
        ));
    }
}

fn draw_legend(sheet: &mut Sheet, quantity: Quantity, y: f64) {
    let (bounds, colors) = quantity.classes();
    for (column, color) in colors.into_iter().enumerate() {
        let x = MARGIN + 34.0 * column as f64;
        sheet.rect(Frame { x, y, width: 33.0, height: 4.0 }, color);
        let words = match column {
            0 => format!("up to {}", bounds[0]),
            5 => format!("more than {}", bounds[4]),
            _ => format!("{} to {}", bounds[column - 1], bounds[column]),
        };
        sheet.label((x, y + 8.6), 3.2, Anchor::Start, INK, &words);
    }
    let x = MARGIN + 34.0 * 6.0 + 6.0;
    sheet.rect(Frame { x, y, width: 12.0, height: 4.0 }, UNUSED);
    sheet.label((x, y + 8.6), 3.2, Anchor::Start, FAINT, "nobody");
}

/// A bar of a round length.
fn draw_scale(sheet: &mut Sheet, frame: Frame, scale: f64) {
    let lengths = [20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0];
    let length = lengths.into_iter().find(|length| length * scale > 30.0).unwrap_or(10_000.0);
    let (right, y) = (frame.right(), frame.bottom() + 10.0);
    let left = right - length * scale;
    sheet.line([(left, y - 1.5), (left, y), (right, y), (right, y - 1.5)], INK, 0.4);
    let words = if length >= 1000.0 { format!("{} km", length / 1000.0) } else { format!("{length} m") };
    sheet.label((right, y + 4.6), 3.2, Anchor::End, INK, &words);
}
