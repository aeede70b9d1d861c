//! Worlds and commands by chance, for the property tests.

use proptest::prelude::*;
use simworld_core::action::{Action, ActionKind};
use simworld_core::alteration::Alteration;
use simworld_core::asset::Asset;
use simworld_core::command::Command;
use simworld_core::environment::Environment;
use simworld_core::geometry::{Point3, Pose, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{Attachment, EntityDesc, EntityKind, Role, Shape, Solidity, Visibility, World};
use simworld_core::testing::sample_action;

pub(crate) fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        20 => -60.0..60.0,
        1 => prop::sample::select(vec![f64::NAN, f64::INFINITY, -1e300, 1.2e7, 0.0]),
    ]
}

pub(crate) fn any_pose() -> impl Strategy<Value = Pose> {
    (any_number(), any_number(), -3.0..3.0).prop_map(|(x, y, yaw)| pose_facing(Point3::new(x, y, 0.0), yaw))
}

/// One of the ids that a small world gives, or one that nobody has.
pub(crate) fn any_id() -> impl Strategy<Value = EntityId> {
    (0_u32..12, 0_u32..3).prop_map(|(index, generation)| EntityId::new(index, generation.saturating_sub(1)))
}

fn any_kind() -> impl Strategy<Value = EntityKind> {
    use EntityKind::{Bench, Car, Chair, Parcel, Person, Scooter};
    prop::sample::select(vec![Bench, Car, Chair, Parcel, Person, Person, Scooter])
}

fn any_bond() -> impl Strategy<Value = Attachment> {
    let roles = prop::sample::select(vec![Role::Held, Role::Carried, Role::Seated, Role::Part]);
    (any_id(), roles, any_pose()).prop_map(|(parent, role, parent_from_body)| Attachment {
        parent,
        role,
        parent_from_body,
    })
}

pub(crate) fn any_desc() -> impl Strategy<Value = EntityDesc> {
    let sizes = (0.2..3.0, 0.2..3.0, any_number());
    (any_kind(), any_pose(), sizes, any_number(), prop::option::weighted(0.2, any_bond())).prop_map(
        |(kind, pose, (x, y, z), speed, attachment)| {
            let mut desc = EntityDesc::new(kind, pose, Shape::cuboid(x, y, z.abs().max(0.1)));
            desc.twist = Twist { linear: Vector3::new(speed, 0.0, 0.0), ..Twist::ZERO };
            desc.attachment = attachment;
            desc
        },
    )
}

/// Few names, so that some are taken; some have no size.
fn any_asset() -> impl Strategy<Value = Asset> {
    ("[ab]", any_kind(), any_number())
        .prop_map(|(name, kind, size)| Asset::new(name, kind, Shape::cuboid(1.0, 1.0, size)))
}

fn any_alteration() -> impl Strategy<Value = Alteration> {
    let sizes = (0.2..3.0, 0.2..3.0, any_number());
    prop_oneof![
        2 => sizes.prop_map(|(x, y, z)| Alteration::Shape(Shape::cuboid(x, y, z))),
        // Some are no colours.
        1 => prop::option::of(prop::array::uniform3(-0.2..1.2_f32)).prop_map(Alteration::Color),
        1 => prop::option::of("[a-z]{0,8}").prop_map(Alteration::Name),
        1 => prop::sample::select(vec![Visibility::Shown, Visibility::Hidden]).prop_map(Alteration::Visibility),
        1 => prop::sample::select(vec![Solidity::OfItsKind, Solidity::Solid, Solidity::Hollow])
            .prop_map(Alteration::Solidity),
    ]
}

/// A command that can be taken back.
pub(crate) fn any_change() -> impl Strategy<Value = Command> {
    let place = (any_id(), any_pose(), any_number(), prop::option::of(any_bond()));
    prop_oneof![
        4 => any_desc().prop_map(|desc| Command::Spawn(Box::new(desc))),
        2 => any_id().prop_map(|id| Command::Remove { id }),
        1 => (any_id(), any_desc(), prop::collection::vec((any_id(), any_bond()), 0..2))
            .prop_map(|(id, desc, load)| Command::Respawn { id, desc: Box::new(desc), load }),
        3 => (any_id(), any_pose()).prop_map(|(id, pose)| Command::Move { id, pose }),
        1 => place.prop_map(|(id, pose, speed, bond)| {
            let twist = Twist { linear: Vector3::new(0.0, speed, 0.0), ..Twist::ZERO };
            Command::Reset { id, pose, twist, bond }
        }),
        2 => (any_id(), prop::option::of(any_number())).prop_map(|(id, value)| {
            // NaN is unequal to itself; it would fail every comparison of worlds.
            let value = value.filter(|number| !number.is_nan()).map(Into::into);
            Command::SetAttribute { id, key: "charge".to_owned(), value }
        }),
        3 => (any_id(), any_alteration()).prop_map(|(id, alteration)| Command::Alter { id, alteration }),
        3 => (any_id(), prop::option::of(any_bond()))
            .prop_map(|(child, bond)| Command::Attach { child, bond }),
        1 => any_number().prop_map(|rain| {
            let mut environment = Environment::default();
            environment.weather.rain = rain;
            Command::SetEnvironment(environment)
        }),
    ]
}

/// Any command at all.
pub(crate) fn any_command() -> impl Strategy<Value = Command> {
    let action = (any_id(), prop::sample::select(ActionKind::ALL), any_id(), any_number());
    prop_oneof![
        4 => any_change(),
        4 => action.prop_map(|(who, kind, whom, number)| {
            let action = match kind {
                ActionKind::MoveForward => Action::MoveForward { speed: number },
                ActionKind::Rotate => Action::Rotate { angle: number },
                kind => sample_action(kind, whom),
            };
            Command::Actuate { who, action }
        }),
        1 => any_asset().prop_map(|asset| Command::AddAsset(Box::new(asset))),
        1 => any_id().prop_map(|who| Command::Intend { who, intent: Intent::call("rest") }),
    ]
}

/// A world with a person, a chair, a parcel, a scooter and a car within reach of each other.
pub(crate) fn small_world() -> World {
    let mut world = World::new();
    let things = [
        (EntityKind::Person, Shape::Capsule { radius: 0.25, height: 1.8 }),
        (EntityKind::Chair, Shape::cuboid(0.5, 0.5, 0.9)),
        (EntityKind::Parcel, Shape::cuboid(0.3, 0.3, 0.2)),
        (EntityKind::Scooter, Shape::cuboid(1.2, 0.5, 1.2)),
        (EntityKind::Car, Shape::cuboid(4.5, 1.8, 1.5)),
    ];
    for (index, (kind, shape)) in things.into_iter().enumerate() {
        let pose = pose_facing(Point3::new(index as f64 * 0.4, 0.0, 0.0), 0.0);
        world.spawn(EntityDesc::new(kind, pose, shape)).expect("the thing is sound");
    }
    world
}

/// Everything a reader can see of a world, but for the history of its slots.
pub(crate) fn contents(world: &World) -> Vec<(EntityId, EntityDesc)> {
    world.iter().map(|entity| (entity.id, entity.to_desc())).collect()
}

/// A world down to the last bit, NaN in a pending action included.
pub(crate) fn bytes(world: &World) -> Vec<u8> {
    postcard::to_stdvec(&world.snapshot()).expect("a snapshot is plain data")
}
