//! Materials of files: metal, roughness, light of their own, and pictures that stay pictures; what is none is refused.
// what fails here fails the test
#![allow(clippy::unwrap_used)]

use crate::assets_common::{container, cuboid, halves, painted, painted_document, plain_model, thing};
use proptest::prelude::*;
use serde_json::{Value, json};
use simworld_agents::assets::{
    GlbError, GlbLimits, ImportConfig, Surface, Unit, export_glb, import_glb, read_glb,
};
use simworld_core::asset::{
    Content, Finish, ModelImage, ModelPart, ModelTexture, Paint, Pictures, Transparency, Wrap,
};

fn read(document: &Value, bytes: &[u8]) -> Result<Surface, GlbError> {
    read_glb(&container(document, bytes), &GlbLimits::default())
}

/// How a cube of that material takes light.
fn finish(material: &Value) -> Finish {
    let (mut document, bytes) = plain_model(&cuboid([0.0; 3], [1.0; 3]));
    document["materials"] = json!([material]);
    document["meshes"][0]["primitives"][0]["material"] = json!(0);
    read(&document, &bytes).unwrap().parts[0].finish
}

#[test]
fn factors_are_those_of_the_material() {
    let dull = Finish::default();
    let of = |metallic, roughness| Finish { metallic, roughness, ..dull };
    for (material, expected) in [
        (json!({}), dull),
        // What glTF has where a material says nothing of its metal.
        (json!({"pbrMetallicRoughness": {}}), of(1.0, 1.0)),
        (json!({"pbrMetallicRoughness": {"metallicFactor": 0.25, "roughnessFactor": 0.5}}), of(0.25, 0.5)),
        (json!({"pbrMetallicRoughness": {"metallicFactor": 7.0, "roughnessFactor": -1.0}}), of(1.0, 0.0)),
        (json!({"pbrMetallicRoughness": {}, "extensions": {"KHR_materials_unlit": {}}}), dull),
        (json!({"emissiveFactor": [1.0, 0.5, 0.0]}), Finish { emission: [1.0, 0.5, 0.0], ..dull }),
        (
            json!({
                "emissiveFactor": [1.0, 0.5, 0.0],
                "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4.0}},
            }),
            Finish { emission: [4.0, 2.0, 0.0], ..dull },
        ),
        (
            json!({
                "emissiveFactor": [1.0, 1.0, 1.0],
                "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1e300}},
            }),
            Finish { emission: [1000.0; 3], ..dull },
        ),
    ] {
        assert_eq!(finish(&material), expected, "{material}");
    }
}

fn png(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(pixels).unwrap();
    png
}

/// A picture of metal alone: green says roughness and blue metal, 51 of 255, and 102; on the right 255 of both.
fn of_metal() -> (Value, Vec<u8>) {
    let (mut document, bytes) = painted_document(&png(2, 1, &[0, 51, 102, 9, 255, 255]));
    let pbr = &mut document["materials"][0]["pbrMetallicRoughness"];
    let texture = pbr.as_object_mut().unwrap().remove("baseColorTexture").unwrap();
    pbr["metallicRoughnessTexture"] = texture;
    pbr["roughnessFactor"] = json!(0.5);
    (document, bytes)
}

/// A picture of light alone.
fn of_light() -> (Value, Vec<u8>) {
    let (mut document, bytes) = painted_document(&halves());
    let material = &mut document["materials"][0];
    let texture =
        material["pbrMetallicRoughness"].as_object_mut().unwrap().remove("baseColorTexture").unwrap();
    material["emissiveTexture"] = texture;
    material["emissiveFactor"] = json!([0.5, 1.0, 1.0]);
    (document, bytes)
}

#[test]
fn pictures_of_metal_and_light_that_do_not_stay_are_taken_at_their_mean() {
    let mean = |(document, bytes): (Value, Vec<u8>)| {
        let limits = GlbLimits { texture: 0, ..GlbLimits::default() };
        let surface = read_glb(&container(&document, &bytes), &limits).unwrap();
        assert!(surface.images.is_empty() && surface.parts[0].pictures == Pictures::default());
        surface.parts[0].finish
    };
    let Finish { metallic, roughness, .. } = mean(of_metal());
    assert!((metallic - 0.7).abs() < 1e-6 && (roughness - 0.3).abs() < 1e-6, "{metallic} {roughness}");
    let [red, green, blue] = mean(of_light()).emission;
    // Half of the surface is red, the other half has the light of sRGB 188.
    assert!(
        (red - 0.25).abs() < 1e-6 && green == 0.0 && (blue - 0.2515).abs() < 1e-3,
        "{red} {green} {blue}"
    );
}

