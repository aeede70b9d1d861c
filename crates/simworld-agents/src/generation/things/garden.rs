//! Fences, gates and walls, and what stands in gardens.

use super::super::sculpt::{Hulls, Sculpt};
use super::super::stuff::Stuff;
use super::super::thing::{Plan, Takes, Thing, Usual};
use super::{DARK, PROP, spread};

#[rustfmt::skip]
pub(super) const THINGS: &[Thing] = &[
    Thing { names: &["fence", "picket fence", "railing", "railings", "palisade"], size: [0.12, 3.0, 1.1], mass: [12.0, 150.0],
        takes: &[Takes::Material, Takes::Count { of: &["pickets", "picket", "boards", "board", "slats", "slat", "bars", "bar"], usual: 17, least: 3, most: 60 }],
        make: fence, ..PROP },
    Thing { names: &["gate", "gateway"], size: [0.4, 3.2, 2.2], stuff: Stuff::Iron, mass: [60.0, 2600.0],
        takes: &[Takes::Material, Takes::Count { of: &["bars", "bar"], usual: 14, least: 4, most: 40 }, Takes::Feature { what: &["posts", "post", "pillars", "pillar"], usual: Usual::With }],
        make: gate, ..PROP },
    Thing { names: &["wall"], size: [0.35, 3.0, 1.6], stuff: Stuff::Stone, mass: [800.0, 7000.0],
        takes: &[Takes::Material, Takes::Count { of: &["rows", "row", "courses", "course", "layers", "layer"], usual: 5, least: 1, most: 10 }], make: wall, ..PROP },
    Thing { names: &["well", "water well", "draw well", "wishing well"], size: [1.5, 1.5, 2.5], stuff: Stuff::Stone, mass: [500.0, 5000.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Feature { what: &["roof"], usual: Usual::With }], make: well, ..PROP },
    Thing { names: &["dog house", "doghouse", "kennel"], size: [1.1, 0.8, 0.9], color: Some([0.5, 0.12, 0.06]), mass: [12.0, 130.0],
        takes: &[Takes::Material, Takes::Accent], make: hut, ..PROP },
    Thing { names: &["shed", "garden shed", "hut", "cabin"], size: [2.4, 3.0, 2.6], mass: [300.0, 3000.0], takes: &[Takes::Material, Takes::Accent], make: hut, ..PROP },
    Thing { names: &["bird house", "birdhouse", "nesting box", "bird box"], size: [0.3, 0.26, 1.9], color: Some([0.45, 0.3, 0.14]), mass: [3.0, 40.0],
        takes: &[Takes::Material, Takes::Accent], make: bird_house, ..PROP },
    Thing { names: &["ladder", "step ladder", "stepladder"], size: [0.1, 0.48, 3.0], mass: [3.0, 40.0],
        takes: &[Takes::Material, Takes::Count { of: &["rungs", "rung", "steps", "step"], usual: 9, least: 2, most: 30 }], make: ladder, ..PROP },
    Thing { names: &["bird bath", "birdbath"], size: [0.6, 0.6, 0.85], stuff: Stuff::Stone, mass: [30.0, 250.0], takes: &[Takes::Material, Takes::Feature { what: &["water"], usual: Usual::With }], make: bird_bath, ..PROP },
    Thing { names: &["scarecrow"], size: [0.3, 1.5, 1.8], stuff: Stuff::Fabric, color: Some([0.3, 0.15, 0.06]), mass: [4.0, 60.0], takes: &[], make: scarecrow, ..PROP },
];

fn fence(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let posts = ((w / 1.5).round() as usize).max(1) + 1;
    s.part("post", p.shaded(0.85));
    for y in spread(posts, w - 0.08) {
        s.block([-l * 0.15, y, 0.0], [l * 0.66, 0.08, h * 0.96]);
    }
    s.part("rail", p.shaded(0.8));
    for z in [0.22, 0.72] {
        s.block([0.0, 0.0, h * z], [l * 0.34, w - 0.02, h * 0.07]);
    }
    let pickets = p.count(0);
    let pitch = w / pickets as f64;
    for y in spread(pickets, w - pitch) {
        s.part("picket", p.varied());
        let wide = (pitch * 0.66).min(0.14);
        s.block([l * 0.34, y, 0.05], [l * 0.3, wide, h * 0.88 - 0.05]);
        s.tapered([l * 0.34, y, h * 0.88], [l * 0.3, wide, h * 0.12], [1.0, 0.15]);
    }
}

