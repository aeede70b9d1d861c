//! A served world for the tests of the remote interface: walkers and cars without physics, and an eye that casts rays.
#![allow(dead_code, reason = "each group uses its part")]
#![allow(unreachable_pub, reason = "a helper of tests")]

use std::collections::BTreeSet;
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crate::car_common::Bicycle;
use simworld_agents::remote::{
    Decoder, Eye, Framing, Limits, Picture, PictureKind, Report, Server, ServerConfig, SimulationStage,
    StageError, Stopper, View,
};
use simworld_core::asset::Catalogue;
use simworld_core::geometry::{Aabb, Point2, Point3, Vector3, pose_facing};
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::record::Recording;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Dynamics, DynamicsError, Embodiment};
use simworld_core::simulation::Simulation;

/// Gives whoever walks or drives a body as soon as it is there.
#[derive(Default)]
struct Walkers {
    bodies: KinematicDynamics,
    known: BTreeSet<EntityId>,
}

impl Dynamics for Walkers {
    fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
        for entity in world.iter() {
            let body: Box<dyn Embodiment> = match entity.kind {
                EntityKind::Person | EntityKind::Dog => {
                    Box::new(KinematicBody::with_max_speed(*entity.pose, 20.0))
                }
                EntityKind::Car => Box::new(Bicycle::at(*entity.pose)),
                _ => continue,
            };
            if self.known.insert(entity.id) {
                self.bodies.insert(entity.id, body);
            }
        }
        self.bodies.step(world, dt)
    }

    fn save(&self) -> Result<Vec<u8>, DynamicsError> {
        self.bodies.save()
    }

    fn restore(&mut self, world: &World, saved: &[u8]) -> Result<(), DynamicsError> {
        self.bodies.restore(world, saved)
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        self.bodies.state_hash(hasher);
    }
}

/// The crossroads around the square, with signals.
pub fn roads() -> Arc<RoadNetwork> {
    let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default());
    Arc::new(network.expect("it is a network"))
}

/// A square with a bench, a car and somebody who stands there.
pub fn simulation() -> Simulation {
    let mut world = World::new();
    world.set_roads(roads());
    for (_, asset) in Catalogue::standard().iter() {
        world.add_asset(asset.clone()).expect("standard assets are sound");
    }
    let mut put = |kind, x, y, shape, name: &str| {
        let at = pose_facing(Point3::new(x, y, 0.0), 0.0);
        world.spawn(EntityDesc::new(kind, at, shape).named(name)).expect("it fits");
    };
    put(EntityKind::Bench, 5.0, 0.0, Shape::cuboid(0.6, 1.8, 0.85), "Bench");
    put(EntityKind::Car, 0.0, 10.0, Shape::cuboid(4.5, 1.8, 1.5), "Red Car");
    put(EntityKind::Person, 4.0, 0.0, Shape::Capsule { radius: 0.25, height: 1.75 }, "Ada");
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("walkers", Box::<Walkers>::default());
    simulation
}

/// Casts a ray through every pixel, at the boxes around things and the ground.
pub struct RayEye;

impl Eye for RayEye {
    fn picture(&mut self, scene: &dyn Scene, view: &View, kind: PictureKind) -> Result<Picture, StageError> {
        let inside = view.camera.intrinsics;
        let from = view.camera.world_from_optical;
        let mut bytes = Vec::new();
        for row in 0..inside.height {
            for column in 0..inside.width {
                let pixel = Point2::new(f64::from(column) + 0.5, f64::from(row) + 0.5);
                let ahead = from.rotation * inside.unproject(&pixel, 1.0).coords;
                let (depth, slot) = cast(scene, view, from.translation.vector, ahead);
                match kind {
                    PictureKind::Color => bytes.extend([slot as u8 * 40, (depth * 10.0).min(255.0) as u8, 7]),
                    PictureKind::Depth => bytes.extend((depth as f32).to_le_bytes()),
                    PictureKind::Instances => bytes.extend(slot.to_le_bytes()),
                }
            }
        }
        Ok(Picture { kind, width: inside.width, height: inside.height, bytes })
    }
}

/// Planar depth and slot plus one of what a ray meets first; `ahead` has depth 1.
fn cast(scene: &dyn Scene, view: &View, origin: Vector3, ahead: Vector3) -> (f64, u32) {
    let mut best = if ahead.z < 0.0 { (-origin.z / ahead.z, 0) } else { (f64::INFINITY, 0) };
    let swept = Aabb::new(origin.into(), (origin + ahead * 100.0).into());
    let _ = scene.visit(&swept, &mut |entity| {
        let depth = enters(entity.bounds, origin, ahead).filter(|_| view.hidden != Some(entity.id));
        if let Some(depth) = depth.filter(|depth| *depth < best.0 && entity.is_visible()) {
            best = (depth, entity.id.index() as u32 + 1);
        }
        ControlFlow::Continue(())
    });
    best
}

/// Where a ray enters a box.
fn enters(bounds: &Aabb, origin: Vector3, ahead: Vector3) -> Option<f64> {
    let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let (a, b) = (
            (bounds.min[axis] - origin[axis]) / ahead[axis],
            (bounds.max[axis] - origin[axis]) / ahead[axis],
        );
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    (enter <= leave).then_some(enter)
}