#[test]
fn pictures_of_metal_and_light_stay_pictures() {
    let first = Some(ModelTexture { image: 0, wrap: [Wrap::Repeat; 2] });
    let (document, bytes) = of_metal();
    let surface = read(&document, &bytes).unwrap();
    let part = &surface.parts[0];
    assert_eq!((part.finish.metallic, part.finish.roughness), (1.0, 0.5), "factors of the picture");
    assert_eq!((part.texture, part.pictures.metal), (None, first));
    assert_eq!((surface.images[0].content, surface.images[0].pixels.len()), (Content::Numbers, 6));
    assert_eq!((surface.places[0], surface.places[8]), ([0.25, 0.5], [0.75, 0.5]));

    let (document, bytes) = of_light();
    let surface = read(&document, &bytes).unwrap();
    assert_eq!(surface.parts[0].finish.emission, [0.5, 1.0, 1.0]);
    assert_eq!((surface.parts[0].pictures.emission, surface.images[0].content), (first, Content::Color));
}

/// One picture for three kinds is there twice: as colours, and as numbers.
#[test]
fn pictures_are_kept_by_what_they_hold() {
    let (mut document, bytes) = painted_document(&halves());
    let material = &mut document["materials"][0];
    material["normalTexture"] = json!({"index": 0, "scale": 0.5});
    material["occlusionTexture"] = json!({"index": 0, "strength": 0.25});
    let surface = read(&document, &bytes).unwrap();
    let pictures = surface.parts[0].pictures;
    let texture = |image| Some(ModelTexture { image, wrap: [Wrap::Repeat; 2] });
    assert_eq!(
        (surface.parts[0].texture, pictures.shade, pictures.bumps),
        (texture(0), texture(1), texture(1))
    );
    assert_eq!((pictures.shade_strength, pictures.bump_scale), (0.25, 0.5));
    assert_eq!(
        surface.images.iter().map(|image| image.content).collect::<Vec<_>>(),
        [Content::Color, Content::Numbers]
    );
    let model =
        import_glb(&container(&document, &bytes), &thing("a crate"), &metres()).unwrap().asset.model.unwrap();
    assert_eq!(model.parts[0].pictures, pictures);
    // What lies otherwise has no place of its own: it is passed over.
    document["materials"][0]["normalTexture"]["extensions"] =
        json!({"KHR_texture_transform": {"offset": [0.1, 0.0]}});
    let surface = read(&document, &bytes).unwrap();
    assert_eq!((surface.parts[0].pictures.bumps, surface.parts[0].pictures.shade), (None, texture(1)));
    // What is not to be lit has none.
    document["materials"][0]["extensions"] = json!({"KHR_materials_unlit": {}});
    assert_eq!(
        read(&document, &bytes).unwrap().parts[0].pictures,
        Pictures { bumps: None, ..Pictures::default() }
    );
}

fn metres() -> ImportConfig {
    ImportConfig { unit: Unit::Metres, ..ImportConfig::default() }
}

/// A file of two boxes, whose material has this beside a picture whose left half is there by 51 of 255.
fn clear(material: &[(&str, Value)]) -> (Value, Vec<u8>) {
    let mut picture = Vec::new();
    let mut encoder = png::Encoder::new(&mut picture, 2, 1);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(&[255, 0, 0, 51, 0, 0, 188, 255]).unwrap();
    let (mut document, bytes) = painted_document(&picture);
    document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = json!([1.0, 1.0, 1.0, 0.75]);
    for (name, value) in material {
        document["materials"][0][*name] = value.clone();
    }
    (document, bytes)
}

