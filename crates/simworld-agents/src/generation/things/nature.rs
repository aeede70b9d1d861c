//! Trees, bushes, rocks, hay and snow.

use std::f64::consts::FRAC_PI_2;

use simworld_core::ops;
use simworld_core::scene::EntityKind;

use super::super::sculpt::{Finish, Sculpt};
use super::super::stuff::Stuff;
use super::super::thing::{Plan, Takes, Thing, Usual};
use super::{DARK, PROP, around, spread};

const BARK: [f32; 3] = [0.12, 0.075, 0.045];

#[rustfmt::skip]
pub(super) const THINGS: &[Thing] = &[
    Thing { names: &["conifer", "pine tree", "fir tree", "spruce", "fir", "christmas tree", "pine"], kind: EntityKind::Tree, size: [3.0, 3.0, 7.0], stuff: Stuff::Leaves,
        color: Some([0.03, 0.1, 0.045]), mass: [100.0, 1500.0], takes: &[Takes::Count { of: &["tiers", "tier", "levels", "level", "layers", "layer"], usual: 4, least: 1, most: 8 }],
        make: conifer, ..PROP },
    Thing { names: &["palm", "palm tree"], kind: EntityKind::Tree, size: [4.0, 4.0, 7.0], stuff: Stuff::Leaves, color: Some([0.08, 0.2, 0.045]), mass: [60.0, 1200.0],
        takes: &[Takes::Count { of: &["leaves", "leaf", "fronds", "frond"], usual: 9, least: 4, most: 16 }], make: palm, ..PROP },
    Thing { names: &["broadleaf tree", "oak tree", "maple tree", "tree", "linden", "maple", "birch", "apple tree"], kind: EntityKind::Tree, size: [4.4, 4.4, 6.5], stuff: Stuff::Leaves,
        mass: [80.0, 1500.0], takes: &[Takes::Feature { what: &["fruit", "apples", "blossoms", "cherries"], usual: Usual::Without }], make: broadleaf, ..PROP },
    Thing { names: &["bush", "shrub"], kind: EntityKind::Shrub, size: [1.3, 1.3, 1.0], stuff: Stuff::Leaves, mass: [1.0, 40.0],
        takes: &[Takes::Feature { what: &["flowers", "flower", "berries", "blossoms", "roses"], usual: Usual::Without }], make: bush, ..PROP },
    Thing { names: &["hedge"], kind: EntityKind::Shrub, size: [0.8, 3.0, 1.2], stuff: Stuff::Leaves, mass: [4.0, 120.0], takes: &[Takes::Round], make: hedge, ..PROP },
    Thing { names: &["rock", "boulder", "stone"], size: [1.4, 1.1, 0.9], stuff: Stuff::Stone, mass: [500.0, 5000.0],
        takes: &[Takes::Round], make: rock, ..PROP },
    Thing { names: &["hay bale", "straw bale", "haystack", "hay stack", "bale of hay"], size: [1.3, 1.5, 1.3], stuff: Stuff::Straw, mass: [80.0, 500.0],
        takes: &[Takes::Square], make: bale, ..PROP },
    Thing { names: &["snowman"], size: [1.0, 1.2, 1.8], stuff: Stuff::Snow, mass: [80.0, 700.0], takes: &[Takes::Accent,
        Takes::Count { of: &["balls", "ball", "snowballs", "snowball"], usual: 3, least: 2, most: 5 }, Takes::Feature { what: &["hat"], usual: Usual::With }], make: snowman, ..PROP },
    Thing { names: &["cactus"], kind: EntityKind::Shrub, size: [0.5, 1.3, 2.2], stuff: Stuff::Stem, mass: [40.0, 900.0],
        takes: &[Takes::Count { of: &["arms", "arm", "armed"], usual: 2, least: 0, most: 4 }], make: cactus, ..PROP },
    Thing { names: &["log", "tree trunk", "fallen tree"], size: [0.5, 2.4, 0.5], color: Some(BARK), mass: [100.0, 900.0], takes: &[], make: log, ..PROP },
    Thing { names: &["mushroom", "toadstool"], size: [0.5, 0.5, 0.5], stuff: Stuff::Plastic, color: Some([0.6, 0.04, 0.03]), mass: [2.0, 60.0],
        takes: &[Takes::Accent, Takes::Count { of: &["dots", "dot", "spots", "spot"], usual: 7, least: 0, most: 16 }], make: mushroom, ..PROP },
    Thing { names: &["campfire", "bonfire", "fire pit"], size: [1.1, 1.1, 0.7], mass: [40.0, 500.0], takes: &[
        Takes::Count { of: &["logs", "stones", "log"], usual: 6, least: 3, most: 10 }], make: campfire, ..PROP },
    Thing { names: &["tree stump", "stump"], size: [0.7, 0.7, 0.5], color: Some(BARK), mass: [30.0, 300.0], takes: &[], make: stump, ..PROP },
];

