//! What stands along streets: lamps, signs, bollards and the like.

use std::f64::consts::FRAC_PI_2;

use simworld_core::scene::EntityKind;

use super::super::sculpt::{Hulls, Sculpt};
use super::super::stuff::Stuff;
use super::super::thing::{Plan, Takes, Thing};
use super::{DARK, PROP, WHITE, around, spots, spread};

const GLOW: [f32; 3] = [0.9, 0.82, 0.6];
const GREEN: [f32; 3] = [0.03, 0.08, 0.05];

#[rustfmt::skip]
pub(super) const THINGS: &[Thing] = &[
    Thing { names: &["lamp post", "street lamp", "lamppost", "streetlamp", "streetlight", "street light"], kind: EntityKind::StreetLamp,
        size: [0.5, 0.5, 4.2], stuff: Stuff::Metal, color: Some(GREEN), mass: [15.0, 250.0],
        takes: &[Takes::Material, Takes::Count { of: &["lamps", "lamp", "lights", "light", "lanterns", "lantern", "arms", "arm", "armed", "heads", "head"], usual: 1, least: 1, most: 6 }],
        make: lamp_post, ..PROP },
    Thing { names: &["traffic light", "traffic signal", "stop light", "stoplight"], kind: EntityKind::TrafficSignal, size: [0.4, 0.4, 3.4], stuff: Stuff::Metal,
        color: Some([0.04, 0.042, 0.045]), mass: [15.0, 150.0], takes: &[], make: traffic_light, ..PROP },
    Thing { names: &["bollard"], size: [0.2, 0.2, 0.95], stuff: Stuff::Metal, color: Some([0.06, 0.06, 0.065]), mass: [10.0, 60.0],
        takes: &[Takes::Material, Takes::Square, Takes::Accent], make: bollard, ..PROP },
    Thing { names: &["traffic cone", "road cone", "safety cone", "cone", "pylon"], kind: EntityKind::Cone, size: [0.4, 0.4, 0.72], stuff: Stuff::Plastic,
        color: Some([0.85, 0.16, 0.01]), mass: [1.0, 12.0], takes: &[Takes::Accent, Takes::Count { of: &["stripes", "stripe", "bands", "band"], usual: 2, least: 0, most: 4 }],
        make: cone, ..PROP },
    Thing { names: &["barrier", "barricade", "roadblock", "road block"], size: [0.5, 1.8, 1.0], stuff: Stuff::Plastic, color: Some([0.75, 0.04, 0.03]), mass: [4.0, 90.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Count { of: &["boards", "board", "planks", "plank", "rails", "rail"], usual: 2, least: 1, most: 4 }], make: barrier, ..PROP },
    Thing { names: &["sign", "signpost", "road sign", "street sign", "traffic sign", "sign post"], kind: EntityKind::Sign, size: [0.1, 0.65, 2.5], stuff: Stuff::Metal,
        color: Some([0.02, 0.1, 0.4]), mass: [4.0, 60.0], takes: &[Takes::Round, Takes::Accent,
            Takes::Count { of: &["boards", "board", "panels", "panel", "plates", "plate"], usual: 1, least: 1, most: 4 }], make: sign, ..PROP },
    Thing { names: &["billboard", "advertising board", "hoarding"], kind: EntityKind::Sign, size: [0.5, 5.0, 5.2], stuff: Stuff::Metal, color: Some([0.75, 0.72, 0.65]),
        mass: [150.0, 3500.0], takes: &[Takes::Accent, Takes::Count { of: &["posts", "post", "legs", "leg", "legged"], usual: 2, least: 1, most: 4 }],
        make: billboard, ..PROP },
    Thing { names: &["phone box", "telephone box", "phone booth", "telephone booth", "call box"], size: [0.95, 0.95, 2.5], stuff: Stuff::Iron, color: Some([0.5, 0.02, 0.02]),
        mass: [250.0, 1600.0], takes: &[], make: phone_box, ..PROP },
    Thing { names: &["bicycle rack", "bike rack", "bike stand", "bicycle stand", "cycle rack"], size: [0.75, 2.4, 0.85], stuff: Stuff::Metal, mass: [10.0, 90.0],
        takes: &[Takes::Count { of: &["hoops", "hoop", "places", "place", "bars", "bar", "stands", "loops", "loop"], usual: 4, least: 1, most: 12 }],
        make: bike_rack, ..PROP },
    Thing { names: &["flag pole", "flagpole", "flag", "flagstaff", "banner"], size: [0.3, 1.5, 6.0], stuff: Stuff::Fabric, color: Some([0.6, 0.03, 0.03]), mass: [8.0, 130.0],
        takes: &[Takes::Accent], make: flag_pole, ..PROP },
    Thing { names: &["hydrant", "fire hydrant", "fireplug"], kind: EntityKind::Hydrant, size: [0.36, 0.36, 0.8], stuff: Stuff::Iron, color: Some([0.55, 0.03, 0.02]),
        mass: [25.0, 200.0], takes: &[Takes::Accent], make: hydrant, ..PROP },
    Thing { names: &["parking meter", "ticket machine"], size: [0.2, 0.25, 1.4], stuff: Stuff::Metal, mass: [5.0, 50.0], takes: &[], make: meter, ..PROP },
    Thing { names: &["manhole", "manhole cover"], size: [0.7, 0.7, 0.04], stuff: Stuff::Iron, mass: [15.0, 80.0], takes: &[Takes::Square], make: manhole, ..PROP },
];

