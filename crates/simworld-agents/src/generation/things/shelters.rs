//! Roofs and counters: stalls, kiosks, shelters, tents and parasols.

use simworld_core::scene::EntityKind;

use super::super::sculpt::Sculpt;
use super::super::stuff::Stuff;
use super::super::thing::{Plan, Takes, Thing, Usual};
use super::{DARK, PROP, WHITE, around, spots, spread};

#[rustfmt::skip]
pub(super) const THINGS: &[Thing] = &[
    Thing { names: &["market stall", "stall", "market stand", "fruit stall", "market booth"], size: [1.8, 2.6, 2.5], color: Some([0.6, 0.05, 0.04]), mass: [60.0, 400.0],
        takes: &[Takes::Accent, Takes::Feature { what: &["goods", "fruit", "vegetables", "wares"], usual: Usual::With }], make: stall, ..PROP },
    Thing { names: &["kiosk", "newsstand", "news stand", "ticket booth", "booth"], size: [2.2, 2.6, 2.8], color: Some([0.1, 0.22, 0.18]), mass: [350.0, 3000.0],
        takes: &[Takes::Material, Takes::Accent], make: kiosk, ..PROP },
    Thing { names: &["bus shelter", "bus stop", "shelter"], kind: EntityKind::BusStop, size: [1.5, 3.8, 2.5], stuff: Stuff::Metal, mass: [150.0, 1500.0],
        takes: &[Takes::Feature { what: &["bench", "seat"], usual: Usual::With }], make: shelter, ..PROP },
    Thing { names: &["tent"], size: [2.4, 2.2, 1.5], stuff: Stuff::Fabric, color: Some([0.55, 0.25, 0.03]), mass: [4.0, 120.0], takes: &[Takes::Accent], make: tent, ..PROP },
    Thing { names: &["parasol", "umbrella", "sunshade", "beach umbrella"], size: [2.6, 2.6, 2.5], stuff: Stuff::Fabric, color: Some([0.6, 0.06, 0.04]), mass: [25.0, 250.0],
        takes: &[Takes::Accent, Takes::Count { of: &["panels", "panel", "segments", "segment", "ribs", "rib"], usual: 8, least: 4, most: 16 }], make: parasol, ..PROP },
    Thing { names: &["pavilion", "gazebo", "bandstand"], size: [4.0, 4.0, 4.0], color: Some([0.7, 0.68, 0.62]), mass: [500.0, 16_000.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Count { of: &["columns", "column", "posts", "post", "pillars", "pillar"], usual: 8, least: 3, most: 12 }],
        make: pavilion, ..PROP },
    Thing { names: &["pergola", "trellis"], size: [2.5, 4.0, 2.5], mass: [90.0, 900.0],
        takes: &[Takes::Material, Takes::Count { of: &["beams", "beam", "slats", "slat"], usual: 9, least: 3, most: 20 }], make: pergola, ..PROP },
    Thing { names: &["carport", "canopy", "awning"], size: [5.0, 3.0, 2.6], mass: [150.0, 2500.0], takes: &[Takes::Material, Takes::Accent], make: canopy, ..PROP },
];

