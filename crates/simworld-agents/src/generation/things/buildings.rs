//! Towers, mills, chimneys and small bridges.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::super::sculpt::{Hulls, Sculpt};
use super::super::stuff::Stuff;
use super::super::thing::{Plan, Takes, Thing, Usual};
use super::{DARK, PROP, WHITE, around, spots, spread};

#[rustfmt::skip]
pub(super) const THINGS: &[Thing] = &[
    Thing { names: &["clock tower", "bell tower", "clocktower"], size: [4.0, 4.0, 18.0], stuff: Stuff::Brick, mass: [40_000.0, 500_000.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Count { of: &["floors", "floor", "storeys", "storey", "stories", "story", "levels", "level"], usual: 4, least: 1, most: 10 }],
        make: clock_tower, ..PROP },
    Thing { names: &["water tower"], size: [6.0, 6.0, 16.0], stuff: Stuff::Metal, color: Some([0.45, 0.48, 0.5]), mass: [8000.0, 120_000.0],
        takes: &[Takes::Accent, Takes::Count { of: &["legs", "leg", "legged"], usual: 6, least: 3, most: 12 }], make: water_tower, ..PROP },
    Thing { names: &["chimney", "smokestack", "factory chimney"], size: [2.4, 2.4, 22.0], stuff: Stuff::Brick, mass: [30_000.0, 250_000.0],
        takes: &[Takes::Material, Takes::Square, Takes::Accent, Takes::Count { of: &["bands", "band", "rings", "ring", "stripes", "stripe"], usual: 2, least: 0, most: 6 }],
        make: chimney, ..PROP },
    Thing { names: &["windmill"], size: [5.0, 9.0, 12.0], stuff: Stuff::Stone, color: Some([0.75, 0.72, 0.66]), mass: [30_000.0, 500_000.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Count { of: &["sails", "sail", "blades", "blade", "vanes", "vane", "arms", "arm"], usual: 4, least: 3, most: 8 }],
        make: windmill, ..PROP },
    Thing { names: &["wind turbine"], size: [2.0, 14.0, 20.0], stuff: Stuff::Metal, color: Some([0.75, 0.76, 0.77]), mass: [2000.0, 60_000.0],
        takes: &[Takes::Count { of: &["blades", "blade", "vanes", "vane"], usual: 3, least: 2, most: 6 }], make: turbine, ..PROP },
    Thing { names: &["bridge", "footbridge", "foot bridge"], size: [7.0, 2.2, 2.2], stuff: Stuff::Stone, mass: [4000.0, 40_000.0],
        takes: &[Takes::Material, Takes::Feature { what: &["railing", "railings", "rails", "handrail", "handrails"], usual: Usual::With }], make: bridge, ..PROP },
    Thing { names: &["watchtower", "lookout tower", "lookout", "watch tower", "guard tower"], size: [3.0, 3.0, 8.0], mass: [600.0, 9000.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Count { of: &["legs", "leg", "legged"], usual: 4, least: 3, most: 8 }], make: watchtower, ..PROP },
    Thing { names: &["lighthouse"], size: [5.0, 5.0, 18.0], stuff: Stuff::Stone, color: Some([0.8, 0.8, 0.8]), mass: [100_000.0, 600_000.0],
        takes: &[Takes::Material, Takes::Accent, Takes::Count { of: &["stripes", "stripe", "bands", "band"], usual: 3, least: 0, most: 6 }], make: lighthouse, ..PROP },
    Thing { names: &["silo", "grain silo"], size: [4.0, 4.0, 11.0], stuff: Stuff::Metal, mass: [5000.0, 200_000.0], takes: &[Takes::Material, Takes::Accent], make: silo, ..PROP },
];

/// A solid that is mostly rooms: walls are a share of it.
fn walled(p: &Plan, factor: f32, share: f64) -> super::super::sculpt::Finish {
    let mut finish = p.shaded(factor);
    finish.density *= share;
    finish
}

