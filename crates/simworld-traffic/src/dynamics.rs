//! Traffic in a world: its vehicles and pedestrians as entities, its signals as the world's.

mod handed;
mod orders;
mod others;
mod passages;

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::environment::Weather;
use simworld_core::geometry::{
    Point2, Point3, Pose, Twist, Vector2, Vector3, direction, pose_facing, yaw_of,
};
use simworld_core::hash::{StateHash, StateHasher};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, EntityRef, Scene, Shape, World};
use simworld_core::seam::{Dynamics, DynamicsError};
use simworld_core::seed::{Seed, Stream, StreamRng};
use simworld_core::traffic::RoadLeg;
use simworld_core::value::Value;

use self::handed::Who;
use self::others::Others;
use crate::traffic::{Obstructs, State};
use crate::{Body, DrivingConditions, Foreign, Pedestrian, Sex, Traffic, TrafficConfig, TrafficError};

/// Colours of cars, linear-light sRGB.
const PAINTS: [[f32; 3]; 7] = [
    [0.62, 0.62, 0.64],
    [0.04, 0.04, 0.05],
    [0.75, 0.75, 0.73],
    [0.45, 0.03, 0.03],
    [0.03, 0.09, 0.3],
    [0.05, 0.2, 0.1],
    [0.5, 0.32, 0.05],
];

/// Moves the traffic of a world: one entity a vehicle and a pedestrian.
///
/// Orders to the traffic ([`Command::Traffic`](simworld_core::command::Command::Traffic)) are carried out at the beginning of a
/// step; one that cannot be is reported as the event `traffic_refused`, and a closure as `closed` with its number. Who is taken
/// out of the world is taken out of the traffic. Streets that the world has closed are closed from the next step on, and those
/// who were to drive there take another way.
///
/// People and vehicles that belong to others are seen: drivers stop for them, but not for parked
/// vehicles (attribute `parked`), which keep within their lanes. They stop for what is put on a lane, be it a cone, a tree or a house;
/// a house or a traffic light over a lane that the world had when its traffic was made belongs there, and is driven through.
///
/// ```
/// use std::sync::Arc;
/// use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
/// use simworld_core::scene::World;
/// use simworld_core::seed::Seed;
/// use simworld_core::simulation::Simulation;
/// use simworld_traffic::{TrafficConfig, TrafficDynamics};
/// let mut world = World::new();
/// world.set_roads(Arc::new(RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default())?));
/// let traffic = TrafficDynamics::new(&mut world, &TrafficConfig::default(), Seed(1))?;
/// assert_eq!(world.len(), 120); // 40 vehicles, 80 pedestrians
/// let mut simulation = Simulation::new(world);
/// simulation.add_dynamics("traffic", Box::new(traffic));
/// for _ in 0..50 { simulation.step()?; }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct TrafficDynamics {
    traffic: Traffic,
    /// By number; a number that nobody has keeps its last entity, which is gone.
    vehicles: Vec<EntityId>,
    paint: Stream,
    pedestrians: Vec<EntityId>,
    /// Whom somebody else moves.
    handed: BTreeMap<EntityId, Who>,
    /// Bodies of others, and who left the world.
    others: Others,
    /// The closures of the streets that the world has closed, by number.
    shut: BTreeMap<RoadLeg, u32>,
    first: First,
    foreign: Vec<Foreign>,
    /// The weather that was minded last.
    weather: Option<Weather>,
}

impl TrafficDynamics {
    /// Places traffic on the roads of the world and spawns its entities.
    ///
    /// # Errors
    /// A world without roads, a setting out of range, or an entity that the world refuses.
    pub fn new(world: &mut World, config: &TrafficConfig, seed: Seed) -> Result<Self, TrafficError> {
        let network = Arc::clone(world.roads().ok_or(TrafficError::NoRoads)?);
        let traffic = Traffic::new(network, config, seed)?;
        let mut vehicles = vec![NOBODY; traffic.placed().vehicles as usize];
        let first = at_first(world, &traffic);
        let stream = seed.stream("traffic/paint");
        let mut paint = stream.rng();
        let mut bodies: Vec<_> = traffic.vehicles().collect();
        bodies.sort_by_key(|body| body.id);
        for body in bodies {
            vehicles[body.id as usize] = world.spawn(describe(&body, &mut paint))?;
        }
        let mut pedestrians = Vec::new();
        for (walker, number) in traffic.pedestrians().iter().zip(0..) {
            pedestrians.push(world.spawn(portray(walker, traffic.walker_height(number), &mut paint))?);
        }
        world.signals_mut().copy_from_slice(traffic.signals());
        Ok(Self {
            traffic,
            vehicles,
            paint: stream.named("entered"),
            pedestrians,
            handed: BTreeMap::new(),
            others: Others::default(),
            shut: BTreeMap::new(),
            first,
            foreign: Vec::new(),
            weather: None,
        })
    }

