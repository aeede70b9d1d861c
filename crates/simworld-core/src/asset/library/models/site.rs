//! What stands and lies on building sites and streets: ladders, scaffolds, stacks, walls, lids.

use super::{ALONG_X, Kit, Maker, SIDES, dark, iron, spread, steel, wood};
use crate::asset::sculpt::Sculpt;

pub(super) const MAKERS: &[(&str, Maker)] = &[
    ("ladder", ladder),
    ("scaffold", scaffold),
    ("cement_bags", cement_bags),
    ("pipe_stack", pipe_stack),
    ("brick_wall", brick_wall),
    ("retaining_wall", retaining_wall),
    ("manhole_cover", manhole_cover),
    ("storm_drain", storm_drain),
    ("solar_panel", solar_panel),
];

/// Stones of a wall differ.
const TONES: [f32; 5] = [1.0, 0.84, 0.94, 0.76, 0.89];

/// Steps that lean against a stay behind them.
fn ladder(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("rails", kit.main());
    for y in SIDES {
        s.bar([0.46 * l, 0.46 * y * w, 0.0], [0.03 * l, 0.36 * y * w, 0.98 * h], [0.02; 2], 6);
    }
    s.part("stay", kit.shade(0.7));
    for y in SIDES {
        s.bar([-0.46 * l, 0.46 * y * w, 0.0], [-0.03 * l, 0.36 * y * w, 0.98 * h], [0.016; 2], 6);
    }
    s.bar([-0.34 * l, -0.43 * w, 0.27 * h], [-0.34 * l, 0.43 * w, 0.27 * h], [0.012; 2], 4);
    s.part("steps", kit.main());
    for k in 1..10_u8 {
        let share = f64::from(k) / 10.0;
        let (x, half) = ((0.46 - 0.43 * share) * l, (0.46 - 0.1 * share) * w);
        s.block([x, 0.0, share * 0.98 * h - 0.02], [0.09, 2.0 * half, 0.02]);
    }
    s.block([0.0, 0.0, 0.98 * h], [0.3 * l, 0.8 * w, 0.02 * h]);
}

/// Four standards, two decks and the rails round them.
fn scaffold(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let (x, y) = (0.46 * l, 0.48 * w);
    s.part("standards", kit.main());
    for [i, j] in [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]] {
        s.bar([i * x, j * y, 0.0], [i * x, j * y, h], [0.03; 2], 8);
    }
    for height in [0.24, 0.48, 0.62, 0.75, 0.97].map(|share| share * h) {
        for side in SIDES {
            s.bar([side * x, -0.5 * w, height], [side * x, 0.5 * w, height], [0.024; 2], 6);
            s.bar([-0.5 * l, side * y, height], [0.5 * l, side * y, height], [0.024; 2], 6);
        }
    }
    s.bar([-x, -y, 0.02 * h], [-x, y, 0.47 * h], [0.02; 2], 6);
    s.part("decks", wood());
    for height in [0.25, 0.49].map(|share| share * h) {
        for x in [-0.24 * l, 0.24 * l] {
            s.block([x, 0.0, height], [0.44 * l, 0.94 * w, 0.045]);
        }
    }
}

/// Bags in layers crosswise, each rounded by what is above it.
fn cement_bags(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let thick = 0.25 * h;
    for layer in 0..4_u8 {
        let z = thick * f64::from(layer);
        for (rank, side) in SIDES.into_iter().enumerate() {
            let (at, size) = if layer % 2 == 0 {
                ([side * 0.25 * l, 0.0, z], [0.5 * l, w])
            } else {
                ([0.0, side * 0.25 * w, z], [l, 0.5 * w])
            };
            s.part("bag", kit.shade(TONES[(usize::from(layer) * 2 + rank) % 5]));
            // From the floor to the middle it grows wider, from there to the top narrower.
            let [x, y, z] = at;
            s.placed([x, y, z + 0.5 * thick], [std::f64::consts::PI, 0.0, 0.0], |s| {
                s.tapered([0.0; 3], [size[0], size[1], 0.5 * thick], [0.9, 0.86]);
            });
            s.tapered([x, y, z + 0.5 * thick], [size[0], size[1], 0.5 * thick], [0.9, 0.86]);
        }
    }
}

