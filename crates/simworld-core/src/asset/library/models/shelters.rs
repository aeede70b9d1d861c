//! Roofs on posts, under which one stands and walks.

use super::{Kit, Maker, SIDES, around, leaf, plastic, spread, steel, white, wood};
use crate::asset::Material;
use crate::asset::sculpt::{Coating, Sculpt};

pub(super) const MAKERS: &[(&str, Maker)] =
    &[("awning_tent", awning_tent), ("gazebo", gazebo), ("market_stall", market_stall), ("pergola", pergola)];

/// Four posts at so many shares of the box from its middle.
fn posts(s: &mut Sculpt, [l, w]: [f64; 2], height: f64, radius: f64) {
    for x in SIDES.map(|side| side * l) {
        for y in SIDES.map(|side| side * w) {
            s.bar([x, y, 0.0], [x, y, height], [radius; 2], 8);
        }
    }
}

/// A pointed canvas with a valance on four posts.
fn awning_tent(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("posts", steel());
    posts(s, [0.47 * l, 0.47 * w], 0.78 * h, 0.025);
    s.part("canvas", kit.main());
    s.tapered([0.0, 0.0, 0.78 * h], [l, w, 0.22 * h], [0.03, 0.03]);
    s.part("valance", kit.shade(0.86));
    for side in SIDES {
        s.block([side * 0.49 * l, 0.0, 0.7 * h], [0.02 * l, w, 0.08 * h]);
        s.block([0.0, side * 0.49 * w, 0.7 * h], [0.96 * l, 0.02 * w, 0.08 * h]);
    }
}

/// Eight posts round a floor, with rails but for where one comes in, under a roof of as many sides.
fn gazebo(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let (r, reach, floor, eaves) = (0.5 * l, 0.45 * l, 0.05 * h, 0.72 * h);
    s.part("floor", wood());
    s.pillar([0.0; 3], r, floor, 8);
    s.part("posts", kit.main());
    let corners: Vec<[f64; 2]> = around(8).map(|[x, y]| [x * reach, y * reach]).collect();
    for [x, y] in &corners {
        s.bar([*x, *y, floor], [*x, *y, eaves], [0.05; 2], 8);
    }
    s.part("rails", kit.shade(0.9));
    for pair in corners[1..].windows(2) {
        let ([x, y], [u, v]) = (pair[0], pair[1]);
        for height in [floor + 0.15, floor + 0.5, floor + 0.85] {
            s.bar([x, y, height], [u, v, height], [0.025; 2], 6);
        }
    }
    s.part("roof", kit.shade(0.5));
    s.frustum([0.0, 0.0, eaves], [r, 0.03 * r], h - eaves, 8);
}

/// A counter with goods under a striped roof.
fn market_stall(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("posts", wood());
    posts(s, [0.44 * l, 0.46 * w], 0.82 * h, 0.035);
    s.part("counter", wood());
    s.block([0.12 * l, 0.0, 0.34 * h], [0.6 * l, 0.9 * w, 0.02 * h]);
    s.block([0.41 * l, 0.0, 0.03 * h], [0.02 * l, 0.9 * w, 0.31 * h]);
    for y in SIDES.map(|side| side * 0.42 * w) {
        s.block([-0.16 * l, y, 0.0], [0.03 * l, 0.03 * w, 0.34 * h]);
    }
    let goods = [[0.55, 0.05, 0.03], [0.6, 0.4, 0.04], [0.1, 0.3, 0.05], [0.6, 0.22, 0.03]];
    for (rank, y) in spread(4, 0.66 * w).enumerate() {
        s.part("crate", wood());
        s.block([0.14 * l, y, 0.36 * h], [0.44 * l, 0.18 * w, 0.04 * h]);
        s.part("goods", if rank == 2 { leaf() } else { plastic(goods[rank]) });
        s.lump([0.14 * l, y, 0.4 * h], [0.2 * l, 0.08 * w, 0.04 * h], 4, 8);
    }
    let stripe = w / 6.0;
    for (rank, y) in spread(6, w - stripe).enumerate() {
        let cloth = Coating::of(Material::Fabric, [0.8, 0.8, 0.79]);
        s.part("awning", if rank % 2 == 0 { kit.main() } else { cloth });
        s.tapered([0.0, y, 0.82 * h], [l, stripe, 0.18 * h], [0.06, 1.0]);
    }
    s.part("edge", white());
    for x in SIDES.map(|side| side * 0.495 * l) {
        s.block([x, 0.0, 0.77 * h], [0.01 * l, w, 0.05 * h]);
    }
}

/// Two beams on four posts, and rafters across them.
fn pergola(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("posts", kit.main());
    for x in SIDES.map(|side| side * 0.42 * l) {
        for y in SIDES.map(|side| side * 0.42 * w) {
            s.block([x, y, 0.0], [0.12, 0.12, 0.88 * h]);
        }
        s.block([x, 0.0, 0.88 * h], [0.09, w, 0.06 * h]);
    }
    s.part("rafters", kit.shade(0.85));
    for y in spread(9, 0.9 * w) {
        s.block([0.0, y, 0.94 * h], [l, 0.05, 0.06 * h]);
    }
    s.part("climber", leaf());
    for (rank, [x, y]) in around(5).enumerate() {
        let z = 0.95 * h - 0.02 * h * (rank % 2) as f64;
        s.lump([0.28 * l * x - 0.08 * l, 0.3 * w * y, z], [0.2 * l, 0.16 * w, 0.04 * h], 4, 7);
    }
}
