//! Nodes as an animation has them at a moment, and the joints of skins (glTF 2.0, 3.7.3 and 3.11).

use nalgebra::{Matrix4, Vector4};
use serde::{Deserialize, Serialize};
use simworld_core::asset::{Curve, Interpolation, Local, Path};

use super::accessor::{Column, Data, Number, get, unsupported};
use super::document::{Channel, Node};
use super::error::GlbError;
use super::limits::GlbLimits;
use super::paint::is_share;

/// A moment of an animation, in which a file is read.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Moment {
    /// Which of the file's animations, from 0.
    pub animation: usize,
    /// When, s from its beginning; before its first key and after its last it stands still.
    pub seconds: f64,
}

/// The nodes of a file at a moment.
pub(super) struct Tree {
    /// Parent from node.
    pub(super) locals: Vec<Local>,
    pub(super) parents: Vec<Option<usize>>,
    /// World from node.
    pub(super) places: Vec<Matrix4<f64>>,
}

/// Every node of the file, at rest or at a moment of an animation.
pub(super) fn tree(data: Data<'_>, limits: &GlbLimits, moment: Option<Moment>) -> Result<Tree, GlbError> {
    let nodes = &data.document.nodes;
    let mut locals: Vec<Local> = nodes.iter().map(local).collect();
    if let Some(moment) = moment {
        animate(data, limits, moment, &mut locals)?;
    }
    let wrong = |node, how| GlbError::Tree { node, how, deepest: limits.depth };
    let mut parents: Vec<Option<usize>> = vec![None; nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        for child in &node.children {
            get("node", nodes, *child)?;
            if parents[*child].replace(index).is_some() {
                return Err(wrong(*child, "hangs in two places, or below itself"));
            }
        }
    }
    let mut places = vec![None; nodes.len()];
    let roots = (0..nodes.len()).filter(|index| parents[*index].is_none());
    let mut open: Vec<(usize, Matrix4<f64>, usize)> =
        roots.map(|root| (root, Matrix4::identity(), 1)).collect();
    while let Some((index, above, depth)) = open.pop() {
        if depth > limits.depth {
            return Err(wrong(index, "lies too deep"));
        }
        let here = above * matrix(&locals[index], index)?;
        places[index] = Some(here);
        open.extend(nodes[index].children.iter().map(|child| (*child, here, depth + 1)));
    }
    // Who is in a ring hangs from no root.
    let place = |(index, place): (usize, Option<Matrix4<f64>>)| {
        place.ok_or_else(|| wrong(index, "hangs in two places, or below itself"))
    };
    let places = places.into_iter().enumerate().map(place).collect::<Result<_, _>>()?;
    Ok(Tree { locals, parents, places })
}

fn local(node: &Node) -> Local {
    node.matrix.map_or_else(
        || Local::Parts {
            translation: node.translation.unwrap_or_default(),
            rotation: node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]),
            scale: node.scale.unwrap_or([1.0; 3]),
        },
        Local::Matrix,
    )
}

fn matrix(local: &Local, index: usize) -> Result<Matrix4<f64>, GlbError> {
    let turns = match local {
        Local::Matrix(_) => true,
        Local::Parts { rotation, .. } => Vector4::from(*rotation).norm() > 1e-9,
    };
    let matrix = local.matrix();
    if turns && matrix.iter().all(|number| number.is_finite()) {
        Ok(matrix)
    } else {
        Err(GlbError::Number { what: "node", index })
    }
}

/// Puts the channels of an animation into the nodes that they move.
fn animate(data: Data<'_>, limits: &GlbLimits, moment: Moment, locals: &mut [Local]) -> Result<(), GlbError> {
    if !moment.seconds.is_finite() {
        return Err(GlbError::Number { what: "animation", index: moment.animation });
    }
    for Moved { node, path, curve } in channels(data, limits, moment.animation, &mut 0)? {
        locals[node].put(path, &curve, moment.seconds);
    }
    Ok(())
}

/// What a channel of an animation moves.
pub(super) struct Moved {
    pub(super) node: usize,
    pub(super) path: Path,
    pub(super) curve: Curve,
}

