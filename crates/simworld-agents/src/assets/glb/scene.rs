//! The tree of a scene: every mesh where its nodes put it, as one surface.

use nalgebra::{Matrix3, Matrix4};
use simworld_core::asset::{ModelPart, Paint};
use simworld_core::geometry::{Point3, Vector3};

use super::accessor::{Column, Data, Normalized, Number, get, unsupported};
use super::document::{Node, Primitive, TRIANGLES};
use super::error::GlbError;
use super::limits::GlbLimits;
use super::paint::{Painter, Says, is_share, same_length};
use super::pose::{Bearing, Moment, Tree, joints, moved, tree};
use super::rig::{Frame, Rigging};
use crate::assets::surface::Surface;

/// The farthest that a point may be from the origin, in units of the file.
const FARTHEST: f64 = 1e9;

/// The longest name of a part that is kept, characters.
const LONGEST_NAME: usize = 64;

/// Everything that the scene of a file shows, at rest or at a moment of an animation; with how it moves, if that is asked for.
pub(super) fn surface(
    data: Data<'_>,
    limits: &GlbLimits,
    moment: Option<Moment>,
    clips: bool,
) -> Result<Surface, GlbError> {
    let document = data.document;
    let scene = get("scene", &document.scenes, document.scene.unwrap_or(0))?;
    let mut gatherer = Gatherer {
        data,
        limits,
        tree: &tree(data, limits, moment)?,
        painter: Painter::new(data, limits),
        surface: Surface::default(),
        rigging: (clips && !document.animations.is_empty()).then(Rigging::default),
    };
    let mut seen = vec![false; document.nodes.len()];
    let mut open: Vec<usize> = scene.nodes.iter().rev().copied().collect();
    while let Some(index) = open.pop() {
        let node = get("node", &document.nodes, index)?;
        if std::mem::replace(&mut seen[index], true) {
            let how = "hangs in two places, or below itself";
            return Err(GlbError::Tree { node: index, how, deepest: limits.depth });
        }
        if let Some(mesh) = node.mesh {
            gatherer.mesh(mesh, &Stand::of(data, gatherer.tree, index)?, node)?;
        }
        open.extend(node.children.iter().rev());
    }
    if gatherer.surface.triangles.is_empty() {
        return Err(GlbError::Empty);
    }
    let rig = gatherer.rigging.map(|rigging| rigging.finish(data, limits, gatherer.tree)).transpose()?;
    Ok(Surface { images: gatherer.painter.into_images(), rig: rig.flatten(), ..gatherer.surface })
}

struct Gatherer<'a> {
    data: Data<'a>,
    limits: &'a GlbLimits,
    tree: &'a Tree,
    painter: Painter<'a>,
    surface: Surface,
    rigging: Option<Rigging>,
}

/// Where a mesh stands: on a node, and on the joints of that node's skin.
struct Stand {
    node: usize,
    /// World from node.
    place: Matrix4<f64>,
    skin: Option<Skin>,
}

/// A skin as it is now.
struct Skin {
    index: usize,
    /// Of each joint its node, joint from mesh, and world from mesh.
    joints: Vec<(usize, Matrix4<f64>, Matrix4<f64>)>,
}

impl Stand {
    fn of(data: Data<'_>, tree: &Tree, node: usize) -> Result<Self, GlbError> {
        let found = get("node", &data.document.nodes, node)?;
        let skin = |index: usize| {
            let place = |(node, bind): (usize, Matrix4<f64>)| {
                let map = tree.places[node] * bind;
                let sound = map.iter().all(|number| number.is_finite());
                if sound { Ok((node, bind, map)) } else { Err(GlbError::Number { what: "skin", index }) }
            };
            let joints = joints(data, index)?.into_iter().map(place).collect::<Result<_, _>>()?;
            Ok(Skin { index, joints })
        };
        Ok(Self { node, place: tree.places[node], skin: found.skin.map(skin).transpose()? })
    }
}

