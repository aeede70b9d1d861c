//! The crowd against what was measured of people: speed over density, doors, streams that meet; and no body in another.
//!
//! `SIMWORLD_SOAK=1` goes through more densities, widths and seeds.

use proptest::prelude::*;
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::ops;
use simworld_core::seed::Seed;
use simworld_traffic::crowd::{AnticipationVelocity, Crowd, Person, Walls, Wish};
use simworld_traffic::validation::corridor::{Corridor, LENGTH, WIDTH, weidmann};

use crate::at_once::at_once;

const DT: f64 = 0.1;

fn soak() -> bool {
    std::env::var("SIMWORLD_SOAK").is_ok()
}

fn nearest_two(people: &[Point2]) -> f64 {
    let mut sorted = people.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x));
    let mut nearest = f64::INFINITY;
    for (index, person) in sorted.iter().enumerate() {
        for other in &sorted[index + 1..] {
            if other.x - person.x >= nearest {
                break;
            }
            nearest = nearest.min((other - person).norm());
        }
    }
    nearest
}

#[test]
fn speed_falls_with_density_as_weidmann_says() {
    // Forty people are few: their own free speeds would show.
    let seeds = if soak() { 24 } else { 4 };
    at_once([0.5, 1.0, 1.5, 2.0, 3.0, 4.0], |density| {
        let speed = |seed| Corridor::new(density, false, seed).mean_speed(&AnticipationVelocity::default());
        let mean = (0..seeds).map(speed).sum::<f64>() / seeds as f64;
        println!("{density} per m²: {mean:.3} m/s, Weidmann {:.3}", weidmann(density));
        let off = (mean - weidmann(density)).abs();
        assert!(off < 0.1, "{mean} m/s at {density} per m² is {off} m/s off");
    });
}

/// How many pass a door of a width a second and metre, from a room of 7 by 8 m full of people.
fn flow_through_a_door(width: f64, seed: u64) -> f64 {
    let model = AnticipationVelocity::default();
    let half = width * 0.5;
    let at = Point2::new;
    let walls = Walls::new(vec![
        (at(-10.0, -4.0), at(0.0, -4.0)),
        (at(-10.0, 4.0), at(0.0, 4.0)),
        (at(0.0, -4.0), at(0.0, -half)),
        (at(0.0, half), at(0.0, 4.0)),
        (at(0.0, -half), at(2.0, -half)),
        (at(0.0, half), at(2.0, half)),
    ]);
    let mut rng = Seed(seed).stream("room").rng();
    let mut people = Vec::new();
    let mut speeds = Vec::new();
    for (row, column) in (0..14).flat_map(|row| (0..12).map(move |column| (row, column))) {
        let x = -1.0 - 0.6 * f64::from(column) + rng.uniform(-0.1, 0.1);
        let y = -3.5 + 0.54 * f64::from(row) + rng.uniform(-0.05, 0.05);
        people.push(Person::standing(at(x, y), Vector2::x()));
        speeds.push(rng.normal_clamped(1.34, 0.26, 0.5, 2.2));
    }
    let (mut crowd, mut wishes, mut passed) = (Crowd::default(), Vec::new(), Vec::new());
    let everybody = people.len();
    for step in 0..3000 {
        wishes.clear();
        wishes.extend(people.iter().zip(&speeds).map(|(person, speed)| {
            let inside = half - model.radius - 0.05;
            let target = if person.position.x > 0.0 {
                at(10.0, person.position.y)
            } else {
                at(0.3, person.position.y.clamp(-inside, inside))
            };
            Wish { direction: (target - person.position).normalize(), speed: *speed }
        }));
        crowd.step(&model, &mut people, &wishes, &[], &walls, DT);
        for index in
            (0..people.len()).rev().filter(|index| people[*index].position.x > 2.5).collect::<Vec<_>>()
        {
            people.swap_remove(index);
            speeds.swap_remove(index);
            passed.push(f64::from(step) * DT);
        }
    }
    let least = people.iter().map(|person| 4.0 - person.position.y.abs()).fold(1.0, f64::min);
    assert!(least > model.radius - 1e-9, "somebody is in a wall");
    assert_eq!(passed.len(), everybody, "the door of {width} m is blocked, seed {seed}");
    // After the first have come and before the last thin out.
    let (first, last) = (everybody / 10, everybody * 7 / 10);
    (last - first) as f64 / (passed[last] - passed[first]) / width
}

