//! Playgrounds and sports.

use super::{ALONG_X, Kit, Maker, SIDES, around, iron, rubber, spread, steel, white, wood};
use crate::asset::Material;
use crate::asset::sculpt::{Coating, Sculpt};

pub(super) const MAKERS: &[(&str, Maker)] = &[
    ("slide", slide),
    ("seesaw", seesaw),
    ("sandbox", sandbox),
    ("merry_go_round", merry_go_round),
    ("swing_set", swing_set),
    ("climbing_frame", climbing_frame),
    ("basketball_hoop", basketball_hoop),
    ("goal", goal),
    ("stage", stage),
    ("loudspeaker", loudspeaker),
];

/// A ladder behind, a stand between rails, and a chute that comes down in front.
fn slide(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let (stand, low) = (0.62 * h, 0.12 * h);
    let (from, to) = (-0.14 * l, 0.38 * l);
    let slope = crate::ops::atan2(stand - low, to - from);
    let (sin, _) = crate::ops::sin_cos(slope);
    let long = (stand - low) / sin;
    s.part("chute", kit.main());
    s.placed([from, 0.0, stand], [0.0, slope, 0.0], |s| {
        s.block([0.5 * long, 0.0, -0.03], [long, 0.6 * w, 0.03]);
        for y in SIDES.map(|side| side * 0.3 * w) {
            s.block([0.5 * long, y, -0.03], [long, 0.04, 0.16]);
        }
    });
    s.block([0.44 * l, 0.0, low - 0.03], [0.12 * l, 0.6 * w, 0.03]);
    for y in SIDES.map(|side| side * 0.3 * w) {
        s.block([0.44 * l, y, low - 0.03], [0.12 * l, 0.04, 0.12]);
    }
    s.part("frame", steel());
    s.block([-0.24 * l, 0.0, stand - 0.05], [0.2 * l, 0.86 * w, 0.05]);
    for y in SIDES.map(|side| side * 0.46 * w) {
        for x in [-0.34 * l, -0.14 * l] {
            s.bar([x, y, 0.0], [x, y, h], [0.025; 2], 8);
        }
        s.bar([-0.34 * l, y, 0.97 * h], [-0.14 * l, y, 0.97 * h], [0.022; 2], 6);
        s.bar([-0.34 * l, y, 0.8 * h], [-0.14 * l, y, 0.8 * h], [0.018; 2], 6);
        s.bar([-0.49 * l, 0.7 * y, 0.0], [-0.34 * l, 0.7 * y, stand], [0.022; 2], 6);
        s.bar([0.38 * l, 0.65 * y, 0.0], [0.38 * l, 0.65 * y, low], [0.022; 2], 6);
    }
    for k in 1..6_u8 {
        let share = f64::from(k) / 6.0;
        let x = (-0.49 + 0.15 * share) * l;
        s.bar([x, -0.32 * w, share * stand], [x, 0.32 * w, share * stand], [0.016; 2], 6);
    }
}

/// A board on a stand, with a seat and a grip at both ends.
fn seesaw(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("stand", iron());
    s.tapered([0.0; 3], [0.2 * l, w, 0.46 * h], [0.3, 0.5]);
    s.part("board", wood());
    s.block([0.0, 0.0, 0.46 * h], [0.98 * l, 0.4 * w, 0.08 * h]);
    s.part("seat", kit.main());
    for side in SIDES {
        s.block([side * 0.43 * l, 0.0, 0.54 * h], [0.14 * l, 0.8 * w, 0.06 * h]);
        let x = side * 0.33 * l;
        s.bar([x, 0.0, 0.5 * h], [x, 0.0, 0.97 * h], [0.018; 2], 6);
        s.bar([x, -0.4 * w, 0.97 * h], [x, 0.4 * w, 0.97 * h], [0.018; 2], 6);
    }
}

