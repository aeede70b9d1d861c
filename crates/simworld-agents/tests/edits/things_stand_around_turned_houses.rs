//! What is put beside a house, and what is found beside it, is told by its walls, however it is turned.

use std::f64::consts::{FRAC_PI_4, PI};

use simworld_agents::editing::{Difference, Edit, EditError, Edited, Make, SceneEditor, Stand, faults};
use simworld_core::geometry::{Point2, Point3, Pose, direction, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Relation, Scene, Shape, World};
use simworld_core::seed::Seed;

/// Half of the length of the house, the way it looks, and of its width, m.
const HALF: [f64; 2] = [30.0, 5.0];

/// A house of 60 m by 10 m alone, which looks so many radians from east.
fn house(yaw: f64) -> (World, EntityId) {
    let mut world = World::new();
    let pose = pose_facing(Point3::new(7.0, -3.0, 0.0), yaw);
    let shape = Shape::cuboid(2.0 * HALF[0], 2.0 * HALF[1], 8.0);
    let desc = EntityDesc::new(EntityKind::Building, pose, shape).named("Maple House");
    let house = world.spawn(desc).unwrap();
    (world, house)
}

/// What was put into the world, as it stands in the frame of the house.
fn put(yaw: f64, asset: &str, stand: impl Fn(EntityId) -> Stand) -> Vec<Pose> {
    let (mut world, house) = house(yaw);
    let stand = stand(house);
    let add = Edit::Add { make: Make::of(asset), count: 3, stands: vec![stand.clone()] };
    let done = SceneEditor::new(Seed(3)).edit(&[add], &mut world);
    let made = done.unwrap_or_else(|error| panic!("{stand:?} at {yaw}: {error}")).made;
    let house_from_world = world.entity(house).unwrap().pose.inverse();
    for thing in &made {
        assert_eq!(faults(&world, *thing), [], "{stand:?} at {yaw}");
        assert!(stand.holds(&world, *thing), "{stand:?} at {yaw}");
    }
    made.iter().map(|thing| house_from_world * world.entity(*thing).unwrap().pose).collect()
}

/// From the walls of the house to the nearest point of a park bench of 0.65 m by 1.8 m, m: by points all along its outline.
fn off_the_walls(bench: &Pose) -> f64 {
    let steps = (0..=40).map(|step| f64::from(step) / 20.0 - 1.0);
    let outline = steps.flat_map(|share| {
        let (ahead, left) = (0.325 * share, 0.9 * share);
        [(ahead, 0.9), (ahead, -0.9), (0.325, left), (-0.325, left)]
    });
    let off = |(ahead, left): (f64, f64)| {
        let at = bench * Point3::new(ahead, left, 0.0);
        let (x, y) = ((at.x.abs() - HALF[0]).max(0.0), (at.y.abs() - HALF[1]).max(0.0));
        (x * x + y * y).sqrt()
    };
    outline.map(off).fold(f64::INFINITY, f64::min)
}

#[test]
fn what_is_put_beside_a_house_stands_there_as_it_would_were_the_house_not_turned() {
    let to = |relation| move |anchor| Stand::To { relation, anchor };
    let all = |yaw: f64| {
        let mut all: Vec<Vec<Pose>> = [
            Relation::NextTo,
            Relation::Near,
            Relation::FarFrom,
            Relation::InFrontOf,
            Relation::Behind,
            Relation::LeftOf,
            Relation::RightOf,
            Relation::OnTopOf,
        ]
        .into_iter()
        .map(|relation| put(yaw, "park_bench", to(relation)))
        .collect();
        all.push(put(yaw, "park_bench", |anchor| Stand::Along { anchor }));
        all.push(put(yaw, "park_bench", |anchor| Stand::AtCornerOf { anchor }));
        all.push(put(yaw, "park_bench", |anchor| Stand::Apart { anchor, least: 6.0, most: 9.0 }));
        all
    };
    let straight = all(0.0);
    for step in 1..12 {
        let yaw = f64::from(step) * PI / 12.0;
        // The last is drawn in any direction of the world, and not of the house.
        let turned = all(yaw);
        for (one, other) in straight.iter().zip(&turned).take(10).flat_map(|(a, b)| a.iter().zip(b)) {
            assert!((one.translation.vector - other.translation.vector).norm() < 1e-6, "{one} and {other}");
            assert!(one.rotation.angle_to(&other.rotation) < 1e-6, "{one} and {other}");
        }
        let nearest = |rank: usize| turned[rank].iter().map(off_the_walls);
        assert!(nearest(0).all(|gap| gap > 0.0 && gap <= 10.1), "next to it");
        assert!(nearest(2).all(|gap| gap > 30.0), "far from it");
        assert!(nearest(8).all(|gap| gap > 0.0 && gap <= 4.1), "along it");
        assert!(nearest(10).all(|gap| gap > 5.9 && gap <= 9.1), "6 to 9 m from it");
    }
}

/// A house that is turned by 45°, and two benches before the middle of a long wall: 3 m and 14 m from it.
fn two_benches() -> (World, [EntityId; 2]) {
    let (mut world, house) = house(-FRAC_PI_4);
    let middle = world.entity(house).unwrap().planar();
    let benches = [3.0, 14.0].map(|gap| {
        let at = middle + direction(FRAC_PI_4) * (HALF[1] + gap + 0.3);
        let pose = pose_facing(Point3::new(at.x, at.y, 0.0), FRAC_PI_4);
        world.spawn(EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.8))).unwrap()
    });
    (world, benches)
}

fn say(words: &str, world: &mut World) -> Result<Edited, EditError> {
    SceneEditor::new(Seed(7)).looking_from(Point2::new(0.0, -60.0)).say(words, world)
}

#[test]
fn beside_a_turned_house_what_is_in_the_box_around_it_alone_is_not_spoken_of() {
    let (mut world, [near, far]) = two_benches();
    let before = world.clone();
    let house = world.iter().find(|thing| thing.kind == EntityKind::Building).unwrap().id;
    let beside = Stand::To { relation: Relation::NextTo, anchor: house };
    assert!(beside.holds(&world, near) && !beside.holds(&world, far));
    let told = say("how many benches are next to the Maple House?", &mut world).unwrap();
    let answer = told.answer.unwrap();
    assert!(answer.starts_with('1'), "{answer}");
    say("remove the bench next to the Maple House", &mut world).unwrap();
    assert_eq!(Difference::between(&before, &world).removed, [near], "there is but one");
}
