//! What holds something: crates, barrels, pots and bins.

use simworld_core::scene::EntityKind;

use super::super::sculpt::{Hulls, Sculpt};
use super::super::stuff::Stuff;
use super::super::thing::{Plan, Takes, Thing, Usual};
use super::{DARK, PROP, around, spots, spread, wheel};

const FLOWERS: &[&str] = &["flowers", "flower", "plants", "plant"];
const LID: Takes = Takes::Feature { what: &["lid", "cover"], usual: Usual::Without };

#[rustfmt::skip]
pub(super) const THINGS: &[Thing] = &[
    Thing { names: &["crate", "wooden crate", "packing case"], size: [0.6, 0.8, 0.6], color: Some([0.38, 0.24, 0.11]), mass: [10.0, 80.0],
        takes: &[Takes::Material, Takes::Count { of: &["boards", "board", "planks", "plank"], usual: 3, least: 2, most: 6 }], make: crated, ..PROP },
    Thing { names: &["barrel", "cask", "keg"], size: [0.6, 0.6, 0.9], mass: [15.0, 200.0],
        takes: &[Takes::Material, Takes::Count { of: &["hoops", "hoop", "bands", "band", "rings", "ring"], usual: 4, least: 2, most: 6 }], make: barrel, ..PROP },
    Thing { names: &["bucket", "pail"], size: [0.3, 0.3, 0.42], stuff: Stuff::Metal, mass: [0.4, 9.0],
        takes: &[Takes::Material, Takes::Feature { what: &["handle"], usual: Usual::With },
            Takes::Feature { what: &["water"], usual: Usual::Without }], make: bucket, ..PROP },
    Thing { names: &["vase", "urn", "amphora"], size: [0.3, 0.3, 0.6], stuff: Stuff::Clay, mass: [3.0, 45.0],
        takes: &[Takes::Material, Takes::Feature { what: FLOWERS, usual: Usual::Without }], make: vase, ..PROP },
    Thing { names: &["flower pot", "flowerpot", "pot", "plant pot"], size: [0.45, 0.45, 0.75], stuff: Stuff::Clay, mass: [8.0, 70.0],
        takes: &[Takes::Material, Takes::Square, Takes::Feature { what: FLOWERS, usual: Usual::With }], make: flower_pot, ..PROP },
    Thing { names: &["planter", "flower box", "flower bed", "raised bed"], size: [0.6, 1.6, 0.9], mass: [60.0, 900.0],
        takes: &[Takes::Material, Takes::Round, Takes::Count { of: &["bushes", "bush", "plants", "plant", "shrubs", "shrub"], usual: 4, least: 1, most: 9 }],
        make: planter, ..PROP },
    Thing { names: &["trash bin", "trash can", "rubbish bin", "litter bin", "waste bin", "dustbin", "garbage can", "bin"], kind: EntityKind::TrashBin,
        size: [0.5, 0.5, 0.95], stuff: Stuff::Metal, color: Some([0.05, 0.16, 0.08]), mass: [4.0, 70.0],
        takes: &[Takes::Material, Takes::Square, LID], make: bin, ..PROP },
    Thing { names: &["dumpster", "skip", "rubbish container", "waste container"], kind: EntityKind::TrashBin, size: [1.1, 1.9, 1.35], stuff: Stuff::Metal,
        color: Some([0.05, 0.2, 0.1]), mass: [80.0, 700.0], takes: &[Takes::Accent, Takes::Feature { what: &["lid", "lids", "cover"], usual: Usual::With }],
        make: dumpster, ..PROP },
    Thing { names: &["mailbox", "letter box", "letterbox", "post box", "postbox", "mail box"], kind: EntityKind::Mailbox, size: [0.5, 0.34, 1.3],
        stuff: Stuff::Metal, color: Some([0.06, 0.12, 0.4]), mass: [8.0, 200.0],
        takes: &[Takes::Material, Takes::Feature { what: &["flag"], usual: Usual::With }], make: mailbox, ..PROP },
    Thing { names: &["trough", "water trough", "drinking trough"], size: [0.7, 1.8, 0.6], stuff: Stuff::Stone, mass: [80.0, 1500.0],
        takes: &[Takes::Material, Takes::Feature { what: &["water"], usual: Usual::With }], make: trough, ..PROP },
    Thing { names: &["box", "cardboard box", "chest"], size: [0.4, 0.5, 0.35], color: Some([0.45, 0.3, 0.15]), mass: [3.0, 40.0],
        takes: &[Takes::Material, LID], make: plain_box, ..PROP },
];

