//! Seats, tables, beds and shelves.

use simworld_core::scene::EntityKind;

use super::super::sculpt::{Finish, Sculpt};
use super::super::stuff::Stuff;
use super::super::thing::{Plan, Takes, Thing, Usual};
use super::{PROP, WHITE, spots, spread};

const LEGS: &[&str] = &["legs", "leg", "legged"];

#[rustfmt::skip]
pub(super) const THINGS: &[Thing] = &[
    Thing { names: &["table", "desk", "coffee table", "dining table"], kind: EntityKind::Table, size: [0.9, 1.4, 0.75], mass: [12.0, 60.0],
        takes: &[Takes::Material, Takes::Round, Takes::Count { of: LEGS, usual: 4, least: 1, most: 12 }], make: table, ..PROP },
    Thing { names: &["picnic table"], kind: EntityKind::Table, size: [1.6, 1.8, 0.75], mass: [25.0, 130.0],
        takes: &[Takes::Material, Takes::Count { of: &["boards", "board", "planks", "plank"], usual: 5, least: 2, most: 9 }], make: picnic_table, ..PROP },
    Thing { names: &["chair"], kind: EntityKind::Chair, size: [0.48, 0.46, 0.88], mass: [3.0, 14.0],
        takes: &[Takes::Material, Takes::Feature { what: &["armrests", "armrest", "arms"], usual: Usual::Without },
            Takes::Count { of: &["slats", "slat"], usual: 3, least: 1, most: 8 }], make: chair, ..PROP },
    Thing { names: &["stool", "bar stool"], kind: EntityKind::Chair, size: [0.36, 0.36, 0.48], mass: [2.0, 10.0],
        takes: &[Takes::Material, Takes::Square, Takes::Count { of: LEGS, usual: 3, least: 1, most: 8 }], make: stool, ..PROP },
    Thing { names: &["bench", "park bench"], kind: EntityKind::Bench, size: [0.6, 1.8, 0.85], mass: [15.0, 90.0],
        takes: &[Takes::Material, Takes::Feature { what: &["backrest", "back"], usual: Usual::With },
            Takes::Feature { what: &["armrests", "armrest", "arms"], usual: Usual::Without },
            Takes::Count { of: &["planks", "plank", "boards", "board", "slats", "slat"], usual: 4, least: 1, most: 8 }], make: bench, ..PROP },
    Thing { names: &["sofa", "couch", "settee"], kind: EntityKind::Bench, size: [0.9, 2.0, 0.85], stuff: Stuff::Fabric, color: Some([0.22, 0.27, 0.33]),
        mass: [30.0, 130.0], takes: &[Takes::Count { of: &["seats", "seat", "seater", "cushions", "cushion"], usual: 3, least: 1, most: 6 }],
        make: sofa, ..PROP },
    Thing { names: &["armchair", "easy chair"], kind: EntityKind::Chair, size: [0.85, 0.9, 0.9], stuff: Stuff::Fabric, color: Some([0.3, 0.12, 0.08]),
        mass: [15.0, 70.0], takes: &[], make: |s, p| { p.counts = vec![1]; sofa(s, p); }, ..PROP },
    Thing { names: &["bed"], size: [2.1, 1.5, 0.95], mass: [40.0, 180.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Feature { what: &["headboard"], usual: Usual::With },
            Takes::Count { of: &["pillows", "pillow"], usual: 2, least: 0, most: 4 }], make: bed, ..PROP },
    Thing { names: &["bookshelf", "bookcase", "shelf", "book shelf"], size: [0.32, 1.0, 1.9], mass: [25.0, 200.0],
        takes: &[Takes::Material, Takes::Count { of: &["boards", "board", "shelves", "tiers", "tier"], usual: 5, least: 2, most: 12 },
            Takes::Feature { what: &["books", "book"], usual: Usual::With }], make: bookshelf, ..PROP },
    Thing { names: &["wardrobe", "cupboard", "closet", "cabinet"], size: [0.6, 1.2, 2.0], mass: [30.0, 190.0],
        takes: &[Takes::Material, Takes::Count { of: &["doors", "door"], usual: 2, least: 1, most: 4 }], make: wardrobe, ..PROP },
];

