//! A city of blocks with somebody in it, for measuring what bodies cost.

use std::ops::ControlFlow;

use simworld_core::action::Action;
use simworld_core::geometry::{Aabb, Point3, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, EntityRef, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::{Seed, StreamRng};
use simworld_physics::proving::ProvingError;
use simworld_physics::{Detail, HumanoidConfig, PhysicsConfig, PhysicsDynamics, VehicleClass};

/// Width of a block with its street, m.
const BLOCK: f64 = 80.0;
/// Fixed solids of a block: four buildings, and seven trees or bins on each side.
pub const SOLIDS: usize = 32;
/// Buildings of a block.
pub const BUILDINGS: usize = 4;
/// Between two orders to the same person, steps of 1/60 s.
const HABIT: u64 = 240;

/// Between two looks of a driver ahead, steps.
const LOOK: u64 = 6;
/// What a driver does with a free way: some 30 km/h.
const CRUISE: Action = Action::Throttle { level: 0.08 };

/// Who is in the city.
#[derive(Clone, Copy, Debug, Default)]
pub struct Crowd {
    /// People on foot.
    pub people: usize,
    /// Robot dogs, as cylinders.
    pub dogs: usize,
    /// Sedans.
    pub cars: usize,
    /// Free crates.
    pub crates: usize,
}

/// Blocks in a square, and bodies that move in their streets.
pub struct Quarter {
    /// The world.
    pub world: World,
    /// Its physics.
    pub physics: PhysicsDynamics,
    /// Who walks.
    walkers: Vec<EntityId>,
    /// Cars, and whether their drivers brake.
    cars: Vec<(EntityId, bool)>,
    rng: StreamRng,
    tick: u64,
}

impl Quarter {
    /// So many blocks to a side, with nobody in them.
    ///
    /// # Errors
    /// The world refuses a solid.
    pub fn world(side: usize) -> Result<World, ProvingError> {
        let mut world = World::new();
        for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
            let (x, y) = (i as f64 * BLOCK, j as f64 * BLOCK);
            let mut put = |kind, x, y, shape| {
                world.spawn(EntityDesc::new(kind, pose_facing(Point3::new(x, y, 0.0), 0.0), shape))
            };
            for (dx, dy) in [(-14.0, -14.0), (14.0, -14.0), (-14.0, 14.0), (14.0, 14.0)] {
                put(EntityKind::Building, x + dx, y + dy, Shape::cuboid(24.0, 24.0, 15.0))?;
            }
            for k in 0..7 {
                let along = f64::from(k) * 9.0 - 27.0;
                for side in [-32.0, 32.0] {
                    put(
                        EntityKind::Tree,
                        x + along,
                        y + side,
                        Shape::Cylinder { radius: 0.15, height: 5.0 },
                    )?;
                    put(EntityKind::TrashBin, x + side, y + along, Shape::cuboid(0.5, 0.5, 1.0))?;
                }
            }
        }
        Ok(world)
    }

    /// A crowd in the streets of the `within` blocks to a side that lie in the corner of a world.
    ///
    /// # Errors
    /// The physics refuses a body.
    pub fn new(world: World, within: usize, crowd: Crowd, threads: Threads) -> Result<Self, ProvingError> {
        Self::with_detail(world, within, crowd, threads, PhysicsConfig::default().detail_radius)
    }

    /// The same with full detail within so many metres of what is of interest.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_detail(
        world: World,
        within: usize,
        crowd: Crowd,
        threads: Threads,
        detail_radius: f64,
    ) -> Result<Self, ProvingError> {
        let parallel_threshold = if threads == Threads::One { usize::MAX } else { 48 };
        let config =
            PhysicsConfig { substeps: 1, parallel_threshold, detail_radius, ..PhysicsConfig::default() };
        let physics = PhysicsDynamics::new(config)?;
        let rng = Seed(1).stream("figures/quarter").rng();
        let mut quarter = Self { world, physics, walkers: Vec::new(), cars: Vec::new(), rng, tick: 0 };
        for _ in 0..crowd.people {
            let id = quarter.put(
                within,
                EntityKind::Person,
                35.0,
                Shape::Capsule { radius: 0.25, height: 1.75 },
            )?;
            quarter.physics.add_humanoid(&quarter.world, id, HumanoidConfig::default())?;
            quarter.walkers.push(id);
        }
        for _ in 0..crowd.dogs {
            let id = quarter.put(within, EntityKind::Dog, 34.0, Shape::cuboid(0.7, 0.35, 0.5))?;
            quarter.physics.add_dog(&quarter.world, id)?;
            quarter.walkers.push(id);
        }
        for _ in 0..crowd.cars {
            let id = quarter.put(within, EntityKind::Car, 40.0, Shape::cuboid(4.3, 1.8, 1.5))?;
            quarter.physics.add_vehicle(&quarter.world, id, VehicleClass::Sedan.parameters())?;
            quarter.world.actuate(id, CRUISE)?;
            quarter.cars.push((id, false));
        }
        for _ in 0..crowd.crates {
            let id = quarter.put(within, EntityKind::Prop, 37.0, Shape::cuboid(0.5, 0.5, 0.5))?;
            let twist = Twist { linear: Vector3::z() * 3.0, angular: Vector3::x() };
            let pose =
                *quarter.world.slot(id.index()).map_or(&pose_facing(Point3::origin(), 0.0), |it| it.pose);
            quarter.world.set_motion(id, pose, twist)?;
            quarter.physics.add_rigid(&quarter.world, id)?;
        }
        Ok(quarter)
    }

    /// Puts something into a street, `aside` m from the middle of a block.
    fn put(
        &mut self,
        within: usize,
        kind: EntityKind,
        aside: f64,
        shape: Shape,
    ) -> Result<EntityId, ProvingError> {
        let rng = &mut self.rng;
        let (i, j) = (rng.below(within) as f64, rng.below(within) as f64);
        let along = rng.uniform(-30.0, 30.0);
        let (dx, dy, yaw) =
            if rng.below(2) == 0 { (along, aside, 0.0) } else { (aside, along, std::f64::consts::FRAC_PI_2) };
        let place = Point3::new(i * BLOCK + dx, j * BLOCK + dy, 0.0);
        Ok(self.world.spawn(EntityDesc::new(kind, pose_facing(place, yaw), shape))?)
    }

    /// One step of 1/60 s; now and then somebody turns a corner.
    ///
    /// # Errors
    /// The physics cannot go on.
    pub fn step(&mut self) -> Result<(), ProvingError> {
        self.world.begin_step();
        for (index, who) in self.walkers.iter().enumerate() {
            let turn = self.tick + index as u64;
            if self.tick == 0 {
                self.world.actuate(*who, Action::MoveForward { speed: 1.34 })?;
            } else if turn.is_multiple_of(HABIT) {
                let quarter = self.rng.below(3) as f64 - 1.0;
                self.world.actuate(*who, Action::Rotate { angle: quarter * std::f64::consts::FRAC_PI_2 })?;
            }
        }
        self.drive()?;
        self.physics.step(&mut self.world, 1.0 / 60.0)?;
        self.world.finish_step();
        self.tick += 1;
        Ok(())
    }
}

