//! The solids that things are made of.

use std::f64::consts::{PI, TAU};

use crate::ops;

use super::loft::{Ends, Hulls, Loft, Shade};
use super::{Sculpt, V};

/// A level of a hollow solid: height, outer and inner radius, m.
type Hollow = [f64; 3];

impl Sculpt {
    /// A box; `at` is the middle of its bottom.
    pub fn block(&mut self, at: [f64; 3], size: [f64; 3]) {
        self.tapered(at, size, [1.0, 1.0]);
    }

    /// A box whose top is so many times as long and wide as its bottom; a roof where one is 0.
    pub fn tapered(&mut self, [x, y, z]: [f64; 3], size: [f64; 3], top: [f64; 2]) {
        let (half, height) = ([size[0] * 0.5, size[1] * 0.5], size[2]);
        let ring = |z: f64, [sx, sy]: [f64; 2]| {
            [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]
                .map(|[i, j]| V::new(x + i * half[0] * sx, y + j * half[1] * sy, z))
                .to_vec()
        };
        let rings = vec![ring(z, [1.0, 1.0]), ring(z + height, top)];
        self.add(&Loft { rings, ends: Ends::Closed, shade: Shade::Flat }, Hulls::Whole);
    }

    /// An upright cylinder on the middle of its bottom.
    pub fn pillar(&mut self, at: [f64; 3], radius: f64, height: f64, sides: usize) {
        self.lathe(at, &[[radius, 0.0], [radius, height]], sides, Hulls::Whole);
    }

    /// An upright cone or frustum on the middle of its bottom.
    pub fn frustum(&mut self, at: [f64; 3], radii: [f64; 2], height: f64, sides: usize) {
        self.lathe(at, &[[radii[0], 0.0], [radii[1], height]], sides, Hulls::Whole);
    }

    /// A profile of radius and height, turned about the vertical through `at`.
    pub fn lathe(&mut self, at: [f64; 3], profile: &[[f64; 2]], sides: usize, hulls: Hulls) {
        let ring = |[radius, height]: &[f64; 2]| circle(at, *radius, *height, sides);
        let rings = profile.iter().map(ring).collect();
        let shade = if sides <= 6 { Shade::Flat } else { Shade::Round };
        self.add(&Loft { rings, ends: Ends::Closed, shade }, hulls);
    }

    /// A prism with a regular or other convex outline, given counter-clockwise from above, standing at a height.
    pub fn prism(&mut self, outline: &[[f64; 2]], z: f64, height: f64) {
        let ring = |z: f64| outline.iter().map(|[x, y]| V::new(*x, *y, z)).collect();
        let loft = Loft { rings: vec![ring(z), ring(z + height)], ends: Ends::Closed, shade: Shade::Flat };
        self.add(&loft, Hulls::Whole);
    }

    /// A straight round bar from one point to another, as thick at each end as its radius says.
    pub fn bar(&mut self, from: [f64; 3], to: [f64; 3], radii: [f64; 2], sides: usize) {
        let (from, to) = (V::from(from), V::from(to));
        let rings = along(&[from, to], |index| radii[index], sides);
        let shade = if sides <= 6 { Shade::Flat } else { Shade::Round };
        self.add(&Loft { rings, ends: Ends::Closed, shade }, Hulls::Whole);
    }

    /// A round bar along points, with mitred bends.
    pub fn tube(&mut self, path: &[[f64; 3]], radii: [f64; 2], sides: usize) {
        let path: Vec<V> = path.iter().copied().map(V::from).collect();
        if path.len() < 2 {
            return;
        }
        let last = (path.len() - 1) as f64;
        let radius = |index: usize| radii[0] + (radii[1] - radii[0]) * index as f64 / last;
        let rings = along(&path, radius, sides);
        self.add(&Loft { rings, ends: Ends::Closed, shade: Shade::Smooth }, Hulls::Segments);
    }

    /// An ellipsoid about its middle.
    pub fn ball(&mut self, middle: [f64; 3], radii: [f64; 3], rings: usize, sides: usize) {
        self.ellipsoid(middle, radii, [rings, sides], Shade::Smooth);
    }

