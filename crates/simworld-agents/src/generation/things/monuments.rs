//! Columns, arches, statues and fountains.

use std::f64::consts::PI;

use super::super::sculpt::{Hulls, Sculpt};
use super::super::stuff::Stuff;
use super::super::thing::{Plan, Takes, Thing, Usual};
use super::{PROP, spread};

const STEPS: &[&str] = &["steps", "step", "tiers", "tier", "layers", "layer", "levels", "level"];

#[rustfmt::skip]
pub(super) const THINGS: &[Thing] = &[
    Thing { names: &["arch", "archway", "triumphal arch"], size: [1.0, 3.6, 3.6], stuff: Stuff::Stone, mass: [3000.0, 30_000.0],
        takes: &[Takes::Material], make: arch, ..PROP },
    Thing { names: &["column", "pillar"], size: [0.9, 0.9, 4.5], stuff: Stuff::Marble, mass: [800.0, 9000.0],
        takes: &[Takes::Material, Takes::Square], make: column, ..PROP },
    Thing { names: &["statue plinth", "plinth", "pedestal"], size: [1.2, 1.2, 1.4], stuff: Stuff::Stone, mass: [1200.0, 7000.0],
        takes: &[Takes::Material, Takes::Round, Takes::Count { of: STEPS, usual: 2, least: 0, most: 5 }], make: plinth, ..PROP },
    Thing { names: &["statue", "sculpture", "monument"], size: [1.1, 1.1, 3.4], stuff: Stuff::Metal, color: Some([0.2, 0.28, 0.22]), mass: [600.0, 9000.0],
        takes: &[Takes::Material], make: statue, ..PROP },
    Thing { names: &["obelisk"], size: [1.4, 1.4, 6.0], stuff: Stuff::Stone, mass: [3000.0, 25_000.0],
        takes: &[Takes::Material, Takes::Count { of: STEPS, usual: 2, least: 0, most: 5 }], make: obelisk, ..PROP },
    Thing { names: &["pyramid"], size: [6.0, 6.0, 4.2], stuff: Stuff::Stone, color: Some([0.6, 0.44, 0.24]), mass: [40_000.0, 400_000.0],
        takes: &[Takes::Material, Takes::Count { of: STEPS, usual: 1, least: 1, most: 20 }], make: pyramid, ..PROP },
    Thing { names: &["fountain"], size: [3.6, 3.6, 2.4], stuff: Stuff::Stone, mass: [2500.0, 25_000.0],
        takes: &[Takes::Material, Takes::Feature { what: &["water"], usual: Usual::With }, Takes::Count { of: &["bowls", "bowl", "tiers", "tier", "basins", "basin"], usual: 1, least: 0, most: 3 }],
        make: fountain, ..PROP },
    Thing { names: &["staircase", "stairs", "steps", "stairway"], size: [2.0, 1.6, 1.1], stuff: Stuff::Stone, mass: [1000.0, 9000.0],
        takes: &[Takes::Material, Takes::Count { of: STEPS, usual: 6, least: 1, most: 24 }], make: stairs, ..PROP },
    Thing { names: &["sundial"], size: [0.6, 0.6, 1.0], stuff: Stuff::Stone, mass: [60.0, 500.0], takes: &[Takes::Material], make: sundial, ..PROP },
    Thing { names: &["gravestone", "tombstone", "headstone"], size: [0.3, 0.7, 1.0], stuff: Stuff::Stone, mass: [80.0, 700.0], takes: &[Takes::Material], make: gravestone, ..PROP },
];

fn arch(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    // The opening is half a circle over two piers.
    let thick = (w * 0.2).min(h * 0.28);
    let outer = (w * 0.5).min(h * 0.8);
    let spring = h - outer;
    s.part("pier", p.shaded(0.9));
    for y in [-1.0, 1.0].map(|side| side * (w - thick) * 0.5) {
        s.block([0.0, y, 0.0], [l, thick, spring * 0.94]);
    }
    s.part("impost", p.shaded(0.75));
    for y in [-1.0, 1.0].map(|side| side * (w - thick) * 0.5) {
        s.block([0.0, y, spring * 0.94], [l, thick, spring * 0.06]);
    }
    let stones = 9;
    let stretch = w * 0.5 / outer;
    for k in 0..stones {
        s.part("stone", p.varied());
        let angles = [k, k + 1].map(|k| PI * f64::from(k) / f64::from(stones));
        s.bow([0.0, 0.0, spring], [w * 0.5 - thick, outer * stretch], l, angles);
    }
}

