//! The fundamental diagram: flow over density, minute by minute, beside the curve of the car-following model.

use super::Recorder;
use super::axes::Axes;
use super::sheet::{Anchor, FAINT, Frame, INK, Sheet};
use crate::vehicle::Idm;

const SHEET: (f64, f64) = (297.0, 210.0);
/// More dots are not told apart; so many are drawn at most.
const DOTS: usize = 20_000;
/// Length with which the curve is drawn: a car's, m.
const LENGTH: f64 = 4.5;

/// The diagram as an SVG text: minutes of lanes as dots, minutes of the whole network as rings, the model in equilibrium as a
/// curve.
pub fn fundamental_diagram(recorder: &Recorder, model: &Idm, title: &str) -> String {
    let (lanes, network) = (recorder.lane_minutes(), recorder.network_minutes());
    let subtitle = format!(
        "{} minutes of lanes, {} of the whole network; by Edie's definitions of density and flow",
        lanes.len(),
        network.len()
    );
    let mut sheet = Sheet::new(SHEET, title, &subtitle);
    let frame = Frame { x: 32.0, y: 32.0, width: 250.0, height: 158.0 };
    let axes = Axes::new(frame, (0.0, 160.0), (0.0, 2100.0));
    axes.draw(&mut sheet, "density, vehicles a kilometre and lane", "flow, vehicles an hour and lane");
    sheet.begin_clip("diagram", frame);
    let place = |point: &(f64, f64)| axes.place(point.0 * 1000.0, point.1 * 3600.0);
    sheet.raw(r##"<g fill="#2f6c8f" fill-opacity="0.28">"##);
    for point in lanes.iter().step_by(lanes.len().div_ceil(DOTS).max(1)) {
        let (x, y) = place(point);
        sheet.raw(&format!(r#"<circle cx="{x:.2}" cy="{y:.2}" r="0.55"/>"#));
    }
    sheet.end_group();
    sheet.line(curve(model).into_iter().map(|point| place(&point)), "#c8553d", 0.6);
    sheet.raw(&format!(r##"<g fill="#f2b84b" stroke="{INK}" stroke-width="0.3">"##));
    for point in network {
        let (x, y) = place(point);
        sheet.raw(&format!(r#"<circle cx="{x:.2}" cy="{y:.2}" r="1.2"/>"#));
    }
    sheet.end_group();
    sheet.end_group();
    let legend = [
        ("#2f6c8f", "a lane over a minute"),
        ("#f2b84b", "the network over a minute"),
        ("#c8553d", "the model in equilibrium, without junctions"),
    ];
    for (row, (ink, words)) in legend.into_iter().enumerate() {
        let y = frame.y + 6.0 + 5.4 * row as f64;
        sheet.raw(&format!(r#"<circle cx="{:.1}" cy="{y:.1}" r="1.3" fill="{ink}"/>"#, frame.right() - 74.0));
        sheet.label((frame.right() - 70.5, y + 1.1), 3.2, Anchor::Start, FAINT, words);
    }
    sheet.finish()
}

/// Density, vehicles a metre, and flow, vehicles a second, in equilibrium.
fn curve(model: &Idm) -> Vec<(f64, f64)> {
    const POINTS: u32 = 240;
    let speed = |index: u32| model.desired_speed * (1.0 - f64::from(index) / f64::from(POINTS));
    let point = |v: f64| {
        let density = 1.0 / (LENGTH + model.equilibrium_gap(v));
        (density, density * v)
    };
    // Crowded near the free speed, where the gap rises without bound.
    let fine = (0..40).map(|index| model.desired_speed * (1.0 - f64::from(index) * 1e-4));
    fine.chain((1..=POINTS).map(speed)).map(point).collect()
}