/// A server in a thread of its own.
pub struct Running {
    pub unrealcv: SocketAddr,
    pub typed: SocketAddr,
    pub stopper: Stopper,
    thread: JoinHandle<(Report, Recording)>,
}

impl Running {
    /// Ends it; gives what it did and what its clients did.
    pub fn stop(self) -> (Report, Recording) {
        self.stopper.stop();
        self.thread.join().expect("the server ends in peace")
    }
}

/// Serves the square on free ports.
pub fn serve(config: ServerConfig) -> Running {
    let server = Server::bind(config).expect("the ports are free");
    let unrealcv = server.unrealcv_address().expect("it listens");
    let typed = server.typed_address().expect("it listens");
    let stopper = server.stopper();
    let thread = std::thread::spawn(move || {
        let mut stage = SimulationStage::new(simulation()).seen_by(Box::new(RayEye));
        let report = server.run(&mut stage).expect("the world goes on");
        (report, stage.recording())
    });
    Running { unrealcv, typed, stopper, thread }
}

/// Replays a recording and gives the trail of digests.
pub fn replay(recording: &Recording) -> Recording {
    let mut again = simulation();
    again.set_trail_interval(1);
    for (tick, _) in &recording.trail {
        let before = again.world().clock().tick();
        for command in recording.commands_at(before) {
            again.submit(command.clone());
        }
        again.step().expect("the world goes on");
        assert_eq!(again.world().clock().tick(), *tick);
        let (_, digest) = again.recording().trail.last().expect("a digest a step");
        recording.confirm(*tick, *digest).expect("the same state");
    }
    again.recording().clone()
}

/// Limits that tests do not have to wait long for.
pub fn impatient() -> Limits {
    Limits {
        clients: 8,
        hello_seconds: 0.3,
        frame_seconds: 0.3,
        write_seconds: 0.3,
        idle_seconds: 30.0,
        ..Limits::default()
    }
}

/// Waits until something is so, at most ten seconds.
pub fn becomes(what: &str, is_so: impl Fn() -> bool) {
    let start = now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(10), "it never came to be that {what}");
        thread::sleep(Duration::from_millis(10));
    }
}

/// The time now.
#[expect(clippy::disallowed_methods, reason = "how long clients wait is outside the simulation")]
pub fn now() -> Instant {
    Instant::now()
}

/// A socket that waits for nothing longer than 200 ms.
pub fn connect(address: SocketAddr) -> Option<TcpStream> {
    let socket = TcpStream::connect(address).ok()?;
    socket.set_write_timeout(Some(Duration::from_millis(200))).ok()?;
    socket.set_read_timeout(Some(Duration::from_millis(200))).ok()?;
    Some(socket)
}

/// A client of `UnrealCV`, byte by byte as its Python client is.
pub struct Unreal {
    socket: TcpStream,
    decoder: Decoder,
    next: u32,
}

impl Unreal {
    pub fn connect(address: SocketAddr) -> Self {
        let socket = TcpStream::connect(address).expect("it listens");
        socket.set_nodelay(true).expect("a socket");
        socket.set_read_timeout(Some(Duration::from_secs(20))).expect("a socket");
        let mut client = Self { socket, decoder: Decoder::new(Framing::UnrealCv, 1 << 26), next: 0 };
        let confirm = client.payload();
        assert!(confirm.starts_with(b"connected to "), "{}", String::from_utf8_lossy(&confirm));
        client
    }

    pub fn send(&mut self, command: &str) {
        let payload = format!("{}:{command}", self.next);
        let mut raw = vec![0xc1, 0x83, 0x2b, 0x9e];
        raw.extend((payload.len() as u32).to_le_bytes());
        raw.extend(payload.as_bytes());
        self.socket.write_all(&raw).expect("the server reads");
        self.next += 1;
    }

    /// The answer to the request of that number, without it.
    pub fn answer(&mut self, number: u32) -> Vec<u8> {
        let payload = self.payload();
        let prefix = format!("{number}:");
        assert!(payload.starts_with(prefix.as_bytes()), "{}", String::from_utf8_lossy(&payload));
        payload[prefix.len()..].to_vec()
    }

    pub fn bytes(&mut self, command: &str) -> Vec<u8> {
        self.send(command);
        self.answer(self.next - 1)
    }

    pub fn ask(&mut self, command: &str) -> String {
        String::from_utf8(self.bytes(command)).expect("the answer is text")
    }

    pub fn numbers(&mut self, command: &str) -> Vec<f64> {
        let answer = self.ask(command);
        answer.split(' ').map(|word| word.parse().unwrap_or_else(|_| panic!("{command}: {answer}"))).collect()
    }

    fn payload(&mut self) -> Vec<u8> {
        let mut chunk = [0; 4096];
        loop {
            if let Some(frame) = self.decoder.next_frame().expect("frames") {
                return frame;
            }
            let count = self.socket.read(&mut chunk).expect("the server answers");
            assert!(count > 0, "the server hung up");
            self.decoder.feed(&chunk[..count]);
        }
    }
}