fn column(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (base, sides) = (h * 0.05, if p.is_square() { 4 } else { 24 });
    let r = l * 0.5;
    s.part("base", p.shaded(0.9));
    s.block([0.0; 3], [l, w, base]);
    s.lathe(
        [0.0, 0.0, base],
        &[[r * 0.9, 0.0], [r * 0.92, base * 0.5], [r * 0.72, base]],
        sides,
        Hulls::Whole,
    );
    s.part("shaft", p.main());
    let (low, high) = (base * 2.0, h * 0.9);
    let profile = [
        [r * 0.7, low],
        [r * 0.69, low + (high - low) * 0.35],
        [r * 0.64, low + (high - low) * 0.7],
        [r * 0.58, high],
    ];
    s.lathe([0.0; 3], &profile, sides, Hulls::Whole);
    s.part("capital", p.shaded(0.9));
    s.frustum([0.0, 0.0, high], [r * 0.6, r * 0.92], h * 0.05, sides);
    s.block([0.0, 0.0, h * 0.95], [l, w, h * 0.05]);
}

/// Steps that grow narrower upwards; gives where they end, with what is left of the width.
fn stepped(s: &mut Sculpt, p: &mut Plan, count: usize, rise: f64, tread: f64) -> (f64, [f64; 2]) {
    let [l, w, _] = p.size;
    let mut size = [l, w];
    for level in 0..count {
        s.part("step", p.varied());
        if p.is_round() {
            s.pillar([0.0, 0.0, rise * level as f64], size[0] * 0.5, rise, 32);
        } else {
            s.block([0.0, 0.0, rise * level as f64], [size[0], size[1], rise]);
        }
        size = size.map(|side| side - 2.0 * tread);
    }
    (rise * count as f64, size)
}

fn plinth(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let steps = p.count(0);
    let (low, [a, b]) = stepped(s, p, steps, h * 0.1, l * 0.07);
    let (a, b) = (a.max(l * 0.3), b.max(l * 0.3));
    let die = h - low;
    let mut level = |name: &'static str, share: f64, size: f64, factor: f32, z: f64| {
        s.part(name, p.shaded(factor));
        if p.is_round() {
            s.pillar([0.0, 0.0, z], a * 0.5 * size, die * share, 32);
        } else {
            s.block([0.0, 0.0, z], [a * size, b * size, die * share]);
        }
    };
    level("base", 0.15, 1.0, 0.85, low);
    level("die", 0.7, 0.84, 1.0, low + die * 0.15);
    level("top", 0.15, 0.98, 0.9, low + die * 0.85);
}

fn statue(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let foot = h * 0.36;
    s.part("plinth", Plan::own(Stuff::Stone));
    s.block([0.0; 3], [l, w, foot * 0.2]);
    s.block([0.0, 0.0, foot * 0.2], [l * 0.8, w * 0.8, foot * 0.66]);
    s.block([0.0, 0.0, foot * 0.86], [l * 0.9, w * 0.9, foot * 0.14]);
    // Eight heads tall, one arm raised.
    let body = h - foot;
    let head = body / 8.0;
    let z = |heads: f64| foot + heads * head;
    s.part("figure", p.main());
    for y in [-1.0, 1.0] {
        s.bar(
            [0.1 * head, y * 0.5 * head, foot],
            [0.0, y * 0.42 * head, z(3.8)],
            [0.32 * head, 0.42 * head],
            10,
        );
        s.block([0.25 * head, y * 0.5 * head, foot], [1.1 * head, 0.5 * head, 0.25 * head]);
    }
    s.placed([0.0, 0.0, z(3.5)], [0.0; 3], |s| {
        s.tapered([0.0; 3], [0.95 * head, 1.5 * head, 1.6 * head], [0.95, 1.0]);
        s.tapered([0.0, 0.0, 1.6 * head], [0.9 * head, 1.5 * head, 1.4 * head], [0.7, 1.05]);
    });
    s.bar([0.0, 0.0, z(6.4)], [0.0, 0.0, z(7.0)], [0.24 * head, 0.2 * head], 8);
    s.ball([0.05 * head, 0.0, z(7.45)], [0.42 * head, 0.36 * head, 0.52 * head], 10, 14);
    s.tube(
        &[[0.0, 0.85 * head, z(6.3)], [0.1 * head, 1.1 * head, z(4.9)], [0.5 * head, 0.9 * head, z(3.9)]],
        [0.24 * head, 0.16 * head],
        8,
    );
    s.tube(
        &[[0.0, -0.85 * head, z(6.3)], [0.8 * head, -1.1 * head, z(6.2)], [1.7 * head, -0.9 * head, z(7.4)]],
        [0.24 * head, 0.15 * head],
        8,
    );
    s.part("cloak", p.shaded(0.75));
    s.tapered([-0.5 * head, 0.0, z(1.0)], [0.35 * head, 2.0 * head, 5.4 * head], [0.8, 0.75]);
}

