//! Junctions by control delay: a bar each, the worst first, with their level of service.

use simworld_core::net::RoadNetwork;

use super::axes::Axes;
use super::sheet::{Anchor, FAINT, Frame, INK, Sheet};
use super::{JunctionDelay, LevelOfService, Recorder};

/// So many junctions have a bar.
const ROWS: usize = 24;
/// Fewer vehicles say too little.
const LEAST: u32 = 5;

/// The chart as an SVG text: the junctions with the longest mean control delay, and how many junctions are in each class.
pub fn service_chart(recorder: &Recorder, network: &RoadNetwork, title: &str) -> String {
    let mut busy: Vec<&JunctionDelay> = recorder
        .junctions()
        .iter()
        .filter(|junction| junction.vehicles >= LEAST && is_junction(network, junction))
        .collect();
    busy.sort_by(|a, b| b.mean().total_cmp(&a.mean()).then(a.junction.cmp(&b.junction)));
    let shown = &busy[..busy.len().min(ROWS)];
    let height = 74.0 + 6.2 * shown.len() as f64;
    let subtitle = format!(
        "mean control delay of the {} worst of {} junctions; classes of the Highway Capacity Manual",
        shown.len(),
        busy.len()
    );
    let mut sheet = Sheet::new((297.0, height), title, &subtitle);
    draw_classes(&mut sheet, &busy);
    let frame = Frame { x: 96.0, y: 46.0, width: 186.0, height: 6.2 * shown.len() as f64 };
    let most = shown.first().map_or(60.0, |worst| worst.mean().max(20.0) * 1.05);
    let axes = Axes::new(frame, (0.0, most), (0.0, shown.len() as f64));
    draw_frame(&mut sheet, &axes, most);
    for (row, junction) in shown.iter().enumerate() {
        let y = frame.y + 6.2 * row as f64;
        let (end, _) = axes.place(junction.mean(), 0.0);
        let bar = Frame { x: frame.x, y: y + 1.0, width: end - frame.x, height: 4.2 };
        sheet.rect(bar, junction.service().color());
        sheet.label((frame.x - 2.0, y + 4.3), 3.1, Anchor::End, INK, &name_of(network, junction));
        let words =
            format!("{}   {:.1} s, {} vehicles", junction.service(), junction.mean(), junction.vehicles);
        let inside = end - frame.x > 62.0;
        let (x, anchor, ink) =
            if inside { (end - 2.0, Anchor::End, "#ffffff") } else { (end + 2.0, Anchor::Start, INK) };
        sheet.label((x, y + 4.2), 2.9, anchor, ink, &words);
    }
    sheet.finish()
}

/// Bends and ends of roads are none.
fn is_junction(network: &RoadNetwork, junction: &JunctionDelay) -> bool {
    network.intersections[junction.junction.index()].roads.len() > 2
}

fn draw_frame(sheet: &mut Sheet, axes: &Axes, most: f64) {
    let Frame { y, height, .. } = axes.frame;
    let mut delay = 0.0;
    while delay <= most {
        let (x, _) = axes.place(delay, 0.0);
        sheet.line([(x, y), (x, y + height)], super::sheet::RULE, 0.2);
        sheet.label((x, y + height + 4.4), 3.0, Anchor::Middle, FAINT, &format!("{delay}"));
        delay += if most > 80.0 { 20.0 } else { 10.0 };
    }
    let (x, _) = axes.place(most * 0.5, 0.0);
    sheet.label((x, y + height + 10.0), 3.4, Anchor::Middle, INK, "mean control delay, s");
}

/// How many junctions are in each class.
fn draw_classes(sheet: &mut Sheet, busy: &[&JunctionDelay]) {
    for (column, class) in LevelOfService::ALL.into_iter().enumerate() {
        let count = busy.iter().filter(|junction| junction.service() == class).count();
        let x = 14.0 + 30.0 * column as f64;
        sheet.rect(Frame { x, y: 28.5, width: 6.0, height: 6.0 }, class.color());
        sheet.label((x + 8.0, 33.2), 4.2, Anchor::Start, INK, &format!("{class}  {count}"));
    }
}

/// The names of the streets that meet, or the number of the junction.
fn name_of(network: &RoadNetwork, junction: &JunctionDelay) -> String {
    let mut names: Vec<&str> = Vec::new();
    for road in &network.intersections[junction.junction.index()].roads {
        if let Some(name) = network.road_name(*road).filter(|name| !names.contains(name)) {
            names.push(name);
        }
    }
    let kind = if junction.has_signals { "signals" } else { "priority" };
    match names.as_slice() {
        [] => format!("junction {} ({kind})", junction.junction.0),
        [one] => format!("{one}, junction {} ({kind})", junction.junction.0),
        [one, other, ..] => format!("{one} / {other} ({kind})"),
    }
}