/// The channels of an animation; `used` are the numbers of curves that were read before, and these are added.
pub(super) fn channels(
    data: Data<'_>,
    limits: &GlbLimits,
    index: usize,
    used: &mut u64,
) -> Result<Vec<Moved>, GlbError> {
    let animation = get("animation", &data.document.animations, index)?;
    let refused = |reason: &str| unsupported("animation", index, reason);
    let mut moved = Vec::new();
    for Channel { sampler, target } in &animation.channels {
        // Channels without a node are for extensions.
        let Some(node) = target.node else { continue };
        if get("node", &data.document.nodes, node)?.matrix.is_some() {
            return Err(refused("it moves a node that has a matrix: export translation, rotation and scale"));
        }
        let path = match target.path.as_str() {
            "translation" => Path::Translation,
            "scale" => Path::Scale,
            "rotation" => Path::Rotation,
            "weights" => return Err(refused("it moves the weights of morph targets, which are not read")),
            _ => return Err(refused("it moves something that glTF 2.0 does not know")),
        };
        let sampler = get("animation sampler", &animation.samplers, *sampler)?;
        let interpolation = match sampler.interpolation.as_str() {
            "STEP" => Interpolation::Step,
            "LINEAR" => Interpolation::Linear,
            "CUBICSPLINE" => Interpolation::Cubic,
            _ => return Err(refused("its keys are joined in a way that glTF 2.0 does not know")),
        };
        let times = data.column(sampler.input, &[("SCALAR", 1)], |number, _| number == Number::F32)?;
        let shape = if path == Path::Rotation { ("VEC4", 4) } else { ("VEC3", 3) };
        let values = data.column(sampler.output, &[shape], is_share)?;
        let numbers = times.count as u64 + values.count as u64 * path.width() as u64;
        *used += numbers;
        if *used > limits.keys {
            return Err(GlbError::TooMany { what: "numbers in animations", got: *used, most: limits.keys });
        }
        let curve =
            Curve { interpolation, times: numbers_of(&times, 1), values: numbers_of(&values, path.width()) };
        if let Some(fault) = curve.fault(path.width()) {
            return Err(refused(&format!("a curve of it {fault}: export the file again")));
        }
        moved.push(Moved { node, path, curve });
    }
    Ok(moved)
}

fn numbers_of(column: &Column<'_>, width: usize) -> Vec<f32> {
    let row = |row| (0..width).map(move |which| column.real(row, which) as f32);
    (0..column.count).flat_map(row).collect()
}

/// The joints of a skin: which node each is, and joint from mesh.
pub(super) fn joints(data: Data<'_>, skin: usize) -> Result<Vec<(usize, Matrix4<f64>)>, GlbError> {
    let found = get("skin", &data.document.skins, skin)?;
    let inverse = match found.inverse_bind_matrices {
        Some(index) => {
            let column = data.column(index, &[("MAT4", 16)], |number, _| number == Number::F32)?;
            if column.count < found.joints.len() {
                return Err(unsupported("skin", skin, "it has fewer matrices than joints: export it again"));
            }
            Some(column)
        }
        None => None,
    };
    let joint = |(rank, node): (usize, &usize)| {
        get("node", &data.document.nodes, *node)?;
        let bind = inverse
            .as_ref()
            .map_or_else(Matrix4::identity, |column| Matrix4::from_column_slice(&column.reals::<16>(rank)));
        if bind.iter().all(|number| number.is_finite()) {
            Ok((*node, bind))
        } else {
            Err(GlbError::Number { what: "skin", index: skin })
        }
    };
    found.joints.iter().enumerate().map(joint).collect()
}

/// Which joints of a skin bear a vertex, and how much each.
pub(super) struct Bearing<'a> {
    sets: Vec<(Column<'a>, Column<'a>)>,
    joints: usize,
    weights: usize,
}

impl<'a> Bearing<'a> {
    /// Of a primitive with these attributes and so many vertices, on a skin of so many joints.
    pub(super) fn new(
        data: Data<'a>,
        attributes: &std::collections::BTreeMap<String, usize>,
        vertices: usize,
        joints: usize,
    ) -> Result<Self, GlbError> {
        /// More sets of four joints a vertex are not read.
        const SETS: usize = 4;
        let mut sets = Vec::new();
        let mut last = 0;
        for set in 0..SETS {
            let (Some(bones), Some(weights)) =
                (attributes.get(&format!("JOINTS_{set}")), attributes.get(&format!("WEIGHTS_{set}")))
            else {
                break;
            };
            let is_index = |number, _| matches!(number, Number::U8 | Number::U16);
            let columns = (
                data.column(*bones, &[("VEC4", 4)], is_index)?,
                data.column(*weights, &[("VEC4", 4)], is_share)?,
            );
            super::paint::same_length(*bones, columns.0.count, vertices)?;
            super::paint::same_length(*weights, columns.1.count, vertices)?;
            last = *weights;
            sets.push(columns);
        }
        Ok(Self { sets, joints, weights: last })
    }

    /// The joints that bear a vertex with their shares, the largest first, together 1; none if no joint bears it.
    pub(super) fn of(&self, vertex: usize) -> Result<Vec<(usize, f64)>, GlbError> {
        let mut shares = Vec::new();
        for (bones, weights) in &self.sets {
            for which in 0..4 {
                let weight = weights.real(vertex, which);
                if !(weight.is_finite() && weight >= 0.0) {
                    return Err(GlbError::Number { what: "accessor", index: self.weights });
                }
                if weight > 0.0 {
                    let joint = bones.whole(vertex, which) as usize;
                    if joint >= self.joints {
                        let (index, count) = (joint as u64, self.joints as u64);
                        return Err(GlbError::Missing { what: "joint", index, count });
                    }
                    shares.push((joint, weight));
                }
            }
        }
        shares.sort_by(|a, b| b.1.total_cmp(&a.1));
        let total: f64 = shares.iter().map(|(_, weight)| weight).sum();
        for (_, weight) in &mut shares {
            *weight /= total;
        }
        Ok(shares)
    }
}

/// A point under a matrix.
pub(super) fn moved(matrix: &Matrix4<f64>, [x, y, z]: [f64; 3]) -> Vector4<f64> {
    matrix * Vector4::new(x, y, z, 1.0)
}
