//! A GLB is read by another reader, lies where the city lies, and holds every building and element.

use gltf::Gltf;
use simworld_citygen::{City, CityConfig};
use simworld_core::seed::Seed;

fn glb(city: &City) -> Vec<u8> {
    let mut bytes = Vec::new();
    city.write_glb(&mut bytes).expect("memory takes all");
    bytes
}

fn city() -> City {
    City::generate(&CityConfig::with_roads(30), Seed(5)).expect("defaults are valid")
}

#[test]
fn another_reader_takes_it_without_complaint() {
    let bytes = glb(&city());
    // `from_slice` validates the document against the specification.
    let file = Gltf::from_slice(&bytes).unwrap();
    let blob = file.blob.clone().unwrap();
    assert_eq!(file.buffers().next().unwrap().length(), blob.len());
    for mesh in file.meshes() {
        for primitive in mesh.primitives() {
            let reader = primitive.reader(|_| Some(&blob));
            let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
            let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
            assert!(indices.len().is_multiple_of(3) && !indices.is_empty());
            assert!(indices.iter().all(|index| (*index as usize) < positions.len()));
            assert!(positions.iter().flatten().all(|x| x.is_finite()));
            let bounds = primitive.bounding_box();
            for axis in 0..3 {
                let low = positions.iter().map(|p| p[axis]).fold(f32::INFINITY, f32::min);
                let high = positions.iter().map(|p| p[axis]).fold(f32::NEG_INFINITY, f32::max);
                assert_eq!((low, high), (bounds.min[axis], bounds.max[axis]), "{:?}", mesh.name());
            }
        }
    }
}

#[test]
fn up_is_y_and_north_is_minus_z() {
    let city = city();
    let bytes = glb(&city);
    let file = Gltf::from_slice(&bytes).unwrap();
    let (low, high) = city.network.bounds().unwrap();
    let root = file.nodes().next().unwrap();
    let (translation, _, _) = root.transform().decomposed();
    assert!((f64::from(translation[0]) - (low.x + high.x) * 0.5).abs() < 0.01);
    assert!((f64::from(translation[2]) + (low.y + high.y) * 0.5).abs() < 0.01);
    let tallest = city.buildings.iter().map(simworld_citygen::building::Building::height).fold(0.0, f64::max);
    let buildings = file.meshes().find(|mesh| mesh.name() == Some("buildings")).unwrap();
    let top = buildings.primitives().map(|part| part.bounding_box().max[1]).fold(0.0, f32::max);
    // A pitched roof rises above the walls.
    assert!((-1e-3..12.0).contains(&(f64::from(top) - tallest)), "{top} {tallest}");
    // The northernmost wall is the one with the least z.
    let north = city
        .buildings
        .iter()
        .flat_map(simworld_citygen::building::Building::outline)
        .map(|p| p.y)
        .fold(f64::MIN, f64::max);
    let least = buildings.primitives().map(|part| part.bounding_box().min[2]).fold(f32::MAX, f32::min);
    assert!((f64::from(-least - translation[2]) - north).abs() < 0.01);
}

#[test]
fn every_tree_is_there() {
    let city = city();
    let bytes = glb(&city);
    let file = Gltf::from_slice(&bytes).unwrap();
    let count = |mesh: &str, material: &str| -> usize {
        file.meshes()
            .filter(|m| m.name() == Some(mesh))
            .flat_map(|m| m.primitives().collect::<Vec<_>>())
            .filter(|part| part.material().name() == Some(material))
            .map(|part| part.get(&gltf::Semantic::Positions).unwrap().count())
            .sum()
    };
    let trees = city.elements.iter().filter(|e| e.kind == simworld_core::scene::EntityKind::Tree).count();
    assert_eq!(count("elements", "leaves"), 8 * trees);
}

#[test]
fn a_city_far_away_keeps_its_shape() {
    let near = city();
    let mut plan = near.plan.clone();
    let shift = simworld_core::geometry::Vector2::new(800_000.0, -600_000.0);
    for point in plan.nodes.iter_mut().chain(plan.streets.iter_mut().flat_map(|street| &mut street.via)) {
        *point += shift;
    }
    let far = City::from_plan(plan, &CityConfig::default(), Seed(5)).unwrap();
    let (near, far) = (glb(&near), glb(&far));
    let roads = |bytes: &[u8]| -> Vec<[f32; 3]> {
        let file = Gltf::from_slice(bytes).unwrap();
        let mesh = file.meshes().find(|mesh| mesh.name() == Some("roads")).unwrap();
        let part = mesh.primitives().next().unwrap();
        part.reader(|_| file.blob.as_deref()).read_positions().unwrap().collect()
    };
    for (a, b) in roads(&near).iter().zip(&roads(&far)) {
        assert!((0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-3), "{a:?} {b:?}");
    }
}

/// Area of the faces that look up, seen from above, m²; x and z lie in the plane.
fn area_from_above(bytes: &[u8], materials: &[&str]) -> f64 {
    let file = Gltf::from_slice(bytes).expect("valid");
    let mut area = 0.0;
    for mesh in file.meshes() {
        for part in mesh.primitives().filter(|p| materials.contains(&p.material().name().unwrap_or(""))) {
            let reader = part.reader(|_| file.blob.as_deref());
            let positions: Vec<[f32; 3]> = reader.read_positions().expect("positions").collect();
            let indices: Vec<u32> = reader.read_indices().expect("indices").into_u32().collect();
            for triangle in indices.chunks_exact(3) {
                let [a, b, c] = [0, 1, 2].map(|i| positions[triangle[i] as usize].map(f64::from));
                // North is -z.
                let cross = (b[0] - a[0]) * (a[2] - c[2]) - (c[0] - a[0]) * (a[2] - b[2]);
                assert!(cross > -1e-6, "a roof looks up");
                area += cross * 0.5;
            }
        }
    }
    area
}

#[test]
fn roofs_cover_their_buildings() {
    let city = city();
    let own: f64 = city
        .buildings
        .iter()
        .map(|building| match building.footprint {
            simworld_citygen::building::Footprint::Stepped { .. } => {
                building.solids().map(|solid| 4.0 * solid.half_extents.x * solid.half_extents.y).sum()
            }
            _ => building.footprint_area(),
        })
        .sum();
    let drawn = area_from_above(&glb(&city), &["flat roof", "pitched roof"]);
    assert!((own - drawn).abs() < 1e-4 * own, "{own} {drawn}");
}
