//! A GLB file becomes an asset: in the right axes, unit, colours and place, mended, taken apart and weighed.
// what fails here fails the test
#![allow(clippy::unwrap_used)]

use crate::assets_common::{
    RED, container, cuboid, dented_ball, halves, import, model, painted, painted_document, plain,
    plain_model, table, thing, together,
};
use serde_json::{Value, json};
use simworld_agents::assets::{
    Facing, GlbLimits, ImportConfig, ImportError, Imported, Unit, export_glb, import_glb, read_glb,
};
use simworld_agents::generation::SizeHint;
use simworld_core::asset::{Catalogue, Model, Paint};
use simworld_core::ops;
use simworld_core::scene::EntityKind;

fn near(got: f64, want: f64, tolerance: f64) -> bool {
    (got - want).abs() <= tolerance
}

fn size(imported: &Imported) -> [f64; 3] {
    imported.asset.collider.size().into()
}

fn own_model(imported: &Imported) -> &Model {
    imported.asset.model.as_deref().unwrap()
}

#[test]
fn what_is_written_is_valid_and_reads_back() {
    let mut written = table();
    for vertex in &mut written.vertices {
        vertex.normal = [0.6, 0.0, 0.8];
    }
    written.parts[1].paint = Paint::Entity;
    written.parts[1].name = "a \"leg\"".into();
    let bytes = export_glb(&written);
    // The other reader checks the document against the specification.
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let blob = file.blob.as_deref().unwrap();
    let mesh = file.meshes().next().unwrap();
    assert_eq!(mesh.primitives().len(), written.parts.len());
    let first = mesh.primitives().next().unwrap();
    let positions: Vec<[f32; 3]> = first.reader(|_| Some(blob)).read_positions().unwrap().collect();
    assert_eq!(positions[7], [1.2, 0.75, 0.8], "x to the left, y up, z to the front");
    assert_eq!(first.bounding_box().max, [1.2, 0.75, 0.8]);

    let read = read_glb(&bytes, &GlbLimits::default()).unwrap();
    assert_eq!(read.parts, written.parts);
    assert_eq!(read.triangles.len(), written.triangles.len());
    for (ours, theirs) in read.triangles.iter().flatten().zip(written.triangles.iter().flatten()) {
        let (ours, theirs) = (*ours as usize, &written.vertices[*theirs as usize]);
        assert_eq!(<[f64; 3]>::from(read.points[ours].coords), theirs.position.map(f64::from));
        assert!(
            (read.normals[ours].map(|x| x as f32) - nalgebra::Vector3::from(theirs.normal)).norm() < 1e-6
        );
    }
    let corner = |part: usize| read.triangles[part * 12][0] as usize;
    assert_eq!(
        (read.colors[corner(0)], read.colors[corner(1)]),
        (RED, [1.0; 3]),
        "the leg has no colour of its own"
    );
}

#[test]
fn nodes_put_meshes_where_they_stand() {
    let (mut document, bytes) = plain_model(&cuboid([0.0, 0.0, 0.0], [1.0, 2.0, 3.0]));
    // Up by ten, a quarter turn about y (up), mirrored along x (to the left), and twice as large.
    document["nodes"] = json!([
        {"children": [1], "translation": [0.0, 10.0, 0.0]},
        {"children": [2], "rotation": [0.0, std::f64::consts::FRAC_1_SQRT_2, 0.0, std::f64::consts::FRAC_1_SQRT_2]},
        {"mesh": 0, "matrix": [-2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]},
    ]);
    let surface = read_glb(&container(&document, &bytes), &GlbLimits::default()).unwrap();
    let [low, high] = surface.bounds().unwrap();
    // y (left) 0..2 is mirrored and doubled to -4..0; about y, left goes to the back, and the front to the left.
    assert!((low - nalgebra::Point3::new(0.0, 0.0, 10.0)).norm() < 1e-6, "{low}");
    assert!((high - nalgebra::Point3::new(4.0, 2.0, 16.0)).norm() < 1e-6, "{high}");
    let volume: f64 = surface
        .triangles
        .iter()
        .map(|triangle| {
            let [a, b, c] = triangle.map(|point| surface.points[point as usize] - low);
            a.dot(&b.cross(&c)) / 6.0
        })
        .sum();
    assert!(near(volume, 48.0, 1e-6), "mirrored, it still looks outward: {volume} m³");
}

