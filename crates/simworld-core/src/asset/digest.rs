//! Content addresses: what an asset is, in 128 bits.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{
    Asset, Channel, Finish, Joint, Local, Model, ModelPart, ModelTexture, Pictures, RigDesc, Season,
    Transparency,
};
use crate::hash::StateHasher;

/// The content address of an asset or of a file: XXH3 with 128 bits, 32 hex digits in files.
///
/// Equal content has an equal address. It finds what was changed or mixed up; it is no seal against somebody who forges both
/// content and address.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct ContentId(pub u128);

/// Text that is no content address.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{text:?} is no content address: give 32 hex digits")]
pub struct ContentIdError {
    /// What was given.
    pub text: String,
}

impl ContentId {
    /// The address of raw bytes.
    pub fn of_bytes(bytes: &[u8]) -> Self {
        Self(StateHasher::new().bytes(bytes).finish_wide())
    }
}

impl fmt::Display for ContentId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl FromStr for ContentId {
    type Err = ContentIdError;

    fn from_str(text: &str) -> Result<Self, ContentIdError> {
        let is_hex = text.len() == 32 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let parsed = is_hex.then(|| u128::from_str_radix(text, 16).ok()).flatten();
        parsed.map(Self).ok_or_else(|| ContentIdError { text: text.chars().take(64).collect() })
    }
}

impl TryFrom<String> for ContentId {
    type Error = ContentIdError;

    fn try_from(text: String) -> Result<Self, ContentIdError> {
        text.parse()
    }
}

impl From<ContentId> for String {
    fn from(id: ContentId) -> Self {
        id.to_string()
    }
}

impl Asset {
    /// Its content address: of everything but its name, so that the same thing under two names is known as one.
    pub fn content_id(&self) -> ContentId {
        let mut hasher = StateHasher::new();
        hasher.u64(self.kind as u64).u64(self.place.map_or(u64::MAX, |place| place as u64));
        self.collider.state_hash(&mut hasher);
        hasher.f64(self.mass.unwrap_or(0.0)).u64(self.material.map_or(u64::MAX, |material| material as u64));
        color(&mut hasher, self.color);
        match self.affordances {
            None => hasher.u64(u64::MAX),
            Some(set) => {
                set.iter().fold(hasher.u64(set.iter().count() as u64), |hasher, one| hasher.u64(one as u64))
            }
        };
        for season in Season::ALL {
            color(&mut hasher, self.seasons.map(|seasons| seasons.color(season)));
        }
        hasher.u64(self.tags.len() as u64);
        for tag in &self.tags {
            hasher.str(tag);
        }
        hasher.str(&self.source).str(&self.licence);
        hasher.u64(u64::from(self.model.is_some()));
        if let Some(model) = &self.model {
            content_of(model, &mut hasher);
        }
        ContentId(hasher.finish_wide())
    }
}

fn color(hasher: &mut StateHasher, color: Option<[f32; 3]>) {
    hasher.u64(u64::from(color.is_some()));
    for channel in color.iter().flatten() {
        hasher.f64(f64::from(*channel));
    }
}

fn triple(hasher: &mut StateHasher, numbers: &[f32; 3]) {
    for number in numbers {
        hasher.bytes(&number.to_bits().to_le_bytes());
    }
}

fn part_of(part: &ModelPart, hasher: &mut StateHasher) {
    hasher.str(&part.name).u64(u64::from(part.triangles)).u64(part.paint as u64);
    let Finish { metallic, roughness, emission } = part.finish;
    triple(hasher, &[metallic, roughness, 0.0]);
    triple(hasher, &emission);
    let (kind, cutoff) = match part.transparency {
        Transparency::Opaque => (0, 0.0),
        Transparency::Cutout { cutoff } => (1, cutoff),
        Transparency::Blend => (2, 0.0),
    };
    let Pictures { metal, emission, shade, shade_strength, bumps, bump_scale } = part.pictures;
    // Parts of one side are known as they were before there were others.
    let kind = kind + if part.two_sided { 4 } else { 0 };
    triple(hasher.u64(kind), &[cutoff, shade_strength, bump_scale]);
    for texture in [part.texture, metal, emission, shade, bumps] {
        let Some(ModelTexture { image, wrap }) = texture else {
            hasher.u64(u64::MAX);
            continue;
        };
        wrap.iter().fold(hasher.u64(u64::from(image)), |hasher, wrap| hasher.u64(*wrap as u64));
    }
}