fn lamp_post(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let lamps = p.count(0);
    let (base, head) = (h * 0.12, (h * 0.14).min(0.6));
    s.part("base", p.main());
    s.lathe(
        [0.0; 3],
        &[[0.16, 0.0], [0.16, base * 0.4], [0.1, base * 0.6], [0.07, base]],
        12,
        Hulls::Segments,
    );
    let lift = if lamps == 1 { head } else { 0.12 };
    s.part("post", p.main());
    s.frustum([0.0, 0.0, base], [0.06, 0.045], h - base - lift, 12);
    if lamps == 1 {
        lantern(s, p, [0.0, 0.0, h - head], [l * 0.5, head]);
        return;
    }
    s.frustum([0.0, 0.0, h - lift], [0.05, 0.01], lift, 12);
    let reach = l * 1.3;
    for [cos, sin] in around(lamps) {
        s.part("arm", p.main());
        let place = |share: f64, z: f64| [cos * reach * share, sin * reach * share, z];
        s.tube(&[place(0.0, h * 0.86), place(0.5, h * 0.95), place(1.0, h * 0.93)], [0.03, 0.025], 8);
        lantern(s, p, place(1.0, h * 0.93 - head), [l * 0.4, head]);
    }
}

/// A lamp between its foot and its cap.
fn lantern(s: &mut Sculpt, p: &Plan, at: [f64; 3], [radius, height]: [f64; 2]) {
    let [x, y, z] = at;
    s.part("fitting", p.main());
    s.frustum(at, [radius * 0.3, radius * 0.55], height * 0.12, 8);
    s.part("glass", Plan::painted(Stuff::Glass, GLOW));
    s.frustum([x, y, z + height * 0.12], [radius * 0.5, radius * 0.8], height * 0.53, 8);
    s.part("cap", p.main());
    s.lathe(
        [x, y, z + height * 0.65],
        &[[radius, 0.0], [radius * 0.35, height * 0.22], [0.02, height * 0.35]],
        8,
        Hulls::Segments,
    );
}

