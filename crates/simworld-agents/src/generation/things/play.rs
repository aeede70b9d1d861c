//! What stands on playgrounds.

use std::f64::consts::FRAC_PI_2;

use super::super::sculpt::Sculpt;
use super::super::stuff::Stuff;
use super::super::thing::{Plan, Takes, Thing};
use super::{PROP, around, spread};

const BLUE: [f32; 3] = [0.03, 0.15, 0.45];
const RED: [f32; 3] = [0.6, 0.04, 0.03];

#[rustfmt::skip]
pub(super) const THINGS: &[Thing] = &[
    Thing { names: &["slide", "playground slide"], size: [3.2, 0.7, 2.3], stuff: Stuff::Metal, color: Some(RED), mass: [30.0, 400.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Count { of: &["rungs", "rung", "steps", "step"], usual: 5, least: 2, most: 14 }], make: slide, ..PROP },
    Thing { names: &["swing", "swings", "swing set"], size: [1.8, 3.0, 2.3], mass: [30.0, 300.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Count { of: &["seats", "seat", "seater", "swings"], usual: 2, least: 1, most: 5 }], make: swing, ..PROP },
    Thing { names: &["see-saw", "seesaw", "teeter totter", "see saw"], size: [3.0, 0.45, 1.25], color: Some([0.6, 0.4, 0.03]), mass: [20.0, 250.0],
        takes: &[Takes::Material, Takes::Accent], make: seesaw, ..PROP },
    Thing { names: &["sandbox", "sandpit", "sand pit", "sand box"], size: [2.4, 2.4, 0.4], mass: [400.0, 5000.0], takes: &[Takes::Material, Takes::Round], make: sandbox, ..PROP },
    Thing { names: &["merry-go-round", "roundabout", "carousel"], size: [2.2, 2.2, 0.95], stuff: Stuff::Metal, color: Some(BLUE), mass: [80.0, 900.0],
        takes: &[Takes::Accent, Takes::Count { of: &["bars", "bar", "handles", "handle", "arms", "arm"], usual: 6, least: 3, most: 12 }], make: merry_go_round, ..PROP },
    Thing { names: &["climbing frame", "jungle gym", "monkey bars"], size: [2.0, 2.0, 2.2], stuff: Stuff::Metal, color: Some(BLUE), mass: [25.0, 400.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Count { of: &["levels", "level", "storeys", "storey", "tiers", "tier"], usual: 3, least: 1, most: 6 }],
        make: climbing_frame, ..PROP },
    Thing { names: &["goal", "football goal", "soccer goal"], size: [1.2, 3.0, 2.0], stuff: Stuff::Metal, color: Some([0.8, 0.8, 0.8]), mass: [10.0, 150.0], takes: &[], make: goal, ..PROP },
    Thing { names: &["basketball hoop", "basket ball hoop", "hoop"], size: [1.3, 1.8, 3.9], stuff: Stuff::Metal, mass: [30.0, 400.0], takes: &[Takes::Accent], make: hoop, ..PROP },
];

fn slide(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let deck = h * 0.66;
    let (back, edge) = (-l * 0.5, -l * 0.5 + l * 0.3);
    s.part("post", p.second(Stuff::Metal, BLUE));
    for x in [back + l * 0.1, edge] {
        for y in [-1.0, 1.0].map(|side| side * (w * 0.5 - 0.03)) {
            s.pillar([x, y, 0.0], 0.03, h, 8);
        }
    }
    for y in [-1.0, 1.0].map(|side| side * (w * 0.5 - 0.03)) {
        s.bar([back + l * 0.1, y, h - 0.03], [edge, y, h - 0.03], [0.03; 2], 8);
    }
    s.part("deck", p.shaded(0.7));
    s.block([(back + l * 0.1 + edge) * 0.5, 0.0, deck - 0.05], [edge - back - l * 0.1, w * 0.9, 0.05]);
    s.part("ladder", p.second(Stuff::Metal, BLUE));
    let rungs = p.count(0);
    for y in [-1.0, 1.0].map(|side| side * w * 0.36) {
        s.bar([back + 0.03, y, 0.0], [back + l * 0.1, y, deck], [0.025; 2], 8);
    }
    for k in 1..=rungs {
        let share = k as f64 / (rungs + 1) as f64;
        let x = back + 0.03 + (l * 0.1 - 0.03) * share;
        s.bar([x, -w * 0.36, deck * share], [x, w * 0.36, deck * share], [0.02; 2], 8);
    }
    // The chute: a floor with two rims, flat at its foot.
    let (end, out) = (l * 0.5, h * 0.1);
    let path = [[edge, deck], [edge + (end - edge) * 0.78, out], [end, out * 0.8]];
    let (half, rim, sheet) = (w * 0.42, 0.14, 0.02);
    let strip = |[x, z]: [f64; 2]| {
        let at = |y: f64, lift: f64| super::super::sculpt::V::new(x, y, z + lift);
        let outer = vec![
            at(-half - sheet, rim),
            at(-half - sheet, -sheet),
            at(half + sheet, -sheet),
            at(half + sheet, rim),
        ];
        let inner = vec![at(-half, rim), at(-half, 0.0), at(half, 0.0), at(half, rim)];
        (outer, inner)
    };
    s.part("chute", p.main());
    s.shell(&path.map(strip));
    s.part("post", p.second(Stuff::Metal, BLUE));
    for y in [-half * 0.8, half * 0.8] {
        s.pillar([end - 0.2, y, 0.0], 0.025, out * 0.84 - sheet, 8);
    }
}