/// Leaves in a shade of their own.
fn leaves(p: &mut Plan) -> Finish {
    p.varied()
}

fn trunk() -> Finish {
    Plan::painted(Stuff::Wood, BARK)
}

fn conifer(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let (bare, r) = (h * 0.14, l * 0.5);
    let thick = 0.03 * h.min(9.0) * 0.6;
    s.part("trunk", trunk());
    s.frustum([0.0; 3], [thick, thick * 0.4], h * 0.7, 10);
    let tiers = p.count(0);
    let pitch = (h - bare) / (tiers as f64 + 0.55);
    for k in 0..tiers {
        let share = k as f64 / tiers as f64;
        let wide = r * (1.0 - 0.75 * share);
        let low = bare + pitch * k as f64;
        let tall = if k + 1 == tiers { h - low } else { pitch * 1.55 };
        s.part("needles", leaves(p));
        s.frustum([0.0, 0.0, low], [wide, 0.0], tall, 12);
    }
}

fn palm(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let (crown, lean) = (h * 0.8, l * 0.1);
    let path: Vec<[f64; 3]> = (0..=6)
        .map(|k| f64::from(k) / 6.0)
        .map(|share| [lean * share * share - lean, 0.0, crown * share])
        .collect();
    s.part("trunk", Plan::painted(Stuff::Wood, [0.25, 0.18, 0.1]));
    s.tube(&path, [0.035 * h.min(8.0) * 0.7, 0.018 * h.min(8.0) * 0.7], 10);
    let fronds = p.count(0);
    for (k, [cos, sin]) in around(fronds).enumerate() {
        let reach = l * 0.5 * if k % 2 == 0 { 1.0 } else { 0.86 };
        let lift = (h - crown) * if k % 2 == 0 { 0.8 } else { 1.0 };
        let at = |share: f64, z: f64| [cos * reach * share, sin * reach * share, crown + z];
        let bend = [at(0.0, -0.05), at(0.3, lift * 0.7), at(0.6, lift * 0.5), at(1.0, -(h * 0.08))];
        s.part("frond", leaves(p));
        let wide = l * 0.12;
        s.blade(&bend, &[wide * 0.3, wide, wide * 0.9, 0.01], 0.03);
    }
    s.part("heart", p.shaded(0.8));
    s.ball([0.0, 0.0, crown], [0.12, 0.12, (h - crown) * 0.4], 6, 10);
}

/// Balls of leaves around a middle that together fill a box.
fn crown(s: &mut Sculpt, p: &mut Plan, middle: [f64; 3], half: [f64; 3], count: usize) {
    let [x, y, z] = middle;
    s.part("leaves", leaves(p));
    s.ball(middle, [half[0] * 0.72, half[1] * 0.72, half[2]], 8, 14);
    for (k, [cos, sin]) in around(count).enumerate() {
        let size = p.rng.uniform(0.5, 0.58);
        let lift = half[2] * (if k % 2 == 0 { -0.32 } else { 0.18 }) * p.rng.uniform(0.7, 1.2);
        s.part("leaves", leaves(p));
        let radii = [half[0] * size, half[1] * size, half[2] * size * 1.05];
        let reach = [half[0] - radii[0], half[1] - radii[1]];
        s.ball([x + cos * reach[0], y + sin * reach[1], z + lift], radii, 8, 12);
    }
}