fn crated(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (board, boards) = (0.03, p.count(0));
    // Boards of 2 cm around a hollow.
    let mut core = p.shaded(0.55);
    core.density *= 0.25;
    s.part("inside", core);
    s.block([0.0, 0.0, board], [l - 2.0 * board, w - 2.0 * board, h - 2.0 * board]);
    let pitch = h / boards as f64;
    for level in 0..boards {
        let z = pitch * (level as f64 + 0.06);
        s.part("board", p.varied());
        for side in [-1.0, 1.0] {
            s.block([side * (l - board) * 0.5, 0.0, z], [board, w - 2.0 * board, pitch * 0.88]);
            s.block([0.0, side * (w - board) * 0.5, z], [l - 2.0 * board, board, pitch * 0.88]);
        }
    }
    s.part("edge", p.shaded(0.9));
    for [x, y] in spots(4, [(l - board) * 0.5, (w - board) * 0.5]) {
        s.block([x, y, 0.0], [board, board, h]);
    }
    let pitch = (l - 2.0 * board) / boards as f64;
    for x in spread(boards, l - 2.0 * board - pitch) {
        s.part("lid", p.varied());
        s.block([x, 0.0, h - board], [pitch * 0.94, w - 2.0 * board, board]);
    }
}

fn barrel(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let belly = |share: f64| l * 0.5 * (1.0 - 0.2 * (2.0 * share - 1.0) * (2.0 * share - 1.0)) - 0.006;
    let profile: Vec<[f64; 2]> =
        (0..=8).map(|k| f64::from(k) / 8.0).map(|share| [belly(share), share * h]).collect();
    // Staves of 4 cm around a hollow.
    let mut body = p.main();
    body.density *= 0.35;
    s.part("staves", body);
    s.lathe([0.0; 3], &profile, 24, Hulls::Whole);
    s.part("hoop", if p.stuff == Stuff::Wood { Plan::own(Stuff::Iron) } else { p.shaded(0.7) });
    let hoops = p.count(0);
    for z in spread(hoops, h * 0.8) {
        let (low, high) = (0.5 + (z - 0.02) / h, 0.5 + (z + 0.02) / h);
        let ring = [[belly(low) + 0.006, low * h], [belly(high) + 0.006, high * h]];
        s.lathe([0.0; 3], &ring, 24, Hulls::Whole);
    }
    s.part("head", p.shaded(0.75));
    s.pillar([0.0, 0.0, h - 0.004], belly(1.0) * 0.9, 0.004, 24);
}

fn bucket(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let rim = if p.has(0) { h * 0.68 } else { h };
    let (radius, wall) = (l * 0.5, 0.008);
    let levels = [[0.0, radius * 0.7, radius * 0.7 - wall], [rim, radius, radius - wall]];
    s.part("body", p.main());
    s.vessel([0.0; 3], &levels, 0.01, 20);
    if p.has(1) {
        s.part("water", Plan::own(Stuff::Water));
        s.pillar([0.0, 0.0, 0.01], radius * 0.7 - wall, rim * 0.7, 20);
    }
    if p.has(0) {
        s.part("handle", Plan::own(Stuff::Metal));
        let bail: Vec<[f64; 3]> = (0..=10)
            .map(|k| {
                let (sin, cos) = simworld_core::ops::sin_cos(std::f64::consts::PI * f64::from(k) / 10.0);
                [0.0, (radius - 0.006) * cos, rim - 0.02 + (h - rim + 0.014) * sin]
            })
            .collect();
        s.tube(&bail, [0.006; 2], 6);
    }
}

fn vase(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let body = if p.has(0) { h * 0.62 } else { h };
    let (radius, wall) = (l * 0.5, 0.012);
    let outline = [
        (0.0, 0.5),
        (0.12, 0.72),
        (0.32, 0.98),
        (0.45, 1.0),
        (0.62, 0.82),
        (0.78, 0.5),
        (0.88, 0.44),
        (1.0, 0.66),
    ];
    // The seed draws how full the belly is.
    let belly = p.rng.uniform(0.85, 1.0);
    let levels: Vec<[f64; 3]> = outline
        .iter()
        .map(|(share, reach)| {
            let outer = radius * if *reach > 0.9 { *reach } else { reach * belly };
            [share * body, outer, outer - wall]
        })
        .collect();
    s.part("body", p.main());
    s.vessel([0.0; 3], &levels, 0.03, 20);
    if p.has(0) {
        bunch(s, p, [0.0, 0.0, body * 0.8], [radius, h - body * 0.8], 7);
    }
}