fn stall(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (eaves, ridge, counter) = (h * 0.8, h, h * 0.36);
    s.part("post", Plan::own(Stuff::Wood));
    for y in [-w * 0.46, w * 0.46] {
        s.block([l * 0.42, y, 0.0], [0.07, 0.07, eaves]);
        s.block([-l * 0.42, y, 0.0], [0.07, 0.07, ridge - 0.06]);
    }
    s.part("counter", Plan::own(Stuff::Wood));
    s.block([l * 0.1, 0.0, counter - 0.05], [l * 0.55, w * 0.96, 0.05]);
    s.block([l * 0.36, 0.0, 0.1], [0.03, w * 0.9, counter - 0.15]);
    if p.has(0) {
        const GOODS: [[f32; 3]; 4] =
            [[0.6, 0.08, 0.03], [0.75, 0.4, 0.03], [0.15, 0.35, 0.05], [0.7, 0.6, 0.08]];
        let pitch = w * 0.9 / 4.0;
        for y in spread(4, w * 0.9 - pitch) {
            s.part("tray", Plan::painted(Stuff::Wood, [0.4, 0.28, 0.14]));
            s.trough([l * 0.1, y, counter], [l * 0.4, pitch * 0.9, 0.12], 0.015, 0.02);
            s.part("goods", Plan::painted(Stuff::Straw, GOODS[p.rng.below(GOODS.len())]));
            s.tapered([l * 0.1, y, counter + 0.02], [l * 0.36, pitch * 0.78, 0.16], [0.6, 0.6]);
        }
    }
    // Stripes of cloth from the ridge at the back down to the front.
    let stripes = 9;
    let pitch = w / stripes as f64;
    for (index, y) in spread(stripes, w - pitch).enumerate() {
        s.part(
            "awning",
            if index % 2 == 0 {
                Plan { stuff: Stuff::Fabric, ..p.clone() }.main()
            } else {
                p.second(Stuff::Fabric, WHITE)
            },
        );
        let edge = |x: f64, z: f64| vec![[x, y - pitch * 0.5, z].into(), [x, y + pitch * 0.5, z].into()];
        let strip = |x: f64, z: f64| (edge(x, z), edge(x, z - 0.025));
        s.shell(&[strip(-l * 0.5, ridge), strip(l * 0.5 - 0.02, eaves)]);
        s.block([l * 0.5 - 0.01, y, eaves - 0.2], [0.02, pitch, 0.2]);
    }
}

fn kiosk(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (wall, counter, top) = (0.07, h * 0.38, h * 0.84);
    let (dl, dw) = (l * 0.86, w * 0.9);
    s.part("wall", p.main());
    s.block([-dl * 0.5 + wall * 0.5, 0.0, 0.0], [wall, dw, top]);
    for side in [-1.0, 1.0] {
        s.block([0.0, side * (dw - wall) * 0.5, 0.0], [dl - 2.0 * wall, wall, top]);
        s.block(
            [(dl - wall) * 0.5, side * (dw - wall * 2.0) * 0.5, counter],
            [wall, wall * 2.0, top - counter],
        );
    }
    s.block([(dl - wall) * 0.5, 0.0, 0.0], [wall, dw, counter]);
    s.block([(dl - wall) * 0.5, 0.0, top - 0.25], [wall, dw - wall * 4.0, 0.25]);
    s.part("counter", p.second(Stuff::Wood, [0.35, 0.22, 0.1]));
    s.block([dl * 0.5 + 0.08, 0.0, counter], [0.34, dw * 0.92, 0.04]);
    s.part("inside", Plan::painted(Stuff::Wood, DARK));
    s.block([0.0, 0.0, 0.02], [dl - 2.0 * wall, dw - 2.0 * wall, 0.02]);
    s.part("roof", p.shaded(0.7));
    s.tapered([0.0, 0.0, top], [l, w, h - top], [0.45, 0.5]);
    s.part("sign", p.second(Stuff::Wood, [0.7, 0.6, 0.3]));
    s.block([dl * 0.5 + 0.02, 0.0, top - 0.22], [0.03, dw * 0.7, 0.18]);
}

fn shelter(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    s.part("post", p.main());
    for [x, y] in spots(4, [l * 0.42, w * 0.46]) {
        s.block([x, y, 0.0], [0.08, 0.08, h * 0.94]);
    }
    s.part("roof", p.shaded(0.8));
    s.tapered([0.0, 0.0, h * 0.94], [l, w, h * 0.06], [0.92, 0.97]);
    s.part("pane", Plan::own(Stuff::Glass));
    s.block([-l * 0.42, 0.0, h * 0.1], [0.015, w * 0.88, h * 0.8]);
    for y in [-w * 0.46, w * 0.46] {
        s.block([-l * 0.1, y, h * 0.1], [l * 0.5, 0.015, h * 0.8]);
    }
    if p.has(0) {
        s.part("seat", Plan::own(Stuff::Wood));
        s.block([-l * 0.24, 0.0, 0.43], [0.36, w * 0.6, 0.04]);
        s.part("leg", p.main());
        for y in [-w * 0.25, w * 0.25] {
            s.block([-l * 0.24, y, 0.0], [0.06, 0.06, 0.43]);
        }
    }
}

