//! What is known of all poses of a rig: where they reach, and how fast its clips walk.

use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

use super::pose::{bones, locals, places, pose};
use super::{Local, POSE_RATE, RigDesc, RigError};
use crate::asset::LARGEST_MODEL;

/// What a point of a rig has to be nearer to the ground than to bear on it, of the rig's height at rest.
const TOUCH: f64 = 0.02;
/// Clips that go slower or faster than this are no gaits, m/s of the model.
const SLOWEST: f64 = 0.1;
const FASTEST: f64 = 30.0;

/// What is known of all poses of a rig.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Measures {
    /// The box around all poses of all clips, body frame, m.
    pub(super) bounds: [[f32; 3]; 2],
    /// How far from the body's origin any mixture of them reaches, m.
    pub(super) reach: f64,
    /// By clip, how fast it walks, m/s.
    pub(super) paces: Vec<Option<f64>>,
}

/// Measures a rig that was checked.
pub(super) fn measure(desc: &RigDesc) -> Result<Measures, RigError> {
    let (skins, soles) = (around_skins(desc), soles(desc));
    let rest = locals(desc, None, 0.0);
    let mut spans = Spans::new(&rest);
    let mut bounds = boxed(&bones(desc, &places(desc, &rest)), &skins, ("", 0.0))?;
    let touch = TOUCH * f64::from(bounds[1][2] - bounds[0][2]);
    let mut paces = Vec::with_capacity(desc.clips.len());
    for clip in &desc.clips {
        let mut walk = Walk::default();
        for number in 0..=clip.poses() {
            let seconds = f64::from(number) / POSE_RATE;
            let posed = locals(desc, Some(clip), seconds);
            spans.take(&posed);
            let bones = bones(desc, &places(desc, &posed));
            let [low, high] = boxed(&bones, &skins, (clip.name.as_str(), seconds))?;
            let [least, most] = bounds;
            bounds = [
                std::array::from_fn(|axis| least[axis].min(low[axis])),
                std::array::from_fn(|axis| most[axis].max(high[axis])),
            ];
            walk.take(soles.iter().map(|(bone, sole)| bones[*bone] * sole).collect(), touch);
        }
        paces.push(walk.pace(touch));
    }
    Ok(Measures { bounds, reach: spans.reach(desc, &skins), paces })
}

/// A box by its middle and half of its sides, or nothing.
#[derive(Clone, Copy)]
struct Around {
    middle: Vector3<f64>,
    half: Vector3<f64>,
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

/// The box around one pose: each vertex is between the places to which its bones carry it, and these are in the boxes around what each bone carries. Which clip it is, and when, is for the
/// error.
fn boxed(
    bones: &[Matrix4<f64>],
    skins: &[Option<Around>],
    (clip, seconds): (&str, f64),
) -> Result<[[f32; 3]; 2], RigError> {
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
                return Err(RigError::Far { clip: clip.to_owned(), seconds, metres });
            }
            (low[axis], high[axis]) = (low[axis].min(ends[0]), high[axis].max(ends[1]));
        }
    }
    Ok([low, high])
}

/// By joint, how far from its parent and how large it comes to be: whatever lies between two poses lies within that, however it is turned.
struct Spans(Vec<(f64, f64)>);

impl Spans {
    fn new(rest: &[Local]) -> Self {
        let mut spans = Self(vec![(0.0, 0.0); rest.len()]);
        spans.take(rest);
        spans
    }

    fn take(&mut self, locals: &[Local]) {
        for ((far, large), local) in self.0.iter_mut().zip(locals) {
            let (away, factor) = match local {
                Local::Parts { translation, scale, .. } => {
                    (Vector3::from(*translation).norm(), Vector3::from(*scale).amax())
                }
                Local::Matrix(columns) => {
                    let matrix = Matrix4::from_column_slice(columns);
                    let linear = matrix.fixed_view::<3, 3>(0, 0).into_owned();
                    (matrix.fixed_view::<3, 1>(0, 3).norm(), stretch(&linear))
                }
            };
            (*far, *large) = (far.max(away), large.max(factor));
        }
    }

