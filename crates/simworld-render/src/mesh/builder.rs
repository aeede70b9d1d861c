//! Vertices that fit any size: a point is an anchor, in shares of the body's box, plus an offset in fixed units.
//!
//! So a car of any length has round wheels, and a house of any height a parapet of one height. Body frame as in
//! core: the origin is the middle of the bottom, x forward, y left, z up; anchors reach from -0.5 to 0.5 in x and y
//! and from 0 to 1 in z. The unit of offsets is set by the instance: metres, a radius, or the height.

use bytemuck::{Pod, Zeroable};
use simworld_core::geometry::{Point3, Pose, Vector3};
use simworld_core::ops;

pub(crate) type V3 = [f32; 3];

/// One corner of a triangle, as the shaders read it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Vertex {
    /// Shares of the body's box.
    pub anchor: V3,
    /// Units of the instance.
    pub offset: V3,
    /// Outward, in the body frame.
    pub normal: V3,
    /// A [`Material`].
    pub material: u32,
}

/// What a surface is made of; the numbers are those of `materials.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(crate) enum Material {
    /// The colour of the instance.
    Body = 0,
    /// The second colour of the instance: trousers, a roof, a lid.
    Second = 1,
    Glass = 2,
    Rubber = 3,
    Metal = 4,
    Wood = 5,
    Skin = 6,
    Hair = 7,
    HeadLight = 8,
    TailLight = 9,
    LampGlow = 10,
    SignalRed = 11,
    SignalYellow = 12,
    SignalGreen = 13,
    White = 14,
    Dark = 15,
    /// The colour of the instance under a clear coat, as vehicles have it.
    Paint = 16,
    /// Green that is not of the instance: plants in pots, goods on a stall.
    Leaf = 17,
}

/// A point: anchor and offset.
#[derive(Clone, Copy, Debug)]
pub(crate) struct P {
    pub a: V3,
    pub o: V3,
}

/// A point by its shares of the box alone.
pub(crate) const fn share(x: f32, y: f32, z: f32) -> P {
    P { a: [x, y, z], o: [0.0; 3] }
}

/// A point by its offset alone.
pub(crate) const fn unit(x: f32, y: f32, z: f32) -> P {
    P { a: [0.0; 3], o: [x, y, z] }
}

impl P {
    /// The point moved by an offset.
    pub(crate) const fn plus(self, x: f32, y: f32, z: f32) -> Self {
        Self { a: self.a, o: [self.o[0] + x, self.o[1] + y, self.o[2] + z] }
    }

    /// The point that takes x, y and z of three points.
    fn mix(x: Self, y: Self, z: Self) -> Self {
        Self { a: [x.a[0], y.a[1], z.a[2]], o: [x.o[0], y.o[1], z.o[2]] }
    }
}

/// A ring of a turned surface: height, radii along x and y, and how far its middle is moved along x.
pub(crate) type Ring = [f32; 4];

/// Collects triangles of one mesh.
pub(crate) struct Builder {
    /// The size of the box and the unit at which normals are reckoned.
    nominal: V3,
    scale: f32,
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) indices: Vec<u32>,
}

impl Builder {
    /// A builder for bodies whose box is about `nominal` m, with offsets in units of `scale` m.
    pub(crate) fn new(nominal: V3, scale: f32) -> Self {
        Self { nominal, scale, vertices: Vec::new(), indices: Vec::new() }
    }

    fn place(&self, p: P) -> V3 {
        std::array::from_fn(|axis| p.a[axis] * self.nominal[axis] + p.o[axis] * self.scale)
    }

    fn push(&mut self, p: P, normal: V3, material: Material) -> u32 {
        self.vertices.push(Vertex { anchor: p.a, offset: p.o, normal, material: material as u32 });
        self.vertices.len() as u32 - 1
    }

    /// A flat quadrilateral, counter-clockwise from outside.
    pub(crate) fn quad(&mut self, corners: [P; 4], material: Material) {
        let [a, b, _, d] = corners.map(|corner| self.place(corner));
        // The diagonal from d serves where a and b coincide.
        let c = self.place(corners[2]);
        let normal = normalize(cross(sub(c, a), sub(d, b)));
        let [i, j, k, l] = corners.map(|corner| self.push(corner, normal, material));
        self.indices.extend([i, j, k, i, k, l]);
    }

    /// A solid of eight corners: the bottom counter-clockwise from above, then the top likewise.
    pub(crate) fn hexa(&mut self, bottom: [P; 4], top: [P; 4], material: Material) {
        self.hexa_of(bottom, top, [material; 3]);
    }

    /// As [`hexa`](Self::hexa), with materials for the sides, the top and the front (between corners 0 and 3).
    pub(crate) fn hexa_of(&mut self, bottom: [P; 4], top: [P; 4], materials: [Material; 3]) {
        let [b0, b1, b2, b3] = bottom;
        let [t0, t1, t2, t3] = top;
        self.quad([b3, b2, b1, b0], materials[0]);
        self.quad([t0, t1, t2, t3], materials[1]);
        for (k, [p, q, r, s]) in
            [[b0, b1, t1, t0], [b1, b2, t2, t1], [b2, b3, t3, t2], [b3, b0, t0, t3]].into_iter().enumerate()
        {
            self.quad([p, q, r, s], materials[if k == 0 { 2 } else { 0 }]);
        }
    }

