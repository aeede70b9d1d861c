//! A step looks at what changed in the world, and the engine has the same as if it had looked at everything.

use crate::common::{PERSON, Stage, at};
use simworld_core::action::Action;
use simworld_core::alteration::Alteration;
use simworld_core::command::Command;
use simworld_core::geometry::{Pose, Twist, Vector3};
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::scene::{Attachment, EntityKind, Role, Scene, Shape, Solidity};
use simworld_core::seam::Dynamics;
use simworld_core::seed::{Seed, StreamRng};
use simworld_physics::HumanoidConfig;

/// What somebody else does to the world or the physics between two steps.
#[derive(Clone, Debug)]
enum Deed {
    Spawn(EntityKind, Pose),
    Remove(EntityId),
    Drive(EntityId, Pose, Twist),
    Resize(EntityId, f64),
    Hollow(EntityId, bool),
    Hand(EntityId, EntityId),
    PutDown(EntityId),
    Embody(EntityId),
    Disembody(EntityId),
    Walk(EntityId, f64),
}

fn deed(rng: &mut StreamRng, all: &[EntityId]) -> Option<Deed> {
    let place = at(rng.uniform(-12.0, 12.0), rng.uniform(-12.0, 12.0), rng.uniform(-3.0, 3.0));
    let (one, other) = (*rng.choose(all)?, *rng.choose(all)?);
    Some(match rng.below(10) {
        0 => Deed::Spawn(*rng.choose(&[EntityKind::Building, EntityKind::Car, EntityKind::Parcel])?, place),
        1 => Deed::Remove(one),
        2 => {
            let linear = Vector3::new(rng.uniform(-3.0, 3.0), 0.0, 0.0);
            Deed::Drive(one, place, Twist { linear, angular: Vector3::zeros() })
        }
        3 => Deed::Resize(one, rng.uniform(0.2, 2.0)),
        4 => Deed::Hollow(one, rng.chance(0.5)),
        5 => Deed::Hand(one, other),
        6 => Deed::PutDown(one),
        7 => Deed::Embody(one),
        8 => Deed::Disembody(one),
        _ => Deed::Walk(one, rng.uniform(0.0, 2.0)),
    })
}

/// What cannot be done is left undone, by all alike.
fn undertake(stage: &mut Stage, deed: &Deed) {
    let world = &mut stage.world;
    let _: Option<()> = match deed {
        Deed::Spawn(kind, pose) => {
            stage.spawn(*kind, *pose, Shape::cuboid(1.0, 0.6, 1.0));
            None
        }
        Deed::Remove(id) => world.remove(*id).map(drop).ok(),
        Deed::Drive(id, pose, twist) => world.set_motion(*id, *pose, *twist).ok(),
        Deed::Resize(id, size)
            if world.entity(*id).is_some_and(|entity| entity.kind != EntityKind::Person) =>
        {
            let alteration = Alteration::Shape(Shape::cuboid(*size, *size, *size));
            world.apply(&Command::Alter { id: *id, alteration }).map(drop).ok()
        }
        Deed::Resize(..) => None,
        Deed::Hollow(id, hollow) => {
            let solidity = if *hollow { Solidity::Hollow } else { Solidity::Solid };
            world
                .apply(&Command::Alter { id: *id, alteration: Alteration::Solidity(solidity) })
                .map(drop)
                .ok()
        }
        Deed::Hand(child, parent) => {
            let bond = Attachment { parent: *parent, role: Role::Ridden, parent_from_body: Pose::identity() };
            world.apply(&Command::Attach { child: *child, bond: Some(bond) }).map(drop).ok()
        }
        Deed::PutDown(child) => world.apply(&Command::Attach { child: *child, bond: None }).map(drop).ok(),
        Deed::Embody(id) if world.entity(*id).is_some_and(|entity| entity.kind == EntityKind::Person) => {
            stage.physics.add_humanoid(&stage.world, *id, HumanoidConfig::default()).ok()
        }
        Deed::Embody(id) => stage.physics.add_rigid(&stage.world, *id).ok(),
        Deed::Disembody(id) => stage.physics.remove(*id).ok(),
        Deed::Walk(id, speed) => world.actuate(*id, Action::MoveForward { speed: *speed }).ok(),
    };
}

fn hash(stage: &Stage) -> u64 {
    let mut hasher = StateHasher::new();
    stage.physics.state_hash(&mut hasher);
    hasher.finish().0
}

#[test]
fn looking_at_what_changed_is_as_good_as_looking_at_everything() {
    for seed in 0..40 {
        let mut rng = Seed(seed).stream("test/changes").rng();
        // The second forgets in each step when it looked last, as whoever is restored does.
        let mut stages = vec![Stage::new(), Stage::new()];
        for stage in &mut stages {
            for index in 0..6 {
                stage.person(at(f64::from(index) * 2.0 - 5.0, 0.0, 0.0));
                stage.spawn(EntityKind::Person, at(f64::from(index) * 2.0 - 5.0, 3.0, 0.0), PERSON);
                stage.building(f64::from(index) * 2.0 - 5.0, 6.0, (1.0, 1.0, 2.0));
            }
        }
        for step in 0..60 {
            let saved = stages[1].physics.save().expect("it can be saved");
            let Stage { world, physics, .. } = &mut stages[1];
            physics.restore(world, &saved).expect("its own state is taken up");
            let all: Vec<EntityId> = stages[0].world.iter().map(|entity| entity.id).collect();
            let deeds: Vec<Deed> = (0..3).filter_map(|_| deed(&mut rng, &all)).collect();
            for stage in &mut stages {
                for deed in &deeds {
                    undertake(stage, deed);
                }
            }
            stages.iter_mut().for_each(Stage::step);
            let (looked, forgot) = (&stages[0], &stages[1]);
            assert_eq!(hash(looked), hash(forgot), "seed {seed}, step {step}, after {deeds:?}");
            let poses = |stage: &Stage| -> Vec<(EntityId, Pose)> {
                stage.world.iter().map(|entity| (entity.id, *entity.pose)).collect()
            };
            assert_eq!(poses(looked), poses(forgot), "seed {seed}, step {step}");
        }
    }
}