fn broadleaf(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let low = h * 0.3;
    let thick = 0.026 * h.min(12.0);
    s.part("trunk", trunk());
    s.frustum([0.0; 3], [thick, thick * 0.6], h * 0.55, 10);
    for side in [-1.0, 1.0] {
        s.bar(
            [0.0, 0.0, h * 0.3],
            [side * l * 0.14, side * w * 0.12, h * 0.52],
            [thick * 0.5, thick * 0.3],
            8,
        );
    }
    let (middle, half) = ([0.0, 0.0, (h + low) * 0.5], [l * 0.5, w * 0.5, (h - low) * 0.5]);
    crown(s, p, middle, half, 6);
    if p.has(0) {
        dots(s, p, middle, [half[0] * 0.76, half[1] * 0.76, half[2] * 0.9], 26, 0.02 * h.min(5.0));
    }
}

/// Fruit or blossoms on an ellipsoid.
fn dots(s: &mut Sculpt, p: &mut Plan, [x, y, z]: [f64; 3], radii: [f64; 3], count: usize, size: f64) {
    s.part("fruit", Plan::painted(Stuff::Plastic, [0.65, 0.05, 0.06]));
    for k in 0..count {
        // Even over the sphere: equal steps of height, the golden angle around.
        let up = 1.0 - 2.0 * (k as f64 + 0.5) / count as f64;
        let flat = (1.0 - up * up).sqrt();
        let (sin, cos) = ops::sin_cos(2.399_963 * k as f64 + p.rng.uniform(0.0, 0.3));
        s.ball([x + radii[0] * flat * cos, y + radii[1] * flat * sin, z + radii[2] * up], [size; 3], 4, 8);
    }
}

fn bush(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    crown(s, p, [0.0, 0.0, h * 0.5], [l * 0.5, w * 0.5, h * 0.5], 6);
    if p.has(0) {
        dots(s, p, [0.0, 0.0, h * 0.52], [l * 0.42, w * 0.42, h * 0.46], 22, 0.04);
    }
}

fn hedge(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let pieces = ((w / 0.5).round() as usize).max(2);
    let pitch = w / pieces as f64;
    for y in spread(pieces, w - pitch) {
        s.part("leaves", leaves(p));
        let tall = h * p.rng.uniform(0.95, 1.0);
        if p.is_round() {
            s.ball([0.0, y, tall * 0.5], [l * 0.5, pitch * 0.75, tall * 0.5], 8, 12);
        } else {
            s.tapered([0.0, y, 0.0], [l, pitch, tall], [0.9, 1.0]);
        }
    }
}

fn rock(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let lumps = if p.is_round() { 1 } else { 3 };
    for k in 0..lumps {
        s.part("rock", p.varied());
        let turn = [p.rng.uniform(-0.3, 0.3), p.rng.uniform(-0.3, 0.3), p.rng.uniform(0.0, 3.0)];
        let (size, reach) = if k == 0 { (1.0, 0.0) } else { (p.rng.uniform(0.45, 0.65), 0.26) };
        let [cos, sin] = around(3).nth(k).unwrap_or([0.0, 0.0]);
        let turn = if p.is_round() { [0.0; 3] } else { turn };
        s.placed([l * reach * cos, w * reach * sin, h * 0.5 * size], turn, |s| {
            s.lump([0.0; 3], [l * 0.5 * size, w * 0.5 * size, h * 0.5 * size], 6, 9);
        });
    }
}

