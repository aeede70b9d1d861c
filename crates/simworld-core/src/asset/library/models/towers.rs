//! Buildings that are no blocks with windows: towers, tanks and mills.

use std::f64::consts::FRAC_PI_2;

use super::{Kit, Maker, around, dark, glass, iron, red, steel, white, wood};
use crate::asset::Material;
use crate::asset::sculpt::{Coating, Hulls, Sculpt};

pub(super) const MAKERS: &[(&str, Maker)] = &[
    ("lighthouse", lighthouse),
    ("observatory", observatory),
    ("radio_tower", radio_tower),
    ("silo", silo),
    ("water_tower", water_tower),
    ("windmill", windmill),
];

/// A door in a wall that is so far in front of the middle, 2.2 m high.
fn door(s: &mut Sculpt, wall: f64, floor: f64) {
    s.part("door", wood());
    s.block([wall, 0.0, floor], [0.3, 1.3, 2.2]);
}

/// Bands of white and red on a foot, a gallery, and a lantern that glows.
fn lighthouse(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("foot", kit.shade(0.55));
    s.frustum([0.0; 3], [r, 0.94 * r], 0.05 * h, 24);
    for band in 0..5_u8 {
        let at = |k: u8| {
            let share = f64::from(k) / 5.0;
            ((0.05 + 0.73 * share) * h, (0.78 - 0.32 * share) * r)
        };
        let ((low, wide), (high, narrow)) = (at(band), at(band + 1));
        s.part("tower", if band % 2 == 0 { kit.main() } else { red() });
        s.frustum([0.0, 0.0, low], [wide, narrow], high - low, 24);
    }
    door(s, 0.76 * r, 0.05 * h);
    s.part("gallery", iron());
    s.pillar([0.0, 0.0, 0.78 * h], 0.66 * r, 0.015 * h, 24);
    for [x, y] in around(10).map(|[x, y]| [0.62 * r * x, 0.62 * r * y]) {
        s.bar([x, y, 0.79 * h], [x, y, 0.835 * h], [0.03; 2], 4);
    }
    s.hoop([0.0, 0.0, 0.835 * h], 0.62 * r, 0.035, 16);
    let lamp = Coating { light: glowing(), ..glass() };
    s.part("lantern", lamp);
    s.pillar([0.0, 0.0, 0.795 * h], 0.34 * r, 0.11 * h, 12);
    s.part("dome", red());
    s.frustum([0.0, 0.0, 0.905 * h], [0.42 * r, 0.05 * r], 0.07 * h, 16);
    s.part("rod", iron());
    s.bar([0.0, 0.0, 0.97 * h], [0.0, 0.0, h], [0.04; 2], 6);
}

/// Glass with a light behind it.
fn glowing() -> crate::asset::Finish {
    crate::asset::Finish { emission: [1.0, 0.85, 0.5], ..glass().light }
}

/// A drum under a dome with a slit.
fn observatory(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("drum", kit.main());
    s.pillar([0.0; 3], 0.96 * r, 0.48 * h, 28);
    s.part("cornice", kit.shade(0.8));
    s.pillar([0.0, 0.0, 0.46 * h], r, 0.05 * h, 28);
    s.part("dome", white());
    s.ball([0.0, 0.0, 0.5 * h], [0.93 * r, 0.93 * r, 0.497 * h], 8, 20);
    // A thin shell that stands out of the dome along one meridian alone.
    s.part("slit", dark());
    s.ball([0.0, 0.0, 0.5 * h], [0.94 * r, 0.09 * r, 0.5 * h], 8, 20);
    door(s, 0.95 * r, 0.0);
    s.part("windows", glass());
    for [x, y] in around(10).skip(1) {
        let reach = 0.95 * r;
        s.bar([reach * x, reach * y, 0.26 * h], [reach * x, reach * y, 0.36 * h], [0.45; 2], 8);
    }
}

