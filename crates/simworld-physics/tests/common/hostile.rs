//! Settings, descriptions and models with hostile numbers in them: a physics takes none of them up, or steps with it, or says why not.

use std::sync::Arc;

use serde::Serialize;
use serde::de::DeserializeOwned;
use simworld_core::action::Action;
use simworld_core::asset::{
    Asset, Finish, Hull, Model, ModelPart, ModelVertex, Paint, Pictures, Transparency,
};
use simworld_core::geometry::{Point3, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_physics::{
    CartConfig, DoorConfig, Grip, HumanoidConfig, PhysicsConfig, PhysicsDynamics, PhysicsError,
    QuadrupedConfig, QuadrupedModel, RobotConfig, VehicleClass,
};

/// How many kinds of bodies there are.
pub(crate) const KINDS: u8 = 8;

/// A number somewhere in some settings: which of them, and what it becomes.
pub(crate) type Change = (u16, f64);

/// A body of some kind in a world.
#[derive(Clone, Debug, serde::Deserialize)]
pub(crate) struct Hostile {
    pub(crate) kind: u8,
    /// Of the settings of the physics, and of those of the body.
    pub(crate) world: Vec<Change>,
    pub(crate) body: Vec<Change>,
    /// How much larger it is than usual, and its mass, kg.
    pub(crate) stretch: [f64; 3],
    pub(crate) mass: f64,
    /// How fast it is, m/s.
    pub(crate) velocity: [f64; 3],
    /// Corners of a model, m.
    pub(crate) corners: Vec<[f32; 3]>,
}

/// The settings with some of their numbers changed, if they still are any: a number is where eight bytes read as a usual one.
pub(crate) fn changed<T: Serialize + DeserializeOwned>(settings: &T, changes: &[Change]) -> Option<T> {
    let mut bytes = postcard::to_allocvec(settings).ok()?;
    let mut numbers = Vec::new();
    let mut at = 0;
    while let Some(number) = bytes.get(at..at + 8).and_then(|window| window.try_into().ok()) {
        let is_usual = (1e-6..1e7).contains(&f64::from_le_bytes(number).abs());
        if is_usual {
            numbers.push(at);
        }
        at += if is_usual { 8 } else { 1 };
    }
    for (which, number) in changes {
        let at = numbers.get(usize::from(*which) % numbers.len().max(1))?;
        bytes[*at..*at + 8].copy_from_slice(&number.to_le_bytes());
    }
    postcard::from_bytes(&bytes).ok()
}

/// Whatever it is: no panic, and as long as the physics says that all is well, the world is finite. Whether it was taken up, and was well
/// all the time.
pub(crate) fn survives(hostile: &Hostile) -> bool {
    let Some(config) = changed(&PhysicsConfig::default(), &hostile.world) else { return false };
    let Ok(mut physics) = PhysicsDynamics::new(config) else { return false };
    let mut world = World::new();
    let Some(id) = put(&mut world, hostile) else { return false };
    if embody(&mut physics, &world, id, hostile).is_none_or(|done| done.is_err()) {
        return false;
    }
    // What the world refuses does not reach the body.
    let _ = world.actuate(id, Action::MoveForward { speed: 1.5 });
    let _ = world.actuate(id, Action::Throttle { level: 0.7 });
    for _ in 0..3 {
        world.begin_step();
        let well = physics.step(&mut world, 0.1).is_ok();
        world.finish_step();
        let body = world.entity(id).expect("nobody took it away");
        let numbers = body.pose.translation.vector.iter().chain(body.pose.rotation.coords.iter());
        let mut numbers = numbers.chain(body.twist.linear.iter()).chain(body.twist.angular.iter());
        assert!(numbers.all(|number| number.is_finite()), "{:?} {:?}", body.pose, body.twist);
        if !well {
            return false;
        }
    }
    true
}

/// Its entity, if the world takes one of that shape.
fn put(world: &mut World, hostile: &Hostile) -> Option<EntityId> {
    let usual = match hostile.kind % KINDS {
        0 => (EntityKind::Person, Shape::Capsule { radius: 0.25, height: 1.75 }),
        1 => (EntityKind::Car, Shape::cuboid(4.3, 1.8, 1.5)),
        2 => (EntityKind::Prop, Shape::cuboid(0.9, 0.55, 0.6)),
        3 => (EntityKind::Door, Shape::cuboid(0.04, 1.0, 2.0)),
        4 => (EntityKind::Dog, Shape::cuboid(0.7, 0.35, 0.5)),
        5 => (EntityKind::Robot, Shape::cuboid(0.7, 0.35, 0.5)),
        _ => (EntityKind::Prop, Shape::cuboid(1.0, 1.0, 1.0)),
    };
    let [x, y, z] = hostile.stretch;
    let (kind, shape) = match usual {
        (kind, Shape::Box { size }) => {
            (kind, Shape::Box { size: size.component_mul(&Vector3::new(x, y, z)) })
        }
        (kind, Shape::Capsule { radius, height }) => {
            (kind, Shape::Capsule { radius: radius * x, height: height * z })
        }
        other => other,
    };
    let pose = pose_facing(Point3::new(0.0, 0.0, 0.3), 0.3);
    let mut desc = if hostile.kind % KINDS == 7 {
        let (model, shape) = model(&hostile.corners);
        let asset = Asset { model: Some(Arc::new(model)), ..Asset::new("thing", kind, shape) };
        let id = world.add_asset(asset.clone()).ok()?;
        asset.at(id, pose)
    } else {
        EntityDesc::new(kind, pose, shape)
    };
    desc = desc.weighing(hostile.mass);
    desc.twist.linear = Vector3::from(hostile.velocity);
    world.spawn(desc).ok()
}

/// A model with one hull, and the box that it fills.
fn model(corners: &[[f32; 3]]) -> (Model, Shape) {
    let ends = |axis: usize| {
        let along = corners.iter().map(|corner| corner[axis]);
        [along.clone().fold(f32::INFINITY, f32::min), along.fold(f32::NEG_INFINITY, f32::max)]
    };
    let [x, y, z] = [0, 1, 2].map(ends);
    let origin = [0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1]), z[0]];
    let corners: Vec<[f32; 3]> =
        corners.iter().map(|corner| std::array::from_fn(|axis| corner[axis] - origin[axis])).collect();
    let size = [x, y, z].map(|[low, high]| f64::from(high - low));
    let vertex = |position: &[f32; 3]| ModelVertex {
        position: *position,
        normal: [0.0, 0.0, 1.0],
        color: [1.0; 3],
        ..ModelVertex::default()
    };
    let count = corners.len() as u32;
    let triangles: Vec<[u32; 3]> = (2..count).map(|third| [0, third - 1, third]).collect();
    let part = ModelPart {
        name: "part".to_owned(),
        triangles: triangles.len() as u32,
        paint: Paint::Own,
        finish: Finish::default(),
        texture: None,
        transparency: Transparency::Opaque,
        pictures: Pictures::default(),
        two_sided: false,
    };
    let model = Model {
        vertices: corners.iter().map(vertex).collect(),
        triangles,
        hulls: vec![Hull { points: corners }],
        parts: vec![part],
        ..Model::default()
    };
    (model, Shape::Box { size: Vector3::from(size) })
}

/// Gives it its body; none where the settings are no settings any more.
fn embody(
    physics: &mut PhysicsDynamics,
    world: &World,
    id: EntityId,
    hostile: &Hostile,
) -> Option<Result<(), PhysicsError>> {
    let changes = &hostile.body;
    Some(match hostile.kind % KINDS {
        0 => physics.add_humanoid(world, id, changed(&HumanoidConfig::default(), changes)?),
        1 => physics.add_vehicle(world, id, changed(&VehicleClass::Sedan.parameters(), changes)?),
        2 => physics.add_cart(world, id, changed(&CartConfig::default(), changes)?),
        3 => physics.add_door(world, id, changed(&DoorConfig::default(), changes)?),
        4 => physics.add_quadruped(world, id, changed(&QuadrupedConfig::default(), changes)?),
        5 => {
            let dog = RobotConfig::from(QuadrupedModel::default().description());
            physics.add_robot(world, id, changed(&dog, changes)?)
        }
        _ => physics.add_rigid(world, id).map(|()| {
            // Nobody holds himself, whatever the grip.
            let grip = changed(&Grip::default(), changes);
            assert!(grip.is_none_or(|grip| physics.grasp(world, id, id, None, grip).is_err()));
        }),
    })
}
