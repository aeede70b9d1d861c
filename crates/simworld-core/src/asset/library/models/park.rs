//! Gardens and parks: what grows, lies and stands there.

use super::{Kit, Maker, SIDES, SIDEWAYS, around, dark, iron, leaf, plastic, steel, wood};
use crate::asset::Material;
use crate::asset::sculpt::{Coating, Hulls, Sculpt};

pub(super) const MAKERS: &[(&str, Maker)] = &[
    ("barbecue", barbecue),
    ("beehive", beehive),
    ("boulder", boulder),
    ("doghouse", doghouse),
    ("fallen_log", fallen_log),
    ("flower_pot", flower_pot),
    ("hay_bale", hay_bale),
    ("tree_stump", tree_stump),
];

/// Cut wood.
fn heartwood() -> Coating {
    Coating::of(Material::Wood, [0.42, 0.3, 0.16])
}

/// A kettle with a lid on a trolley with two boards at its sides.
fn barbecue(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("legs", iron());
    for x in SIDES.map(|side| side * 0.38 * l) {
        for y in SIDES.map(|side| side * 0.26 * w) {
            s.bar([x, y, 0.0], [x, y, 0.6 * h], [0.018; 2], 6);
        }
    }
    s.block([0.0, 0.0, 0.18 * h], [0.8 * l, 0.56 * w, 0.02]);
    s.part("kettle", kit.main());
    s.placed([0.0, 0.0, 0.8 * h], [std::f64::consts::PI, 0.0, 0.0], |s| {
        s.tapered([0.0; 3], [0.96 * l, 0.58 * w, 0.22 * h], [0.8, 0.9]);
    });
    s.part("lid", kit.main());
    // Half of a cylinder along y, as a bow that is filled but for a hair.
    s.placed([0.0, 0.0, 0.81 * h], SIDEWAYS, |s| {
        s.bow([0.0; 3], [0.01, 0.34 * l], 0.58 * w, [0.0, std::f64::consts::PI]);
    });
    s.part("grip", wood());
    s.bar([0.4 * l, -0.14 * w, 0.88 * h], [0.4 * l, 0.14 * w, 0.88 * h], [0.018; 2], 8);
    s.part("boards", wood());
    for y in SIDES.map(|side| side * 0.4 * w) {
        s.block([0.0, y, 0.76 * h], [0.7 * l, 0.2 * w, 0.025]);
    }
}

/// Three boxes on four feet under a lid of sheet, with a slit in front.
fn beehive(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("feet", wood());
    for x in SIDES.map(|side| side * 0.36 * l) {
        for y in SIDES.map(|side| side * 0.36 * w) {
            s.block([x, y, 0.0], [0.1 * l, 0.1 * w, 0.16 * h]);
        }
    }
    for (level, tone) in [(0.16, 0.9), (0.4, 1.0), (0.64, 0.94)] {
        s.part("box", kit.shade(tone));
        s.block([0.0, 0.0, level * h], [0.86 * l, 0.86 * w, 0.23 * h]);
        for y in SIDES.map(|side| side * 0.44 * w) {
            s.block([0.0, y, (level + 0.13) * h], [0.3 * l, 0.03 * w, 0.05 * h]);
        }
    }
    s.part("slit", dark());
    s.block([0.43 * l, 0.0, 0.18 * h], [0.02 * l, 0.5 * w, 0.03 * h]);
    s.part("board", wood());
    s.block([0.46 * l, 0.0, 0.15 * h], [0.08 * l, 0.7 * w, 0.015 * h]);
    s.part("lid", steel());
    s.tapered([0.0, 0.0, 0.87 * h], [l, w, 0.13 * h], [0.96, 0.96]);
}

/// A rock of two lumps with a flat bed, so that it stays where it lies.
fn boulder(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("rock", kit.main());
    let lump = |s: &mut Sculpt, [x, y]: [f64; 2], turn: f64, size: f64, profile: &[[f64; 2]]| {
        s.placed([x, y, 0.0], [0.0, 0.0, turn], |s| {
            let rings: Vec<[f64; 2]> = profile.iter().map(|[r, z]| [r * size, z * h]).collect();
            s.lathe([0.0; 3], &rings, 6, Hulls::Whole);
        });
    };
    lump(s, [-0.08 * l, 0.0], 0.3, 0.42 * w, &[[0.86, 0.0], [1.0, 0.3], [0.82, 0.72], [0.34, 1.0]]);
    s.part("shoulder", kit.shade(0.88));
    lump(s, [0.16 * l, 0.06 * w], 0.85, 0.36 * w, &[[0.9, 0.0], [1.0, 0.24], [0.7, 0.56], [0.3, 0.7]]);
}