fn content_of(model: &Model, hasher: &mut StateHasher) {
    hasher.u64(model.vertices.len() as u64);
    for vertex in &model.vertices {
        for numbers in [&vertex.position, &vertex.normal, &vertex.color] {
            triple(hasher, numbers);
        }
        let [right, down] = vertex.place;
        triple(hasher, &[right, down, vertex.alpha]);
    }
    hasher.u64(model.triangles.len() as u64);
    for corner in model.triangles.iter().flatten() {
        hasher.bytes(&corner.to_le_bytes());
    }
    hasher.u64(model.parts.len() as u64);
    for part in &model.parts {
        part_of(part, hasher);
    }
    hasher.u64(model.hulls.len() as u64);
    for hull in &model.hulls {
        hasher.u64(hull.points.len() as u64);
        for point in &hull.points {
            triple(hasher, point);
        }
    }
    hasher.u64(model.images.len() as u64);
    for image in &model.images {
        hasher.u64(u64::from(image.width)).u64(u64::from(image.height));
        hasher.u64(image.pixels.len() as u64).bytes(&image.pixels);
        hasher.u64(image.alpha.len() as u64).bytes(&image.alpha).u64(image.content as u64);
    }
    hasher.u64(u64::from(model.rig.is_some()));
    if let Some(rig) = &model.rig {
        rig_of(rig.desc(), hasher);
    }
    // Only where there are some: models without are known as they were before there were any.
    if !model.tangents.is_empty() {
        hasher.u64(model.tangents.len() as u64);
        for number in model.tangents.as_flattened() {
            hasher.bytes(&number.to_bits().to_le_bytes());
        }
    }
}

