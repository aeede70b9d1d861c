//! A mill of boxes whose sails turn, as somebody would model it.

use simworld_core::asset::{
    Bone, Channel, Clip, Curve, Interpolation, Joint, Local, Model, ModelPart, ModelVertex, Path, Rig,
    RigDesc, RigError, SkinVertex,
};

/// Where the axle of the sails is, body frame, m.
const AXLE: [f32; 3] = [1.5, 0.0, 5.4];
/// How long the sails take to turn once, s.
const TURN: f32 = 6.0;

/// A tower with a cap, and four sails on an axle to its front, which turn in the clip `turn`.
///
/// # Errors
/// None, as long as its joints are sound.
pub fn mill() -> Result<Model, RigError> {
    let mut made = Made::default();
    made.taper("tower", [1.5, 1.05], [0.0, 4.8], [0.72, 0.68, 0.6]);
    made.taper("cap", [1.25, 0.3], [4.8, 6.4], [0.16, 0.1, 0.07]);
    made.slab("door", [1.2, -0.4, 0.0], [1.55, 0.4, 1.7], [0.09, 0.17, 0.11], 0);
    made.slab("axle", [0.4, -0.14, 5.26], [1.85, 0.14, 5.54], [0.12, 0.08, 0.05], 1);
    for sail in 0..4 {
        made.sail(sail);
    }
    let mut desc = RigDesc {
        joints: vec![Joint::default(), axle()],
        bones: vec![Bone::of(0), carried_by_axle()],
        vertices: made.skin,
        clips: vec![Clip {
            name: "turn".to_owned(),
            channels: vec![Channel { joint: 1, path: Path::Rotation, curve: turn() }],
        }],
    };
    let normals: Vec<[f32; 3]> = made.model.vertices.iter().map(|vertex| vertex.normal).collect();
    desc.face(&normals);
    made.model.rig = Some(Rig::new(desc)?);
    Ok(made.model)
}

fn axle() -> Joint {
    let rest =
        Local::Parts { translation: AXLE.map(f64::from), rotation: [0.0, 0.0, 0.0, 1.0], scale: [1.0; 3] };
    Joint { parent: Some(0), rest }
}

/// Its vertices are told in the body frame.
fn carried_by_axle() -> Bone {
    let mut bone = Bone::of(1);
    for (axis, place) in AXLE.into_iter().enumerate() {
        bone.joint_from_skin[12 + axis] = -f64::from(place);
    }
    bone
}

/// Once around the axle, in four keys and back to the first.
fn turn() -> Curve {
    let key = |quarter: u32| {
        let half = f64::from(quarter) * std::f64::consts::FRAC_PI_4;
        let (sine, cosine) = simworld_core::ops::sin_cos(half);
        [sine as f32, 0.0, 0.0, cosine as f32]
    };
    Curve {
        interpolation: Interpolation::Linear,
        times: (0..5_u8).map(|quarter| f32::from(quarter) * TURN / 4.0).collect(),
        values: (0..5).flat_map(key).collect(),
    }
}

/// A model as it grows, with which bone carries each vertex.
#[derive(Default)]
struct Made {
    model: Model,
    skin: Vec<SkinVertex>,
}

impl Made {
    /// A tower of eight sides, so wide below and above.
    fn taper(&mut self, name: &str, radii: [f32; 2], heights: [f32; 2], color: [f32; 3]) {
        let at = |side: u32, end: usize| {
            let turn = f64::from(side) * std::f64::consts::FRAC_PI_4 + std::f64::consts::FRAC_PI_8;
            let (sine, cosine) = simworld_core::ops::sin_cos(turn);
            [radii[end] * cosine as f32, radii[end] * sine as f32, heights[end]]
        };
        let top = (0..8).map(|side| at(side, 1));
        let bottom = (0..8).rev().map(|side| at(side, 0));
        let mut faces: Vec<Vec<[f32; 3]>> = vec![top.collect(), bottom.collect()];
        faces.extend((0..8).map(|side| vec![at(side, 0), at(side + 1, 0), at(side + 1, 1), at(side, 1)]));
        self.add(name, &faces, color, 0);
    }

    fn slab(&mut self, name: &str, low: [f32; 3], high: [f32; 3], color: [f32; 3], bone: u16) {
        self.solid(
            name,
            |k| std::array::from_fn(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] }),
            color,
            bone,
        );
    }

    /// A sail: a lattice on a stock, a little aslant to the wind.
    fn sail(&mut self, number: u32) {
        let (sine, cosine) = simworld_core::ops::sin_cos(f64::from(number) * std::f64::consts::FRAC_PI_2);
        let placed = |[ahead, across, out]: [f32; 3]| {
            let (across, out) = (f64::from(across), f64::from(out));
            let [left, up] = [across * cosine - out * sine, across * sine + out * cosine];
            [AXLE[0] + ahead, AXLE[1] + left as f32, AXLE[2] + up as f32]
        };
        let slanted = |k: u32, [low, high]: [[f32; 3]; 2]| {
            let [ahead, across, out]: [f32; 3] =
                std::array::from_fn(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
            placed([ahead + 0.25 * across, across, out])
        };
        let stock = [[0.12, -0.07, 0.1], [0.26, 0.07, 4.2]];
        self.solid("stock", |k| slanted(k, stock), [0.12, 0.08, 0.05], 1);
        let cloth = [[0.17, 0.07, 1.0], [0.21, 0.95, 4.1]];
        self.solid("sail", |k| slanted(k, cloth), [0.75, 0.7, 0.6], 1);
    }

    /// A box by its corners, whose bits say which end of each axis they are at.
    fn solid(&mut self, name: &str, corner: impl Fn(u32) -> [f32; 3], color: [f32; 3], bone: u16) {
        const FACES: [[u32; 4]; 6] =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        self.add(name, &FACES.map(|face| face.map(&corner).to_vec()), color, bone);
    }

    /// Adds flat faces, counter-clockwise from outside.
    fn add(&mut self, name: &str, faces: &[Vec<[f32; 3]>], color: [f32; 3], bone: u16) {
        let before = self.model.triangles.len();
        for face in faces {
            let first = self.model.vertices.len() as u32;
            let normal = normal_of(face);
            for position in face.iter().copied() {
                self.model.vertices.push(ModelVertex { position, normal, color, ..ModelVertex::default() });
                self.skin.push(SkinVertex { position, bones: [bone, 0, 0, 0], ..SkinVertex::default() });
            }
            let fan = |corner: u32| [first, first + corner, first + corner + 1];
            self.model.triangles.extend((1..face.len() as u32 - 1).map(fan));
        }
        let triangles = (self.model.triangles.len() - before) as u32;
        self.model.parts.push(ModelPart { name: name.to_owned(), triangles, ..ModelPart::default() });
    }
}

fn normal_of(face: &[[f32; 3]]) -> [f32; 3] {
    let [a, b, c] = [face[0], face[1], face[2]].map(nalgebra::Vector3::from);
    (b - a).cross(&(c - a)).try_normalize(1e-12).unwrap_or_default().into()
}
