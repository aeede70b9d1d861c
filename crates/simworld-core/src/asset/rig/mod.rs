//! Rigs: how a model moves. Joints hang from one another, bones carry the surface along, and clips say how the joints move in time.

mod check;
mod curve;
mod error;
mod measure;
mod moment;
mod pose;

pub use curve::{Curve, Interpolation, Path};
pub use error::{LONGEST_CLIP_NAME, RigError};
use measure::Measures;
pub use moment::{ClipMoment, MIX_SECONDS, MOMENT_RATE, RigPose};
pub use pose::PosedModel;
use serde::{Deserialize, Serialize};

/// Poses of a clip that are looked up in its curves, a second; what is between two of them is reckoned from both.
pub const POSE_RATE: f64 = 30.0;

/// Joints and bones, times poses of all clips, that a rig may have.
pub const MOST_WORK: u64 = 4_000_000;

/// How a model moves, as [`Model::rig`](super::Model::rig): a skeleton as glTF 2.0 has it (3.7.3 and 3.11), in metres of the body frame at its first joint. It is always
/// sound: what is none is no [`Rig`].
///
/// ```
/// use simworld_core::asset::{Bone, Channel, Clip, Curve, Interpolation, Joint, Local, Path, Rig, RigDesc, SkinVertex};
/// // One point, 1 m ahead of a joint that turns half around in a second.
/// let turn = Curve {
///     interpolation: Interpolation::Linear,
///     times: vec![0.0, 1.0],
///     values: vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0],
/// };
/// let rig = Rig::new(RigDesc {
///     joints: vec![Joint::default()],
///     bones: vec![Bone::of(0)],
///     vertices: vec![SkinVertex { position: [1.0, 0.0, 0.0], ..SkinVertex::default() }],
///     clips: vec![Clip { name: "turn".into(), channels: vec![Channel { joint: 0, path: Path::Rotation, curve: turn }] }],
/// })?;
/// assert_eq!(rig.clip_like(&["turn"]), Some(0));
/// let [x, y, _] = rig.pose(0, 0.5).positions[0];
/// assert!(x.abs() < 1e-6 && (y - 1.0).abs() < 1e-6);
/// # Ok::<(), simworld_core::asset::RigError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "RigDesc", into = "RigDesc")]
pub struct Rig {
    desc: RigDesc,
    measures: Measures,
}

/// What a [`Rig`] is made of.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RigDesc {
    /// What turns and moves, parents before their children.
    pub joints: Vec<Joint>,
    /// What carries vertices.
    pub bones: Vec<Bone>,
    /// How each vertex of the model is carried, in their order.
    pub vertices: Vec<SkinVertex>,
    /// What it can do.
    pub clips: Vec<Clip>,
}

/// What turns and moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// On what it hangs; on the body if that is none.
    pub parent: Option<u32>,
    /// Where it is on that, while no clip says otherwise.
    pub rest: Local,
}

/// Where a joint is on its parent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Local {
    /// Scaled, then turned, then moved.
    Parts {
        /// Units of the parent.
        translation: [f64; 3],
        /// Quaternion, x, y, z, w; of any length but 0.
        rotation: [f64; 4],
        /// Factors.
        scale: [f64; 3],
    },
    /// By a matrix, column by column: no clip moves such a joint.
    Matrix([f64; 16]),
}

impl Local {
    /// Exactly where its parent is.
    pub const IDENTITY: Self =
        Self::Parts { translation: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0], scale: [1.0; 3] };
}

impl Default for Local {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// What carries vertices: a joint, and where a vertex is from there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bone {
    /// Which joint.
    pub joint: u32,
    /// From the vertex's frame to the joint's, the inverse bind matrix, column by column.
    pub joint_from_skin: [f64; 16],
}

impl Bone {
    /// A bone of a joint whose vertices are told in the joint's frame.
    pub const fn of(joint: u32) -> Self {
        let mut identity = [0.0; 16];
        (identity[0], identity[5], identity[10], identity[15]) = (1.0, 1.0, 1.0, 1.0);
        Self { joint, joint_from_skin: identity }
    }
}

/// How a vertex is carried.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SkinVertex {
    /// In the frame of the skin.
    pub position: [f32; 3],
    /// In the frame of the skin, of any length; none where it is zero, and then that of the model stands.
    pub normal: [f32; 3],
    /// Which bones carry it.
    pub bones: [u16; 4],
    /// How much each, together 1; those of no share may be any.
    pub weights: [f32; 4],
}

