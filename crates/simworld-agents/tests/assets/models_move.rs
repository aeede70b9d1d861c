//! Animations of files stay with the assets made from them, and move them as the files say.
// what fails here fails the test
#![allow(clippy::unwrap_used)]

use crate::assets_common::{bending_bar, container, thing};
use proptest::prelude::*;
use serde_json::{Value, json};
use simworld_agents::assets::{
    Facing, GlbError, GlbLimits, ImportConfig, ImportError, Moment, Unit, export_glb, import_glb,
    read_glb_at, read_rigged_glb,
};
use simworld_core::asset::{Model, POSE_RATE, RigError};

fn imported(document: &Value, bytes: &[u8], config: &ImportConfig) -> Result<Model, ImportError> {
    let file = container(document, bytes);
    import_glb(&file, &thing("a crate"), config)
        .map(|imported| imported.asset.model.as_deref().cloned().unwrap())
}

fn metres() -> ImportConfig {
    ImportConfig { unit: Unit::Metres, ..ImportConfig::default() }
}

/// Each vertex of a model is where one of the surface's points is, seen from the model's foot.
fn farthest(model: &Model, positions: &[[f32; 3]], wanted: &[[f64; 3]]) -> f64 {
    let rest: Vec<[f32; 3]> = model.vertices.iter().map(|vertex| vertex.position).collect();
    assert_eq!(positions.len(), rest.len());
    let apart = |a: [f32; 3], b: &[f64; 3]| {
        let part = |axis: usize| f64::from(a[axis]) - b[axis];
        (0..3).map(|axis| part(axis) * part(axis)).sum::<f64>().sqrt()
    };
    let nearest =
        |point: &[f32; 3]| wanted.iter().map(|other| apart(*point, other)).fold(f64::INFINITY, f64::min);
    positions.iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn a_bar_bends_while_the_world_runs() {
    for interpolation in ["LINEAR", "STEP", "CUBICSPLINE"] {
        let (mut document, bytes) = bending_bar(interpolation);
        document["animations"][0]["name"] = json!("bow");
        let model = imported(&document, &bytes, &metres()).unwrap();
        let rig = model.rig.as_ref().unwrap();
        assert_eq!((rig.clips().len(), rig.clips()[0].name.as_str()), (1, "bow"));
        assert_eq!(rig.clips()[0].seconds(), 3.0);
        let rest = rig.rest();
        for (vertex, (position, normal)) in
            model.vertices.iter().zip(rest.positions.iter().zip(&rest.normals))
        {
            for axis in 0..3 {
                assert!((vertex.position[axis] - position[axis]).abs() < 1e-5, "it rests as it was imported");
                assert!((vertex.normal[axis] - normal[axis]).abs() < 1e-5, "and faces as it did");
            }
        }
        for seconds in [0.0, 1.5, 2.25, 2.75, 3.0] {
            let moment = Some(Moment { animation: 0, seconds });
            let file = container(&document, &bytes);
            let surface = read_glb_at(&file, &GlbLimits::default(), moment).unwrap();
            let wanted: Vec<[f64; 3]> = surface.points.iter().map(|point| (*point).into()).collect();
            let off = farthest(&model, &rig.pose(0, seconds).positions, &wanted);
            assert!(off < 1e-5, "{interpolation} at {seconds} s: {off} m off");
        }
        let [low, high] = rig.bounds();
        let widest = (0..rig.clips()[0].poses())
            .flat_map(|pose| rig.pose(0, f64::from(pose) / POSE_RATE).positions)
            .map(|[_, y, _]| y.abs())
            .fold(0.0, f32::max);
        assert!(low[1].abs().max(high[1]) + 1e-5 >= widest);
    }
}

/// Whatever is done to a file on its way to an asset is done to what its clips do.
#[test]
fn clips_are_scaled_turned_and_stood_with_the_rest() {
    let (document, bytes) = bending_bar("LINEAR");
    let plain = imported(&document, &bytes, &metres()).unwrap();
    let mut scaled = document.clone();
    // Hung below a node that makes it a hundred times as large, somewhere else.
    scaled["nodes"].as_array_mut().unwrap().push(json!({
        "children": [1], "scale": [100.0, 100.0, 100.0], "translation": [700.0, 5.0, -3.0]
    }));
    scaled["scenes"] = json!([{"nodes": [0, 3]}]);
    let config = ImportConfig { unit: Unit::Guess, facing: Facing::ByClass, ..ImportConfig::default() };
    let file = container(&scaled, &bytes);
    let long = simworld_agents::assets::Thing {
        size: simworld_agents::generation::SizeHint { height: Some(2.0), ..Default::default() },
        ..thing("a crate")
    };
    let model = import_glb(&file, &long, &config).unwrap().asset.model.as_deref().cloned().unwrap();
    for seconds in [0.0, 1.5, 3.0] {
        let [a, b] = [&plain, &model].map(|model| model.rig.as_ref().unwrap().pose(0, seconds));
        for (a, b) in a.positions.iter().zip(&b.positions) {
            assert!((0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-4), "{a:?} and {b:?} at {seconds} s");
        }
    }
}

#[test]
fn clips_are_kept_only_where_they_are_wanted_and_seen() {
    let (document, bytes) = bending_bar("LINEAR");
    let without = ImportConfig { clips: false, ..metres() };
    assert!(imported(&document, &bytes, &without).unwrap().rig.is_none());
    // Of an animation that moves a node on which nothing hangs, nothing is seen.
    let mut elsewhere = document.clone();
    elsewhere["nodes"].as_array_mut().unwrap().push(json!({}));
    elsewhere["animations"][0]["channels"][0]["target"]["node"] = json!(3);
    assert!(imported(&elsewhere, &bytes, &metres()).unwrap().rig.is_none());
    // Names are as the file has them, and free.
    let mut two = document;
    let mut clip = two["animations"][0].clone();
    clip["name"] = json!("Bow");
    two["animations"] = json!([clip, clip, {"channels": [], "samplers": []}]);
    clip["name"] = Value::Null;
    two["animations"].as_array_mut().unwrap().push(clip);
    let model = imported(&two, &bytes, &metres()).unwrap();
    let names: Vec<String> = model.rig.unwrap().clips().iter().map(|clip| clip.name.clone()).collect();
    assert_eq!(names, ["Bow", "Bow 2", "clip 3"]);
}

/// A mesh without a skin is moved by its node and by all above it.
#[test]
fn nodes_carry_their_meshes() {
    let (mut document, bytes) = bending_bar("LINEAR");
    document["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("JOINTS_0");
    document["nodes"] =
        json!([{"mesh": 0, "translation": [0.0, 3.0, 0.0]}, {"children": [2]}, {"children": [0]}]);
    document["scenes"] = json!([{"nodes": [1]}]);
    let model = imported(&document, &bytes, &metres()).unwrap();
    let turned = model.rig.as_ref().unwrap().pose(0, 3.0);
    // A quarter about z of glTF, 3 m below its foot: what was above lies to the side.
    for (vertex, position) in model.vertices.iter().zip(&turned.positions) {
        let [ahead, left, up] = vertex.position;
        let wanted = [ahead, -(up + 3.0), left - 3.0];
        assert!(
            (0..3).all(|axis| (wanted[axis] - position[axis]).abs() < 1e-5),
            "{position:?}, not {wanted:?}"
        );
    }
}

#[test]
fn damaged_animations_are_refused_with_a_way_out() {
    let (document, bytes) = bending_bar("LINEAR");
    let spoilt = |spoil: fn(&mut Value)| {
        let mut document = document.clone();
        spoil(&mut document);
        let without = ImportConfig { clips: false, ..metres() };
        assert!(imported(&document, &bytes, &without).is_ok(), "at rest it can be read");
        imported(&document, &bytes, &metres()).unwrap_err().to_string()
    };
    let says = [
        (spoilt(|d| d["animations"][0]["channels"][0]["target"]["path"] = json!("weights")), "morph targets"),
        (
            spoilt(|d| d["animations"][0]["samplers"][0]["output"] = json!(3)),
            "one value for each of its keys",
        ),
        (spoilt(|d| d["animations"][0]["samplers"][0]["input"] = json!(77)), "accessor 77 is not there"),
    ];
    for (error, said) in says {
        assert!(error.contains(said), "{error:?} is not about {said:?}");
    }
    let limits = GlbLimits { keys: 9, ..GlbLimits::default() };
    let error = read_rigged_glb(&container(&document, &bytes), &limits, None).unwrap_err();
    assert!(matches!(error, GlbError::TooMany { got: 10, most: 9, .. }), "{error}");
    // An hour and more between two keys.
    let mut bytes = bytes;
    let times = document["bufferViews"][5]["byteOffset"].as_u64().unwrap() as usize;
    bytes[times + 4..times + 8].copy_from_slice(&1e6_f32.to_le_bytes());
    let error = imported(&document, &bytes, &metres()).unwrap_err();
    assert!(matches!(error, ImportError::Rig(RigError::Curve { .. })), "{error}");
    assert!(error.to_string().contains("clips"), "{error} names the way out");
}

#[test]
fn clips_survive_being_written() {
    let (mut document, bytes) = bending_bar("CUBICSPLINE");
    document["animations"][0]["name"] = json!("bow");
    let model = imported(&document, &bytes, &metres()).unwrap();
    let again = import_glb(&export_glb(&model), &thing("a crate"), &metres()).unwrap().asset;
    let again = again.model.as_deref().unwrap();
    assert_eq!(again.rig.as_ref().unwrap().clips()[0].name, "bow");
    for seconds in [0.0, 1.4, 2.6] {
        let [a, b] = [&model, again].map(|model| model.rig.as_ref().unwrap().pose(0, seconds).positions);
        assert_eq!(a.len(), b.len());
        let wanted: Vec<[f64; 3]> = a.iter().map(|point| point.map(f64::from)).collect();
        let off = farthest(again, &b, &wanted);
        assert!(off < 1e-5, "{off} m off at {seconds} s");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Keys, weights and matrices of any bits: every pose of every clip is within the model's bounds, or there is no model.
    #[test]
    fn any_numbers_give_finite_poses_or_an_error(
        changes in prop::collection::vec((0_usize..1000, any::<u32>()), 1..4),
        kind in 0_usize..3,
    ) {
        let (document, mut bytes) = bending_bar(["LINEAR", "STEP", "CUBICSPLINE"][kind]);
        for (place, word) in changes {
            let first = place % (bytes.len() / 4) * 4;
            bytes[first..first + 4].copy_from_slice(&word.to_le_bytes());
        }
        let config = ImportConfig { hulls: 1, voxels: 16, ..metres() };
        if let Ok(model) = imported(&document, &bytes, &config)
            && let Some(rig) = &model.rig
        {
            let [low, high] = rig.bounds();
            for pose in (0..rig.clips()[0].poses()).step_by(7) {
                for point in rig.pose(0, f64::from(pose) / POSE_RATE).positions {
                    for axis in 0..3 {
                        let slack = 1e-4 * (1.0 + high[axis] - low[axis]);
                        prop_assert!(point[axis] >= low[axis] - slack && point[axis] <= high[axis] + slack);
                    }
                }
            }
        }
    }
}