/// Flowers on stems out of one place, as wide and high as they are told.
fn bunch(s: &mut Sculpt, p: &mut Plan, from: [f64; 3], [radius, height]: [f64; 2], count: usize) {
    const PETALS: [[f32; 3]; 4] = [[0.7, 0.05, 0.1], [0.85, 0.6, 0.05], [0.8, 0.3, 0.5], [0.75, 0.75, 0.75]];
    let head = (radius * 0.3).min(0.06);
    for [cos, sin] in around(count) {
        let reach = (radius - head) * p.rng.uniform(0.7, 1.0);
        let tip = [
            from[0] + cos * reach,
            from[1] + sin * reach,
            from[2] + (height - head) * p.rng.uniform(0.75, 1.0),
        ];
        s.part("stem", Plan::own(Stuff::Leaves));
        s.bar(from, tip, [0.008, 0.005], 5);
        s.part("flower", Plan::painted(Stuff::Leaves, PETALS[p.rng.below(PETALS.len())]));
        s.ball(tip, [head, head, head * 0.7], 6, 10);
    }
}

fn flower_pot(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let body = if p.has(0) { h * 0.52 } else { h };
    s.part("pot", p.main());
    let soil = body * 0.86;
    if p.is_square() {
        s.trough([0.0; 3], [l, w, body], 0.025, 0.03);
        s.part("soil", Plan::own(Stuff::Soil));
        s.block([0.0, 0.0, 0.03], [l - 0.05, w - 0.05, soil - 0.03]);
    } else {
        let r = l * 0.5;
        let lip = body * 0.84;
        let levels = [
            [0.0, r * 0.66, r * 0.58],
            [lip, r * 0.92, r * 0.84],
            [lip + 1e-3, r, r * 0.84],
            [body, r, r * 0.86],
        ];
        s.vessel([0.0; 3], &levels, 0.03, 20);
        s.part("soil", Plan::own(Stuff::Soil));
        s.frustum([0.0, 0.0, 0.03], [r * 0.58, r * 0.84], soil - 0.03, 20);
    }
    if p.has(0) {
        bunch(s, p, [0.0, 0.0, soil - 0.01], [l * 0.46, h - soil], 9);
    }
}

fn planter(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let body = h * 0.55;
    s.part("box", p.main());
    if p.is_round() {
        // As wide as it is long.
        let r = l.min(w) * 0.5;
        s.vessel([0.0; 3], &[[0.0, r * 0.8, r * 0.7], [body, r, r - 0.06]], 0.06, 24);
        s.part("soil", Plan::own(Stuff::Soil));
        s.frustum([0.0, 0.0, 0.06], [r * 0.71, r - 0.07], body * 0.85 - 0.06, 24);
    } else {
        s.trough([0.0; 3], [l, w, body], 0.05, 0.06);
        s.part("soil", Plan::own(Stuff::Soil));
        s.block([0.0, 0.0, 0.06], [l - 0.1, w - 0.1, body * 0.85 - 0.06]);
    }
    let count = p.count(0);
    let span = if p.is_round() { l.min(w) * 0.5 } else { w * 0.88 };
    let pitch = span / count as f64;
    for y in spread(count, span - pitch) {
        let leaf = p.rng.uniform(0.8, 1.25) as f32;
        s.part("plant", Plan::painted(Stuff::Leaves, Stuff::Leaves.color().map(|channel| channel * leaf)));
        let tall = (h - body * 0.85) * p.rng.uniform(0.85, 1.0) * 0.5;
        s.ball([0.0, y, body * 0.85 + tall - 0.02], [l * 0.36, (pitch * 0.55).min(l * 0.45), tall], 8, 12);
    }
}

