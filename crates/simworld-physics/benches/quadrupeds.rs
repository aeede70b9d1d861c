//! What fifty robot dogs cost that trot on their motors, beside the time they trot: a tenth of a second of the world, in 20
//! substeps. Less than a tenth of a second is faster than real time.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use simworld_physics::proving::Pack;

fn quadrupeds(criterion: &mut Criterion) {
    for dogs in [1, 50] {
        let mut pack = Pack::new(dogs, 0.6).expect("sound data");
        (0..20).for_each(|_| pack.step(0.1).expect("the step goes well")); // until they trot
        criterion.bench_function(&format!("quadrupeds/{dogs}"), |bencher| {
            bencher.iter(|| black_box(&mut pack).step(0.1).expect("the step goes well"));
        });
    }
}

criterion_group!(benches, quadrupeds);
criterion_main!(benches);
