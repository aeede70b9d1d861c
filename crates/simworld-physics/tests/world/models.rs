//! Assets with a model are met as their hulls: what has an opening lets things through.

use std::sync::Arc;

use crate::common::{Stage, at};
use nalgebra::UnitQuaternion;
use simworld_core::asset::{Asset, Catalogue, Hull, Material, Model, ModelPart, ModelVertex};
use simworld_core::geometry::{Point3, Pose, Vector3, pose_facing};
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape};
use simworld_core::seam::Dynamics;
use simworld_physics::{PhysicsConfig, PhysicsDynamics};

/// Boxes between their lowest and highest corners as one model.
fn boxes(solids: &[[[f32; 3]; 2]]) -> Model {
    let mut model = Model::default();
    for [low, high] in solids {
        let corner =
            |k: u32| std::array::from_fn(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
        let first = model.vertices.len() as u32;
        let points: Vec<[f32; 3]> = (0..8).map(corner).collect();
        let vertex = |position: &[f32; 3]| ModelVertex {
            position: *position,
            normal: [0.0, 0.0, 1.0],
            color: [1.0; 3],
            ..ModelVertex::default()
        };
        model.vertices.extend(points.iter().map(vertex));
        for quad in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
            let [a, b, c, d] = quad.map(|corner| first + corner);
            model.triangles.extend([[a, b, c], [a, c, d]]);
        }
        model.hulls.push(Hull { points });
    }
    let triangles = model.triangles.len() as u32;
    model.parts.push(ModelPart { name: "boxes".to_owned(), triangles, ..ModelPart::default() });
    model
}

/// Two piers and a lintel over an opening 2 m wide and high.
fn arch() -> Asset {
    let model = boxes(&[
        [[-0.5, -1.5, 0.0], [0.5, -1.0, 2.0]],
        [[-0.5, 1.0, 0.0], [0.5, 1.5, 2.0]],
        [[-0.5, -1.5, 2.0], [0.5, 1.5, 2.5]],
    ]);
    asset("arch", Shape::cuboid(1.0, 3.0, 2.5), 4000.0, model)
}

/// A top on four legs, 0.7 m of room under it.
fn table() -> Asset {
    let leg = |x: f32, y: f32| [[x - 0.05, y - 0.05, 0.0], [x + 0.05, y + 0.05, 0.7]];
    let model = boxes(&[
        [[-0.5, -0.7, 0.7], [0.5, 0.7, 0.75]],
        leg(0.45, 0.65),
        leg(-0.45, 0.65),
        leg(-0.45, -0.65),
        leg(0.45, -0.65),
    ]);
    asset("table", Shape::cuboid(1.0, 1.4, 0.75), 20.0, model)
}

fn asset(name: &str, collider: Shape, mass: f64, model: Model) -> Asset {
    let asset = Asset::new(name, EntityKind::Prop, collider);
    Asset { mass: Some(mass), material: Some(Material::Wood), model: Some(Arc::new(model)), ..asset }
}

fn put(stage: &mut Stage, asset: &Asset, pose: Pose, stretch: f64) -> EntityId {
    let id = stage.world.add_asset(asset.clone()).expect("the models here fit their colliders");
    let mut desc: EntityDesc = asset.at(id, pose);
    if let Shape::Box { size } = &mut desc.info.shape {
        *size *= stretch;
    }
    stage.world.spawn(desc).expect("a solid in the world")
}

fn drop_in(stage: &mut Stage, at: [f64; 3], shape: Shape) -> EntityId {
    let id = stage.spawn(EntityKind::Prop, pose_facing(Point3::from(at), 0.0), shape);
    stage.physics.add_rigid(&stage.world, id).expect("it has no body yet");
    id
}

#[test]
fn a_box_falls_through_an_opening() {
    let mut stage = Stage::new();
    // It lies on its back: the opening looks up, from x = -2 to 0.
    let lying = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -std::f64::consts::FRAC_PI_2);
    let pose = Pose::from_parts(Vector3::new(0.0, 0.0, 0.5).into(), lying);
    put(&mut stage, &arch(), pose, 1.0);
    let through = drop_in(&mut stage, [-1.0, 0.0, 3.0], Shape::cuboid(0.6, 0.6, 0.4));
    let on = drop_in(&mut stage, [-2.25, 0.0, 3.0], Shape::cuboid(0.3, 0.3, 0.3));
    stage.run(40);
    assert!(
        stage.position(through).z.abs() < 0.02,
        "it lies on the ground, at {}",
        stage.position(through).z
    );
    assert!((stage.position(on).z - 1.0).abs() < 0.05, "it lies on the lintel, at {}", stage.position(on).z);
}

#[test]
fn a_ball_rests_on_a_table_and_rolls_under_it() {
    let mut stage = Stage::new();
    put(&mut stage, &table(), at(0.0, 0.0, 0.0), 1.0);
    let resting = drop_in(&mut stage, [0.1, 0.2, 1.0], Shape::Sphere { radius: 0.1 });
    let shape = Shape::Sphere { radius: 0.2 };
    let mut start = EntityDesc::new(EntityKind::Prop, pose_facing(Point3::new(-2.0, 0.0, 0.0), 0.0), shape);
    start.twist.linear = Vector3::new(3.0, 0.0, 0.0);
    let rolling = stage.world.spawn(start).unwrap();
    stage.physics.add_rigid(&stage.world, rolling).unwrap();
    stage.run(20);
    assert!((stage.position(resting).z - 0.75).abs() < 0.01, "{}", stage.position(resting));
    assert!(stage.position(rolling).x > 1.0, "it came through: {}", stage.position(rolling));
}