    /// An ellipsoid with facets, as broken stone has.
    pub fn lump(&mut self, middle: [f64; 3], radii: [f64; 3], rings: usize, sides: usize) {
        self.ellipsoid(middle, radii, [rings, sides], Shade::Flat);
    }

    fn ellipsoid(&mut self, middle: [f64; 3], radii: [f64; 3], [rings, sides]: [usize; 2], shade: Shade) {
        let ring = |index: usize| {
            let (sin, cos) = latitude(index, rings);
            let place =
                |point: V| V::new(point.x * radii[0], point.y * radii[1], sin * radii[2]) + V::from(middle);
            circle([0.0; 3], cos, 0.0, sides).into_iter().map(place).collect()
        };
        let rings = (0..=rings).map(ring).collect();
        self.add(&Loft { rings, ends: Ends::Closed, shade }, Hulls::Whole);
    }

    /// A vessel that is open at its top: a bottom up to `floor`, and a wall through levels from the lowest to the highest.
    /// Each inner radius is that of the room inside.
    pub fn vessel(&mut self, at: [f64; 3], levels: &[Hollow], floor: f64, sides: usize) {
        let (Some(first), Some(last)) = (levels.first(), levels.last()) else { return };
        let ring = |radius: f64, height: f64| circle(at, radius, height, sides);
        let inner = |height: f64| inner_at(levels, height);
        let mut rings = vec![ring(0.0, first[0])];
        rings.extend(levels.iter().map(|[height, outer, _]| ring(*outer, *height)));
        rings.push(ring(last[2], last[0]));
        let inside: Vec<_> =
            levels.iter().rev().skip(1).filter(|[height, ..]| *height > floor + 1e-9).collect();
        rings.extend(inside.iter().map(|[height, _, radius]| ring(*radius, *height)));
        rings.extend([ring(inner(floor), floor), ring(0.0, floor)]);
        let shade = if sides <= 6 { Shade::Flat } else { Shade::Round };
        let skin = Loft { rings, ends: Ends::Closed, shade };
        if self.add(&skin, Hulls::Whole) {
            self.meet(vessel_hulls(levels, floor, ring));
        }
    }

    /// A box that is open at its top, on the middle of its bottom.
    pub fn trough(&mut self, at: [f64; 3], size: [f64; 3], wall: f64, floor: f64) {
        let [x, y, z] = at;
        let ring = |inset: f64, height: f64| {
            let (a, b) = (size[0] * 0.5 - inset, size[1] * 0.5 - inset);
            [[a, b], [-a, b], [-a, -b], [a, -b]].map(|[i, j]| V::new(x + i, y + j, z + height)).to_vec()
        };
        let middle = |height: f64| vec![V::new(x, y, z + height); 4];
        let height = size[2];
        let rings = vec![
            middle(0.0),
            ring(0.0, 0.0),
            ring(0.0, height),
            ring(wall, height),
            ring(wall, floor),
            middle(floor),
        ];
        self.add(&Loft { rings, ends: Ends::Closed, shade: Shade::Flat }, Hulls::Whole);
        let sides = |k: usize| {
            let rings = [ring(0.0, 0.0), ring(0.0, height), ring(wall, 0.0), ring(wall, height)];
            rings.iter().flat_map(|ring| [ring[k], ring[(k + 1) % 4]]).collect::<Vec<V>>()
        };
        let floor = ring(wall, 0.0).into_iter().chain(ring(wall, floor)).collect();
        self.meet((0..4).map(sides).chain([floor]).collect());
    }

    /// A bow of four-sided section in the plane of y and z, from one angle to another (rad, 0 to the left, π/2 upwards).
    pub fn bow(&mut self, middle: [f64; 3], radii: [f64; 2], depth: f64, [from, to]: [f64; 2]) {
        let steps = (((to - from).abs() / (PI / 12.0)).ceil() as usize).max(1);
        let ring = |step: usize| {
            let angle = from + (to - from) * step as f64 / steps as f64;
            let (sin, cos) = ops::sin_cos(angle);
            let [inner, outer] = radii;
            [(inner, -1.0), (outer, -1.0), (outer, 1.0), (inner, 1.0)]
                .map(|(radius, side)| {
                    V::new(side * depth * 0.5, radius * cos, radius * sin) + V::from(middle)
                })
                .to_vec()
        };
        let rings = (0..=steps).map(ring).collect();
        self.add(&Loft { rings, ends: Ends::Closed, shade: Shade::Flat }, Hulls::Segments);
    }

