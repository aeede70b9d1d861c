//! A world that was saved as bytes and restored goes on bit for bit, and damaged bytes are refused.

use crate::common::{any_command, bytes, small_world};
use proptest::prelude::*;
use simworld_core::command::Command;
use simworld_core::geometry::Pose;
use simworld_core::hash::StateHash;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World, WorldSnapshot};

fn step(world: &mut World, commands: &[Command]) {
    world.begin_step();
    for command in commands {
        let _ = world.apply(command);
    }
    world.finish_step();
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn a_restored_world_is_a_straight_run(
        steps in prop::collection::vec(prop::collection::vec(any_command(), 0..5), 2..14),
        share in 0.0..1.0,
    ) {
        let halt = (steps.len() as f64 * share) as usize;
        let mut straight = small_world();
        let mut halted = small_world();
        for commands in &steps[..halt] {
            step(&mut straight, commands);
            step(&mut halted, commands);
        }
        let saved = bytes(&halted);
        let snapshot: WorldSnapshot = postcard::from_bytes(&saved).unwrap();
        let mut resumed = World::restore(snapshot).unwrap();
        for commands in &steps[halt..] {
            step(&mut straight, commands);
            step(&mut resumed, commands);
            prop_assert_eq!(straight.digest(), resumed.digest());
        }
        prop_assert!(bytes(&straight) == bytes(&resumed));
    }

    #[test]
    fn damaged_bytes_are_refused_or_sound(
        commands in prop::collection::vec(any_command(), 0..20),
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut world = small_world();
        step(&mut world, &commands);
        let mut saved = bytes(&world);
        for (index, value) in flips {
            let at = index.index(saved.len());
            saved[at] = value;
        }
        if let Ok(snapshot) = postcard::from_bytes::<WorldSnapshot>(&saved)
            && let Ok(mut world) = World::restore(snapshot)
        {
            step(&mut world, &[]);
            simworld_core::testing::check_scene(&world);
        }
    }
}

#[test]
fn free_slots_are_filled_in_the_same_order() {
    let mut straight = small_world();
    for index in [3, 1, 2] {
        straight.remove(EntityId::new(index, 0)).unwrap();
    }
    let mut resumed = World::restore(straight.snapshot()).unwrap();
    for _ in 0..4 {
        let desc = EntityDesc::new(EntityKind::Cone, Pose::identity(), Shape::cuboid(0.3, 0.3, 0.5));
        assert_eq!(straight.spawn(desc.clone()), resumed.spawn(desc));
    }
}
