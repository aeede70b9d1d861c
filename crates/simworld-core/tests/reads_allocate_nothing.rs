//! After a warm-up, reading a world, finding routes and stepping moving bodies ask the heap for nothing.

#![allow(clippy::unwrap_used, reason = "a helper of tests")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::hint::black_box;
use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, Point3, Pose, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::net::{
    NetworkConfig, RoadNetwork, Route, RouteScratch, StreetPlan, WaypointConfig, WaypointGraph,
};
use simworld_core::scene::{Attachment, EntityDesc, EntityKind, Role, Scene, Shape, World};

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

/// The system's allocator, counting the requests of each thread.
struct Counting;

fn count() {
    // A thread that is being torn down has no counter left, and is not under test.
    let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
}

// SAFETY: every call is passed on unchanged to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // SAFETY: the caller keeps the contract of `realloc`.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How often the heap was asked during the work.
fn allocations(work: &mut dyn FnMut()) -> u64 {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

fn crowd() -> World {
    let mut world = World::new();
    for index in 0..400_u32 {
        let at = Point3::new(f64::from(index % 20) * 16.0 + 4.0, f64::from(index / 20) * 16.0 + 4.0, 0.0);
        let shape = Shape::Capsule { radius: 0.25, height: 1.8 };
        world.spawn(EntityDesc::new(EntityKind::Person, pose_facing(at, 0.0), shape)).unwrap();
    }
    for index in 0..20 {
        let parent = EntityId::new(2 * index, 0);
        let bond = Attachment { parent, role: Role::Part, parent_from_body: Pose::identity() };
        world.attach(EntityId::new(2 * index + 1, 0), Some(bond)).unwrap();
    }
    world.finish_step();
    world
}

#[test]
fn the_counter_counts() {
    assert_eq!(allocations(&mut || drop(black_box(Box::new(7)))), 1);
}

#[test]
fn reads_of_a_world() {
    let world = crowd();
    let mut work = || {
        let mut seen = 0;
        let region = Aabb::column_around(Point2::new(150.0, 150.0), 70.0);
        let _ = world.visit(&region, &mut |entity| {
            seen += entity.id.index();
            ControlFlow::Continue(())
        });
        let near = world.nearest(Point2::new(33.0, 90.0), 500.0, &|e| e.kind == EntityKind::Person);
        let mut attached = 0;
        world.visit_attached(EntityId::new(4, 0), &mut |_| attached += 1);
        let part = world.attached(EntityId::new(4, 0), Role::Part);
        black_box((seen, near.map(|e| e.id), world.entity(EntityId::new(9, 0)).is_some(), attached, part));
    };
    work();
    assert_eq!(allocations(&mut work), 0);
}

#[test]
fn steps_of_moving_bodies() {
    let mut world = crowd();
    let mut phase = 0.0;
    let mut work = || {
        world.begin_step();
        phase = 1.0 - phase;
        for index in 40..400 {
            let at = Point3::new(
                f64::from(index % 20) * 16.0 + 4.0 + phase,
                f64::from(index / 20) * 16.0 + 4.0,
                0.0,
            );
            let twist = Twist { linear: Vector3::x(), ..Twist::ZERO };
            world.set_motion(EntityId::new(index, 0), pose_facing(at, phase), twist).unwrap();
        }
        world.finish_step();
    };
    work();
    work();
    assert_eq!(allocations(&mut work), 0);
}

#[test]
fn routes_with_a_kept_scratch() {
    let network = RoadNetwork::derive(&StreetPlan::grid(5, 5, 120.0), &NetworkConfig::default()).unwrap();
    let walks = WaypointGraph::walkable(&network, &WaypointConfig::default()).unwrap();
    let (mut scratch, mut route) = (RouteScratch::default(), Route::default());
    let mut work = || {
        let from = walks.nearest(Point2::new(10.0, 10.0)).unwrap();
        let to = walks.nearest(Point2::new(470.0, 470.0)).unwrap();
        assert!(walks.route(from, to, &mut scratch, &mut route));
        assert!(walks.route(to, from, &mut scratch, &mut route));
    };
    work();
    assert_eq!(allocations(&mut work), 0);
}
