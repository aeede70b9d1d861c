//! Models as GLB files: one mesh, a primitive and a material for each part, colours at the vertices, pictures as PNG, and how they move.

use serde_json::{Value, json};
use simworld_core::asset::{
    Model, ModelImage, ModelPart, ModelTexture, ModelVertex, Paint, Transparency, Wrap,
};

use super::write_rig::{Written, rig};

/// Targets of buffer views: what vertices have, and indices.
const VERTICES: u32 = 34_962;
const INDICES: u32 = 34_963;

/// Writes a model as a GLB file, y up and z to the front, in metres, with its clips as animations. Hulls are not written; [`read_glb`](super::read_glb) gives
/// its triangles back.
///
/// A part that takes the colour of its entity is written without colours and picture. A picture that has another number of bytes than its
/// size says is left out.
pub fn export_glb(model: &Model) -> Vec<u8> {
    let mut file = File::default();
    let rows = |of: fn(&ModelVertex) -> [f32; 3]| model.vertices.iter().map(of).collect::<Vec<_>>();
    let turned = |[x, y, z]: [f32; 3]| [y, z, x];
    // What a rig carries stands in the frame of its skin.
    let skin = model.rig.as_ref().map(|rig| &rig.desc().vertices);
    let positions: Vec<_> = match skin {
        Some(vertices) => vertices.iter().map(|vertex| vertex.position).collect(),
        None => rows(|vertex| vertex.position).into_iter().map(turned).collect(),
    };
    let normals: Vec<_> = match skin {
        Some(vertices) => vertices.iter().map(|vertex| vertex.normal).collect(),
        None => rows(|vertex| vertex.normal).into_iter().map(turned).collect(),
    };
    file.rig = model.rig.as_ref().map(|own| rig(own.desc(), &mut file));
    let position = file.column(&positions);
    let fold = |from: f32, pick: fn(f32, f32) -> f32| -> [f32; 3] {
        std::array::from_fn(|axis| positions.iter().map(|row| row[axis]).fold(from, pick))
    };
    file.bound(position, json!(fold(f32::INFINITY, f32::min)), json!(fold(f32::NEG_INFINITY, f32::max)));
    let normal = file.column(&normals);
    let color = if model.vertices.iter().all(|vertex| vertex.alpha >= 1.0) {
        file.column(&rows(|vertex| vertex.color))
    } else {
        let with_alpha = |ModelVertex { color: [r, g, b], alpha, .. }: &ModelVertex| [*r, *g, *b, *alpha];
        file.column(&model.vertices.iter().map(with_alpha).collect::<Vec<_>>())
    };
    let has_pictures = |part: &ModelPart| part.texture.is_some() || part.pictures.all().next().is_some();
    let is_textured = model.parts.iter().any(has_pictures);
    let place = is_textured
        .then(|| file.column(&model.vertices.iter().map(|vertex| vertex.place).collect::<Vec<_>>()));
    let tangents = tangents(model, &mut file);
    let pictures: Vec<Option<usize>> = model.images.iter().map(|image| file.picture(image)).collect();
    for (part, triangles) in model.runs().filter(|(_, triangles)| !triangles.is_empty()) {
        let corners = triangles.as_flattened();
        let view = file.append(corners.iter().flat_map(|x| x.to_le_bytes()), Some(INDICES));
        let indices = file.accessor_of(view, 5125, corners.len(), "SCALAR");
        let mut attributes = json!({"POSITION": position, "NORMAL": normal});
        if let Some(Written { joints, weights, .. }) = &file.rig {
            attributes["JOINTS_0"] = json!(joints);
            attributes["WEIGHTS_0"] = json!(weights);
        }
        if part.paint == Paint::Own {
            attributes["COLOR_0"] = json!(color);
        }
        if let (Some(place), true) = (place, has_pictures(part)) {
            attributes["TEXCOORD_0"] = json!(place);
        }
        let is_laid =
            |corner: &u32| model.tangents.get(*corner as usize).is_some_and(|[.., side]| *side != 0.0);
        if let (Some(tangents), true) = (tangents, corners.iter().all(is_laid)) {
            attributes["TANGENT"] = json!(tangents);
        }
        let material = file.material(part, &pictures);
        file.primitives
            .push(json!({"attributes": attributes, "indices": indices, "material": material, "mode": 4}));
    }
    file.pack()
}

