//! A small town of kinematic walkers, and a loop that plays the task in it.

use std::collections::BTreeMap;

use simworld_agents::delivery::{CourierAction, DeliveryConfig, DeliveryTask};
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::event::{Event, EventKind};
use simworld_core::geometry::{Point3, heading, pose_facing, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityDesc, EntityKind, Place, Scene, Shape, World};
use simworld_core::seam::{Goal, Outcome, Plan, PlanStep, Task, TaskContext, TaskOutput};
use simworld_core::seed::Seed;
use simworld_core::simulation::{Simulation, SimulationSnapshot};

/// A town with its couriers at work.
pub(crate) struct Town {
    pub(crate) simulation: Simulation,
    pub(crate) task: DeliveryTask,
    pub(crate) couriers: Vec<EntityId>,
    /// Everything that happened.
    pub(crate) log: Vec<Event>,
    pub(crate) outcome: Outcome,
    plans: BTreeMap<EntityId, PlanStep>,
    last: Vec<Event>,
}

fn building(place: Place, x: f64, y: f64) -> EntityDesc {
    let pose = pose_facing(Point3::new(x, y, 0.0), 0.0);
    EntityDesc::new(EntityKind::Building, pose, Shape::cuboid(8.0, 8.0, 6.0))
        .used_as(place)
        .accessed_at(Point3::new(x + 6.0, y, 0.0))
}

/// Two restaurants, three homes, a store and a charging station around the origin, and walkers in a row.
pub(crate) fn world(couriers: usize) -> (World, Vec<EntityId>) {
    let mut world = World::new();
    let places = [
        (Place::Restaurant, 0.0, 30.0),
        (Place::Restaurant, 60.0, -40.0),
        (Place::Home, 100.0, 40.0),
        (Place::Home, -80.0, 10.0),
        (Place::Home, 20.0, -90.0),
        (Place::Store, -20.0, -30.0),
        (Place::ChargingStation, 40.0, 60.0),
    ];
    for (place, x, y) in places {
        world.spawn(building(place, x, y)).unwrap();
    }
    let body = Shape::Capsule { radius: 0.25, height: 1.8 };
    let walker = |index: usize| {
        let pose = pose_facing(Point3::new(index as f64 * 2.0, 0.0, 0.0), 0.0);
        EntityDesc::new(EntityKind::Person, pose, body)
    };
    let ids = (0..couriers).map(|index| world.spawn(walker(index)).unwrap()).collect();
    (world, ids)
}

pub(crate) fn simulation(world: World, couriers: &[EntityId]) -> Simulation {
    let mut bodies = KinematicDynamics::new();
    for id in couriers {
        let pose = *world.entity(*id).unwrap().pose;
        bodies.insert(*id, Box::new(KinematicBody::with_max_speed(pose, 10.0)));
    }
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("bodies", Box::new(bodies));
    simulation
}

impl Town {
    pub(crate) fn new(config: DeliveryConfig, couriers: usize, seed: u64) -> Self {
        let (world, ids) = world(couriers);
        Self::within(world, ids, config, seed)
    }

    /// In a world of one's own.
    pub(crate) fn within(world: World, ids: Vec<EntityId>, config: DeliveryConfig, seed: u64) -> Self {
        let mut simulation = simulation(world, &ids);
        let mut task = DeliveryTask::new(config).unwrap();
        let mut out = TaskOutput::default();
        task.reset(simulation.world(), &ids, Seed(seed), &mut out).unwrap();
        simulation.begin_step();
        for event in out.events {
            simulation.emit(event);
        }
        simulation.finish_step().unwrap();
        let last = simulation.world().events().to_vec();
        let (plans, outcome) = (BTreeMap::new(), Outcome::default());
        Self { simulation, task, couriers: ids, log: last.clone(), outcome, plans, last }
    }