impl Default for SkinVertex {
    /// At the origin of the first bone.
    fn default() -> Self {
        Self { position: [0.0; 3], normal: [0.0; 3], bones: [0; 4], weights: [1.0, 0.0, 0.0, 0.0] }
    }
}

/// Something that a model can do: `walk`, `turn`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Clip {
    /// A name of its own.
    pub name: String,
    /// What moves.
    pub channels: Vec<Channel>,
}

/// A curve that moves one thing about a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Channel {
    /// Which joint.
    pub joint: u32,
    /// What about it.
    pub path: Path,
    /// How it goes on.
    pub curve: Curve,
}

impl Clip {
    /// How long it takes, s: until the last key of its curves.
    pub fn seconds(&self) -> f64 {
        self.channels.iter().map(|channel| channel.curve.end()).fold(0.0, f64::max)
    }

    /// How many poses it has at [`POSE_RATE`].
    pub fn poses(&self) -> u32 {
        // Bounded by what a rig may have; a clip of one key is one pose.
        ((self.seconds() * POSE_RATE).ceil() as u32).max(1)
    }
}

impl Rig {
    /// Checks what a rig is made of, and makes one.
    ///
    /// # Errors
    /// Names of what is not there, numbers that are none, curves that are none, clips that lead away from the origin or are too long; see
    /// [`RigError`].
    pub fn new(desc: RigDesc) -> Result<Self, RigError> {
        check::check(&desc)?;
        let measures = measure::measure(&desc)?;
        Ok(Self { desc, measures })
    }

    /// What it is made of.
    pub const fn desc(&self) -> &RigDesc {
        &self.desc
    }

    /// What it can do.
    pub fn clips(&self) -> &[Clip] {
        &self.desc.clips
    }

    /// The lowest and the highest corner of a box in which it stays in every pose of every clip, body frame, m.
    pub const fn bounds(&self) -> [[f32; 3]; 2] {
        self.measures.bounds
    }

    /// How far from the body's origin it reaches at most, m, at any moment of its clips and on the way from any to any other: as a stretched arm does. No farther than twice
    /// [as far as a model may be](super::LARGEST_MODEL).
    pub const fn reach(&self) -> f64 {
        self.measures.reach
    }

    /// How fast a clip walks, m/s ahead: as fast as its feet go back while they bear, so that they stand where they are on the ground if the body comes as far. `None` where no such speed can be told: of what does
    /// not walk, and of clips that lead the body along.
    pub fn pace(&self, clip: usize) -> Option<f64> {
        self.measures.paces.get(clip).copied().flatten()
    }

    /// The clip of a name, whatever its case.
    pub fn clip(&self, name: &str) -> Option<usize> {
        self.clips().iter().position(|clip| clip.name.eq_ignore_ascii_case(name))
    }

    /// The first clip whose name has one of some words in it, those before others: `Survey_walk` for `walk`.
    pub fn clip_like(&self, words: &[&str]) -> Option<usize> {
        let names: Vec<String> = self.clips().iter().map(|clip| clip.name.to_ascii_lowercase()).collect();
        words.iter().find_map(|word| names.iter().position(|name| name.contains(word)))
    }

    /// Where its vertices are in a clip, so long after it began; at rest if there is no such clip. Before the first key and behind the last it stands
    /// still.
    pub fn pose(&self, clip: usize, seconds: f64) -> PosedModel {
        pose::pose(&self.desc, &pose::locals(&self.desc, self.desc.clips.get(clip), seconds))
    }

    /// Where its vertices are as it is shown.
    pub fn posed(&self, pose: RigPose) -> PosedModel {
        pose::pose(&self.desc, &pose::shown(&self.desc, pose))
    }

    /// Where its vertices are while no clip moves them.
    pub fn rest(&self) -> PosedModel {
        pose::pose(&self.desc, &pose::locals(&self.desc, None, 0.0))
    }

    /// Which way the [tangents](super::Model::tangents) of its model at rest point as it is shown.
    pub fn tangents(&self, rest: &[[f32; 4]], pose: RigPose) -> Vec<[f32; 4]> {
        let skin = self.desc.tangents_of_skin(rest);
        pose::tangents(&self.desc, &skin, &pose::shown(&self.desc, pose))
    }
}

impl RigDesc {
    /// Says which way its vertices face at rest, body frame, one for each in their order: finds their normals in the frame of the skin.
    pub fn face(&mut self, normals: &[[f32; 3]]) {
        pose::face(self, normals);
    }

