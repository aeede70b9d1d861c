//! Models: what an asset looks like and is met as, finer than its collider.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::geometry::Vector3;

/// Why a model is none.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// It has no triangle or no hull.
    #[error("it has no {what}: give at least one")]
    Empty {
        /// What lacks.
        what: &'static str,
    },
    /// A number is none, or far off.
    #[error("{what} {index} is {value:?}: give finite numbers within {LARGEST_MODEL} m of the origin")]
    Number {
        /// Of what.
        what: &'static str,
        /// Which.
        index: usize,
        /// What was given.
        value: [f32; 3],
    },
    /// A triangle names a vertex that is not there.
    #[error("triangle {index} has vertex {vertex}, and there are {count}: count from 0")]
    Vertex {
        /// Which triangle.
        index: usize,
        /// Which vertex.
        vertex: u32,
        /// How many there are.
        count: usize,
    },
    /// The parts do not share out the triangles.
    #[error("its parts have {parts} triangles together, and it has {triangles}: each belongs to one part")]
    Parts {
        /// How many the parts have.
        parts: u64,
        /// How many there are.
        triangles: usize,
    },
    /// A hull has no room inside.
    #[error("hull {index} has {points} points: a solid has at least four")]
    Hull {
        /// Which.
        index: usize,
        /// How many points it has.
        points: usize,
    },
    /// It does not fit its collider.
    #[error(
        "it is {model:?} m long, wide and high, and its collider {collider:?}: give a collider that is as large, and stand \
         the model on its origin"
    )]
    Size {
        /// The box around the model, m.
        model: [f64; 3],
        /// The box around the collider, m.
        collider: [f64; 3],
    },
}

/// How far a point of a model may be from its origin, m.
pub const LARGEST_MODEL: f32 = 1000.0;

/// How much larger or smaller a model may be than its asset's collider, m.
const MISFIT: f64 = 0.02;

/// A solid with a surface: triangles to look at, and convex hulls to meet.
///
/// Body frame in metres, x forward, y left, z up; the origin is the middle of its bottom. An entity whose shape is larger than
/// its asset's collider has the model stretched by the ratio of both boxes in each direction.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Model {
    /// The corners of the triangles.
    pub vertices: Vec<ModelVertex>,
    /// Three vertices each, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Runs of triangles of one look, in order; together they are all of them.
    pub parts: Vec<ModelPart>,
    /// Convex solids that together are what bodies meet.
    pub hulls: Vec<Hull>,
}

/// A corner of triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ModelVertex {
    /// Body frame, m.
    pub position: [f32; 3],
    /// Outward, of length 1.
    pub normal: [f32; 3],
    /// Colour, linear-light sRGB primaries in [0, 1].
    pub color: [f32; 3],
}

/// A run of triangles of one look.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelPart {
    /// What it is: `leg`, `lid`, `lamp`; a name for people.
    pub name: String,
    /// How many triangles it has.
    pub triangles: u32,
    /// Whose colour it has.
    pub paint: Paint,
}

/// Whose colour a part has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Paint {
    /// The colour of its vertices, whatever the entity is painted.
    #[default]
    Own,
    /// The colour of the entity, times that of its vertices.
    Entity,
}

/// A convex solid: the hull of its points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hull {
    /// Body frame, m.
    pub points: Vec<[f32; 3]>,
}

impl Model {
    /// The lowest and the highest corner of the box around its vertices, m; none without vertices.
    pub fn bounds(&self) -> Option<[[f32; 3]; 2]> {
        let first = self.vertices.first()?.position;
        Some(self.vertices.iter().fold([first, first], |[low, high], vertex| {
            let position = vertex.position;
            [
                std::array::from_fn(|axis| low[axis].min(position[axis])),
                std::array::from_fn(|axis| high[axis].max(position[axis])),
            ]
        }))
    }

    /// Its parts with the triangles of each.
    pub fn runs(&self) -> impl Iterator<Item = (&ModelPart, &[[u32; 3]])> {
        let mut left = &self.triangles[..];
        self.parts.iter().map(move |part| {
            let (own, rest) = left.split_at((part.triangles as usize).min(left.len()));
            left = rest;
            (part, own)
        })
    }