    /// One step in which these couriers want these things.
    pub(crate) fn step(&mut self, intents: &[(usize, Intent)]) {
        self.simulation.begin_step();
        let intents: Vec<(EntityId, Intent)> =
            intents.iter().map(|(index, intent)| (self.couriers[*index], intent.clone())).collect();
        let (mut out, mut outcome) = (TaskOutput::default(), Outcome::default());
        let context = TaskContext {
            scene: self.simulation.world(),
            agents: &self.couriers,
            intents: &intents,
            events: &self.last,
            spawned: &[],
        };
        self.task.step(&context, &mut out, &mut outcome).unwrap();
        self.outcome = outcome;
        for command in &out.commands {
            // What a body cannot do is a fact of the world, as in an episode.
            let applied = self.simulation.apply(command);
            assert!(
                applied.is_ok() || matches!(command, Command::Actuate { .. }),
                "{command:?}: {applied:?}"
            );
        }
        for event in out.events {
            self.simulation.emit(event);
        }
        for (who, plan) in out.plans {
            let Plan { steps } = plan;
            self.plans.insert(who, steps[0].clone());
        }
        self.walk();
        self.simulation.finish_step().unwrap();
        self.last = self.simulation.world().events().to_vec();
        self.log.extend(self.last.iter().cloned());
        self.task.audit().unwrap();
    }

    /// Walks straight at the goal of each plan.
    fn walk(&mut self) {
        for (who, step) in self.plans.clone() {
            let act = |simulation: &mut Simulation, action| {
                simulation.apply(&Command::Actuate { who, action }).unwrap();
            };
            match step {
                PlanStep::Navigate { to: Goal::Point(point), within, speed } => {
                    let Some(body) = self.simulation.world().entity(who) else { continue };
                    let way = point.xy() - body.planar();
                    if way.norm() <= within {
                        act(&mut self.simulation, Action::Stop);
                        self.simulation.emit(EventKind::PlanDone { who });
                        self.plans.remove(&who);
                    } else {
                        let angle = wrap_angle(heading(&way) - yaw_of(body.pose));
                        let speed = speed.unwrap().min(way.norm() * 10.0);
                        act(&mut self.simulation, Action::Rotate { angle });
                        act(&mut self.simulation, Action::MoveForward { speed });
                    }
                }
                PlanStep::Act(action) => {
                    act(&mut self.simulation, action);
                    self.plans.remove(&who);
                }
                other => panic!("unexpected {other:?}"),
            }
        }
    }

    /// One step in which a courier does something; the reason if it was refused.
    pub(crate) fn act(&mut self, courier: usize, action: CourierAction) -> Result<(), String> {
        self.step(&[(courier, action.into())]);
        let refusal = self.last.iter().find_map(|event| match &event.kind {
            EventKind::IntentRefused { reason, .. } => Some(reason.clone()),
            _ => None,
        });
        refusal.map_or(Ok(()), Err)
    }

    /// Steps until a task event of that name happened; panics after `steps`.
    pub(crate) fn until(&mut self, name: &str, steps: usize) {
        let before = self.count(name);
        for _ in 0..steps {
            self.step(&[]);
            if self.count(name) > before {
                return;
            }
        }
        panic!("no {name} within {steps} steps");
    }

    /// The plan of a courier fails: in the next step it is told so.
    pub(crate) fn fail_plan(&mut self, who: EntityId) {
        if self.plans.remove(&who).is_some() {
            let kind = EventKind::PlanFailed { who, reason: "the way is blocked".to_owned() };
            self.last.push(Event { tick: self.simulation.world().clock().tick(), kind });
        }
    }

    pub(crate) fn count(&self, name: &str) -> usize {
        let is = |event: &&Event| matches!(&event.kind, EventKind::Task { name: other, .. } if other == name);
        self.log.iter().filter(is).count()
    }

    pub(crate) fn save(&self) -> (SimulationSnapshot, Vec<u8>, BTreeMap<EntityId, PlanStep>, Vec<Event>) {
        (self.simulation.save().unwrap(), self.task.save(), self.plans.clone(), self.last.clone())
    }

    pub(crate) fn resume(
        config: DeliveryConfig,
        couriers: usize,
        saved: (SimulationSnapshot, Vec<u8>, BTreeMap<EntityId, PlanStep>, Vec<Event>),
    ) -> Self {
        let (world, ids) = world(couriers);
        let mut simulation = simulation(world, &ids);
        simulation.restore(saved.0).unwrap();
        let mut task = DeliveryTask::new(config).unwrap();
        assert!(task.restore(&saved.1));
        let (plans, last) = (saved.2, saved.3);
        Self { simulation, task, couriers: ids, log: Vec::new(), outcome: Outcome::default(), plans, last }
    }
}

/// One order at the start and no other, a short auction, and fixed prices.
pub(crate) fn quiet() -> DeliveryConfig {
    let mut config = DeliveryConfig::default();
    config.orders.initial = 1;
    config.orders.hunger_rate = 0.0;
    config.auction.window = 1.0;
    config.prices.drift = false;
    config
}
