//! What is pushed and pulled by hand.

use super::{ALONG_Y, Kit, Maker, SIDES, dark, iron, red, steel, wheel, wood};
use crate::asset::sculpt::Sculpt;

pub(super) const MAKERS: &[(&str, Maker)] = &[
    ("hand_cart", hand_cart),
    ("hand_truck", hand_truck),
    ("shopping_cart", shopping_cart),
    ("wheelbarrow", wheelbarrow),
    ("cable_drum", cable_drum),
];

/// A tray on two wheels, which stands on its props; one pulls it by a bow behind.
fn hand_cart(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("tray", kit.main());
    s.trough([0.12 * l, 0.0, 0.4 * h], [0.76 * l, 0.74 * w, 0.4 * h], 0.03, 0.05);
    s.part("handle", kit.shade(0.7));
    for y in SIDES.map(|side| side * 0.3 * w) {
        s.bar([-0.24 * l, y, 0.5 * h], [-0.48 * l, y, 0.97 * h], [0.022; 2], 6);
        s.bar([-0.18 * l, y, 0.4 * h], [-0.2 * l, y, 0.0], [0.02; 2], 6);
    }
    s.bar([-0.48 * l, -0.34 * w, 0.97 * h], [-0.48 * l, 0.34 * w, 0.97 * h], [0.022; 2], 6);
    s.part("axle", iron());
    s.bar([0.16 * l, -0.42 * w, 0.3 * h], [0.16 * l, 0.42 * w, 0.3 * h], [0.02; 2], 6);
    for y in SIDES.map(|side| side * 0.45 * w) {
        wheel(s, [0.16 * l, y], 0.3 * h, 0.08 * w);
    }
}

/// Two uprights with rungs on two wheels, and a plate that goes under what is carried.
fn hand_truck(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("frame", kit.main());
    s.block([0.22 * l, 0.0, 0.0], [0.56 * l, 0.86 * w, 0.02]);
    for y in SIDES.map(|side| side * 0.32 * w) {
        s.bar([-0.04 * l, y, 0.0], [-0.3 * l, y, 0.97 * h], [0.018; 2], 8);
    }
    for (share, height) in [(0.3, 0.26), (0.55, 0.5), (0.8, 0.74)] {
        let x = (-0.04 - 0.26 * share) * l;
        s.bar([x, -0.32 * w, height * h], [x, 0.32 * w, height * h], [0.012; 2], 6);
    }
    s.part("grip", dark());
    s.bar([-0.3 * l, -0.4 * w, 0.97 * h], [-0.3 * l, 0.4 * w, 0.97 * h], [0.022; 2], 8);
    for y in SIDES.map(|side| side * 0.44 * w) {
        wheel(s, [-0.24 * l, y], 0.24 * l, 0.1 * w);
    }
}

/// A basket on a frame with four castors; one stands behind it.
fn shopping_cart(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("basket", kit.main());
    s.trough([0.06 * l, 0.0, 0.46 * h], [0.88 * l, w, 0.42 * h], 0.015, 0.02);
    s.part("frame", steel());
    for y in SIDES.map(|side| side * 0.4 * w) {
        s.bar([0.42 * l, y, 0.14 * h], [-0.4 * l, y, 0.14 * h], [0.014; 2], 6);
        s.bar([-0.4 * l, y, 0.14 * h], [-0.46 * l, y, 0.96 * h], [0.014; 2], 6);
        s.bar([0.4 * l, y, 0.14 * h], [0.24 * l, y, 0.47 * h], [0.014; 2], 6);
    }
    s.part("handle", red());
    s.bar([-0.46 * l, -0.46 * w, 0.96 * h], [-0.46 * l, 0.46 * w, 0.96 * h], [0.02; 2], 8);
    for x in [-0.38 * l, 0.42 * l] {
        for y in SIDES.map(|side| side * 0.4 * w) {
            wheel(s, [x, y], 0.07 * h, 0.05 * w);
        }
    }
}

/// A tray between two poles that begin at the wheel in front.
fn wheelbarrow(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("tray", kit.main());
    s.trough([0.06 * l, 0.0, 0.46 * h], [0.56 * l, w, 0.54 * h], 0.025, 0.03);
    s.part("poles", wood());
    for y in SIDES {
        s.bar([0.36 * l, 0.08 * y * w, 0.28 * h], [-0.5 * l, 0.42 * y * w, 0.72 * h], [0.02; 2], 6);
    }
    s.part("legs", iron());
    for y in SIDES.map(|side| side * 0.3 * w) {
        s.bar([-0.16 * l, y, 0.5 * h], [-0.2 * l, y, 0.0], [0.016; 2], 6);
    }
    wheel(s, [0.36 * l, 0.0], 0.14 * l, 0.1 * w);
}

/// Two flanges on a core with some windings, rolling along x.
fn cable_drum(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.placed([0.0, 0.0, 0.5 * h], ALONG_Y, |s| {
        s.part("flange", kit.main());
        for z in [-0.5 * w, 0.42 * w] {
            s.pillar([0.0, 0.0, z], 0.5 * l, 0.08 * w, 24);
        }
        s.part("cable", dark());
        s.pillar([0.0, 0.0, -0.42 * w], 0.36 * l, 0.84 * w, 16);
        s.part("bore", iron());
        s.pillar([0.0, 0.0, -0.505 * w], 0.06 * l, 1.01 * w, 8);
    });
}