    /// Checks that it is a model, and one that stands in a collider of that size (length, width, height, m).
    ///
    /// # Errors
    /// Nothing to see or to meet, numbers that are none, triangles without vertices, another size than the collider's.
    pub fn validate(&self, collider: Vector3) -> Result<(), ModelError> {
        for (what, count) in [("triangle", self.triangles.len()), ("hull", self.hulls.len())] {
            if count == 0 {
                return Err(ModelError::Empty { what });
            }
        }
        for (index, vertex) in self.vertices.iter().enumerate() {
            checked("the position of vertex", index, vertex.position, LARGEST_MODEL)?;
            checked("the normal of vertex", index, vertex.normal, 1.01)?;
            checked("the colour of vertex", index, vertex.color, 1.0)?;
        }
        let count = self.vertices.len();
        for (index, triangle) in self.triangles.iter().enumerate() {
            if let Some(vertex) = triangle.iter().copied().find(|vertex| *vertex as usize >= count) {
                return Err(ModelError::Vertex { index, vertex, count });
            }
        }
        let parts = self.parts.iter().map(|part| u64::from(part.triangles)).sum();
        if parts != self.triangles.len() as u64 {
            return Err(ModelError::Parts { parts, triangles: self.triangles.len() });
        }
        for (index, hull) in self.hulls.iter().enumerate() {
            if hull.points.len() < 4 {
                return Err(ModelError::Hull { index, points: hull.points.len() });
            }
            for point in &hull.points {
                checked("a point of hull", index, *point, LARGEST_MODEL)?;
            }
        }
        self.fits(collider)
    }

    fn fits(&self, collider: Vector3) -> Result<(), ModelError> {
        let Some([low, high]) = self.bounds() else { return Err(ModelError::Empty { what: "vertex" }) };
        let [low, high] = [low, high].map(|corner| corner.map(f64::from));
        let half = collider * 0.5;
        let wanted = [[-half.x, -half.y, 0.0], [half.x, half.y, collider.z]];
        let is_near =
            |got: [f64; 3], want: [f64; 3]| (0..3).all(|axis| (got[axis] - want[axis]).abs() <= MISFIT);
        if is_near(low, wanted[0]) && is_near(high, wanted[1]) {
            return Ok(());
        }
        let model = std::array::from_fn(|axis| high[axis] - low[axis]);
        Err(ModelError::Size { model, collider: collider.into() })
    }
}

fn checked(what: &'static str, index: usize, value: [f32; 3], limit: f32) -> Result<(), ModelError> {
    let is_sound = value.iter().all(|number| number.is_finite() && number.abs() <= limit);
    if is_sound { Ok(()) } else { Err(ModelError::Number { what, index, value }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wedge() -> Model {
        let corners = [[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 1.0]];
        let vertex = |position| ModelVertex { position, normal: [0.0, 0.0, 1.0], color: [0.5; 3] };
        Model {
            vertices: corners.map(vertex).to_vec(),
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
            parts: vec![ModelPart { name: "wedge".to_owned(), triangles: 4, paint: Paint::Own }],
            hulls: vec![Hull { points: corners.to_vec() }],
        }
    }

    #[test]
    fn a_model_stands_in_its_collider() {
        assert_eq!(wedge().validate(Vector3::new(1.0, 1.0, 1.0)), Ok(()));
        let error = wedge().validate(Vector3::new(1.0, 1.0, 2.0)).unwrap_err();
        assert!(matches!(error, ModelError::Size { .. }), "{error}");
    }

    #[test]
    fn every_triangle_is_in_the_run_of_its_part() {
        let part = |name: &str, triangles| ModelPart { name: name.to_owned(), triangles, paint: Paint::Own };
        let model = Model { parts: vec![part("front", 1), part("none", 0), part("rest", 3)], ..wedge() };
        let runs: Vec<(&str, &[[u32; 3]])> =
            model.runs().map(|(part, triangles)| (part.name.as_str(), triangles)).collect();
        let all = &model.triangles;
        assert_eq!(runs, [("front", &all[..1]), ("none", &[][..]), ("rest", &all[1..])]);
    }

    #[test]
    fn what_is_no_model_says_so() {
        let is_none = |spoil: fn(&mut Model)| {
            let mut model = wedge();
            spoil(&mut model);
            model.validate(Vector3::new(1.0, 1.0, 1.0)).unwrap_err()
        };
        assert!(matches!(is_none(|model| model.triangles.clear()), ModelError::Empty { .. }));
        assert!(matches!(is_none(|model| model.hulls.clear()), ModelError::Empty { .. }));
        assert!(matches!(is_none(|model| model.triangles[0][1] = 4), ModelError::Vertex { .. }));
        assert!(matches!(is_none(|model| model.parts[0].triangles = 3), ModelError::Parts { .. }));
        assert!(matches!(is_none(|model| model.hulls[0].points.truncate(3)), ModelError::Hull { .. }));
        assert!(matches!(
            is_none(|model| model.vertices[2].position[1] = f32::NAN),
            ModelError::Number { .. }
        ));
        assert!(matches!(is_none(|model| model.vertices[0].color[0] = 2.0), ModelError::Number { .. }));
    }
}