fn traffic_light(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let case = h * 0.3;
    s.part("post", p.support(Stuff::Metal));
    s.pillar([-l * 0.3, 0.0, 0.0], 0.06, h - case * 0.3, 12);
    s.part("foot", p.main());
    s.pillar([-l * 0.3, 0.0, 0.0], 0.14, 0.05, 12);
    // A case around lamps.
    let mut sheet = p.main();
    sheet.density *= 0.3;
    s.part("case", sheet);
    s.block([0.0, 0.0, h - case], [l * 0.45, w * 0.85, case]);
    for (k, color) in [[0.03, 0.55, 0.15], [0.8, 0.45, 0.02], [0.75, 0.02, 0.02]].into_iter().enumerate() {
        let z = h - case + case * (k as f64 + 0.5) / 3.0;
        let x = l * 0.225;
        s.part("light", Plan::painted(Stuff::Glass, color));
        s.ball([x, 0.0, z], [0.04, case * 0.12, case * 0.12], 6, 12);
        s.part("visor", p.main());
        s.block([x + 0.05, 0.0, z + case * 0.125], [0.14, case * 0.26, 0.012]);
    }
    s.part("board", Plan::painted(Stuff::Metal, DARK));
    s.block([-l * 0.2, 0.0, h - case * 1.02], [0.02, w, case * 1.02]);
}

fn bollard(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let (r, sides) = (l * 0.5, if p.is_square() { 4 } else { 16 });
    s.part("foot", p.shaded(0.8));
    s.pillar([0.0; 3], r, h * 0.06, sides);
    s.part("post", p.main());
    s.frustum([0.0, 0.0, h * 0.06], [r * 0.78, r * 0.7], h * 0.84, sides);
    s.part("cap", p.main());
    s.lathe(
        [0.0, 0.0, h * 0.9],
        &[[r * 0.85, 0.0], [r * 0.85, h * 0.04], [r * 0.5, h * 0.085], [0.0, h * 0.1]],
        sides,
        Hulls::Whole,
    );
    s.part("band", p.second(Stuff::Plastic, WHITE));
    s.pillar([0.0, 0.0, h * 0.68], r * 0.78, h * 0.08, sides);
}

fn cone(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let foot = h * 0.06;
    // Hollow from below.
    let mut rubber = Plan::own(Stuff::Rubber);
    rubber.density *= 0.4;
    s.part("foot", rubber);
    s.tapered([0.0; 3], [l, w, foot], [0.94, 0.94]);
    let radius = |z: f64| l * (0.36 - 0.3 * z / (h - foot));
    s.part("cone", p.main());
    s.frustum([0.0, 0.0, foot], [radius(0.0), radius(h - foot)], h - foot, 20);
    s.part("stripe", p.second(Stuff::Plastic, WHITE));
    let stripes = p.count(0);
    for z in spread(stripes, h * 0.16 * (stripes.max(1) - 1) as f64) {
        let low = h * 0.52 + z - foot;
        let high = low + h * 0.09;
        s.frustum([0.0, 0.0, foot + low], [radius(low) + 0.004, radius(high) + 0.004], high - low, 20);
    }
}

fn barrier(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    s.part("foot", Plan::own(Stuff::Metal));
    for y in [-w * 0.4, w * 0.4] {
        for side in [-1.0, 1.0] {
            s.bar([side * (l * 0.5 - 0.02), y, 0.0], [0.0, y, h * 0.96], [0.02, 0.02], 6);
        }
    }
    let boards = p.count(0);
    let pitch = h * 0.62 / boards as f64;
    let stripes = 8;
    for level in 0..boards {
        let z = h - pitch * (level as f64 + 1.0) + pitch * 0.3;
        for (index, y) in spread(stripes, w * (1.0 - 1.0 / stripes as f64)).enumerate() {
            let finish = if index % 2 == 0 { p.main() } else { p.second(p.stuff, WHITE) };
            s.part("board", finish);
            s.block([0.0, y, z], [0.05, w / stripes as f64, pitch * 0.7]);
        }
    }
}

fn sign(s: &mut Sculpt, p: &mut Plan) {
    let [_, w, h] = p.size;
    let plates = p.count(0);
    s.part("post", Plan::own(Stuff::Metal));
    s.pillar([-0.02, 0.0, 0.0], 0.03, h * 0.98, 10);
    let tall = if p.is_round() { w } else { w * 0.8 }.min(h * 0.62 / plates as f64);
    for level in 0..plates {
        let z = h - tall * 0.5 - level as f64 * tall * 1.08;
        let wide = if p.is_round() { tall } else { w };
        plate(s, p, z, [wide, tall]);
    }
}