#[test]
fn indices_of_any_width_or_none_are_the_same() {
    let cube = cuboid([0.0; 3], [0.5; 3]);
    let (document, bytes) = plain_model(&cube);
    let split = cube.vertices.len() * 12;
    let reference = read_glb(&container(&document, &bytes), &GlbLimits::default()).unwrap();
    let corners: Vec<u32> = cube.triangles.as_flattened().to_vec();
    let narrow: [(u32, Vec<u8>); 2] = [
        (5121, corners.iter().map(|x| *x as u8).collect()),
        (5123, corners.iter().flat_map(|x| (*x as u16).to_le_bytes()).collect()),
    ];
    for (kind, indices) in narrow {
        let mut document = document.clone();
        document["accessors"][1]["componentType"] = json!(kind);
        document["bufferViews"][1]["byteLength"] = json!(indices.len());
        let bytes = [&bytes[..split], &indices].concat();
        document["buffers"][0]["byteLength"] = json!(bytes.len());
        assert_eq!(read_glb(&container(&document, &bytes), &GlbLimits::default()).unwrap(), reference);
    }
    let spread: Vec<[f32; 3]> = corners
        .iter()
        .map(|corner| cube.vertices[*corner as usize].position)
        .map(|[x, y, z]| [y, z, x])
        .collect();
    let (mut document, bytes) = plain(&spread, &[0]);
    document["meshes"][0]["primitives"][0].as_object_mut().unwrap().remove("indices");
    let surface = read_glb(&container(&document, &bytes), &GlbLimits::default()).unwrap();
    assert_eq!(surface.points.len(), 36);
    let corner = |surface: &simworld_agents::assets::Surface, index: usize| {
        surface.points[surface.triangles[index / 3][index % 3] as usize]
    };
    assert!((0..36).all(|index| corner(&surface, index) == corner(&reference, index)));
}

#[test]
fn edges_are_sharp_and_bends_are_smooth_where_no_normals_are_given() {
    let (document, bytes) = plain_model(&cuboid([0.0; 3], [0.6; 3]));
    let cube = import(&container(&document, &bytes), "crate").unwrap();
    let along_an_axis = |normal: &[f32; 3]| normal.iter().filter(|part| part.abs() > 0.999).count() == 1;
    assert_eq!(own_model(&cube).vertices.len(), 24, "each corner has three normals");
    assert!(own_model(&cube).vertices.iter().all(|vertex| along_an_axis(&vertex.normal)));

    let (document, bytes) = plain_model(&dented_ball(8000, 0.11));
    let ball = import(&container(&document, &bytes), "ball").unwrap();
    let inward = own_model(&ball).vertices.iter().filter(|vertex| {
        let from_middle = [vertex.position[0], vertex.position[1], vertex.position[2] - 0.11];
        (0..3).map(|axis| from_middle[axis] * vertex.normal[axis]).sum::<f32>() < 0.0
    });
    assert_eq!(inward.count(), 0, "all look away from the middle");
    assert!(
        own_model(&ball).vertices.len() < 4400,
        "neighbours share their normals: {}",
        own_model(&ball).vertices.len()
    );
}

#[test]
fn textures_lie_where_the_file_shifts_and_turns_them() {
    let colors = |transform: Value| {
        let (mut document, bytes) = painted_document(&halves());
        document["extensionsRequired"] = json!(["KHR_texture_transform"]);
        let texture = &mut document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
        texture["extensions"] = json!({"KHR_texture_transform": transform});
        let surface = read_glb(&container(&document, &bytes), &at_vertices()).unwrap();
        [surface.colors[0], surface.colors[8]].map(|[red, _, blue]| (red > 0.4, blue > 0.4))
    };
    let (red, blue) = ((true, false), (false, true));
    // The coordinates are (0.25, 0.5) and (0.75, 0.5).
    assert_eq!(colors(json!({})), [red, blue]);
    assert_eq!(colors(json!({"offset": [0.5, 0.0]})), [blue, red], "it repeats");
    assert_eq!(colors(json!({"scale": [0.2, 1.0]})), [red, red]);
    // Half a turn: -0.25 and -0.75 are 0.75 and 0.25.
    assert_eq!(colors(json!({"rotation": std::f64::consts::PI})), [blue, red]);
    // A quarter: u becomes v, 0.5, and shifted by 0.25 that is on the right for both.
    assert_eq!(colors(json!({"rotation": std::f64::consts::FRAC_PI_2, "offset": [0.25, 0.0]})), [blue, blue]);
}

