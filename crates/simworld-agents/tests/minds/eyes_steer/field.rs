//! Two posts in a field, and everybody that can be steered to one of them.

use crate::car_common::Bicycle;
use simworld_core::action::Action;
use simworld_core::geometry::{Point3, Pose, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics, KinematicVehicle};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seam::{Embodiment, Goal, Plan, PlanStep};
use simworld_core::simulation::Simulation;

/// Radius of every post, m.
pub(super) const RADIUS: f64 = 0.3;
const RED: [f32; 3] = [0.6, 0.02, 0.02];
const BLUE: [f32; 3] = [0.02, 0.05, 0.6];

pub(super) const RED_POST: EntityId = EntityId::new(0, 0);
pub(super) const BLUE_POST: EntityId = EntityId::new(1, 0);
pub(super) const VEHICLE: EntityId = EntityId::new(2, 0);

/// Who is steered, and what it gets into or on first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    pub(super) kind: EntityKind,
    pub(super) on: Option<EntityKind>,
}

pub(super) const PERSON: Body = Body { kind: EntityKind::Person, on: None };
pub(super) const DOG: Body = Body { kind: EntityKind::Dog, on: None };
pub(super) const DRIVER: Body = Body { kind: EntityKind::Person, on: Some(EntityKind::Car) };

impl Body {
    /// The vehicle that it drives, which may be itself; a scooter goes where its rider goes.
    pub(super) fn wheels(self) -> Option<EntityKind> {
        let moved = match self.on {
            Some(EntityKind::Scooter) => None,
            Some(vehicle) => Some(vehicle),
            None => Some(self.kind),
        };
        moved.filter(|kind| kind.is_vehicle())
    }

    /// How near it comes, m; its middle, of what is long.
    pub(super) fn within(self) -> f64 {
        self.wheels().map_or(1.0, |vehicle| shape(vehicle).size().x * 0.5 + 3.0)
    }

    /// To get into or on what there is for that, and to go to the red post.
    pub(super) fn plan(self) -> Plan {
        let mount = self.on.map(|on| match on {
            EntityKind::Scooter => Action::RideScooter { scooter: VEHICLE },
            _ => Action::EnterCar { car: VEHICLE },
        });
        let go = to_red(self.within());
        Plan { steps: mount.map(PlanStep::Act).into_iter().chain(go.steps).collect() }
    }
}

fn shape(kind: EntityKind) -> Shape {
    match kind {
        EntityKind::Person | EntityKind::Robot => Shape::Capsule { radius: 0.25, height: 1.8 },
        EntityKind::Dog => Shape::cuboid(0.8, 0.3, 0.6),
        EntityKind::Truck => Shape::cuboid(8.5, 2.5, 3.4),
        EntityKind::Bus => Shape::cuboid(12.0, 2.5, 3.0),
        EntityKind::Motorcycle => Shape::cuboid(2.1, 0.8, 1.2),
        EntityKind::Bicycle => Shape::cuboid(1.8, 0.6, 1.1),
        EntityKind::Scooter => Shape::cuboid(1.1, 0.5, 1.2),
        _ => Shape::cuboid(4.5, 1.8, 1.5),
    }
}

fn made_for(kind: EntityKind, pose: Pose) -> Box<dyn Embodiment> {
    match kind {
        EntityKind::Car => Box::new(Bicycle::at(pose)),
        kind if kind.is_vehicle() => Box::new(KinematicVehicle::new(pose, &shape(kind))),
        _ => Box::new(KinematicBody::walker(pose)),
    }
}

/// Where the red post stands in the field, and where it does for vehicles: out of the circle that a bus turns in.
pub(super) const POST: (f64, f64) = (-14.0, 9.0);
const FAR_POST: (f64, f64) = (-20.0, 13.0);

/// A field with a red post (#0) and a blue one (#1), a vehicle (#2) if one is wanted, and a body in its place or beside it; they look away
/// from the red post.
pub(super) fn field(body: Body) -> (Simulation, EntityId) {
    let mut world = World::new();
    let red = if body.wheels().is_some() { FAR_POST } else { POST };
    for ((x, y), color) in [(red, RED), ((12.0, -6.0), BLUE)] {
        let pose = pose_facing(Point3::new(x, y, 0.0), 0.0);
        let post = EntityDesc::new(EntityKind::Sign, pose, Shape::Cylinder { radius: RADIUS, height: 2.5 });
        world.spawn(post.colored(color)).expect("there is room");
    }
    let mut bodies = KinematicDynamics::new();
    let mut place = |kind: EntityKind, at: Point3| {
        let pose = pose_facing(at, 0.5);
        let id = world.spawn(EntityDesc::new(kind, pose, shape(kind))).expect("there is room");
        bodies.insert(id, made_for(kind, pose));
        id
    };
    let mut beside = Point3::origin();
    if let Some(vehicle) = body.on {
        assert_eq!(place(vehicle, beside), VEHICLE);
        beside = pose_facing(beside, 0.5) * Point3::new(0.0, shape(vehicle).size().y * 0.5 + 0.6, 0.0);
    }
    let me = place(body.kind, beside);
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("bodies", Box::new(bodies));
    (simulation, me)
}

/// To come within so many metres of the red post.
pub(super) fn to_red(within: f64) -> Plan {
    Plan::navigate(Goal::Entity(RED_POST), within)
}

/// Everybody that moves by itself, and all who can drive in and on everything that has wheels.
pub(super) fn bodies() -> impl Iterator<Item = Body> {
    let moving = EntityKind::ALL.iter().copied().filter(|kind| kind.is_mobile());
    let wheeled = moving.clone().filter(|kind| kind.is_vehicle());
    let aboard = |on| [EntityKind::Person, EntityKind::Robot].map(|kind| Body { kind, on: Some(on) });
    moving.map(|kind| Body { kind, on: None }).chain(wheeled.flat_map(aboard))
}