    /// The traffic itself.
    pub fn traffic(&self) -> &Traffic {
        &self.traffic
    }

    /// The traffic itself, to give its signals a policy.
    pub fn traffic_mut(&mut self) -> &mut Traffic {
        &mut self.traffic
    }

    /// The entities of the vehicles, by number; those of numbers that nobody has any more are gone from the world.
    pub fn vehicles(&self) -> &[EntityId] {
        &self.vehicles
    }

    /// The entities of the pedestrians, by number.
    pub fn pedestrians(&self) -> &[EntityId] {
        &self.pedestrians
    }

    /// Drivers mind the weather of the world, once it is not what it was.
    fn mind_weather(&mut self, world: &World) -> Result<(), DynamicsError> {
        let weather = world.environment().weather;
        if self.weather != Some(weather) {
            self.weather = Some(weather);
            // The default weather leaves the conditions of the configuration as they are.
            let conditions = if weather == Weather::default() {
                self.traffic.config().conditions
            } else {
                DrivingConditions::from_weather(&weather)
            };
            let refused = |error: TrafficError| DynamicsError::Other(error.to_string());
            self.traffic.set_conditions(conditions).map_err(refused)?;
        }
        Ok(())
    }

    /// Finds out who came, and takes out of the traffic whose entities somebody took out of the world.
    fn look_around(&mut self, world: &World) {
        let Self { others, vehicles, pedestrians, traffic, first, .. } = self;
        let in_the_way = |entity: &EntityRef<'_>| match standing(entity) {
            Some(Standing::Put) => match obstructs(traffic, entity) {
                Obstructs::Nothing => false,
                Obstructs::OffGround => first.get(&entity.id) != Some(&stance(entity)),
                Obstructs::Ground => true,
            },
            Some(Standing::Built) => {
                first.get(&entity.id) != Some(&stance(entity)) && traffic.is_on_a_track(&seen(entity))
            }
            None => false,
        };
        let vehicles_own = (0..).map(Who::Vehicle).zip(vehicles.iter());
        let own = vehicles_own.chain((0..).map(Who::Walker).zip(pedestrians.iter()));
        let own = own.filter(|(_, id)| **id != NOBODY).map(|(who, id)| (*id, who));
        for (id, who) in others.look(world, own, &in_the_way) {
            self.bury(id, who);
        }
    }

    /// Where the bodies of others are.
    fn watch(&mut self, world: &World) {
        self.foreign.clear();
        let is_here = |entity: &EntityRef<'_>| entity.attachment.is_none() && !is_parked(entity);
        self.foreign.extend(self.others.iter(world).filter(is_here).map(|entity| seen(&entity)));
    }

    /// Removes the entities of those who left.
    fn clear_away(&self, world: &mut World) -> Result<(), DynamicsError> {
        for trip in self.traffic.ended() {
            let id = self.vehicles[trip.id as usize];
            if world.entity(id).is_some() {
                world.remove(id)?;
            }
        }
        for walk in self.traffic.walks().iter().filter(|walk| walk.left) {
            let id = self.pedestrians.get(walk.id as usize).copied().unwrap_or(NOBODY);
            if world.entity(id).is_some() {
                world.remove(id)?;
            }
        }
        Ok(())
    }

    /// Makes an entity for every walker who entered.
    fn welcome_walkers(&mut self, world: &mut World) -> Result<(), DynamicsError> {
        let count = self.traffic.pedestrians().len();
        self.pedestrians.resize(count, NOBODY);
        for index in self.traffic.walkers_entered() {
            let walker = &self.traffic.pedestrians()[*index as usize];
            let entered = self.traffic.counters().walkers_entered;
            let mut paint = self.paint.named("walkers").indexed(entered).indexed(u64::from(*index)).rng();
            if walker.is_present() {
                let id = world.spawn(portray(walker, self.traffic.walker_height(*index), &mut paint))?;
                self.pedestrians[*index as usize] = id;
                self.others.claim(id, Who::Walker(*index));
            }
        }
        Ok(())
    }

    /// Makes an entity for everybody who entered.
    fn welcome(&mut self, world: &mut World) -> Result<(), DynamicsError> {
        for body in self.traffic.entered().iter().filter_map(|id| self.traffic.vehicle(*id)) {
            let index = body.id as usize;
            if self.vehicles.len() <= index {
                self.vehicles.resize(index + 1, NOBODY);
            }
            let mut paint =
                self.paint.indexed(self.traffic.counters().entered).indexed(u64::from(body.id)).rng();
            let id = world.spawn(describe(&body, &mut paint))?;
            self.vehicles[index] = id;
            self.others.claim(id, Who::Vehicle(body.id));
        }
        Ok(())
    }

    fn write(&self, world: &mut World) -> Result<(), DynamicsError> {
        for body in self.traffic.vehicles() {
            let id = self.vehicles[body.id as usize];
            if world.entity(id).is_some() && !self.is_handed(id) {
                world.set_motion(id, body.pose, body.twist)?;
            }
        }
        for ((id, walker), number) in self.pedestrians.iter().zip(self.traffic.pedestrians()).zip(0..) {
            if !walker.is_present() || world.entity(*id).is_none() || self.is_handed(*id) {
                continue;
            }
            let height = self.traffic.walker_height(number);
            let pose =
                pose_facing(Point3::new(walker.position.x, walker.position.y, height), walker.heading());
            let linear = Vector3::new(walker.velocity().x, walker.velocity().y, 0.0);
            world.set_motion(*id, pose, Twist { linear, angular: Vector3::zeros() })?;
        }
        world.signals_mut().copy_from_slice(self.traffic.signals());
        Ok(())
    }
}