fn table(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let top = 0.05 * h.min(1.0);
    let legs = p.count(0);
    let thick = 0.035 + 0.02 * h.min(1.0);
    s.part("leg", p.shaded(0.75));
    for [x, y] in spots(legs, [l * 0.5 - thick * 1.6, w * 0.5 - thick * 1.6]) {
        // On a round top the legs stand nearer to the middle.
        let inward = if p.is_round() && legs > 1 { 0.68 } else { 1.0 };
        let radius = if legs == 1 { thick * 1.6 } else { thick * 0.8 };
        s.frustum([x * inward, y * inward, 0.0], [radius * 0.8, radius], h - top, 8);
    }
    if legs == 1 {
        s.frustum([0.0; 3], [l.min(w) * 0.3, thick], h * 0.08, 16);
    }
    s.part("top", p.main());
    if p.is_round() {
        ellipse(s, [l, w], h - top, top);
    } else {
        s.block([0.0, 0.0, h - top], [l, w, top]);
    }
}

/// An upright disc that need not be round.
fn ellipse(s: &mut Sculpt, [l, w]: [f64; 2], z: f64, height: f64) {
    let outline: Vec<[f64; 2]> = super::around(24).map(|[cos, sin]| [cos * l * 0.5, sin * w * 0.5]).collect();
    s.prism(&outline, z, height);
}

fn picnic_table(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let boards = p.count(0);
    let (top, seat) = (l * 0.46, h * 0.6);
    let pitch = top / boards as f64;
    for x in spread(boards, top - pitch) {
        s.part("board", p.varied());
        s.block([x, 0.0, h - 0.04], [pitch * 0.92, w, 0.04]);
    }
    for side in [-1.0, 1.0] {
        s.part("seat", p.varied());
        s.block([side * (l * 0.5 - 0.13), 0.0, seat - 0.04], [0.26, w, 0.04]);
    }
    s.part("frame", p.shaded(0.7));
    for y in [-w * 0.34, w * 0.34] {
        s.block([0.0, y, seat - 0.12], [l * 0.96, 0.05, 0.08]);
        s.block([0.0, y, h - 0.12], [top * 0.9, 0.05, 0.08]);
        for side in [-1.0, 1.0] {
            s.bar([side * l * 0.36, y, 0.0], [side * top * 0.28, y, h - 0.05], [0.04, 0.04], 4);
        }
    }
}

fn chair(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let seat = h * 0.51;
    let thick = 0.04;
    s.part("leg", p.shaded(0.8));
    for y in [-1.0, 1.0].map(|side| side * (w * 0.5 - thick * 0.5)) {
        s.block([l * 0.5 - thick * 0.5, y, 0.0], [thick, thick, seat - 0.035]);
        s.block([-l * 0.5 + thick * 0.5, y, 0.0], [thick, thick, h]);
    }
    s.part("seat", p.main());
    s.block([0.0, 0.0, seat - 0.035], [l, w, 0.035]);
    s.part("back", p.main());
    let slats = p.count(0);
    let room = h - seat - 0.12;
    for z in spread(slats, room * 0.75) {
        s.block(
            [-l * 0.5 + thick * 0.5, 0.0, seat + 0.1 + room * 0.5 + z - 0.03],
            [0.022, w - thick * 2.0, 0.06],
        );
    }
    if p.has(0) {
        s.part("armrest", p.shaded(0.9));
        for y in [-1.0, 1.0].map(|side| side * (w * 0.5 - thick * 0.5)) {
            s.block([0.0, y, seat + 0.2], [l, thick, 0.03]);
            s.block([l * 0.4, y, seat], [thick * 0.8, thick * 0.8, 0.2]);
        }
    }
}