    /// A torus-like hoop lying flat about its middle, of round section.
    pub fn hoop(&mut self, middle: [f64; 3], radius: f64, thickness: f64, sides: usize) {
        let ring = |step: usize| {
            let (sin, cos) = ops::sin_cos(TAU * step as f64 / sides as f64);
            (0..6)
                .map(|k| {
                    let (up, out) = ops::sin_cos(TAU * f64::from(k) / 6.0);
                    let reach = radius + thickness * out;
                    V::new(reach * cos, reach * sin, thickness * up) + V::from(middle)
                })
                .collect()
        };
        let rings = (0..sides).map(ring).collect();
        self.add(&Loft { rings, ends: Ends::Joined, shade: Shade::Smooth }, Hulls::Segments);
    }

    /// A plate with a convex outline in the plane of y and z, its back at `x`, so deep towards the front.
    pub fn panel(&mut self, outline: &[[f64; 2]], x: f64, depth: f64) {
        let ring = |x: f64| outline.iter().map(|[y, z]| V::new(x, *y, *z)).collect();
        let loft = Loft { rings: vec![ring(x), ring(x + depth)], ends: Ends::Closed, shade: Shade::Flat };
        self.add(&loft, Hulls::Whole);
    }

    /// A flat leaf along points: `widths` across, from side to side, at each of them.
    pub fn blade(&mut self, path: &[[f64; 3]], widths: &[f64], thickness: f64) {
        let path: Vec<V> = path.iter().copied().map(V::from).collect();
        let (Some(first), Some(last)) = (path.first(), path.last()) else { return };
        let across = V::z().cross(&(last - first)).try_normalize(1e-9).unwrap_or_else(V::y);
        let ring = |(at, width): (&V, &f64)| {
            let (side, up) = (across * (width * 0.5), V::z() * (thickness * 0.5));
            vec![at + side, at + up, at - side, at - up]
        };
        let rings = path.iter().zip(widths).map(ring).collect();
        self.add(&Loft { rings, ends: Ends::Closed, shade: Shade::Flat }, Hulls::Segments);
    }

    /// A cone in sectors, each with a coating of its own; `at` is the middle of its flat bottom.
    pub fn sectors(
        &mut self,
        at: [f64; 3],
        [radius, height]: [f64; 2],
        sides: usize,
        coatings: [super::Coating; 2],
    ) {
        let rim = circle(at, radius, 0.0, sides);
        let (middle, apex) = (V::from(at), V::from(at) + V::z() * height);
        for k in 0..sides {
            self.coating = coatings[k % 2];
            let rings = vec![vec![rim[k], rim[(k + 1) % sides], middle], vec![apex; 3]];
            self.add(&Loft { rings, ends: Ends::Closed, shade: Shade::Flat }, Hulls::Whole);
        }
    }

    /// A skin with two faces: strips of points across, each with the one inside it, which has as many points; nothing where one has not.
    pub fn shell(&mut self, strips: &[(Vec<V>, Vec<V>)]) {
        if strips.iter().any(|(outer, inner)| outer.len() != inner.len()) {
            return;
        }
        let ring =
            |(outer, inner): &(Vec<V>, Vec<V>)| outer.iter().chain(inner.iter().rev()).copied().collect();
        let rings = strips.iter().map(ring).collect();
        if !self.add(&Loft { rings, ends: Ends::Strips, shade: Shade::Flat }, Hulls::Whole) {
            return;
        }
        let hulls = strips.windows(2).flat_map(|pair| {
            (1..pair[0].0.len()).map(|k| {
                pair.iter()
                    .flat_map(|(outer, inner)| [outer[k - 1], outer[k], inner[k - 1], inner[k]])
                    .collect::<Vec<V>>()
            })
        });
        self.meet(hulls.collect());
    }

    /// What bodies meet of the last piece, where its hulls are not those of its rings.
    fn meet(&mut self, hulls: Vec<Vec<V>>) {
        let frame = self.frame;
        if let Some(piece) = self.pieces.last_mut() {
            let place = |hull: Vec<V>| {
                hull.into_iter().map(|point| (frame * nalgebra::Point3::from(point)).coords).collect()
            };
            piece.hulls = hulls.into_iter().map(place).collect();
        }
    }
}