/// Four legs that lean together, with rings and braces, in bands of two colours, and an aerial.
fn radio_tower(s: &mut Sculpt, kit: &Kit) {
    const LEVELS: u8 = 8;
    let [l, w, h] = kit.size;
    let corners = |level: u8| {
        let share = f64::from(level) / f64::from(LEVELS);
        let (reach, z) = (0.48 * (1.0 - 0.88 * share), 0.92 * h * share);
        [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(|[i, j]| [i * reach * l, j * reach * w, z])
    };
    for level in 0..LEVELS {
        let (low, high) = (corners(level), corners(level + 1));
        s.part("mast", if level % 2 == 0 { kit.main() } else { white() });
        for k in 0..4 {
            let next = (k + 1) % 4;
            s.bar(low[k], high[k], [0.08; 2], 4);
            s.bar(high[k], high[next], [0.05; 2], 4);
            let (from, to) = if level % 2 == 0 { (low[k], high[next]) } else { (low[next], high[k]) };
            s.bar(from, to, [0.04; 2], 4);
        }
    }
    s.part("aerial", steel());
    s.bar([0.0, 0.0, 0.915 * h], [0.0, 0.0, h], [0.12, 0.05], 8);
    // Its feet stand on blocks, which are as far apart as the box is wide.
    s.part("feet", Coating::of(Material::Concrete, [0.36, 0.36, 0.35]));
    for [x, y, _] in corners(0) {
        let inward = |reach: f64, side: f64| reach.signum() * (0.5 * side - 0.06 * side);
        s.block([inward(x, l), inward(y, w), 0.0], [0.12 * l, 0.12 * w, 0.3]);
    }
}

/// Rings of sheet under a dome, with a ladder.
fn silo(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("shell", kit.main());
    s.pillar([0.0; 3], 0.97 * r, 0.8 * h, 28);
    s.part("ribs", kit.shade(0.85));
    for level in 0..7_u8 {
        s.pillar([0.0, 0.0, (0.01 + 0.13 * f64::from(level)) * h], 0.985 * r, 0.012 * h, 28);
    }
    s.part("foot", Coating::of(Material::Concrete, [0.36, 0.36, 0.35]));
    s.pillar([0.0; 3], r, 0.015 * h, 28);
    s.part("dome", kit.shade(0.92));
    s.ball([0.0, 0.0, 0.8 * h], [0.97 * r, 0.97 * r, 0.19 * h], 8, 20);
    s.pillar([0.0, 0.0, 0.97 * h], 0.1 * r, 0.03 * h, 10);
    s.part("ladder", iron());
    for y in [-0.25, 0.25] {
        s.bar([0.98 * r, y, 0.02 * h], [0.98 * r, y, 0.84 * h], [0.04; 2], 4);
    }
    for level in 1..16_u8 {
        let z = 0.052 * f64::from(level) * h;
        s.bar([0.98 * r, -0.25, z], [0.98 * r, 0.25, z], [0.025; 2], 4);
    }
}

/// A shaft that widens into a tank under a flat cone.
fn water_tower(s: &mut Sculpt, kit: &Kit) {
    let [l, _, h] = kit.size;
    let r = 0.5 * l;
    s.part("shaft", kit.main());
    let shaft = [[0.4 * r, 0.0], [0.28 * r, 0.08 * h], [0.25 * r, 0.62 * h]];
    s.lathe([0.0; 3], &shaft, 20, Hulls::Segments);
    s.part("tank", kit.shade(0.9));
    let tank = [[0.25 * r, 0.62 * h], [0.97 * r, 0.76 * h], [0.97 * r, 0.92 * h]];
    s.lathe([0.0; 3], &tank, 28, Hulls::Segments);
    s.part("band", kit.shade(0.6));
    s.pillar([0.0, 0.0, 0.78 * h], 0.985 * r, 0.02 * h, 28);
    s.part("roof", kit.shade(0.75));
    s.frustum([0.0, 0.0, 0.92 * h], [r, 0.08 * r], 0.07 * h, 28);
    s.pillar([0.0, 0.0, 0.98 * h], 0.1 * r, 0.02 * h, 10);
    door(s, 0.36 * r, 0.0);
}

/// A tower that narrows, a cap, and four sails before it.
fn windmill(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let back = -0.06 * l;
    s.part("tower", kit.main());
    s.frustum([back, 0.0, 0.0], [0.44 * l, 0.28 * l], 0.78 * h, 12);
    s.part("gallery", wood());
    s.pillar([back, 0.0, 0.3 * h], 0.41 * l, 0.012 * h, 12);
    door(s, back + 0.42 * l, 0.0);
    s.part("windows", glass());
    for z in [0.4, 0.56] {
        s.block([back + (0.44 - 0.205 * (z + 0.04)) * l, 0.0, z * h], [0.16, 0.7, 1.0]);
    }
    s.part("cap", kit.shade(0.35));
    s.frustum([back, 0.0, 0.78 * h], [0.31 * l, 0.05 * l], 0.22 * h, 12);
    s.part("axle", iron());
    let hub = 0.7 * h;
    s.bar([back, 0.0, hub], [0.5 * l, 0.0, hub], [0.2, 0.16], 8);
    let long = 0.6 * w;
    for quarter in 0..4_u8 {
        let turn = FRAC_PI_2 * (0.5 + f64::from(quarter));
        s.placed([0.44 * l, 0.0, hub], [turn, 0.0, 0.0], |s| {
            s.part("spar", wood());
            s.block([0.0; 3], [0.12, 0.14, long]);
            s.part("canvas", Coating::of(Material::Fabric, [0.72, 0.68, 0.6]));
            s.block([0.0, 0.45, 0.22 * long], [0.05, 0.76, 0.75 * long]);
        });
    }
}