fn bin(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let body = if p.has(0) { h * 0.92 } else { h };
    s.part("body", p.main());
    if p.is_square() {
        s.trough([0.0; 3], [l, w, body], 0.025, 0.05);
    } else {
        let r = l * 0.5;
        s.vessel(
            [0.0; 3],
            &[
                [0.0, r * 0.86, r * 0.86 - 0.02],
                [body * 0.93, r * 0.94, r * 0.94 - 0.02],
                [body, r, r * 0.92],
            ],
            0.05,
            24,
        );
    }
    s.part("bag", Plan::painted(Stuff::Fabric, DARK));
    let inner = l * 0.5 * 0.8;
    let sides = if p.is_square() { 4 } else { 24 };
    s.pillar([0.0, 0.0, 0.05], inner, body * 0.5, sides);
    if p.has(0) {
        s.part("lid", p.shaded(0.7));
        if p.is_square() {
            s.tapered([0.0, 0.0, body], [l, w, h - body], [0.8, 0.8]);
        } else {
            s.frustum([0.0, 0.0, body], [l * 0.5, l * 0.3], h - body, 24);
        }
    }
}

fn dumpster(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (low, rim) = (0.16, h * 0.88);
    s.part("body", p.main());
    s.trough([0.0, 0.0, low], [l, w, rim - low], 0.03, 0.04);
    s.part("rib", p.shaded(0.8));
    for y in spread(4, w * 0.84) {
        s.block([l * 0.5 + 0.01, y, low + 0.05], [0.03, 0.06, rim - low - 0.1]);
        s.block([-l * 0.5 - 0.01, y, low + 0.05], [0.03, 0.06, rim - low - 0.1]);
    }
    if p.has(0) {
        s.part("lid", p.second(Stuff::Plastic, [0.02, 0.02, 0.022]));
        for y in [-w * 0.25, w * 0.25] {
            s.tapered([0.0, y, rim], [l, w * 0.49, h - rim], [0.5, 0.96]);
        }
    }
    for [x, y] in spots(4, [l * 0.36, w * 0.42]) {
        wheel(s, [x, y], low * 0.5, 0.06);
        s.part("fork", Plan::own(Stuff::Metal));
        s.block([x, y, low * 0.75], [0.08, 0.1, low * 0.25]);
    }
}

fn mailbox(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let low = h * 0.68;
    s.part("post", p.support(Stuff::Wood));
    s.block([0.0, 0.0, 0.0], [0.09, 0.09, low]);
    let mut body = p.main();
    // A sheet around a hollow.
    body.density *= 0.3;
    s.part("box", body);
    vault(s, [l, w, h - low], low);
    s.part("slot", Plan::painted(Stuff::Metal, DARK));
    s.block([l * 0.5, 0.0, low + (h - low) * 0.55], [0.008, w * 0.6, 0.025]);
    if p.has(0) {
        s.part("flag", Plan::painted(Stuff::Metal, [0.6, 0.03, 0.02]));
        s.block([l * 0.1, w * 0.5 + 0.008, low + 0.1], [0.02, 0.012, (h - low) * 0.5]);
        s.block([l * 0.1 + 0.03, w * 0.5 + 0.008, low + 0.06 + (h - low) * 0.5], [0.08, 0.012, 0.05]);
    }
}

/// A box with a round roof, its front to x, standing at a height.
fn vault(s: &mut Sculpt, [l, w, h]: [f64; 3], z: f64) {
    let r = (w * 0.5).min(h);
    let mut outline = vec![[-w * 0.5, z], [w * 0.5, z]];
    outline.extend((0..=10).map(|k| {
        let (sin, cos) = simworld_core::ops::sin_cos(std::f64::consts::PI * f64::from(k) / 10.0);
        [w * 0.5 * cos, z + h - r + r * sin]
    }));
    s.panel(&outline, -l * 0.5, l);
}

fn trough(s: &mut Sculpt, p: &mut Plan) {
    let size = p.size;
    let wall = size[0] * 0.14;
    s.part("body", p.main());
    s.trough([0.0; 3], size, wall, size[2] * 0.3);
    if p.has(0) {
        s.part("water", Plan::own(Stuff::Water));
        s.block([0.0, 0.0, size[2] * 0.3], [size[0] - 2.0 * wall, size[1] - 2.0 * wall, size[2] * 0.5]);
    }
}

fn plain_box(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let body = if p.has(0) { h * 0.85 } else { h };
    s.part("body", p.main());
    s.trough([0.0; 3], [l, w, body], 0.02, 0.02);
    if p.has(0) {
        s.part("lid", p.shaded(0.8));
        s.block([0.0, 0.0, body], [l, w, h - body]);
    }
}
