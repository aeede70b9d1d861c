//! Physics alone: a box falls and comes to rest.
//!
//! ```sh
//! cargo run --release --example dropped_box -- --height 10
//! ```

use std::process::ExitCode;

use clap::Parser;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::simulation::Simulation;
use simworld_examples::exit_code;
use simworld_physics::{PhysicsConfig, PhysicsDynamics};

/// Drops a box and prints its height.
#[derive(Parser)]
struct Arguments {
    /// Height of its bottom at the start, m.
    #[arg(long, default_value_t = 5.0)]
    height: f64,
}

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World::new();
    let start = pose_facing(Point3::new(0.0, 0.0, arguments.height), 0.4);
    let box_id =
        world.spawn(EntityDesc::new(EntityKind::Prop, start, Shape::cuboid(0.5, 0.5, 0.5)).weighing(10.0))?;
    let mut physics = PhysicsDynamics::new(PhysicsConfig::default())?;
    physics.add_rigid(&world, box_id)?;
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("physics", Box::new(physics));
    for _ in 0..40 {
        let world = simulation.world();
        if let Some(entity) = world.entity(box_id) {
            let (time, height) = (world.clock().seconds(), entity.position().z);
            let bar = "#".repeat((height.clamp(0.0, 20.0) * 6.0) as usize);
            println!("{time:4.1} s  {height:6.3} m  {:6.2} m/s  {bar}", entity.twist.linear.z);
        }
        simulation.step()?;
    }
    Ok(())
}
