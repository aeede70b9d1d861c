//! Where joints, bones and vertices are at a moment.

use nalgebra::{Matrix3, Matrix3x4, Matrix4, Quaternion, Translation3, UnitQuaternion, Vector3, Vector4};

use super::{Channel, Clip, Curve, Local, POSE_RATE, Path, RigDesc, RigError, SkinVertex};
use crate::asset::LARGEST_MODEL;

/// A model at a moment: of each of its vertices, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PosedModel {
    /// Body frame, m.
    pub positions: Vec<[f32; 3]>,
    /// Outward, of length 1; zero where the skin has none.
    pub normals: Vec<[f32; 3]>,
}

/// Where all vertices are.
pub(super) fn pose(desc: &RigDesc, clip: Option<&Clip>, seconds: f64) -> PosedModel {
    let bones = carriers(desc, clip, seconds);
    let mut posed = PosedModel {
        positions: Vec::with_capacity(desc.vertices.len()),
        normals: Vec::with_capacity(desc.vertices.len()),
    };
    for vertex in &desc.vertices {
        let (position, normal) = carried(vertex, &bones);
        posed.positions.push(position);
        posed.normals.push(normal);
    }
    posed
}

/// Body from joint.
fn joints(desc: &RigDesc, clip: Option<&Clip>, seconds: f64) -> Vec<Matrix4<f64>> {
    let mut locals: Vec<Local> = desc.joints.iter().map(|joint| joint.rest).collect();
    for Channel { joint, path, curve } in clip.iter().flat_map(|clip| &clip.channels) {
        locals[*joint as usize].put(*path, curve, seconds);
    }
    let mut places: Vec<Matrix4<f64>> = Vec::with_capacity(locals.len());
    for (local, joint) in locals.iter().zip(&desc.joints) {
        let own = local.matrix();
        // Parents come before their children.
        places.push(joint.parent.map_or(own, |parent| places[parent as usize] * own));
    }
    places
}

impl Local {
    /// Parent from joint. A rotation of no length turns nothing: cubics may come through zero.
    pub fn matrix(&self) -> Matrix4<f64> {
        match self {
            Self::Matrix(columns) => Matrix4::from_column_slice(columns),
            Self::Parts { translation, rotation: [x, y, z, w], scale } => {
                let turn = UnitQuaternion::try_new(Quaternion::new(*w, *x, *y, *z), 1e-9).unwrap_or_default();
                let scale = Matrix4::new_nonuniform_scaling(&Vector3::from(*scale));
                Translation3::from(*translation).to_homogeneous() * turn.to_homogeneous() * scale
            }
        }
    }

    /// Puts what a curve says at a time, s, into one of its parts; a matrix has none, and stays.
    pub fn put(&mut self, path: Path, curve: &Curve, seconds: f64) {
        let Self::Parts { translation, rotation, scale } = self else { return };
        match path {
            Path::Translation => *translation = curve.at(seconds),
            Path::Rotation => *rotation = curve.at(seconds),
            Path::Scale => *scale = curve.at(seconds),
        }
    }
}

/// Body from skin, by bone.
fn bones(desc: &RigDesc, joints: &[Matrix4<f64>]) -> Vec<Matrix4<f64>> {
    let bone =
        |bone: &super::Bone| joints[bone.joint as usize] * Matrix4::from_column_slice(&bone.joint_from_skin);
    desc.bones.iter().map(bone).collect()
}

/// Where bones carry a vertex.
fn carried(vertex: &SkinVertex, bones: &[Matrix3x4<f32>]) -> ([f32; 3], [f32; 3]) {
    let map = blended(vertex, bones);
    let [x, y, z] = vertex.position;
    let linear = linear(&map);
    // Cofactors keep normals upright on what is scaled, and need no inverse.
    let column = |a: usize, b: usize| linear.column(a).cross(&linear.column(b));
    let cofactors = Matrix3::from_columns(&[column(1, 2), column(2, 0), column(0, 1)]);
    let normal = (cofactors * Vector3::from(vertex.normal)).try_normalize(1e-12).unwrap_or_default();
    ((map * Vector4::new(x, y, z, 1.0)).into(), normal.into())
}

/// Body from skin for a vertex: its bones' matrices in its shares.
fn blended(vertex: &SkinVertex, bones: &[Matrix3x4<f32>]) -> Matrix3x4<f32> {
    let shares = vertex.bones.iter().zip(vertex.weights).filter(|(_, weight)| *weight > 0.0);
    shares.map(|(bone, weight)| bones[usize::from(*bone)] * weight).sum()
}

/// What a map does to directions, of about one, whatever the units of the skin are.
fn linear(map: &Matrix3x4<f32>) -> Matrix3<f32> {
    let linear: Matrix3<f32> = map.fixed_columns::<3>(0).into_owned();
    linear / linear.amax().max(f32::MIN_POSITIVE)
}

/// The normals of the skin that are these at rest: by the transposed map, which the cofactors undo but for a factor.
pub(super) fn face(desc: &mut RigDesc, normals: &[[f32; 3]]) {
    let bones = carriers(desc, None, 0.0);
    for (vertex, normal) in desc.vertices.iter_mut().zip(normals) {
        let linear = linear(&blended(vertex, &bones));
        let side = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
        let normal = linear.tr_mul(&Vector3::from(*normal)) * side;
        vertex.normal = normal.try_normalize(1e-12).unwrap_or_default().into();
    }
}