fn swing(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let beam = h - 0.06;
    s.part("frame", p.main());
    for y in [-1.0, 1.0].map(|side| side * (w * 0.5 - 0.1)) {
        for x in [-1.0, 1.0] {
            s.bar([x * (l * 0.5 - 0.05), y, 0.0], [0.0, y, beam], [0.05; 2], 8);
        }
    }
    s.bar([0.0, -w * 0.5, beam], [0.0, w * 0.5, beam], [0.06; 2], 10);
    let seats = p.count(0);
    let pitch = (w - 0.4) / seats as f64;
    for y in spread(seats, w - 0.4 - pitch) {
        let half = (pitch * 0.3).min(0.24);
        s.part("rope", Plan::own(Stuff::Straw));
        for side in [-half, half] {
            s.bar([0.0, y + side, 0.46], [0.0, y + side, beam], [0.012; 2], 6);
        }
        s.part("seat", p.second(Stuff::Plastic, RED));
        s.block([0.0, y, 0.43], [0.22, half * 2.0 + 0.06, 0.03]);
    }
}

fn seesaw(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let pivot = h * 0.42;
    s.part("stand", p.second(Stuff::Metal, BLUE));
    s.placed([0.0; 3], [0.0, 0.0, FRAC_PI_2], |s| {
        s.panel(&[[-0.28, 0.0], [0.28, 0.0], [0.06, pivot], [-0.06, pivot]], -w * 0.4, w * 0.8);
    });
    // It rests on its front end.
    let tilt = simworld_core::ops::atan2(pivot - 0.06, l * 0.5);
    let (half, thick) = (l * 0.495, 0.05);
    s.placed([0.0, 0.0, pivot], [0.0, tilt, 0.0], |s| {
        s.part("plank", p.main());
        s.block([0.0; 3], [half * 2.0, w, thick]);
        for x in [-half * 0.76, half * 0.76] {
            s.part("handle", p.second(Stuff::Metal, BLUE));
            let (low, high) = (thick, thick + h * 0.2);
            let grip = |y: f64| [[x, y * 0.9, low], [x, y, high]];
            let ([a, b], [d, c]) = (grip(-w * 0.4), grip(w * 0.4));
            s.tube(&[a, b, c, d], [0.016; 2], 8);
        }
    });
}

fn sandbox(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    s.part("rim", p.main());
    if p.is_round() {
        let r = l * 0.5;
        s.vessel([0.0; 3], &[[0.0, r, r - 0.12], [h, r, r - 0.12]], 0.04, 32);
        s.part("sand", Plan::own(Stuff::Sand));
        s.pillar([0.0, 0.0, 0.04], r - 0.12, h * 0.5, 32);
        return;
    }
    s.trough([0.0; 3], [l, w, h], 0.06, 0.04);
    s.part("sand", Plan::own(Stuff::Sand));
    s.block([0.0, 0.0, 0.04], [l - 0.12, w - 0.12, h * 0.5]);
    for [x, y] in super::spots(4, [l * 0.5 - 0.17, w * 0.5 - 0.17]) {
        s.part("seat", p.varied());
        s.block([x, y, h - 0.04], [0.34, 0.34, 0.04]);
    }
    s.part("bucket", Plan::painted(Stuff::Plastic, RED));
    s.frustum([l * 0.16, w * 0.1, 0.04 + h * 0.5], [0.09, 0.07], h * 0.3, 12);
}

