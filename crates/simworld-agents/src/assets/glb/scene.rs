//! The tree of a scene: every mesh where its nodes put it, as one surface.

use nalgebra::{Matrix3, Matrix4, Quaternion, Translation3, UnitQuaternion};
use simworld_core::asset::{ModelPart, Paint};
use simworld_core::geometry::{Point3, Vector3};

use super::accessor::{Data, Number, get, unsupported};
use super::document::{Node, Primitive, TRIANGLES};
use super::error::GlbError;
use super::limits::GlbLimits;
use super::paint::{Painter, Says, same_length};
use crate::assets::surface::Surface;

/// The farthest that a point may be from the origin, in units of the file.
const FARTHEST: f64 = 1e9;

/// The longest name of a part that is kept, characters.
const LONGEST_NAME: usize = 64;

/// Everything that the scene of a file shows.
pub(super) fn surface(data: Data<'_>, limits: &GlbLimits) -> Result<Surface, GlbError> {
    let document = data.document;
    let scene = get("scene", &document.scenes, document.scene.unwrap_or(0))?;
    let mut gatherer =
        Gatherer { data, limits, painter: Painter::new(data, limits.pixels), surface: Surface::default() };
    let mut seen = vec![false; document.nodes.len()];
    let mut open: Vec<(usize, Matrix4<f64>, usize)> =
        scene.nodes.iter().rev().map(|node| (*node, Matrix4::identity(), 1)).collect();
    while let Some((index, above, depth)) = open.pop() {
        let node = get("node", &document.nodes, index)?;
        let wrong = |how| GlbError::Tree { node: index, how, deepest: limits.depth };
        if std::mem::replace(&mut seen[index], true) {
            return Err(wrong("hangs in two places, or below itself"));
        }
        if depth > limits.depth {
            return Err(wrong("lies too deep"));
        }
        let here = above * local(node, index)?;
        if let Some(mesh) = node.mesh {
            if node.skin.is_some() {
                return Err(unsupported("node", index, "its mesh has a skin: export the file without bones"));
            }
            gatherer.mesh(mesh, node, &here)?;
        }
        open.extend(node.children.iter().rev().map(|child| (*child, here, depth + 1)));
    }
    if gatherer.surface.triangles.is_empty() { Err(GlbError::Empty) } else { Ok(gatherer.surface) }
}

fn local(node: &Node, index: usize) -> Result<Matrix4<f64>, GlbError> {
    let matrix = if let Some(columns) = node.matrix {
        Matrix4::from_column_slice(&columns)
    } else {
        let [x, y, z, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9)
            .ok_or(GlbError::Number { what: "node", index })?;
        let shift = Translation3::from(node.translation.unwrap_or_default());
        let scale = Vector3::from(node.scale.unwrap_or([1.0; 3]));
        shift.to_homogeneous() * turn.to_homogeneous() * Matrix4::new_nonuniform_scaling(&scale)
    };
    if matrix.iter().all(|number| number.is_finite()) {
        Ok(matrix)
    } else {
        Err(GlbError::Number { what: "node", index })
    }
}

struct Gatherer<'a> {
    data: Data<'a>,
    limits: &'a GlbLimits,
    painter: Painter<'a>,
    surface: Surface,
}

