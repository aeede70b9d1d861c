//! What one carries.

use super::{ALONG_X, Kit, Maker, SIDES, around, dark, iron, leaf, plastic, steel, wheel, white, wood};
use crate::asset::Material;
use crate::asset::sculpt::{Coating, Hulls, Sculpt};

pub(super) const MAKERS: &[(&str, Maker)] = &[
    ("backpack", backpack),
    ("book", book),
    ("bouquet", bouquet),
    ("fire_extinguisher", fire_extinguisher),
    ("first_aid_kit", first_aid_kit),
    ("garbage_bag", garbage_bag),
    ("guitar", guitar),
    ("jerry_can", jerry_can),
    ("laptop", laptop),
    ("shopping_bag", shopping_bag),
    ("suitcase", suitcase),
    ("toolbox", toolbox),
    ("umbrella", umbrella),
];

fn paper(color: [f32; 3]) -> Coating {
    Coating::of(Material::Paper, color)
}

/// A sack with a flap, a pocket in front and two straps behind.
fn backpack(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("sack", kit.main());
    s.block([0.06 * l, 0.0, 0.0], [0.6 * l, 0.92 * w, 0.7 * h]);
    s.tapered([0.06 * l, 0.0, 0.7 * h], [0.6 * l, 0.92 * w, 0.22 * h], [0.6, 0.7]);
    s.part("pocket", kit.shade(0.75));
    s.block([0.42 * l, 0.0, 0.06 * h], [0.16 * l, 0.7 * w, 0.36 * h]);
    for y in SIDES.map(|side| side * 0.48 * w) {
        s.block([0.06 * l, y, 0.05 * h], [0.4 * l, 0.04 * w, 0.3 * h]);
    }
    s.part("straps", dark());
    for y in SIDES.map(|side| side * 0.24 * w) {
        let path = [[-0.22 * l, y, 0.76 * h], [-0.43 * l, y, 0.48 * h], [-0.22 * l, y, 0.1 * h]];
        s.tube(&path, [0.012; 2], 6);
    }
    let grip = [[0.06 * l, -0.12 * w, 0.9 * h], [0.06 * l, 0.0, 0.98 * h], [0.06 * l, 0.12 * w, 0.9 * h]];
    s.tube(&grip, [0.01; 2], 6);
}

/// Pages between two covers.
fn book(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("covers", kit.main());
    for z in [0.0, 0.88 * h] {
        s.block([0.0, 0.0, z], [l, w, 0.12 * h]);
    }
    s.block([0.0, -0.48 * w, 0.12 * h], [l, 0.04 * w, 0.76 * h]);
    s.part("pages", paper([0.7, 0.67, 0.58]));
    s.block([0.0, -0.01 * w, 0.12 * h], [0.96 * l, 0.9 * w, 0.76 * h]);
}

/// Flowers in a cone of paper.
fn bouquet(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("paper", paper([0.62, 0.55, 0.42]));
    s.frustum([0.0; 3], [0.36 * r, 0.78 * r], 0.56 * h, 10);
    s.part("leaves", leaf());
    s.frustum([0.0, 0.0, 0.56 * h], [0.78 * r, r], 0.08 * h, 10);
    s.part("flowers", kit.main());
    for [x, y] in around(6) {
        s.ball([0.62 * r * x, 0.62 * r * y, 0.72 * h], [0.32 * r, 0.32 * r, 0.12 * h], 4, 8);
    }
    s.part("middle", kit.shade(0.8));
    s.ball([0.0, 0.0, 0.86 * h], [0.36 * r, 0.36 * r, 0.14 * h], 4, 8);
}

/// A bottle with a lever and a hose.
fn fire_extinguisher(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("bottle", kit.main());
    let profile = [[0.84 * r, 0.0], [0.84 * r, 0.68 * h], [0.6 * r, 0.77 * h], [0.24 * r, 0.81 * h]];
    s.lathe([0.0; 3], &profile, 16, Hulls::Whole);
    s.part("valve", iron());
    s.pillar([0.0, 0.0, 0.81 * h], 0.24 * r, 0.1 * h, 8);
    s.part("lever", dark());
    s.block([0.1 * r, 0.0, 0.91 * h], [1.8 * r, 0.3 * r, 0.03 * h]);
    s.block([0.2 * r, 0.0, 0.96 * h], [1.5 * r, 0.3 * r, 0.04 * h]);
    let hose = [[0.0, 0.2 * r, 0.86 * h], [0.0, 0.9 * r, 0.8 * h], [0.0, 0.92 * r, 0.3 * h]];
    s.tube(&hose, [0.08 * r; 2], 6);
}

