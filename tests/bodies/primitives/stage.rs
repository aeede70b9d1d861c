//! An open place with all that actions need, bodies under physics for everybody who acts, and somebody who watches.

use std::ops::RangeInclusive;

use simworld_agents::observer::{SceneGraph, SceneGraphObserver, Sighting};
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point2, Point3, Pose, pose_facing, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, LOCKED, Place, SELLS, Scene, Shape, World};
use simworld_core::seam::Observer;
use simworld_core::simulation::Simulation;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, VehicleClass};

/// Who and what is there, each with room around it.
pub(crate) struct Stage {
    simulation: Simulation,
    observer: SceneGraphObserver,
    pub(crate) me: EntityId,
    /// Another person, who takes part.
    pub(crate) other: EntityId,
    /// Who watches and takes no part.
    pub(crate) witness: EntityId,
    pub(crate) dog: EntityId,
    pub(crate) car: EntityId,
    pub(crate) chair: EntityId,
    pub(crate) parcel: EntityId,
    /// Something of 20 kg.
    pub(crate) crate_: EntityId,
    /// Something of 80 kg.
    pub(crate) safe: EntityId,
    /// A door in a wall that runs from south to north at x = 20.
    pub(crate) door: EntityId,
    pub(crate) locked: EntityId,
    pub(crate) scooter: EntityId,
    /// Sells tea.
    pub(crate) kiosk: EntityId,
}