fn stool(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let legs = p.count(0);
    s.part("leg", p.shaded(0.75));
    for [x, y] in spots(legs, [l * 0.42, w * 0.42]) {
        let radius = if legs == 1 { 0.035 } else { 0.018 };
        s.bar([x * 0.96, y * 0.96, 0.0], [x * 0.6, y * 0.6, h - 0.04], [radius, radius * 1.2], 8);
    }
    if legs == 1 {
        s.frustum([0.0; 3], [l * 0.42, 0.03], 0.04, 16);
    }
    s.part("seat", p.main());
    if p.is_square() {
        s.block([0.0, 0.0, h - 0.045], [l, w, 0.045]);
    } else {
        ellipse(s, [l, w], h - 0.045, 0.045);
    }
}

fn bench(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (has_back, has_arms) = (p.has(0), p.has(1));
    let seat = if has_back { h * 0.53 } else { h.min(l * 0.85) };
    let thick = 0.06;
    s.part("leg", p.support(Stuff::Iron));
    for y in [-1.0, 1.0].map(|side| side * (w * 0.5 - 0.12)) {
        s.block([l * 0.5 - 0.08, y, 0.0], [thick, thick, seat - 0.04]);
        s.block([-l * 0.5 + 0.08, y, 0.0], [thick, thick, seat - 0.04]);
        s.block([0.0, y, seat - 0.1], [l - 0.1, thick, 0.06]);
        if has_back {
            s.bar([-l * 0.5 + 0.12, y, seat - 0.06], [-l * 0.5 + 0.02, y, h], [0.03, 0.03], 4);
        }
        if has_arms {
            s.block([l * 0.5 - 0.08, y, seat - 0.04], [thick * 0.8, thick * 0.8, 0.22]);
            s.block([0.0, y, seat + 0.18], [l - 0.1, thick, 0.035]);
        }
    }
    let planks = p.count(0);
    let pitch = (l - 0.04) / planks as f64;
    for x in spread(planks, l - pitch) {
        s.part("plank", p.varied());
        s.block([x, 0.0, seat - 0.04], [pitch * 0.86, w, 0.04]);
    }
    if has_back {
        for k in 0..3 {
            s.part("back", p.varied());
            let share = (f64::from(k) + 0.7) / 3.2;
            let (z, x) = (seat + (h - seat) * share, -l * 0.5 + 0.14 - 0.1 * share);
            s.block([x, 0.0, z], [0.035, w, (h - seat) * 0.24]);
        }
    }
}

fn sofa(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (arm, foot, base) = (0.16 * (w / 2.0).clamp(0.7, 1.3), h * 0.1, h * 0.38);
    let depth = l * 0.24;
    s.part("foot", Plan::own(Stuff::Wood));
    for [x, y] in spots(4, [l * 0.42, w * 0.46]) {
        s.frustum([x, y, 0.0], [0.02, 0.03], foot, 8);
    }
    s.part("frame", p.shaded(0.85));
    s.block([0.0, 0.0, foot], [l, w, base - foot]);
    s.block([-(l - depth) * 0.5, 0.0, base], [depth, w, h - base]);
    for side in [-1.0, 1.0] {
        s.block([depth * 0.5, side * (w - arm) * 0.5, base], [l - depth, arm, h * 0.26]);
    }
    let seats = p.count(0).max(1);
    let pitch = (w - 2.0 * arm) / seats as f64;
    for y in spread(seats, w - 2.0 * arm - pitch) {
        s.part("cushion", p.varied());
        s.tapered([depth * 0.5, y, base], [l - depth, pitch * 0.98, h * 0.13], [0.96, 0.96]);
        s.tapered([-l * 0.5 + depth + 0.07, y, base + h * 0.13], [0.14, pitch * 0.96, h * 0.4], [0.6, 0.94]);
    }
}

