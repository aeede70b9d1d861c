//! How a file moves: the joints, bones and clips of a rig, gathered beside its surface.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Matrix4;
use simworld_core::asset::{Bone, Channel, Clip, Joint, LONGEST_CLIP_NAME, Local, RigDesc, SkinVertex};

use super::accessor::Data;
use super::error::GlbError;
use super::limits::GlbLimits;
use super::pose::{Tree, channels};

/// Body from world of glTF, column by column: there x is to the left, y up and z to the front.
const BODY_FROM_FILE: [f64; 16] =
    [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];

/// Whose frame a bone carries vertices in: a node's own, or that of a skin at one of its joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Frame {
    Node(usize),
    Skin { skin: usize, rank: usize },
}

/// Bones and what they carry, as the surface is gathered.
#[derive(Default)]
pub(super) struct Rigging {
    /// Node, and joint from skin.
    bones: Vec<(usize, Matrix4<f64>)>,
    numbers: BTreeMap<Frame, u16>,
    vertices: Vec<SkinVertex>,
}

impl Rigging {
    /// The number of the bone of a frame, which hangs on a node.
    pub(super) fn bone(
        &mut self,
        frame: Frame,
        node: usize,
        joint_from_skin: &Matrix4<f64>,
    ) -> Result<u16, GlbError> {
        if let Some(number) = self.numbers.get(&frame) {
            return Ok(*number);
        }
        let most = u64::from(u16::MAX);
        let number = u16::try_from(self.bones.len()).map_err(|_| GlbError::TooMany {
            what: "joints and nodes with meshes",
            got: most + 1,
            most,
        })?;
        self.bones.push((node, *joint_from_skin));
        self.numbers.insert(frame, number);
        Ok(number)
    }

    /// Adds a vertex with the bones that carry it, the largest share first; four of them are kept.
    pub(super) fn carry(&mut self, position: [f64; 3], shares: impl IntoIterator<Item = (u16, f64)>) {
        let mut vertex = SkinVertex { position: position.map(|part| part as f32), ..SkinVertex::default() };
        vertex.weights = [0.0; 4];
        let slots = vertex.bones.iter_mut().zip(&mut vertex.weights);
        for ((slot, weight), (bone, share)) in slots.zip(shares) {
            (*slot, *weight) = (bone, share as f32);
        }
        let kept: f32 = vertex.weights.iter().sum();
        vertex.weights.iter_mut().for_each(|weight| *weight /= kept);
        self.vertices.push(vertex);
    }

    /// The rig, if an animation of the file moves something that is seen. Vertices have no normals yet.
    pub(super) fn finish(
        self,
        data: Data<'_>,
        limits: &GlbLimits,
        tree: &Tree,
    ) -> Result<Option<RigDesc>, GlbError> {
        let mut skeleton = Skeleton::new();
        for (node, _) in &self.bones {
            skeleton.hang(tree, *node);
        }
        let (mut clips, mut names, mut used) = (Vec::new(), BTreeSet::new(), 0);
        for (index, animation) in data.document.animations.iter().enumerate() {
            let moved = channels(data, limits, index, &mut used)?;
            let seen = moved.into_iter().filter_map(|moved| {
                let joint = *skeleton.numbers.get(&moved.node)?;
                Some(Channel { joint, path: moved.path, curve: moved.curve })
            });
            let channels: Vec<Channel> = seen.collect();
            if !channels.is_empty() {
                let name = free_name(animation.name.as_deref().unwrap_or_default(), index, &mut names);
                clips.push(Clip { name, channels });
            }
        }
        if clips.is_empty() {
            return Ok(None);
        }
        let bone = |(node, matrix): &(usize, Matrix4<f64>)| {
            let joint_from_skin = std::array::from_fn(|index| matrix.as_slice()[index]);
            Bone { joint: skeleton.numbers[node], joint_from_skin }
        };
        let bones = self.bones.iter().map(bone).collect();
        Ok(Some(RigDesc { joints: skeleton.joints, bones, vertices: self.vertices, clips }))
    }
}

/// The nodes on which bones hang, as joints; the first turns the file to the axes of the body.
struct Skeleton {
    joints: Vec<Joint>,
    /// By node.
    numbers: BTreeMap<usize, u32>,
}

impl Skeleton {
    fn new() -> Self {
        let turned = Joint { parent: None, rest: Local::Matrix(BODY_FROM_FILE) };
        Self { joints: vec![turned], numbers: BTreeMap::new() }
    }

    /// Adds a node behind all that it hangs on.
    fn hang(&mut self, tree: &Tree, node: usize) {
        let mut way = Vec::new();
        let mut next = Some(node);
        // No ring: the tree was walked from its roots.
        while let Some(node) = next.filter(|node| !self.numbers.contains_key(node)) {
            way.push(node);
            next = tree.parents[node];
        }
        for node in way.into_iter().rev() {
            let above = tree.parents[node].and_then(|parent| self.numbers.get(&parent));
            let parent = Some(above.copied().unwrap_or(0));
            self.numbers.insert(node, self.joints.len() as u32);
            self.joints.push(Joint { parent, rest: tree.locals[node] });
        }
    }
}

/// What a clip is called: as in the file, if that is a name that no other has.
fn free_name(given: &str, index: usize, taken: &mut BTreeSet<String>) -> String {
    let said: String = given.chars().filter(|c| !c.is_control()).take(LONGEST_CLIP_NAME - 8).collect();
    let said = if said.trim().is_empty() { format!("clip {index}") } else { said.trim().to_owned() };
    let numbered = (2_u32..).map(|number| format!("{said} {number}"));
    let mut names = std::iter::once(said.clone()).chain(numbered);
    // One of endlessly many is free.
    names.find(|name| taken.insert(name.to_ascii_lowercase())).unwrap_or_default()
}
