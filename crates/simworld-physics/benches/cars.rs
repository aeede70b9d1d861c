//! A step of 1/60 s with a thousand cars on tyres, and with a thousand as single tracks.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use simworld_core::geometry::Point3;
use simworld_physics::proving::Fleet;

fn cars(criterion: &mut Criterion) {
    for (name, interest) in [("tyres", vec![]), ("single_tracks", vec![Point3::new(0.0, 0.0, 1e5)])] {
        let mut fleet = Fleet::new(1000).expect("sound data");
        fleet.physics.set_interest(&interest);
        for _ in 0..120 {
            fleet.step().expect("the step goes well"); // until they roll
        }
        criterion.bench_function(&format!("thousand_cars/{name}"), |bencher| {
            bencher.iter(|| black_box(&mut fleet).step().expect("the step goes well"));
        });
    }
}

criterion_group!(benches, cars);
criterion_main!(benches);