    /// A box between its least and its greatest corner.
    pub(crate) fn cuboid(&mut self, low: P, high: P, material: Material) {
        let ring =
            |z| [P::mix(high, low, z), P::mix(high, high, z), P::mix(low, high, z), P::mix(low, low, z)];
        self.hexa(ring(low), ring(high), material);
    }

    /// A box whose top is drawn in by `dx` and `dy` units on each side.
    pub(crate) fn tapered(&mut self, low: P, high: P, [dx, dy]: [f32; 2], materials: [Material; 3]) {
        let ring =
            |z| [P::mix(high, low, z), P::mix(high, high, z), P::mix(low, high, z), P::mix(low, low, z)];
        let [a, b, c, d] = ring(high);
        let top = [a.plus(-dx, dy, 0.0), b.plus(-dx, -dy, 0.0), c.plus(dx, -dy, 0.0), d.plus(dx, dy, 0.0)];
        self.hexa_of(ring(low), top, materials);
    }

    /// A cone or cylinder between the middles of its ends, with radii in units, closed.
    pub(crate) fn tube(&mut self, ends: [P; 2], radii: [f32; 2], sides: u32, material: Material) {
        let axis = normalize(sub(self.place(ends[1]), self.place(ends[0])));
        let (u, v) = frame_around(axis);
        let slope =
            (radii[0] - radii[1]) * self.scale / length(sub(self.place(ends[1]), self.place(ends[0])));
        let first = self.vertices.len() as u32;
        for k in 0..=sides {
            let radial = around(u, v, k, sides);
            let normal = normalize(std::array::from_fn(|i| radial[i] + axis[i] * slope));
            for end in 0..2 {
                let [x, y, z] = radial.map(|component| component * radii[end]);
                self.push(ends[end].plus(x, y, z), normal, material);
            }
        }
        for k in 0..sides {
            let [a, b, c, d] = [0, 2, 3, 1].map(|corner| first + 2 * k + corner);
            self.indices.extend([a, b, c, a, c, d]);
        }
        self.cap(ends[0], radii[0], [u, v, axis.map(|c| -c)], sides, material);
        self.cap(ends[1], radii[1], [u, v, axis], sides, material);
    }

    fn cap(&mut self, center: P, radius: f32, [u, v, normal]: [V3; 3], sides: u32, material: Material) {
        if radius <= 0.0 {
            return;
        }
        let middle = self.push(center, normal, material);
        for k in 0..sides {
            let [x, y, z] = around(u, v, k, sides).map(|component| component * radius);
            self.push(center.plus(x, y, z), normal, material);
        }
        let upwards = dot(cross(u, v), normal) > 0.0;
        for k in 0..sides {
            let (a, b) = (middle + 1 + k, middle + 1 + (k + 1) % sides);
            self.indices.extend(if upwards { [middle, a, b] } else { [middle, b, a] });
        }
    }

    /// A ball stretched to radii in units, whose upper and lower half may stand at different centres.
    pub(crate) fn ball(&mut self, centers: [P; 2], radii: V3, rings: u32, sides: u32, material: Material) {
        self.blob(centers, radii, [rings, sides], material, &|_| 1.0);
    }

    /// A ball whose radius is multiplied by a function of the direction.
    pub(crate) fn blob(
        &mut self,
        [lower, upper]: [P; 2],
        radii: V3,
        [rings, sides]: [u32; 2],
        material: Material,
        swell: &dyn Fn(V3) -> f32,
    ) {
        let first = self.vertices.len() as u32;
        // The equator stands twice, once for each half.
        let half = rings / 2;
        let levels = (0..=half).map(|ring| (ring, lower)).chain((half..=rings).map(|ring| (ring, upper)));
        for (ring, center) in levels {
            let latitude = std::f64::consts::PI * (f64::from(ring) / f64::from(rings) - 0.5);
            let (sin, cos) = ops::sin_cos(latitude);
            for k in 0..=sides {
                let flat = around([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], k % sides, sides);
                let direction = [flat[0] * cos as f32, flat[1] * cos as f32, sin as f32];
                let size = swell(direction);
                let normal = normalize(std::array::from_fn(|i| direction[i] / radii[i]));
                let [x, y, z] = std::array::from_fn(|i| direction[i] * radii[i] * size);
                self.push(center.plus(x, y, z), normal, material);
            }
        }
        let row = sides + 1;
        for level in 0..=rings {
            for k in 0..sides {
                let a = first + level * row + k;
                self.indices.extend([a, a + 1, a + row + 1, a, a + row + 1, a + row]);
            }
        }
    }

