//! Where joints, bones and vertices are at a moment.

use nalgebra::{Matrix3, Matrix3x4, Matrix4, Quaternion, Translation3, UnitQuaternion, Vector3, Vector4};

use super::curve::{line, slerp};
use super::moment::{MIX_STEPS, MOMENTS_A_POSE};
use super::{Channel, Clip, ClipMoment, Curve, Local, POSE_RATE, Path, RigDesc, RigPose, SkinVertex};

/// A model at a moment: of each of its vertices, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PosedModel {
    /// Body frame, m.
    pub positions: Vec<[f32; 3]>,
    /// Outward, of length 1; zero where the skin has none.
    pub normals: Vec<[f32; 3]>,
}

/// Where all vertices are, of joints that stand like this.
pub(super) fn pose(desc: &RigDesc, locals: &[Local]) -> PosedModel {
    let bones = carriers(desc, locals);
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

/// Where all joints are on their parents in a clip, so long after it began; at rest without one.
pub(super) fn locals(desc: &RigDesc, clip: Option<&Clip>, seconds: f64) -> Vec<Local> {
    let mut locals: Vec<Local> = desc.joints.iter().map(|joint| joint.rest).collect();
    for Channel { joint, path, curve } in clip.iter().flat_map(|clip| &clip.channels) {
        locals[*joint as usize].put(*path, curve, seconds);
    }
    locals
}

/// Where all joints are on their parents as they are shown.
pub(super) fn shown(desc: &RigDesc, RigPose { from, to, share }: RigPose) -> Vec<Local> {
    let now = at_moment(desc, to);
    if share == MIX_STEPS {
        now
    } else {
        mixed(&at_moment(desc, from), &now, u32::from(share), MIX_STEPS.into())
    }
}

/// At a moment of a clip, between its poses from joint to joint; at rest without one.
fn at_moment(desc: &RigDesc, moment: Option<ClipMoment>) -> Vec<Local> {
    let clip = moment.and_then(|moment| desc.clips.get(moment.clip as usize));
    let Some((clip, ClipMoment { number, .. })) = clip.zip(moment) else { return locals(desc, None, 0.0) };
    let (number, beyond) = (number / MOMENTS_A_POSE, number % MOMENTS_A_POSE);
    let sample = |number: u32| locals(desc, Some(clip), f64::from(number) / POSE_RATE);
    if beyond == 0 {
        return sample(number);
    }
    mixed(&sample(number), &sample(number + 1), beyond, MOMENTS_A_POSE)
}

/// So many of some steps on the way from one to the other.
fn mixed(from: &[Local], to: &[Local], step: u32, steps: u32) -> Vec<Local> {
    let share = f64::from(step) / f64::from(steps);
    from.iter().zip(to).map(|(from, to)| from.mixed(to, share)).collect()
}

/// Body from joint.
pub(super) fn places(desc: &RigDesc, locals: &[Local]) -> Vec<Matrix4<f64>> {
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

    /// Some share of the way to another place on the same parent: rotations along the shorter arc. A matrix has no way, and stays.
    fn mixed(&self, other: &Self, share: f64) -> Self {
        let (
            Self::Parts { translation, rotation, scale },
            Self::Parts { translation: place, rotation: turn, scale: size },
        ) = (self, other)
        else {
            return *self;
        };
        let weights = [1.0 - share, share];
        Self::Parts {
            translation: line(*translation, *place, weights),
            rotation: slerp(unit(*rotation), unit(*turn), share),
            scale: line(*scale, *size, weights),
        }
    }
}

/// A rotation of length 1; one of no length turns nothing.
fn unit(rotation: [f64; 4]) -> [f64; 4] {
    let turn = Vector4::from(rotation).try_normalize(1e-9);
    turn.map_or([0.0, 0.0, 0.0, 1.0], Into::into)
}

/// Body from skin, by bone.
pub(super) fn bones(desc: &RigDesc, joints: &[Matrix4<f64>]) -> Vec<Matrix4<f64>> {
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
    let bones = carriers(desc, &locals(desc, None, 0.0));
    for (vertex, normal) in desc.vertices.iter_mut().zip(normals) {
        let linear = linear(&blended(vertex, &bones));
        let side = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
        let normal = linear.tr_mul(&Vector3::from(*normal)) * side;
        vertex.normal = normal.try_normalize(1e-12).unwrap_or_default().into();
    }
}

/// The tangents of the skin that are these at rest: of length 1, with the side that they have there; zeros where nothing leads back.
pub(super) fn of_skin(desc: &RigDesc, rest: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let bones = carriers(desc, &locals(desc, None, 0.0));
    let led = |(vertex, tangent): (&SkinVertex, &[f32; 4])| {
        let map = linear(&blended(vertex, &bones));
        map.try_inverse().map_or([0.0; 4], |back| led_by(&back, *tangent))
    };
    desc.vertices.iter().zip(rest).map(led).collect()
}

/// Where tangents of the skin point, body frame, of joints that stand like this.
pub(super) fn tangents(desc: &RigDesc, skin: &[[f32; 4]], locals: &[Local]) -> Vec<[f32; 4]> {
    let bones = carriers(desc, locals);
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

/// Body from skin, by bone, of joints that stand like this.
fn carriers(desc: &RigDesc, locals: &[Local]) -> Vec<Matrix3x4<f32>> {
    let single = |bone: &Matrix4<f64>| bone.fixed_view::<3, 4>(0, 0).map(|part| part as f32);
    bones(desc, &places(desc, locals)).iter().map(single).collect()
}
