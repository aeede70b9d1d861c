//! What is put up to be looked at, or for whoever falls into the water.

use super::{ALONG_X, Kit, Maker, SIDES, SIDEWAYS, steel, white, wood};
use crate::asset::Material;
use crate::asset::sculpt::{Coating, Sculpt};
use std::f64::consts::{FRAC_PI_2, PI};

pub(super) const MAKERS: &[(&str, Maker)] =
    &[("anchor", anchor), ("archway", archway), ("lifebuoy_stand", lifebuoy_stand)];

/// An anchor that stands on a slab: a shank with its ring and stock, and two arms with their flukes.
fn anchor(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("slab", Coating::of(Material::Concrete, [0.36, 0.36, 0.35]));
    s.block([0.0; 3], [0.8 * l, 0.8 * w, 0.07 * h]);
    let reach = 0.44 * l;
    let crown = 0.06 * h + reach;
    s.part("arms", kit.main());
    s.placed([0.0, 0.0, crown], SIDEWAYS, |s| {
        s.bow([0.0; 3], [0.82 * reach, reach], 0.1, [PI + 0.1, 2.0 * PI - 0.1]);
    });
    for side in SIDES {
        s.tapered([side * 0.93 * reach, 0.0, crown - 0.14], [0.14 * l, 0.3 * w, 0.26], [0.3, 0.2]);
    }
    s.part("shank", kit.main());
    s.bar([0.0, 0.0, 0.08 * h], [0.0, 0.0, 0.92 * h], [0.06, 0.045], 8);
    s.part("stock", kit.shade(0.8));
    s.bar([0.0, -0.5 * w, 0.82 * h], [0.0, 0.5 * w, 0.82 * h], [0.035; 2], 8);
    s.part("ring", kit.main());
    s.placed([0.0, 0.0, h - 0.08], ALONG_X, |s| s.hoop([0.0; 3], 0.065, 0.015, 12));
}

/// A round arch between two piers, through which one walks along x.
fn archway(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    let outer = 0.5 * w;
    let inner = 0.56 * outer;
    let spring = h - outer;
    let pier = outer - inner;
    s.part("pier", kit.main());
    for side in SIDES {
        s.block([0.0, side * (outer - 0.5 * pier), 0.0], [0.86 * l, 0.98 * pier, spring]);
    }
    s.part("arch", kit.shade(0.9));
    s.bow([0.0, 0.0, spring], [inner, outer], 0.84 * l, [0.0, PI]);
    s.part("plinth", kit.shade(0.75));
    for side in SIDES {
        let y = side * (outer - 0.5 * pier);
        s.block([0.0, y, 0.0], [l, pier, 0.08 * h]);
        s.block([0.0, y, spring - 0.04 * h], [0.96 * l, pier, 0.04 * h]);
    }
    s.part("keystone", kit.shade(0.75));
    s.bow([0.0, 0.0, spring], [0.94 * inner, outer], 0.94 * l, [FRAC_PI_2 - 0.12, FRAC_PI_2 + 0.12]);
}

/// A board on a post with a lifebuoy.
fn lifebuoy_stand(s: &mut Sculpt, kit: &Kit) {
    let [l, w, h] = kit.size;
    s.part("post", steel());
    s.bar([-0.1 * l, 0.0, 0.0], [-0.1 * l, 0.0, 0.6 * h], [0.035; 2], 8);
    s.part("board", wood());
    s.block([-0.2 * l, 0.0, 0.56 * h], [0.2 * l, w, 0.41 * h]);
    s.part("roof", kit.shade(0.8));
    s.block([0.0, 0.0, 0.97 * h], [l, w, 0.03 * h]);
    let (middle, radius, thick) = ([0.2 * l, 0.0, 0.76 * h], 0.38 * w, 0.055);
    s.part("buoy", kit.main());
    s.placed(middle, ALONG_X, |s| s.hoop([0.0; 3], radius, thick, 18));
    s.part("bands", white());
    for quarter in [0.25, 0.75, 1.25, 1.75] {
        let angles = [quarter * PI - 0.16, quarter * PI + 0.16];
        s.bow(middle, [radius - 1.06 * thick, radius + 1.06 * thick], 2.1 * thick, angles);
    }
}