#[test]
fn doors_pass_as_many_as_measured() {
    let seeds = if soak() { 0..8 } else { 0..1 };
    for seed in seeds {
        for width in [0.8, 1.2, 1.6, 2.5] {
            let flow = flow_through_a_door(width, seed);
            println!("door of {width} m: {flow:.2} people a second and metre");
            assert!((1.2..1.9).contains(&flow), "{flow} /(m s) through {width} m, seed {seed}");
        }
    }
}

#[test]
fn streams_that_meet_part_into_lanes() {
    let model = AnticipationVelocity::default();
    for seed in 0..if soak() { 20 } else { 3 } {
        let mut corridor = Corridor::new(1.0, true, seed);
        let before = corridor.order();
        let speed = corridor.mean_speed(&model);
        let mut order = 0.0;
        for _ in 0..300 {
            corridor.step(&model);
            order += corridor.order() / 300.0;
        }
        println!("streams that meet at 1 per m²: {speed:.2} m/s, order {before:.2} to {order:.2}");
        assert!(order > before + 0.3 && order > 0.6, "order {before} to {order}, seed {seed}");
        assert!(speed > 0.6 * weidmann(1.0), "{speed} m/s, seed {seed}");
    }
}

#[test]
fn numbers_give_no_advantage() {
    let model = AnticipationVelocity::default();
    let mut one = Corridor::new(1.5, true, 4);
    let mut other = Corridor::new(1.5, true, 4);
    other.people.reverse();
    other.wishes.reverse();
    // For a few steps: sums in another order differ by rounding, which a crowd magnifies.
    for _ in 0..5 {
        one.step(&model);
        other.step(&model);
    }
    for (a, b) in one.people.iter().zip(other.people.iter().rev()) {
        assert!((a.position - b.position).norm() < 1e-9, "{a:?} against {b:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if soak() { 200 } else { 12 }))]

    /// Whatever one wishes and however long the steps are, bodies stay apart and within walls.
    #[test]
    fn bodies_never_overlap(
        density in 0.5_f64..5.0, turn in 0.0_f64..6.3, radius in 0.1_f64..0.18, dt in 0.02_f64..0.5, seed in any::<u64>(),
    ) {
        let model = AnticipationVelocity { radius, ..AnticipationVelocity::default() };
        let mut corridor = Corridor::new(density, true, seed);
        let mut rng = Seed(seed).stream("wishes").rng();
        let begun: Vec<Point2> = corridor.people.iter().chain(&corridor.seams).map(|person| person.position).collect();
        prop_assume!(nearest_two(&begun) > 2.0 * radius);
        let ends = [0.0, LENGTH].map(|x| (Point2::new(x - 1.0, -1.0), Point2::new(x - 1.0, WIDTH + 1.0)));
        let side = |y: f64| (Point2::new(-2.0, y), Point2::new(LENGTH + 2.0, y));
        let walls = Walls::new(vec![ends[0], (ends[1].0 + Vector2::x() * 2.0, ends[1].1 + Vector2::x() * 2.0), side(0.0), side(WIDTH)]);
        for step in 0..150 {
            for wish in &mut corridor.wishes {
                let (y, x) = ops::sin_cos(turn * f64::from(step / 40) + rng.uniform(-1.0, 1.0));
                *wish = Wish { direction: Vector2::new(x, y), speed: rng.uniform(0.0, 2.5) };
            }
            let Corridor { people, wishes, crowd, .. } = &mut corridor;
            crowd.step(&model, people, wishes, &[], &walls, dt);
            let places: Vec<Point2> = people.iter().map(|person| person.position).collect();
            prop_assert!(nearest_two(&places) > 2.0 * radius - 1e-9, "{} m at step {step}", nearest_two(&places));
            for place in places {
                prop_assert!(place.y > radius - 1e-9 && place.y < WIDTH - radius + 1e-9);
                prop_assert!(place.x > -1.0 + radius - 1e-9 && place.x < LENGTH + 1.0 - radius + 1e-9);
            }
        }
    }
}