impl Gatherer<'_> {
    fn mesh(&mut self, index: usize, stand: &Stand, node: &Node) -> Result<(), GlbError> {
        let mesh = get("mesh", &self.data.document.meshes, index)?;
        for primitive in &mesh.primitives {
            if primitive.mode != TRIANGLES {
                return Err(unsupported(
                    "mesh",
                    index,
                    "it has points, lines, strips or fans: export triangles",
                ));
            }
            if !primitive.targets.is_empty() {
                return Err(unsupported(
                    "mesh",
                    index,
                    "it has morph targets: export the file without shape keys",
                ));
            }
            let material =
                primitive.material.and_then(|index| self.data.document.materials.get(index)?.name.as_ref());
            let name = node.name.as_ref().or(mesh.name.as_ref()).or(material);
            self.primitive(index, primitive, name.map_or("", String::as_str), stand)?;
        }
        Ok(())
    }

    fn primitive(
        &mut self,
        mesh: usize,
        primitive: &Primitive,
        name: &str,
        stand: &Stand,
    ) -> Result<(), GlbError> {
        let column = |name: &str| primitive.attributes.get(name).copied();
        let Some(index) = column("POSITION") else {
            return Err(unsupported("mesh", mesh, "it has no positions: export the file again"));
        };
        let positions = self.data.column(index, &[("VEC3", 3)], |number, _| {
            number == Number::F32 || (number != Number::U32 && self.data.is_quantized())
        })?;
        afford("vertices", self.surface.points.len(), positions.count, self.limits.vertices)?;
        let triangles = self.triangles(mesh, primitive, positions.count)?;

        let maps = self.maps(primitive, &positions, stand)?;
        let map = |row: usize| maps.get(row).unwrap_or(&maps[0]);
        let first = self.surface.points.len() as u32;
        for row in 0..positions.count {
            let point = map(row).point(positions.reals(row));
            if !point.iter().all(|number| number.is_finite() && number.abs() <= FARTHEST) {
                return Err(GlbError::Number { what: "accessor", index });
            }
            self.surface.points.push(point);
        }
        self.normals(primitive, positions.count, map)?;
        let coat = self.painter.coat(primitive, positions.count, &triangles)?;
        self.surface.colors.extend(coat.colors);
        self.surface.places.extend(coat.places);
        self.surface.alphas.extend(coat.alphas);
        if coat.pictures.bumps.is_some() {
            self.tangents(primitive, positions.count, map)?;
        }
        self.surface.tangents.resize(self.surface.points.len(), [0.0; 4]);
        let paint = if coat.says == Says::Color { Paint::Own } else { Paint::Entity };
        let name = name.chars().filter(|c| !c.is_control()).take(LONGEST_NAME).collect();
        self.surface.parts.push(ModelPart {
            name,
            triangles: triangles.len() as u32,
            paint,
            finish: coat.finish,
            texture: coat.texture,
            transparency: coat.transparency,
            pictures: coat.pictures,
            two_sided: coat.two_sided,
        });
        self.surface.triangles.extend(triangles.iter().map(|[a, b, c]| {
            let [a, b, c] = [first + a, first + b, first + c];
            if map((a - first) as usize).mirrors { [a, c, b] } else { [a, b, c] }
        }));
        Ok(())
    }

    /// Adds the normals of so many vertices of a primitive; none where it has none.
    fn normals<'m>(
        &mut self,
        primitive: &Primitive,
        count: usize,
        map: impl Fn(usize) -> &'m Map,
    ) -> Result<(), GlbError> {
        if let Some(index) = primitive.attributes.get("NORMAL") {
            let column = self.data.column(*index, &[("VEC3", 3)], self.is_direction())?;
            same_length(*index, column.count, count)?;
            self.surface.normals.extend((0..count).map(|row| map(row).normal(column.reals(row))));
        }
        self.surface.normals.resize(self.surface.points.len(), Vector3::zeros());
        Ok(())
    }

    /// Adds the tangents of so many vertices of a primitive, if there are some that hold: as glTF has it, those without normals are none. Where a transform
    /// turns or mirrors the picture of bumps, its right is no longer that of the tangents.
    fn tangents<'m>(
        &mut self,
        primitive: &Primitive,
        count: usize,
        map: impl Fn(usize) -> &'m Map,
    ) -> Result<(), GlbError> {
        let bumps = primitive
            .material
            .and_then(|index| self.data.document.materials.get(index)?.normal_texture.as_ref())
            .and_then(|info| info.extensions.transform);
        let is_straight = bumps.is_none_or(|transform| {
            transform.rotation == 0.0 && transform.scale.iter().all(|scale| *scale > 0.0)
        });
        let holds = is_straight && primitive.attributes.contains_key("NORMAL");
        let Some(index) = primitive.attributes.get("TANGENT").filter(|_| holds) else { return Ok(()) };
        let column = self.data.column(*index, &[("VEC4", 4)], self.is_direction())?;
        same_length(*index, column.count, count)?;
        self.surface.tangents.extend((0..count).map(|row| map(row).tangent(column.reals(row))));
        Ok(())
    }

    /// How directions are written.
    fn is_direction(&self) -> impl Fn(Number, Normalized) -> bool {
        let is_quantized = self.data.is_quantized();
        move |number, normalized| number == Number::F32 || (is_quantized && is_share(number, normalized))
    }

    /// From the mesh to the body for each vertex of a primitive that joints bear; for all of them alike without joints. The rig learns
    /// who carries them.
    fn maps(
        &mut self,
        primitive: &Primitive,
        positions: &Column<'_>,
        stand: &Stand,
    ) -> Result<Vec<Map>, GlbError> {
        let Stand { node, place, skin } = stand;
        // Whom no joint bears stays with the node.
        let own = |rigging: &mut Rigging| rigging.bone(Frame::Node(*node), *node, &Matrix4::identity());
        let Some(Skin { index, joints }) = skin else {
            if let Some(rigging) = &mut self.rigging {
                let bone = own(rigging)?;
                (0..positions.count).for_each(|row| rigging.carry(positions.reals(row), [(bone, 1.0)]));
            }
            return Ok(vec![Map::new(place)]);
        };
        let bearing = Bearing::new(self.data, &primitive.attributes, positions.count, joints.len())?;
        let mut maps = Vec::with_capacity(positions.count);
        for row in 0..positions.count {
            let shares = bearing.of(row)?;
            if let Some(rigging) = &mut self.rigging {
                let bone = |(rank, share): &(usize, f64)| {
                    let (node, bind, _) = &joints[*rank];
                    Ok((rigging.bone(Frame::Skin { skin: *index, rank: *rank }, *node, bind)?, *share))
                };
                let mut bones = shares.iter().map(bone).collect::<Result<Vec<_>, GlbError>>()?;
                if bones.is_empty() {
                    bones.push((own(rigging)?, 1.0));
                }
                rigging.carry(positions.reals(row), bones);
            }
            let blended: Matrix4<f64> = shares.iter().map(|(rank, share)| joints[*rank].2 * *share).sum();
            maps.push(Map::new(if shares.is_empty() { place } else { &blended }));
        }
        Ok(maps)
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
        let point = moved(&self.matrix, point);
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

    /// Of length 1, with the side of the top of pictures beside it, which a mirror changes; zeros where the file has none that can be used.
    fn tangent(&self, [x, y, z, side]: [f64; 4]) -> [f32; 4] {
        let linear = self.matrix.fixed_view::<3, 3>(0, 0).into_owned();
        let way = linear * Vector3::new(x, y, z);
        let way = Vector3::new(way.z, way.x, way.y)
            .try_normalize(1e-30)
            .filter(|way| way.iter().all(|number| number.is_finite()));
        let side = if (side < 0.0) == self.mirrors { 1.0 } else { -1.0 };
        way.map_or([0.0; 4], |way| [way.x as f32, way.y as f32, way.z as f32, side])
    }
}
