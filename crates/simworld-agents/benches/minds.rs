//! What it costs to understand a sentence, and to look around, in a city of ten thousand things.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use simworld_agents::language::GrammarPlanner;
use simworld_agents::observer::{SceneGraph, SceneGraphObserver};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{EntityDesc, EntityKind, Place, Shape, World};
use simworld_core::seam::{Observer, Planner};

/// A hundred blocks of a hundred things: a house, cars, trees, lamps, seats, people; every tenth house has a name.
fn city() -> (World, EntityId) {
    const THINGS: [(EntityKind, [f64; 3]); 10] = [
        (EntityKind::Tree, [0.4, 0.4, 7.0]),
        (EntityKind::StreetLamp, [0.2, 0.2, 6.0]),
        (EntityKind::Car, [4.5, 1.8, 1.5]),
        (EntityKind::Bench, [0.6, 1.8, 0.8]),
        (EntityKind::Person, [0.5, 0.5, 1.8]),
        (EntityKind::TrashBin, [0.5, 0.5, 0.9]),
        (EntityKind::Chair, [0.5, 0.5, 0.9]),
        (EntityKind::Parcel, [0.3, 0.3, 0.2]),
        (EntityKind::Sign, [0.1, 0.1, 2.4]),
        (EntityKind::Scooter, [1.1, 0.5, 1.1]),
    ];
    let mut world = World::new();
    let put = |kind: EntityKind, x: f64, y: f64, [length, width, height]: [f64; 3]| {
        EntityDesc::new(kind, pose_facing(Point3::new(x, y, 0.0), 0.0), Shape::cuboid(length, width, height))
    };
    for block in 0..100 {
        let (x, y) = (f64::from(block % 10) * 120.0, f64::from(block / 10) * 120.0);
        let place = Place::ALL[block as usize % Place::ALL.len()];
        let mut house = put(EntityKind::Building, x + 60.0, y + 60.0, [50.0, 40.0, 15.0]).used_as(place);
        if block % 10 == 0 {
            house = house.named(format!("{place} of block {block}"));
        }
        world.spawn(house).expect("a sound house");
        for index in 0..99 {
            let (kind, size) = THINGS[index % THINGS.len()];
            let along = index as f64 / 99.0 * 4.0;
            let (dx, dy) = match along as u32 {
                0 => (along.fract() * 100.0, 5.0),
                1 => (105.0, along.fract() * 100.0),
                2 => (100.0 - along.fract() * 100.0, 105.0),
                _ => (5.0, 100.0 - along.fract() * 100.0),
            };
            world.spawn(put(kind, x + dx, y + dy, size)).expect("a sound thing");
        }
    }
    let me = world.spawn(put(EntityKind::Person, 600.0, 600.0, [0.5, 0.5, 1.8])).expect("a sound person");
    (world, me)
}

const SENTENCES: [(&str, &str); 8] = [
    ("single", "go to the nearest bench"),
    ("two orders", "go to the nearest chair and sit down"),
    ("relation", "walk to the bench near the museum"),
    ("ordinal", "look at the second tree on the left"),
    ("condition", "if it is raining go to the restaurant, otherwise sit down on the bench"),
    ("polite", "could you please pick up the parcel and bring it to the hospital, thank you"),
    ("typo", "go to the nearst bnech and sit down"),
    ("name", "go to the Home of Block 0"),
];

fn language(criterion: &mut Criterion) {
    let (world, me) = city();
    let mut group = criterion.benchmark_group("grammar/10k");
    for (name, words) in SENTENCES {
        let intent = Intent::Words(words.to_owned());
        GrammarPlanner::default()
            .plan(&intent, &world, me)
            .unwrap_or_else(|error| panic!("{words}: {error}"));
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(GrammarPlanner::default().plan(&intent, &world, me)));
        });
    }
}

fn sight(criterion: &mut Criterion) {
    let (world, me) = city();
    let mut group = criterion.benchmark_group("scene_graph/10k");
    let observers = [
        ("all_round_50m", SceneGraphObserver::new(50.0)),
        ("fov_120_occluded_50m", SceneGraphObserver::new(50.0).with_field_of_view(2.094).with_occlusion()),
    ];
    for (name, mut observer) in observers {
        let mut graph = SceneGraph::default();
        group.bench_function(name, |bencher| {
            bencher.iter(|| observer.observe(&world, me, black_box(&mut graph)).expect("the agent is there"));
        });
    }
}

criterion_group!(benches, language, sight);
criterion_main!(benches);
