//! What carries loads: carts, barrows, boats and rails.

use super::super::sculpt::{Sculpt, V};
use super::super::stuff::Stuff;
use super::super::thing::{Plan, Takes, Thing, Usual};
use super::{PROP, spread, wheel};

#[rustfmt::skip]
pub(super) const THINGS: &[Thing] = &[
    Thing { names: &["wheelbarrow", "barrow", "wheel barrow"], size: [1.45, 0.62, 0.65], stuff: Stuff::Metal, color: Some([0.05, 0.22, 0.1]), mass: [6.0, 80.0],
        takes: &[Takes::Material], make: wheelbarrow, ..PROP },
    Thing { names: &["cart", "hand cart", "handcart", "wagon"], size: [2.6, 1.4, 1.2], mass: [40.0, 350.0],
        takes: &[Takes::Material, Takes::Count { of: &["wheels", "wheel", "wheeled"], usual: 2, least: 2, most: 4 },
            Takes::Feature { what: &["hay", "straw"], usual: Usual::Without }], make: cart, ..PROP },
    Thing { names: &["boat", "rowing boat", "rowboat", "row boat", "dinghy", "canoe"], size: [3.8, 1.4, 0.75], color: Some([0.1, 0.22, 0.38]), mass: [40.0, 450.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Count { of: &["seats", "seat", "seater", "benches", "thwarts"], usual: 3, least: 1, most: 5 }], make: boat, ..PROP },
    Thing { names: &["shopping cart", "shopping trolley", "trolley"], size: [0.95, 0.6, 1.0], stuff: Stuff::Metal, mass: [4.0, 60.0], takes: &[Takes::Accent], make: trolley, ..PROP },
    Thing { names: &["pallet"], size: [1.2, 0.8, 0.144], mass: [10.0, 50.0],
        takes: &[Takes::Material, Takes::Count { of: &["boards", "board", "planks", "plank", "slats", "slat"], usual: 7, least: 3, most: 11 }], make: pallet, ..PROP },
    Thing { names: &["tyre", "tire"], size: [0.65, 0.22, 0.65], stuff: Stuff::Rubber, mass: [5.0, 90.0], takes: &[], make: |s, p| {
        let [l, w, _] = p.size;
        s.part("tyre", p.main());
        s.placed([0.0, 0.0, l * 0.5], [std::f64::consts::FRAC_PI_2, 0.0, 0.0], |s| {
            s.vessel([0.0, 0.0, -w * 0.5], &[[0.0, l * 0.46, l * 0.3], [w * 0.25, l * 0.5, l * 0.28], [w * 0.75, l * 0.5, l * 0.28], [w, l * 0.46, l * 0.3]], w * 0.1, 24);
        });
    }, ..PROP },
];

fn wheelbarrow(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let r = h * 0.3;
    wheel(s, [l * 0.5 - r, 0.0], r, 0.08);
    s.part("tray", p.main());
    // A tray that widens upwards: four walls and a floor.
    let (low, high, z, top) = ([l * 0.16, w * 0.26], [l * 0.3, w * 0.5], h * 0.48, h);
    let x = l * 0.12;
    let corner = |[a, b]: [f64; 2], k: usize, z: f64, inset: f64| {
        let [i, j] = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]][k % 4];
        V::new(x + i * (a - inset), j * (b - inset), z)
    };
    for k in 0..4 {
        let edge = |ring: [f64; 2], z: f64| {
            (
                [0, 1].map(|d| corner(ring, k + d, z, 0.0)).to_vec(),
                [0, 1].map(|d| corner(ring, k + d, z, 0.015)).to_vec(),
            )
        };
        s.shell(&[edge(low, z), edge(high, top)]);
    }
    s.block([x, 0.0, z], [low[0] * 2.0, low[1] * 2.0, 0.02]);
    s.part("handle", Plan::own(Stuff::Wood));
    for side in [-1.0, 1.0] {
        s.bar(
            [l * 0.5 - r, side * 0.06, r],
            [-l * 0.5, side * (w * 0.5 - 0.03), h * 0.72],
            [0.022, 0.022],
            8,
        );
        s.bar([-l * 0.12, side * w * 0.28, 0.0], [-l * 0.06, side * w * 0.26, h * 0.5], [0.02; 2], 8);
    }
}

fn cart(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let r = h * 0.36;
    let (bed, back) = (l * 0.62, -l * 0.5);
    let middle = back + bed * 0.5;
    let axles: &[f64] = if p.count(0) > 2 { &[-0.3, 0.3] } else { &[0.0] };
    for share in axles {
        let x = middle + bed * share;
        for y in [-1.0, 1.0].map(|side| side * (w * 0.5 - 0.05)) {
            wheel(s, [x, y], r, 0.07);
        }
        s.part("axle", Plan::own(Stuff::Iron));
        s.bar([x, -w * 0.48, r], [x, w * 0.48, r], [0.03; 2], 8);
    }
    if p.count(0) == 3 {
        wheel(s, [l * 0.5 - r * 0.5, 0.0], r * 0.5, 0.06);
    }
    let floor = r + 0.05;
    s.part("bed", p.shaded(0.8));
    s.block([middle, 0.0, floor], [bed, w * 0.8, 0.05]);
    for level in 0..2 {
        let z = floor + 0.05 + (h - floor - 0.05) * 0.5 * f64::from(level);
        let tall = (h - floor - 0.05) * 0.46;
        for side in [-1.0, 1.0] {
            s.part("board", p.varied());
            s.block([middle, side * w * 0.39, z], [bed, 0.03, tall]);
            s.block([middle + side * (bed * 0.5 - 0.015), 0.0, z], [0.03, w * 0.75, tall]);
        }
    }
    s.part("post", p.shaded(0.7));
    for [x, y] in super::spots(4, [bed * 0.5 - 0.02, w * 0.39]) {
        s.block([middle + x, y, floor], [0.06, 0.06, h - floor]);
    }
    if p.has(0) {
        s.part("hay", Plan::own(Stuff::Straw));
        s.tapered([middle, 0.0, floor + 0.05], [bed * 0.94, w * 0.72, (h - floor) * 1.1], [0.5, 0.6]);
    }
    s.part("shaft", p.main());
    for side in [-1.0, 1.0] {
        s.bar([middle, side * w * 0.3, floor], [l * 0.5, side * w * 0.22, floor + 0.08], [0.035; 2], 8);
    }
    s.bar([l * 0.48, -w * 0.22, floor + 0.08], [l * 0.48, w * 0.22, floor + 0.08], [0.025; 2], 8);
}

