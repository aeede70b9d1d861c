//! A recording replayed on the same start leads through the same digests; on another start it is noticed.

use crate::common::{any_command, small_world};
use proptest::prelude::*;
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::geometry::{Pose, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::record::Recording;
use simworld_core::scene::{Scene, World};
use simworld_core::simulation::{Simulation, SimulationSnapshot};

fn simulation(world: World) -> Simulation {
    let walker = EntityId::new(0, 0);
    let pose = *world.entity(walker).unwrap().pose;
    let mut bodies = KinematicDynamics::new();
    bodies.insert(walker, Box::new(KinematicBody::walker(pose)));
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("bodies", Box::new(bodies)).set_trail_interval(1);
    simulation
}

fn replay(recording: &Recording, world: World) -> Simulation {
    let mut replayed = simulation(world);
    for (tick, _) in &recording.trail {
        for command in recording.commands_at(replayed.world().clock().tick()) {
            replayed.submit(command.clone());
        }
        replayed.step().unwrap();
        assert_eq!(replayed.world().clock().tick(), *tick);
    }
    replayed
}

fn run(steps: &[Vec<Command>]) -> Simulation {
    let mut simulation = simulation(small_world());
    for commands in steps {
        for command in commands {
            simulation.submit(command.clone());
        }
        simulation.step().unwrap();
    }
    simulation
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(80))]

    #[test]
    fn a_replay_gives_the_same_trail(
        steps in prop::collection::vec(prop::collection::vec(any_command(), 0..4), 1..12),
    ) {
        let original = run(&steps);
        let bytes = postcard::to_stdvec(original.recording()).unwrap();
        let recording: Recording = postcard::from_bytes(&bytes).unwrap();
        let replayed = replay(&recording, small_world());
        prop_assert_eq!(&replayed.recording().trail, &recording.trail);
        for (tick, digest) in &replayed.recording().trail {
            prop_assert!(recording.confirm(*tick, *digest).is_ok());
        }
    }

    #[test]
    fn a_saved_simulation_goes_on(
        steps in prop::collection::vec(prop::collection::vec(any_command(), 0..4), 2..10),
    ) {
        let straight = run(&steps);
        let halt = steps.len() / 2;
        let bytes = postcard::to_stdvec(&run(&steps[..halt]).save().unwrap()).unwrap();
        let snapshot: SimulationSnapshot = postcard::from_bytes(&bytes).unwrap();
        let mut resumed = simulation(small_world());
        resumed.restore(snapshot).unwrap();
        for commands in &steps[halt..] {
            for command in commands {
                resumed.submit(command.clone());
            }
            resumed.step().unwrap();
        }
        prop_assert_eq!(&resumed.recording().trail[..], &straight.recording().trail[halt..]);
    }
}

#[test]
fn a_body_that_was_moved_goes_on_from_there() {
    let mut simulation = simulation(small_world());
    let walker = EntityId::new(0, 0);
    simulation.submit(Command::Actuate { who: walker, action: Action::MoveForward { speed: 1.0 } });
    simulation.step().unwrap();
    simulation.submit(Command::Move { id: walker, pose: Pose::translation(40.0, 0.0, 0.0) });
    simulation.step().unwrap();
    let x = simulation.world().entity(walker).unwrap().position().x;
    assert!((x - 40.1).abs() < 1e-9, "{x}");
    simulation.submit(Command::Actuate { who: walker, action: Action::Rotate { angle: 1.5 } });
    simulation.step().unwrap();
    let yaw = yaw_of(simulation.world().entity(walker).unwrap().pose);
    assert!((yaw - 1.5).abs() < 1e-9, "{yaw}");
}

#[test]
fn another_start_is_noticed() {
    let original = run(&vec![Vec::new(); 3]);
    let mut elsewhere = small_world();
    elsewhere.set_attribute(EntityId::new(1, 0), "color", Some("red".into())).unwrap();
    let replayed = replay(original.recording(), elsewhere);
    let (tick, digest) = replayed.recording().trail[0];
    let divergence = original.recording().confirm(tick, digest).unwrap_err();
    assert_eq!((divergence.tick, divergence.replayed), (tick, digest));
}
