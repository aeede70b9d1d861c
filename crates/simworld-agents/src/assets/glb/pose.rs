//! Nodes as an animation has them at a moment, and the joints of skins (glTF 2.0, 3.7.3 and 3.11).

use nalgebra::{Matrix4, Quaternion, Translation3, UnitQuaternion, Vector4};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::Vector3;

use super::accessor::{Column, Data, Number, get, unsupported};
use super::document::{Channel, Curve, Node};
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

/// Where a node is, as its file and its animation say: translation, rotation and scale, or a matrix.
#[derive(Clone, Debug)]
struct Local {
    translation: [f64; 3],
    rotation: [f64; 4],
    scale: [f64; 3],
    matrix: Option<[f64; 16]>,
}

/// World from node, for every node of the file.
pub(super) fn places(
    data: Data<'_>,
    limits: &GlbLimits,
    moment: Option<Moment>,
) -> Result<Vec<Matrix4<f64>>, GlbError> {
    let nodes = &data.document.nodes;
    let mut locals: Vec<Local> = nodes.iter().map(Local::of).collect();
    if let Some(moment) = moment {
        animate(data, moment, &mut locals)?;
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
        let here = above * locals[index].matrix(index)?;
        places[index] = Some(here);
        open.extend(nodes[index].children.iter().map(|child| (*child, here, depth + 1)));
    }
    // Who is in a ring hangs from no root.
    let place = |(index, place): (usize, Option<Matrix4<f64>>)| {
        place.ok_or_else(|| wrong(index, "hangs in two places, or below itself"))
    };
    places.into_iter().enumerate().map(place).collect()
}

impl Local {
    fn of(node: &Node) -> Self {
        Self {
            translation: node.translation.unwrap_or_default(),
            rotation: node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]),
            scale: node.scale.unwrap_or([1.0; 3]),
            matrix: node.matrix,
        }
    }

    fn matrix(&self, index: usize) -> Result<Matrix4<f64>, GlbError> {
        let matrix = if let Some(columns) = self.matrix {
            Matrix4::from_column_slice(&columns)
        } else {
            let [x, y, z, w] = self.rotation;
            let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9)
                .ok_or(GlbError::Number { what: "node", index })?;
            let shift = Translation3::from(self.translation);
            let scale = Vector3::from(self.scale);
            shift.to_homogeneous() * turn.to_homogeneous() * Matrix4::new_nonuniform_scaling(&scale)
        };
        if matrix.iter().all(|number| number.is_finite()) {
            Ok(matrix)
        } else {
            Err(GlbError::Number { what: "node", index })
        }
    }
}

/// Puts the channels of an animation into the nodes that they move.
fn animate(data: Data<'_>, moment: Moment, locals: &mut [Local]) -> Result<(), GlbError> {
    let animation = get("animation", &data.document.animations, moment.animation)?;
    if !moment.seconds.is_finite() {
        return Err(GlbError::Number { what: "animation", index: moment.animation });
    }
    let refused = |reason: &str| unsupported("animation", moment.animation, reason);
    for Channel { sampler, target } in &animation.channels {
        // Channels without a node are for extensions.
        let Some(node) = target.node else { continue };
        get("node", locals, node)?;
        if locals[node].matrix.is_some() {
            return Err(refused("it moves a node that has a matrix: export translation, rotation and scale"));
        }
        let curve = get("animation sampler", &animation.samplers, *sampler)?;
        let local = &mut locals[node];
        match target.path.as_str() {
            "translation" => local.translation = sample(data, curve, moment, Mixing::Linear)?,
            "scale" => local.scale = sample(data, curve, moment, Mixing::Linear)?,
            "rotation" => local.rotation = sample(data, curve, moment, Mixing::Spherical)?,
            "weights" => return Err(refused("it moves the weights of morph targets, which are not read")),
            _ => return Err(refused("it moves something that glTF 2.0 does not know")),
        }
    }
    Ok(())
}

/// How one goes from key to key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mixing {
    Linear,
    /// Along the shorter arc of unit quaternions.
    Spherical,
}

/// A curve at a moment.
fn sample<const N: usize>(
    data: Data<'_>,
    curve: &Curve,
    moment: Moment,
    mixing: Mixing,
) -> Result<[f64; N], GlbError> {
    let refused = |reason: &str| unsupported("animation", moment.animation, reason);
    let times = data.column(curve.input, &[("SCALAR", 1)], |number, _| number == Number::F32)?;
    let shape = if N == 4 { ("VEC4", 4) } else { ("VEC3", 3) };
    let values = data.column(curve.output, &[shape], is_share)?;
    let cubic = curve.interpolation == "CUBICSPLINE";
    if !cubic && !matches!(curve.interpolation.as_str(), "LINEAR" | "STEP") {
        return Err(refused("its keys are joined in a way that glTF 2.0 does not know"));
    }
    if times.count.checked_mul(if cubic { 3 } else { 1 }) != Some(values.count) {
        return Err(refused("it has not one value for each of its keys: export the file again"));
    }
    let ascends = (1..times.count).all(|row| times.real(row, 0) > times.real(row - 1, 0));
    if !ascends || !times.real(0, 0).is_finite() {
        return Err(refused("the times of its keys do not ascend: export the file again"));
    }
    let value = |row: usize| -> [f64; N] { values.reals(row) };
    let key = |row: usize| value(if cubic { row * 3 + 1 } else { row });
    let (next, share, span) = between(&times, moment.seconds);
    let mixed = match next.checked_sub(1) {
        None => key(0),
        Some(last) if next == times.count => key(last),
        Some(before) if cubic => {
            let (out, into) = (value(before * 3 + 2), value(next * 3));
            hermite([key(before), out, into, key(next)], share, span)
        }
        Some(before) if curve.interpolation == "STEP" => key(before),
        Some(before) => mix(key(before), key(next), share, mixing),
    };
    if mixed.iter().all(|number| number.is_finite()) {
        Ok(mixed)
    } else {
        Err(GlbError::Number { what: "accessor", index: curve.output })
    }
}