/// A case with a cross on its lid and two clasps.
fn first_aid_kit(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("case", kit.main());
    s.block([0.0; 3], [l, 0.96 * w, 0.5 * h]);
    s.part("seam", dark());
    s.block([0.0, 0.0, 0.5 * h], [0.97 * l, 0.92 * w, 0.03 * h]);
    s.part("lid", kit.shade(0.95));
    s.tapered([0.0, 0.0, 0.53 * h], [l, 0.96 * w, 0.4 * h], [0.94, 0.92]);
    s.part("cross", white());
    s.block([0.0, 0.0, 0.93 * h], [0.13, 0.04, 0.07 * h]);
    s.block([0.0, 0.0, 0.93 * h], [0.04, 0.13, 0.07 * h]);
    s.part("clasps", steel());
    for x in SIDES.map(|side| side * 0.28 * l) {
        s.block([x, -0.48 * w, 0.4 * h], [0.1 * l, 0.04 * w, 0.26 * h]);
    }
    s.block([0.0, 0.49 * w, 0.42 * h], [0.34 * l, 0.02 * w, 0.2 * h]);
}

/// A tied sack.
fn garbage_bag(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("sack", kit.main());
    let profile =
        [[0.72 * r, 0.0], [r, 0.24 * h], [0.94 * r, 0.52 * h], [0.46 * r, 0.78 * h], [0.14 * r, 0.86 * h]];
    s.lathe([0.0; 3], &profile, 10, Hulls::Whole);
    s.part("neck", kit.shade(0.8));
    s.frustum([0.0, 0.0, 0.86 * h], [0.14 * r, 0.34 * r], 0.14 * h, 8);
}

/// It lies on its back, the head to the front.
fn guitar(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let (thick, top) = (0.68 * h, 0.72 * h);
    let bouts = [([-0.27 * l, 0.0], 0.5 * w), ([0.0, 0.0], 0.38 * w)];
    s.part("body", kit.main());
    for ([x, y], radius) in bouts {
        s.pillar([x, y, 0.0], radius, thick, 24);
    }
    s.block([-0.12 * l, 0.0, 0.0], [0.2 * l, 0.62 * w, thick]);
    s.part("top", Coating::of(Material::Wood, [0.55, 0.36, 0.15]));
    for ([x, y], radius) in bouts {
        s.pillar([x, y, thick], 0.96 * radius, top - thick, 24);
    }
    s.block([-0.12 * l, 0.0, thick], [0.2 * l, 0.6 * w, top - thick]);
    s.part("hole", dark());
    s.pillar([-0.07 * l, 0.0, top], 0.13 * w, 0.01 * h, 16);
    s.part("neck", wood());
    s.block([0.22 * l, 0.0, top], [0.46 * l, 0.15 * w, 0.18 * h]);
    s.block([0.47 * l, 0.0, top], [0.06 * l, 0.22 * w, 0.22 * h]);
    s.block([-0.32 * l, 0.0, top], [0.03 * l, 0.4 * w, 0.14 * h]);
    s.part("strings", steel());
    for y in [-0.05, -0.017, 0.017, 0.05].map(|share| share * w) {
        s.bar([-0.31 * l, y, 0.97 * h], [0.45 * l, y, 0.97 * h], [0.03 * h; 2], 4);
    }
}

/// A canister with three grips and a spout.
fn jerry_can(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("can", kit.main());
    s.block([0.0; 3], [0.9 * l, w, 0.74 * h]);
    s.tapered([0.0, 0.0, 0.74 * h], [0.9 * l, w, 0.1 * h], [0.7, 0.92]);
    // Stamped on both sides.
    s.part("stamp", kit.shade(0.85));
    for x in SIDES.map(|side| side * 0.46 * l) {
        s.block([x, 0.0, 0.12 * h], [0.08 * l, 0.66 * w, 0.5 * h]);
    }
    s.part("grips", kit.shade(0.8));
    for y in [-0.3 * w, 0.1 * w] {
        s.block([0.0, y, 0.82 * h], [0.56 * l, 0.05 * w, 0.13 * h]);
    }
    for x in [-0.22 * l, 0.0, 0.22 * l] {
        s.bar([x, -0.32 * w, 0.95 * h], [x, 0.12 * w, 0.95 * h], [0.045 * h; 2], 6);
    }
    s.part("spout", iron());
    s.frustum([0.0, 0.33 * w, 0.8 * h], [0.14 * w, 0.11 * w], 0.19 * h, 10);
}