fn boat(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let steps = 12;
    let skin = 0.04;
    // Full amidships, a point at both ends, which rise a little.
    let strip = |k: usize| {
        let share = 2.0 * k as f64 / f64::from(steps) - 1.0;
        let beam = w * 0.5 * (1.0 - share * share).max(0.0);
        let keel = h * 0.34 * share * share * share * share;
        let rail = h * (0.72 + 0.28 * share * share);
        let x = l * 0.5 * share;
        let at = |reach: f64, z: f64| V::new(x, beam * reach, z);
        let bilge = keel + (rail - keel) * 0.3;
        let inset = if beam > skin { 1.0 - skin / beam } else { 1.0 };
        let lift = if beam > skin { skin } else { 0.0 };
        let outer = vec![at(1.0, rail), at(0.8, bilge), at(0.0, keel), at(-0.8, bilge), at(-1.0, rail)];
        let inner = vec![
            at(inset, rail),
            at(0.8 * inset, bilge + lift),
            at(0.0, keel + lift),
            at(-0.8 * inset, bilge + lift),
            at(-inset, rail),
        ];
        (outer, inner)
    };
    s.part("hull", p.main());
    s.shell(&(0..=steps as usize).map(strip).collect::<Vec<_>>());
    s.part("thwart", p.second(Stuff::Wood, [0.4, 0.26, 0.12]));
    for x in spread(p.count(0), l * 0.44) {
        let share = 2.0 * x / l;
        s.block([x, 0.0, h * 0.5], [0.22, w * 0.92 * (1.0 - share * share) - 0.04, 0.035]);
    }
    for side in [-1.0, 1.0] {
        s.part("oar", Plan::painted(Stuff::Wood, [0.5, 0.36, 0.18]));
        s.bar([-l * 0.3, side * w * 0.16, h * 0.56], [l * 0.3, side * w * 0.2, h * 0.56], [0.022; 2], 6);
        s.block([l * 0.33, side * w * 0.2, h * 0.555], [l * 0.1, 0.12, 0.02]);
    }
}

fn trolley(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (floor, top) = (h * 0.42, h * 0.88);
    for [x, y] in super::spots(4, [l * 0.4, w * 0.4]) {
        wheel(s, [x, y], 0.055, 0.03);
        s.part("frame", p.main());
        s.bar([x, y, 0.08], [x * 0.9, y, floor], [0.014; 2], 6);
    }
    s.part("frame", p.main());
    for y in [-w * 0.4, w * 0.4] {
        s.bar([-l * 0.4, y, 0.13], [l * 0.4, y, 0.13], [0.014; 2], 6);
    }
    s.part("basket", p.shaded(0.85));
    s.block([0.02, 0.0, floor], [l * 0.86, w * 0.86, 0.012]);
    for z in spread(5, top - floor) {
        let z = (floor + top) * 0.5 + z;
        for side in [-1.0, 1.0] {
            s.block([0.02, side * w * 0.43, z], [l * 0.88, 0.01, 0.01]);
            s.block([0.02 + side * l * 0.44, 0.0, z], [0.01, w * 0.87, 0.01]);
        }
    }
    for x in spread(8, l * 0.86) {
        for side in [-1.0, 1.0] {
            s.block([0.02 + x, side * w * 0.43, floor], [0.008, 0.008, top - floor]);
        }
    }
    s.part("handle", p.second(Stuff::Plastic, [0.55, 0.03, 0.03]));
    s.bar([-l * 0.5 + 0.02, -w * 0.5, h - 0.02], [-l * 0.5 + 0.02, w * 0.5, h - 0.02], [0.02; 2], 8);
    for y in [-w * 0.42, w * 0.42] {
        s.bar([-l * 0.42, y, top - 0.1], [-l * 0.5 + 0.02, y, h - 0.02], [0.014; 2], 6);
    }
}

fn pallet(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let board = h * 0.15;
    for y in spread(3, w - 0.1) {
        s.part("board", p.varied());
        s.block([0.0, y, 0.0], [l, 0.1, board]);
        s.part("block", p.varied());
        for x in spread(3, l - 0.14) {
            s.block([x, y, board], [0.14, 0.1, h - 3.0 * board]);
        }
    }
    for x in spread(3, l - 0.14) {
        s.part("board", p.varied());
        s.block([x, 0.0, h - 2.0 * board], [0.14, w, board]);
    }
    let boards = p.count(0);
    let pitch = w / boards as f64;
    for y in spread(boards, w - pitch * 0.8) {
        s.part("board", p.varied());
        s.block([0.0, y, h - board], [l, pitch * 0.8, board]);
    }
}
