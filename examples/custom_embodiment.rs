//! Your own body: a drone with four actions, moved by core's kinematic dynamics.
//!
//! ```sh
//! cargo run --release --example custom_embodiment
//! ```

use simworld_core::action::{Action, ActionKind, ActionSet};
use simworld_core::command::Command;
use simworld_core::geometry::{Pose, Twist, Vector3, direction, pose_facing, yaw_of};
use simworld_core::kinematic::KinematicDynamics;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};
use simworld_core::simulation::Simulation;

/// A drone: it flies forward, turns, tilts its nose to climb, and hovers on stop.
struct Drone {
    state: BodyState,
    speed: f64,
    climb: f64,
}

impl Embodiment for Drone {
    fn supports(&self) -> ActionSet {
        ActionSet::of(&[ActionKind::MoveForward, ActionKind::Rotate, ActionKind::LookUp, ActionKind::Stop])
    }

    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        match *action {
            Action::MoveForward { speed } if (0.0..=15.0).contains(&speed) => self.speed = speed,
            Action::Rotate { angle } if angle.is_finite() => {
                let yaw = yaw_of(&self.state.pose) + angle;
                self.state.pose = pose_facing(self.state.pose.translation.vector.into(), yaw);
            }
            Action::LookUp { angle } if angle.abs() < 1.5 => self.climb = angle,
            Action::Stop => (self.speed, self.climb) = (0.0, 0.0),
            _ => return Err(EmbodimentError::unsupported(action.kind(), self.supports())),
        }
        Ok(())
    }

    fn state(&self) -> BodyState {
        self.state
    }

    fn advance(&mut self, dt: f64) {
        let ahead = direction(yaw_of(&self.state.pose)) * self.speed;
        self.state.twist.linear = Vector3::new(ahead.x, ahead.y, self.speed * self.climb);
        self.state.pose.translation.vector += self.state.twist.linear * dt;
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    if std::env::args().any(|argument| argument == "--help" || argument == "-h") {
        println!(
            "Flies a drone of one's own once round a square and prints where it goes. It takes no options."
        );
        return Ok(());
    }
    let mut world = World::new();
    let start = Pose::identity();
    let drone = world.spawn(EntityDesc::new(EntityKind::Robot, start, Shape::cuboid(0.6, 0.6, 0.2)))?;
    let state = BodyState { pose: start, twist: Twist::ZERO };
    let mut bodies = KinematicDynamics::new();
    bodies.insert(drone, Box::new(Drone { state, speed: 0.0, climb: 0.0 }));
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("bodies", Box::new(bodies));
    let tell =
        |simulation: &mut Simulation, action| simulation.submit(Command::Actuate { who: drone, action });
    tell(&mut simulation, Action::LookUp { angle: 0.1 });
    for corner in 0..4 {
        tell(&mut simulation, Action::MoveForward { speed: 8.0 });
        for _ in 0..25 {
            simulation.step()?;
        }
        let at = simulation.world().entity(drone).map(|entity| entity.position());
        println!(
            "corner {}: {:?}",
            corner + 1,
            at.map(|p| [p.x, p.y, p.z].map(|x| (x * 100.0).round() / 100.0))
        );
        tell(&mut simulation, Action::Rotate { angle: std::f64::consts::FRAC_PI_2 });
    }
    Ok(())
}