/// Limits with which no picture stays one.
fn at_vertices() -> GlbLimits {
    GlbLimits { texture: 0, ..GlbLimits::default() }
}

#[test]
fn textures_become_colours_of_vertices_where_none_is_to_stay() {
    let png = halves();
    // Left half red, right half (0, 0, 188), 16 by 8.
    let jpeg = include_bytes!("assets_common/halves.jpg");
    for (picture, tolerance) in [(png.as_slice(), 1e-3), (jpeg.as_slice(), 0.03)] {
        let surface = read_glb(&painted(picture), &at_vertices()).unwrap();
        assert!(surface.images.is_empty() && surface.parts[0].texture.is_none());
        let (left, right) = (surface.colors[0], surface.colors[8]);
        // sRGB 188 is 0.503 in linear light; the factor halves red.
        for (got, want) in left.into_iter().chain(right).zip([0.5, 0.0, 0.0, 0.0, 0.0, 0.503]) {
            assert!(near(got.into(), want, tolerance), "{left:?} {right:?}");
        }
        assert_eq!(surface.parts[0].paint, Paint::Own);
    }
    let few = GlbLimits { pixels: 1, ..GlbLimits::default() };
    assert!(read_glb(&painted(&png), &few).is_err(), "two pixels are more than one");
}

#[test]
fn a_car_in_centimetres_becomes_a_car() {
    let body = cuboid([100.0, 50.0, -20.0], [550.0, 230.0, 60.0]);
    let cabin = cuboid([200.0, 60.0, 61.0], [400.0, 220.0, 125.0]);
    let (document, bytes) = plain_model(&together(&[body, cabin]));
    let car = import(&container(&document, &bytes), "a red sports car").unwrap();
    assert_eq!(car.report.scale, 0.01);
    assert_eq!(car.asset.kind, EntityKind::Car);
    assert!((0..3).all(|axis| near(size(&car)[axis], [4.5, 1.8, 1.45][axis], 1e-5)), "{:?}", size(&car));
    let [low, high] = own_model(&car).bounds().unwrap();
    assert!(
        near(low[2].into(), 0.0, 1e-6) && near((low[0] + high[0]).into(), 0.0, 1e-5),
        "it stands on its origin"
    );
    // 6.48 m³ of body and 2.05 of cabin.
    assert!(near(car.report.volume, 8.528, 0.01), "{}", car.report.volume);
    assert!((900.0..2500.0).contains(&car.asset.mass.unwrap()), "{:?} kg", car.asset.mass);
    let [x, y, z] = car.report.center_of_mass;
    assert!(near(x, -0.06, 0.01) && near(y, 0.0, 1e-3) && near(z, 0.575, 0.01), "{x} {y} {z}");
    assert!(car.asset.tags.contains(&"sports".to_owned()));
    let mut catalogue = Catalogue::standard();
    let id = catalogue.add(car.asset).unwrap();
    assert_eq!(catalogue.get(id).unwrap().model.as_ref().unwrap().parts.len(), 1);
}

#[test]
fn generated_models_of_any_size_are_turned_and_scaled_by_their_class() {
    // A bench that is long where it should be wide, two units long.
    let (document, bytes) = plain_model(&cuboid([-1.0, -0.3, 0.0], [1.0, 0.3, 0.9]));
    let config = ImportConfig { unit: Unit::Any, facing: Facing::ByClass, ..ImportConfig::default() };
    let bytes = container(&document, &bytes);
    let bench = import_glb(&bytes, &thing("a park bench"), &config).unwrap();
    assert!(bench.report.quarter_turned);
    assert!((0..3).all(|axis| near(size(&bench)[axis], [0.54, 1.8, 0.81][axis], 1e-5)), "{:?}", size(&bench));
    let mut wish = thing("a park bench");
    wish.size = SizeHint { height: Some(0.45), ..SizeHint::default() };
    let low = import_glb(&bytes, &wish, &config).unwrap();
    assert!(near(size(&low)[2], 0.45, 1e-6));
    // A bench in half the size weighs about an eighth.
    let share = low.asset.mass.unwrap() / bench.asset.mass.unwrap();
    let smaller = 0.45 / 0.81;
    assert!(near(share, smaller * smaller * smaller, 1e-3), "{share}");
}