    /// The [tangents](super::Model::tangents) in the frame of the skin that are these at rest; zeros where there is no way back, as on what is scaled to nothing.
    pub fn tangents_of_skin(&self, rest: &[[f32; 4]]) -> Vec<[f32; 4]> {
        pose::of_skin(self, rest)
    }
}

impl TryFrom<RigDesc> for Rig {
    type Error = RigError;

    fn try_from(desc: RigDesc) -> Result<Self, RigError> {
        Self::new(desc)
    }
}

impl From<Rig> for RigDesc {
    fn from(rig: Rig) -> Self {
        rig.desc
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn turn(axis: usize, angle: f32, seconds: f32) -> Curve {
        let mut key = [0.0; 4];
        (key[axis], key[3]) = ((angle * 0.5).sin(), (angle * 0.5).cos());
        let values = [[0.0, 0.0, 0.0, 1.0], key].concat();
        Curve { interpolation: Interpolation::Linear, times: vec![0.0, seconds], values }
    }

    /// An upper arm of 1 m along x and a forearm of 1 m behind it; three points on it: shoulder, elbow (half and half), hand.
    pub(super) fn arm() -> RigDesc {
        let at = |x: f64| Local::Parts {
            translation: [x, 0.0, 0.0],
            rotation: [0.0, 0.0, 0.0, 1.0],
            scale: [1.0; 3],
        };
        let mut forearm = Bone::of(1);
        forearm.joint_from_skin[12] = -1.0;
        let point = |x: f32, weights: [f32; 4]| SkinVertex {
            position: [x, 0.0, 0.0],
            normal: [0.0, 0.0, 1.0],
            bones: [0, 1, 0, 0],
            weights,
        };
        let bend =
            Channel { joint: 1, path: Path::Rotation, curve: turn(2, std::f32::consts::FRAC_PI_2, 1.0) };
        RigDesc {
            joints: vec![Joint::default(), Joint { parent: Some(0), rest: at(1.0) }],
            bones: vec![Bone::of(0), forearm],
            vertices: vec![
                point(0.0, [1.0, 0.0, 0.0, 0.0]),
                point(1.0, [0.5, 0.5, 0.0, 0.0]),
                point(2.0, [0.0, 1.0, 0.0, 0.0]),
            ],
            clips: vec![Clip { name: "bend".to_owned(), channels: vec![bend] }],
        }
    }

    pub(super) fn is_near(got: [f32; 3], wanted: [f32; 3]) -> bool {
        got.iter().zip(wanted).all(|(got, wanted)| (got - wanted).abs() < 1e-6)
    }

    #[test]
    fn bones_carry_what_hangs_on_them() {
        let rig = Rig::new(arm()).unwrap();
        let rest = rig.rest();
        assert!(is_near(rest.positions[2], [2.0, 0.0, 0.0]));
        let bent = rig.pose(0, 1.0);
        assert!(is_near(bent.positions[0], [0.0; 3]));
        assert!(is_near(bent.positions[1], [1.0, 0.0, 0.0]), "the elbow is where both bones have it");
        assert!(is_near(bent.positions[2], [1.0, 1.0, 0.0]), "{:?}", bent.positions[2]);
        assert!(bent.normals.iter().all(|normal| is_near(*normal, [0.0, 0.0, 1.0])));
        let half = std::f32::consts::FRAC_1_SQRT_2;
        assert!(is_near(rig.pose(0, 0.5).positions[2], [1.0 + half, half, 0.0]));
        assert_eq!(rig.pose(7, 0.5), rest, "there is no such clip");
    }

    #[test]
    fn normals_stay_upright_on_what_is_scaled() {
        let mut desc = arm();
        desc.joints[0].rest =
            Local::Parts { translation: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0], scale: [4.0, 1.0, 1.0] };
        // On a slope of 45 degrees, which becomes one of 1 in 4.
        desc.vertices[0].normal = [-1.0, 0.0, 1.0];
        let normal = Rig::new(desc).unwrap().rest().normals[0];
        let length = (1.0_f32 + 16.0).sqrt();
        assert!(is_near(normal, [-1.0 / length, 0.0, 4.0 / length]), "{normal:?}");
    }