fn clock_tower(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let floors = p.count(0);
    let (base, eaves) = (h * 0.08, h * 0.8);
    s.part("base", walled(p, 0.8, 0.6));
    s.block([0.0; 3], [l, w, base]);
    s.part("shaft", walled(p, 1.0, 0.35));
    s.block([0.0, 0.0, base], [l * 0.84, w * 0.84, eaves - base]);
    let pitch = (eaves - base) / (floors + 1) as f64;
    for level in 1..=floors {
        s.part("cornice", p.shaded(0.75));
        s.block([0.0, 0.0, base + pitch * level as f64], [l * 0.9, w * 0.9, h * 0.012]);
    }
    s.block([0.0, 0.0, eaves], [l * 0.96, w * 0.96, h * 0.025]);
    for side in 0..4 {
        let [reach, across] = if side % 2 == 0 { [l, w] } else { [w, l] };
        s.placed([0.0; 3], [0.0, 0.0, f64::from(side) * FRAC_PI_2], |s| {
            for level in 1..floors {
                s.part("window", Plan::own(Stuff::Glass));
                s.block(
                    [reach * 0.42, 0.0, base + pitch * (level as f64 + 0.3)],
                    [0.04, across * 0.18, pitch * 0.5],
                );
            }
            clock(s, [reach * 0.42, eaves - pitch * 0.5], (across * 0.3).min(pitch * 0.42));
        });
    }
    s.part("door", Plan::own(Stuff::Wood));
    s.block([l * 0.5, 0.0, 0.0], [0.04, w * 0.24, base * 0.9]);
    s.part("roof", Plan { stuff: Stuff::Wood, ..p.clone() }.second(Stuff::Wood, [0.12, 0.2, 0.17]));
    s.tapered([0.0, 0.0, eaves + h * 0.025], [l * 0.92, w * 0.92, h * 0.155], [0.02, 0.02]);
    s.part("spire", Plan::own(Stuff::Metal));
    s.pillar([0.0, 0.0, h * 0.975], 0.04, h * 0.025, 8);
}

/// A dial that faces the front, at ten past ten.
fn clock(s: &mut Sculpt, [x, z]: [f64; 2], radius: f64) {
    s.placed([x, 0.0, z], [0.0, FRAC_PI_2, 0.0], |s| {
        s.part("dial", Plan::painted(Stuff::Metal, DARK));
        s.pillar([0.0; 3], radius, 0.05, 24);
        s.part("dial", Plan::painted(Stuff::Glass, [0.8, 0.78, 0.7]));
        s.pillar([0.0, 0.0, 0.05], radius * 0.9, 0.02, 24);
        s.part("hand", Plan::painted(Stuff::Metal, DARK));
        for (angle, reach) in [(PI / 3.0, 0.8), (-PI / 3.0, 0.5)] {
            // In this frame up is -x.
            s.placed([0.0, 0.0, 0.07], [0.0, 0.0, angle], |s| {
                s.block([-radius * reach * 0.5, 0.0, 0.0], [radius * reach, radius * 0.07, 0.02]);
            });
        }
    });
}

fn water_tower(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let r = l * 0.5;
    let (deck, top) = (h * 0.56, h * 0.86);
    let legs = p.count(0);
    s.part("leg", p.shaded(0.6));
    let feet: Vec<[f64; 2]> = around(legs).map(|[cos, sin]| [r * 0.94 * cos, r * 0.94 * sin]).collect();
    for [x, y] in &feet {
        s.bar([*x, *y, 0.0], [x * 0.84, y * 0.84, deck], [0.12; 2], 8);
    }
    s.part("brace", p.shaded(0.5));
    for k in 0..legs {
        let (a, b) = (feet[k], feet[(k + 1) % legs]);
        for (share, inward) in [(0.33, 0.95), (0.68, 0.9)] {
            s.bar(
                [a[0] * inward, a[1] * inward, deck * share],
                [b[0] * inward, b[1] * inward, deck * share],
                [0.05; 2],
                6,
            );
        }
    }
    s.part("deck", p.shaded(0.5));
    s.pillar([0.0, 0.0, deck], r, h * 0.012, 32);
    s.part("tank", walled(p, 1.0, 0.12));
    s.pillar([0.0, 0.0, deck + h * 0.012], r * 0.9, top - deck - h * 0.012, 32);
    s.part("pipe", p.shaded(0.6));
    s.pillar([0.0; 3], 0.25, deck, 12);
    s.part("roof", p.second(Stuff::Metal, [0.2, 0.1, 0.07]));
    s.frustum([0.0, 0.0, top], [r * 0.96, 0.05], h - top, 32);
}

fn chimney(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let (r, sides) = (l * 0.5, if p.is_square() { 4 } else { 24 });
    s.part("foot", p.shaded(0.8));
    s.pillar([0.0; 3], r, h * 0.06, sides);
    // The flue is open at the top.
    s.part("shaft", p.main());
    let levels = [[h * 0.06, r * 0.9, r * 0.5], [h * 0.96, r * 0.6, r * 0.42], [h, r * 0.68, r * 0.42]];
    s.vessel([0.0; 3], &levels, h * 0.3, sides);
    let bands = p.count(0);
    for z in spread(bands, h * 0.07 * (bands.max(1) - 1) as f64) {
        s.part("band", p.second(p.stuff, WHITE));
        let low = h * 0.82 + z;
        let radius = |z: f64| r * (0.9 - 0.3 * (z / h - 0.06) / 0.9) + 0.02;
        s.vessel(
            [0.0; 3],
            &[
                [low, radius(low), radius(low) - 0.04],
                [low + h * 0.03, radius(low + h * 0.03), radius(low + h * 0.03) - 0.04],
            ],
            low + h * 0.01,
            sides,
        );
    }
}