/// A laptop that is closed.
fn laptop(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("base", kit.shade(0.8));
    s.block([0.0, 0.0, 0.08 * h], [l, w, 0.4 * h]);
    s.part("gap", dark());
    s.block([-0.01 * l, 0.0, 0.48 * h], [0.96 * l, 0.96 * w, 0.08 * h]);
    s.part("lid", kit.main());
    s.block([0.0, 0.0, 0.56 * h], [l, w, 0.44 * h]);
    s.part("feet", dark());
    for x in SIDES.map(|side| side * 0.42 * l) {
        for y in SIDES.map(|side| side * 0.42 * w) {
            s.block([x, y, 0.0], [0.06 * l, 0.06 * w, 0.08 * h]);
        }
    }
}

/// A full bag of paper with two cords.
fn shopping_bag(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("bag", kit.main());
    s.block([0.0; 3], [l, w, 0.74 * h]);
    s.part("inside", dark());
    s.block([0.0, 0.0, 0.74 * h], [0.94 * l, 0.88 * w, 0.005 * h]);
    s.part("bread", Coating::of(Material::Paper, [0.45, 0.24, 0.08]));
    s.bar([-0.3 * l, 0.0, 0.6 * h], [-0.36 * l, 0.0, 0.94 * h], [0.028, 0.02], 8);
    s.part("fruit", plastic([0.55, 0.2, 0.03]));
    s.ball([0.02 * l, 0.02 * w, 0.75 * h], [0.045, 0.045, 0.045], 6, 8);
    s.part("lettuce", leaf());
    s.lump([0.28 * l, 0.0, 0.75 * h], [0.06, 0.06, 0.05], 5, 8);
    s.part("cords", kit.shade(0.6));
    for y in SIDES.map(|side| side * 0.46 * w) {
        let path = [[-0.2, 0.7], [-0.15, 0.93], [0.0, 0.985], [0.15, 0.93], [0.2, 0.7]];
        s.tube(&path.map(|[x, z]| [x * l, y, z * h]), [0.005; 2], 5);
    }
}

/// A shell with ribs on four wheels, its handle drawn out.
fn suitcase(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("shell", kit.main());
    s.block([0.0, 0.0, 0.07 * h], [0.94 * l, w, 0.71 * h]);
    s.part("ribs", kit.shade(0.75));
    for y in [-0.33, -0.11, 0.11, 0.33].map(|share| share * w) {
        s.block([0.0, y, 0.12 * h], [l, 0.1 * w, 0.6 * h]);
    }
    s.part("seam", dark());
    s.block([0.0, 0.0, 0.42 * h], [0.96 * l, 1.002 * w, 0.015 * h]);
    s.part("handle", steel());
    for y in SIDES.map(|side| side * 0.18 * w) {
        s.bar([-0.34 * l, y, 0.76 * h], [-0.34 * l, y, 0.97 * h], [0.009; 2], 6);
    }
    s.part("grip", dark());
    s.block([-0.34 * l, 0.0, 0.96 * h], [0.12 * l, 0.48 * w, 0.04 * h]);
    for x in SIDES.map(|side| side * 0.36 * l) {
        for y in SIDES.map(|side| side * 0.4 * w) {
            wheel(s, [x, y], 0.042 * h, 0.06 * w);
        }
    }
}

/// A case with a pitched lid and a grip along it.
fn toolbox(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("case", kit.main());
    s.block([0.0; 3], [l, w, 0.56 * h]);
    s.part("lid", kit.shade(0.85));
    s.tapered([0.0, 0.0, 0.56 * h], [l, w, 0.22 * h], [0.98, 0.4]);
    s.part("grip", iron());
    for x in SIDES.map(|side| side * 0.28 * l) {
        s.bar([x, 0.0, 0.76 * h], [x, 0.0, 0.95 * h], [0.008; 2], 6);
    }
    s.placed([-0.3 * l, 0.0, 0.95 * h], ALONG_X, |s| s.pillar([0.0; 3], 0.05 * h, 0.6 * l, 10));
}

/// It is closed, and stands on its grip.
fn umbrella(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("grip", wood());
    s.pillar([0.0; 3], 0.4 * r, 0.16 * h, 10);
    s.part("stick", steel());
    s.pillar([0.0, 0.0, 0.16 * h], 0.12 * r, 0.1 * h, 8);
    s.part("canopy", kit.main());
    let profile = [[0.7 * r, 0.26 * h], [r, 0.34 * h], [0.9 * r, 0.5 * h], [0.3 * r, 0.92 * h]];
    s.lathe([0.0; 3], &profile, 10, Hulls::Whole);
    s.part("strap", dark());
    s.pillar([0.0, 0.0, 0.44 * h], r, 0.02 * h, 10);
    s.part("tip", steel());
    s.frustum([0.0, 0.0, 0.92 * h], [0.16 * r, 0.06 * r], 0.08 * h, 8);
}
