//! A compact mesher: closed solids piece by piece, each with the triangles one sees and the convex hulls one meets.
//!
//! Body frame in metres, x forward, y left, z up. Every solid is a loft, a row of rings with the same number of points, so
//! that its hulls are those of its rings: what is seen and what is met are the same polytopes.

mod finish;
mod loft;
mod shapes;

pub(super) use finish::Cast;
pub(super) use loft::Hulls;
use loft::Loft;
use simworld_core::asset::Paint;
use simworld_core::geometry::{Pose, Vector3};

/// A point or a direction in the body frame, m.
pub(super) type V = Vector3;

/// What a piece is painted with, and how heavy it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Finish {
    /// Linear-light sRGB; where the entity's colour counts, a factor of it.
    pub(super) color: [f32; 3],
    pub(super) paint: Paint,
    /// Mass over the volume that one sees, kg/m³: what is hollow inside is lighter than its material.
    pub(super) density: f64,
}

/// One solid.
#[derive(Clone, Debug)]
struct Piece {
    name: &'static str,
    finish: Finish,
    /// Three corners each, with their normals, counter-clockwise from outside.
    triangles: Vec<[(V, V); 3]>,
    hulls: Vec<Vec<V>>,
}

/// Pieces that are put together.
#[derive(Debug)]
pub(super) struct Sculpt {
    pieces: Vec<Piece>,
    name: &'static str,
    finish: Finish,
    /// Where the next pieces stand.
    frame: Pose,
}

impl Sculpt {
    /// Nothing yet.
    pub(super) fn new(finish: Finish) -> Self {
        Self { pieces: Vec::new(), name: "body", finish, frame: Pose::identity() }
    }

    /// What the next pieces are, and how they are finished.
    pub(super) fn part(&mut self, name: &'static str, finish: Finish) -> &mut Self {
        (self.name, self.finish) = (name, finish);
        self
    }

    /// Puts pieces together in a frame of their own: moved there, turned by roll, pitch and yaw (rad).
    pub(super) fn placed(&mut self, at: [f64; 3], turn: [f64; 3], make: impl FnOnce(&mut Self)) {
        let outer = self.frame;
        self.frame = outer * Pose::from_parts(V::from(at).into(), turned(turn));
        make(self);
        self.frame = outer;
    }

    fn add(&mut self, loft: &Loft, hulls: Hulls) {
        let frame = self.frame;
        let place = |point: &V| frame * nalgebra::Point3::from(*point);
        let triangles = loft
            .triangles()
            .into_iter()
            .map(|triangle| triangle.map(|(point, normal)| (place(&point).coords, frame.rotation * normal)));
        let hulls = loft.hulls(hulls).into_iter().map(|hull| hull.iter().map(|p| place(p).coords).collect());
        let (triangles, hulls) = (triangles.collect(), hulls.collect());
        self.pieces.push(Piece { name: self.name, finish: self.finish, triangles, hulls });
    }
}

/// Roll about x, then pitch about y, then yaw about z. nalgebra's own would call the platform's sine.
fn turned([roll, pitch, yaw]: [f64; 3]) -> nalgebra::UnitQuaternion<f64> {
    let about = |axis: V, angle: f64| {
        let (sin, cos) = simworld_core::ops::sin_cos(angle * 0.5);
        nalgebra::UnitQuaternion::new_unchecked(nalgebra::Quaternion::from_parts(cos, axis * sin))
    };
    about(V::z(), yaw) * about(V::y(), pitch) * about(V::x(), roll)
}
