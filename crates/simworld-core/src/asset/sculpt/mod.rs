//! A compact mesher: closed solids piece by piece, each with the triangles one sees and the convex hulls one meets.
//!
//! Body frame in metres, x forward, y left, z up. Every solid is a loft, a row of rings with the same number of points, so
//! that its hulls are those of its rings: what is seen and what is met are the same polytopes.
//!
//! ```
//! use simworld_core::asset::sculpt::{Coating, Sculpt};
//! use simworld_core::asset::Material;
//! use simworld_core::geometry::Vector3;
//! let mut bench = Sculpt::new(Coating::of(Material::Wood, [0.3, 0.17, 0.08]));
//! bench.block([0.0, 0.0, 0.4], [0.5, 1.8, 0.05]);
//! bench.part("leg", Coating::of(Material::Stone, [0.4, 0.4, 0.4]));
//! for y in [-0.7, 0.7] {
//!     bench.block([0.0, y, 0.0], [0.4, 0.2, 0.4]);
//! }
//! let cast = bench.cast([None, None, Some(0.5)]);
//! assert_eq!((cast.size[2], cast.model.hulls.len()), (0.5, 3));
//! let [length, width, height] = cast.size;
//! assert_eq!(cast.model.validate(Vector3::new(length, width, height)), Ok(()));
//! ```

mod finish;
mod loft;
mod shapes;

pub use finish::Cast;
pub use loft::Hulls;
use loft::Loft;

use super::{Finish, Material, Paint};
use crate::geometry::{Pose, Vector3};

/// A point or a direction in the body frame, m.
pub type V = Vector3;

/// What a piece is painted with, how it takes light, and how heavy it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coating {
    /// Linear-light sRGB; where the entity's colour counts, a factor of it.
    pub color: [f32; 3],
    /// Whose colour counts.
    pub paint: Paint,
    /// How it takes light.
    pub light: Finish,
    /// Mass over the volume that one sees, kg/m³: what is hollow inside is lighter than its material.
    pub density: f64,
}

impl Coating {
    /// What takes light as wood, paint and stone do.
    pub fn dull(color: [f32; 3], paint: Paint, density: f64) -> Self {
        Self { color, paint, light: Finish::default(), density }
    }

    /// A full piece of a material in a colour that it keeps.
    pub fn of(material: Material, color: [f32; 3]) -> Self {
        let light = Finish::of(material, color);
        Self { color, paint: Paint::Own, light, density: material.density() }
    }
}

/// One solid.
#[derive(Clone, Debug)]
struct Piece {
    name: &'static str,
    coating: Coating,
    /// Three corners each, with their normals, counter-clockwise from outside.
    triangles: Vec<[(V, V); 3]>,
    hulls: Vec<Vec<V>>,
}

/// Pieces that are put together.
#[derive(Debug)]
pub struct Sculpt {
    pieces: Vec<Piece>,
    name: &'static str,
    coating: Coating,
    /// Where the next pieces stand.
    frame: Pose,
}

impl Sculpt {
    /// Nothing yet.
    pub fn new(coating: Coating) -> Self {
        Self { pieces: Vec::new(), name: "body", coating, frame: Pose::identity() }
    }

    /// What the next pieces are, and how they are coated.
    pub fn part(&mut self, name: &'static str, coating: Coating) -> &mut Self {
        (self.name, self.coating) = (name, coating);
        self
    }

    /// Puts pieces together in a frame of their own: moved there, turned by roll, pitch and yaw (rad).
    pub fn placed(&mut self, at: [f64; 3], turn: [f64; 3], make: impl FnOnce(&mut Self)) {
        let outer = self.frame;
        self.frame = outer * Pose::from_parts(V::from(at).into(), turned(turn));
        make(self);
        self.frame = outer;
    }

    /// Adds a solid; false where the rings are none that have a skin, and nothing is added.
    fn add(&mut self, loft: &Loft, hulls: Hulls) -> bool {
        let sides = loft.rings.first().map_or(0, Vec::len);
        if loft.rings.len() < 2 || sides < 3 || loft.rings.iter().any(|ring| ring.len() != sides) {
            return false;
        }
        let frame = self.frame;
        let place = |point: &V| frame * nalgebra::Point3::from(*point);
        let triangles = loft
            .triangles()
            .into_iter()
            .map(|triangle| triangle.map(|(point, normal)| (place(&point).coords, frame.rotation * normal)));
        let hulls = loft.hulls(hulls).into_iter().map(|hull| hull.iter().map(|p| place(p).coords).collect());
        let (triangles, hulls) = (triangles.collect(), hulls.collect());
        self.pieces.push(Piece { name: self.name, coating: self.coating, triangles, hulls });
        true
    }
}

/// Roll about x, then pitch about y, then yaw about z. nalgebra's own would call the platform's sine.
fn turned([roll, pitch, yaw]: [f64; 3]) -> nalgebra::UnitQuaternion<f64> {
    let about = |axis: V, angle: f64| {
        let (sin, cos) = crate::ops::sin_cos(angle * 0.5);
        nalgebra::UnitQuaternion::new_unchecked(nalgebra::Quaternion::from_parts(cos, axis * sin))
    };
    about(V::z(), yaw) * about(V::y(), pitch) * about(V::x(), roll)
}