#[test]
fn alpha_is_read_where_the_material_says_what_becomes_of_it() {
    for (material, expected) in [
        (vec![], Transparency::Opaque),
        (vec![("alphaMode", json!("OPAQUE")), ("alphaCutoff", json!(0.2))], Transparency::Opaque),
        (vec![("alphaMode", json!("MASK"))], Transparency::Cutout { cutoff: 0.5 }),
        (vec![("alphaMode", json!("MASK")), ("alphaCutoff", json!(0))], Transparency::Cutout { cutoff: 0.0 }),
        (
            vec![("alphaMode", json!("MASK")), ("alphaCutoff", json!(1e30))],
            Transparency::Cutout { cutoff: 2.0 },
        ),
        (vec![("alphaMode", json!("BLEND"))], Transparency::Blend),
    ] {
        let (document, bytes) = clear(&material);
        let surface = read(&document, &bytes).unwrap();
        assert_eq!(surface.parts[0].transparency, expected, "{material:?}");
        let is_opaque = expected == Transparency::Opaque;
        assert_eq!(surface.images[0].alpha, if is_opaque { vec![] } else { vec![51, 255] });
        assert!(surface.alphas.iter().all(|alpha| *alpha == if is_opaque { 1.0 } else { 0.75 }));
        let asset = import_glb(&container(&document, &bytes), &thing("a crate"), &metres()).unwrap().asset;
        let model = asset.model.as_deref().unwrap();
        assert_eq!(
            (model.images[0].alpha.len(), model.parts[0].transparency),
            (if is_opaque { 0 } else { 2 }, expected)
        );
        // And it is written as it was read.
        let again = read_glb(&export_glb(model), &GlbLimits::default()).unwrap();
        assert_eq!((&again.images, again.parts[0].transparency), (&model.images, expected));
        assert!(again.alphas.iter().all(|alpha| *alpha == model.vertices[0].alpha));
    }
}

#[test]
fn two_sides_are_read_and_written() {
    for (material, expected) in [
        (vec![], false),
        (vec![("doubleSided", json!(false))], false),
        (vec![("doubleSided", json!(true))], true),
        (vec![("doubleSided", json!(true)), ("alphaMode", json!("MASK"))], true),
    ] {
        let (document, bytes) = clear(&material);
        assert_eq!(read(&document, &bytes).unwrap().parts[0].two_sided, expected, "{material:?}");
        let asset = import_glb(&container(&document, &bytes), &thing("a crate"), &metres()).unwrap().asset;
        let model = asset.model.as_deref().unwrap();
        assert!(model.parts.iter().all(|part| part.two_sided == expected), "{material:?}");
        let again = read_glb(&export_glb(model), &GlbLimits::default()).unwrap();
        assert_eq!(again.parts[0].two_sided, expected, "{material:?}");
    }
    let (document, bytes) = clear(&[("doubleSided", json!("both"))]);
    let error = read(&document, &bytes).unwrap_err().to_string();
    assert!(error.contains("JSON"), "{error}");
}

#[test]
fn what_is_no_transparency_is_refused() {
    for (name, value, said) in [
        ("alphaMode", json!("DITHER"), "DITHER"),
        ("alphaMode", json!("mask"), "MASK"),
        ("alphaMode", json!(3), "JSON"),
        ("alphaCutoff", json!(-0.1), "0 or more"),
        ("alphaCutoff", json!("half"), "JSON"),
        ("normalTexture", json!({"index": 7}), "texture 7"),
        ("normalTexture", json!({}), "JSON"),
        ("occlusionTexture", json!({"index": 0, "texCoord": 2}), "TEXCOORD_2"),
    ] {
        let (document, bytes) = clear(&[(name, value)]);
        let error = read(&document, &bytes).unwrap_err().to_string();
        assert!(error.contains(said), "{error:?} is not about {said:?}");
    }
    // Far factors are brought into their ranges.
    let (document, bytes) = clear(&[
        ("normalTexture", json!({"index": 0, "scale": -1e300})),
        ("occlusionTexture", json!({"index": 0, "strength": 7.0})),
    ]);
    let pictures = read(&document, &bytes).unwrap().parts[0].pictures;
    assert_eq!((pictures.bump_scale, pictures.shade_strength), (-100.0, 1.0));
}

