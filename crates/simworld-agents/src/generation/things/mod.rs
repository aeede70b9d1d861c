//! The things of the grammar, family by family.
#![expect(clippy::needless_update, reason = "rows that say everything look like the others")]

mod buildings;
mod containers;
mod furniture;
mod garden;
mod monuments;
mod nature;
mod play;
mod shelters;
mod street;
mod transport;

use simworld_core::scene::EntityKind;

use super::sculpt::Sculpt;
use super::stuff::Stuff;
use super::thing::Thing;

/// White paint.
const WHITE: [f32; 3] = [0.8, 0.8, 0.8];
/// Dark openings and iron.
const DARK: [f32; 3] = [0.012, 0.012, 0.014];

/// What most things are; each row says how it differs.
const PROP: Thing = Thing {
    names: &[],
    kind: EntityKind::Prop,
    size: [1.0; 3],
    stuff: Stuff::Wood,
    color: None,
    takes: &[],
    mass: [0.0; 2],
    make: |_, _| {},
};

/// All of them.
pub(super) fn all() -> impl Iterator<Item = &'static Thing> {
    [
        furniture::THINGS,
        containers::THINGS,
        street::THINGS,
        shelters::THINGS,
        garden::THINGS,
        monuments::THINGS,
        buildings::THINGS,
        play::THINGS,
        transport::THINGS,
        nature::THINGS,
    ]
    .into_iter()
    .flatten()
}

/// Where legs stand: in the corners if there are four, else around; one stands in the middle.
fn spots(count: usize, [x, y]: [f64; 2]) -> Vec<[f64; 2]> {
    match count {
        1 => vec![[0.0, 0.0]],
        4 => vec![[x, y], [-x, y], [-x, -y], [x, -y]],
        _ => around(count).map(|[cos, sin]| [x * cos, y * sin]).collect(),
    }
}

/// Directions around, the first to the front.
fn around(count: usize) -> impl Iterator<Item = [f64; 2]> {
    (0..count).map(move |k| {
        let (sin, cos) = simworld_core::ops::sin_cos(std::f64::consts::TAU * k as f64 / count as f64);
        [cos, sin]
    })
}

/// Evenly spread over a span around 0, from end to end; one is in the middle.
fn spread(count: usize, span: f64) -> impl Iterator<Item = f64> {
    let gap = span / count.saturating_sub(1).max(1) as f64;
    let start = if count > 1 { -span * 0.5 } else { 0.0 };
    (0..count).map(move |k| start + gap * k as f64)
}

/// A wheel that stands on its rim and rolls along x.
fn wheel(s: &mut Sculpt, [x, y]: [f64; 2], radius: f64, width: f64) {
    let quarter = std::f64::consts::FRAC_PI_2;
    s.placed([x, y, radius], [quarter, 0.0, 0.0], |s| {
        s.part("tyre", super::thing::Plan::own(Stuff::Rubber));
        s.pillar([0.0, 0.0, -width * 0.5], radius, width, 16);
        s.part("hub", super::thing::Plan::own(Stuff::Metal));
        s.pillar([0.0, 0.0, -width * 0.6], radius * 0.45, width * 1.2, 12);
    });
}