/// Adds the tangents of vertices, where a model has some; the number of their accessor. Those without one, which no primitive that has them uses, get one all the
/// same, since a tangent has a length.
fn tangents(model: &Model, file: &mut File) -> Option<usize> {
    if model.tangents.is_empty() {
        return None;
    }
    let turned = |[x, y, z, side]: &[f32; 4]| [*y, *z, *x, *side];
    let own: Vec<[f32; 4]> = match &model.rig {
        Some(rig) => rig.desc().tangents_of_skin(&model.tangents),
        None => model.tangents.iter().map(turned).collect(),
    };
    let some = |tangent: [f32; 4]| if tangent[3] == 0.0 { [1.0, 0.0, 0.0, 1.0] } else { tangent };
    Some(file.column(&own.into_iter().map(some).collect::<Vec<_>>()))
}

/// A file as it grows.
#[derive(Default)]
pub(super) struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    primitives: Vec<Value>,
    materials: Vec<Value>,
    images: Vec<Value>,
    textures: Vec<Value>,
    samplers: Vec<Value>,
    /// Whether something shines brighter than a factor can say.
    shines: bool,
    rig: Option<Written>,
}

impl File {
    /// Adds rows of real numbers of vertices; the number of their accessor.
    pub(super) fn column<const N: usize>(&mut self, rows: &[[f32; N]]) -> usize {
        let view = self.append(rows.iter().flatten().flat_map(|x| x.to_le_bytes()), Some(VERTICES));
        self.accessor_of(view, 5126, rows.len(), &format!("VEC{N}"))
    }

    /// Adds so many rows of numbers of a component type; the number of their accessor.
    pub(super) fn accessor(&mut self, bytes: Vec<u8>, kind: u32, count: usize, shape: &str) -> usize {
        let view = self.append(bytes, None);
        self.accessor_of(view, kind, count, shape)
    }

    fn accessor_of(&mut self, view: usize, kind: u32, count: usize, shape: &str) -> usize {
        self.accessors
            .push(json!({"bufferView": view, "componentType": kind, "count": count, "type": shape}));
        self.accessors.len() - 1
    }

    /// Says between what the numbers of an accessor are.
    pub(super) fn bound(&mut self, accessor: usize, least: Value, most: Value) {
        self.accessors[accessor]["min"] = least;
        self.accessors[accessor]["max"] = most;
    }