#[test]
fn cracks_are_closed() {
    let cube = cuboid([0.0; 3], [1.0; 3]);
    // Every triangle has corners of its own, a hair off.
    let points: Vec<[f32; 3]> = cube
        .triangles
        .as_flattened()
        .iter()
        .enumerate()
        .map(|(index, corner)| {
            cube.vertices[*corner as usize].position.map(|x| x + (index % 5) as f32 * 1e-6)
        })
        .collect();
    let corners: Vec<[u32; 3]> = (0..12).map(|face| [face * 3, face * 3 + 1, face * 3 + 2]).collect();
    let (document, bytes) = plain_model(&model(&points, &corners));
    let bytes = container(&document, &bytes);
    let whole = import(&bytes, "crate").unwrap();
    assert_eq!((whole.report.repair.open, whole.report.repair.edges), (0, 18));
    assert!(near(whole.report.volume, 1.0, 1e-4));
    let apart =
        import_glb(&bytes, &thing("crate"), &ImportConfig { weld: 0.0, ..ImportConfig::default() }).unwrap();
    assert!(apart.report.repair.open > 0);
    let strict = ImportConfig { weld: 0.0, open: 0.0, ..ImportConfig::default() };
    let error = import_glb(&bytes, &thing("crate"), &strict).unwrap_err();
    assert!(matches!(error, ImportError::Unsound { field: "open", .. }), "{error}");
}

#[test]
fn what_has_no_area_is_dropped_and_counted() {
    let mut cube = cuboid([0.0; 3], [1.0; 3]);
    let (first, second) = (cube.triangles[0], cube.triangles[5]);
    cube.triangles.extend([[0, 0, 1], [3, 3, 3], first, [second[1], second[2], second[0]]]);
    cube.parts[0].triangles += 4;
    let (document, bytes) = plain_model(&cube);
    let mended = import(&container(&document, &bytes), "crate").unwrap();
    let repair = mended.report.repair;
    assert_eq!((repair.flat, repair.doubled, repair.open, repair.tangled), (2, 2, 0, 0));
    assert_eq!(own_model(&mended).triangles.len(), 12);

    let flat = model(&[[0.0; 3], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]], &[[0, 1, 2], [1, 1, 2]]);
    let (document, bytes) = plain_model(&flat);
    let error = import(&container(&document, &bytes), "crate").unwrap_err();
    assert_eq!(error, ImportError::NoArea { triangles: 2 });
}