/// A hut with a pitched roof and a hole in front.
fn doghouse(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("walls", kit.main());
    s.block([-0.02 * l, 0.0, 0.0], [0.88 * l, 0.84 * w, 0.56 * h]);
    s.tapered([-0.02 * l, 0.0, 0.56 * h], [0.88 * l, 0.84 * w, 0.38 * h], [1.0, 0.0]);
    s.part("roof", kit.shade(0.55));
    // Two slopes, each a slab over the gable.
    let rise = crate::ops::atan2(0.42 * h, 0.5 * w);
    let (_, cos) = crate::ops::sin_cos(rise);
    for side in SIDES {
        s.placed([0.0, 0.0, 0.965 * h], [-side * rise, 0.0, 0.0], |s| {
            s.block([0.0, side * 0.24 * w / cos, -0.03], [l, 0.5 * w / cos, 0.03]);
        });
    }
    s.part("hole", dark());
    let arch = [[-0.16, 0.04], [0.16, 0.04], [0.16, 0.36], [0.1, 0.5], [-0.1, 0.5], [-0.16, 0.36]];
    s.panel(&arch.map(|[y, z]| [y * w, z * h]), 0.41 * l, 0.02 * l);
}

/// A trunk with the stub of a bough.
fn fallen_log(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("bark", kit.main());
    s.bar([-0.49 * l, 0.0, 0.5 * h], [0.49 * l, 0.0, 0.47 * h], [0.5 * h, 0.47 * h], 12);
    s.bar([0.16 * l, 0.0, 0.55 * h], [0.22 * l, 0.44 * w, 0.94 * h], [0.09, 0.06], 8);
    s.part("cut", heartwood());
    s.bar([-0.5 * l, 0.0, 0.5 * h], [0.5 * l, 0.0, 0.47 * h], [0.41 * h, 0.38 * h], 12);
}

/// A pot with a rim, earth and a plant in bloom.
fn flower_pot(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("pot", kit.main());
    s.frustum([0.0; 3], [0.62 * r, 0.88 * r], 0.52 * h, 16);
    s.pillar([0.0, 0.0, 0.52 * h], r, 0.12 * h, 16);
    s.part("earth", Coating::of(Material::Soil, [0.07, 0.045, 0.03]));
    s.pillar([0.0, 0.0, 0.64 * h], 0.84 * r, 0.01 * h, 16);
    s.part("leaves", leaf());
    s.ball([0.0, 0.0, 0.76 * h], [0.7 * r, 0.7 * r, 0.14 * h], 6, 10);
    s.part("bloom", plastic([0.6, 0.12, 0.2]));
    for (rank, [x, y]) in around(5).enumerate() {
        let reach = if rank % 2 == 0 { 0.5 } else { 0.34 };
        s.ball([x * reach * r, y * reach * r, 0.88 * h], [0.2 * r, 0.2 * r, 0.1 * h], 4, 6);
    }
    s.ball([0.0, 0.0, 0.92 * h], [0.2 * r, 0.2 * r, 0.08 * h], 4, 6);
}

/// A round bale that stands on its end, tied three times.
fn hay_bale(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("straw", kit.main());
    let profile = [[0.94 * r, 0.0], [0.99 * r, 0.04 * h], [0.99 * r, 0.96 * h], [0.94 * r, h]];
    s.lathe([0.0; 3], &profile, 20, Hulls::Whole);
    s.part("twine", kit.shade(0.6));
    for z in [0.2, 0.5, 0.8] {
        s.pillar([0.0, 0.0, z * h], r, 0.015 * h, 20);
    }
}

/// What is left of a trunk, wider at its foot.
fn tree_stump(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("bark", kit.main());
    let profile = [[r, 0.0], [0.84 * r, 0.25 * h], [0.78 * r, 0.97 * h]];
    s.lathe([0.0; 3], &profile, 12, Hulls::Segments);
    s.part("cut", heartwood());
    s.pillar([0.0, 0.0, 0.97 * h], 0.68 * r, 0.03 * h, 12);
}