fn bale(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    s.part("straw", p.main());
    if p.is_square() {
        s.block([0.0; 3], [l * 0.99, w * 0.99, h * 0.99]);
        s.part("twine", Plan::painted(Stuff::Fabric, [0.5, 0.12, 0.05]));
        for y in [-w * 0.25, w * 0.25] {
            s.block([0.0, y, 0.0], [l, 0.02, h]);
        }
        return;
    }
    let r = l.min(h) * 0.5;
    s.placed([0.0, 0.0, r], [FRAC_PI_2, 0.0, 0.0], |s| {
        s.pillar([0.0, 0.0, -w * 0.5], r, w, 28);
        // The winding shows at the ends.
        for k in 1..4 {
            s.part("winding", p.shaded(0.75 + 0.06 * k as f32));
            let radius = r * (1.0 - 0.22 * f64::from(k));
            s.pillar([0.0, 0.0, -w * 0.5 - 0.004 * f64::from(k)], radius, w + 0.008 * f64::from(k), 24);
        }
    });
}

fn snowman(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let balls = p.count(0);
    let hat = if p.has(0) { h * 0.15 } else { 0.0 };
    // Each ball is three quarters of the one below, and sinks a little into it.
    let sizes: Vec<f64> = (0..balls).map(|k| ops::pow(0.74, k as f64)).collect();
    let total: f64 = sizes.iter().sum::<f64>() * 2.0 * 0.9;
    let unit = (h - hat) / total;
    let mut z = 0.0;
    let mut top = (0.0, 0.0);
    for size in &sizes {
        let r = unit * size;
        s.part("snow", p.main());
        s.ball([0.0, 0.0, z + r], [r.min(l * 0.5), r.min(l * 0.5), r], 12, 20);
        top = (z + r, r);
        z += r * 1.8;
    }
    let (z, r) = top;
    let across = r.min(l * 0.5);
    s.part("nose", Plan::painted(Stuff::Plastic, [0.8, 0.25, 0.02]));
    s.bar([across * 0.85, 0.0, z], [across * 1.7, 0.0, z], [r * 0.14, 0.005], 10);
    s.part("coal", Plan::painted(Stuff::Plastic, DARK));
    for y in [-0.33, 0.33] {
        s.ball([across * 0.88, y * across, z + r * 0.3], [r * 0.1; 3], 6, 8);
    }
    s.part("arm", trunk());
    let shoulder = h * 0.52 - hat * 0.5;
    for side in [-1.0, 1.0] {
        s.bar([0.0, 0.0, shoulder], [0.0, side * w * 0.5, shoulder + h * 0.12], [0.02, 0.012], 6);
    }
    s.part("scarf", p.second(Stuff::Fabric, [0.55, 0.04, 0.03]));
    s.hoop([0.0, 0.0, z - r * 0.72], across * 0.68, r * 0.16, 20);
    if p.has(0) {
        s.part("hat", Plan::painted(Stuff::Fabric, DARK));
        s.pillar([0.0, 0.0, h - hat - r * 0.12], across * 0.95, r * 0.1, 20);
        s.pillar([0.0, 0.0, h - hat - r * 0.02], across * 0.6, hat + r * 0.02, 20);
    }
}

fn cactus(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let r = l * 0.4;
    s.part("stem", p.main());
    let column = |s: &mut Sculpt, path: &[[f64; 3]], r: f64| {
        s.tube(path, [r, r * 0.92], 12);
        if let Some(tip) = path.last() {
            s.ball(*tip, [r * 0.92; 3], 8, 12);
        }
    };
    column(s, &[[0.0; 3], [0.0, 0.0, h * 0.5], [0.0, 0.0, h - r]], r);
    for k in 0..p.count(0) {
        s.part("arm", p.varied());
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        let (low, arm) = (h * (0.34 + 0.12 * k as f64), r * 0.6);
        let out = side * (w * 0.5 - arm);
        let tip = (low + h * 0.32).min(h - arm);
        column(s, &[[0.0, 0.0, low], [0.0, out * 0.85, low], [0.0, out, low + arm], [0.0, out, tip]], arm);
    }
}

