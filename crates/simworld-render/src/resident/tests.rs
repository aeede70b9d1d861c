//! Whatever was seen before: what a batch may show of whom is as if everybody had been dressed in full for it, and little else is dressed.

use simworld_core::alteration::Alteration;
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Twist, pose_facing};
use simworld_core::scene::{EntityDesc, Shape, Visibility, World};
use simworld_core::seed::{Seed, StreamRng};

use super::*;
use crate::demand::Manner;
use crate::look::Detail;
use crate::view::View;

const DETAILS: [Detail; 3] = [Detail::Far, Detail::Middle, Detail::Near];

/// Somebody who moves on a square of that side, or something that stands there.
fn put(world: &mut World, rng: &mut StreamRng, side: f64) -> EntityId {
    let (kind, shape) = match rng.uniform(0.0, 8.0) as u32 {
        0 | 1 => (EntityKind::Car, Shape::cuboid(4.4, 1.8, 1.5)),
        2 => (EntityKind::Bus, Shape::cuboid(17.0, 2.5, 3.1)),
        3 => (EntityKind::Bicycle, Shape::cuboid(1.75, 0.6, 1.6)),
        4 => (EntityKind::Dog, Shape::cuboid(0.8, 0.3, 0.6)),
        5 => (EntityKind::Robot, Shape::cuboid(0.8, 0.6, 1.2)),
        _ => (EntityKind::Person, Shape::Capsule { radius: 0.25, height: 1.75 }),
    };
    let desc = EntityDesc::new(kind, pose_facing(place(rng, side), rng.uniform(-3.0, 3.0)), shape);
    world.spawn(desc).expect("a solid in the world")
}

fn place(rng: &mut StreamRng, side: f64) -> Point3 {
    Point3::new(rng.uniform(-0.5, 0.5) * side, rng.uniform(-0.5, 0.5) * side, 0.0)
}

/// What a batch of so many eyes on a square demands: of rays in colour or of depth by triangles.
fn demand(rng: &mut StreamRng, side: f64, count: usize, is_cast: bool) -> Demand {
    let view = |_| {
        let intrinsics = Intrinsics::from_fov(128, 96, 1.2).expect("a size in range");
        let eye = place(rng, side) + Vector3::z() * 1.6;
        let camera = Camera::looking_along(&pose_facing(eye, rng.uniform(-3.0, 3.0)), intrinsics);
        View::new(&camera, 0.05, 1000.0, 4096).expect("a sound camera")
    };
    let views: Vec<View> = (0..count).map(view).collect();
    let mut demand = Demand::default();
    let manner = Manner { min_pixels: 0.7, finest: false, is_cast, in_color: is_cast, widest: side };
    demand.gather(&views, &[], &manner);
    demand
}

fn follow(residents: &mut Residents, world: &World, demand: &Demand) {
    residents.follow(world, &Aabb::around(Point3::origin(), Vector3::repeat(1.0)), demand);
}

/// What there is of a slot at a level, in the order in which it is drawn.
fn at(residents: &Residents, slot: u32, detail: Detail) -> Vec<(Drawn, Instance, Grain)> {
    let numbers = residents.numbers_of(slot).map(|number| number as usize);
    let own = numbers.filter(|number| residents.cards[*number].details & detail.bit() != 0);
    let part =
        |number: usize| (residents.cards[number].mesh, residents.instances[number], residents.grains[number]);
    let mut own: Vec<_> = own.map(part).collect();
    own.sort_by_key(|(mesh, ..)| *mesh);
    own
}

/// Compares with somebody who dresses all in full; gives how many levels of how many bodies are there.
fn check(residents: &Residents, world: &World, demand: &Demand, what: &str) -> usize {
    let mut full = Residents::default();
    follow(&mut full, world, &Demand::default());
    let mut dressed = 0;
    for slot in 0..residents.names.len() as u32 {
        let Some(head) = full.numbers_of(slot).next() else {
            assert!(residents.numbers_of(slot).next().is_none(), "{what}: nobody is seen in slot {slot}");
            continue;
        };
        let levels = demand.levels(full.grid.ball(head));
        for detail in DETAILS {
            let (own, whole) = (at(residents, slot, detail), at(&full, slot, detail));
            assert!(own.is_empty() || own == whole, "{what}: slot {slot} was otherwise at {detail:?}");
            let lacks = levels & detail.bit() != 0 && own.len() != whole.len();
            assert!(!lacks, "{what}: slot {slot} lacks {detail:?}");
            dressed += usize::from(!own.is_empty());
        }
    }
    residents.grid.visit(
        |_, _| true,
        |number, _| assert!(residents.cards[number as usize].details != 0, "{what}: nobody sees {number}"),
    );
    dressed
}

fn shift(world: &mut World, rng: &mut StreamRng, id: EntityId) {
    let pose = *world.entity(id).expect("it lives").pose;
    let ahead = nalgebra::Translation3::new(rng.uniform(-1.0, 1.5), 0.0, 0.0);
    world.set_motion(id, pose * ahead, Twist::ZERO).expect("it lives");
}

/// One thing that happens to a world.
fn change(world: &mut World, rng: &mut StreamRng, side: f64, ids: &mut Vec<EntityId>) {
    let pick = rng.uniform(0.0, ids.len() as f64) as usize;
    let alter = |world: &mut World, alteration| {
        world.alter(ids[pick], alteration).expect("it lives");
    };
    match rng.uniform(0.0, 12.0) as u32 {
        0 => ids.push(put(world, rng, side)),
        1 => {
            world.remove(ids.swap_remove(pick)).expect("it lives");
        }
        2 => alter(world, Alteration::Color(Some([rng.uniform(0.0, 1.0) as f32, 0.2, 0.3]))),
        3 => alter(world, Alteration::Visibility(Visibility::Hidden)),
        4 => alter(world, Alteration::Visibility(Visibility::Shown)),
        5 => {
            let pose = pose_facing(place(rng, side), 1.0);
            world.set_motion(ids[pick], pose, Twist::ZERO).expect("it lives");
        }
        _ => shift(world, rng, ids[pick]),
    }
}