fn windmill(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let sweep = w * 0.5;
    let axle = h - sweep.min(h * 0.55);
    let body = axle + h * 0.02;
    let r = l * 0.42;
    s.part("tower", walled(p, 1.0, 0.3));
    s.frustum([-l * 0.08, 0.0, 0.0], [r, r * 0.66], body, 16);
    s.part("door", Plan::own(Stuff::Wood));
    s.block([-l * 0.08 + r * 0.95, 0.0, 0.0], [0.12, r * 0.5, body * 0.22]);
    s.part("window", Plan::own(Stuff::Glass));
    s.block([-l * 0.08 + r * 0.82, 0.0, body * 0.45], [0.12, r * 0.3, body * 0.1]);
    s.part("cap", p.second(Stuff::Wood, [0.14, 0.09, 0.06]));
    s.lathe(
        [-l * 0.08, 0.0, body],
        &[[r * 0.74, 0.0], [r * 0.6, h * 0.08], [r * 0.2, h * 0.13], [0.0, h * 0.14]],
        16,
        Hulls::Whole,
    );
    s.part("axle", Plan::own(Stuff::Wood));
    s.bar([0.0, 0.0, axle], [l * 0.5, 0.0, axle], [0.14; 2], 10);
    let sails = p.count(0);
    for k in 0..sails {
        let angle = TAU * (k as f64 + 0.5) / sails as f64;
        s.placed([l * 0.46, 0.0, axle], [angle, 0.0, 0.0], |s| {
            s.part("spar", Plan::own(Stuff::Wood));
            s.block([0.0; 3], [0.1, 0.12, sweep]);
            s.part("sail", Plan::painted(Stuff::Fabric, [0.7, 0.66, 0.56]));
            s.block([0.03, sweep * 0.1 + 0.06, sweep * 0.2], [0.02, sweep * 0.2, sweep * 0.8]);
            s.part("spar", Plan::own(Stuff::Wood));
            for z in spread(6, sweep * 0.76) {
                s.block([0.0, sweep * 0.1 + 0.06, sweep * 0.6 + z - 0.02], [0.05, sweep * 0.21, 0.04]);
            }
        });
    }
}

fn turbine(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let sweep = w * 0.5;
    let axle = h - sweep.min(h * 0.5);
    s.part("tower", p.main());
    s.frustum([-l * 0.2, 0.0, 0.0], [0.4, 0.22], axle, 16);
    s.part("nacelle", p.shaded(0.9));
    s.tapered([-l * 0.1, 0.0, axle - 0.3], [l * 0.7, 0.7, 0.7], [0.9, 0.8]);
    s.part("hub", p.shaded(0.8));
    s.ball([l * 0.3, 0.0, axle], [0.4, 0.35, 0.35], 8, 12);
    let blades = p.count(0);
    for k in 0..blades {
        let angle = TAU * k as f64 / blades as f64;
        s.placed([l * 0.34, 0.0, axle], [angle, 0.0, 0.0], |s| {
            s.part("blade", p.main());
            s.tapered([0.0; 3], [0.16, 0.5, sweep], [0.3, 0.25]);
        });
    }
}

fn bridge(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let rail = if p.has(0) { (h * 0.42).min(1.1) } else { 0.0 };
    let (rise, thick) = (h - rail, 0.28);
    // The deck is a bow over the length: its chord and rise give the circle.
    let climb = (rise - thick).max(0.1);
    let radius = (l * l * 0.25 + climb * climb) / (2.0 * climb);
    let half = simworld_core::ops::asin((l * 0.5 / radius).min(1.0)) - 0.02;
    let stones = 14;
    let angle = |k: usize| FRAC_PI_2 - half + 2.0 * half * k as f64 / stones as f64;
    s.placed([0.0; 3], [0.0, 0.0, FRAC_PI_2], |s| {
        for k in 0..stones {
            s.part("deck", p.varied());
            s.bow([0.0, 0.0, rise - thick - radius], [radius, radius + thick], w, [angle(k), angle(k + 1)]);
        }
    });
    let at = |k: usize, lift: f64| {
        let (sin, cos) = simworld_core::ops::sin_cos(angle(k));
        [(radius + thick) * cos, rise - thick - radius + (radius + thick) * sin + lift]
    };
    s.part("abutment", p.shaded(0.8));
    for side in [-1.0, 1.0] {
        s.block([side * l * 0.48, 0.0, 0.0], [l * 0.04, w, thick * 0.7]);
    }
    if p.has(0) {
        for y in [-1.0, 1.0].map(|side| side * (w * 0.5 - 0.06)) {
            s.part("post", p.shaded(0.85));
            for k in (0..=stones).step_by(2) {
                let [x, z] = at(k, -0.04);
                s.block([x, y, z], [0.1, 0.1, rail]);
            }
            s.part("handrail", p.shaded(0.7));
            let path: Vec<[f64; 3]> =
                (0..=stones).map(|k| at(k, rail - 0.06)).map(|[x, z]| [x, y, z]).collect();
            s.tube(&path, [0.05; 2], 8);
        }
    }
}