fn merry_go_round(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let r = l * 0.5;
    s.part("hub", Plan::own(Stuff::Metal));
    s.pillar([0.0; 3], r * 0.3, h * 0.2, 20);
    s.part("disc", p.main());
    s.pillar([0.0, 0.0, h * 0.2], r, h * 0.08, 32);
    s.part("bar", p.second(Stuff::Metal, RED));
    s.pillar([0.0, 0.0, h * 0.28], 0.05, h * 0.7, 12);
    for [cos, sin] in around(p.count(0)) {
        let at = |share: f64, z: f64| [r * share * cos, r * share * sin, h * z];
        s.tube(&[at(0.88, 0.27), at(0.88, 0.8), at(0.75, 0.95), at(0.0, 0.95)], [0.022; 2], 8);
    }
    s.part("knob", p.main());
    s.ball([0.0, 0.0, h * 0.95], [0.09, 0.09, h * 0.05], 8, 12);
}

fn climbing_frame(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let levels = p.count(0);
    let tube = 0.022;
    let (xs, ys): (Vec<f64>, Vec<f64>) =
        (spread(3, l - 2.0 * tube).collect(), spread(3, w - 2.0 * tube).collect());
    s.part("post", p.main());
    for x in &xs {
        for y in &ys {
            s.pillar([*x, *y, 0.0], tube, h, 8);
        }
    }
    s.part("bar", p.second(Stuff::Metal, [0.7, 0.5, 0.03]));
    for level in 1..=levels {
        let z = (h - tube) * level as f64 / levels as f64;
        for x in &xs {
            s.bar([*x, ys[0], z], [*x, ys[2], z], [tube * 0.8; 2], 8);
        }
        for y in &ys {
            s.bar([xs[0], *y, z], [xs[2], *y, z], [tube * 0.8; 2], 8);
        }
    }
}

fn goal(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let post = 0.05;
    let (front, back) = (l * 0.5 - post, -l * 0.5 + post);
    s.part("frame", p.main());
    for y in [-1.0, 1.0].map(|side| side * (w * 0.5 - post)) {
        s.pillar([front, y, 0.0], post, h - post, 12);
        s.bar([front, y, post], [back, y, post], [0.03; 2], 8);
        s.bar([back, y, post], [front, y, h - post], [0.03; 2], 8);
    }
    s.bar([front, -w * 0.5, h - post], [front, w * 0.5, h - post], [post; 2], 12);
    s.bar([back, -w * 0.5 + post, post], [back, w * 0.5 - post, post], [0.03; 2], 8);
    s.part("net", Plan::painted(Stuff::Fabric, [0.5, 0.5, 0.5]));
    for y in spread(13, w - 4.0 * post) {
        s.bar([back, y, post], [front, y, h - post], [0.006; 2], 4);
    }
    for k in 1..8 {
        let share = f64::from(k) / 8.0;
        let (x, z) = (back + (front - back) * share, post + (h - 2.0 * post) * share);
        s.bar([x, -w * 0.5 + post, z], [x, w * 0.5 - post, z], [0.006; 2], 4);
    }
}

fn hoop(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let back = -l * 0.5;
    let board = w * 0.58;
    s.part("post", p.main());
    s.pillar([back + 0.12, 0.0, 0.0], 0.08, h * 0.78, 12);
    s.block([back + 0.25, 0.0, 0.0], [0.5, 0.5, 0.06]);
    s.bar([back + 0.12, 0.0, h * 0.76], [l * 0.1, 0.0, h - board * 0.5], [0.06; 2], 8);
    s.part("board", Plan::painted(Stuff::Plastic, [0.8, 0.8, 0.8]));
    s.block([l * 0.12, 0.0, h - board], [0.04, w, board]);
    s.part("mark", p.second(Stuff::Plastic, RED));
    s.block([l * 0.12 + 0.02, 0.0, h - board * 0.75], [0.006, w * 0.3, board * 0.4]);
    s.part("rim", p.second(Stuff::Metal, [0.75, 0.2, 0.02]));
    s.hoop([l * 0.5 - 0.25, 0.0, h - board * 0.8], 0.23, 0.016, 24);
    s.block([l * 0.14 + 0.03, 0.0, h - board * 0.8 - 0.02], [0.1, 0.14, 0.04]);
}