/// Three pipes and two in the hollows between them.
fn pipe_stack(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let radius = w / 6.0;
    let upper = h - radius;
    let row = |count: u32, z: f64| spread(count, 2.0 * radius * f64::from(count - 1)).map(move |y| [y, z]);
    for [y, z] in row(3, radius).chain(row(2, upper)) {
        s.part("pipe", kit.main());
        s.bar([-0.49 * l, y, z], [0.49 * l, y, z], [radius; 2], 16);
        s.part("bore", dark());
        s.bar([-0.5 * l, y, z], [0.5 * l, y, z], [0.74 * radius; 2], 12);
    }
    // Wedges keep the lowest from rolling away.
    s.part("wedge", wood());
    for x in [-0.3 * l, 0.3 * l] {
        s.block([x, 0.0, 0.0], [0.08, w, 0.3 * radius]);
    }
}

/// A wall between two piers under a coping.
fn brick_wall(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("wall", kit.main());
    s.block([0.0; 3], [0.7 * l, 0.96 * w, 0.92 * h]);
    s.part("pier", kit.shade(0.9));
    for y in SIDES.map(|side| side * 0.45 * w) {
        s.block([0.0, y, 0.0], [0.94 * l, 0.1 * w, 0.92 * h]);
    }
    s.part("plinth", kit.shade(0.8));
    s.block([0.0; 3], [0.86 * l, 0.99 * w, 0.1 * h]);
    s.part("coping", kit.shade(0.7));
    s.tapered([0.0, 0.0, 0.92 * h], [l, w, 0.08 * h], [0.6, 1.0]);
}

/// Four courses of stones, each a little behind the one below it; what is behind it reaches to the top.
fn retaining_wall(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    for course in 0..4_u32 {
        let back = 0.04 * l * f64::from(course);
        // Joints lie over the middles of stones.
        let count = 5 - course % 2;
        let long = w / f64::from(count);
        for (rank, y) in (0..count).zip(spread(count, w - long)) {
            s.part("stone", kit.shade(TONES[(course as usize * 3 + rank as usize) % 5]));
            let height = 0.25 * h;
            s.tapered(
                [-0.5 * back, y, height * f64::from(course)],
                [l - back, long, height],
                [0.98, if course == 3 { 1.0 } else { 0.97 }],
            );
        }
    }
}

/// A cast lid with rings.
fn manhole_cover(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    s.part("frame", kit.shade(0.7));
    s.pillar([0.0; 3], 0.5 * l, 0.8 * h, 24);
    s.part("lid", kit.main());
    s.pillar([0.0, 0.0, 0.8 * h], 0.44 * l, 0.1 * h, 24);
    for y in [-0.24, -0.08, 0.08, 0.24].map(|share| share * l) {
        s.block([0.0, y, 0.9 * h], [0.5 * l, 0.05 * l, 0.1 * h]);
    }
}

/// A grate in a frame.
fn storm_drain(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("pit", dark());
    s.block([0.0; 3], [l, w, 0.7 * h]);
    s.part("frame", kit.shade(0.8));
    for side in SIDES {
        s.block([0.0, side * 0.46 * w, 0.7 * h], [l, 0.08 * w, 0.3 * h]);
        s.block([side * 0.46 * l, 0.0, 0.7 * h], [0.08 * l, 0.84 * w, 0.3 * h]);
    }
    s.part("bars", kit.main());
    for y in spread(6, 0.6 * w) {
        s.block([0.0, y, 0.7 * h], [0.84 * l, 0.07 * w, 0.3 * h]);
    }
}

/// A panel that faces forward and up, on four legs.
fn solar_panel(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let slope = crate::ops::atan2(0.78 * h, l);
    let (sin, cos) = crate::ops::sin_cos(slope);
    let long = l / cos;
    s.placed([0.0, 0.0, 0.57 * h], [0.0, slope, 0.0], |s| {
        s.part("cells", kit.main());
        s.block([0.0, 0.0, 0.0], [0.97 * long, 0.98 * w, 0.03]);
        s.part("frame", steel());
        for side in SIDES {
            s.block([0.0, side * 0.49 * w, -0.005], [0.98 * long, 0.02 * w, 0.04]);
            s.block([side * 0.48 * long, 0.0, -0.005], [0.02 * long, 0.96 * w, 0.04]);
        }
        for y in [-0.245 * w, 0.0, 0.245 * w] {
            s.block([0.0, y, 0.03], [0.94 * long, 0.012, 0.002]);
        }
    });
    s.part("legs", iron());
    for x in [-0.36 * l, 0.36 * l] {
        let top = 0.57 * h - x * sin / cos;
        for y in SIDES.map(|side| side * 0.38 * w) {
            s.bar([x, y, 0.0], [x, y, top], [0.02; 2], 6);
        }
    }
    s.placed([0.0, 0.0, 0.03], ALONG_X, |s| {
        for y in SIDES.map(|side| side * 0.38 * w) {
            s.pillar([0.0, y, -0.4 * l], 0.02, 0.8 * l, 6);
        }
    });
}