/// The bottom, and the wall sector by sector.
fn vessel_hulls(levels: &[Hollow], floor: f64, ring: impl Fn(f64, f64) -> Vec<V>) -> Vec<Vec<V>> {
    let at_floor = [floor, outer_at(levels, floor), inner_at(levels, floor)];
    let lower = levels.iter().filter(|level| level[0] < floor - 1e-9);
    let upper = levels.iter().filter(|level| level[0] > floor + 1e-9);
    let bottom: Vec<V> =
        lower.copied().chain([at_floor]).flat_map(|[height, outer, _]| ring(outer, height)).collect();
    let wall: Vec<Hollow> = [at_floor].into_iter().chain(upper.copied()).collect();
    let mut hulls = vec![bottom];
    for pair in wall.windows(2) {
        let rings: Vec<Vec<V>> =
            pair.iter().flat_map(|[z, outer, inner]| [ring(*outer, *z), ring(*inner, *z)]).collect();
        let sides = rings[0].len();
        hulls.extend(
            (0..sides)
                .map(|k| rings.iter().flat_map(|ring| [ring[k], ring[(k + 1) % sides]]).collect::<Vec<V>>()),
        );
    }
    hulls
}

fn outer_at(levels: &[Hollow], height: f64) -> f64 {
    between(levels, height, 1)
}

fn inner_at(levels: &[Hollow], height: f64) -> f64 {
    between(levels, height, 2)
}

/// A radius at a height between two levels.
fn between(levels: &[Hollow], height: f64, which: usize) -> f64 {
    for pair in levels.windows(2) {
        if (pair[0][0]..=pair[1][0]).contains(&height) {
            let share = (height - pair[0][0]) / (pair[1][0] - pair[0][0]).max(1e-9);
            return pair[0][which] + (pair[1][which] - pair[0][which]) * share;
        }
    }
    levels.last().map_or(0.0, |level| level[which])
}

/// A level ring about the vertical through a point, counter-clockwise from above.
fn circle([x, y, z]: [f64; 3], radius: f64, height: f64, sides: usize) -> Vec<V> {
    // Four sides are a square with its edges along the axes.
    let start = if sides == 4 { 0.5 } else { 0.0 };
    let reach = if sides == 4 { radius * std::f64::consts::SQRT_2 } else { radius };
    (0..sides)
        .map(|k| {
            let (sin, cos) = ops::sin_cos(TAU * (k as f64 + start) / sides as f64);
            V::new(x + reach * cos, y + reach * sin, z + height)
        })
        .collect()
}

/// Sine and cosine of the latitude of a ring, exactly 0 at the poles.
fn latitude(ring: usize, rings: usize) -> (f64, f64) {
    match ring {
        0 => (-1.0, 0.0),
        last if last == rings => (1.0, 0.0),
        _ => ops::sin_cos(PI * (ring as f64 / rings as f64 - 0.5)),
    }
}

/// Rings across a way, at bends across the half of the angle.
fn along(path: &[V], radius: impl Fn(usize) -> f64, sides: usize) -> Vec<Vec<V>> {
    let way = |from: usize, to: usize| (path[to] - path[from]).try_normalize(1e-9).unwrap_or_else(V::z);
    let last = path.len() - 1;
    let first = way(0, 1);
    let helper = if first.z.abs() > 0.9 { V::x() } else { V::z() };
    let mut across = first.cross(&helper).normalize();
    (0..=last)
        .map(|index| {
            let before = way(index.saturating_sub(1), index.max(1));
            let after = way(index.min(last - 1), (index + 1).min(last));
            let ahead = (before + after).try_normalize(1e-9).unwrap_or(after);
            // Over the straight piece before the bend, or a turn back would leave nothing of it.
            for way in [before, ahead] {
                across = (across - way * across.dot(&way)).try_normalize(1e-9).unwrap_or(across);
            }
            let other = ahead.cross(&across);
            let size = radius(index);
            (0..sides)
                .map(|k| {
                    let (sin, cos) = ops::sin_cos(TAU * k as f64 / sides as f64);
                    path[index] + (across * cos + other * sin) * size
                })
                .collect()
        })
        .collect()
}