fn watchtower(s: &mut Sculpt, p: &mut Plan) {
    let [l, w, h] = p.size;
    let (deck, eaves) = (h * 0.58, h * 0.84);
    let legs = p.count(0);
    s.part("leg", p.shaded(0.85));
    for [x, y] in spots(legs, [l * 0.42, w * 0.42]) {
        s.bar([x * 1.12, y * 1.12, 0.0], [x, y, deck], [0.1; 2], 8);
        s.bar([x, y, deck], [x, y, eaves], [0.07; 2], 8);
    }
    s.part("deck", p.main());
    s.block([0.0, 0.0, deck], [l * 0.94, w * 0.94, 0.1]);
    for (side, (reach, across)) in [(l, w), (w, l), (l, w), (w, l)].into_iter().enumerate() {
        s.placed([0.0; 3], [0.0, 0.0, side as f64 * FRAC_PI_2], |s| {
            s.part("railing", p.varied());
            s.block([reach * 0.45, 0.0, deck + 0.1], [0.05, across * 0.88, h * 0.11]);
        });
    }
    s.part("ladder", p.shaded(0.7));
    for y in [-0.25, 0.25] {
        s.bar([l * 0.5, y, 0.0], [l * 0.44, y, deck + 0.3], [0.04; 2], 6);
    }
    for k in 1..12 {
        let share = f64::from(k) / 12.0;
        let x = l * (0.5 - 0.055 * share);
        s.bar([x, -0.25, deck * share], [x, 0.25, deck * share], [0.025; 2], 6);
    }
    s.part("roof", p.second(Stuff::Wood, [0.2, 0.08, 0.05]));
    s.tapered([0.0, 0.0, eaves], [l, w, h - eaves], [0.05, 0.05]);
}

fn lighthouse(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let r = l * 0.5;
    let (foot, gallery) = (h * 0.06, h * 0.8);
    s.part("foot", p.shaded(0.5));
    s.pillar([0.0; 3], r, foot, 32);
    let radius = |z: f64| r * (0.84 - 0.34 * (z - foot) / (gallery - foot));
    let stripes = p.count(0) * 2 + 1;
    let pitch = (gallery - foot) / stripes as f64;
    for k in 0..stripes {
        let low = foot + pitch * k as f64;
        let mut finish = if k % 2 == 0 { p.main() } else { p.second(p.stuff, [0.55, 0.03, 0.02]) };
        finish.density *= 0.4;
        s.part("tower", finish);
        s.frustum([0.0, 0.0, low], [radius(low), radius(low + pitch)], pitch, 32);
    }
    s.part("gallery", Plan::painted(Stuff::Metal, DARK));
    s.pillar([0.0, 0.0, gallery], r * 0.64, h * 0.02, 32);
    s.hoop([0.0, 0.0, gallery + h * 0.06], r * 0.6, 0.03, 32);
    for [cos, sin] in around(12) {
        s.pillar([r * 0.6 * cos, r * 0.6 * sin, gallery + h * 0.02], 0.025, h * 0.04, 6);
    }
    s.part("lantern", Plan::painted(Stuff::Glass, [0.9, 0.85, 0.6]));
    s.pillar([0.0, 0.0, gallery + h * 0.02], r * 0.36, h * 0.1, 16);
    s.part("roof", p.second(Stuff::Metal, [0.55, 0.03, 0.02]));
    s.lathe(
        [0.0, 0.0, gallery + h * 0.12],
        &[[r * 0.44, 0.0], [r * 0.25, h * 0.05], [0.04, h * 0.08]],
        16,
        Hulls::Whole,
    );
}

fn silo(s: &mut Sculpt, p: &mut Plan) {
    let [l, _, h] = p.size;
    let r = l * 0.5;
    let mut body = p.main();
    // Sheet around a hollow.
    body.density *= 0.12;
    s.part("body", body);
    s.pillar([0.0; 3], r * 0.97, h * 0.8, 32);
    for z in spread(8, h * 0.74) {
        s.part("hoop", p.shaded(0.75));
        s.hoop([0.0, 0.0, h * 0.4 + z], r * 0.97, r * 0.03, 32);
    }
    s.part("roof", p.second(Stuff::Plastic, [0.3, 0.31, 0.33]));
    s.lathe(
        [0.0, 0.0, h * 0.8],
        &[[r, 0.0], [r * 0.86, h * 0.09], [r * 0.5, h * 0.165], [0.0, h * 0.2]],
        32,
        Hulls::Whole,
    );
}