    /// Adds bytes to the buffer, from a multiple of four on, and a view of them; the view's number.
    fn append(&mut self, more: impl IntoIterator<Item = u8>, target: Option<u32>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let start = self.bytes.len();
        self.bytes.extend(more);
        let mut view = json!({"buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start});
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.views.len() - 1
    }

    /// Adds a picture as PNG; its number, if it is one.
    fn picture(&mut self, image: &ModelImage) -> Option<usize> {
        let png = image.is_whole().then(|| png_of(image).ok()).flatten()?;
        let view = self.append(png, None);
        self.images.push(json!({"bufferView": view, "mimeType": "image/png"}));
        Some(self.images.len() - 1)
    }

    /// Adds a texture; its number, if its picture is one.
    fn texture(&mut self, texture: ModelTexture, pictures: &[Option<usize>]) -> Option<usize> {
        let picture = pictures.get(texture.image as usize)?.as_ref()?;
        let [right, down] = texture.wrap.map(|wrap| match wrap {
            Wrap::Repeat => 10_497,
            Wrap::Mirror => 33_648,
            Wrap::Clamp => 33_071,
        });
        self.samplers.push(json!({"wrapS": right, "wrapT": down}));
        self.textures.push(json!({"source": picture, "sampler": self.samplers.len() - 1}));
        Some(self.textures.len() - 1)
    }

    /// Adds the material of a part; its number.
    fn material(&mut self, part: &ModelPart, pictures: &[Option<usize>]) -> usize {
        let finish = &part.finish;
        let mut pbr = json!({"metallicFactor": finish.metallic, "roughnessFactor": finish.roughness});
        let own = part.texture.filter(|_| part.paint == Paint::Own);
        let mut lay = |texture: Option<ModelTexture>| self.texture(texture?, pictures);
        if let Some(index) = lay(own) {
            pbr["baseColorTexture"] = json!({"index": index});
        }
        if let Some(index) = lay(part.pictures.metal) {
            pbr["metallicRoughnessTexture"] = json!({"index": index});
        }
        let mut material = json!({"name": part.name});
        if let Some(index) = lay(part.pictures.emission) {
            material["emissiveTexture"] = json!({"index": index});
        }
        if let Some(index) = lay(part.pictures.shade) {
            material["occlusionTexture"] = json!({"index": index, "strength": part.pictures.shade_strength});
        }
        if let Some(index) = lay(part.pictures.bumps) {
            material["normalTexture"] = json!({"index": index, "scale": part.pictures.bump_scale});
        }
        material["pbrMetallicRoughness"] = pbr;
        match part.transparency {
            Transparency::Opaque => {}
            Transparency::Cutout { cutoff } => {
                material["alphaMode"] = json!("MASK");
                material["alphaCutoff"] = json!(cutoff);
            }
            Transparency::Blend => material["alphaMode"] = json!("BLEND"),
        }
        if part.two_sided {
            material["doubleSided"] = json!(true);
        }
        let brightest = finish.emission.iter().copied().fold(0.0, f32::max);
        if brightest > 1.0 {
            self.shines = true;
            material["emissiveFactor"] = json!(finish.emission.map(|light| light / brightest));
            material["extensions"] =
                json!({"KHR_materials_emissive_strength": {"emissiveStrength": brightest}});
        } else if brightest > 0.0 {
            material["emissiveFactor"] = json!(finish.emission);
        }
        self.materials.push(material);
        self.materials.len() - 1
    }

    /// The container: every chunk is filled up to a multiple of four bytes.
    fn pack(self) -> Vec<u8> {
        let mut document = json!({
            "asset": {"version": "2.0", "generator": concat!("simworld ", env!("CARGO_PKG_VERSION"))},
            "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": self.primitives}], "materials": self.materials,
            "accessors": self.accessors, "bufferViews": self.views, "buffers": [{"byteLength": self.bytes.len()}],
        });
        if let Some(Written { nodes, skins, animations, .. }) = self.rig {
            document["scenes"] = json!([{"nodes": [0, 1]}]);
            document["nodes"] = json!(nodes);
            document["skins"] = skins;
            document["animations"] = json!(animations);
        }
        if !self.textures.is_empty() {
            document["samplers"] = json!(self.samplers);
            document["textures"] = json!(self.textures);
        }
        if !self.images.is_empty() {
            document["images"] = json!(self.images);
        }
        if self.shines {
            document["extensionsUsed"] = json!(["KHR_materials_emissive_strength"]);
        }
        let mut bytes = self.bytes;
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        let length = 12 + 8 + text.len() + 8 + bytes.len();
        let mut file = Vec::with_capacity(length);
        for word in [0x4654_6C67, 2, length as u32, text.len() as u32, 0x4E4F_534A] {
            file.extend(u32::to_le_bytes(word));
        }
        file.extend(text);
        for word in [bytes.len() as u32, 0x004E_4942] {
            file.extend(u32::to_le_bytes(word));
        }
        file.extend(bytes);
        file
    }
}

fn png_of(image: &ModelImage) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, image.width, image.height);
    if image.alpha.is_empty() {
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header()?.write_image_data(&image.pixels)?;
    } else {
        encoder.set_color(png::ColorType::Rgba);
        let colors = image.pixels.as_chunks::<3>().0.iter().zip(&image.alpha);
        let whole: Vec<u8> = colors.flat_map(|([r, g, b], alpha)| [*r, *g, *b, *alpha]).collect();
        encoder.write_header()?.write_image_data(&whole)?;
    }
    Ok(file)
}