#[test]
fn a_picture_stays_a_picture() {
    let surface = read_glb(&painted(&halves()), &GlbLimits::default()).unwrap();
    let pixels = vec![255, 0, 0, 0, 0, 188];
    let image = ModelImage { width: 2, height: 1, pixels, ..ModelImage::default() };
    assert_eq!(surface.images, [image]);
    assert_eq!(surface.parts[0].texture, Some(ModelTexture { image: 0, wrap: [Wrap::Repeat; 2] }));
    assert_eq!(surface.parts[0].paint, Paint::Own);
    assert_eq!((surface.places[0], surface.places[8]), ([0.25, 0.5], [0.75, 0.5]));
    assert_eq!(surface.colors[0], [0.5, 1.0, 1.0], "the factor is its vertices'");

    let config = ImportConfig { unit: Unit::Metres, ..ImportConfig::default() };
    let asset = import_glb(&painted(&halves()), &thing("a crate"), &config).unwrap().asset;
    let model = asset.model.as_deref().unwrap();
    assert_eq!(model.images, surface.images);
    assert!(
        model
            .vertices
            .iter()
            .all(|vertex| vertex.place == if vertex.position[1] < 0.0 { [0.25, 0.5] } else { [0.75, 0.5] })
    );
    let [red, green, blue] = asset.color.unwrap();
    // Half of it is red by half, and half of it blue.
    assert!(
        (red - 0.25).abs() < 0.01 && green == 0.0 && (blue - 0.2515).abs() < 0.01,
        "{red} {green} {blue}"
    );
}

#[test]
fn what_has_pictures_and_shines_reads_back() {
    let mut written = cuboid([0.0; 3], [1.0; 3]);
    let wraps = [[Wrap::Repeat, Wrap::Mirror], [Wrap::Clamp, Wrap::Repeat]];
    let part = |triangles, finish, texture| ModelPart {
        name: "side".into(),
        triangles,
        finish,
        texture,
        ..ModelPart::default()
    };
    let dull = Finish::default();
    written.parts = vec![
        part(
            4,
            Finish { metallic: 0.3, roughness: 0.1, ..dull },
            Some(ModelTexture { image: 1, wrap: wraps[0] }),
        ),
        part(4, Finish { emission: [0.2, 0.4, 0.0], ..dull }, None),
        part(
            4,
            Finish { emission: [2.5, 5.0, 0.0], ..dull },
            Some(ModelTexture { image: 0, wrap: wraps[1] }),
        ),
    ];
    for (index, vertex) in (0..8u8).zip(&mut written.vertices) {
        vertex.normal = [0.6, 0.0, 0.8];
        vertex.place = [f32::from(index) * 0.5, -f32::from(index)];
    }
    let image = |width: u32, height: u32, first: u8| {
        let pixels = (0..width * height * 3).map(|k| first.wrapping_add(k as u8)).collect();
        ModelImage { width, height, pixels, ..ModelImage::default() }
    };
    written.images = vec![image(5, 3, 7), image(2, 2, 90)];
    let bytes = export_glb(&written);
    // The other reader checks the document against the specification.
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    assert_eq!((file.images().len(), file.textures().len(), file.materials().len()), (2, 2, 3));
    let read = read_glb(&bytes, &GlbLimits::default()).unwrap();
    // Pictures are numbered as they are met.
    let images: Vec<&ModelImage> =
        read.parts.iter().filter_map(|part| Some(&read.images[part.texture?.image as usize])).collect();
    assert_eq!(images, [&written.images[1], &written.images[0]]);
    for (ours, theirs) in read.parts.iter().zip(&written.parts) {
        assert_eq!(ours.finish, theirs.finish);
        assert_eq!(ours.texture.map(|texture| texture.wrap), theirs.texture.map(|texture| texture.wrap));
    }
    for (part, triangle) in [(0, 0), (0, 3), (2, 11)] {
        assert!(written.parts[part].texture.is_some());
        let place = |corner: usize| read.places[read.triangles[triangle][corner] as usize];
        let wanted = written.triangles[triangle].map(|corner| written.vertices[corner as usize].place);
        assert_eq!([place(0), place(1), place(2)], wanted);
    }
}

#[test]
fn large_pictures_are_halved() {
    let (document, bytes) = painted_document(&png(300, 100, &vec![99; 90_000]));
    let limits = |texture| GlbLimits { texture, ..GlbLimits::default() };
    for (most, size) in [(1024, (300, 100)), (299, (150, 50)), (50, (37, 12)), (1, (1, 1))] {
        let surface = read_glb(&container(&document, &bytes), &limits(most)).unwrap();
        let image = &surface.images[0];
        assert_eq!((image.width, image.height), size, "at most {most}");
        assert!(image.pixels.iter().all(|value| *value == 99));
    }
}