#[test]
fn surfaces_look_outward() {
    let mut cube = cuboid([0.0; 3], [1.0; 3]);
    let upright = own_model(&import(&export(&cube), "crate").unwrap()).clone();
    for over in [vec![3], vec![0, 4, 5, 9], (0..12usize).collect()] {
        let mut some = cube.clone();
        for face in &over {
            some.triangles[*face].swap(0, 1);
        }
        let mended = import(&export(&some), "crate").unwrap();
        assert_eq!(mended.report.repair.turned, over.len());
        assert!(near(mended.report.volume, 1.0, 1e-9));
        assert_eq!(own_model(&mended).hulls, upright.hulls);
    }
    // A Möbius strip has no outside.
    let strip: Vec<[f32; 3]> = (0..12u8)
        .flat_map(|step| {
            let turn = f64::from(step) / 12.0 * std::f64::consts::TAU;
            [-0.2, 0.2].map(|side: f64| {
                let reach = 1.0 + side * ops::cos(turn / 2.0);
                [reach * ops::cos(turn), reach * ops::sin(turn), side * ops::sin(turn / 2.0)]
                    .map(|x| x as f32)
            })
        })
        .collect();
    let at = |step: u32, side: u32| if step < 12 { step * 2 + side } else { 1 - side };
    let faces: Vec<[u32; 3]> = (0..12)
        .flat_map(|step| {
            let [a, b, c, d] = [at(step, 0), at(step, 1), at(step + 1, 1), at(step + 1, 0)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    cube = model(&strip, &faces);
    let error = import(&export(&cube), "fountain").unwrap_err();
    assert!(matches!(error, ImportError::Unsound { field: "tangled", .. }), "{error}");
}

fn export(model: &Model) -> Vec<u8> {
    let (document, bytes) = plain_model(model);
    container(&document, &bytes)
}

#[test]
fn walls_within_are_refused_unless_they_are_allowed() {
    // Two boxes that share a wall, which is there once: its edges lie between three triangles.
    let mut cells = cuboid([0.0; 3], [0.5, 1.0, 1.0]);
    let more = cuboid([0.5, 0.0, 0.0], [1.0, 1.0, 1.0]);
    let first = cells.vertices.len() as u32;
    cells.vertices.extend(&more.vertices);
    let wall = |triangle: &&[u32; 3]| {
        !triangle.iter().all(|vertex| more.vertices[*vertex as usize].position[0] < 0.6)
    };
    let outside: Vec<[u32; 3]> =
        more.triangles.iter().filter(wall).map(|face| face.map(|x| first + x)).collect();
    assert_eq!(outside.len(), 10);
    cells.triangles.extend(outside);
    cells.parts[0].triangles = cells.triangles.len() as u32;
    let bytes = export(&cells);
    let error = import(&bytes, "crate").unwrap_err();
    assert!(matches!(error, ImportError::Unsound { count: 4, field: "tangled", .. }), "{error}");
    let any = ImportConfig { tangled: 1.0, ..ImportConfig::default() };
    let crate_of_two = import_glb(&bytes, &thing("crate"), &any).unwrap();
    assert!(near(crate_of_two.report.volume, 1.0, 0.02), "by its hulls: {}", crate_of_two.report.volume);
}

#[test]
fn a_table_stands_on_legs() {
    let table = import(&export(&table()), "table").unwrap();
    let hulls = &own_model(&table).hulls;
    assert!(hulls.len() >= 5, "{} hulls", hulls.len());
    assert_eq!(table.report.hulls, hulls.len());
    for most in [1, 4, 9, 32] {
        let config = ImportConfig { hulls: most, ..ImportConfig::default() };
        let count = import_glb(&export(&crate::assets_common::table()), &thing("table"), &config)
            .unwrap()
            .report
            .hulls;
        assert!((1..=most as usize).contains(&count), "{count} of {most}");
    }
    // Every vertex is met where it is seen.
    let voxel = 1.2 / 47.0;
    for vertex in &own_model(&table).vertices {
        let is_in = |points: &[[f32; 3]]| {
            (0..3).all(|axis| {
                let of = points.iter().map(|point| point[axis]);
                let (low, high) = (of.clone().fold(f32::MAX, f32::min), of.fold(f32::MIN, f32::max));
                (low - voxel..=high + voxel).contains(&vertex.position[axis])
            })
        };
        assert!(hulls.iter().any(|hull| is_in(&hull.points)), "{:?}", vertex.position);
    }
    // 0.048 m³ of top, 0.0098 of legs; wood, nearly full.
    assert!(near(table.report.volume, 0.0578, 1e-3), "{}", table.report.volume);
    assert!((20.0..32.0).contains(&table.asset.mass.unwrap()), "{:?}", table.asset.mass);
}

#[test]
fn the_same_bytes_are_the_same_asset() {
    let bytes = export(&dented_ball(3000, 0.11));
    let [once, twice] = [(); 2].map(|()| import(&bytes, "ball").unwrap());
    assert_eq!(postcard::to_stdvec(&once.asset).unwrap(), postcard::to_stdvec(&twice.asset).unwrap());
    assert!(once.asset.source.starts_with("glb "), "{}", once.asset.source);
    let other = import(&export(&dented_ball(3000, 0.12)), "ball").unwrap();
    assert_ne!(once.asset.source, other.asset.source);
}

#[test]
fn sheets_and_absurd_sizes_are_refused() {
    let sheet =
        model(&[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2], [0, 2, 3]]);
    let config = ImportConfig { unit: Unit::Metres, ..ImportConfig::default() };
    let error = import_glb(&export(&sheet), &thing("sign"), &config).unwrap_err();
    assert!(matches!(error, ImportError::Flat { .. }), "{error}");
    let cube = export(&cuboid([0.0; 3], [40.0; 3]));
    assert!(matches!(import(&cube, "car").unwrap_err(), ImportError::Size { .. }));
    assert!(matches!(import(&cube, "gizmo").unwrap_err(), ImportError::NoSize { .. }));
    let error = import_glb(&cube, &thing("car"), &ImportConfig { voxels: 4, ..config }).unwrap_err();
    assert!(matches!(error, ImportError::Config(_)), "{error}");
    // 2 km are no thing.
    let error = import_glb(&export(&cuboid([0.0; 3], [2000.0; 3])), &thing("tower"), &config).unwrap_err();
    assert!(matches!(error, ImportError::Asset(_)), "{error}");
}
