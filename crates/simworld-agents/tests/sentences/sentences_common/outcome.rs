//! Carrying out a plan with a kinematic walker, and what the world shows afterwards.

use simworld_agents::executor::RuleExecutor;
use simworld_core::command::Command;
use simworld_core::id::EntityId;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::scene::{OPEN, Role, Scene, World};
use simworld_core::seam::{Executor, Plan, Progress};
use simworld_core::simulation::Simulation;
use simworld_core::value::Value;

use super::city::City;

/// A plan that takes longer has gone wrong, in steps of 0.1 s.
const MOST_STEPS: usize = 6000;

/// Carries the plan out; the world afterwards, and how it ended.
pub(crate) fn carry_out(world: World, me: EntityId, plan: Plan) -> (Simulation, Progress) {
    let mut bodies = KinematicDynamics::new();
    bodies.insert(me, Box::new(KinematicBody::walker(*world.entity(me).unwrap().pose)));
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("bodies", Box::new(bodies)).set_trail_interval(0);
    let mut executor = RuleExecutor::straight();
    executor.start(plan, simulation.world(), me).unwrap();
    let mut actions = Vec::new();
    for _ in 0..MOST_STEPS {
        actions.clear();
        let progress = executor.advance(simulation.world(), me, &mut actions).unwrap();
        for action in actions.drain(..) {
            simulation.submit(Command::Actuate { who: me, action });
        }
        simulation.step().unwrap();
        if !progress.goes_on() {
            return (simulation, progress);
        }
    }
    (simulation, Progress::Running)
}

/// Whether the world shows what was expected: "seated x", "holds x", "at x", "fails reason".
pub(crate) fn shows(
    city: &City,
    expected: &str,
    simulation: &Simulation,
    ended: &Progress,
) -> Result<(), String> {
    let world = simulation.world();
    let (verb, object) = expected.split_once(' ').unwrap_or((expected, ""));
    if verb == "fails" {
        return match ended {
            Progress::Failed { reason } if reason.contains(object) => Ok(()),
            other => Err(format!("ended with {other:?}")),
        };
    }
    if *ended != Progress::Done {
        return Err(format!("ended with {ended:?}"));
    }
    let key = |id: Option<EntityId>| match id {
        Some(id) if city.ids.values().any(|known| *known == id) => city.key(id),
        Some(id) => world.entity(id).map_or_else(String::new, |entity| entity.label().to_owned()),
        None => "nothing".to_owned(),
    };
    let parent = |role: Role| {
        world.entity(city.me).unwrap().attachment.filter(|bond| bond.role == role).map(|bond| bond.parent)
    };
    let is_open = |key: &str| {
        world.entity(city.ids[key]).unwrap().info.attributes.get(OPEN) == Some(&Value::Bool(true))
    };
    let found = match verb {
        "seated" => key(parent(Role::Seated)),
        "aboard" => key(parent(Role::Aboard)),
        "holds" => key(world.attached(city.me, Role::Held)),
        "carries" => key(world.attached(city.me, Role::Carried)),
        "rides" => key(world.attached(city.me, Role::Ridden)),
        "gave" => {
            let (to, _) = object.split_once(' ').expect("gave whom what");
            format!("{to} {}", key(world.attached(city.ids[to], Role::Held)))
        }
        "open" if is_open(object) => object.to_owned(),
        "closed" if !is_open(object) => object.to_owned(),
        // "At x", or so many metres off: "at x 5".
        "at" => {
            let (thing, reach) = object.split_once(' ').unwrap_or((object, "2"));
            let (me, thing) = (world.entity(city.me).unwrap(), world.entity(city.ids[thing]).unwrap());
            let reach: f64 = reach.parse().expect("a distance is a number");
            let to_access = (thing.access().xy() - me.planar()).norm();
            let distance = thing.info.shape.planar_distance(thing.pose, &me.planar()).min(to_access);
            if distance <= reach { object.to_owned() } else { format!("{distance:.1} m away from {object}") }
        }
        _ => "otherwise".to_owned(),
    };
    if found == object { Ok(()) } else { Err(format!("{verb} {found}")) }
}
