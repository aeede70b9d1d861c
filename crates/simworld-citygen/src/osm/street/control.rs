//! Who may go at which junction: signals and stop signs stand where the map has them, elsewhere the right of way says.

use std::collections::BTreeMap;

use simworld_core::geometry::Point2;
use simworld_core::net::{Control, StreetPlan};

use crate::osm::place::Place;
use crate::osm::tags::Key;

/// A signal or sign nearer to a junction than this governs it, m: it may be drawn at the stop line.
const REACH: f64 = 30.0;

/// The controls of all junctions of three streets and more.
pub(super) fn controls(plan: &StreetPlan, place: &Place) -> BTreeMap<usize, Control> {
    let mut degrees = vec![0_u32; plan.nodes.len()];
    for street in &plan.streets {
        degrees[street.from] += 1;
        degrees[street.to] += 1;
    }
    let junctions = || (0..plan.nodes.len()).filter(|node| degrees[*node] >= 3);
    let mut controls: BTreeMap<usize, Control> = junctions().map(|node| (node, Control::Priority)).collect();
    let mut cells: Vec<((i64, i64), usize)> =
        junctions().map(|node| (cell(plan.nodes[node]), node)).collect();
    cells.sort_unstable();
    for (node, tags) in place.raw.tagged_nodes() {
        let sign = match () {
            () if tags.is(Key::Highway, "traffic_signals") => Control::Signals,
            () if tags.is(Key::Highway, "stop") => Control::Stop,
            () => continue,
        };
        let Some(at) = place.point(node) else { continue };
        if let Some(junction) = nearest(plan, &cells, at) {
            // Of both at one junction the signals say.
            let control = controls.entry(junction).or_insert(sign);
            if *control != Control::Signals {
                *control = sign;
            }
        }
    }
    controls
}

fn cell(point: Point2) -> (i64, i64) {
    ((point.x / REACH).floor() as i64, (point.y / REACH).floor() as i64)
}

/// The junction nearest to a point, if one is near.
fn nearest(plan: &StreetPlan, cells: &[((i64, i64), usize)], at: Point2) -> Option<usize> {
    let (column, row) = cell(at);
    let around = (column - 1..=column + 1).flat_map(|column| {
        let from = cells.partition_point(|entry| entry.0 < (column, row - 1));
        let to = cells.partition_point(|entry| entry.0 <= (column, row + 1));
        &cells[from..to]
    });
    let distance = |node: usize| (plan.nodes[node] - at).norm();
    let near = around.map(|(_, node)| (distance(*node), *node)).filter(|(distance, _)| *distance <= REACH);
    near.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))).map(|(_, node)| node)
}