/// The first key after a time; how far it is between that and the one before, and the time between the two.
fn between(times: &Column<'_>, seconds: f64) -> (usize, f64, f64) {
    let (mut low, mut high) = (0, times.count);
    while low < high {
        let middle = low.midpoint(high);
        if times.real(middle, 0) <= seconds { low = middle + 1 } else { high = middle }
    }
    if low == 0 || low == times.count {
        return (low, 0.0, 0.0);
    }
    let (before, after) = (times.real(low - 1, 0), times.real(low, 0));
    (low, (seconds - before) / (after - before), after - before)
}

fn mix<const N: usize>(a: [f64; N], b: [f64; N], share: f64, mixing: Mixing) -> [f64; N] {
    let line = |weights: [f64; 2]| std::array::from_fn(|axis| a[axis] * weights[0] + b[axis] * weights[1]);
    if mixing == Mixing::Linear {
        return line([1.0 - share, share]);
    }
    let cosine: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
    let side = if cosine < 0.0 { -1.0 } else { 1.0 };
    let angle = simworld_core::ops::acos((cosine * side).min(1.0));
    let sine = simworld_core::ops::sin(angle);
    if sine < 1e-6 {
        return line([1.0 - share, share * side]);
    }
    let weight = |part: f64| simworld_core::ops::sin(part * angle) / sine;
    line([weight(1.0 - share), weight(share) * side])
}

/// A cubic between two keys with the tangents that leave the one and come into the other (glTF 2.0, C.5).
fn hermite<const N: usize>([a, out, into, b]: [[f64; N]; 4], t: f64, span: f64) -> [f64; N] {
    let (square, cube) = (t * t, t * t * t);
    std::array::from_fn(|axis| {
        (2.0 * cube - 3.0 * square + 1.0) * a[axis]
            + span * (cube - 2.0 * square + t) * out[axis]
            + (3.0 * square - 2.0 * cube) * b[axis]
            + span * (cube - square) * into[axis]
    })
}

/// World from mesh for each joint of a skin.
pub(super) fn joints(
    data: Data<'_>,
    skin: usize,
    places: &[Matrix4<f64>],
) -> Result<Vec<Matrix4<f64>>, GlbError> {
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
        let place = get("node", places, *node)?;
        let bind = inverse
            .as_ref()
            .map_or_else(Matrix4::identity, |column| Matrix4::from_column_slice(&column.reals::<16>(rank)));
        let matrix = place * bind;
        if matrix.iter().all(|number| number.is_finite()) {
            Ok(matrix)
        } else {
            Err(GlbError::Number { what: "skin", index: skin })
        }
    };
    found.joints.iter().enumerate().map(joint).collect()
}

/// Which joints bear a vertex, and how much each.
pub(super) struct Bearing<'a> {
    sets: Vec<(Column<'a>, Column<'a>)>,
    joints: &'a [Matrix4<f64>],
    weights: usize,
}

impl<'a> Bearing<'a> {
    /// Of a primitive with these attributes and so many vertices.
    pub(super) fn new(
        data: Data<'a>,
        attributes: &std::collections::BTreeMap<String, usize>,
        vertices: usize,
        joints: &'a [Matrix4<f64>],
    ) -> Result<Self, GlbError> {
        /// More joints than these a vertex are not read.
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

    /// World from mesh for a vertex: the joints' matrices in the shares of its weights; none if no joint bears it.
    pub(super) fn of(&self, vertex: usize) -> Result<Option<Matrix4<f64>>, GlbError> {
        let (mut sum, mut total) = (Matrix4::zeros(), 0.0);
        for (bones, weights) in &self.sets {
            for which in 0..4 {
                let weight = weights.real(vertex, which);
                if !(weight.is_finite() && weight >= 0.0) {
                    return Err(GlbError::Number { what: "accessor", index: self.weights });
                }
                if weight > 0.0 {
                    sum += get("joint", self.joints, bones.whole(vertex, which) as usize)? * weight;
                    total += weight;
                }
            }
        }
        Ok((total > 0.0).then(|| sum / total))
    }
}

/// A point under a matrix.
pub(super) fn moved(matrix: &Matrix4<f64>, [x, y, z]: [f64; 3]) -> Vector4<f64> {
    matrix * Vector4::new(x, y, z, 1.0)
}
