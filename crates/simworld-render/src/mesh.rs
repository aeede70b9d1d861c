//! The meshes: small silhouettes of unit size, scaled to each entity's box.
//!
//! A mesh fills x and y in [-0.5, 0.5] and z in [0, 1]. Each vertex names a part, whose colour the shader chooses.

use bytemuck::{Pod, Zeroable};
use simworld_core::ops;
use simworld_core::scene::EntityKind;

/// A vertex of a mesh.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Vertex {
    pub(crate) position: [f32; 3],
    pub(crate) normal: [f32; 3],
    /// What it belongs to: see [`Part`].
    pub(crate) part: u32,
}

/// Which colour a piece of a mesh takes.
#[derive(Clone, Copy)]
#[repr(u32)]
enum Part {
    /// The entity's own.
    Body = 0,
    /// Dark glass.
    Glass = 1,
    /// Rubber and shoes.
    Dark = 2,
    /// Leaves.
    Leaves = 3,
    /// Skin.
    Skin = 4,
    /// A lit lamp.
    Lamp = 5,
    /// Bark.
    Bark = 6,
    /// Cloth of trousers.
    Cloth = 7,
}

/// The kinds of meshes, in the order in which they are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum MeshKind {
    Box,
    Cylinder,
    Sphere,
    Car,
    Van,
    Person,
    Tree,
    Lamp,
    Bench,
}

impl MeshKind {
    pub(crate) const ALL: [Self; 9] = [
        Self::Box,
        Self::Cylinder,
        Self::Sphere,
        Self::Car,
        Self::Van,
        Self::Person,
        Self::Tree,
        Self::Lamp,
        Self::Bench,
    ];

    /// The silhouette of a kind of entity; `None` for those that are drawn as their solid.
    pub(crate) const fn of(kind: EntityKind) -> Option<Self> {
        Some(match kind {
            EntityKind::Car => Self::Car,
            EntityKind::Truck | EntityKind::Bus => Self::Van,
            EntityKind::Person => Self::Person,
            EntityKind::Tree => Self::Tree,
            EntityKind::StreetLamp => Self::Lamp,
            EntityKind::Bench | EntityKind::Chair => Self::Bench,
            _ => return None,
        })
    }

    /// Its triangles.
    pub(crate) fn vertices(self) -> Vec<Vertex> {
        let mut mesh = Mesh(Vec::new());
        match self {
            Self::Box => mesh.cuboid([-0.5, -0.5, 0.0], [0.5, 0.5, 1.0], Part::Body),
            Self::Cylinder => mesh.cone(0.5, 0.5, 0.0, 1.0, Part::Body),
            Self::Sphere => mesh.ball([0.0, 0.0, 0.5], [0.5, 0.5, 0.5], Part::Body),
            Self::Car => mesh.car(),
            Self::Van => mesh.van(),
            Self::Person => mesh.person(),
            Self::Tree => mesh.tree(),
            Self::Lamp => mesh.lamp(),
            Self::Bench => {
                mesh.cuboid([-0.5, -0.5, 0.45], [0.5, 0.5, 0.55], Part::Bark);
                mesh.cuboid([-0.5, -0.5, 0.55], [-0.35, 0.5, 1.0], Part::Bark);
                mesh.cuboid([-0.4, -0.42, 0.0], [0.4, -0.34, 0.45], Part::Dark);
                mesh.cuboid([-0.4, 0.34, 0.0], [0.4, 0.42, 0.45], Part::Dark);
            }
        }
        mesh.0
    }
}

struct Mesh(Vec<Vertex>);

impl Mesh {
    fn triangle(&mut self, corners: [[f32; 3]; 3], normals: [[f32; 3]; 3], part: Part) {
        for (position, normal) in corners.into_iter().zip(normals) {
            self.0.push(Vertex { position, normal, part: part as u32 });
        }
    }

    fn quad(&mut self, [a, b, c, d]: [[f32; 3]; 4], normal: [f32; 3], part: Part) {
        self.triangle([a, b, c], [normal; 3], part);
        self.triangle([a, c, d], [normal; 3], part);
    }

    fn cuboid(&mut self, low: [f32; 3], high: [f32; 3], part: Part) {
        self.frustum(low, high, 1.0, part);
    }

    /// A box whose top is smaller in x by a factor: cabins and roofs.
    fn frustum(&mut self, low: [f32; 3], high: [f32; 3], top: f32, part: Part) {
        let middle = (low[0] + high[0]) * 0.5;
        let corner = |x: usize, y: usize, z: usize| {
            let pick = |i: usize, axis: usize| if i == 0 { low[axis] } else { high[axis] };
            let across = pick(x, 0);
            let across = if z == 1 { middle + (across - middle) * top } else { across };
            [across, pick(y, 1), pick(z, 2)]
        };
        let c = corner;
        self.quad([c(1, 0, 0), c(1, 1, 0), c(1, 1, 1), c(1, 0, 1)], [1.0, 0.0, 0.0], part);
        self.quad([c(0, 1, 0), c(0, 0, 0), c(0, 0, 1), c(0, 1, 1)], [-1.0, 0.0, 0.0], part);
        self.quad([c(1, 1, 0), c(0, 1, 0), c(0, 1, 1), c(1, 1, 1)], [0.0, 1.0, 0.0], part);
        self.quad([c(0, 0, 0), c(1, 0, 0), c(1, 0, 1), c(0, 0, 1)], [0.0, -1.0, 0.0], part);
        self.quad([c(0, 0, 1), c(1, 0, 1), c(1, 1, 1), c(0, 1, 1)], [0.0, 0.0, 1.0], part);
        self.quad([c(0, 1, 0), c(1, 1, 0), c(1, 0, 0), c(0, 0, 0)], [0.0, 0.0, -1.0], part);
    }