/// A plate with a rim, facing the front.
fn plate(s: &mut Sculpt, p: &Plan, z: f64, [wide, tall]: [f64; 2]) {
    let finishes = [p.second(Stuff::Metal, WHITE), p.main()];
    for ((x, share), finish) in [(0.01, 1.0), (0.018, 0.86)].into_iter().zip(finishes) {
        s.part("plate", finish);
        if p.is_round() {
            s.placed([x, 0.0, z], [0.0, FRAC_PI_2, 0.0], |s| {
                s.pillar([0.0; 3], wide * 0.5 * share, 0.015, 24);
            });
        } else {
            let rim = (1.0 - share) * tall;
            s.block([x + 0.0075, 0.0, z - tall * 0.5 + rim * 0.5], [0.015, wide - rim, tall - rim]);
        }
    }
}

fn billboard(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let board = h * 0.5;
    s.part("post", Plan::own(Stuff::Metal));
    for y in spread(p.count(0), w * 0.6) {
        s.pillar([-l * 0.2, y, 0.0], 0.11, h - board * 0.2, 12);
        s.block([-l * 0.2, y, 0.0], [l * 0.6, 0.4, 0.08]);
    }
    s.part("frame", p.second(Stuff::Metal, [0.08, 0.09, 0.1]));
    s.block([0.0, 0.0, h - board], [l * 0.3, w, board]);
    s.part("picture", p.main());
    s.block([l * 0.15 + 0.01, 0.0, h - board * 0.96], [0.02, w * 0.97, board * 0.92]);
    s.part("catwalk", Plan::own(Stuff::Metal));
    s.block([l * 0.25, 0.0, h - board - 0.06], [l * 0.5, w * 0.98, 0.05]);
}

fn phone_box(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (post, body) = (0.1, h * 0.86);
    s.part("floor", p.shaded(0.6));
    s.block([0.0; 3], [l * 0.96, w * 0.96, 0.08]);
    s.part("frame", p.main());
    for [x, y] in spots(4, [(l * 0.94 - post) * 0.5, (w * 0.94 - post) * 0.5]) {
        s.block([x, y, 0.08], [post, post, body - 0.08]);
    }
    for yaw in 0..4 {
        let side = if yaw % 2 == 0 { [l, w] } else { [w, l] };
        s.placed([0.0; 3], [0.0, 0.0, f64::from(yaw) * FRAC_PI_2], |s| {
            let (x, wide) = (side[0] * 0.47 - post * 0.5, side[1] * 0.94 - 2.0 * post);
            s.part("pane", Plan::own(Stuff::Glass));
            s.block([x, 0.0, 0.3], [0.02, wide, body - 0.4]);
            s.part("frame", p.main());
            s.block([x, 0.0, 0.08], [0.05, wide, 0.22]);
            s.block([x, 0.0, body - 0.1], [0.05, wide, 0.1]);
            for z in spread(5, body * 0.5) {
                s.block([x, 0.0, body * 0.55 + z], [0.035, wide, 0.025]);
            }
            s.block([x, 0.0, 0.3], [0.035, 0.025, body - 0.4]);
        });
    }
    s.part("roof", p.main());
    s.block([0.0, 0.0, body], [l, w, h * 0.07]);
    s.tapered([0.0, 0.0, body + h * 0.07], [l * 0.9, w * 0.9, h * 0.07], [0.5, 0.5]);
    s.part("lettering", Plan::painted(Stuff::Metal, WHITE));
    s.block([l * 0.5, 0.0, body + h * 0.015], [0.006, w * 0.7, h * 0.04]);
}

fn bike_rack(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let hoops = p.count(0);
    let (tube, r) = (0.024, (l * 0.5 - 0.024).min(h * 0.4));
    for y in spread(hoops, w - 2.0 * tube) {
        s.part("hoop", p.main());
        let mut path = vec![[l * 0.5 - tube, y, 0.0]];
        path.extend((0..=8).map(|k| {
            let (sin, cos) = simworld_core::ops::sin_cos(std::f64::consts::PI * f64::from(k) / 8.0);
            [(l * 0.5 - tube) * cos, y, h - tube - r + r * sin]
        }));
        path.push([-l * 0.5 + tube, y, 0.0]);
        s.tube(&path, [tube; 2], 8);
    }
    s.part("rail", p.shaded(0.8));
    for x in [-1.0, 1.0].map(|side| side * (l * 0.5 - tube)) {
        s.block([x, 0.0, 0.0], [tube * 2.0, w, 0.012]);
    }
}

