//! What is looked at: a city or a scene with traffic, or a recorded run that is played again.

use std::path::Path;

use simworld_citygen::{AllThreads, City};
use simworld_core::clock::Clock;
use simworld_core::geometry::{Point2, Point3, direction};
use simworld_core::id::EntityId;
use simworld_core::net::polyline;
use simworld_core::scene::{EntityKind, EntityRef, Scene, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::{TrafficConfig, TrafficDynamics};

use super::Flight;
use crate::Outcome;
use crate::delivery::{Assembly, ReadLog, RunConfig, assemble_with, make_city, read_log};
use crate::written::Written;

/// A step of a city, µs.
const STEP: u64 = 50_000;
/// How far around it a place is looked at, when the liveliest is looked for, m.
const LIVELY: f64 = 40.0;

/// Whether there is more to see.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Going {
    /// There is.
    On,
    /// A recorded run has come to its end.
    Ended,
}

/// A world that moves.
pub struct Stage {
    moving: Moving,
}

enum Moving {
    /// Without streets there is no traffic.
    Traffic {
        world: Box<World>,
        traffic: Option<Box<TrafficDynamics>>,
    },
    Replay {
        assembly: Box<Assembly>,
        log: Box<ReadLog>,
        step: f64,
    },
}

impl Stage {
    /// A city with vehicles and people, who have moved for half a minute.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn of_city(city: &City, vehicles: u32, pedestrians: u32, seed: Seed) -> Outcome<Self> {
        let mut world = World::with_clock(Clock::new(STEP)?);
        city.populate(&mut world)?;
        Self::of_world(world, vehicles, pedestrians, seed)
    }

    /// A scene that is written by hand, likewise; where it has no street nobody moves in it.
    ///
    /// # Errors
    /// A file that is no scene, a scene that cannot be, or a setting out of range.
    pub fn of_scene(path: &Path, vehicles: u32, pedestrians: u32, seed: Seed) -> Outcome<Self> {
        let written = Written::read(path, Clock::new(STEP)?)?;
        written.tell();
        Self::of_world(written.loaded.world, vehicles, pedestrians, seed)
    }

    fn of_world(mut world: World, vehicles: u32, pedestrians: u32, seed: Seed) -> Outcome<Self> {
        let config = TrafficConfig { vehicles, pedestrians, ..TrafficConfig::default() };
        let mut traffic = None;
        if world.roads().is_some() {
            let mut own = TrafficDynamics::new(&mut world, &config, seed)?;
            own.traffic_mut().set_workers(Box::new(AllThreads));
            traffic = Some(Box::new(own));
        }
        let mut stage = Self { moving: Moving::Traffic { world: Box::new(world), traffic } };
        for _ in 0..600 {
            stage.step()?;
        }
        Ok(stage)
    }

    /// A run of couriers as it was recorded in the folder of `--example delivery`, from its beginning. Nobody thinks: the
    /// recorded commands are carried out again.
    ///
    /// # Errors
    /// A folder without a run, or a part of it that cannot be read.
    pub fn of_recording(folder: &Path) -> Outcome<Self> {
        let config = RunConfig::read(&folder.join("config.toml"))?;
        let (city, _) = make_city(&config)?;
        let path = folder.join(format!("seed-{}", config.seed)).join("events.jsonl");
        let log = read_log(&path)?;
        let assembly = assemble_with(&config, &city, log.seed, None)?;
        let step = assembly.episode.simulation().world().clock().dt();
        Ok(Self { moving: Moving::Replay { assembly: Box::new(assembly), log: Box::new(log), step } })
    }

    /// The world as it is now.
    pub fn world(&self) -> &World {
        match &self.moving {
            Moving::Traffic { world, .. } => world,
            Moving::Replay { assembly, .. } => assembly.episode.simulation().world(),
        }
    }

    /// How long a step is, s.
    pub fn dt(&self) -> f64 {
        match &self.moving {
            Moving::Traffic { world, .. } => world.clock().dt(),
            Moving::Replay { step, .. } => *step,
        }
    }

    /// One step further.
    ///
    /// # Errors
    /// The traffic failed, or the replay cannot go on.
    pub fn step(&mut self) -> Outcome<Going> {
        match &mut self.moving {
            Moving::Traffic { world, traffic } => {
                world.begin_step();
                let dt = world.clock().dt();
                if let Some(traffic) = traffic {
                    traffic.step(world, dt)?;
                }
                world.finish_step();
                Ok(Going::On)
            }
            Moving::Replay { assembly, log, .. } => {
                if assembly.episode.simulation().world().clock().tick() >= log.end {
                    return Ok(Going::Ended);
                }
                assembly.episode.replay_step(&log.recording)?;
                Ok(Going::On)
            }
        }
    }

    /// Whom one would look at: the first courier of a recorded run.
    pub fn hero(&self) -> Option<EntityId> {
        match &self.moving {
            Moving::Traffic { .. } => None,
            Moving::Replay { assembly, .. } => assembly.couriers.first().copied(),
        }
    }

    /// Whoever of that kind has most others around it, before all of those that move just now.
    pub fn liveliest(&self, kind: Option<EntityKind>) -> Option<EntityId> {
        let bodies: Vec<_> = self.world().iter().filter(|body| body.kind.is_mobile()).collect();
        let around = |at: Point2| bodies.iter().filter(|other| (other.planar() - at).norm() < LIVELY).count();
        let wanted = bodies.iter().filter(|body| kind.is_none_or(|kind| body.kind == kind));
        let rank = |body: &&EntityRef<'_>| {
            let moves = body.twist.ground_speed() > 0.5;
            (moves, around(body.planar()), std::cmp::Reverse(body.id))
        };
        wanted.map(|body| rank(&body)).max().map(|(.., id)| id.0)
    }

    /// A place over the street where most is going on, from which one sees it.
    pub fn lookout(&self) -> Flight {
        let world = self.world();
        let who =
            self.hero().or_else(|| self.liveliest(Some(EntityKind::Car))).or_else(|| self.liveliest(None));
        let middle = who.and_then(|id| world.entity(id)).map_or(Point2::origin(), |body| body.planar());
        let nearest = world.roads().and_then(|roads| {
            let paths = roads.roads.iter().map(|road| &road.centerline);
            let found = paths.filter_map(|path| Some((polyline::closest(path, &middle)?, path)));
            found.min_by(|a, b| a.0.distance.total_cmp(&b.0.distance))
        });
        let Some((closest, path)) = nearest else {
            let eye = Point3::new(middle.x - 30.0, middle.y - 30.0, 20.0);
            return Flight::looking_at(eye, Point3::new(middle.x, middle.y, 0.0));
        };
        let (place, heading) = polyline::at(path, (closest.station - 26.0).max(4.0));
        let aside = direction(heading - std::f64::consts::FRAC_PI_2) * 2.0;
        let ground = world.ground().map_or(0.0, |ground| ground.height(place));
        let eye = Point3::new(place.x + aside.x, place.y + aside.y, ground + 5.2);
        let ahead = direction(heading) * 30.0;
        Flight::looking_at(eye, Point3::new(place.x + ahead.x, place.y + ahead.y, ground + 1.8))
    }
}