#[test]
fn a_larger_one_is_met_larger() {
    let mut stage = Stage::new();
    put(&mut stage, &table(), at(0.0, 0.0, 0.0), 2.0);
    let on = drop_in(&mut stage, [0.8, 1.2, 2.0], Shape::cuboid(0.2, 0.2, 0.2));
    let under = drop_in(&mut stage, [0.0, 0.0, 0.5], Shape::cuboid(0.2, 0.2, 0.2));
    stage.run(30);
    assert!((stage.position(on).z - 1.5).abs() < 0.01, "{}", stage.position(on));
    assert!(stage.position(under).z.abs() < 0.01, "{}", stage.position(under));
}

#[test]
fn a_table_tumbles_as_itself() {
    let mut stage = Stage::new();
    let tilt = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.3);
    let id = put(&mut stage, &table(), Pose::from_parts(Vector3::new(0.0, 0.0, 1.5).into(), tilt), 1.0);
    stage.physics.add_rigid(&stage.world, id).unwrap();
    let ball = drop_in(&mut stage, [0.0, 0.0, 0.0], Shape::Sphere { radius: 0.25 });
    stage.run(60);
    assert!(stage.velocity(id).norm() < 0.01, "it has come to rest");
    assert!(stage.position(id).z.abs() < 0.02, "it stands on its legs: {}", stage.position(id));
    assert!(stage.position(ball).z.abs() < 0.02, "the ball is under it: {}", stage.position(ball));
}

#[test]
fn a_save_goes_on_bit_for_bit() {
    let mut stage = Stage::new();
    put(&mut stage, &arch(), at(2.0, 0.0, 0.3), 1.0);
    let id = put(&mut stage, &table(), pose_facing(Point3::new(0.0, 0.0, 1.0), 0.0), 1.0);
    stage.physics.add_rigid(&stage.world, id).unwrap();
    stage.run(5);
    let (saved, world) = (stage.physics.save().unwrap(), stage.world.clone());
    let mut again = PhysicsDynamics::new(PhysicsConfig::default()).unwrap();
    again.add_rigid(&world, id).unwrap();
    again.restore(&world, &saved).unwrap();
    let mut other = Stage { world, physics: again, contacts: Vec::new(), events: Vec::new() };
    stage.run(15);
    other.run(15);
    let hash = |stage: &Stage| {
        let mut hasher = StateHasher::new();
        stage.physics.state_hash(&mut hasher);
        hasher.finish()
    };
    assert_eq!(hash(&stage), hash(&other));
    assert_eq!(stage.position(id), other.position(id));
}

fn of_library(name: &str) -> Asset {
    let library = Catalogue::library();
    library.find(name).and_then(|id| library.get(id)).unwrap_or_else(|| panic!("no {name}")).clone()
}

/// A ball goes through the archway of the library, and not through its piers.
#[test]
fn one_goes_through_an_archway_and_not_through_a_pier() {
    let mut stage = Stage::new();
    put(&mut stage, &of_library("archway"), at(0.0, 0.0, 0.0), 1.0);
    let [through, against] = [0.0, 1.6].map(|y| {
        let pose = pose_facing(Point3::new(-2.0, y, 0.0), 0.0);
        let mut start = EntityDesc::new(EntityKind::Prop, pose, Shape::Sphere { radius: 0.3 });
        start.twist.linear = Vector3::new(3.0, 0.0, 0.0);
        let id = stage.world.spawn(start).unwrap();
        stage.physics.add_rigid(&stage.world, id).unwrap();
        id
    });
    stage.run(20);
    assert!(stage.position(through).x > 1.0, "{}", stage.position(through));
    assert!(stage.position(against).x < 0.0, "{}", stage.position(against));
}

/// Every model of the library is a solid for the engine, and what is no luggage stands where it is put.
#[test]
fn the_things_of_the_library_stand() {
    let mut stage = Stage::new();
    let library = Catalogue::library();
    let modelled: Vec<&Asset> =
        library.iter().map(|(_, asset)| asset).filter(|asset| asset.model.is_some()).collect();
    let mut standing = Vec::new();
    for (rank, asset) in modelled.iter().enumerate() {
        let place = Point3::new(60.0 * (rank % 8) as f64, 60.0 * (rank / 8) as f64, 0.0);
        let id = put(&mut stage, asset, pose_facing(place, 0.3), 1.0);
        if asset.mass.is_some() {
            stage.physics.add_rigid(&stage.world, id).unwrap();
        }
        if asset.mass.is_some() && asset.kind != EntityKind::Parcel {
            standing.push((asset.name.as_str(), id, place));
        }
    }
    stage.run(30);
    assert!(standing.len() >= 15, "{}", standing.len());
    for (name, id, place) in standing {
        let (off, up) = ((stage.position(id) - place).norm(), stage.up(id));
        assert!(off < 0.15 && up > 0.95, "{name} is {off} m off, and its top is {up} up");
    }
}