fn rig_of(rig: &RigDesc, hasher: &mut StateHasher) {
    let singles = |hasher: &mut StateHasher, numbers: &[f32]| {
        hasher.u64(numbers.len() as u64);
        for number in numbers {
            hasher.bytes(&number.to_bits().to_le_bytes());
        }
    };
    hasher.u64(rig.joints.len() as u64);
    for Joint { parent, rest } in &rig.joints {
        hasher.u64(parent.map_or(u64::MAX, u64::from));
        let (is_matrix, numbers) = match rest {
            Local::Matrix(columns) => (true, columns.to_vec()),
            Local::Parts { translation, rotation, scale } => {
                (false, translation.iter().chain(rotation).chain(scale).copied().collect())
            }
        };
        numbers.iter().fold(hasher.u64(u64::from(is_matrix)), |hasher, number| hasher.f64(*number));
    }
    hasher.u64(rig.bones.len() as u64);
    for bone in &rig.bones {
        bone.joint_from_skin
            .iter()
            .fold(hasher.u64(u64::from(bone.joint)), |hasher, number| hasher.f64(*number));
    }
    hasher.u64(rig.vertices.len() as u64);
    for vertex in &rig.vertices {
        for numbers in [&vertex.position[..], &vertex.normal, &vertex.weights] {
            singles(hasher, numbers);
        }
        vertex.bones.iter().fold(&mut *hasher, |hasher, bone| hasher.u64(u64::from(*bone)));
    }
    hasher.u64(rig.clips.len() as u64);
    for clip in &rig.clips {
        hasher.str(&clip.name).u64(clip.channels.len() as u64);
        for Channel { joint, path, curve } in &clip.channels {
            hasher.u64(u64::from(*joint)).u64(*path as u64).u64(curve.interpolation as u64);
            singles(hasher, &curve.times);
            singles(hasher, &curve.values);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::sync::Arc;

    use super::*;
    use crate::asset::{
        Affordance, AffordanceSet, Bone, Clip, Content, Curve, Hull, Interpolation, Material, ModelImage,
        ModelVertex, Path, Rig, Seasons, SkinVertex, Wrap,
    };
    use crate::scene::{EntityKind, Place, Shape};

    fn stool() -> Asset {
        Asset::new("stool", EntityKind::Chair, Shape::cuboid(0.4, 0.4, 0.5)).tagged(["seat"])
    }

    fn model(z: f32) -> Model {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, z]];
        let vertex = |position| ModelVertex { position, ..ModelVertex::default() };
        Model {
            vertices: corners.map(vertex).to_vec(),
            triangles: vec![[0, 1, 2]],
            parts: vec![ModelPart { name: "seat".to_owned(), triangles: 1, ..ModelPart::default() }],
            hulls: vec![Hull { points: corners.to_vec() }],
            images: vec![ModelImage { width: 2, height: 1, pixels: vec![9; 6], ..ModelImage::default() }],
            rig: None,
            tangents: Vec::new(),
        }
    }

    /// With a rig of one joint and one clip, as somebody changes it.
    fn moves(model: &mut Model, change: fn(&mut RigDesc)) {
        let curve =
            Curve { interpolation: Interpolation::Linear, times: vec![0.0, 1.0], values: vec![0.0; 6] };
        let channel = Channel { joint: 0, path: Path::Translation, curve };
        let mut desc = RigDesc {
            joints: vec![Joint::default()],
            bones: vec![Bone::of(0)],
            vertices: vec![SkinVertex::default(); model.vertices.len()],
            clips: vec![Clip { name: "go".to_owned(), channels: vec![channel] }],
        };
        change(&mut desc);
        model.rig = Some(Rig::new(desc).unwrap());
    }

    #[test]
    fn the_name_alone_is_no_content() {
        assert_eq!(stool().content_id(), Asset { name: "taboret".to_owned(), ..stool() }.content_id());
    }

    fn lies(model: &mut Model, wrap: [Wrap; 2]) {
        model.parts[0].texture = Some(ModelTexture { image: 0, wrap });
    }

    const SOME: Option<ModelTexture> = Some(ModelTexture { image: 0, wrap: [Wrap::Repeat; 2] });

    #[test]
    fn every_other_field_is_content() {
        let seasons = Seasons { spring: [0.1; 3], summer: [0.2; 3], autumn: [0.3; 3], winter: [0.4; 3] };
        let spoilt = |spoil: fn(&mut Model)| {
            let mut model = model(1.0);
            spoil(&mut model);
            Asset { model: Some(Arc::new(model)), ..stool() }
        };
        let others = [
            stool(),
            Asset { kind: EntityKind::Bench, ..stool() },
            Asset { place: Some(Place::RestArea), ..stool() },
            Asset { collider: Shape::cuboid(0.4, 0.4, 0.6), ..stool() },
            Asset { mass: Some(4.0), ..stool() },
            Asset { material: Some(Material::Wood), ..stool() },
            Asset { color: Some([0.5; 3]), ..stool() },
            Asset { affordances: Some(AffordanceSet::NONE), ..stool() },
            Asset { affordances: Some(AffordanceSet::of(&[Affordance::Sit])), ..stool() },
            Asset { seasons: Some(seasons), ..stool() },
            Asset { seasons: Some(Seasons { winter: [0.5; 3], ..seasons }), ..stool() },
            stool().tagged(["wooden"]),
            Asset { source: "a joiner".to_owned(), ..stool() },
            Asset { licence: "CC0-1.0".to_owned(), ..stool() },
            Asset { model: Some(Arc::new(model(1.0))), ..stool() },
            Asset { model: Some(Arc::new(model(2.0))), ..stool() },
            spoilt(|model| model.vertices[1].place = [0.5, 0.0]),
            spoilt(|model| model.parts[0].finish.metallic = 1.0),
            spoilt(|model| model.parts[0].finish.roughness = 0.2),
            spoilt(|model| model.parts[0].finish.emission[2] = 0.2),
            spoilt(|model| lies(model, [Wrap::Repeat; 2])),
            spoilt(|model| lies(model, [Wrap::Repeat, Wrap::Clamp])),
            spoilt(|model| model.images[0].pixels[5] = 8),
            spoilt(|model| (model.images[0].width, model.images[0].height) = (1, 2)),
            spoilt(|model| model.vertices[1].alpha = 0.5),
            spoilt(|model| model.images[0].alpha = vec![255, 255]),
            spoilt(|model| model.images[0].content = Content::Numbers),
            spoilt(|model| model.parts[0].transparency = Transparency::Blend),
            spoilt(|model| model.parts[0].transparency = Transparency::Cutout { cutoff: 0.0 }),
            spoilt(|model| model.parts[0].transparency = Transparency::Cutout { cutoff: 0.5 }),
            spoilt(|model| model.parts[0].two_sided = true),
            spoilt(|model| model.tangents = vec![[1.0, 0.0, 0.0, 1.0]; 4]),
            spoilt(|model| model.tangents = vec![[1.0, 0.0, 0.0, -1.0]; 4]),
            spoilt(|model| model.parts[0].pictures.metal = SOME),
            spoilt(|model| model.parts[0].pictures.emission = SOME),
            spoilt(|model| model.parts[0].pictures.shade = SOME),
            spoilt(|model| model.parts[0].pictures.bumps = SOME),
            spoilt(|model| model.parts[0].pictures.shade_strength = 0.5),
            spoilt(|model| model.parts[0].pictures.bump_scale = 0.5),
            spoilt(|model| moves(model, |_| {})),
            spoilt(|model| {
                moves(model, |rig| {
                    let rest = Local::Matrix(Bone::of(0).joint_from_skin);
                    rig.joints.push(Joint { parent: Some(0), rest });
                });
            }),
            spoilt(|model| {
                moves(model, |rig| rig.joints.push(Joint { parent: Some(0), ..Joint::default() }));
            }),
            spoilt(|model| moves(model, |rig| rig.bones[0].joint_from_skin[12] = 1.0)),
            spoilt(|model| moves(model, |rig| rig.vertices[0].position[0] = 1.0)),
            spoilt(|model| moves(model, |rig| rig.vertices[0].bones[3] = 1)),
            spoilt(|model| moves(model, |rig| rig.clips[0].name.push('!'))),
            spoilt(|model| moves(model, |rig| rig.clips[0].channels[0].path = Path::Scale)),
            spoilt(|model| moves(model, |rig| rig.clips[0].channels[0].curve.times[1] = 2.0)),
            spoilt(|model| moves(model, |rig| rig.clips[0].channels[0].curve.values[5] = 2.0)),
        ];
        let distinct: BTreeSet<ContentId> = others.iter().map(Asset::content_id).collect();
        assert_eq!(distinct.len(), others.len());
    }

    #[test]
    fn addresses_are_written_and_read() {
        let id = ContentId::of_bytes(b"simworld");
        assert_eq!(id.to_string().parse(), Ok(id));
        assert_eq!(serde_json::from_str::<ContentId>(&serde_json::to_string(&id).unwrap()).unwrap(), id);
        for wrong in ["", "12", "+0000000000000000000000000000001", "zz000000000000000000000000000000"] {
            assert!(wrong.parse::<ContentId>().is_err(), "{wrong:?}");
        }
    }
}