fn log(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let r = l.min(h) * 0.5;
    s.part("bark", p.main());
    s.bar([0.0, -w * 0.49, r], [0.0, w * 0.49, r], [r, r * 0.94], 16);
    s.part("wood", Plan::painted(Stuff::Wood, [0.5, 0.33, 0.17]));
    for side in [-1.0, 1.0] {
        s.bar([0.0, side * w * 0.488, r], [0.0, side * w * 0.5, r], [r * 0.86; 2], 16);
    }
    s.part("branch", p.shaded(0.9));
    s.bar([0.0, w * 0.1, r], [r * 0.5, w * 0.16, h * 0.98], [r * 0.2, r * 0.12], 8);
}

fn mushroom(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let (r, rim) = (l * 0.5, h * 0.55);
    s.part("stem", Plan::painted(Stuff::Plastic, [0.75, 0.7, 0.6]));
    s.lathe(
        [0.0; 3],
        &[[r * 0.36, 0.0], [r * 0.26, rim * 0.5], [r * 0.3, rim]],
        16,
        super::super::sculpt::Hulls::Segments,
    );
    let cap: Vec<[f64; 2]> = (0..=8)
        .map(|k| {
            let (sin, cos) = ops::sin_cos(FRAC_PI_2 * f64::from(k) / 8.0);
            [if k == 8 { 0.0 } else { r * cos }, rim + (h - rim) * sin]
        })
        .collect();
    s.part("cap", p.main());
    s.lathe([0.0; 3], &cap, 20, super::super::sculpt::Hulls::Whole);
    s.part("dot", p.second(Stuff::Plastic, [0.8, 0.8, 0.78]));
    let count = p.count(0);
    for k in 0..count {
        let up = 0.25 + 0.62 * (k as f64 + 0.5) / count as f64;
        let (sin, cos) = ops::sin_cos(2.399_963 * k as f64);
        let flat = (1.0 - up * up).sqrt() * 0.97;
        s.ball([r * flat * cos, r * flat * sin, rim + (h - rim) * up * 0.97], [r * 0.11; 3], 4, 8);
    }
}

fn campfire(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let r = l * 0.5;
    let count = p.count(0);
    for [cos, sin] in around(count * 2) {
        s.part("stone", Plan::own(Stuff::Stone));
        let size = r * 0.16 * p.rng.uniform(0.85, 1.0);
        s.lump([cos * (r - r * 0.16), sin * (r - r * 0.16), size * 0.8], [size, size, size * 0.8], 4, 7);
    }
    for [cos, sin] in around(count) {
        s.part("log", p.varied());
        s.bar(
            [cos * r * 0.6, sin * r * 0.6, 0.05],
            [-cos * r * 0.08, -sin * r * 0.08, h * 0.6],
            [0.05, 0.04],
            8,
        );
    }
    s.part("flame", Plan::painted(Stuff::Leaves, [0.95, 0.35, 0.03]));
    s.frustum([0.0, 0.0, h * 0.15], [r * 0.3, 0.0], h * 0.85, 8);
    s.part("flame", Plan::painted(Stuff::Leaves, [0.98, 0.7, 0.1]));
    s.frustum([0.0, 0.0, h * 0.2], [r * 0.34, 0.0], h * 0.5, 7);
}

fn stump(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let r = l * 0.5;
    s.part("bark", p.main());
    s.frustum([0.0; 3], [r, r * 0.72], h * 0.3, 14);
    s.frustum([0.0, 0.0, h * 0.3], [r * 0.72, r * 0.7], h * 0.68, 14);
    for (k, share) in [0.64, 0.44, 0.22].into_iter().enumerate() {
        s.part(
            "ring",
            Plan::painted(Stuff::Wood, [0.5 - 0.1 * (k % 2) as f32, 0.33 - 0.08 * (k % 2) as f32, 0.17]),
        );
        s.pillar([0.0, 0.0, h * 0.97], r * share, h * (0.015 + 0.005 * k as f64), 14);
    }
}