impl Gatherer<'_> {
    fn mesh(&mut self, index: usize, node: &Node, here: &Matrix4<f64>) -> Result<(), GlbError> {
        let mesh = get("mesh", &self.data.document.meshes, index)?;
        for primitive in &mesh.primitives {
            if primitive.mode != TRIANGLES {
                return Err(unsupported(
                    "mesh",
                    index,
                    "it has points, lines, strips or fans: export triangles",
                ));
            }
            let material =
                primitive.material.and_then(|index| self.data.document.materials.get(index)?.name.as_ref());
            let name = node.name.as_ref().or(mesh.name.as_ref()).or(material);
            self.primitive(index, primitive, name.map_or("", String::as_str), here)?;
        }
        Ok(())
    }

    fn primitive(
        &mut self,
        mesh: usize,
        primitive: &Primitive,
        name: &str,
        here: &Matrix4<f64>,
    ) -> Result<(), GlbError> {
        let column = |name: &str| primitive.attributes.get(name).copied();
        let Some(index) = column("POSITION") else {
            return Err(unsupported("mesh", mesh, "it has no positions: export the file again"));
        };
        let positions = self.data.column(index, &[("VEC3", 3)], |number, _| number == Number::F32)?;
        afford("vertices", self.surface.points.len(), positions.count, self.limits.vertices)?;
        let triangles = self.triangles(mesh, primitive, positions.count)?;

        let map = Map::new(here);
        let first = self.surface.points.len() as u32;
        for row in 0..positions.count {
            let point = map.point(positions.reals(row));
            if !point.iter().all(|number| number.is_finite() && number.abs() <= FARTHEST) {
                return Err(GlbError::Number { what: "accessor", index });
            }
            self.surface.points.push(point);
        }
        match column("NORMAL") {
            Some(index) => {
                let normals = self.data.column(index, &[("VEC3", 3)], |number, _| number == Number::F32)?;
                same_length(index, normals.count, positions.count)?;
                self.surface.normals.extend((0..normals.count).map(|row| map.normal(normals.reals(row))));
            }
            None => self.surface.normals.resize(self.surface.points.len(), Vector3::zeros()),
        }
        let coat = self.painter.coat(primitive, positions.count, &triangles)?;
        self.surface.colors.extend(coat.colors);
        let paint = if coat.says == Says::Color { Paint::Own } else { Paint::Entity };
        let name = name.chars().filter(|c| !c.is_control()).take(LONGEST_NAME).collect();
        self.surface.parts.push(ModelPart { name, triangles: triangles.len() as u32, paint });
        self.surface.triangles.extend(triangles.iter().map(|[a, b, c]| {
            let [a, b, c] = [first + a, first + b, first + c];
            if map.mirrors { [a, c, b] } else { [a, b, c] }
        }));
        Ok(())
    }

    fn triangles(
        &self,
        mesh: usize,
        primitive: &Primitive,
        vertices: usize,
    ) -> Result<Vec<[u32; 3]>, GlbError> {
        let is_index = |number, _| matches!(number, Number::U8 | Number::U16 | Number::U32);
        let column =
            primitive.indices.map(|index| self.data.column(index, &[("SCALAR", 1)], is_index)).transpose()?;
        let corners = column.as_ref().map_or(vertices, |column| column.count);
        afford("triangles", self.surface.triangles.len(), corners / 3, self.limits.triangles)?;
        if corners < 3 || !corners.is_multiple_of(3) {
            return Err(unsupported("mesh", mesh, "its corners are not three for each triangle"));
        }
        let corner = |row: usize| column.as_ref().map_or(row as u32, |column| column.index(row));
        (0..corners / 3)
            .map(|triangle| {
                let corners = [0, 1, 2].map(|which| corner(triangle * 3 + which));
                match corners.iter().find(|corner| **corner as usize >= vertices) {
                    Some(corner) => Err(GlbError::Missing {
                        what: "vertex",
                        index: u64::from(*corner),
                        count: vertices as u64,
                    }),
                    None => Ok(corners),
                }
            })
            .collect()
    }
}

fn afford(what: &'static str, now: usize, more: usize, most: u64) -> Result<(), GlbError> {
    let got = now as u64 + more as u64;
    if got > most { Err(GlbError::TooMany { what, got, most }) } else { Ok(()) }
}

/// From a mesh's own frame to the body frame: glTF has x to the left, y up, z to the front.
struct Map {
    matrix: Matrix4<f64>,
    normals: Matrix3<f64>,
    mirrors: bool,
}

impl Map {
    fn new(here: &Matrix4<f64>) -> Self {
        let linear = here.fixed_view::<3, 3>(0, 0).into_owned();
        let mirrors = linear.determinant() < 0.0;
        // The matrix of cofactors keeps normals upright on what it scales, and needs no inverse.
        let column = |a: usize, b: usize| linear.column(a).cross(&linear.column(b));
        let cofactors = Matrix3::from_columns(&[column(1, 2), column(2, 0), column(0, 1)]);
        Self { matrix: *here, normals: if mirrors { -cofactors } else { cofactors }, mirrors }
    }

    fn point(&self, point: [f64; 3]) -> Point3 {
        let [x, y, z] = point;
        let point = self.matrix * nalgebra::Vector4::new(x, y, z, 1.0);
        Point3::new(point.z, point.x, point.y)
    }

    /// Of length 1; zero where the file has none that can be used.
    fn normal(&self, normal: [f64; 3]) -> Vector3 {
        let normal = self.normals * Vector3::from(normal);
        Vector3::new(normal.z, normal.x, normal.y)
            .try_normalize(1e-30)
            .filter(|normal| normal.iter().all(|number| number.is_finite()))
            .unwrap_or_else(Vector3::zeros)
    }
}