fn flag_pole(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    s.part("foot", Plan::own(Stuff::Concrete));
    s.pillar([0.0, -w * 0.5 + l * 0.5, 0.0], l * 0.5, 0.1, 16);
    s.part("pole", Plan::painted(Stuff::Metal, WHITE));
    let y = -w * 0.5 + l * 0.5;
    s.frustum([0.0, y, 0.1], [0.05, 0.03], h - 0.2, 12);
    s.part("knob", Plan::painted(Stuff::Metal, [0.6, 0.4, 0.08]));
    s.ball([0.0, y, h - 0.06], [0.06; 3], 8, 12);
    // The cloth waves in three folds.
    let tall = (w * 0.6).min(h * 0.3);
    let steps = 8;
    let reach = w - l * 0.5 - 0.04;
    let wave = |k: usize| {
        let share = k as f64 / steps as f64;
        [0.08 * share * simworld_core::ops::sin(share * 7.5), y + 0.04 + reach * share]
    };
    for stripe in 0..3 {
        s.part("cloth", if stripe == 1 { p.second(Stuff::Fabric, WHITE) } else { p.main() });
        let low = h - 0.15 - tall * f64::from(stripe + 1) / 3.0;
        let strip = |k: usize| {
            let [x, y] = wave(k);
            let edge = |x: f64| [low, low + tall / 3.0].map(|z| [x, y, z].into()).to_vec();
            (edge(x + 0.006), edge(x - 0.006))
        };
        s.shell(&(0..=steps).map(strip).collect::<Vec<_>>());
    }
}

fn hydrant(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let r = l * 0.32;
    s.part("body", p.main());
    s.pillar([0.0; 3], l * 0.44, h * 0.06, 16);
    s.pillar([0.0, 0.0, h * 0.06], r, h * 0.62, 16);
    s.pillar([0.0, 0.0, h * 0.66], l * 0.4, h * 0.05, 16);
    s.part("cap", p.second(Stuff::Iron, [0.6, 0.4, 0.05]));
    s.lathe(
        [0.0, 0.0, h * 0.71],
        &[[r, 0.0], [r * 0.9, h * 0.1], [r * 0.5, h * 0.19], [0.04, h * 0.22]],
        16,
        Hulls::Whole,
    );
    s.pillar([0.0, 0.0, h * 0.92], 0.035, h * 0.08, 6);
    for y in [-1.0, 1.0] {
        s.bar([0.0, 0.0, h * 0.5], [0.0, y * l * 0.5, h * 0.5], [l * 0.14; 2], 12);
    }
    s.bar([0.0, 0.0, h * 0.42], [l * 0.5, 0.0, h * 0.42], [l * 0.18; 2], 12);
}

fn meter(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    s.part("post", Plan::own(Stuff::Metal));
    s.pillar([0.0; 3], l * 0.25, h * 0.7, 12);
    s.part("head", p.shaded(1.0));
    s.tapered([0.0, 0.0, h * 0.68], [l * 0.9, w, h * 0.32], [0.7, 0.7]);
    s.part("display", Plan::painted(Stuff::Glass, [0.02, 0.05, 0.03]));
    s.block([l * 0.42, 0.0, h * 0.78], [l * 0.06, w * 0.5, h * 0.1]);
}

fn manhole(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let sides = if p.is_square() { 4 } else { 32 };
    s.part("frame", p.shaded(0.7));
    s.pillar([0.0; 3], l * 0.5, h * 0.7, sides);
    s.part("cover", p.main());
    s.pillar([0.0, 0.0, h * 0.7], l * 0.44, h * 0.3, sides);
}
