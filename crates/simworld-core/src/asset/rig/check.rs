//! What makes a rig sound.

use std::collections::BTreeSet;

use super::{Channel, Clip, LONGEST_CLIP_NAME, Local, MOST_WORK, POSE_RATE, RigDesc, RigError};

/// Bones that a vertex can name.
const MOST_BONES: usize = 1 << 16;
const MOST_JOINTS: usize = 1 << 16;
const MOST_VERTICES: usize = 1 << 24;
const MOST_CLIPS: usize = 1 << 12;
/// The longest clip, s, whatever it moves.
const LONGEST_CLIP: f64 = 3600.0;
/// By how much the shares of a vertex may be off together.
const SHARES: f32 = 1e-3;

pub(super) fn check(desc: &RigDesc) -> Result<(), RigError> {
    for (what, got, most) in [
        ("joints", desc.joints.len(), MOST_JOINTS),
        ("bones", desc.bones.len(), MOST_BONES),
        ("vertices", desc.vertices.len(), MOST_VERTICES),
        ("clips", desc.clips.len(), MOST_CLIPS),
    ] {
        if got == 0 || got > most {
            return Err(RigError::Count { what, got, most });
        }
    }
    check_bones(desc)?;
    check_vertices(desc)?;
    let mut names = BTreeSet::new();
    for (index, clip) in desc.clips.iter().enumerate() {
        let length = clip.name.chars().count();
        if length == 0 || length > LONGEST_CLIP_NAME || !names.insert(clip.name.to_ascii_lowercase()) {
            return Err(RigError::Name { index, name: clip.name.chars().take(LONGEST_CLIP_NAME).collect() });
        }
        check_clip(desc, clip)?;
    }
    let poses = desc.clips.iter().map(|clip| (clip.seconds() * POSE_RATE) as u64 + 1).sum();
    let joints = desc.joints.len() + desc.bones.len();
    if joints as u64 * poses > MOST_WORK { Err(RigError::Work { poses, joints }) } else { Ok(()) }
}

/// That joints hang from earlier ones, and bones from joints.
fn check_bones(desc: &RigDesc) -> Result<(), RigError> {
    for (index, joint) in desc.joints.iter().enumerate() {
        let parent = joint.parent.map_or(0, |parent| parent as usize);
        if joint.parent.is_some() && parent >= index {
            return Err(RigError::Index {
                what: "joint",
                index,
                named: "parent",
                other: parent,
                count: index,
            });
        }
        let sound = match joint.rest {
            Local::Parts { translation, rotation, scale } => {
                let turns = rotation.iter().map(|part| part * part).sum::<f64>();
                translation.iter().chain(&scale).all(|part| part.is_finite())
                    && turns.is_finite()
                    && turns > 1e-18
            }
            Local::Matrix(matrix) => matrix.iter().all(|part| part.is_finite()),
        };
        if !sound {
            return Err(RigError::Number { what: "joint", index });
        }
    }
    let count = desc.joints.len();
    for (index, bone) in desc.bones.iter().enumerate() {
        let other = bone.joint as usize;
        if other >= count {
            return Err(RigError::Index { what: "bone", index, named: "joint", other, count });
        }
        if !bone.joint_from_skin.iter().all(|part| part.is_finite()) {
            return Err(RigError::Number { what: "bone", index });
        }
    }
    Ok(())
}

fn check_vertices(desc: &RigDesc) -> Result<(), RigError> {
    let count = desc.bones.len();
    for (index, vertex) in desc.vertices.iter().enumerate() {
        if !vertex.position.iter().chain(&vertex.normal).all(|part| part.is_finite()) {
            return Err(RigError::Number { what: "vertex", index });
        }
        let weights = vertex.weights;
        let sum: f32 = weights.iter().sum();
        if !weights.iter().all(|weight| *weight >= 0.0) || !(1.0 - SHARES..=1.0 + SHARES).contains(&sum) {
            return Err(RigError::Weights { index, weights });
        }
        let named = vertex.bones.iter().zip(weights).filter(|(_, weight)| *weight > 0.0);
        if let Some(other) = named.map(|(bone, _)| usize::from(*bone)).find(|bone| *bone >= count) {
            return Err(RigError::Index { what: "vertex", index, named: "bone", other, count });
        }
    }
    Ok(())
}

fn check_clip(desc: &RigDesc, clip: &Clip) -> Result<(), RigError> {
    let count = desc.joints.len();
    let mut moved = BTreeSet::new();
    for (index, Channel { joint, path, curve }) in clip.channels.iter().enumerate() {
        let wrong = |fault| Err(RigError::Curve { clip: clip.name.clone(), channel: index, fault });
        let other = *joint as usize;
        let Some(found) = desc.joints.get(other) else {
            return Err(RigError::Index { what: "channel", index, named: "joint", other, count });
        };
        if matches!(found.rest, Local::Matrix(_)) {
            return wrong("moves a joint that has a matrix: give it translation, rotation and scale");
        }
        if !moved.insert((*joint, *path)) {
            return wrong("moves what another channel of the clip moves already");
        }
        if let Some(fault) = curve.fault(path.width()) {
            return wrong(fault);
        }
        if curve.end() > LONGEST_CLIP {
            return wrong("is longer than an hour");
        }
    }
    Ok(())
}