fn obelisk(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let steps = p.count(0);
    let (low, [a, b]) = stepped(s, p, steps, h * 0.035, l * 0.08);
    let size = [a.max(l * 0.3) * 0.92, b.max(l * 0.3) * 0.92];
    let shaft = (h - low) * 0.9;
    s.part("shaft", p.main());
    s.tapered([0.0, 0.0, low], [size[0], size[1], shaft], [0.6, 0.6]);
    s.part("tip", p.shaded(0.85));
    s.tapered([0.0, 0.0, low + shaft], [size[0] * 0.6, size[1] * 0.6, h - low - shaft], [0.0, 0.0]);
}

fn pyramid(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let steps = p.count(0);
    s.part("body", p.main());
    if steps == 1 {
        s.tapered([0.0; 3], [l, w, h], [0.0, 0.0]);
        return;
    }
    let rise = h / steps as f64;
    stepped(s, p, steps, rise, l.min(w) * 0.5 / (steps as f64 + 0.5));
}

fn fountain(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let (r, rim) = (l * 0.5, h * 0.22);
    let bowls = p.count(0);
    s.part("basin", p.main());
    s.vessel(
        [0.0; 3],
        &[[0.0, r * 0.94, r * 0.84], [rim * 0.8, r * 0.96, r * 0.86], [rim, r, r * 0.84]],
        rim * 0.2,
        32,
    );
    let column = |share: f64| h * (0.22 + 0.6 * share);
    let tops: Vec<f64> = (1..=bowls).map(|k| column(k as f64 / bowls as f64)).collect();
    let top = tops.last().copied().unwrap_or(rim * 1.2);
    s.part("column", p.shaded(0.9));
    s.lathe(
        [0.0; 3],
        &[[r * 0.2, rim * 0.2], [r * 0.14, rim], [r * 0.07, rim * 1.6], [r * 0.06, top]],
        16,
        Hulls::Segments,
    );
    for (k, z) in tops.iter().enumerate() {
        let wide = r * 0.5 / (1.0 + 0.6 * k as f64);
        s.part("bowl", p.main());
        let deep = h * 0.09;
        s.vessel(
            [0.0, 0.0, z - deep],
            &[
                [0.0, wide * 0.3, wide * 0.22],
                [deep * 0.6, wide * 0.85, wide * 0.76],
                [deep, wide, wide * 0.9],
            ],
            deep * 0.3,
            24,
        );
        if p.has(0) {
            s.part("water", Plan::own(Stuff::Water));
            s.frustum([0.0, 0.0, z - deep * 0.7], [wide * 0.4, wide * 0.84], deep * 0.55, 24);
        }
    }
    if p.has(0) {
        s.part("water", Plan::own(Stuff::Water));
        s.pillar([0.0, 0.0, rim * 0.2], r * 0.84, rim * 0.5, 32);
        s.part("jet", Plan::painted(Stuff::Water, [0.55, 0.68, 0.75]));
        s.frustum([0.0, 0.0, top - h * 0.02], [r * 0.05, 0.01], h - top + h * 0.02, 10);
    } else {
        s.part("column", p.shaded(0.9));
        s.frustum([0.0, 0.0, top - h * 0.02], [r * 0.07, 0.0], h - top + h * 0.02, 10);
    }
}

fn stairs(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let steps = p.count(0);
    let (rise, tread) = (h / steps as f64, l / steps as f64);
    for (k, x) in spread(steps, l - tread).enumerate() {
        s.part("step", p.varied());
        // The lowest step is in front.
        s.block([-x, 0.0, 0.0], [tread, w, rise * (k as f64 + 1.0)]);
    }
}

fn sundial(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let r = l * 0.5;
    s.part("foot", p.main());
    s.lathe(
        [0.0; 3],
        &[[r * 0.8, 0.0], [r * 0.8, h * 0.08], [r * 0.4, h * 0.16], [r * 0.34, h * 0.7], [r * 0.6, h * 0.8]],
        20,
        Hulls::Segments,
    );
    s.part("dial", p.shaded(0.85));
    s.pillar([0.0, 0.0, h * 0.8], r, h * 0.05, 28);
    s.part("gnomon", Plan::painted(Stuff::Metal, [0.4, 0.25, 0.08]));
    s.placed([0.0, 0.0, h * 0.85], [0.0, 0.0, PI * 0.5], |s| {
        s.panel(&[[-r * 0.5, 0.0], [r * 0.5, 0.0], [r * 0.5, h * 0.15]], -0.006, 0.012);
    });
}

fn gravestone(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    s.part("foot", p.shaded(0.8));
    s.block([0.0; 3], [l, w, h * 0.14]);
    let wide = w * 0.42;
    let arc = (0..=12).map(|k| {
        let (sin, cos) = simworld_core::ops::sin_cos(PI * f64::from(k) / 12.0);
        [wide * cos, h * 0.72 + h * 0.28 * sin]
    });
    let outline: Vec<[f64; 2]> = [[-wide, h * 0.14], [wide, h * 0.14]].into_iter().chain(arc).collect();
    s.part("stone", p.main());
    s.panel(&outline, -l * 0.25, l * 0.5);
}