    #[test]
    fn tangents_are_led_by_what_carries_them() {
        let ahead = [[1.0, 0.0, 0.0, 1.0]; 3];
        let is_led = |got: &[f32; 4], wanted: [f32; 4]| {
            is_near([got[0], got[1], got[2]], [wanted[0], wanted[1], wanted[2]]) && got[3] == wanted[3]
        };
        let rig = Rig::new(arm()).unwrap();
        let at = |clip, number| RigPose::at(Some(ClipMoment { clip, number }));
        let bent = rig.tangents(&ahead, at(0, 60));
        assert!(is_led(&bent[0], ahead[0]) && is_led(&bent[2], [0.0, 1.0, 0.0, 1.0]), "{bent:?}");
        let mut desc = arm();
        desc.joints[0].rest =
            Local::Parts { translation: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0], scale: [-2.0, 1.0, 1.0] };
        assert!(is_led(&desc.tangents_of_skin(&ahead)[0], [-1.0, 0.0, 0.0, -1.0]), "the skin is mirrored");
        let rig = Rig::new(desc).unwrap();
        let back = rig.tangents(&ahead, RigPose::REST);
        assert!(back.iter().all(|got| is_led(got, ahead[0])), "and back at rest");
        assert_eq!(rig.tangents(&[[0.0; 4]; 3], at(0, 30)), [[0.0; 4]; 3], "none is none");
    }

    #[test]
    fn rigs_are_written_and_read() {
        let rig = Rig::new(arm()).unwrap();
        let text = serde_json::to_string(&rig).unwrap();
        assert_eq!(serde_json::from_str::<Rig>(&text).unwrap(), rig);
        let wrong = text.replace("\"parent\":0", "\"parent\":7");
        assert!(serde_json::from_str::<Rig>(&wrong).unwrap_err().to_string().contains("parent 7"));
    }

    #[test]
    fn what_is_no_rig_says_so() {
        let is_none = |spoil: fn(&mut RigDesc)| {
            let mut desc = arm();
            spoil(&mut desc);
            Rig::new(desc).unwrap_err()
        };
        assert!(matches!(is_none(|desc| desc.joints.clear()), RigError::Count { what: "joints", .. }));
        assert!(matches!(is_none(|desc| desc.clips.clear()), RigError::Count { what: "clips", .. }));
        assert!(matches!(is_none(|desc| desc.joints[0].parent = Some(0)), RigError::Index { .. }));
        assert!(matches!(is_none(|desc| desc.joints[0].parent = Some(1)), RigError::Index { .. }));
        assert!(matches!(is_none(|desc| desc.bones[1].joint = 2), RigError::Index { .. }));
        assert!(matches!(
            is_none(|desc| desc.bones[1].joint_from_skin[3] = f64::NAN),
            RigError::Number { .. }
        ));
        assert!(matches!(
            is_none(|desc| desc.joints[1].rest = Local::Matrix([f64::NAN; 16])),
            RigError::Number { .. }
        ));
        assert!(matches!(is_none(|desc| desc.vertices[0].position[0] = f32::NAN), RigError::Number { .. }));
        assert!(matches!(is_none(|desc| desc.vertices[1].bones[1] = 2), RigError::Index { .. }));
        assert!(matches!(is_none(|desc| desc.vertices[1].weights[1] = 0.2), RigError::Weights { .. }));
        assert!(matches!(is_none(|desc| desc.vertices[1].weights = [f32::NAN; 4]), RigError::Weights { .. }));
        assert!(matches!(is_none(|desc| desc.clips.push(desc.clips[0].clone())), RigError::Name { .. }));
        assert!(matches!(is_none(|desc| desc.clips[0].name.clear()), RigError::Name { .. }));
        let channel = |spoil: fn(&mut Channel)| {
            let mut desc = arm();
            spoil(&mut desc.clips[0].channels[0]);
            Rig::new(desc).unwrap_err()
        };
        assert!(matches!(channel(|channel| channel.joint = 2), RigError::Index { .. }));
        assert!(matches!(channel(|channel| channel.path = Path::Scale), RigError::Curve { .. }));
        assert!(matches!(channel(|channel| channel.curve.times[1] = 1e9), RigError::Curve { .. }));
        let twice = is_none(|desc| {
            let again = desc.clips[0].channels[0].clone();
            desc.clips[0].channels.push(again);
        });
        assert!(matches!(twice, RigError::Curve { channel: 1, .. }));
        let matrix = is_none(|desc| desc.joints[1].rest = Local::Matrix(Bone::of(0).joint_from_skin));
        assert!(matches!(matrix, RigError::Curve { .. }));
        let far = is_none(|desc| desc.vertices[2].position[0] = 1e7);
        assert!(matches!(far, RigError::Far { .. }), "{far}");
        let long = is_none(|desc| {
            desc.joints.extend(vec![Joint::default(); 5_000]);
            desc.clips[0].channels[0].curve.times[1] = 60.0;
        });
        assert!(matches!(long, RigError::Work { .. }), "{long}");
    }
}