/// A thing whose upper side is no steeper than this stands, as the cosine of its slope.
const STANDS: f64 = 0.7;
/// Whose number has no entity: no world has so many that one has this id.
const NOBODY: EntityId = EntityId::new(u32::MAX, u32::MAX);

/// What a city is built with that stood over lanes when the traffic was made, and how: real places have houses over streets. Who moves
/// one puts it where it stands then.
type First = BTreeMap<EntityId, (Pose, Shape)>;

/// What is saved: the configuration, the state, entities of vehicles and walkers by number, whom somebody else moves, the closures of
/// closed streets, and what stood over lanes at first.
type Saved = (
    TrafficConfig,
    State,
    Vec<EntityId>,
    Vec<EntityId>,
    BTreeMap<EntityId, Who>,
    BTreeMap<RoadLeg, u32>,
    First,
);

fn describe(body: &Body, paint: &mut StreamRng) -> EntityDesc {
    let desc = EntityDesc::new(body.kind.entity_kind(), body.pose, body.shape);
    desc.colored(PAINTS[paint.below(PAINTS.len())])
}

/// A person at a height above the ground, m. They are as tall as their age and sex say: grown up at 18, 1.78 m or 1.65 m tall on average
/// (NCD-RisC 2016, Europe).
fn portray(walker: &Pedestrian, height_above: f64, paint: &mut StreamRng) -> EntityDesc {
    let pose = pose_facing(Point3::new(walker.position.x, walker.position.y, height_above), walker.heading());
    let grown = if walker.sex() == Sex::Male { 1.78 } else { 1.65 };
    let growing = (18.0 - f64::from(walker.age())).max(0.0) * 0.05;
    let height = paint.normal_clamped(grown - growing, 0.07, 1.0, 2.1);
    let coat = [0; 3].map(|_: i32| paint.uniform(0.02, 0.5) as f32);
    EntityDesc::new(EntityKind::Person, pose, Shape::Capsule { radius: 0.22, height }).colored(coat)
}

/// An entity as drivers and walkers see it.
fn seen(entity: &EntityRef<'_>) -> Foreign {
    let size = entity.info.shape.size() * 0.5;
    let linear = entity.twist.linear;
    Foreign {
        position: entity.planar(),
        radius: size.x,
        half_width: size.y,
        direction: direction(yaw_of(entity.pose)),
        velocity: Vector2::new(linear.x, linear.y),
        height: entity.pose.translation.z,
    }
}

/// What stands in streets.
#[derive(Clone, Copy)]
enum Standing {
    /// Put somewhere, and in the way as soon as a vehicle would touch it. What does so on bridges and in tunnels alone, and from the
    /// beginning, are their own parts and what stands above them.
    Put,
    /// What a street is built with beside its lanes, and in the way only where it stands on one; not if it does so from the beginning:
    /// streets lead through houses, lights stand where streets meet, and maps have trees on lanes.
    Built,
}

/// What of the solid things that stand somewhere an entity is.
fn standing(entity: &EntityRef<'_>) -> Option<Standing> {
    let standing = match entity.kind {
        EntityKind::Bench
        | EntityKind::Chair
        | EntityKind::Table
        | EntityKind::TrashBin
        | EntityKind::Mailbox
        | EntityKind::Cone
        | EntityKind::Prop => Standing::Put,
        EntityKind::Tree
        | EntityKind::StreetLamp
        | EntityKind::Sign
        | EntityKind::Hydrant
        | EntityKind::BusStop
        | EntityKind::Building
        | EntityKind::TrafficSignal => Standing::Built,
        _ => return None,
    };
    (entity.is_solid() && entity.attachment.is_none()).then_some(standing)
}