    /// How far from the origin what bones carry comes to be, m: at most twice as far as a model may be large, which no sound one is.
    fn reach(&self, desc: &RigDesc, skins: &[Option<Around>]) -> f64 {
        let mut most = 0.0_f64;
        for (bone, around) in desc.bones.iter().zip(skins) {
            let Some(Around { middle, half }) = around else { continue };
            let matrix = Matrix4::from_column_slice(&bone.joint_from_skin);
            let linear = matrix.fixed_view::<3, 3>(0, 0).into_owned();
            let middle = linear * middle + matrix.fixed_view::<3, 1>(0, 3);
            let mut far = middle.norm() + (linear.abs() * half).norm();
            let mut next = Some(bone.joint);
            while let Some(joint) = next {
                let (away, factor) = self.0[joint as usize];
                far = far * factor + away;
                next = desc.joints[joint as usize].parent;
            }
            most = most.max(far);
        }
        most.min(2.0 * f64::from(LARGEST_MODEL))
    }
}

/// By how much a map stretches any direction at most: by the norm of its columns and that of its rows (Hölder).
fn stretch(linear: &Matrix3<f64>) -> f64 {
    let most = |sums: [f64; 3]| sums.into_iter().fold(0.0, f64::max);
    let columns = std::array::from_fn(|axis| linear.column(axis).abs().sum());
    let rows = std::array::from_fn(|axis| linear.row(axis).abs().sum());
    (most(columns) * most(rows)).sqrt()
}

/// Of each bone that carries most of something, its lowest point at rest, as the skin has it.
fn soles(desc: &RigDesc) -> Vec<(usize, Vector4<f64>)> {
    /// Who carries as much of a vertex carries most of it.
    const MOST: f32 = 0.5;
    let rest = pose(desc, &locals(desc, None, 0.0));
    let mut lowest: Vec<Option<(f32, [f32; 3])>> = vec![None; desc.bones.len()];
    for (vertex, [_, _, height]) in desc.vertices.iter().zip(&rest.positions) {
        for (bone, _) in vertex.bones.iter().zip(vertex.weights).filter(|(_, weight)| *weight >= MOST) {
            let known = &mut lowest[usize::from(*bone)];
            if known.is_none_or(|(least, _)| *height < least) {
                *known = Some((*height, vertex.position));
            }
        }
    }
    let point = |[x, y, z]: [f32; 3]| Vector4::new(f64::from(x), f64::from(y), f64::from(z), 1.0);
    let found = lowest.into_iter().enumerate();
    found.filter_map(|(bone, lowest)| Some((bone, point(lowest?.1)))).collect()
}

/// How what bears on the ground goes from pose to pose of a clip.
#[derive(Default)]
struct Walk {
    before: Vec<Vector4<f64>>,
    /// How low the lowest point is, and how fast those that are as low go backwards, m/s.
    steps: Vec<(f64, f64)>,
}

impl Walk {
    fn take(&mut self, soles: Vec<Vector4<f64>>, touch: f64) {
        let low = |soles: &[Vector4<f64>]| soles.iter().map(|sole| sole.z).fold(f64::INFINITY, f64::min);
        let (last, now) = (low(&self.before), low(&soles));
        let pairs = self.before.iter().zip(&soles);
        let bearing = pairs.filter(|(a, b)| a.z <= last + touch && b.z <= now + touch);
        let ways: Vec<f64> = bearing.map(|(a, b)| a.x - b.x).collect();
        if !ways.is_empty() {
            let mean = ways.iter().sum::<f64>() / ways.len() as f64;
            self.steps.push((last.max(now), mean * POSE_RATE));
        }
        self.before = soles;
    }