impl Quarter {
    /// Lets drivers near by brake for whatever is in their way, and go on when it is free; those far away meet nobody.
    fn drive(&mut self) -> Result<(), ProvingError> {
        for (index, (car, brakes)) in self.cars.iter_mut().enumerate() {
            let looks = (self.tick + index as u64).is_multiple_of(LOOK);
            if !looks || self.physics.detail(*car) != Some(Detail::Full) {
                continue;
            }
            let Some(me) = self.world.entity(*car) else { continue };
            let is_blocked = is_blocked(&self.world, &me);
            if is_blocked != *brakes {
                *brakes = is_blocked;
                self.world.actuate(*car, if is_blocked { Action::Brake { level: 1.0 } } else { CRUISE })?;
            }
        }
        Ok(())
    }
}

/// Whether something is on the way that a car needs to stop, or will be when it walks into it.
fn is_blocked(world: &World, car: &EntityRef<'_>) -> bool {
    let (speed, half) = (car.twist.linear.norm(), car.info.shape.size() * 0.5);
    // A second to react and a stop at 4 m/s².
    let reach = half.x + 2.0 + speed + speed * speed / 8.0;
    let all = Aabb::around(car.position(), Vector3::new(reach, reach, 3.0));
    world
        .visit(&all, &mut |other| {
            let seen = car.pose.inverse() * other.position();
            let wide = half.y + 0.5 * other.info.shape.size().x.min(other.info.shape.size().y) + 0.7;
            let is_ahead = seen.x > half.x && seen.x < reach && seen.y.abs() < wide;
            if is_ahead && other.id != car.id { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .is_break()
}

/// How many threads look around.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Threads {
    /// One.
    One,
    /// As many as there are.
    All,
}
