//! From pieces to a model: fitted to a size, weighed, and told vertex from vertex.

use std::collections::BTreeMap;

use super::super::{Hull, Model, ModelPart, ModelVertex};
use super::loft::volume;
use super::{Piece, Sculpt, V};

/// A model with what it weighs.
#[derive(Clone, Debug)]
pub struct Cast {
    /// In a box of that size, on its origin.
    pub model: Model,
    /// Length, width and height, m.
    pub size: [f64; 3],
    /// kg.
    pub mass: f64,
    /// Whether every point is within the upright cylinder in the box.
    pub round: bool,
}

impl Sculpt {
    /// The pieces as one model that stands on its origin; it is stretched to the sizes that are given.
    pub fn cast(mut self, exact: [Option<f64>; 3]) -> Cast {
        let (low, high) = self.bounds();
        let span = high - low;
        let size: [f64; 3] = std::array::from_fn(|axis| exact[axis].unwrap_or(span[axis]));
        let stretch = V::from_fn(|axis, _| size[axis] / span[axis].max(1e-9));
        let foot = V::new((low.x + high.x) * 0.5, (low.y + high.y) * 0.5, low.z);
        for piece in &mut self.pieces {
            piece.fit(foot, stretch);
        }
        let mass = self.pieces.iter().map(|piece| volume(&piece.triangles) * piece.coating.density).sum();
        let radius = size[0].max(size[1]) * 0.5;
        let round =
            (size[0] - size[1]).abs() < 0.01 && self.points().all(|point| point.xy().norm() <= radius + 1e-3);
        Cast { model: model_of(&self.pieces), size, mass, round }
    }

    fn points(&self) -> impl Iterator<Item = V> + '_ {
        self.pieces.iter().flat_map(|piece| &piece.triangles).flatten().map(|(point, _)| *point)
    }

    fn bounds(&self) -> (V, V) {
        let start = (V::repeat(f64::INFINITY), V::repeat(f64::NEG_INFINITY));
        self.points().fold(start, |(low, high), point| (low.inf(&point), high.sup(&point)))
    }
}

impl Piece {
    fn fit(&mut self, foot: V, stretch: V) {
        let place = |point: &V| (point - foot).component_mul(&stretch);
        for (point, normal) in self.triangles.iter_mut().flatten() {
            *point = place(point);
            *normal = normal.component_div(&stretch).try_normalize(1e-12).unwrap_or(*normal);
        }
        for point in self.hulls.iter_mut().flatten() {
            *point = place(point);
        }
    }
}

/// The model of the pieces: those of one name and look in a row are one part.
fn model_of(pieces: &[Piece]) -> Model {
    let mut model = Model::default();
    let mut known: BTreeMap<[u32; 9], u32> = BTreeMap::new();
    for piece in pieces {
        let count = piece.triangles.len() as u32;
        let (name, paint, finish) = (piece.name, piece.coating.paint, piece.coating.light);
        match model.parts.last_mut() {
            Some(part) if part.name == name && part.paint == paint && part.finish == finish => {
                part.triangles += count;
            }
            _ => model.parts.push(ModelPart {
                name: name.to_owned(),
                triangles: count,
                paint,
                finish,
                ..ModelPart::default()
            }),
        }
        for triangle in &piece.triangles {
            let corner = |(point, normal): &(V, V)| {
                let vertex = ModelVertex {
                    position: narrow(point),
                    normal: narrow(normal),
                    color: piece.coating.color,
                    ..ModelVertex::default()
                };
                let mut key = [0; 9];
                let numbers = vertex.position.iter().chain(&vertex.normal).chain(&vertex.color);
                key.iter_mut().zip(numbers).for_each(|(bits, number)| *bits = number.to_bits());
                *known.entry(key).or_insert_with(|| {
                    model.vertices.push(vertex);
                    model.vertices.len() as u32 - 1
                })
            };
            model.triangles.push([&triangle[0], &triangle[1], &triangle[2]].map(corner));
        }
        let hull = |points: &Vec<V>| Hull { points: points.iter().map(narrow).collect() };
        model.hulls.extend(piece.hulls.iter().map(hull));
    }
    model
}

/// Adding zero makes one zero of both.
fn narrow(vector: &V) -> [f32; 3] {
    [vector.x as f32 + 0.0, vector.y as f32 + 0.0, vector.z as f32 + 0.0]
}