/// Four boards round sand.
fn sandbox(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let board = 0.06 * l;
    s.part("boards", kit.main());
    for side in SIDES {
        s.block([side * (0.5 * l - 0.5 * board), 0.0, 0.0], [board, w, 0.9 * h]);
        s.block([0.0, side * (0.5 * w - 0.5 * board), 0.0], [l - 2.0 * board, board, 0.9 * h]);
    }
    s.part("seats", kit.shade(0.8));
    for i in SIDES {
        for j in SIDES {
            s.block([i * 0.42 * l, j * 0.42 * w, 0.9 * h], [0.16 * l, 0.16 * w, 0.1 * h]);
        }
    }
    s.part("sand", Coating::of(Material::Sand, [0.55, 0.43, 0.25]));
    s.block([0.0; 3], [l - 2.0 * board, w - 2.0 * board, 0.55 * h]);
}

/// A disc with four bows that meet over its middle.
fn merry_go_round(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("foot", iron());
    s.pillar([0.0; 3], 0.22 * r, 0.2 * h, 12);
    s.part("disc", kit.main());
    s.pillar([0.0, 0.0, 0.2 * h], r, 0.1 * h, 24);
    s.part("bows", steel());
    s.pillar([0.0, 0.0, 0.3 * h], 0.06 * r, 0.6 * h, 8);
    for [x, y] in around(4) {
        let at = |reach: f64, z: f64| [x * reach * r, y * reach * r, z * h];
        s.tube(&[at(0.86, 0.28), at(0.84, 0.82), at(0.7, 0.96), at(0.0, 0.97)], [0.025; 2], 6);
    }
}

/// Two swings from a beam on trestles.
fn swing_set(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("frame", kit.main());
    for y in SIDES.map(|side| side * 0.48 * w) {
        for x in SIDES.map(|side| side * 0.48 * l) {
            s.bar([x, y, 0.0], [0.05 * x, y, 0.98 * h], [0.04; 2], 8);
        }
        s.bar([-0.26 * l, y, 0.45 * h], [0.26 * l, y, 0.45 * h], [0.025; 2], 6);
    }
    s.bar([0.0, -0.5 * w, 0.98 * h], [0.0, 0.5 * w, 0.98 * h], [0.045; 2], 8);
    for y in SIDES.map(|side| side * 0.22 * w) {
        s.part("chains", iron());
        for aside in SIDES.map(|side| side * 0.22) {
            s.bar([0.0, y + aside, 0.98 * h], [0.0, y + aside, 0.19 * h], [0.009; 2], 4);
        }
        s.part("seat", rubber());
        s.block([0.0, y, 0.18 * h], [0.18, 0.48, 0.03]);
    }
}

/// Posts and rungs three by three by three.
fn climbing_frame(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let thick = 0.025;
    let [x, y] = [0.5 * l - thick, 0.5 * w - thick];
    for i in [-1.0, 0.0, 1.0] {
        s.part("posts", kit.main());
        for j in [-1.0, 0.0, 1.0] {
            s.bar([i * x, j * y, 0.0], [i * x, j * y, h], [thick; 2], 8);
        }
        s.part("rungs", kit.shade(0.8));
        for z in [0.33, 0.66, 0.98].map(|share| share * h) {
            s.bar([i * x, -y, z], [i * x, y, z], [0.018; 2], 6);
            s.bar([-x, i * y, z], [x, i * y, z], [0.018; 2], 6);
        }
    }
}