    /// A surface turned round the z axis through rings by ascending height; `place` says where its points are and must not
    /// mirror them. It is smooth where it bends by less than 60°. A ring without radii closes it.
    pub(crate) fn lathe(&mut self, rings: &[Ring], sides: u32, material: Material, place: &dyn Fn(V3) -> P) {
        let last = rings.len() - 1;
        let mut below = self.turned_row(rings, 0, [0, 1], sides, material, place);
        for ring in 0..last {
            let crease = ring + 1 < last && bends(&rings[ring..ring + 3]);
            let (from, to) = (ring, if crease || ring + 1 == last { ring + 1 } else { ring + 2 });
            let above = self.turned_row(rings, ring + 1, [from, to], sides, material, place);
            let (open_below, open_above) = (rings[ring][1] > 0.0, rings[ring + 1][1] > 0.0);
            for k in 0..sides {
                let (a, d) = (below + k, above + k);
                if open_below {
                    self.indices.extend([a, a + 1, d + 1]);
                }
                if open_above {
                    self.indices.extend([a, d + 1, d]);
                }
            }
            below = if crease {
                self.turned_row(rings, ring + 1, [ring + 1, ring + 2], sides, material, place)
            } else {
                above
            };
        }
    }

    /// The vertices of a ring, with the slope of the surface from one ring to another; returns the first.
    fn turned_row(
        &mut self,
        rings: &[Ring],
        ring: usize,
        [from, to]: [usize; 2],
        sides: u32,
        material: Material,
        place: &dyn Fn(V3) -> P,
    ) -> u32 {
        let point = |ring: usize, k: u32| {
            let [z, rx, ry, dx] = rings[ring];
            let [x, y, _] = around([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], k, sides);
            [dx + rx * x, ry * y, z]
        };
        let first = self.vertices.len() as u32;
        let origin = self.place(place([0.0; 3]));
        // A ring without radii has the directions of its neighbour.
        let wide = if rings[ring][1] > 0.0 {
            ring
        } else if ring == from {
            to
        } else {
            from
        };
        for k in 0..=sides {
            let along = sub(point(to, k), point(from, k));
            let across = sub(point(wide, k + 1), point(wide, k + sides - 1));
            let normal = normalize(cross(across, along));
            let normal = normalize(sub(self.place(place(normal)), origin));
            self.push(place(point(ring, k)), normal, material);
        }
        first
    }

    /// Takes over the triangles of another mesh, its anchors moved and turned and its materials renamed.
    pub(crate) fn append(&mut self, other: &Self, place: &Pose, material: &dyn Fn(u32) -> Material) {
        let first = self.vertices.len() as u32;
        let narrow = |v: Vector3| [v.x as f32, v.y as f32, v.z as f32];
        for vertex in &other.vertices {
            let [x, y, z]: V3 =
                std::array::from_fn(|i| vertex.anchor[i] * other.nominal[i] + vertex.offset[i] * other.scale);
            let point = place * Point3::new(f64::from(x), f64::from(y), f64::from(z));
            let normal = place.rotation * Vector3::from(vertex.normal.map(f64::from));
            let anchor = narrow(point.coords);
            let material = material(vertex.material);
            self.push(P { a: anchor, o: [0.0; 3] }, narrow(normal), material);
        }
        self.indices.extend(other.indices.iter().map(|index| first + index));
    }

    /// A limb: a tapered tube with round ends, radii in units.
    pub(crate) fn limb(&mut self, ends: [P; 2], radii: [f32; 2], material: Material) {
        self.tube(ends, radii, 8, material);
        for (end, radius) in ends.into_iter().zip(radii) {
            self.ball([end, end], [radius; 3], 4, 8, material);
        }
    }
}

/// Whether a turned surface has an edge at the middle one of three rings.
fn bends(rings: &[Ring]) -> bool {
    let slope = |a: &Ring, b: &Ring| normalize([(b[1] + b[2] - a[1] - a[2]) * 0.5, b[0] - a[0], 0.0]);
    dot(slope(&rings[0], &rings[1]), slope(&rings[1], &rings[2])) < 0.5
}

/// The `k`-th of `sides` directions round the axis u x v.
fn around(u: V3, v: V3, k: u32, sides: u32) -> V3 {
    let (sin, cos) = ops::sin_cos(std::f64::consts::TAU * f64::from(k % sides) / f64::from(sides));
    std::array::from_fn(|i| u[i] * cos as f32 + v[i] * sin as f32)
}

/// Two directions that make a right-handed frame with the axis.
fn frame_around(axis: V3) -> (V3, V3) {
    let helper = if axis[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
    let u = normalize(cross(helper, axis));
    (u, cross(axis, u))
}

pub(crate) fn sub(a: V3, b: V3) -> V3 {
    std::array::from_fn(|i| a[i] - b[i])
}

pub(crate) fn dot(a: V3, b: V3) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn length(a: V3) -> f32 {
    dot(a, a).sqrt()
}

/// The vector at unit length; nothing stays nothing.
pub(crate) fn normalize(a: V3) -> V3 {
    let size = length(a);
    if size > 0.0 { a.map(|component| component / size) } else { a }
}