    /// The speed at which the ground would go by under what bears on it, m/s ahead: the middle one of all steps that are on the ground; none where that is no gait.
    fn pace(&self, touch: f64) -> Option<f64> {
        let ground = self.steps.iter().map(|(low, _)| *low).fold(f64::INFINITY, f64::min);
        let bearing = self.steps.iter().filter(|(low, _)| *low <= ground + touch);
        let mut speeds: Vec<f64> = bearing.map(|(_, speed)| *speed).collect();
        speeds.sort_unstable_by(f64::total_cmp);
        let middle = *speeds.get(speeds.len() / 2)?;
        (SLOWEST..=FASTEST).contains(&middle.abs()).then_some(middle)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::tests::{arm, turn};
    use super::super::{
        Bone, Channel, Clip, ClipMoment, Curve, Interpolation, Joint, Path, Rig, RigPose, SkinVertex,
    };
    use super::*;

    proptest! {
        /// Whatever the joints do, every vertex of every pose is in the box that is said to be around all of them, and of every mixture within reach.
        #[test]
        fn every_pose_is_in_the_bounds(
            angles in prop::array::uniform3(-3.0..3.0f32),
            shift in prop::array::uniform3(-2.0..2.0f32),
            seconds in 0.05..2.0f32,
        ) {
            let mut desc = arm();
            desc.clips[0].channels = (0..2_u32)
                .map(|joint| Channel {
                    joint,
                    path: Path::Rotation,
                    curve: turn(joint as usize, angles[joint as usize], seconds),
                })
                .collect();
            let curve = Curve {
                interpolation: Interpolation::Linear,
                times: vec![0.0, seconds],
                values: [[0.0; 3], shift].concat(),
            };
            desc.clips[0].channels.push(Channel { joint: 0, path: Path::Translation, curve });
            let rig = Rig::new(desc).unwrap();
            let [low, high] = rig.bounds();
            for pose in 0..rig.clips()[0].poses() {
                for point in rig.pose(0, f64::from(pose) / POSE_RATE).positions {
                    for axis in 0..3 {
                        prop_assert!(point[axis] >= low[axis] - 1e-5 && point[axis] <= high[axis] + 1e-5);
                    }
                }
            }
            for number in (0..rig.clips()[0].moments()).step_by(5) {
                let moment = Some(ClipMoment { clip: 0, number });
                for pose in [RigPose::at(moment), RigPose::between(moment, None, 0.07)] {
                    for point in rig.posed(pose).positions {
                        let far = Vector3::from(point).norm();
                        prop_assert!(f64::from(far) <= rig.reach() + 1e-5, "{far} of {}", rig.reach());
                    }
                }
            }
        }
    }

    /// Somebody 2 m high on two feet, which take turns: half of the time a foot goes back over the ground by so many metres, then it is lifted and comes ahead.
    fn walker(stride: f32, seconds: f32, root: f32) -> Rig {
        let foot = |joint, [a, b, c, d]: [f32; 4], lifted: [f32; 4], times: [f32; 4]| {
            let values =
                [a, b, c, d].into_iter().zip(lifted).flat_map(|(x, z)| [x * stride, 0.0, z]).collect();
            let times = times.map(|share| share * seconds).to_vec();
            let curve = Curve { interpolation: Interpolation::Linear, times, values };
            Channel { joint, path: Path::Translation, curve }
        };
        let body = Curve {
            interpolation: Interpolation::Linear,
            times: vec![0.0, seconds],
            values: vec![0.0, 0.0, 0.0, root * seconds, 0.0, 0.0],
        };
        let on = |bone, z| SkinVertex { position: [0.0, 0.0, z], bones: [bone; 4], ..SkinVertex::default() };
        let hung = Joint { parent: Some(0), ..Joint::default() };
        Rig::new(RigDesc {
            joints: vec![Joint::default(), hung, hung],
            bones: [0, 1, 2].map(Bone::of).to_vec(),
            vertices: vec![on(0, 1.0), on(0, 2.0), on(1, 0.0), on(1, 0.1), on(2, 0.0), on(2, 0.1)],
            clips: vec![Clip {
                name: "walk".to_owned(),
                channels: vec![
                    foot(1, [0.5, -0.5, 0.0, 0.5], [0.0, 0.0, 0.3, 0.0], [0.0, 0.5, 0.75, 1.0]),
                    foot(2, [-0.5, 0.0, 0.5, -0.5], [0.0, 0.3, 0.0, 0.0], [0.0, 0.25, 0.5, 1.0]),
                    Channel { joint: 0, path: Path::Translation, curve: body },
                ],
            }],
        })
        .unwrap()
    }

    #[test]
    fn feet_say_how_fast_a_clip_walks() {
        for (stride, seconds) in [(0.7, 1.0), (1.2, 0.8), (-0.7, 1.0)] {
            let pace = walker(stride, seconds, 0.0).pace(0).unwrap();
            // A stride in half of its time.
            let wanted = 2.0 * f64::from(stride / seconds);
            assert!((pace - wanted).abs() < 0.02 * wanted.abs(), "{pace}, not {wanted}");
        }
        // Who goes along with its feet leaves the ground where it is, and who stands too.
        assert_eq!(walker(0.7, 1.0, 1.4).pace(0), None);
        assert_eq!(walker(0.0, 1.0, 0.0).pace(0), None);
        assert_eq!(walker(0.7, 1.0, 0.0).pace(7), None, "there is no such clip");
    }

    #[test]
    fn reach_is_that_of_a_stretched_arm() {
        let rig = Rig::new(arm()).unwrap();
        assert!((rig.reach() - 2.0).abs() < 1e-9, "{}", rig.reach());
        let mut long = arm();
        long.joints[0].rest =
            Local::Matrix([0.0, 3.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, -3.0, 0.0, 0.0, 0.0, 0.5, 1.0]);
        let reach = Rig::new(long).unwrap().reach();
        assert!((reach - 6.5).abs() < 1e-9, "{reach}");
    }
}