/// A post behind, an arm, a board and a ring that hangs before it, 3.05 m up.
fn basketball_hoop(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let ring = 0.772 * h;
    s.part("foot", iron());
    s.block([-0.36 * l, 0.0, 0.0], [0.28 * l, 0.4 * w, 0.05 * h]);
    s.part("post", steel());
    s.bar([-0.4 * l, 0.0, 0.0], [-0.4 * l, 0.0, 0.84 * h], [0.07; 2], 10);
    s.bar([-0.42 * l, 0.0, 0.83 * h], [0.02 * l, 0.0, 0.86 * h], [0.05; 2], 8);
    s.part("board", white());
    s.block([0.02 * l, 0.0, 0.735 * h], [0.03, w, 0.265 * h]);
    s.part("frame", kit.main());
    let face = 0.02 * l + 0.015;
    for z in [0.79 * h, 0.9 * h] {
        s.block([face, 0.0, z], [0.012, 0.34 * w, 0.05]);
    }
    for y in SIDES.map(|side| side * 0.155 * w) {
        s.block([face, y, 0.79 * h], [0.012, 0.03 * w, 0.11 * h]);
    }
    s.part("ring", kit.main());
    s.bar([face, 0.0, ring], [face + 0.16, 0.0, ring], [0.03; 2], 6);
    s.hoop([0.5 * l - 0.24, 0.0, ring], 0.225, 0.015, 14);
    s.part("net", white());
    for [x, y] in around(8) {
        let at = |reach: f64, z: f64| [0.5 * l - 0.24 + reach * x, reach * y, z];
        s.bar(at(0.22, ring), at(0.13, ring - 0.4), [0.006; 2], 4);
    }
}

/// Two posts and a bar, with strings of the net down to the ground behind.
fn goal(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let (x, y, top) = (0.47 * l, 0.48 * w, 0.97 * h);
    s.part("frame", kit.main());
    for side in SIDES {
        s.bar([x, side * y, 0.0], [x, side * y, h], [0.05; 2], 8);
        s.bar([x, side * y, 0.03], [-x, side * y, 0.03], [0.03; 2], 6);
        s.bar([x, side * y, top], [-x, side * y, 0.03], [0.02; 2], 6);
    }
    s.bar([x, -0.5 * w, top], [x, 0.5 * w, top], [0.05; 2], 8);
    s.bar([-x, -y, 0.03], [-x, y, 0.03], [0.03; 2], 6);
    s.part("net", white());
    for side in spread(9, 1.8 * y) {
        s.bar([x, side, top], [-x, side, 0.03], [0.006; 2], 4);
    }
    for share in [0.25, 0.5, 0.75] {
        let (x, z) = (x * (1.0 - 2.0 * share), top * (1.0 - share));
        s.bar([x, -y, z], [x, y, z], [0.006; 2], 4);
    }
}

/// A deck on posts, with steps at its side.
fn stage(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let (middle, wide) = (0.06 * w, 0.88 * w);
    s.part("deck", wood());
    s.block([0.0, middle, 0.9 * h], [l, wide, 0.1 * h]);
    s.part("skirt", kit.main());
    s.block([0.46 * l, middle, 0.0], [0.02 * l, 0.96 * wide, 0.9 * h]);
    s.part("posts", steel());
    for x in spread(3, 0.88 * l) {
        for y in spread(4, 0.94 * wide) {
            s.bar([x, middle + y, 0.0], [x, middle + y, 0.9 * h], [0.04; 2], 8);
        }
    }
    s.part("steps", kit.main());
    for k in 0..3_u8 {
        let rise = f64::from(k + 1) * 0.25 * h;
        s.block([-0.3 * l, (-0.48 + 0.04 * f64::from(k)) * w, 0.0], [0.3 * l, 0.04 * w, rise]);
    }
}

/// A cabinet with two cones.
fn loudspeaker(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("cabinet", kit.main());
    s.block([-0.03 * l, 0.0, 0.02 * h], [0.94 * l, w, 0.98 * h]);
    for y in SIDES.map(|side| side * 0.4 * w) {
        s.block([-0.03 * l, y, 0.0], [0.8 * l, 0.1 * w, 0.02 * h]);
    }
    for (height, radius) in [(0.3, 0.36), (0.74, 0.22)] {
        s.placed([0.44 * l, 0.0, height * h], ALONG_X, |s| {
            s.part("surround", steel());
            s.pillar([0.0; 3], radius * w, 0.04 * l, 20);
            s.part("cone", rubber());
            s.pillar([0.0; 3], 0.86 * radius * w, 0.05 * l, 20);
            s.part("cap", steel());
            s.frustum([0.0, 0.0, 0.05 * l], [0.3 * radius * w, 0.1 * radius * w], 0.01 * l, 12);
        });
    }
}