/// How an entity stands, and how large it is.
fn stance(entity: &EntityRef<'_>) -> (Pose, Shape) {
    (*entity.pose, entity.info.shape)
}

/// Where a thing is in the way of vehicles.
fn obstructs(traffic: &Traffic, entity: &EntityRef<'_>) -> Obstructs {
    let (pose, size) = (entity.pose, entity.info.shape.size());
    let middle = pose * Point3::new(0.0, 0.0, size.z);
    let normal = pose.rotation * Vector3::z();
    // The upper side of what stands or slopes is a plane; what has tipped over reaches as high as it may.
    let top = |at: Point2| {
        let offset = at - middle.xy();
        if normal.z > STANDS {
            middle.z - offset.dot(&normal.xy()) / normal.z
        } else {
            pose.translation.z + size.norm()
        }
    };
    traffic.obstructs(&seen(entity), &top)
}

/// What stands over lanes before there is traffic on them.
fn at_first(world: &World, traffic: &Traffic) -> First {
    let is_over_a_lane = |entity: &EntityRef<'_>| match standing(entity) {
        Some(Standing::Built) => traffic.is_on_a_track(&seen(entity)),
        Some(Standing::Put) => obstructs(traffic, entity) == Obstructs::OffGround,
        None => false,
    };
    world.iter().filter(is_over_a_lane).map(|entity| (entity.id, stance(&entity))).collect()
}

/// Whether an entity is a parked vehicle: it keeps within its parking lane, where nobody drives.
fn is_parked(entity: &EntityRef<'_>) -> bool {
    entity.kind.is_vehicle()
        && entity.twist.ground_speed() == 0.0
        && entity.info.attributes.get("parked") == Some(&Value::Bool(true))
}

/// Tells damaged bytes from whole ones: state that merely reads well may still contradict itself.
fn checksum(bytes: &[u8]) -> [u8; 8] {
    StateHasher::new().bytes(bytes).finish().0.to_le_bytes()
}

impl Dynamics for TrafficDynamics {
    fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
        let roads = world.roads().map_or(0, |roads| roads.signal_groups());
        if roads != self.traffic.signals().len() {
            let message = "the world's roads are not those the traffic was made for: make it anew";
            return Err(DynamicsError::Other(message.to_owned()));
        }
        self.mind_weather(world)?;
        self.look_around(world);
        self.mind_passages(world)?;
        self.obey(world);
        self.follow(world);
        self.watch(world);
        // Those who were taken out between two steps or came then, and those who left in this one.
        self.clear_away(world)?;
        self.welcome_walkers(world)?;
        self.traffic.step_among(&self.foreign, dt);
        self.clear_away(world)?;
        self.welcome(world)?;
        self.write(world)
    }

    fn save(&self) -> Result<Vec<u8>, DynamicsError> {
        let saved = (
            self.traffic.config(),
            self.traffic.state(),
            &self.vehicles,
            &self.pedestrians,
            &self.handed,
            &self.shut,
            &self.first,
        );
        let mut bytes =
            postcard::to_stdvec(&saved).map_err(|error| DynamicsError::Saved(error.to_string()))?;
        bytes.extend(checksum(&bytes));
        Ok(bytes)
    }

    fn restore(&mut self, _: &World, saved: &[u8]) -> Result<(), DynamicsError> {
        let refused = |why: &str| DynamicsError::Saved(why.to_owned());
        let (bytes, sum) = saved.split_last_chunk::<8>().ok_or_else(|| refused("it is cut off"))?;
        if checksum(bytes) != *sum {
            return Err(refused("its checksum does not fit its bytes, so it is damaged"));
        }
        let (config, state, vehicles, pedestrians, handed, shut, first): Saved =
            postcard::from_bytes(bytes).map_err(|error| refused(&error.to_string()))?;
        let named = config == *self.traffic.config()
            && vehicles.len() >= state.numbers()
            && pedestrians.len() >= state.walkers();
        if !named || !self.traffic.set_state(state) {
            return Err(refused("it belongs to another network or configuration"));
        }
        (self.vehicles, self.pedestrians, self.handed) = (vehicles, pedestrians, handed);
        (self.shut, self.first) = (shut, first);
        self.others.forget();
        self.weather = None;
        Ok(())
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        self.traffic.state_hash(hasher);
        self.handed.values().for_each(|who| who.hash(hasher));
    }
}