/// The tangents of the skin that are these at rest: of length 1, with the side that they have there; zeros where nothing leads back.
pub(super) fn of_skin(desc: &RigDesc, rest: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let bones = carriers(desc, None, 0.0);
    let led = |(vertex, tangent): (&SkinVertex, &[f32; 4])| {
        let map = linear(&blended(vertex, &bones));
        map.try_inverse().map_or([0.0; 4], |back| led_by(&back, *tangent))
    };
    desc.vertices.iter().zip(rest).map(led).collect()
}

/// Where tangents of the skin point, body frame.
pub(super) fn tangents(
    desc: &RigDesc,
    skin: &[[f32; 4]],
    clip: Option<&Clip>,
    seconds: f64,
) -> Vec<[f32; 4]> {
    let bones = carriers(desc, clip, seconds);
    let led =
        |(vertex, tangent): (&SkinVertex, &[f32; 4])| led_by(&linear(&blended(vertex, &bones)), *tangent);
    desc.vertices.iter().zip(skin).map(led).collect()
}

/// A tangent under a map, of length 1: what mirrors a surface mirrors what lies on it. Zeros where it has none.
fn led_by(map: &Matrix3<f32>, [x, y, z, side]: [f32; 4]) -> [f32; 4] {
    let led = (map * Vector3::new(x, y, z)).try_normalize(1e-12);
    let sound = led.filter(|way| way.iter().all(|part| part.is_finite()));
    let turned = if map.determinant() < 0.0 { -side } else { side };
    sound.map_or([0.0; 4], |way| [way.x, way.y, way.z, turned])
}

/// Body from skin, by bone.
fn carriers(desc: &RigDesc, clip: Option<&Clip>, seconds: f64) -> Vec<Matrix3x4<f32>> {
    let single = |bone: &Matrix4<f64>| bone.fixed_view::<3, 4>(0, 0).map(|part| part as f32);
    bones(desc, &joints(desc, clip, seconds)).iter().map(single).collect()
}

/// A box by its middle and half of its sides, or nothing.
#[derive(Clone, Copy)]
struct Around {
    middle: Vector3<f64>,
    half: Vector3<f64>,
}

/// The box around all poses: each vertex is between the places to which its bones carry it, and these are in the boxes around what each
/// bone carries.
pub(super) fn bounds(desc: &RigDesc) -> Result<[[f32; 3]; 2], RigError> {
    let skins = around_skins(desc);
    let mut whole = reach(desc, &skins, None, 0.0)?;
    for clip in &desc.clips {
        for pose in 0..clip.poses() {
            let [low, high] = reach(desc, &skins, Some(clip), f64::from(pose) / POSE_RATE)?;
            let [least, most] = whole;
            whole = [
                std::array::from_fn(|axis| least[axis].min(low[axis])),
                std::array::from_fn(|axis| most[axis].max(high[axis])),
            ];
        }
    }
    Ok(whole)
}

/// By bone, the box around the vertices that it carries, as the skin has them.
fn around_skins(desc: &RigDesc) -> Vec<Option<Around>> {
    let mut boxes: Vec<Option<[[f32; 3]; 2]>> = vec![None; desc.bones.len()];
    for vertex in &desc.vertices {
        for (bone, _) in vertex.bones.iter().zip(vertex.weights).filter(|(_, weight)| *weight > 0.0) {
            let [low, high] = boxes[usize::from(*bone)].get_or_insert([vertex.position; 2]);
            *low = std::array::from_fn(|axis| low[axis].min(vertex.position[axis]));
            *high = std::array::from_fn(|axis| high[axis].max(vertex.position[axis]));
        }
    }
    let around = |[low, high]: [[f32; 3]; 2]| {
        let [low, high] = [low, high].map(|corner| Vector3::from(corner).map(f64::from));
        Around { middle: (low + high) * 0.5, half: (high - low) * 0.5 }
    };
    boxes.into_iter().map(|one| one.map(around)).collect()
}

/// The box around one pose.
fn reach(
    desc: &RigDesc,
    skins: &[Option<Around>],
    clip: Option<&Clip>,
    seconds: f64,
) -> Result<[[f32; 3]; 2], RigError> {
    let bones = bones(desc, &joints(desc, clip, seconds));
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for (bone, around) in bones.iter().zip(skins) {
        let Some(Around { middle, half }) = around else { continue };
        let linear = bone.fixed_view::<3, 3>(0, 0).into_owned();
        let (at, wide) = (linear * middle + bone.fixed_view::<3, 1>(0, 3), linear.abs() * half);
        for axis in 0..3 {
            let ends = [at[axis] - wide[axis], at[axis] + wide[axis]].map(|part| part as f32);
            // What is no number is far too.
            let far = ends.into_iter().find(|end| !(-LARGEST_MODEL..=LARGEST_MODEL).contains(end));
            if let Some(metres) = far {
                let name = clip.map_or_else(String::new, |clip| clip.name.clone());
                return Err(RigError::Far { clip: name, seconds, metres });
            }
            (low[axis], high[axis]) = (low[axis].min(ends[0]), high[axis].max(ends[1]));
        }
    }
    Ok([low, high])
}