#[test]
fn pictures_that_lie_are_refused() {
    let read = |picture: &[u8]| read_glb(&painted(picture), &GlbLimits::default()).unwrap_err();
    // A header that says 30 000 pixels each way, and one of 60 000 by 1.
    for (width, height) in [(30_000_u32, 30_000_u32), (60_000, 1)] {
        let mut huge = png(2, 1, &[0; 6]);
        huge[16..20].copy_from_slice(&width.to_be_bytes());
        huge[20..24].copy_from_slice(&height.to_be_bytes());
        let error = read(&huge);
        assert!(matches!(error, GlbError::Picture { .. } | GlbError::TooMany { .. }), "{width}: {error}");
    }
    // The same with a checksum that is right.
    let error = read(&png(4097, 1, &vec![0; 3 * 4097]));
    assert!(matches!(&error, GlbError::Picture { reason, .. } if reason.contains("4096")), "{error}");
    assert!(matches!(read(b"GIF89a"), GlbError::Picture { .. }));
    let many = GlbLimits { pixels: 1, ..GlbLimits::default() };
    assert!(matches!(
        read_glb(&painted(&halves()), &many),
        Err(GlbError::TooMany { what: "pixels", got: 2, most: 1 })
    ));
}

#[test]
fn damaged_materials_are_refused() {
    type Spoil = fn(&mut Value);
    let spoils: [(Spoil, &str); 7] = [
        (|d| d["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = json!(4), "texture 4"),
        (|d| d["textures"][0]["source"] = json!(3), "image 3"),
        (|d| d["textures"][0]["sampler"] = json!(0), "sampler 0"),
        (|d| d["images"][0]["bufferView"] = json!(70), "buffer view 70"),
        (|d| d["images"][0] = json!({}), "does not hold it"),
        (
            |d| d["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = json!(3),
            "TEXCOORD_3",
        ),
        (|d| d["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = json!("all"), "JSON"),
    ];
    for (spoil, said) in spoils {
        let (mut document, bytes) = painted_document(&halves());
        spoil(&mut document);
        let error = read(&document, &bytes).unwrap_err().to_string();
        assert!(error.contains(said), "{error:?} is not about {said:?}");
    }
    // Places on the picture begin behind positions and indices.
    for bits in [f32::NAN, f32::INFINITY, -1e30] {
        let (document, mut bytes) = painted_document(&halves());
        let first = document["bufferViews"][2]["byteOffset"].as_u64().unwrap() as usize;
        bytes[first + 4..first + 8].copy_from_slice(&bits.to_le_bytes());
        let error = read(&document, &bytes).unwrap_err();
        assert!(matches!(error, GlbError::Number { what: "accessor", .. }), "{bits}: {error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Whatever stands in the numbers and the picture of a file with a texture: an asset that is sound, or an error.
    #[test]
    fn any_bytes_of_a_texture_give_a_sound_asset_or_an_error(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        factors in prop::array::uniform3(-2.0..3.0_f64),
    ) {
        let (mut document, mut bytes) = painted_document(&halves());
        let material = &mut document["materials"][0];
        let [metallic, roughness, shine] = factors;
        material["pbrMetallicRoughness"]["metallicFactor"] = json!(metallic);
        material["pbrMetallicRoughness"]["roughnessFactor"] = json!(roughness);
        material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = json!({"index": 0});
        material["emissiveFactor"] = json!([shine, 0.5, 1.0]);
        material["emissiveTexture"] = json!({"index": 0});
        material["occlusionTexture"] = json!({"index": 0, "strength": shine});
        material["normalTexture"] = json!({"index": 0, "scale": metallic});
        material["alphaMode"] = json!(if shine > 1.0 { "MASK" } else { "BLEND" });
        material["alphaCutoff"] = json!(roughness.abs());
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        let config = ImportConfig { unit: Unit::Metres, voxels: 16, hulls: 4, ..ImportConfig::default() };
        if let Ok(imported) = import_glb(&container(&document, &bytes), &thing("crate"), &config) {
            prop_assert!(imported.asset.validate().is_ok());
        }
    }
}
