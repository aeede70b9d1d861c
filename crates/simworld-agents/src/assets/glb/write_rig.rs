//! Rigs in GLB files: joints and bones as nodes, a skin over the bones, an animation for each clip.

use serde_json::{Value, json};
use simworld_core::asset::{Channel, Clip, Interpolation, Local, Path, RigDesc};

use super::write::File;

/// The nodes before the joints: the mesh, and what turns the body to the axes of the file.
const BEFORE: usize = 2;

/// World of glTF from body, column by column: there x is to the left, y up and z to the front.
const FILE_FROM_BODY: [f64; 16] =
    [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];

/// What a document says of a rig.
pub(super) struct Written {
    pub(super) nodes: Vec<Value>,
    pub(super) skins: Value,
    pub(super) animations: Vec<Value>,
    /// The accessors of the attributes of its vertices.
    pub(super) joints: usize,
    pub(super) weights: usize,
}

/// Adds the numbers of a rig to a file.
pub(super) fn rig(rig: &RigDesc, file: &mut File) -> Written {
    let vertices = || rig.vertices.iter();
    let bones: Vec<u8> = vertices().flat_map(|vertex| vertex.bones).flat_map(u16::to_le_bytes).collect();
    let joints = file.accessor(bones, 5123, rig.vertices.len(), "VEC4");
    let weights = file.column(&vertices().map(|vertex| vertex.weights).collect::<Vec<_>>());
    let first_bone = BEFORE + rig.joints.len();
    let skins = json!([{"joints": (first_bone..first_bone + rig.bones.len()).collect::<Vec<_>>()}]);
    let animations = rig.clips.iter().map(|clip| animation(clip, file)).collect();
    Written { nodes: nodes(rig, first_bone), skins, animations, joints, weights }
}

fn nodes(rig: &RigDesc, first_bone: usize) -> Vec<Value> {
    // By joint; those of the body come last.
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); rig.joints.len() + 1];
    for (index, joint) in rig.joints.iter().enumerate() {
        children[joint.parent.map_or(rig.joints.len(), |parent| parent as usize)].push(BEFORE + index);
    }
    for (index, bone) in rig.bones.iter().enumerate() {
        children[bone.joint as usize].push(first_bone + index);
    }
    let with_children = |mut node: Value, children: &[usize]| {
        // An empty list is none in glTF.
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        node
    };
    let joints = rig.joints.iter().zip(&children).map(|(joint, children)| {
        let node = match joint.rest {
            Local::Matrix(matrix) => json!({"matrix": matrix}),
            Local::Parts { translation, rotation, scale } => {
                json!({"translation": translation, "rotation": rotation, "scale": scale})
            }
        };
        with_children(node, children)
    });
    let body = with_children(json!({"matrix": FILE_FROM_BODY}), &children[rig.joints.len()]);
    let bones = rig.bones.iter().map(|bone| json!({"matrix": bone.joint_from_skin}));
    [json!({"mesh": 0, "skin": 0}), body].into_iter().chain(joints).chain(bones).collect()
}

fn animation(clip: &Clip, file: &mut File) -> Value {
    let (mut channels, mut samplers) = (Vec::new(), Vec::new());
    for Channel { joint, path, curve } in &clip.channels {
        let (shape, name) = match path {
            Path::Translation => ("VEC3", "translation"),
            Path::Rotation => ("VEC4", "rotation"),
            Path::Scale => ("VEC3", "scale"),
        };
        let bytes = |numbers: &[f32]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        let input = file.accessor(bytes(&curve.times), 5126, curve.times.len(), "SCALAR");
        file.bound(input, json!([curve.times.first()]), json!([curve.times.last()]));
        let output = file.accessor(bytes(&curve.values), 5126, curve.values.len() / path.width(), shape);
        let interpolation = match curve.interpolation {
            Interpolation::Step => "STEP",
            Interpolation::Linear => "LINEAR",
            Interpolation::Cubic => "CUBICSPLINE",
        };
        let target = json!({"node": BEFORE + *joint as usize, "path": name});
        channels.push(json!({"sampler": samplers.len(), "target": target}));
        samplers.push(json!({"input": input, "output": output, "interpolation": interpolation}));
    }
    json!({"name": clip.name, "channels": channels, "samplers": samplers})
}
