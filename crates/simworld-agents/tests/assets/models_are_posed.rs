//! Skins follow their joints, at rest and at any moment of an animation; textures lie where a file shifts them, and numbers may be
//! whole.
// what fails here fails the test
#![allow(clippy::unwrap_used)]

use crate::assets_common::{bending_bar, container, cuboid, plain_model, thing};
use proptest::prelude::*;
use serde_json::{Value, json};
use simworld_agents::assets::{GlbError, GlbLimits, ImportConfig, Moment, import_glb, read_glb, read_glb_at};
use simworld_core::geometry::Point3;
use simworld_core::ops;

fn at(seconds: f64) -> Moment {
    Moment { animation: 0, seconds }
}

fn read(document: &Value, bytes: &[u8], seconds: f64) -> Result<Vec<Point3>, GlbError> {
    read_glb_at(&container(document, bytes), &GlbLimits::default(), Some(at(seconds)))
        .map(|surface| surface.points)
}

/// Where the bar's points are once its head is turned by an angle about z (glTF), in body axes.
fn bent(angle: f64) -> Vec<Point3> {
    let (sin, cos) = ops::sin_cos(angle);
    let rest = cuboid([-0.2, -0.2, 0.0], [0.2, 0.2, 2.0]);
    let place = |[ahead, left, up]: [f32; 3]| {
        let (x, y, z) = (f64::from(left), f64::from(up), f64::from(ahead));
        // The head turns about (0, 1, 0).
        let (x, y) =
            if y > 1.0 { (x * cos - (y - 1.0) * sin, 1.0 + x * sin + (y - 1.0) * cos) } else { (x, y) };
        Point3::new(z, x, y)
    };
    rest.vertices.iter().map(|vertex| place(vertex.position)).collect()
}

fn apart(a: &[Point3], b: &[Point3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

#[test]
fn a_bar_bends_as_its_animation_says() {
    let quarter = std::f64::consts::FRAC_PI_2;
    for (interpolation, seconds, angle) in [
        ("LINEAR", 0.0, 0.0),
        ("LINEAR", 1.5, 0.25 * quarter),
        ("LINEAR", 2.0, 0.5 * quarter),
        ("LINEAR", 3.0, quarter),
        ("LINEAR", 99.0, quarter),
        ("STEP", 2.9, 0.0),
        ("STEP", 3.0, quarter),
        ("CUBICSPLINE", 1.0, 0.0),
        ("CUBICSPLINE", 2.0, 0.5 * quarter),
        ("CUBICSPLINE", 3.0, quarter),
    ] {
        let (document, bytes) = bending_bar(interpolation);
        let points = read(&document, &bytes, seconds).unwrap();
        let off = apart(&points, &bent(angle));
        assert!(points.len() == 8 && off < 1e-6, "{interpolation} at {seconds} s: {off} m off");
    }
    let (document, bytes) = bending_bar("LINEAR");
    let rest = read_glb(&container(&document, &bytes), &GlbLimits::default()).unwrap();
    assert!(apart(&rest.points, &bent(0.0)) < 1e-6, "at rest it stands upright");
}

#[test]
fn an_asset_is_taken_at_its_moment() {
    let (document, bytes) = bending_bar("LINEAR");
    let size = |moment| {
        let config =
            ImportConfig { moment, unit: simworld_agents::assets::Unit::Metres, ..ImportConfig::default() };
        let file = container(&document, &bytes);
        import_glb(&file, &thing("a crate"), &config).unwrap().asset.collider.size()
    };
    let (upright, bent) = (size(None), size(Some(at(3.0))));
    assert!((upright.z - 2.0).abs() < 1e-3, "{upright}");
    assert!((bent.z - 1.2).abs() < 1e-3 && (bent.y - 1.2).abs() < 1e-3, "the head lies to the side: {bent}");
}

#[test]
fn damaged_skins_and_animations_are_refused() {
    type Spoil = fn(&mut Value);
    let spoils: [(Spoil, &str); 11] = [
        (|d| d["nodes"][0]["skin"] = json!(7), "skin 7 is not there"),
        (|d| d["skins"][0]["joints"] = json!([1, 9]), "node 9 is not there"),
        (|d| d["skins"][0]["joints"] = json!([1]), "joint 1 is not there"),
        (|d| d["skins"][0]["joints"] = json!([1, 2, 1]), "fewer matrices than joints"),
        (|d| d["animations"] = json!([]), "animation 0 is not there"),
        (|d| d["animations"][0]["channels"][0]["target"]["node"] = json!(9), "node 9 is not there"),
        (|d| d["animations"][0]["channels"][0]["target"]["path"] = json!("weights"), "morph targets"),
        (|d| d["animations"][0]["samplers"][0]["interpolation"] = json!("CUBIC"), "does not know"),
        (|d| d["animations"][0]["samplers"][0]["output"] = json!(3), "one value for each of its keys"),
        (|d| d["animations"][0]["samplers"][0]["input"] = json!(3), "type or shape"),
        (|d| d["nodes"][2]["children"] = json!([1]), "below itself"),
    ];
    for (spoil, said) in spoils {
        let (mut document, bytes) = bending_bar("LINEAR");
        spoil(&mut document);
        let error = read(&document, &bytes, 2.0).unwrap_err().to_string();
        assert!(error.contains(said), "{error:?} is not about {said:?}");
    }
    let (document, bytes) = bending_bar("LINEAR");
    assert!(matches!(read(&document, &bytes, f64::NAN), Err(GlbError::Number { what: "animation", .. })));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Weights, matrices, keys of any bits: finite points or an error.
    #[test]
    fn any_numbers_in_skins_give_finite_points_or_an_error(
        changes in prop::collection::vec((0_usize..1000, any::<u32>()), 1..6),
        seconds in -1.0..5.0_f64,
        kind in 0_usize..3,
    ) {
        let (document, mut bytes) = bending_bar(["LINEAR", "STEP", "CUBICSPLINE"][kind]);
        for (place, word) in changes {
            let first = place % (bytes.len() / 4) * 4;
            bytes[first..first + 4].copy_from_slice(&word.to_le_bytes());
        }
        if let Ok(points) = read(&document, &bytes, seconds) {
            prop_assert!(points.iter().flat_map(|point| point.iter()).all(|number| number.is_finite()));
        }
    }
}

#[test]
fn whole_numbers_stand_for_positions_where_the_file_says_so() {
    let cube = cuboid([0.0; 3], [1.0; 3]);
    let (mut document, bytes) = plain_model(&cube);
    let reference = read_glb(&container(&document, &bytes), &GlbLimits::default()).unwrap();
    let shorts: Vec<u8> = cube
        .vertices
        .iter()
        .flat_map(|vertex| {
            let [x, y, z] = vertex.position;
            [y, z, x, 0.0].map(|number| number as i16 * 500)
        })
        .flat_map(i16::to_le_bytes)
        .collect();
    let indices = &bytes[cube.vertices.len() * 12..];
    document["accessors"][0]["componentType"] = json!(5122);
    document["bufferViews"][0] = json!({"buffer": 0, "byteLength": shorts.len(), "byteStride": 8});
    document["bufferViews"][1]["byteOffset"] = json!(shorts.len());
    document["nodes"][0]["scale"] = json!([0.002, 0.002, 0.002]);
    let file = |document: &Value| container(document, &[&shorts, indices].concat());
    assert!(read_glb(&file(&document), &GlbLimits::default()).is_err(), "not without the extension");
    document["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let read = read_glb(&file(&document), &GlbLimits::default()).unwrap();
    assert!(apart(&read.points, &reference.points) < 1e-9);
}
