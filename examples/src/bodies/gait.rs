//! The picture of a gait: which feet bear when, and how high the trunk is carried.

use simworld_physics::LEGS;
use simworld_physics::proving::Stance;
use svg::node::element::{Line, Polyline, Rectangle};

use super::chart::{paper, text};

/// The picture and its margins, points.
const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 380.0;
const LEFT: f64 = 110.0;
const RIGHT: f64 = 20.0;
/// Where the bars of the feet begin, and how far apart they are.
const FEET: f64 = 40.0;
const ROW: f64 = 34.0;
/// Where the field of the heights begins and ends, and the heights there, m.
const FIELD: [f64; 2] = [200.0, 340.0];
const HEIGHTS: [f64; 2] = [0.34, 0.26];
/// A foot with less load than this is in the air, N.
const CONTACT: f64 = 2.0;

/// Contacts of the feet as bars over time, and under them the height of the trunk, as an SVG.
pub fn gait_chart(stances: &[Stance]) -> String {
    let end = stances.last().map_or(1.0, |last| last.time.max(1e-3));
    let across = |time: f64| LEFT + (WIDTH - LEFT - RIGHT) * time / end;
    let down = |height: f64| {
        let share = (HEIGHTS[0] - height) / (HEIGHTS[0] - HEIGHTS[1]);
        FIELD[0] + (FIELD[1] - FIELD[0]) * share.clamp(0.0, 1.0)
    };
    let mut picture = paper(WIDTH, HEIGHT).add(text(LEFT, 24.0, "feet on the ground")).add(text(
        LEFT,
        FIELD[0] - 12.0,
        "height of the trunk, m",
    ));
    for (foot, name) in LEGS.into_iter().enumerate() {
        let top = FEET + ROW * foot as f64;
        picture = picture.add(text(10.0, top + 15.0, name));
        for (from, to) in spells(stances, foot) {
            let bar = Rectangle::new().set("x", across(from)).set("width", across(to) - across(from));
            picture = picture.add(bar.set("y", top).set("height", 20.0).set("fill", "#0072b2"));
        }
    }
    for height in [0.26, 0.28, 0.30, 0.32, 0.34] {
        let y = down(height);
        let line = Line::new().set("x1", LEFT).set("x2", WIDTH - RIGHT).set("y1", y).set("y2", y);
        picture = picture.add(line.set("stroke", "#cccccc")).add(text(60.0, y + 4.0, format!("{height:.2}")));
    }
    let points: Vec<String> = stances
        .iter()
        .map(|stance| format!("{:.1},{:.1}", across(stance.time), down(stance.height)))
        .collect();
    let line = Polyline::new().set("points", points.join(" ")).set("fill", "none").set("stroke", "#d55e00");
    picture = picture.add(line.set("stroke-width", 1.5));
    for second in 0..=end.floor() as u32 {
        let x = across(f64::from(second));
        picture = picture.add(text(x - 4.0, FIELD[1] + 22.0, format!("{second} s")));
    }
    picture.to_string()
}

/// From when to when a foot bears, s.
fn spells(stances: &[Stance], foot: usize) -> Vec<(f64, f64)> {
    let mut spells: Vec<(f64, f64)> = Vec::new();
    let mut bore = false;
    for stance in stances {
        let bears = stance.feet[foot] > CONTACT;
        match spells.last_mut() {
            Some(last) if bears && bore => last.1 = stance.time,
            _ if bears => spells.push((stance.time, stance.time)),
            _ => {}
        }
        bore = bears;
    }
    spells
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_spell_on_the_ground_is_a_bar() {
        let loads = [0.0, 30.0, 30.0, 0.0, 0.0, 30.0];
        let stances: Vec<Stance> = loads
            .iter()
            .enumerate()
            .map(|(look, load)| Stance { time: look as f64 * 0.5, feet: [*load, 0.0, 0.0, 0.0], height: 0.3 })
            .collect();
        assert_eq!(spells(&stances, 0), [(0.5, 1.0), (2.5, 2.5)]);
        assert!(spells(&stances, 1).is_empty());
        assert_eq!(gait_chart(&stances).matches("#0072b2").count(), 2);
    }
}