fn tent(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (half, cloth) = (w * 0.5, 0.03);
    for (side, finish) in [(-1.0, p.main()), (1.0, p.main())] {
        s.part("cloth", finish);
        s.panel(
            &[[side * half, 0.0], [side * (half - cloth * 1.5), 0.0], [0.0, h - cloth * 1.8], [0.0, h]],
            -l * 0.5,
            l,
        );
    }
    s.part("back", p.second(Stuff::Fabric, [0.5, 0.45, 0.35]));
    s.panel(&[[-half + 0.05, 0.0], [half - 0.05, 0.0], [0.0, h - 0.06]], -l * 0.5 + 0.02, 0.02);
    // One flap of the entrance hangs, the other is open.
    s.panel(&[[0.0, 0.0], [half - 0.05, 0.0], [0.0, h - 0.06]], l * 0.5 - 0.05, 0.02);
    s.part("pole", Plan::own(Stuff::Metal));
    s.pillar([l * 0.5 - 0.09, 0.0, 0.0], 0.015, h - 0.07, 8);
}

fn parasol(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    s.part("foot", Plan::own(Stuff::Concrete));
    s.frustum([0.0; 3], [l * 0.12, l * 0.1], 0.1, 16);
    s.part("pole", Plan::painted(Stuff::Wood, [0.45, 0.3, 0.16]));
    s.pillar([0.0, 0.0, 0.1], 0.025, h - 0.15, 10);
    let cap = h * 0.17;
    s.part("canopy", p.main());
    let finishes = [p.main(), p.second(Stuff::Fabric, WHITE)];
    s.sectors([0.0, 0.0, h - cap - 0.05], [l * 0.5, cap], p.count(0), finishes);
    s.part("knob", Plan::painted(Stuff::Wood, [0.45, 0.3, 0.16]));
    s.ball([0.0, 0.0, h - 0.04], [0.03, 0.03, 0.04], 6, 10);
}

fn pavilion(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let (r, floor, eaves) = (l * 0.5, h * 0.06, h * 0.66);
    let columns = p.count(0);
    s.part("floor", Plan::own(Stuff::Stone));
    s.pillar([0.0; 3], r, floor, 32);
    s.part("column", p.main());
    for [cos, sin] in around(columns) {
        s.pillar([r * 0.84 * cos, r * 0.84 * sin, floor], 0.09, eaves - floor, 12);
    }
    // Beams from column to column, and a railing with its front open.
    let corners: Vec<[f64; 2]> = around(columns).map(|[cos, sin]| [r * 0.84 * cos, r * 0.84 * sin]).collect();
    for k in 0..columns {
        let (a, b) = (corners[k], corners[(k + 1) % columns]);
        s.part("beam", p.shaded(0.9));
        s.bar([a[0], a[1], eaves - 0.08], [b[0], b[1], eaves - 0.08], [0.09; 2], 4);
        if k > 0 {
            s.bar([a[0], a[1], floor + h * 0.2], [b[0], b[1], floor + h * 0.2], [0.04; 2], 6);
        }
    }
    s.part("roof", p.second(Stuff::Wood, [0.25, 0.07, 0.05]));
    s.frustum([0.0, 0.0, eaves], [r, 0.06], h * 0.31, columns.max(8));
    s.ball([0.0, 0.0, h * 0.985], [0.06, 0.06, h * 0.015], 6, 10);
}

fn pergola(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    s.part("post", p.main());
    for x in [-l * 0.4, l * 0.4] {
        for y in spread(3, w * 0.8) {
            s.block([x, y, 0.0], [0.12, 0.12, h - 0.26]);
        }
        s.block([x, 0.0, h - 0.26], [0.1, w * 0.96, 0.14]);
    }
    for y in spread(p.count(0), w - 0.06) {
        s.part("beam", p.varied());
        s.block([0.0, y, h - 0.12], [l, 0.06, 0.12]);
    }
}

fn canopy(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    s.part("post", p.main());
    for [x, y] in spots(4, [l * 0.44, w * 0.44]) {
        s.block([x, y, 0.0], [0.12, 0.12, h - 0.2]);
    }
    s.part("beam", p.shaded(0.8));
    for y in [-w * 0.44, w * 0.44] {
        s.block([0.0, y, h - 0.2], [l, 0.1, 0.12]);
    }
    s.part("roof", p.second(Stuff::Metal, [0.2, 0.07, 0.05]));
    s.tapered([0.0, 0.0, h - 0.08], [l, w, 0.08], [0.98, 0.97]);
}