/// Few eyes and many, near and far, of rays and of triangles in turn, with no step between or several, while bodies come, go, move and are altered.
#[test]
fn nothing_that_is_seen_is_undressed_or_stale() {
    let mut rng = Seed(41).stream("tests/residents").rng();
    for side in [30.0, 400.0] {
        let (mut world, mut residents) = (World::new(), Residents::default());
        let mut ids: Vec<EntityId> = (0..60).map(|_| put(&mut world, &mut rng, side)).collect();
        let mut sparing = 0;
        for round in 0..60 {
            let changes = if round % 4 == 3 { 0 } else { 30 };
            for _ in 0..changes {
                change(&mut world, &mut rng, side, &mut ids);
            }
            for _ in 0..round % 3 {
                world.finish_step();
            }
            let demand = demand(&mut rng, side, [1, 3, 9][round % 3], round % 5 < 2);
            follow(&mut residents, &world, &demand);
            let dressed = check(&residents, &world, &demand, &format!("{side} m, round {round}"));
            sparing += usize::from(dressed < 2 * ids.len());
        }
        assert!(sparing > 3, "{sparing} rounds in which bodies were not dressed in full");
    }
}

/// A crowd that moves, of which a thousandth is near somebody: what changes in a step is little, and lies together.
#[test]
fn few_instances_change_and_they_lie_together() {
    let mut rng = Seed(42).stream("tests/residents").rng();
    let (mut world, mut residents) = (World::new(), Residents::default());
    let ids: Vec<EntityId> = (0..400).map(|_| put(&mut world, &mut rng, 900.0)).collect();
    follow(&mut residents, &world, &demand(&mut rng, 900.0, 6, true));
    let everything = residents.ordered().count();
    let mut heads: Vec<u32> = Vec::new();
    for step in 0..8 {
        for id in &ids {
            shift(&mut world, &mut rng, *id);
        }
        world.finish_step();
        residents.changed.clear();
        let demand = demand(&mut rng, 900.0, if step == 5 { 1 } else { 6 }, step != 5);
        follow(&mut residents, &world, &demand);
        check(&residents, &world, &demand, &format!("step {step}"));
        // In the first they give up the numbers that they had while they stood.
        if step > 0 {
            residents.changed.sort_unstable();
            residents.changed.dedup();
            let changed = &residents.changed;
            assert!(changed.len() * 4 < everything, "{} of {everything}, step {step}", changed.len());
            // Robots are dressed in full, and stand among those that were here first.
            let own: Vec<u32> =
                changed.iter().copied().filter(|number| residents.cards[*number as usize].nimble).collect();
            let wide = own[own.len() - 1] - own[0] + 1;
            assert!(own.len() * 3 > wide as usize, "{} numbers within {wide}, step {step}", own.len());
            // Whatever is seen of somebody, it is the same leaf to rays.
            assert!(heads.is_empty() || heads == residents.heads, "step {step}");
            heads.clone_from(&residents.heads);
        }
    }
}

/// Who is seen from nowhere keeps one number and is not looked at, until somebody looks: then it is dressed without a step.
#[test]
fn who_is_not_seen_keeps_its_place() {
    let mut world = World::new();
    let shape = Shape::Capsule { radius: 0.25, height: 1.75 };
    let desc = EntityDesc::new(EntityKind::Person, pose_facing(Point3::new(30.0, 0.0, 0.0), 0.0), shape);
    let id = world.spawn(desc).expect("a person in the world");
    let facing = |yaw: f64| {
        let intrinsics = Intrinsics::from_fov(128, 96, 1.2).expect("a size in range");
        let camera = Camera::looking_along(&pose_facing(Point3::origin(), yaw), intrinsics);
        let view = View::new(&camera, 0.05, 1000.0, 4096).expect("a sound camera");
        let mut demand = Demand::default();
        let manner = Manner { min_pixels: 0.7, finest: false, is_cast: false, in_color: false, widest: 30.0 };
        demand.gather(&[view], &[], &manner);
        demand
    };
    let (towards, away) = (facing(0.0), facing(3.1));
    let mut residents = Residents::default();
    follow(&mut residents, &world, &away);
    assert!(residents.ordered().count() > 10, "who comes is dressed in full");
    let slot = id.index() as u32;
    let mut head = None;
    for (step, looks) in [(1, false), (2, false), (2, true), (2, false), (3, true), (4, false), (4, true)] {
        let pose = pose_facing(Point3::new(30.0 + f64::from(step), 0.0, 0.0), 0.0);
        world.set_motion(id, pose, Twist::ZERO).expect("it lives");
        world.finish_step();
        let demand = if looks { &towards } else { &away };
        follow(&mut residents, &world, demand);
        check(&residents, &world, demand, &format!("step {step}"));
        let numbers: Vec<u32> = residents.numbers_of(slot).collect();
        let drawn = numbers.iter().filter(|number| residents.cards[**number as usize].details != 0).count();
        // At step 2 the third time nothing changed, so that what was up to date stays.
        assert!(drawn == usize::from(looks) || (step == 2 && drawn == 1), "{drawn} drawn, step {step}");
        assert_eq!(numbers.len(), 1);
        assert!(head.is_none_or(|head| head == numbers[0]), "another number, step {step}");
        head = Some(numbers[0]);
    }
}