fn gate(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let post = if p.has(0) { l } else { 0.08 };
    let leaf = (w - 2.0 * post) * 0.5;
    let top = if p.has(0) { h * 0.86 } else { h };
    if p.has(0) {
        s.part("post", Plan::own(Stuff::Stone));
        for y in [-1.0, 1.0].map(|side| side * (w - post) * 0.5) {
            s.block([0.0, y, 0.0], [l * 0.9, post * 0.9, h * 0.93]);
            s.tapered([0.0, y, h * 0.93], [l, post, h * 0.07], [0.6, 0.6]);
        }
    } else {
        s.part("post", p.main());
        for y in [-1.0, 1.0].map(|side| side * (w - post) * 0.5) {
            s.block([0.0, y, 0.0], [post, post, h]);
        }
    }
    let bars = p.count(0);
    for (side, bars) in [(-1.0, bars / 2), (1.0, bars - bars / 2)] {
        let middle = side * (leaf * 0.5 + 0.01);
        s.part("frame", p.main());
        for z in [0.06, top * 0.5, top - 0.12] {
            s.block([0.0, middle, z], [0.04, leaf * 0.96, 0.05]);
        }
        s.part("bar", p.shaded(0.9));
        for y in spread(bars, leaf * 0.9) {
            s.pillar([0.0, middle + y, 0.06], 0.014, top - 0.1, 6);
            s.frustum([0.0, middle + y, top - 0.04], [0.022, 0.0], 0.04, 6);
        }
    }
}

fn wall(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let rows = p.count(0);
    let (cap, tall) = (h * 0.06, h * 0.94 / rows as f64);
    let long = (tall * 2.0).max(w / 9.0);
    let columns = ((w / long).round() as usize).max(1);
    for row in 0..rows {
        // Every other row begins with half a stone.
        let shift = if row % 2 == 1 && columns > 1 { 0.5 } else { 0.0 };
        let mut edge = -w * 0.5;
        for k in 0..=columns {
            let end = (-w * 0.5 + (k as f64 + 1.0 - shift) * w / columns as f64).min(w * 0.5);
            if end - edge < 1e-6 {
                continue;
            }
            s.part("stone", p.varied());
            s.block([0.0, (edge + end) * 0.5, row as f64 * tall], [l * 0.92, end - edge, tall]);
            edge = end;
        }
    }
    s.part("cap", p.shaded(0.8));
    s.block([0.0, 0.0, h - cap], [l, w, cap]);
}

fn well(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (r, rim) = (l * 0.44, h * 0.34);
    s.part("ring", p.main());
    s.vessel(
        [0.0; 3],
        &[[0.0, r, r * 0.72], [rim - 0.08, r * 0.97, r * 0.72], [rim, r * 1.06, r * 0.7]],
        0.1,
        20,
    );
    s.part("water", Plan::own(Stuff::Water));
    s.pillar([0.0, 0.0, 0.1], r * 0.7, rim * 0.4, 20);
    s.part("post", Plan::own(Stuff::Wood));
    let eaves = h * 0.76;
    for y in [-r * 0.88, r * 0.88] {
        s.block([0.0, y, rim - 0.02], [0.1, 0.1, eaves - rim + 0.04]);
    }
    s.bar([0.0, -r * 0.95, h * 0.58], [0.0, r * 0.95, h * 0.58], [0.06; 2], 10);
    s.part("rope", Plan::own(Stuff::Straw));
    s.pillar([0.0, 0.0, h * 0.42], 0.012, h * 0.16, 6);
    s.part("bucket", Plan::own(Stuff::Wood));
    s.vessel([0.0, 0.0, h * 0.33], &[[0.0, 0.09, 0.08], [h * 0.09, 0.12, 0.11]], 0.01, 12);
    if p.has(0) {
        s.part("roof", p.second(Stuff::Wood, [0.3, 0.08, 0.05]));
        gable(s, [l, w, h - eaves], eaves, 0.05);
    } else {
        s.part("post", Plan::own(Stuff::Wood));
        s.block([0.0, 0.0, h * 0.95], [0.12, w * 0.96, h * 0.05]);
        for y in [-r * 0.88, r * 0.88] {
            s.block([0.0, y, eaves], [0.1, 0.1, h * 0.95 - eaves]);
        }
    }
}

/// Two slabs that lean on each other over a ridge along y.
pub(super) fn gable(s: &mut Sculpt, [l, w, h]: [f64; 3], z: f64, thick: f64) {
    for side in [-1.0, 1.0] {
        let foot = side * l * 0.5;
        let strip = |y: f64| {
            let outer = vec![[foot, y, z].into(), [0.0, y, z + h].into()];
            let inner = vec![[foot - side * thick, y, z].into(), [0.0, y, z + h - thick].into()];
            (outer, inner)
        };
        s.shell(&[strip(-w * 0.5), strip(w * 0.5)]);
    }
}