impl Stage {
    pub(crate) fn new() -> Self {
        let mut world = World::new();
        let mut put = |desc: EntityDesc| world.spawn(desc).expect("a sound entity");
        let thing = |kind, x: f64, y: f64, size: [f64; 3]| {
            let pose = pose_facing(Point3::new(x, y, 0.0), 0.0);
            EntityDesc::new(kind, pose, Shape::cuboid(size[0], size[1], size[2]))
        };
        let person = |x: f64, y: f64| EntityDesc {
            info: EntityDesc::new(
                EntityKind::Person,
                Pose::identity(),
                Shape::Capsule { radius: 0.25, height: 1.75 },
            )
            .info,
            ..thing(EntityKind::Person, x, y, [0.5, 0.5, 1.75])
        };
        for y in [25.0, 35.0] {
            put(thing(EntityKind::Building, 20.0, y, [0.3, 9.0, 3.0]));
        }
        put(thing(EntityKind::Building, -26.0, 10.0, [0.5, 4.0, 3.0]));
        let kiosk = thing(EntityKind::Building, -10.0, 30.0, [3.0, 3.0, 3.0])
            .used_as(Place::Store)
            .with(SELLS, "tea");
        let stage = (
            [person(0.0, 0.0), person(30.0, 5.0), person(0.0, -8.0)].map(&mut put),
            put(thing(EntityKind::Dog, -30.0, 10.0, [0.7, 0.35, 0.5])),
            put(thing(EntityKind::Car, -20.0, -20.0, [4.3, 1.8, 1.5])),
            put(thing(EntityKind::Chair, 10.0, 10.0, [0.5, 0.5, 0.9])),
            put(thing(EntityKind::Parcel, 10.0, 20.0, [0.3, 0.3, 0.2]).weighing(2.0)),
            [20.0, 80.0]
                .map(|mass| put(thing(EntityKind::Prop, mass * 0.2, 50.0, [0.5, 0.5, 0.5]).weighing(mass))),
            put(thing(EntityKind::Door, 20.0, 30.0, [0.1, 1.0, 2.1])),
            put(thing(EntityKind::Door, 40.0, 30.0, [0.1, 1.0, 2.1]).with(LOCKED, true)),
            put(thing(EntityKind::Scooter, -10.0, 10.0, [1.1, 0.5, 1.2]).weighing(20.0)),
            put(kiosk.accessed_at(Point3::new(-10.0, 27.5, 0.0))),
        );
        let ([me, other, witness], dog, car, chair, parcel, [crate_, safe], door, locked, scooter, kiosk) =
            stage;
        let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).expect("sound settings");
        for id in [me, other, witness] {
            physics.add_humanoid(&world, id, HumanoidConfig::default()).expect("an upright body");
        }
        physics.add_dog(&world, dog).expect("an upright body");
        physics.add_vehicle(&world, car, VehicleClass::Sedan.parameters()).expect("a sedan's size");
        let mut simulation = Simulation::new(world);
        simulation.add_dynamics("physics", Box::new(physics));
        simulation.set_trail_interval(0);
        let observer = SceneGraphObserver::new(100.0).with_most(1000);
        let mut stage = Self {
            simulation,
            observer,
            me,
            other,
            witness,
            dog,
            car,
            chair,
            parcel,
            crate_,
            safe,
            door,
            locked,
            scooter,
            kiosk,
        };
        stage.wait(0.5);
        stage
    }

    pub(crate) fn world(&self) -> &World {
        self.simulation.world()
    }

    pub(crate) fn at(&self, id: EntityId) -> Point2 {
        self.world().entity(id).expect("nobody takes it out").planar()
    }

    pub(crate) fn heading(&self, id: EntityId) -> f64 {
        yaw_of(self.world().entity(id).expect("nobody takes it out").pose)
    }

    pub(crate) fn speed(&self, id: EntityId) -> f64 {
        self.world().entity(id).expect("nobody takes it out").twist.ground_speed()
    }

    /// Puts somebody somewhere, looking so many radians to the left of east.
    pub(crate) fn stand(&mut self, who: EntityId, x: f64, y: f64, heading: f64) {
        self.simulation.submit(Command::Actuate { who, action: Action::Stop });
        self.simulation.submit(Command::Move { id: who, pose: pose_facing(Point3::new(x, y, 0.0), heading) });
        self.wait(0.2);
    }

    pub(crate) fn wait(&mut self, seconds: f64) {
        for _ in 0..(seconds * 10.0).round() as u32 {
            self.simulation.step().expect("the world goes on");
        }
    }

    /// Tells somebody something by a command, and lets a step pass; why it was refused, if it was.
    pub(crate) fn tell(&mut self, who: EntityId, action: Action) -> Option<String> {
        let kind = action.kind();
        self.simulation.submit(Command::Actuate { who, action });
        self.simulation.step().expect("the world goes on");
        self.world().events().iter().find_map(|event| match &event.kind {
            EventKind::ActionFailed { who: failed, action, reason } if *failed == who && *action == kind => {
                Some(reason.clone())
            }
            _ => None,
        })
    }

    #[track_caller]
    pub(crate) fn does(&mut self, who: EntityId, action: Action) {
        let said = format!("{action:?}");
        assert_eq!(self.tell(who, action), None, "{said}");
    }

    #[track_caller]
    pub(crate) fn refuses(&mut self, who: EntityId, action: Action, why: &str) {
        let said = format!("{action:?}");
        let reason = self.tell(who, action).unwrap_or_else(|| panic!("{said} was done"));
        assert!(reason.contains(why), "{said}: {reason:?} does not say {why:?}");
    }

    fn graph(&mut self) -> SceneGraph {
        let mut graph = SceneGraph::default();
        let (world, witness) = (self.simulation.world(), self.witness);
        self.observer.observe(world, witness, &mut graph).expect("it watches");
        graph.hear(world.events(), witness);
        graph
    }

    /// What the one who watches sees of somebody or something.
    pub(crate) fn sees(&mut self, id: EntityId) -> Sighting {
        self.graph().sightings.into_iter().find(|seen| seen.id == id).expect("it is in sight")
    }

    /// What the one who watches noticed in the last step.
    pub(crate) fn notices(&mut self) -> Vec<String> {
        self.graph().feedback
    }

    /// The way that a body makes in so many seconds, in the direction in which it looked before: ahead and to the left, m.
    pub(crate) fn way_in(&mut self, who: EntityId, seconds: f64) -> (f64, f64) {
        let (from, heading) = (self.at(who), self.heading(who));
        self.wait(seconds);
        let way = self.at(who) - from;
        let ahead = simworld_core::geometry::direction(heading);
        (way.dot(&ahead), ahead.perp(&way))
    }
}

#[track_caller]
pub(crate) fn within(value: f64, range: RangeInclusive<f64>) {
    assert!(range.contains(&value), "{value} is not within {range:?}");
}