fn bed(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (frame, top) = (h * 0.32, h * 0.58);
    // Slats in a frame.
    let mut slats = p.main();
    slats.density *= 0.2;
    s.part("frame", slats);
    for [x, y] in spots(4, [l * 0.5 - 0.05, w * 0.5 - 0.05]) {
        s.block([x, y, 0.0], [0.09, 0.09, frame]);
    }
    s.block([0.0, 0.0, frame * 0.5], [l, w, frame * 0.5]);
    if p.has(0) {
        s.part("headboard", p.main());
        s.block([-l * 0.5 + 0.03, 0.0, 0.0], [0.06, w, h]);
    }
    let light = |finish: Finish, share: f64| Finish { density: finish.density * share, ..finish };
    s.part("mattress", light(Plan::painted(Stuff::Fabric, WHITE), 0.5));
    s.tapered([0.03, 0.0, frame], [l - 0.1, w * 0.96, top - frame], [0.98, 0.97]);
    // It lies around the mattress, where that is counted already.
    s.part("blanket", light(p.second(Stuff::Fabric, [0.12, 0.2, 0.35]), 0.05));
    s.tapered([l * 0.13, 0.0, frame + 0.02], [l * 0.7, w * 0.99, top - frame], [0.98, 0.97]);
    let pillows = p.count(0);
    let pitch = w * 0.94 / pillows.max(1) as f64;
    s.part("pillow", Plan::painted(Stuff::Fabric, [0.85, 0.85, 0.82]));
    for y in spread(pillows, w * 0.94 - pitch) {
        s.ball([-l * 0.36, y, top + 0.03], [0.2, pitch * 0.42, 0.08], 8, 16);
    }
}

fn bookshelf(s: &mut Sculpt, p: &mut Plan) {
    const SPINES: [[f32; 3]; 5] =
        [[0.4, 0.05, 0.04], [0.04, 0.12, 0.3], [0.06, 0.22, 0.1], [0.5, 0.36, 0.12], [0.2, 0.19, 0.18]];
    let [l, w, h] = p.size;
    let board = 0.03;
    s.part("frame", p.shaded(0.85));
    for side in [-1.0, 1.0] {
        s.block([0.0, side * (w - board) * 0.5, 0.0], [l, board, h]);
    }
    s.block([-l * 0.5 + 0.01, 0.0, 0.0], [0.02, w - 2.0 * board, h]);
    let boards = p.count(0);
    let pitch = (h - board) / (boards - 1).max(1) as f64;
    for level in 0..boards {
        let z = pitch * level as f64;
        s.part("board", p.varied());
        s.block([0.01, 0.0, z], [l - 0.02, w - 2.0 * board, board]);
        if !p.has(0) || level + 1 == boards {
            continue;
        }
        let mut y = -w * 0.5 + board + 0.01;
        while y < w * 0.5 - board - 0.12 {
            let (thick, tall) = (p.rng.uniform(0.05, 0.11), (pitch - board) * p.rng.uniform(0.6, 0.88));
            s.part("books", Plan::painted(Stuff::Wood, SPINES[p.rng.below(SPINES.len())]));
            s.block([0.0, y + thick * 0.5, z + board], [l * 0.7, thick * 0.97, tall]);
            y += thick + if p.rng.chance(0.2) { 0.08 } else { 0.0 };
        }
    }
}

fn wardrobe(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    // Hollow inside: boards of 2 cm around.
    let mut body = p.main();
    body.density *= 0.12;
    s.part("body", body);
    s.block([-0.01, 0.0, 0.08], [l - 0.02, w, h - 0.08]);
    s.part("foot", p.shaded(0.6));
    s.block([-0.01, 0.0, 0.0], [l * 0.9, w * 0.94, 0.08]);
    let doors = p.count(0);
    let pitch = w / doors as f64;
    for (index, y) in spread(doors, w - pitch).enumerate() {
        s.part("door", p.varied());
        s.block([l * 0.5 - 0.02, y, 0.11], [0.02, pitch * 0.97, h - 0.14]);
        s.part("handle", Plan::own(Stuff::Metal));
        let side = if index % 2 == 0 { 0.4 } else { -0.4 };
        s.block([l * 0.5 - 0.005, y + side * pitch, h * 0.5], [0.01, 0.02, 0.16]);
    }
}