/// Walls with a door in front and a gable roof, for dogs or for tools.
fn hut(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (eaves, wall) = (h * 0.66, 0.02 + 0.02 * h.min(2.0));
    let (dl, dw) = (l * 0.9, w * 0.88);
    let (door, head) = (dw * 0.36, eaves * 0.84);
    s.part("floor", p.shaded(0.5));
    s.block([0.0; 3], [dl, dw, h * 0.03]);
    let walls = [
        ([-(dl - wall) * 0.5, 0.0], [wall, dw], 0.0, eaves),
        ([0.0, (dw - wall) * 0.5], [dl - 2.0 * wall, wall], 0.0, eaves),
        ([0.0, -(dw - wall) * 0.5], [dl - 2.0 * wall, wall], 0.0, eaves),
        ([(dl - wall) * 0.5, (dw + door) * 0.25], [wall, (dw - door) * 0.5], 0.0, eaves),
        ([(dl - wall) * 0.5, -(dw + door) * 0.25], [wall, (dw - door) * 0.5], 0.0, eaves),
        ([(dl - wall) * 0.5, 0.0], [wall, door], head, eaves),
    ];
    for ([x, y], [sx, sy], low, high) in walls {
        s.part("wall", p.varied());
        s.block([x, y, low.max(h * 0.03)], [sx, sy, high - low.max(h * 0.03)]);
    }
    // The gables look to the front and the back, so the ridge runs along x.
    for x in [-dl * 0.5, dl * 0.5 - wall] {
        s.part("gable", p.shaded(0.9));
        s.panel(&[[-dw * 0.5, eaves], [dw * 0.5, eaves], [0.0, h - h * 0.05]], x, wall);
    }
    s.part("roof", p.second(p.stuff, [0.16, 0.08, 0.05]));
    s.placed([0.0; 3], [0.0, 0.0, std::f64::consts::FRAC_PI_2], |s| {
        gable(s, [w, l, h - eaves + h * 0.02], eaves - h * 0.02, wall * 1.4);
    });
}

fn bird_house(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (low, eaves) = (h * 0.8, h * 0.93);
    s.part("post", Plan::own(Stuff::Wood));
    s.pillar([0.0; 3], 0.035, low, 10);
    s.part("box", p.main());
    s.block([0.0, 0.0, low], [l * 0.7, w * 0.7, eaves - low]);
    s.part("hole", Plan::painted(Stuff::Wood, DARK));
    s.placed([l * 0.35, 0.0, (low + eaves) * 0.5], [0.0, std::f64::consts::FRAC_PI_2, 0.0], |s| {
        s.pillar([0.0; 3], w * 0.13, 0.004, 16);
    });
    s.part("perch", Plan::own(Stuff::Wood));
    s.bar([l * 0.3, 0.0, low + 0.04], [l * 0.5, 0.0, low + 0.04], [0.008; 2], 6);
    s.part("roof", p.second(Stuff::Wood, [0.3, 0.07, 0.05]));
    s.placed([0.0; 3], [0.0, 0.0, std::f64::consts::FRAC_PI_2], |s| {
        gable(s, [w, l, h - eaves + 0.02], eaves - 0.02, 0.02);
    });
}

fn ladder(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    s.part("rail", p.main());
    for y in [-1.0, 1.0].map(|side| side * (w * 0.5 - 0.02)) {
        s.block([0.0, y, 0.0], [l * 0.7, 0.04, h]);
    }
    let rungs = p.count(0);
    let pitch = h / (rungs + 1) as f64;
    for z in spread(rungs, h - 2.0 * pitch) {
        s.part("rung", p.varied());
        s.block([0.0, 0.0, h * 0.5 + z - 0.015], [l, w - 0.08, 0.03]);
    }
}

fn bird_bath(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let r = l * 0.5;
    s.part("foot", p.main());
    s.lathe(
        [0.0; 3],
        &[[r * 0.7, 0.0], [r * 0.6, h * 0.06], [r * 0.26, h * 0.16], [r * 0.2, h * 0.5], [r * 0.3, h * 0.8]],
        20,
        Hulls::Segments,
    );
    s.part("bowl", p.main());
    s.vessel(
        [0.0, 0.0, h * 0.8],
        &[[0.0, r * 0.4, r * 0.36], [h * 0.12, r * 0.85, r * 0.77], [h * 0.2, r, r * 0.9]],
        h * 0.05,
        24,
    );
    if p.has(0) {
        s.part("water", Plan::own(Stuff::Water));
        s.frustum([0.0, 0.0, h * 0.85], [r * 0.5, r * 0.75], h * 0.07, 24);
    }
}

fn scarecrow(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    s.part("post", Plan::own(Stuff::Wood));
    s.pillar([0.0; 3], 0.03, h * 0.8, 8);
    s.bar([0.0, -w * 0.5, h * 0.68], [0.0, w * 0.5, h * 0.68], [0.025; 2], 8);
    s.part("coat", p.main());
    s.tapered([0.0, 0.0, h * 0.36], [l * 0.9, w * 0.36, h * 0.36], [0.7, 0.8]);
    for y in [-w * 0.27, w * 0.27] {
        s.block([0.0, y, h * 0.61], [l * 0.5, w * 0.26, h * 0.11]);
    }
    s.part("head", Plan::own(Stuff::Straw));
    s.ball([0.0, 0.0, h * 0.8], [l * 0.4, l * 0.4, h * 0.08], 8, 12);
    s.part("hat", Plan::painted(Stuff::Straw, [0.35, 0.24, 0.08]));
    s.pillar([0.0, 0.0, h * 0.85], l * 0.5, h * 0.015, 16);
    s.frustum([0.0, 0.0, h * 0.865], [l * 0.32, l * 0.2], h * 0.135, 16);
    s.part("face", Plan::painted(Stuff::Straw, DARK));
    for side in [-1.0, 1.0] {
        s.ball([l * 0.37, side * l * 0.13, h * 0.815], [0.02; 3], 4, 8);
    }
}