    /// An upright cylinder or cone about the z axis.
    fn cone(&mut self, bottom: f32, top: f32, low: f32, high: f32, part: Part) {
        const SIDES: u32 = 20;
        let ring = |index: u32| {
            let (sin, cos) = ops::sin_cos(std::f64::consts::TAU * f64::from(index) / f64::from(SIDES));
            [cos as f32, sin as f32]
        };
        for index in 0..SIDES {
            let (p, q) = (ring(index), ring(index + 1));
            let at = |r: f32, d: [f32; 2], z: f32| [r * d[0], r * d[1], z];
            let (a, b, c, d) = (at(bottom, p, low), at(bottom, q, low), at(top, q, high), at(top, p, high));
            let (n, m) = ([p[0], p[1], 0.0], [q[0], q[1], 0.0]);
            self.triangle([a, b, c], [n, m, m], part);
            self.triangle([a, c, d], [n, m, n], part);
            self.triangle([[0.0, 0.0, high], d, c], [[0.0, 0.0, 1.0]; 3], part);
            self.triangle([[0.0, 0.0, low], b, a], [[0.0, 0.0, -1.0]; 3], part);
        }
    }

    fn ball(&mut self, center: [f32; 3], radii: [f32; 3], part: Part) {
        const RINGS: u32 = 8;
        const SIDES: u32 = 14;
        let normal = |ring: u32, side: u32| {
            let (sin_lat, cos_lat) = ops::sin_cos(std::f64::consts::PI * f64::from(ring) / f64::from(RINGS));
            let (sin_lon, cos_lon) = ops::sin_cos(std::f64::consts::TAU * f64::from(side) / f64::from(SIDES));
            [(sin_lat * cos_lon) as f32, (sin_lat * sin_lon) as f32, cos_lat as f32]
        };
        let point = |n: [f32; 3]| [0, 1, 2].map(|axis: usize| center[axis] + radii[axis] * n[axis]);
        for ring in 0..RINGS {
            for side in 0..SIDES {
                let n = [
                    normal(ring, side),
                    normal(ring + 1, side),
                    normal(ring + 1, side + 1),
                    normal(ring, side + 1),
                ];
                let p = n.map(point);
                self.triangle([p[0], p[1], p[2]], [n[0], n[1], n[2]], part);
                self.triangle([p[0], p[2], p[3]], [n[0], n[2], n[3]], part);
            }
        }
    }

    fn wheels(&mut self, stations: &[f32]) {
        for x in stations {
            for y in [-0.5_f32, 0.4] {
                self.cuboid([x - 0.07, y, 0.0], [x + 0.07, y + 0.1, 0.4], Part::Dark);
            }
        }
    }

    fn car(&mut self) {
        self.cuboid([-0.5, -0.48, 0.18], [0.5, 0.48, 0.58], Part::Body);
        self.frustum([-0.36, -0.42, 0.58], [0.22, 0.42, 0.94], 0.72, Part::Glass);
        self.cuboid([-0.27, -0.41, 0.93], [0.13, 0.41, 1.0], Part::Body);
        self.wheels(&[-0.31, 0.31]);
        self.cuboid([0.49, -0.42, 0.4], [0.505, -0.26, 0.52], Part::Lamp);
        self.cuboid([0.49, 0.26, 0.4], [0.505, 0.42, 0.52], Part::Lamp);
    }

    fn van(&mut self) {
        self.cuboid([-0.5, -0.5, 0.12], [0.5, 0.5, 1.0], Part::Body);
        self.cuboid([0.495, -0.44, 0.52], [0.505, 0.44, 0.88], Part::Glass);
        self.cuboid([-0.42, -0.505, 0.55], [0.44, -0.495, 0.85], Part::Glass);
        self.cuboid([-0.42, 0.495, 0.55], [0.44, 0.505, 0.85], Part::Glass);
        self.wheels(&[-0.33, 0.33]);
    }

    fn person(&mut self) {
        self.cuboid([-0.14, -0.26, 0.0], [0.16, -0.04, 0.06], Part::Dark);
        self.cuboid([-0.14, 0.04, 0.0], [0.16, 0.26, 0.06], Part::Dark);
        self.cuboid([-0.12, -0.25, 0.05], [0.12, -0.03, 0.48], Part::Cloth);
        self.cuboid([-0.12, 0.03, 0.05], [0.12, 0.25, 0.48], Part::Cloth);
        self.cuboid([-0.18, -0.34, 0.46], [0.18, 0.34, 0.82], Part::Body);
        self.cuboid([-0.12, -0.5, 0.46], [0.12, -0.36, 0.8], Part::Body);
        self.cuboid([-0.12, 0.36, 0.46], [0.12, 0.5, 0.8], Part::Body);
        self.ball([0.0, 0.0, 0.92], [0.22, 0.2, 0.08], Part::Skin);
    }

    /// The solid of a tree is its trunk; the crown reaches far beyond it.
    fn tree(&mut self) {
        self.cone(0.5, 0.35, 0.0, 0.5, Part::Bark);
        self.ball([0.0, 0.0, 0.68], [4.6, 4.6, 0.22], Part::Leaves);
        self.ball([1.6, 1.2, 0.8], [3.4, 3.4, 0.18], Part::Leaves);
        self.ball([-1.8, -0.8, 0.82], [3.2, 3.2, 0.17], Part::Leaves);
    }

    fn lamp(&mut self) {
        self.cone(0.5, 0.35, 0.0, 0.97, Part::Dark);
        self.cuboid([-0.5, -0.6, 0.965], [7.0, 0.6, 0.98], Part::Dark);
        self.cuboid([4.5, -1.0, 0.952], [7.5, 1.0, 0.966], Part::Lamp);
    }
}
